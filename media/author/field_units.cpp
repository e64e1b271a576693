#include "media/author/field_units.h"

#include <cctype>
#include <map>
#include <vector>

namespace arcus::media {
namespace {

using Table = std::map<std::string, FieldUnit, std::less<>>;

std::optional<FieldUnit> look_up(const Table& table, std::string_view unit) {
  const auto found = table.find(plain_unit(unit));
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

/// Letters, then the sign and digits of a power: "m-3", "cm3".
struct Factor {
  std::string name;
  int power = 1;
};

}  // namespace

std::string plain_unit(std::string_view unit) {
  std::vector<Factor> factors;
  int sign = 1;
  std::size_t i = 0;
  while (i < unit.size()) {
    const auto c = static_cast<unsigned char>(unit[i]);
    if (c == '/') {
      sign = -1;
      ++i;
    } else if (std::isalpha(c) || c >= 0x80 || c == '#' || c == '%') {
      Factor factor;
      while (i < unit.size() && (std::isalpha(static_cast<unsigned char>(unit[i])) || static_cast<unsigned char>(unit[i]) >= 0x80 ||
                                 unit[i] == '#' || unit[i] == '%'))
        factor.name += unit[i++];
      while (i < unit.size() && (unit[i] == '^' || unit[i] == '*')) ++i;  // m^3, m**3
      int power = 0, power_sign = 1;
      if (i < unit.size() && (unit[i] == '-' || unit[i] == '+')) power_sign = unit[i++] == '-' ? -1 : 1;
      while (i < unit.size() && std::isdigit(static_cast<unsigned char>(unit[i])) && power < 100) power = 10 * power + (unit[i++] - '0');
      factor.power = sign * power_sign * (power == 0 ? 1 : power);
      sign = 1;
      if (factor.name != "#") factors.push_back(factor);
    } else {
      ++i;  // blanks, dots, brackets, the 1 of 1/cm3
    }
  }
  std::string text;
  for (const Factor& factor : factors) {
    text += (text.empty() ? "" : " ") + factor.name;
    if (factor.power != 1) text += std::to_string(factor.power);
  }
  return text.empty() ? "1" : text;
}

std::optional<FieldUnit> water_unit(std::string_view unit) {
  static const Table table{{"g m-3", {1, false}},  {"kg m-3", {1e3, false}}, {"mg m-3", {1e-3, false}}, {"g kg-1", {1, true}},
                           {"kg kg-1", {1e3, true}}, {"mg kg-1", {1e-3, true}}, {"1", {1e3, true}}};
  return look_up(table, unit);
}

std::optional<FieldUnit> number_unit(std::string_view unit) {
  static const Table table{{"cm-3", {1, false}}, {"m-3", {1e-6, false}}, {"l-1", {1e-3, false}},   {"L-1", {1e-3, false}},
                           {"kg-1", {1e-6, true}}, {"mg-1", {1, true}},  {"g-1", {1e-3, true}}};
  return look_up(table, unit);
}

std::optional<FieldUnit> radius_unit(std::string_view unit) {
  static const Table table{{"um", {1, false}},      {"micron", {1, false}},     {"microns", {1, false}},    {"µm", {1, false}},
                           {"μm", {1, false}},      {"micrometer", {1, false}}, {"micrometre", {1, false}}, {"micrometers", {1, false}},
                           {"mkm", {1, false}},     {"mm", {1e3, false}},       {"m", {1e6, false}},        {"cm", {1e4, false}}};
  return look_up(table, unit);
}

std::optional<FieldUnit> length_unit(std::string_view unit) {
  static const Table table{{"m", {1, false}},        {"meter", {1, false}},  {"meters", {1, false}},     {"metre", {1, false}},
                           {"metres", {1, false}},   {"km", {1e3, false}},   {"kilometer", {1e3, false}}, {"kilometers", {1e3, false}},
                           {"kilometre", {1e3, false}}, {"kilometres", {1e3, false}}, {"cm", {1e-2, false}}};
  return look_up(table, unit);
}

std::optional<FieldUnit> pressure_unit(std::string_view unit) {
  static const Table table{{"Pa", {1, false}},     {"hPa", {100, false}},      {"mb", {100, false}},    {"mbar", {100, false}},
                           {"kPa", {1e3, false}},  {"millibar", {100, false}}, {"millibars", {100, false}}};
  return look_up(table, unit);
}

}  // namespace arcus::media
