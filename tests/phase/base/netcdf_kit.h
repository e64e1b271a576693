#pragma once
// NetCDF files as other programs write them.

#include <gtest/gtest.h>
#include <netcdf.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace arcus::kit {

/// A NetCDF file being written: dimensions first, then variables; whole once destroyed.
class NewNetcdf {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  /// mode: 0 for the classic format, NC_64BIT_OFFSET, NC_64BIT_DATA or NC_NETCDF4.
  explicit NewNetcdf(const std::string& path, int mode = 0) { check(nc_create(path.c_str(), NC_CLOBBER | mode, &id_)); }
  ~NewNetcdf() { check(nc_close(id_)); }
  NewNetcdf(const NewNetcdf&) = delete;
  NewNetcdf& operator=(const NewNetcdf&) = delete;

  void dimension(const std::string& name, std::size_t length) {
    nc_redef(id_);
    check(nc_def_dim(id_, name.c_str(), length, &dimensions_[name]));
    lengths_[name] = length;
  }
  /// Values in the order of the dimensions, as type NC_FLOAT, NC_DOUBLE, NC_SHORT ...
  int variable(const std::string& name, const std::vector<std::string>& along, const std::vector<double>& values, const Attributes& attributes = {},
               nc_type type = NC_FLOAT) {
    int variable = 0;
    std::vector<int> ids;
    std::vector<std::size_t> start, count;
    for (const std::string& d : along) {
      ids.push_back(dimensions_.at(d));
      start.push_back(0);
      count.push_back(lengths_.at(d) == NC_UNLIMITED ? records : lengths_.at(d));
    }
    nc_redef(id_);
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &variable));
    for (const auto& [key, text] : attributes) check(nc_put_att_text(id_, variable, key.c_str(), text.size(), text.c_str()));
    nc_enddef(id_);
    check(nc_put_vara_double(id_, variable, start.data(), count.data(), values.data()));
    return variable;
  }
  /// The attribute must have the variable's type to be a fill value, which is set before there are values.
  void number(int variable, const std::string& name, double value, nc_type type = NC_DOUBLE) {
    nc_redef(id_);
    check(nc_put_att_double(id_, variable, name.c_str(), type, 1, &value));
    nc_enddef(id_);
  }
  void text(const std::string& name, const std::string& value) {
    nc_redef(id_);
    check(nc_put_att_text(id_, NC_GLOBAL, name.c_str(), value.size(), value.c_str()));
    nc_enddef(id_);
  }

  std::size_t records = 1;  ///< how many an unlimited dimension gets

 private:
  static void check(int status) { ASSERT_EQ(status, NC_NOERR) << nc_strerror(status); }
  int id_ = 0;
  std::map<std::string, int> dimensions_;
  std::map<std::string, std::size_t> lengths_;
};

}  // namespace arcus::kit
