#include "tools/key_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::tools {
namespace {

/// Visits a list of keys and adds an option for each.
class Adder : public Keys {
 public:
  using Values = std::map<std::string, std::vector<std::string>>;
  Adder(CLI::App& app, Values& values) : app_(app), values_(values) {}

  void number(std::string_view name, double& value, const Range& range, std::string_view meaning) override {
    add(name, meaning, range.words(), number_text(value), 1);
  }
  void integer(std::string_view name, long long& value, const Range& range, std::string_view meaning) override {
    add(name, meaning, range.words(), std::to_string(value), 1);
  }
  void flag(std::string_view name, bool& value, std::string_view meaning) override {
    add(name, meaning, "true or false", value ? "true" : "false", 1);
  }
  void text(std::string_view name, std::string& value, std::string_view meaning) override {
    add(name, meaning, "", value, 1);
  }
  void choice(std::string_view name, std::string& value, const std::vector<std::string>& choices,
              std::string_view meaning) override {
    add(name, meaning, list_of(choices), value, 1);
  }
  void word_or_number(std::string_view name, std::string& value, const std::vector<std::string>& words,
                      const Range& range, std::string_view meaning) override {
    add(name, meaning, list_of(words) + ", or a number that " + range.words(), value, 1);
  }
  void choices(std::string_view name, std::vector<std::string>&, const std::vector<std::string>& choices,
               std::string_view meaning) override {
    add(name, meaning, list_of(choices), "", -1);
  }
  void numbers(std::string_view name, std::vector<double>& values, const Range& range, std::size_t, std::size_t,
               std::string_view meaning) override {
    add(name, meaning, "each " + range.words(), joined(values), -1);
  }
  void nodes(std::string_view name, std::vector<double>& values, const Range& range, Spacing,
             std::string_view meaning) override {
    add(name, meaning, "each " + range.words() + "; or '{ min = , max = , nodes = }'", joined(values), -1);
  }
  void vector3(std::string_view name, Vec3& value, std::string_view meaning) override {
    add(name, meaning, "X,Y,Z", joined({value.x, value.y, value.z}), -1);
  }
  void box(std::string_view name, Vec3&, Vec3&, std::string_view meaning) override { add(name, meaning, "'[[X, Y, Z], [X, Y, Z]]'", "", 1); }
  bool only_if(bool, std::string_view note) override {
    note_ = note;
    return true;
  }
  bool is_given(std::string_view) const override { return true; }
  [[noreturn]] void refuse(std::string_view name, std::string_view found, std::string_view expected) const override {
    throw bad_input(name, found, expected);
  }
  bool documents() const override { return true; }

 protected:
  bool begin_table(std::string_view name, std::string_view) override {
    paths_.push_back(path_);
    path_ += std::string(name) + ".";
    return true;
  }
  bool begin_word_or_table(std::string_view name, std::string& word, std::string_view meaning) override {
    text(name, word, meaning);
    return begin_table(name, meaning);
  }
  std::size_t begin_tables(std::string_view, std::size_t, std::string_view) override { return 0; }
  void begin_entry(std::string_view name, std::size_t) override { begin_table(name, ""); }
  void end_table() override {
    path_ = paths_.back();
    paths_.pop_back();
  }

 private:
  static std::string joined(const std::vector<double>& values) {
    if (values.size() > 8) return std::to_string(values.size()) + " values";
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ",") + number_text(value);
    return text;
  }
  void add(std::string_view name, std::string_view meaning, const std::string& allowed, const std::string& value,
           int count) {
    const std::string key = path_ + std::string(name);
    std::string option = "--" + key;
    std::replace_if(option.begin() + 2, option.end(), [](char c) { return c == '_' || c == '.'; }, '-');
    std::string help(meaning);
    if (!allowed.empty()) help += "; " + allowed;
    if (!note_.empty()) help += " (" + note_ + ")";
    if (!value.empty()) help += " [" + value + "]";
    note_.clear();
    if (app_.get_option_no_throw(option)) return;  // a key that several cases share
    CLI::Option* added = app_.add_option(option, values_[key], help)->type_name("");
    if (count == 1) added->expected(1);
    else added->expected(1, -1)->delimiter(',');
  }

  CLI::App& app_;
  Values& values_;
  std::string path_, note_;
  std::vector<std::string> paths_;
};

/// An entry of a TOML array: words, which nobody quotes twice on a command line, become strings.
std::string list_entry(const std::string& word) {
  const bool is_word = !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) && word != "nan" && word != "inf";
  return is_word ? '"' + word + '"' : word;
}

}  // namespace

KeyOptions::KeyOptions(CLI::App& app, const KeyList& list)
    : values_(std::make_shared<std::map<std::string, std::vector<std::string>>>()) {
  Adder adder(app, *values_);
  list(adder);
}

std::vector<std::string> KeyOptions::assignments() const {
  std::vector<std::string> result;
  for (const auto& [key, words] : *values_) {
    if (words.empty()) continue;
    const bool is_list = words.size() > 1 && !words[0].starts_with('[') && !words[0].starts_with('{');
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ",") + (is_list ? list_entry(word) : word);
    result.push_back(key + "=" + (is_list ? "[" + text + "]" : text));
  }
  return result;
}

void KeyOptions::read(const KeyList& list) const { read_toml("", "command line", assignments(), list); }

}  // namespace arcus::tools
