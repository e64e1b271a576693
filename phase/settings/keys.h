#pragma once
// The list of a settings struct's keys: name with unit, range, meaning. A struct S is described once, by a function
//     void list_keys(Keys&, S&);
// beside it, and that one list reads files, takes `--set`, writes the complete settings back, and prints the
// reference page and the schema for editors. So they cannot disagree, and a new key is one line.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "phase/base/vec3.h"

namespace arcus {

/// Which numbers a key takes.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false, high_excluded = false;
  bool contains(double x) const;  ///< false for NaN and infinities
  std::string words() const;      ///< "must be above 0", "must be between 0 and 1", ...
};
inline Range any() { return {}; }
inline Range at_least(double low) { return {.low = low}; }
inline Range above(double low) { return {.low = low, .low_excluded = true}; }
inline Range between(double low, double high) { return {.low = low, .high = high}; }
/// low excluded, high included
inline Range above_up_to(double low, double high) { return {.low = low, .high = high, .low_excluded = true}; }
/// low included, high excluded
inline Range from_below(double low, double high) { return {.low = low, .high = high, .high_excluded = true}; }

/// How { min, max, nodes } is spaced.
enum class Spacing { linear, logarithmic };

class Keys {
 public:
  virtual ~Keys() = default;

  // Each takes the key's name, the variable that holds the default and receives the value, what is allowed, and one
  // sentence for the reference page. A key that is not in the file leaves its variable alone.
  virtual void number(std::string_view name, double& value, const Range& range, std::string_view meaning) = 0;
  virtual void integer(std::string_view name, long long& value, const Range& range, std::string_view meaning) = 0;
  virtual void flag(std::string_view name, bool& value, std::string_view meaning) = 0;
  virtual void text(std::string_view name, std::string& value, std::string_view meaning) = 0;
  virtual void choice(std::string_view name, std::string& value, const std::vector<std::string>& choices,
                      std::string_view meaning) = 0;
  /// One of the given words, or a number within the range, kept as its text.
  virtual void word_or_number(std::string_view name, std::string& value, const std::vector<std::string>& words,
                              const Range& range, std::string_view meaning) = 0;
  /// Any number of the given words.
  virtual void choices(std::string_view name, std::vector<std::string>& values,
                       const std::vector<std::string>& choices, std::string_view meaning) = 0;
  /// An array of `least` to `most` numbers; a single number counts as an array of one.
  virtual void numbers(std::string_view name, std::vector<double>& values, const Range& range, std::size_t least,
                       std::size_t most, std::string_view meaning) = 0;
  /// Ascending positions on an axis: a number, an array, or { min, max, nodes }.
  virtual void nodes(std::string_view name, std::vector<double>& values, const Range& range, Spacing spacing,
                     std::string_view meaning) = 0;
  virtual void vector3(std::string_view name, Vec3& value, std::string_view meaning) = 0;
  /// Two opposite corners of a box along the axes, [[x, y, z], [x, y, z]]; the file may give them in any order.
  virtual void box(std::string_view name, Vec3& low, Vec3& high, std::string_view meaning) = 0;

  /// A table with settings of its own.
  template <class S>
  void table(std::string_view name, S& settings, std::string_view meaning) {
    if (begin_table(name, meaning)) {
      list_keys(*this, settings);
      end_table();
    }
  }
  /// A word (a name or a file) or a table: where the file has a word, `word` gets it; where it has a table, `word`
  /// becomes empty and the table is read.
  template <class S>
  void word_or_table(std::string_view name, std::string& word, S& settings, std::string_view meaning) {
    if (begin_word_or_table(name, word, meaning)) {
      list_keys(*this, settings);
      end_table();
    }
  }
  /// An array of tables; the file's entries are added to `list`.
  template <class S>
  void tables(std::string_view name, std::vector<S>& list, std::string_view meaning) {
    const std::size_t count = begin_tables(name, list.size(), meaning);
    list.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      begin_entry(name, i);
      list_keys(*this, list[i]);
      end_table();
    }
    if (documents()) {  // one example, whatever the list holds
      S example{};
      begin_entry(name, 0);
      list_keys(*this, example);
      end_table();
    }
    end_tables();
  }

  /// Guards keys that mean something only in some cases: `if (keys.only_if(type == "gamma", "type = gamma")) ...`.
  /// The condition when reading and writing; true, with the note, when documenting.
  virtual bool only_if(bool condition, std::string_view note) = 0;
  /// True where the file has that key (in the current table).
  virtual bool is_given(std::string_view name) const = 0;
  /// Throws bad_input at the place of that key: for checks that involve several keys.
  [[noreturn]] virtual void refuse(std::string_view name, std::string_view found, std::string_view expected) const = 0;
  /// True where the list is printed for people or editors and no values are read.
  virtual bool documents() const { return false; }

 protected:
  virtual bool begin_table(std::string_view name, std::string_view meaning) = 0;
  virtual bool begin_word_or_table(std::string_view name, std::string& word, std::string_view meaning) = 0;
  virtual std::size_t begin_tables(std::string_view name, std::size_t have, std::string_view meaning) = 0;
  virtual void begin_entry(std::string_view name, std::size_t index) = 0;
  virtual void end_table() = 0;
  virtual void end_tables() {}
};

}  // namespace arcus
