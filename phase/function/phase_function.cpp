#include "phase/function/phase_function.h"

#include <cassert>

#include "phase/function/oriented_crystals.h"
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
  assert(!std::holds_alternative<OrientedLobe>(kind_));
  const HalfAngle angle = half_angle_between(incoming, outgoing);
  return choose(
      kind_, [&](const auto& analytic) { return grey_value(analytic, angle); },
      [&](const SphereLobe& lobe) { return lobe.table->value_per_sr(lobe.size, angle, wavelengths); });
}

bool PhaseFunction::includes_sun_disc() const {
  const auto* lobe = std::get_if<SphereLobe>(&kind_);
  return lobe ? lobe->table->includes_sun_disc() : std::holds_alternative<OrientedLobe>(kind_);
}

Spectrum PhaseFunction::sunlit_value(const Vec3& incoming, const Vec3& to_centre, const Wavelengths& wavelengths) const {
  assert(includes_sun_disc());
  if (const auto* oriented = std::get_if<OrientedLobe>(&kind_))
    return oriented->crystals->sunlit_value_per_sr(oriented->size, incoming, to_centre, wavelengths);
  const auto* lobe = std::get_if<SphereLobe>(&kind_);
  return lobe->table->sunlit_value_per_sr(lobe->size, half_angle_between(incoming, to_centre), wavelengths);
}

Draw PhaseFunction::draw(const Vec3& incoming, const Wavelengths& wavelengths, Random& random) const {
  if (const auto* oriented = std::get_if<OrientedLobe>(&kind_)) {
    const auto ray = oriented->crystals->draw(oriented->size, incoming, wavelengths[0], random);
    return {ray.outgoing, {ray.albedo, 0, 0, 0}, {1, 0, 0, 0}};
  }
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
