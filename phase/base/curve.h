#pragma once
// A function of one variable given by a table, and the reader of such tables.

#include <string>
#include <string_view>
#include <vector>

namespace arcus {

/// Numbers in columns. Lines that begin with # and one line of column names are skipped; blanks or commas separate.
struct Columns {
  std::vector<std::string> names;            ///< empty where the text has no line of names
  std::vector<std::vector<double>> columns;  ///< [column][row]
  /// The column of that name; an assertion fails where there is none.
  const std::vector<double>& named(std::string_view name) const;
};

/// Reads columns of numbers. `where` names the text in messages, `first_line` is its first line's number in them. Throws
/// bad_input with the line where a row has another number of columns than the first or a word is not a finite number, or where
/// there are no rows.
Columns read_columns(std::string_view text, std::string_view where, int first_line = 1);

/// The same from a file; throws bad_input where it cannot be read.
Columns read_columns_file(const std::string& path);

/// Piecewise-linear function; constant beyond both ends.
class Curve {
 public:
  Curve() = default;
  /// x strictly ascending, as many y as x, at least one; `where` names the table in messages.
  Curve(std::vector<double> x, std::vector<double> y, std::string_view where);
  double operator()(double x) const;
  double first() const { return x_.front(); }
  double last() const { return x_.back(); }
  /// Integral of the piecewise-linear function over [a, b].
  double integral(double a, double b) const;
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }

 private:
  std::vector<double> x_, y_;
};

}  // namespace arcus
