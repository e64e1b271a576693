#include "phase/species/netcdf_table.h"

#include <netcdf.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string_view>

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/netcdf_file.h"
#include "phase/base/whole_file.h"

namespace arcus::phase {
namespace {

/// The last line of a file names the bytes before it. HDF5 ignores what follows its own end, but crashes where its
/// inner structure was changed, so a file is checked before that library sees it.
constexpr std::string_view seal_begin = "\narcus-seal-xxh3-128 ";
std::string seal_of(std::string_view bytes) { return std::string(seal_begin) + content_hash(bytes) + "\n"; }

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return "";
  std::string bytes(static_cast<std::size_t>(std::max<std::streamoff>(0, file.tellg())), '\0');
  file.seekg(0);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file ? bytes : "";
}

bool is_sealed(std::string_view bytes) {
  const std::size_t length = seal_begin.size() + content_hash("").size() + 1;
  if (bytes.size() < length) return false;
  return seal_of(bytes.substr(0, bytes.size() - length)) == bytes.substr(bytes.size() - length);
}

/// Bytes of one piece of a compressed variable, about.
constexpr std::size_t piece_bytes = 4 << 20;

}  // namespace

// ---- writing --------------------------------------------------------------------------------------

struct NetcdfTableWriter::File {
  explicit File(const std::string& where) : path(where), whole(where) {}
  ~File() {
    const std::lock_guard guard(netcdf_library());
    if (is_open) nc_abort(id);
  }
  void check(int status) const {
    if (status != NC_NOERR) throw cannot("cannot write " + path, nc_strerror(status));
  }
  int define(const TableVariable& v, nc_type type, const std::vector<int>& places) {
    std::vector<int> ids;
    for (const int place : places) ids.push_back(dimensions[static_cast<std::size_t>(place)]);
    int variable = 0;
    check(nc_def_var(id, v.name, type, static_cast<int>(ids.size()), ids.data(), &variable));
    put_text("units", v.units, variable);
    put_text("long_name", v.long_name, variable);
    return variable;
  }
  void put_text(const char* name, const std::string& value, int variable = NC_GLOBAL) const {
    check(nc_put_att_text(id, variable, name, value.size(), value.c_str()));
  }

  std::string path;
  WholeFile whole;
  int id = 0;
  bool is_open = false;
  std::vector<int> dimensions;
  std::vector<std::size_t> lengths;
};

NetcdfTableWriter::NetcdfTableWriter(const std::string& path) : file_(std::make_unique<File>(path)) {
  const std::lock_guard guard(netcdf_library());
  file_->check(nc_create(file_->whole.temporary_path().c_str(), NC_NETCDF4 | NC_CLOBBER, &file_->id));
  file_->is_open = true;
  file_->check(nc_set_fill(file_->id, NC_NOFILL, nullptr));
}
NetcdfTableWriter::~NetcdfTableWriter() = default;

void NetcdfTableWriter::text(const char* attribute, const std::string& value) {
  const std::lock_guard guard(netcdf_library());
  file_->put_text(attribute, value);
}
void NetcdfTableWriter::number(const char* attribute, double value) {
  const std::lock_guard guard(netcdf_library());
  file_->check(nc_put_att_double(file_->id, NC_GLOBAL, attribute, NC_DOUBLE, 1, &value));
}
void NetcdfTableWriter::integer(const char* attribute, int value) {
  const std::lock_guard guard(netcdf_library());
  file_->check(nc_put_att_int(file_->id, NC_GLOBAL, attribute, NC_INT, 1, &value));
}

void NetcdfTableWriter::axis(const TableVariable& v, const std::vector<double>& values) {
  {
    const std::lock_guard guard(netcdf_library());
    int dimension = 0;
    file_->check(nc_def_dim(file_->id, v.name, values.size(), &dimension));
    file_->dimensions.push_back(dimension);
    file_->lengths.push_back(values.size());
  }
  variable(v, values, {static_cast<int>(file_->dimensions.size()) - 1});
}

void NetcdfTableWriter::variable(const TableVariable& v, const std::vector<double>& values, const std::vector<int>& dimensions) {
  const std::lock_guard guard(netcdf_library());
  const int variable = file_->define(v, NC_DOUBLE, dimensions);
  file_->check(nc_put_var_double(file_->id, variable, values.data()));
}

void NetcdfTableWriter::variable(const TableVariable& v, const std::vector<float>& values, const std::vector<int>& dimensions) {
  const std::lock_guard guard(netcdf_library());
  const int variable = file_->define(v, NC_FLOAT, dimensions);
  file_->check(nc_put_var_float(file_->id, variable, values.data()));
}

void NetcdfTableWriter::compressed(const TableVariable& v, const std::vector<float>& values, const std::vector<int>& dimensions) {
  const std::lock_guard guard(netcdf_library());
  const int variable = file_->define(v, NC_FLOAT, dimensions);
  std::vector<std::size_t> piece;
  std::size_t row_bytes = sizeof(float);
  for (std::size_t i = 0; i < dimensions.size(); ++i) {
    piece.push_back(i == 0 ? 1 : file_->lengths[static_cast<std::size_t>(dimensions[i])]);
    if (i > 1) row_bytes *= piece.back();
  }
  if (piece.size() > 1) piece[1] = std::clamp<std::size_t>(piece_bytes / row_bytes, 1, piece[1]);
  file_->check(nc_def_var_chunking(file_->id, variable, NC_CHUNKED, piece.data()));
  file_->check(nc_def_var_deflate(file_->id, variable, 1, 1, 1));
  file_->check(nc_put_var_float(file_->id, variable, values.data()));
}

void NetcdfTableWriter::commit() {
  {
    const std::lock_guard guard(netcdf_library());
    file_->is_open = false;
    file_->check(nc_close(file_->id));
  }
  const std::string& path = file_->whole.temporary_path();
  const std::string seal = seal_of(bytes_of(path));
  std::ofstream end(path, std::ios::binary | std::ios::app);
  end << seal << std::flush;
  if (!end) throw cannot("cannot write " + file_->path, "the disk may be full");
  end.close();
  file_->whole.commit();
}

// ---- reading --------------------------------------------------------------------------------------

struct NetcdfTableReader::File {
  ~File() {
    const std::lock_guard guard(netcdf_library());
    if (is_open) nc_close(id);
  }
  Error damaged(const std::string& found) const {
    return bad_input(path, found, "a whole " + what + " in NetCDF-4 expected", "The file may be damaged");
  }
  void check(int status, const std::string& name) const {
    if (status != NC_NOERR) throw damaged((name.empty() ? "" : name + ": ") + nc_strerror(status));
  }
  /// The variable's id, and room for its values.
  template <class Number>
  int find(const TableVariable& v, std::vector<Number>& values, const std::vector<int>& places) const {
    int variable = 0, count = 0, found[NC_MAX_VAR_DIMS] = {};
    check(nc_inq_varid(id, v.name, &variable), v.name);
    check(nc_inq_var(id, variable, nullptr, nullptr, &count, found, nullptr), v.name);
    bool as_expected = count == static_cast<int>(places.size());
    std::size_t length = 1;
    for (std::size_t i = 0; as_expected && i < places.size(); ++i) {
      const auto place = static_cast<std::size_t>(places[i]);
      as_expected = found[i] == dimensions[place];
      length *= lengths[place];
    }
    if (!as_expected) throw damaged(std::string(v.name) + " with other dimensions");
    if (length > (std::size_t{1} << 32)) throw damaged("a table of more than 2^32 values");
    values.resize(length);
    return variable;
  }

  std::string path, what;
  int id = 0;
  bool is_open = false;
  std::vector<int> dimensions;
  std::vector<std::size_t> lengths;
};

int netcdf_table_format(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw bad_input(path, "no file", "a table in NetCDF-4 expected");
  if (!is_sealed(bytes_of(path)))
    throw bad_input(path, "a file that is not as it was written", "a whole table in NetCDF-4 expected", "The file may be damaged");
  const std::lock_guard guard(netcdf_library());
  int id = 0, format = 0;
  if (nc_open(path.c_str(), NC_NOWRITE, &id) != NC_NOERR) return 0;
  if (nc_get_att_int(id, NC_GLOBAL, "arcus_format", &format) != NC_NOERR) format = 0;
  nc_close(id);
  return format;
}

NetcdfTableReader::NetcdfTableReader(const std::string& path, const std::string& what, int format)
    : file_(std::make_unique<File>()) {
  file_->path = path;
  file_->what = what;
  if (!std::filesystem::is_regular_file(path)) throw bad_input(path, "no file", "a " + what + " in NetCDF-4 expected");
  if (!is_sealed(bytes_of(path))) throw file_->damaged("a file that is not as it was written");
  const std::lock_guard guard(netcdf_library());
  file_->check(nc_open(path.c_str(), NC_NOWRITE, &file_->id), "");
  file_->is_open = true;
  int found = 0;
  file_->check(nc_get_att_int(file_->id, NC_GLOBAL, "arcus_format", &found), "arcus_format");
  if (found != format) throw bad_input(path, "table format " + std::to_string(found), std::to_string(format) + " expected");
}
NetcdfTableReader::~NetcdfTableReader() = default;

std::string NetcdfTableReader::text(const char* attribute) {
  const std::lock_guard guard(netcdf_library());
  std::size_t length = 0;
  file_->check(nc_inq_attlen(file_->id, NC_GLOBAL, attribute, &length), attribute);
  if (length > 10000000) throw file_->damaged("a text that is too long");
  std::string value(length, ' ');
  file_->check(nc_get_att_text(file_->id, NC_GLOBAL, attribute, value.data()), attribute);
  return value;
}

double NetcdfTableReader::number(const char* attribute) {
  const std::lock_guard guard(netcdf_library());
  double value = 0;
  file_->check(nc_get_att_double(file_->id, NC_GLOBAL, attribute, &value), attribute);
  return value;
}

void NetcdfTableReader::axis(const TableVariable& v, std::vector<double>& values, std::size_t most) {
  {
    const std::lock_guard guard(netcdf_library());
    int dimension = 0;
    file_->check(nc_inq_dimid(file_->id, v.name, &dimension), v.name);
    std::size_t length = 0;
    file_->check(nc_inq_dimlen(file_->id, dimension, &length), v.name);
    if (length == 0 || length > most) throw file_->damaged(std::string(v.name) + " of " + std::to_string(length) + " nodes");
    file_->dimensions.push_back(dimension);
    file_->lengths.push_back(length);
  }
  variable(v, values, {static_cast<int>(file_->dimensions.size()) - 1});
}

void NetcdfTableReader::variable(const TableVariable& v, std::vector<double>& values, const std::vector<int>& dimensions) {
  const std::lock_guard guard(netcdf_library());
  const int id = file_->find(v, values, dimensions);
  file_->check(nc_get_var_double(file_->id, id, values.data()), v.name);
}

void NetcdfTableReader::variable(const TableVariable& v, std::vector<float>& values, const std::vector<int>& dimensions) {
  const std::lock_guard guard(netcdf_library());
  const int id = file_->find(v, values, dimensions);
  file_->check(nc_get_var_float(file_->id, id, values.data()), v.name);
}

}  // namespace arcus::phase
