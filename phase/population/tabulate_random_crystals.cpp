// Randomly oriented crystals. Rays give what leaves them by angle; what diffraction adds and blurs is known in closed form and put on
// top, so that it brings no noise of its own. All wavelengths trace with the same random numbers: what noise is left is grey.

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/normal_quantile.h"
#include "phase/base/units.h"
#include "phase/population/crystal_angles.h"
#include "phase/population/hat_nodes.h"
#include "phase/population/progress.h"
#include "phase/population/shadow_lobe.h"
#include "phase/population/tabulate_crystals.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

/// Parts of the rays at one wavelength: each has its own random numbers and its own sizes.
constexpr int groups = 16;
constexpr long long rays_of_stream = 1 << 22;  // far below what one stream of numbers is good for
constexpr std::uint64_t seed = 0x6372797374616c73;
/// Faces met from inside: as many as leave this share of the light that is deviated in the crystal. What is still there is taken to
/// leave it as the rest does. Thin plates trap light for long.
constexpr double cut_off = 0.005;
constexpr int fewest_events = 12, most_events = 96;
/// Optical thickness along the largest crystal below which what absorption takes is linear in the size, to 1e-5 of the light.
constexpr double thin = 0.005;

/// Sums over rays, in units of the shadow.
struct Traced {
  explicit Traced(std::size_t nodes = 0) : p11(nodes, 0.0), p12(nodes, 0.0) {}
  double undeviated = 0, deviated = 0, absorbed = 0;
  std::vector<double> p11, p12;  ///< [node] of the light that is deviated

  template <class Combine>
  void combine(const Traced& other, const Combine& with) {
    undeviated = with(undeviated, other.undeviated);
    deviated = with(deviated, other.deviated);
    absorbed = with(absorbed, other.absorbed);
    for (std::size_t i = 0; i < p11.size(); ++i) {
      p11[i] = with(p11[i], other.p11[i]);
      p12[i] = with(p12[i], other.p12[i]);
    }
  }
};

int sufficient_events(const CrystalPopulation& crystals, CrystalWave wave) {
  wave.absorption_per_um = 0;
  for (int events = fewest_events; events < most_events; events *= 2) {
    CrystalBeam beam(crystals, wave, events);
    Random random(seed, groups, 0);
    double deviated = 0, inside = 0;
    beam.send(1 << 14, [](Random&) { return Vec3(0, 0, -1); }, random, [&](const CrystalLight& light) {
      if (light.event == 0) inside += light.batch.cut_off(light.ray) * light.shadow_um2;
      if (!light.is_undeviated()) deviated += light.power_um2;
    });
    if (inside < cut_off * deviated) return events;
  }
  return most_events;
}

Traced trace(const CrystalPopulation& crystals, const CrystalWave& wave, int events, long long rays, int group, const HatNodes& nodes) {
  Traced sums(nodes.count());
  CrystalBeam beam(crystals, wave, events);
  const Vec3 incoming(0, 0, -1);
  std::uint32_t stream = 0;
  for (long long sent = 0; sent < rays; ++stream) {
    Random random(seed, static_cast<std::uint64_t>(group), stream);
    sent += beam.send(std::min(rays - sent, rays_of_stream), [&](Random&) { return incoming; }, random, [&](const CrystalLight& light) {
      if (light.event == 0) sums.absorbed += light.batch.absorbed(light.ray) * light.shadow_um2;
      if (light.is_undeviated()) {
        sums.undeviated += light.power_um2;
        return;
      }
      const Vec3 turn = light.outgoing - light.incoming;
      const HatNodes::Place place = nodes.place_of(0.25 * dot(turn, turn));
      const double upper = light.power_um2 * place.share, q = light.batch.light(light.event, light.ray).q * light.shadow_um2;
      sums.deviated += light.power_um2;
      sums.p11[place.node] += light.power_um2 - upper;
      sums.p11[place.node + 1] += upper;
      sums.p12[place.node] += q * (1 - place.share);
      sums.p12[place.node + 1] += q * place.share;
    });
  }
  return sums;
}

void check(const CrystalTableSettings& settings) {
  if (settings.size_um.empty()) throw bad_input("size_um", "no size", "at least one expected");
  for (const double size : settings.size_um)
    if (!(size > 0) || !std::isfinite(size)) throw bad_input("size_um", number_text(size), "must be above 0");
  if (settings.waves.empty()) throw bad_input("wavelength_nm", "no wavelength", "at least one expected");
  for (const CrystalWave& wave : settings.waves) {
    if (!(wave.n > 1) || !std::isfinite(wave.n)) throw bad_input("index", number_text(wave.n), "must be above 1");
    if (!(wave.absorption_per_um >= 0) || !std::isfinite(wave.absorption_per_um))
      throw bad_input("absorption", number_text(wave.absorption_per_um), "must be at least 0");
  }
  if (!(settings.size_spread >= 0 && settings.size_spread <= 1))
    throw bad_input("size_spread", number_text(settings.size_spread), "must be between 0 and 1");
  if (!(settings.rays > 0 && settings.rays <= 1e12)) throw bad_input("rays", number_text(settings.rays), "must be between 0 and 1e12");
}

/// Makes a table from what was traced.
class Assembly {
 public:
  Assembly(const CrystalTableSettings& settings, std::vector<CrystalPopulation> crystals)
      : settings_(settings), crystals_(std::move(crystals)) {
    const auto [least, largest] = std::minmax_element(settings.waves.begin(), settings.waves.end(),
                                                      [](const CrystalWave& a, const CrystalWave& b) { return a.n < b.n; });
    double lobe_deg = 0;
    for (std::size_t size = 0; size < crystals_.size(); ++size)
      if (!removes_forward(size))
        lobe_deg = settings.diffraction ? degrees(SilhouetteDiffraction(crystals_[size].mean_projected_area_um2(),
                                                                        settings.waves.front().wavelength_nm).width_rad())
                                        : 0.5;
    table_.scattering_angle_deg = crystal_angles_deg(crystals_.front(), least->n, largest->n, lobe_deg);
    table_.size_um = settings.size_um;
    for (const CrystalWave& wave : settings.waves) table_.wavelength_nm.push_back(wave.wavelength_nm);
    const std::size_t rows = table_.size_um.size() * table_.wavelength_nm.size(), values = rows * table_.scattering_angle_deg.size();
    for (auto* values_of : {&table_.extinction_cross_section_m2, &table_.scattering_cross_section_m2, &table_.asymmetry, &table_.forward_fraction})
      values_of->assign(rows, 0.0);
    for (auto* element : {&table_.p11, &table_.p12, &table_.p33, &table_.p34}) element->assign(values, 0.0f);
    // A ray of light meets crystals in proportion to their shadows: the square of the size moves a log-normal by 2 σ² in ln size,
    // and the mean of a log-normal lies σ² / 2 above its middle.
    const double variance = settings.size_spread * settings.size_spread;
    scales_ = settings.size_spread > 0 ? log_normal_middles(1.5 * variance, settings.size_spread, groups) : std::vector<double>{1};
    mean_square_ = std::exp(variance);
  }

  const std::vector<double>& angle_deg() const { return table_.scattering_angle_deg; }
  /// Length of the crystals that a group of rays meets over the node's.
  double scale(int group) const { return scales_[static_cast<std::size_t>(group) % scales_.size()]; }
  double largest_scale() const { return scales_.back(); }

  /// Fills the row of a size and a wavelength.
  void set_row(std::size_t size, std::size_t wavelength, const Traced& traced, const HatNodes& nodes) {
    const std::size_t row = table_.row(size, wavelength), first = table_.first(size, wavelength), count = nodes.count();
    // Light cut off counts as the rest.
    const double whole = traced.undeviated + traced.deviated + traced.absorbed;
    const double undeviated = traced.undeviated / whole, deviated = traced.deviated / whole;
    const double diffracted = settings_.diffraction ? 1 : 0;
    const double area_m2 = crystals_[size].mean_projected_area_um2() * mean_square_ * 1e-12;
    const double forward = undeviated + diffracted;
    table_.extinction_cross_section_m2[row] = (1 + diffracted) * area_m2;
    // Written so that without absorption both are equal to the last digit.
    table_.scattering_cross_section_m2[row] = (1 + diffracted - traced.absorbed / whole) * area_m2;
    const bool removes = removes_forward(size);
    table_.forward_fraction[row] = removes ? forward / (1 + diffracted) : 0;

    std::vector<double> p11(count), p12(count);
    for (std::size_t i = 0; i < count; ++i) {
      p11[i] = traced.p11[i] / whole / nodes.solid_angle_sr(i);
      p12[i] = traced.p12[i] / whole / nodes.solid_angle_sr(i);
    }
    if (settings_.diffraction) {
      const ShadowLobe lobe(shadows_of(crystals_[size], scales_), table_.wavelength_nm[wavelength]);
      p11 = lobe.blurred(nodes, p11);
      p12 = lobe.blurred(nodes, p12);
      if (!removes) {
        const std::vector<double> light = lobe.at_nodes(nodes);
        for (std::size_t i = 0; i < count; ++i) p11[i] += forward * light[i] / nodes.solid_angle_sr(i);
      }
    } else if (!removes) {
      p11[0] += undeviated / nodes.solid_angle_sr(0);  // as narrow as the nodes can tell
    }

    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += p11[i] * nodes.solid_angle_sr(i);
    errors_[row] = std::fabs(sum / (deviated + (removes ? 0 : forward)) - 1);
    for (std::size_t i = 0; i < count; ++i) {
      table_.p11[first + i] = static_cast<float>(p11[i] / sum);
      // Blurred apart, they must still be light that exists.
      table_.p12[first + i] = static_cast<float>(std::clamp(p12[i], -p11[i], p11[i]) / sum);
    }
    table_.asymmetry[row] = sphere_integral_of_cosine(table_.scattering_angle_deg, &table_.p11[first]);
  }

  ScatteringTable take() {
    table_.normalisation_error = *std::max_element(errors_.begin(), errors_.end());
    return std::move(table_);
  }
  void begin() { errors_.assign(table_.size_um.size() * table_.wavelength_nm.size(), 0.0); }

 private:
  /// Whether light that goes straight on is in no p11.
  bool removes_forward(std::size_t size) const {
    return settings_.remove_forward && (!settings_.diffraction || is_diffraction_narrow(crystals_[size]));
  }

  const CrystalTableSettings& settings_;
  std::vector<CrystalPopulation> crystals_;
  std::vector<double> scales_;
  double mean_square_ = 1;
  std::vector<double> errors_;  // [row]
  ScatteringTable table_;
};

/// Sizes at which a wavelength is traced: where little is absorbed everything is linear in the size.
std::vector<double> traced_sizes(const std::vector<double>& size_um, double absorption_per_um, double largest_scale) {
  if (size_um.size() == 1 || absorption_per_um == 0) return {size_um.front()};
  if (size_um.back() * largest_scale * absorption_per_um < thin) return {size_um.front(), size_um.back()};
  return size_um;
}

/// That of a size, from the traced ones: one of them or between two.
Traced at_size(const std::vector<double>& sizes, const std::vector<Traced>& traced, double size_um) {
  if (sizes.size() == 1) return traced.front();
  const auto upper = std::clamp<std::size_t>(static_cast<std::size_t>(std::upper_bound(sizes.begin(), sizes.end(), size_um) - sizes.begin()), 1,
                                             sizes.size() - 1);
  const double share = (size_um - sizes[upper - 1]) / (sizes[upper] - sizes[upper - 1]);
  Traced result = traced[upper - 1];
  result.combine(traced[upper], [=](double a, double b) { return a + share * (b - a); });
  return result;
}

}  // namespace

ScatteringTable tabulate_random_crystals(const CrystalTableSettings& settings, const std::function<void(double)>& progress) {
  check(settings);
  std::vector<CrystalPopulation> crystals;
  for (const double size : settings.size_um) crystals.emplace_back(settings.crystals, size);
  // Directions do not depend on the size, and absorption on its product with the size alone: one population serves for all.
  const CrystalPopulation met = crystals.front();
  Assembly assembly(settings, std::move(crystals));
  const HatNodes nodes(assembly.angle_deg());
  assembly.begin();

  // Every shape of a population must be met equally often.
  const double round = 256.0 * static_cast<double>(met.shapes().size());
  const auto rays_of_group = static_cast<long long>(std::ceil(settings.rays / groups / round) * round);
  const int events = sufficient_events(met, settings.waves[settings.waves.size() / 2]);
  std::vector<std::vector<double>> sizes;
  std::size_t jobs = 0;
  for (const CrystalWave& wave : settings.waves) {
    sizes.push_back(traced_sizes(settings.size_um, wave.absorption_per_um, assembly.largest_scale()));
    jobs += sizes.back().size();
  }
  Work work(progress, static_cast<double>(jobs * groups + settings.waves.size()));
  tbb::parallel_for(std::size_t{0}, settings.waves.size(), [&](std::size_t wavelength) {
    std::vector<Traced> traced(sizes[wavelength].size(), Traced(nodes.count()));
    for (std::size_t i = 0; i < traced.size(); ++i) {
      std::vector<Traced> parts(groups);
      tbb::parallel_for(0, groups, [&](int group) {
        CrystalWave wave = settings.waves[wavelength];
        wave.absorption_per_um *= sizes[wavelength][i] / settings.size_um.front() * assembly.scale(group);
        parts[static_cast<std::size_t>(group)] = trace(met, wave, events, rays_of_group, group, nodes);
        work.done(1);
      });
      for (const Traced& part : parts) traced[i].combine(part, [](double a, double b) { return a + b; });
    }
    tbb::parallel_for(std::size_t{0}, settings.size_um.size(), [&](std::size_t size) {
      assembly.set_row(size, wavelength, at_size(sizes[wavelength], traced, settings.size_um[size]), nodes);
    });
    work.done(1);
  });
  return assembly.take();
}

}  // namespace arcus::phase
