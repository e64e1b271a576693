#pragma once
// A NetCDF file of another program, classic or NetCDF-4, opened for reading: what it holds, and its variables as numbers.

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arcus {

/// The NetCDF library is not made for several threads at a time: whoever calls it holds this.
std::mutex& netcdf_library();

class NetcdfFile {
 public:
  struct Dimension {
    std::string name;
    std::size_t length = 0;
  };
  struct Variable {
    std::string name;
    std::vector<std::size_t> dimensions;  ///< places in dimensions(), the last running fastest
    bool is_number = true;                ///< else text or a compound
  };

  /// Throws bad_input where the file is missing, not NetCDF, cut short or damaged.
  explicit NetcdfFile(const std::string& path);
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;
  ~NetcdfFile();

  const std::string& path() const { return path_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  const std::vector<Variable>& variables() const { return variables_; }
  /// Null where there is none of that name.
  const Variable* find(std::string_view name) const;
  /// The variable, or bad_input with the nearest name and the list of all; `key` says who asked for it.
  const Variable& get(std::string_view name, std::string_view key) const;
  /// "FILE: variable 'name'", for messages.
  std::string where(const Variable& variable) const { return path_ + ": variable '" + variable.name + "'"; }
  /// "'a' (x, y), 'b' (z)"
  std::string all_variables() const;

  /// An attribute of a variable, or of the file where `variable` is null; nothing where it is absent or of another kind.
  std::optional<std::string> text(const Variable* variable, const std::string& attribute) const;
  std::optional<double> number(const Variable* variable, const std::string& attribute) const;

  /// The values from `start`, `count` of them along each dimension, in the order of the file; scale_factor and add_offset are
  /// applied, and fill values are NaN. Number: float or double. Throws bad_input where they cannot be read.
  template <class Number>
  std::vector<Number> read(const Variable& variable, std::span<const std::size_t> start,
                           std::span<const std::size_t> count) const;
  /// All of them.
  template <class Number>
  std::vector<Number> read(const Variable& variable) const;

 private:
  void check(int status, const std::string& what) const;
  void list_contents();
  int id_of(const Variable& variable) const;

  std::string path_;
  int id_ = -1;
  std::vector<Dimension> dimensions_;
  std::vector<Variable> variables_;
};

/// Bytes that a classic NetCDF file must have by its header, which begins with `bytes`: the library reads what is missing at the end
/// as zeros. 0 where the bytes are no such header, nothing where the header is longer than they are. The layout: NetCDF Classic and
/// 64-bit Offset File Formats, OGC 10-092r3.
std::optional<std::uint64_t> classic_netcdf_size(std::string_view bytes);

}  // namespace arcus
