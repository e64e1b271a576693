#include "src/material/clear_body.h"

#include <algorithm>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::render {

ClearBody::ClearBody(const phase::RefractiveIndex& index, const SmoothSpectrum& filter, double filter_m, double enlargement) {
  for (int i = 0; i < nodes; ++i) {
    const double nm = shortest_wavelength_nm + i;
    const auto m = index.relative_to_air(nm);
    const auto node = static_cast<std::size_t>(i);
    index_[node] = m.real();
    // The imaginary part is relative to the air too, in which the wavelength is shorter by the air's index.
    absorption_per_m_[node] = 4 * pi * m.imag() * phase::air_index(nm) / (nm * 1e-9);
    absorption_per_m_[node] -= std::log(std::max(filter.at(nm), 1e-300)) / filter_m;
    absorption_per_m_[node] /= enlargement;
    is_dispersive_ |= index_[node] != index_[0];
    absorbs_ |= absorption_per_m_[node] > 0;
  }
}

double ClearBody::interpolated(const std::array<double, nodes>& values, double nm) {
  const double at = std::clamp(nm - shortest_wavelength_nm, 0.0, nodes - 1.0);
  const int low = std::min(static_cast<int>(at), nodes - 2);
  const auto i = static_cast<std::size_t>(low);
  return values[i] + (values[i + 1] - values[i]) * (at - low);
}

Spectrum ClearBody::transmittance(double distance_m, const Wavelengths& wavelengths) const {
  if (!absorbs_) return Spectrum::filled(1);
  Spectrum result;
  for (int i = 0; i < wavelength_count; ++i)
    result[i] = static_cast<float>(std::exp(-interpolated(absorption_per_m_, wavelengths[i]) * distance_m));
  return result;
}

}  // namespace arcus::render
