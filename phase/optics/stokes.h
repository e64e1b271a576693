#pragma once
// Polarised light as a Stokes vector, and what turning its axes and a plane interface do to it.
// Bohren & Huffman (1983), sections 2.11.1 and 3.3.

namespace arcus::phase {

/// With respect to unit vectors e_perpendicular x e_parallel = direction of propagation:
/// i = |E_par|^2 + |E_perp|^2, q = |E_par|^2 - |E_perp|^2, u = 2 Re(E_par E_perp*),
/// v = 2 Im(E_par E_perp*). A power or an intensity, whatever the user counts.
struct Stokes {
  double i = 1, q = 0, u = 0, v = 0;

  Stokes& operator+=(const Stokes& other) {
    i += other.i;
    q += other.q;
    u += other.u;
    v += other.v;
    return *this;
  }
  Stokes operator-(const Stokes& other) const {
    return {i - other.i, q - other.q, u - other.u, v - other.v};
  }
  Stokes operator*(double factor) const { return {i * factor, q * factor, u * factor, v * factor}; }
};

/// The same light with respect to axes turned about the direction of propagation by the angle eta,
/// from e_perpendicular towards e_parallel; cosine and sine of eta times any common positive
/// factor. Both zero leaves it as it is.
Stokes turned(const Stokes& light, double cosine, double sine);

/// What a plane interface between transparent media makes of light, axes perpendicular and parallel
/// to the plane of incidence. The two powers add up to the incoming one.
struct InterfaceMatrix {
  double a = 1, b = 0;  ///< reflected i = a i + b q, q = b i + a q
  double c = 1, d = 0;  ///< reflected u = c u + d v, v = c v - d u; d only under total reflection
  double transmitted_c = 0;  ///< transmitted u and v; i and q get what is not reflected
  double cos_transmitted = 0;

  bool total() const { return cos_transmitted == 0; }  ///< nothing goes through
  Stokes reflected(const Stokes& light) const;
  Stokes transmitted(const Stokes& light) const;
};
/// cos_incident in [0, 1]; relative_index: of the medium beyond over that of the medium before.
InterfaceMatrix interface_matrix(double cos_incident, double relative_index);

}  // namespace arcus::phase
