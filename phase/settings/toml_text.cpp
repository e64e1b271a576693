#include "phase/settings/toml_text.h"

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus {
namespace {

std::string place_of(std::string_view where, const toml::source_region& region) {
  std::string text(where);
  if (region.begin.line > 0) {
    text += ":" + std::to_string(region.begin.line);
    text += ":" + std::to_string(region.begin.column);
  }
  return text;
}

std::string kind_of(const toml::node& node) {
  std::ostringstream text;
  text << node.type();
  if (const auto* word = node.as_string()) return "text '" + word->get() + "'";
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  return text.str();
}

/// Reads values from a tree of TOML tables and remembers which keys were asked for.
class Reader : public Keys {
 public:
  Reader(const toml::table& root, std::string where) : where_(std::move(where)) { levels_.push_back({&root, "", {}}); }

  void number(std::string_view name, double& value, const Range& range, std::string_view) override {
    if (const toml::node* node = find(name)) value = number_at(*node, name, range);
  }
  void integer(std::string_view name, long long& value, const Range& range, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    const auto* whole = node->as_integer();
    if (!whole) fail(*node, name, kind_of(*node), "must be a whole number");
    if (!range.contains(static_cast<double>(whole->get()))) fail(*node, name, kind_of(*node), range.words());
    value = whole->get();
  }
  void flag(std::string_view name, bool& value, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    if (!node->is_boolean()) fail(*node, name, kind_of(*node), "must be true or false");
    value = node->as_boolean()->get();
  }
  void text(std::string_view name, std::string& value, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    if (!node->is_string()) fail(*node, name, kind_of(*node), "must be a text in quotes");
    value = node->as_string()->get();
  }
  void choice(std::string_view name, std::string& value, const std::vector<std::string>& choices,
              std::string_view) override {
    if (const toml::node* node = find(name)) value = word_at(*node, name, choices);
  }
  void word_or_number(std::string_view name, std::string& value, const std::vector<std::string>& words,
                      const Range& range, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    if (node->is_string()) value = word_at(*node, name, words, " or a number that " + range.words());
    else value = number_text(number_at(*node, name, range));
  }
  void choices(std::string_view name, std::vector<std::string>& values, const std::vector<std::string>& choices,
               std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    values.clear();
    if (const auto* array = node->as_array()) {
      for (const toml::node& entry : *array) values.push_back(word_at(entry, name, choices));
    } else {
      values.push_back(word_at(*node, name, choices));
    }
  }
  void numbers(std::string_view name, std::vector<double>& values, const Range& range, std::size_t least,
               std::size_t most, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    values = numbers_at(*node, name, range);
    if (values.size() < least || values.size() > most)
      fail(*node, name, std::to_string(values.size()) + " numbers",
           least == most ? "must have " + std::to_string(least)
                         : "must have " + std::to_string(least) + " to " + std::to_string(most));
  }
  void nodes(std::string_view name, std::vector<double>& values, const Range& range, Spacing spacing,
             std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    if (const auto* table = node->as_table()) {
      values = spaced_nodes(*table, name, range, spacing);
      return;
    }
    values = numbers_at(*node, name, range);
    if (values.empty()) fail(*node, name, "an empty array", "must have at least one number");
    for (std::size_t i = 1; i < values.size(); ++i)
      if (!(values[i] > values[i - 1]))
        fail(*node, name, number_text(values[i]) + " after " + number_text(values[i - 1]), "must be ascending");
  }
  void vector3(std::string_view name, Vec3& value, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    if (!node->is_array()) fail(*node, name, kind_of(*node), "must be three numbers [x, y, z]");
    const auto values = numbers_at(*node, name, any());
    if (values.size() != 3) fail(*node, name, std::to_string(values.size()) + " numbers", "must be [x, y, z]");
    value = Vec3(values[0], values[1], values[2]);
  }

  void box(std::string_view name, Vec3& low, Vec3& high, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return;
    const char* expected = "must be two corners, [[x, y, z], [x, y, z]]";
    const auto* corners = node->as_array();
    if (!corners || corners->size() != 2 || !corners->is_homogeneous(toml::node_type::array)) fail(*node, name, kind_of(*node), expected);
    const auto a = numbers_at(*corners->get(0), name, any()), b = numbers_at(*corners->get(1), name, any());
    if (a.size() != 3 || b.size() != 3) fail(*node, name, std::to_string(a.size()) + " and " + std::to_string(b.size()) + " numbers", expected);
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      low[axis] = std::min(a[i], b[i]);
      high[axis] = std::max(a[i], b[i]);
    }
  }

  bool only_if(bool condition, std::string_view) override { return condition; }
  bool is_given(std::string_view name) const override { return levels_.back().table->contains(name); }
  [[noreturn]] void refuse(std::string_view name, std::string_view found, std::string_view expected) const override {
    const toml::node* node = levels_.back().table->get(name);
    const toml::source_region& region = node ? node->source() : levels_.back().table->source();
    throw bad_input(place_of(where_, region) + ": " + path_of(name), found, expected);
  }
  /// Throws at the first key of the innermost table that nobody asked for.
  void check_all_known() const {
    const Level& level = levels_.back();
    for (const auto& [key, node] : *level.table) {
      const std::string name(key.str());
      if (std::find(level.names.begin(), level.names.end(), name) != level.names.end()) continue;
      const std::string nearest = nearest_name(name, level.names);
      const auto& region = key.source().begin.line > 0 ? key.source() : node.source();
      throw bad_input(place_of(where_, region) + ": " + path_of(name), "an unknown key",
                      "one of " + list_of(level.names) + " expected",
                      nearest.empty() ? "" : "Did you mean '" + nearest + "'?");
    }
  }

 protected:
  bool begin_table(std::string_view name, std::string_view) override {
    const toml::node* node = find(name);
    static const toml::table nothing;
    if (node && !node->is_table()) fail(*node, name, kind_of(*node), "must be a table");
    levels_.push_back({node ? node->as_table() : &nothing, path_of(name) + ".", {}});
    return true;
  }
  bool begin_word_or_table(std::string_view name, std::string& word, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return false;
    if (const auto* text = node->as_string()) {
      word = text->get();
      return false;
    }
    if (!node->is_table()) fail(*node, name, kind_of(*node), "must be a text in quotes or a table");
    word.clear();
    levels_.push_back({node->as_table(), path_of(name) + ".", {}});
    return true;
  }
  std::size_t begin_tables(std::string_view name, std::size_t have, std::string_view) override {
    const toml::node* node = find(name);
    if (!node) return have;
    const auto* array = node->as_array();
    if (!array || (!array->empty() && !array->is_homogeneous(toml::node_type::table)))
      fail(*node, name, kind_of(*node), "must be written [[" + path_of(name) + "]]");
    return array->size();
  }
  void begin_entry(std::string_view name, std::size_t index) override {
    const auto& array = *levels_.back().table->get(name)->as_array();
    levels_.push_back({array[index].as_table(), path_of(name) + "[" + std::to_string(index) + "].", {}});
  }
  void end_table() override {
    check_all_known();
    levels_.pop_back();
  }

 private:
  struct Level {
    const toml::table* table;
    std::string path;
    std::vector<std::string> names;
  };

  std::string path_of(std::string_view name) const { return levels_.back().path + std::string(name); }
  const toml::node* find(std::string_view name) {
    levels_.back().names.emplace_back(name);
    return levels_.back().table->get(name);
  }
  [[noreturn]] void fail(const toml::node& node, std::string_view name, std::string_view found,
                         std::string_view expected) const {
    throw bad_input(place_of(where_, node.source()) + ": " + path_of(name), found, expected);
  }
  double number_at(const toml::node& node, std::string_view name, const Range& range) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail(node, name, kind_of(node), "must be a number");
    if (!range.contains(*value)) fail(node, name, kind_of(node), range.words());
    return *value;
  }
  std::vector<double> numbers_at(const toml::node& node, std::string_view name, const Range& range) const {
    std::vector<double> values;
    if (const auto* array = node.as_array()) {
      for (const toml::node& entry : *array) values.push_back(number_at(entry, name, range));
    } else {
      values.push_back(number_at(node, name, range));
    }
    return values;
  }
  std::string word_at(const toml::node& node, std::string_view name, const std::vector<std::string>& choices,
                      std::string_view alternative = "") const {
    const auto* word = node.as_string();
    if (word && std::find(choices.begin(), choices.end(), word->get()) != choices.end()) return word->get();
    std::string expected = "must be " + list_of(choices) + std::string(alternative);
    const std::string nearest = word ? nearest_name(word->get(), choices) : "";
    if (!nearest.empty()) expected += ". Did you mean '" + nearest + "'?";
    fail(node, name, kind_of(node), expected);
  }
  std::vector<double> spaced_nodes(const toml::table& table, std::string_view name, const Range& range,
                                   Spacing spacing) {
    levels_.push_back({&table, path_of(name) + ".", {}});
    double low = std::nan(""), high = std::nan("");
    long long count = 0;
    number("min", low, range, "");
    number("max", high, range, "");
    integer("nodes", count, between(1, 100000), "");
    for (const char* key : {"min", "max", "nodes"})
      if (!is_given(key)) refuse(key, "nothing", "min, max and nodes expected");
    if (!(high > low) && !(high == low && count == 1)) refuse("max", number_text(high), "must be above min");
    if (count == 1 && high > low) refuse("nodes", "1", "must be at least 2 between two different ends");
    end_table();
    std::vector<double> values;
    for (long long i = 0; i < count; ++i) {
      const double t = count == 1 ? 0 : static_cast<double>(i) / static_cast<double>(count - 1);
      values.push_back(spacing == Spacing::linear ? low + t * (high - low) : low * std::pow(high / low, t));
    }
    values.back() = high;
    return values;
  }

  std::string where_;
  std::vector<Level> levels_;
};

toml::table parsed(std::string_view text, std::string_view where) {
  try {
    return toml::parse(text, where);
  } catch (const toml::parse_error& error) {
    throw Error(Fault::input, place_of(where, error.source()) + ": " + std::string(error.description()));
  }
}

/// Sets one "table.key=VALUE" in the tree. VALUE is read as TOML, or as a plain word where it is none.
void apply_override(toml::table& root, const std::string& assignment) {
  const std::string where = "--set " + assignment;
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw bad_input(where, "no assignment", "table.key=VALUE expected");
  const std::string value_text = assignment.substr(equals + 1);
  toml::table holder;
  try {
    holder = toml::parse("value = " + value_text, where);
  } catch (const toml::parse_error&) {
    holder.insert_or_assign("value", value_text);
  }
  std::vector<std::string> steps;
  std::istringstream path(assignment.substr(0, equals));
  for (std::string step; std::getline(path, step, '.');) steps.push_back(step);
  toml::node* node = &root;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool is_last = i + 1 == steps.size();
    if (auto* array = node->as_array()) {
      std::size_t index = 0;
      const auto [end, fault] = std::from_chars(steps[i].data(), steps[i].data() + steps[i].size(), index);
      if (fault != std::errc() || *end != '\0' || index >= array->size())
        throw bad_input(where, "'" + steps[i] + "'",
                        "the number of an entry, 0 to " + std::to_string(array->size()) + " (excluded), expected");
      if (is_last) array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), *holder.get("value"));
      else node = array->get(index);
    } else if (auto* table = node->as_table()) {
      if (is_last) {
        table->insert_or_assign(steps[i], *holder.get("value"));
      } else {
        if (!table->contains(steps[i])) table->insert(steps[i], toml::table{});
        node = table->get(steps[i]);
      }
    } else {
      throw bad_input(where, "'" + steps[i] + "' below a value that is no table", "table.key=VALUE expected");
    }
  }
}

}  // namespace

void read_toml(std::string_view text, std::string_view where, std::span<const std::string> overrides,
               const KeyList& list) {
  toml::table root = parsed(text, where);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  Reader reader(root, std::string(where));
  list(reader);
  reader.check_all_known();
}

void read_toml_file(const std::string& path, std::span<const std::string> overrides, const KeyList& list) {
  read_toml(read_text_file(path), path, overrides, list);
}

std::string read_text_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || std::filesystem::is_directory(path) || !(text << file.rdbuf()))
    throw bad_input(path, "no readable file", "a text file expected", "Check the name and the folder");
  return text.str();
}

std::string path_from(const std::string& folder, const std::string& path) {
  const std::filesystem::path given(path);
  return given.is_absolute() || folder.empty() ? path : (std::filesystem::path(folder) / given).string();
}

}  // namespace arcus
