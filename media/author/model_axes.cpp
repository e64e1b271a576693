#include "media/author/model_axes.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "media/author/field_units.h"
#include "phase/base/error.h"
#include "phase/settings/number_text.h"

namespace arcus::media {
namespace {

using Variable = NetcdfFile::Variable;

enum class Role { x, y, z, time, angle, pressure, unknown };

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The usual names of models (WRF, SAM, DALES, MicroHH, PALM, UCLA-LES, CM1, MesoNH, ICON on planes).
Role role_of_name(const std::string& original) {
  const std::string name = lower(original);
  if (is_one_of(name, {"x", "xt", "xm", "xh", "x_c", "nx", "ni", "west_east", "projection_x_coordinate", "xc"})) return Role::x;
  if (is_one_of(name, {"y", "yt", "ym", "yh", "y_c", "ny", "nj", "south_north", "projection_y_coordinate", "yc"})) return Role::y;
  if (is_one_of(name, {"z", "zt", "zm", "zh", "z_c", "nz", "nk", "zu_3d", "zw_3d", "height", "altitude", "alt", "lev",
                       "level", "levels", "bottom_top", "zc", "height_above_ground"}))
    return Role::z;
  if (is_one_of(name, {"time", "t", "times"})) return Role::time;
  if (is_one_of(name, {"lat", "latitude", "lon", "longitude", "rlat", "rlon"})) return Role::angle;
  if (is_one_of(name, {"plev", "pressure", "isobaric"})) return Role::pressure;
  return Role::unknown;
}

Role role_of(const NetcdfFile& file, const Variable& coordinate) {
  const std::string units = lower(file.text(&coordinate, "units").value_or(""));
  const std::string standard = lower(file.text(&coordinate, "standard_name").value_or(""));
  if (units.starts_with("degree") || is_one_of(standard, {"latitude", "longitude", "grid_latitude", "grid_longitude"})) return Role::angle;
  if (units.find(" since ") != std::string::npos || standard == "time") return Role::time;
  if (pressure_unit(file.text(&coordinate, "units").value_or("")) || standard == "air_pressure") return Role::pressure;
  const std::string axis = lower(file.text(&coordinate, "axis").value_or(""));
  if (axis == "x" || standard == "projection_x_coordinate") return Role::x;
  if (axis == "y" || standard == "projection_y_coordinate") return Role::y;
  if (axis == "z" || is_one_of(standard, {"height", "altitude", "height_above_mean_sea_level"})) return Role::z;
  if (axis == "t") return Role::time;
  return role_of_name(coordinate.name);
}

/// A dimension and the variable that says where its points are, if there is one.
struct Dimension {
  std::size_t place;
  const Variable* coordinate = nullptr;
  Role role = Role::unknown;
};

bool is_along(const Variable& variable, std::size_t dimension) {
  return variable.is_number && variable.dimensions.size() == 1 && variable.dimensions[0] == dimension;
}

Role named_role(const AxisNames& names, const std::string& dimension, const std::string& coordinate) {
  const auto is = [&](const std::string& given) { return !given.empty() && (given == dimension || given == coordinate); };
  return is(names.x) ? Role::x : is(names.y) ? Role::y : is(names.z) ? Role::z : is(names.time) ? Role::time : Role::unknown;
}

Dimension look_at(const NetcdfFile& file, std::size_t place, const AxisNames& names) {
  Dimension result{place};
  const std::string& name = file.dimensions()[place].name;
  const auto take = [&](const Variable& variable, Role role) {
    result.coordinate = &variable;
    result.role = role;
  };
  // A coordinate variable that was asked for, then the dimension's own, then another one that lies along it.
  for (const Variable& variable : file.variables())
    if (const Role role = named_role(names, "", variable.name); is_along(variable, place) && role != Role::unknown) {
      take(variable, role);
      return result;
    }
  if (const Variable* own = file.find(name); own && is_along(*own, place)) take(*own, role_of(file, *own));
  else
    for (const Variable& variable : file.variables())
      if (const Role role = role_of(file, variable); !result.coordinate && is_along(variable, place) && role != Role::unknown) take(variable, role);
  if (const Role role = named_role(names, name, ""); role != Role::unknown) result.role = role;
  else if (result.role == Role::unknown) result.role = role_of_name(name);
  return result;
}

std::string described(const NetcdfFile& file, const Dimension& dimension) {
  const NetcdfFile::Dimension& d = file.dimensions()[dimension.place];
  return "dimension '" + d.name + "' of length " + std::to_string(d.length);
}

/// Positions as the file has them.
std::vector<double> positions_of(const NetcdfFile& file, const Dimension& dimension, std::size_t axis, const std::optional<GivenLattice>& given,
                                 std::vector<std::string>& notes) {
  const std::size_t count = file.dimensions()[dimension.place].length;
  std::vector<double> positions;
  if (!dimension.coordinate || (given && dimension.role != Role::z)) {
    if (!given && count > 1)
      throw bad_input(file.path(), described(file, dimension) + " without a coordinate variable", "positions in m or km expected",
                      "Give first_m and voxel_m");
    for (std::size_t i = 0; i < count; ++i)
      positions.push_back(given ? given->first_m[axis] + static_cast<double>(i) * given->step_m[axis] : 0);
    return positions;
  }
  const Variable& coordinate = *dimension.coordinate;
  const auto text = file.text(&coordinate, "units");
  double factor = 1;
  if (!text || text->empty()) {
    notes.push_back("'" + coordinate.name + "' has no units: taken as metres");
  } else if (const auto unit = length_unit(*text)) {
    factor = unit->factor;
  } else {
    throw bad_input(file.where(coordinate), "units '" + *text + "'", "m or km expected",
                    "Give another coordinate with x, y or z, or first_m and voxel_m");
  }
  positions = file.read<double>(coordinate);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] *= factor;
    if (!std::isfinite(positions[i]))
      throw bad_input(file.where(coordinate), "a missing value at index " + std::to_string(i), "positions expected");
  }
  return positions;
}

ModelAxis axis_of(const NetcdfFile& file, const Dimension& dimension, std::vector<double> positions) {
  ModelAxis axis{.dimension = dimension.place};
  if (positions.empty()) throw bad_input(file.path(), described(file, dimension), "at least one point expected");
  axis.is_reversed = positions.size() > 1 && positions[1] < positions[0];
  if (axis.is_reversed) std::reverse(positions.begin(), positions.end());
  for (std::size_t i = 1; i < positions.size(); ++i)
    if (!(positions[i] > positions[i - 1]))
      throw bad_input(file.path() + ": " + described(file, dimension),
                      number_text(positions[i]) + " m beside " + number_text(positions[i - 1]) + " m", "positions that go one way expected");
  axis.position_m = std::move(positions);
  return axis;
}

}  // namespace

ModelAxes find_axes(const NetcdfFile& file, const Variable& variable, const AxisNames& names, const std::optional<GivenLattice>& given) {
  ModelAxes axes;
  for (const std::size_t place : variable.dimensions) {
    const Dimension dimension = look_at(file, place, names);
    const std::string where = file.where(variable);
    if (dimension.role == Role::angle)
      throw bad_input(where, described(file, dimension) + " is latitude or longitude", "a plane with x and y in m or km expected",
                      "Project it first (cdo, xesmf), or give first_m and voxel_m with x, y and z as names of dimensions");
    if (dimension.role == Role::pressure)
      throw bad_input(where, described(file, dimension) + " is a pressure", "heights in m or km expected", "Interpolate it to heights first");
    if (dimension.role == Role::unknown) {
      if (file.dimensions()[place].length == 1) continue;
      throw bad_input(where, described(file, dimension) + ", neither x nor y, z or time by its name and attributes", "x, y, z and perhaps time expected",
                      "Say which it is with x, y, z or time");
    }
    if (dimension.role == Role::time) {
      if (axes.time) throw bad_input(where, "two dimensions of time", "one expected", "Say which with time");
      axes.time = place;
      continue;
    }
    const auto axis = static_cast<std::size_t>(dimension.role);
    if (axes.space[axis].dimension)
      throw bad_input(where, "two dimensions along " + std::string(1, "xyz"[axis]), "one expected", "Say which with x, y or z");
    axes.space[axis] = axis_of(file, dimension, positions_of(file, dimension, axis, given, axes.notes));
  }
  if (!axes.space[2].dimension)
    throw bad_input(file.where(variable), "no dimension of height", "x, y and z expected", "Say which it is with z");
  return axes;
}

}  // namespace arcus::media
