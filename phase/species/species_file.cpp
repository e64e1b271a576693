#include "phase/species/species_file.h"

#include <netcdf.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string_view>
#include <type_traits>

#include "phase/base/content_hash.h"
#include "phase/settings/toml_text.h"
#include "phase/base/error.h"
#include "phase/base/netcdf_file.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"

namespace arcus::phase {
namespace {

constexpr int format = 1;

const char* const references =
    "Lorenz-Mie series: C. F. Bohren and D. R. Huffman, Absorption and Scattering of Light by Small Particles "
    "(Wiley 1983). Size distributions: J. E. Hansen and L. D. Travis, Space Sci. Rev. 16, 527 (1974); J. S. Marshall "
    "and W. McK. Palmer, J. Meteor. 5, 165 (1948). Water: M. Daimon and A. Masumura, Appl. Opt. 46, 3811 (2007); D. J. "
    "Segelstein, thesis, Univ. of Missouri-Kansas City (1981). Ice: S. G. Warren and R. E. Brandt, J. Geophys. Res. "
    "113, D14220 (2008). Air: B. Edlen, Metrologia 2, 71 (1966).";

/// A NetCDF file that is closed whatever happens.
class Handle {
 public:
  Handle() = default;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (is_open) nc_abort(id);
  }
  int close() {
    is_open = false;
    return nc_close(id);
  }
  int id = 0;
  bool is_open = false;
};

/// Name, unit and meaning of every variable, and where it lies in a table: the one list for writing and reading.
struct Variable {
  const char *name, *units, *long_name;
};
constexpr Variable size_axis{"size_um", "um", "effective radius of the particles"};
constexpr Variable wavelength_axis{"wavelength_nm", "nm", "wavelength in vacuum"};
constexpr Variable angle_axis{"scattering_angle_deg", "degree", "scattering angle, 0 is straight on"};

template <class Table, class Action>
void for_each_cross_section(Table& t, const Action& action) {
  action(Variable{"extinction_cross_section", "m2", "mean extinction cross-section of a particle"},
         t.extinction_cross_section_m2);
  action(Variable{"scattering_cross_section", "m2", "mean scattering cross-section of a particle"},
         t.scattering_cross_section_m2);
  action(Variable{"asymmetry", "1", "mean cosine of the scattering angle"}, t.asymmetry);
  action(Variable{"forward_fraction", "1",
                  "share of the extinction that goes straight on: the lobe of P11 inside forward_angle_deg, or, where that is 0, light that is in no P11"},
         t.forward_fraction);
}

template <class Table, class Action>
void for_each_element(Table& t, const Action& action) {
  action(Variable{"P11", "sr-1", "scattering matrix element P11, integral over the sphere 1"}, t.p11);
  action(Variable{"P12", "sr-1", "scattering matrix element P12, normalised as P11"}, t.p12);
  action(Variable{"P33", "sr-1", "scattering matrix element P33, normalised as P11"}, t.p33);
  action(Variable{"P34", "sr-1", "scattering matrix element P34, normalised as P11"}, t.p34);
}

/// The last line of a file names the bytes before it. HDF5 ignores what follows its own end, but crashes where its
/// inner structure was changed, so a file is checked before that library sees it.
constexpr std::string_view seal_begin = "\narcus-seal-xxh3-128 ";
std::string seal_of(std::string_view bytes) { return std::string(seal_begin) + content_hash(bytes) + "\n"; }

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (file) bytes << file.rdbuf();
  return std::move(bytes).str();
}

bool is_sealed(std::string_view bytes) {
  const std::size_t length = seal_begin.size() + content_hash("").size() + 1;
  if (bytes.size() < length) return false;
  return seal_of(bytes.substr(0, bytes.size() - length)) == bytes.substr(bytes.size() - length);
}

class Writer {
 public:
  explicit Writer(const std::string& path) : path_(path) {}

  void write(const std::string& temporary_path, const SpeciesFile& file) {
    check(nc_create(temporary_path.c_str(), NC_NETCDF4 | NC_CLOBBER, &handle_.id));
    handle_.is_open = true;
    check(nc_set_fill(handle_.id, NC_NOFILL, nullptr));
    attributes(file);
    const ScatteringTable& t = file.table;
    axis(size_axis, t.size_um, 0);
    axis(wavelength_axis, t.wavelength_nm, 1);
    axis(angle_axis, t.scattering_angle_deg, 2);
    for_each_cross_section(t, [&](const Variable& v, const auto& values) { variable(v, values, 2, dimensions_); });
    for_each_element(t, [&](const Variable& v, const auto& values) { variable(v, values, 3, dimensions_); });
    check(handle_.close());
  }

 private:
  void check(int status) const {
    if (status != NC_NOERR) throw cannot("cannot write " + path_, nc_strerror(status));
  }
  void text(const char* name, const std::string& value, int variable = NC_GLOBAL) const {
    check(nc_put_att_text(handle_.id, variable, name, value.size(), value.c_str()));
  }
  void number(const char* name, double value) const {
    check(nc_put_att_double(handle_.id, NC_GLOBAL, name, NC_DOUBLE, 1, &value));
  }
  void attributes(const SpeciesFile& file) const {
    text("Conventions", "CF-1.8");
    text("title", "Light scattering by a population of particles");
    text("source", std::string("arcus ") + version);
    text("program_version", version);
    check(nc_put_att_int(handle_.id, NC_GLOBAL, "arcus_format", NC_INT, 1, &format));
    text("recipe", file.recipe);
    text("recipe_id", file.recipe_id);
    text("references", references);
    text("comment",
         "Between angle nodes the elements are linear in sin(theta/2)^2; so interpolated, P11 integrates to 1. "
         "P22 = P11 and P44 = P33 for spheres; P33 and P34 of crystals are unknown and 0. The forward lobe is included where "
         "forward_angle_deg is above 0; where it is 0, P11 is of what does not go straight on. No disc of the sun.");
    number("forward_angle_deg", file.table.forward_angle_deg);
    number("normalisation_error", file.table.normalisation_error);
    number("angle_error", file.table.angle_error);
  }
  void axis(const Variable& v, const std::vector<double>& values, int which) {
    check(nc_def_dim(handle_.id, v.name, values.size(), &dimensions_[which]));
    variable(v, values, 1, &dimensions_[which]);
  }
  template <class Number>
  void variable(const Variable& v, const std::vector<Number>& values, int dimension_count, const int* dimensions) {
    int id = 0;
    constexpr bool is_double = std::is_same_v<Number, double>;
    check(nc_def_var(handle_.id, v.name, is_double ? NC_DOUBLE : NC_FLOAT, dimension_count, dimensions, &id));
    text("units", v.units, id);
    text("long_name", v.long_name, id);
    check(nc_put_var(handle_.id, id, values.data()));
  }

  std::string path_;
  Handle handle_;
  int dimensions_[3] = {};
};

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  SpeciesFile read() {
    if (!std::filesystem::is_regular_file(path_)) throw bad_input(path_, "no file", "a phase table in NetCDF-4 expected");
    if (!is_sealed(bytes_of(path_))) throw damaged("a file that is not as it was written");
    check(nc_open(path_.c_str(), NC_NOWRITE, &handle_.id), "");
    handle_.is_open = true;
    int found_format = 0;
    check(nc_get_att_int(handle_.id, NC_GLOBAL, "arcus_format", &found_format), "arcus_format");
    if (found_format != format)
      throw bad_input(path_, "table format " + std::to_string(found_format), std::to_string(format) + " expected");
    SpeciesFile file;
    ScatteringTable& t = file.table;
    axis(size_axis, t.size_um, 0, 100000);
    axis(wavelength_axis, t.wavelength_nm, 1, 100000);
    axis(angle_axis, t.scattering_angle_deg, 2, 10000000);
    for_each_cross_section(t, [&](const Variable& v, auto& values) { variable(v, values, 2, dimensions_); });
    for_each_element(t, [&](const Variable& v, auto& values) { variable(v, values, 3, dimensions_); });
    t.forward_angle_deg = number("forward_angle_deg");
    t.normalisation_error = number("normalisation_error");
    t.angle_error = number("angle_error");
    file.recipe = text("recipe");
    file.recipe_id = text("recipe_id");
    file.program_version = text("program_version");
    check(handle_.close(), "");
    check_table(t, path_);
    return file;
  }

 private:
  Error damaged(const std::string& found) const {
    return bad_input(path_, found, "a whole phase table in NetCDF-4 expected", "The file may be damaged");
  }
  void check(int status, const std::string& what) const {
    if (status != NC_NOERR) throw damaged((what.empty() ? "" : what + ": ") + nc_strerror(status));
  }
  std::string text(const char* name) const {
    std::size_t length = 0;
    check(nc_inq_attlen(handle_.id, NC_GLOBAL, name, &length), name);
    if (length > 10000000) throw damaged("a text that is too long");
    std::string value(length, ' ');
    check(nc_get_att_text(handle_.id, NC_GLOBAL, name, value.data()), name);
    return value;
  }
  double number(const char* name) const {
    double value = 0;
    check(nc_get_att_double(handle_.id, NC_GLOBAL, name, &value), name);
    return value;
  }
  void axis(const Variable& v, std::vector<double>& values, int which, std::size_t most) {
    check(nc_inq_dimid(handle_.id, v.name, &dimensions_[which]), v.name);
    std::size_t length = 0;
    check(nc_inq_dimlen(handle_.id, dimensions_[which], &length), v.name);
    if (length == 0 || length > most) throw damaged(std::string(v.name) + " of " + std::to_string(length) + " nodes");
    length_[which] = length;
    variable(v, values, 1, &dimensions_[which]);
  }
  template <class Number>
  void variable(const Variable& v, std::vector<Number>& values, int dimension_count, const int* dimensions) {
    int id = 0, count = 0, found[NC_MAX_VAR_DIMS] = {};
    check(nc_inq_varid(handle_.id, v.name, &id), v.name);
    check(nc_inq_var(handle_.id, id, nullptr, nullptr, &count, found, nullptr), v.name);
    std::size_t length = 1;
    bool as_expected = count == dimension_count;
    for (int i = 0; as_expected && i < count; ++i) {
      as_expected = found[i] == dimensions[i];
      for (int axis = 0; axis < 3; ++axis)
        if (found[i] == dimensions_[axis]) length *= length_[axis];
    }
    if (!as_expected) throw damaged(std::string(v.name) + " with other dimensions");
    if (length > (std::size_t{1} << 31)) throw damaged("a table of more than 2^31 values");
    values.resize(length);
    if constexpr (std::is_same_v<Number, double>) check(nc_get_var_double(handle_.id, id, values.data()), v.name);
    else check(nc_get_var_float(handle_.id, id, values.data()), v.name);
  }

  std::string path_;
  Handle handle_;
  int dimensions_[3] = {-1, -1, -1};
  std::size_t length_[3] = {};
};

}  // namespace

void write_species_file(const std::string& path, const SpeciesFile& file) {
  WholeFile whole(path);
  {
    const std::lock_guard guard(netcdf_library());
    Writer(path).write(whole.temporary_path(), file);
  }
  const std::string seal = seal_of(bytes_of(whole.temporary_path()));
  std::ofstream end(whole.temporary_path(), std::ios::binary | std::ios::app);
  end << seal << std::flush;
  if (!end) throw cannot("cannot write " + path, "the disk may be full");
  end.close();
  whole.commit();
}

SpeciesFile read_species_file(const std::string& path) {
  const std::lock_guard guard(netcdf_library());
  return Reader(path).read();
}

}  // namespace arcus::phase
