#include "phase/settings/reference.h"

#include <cmath>

#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus {
namespace {

/// What both forms share: no values are read, every key is visited.
class Documenter : public Keys {
 public:
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
  /// The note of an only_if just before, once.
  std::string taken_note() {
    std::string note;
    note.swap(note_);
    return note;
  }

 private:
  std::string note_;
};

std::string word_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "`" : ", `") + word + "`";
  return text;
}

std::string number_list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return "[" + text + "]";
}

class Page : public Documenter {
 public:
  explicit Page(std::string_view title) : title_(title) {}
  std::string text() const {
    std::string text = "# " + title_ + "\n";
    for (const Section& section : sections_) {
      if (!section.heading.empty()) text += "\n## " + section.heading + "\n\n" + section.meaning + "\n";
      if (!section.rows.empty()) text += "\n| key | default | allowed | meaning |\n| --- | --- | --- | --- |\n" + section.rows;
    }
    return text;
  }

  void number(std::string_view name, double& value, const Range& range, std::string_view meaning) override {
    row(name, number_text(value), range.words(), meaning);
  }
  void integer(std::string_view name, long long& value, const Range& range, std::string_view meaning) override {
    row(name, std::to_string(value), "whole number, " + range.words(), meaning);
  }
  void flag(std::string_view name, bool& value, std::string_view meaning) override {
    row(name, value ? "true" : "false", "`true`, `false`", meaning);
  }
  void text(std::string_view name, std::string& value, std::string_view meaning) override {
    row(name, "\"" + value + "\"", "text", meaning);
  }
  void word_or_number(std::string_view name, std::string& value, const std::vector<std::string>& words,
                      const Range& range, std::string_view meaning) override {
    row(name, value, word_list(words) + " or a number, " + range.words(), meaning);
  }
  void choice(std::string_view name, std::string& value, const std::vector<std::string>& choices,
              std::string_view meaning) override {
    row(name, "\"" + value + "\"", word_list(choices), meaning);
  }
  void choices(std::string_view name, std::vector<std::string>& values, const std::vector<std::string>& choices,
               std::string_view meaning) override {
    row(name, word_list(values), "any of " + word_list(choices), meaning);
  }
  void numbers(std::string_view name, std::vector<double>& values, const Range& range, std::size_t least,
               std::size_t most, std::string_view meaning) override {
    const std::string count = least == most ? std::to_string(least)
                                            : std::to_string(least) + " to " + std::to_string(most);
    row(name, number_list(values), count + " numbers, each " + range.words(), meaning);
  }
  void nodes(std::string_view name, std::vector<double>& values, const Range& range, Spacing spacing,
             std::string_view meaning) override {
    const std::string shown = values.size() > 6
                                  ? std::to_string(values.size()) + " from " + number_text(values.front()) + " to " +
                                        number_text(values.back())
                                  : number_list(values);
    row(name, shown,
        std::string("number, array, or `{ min, max, nodes }` spaced ") +
            (spacing == Spacing::linear ? "evenly" : "logarithmically") + "; each " + range.words(),
        meaning);
  }
  void vector3(std::string_view name, Vec3& value, std::string_view meaning) override {
    row(name, number_list({value.x, value.y, value.z}), "[x, y, z]", meaning);
  }
  void box(std::string_view name, Vec3& low, Vec3& high, std::string_view meaning) override {
    row(name, "[" + number_list({low.x, low.y, low.z}) + ", " + number_list({high.x, high.y, high.z}) + "]", "[[x, y, z], [x, y, z]]", meaning);
  }

 protected:
  bool begin_table(std::string_view name, std::string_view meaning) override {
    open("`[" + path_ + std::string(name) + "]`", name, meaning);
    return true;
  }
  bool begin_word_or_table(std::string_view name, std::string& word, std::string_view meaning) override {
    open("`" + path_ + std::string(name) + "`, " + (word.empty() ? "a text" : "`\"" + word + "\"`") + " or a table", name, meaning);
    return true;
  }
  std::size_t begin_tables(std::string_view name, std::size_t, std::string_view meaning) override {
    open("`[[" + path_ + std::string(name) + "]]`, any number of them", name, meaning);
    return 0;
  }
  void begin_entry(std::string_view, std::size_t) override {}
  void end_table() override {
    path_ = open_.back().path;
    open_.pop_back();
  }

 private:
  struct Section {
    std::string heading, meaning, rows;
  };
  /// A table that is being listed; rows that follow those inside it belong to the one around it again.
  struct Open {
    std::string path;  ///< of the table around it
    std::size_t section;
  };

  void open(const std::string& heading, std::string_view name, std::string_view meaning) {
    const std::string note = taken_note();
    open_.push_back({path_, sections_.size()});
    sections_.push_back({heading, std::string(meaning) + (note.empty() ? "" : " (" + note + ")"), ""});
    path_ += std::string(name) + ".";
  }
  void row(std::string_view name, const std::string& value, const std::string& allowed, std::string_view meaning) {
    const std::string note = taken_note();
    if (sections_.empty()) sections_.emplace_back();
    sections_[open_.empty() ? 0 : open_.back().section].rows +=
        "| `" + path_ + std::string(name) + "` | " + value + " | " + allowed + " | " + std::string(meaning) +
        (note.empty() ? "" : " (" + note + ")") + " |\n";
  }

  std::string title_, path_;
  std::vector<Section> sections_;
  std::vector<Open> open_;
};

std::string json_text(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

class Schema : public Documenter {
 public:
  explicit Schema(std::string_view title) {
    text_ = "{\"$schema\": \"http://json-schema.org/draft-07/schema#\", \"title\": " + json_text(title) +
            ", \"type\": \"object\", \"additionalProperties\": false, \"properties\": {";
  }
  std::string text() const { return text_ + "}}\n"; }

  void number(std::string_view name, double&, const Range& range, std::string_view meaning) override {
    property(name, meaning, "\"type\": \"number\"" + limits(range));
  }
  void integer(std::string_view name, long long&, const Range& range, std::string_view meaning) override {
    property(name, meaning, "\"type\": \"integer\"" + limits(range));
  }
  void flag(std::string_view name, bool&, std::string_view meaning) override {
    property(name, meaning, "\"type\": \"boolean\"");
  }
  void text(std::string_view name, std::string&, std::string_view meaning) override {
    property(name, meaning, "\"type\": \"string\"");
  }
  void word_or_number(std::string_view name, std::string&, const std::vector<std::string>& words, const Range& range,
                      std::string_view meaning) override {
    property(name, meaning, "\"oneOf\": [{" + one_of(words) + "}, {\"type\": \"number\"" + limits(range) + "}]");
  }
  void choice(std::string_view name, std::string&, const std::vector<std::string>& choices,
              std::string_view meaning) override {
    property(name, meaning, one_of(choices));
  }
  void choices(std::string_view name, std::vector<std::string>&, const std::vector<std::string>& choices,
               std::string_view meaning) override {
    property(name, meaning, "\"type\": [\"array\", \"string\"], \"items\": {" + one_of(choices) + "}");
  }
  void numbers(std::string_view name, std::vector<double>&, const Range& range, std::size_t least, std::size_t most,
               std::string_view meaning) override {
    property(name, meaning,
             "\"type\": [\"array\", \"number\"], \"minItems\": " + std::to_string(least) +
                 ", \"maxItems\": " + std::to_string(most) + ", \"items\": {\"type\": \"number\"" + limits(range) + "}");
  }
  void nodes(std::string_view name, std::vector<double>&, const Range& range, Spacing,
             std::string_view meaning) override {
    const std::string one = "{\"type\": \"number\"" + limits(range) + "}";
    property(name, meaning,
             "\"oneOf\": [" + one + ", {\"type\": \"array\", \"items\": " + one +
                 "}, {\"type\": \"object\", \"required\": [\"min\", \"max\", \"nodes\"], \"additionalProperties\": "
                 "false, \"properties\": {\"min\": " + one + ", \"max\": " + one +
                 ", \"nodes\": {\"type\": \"integer\", \"minimum\": 1}}}]");
  }
  void vector3(std::string_view name, Vec3&, std::string_view meaning) override {
    property(name, meaning,
             "\"type\": \"array\", \"minItems\": 3, \"maxItems\": 3, \"items\": {\"type\": \"number\"}");
  }
  void box(std::string_view name, Vec3&, Vec3&, std::string_view meaning) override {
    property(name, meaning,
             "\"type\": \"array\", \"minItems\": 2, \"maxItems\": 2, \"items\": {\"type\": \"array\", \"minItems\": 3, "
             "\"maxItems\": 3, \"items\": {\"type\": \"number\"}}");
  }

 protected:
  bool begin_table(std::string_view name, std::string_view meaning) override {
    open(name, meaning, "\"type\": \"object\", \"additionalProperties\": false, \"properties\": {", "}");
    return true;
  }
  bool begin_word_or_table(std::string_view name, std::string&, std::string_view meaning) override {
    open(name, meaning,
         "\"oneOf\": [{\"type\": \"string\"}, {\"type\": \"object\", \"additionalProperties\": false, "
         "\"properties\": {", "}}]");
    return true;
  }
  std::size_t begin_tables(std::string_view name, std::size_t, std::string_view meaning) override {
    open(name, meaning,
         "\"type\": \"array\", \"items\": {\"type\": \"object\", \"additionalProperties\": false, \"properties\": {",
         "}}");
    return 0;
  }
  void begin_entry(std::string_view, std::size_t) override {}
  void end_table() override {
    text_ += ends_.back() + "}";
    ends_.pop_back();
    is_first_ = false;
  }

 private:
  static std::string limits(const Range& range) {
    std::string text;
    if (std::isfinite(range.low))
      text += std::string(range.low_excluded ? ", \"exclusiveMinimum\": " : ", \"minimum\": ") + number_text(range.low);
    if (std::isfinite(range.high))
      text += std::string(range.high_excluded ? ", \"exclusiveMaximum\": " : ", \"maximum\": ") + number_text(range.high);
    return text;
  }
  static std::string one_of(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + json_text(word);
    return "\"enum\": [" + text + "]";
  }
  void name_and_meaning(std::string_view name, std::string_view meaning) {
    const std::string note = taken_note();
    if (!is_first_) text_ += ", ";
    is_first_ = false;
    text_ += "\n" + json_text(name) + ": {\"description\": " +
             json_text(std::string(meaning) + (note.empty() ? "" : " (" + note + ")")) + ", ";
  }
  void property(std::string_view name, std::string_view meaning, const std::string& what) {
    name_and_meaning(name, meaning);
    text_ += what + "}";
  }
  void open(std::string_view name, std::string_view meaning, const std::string& beginning, const std::string& end) {
    name_and_meaning(name, meaning);
    text_ += beginning;
    ends_.push_back(end);
    is_first_ = true;
  }

  std::string text_;
  std::vector<std::string> ends_;
  bool is_first_ = true;
};

}  // namespace

std::string reference_page(std::string_view title, const KeyList& list) {
  Page page(title);
  list(page);
  return page.text();
}

std::string json_schema(std::string_view title, const KeyList& list) {
  Schema schema(title);
  list(schema);
  return schema.text();
}

}  // namespace arcus
