#include "phase/optics/fresnel.h"

#include <cmath>

namespace arcus::phase {

FresnelAmplitudes fresnel_amplitudes(std::complex<double> cos_incident, std::complex<double> m) {
  const std::complex<double> sin2 = 1.0 - cos_incident * cos_incident;
  std::complex<double> c = std::sqrt(1.0 - sin2 / (m * m));
  // At a real angle take, of the two roots, the wave that decays beyond the interface.
  if (std::imag(cos_incident) == 0 && std::imag(m * c) < 0) c = -c;
  FresnelAmplitudes a;
  a.cos_transmitted = c;
  const std::complex<double> perpendicular = cos_incident + m * c, parallel = m * cos_incident + c;
  a.r_perpendicular = (cos_incident - m * c) / perpendicular;
  a.r_parallel = (m * cos_incident - c) / parallel;
  a.t_perpendicular = 2.0 * cos_incident / perpendicular;
  a.t_parallel = 2.0 * cos_incident / parallel;
  return a;
}

FresnelReflectance fresnel_reflectance(double cos_incident, double m) {
  const double cos2 = 1 - (1 - cos_incident * cos_incident) / (m * m);
  if (cos2 <= 0) return {};
  const double c = std::sqrt(cos2);
  const double perpendicular = (cos_incident - m * c) / (cos_incident + m * c);
  const double parallel = (m * cos_incident - c) / (m * cos_incident + c);
  return {perpendicular * perpendicular, parallel * parallel};
}

}  // namespace arcus::phase
