#include "phase/function/phase_function.h"

#include <cassert>

#include "phase/function/sphere_table.h"

namespace arcus::phase {

namespace {

template <class Analytic>
Spectrum grey_value(const Analytic& kind, const HalfAngle& angle) {
  return Spectrum::filled(static_cast<float>(kind.value_per_sr(angle)));
}

/// Calls with_analytic(kind) or with_lobe(lobe). A chain of comparisons instead of std::visit, so that both are inlined.
template <class Kinds, class WithAnalytic, class WithLobe>
inline auto choose(const Kinds& kind, WithAnalytic with_analytic, WithLobe with_lobe) {
  if (const auto* lobe = std::get_if<SphereLobe>(&kind)) return with_lobe(*lobe);
  if (const auto* hg = std::get_if<HenyeyGreenstein>(&kind)) return with_analytic(*hg);
  if (const auto* rayleigh = std::get_if<Rayleigh>(&kind)) return with_analytic(*rayleigh);
  return with_analytic(Isotropic());
}

}  // namespace

Spectrum PhaseFunction::value(const Vec3& incoming, const Vec3& outgoing, const Wavelengths& wavelengths) const {
  const HalfAngle angle = half_angle_between(incoming, outgoing);
  return choose(
      kind_, [&](const auto& analytic) { return grey_value(analytic, angle); },
      [&](const SphereLobe& lobe) { return lobe.table->value_per_sr(lobe.size, angle, wavelengths); });
}

bool PhaseFunction::includes_sun_disc() const {
  const auto* lobe = std::get_if<SphereLobe>(&kind_);
  return lobe && lobe->table->includes_sun_disc();
}

Spectrum PhaseFunction::sunlit_value(const Vec3& from_centre, const Vec3& outgoing,
                                     const Wavelengths& wavelengths) const {
  assert(includes_sun_disc());
  const auto* lobe = std::get_if<SphereLobe>(&kind_);
  return lobe->table->sunlit_value_per_sr(lobe->size, half_angle_between(from_centre, outgoing), wavelengths);
}

Draw PhaseFunction::draw(const Vec3& incoming, const Wavelengths& wavelengths, Random& random) const {
  const auto drawn = choose(
      kind_,
      [&](const auto& analytic) {
        const HalfAngle angle = analytic.draw(random.uniform_double());
        return SphereTable::AngleDraw{angle, grey_value(analytic, angle)};
      },
      [&](const SphereLobe& lobe) { return lobe.table->draw(lobe.size, wavelengths, random); });
  return {direction_at(incoming, drawn.angle, random.uniform()), drawn.value_per_sr, drawn.value_per_sr};
}

}  // namespace arcus::phase
