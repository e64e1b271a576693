#pragma once
// How much air there is in a cubic metre.

namespace arcus::media {

/// Of dry air [kg/m³] by the gas law.
double air_density_kg_per_m3(double pressure_pa, double temperature_k);

/// Of the International Standard Atmosphere (ISO 2533:1975) at a geopotential height over the sea [m], below 20 km: 288.15 K and 1013.25 hPa at
/// the sea, 6.5 K colder each km up to 11 km, then 216.65 K. Higher up counts as 20 km.
double standard_air_density_kg_per_m3(double height_m);

}  // namespace arcus::media
