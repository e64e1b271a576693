#pragma once
// What lies along a climbing ray in air whose density falls exponentially with height above a round planet: Chapman's function ("The absorption and
// dissociative or ionizing effect of monochromatic radiation in an atmosphere on a rotating earth", Proc. Phys. Soc. 43, 26, 1931).

namespace arcus::media {

/// e^(z²) erfc(z) for z from 0 to 500, to 10⁻¹² of its value.
double scaled_erfc(double z);

/// ∫ e^(−h/H) ds from a place to infinity [m]: the way through air of sea level's density that is worth the same, to 10⁻⁷ where the scale height H is
/// at most 1/500 of the planet's radius. `climb`: cosine of the ray's zenith angle there, 0 to 1.
double way_to_space_m(double height_m, double climb, double scale_height_m, double radius_m);

}  // namespace arcus::media
