#pragma once
// What cirrus is like at a temperature, by measurements from aircraft and in cold chambers.

namespace arcus::media {

/// Mean ice water content of cirrus: ln IWC = -7.6 + 4 exp[-0.2443e-3 (|T| - 20)^2.455] (K. N. Liou, Mon. Weather Rev. 114, 1167, 1986, after A. J.
/// Heymsfield and C. M. R. Platt, J. Atmos. Sci. 41, 846, 1984): 0.5 mg/m³ in the coldest, 27 mg/m³ from -20 C on.
double mean_ice_g_per_m3(double temperature_c);

/// Mean effective size D = 326.3 + 12.42 T + 0.197 T² + 0.0012 T³ (S. C. Ou and K. N. Liou, Atmos. Res. 35, 127, 1995): 31 µm at -60 C and colder,
/// 147 µm at -20 C and warmer. It is the width of columns; their length is two to three times as much.
double mean_width_um(double temperature_c);

/// Share of columns among plates and columns: plates grow from -9 to -40 C, columns above and below (C. Magono and C. W. Lee, J. Fac. Sci.
/// Hokkaido Univ. VII 2, 321, 1966; M. P. Bailey and J. Hallett, J. Atmos. Sci. 66, 2888, 2009). A smooth rule between 0.1 and 0.9:
/// both are always found.
double columnar_share(double temperature_c);

}  // namespace arcus::media
