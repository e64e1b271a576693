#include "phase/base/curve.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "phase/base/error.h"

namespace arcus {
namespace {

bool is_separator(char c) { return c == ',' || c == ' ' || c == '\t' || c == ';' || c == '\r'; }

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && is_separator(line[i])) ++i;
    std::size_t j = i;
    while (j < line.size() && !is_separator(line[j])) ++j;
    if (j > i) words.push_back(line.substr(i, j - i));
    i = j;
  }
  return words;
}

bool to_number(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  return fault == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

}  // namespace

const std::vector<double>& Columns::named(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  assert(found != names.end());
  return columns[static_cast<std::size_t>(found - names.begin())];
}

Columns read_columns(std::string_view text, std::string_view where, int first_line) {
  Columns result;
  int line_number = first_line - 1;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line_number;
    line = line.substr(0, line.find('#'));
    const auto words = words_of(line);
    if (words.empty()) continue;
    const std::string place = std::string(where) + ":" + std::to_string(line_number);
    double value = 0;
    if (result.columns.empty() && result.names.empty() && !to_number(words[0], value)) {
      result.names.assign(words.begin(), words.end());
      continue;
    }
    if (result.columns.empty()) result.columns.resize(words.size());
    if (words.size() != result.columns.size())
      throw bad_input(place, std::to_string(words.size()) + " columns",
                      "as many as in the rows before, " + std::to_string(result.columns.size()) + ", expected");
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (!to_number(words[i], value))
        throw bad_input(place, "'" + std::string(words[i]) + "'", "a finite number expected");
      result.columns[i].push_back(value);
    }
  }
  if (result.columns.empty()) throw bad_input(where, "no row of numbers", "at least one expected");
  if (!result.names.empty() && result.names.size() != result.columns.size())
    throw bad_input(where, std::to_string(result.names.size()) + " column names",
                    std::to_string(result.columns.size()) + " expected, one a column");
  return result;
}

Columns read_columns_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
    throw bad_input(path, "no readable file", "a text file with columns of numbers expected");
  return read_columns(text.str(), path);
}

Curve::Curve(std::vector<double> x, std::vector<double> y, std::string_view where)
    : x_(std::move(x)), y_(std::move(y)) {
  assert(x_.size() == y_.size() && !x_.empty());
  for (std::size_t i = 1; i < x_.size(); ++i)
    if (!(x_[i] > x_[i - 1]))
      throw bad_input(where, std::to_string(x_[i]) + " after " + std::to_string(x_[i - 1]),
                      "ascending values in the first column expected");
}

namespace {

/// Index of the first of the ascending numbers that is above x, which lies between the ends. Most curves have nearly equal steps, so that a
/// guess is at most a few steps aside.
std::size_t first_above(const std::vector<double>& ascending, double x) {
  const double steps = static_cast<double>(ascending.size() - 1) / (ascending.back() - ascending.front());
  auto i = std::min(static_cast<std::size_t>((x - ascending.front()) * steps) + 1, ascending.size() - 1);
  for (int tries = 0; tries < 8; ++tries) {
    if (ascending[i] <= x)
      ++i;
    else if (ascending[i - 1] > x)
      --i;
    else
      return i;
  }
  return static_cast<std::size_t>(std::upper_bound(ascending.begin(), ascending.end(), x) - ascending.begin());
}

}  // namespace

double Curve::operator()(double x) const {
  if (!(x > x_.front())) return y_.front();
  if (x >= x_.back()) return y_.back();
  const std::size_t i = first_above(x_, x);
  const double t = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
  return y_[i - 1] + t * (y_[i] - y_[i - 1]);
}

double Curve::integral(double a, double b) const {
  if (b < a) return -integral(b, a);
  double sum = 0, from = a;
  double value = (*this)(a);
  for (std::size_t i = 0; i < x_.size() && x_[i] < b; ++i) {
    if (x_[i] <= a) continue;
    sum += 0.5 * (value + y_[i]) * (x_[i] - from);
    from = x_[i];
    value = y_[i];
  }
  return sum + 0.5 * (value + (*this)(b)) * (b - from);
}

}  // namespace arcus
