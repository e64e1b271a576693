#include "media/author/model_output.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

#include "media/author/air_density.h"
#include "media/author/field_units.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::media {
namespace {

using Variable = NetcdfFile::Variable;
using Names = std::vector<std::string>;
using Unit = std::optional<FieldUnit> (*)(std::string_view);

// What models and their converters call them, without regard to capitals; the first that the file has.
const Names water_names{"lwc", "qc", "clw", "clwc", "ql", "qcloud", "qcl", "rc", "rct", "liquid_water_content", "cloud_liquid_water_content", "cloud_water"};
const Names number_names{"nc", "qnc", "qncloud", "cdnc", "ndrop", "number_concentration", "droplet_number", "cloud_droplet_number_concentration"};
const Names radius_names{"reff", "re", "r_eff", "rel", "re_cloud", "effective_radius", "cloud_effective_radius"};
const Names density_names{"rho", "air_density", "rhoair", "rho_air", "dens", "rhobf"};
const Names pressure_names{"p", "pres", "pressure", "presh"};
const Names temperature_names{"tabs", "ta", "temp", "temperature", "air_temperature", "t"};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

class Reader {
 public:
  Reader(const std::string& path, const ModelSettings& settings, const std::optional<GivenLattice>& given)
      : file_(path), s_(settings), water_(find_water()), axes_(find_axes(file_, water_, settings.axes, given)) {
    if (!water_.is_number) throw bad_input(file_.where(water_), "no numbers", "liquid water expected");
    output_.notes = axes_.notes;
    output_.field.where = file_.where(water_);
    lay_out(given);
    choose_time();
  }

  ModelOutput read(bool sizes_are_given) {
    WaterField& field = output_.field;
    field.water_g_per_m3 = quantity(water_, water_unit, s_.water_unit, "water", "g/kg, kg/kg, g/m3 or kg/m3");
    if (!sizes_are_given) {
      if (const Variable* radius = chosen(s_.radius, "radius", radius_names))
        field.radius_um = quantity(*radius, radius_unit, s_.radius_unit, "radius", "um or m");
      else if (const Variable* number = chosen(s_.number, "number", number_names))
        field.drops_per_cm3 = quantity(*number, number_unit, s_.number_unit, "number", "1/cm3, 1/m3 or 1/kg");
    }
    return std::move(output_);
  }

 private:
  const Variable* chosen(const std::string& name, const char* key, const Names& usual) const {
    if (!name.empty()) return &file_.get(name, key);
    for (const std::string& candidate : usual)
      for (const Variable& variable : file_.variables())
        if (variable.is_number && !variable.dimensions.empty() && lower(variable.name) == candidate && &variable != water_pointer_ && is_on_lattice(variable))
          return &variable;
    return nullptr;
  }
  const Variable& find_water() {
    if (const Variable* found = chosen(s_.water, "water", water_names)) {
      water_pointer_ = found;
      return *found;
    }
    throw bad_input(file_.path(), "no variable with a usual name of liquid water (" + list_of(water_names) + ")",
                    "one expected; the file has " + file_.all_variables(), "Say which with water = \"...\"");
  }

  void lay_out(const std::optional<GivenLattice>& given) {
    WaterField& field = output_.field;
    double step[2] = {0, 0};
    for (std::size_t a = 0; a < 2; ++a) {
      step[a] = even_step(axes_.space[a], "xy"[a]);
      if (step[a] == 0 && given) step[a] = given->step_m[a];
    }
    if (step[0] == 0) step[0] = step[1];  // a single row is as wide as its cells are long
    if (step[1] == 0) step[1] = step[0];
    if (step[0] == 0)
      throw bad_input(file_.where(water_), "a single column", "steps along x and y expected", "Give voxel_m and first_m");
    const double alone_m = given ? given->step_m[2] : step[0];
    field.level_m = bounds_between(axes_.space[2].position_m, alone_m);
    for (std::size_t a = 0; a < 3; ++a) {
      if (axes_.space[a].position_m.size() > 1'000'000)
        throw bad_input(file_.where(water_), std::to_string(axes_.space[a].position_m.size()) + " points along one dimension", "at most 1e6 expected");
      (a == 0 ? field.count.x : a == 1 ? field.count.y : field.count.z) = static_cast<int>(axes_.space[a].position_m.size());
    }
    if (const double total = 1.0 * field.count.x * field.count.y * field.count.z; total > 2e9)
      throw bad_input(file_.where(water_), number_text(total) + " cells", "at most 2e9 expected");
    field.first_x_m = axes_.space[0].position_m[0];
    field.first_y_m = axes_.space[1].position_m[0];
    field.step_x_m = step[0];
    field.step_y_m = step[1];
  }

  /// 0 for a single point.
  double even_step(const ModelAxis& axis, char name) const {
    const std::vector<double>& at = axis.position_m;
    if (at.size() < 2) return 0;
    const double step = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
    for (std::size_t i = 1; i < at.size(); ++i)
      if (std::fabs(at[i] - at[i - 1] - step) > 5e-3 * step)
        throw bad_input(file_.where(water_), "a step of " + number_text(at[i] - at[i - 1]) + " m along " + name + " after " + number_text(at[i - 1]) + " m",
                        "equal steps expected, here of " + number_text(step) + " m", "Resample it to even steps");
    return step;
  }

  void choose_time() {
    if (!axes_.time) return;
    const auto count = static_cast<long long>(file_.dimensions()[*axes_.time].length);
    if (s_.time_index < 0 && count > 1)
      throw bad_input(file_.where(water_), std::to_string(count) + " times", "one must be chosen",
                      "Say which with time_index, from 0 to " + std::to_string(count - 1));
    if (s_.time_index >= count)
      throw bad_input("time_index", std::to_string(s_.time_index),
                      "0 to " + std::to_string(count - 1) + " expected: " + file_.path() + " has " + std::to_string(count) + " times");
    time_ = static_cast<std::size_t>(std::max(s_.time_index, 0LL));
  }

  /// Whether all dimensions of a variable are dimensions of the water.
  bool is_on_lattice(const Variable& variable) const {
    if (!water_pointer_) return true;
    for (const std::size_t d : variable.dimensions)
      if (file_.dimensions()[d].length > 1 && std::find(water_.dimensions.begin(), water_.dimensions.end(), d) == water_.dimensions.end()) return false;
    return true;
  }

  /// The values at every cell, [x][y][z], in the file's unit.
  std::vector<float> on_lattice(const Variable& variable) const {
    if (!is_on_lattice(variable))
      throw bad_input(file_.where(variable), "other dimensions than those of '" + water_.name + "'", "a variable on the same points, or a profile of them, expected",
                      "Interpolate staggered variables first");
    std::vector<std::size_t> start, count;
    std::size_t stride[3] = {0, 0, 0}, run = 1;
    for (const std::size_t d : variable.dimensions) {
      const bool is_time = axes_.time && d == *axes_.time;
      start.push_back(is_time ? time_ : 0);
      count.push_back(is_time ? 1 : file_.dimensions()[d].length);
    }
    for (std::size_t i = variable.dimensions.size(); i-- > 0;) {
      for (std::size_t a = 0; a < 3; ++a)
        if (axes_.space[a].dimension == variable.dimensions[i]) stride[a] = run;
      run *= count[i];
    }
    const std::vector<float> raw = file_.read<float>(variable, start, count);
    const Coord n = output_.field.count;
    std::vector<float> values(static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z));
    std::size_t to = 0;
    const auto along = [&](std::size_t axis, int i, int last) {
      return stride[axis] * static_cast<std::size_t>(axes_.space[axis].is_reversed ? last - i : i);
    };
    for (int x = 0; x < n.x; ++x)
      for (int y = 0; y < n.y; ++y)
        for (int z = 0; z < n.z; ++z) values[to++] = raw[along(0, x, n.x - 1) + along(1, y, n.y - 1) + along(2, z, n.z - 1)];
    return values;
  }

  FieldUnit unit_of(const Variable& variable, Unit known, const std::string& given, const std::string& key, const std::string& expected) const {
    const std::string text = given.empty() ? file_.text(&variable, "units").value_or("") : given;
    if (text.empty())
      throw bad_input(file_.where(variable), "no attribute units", expected + " expected", "Give it with " + key + "_unit");
    if (const auto unit = known(text)) return *unit;
    throw bad_input(file_.where(variable), "units '" + text + "'", expected + " expected", "Give it with " + key + "_unit");
  }

  /// A variable in the unit of WaterField.
  std::vector<float> quantity(const Variable& variable, Unit known, const std::string& given, const std::string& key, const std::string& expected) {
    const FieldUnit unit = unit_of(variable, known, given, key, expected);
    std::vector<float> values = on_lattice(variable);
    for (float& value : values) value *= static_cast<float>(unit.factor);
    std::string note = key + " from '" + variable.name + "'";
    if (unit.is_per_kg) {
      const std::vector<float>& density = densities();
      for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] != 0) values[i] *= density[i];
      note += " times the density of the air, " + density_source_;
    }
    output_.notes.push_back(note);
    return values;
  }

  /// A value of the air at every cell, between two bounds that it surely keeps.
  std::vector<float> air(const Variable& variable, const std::string& what, double factor, double low, double high, const std::string& unit) const {
    std::vector<float> values = on_lattice(variable);
    for (float& value : values) {
      value *= static_cast<float>(factor);
      if (!(value >= low && value <= high))
        throw bad_input(file_.where(variable), std::isnan(value) ? "NaN" : number_text(value) + " " + unit,
                        what + " of " + number_text(low) + " to " + number_text(high) + " " + unit + " expected",
                        "Say which variable it is with " + what + ", or take the standard atmosphere with density = \"standard\"");
    }
    return values;
  }

  const std::vector<float>& densities() {
    if (!density_.empty()) return density_;
    const bool is_standard = s_.density == "standard";
    const Variable* density = is_standard ? nullptr : chosen(s_.density, "density", density_names);
    const Variable* pressure = is_standard ? nullptr : chosen(s_.pressure, "pressure", pressure_names);
    const Variable* temperature = is_standard ? nullptr : chosen(s_.temperature, "temperature", temperature_names);
    if (density && (!s_.density.empty() || s_.pressure.empty())) {
      const std::string unit = plain_unit(file_.text(density, "units").value_or("kg m-3"));
      if (unit != "kg m-3" && unit != "g m-3") throw bad_input(file_.where(*density), "units '" + unit + "'", "kg/m3 expected");
      density_ = air(*density, "density", unit == "g m-3" ? 1e-3 : 1, 0.01, 2, "kg/m3");
      density_source_ = "'" + density->name + "'";
    } else if (pressure && temperature) {
      const auto unit = pressure_unit(file_.text(pressure, "units").value_or("Pa"));
      if (!unit) throw bad_input(file_.where(*pressure), "units '" + *file_.text(pressure, "units") + "'", "Pa or hPa expected");
      density_ = air(*pressure, "pressure", unit->factor, 500, 110000, "Pa");
      const std::vector<float> kelvin = air(*temperature, "temperature", 1, 150, 350, "K");
      for (std::size_t i = 0; i < kelvin.size(); ++i) density_[i] = static_cast<float>(air_density_kg_per_m3(density_[i], kelvin[i]));
      density_source_ = "from '" + pressure->name + "' and '" + temperature->name + "'";
    } else {
      if (!s_.pressure.empty() || !s_.temperature.empty())
        throw bad_input(file_.path(), "only one of pressure and temperature", "both expected", "Give the other one's name");
      const WaterField& field = output_.field;
      const auto n = static_cast<std::size_t>(field.count.z);
      density_.resize(static_cast<std::size_t>(field.count.x) * static_cast<std::size_t>(field.count.y) * n);
      for (std::size_t i = 0; i < density_.size(); ++i)
        density_[i] = static_cast<float>(standard_air_density_kg_per_m3(0.5 * (field.level_m[i % n] + field.level_m[i % n + 1])));
      density_source_ = "that of the International Standard Atmosphere";
    }
    return density_;
  }

  NetcdfFile file_;
  const ModelSettings& s_;
  const Variable* water_pointer_ = nullptr;
  const Variable& water_;
  ModelAxes axes_;
  std::size_t time_ = 0;
  ModelOutput output_;
  std::vector<float> density_;
  std::string density_source_;
};

}  // namespace

void list_keys(Keys& keys, ModelSettings& model) {
  keys.text("water", model.water, "variable of liquid water; empty: the first of " + list_of(water_names) + ", whatever their capitals");
  keys.text("water_unit", model.water_unit, "g/kg, kg/kg, g/m3 or kg/m3, where the attribute units does not say so");
  keys.text("radius", model.radius, "variable of the effective radius; empty: by its usual names, if there is one");
  keys.text("radius_unit", model.radius_unit, "um or m, where the attribute units does not say so");
  keys.text("number", model.number, "variable of the number of droplets; empty: by its usual names, if there is one and no radius");
  keys.text("number_unit", model.number_unit, "1/cm3, 1/m3 or 1/kg, where the attribute units does not say so");
  keys.text("density", model.density,
            "of the air, for what is per kg: a variable, or standard: the International Standard Atmosphere; empty: by its usual names, else from pressure and temperature, else standard");
  keys.text("pressure", model.pressure, "variable of the air's pressure; empty: by its usual names");
  keys.text("temperature", model.temperature, "variable of the air's temperature in K; empty: by its usual names");
  keys.text("x", model.axes.x, "dimension or coordinate towards the east; empty: by attributes and usual names, as for y, z and time");
  keys.text("y", model.axes.y, "dimension or coordinate towards the north");
  keys.text("z", model.axes.z, "dimension or coordinate of height");
  keys.text("time", model.axes.time, "dimension or coordinate of time");
  keys.integer("time_index", model.time_index, between(-1, 1e9), "which time, from 0 on; -1: the only one");
}

ModelOutput read_model_output(const std::string& path, const ModelSettings& settings, const std::optional<GivenLattice>& given, bool sizes_are_given) {
  return Reader(path, settings, given).read(sizes_are_given);
}

}  // namespace arcus::media
