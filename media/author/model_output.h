#pragma once
// The output of a cloud model or a large-eddy simulation in NetCDF: liquid water, and what says how large its droplets are.

#include <optional>
#include <string>
#include <vector>

#include "media/author/model_axes.h"
#include "media/author/water_field.h"
#include "phase/settings/keys.h"

namespace arcus::media {

/// Which variables to read; empty: found by the usual names, where the file has one.
struct ModelSettings {
  std::string water, water_unit;    ///< liquid water; its unit where the attribute is missing or wrong
  std::string number, number_unit;  ///< of droplets
  std::string radius, radius_unit;  ///< effective
  std::string density, pressure, temperature;  ///< of the air, for water or numbers per kg
  AxisNames axes;
  long long time_index = -1;  ///< from 0 on; -1: there is only one time
};
void list_keys(Keys& keys, ModelSettings& model);

struct ModelOutput {
  WaterField field;
  std::vector<std::string> notes;  ///< which variables were used, and how
};

/// Reads the water and, unless `sizes_are_given`, the droplets' radius or else number where the file has one. What is per kg of air
/// takes the air's density from a variable, else from pressure and temperature, else from the International Standard Atmosphere at its
/// height; variables that lack a dimension of the water hold along it (profiles). Throws bad_input: see NetcdfFile and
/// find_axes; no such variable, an unknown unit, other dimensions than the water's, uneven steps along x or y.
ModelOutput read_model_output(const std::string& path, const ModelSettings& settings, const std::optional<GivenLattice>& given, bool sizes_are_given);

}  // namespace arcus::media
