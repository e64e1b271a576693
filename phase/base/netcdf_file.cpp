#include "phase/base/netcdf_file.h"

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <type_traits>

#include "phase/base/error.h"

namespace arcus {
namespace {

constexpr std::size_t longest_text = 1 << 20;
constexpr std::size_t most_values = std::size_t{1} << 32;

/// Throws unless a classic file is as long as its header says.
void check_length(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code error;
  const std::uint64_t found = std::filesystem::file_size(path, error);
  std::string head;
  for (std::size_t length = 1 << 16;; length *= 16) {
    head.resize(std::min<std::uint64_t>(length, found));
    file.clear();
    file.seekg(0);
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    const auto expected = classic_netcdf_size(head);
    if (!expected && head.size() < found) continue;
    if (!expected || found < *expected)
      throw bad_input(path, std::to_string(found) + " bytes",
                      expected ? std::to_string(*expected) + " expected by its header" : "a longer header expected",
                      "It may have been cut short on its way: copy it again");
    return;
  }
}

}  // namespace

std::mutex& netcdf_library() {
  static std::mutex mutex;
  // HDF5 locks files as it opens them, and fails where a file system has no locks, as NFS may. Ours are whole before anyone finds them.
  [[maybe_unused]] static const int no_locks = ::setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);
  return mutex;
}

NetcdfFile::NetcdfFile(const std::string& path) : path_(path) {
  if (!std::filesystem::is_regular_file(path)) throw bad_input(path, "no file", "a NetCDF file expected");
  check_length(path);
  const std::lock_guard guard(netcdf_library());
  if (const int status = nc_open(path.c_str(), NC_NOWRITE, &id_); status != NC_NOERR) {
    id_ = -1;
    throw bad_input(path, std::string("no NetCDF file, or a damaged one (") + nc_strerror(status) + ")",
                    "a whole NetCDF file, classic or NetCDF-4, expected", "It may have been cut short on its way: copy it again");
  }
  try {
    list_contents();
  } catch (...) {
    nc_close(id_);
    throw;
  }
}

NetcdfFile::~NetcdfFile() {
  const std::lock_guard guard(netcdf_library());
  if (id_ >= 0) nc_close(id_);
}

void NetcdfFile::check(int status, const std::string& what) const {
  if (status != NC_NOERR)
    throw bad_input(path_ + ": " + what, nc_strerror(status), "a whole NetCDF file expected", "The file may be damaged: copy it again");
}

void NetcdfFile::list_contents() {
  int dimensions = 0, variables = 0;
  check(nc_inq_ndims(id_, &dimensions), "dimensions");
  check(nc_inq_nvars(id_, &variables), "variables");
  std::vector<int> ids(static_cast<std::size_t>(dimensions));
  check(nc_inq_dimids(id_, nullptr, ids.data(), 0), "dimensions");
  char name[NC_MAX_NAME + 1];
  for (const int dimension : ids) {
    std::size_t length = 0;
    check(nc_inq_dim(id_, dimension, name, &length), "dimensions");
    dimensions_.push_back({name, length});
  }
  for (int v = 0; v < variables; ++v) {
    nc_type type = 0;
    int rank = 0, own[NC_MAX_VAR_DIMS];
    check(nc_inq_var(id_, v, name, &type, &rank, own, nullptr), "variables");
    Variable variable{name, {}, type != NC_CHAR && type <= NC_UINT64 && type != NC_NAT};
    for (int i = 0; i < rank; ++i) {
      const auto place = std::find(ids.begin(), ids.end(), own[i]);
      if (place == ids.end()) check(NC_EBADDIM, name);
      variable.dimensions.push_back(static_cast<std::size_t>(place - ids.begin()));
    }
    variables_.push_back(variable);
  }
}

int NetcdfFile::id_of(const Variable& variable) const { return static_cast<int>(&variable - variables_.data()); }

const NetcdfFile::Variable* NetcdfFile::find(std::string_view name) const {
  for (const Variable& variable : variables_)
    if (variable.name == name) return &variable;
  return nullptr;
}

const NetcdfFile::Variable& NetcdfFile::get(std::string_view name, std::string_view key) const {
  if (const Variable* found = find(name)) return *found;
  std::vector<std::string> names;
  for (const Variable& variable : variables_) names.push_back(variable.name);
  const std::string near = nearest_name(name, names);
  throw bad_input(path_, "no variable '" + std::string(name) + "' (" + std::string(key) + ")", "one of its variables expected: " + all_variables(),
                  near.empty() ? "" : "Did you mean '" + near + "'?");
}

std::string NetcdfFile::all_variables() const {
  std::string text;
  for (const Variable& variable : variables_) {
    text += (text.empty() ? "'" : ", '") + variable.name + "' (";
    for (std::size_t i = 0; i < variable.dimensions.size(); ++i)
      text += (i ? ", " : "") + dimensions_[variable.dimensions[i]].name;
    text += ")";
  }
  return text.empty() ? "none at all" : text;
}

std::optional<std::string> NetcdfFile::text(const Variable* variable, const std::string& attribute) const {
  const std::lock_guard guard(netcdf_library());
  const int id = variable ? id_of(*variable) : NC_GLOBAL;
  nc_type type = 0;
  std::size_t length = 0;
  if (nc_inq_att(id_, id, attribute.c_str(), &type, &length) != NC_NOERR) return std::nullopt;
  if (type == NC_CHAR && length <= longest_text) {
    std::string value(length, ' ');
    if (nc_get_att_text(id_, id, attribute.c_str(), value.data()) != NC_NOERR) return std::nullopt;
    while (!value.empty() && (value.back() == '\0' || value.back() == ' ')) value.pop_back();
    return value;
  }
  if (type != NC_STRING || length != 1) return std::nullopt;
  char* value = nullptr;
  if (nc_get_att_string(id_, id, attribute.c_str(), &value) != NC_NOERR || !value) return std::nullopt;
  std::string result(value);
  nc_free_string(1, &value);
  return result;
}

std::optional<double> NetcdfFile::number(const Variable* variable, const std::string& attribute) const {
  const std::lock_guard guard(netcdf_library());
  const int id = variable ? id_of(*variable) : NC_GLOBAL;
  nc_type type = 0;
  std::size_t length = 0;
  double value = 0;
  if (nc_inq_att(id_, id, attribute.c_str(), &type, &length) != NC_NOERR || type == NC_CHAR || type > NC_UINT64 || length != 1 ||
      nc_get_att_double(id_, id, attribute.c_str(), &value) != NC_NOERR)
    return std::nullopt;
  return value;
}

template <class Number>
std::vector<Number> NetcdfFile::read(const Variable& variable, std::span<const std::size_t> start,
                                     std::span<const std::size_t> count) const {
  if (!variable.is_number) throw bad_input(where(variable), "no numbers", "numbers expected");
  std::size_t total = 1;
  for (const std::size_t n : count) {
    if (n > 0 && total > most_values / n) throw bad_input(where(variable), "more than 2^32 values", "a smaller array expected");
    total *= n;
  }
  const auto fill = number(&variable, "_FillValue"), missing = number(&variable, "missing_value");
  const double scale = number(&variable, "scale_factor").value_or(1), offset = number(&variable, "add_offset").value_or(0);
  std::vector<Number> values(total);
  {
    const std::lock_guard guard(netcdf_library());
    int status;
    if constexpr (std::is_same_v<Number, double>)
      status = nc_get_vara_double(id_, id_of(variable), start.data(), count.data(), values.data());
    else
      status = nc_get_vara_float(id_, id_of(variable), start.data(), count.data(), values.data());
    if (status != NC_ERANGE) check(status, "variable '" + variable.name + "'");  // out of range: infinite
  }
  const auto is = [](Number value, const std::optional<double>& mark) { return mark && value == static_cast<Number>(*mark); };
  for (Number& value : values) {
    if (is(value, fill) || is(value, missing) || value == static_cast<Number>(NC_FILL_DOUBLE))
      value = std::numeric_limits<Number>::quiet_NaN();
    else if (scale != 1 || offset != 0)
      value = static_cast<Number>(scale * static_cast<double>(value) + offset);
  }
  return values;
}

template <class Number>
std::vector<Number> NetcdfFile::read(const Variable& variable) const {
  std::vector<std::size_t> start, count;
  for (const std::size_t d : variable.dimensions) {
    start.push_back(0);
    count.push_back(dimensions_[d].length);
  }
  return read<Number>(variable, start, count);
}

template std::vector<float> NetcdfFile::read(const Variable&, std::span<const std::size_t>, std::span<const std::size_t>) const;
template std::vector<double> NetcdfFile::read(const Variable&, std::span<const std::size_t>, std::span<const std::size_t>) const;
template std::vector<float> NetcdfFile::read(const Variable&) const;
template std::vector<double> NetcdfFile::read(const Variable&) const;

}  // namespace arcus
