#pragma once
// Units as model output spells them.

#include <optional>
#include <string>
#include <string_view>

namespace arcus::media {

/// What a quantity is per, and the factor to the unit that authors use.
struct FieldUnit {
  double factor = 1;
  bool is_per_kg = false;  ///< of air: times the air's density [kg/m³] it is per m³
};

/// A unit with its powers in one spelling: "g m-3", "g/m^3", "g m**-3" and "g.m-3" are "g m-3". Letters stay as they are.
std::string plain_unit(std::string_view unit);

// Nothing where the unit is none of these.

/// Liquid water, to g/m³ or g/kg: g, mg or kg per m³ or kg; 1 is kg/kg.
std::optional<FieldUnit> water_unit(std::string_view unit);
/// Droplets, to 1/cm³: per cm³, litre, m³ or kg.
std::optional<FieldUnit> number_unit(std::string_view unit);
/// Radii, to µm.
std::optional<FieldUnit> radius_unit(std::string_view unit);
/// Lengths, to m.
std::optional<FieldUnit> length_unit(std::string_view unit);
/// Pressures, to Pa.
std::optional<FieldUnit> pressure_unit(std::string_view unit);

}  // namespace arcus::media
