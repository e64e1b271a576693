#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus {
namespace {

/// Writes every key with its value.
class Writer : public Keys {
 public:
  std::string text() const { return text_; }

  void number(std::string_view name, double& value, const Range&, std::string_view) override {
    line(name, number_text(value));
  }
  void integer(std::string_view name, long long& value, const Range&, std::string_view) override {
    line(name, std::to_string(value));
  }
  void flag(std::string_view name, bool& value, std::string_view) override { line(name, value ? "true" : "false"); }
  void text(std::string_view name, std::string& value, std::string_view) override { line(name, quoted(value)); }
  void choice(std::string_view name, std::string& value, const std::vector<std::string>&, std::string_view) override {
    line(name, quoted(value));
  }
  void word_or_number(std::string_view name, std::string& value, const std::vector<std::string>& words, const Range&,
                      std::string_view) override {
    line(name, std::find(words.begin(), words.end(), value) != words.end() ? quoted(value) : value);
  }
  void choices(std::string_view name, std::vector<std::string>& values, const std::vector<std::string>&,
               std::string_view) override {
    std::string list;
    for (const auto& value : values) list += (list.empty() ? "" : ", ") + quoted(value);
    line(name, "[" + list + "]");
  }
  void numbers(std::string_view name, std::vector<double>& values, const Range&, std::size_t, std::size_t,
               std::string_view) override {
    std::string list;
    for (const double value : values) list += (list.empty() ? "" : ", ") + number_text(value);
    line(name, "[" + list + "]");
  }
  void nodes(std::string_view name, std::vector<double>& values, const Range& range, Spacing,
             std::string_view meaning) override {
    numbers(name, values, range, 0, 0, meaning);
  }
  void vector3(std::string_view name, Vec3& value, std::string_view) override {
    line(name, "[" + number_text(value.x) + ", " + number_text(value.y) + ", " + number_text(value.z) + "]");
  }
  void box(std::string_view name, Vec3& low, Vec3& high, std::string_view) override {
    const auto corner = [](const Vec3& v) { return "[" + number_text(v.x) + ", " + number_text(v.y) + ", " + number_text(v.z) + "]"; };
    line(name, "[" + corner(low) + ", " + corner(high) + "]");
  }
  bool only_if(bool condition, std::string_view) override { return condition; }
  bool is_given(std::string_view) const override { return false; }
  [[noreturn]] void refuse(std::string_view name, std::string_view found, std::string_view expected) const override {
    throw bad_input(name, found, expected);
  }

 protected:
  // Nested tables are written inline, so that the text needs no state but the open brackets.
  bool begin_table(std::string_view name, std::string_view) override {
    open(std::string(name) + " = {", "}");
    return true;
  }
  bool begin_word_or_table(std::string_view name, std::string& word, std::string_view meaning) override {
    if (!word.empty()) {
      text(name, word, meaning);
      return false;
    }
    return begin_table(name, meaning);
  }
  std::size_t begin_tables(std::string_view name, std::size_t have, std::string_view) override {
    open(std::string(name) + " = [", "]");
    return have;
  }
  void begin_entry(std::string_view, std::size_t) override { open("{", "}"); }
  void end_table() override { close(); }
  void end_tables() override { close(); }

 private:
  static std::string quoted(const std::string& value) {
    std::string text = "\"";
    for (const char c : value) {
      if (c == '"' || c == '\\') text += '\\';
      if (c == '\n') text += "\\n";
      else text += c;
    }
    return text + "\"";
  }
  void separate() {
    if (ends_.empty()) return;
    if (!first_.back()) text_ += ", ";
    first_.back() = false;
  }
  void line(std::string_view name, const std::string& value) {
    separate();
    text_ += std::string(name) + " = " + value;
    if (ends_.empty()) text_ += "\n";
  }
  void open(const std::string& beginning, const char* end) {
    separate();
    text_ += beginning;
    ends_.emplace_back(end);
    first_.push_back(true);
  }
  void close() {
    text_ += ends_.back();
    ends_.pop_back();
    first_.pop_back();
    if (ends_.empty()) text_ += "\n";
  }

  std::string text_;
  std::vector<std::string> ends_;
  std::vector<bool> first_;
};

}  // namespace

std::string write_toml(const KeyList& list) {
  Writer writer;
  list(writer);
  return writer.text();
}

}  // namespace arcus
