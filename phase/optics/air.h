#pragma once
// What air does to light, a molecule at a time.

namespace arcus::phase {

/// Scattering cross section of a molecule of dry air with 360 ppm CO2 [m²] at a vacuum wavelength [nm], 250 to 1000 nm, to 0.01 %:
/// B. A. Bodhaine, N. B. Wood, E. G. Dutton, J. R. Slusser, "On Rayleigh Optical Depth Calculations", Journal of Atmospheric and Oceanic
/// Technology 16, 1854, 1999, equation 29.
double air_scattering_cross_section_m2(double wavelength_nm);

/// Depolarisation of natural light that dry air scatters at 90°, from the King factors of its gases (D. R. Bates, "Rayleigh scattering by air",
/// Planetary and Space Science 32, 785, 1984, as in Bodhaine et al., equations 5, 6 and 23).
double air_depolarisation(double wavelength_nm);

/// Absorption cross section of a molecule of ozone at 233 K [m²]: phase/data/ozone_cross_section.csv, linear between its nodes.
double ozone_absorption_cross_section_m2(double wavelength_nm);

/// Molecules of air in a cubic metre at 1013.25 hPa and 15 °C (US Standard Atmosphere 1976 at sea level).
inline constexpr double air_molecules_per_m3_at_sea_level = 2.546899e25;

/// Molecules in a square metre's column of one Dobson unit.
inline constexpr double molecules_per_m2_in_dobson_unit = 2.6867e20;

}  // namespace arcus::phase
