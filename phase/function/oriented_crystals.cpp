#include "phase/function/oriented_crystals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/curve.h"
#include "phase/base/frame.h"
#include "phase/base/half_float.h"
#include "phase/base/units.h"
#include "phase/crystal/silhouette_diffraction.h"
#include "phase/function/half_angle.h"
#include "phase/population/sine_nodes.h"

namespace arcus::phase {
namespace {

constexpr double reference_nm = 550;

/// Of values over an ascending axis, linear between, at its ends beyond.
double interpolated(const std::vector<double>& axis, const double* values, std::size_t stride, double x) {
  if (axis.size() == 1 || x <= axis.front()) return values[0];
  if (x >= axis.back()) return values[(axis.size() - 1) * stride];
  const auto above = static_cast<std::size_t>(std::upper_bound(axis.begin(), axis.end(), x) - axis.begin());
  const double share = (x - axis[above - 1]) / (axis[above] - axis[above - 1]);
  return values[(above - 1) * stride] * (1 - share) + values[above * stride] * share;
}

Vec3 deflected(const Vec3& direction, double shadow_um2, double wavelength_nm, Random& random) {
  const double s = SilhouetteDiffraction(shadow_um2, wavelength_nm).draw_sin2_half(random.uniform_double());
  return direction_at(direction, HalfAngle{s, 1 - s}, random.uniform_double());
}

}  // namespace

struct OrientedCrystals::Node {
  CrystalPopulation crystals;
  bool leaves_out_diffraction;

  Node(const CrystalTableSettings& settings, double size_um)
      : crystals(settings.crystals, size_um),
        leaves_out_diffraction(settings.remove_forward && is_diffraction_narrow(crystals)) {}
};

OrientedCrystals::OrientedCrystals(const CrystalTableSettings& settings, OrientedTable table)
    : settings_(settings), table_(std::move(table)) {
  for (const double size : table_.size_um) nodes_.push_back(std::make_unique<const Node>(settings_, size));
  const std::size_t waves = table_.wavelength_nm.size();
  for (int size = 0; size < size_count(); ++size)
    for (int i = 0; i < sine_node_count; ++i)
      for (const double nm : table_.wavelength_nm)
        extinction_.push_back(static_cast<float>(extinction_ratio(size, sine_of_node(i), nm)));
  if (table_.elevation_deg.size() < 2) return;

  elevations_per_deg_ = static_cast<double>(table_.elevation_deg.size() - 1) / (table_.elevation_deg.back() - table_.elevation_deg.front());
  azimuths_per_deg_ = static_cast<double>(table_.azimuth_deg.size() - 1) / (table_.azimuth_deg.back() - table_.azimuth_deg.front());
  map_.resize(table_.scattering_m2_per_sr.size());
  const std::size_t cells = table_.elevation_deg.size() * table_.azimuth_deg.size();
  for (std::size_t size = 0; size < table_.size_um.size(); ++size) {
    const double mean = interpolated(table_.wavelength_nm, &table_.mean_extinction_cross_section_m2[size * waves], 1, reference_nm);
    const auto scale = static_cast<float>(1 / mean);
    const std::size_t first = size * cells * waves;
    tbb::parallel_for(std::size_t{0}, table_.elevation_deg.size(), [&](std::size_t row) {
      const std::size_t length = table_.azimuth_deg.size() * waves, begin = first + row * length;
      for (std::size_t i = begin; i < begin + length; ++i) map_[i] = half_bits(table_.scattering_m2_per_sr[i] * scale);
    });
  }
  table_.scattering_m2_per_sr = {};
  table_.relative_error = {};
}

OrientedCrystals::~OrientedCrystals() = default;

double OrientedCrystals::extinction_ratio(int size, double sine_elevation, double wavelength_nm) const {
  const std::size_t waves = table_.wavelength_nm.size(), sines = table_.sine_elevation.size();
  const auto row = static_cast<std::size_t>(size) * waves;
  std::vector<double> stopped;
  for (std::size_t w = 0; w < waves; ++w) {
    const double* all = &table_.extinction_cross_section_m2[(row + w) * sines];
    const double* forward = &table_.forward_fraction[(row + w) * sines];
    const double x = std::fabs(sine_elevation);
    stopped.push_back(interpolated(table_.sine_elevation, all, 1, x) * (1 - interpolated(table_.sine_elevation, forward, 1, x)));
  }
  return interpolated(table_.wavelength_nm, stopped.data(), 1, wavelength_nm) /
         interpolated(table_.wavelength_nm, &table_.mean_extinction_cross_section_m2[row], 1, reference_nm);
}

double OrientedCrystals::mean_extinction_ratio(int size, double wavelength_nm) const {
  // All sines of elevation are equally likely for random directions; linear between the nodes.
  double sum = 0, before = extinction_ratio(size, 0, wavelength_nm);
  for (int i = 1; i < sine_node_count; ++i) {
    const double here = extinction_ratio(size, sine_of_node(i), wavelength_nm);
    sum += 0.5 * (before + here) * (sine_of_node(i) - sine_of_node(i - 1));
    before = here;
  }
  return sum;
}

OrientedCrystals::Columns OrientedCrystals::columns_of(const Wavelengths& wavelengths) const {
  const std::vector<double>& nm = table_.wavelength_nm;
  Columns columns{};
  if (nm.size() == 1) return columns;
  const auto last = nm.size() - 2;
  for (int i = 0; i < wavelength_count; ++i) {
    const double x = std::clamp(static_cast<double>(wavelengths[i]), nm.front(), nm.back());
    // Nodes are mostly even: the guess is right or next to it.
    auto at = std::min(static_cast<std::size_t>((x - nm.front()) / (nm.back() - nm.front()) * static_cast<double>(nm.size() - 1)), last);
    while (at > 0 && nm[at] > x) --at;
    while (at < last && nm[at + 1] <= x) ++at;
    columns.first[i] = static_cast<int>(at);
    columns.share[i] = static_cast<float>((x - nm[at]) / (nm[at + 1] - nm[at]));
  }
  return columns;
}

Spectrum OrientedCrystals::extinction(int size, double sine_elevation, const Columns& columns) const {
  const std::size_t waves = table_.wavelength_nm.size();
  const double sine = std::min(std::fabs(sine_elevation), 1.0);
  const int node = node_below_sine(sine);
  const auto share = static_cast<float>((sine - sine_of_node(node)) / (sine_of_node(node + 1) - sine_of_node(node)));
  const float* low = &extinction_[(static_cast<std::size_t>(size) * sine_node_count + static_cast<std::size_t>(node)) * waves];
  const float* high = low + waves;
  const std::size_t step = waves > 1 ? 1 : 0;
  Spectrum first, second;
  for (int i = 0; i < wavelength_count; ++i) {
    const auto c = static_cast<std::size_t>(columns.first[i]);
    first[i] = low[c] + share * (high[c] - low[c]);
    second[i] = low[c + step] + share * (high[c + step] - low[c + step]);
  }
  return first + (second - first) * columns.share;
}

Spectrum OrientedCrystals::sunlit_value_per_sr(int size, const Vec3& incoming, const Vec3& to_centre,
                                               const Wavelengths& wavelengths) const {
  assert(has_map());
  const double across = incoming.x * to_centre.y - incoming.y * to_centre.x;
  const double along = incoming.x * to_centre.x + incoming.y * to_centre.y;
  const double azimuth_deg = degrees(std::atan2(std::fabs(across), along));
  const double elevation_deg = degrees(std::atan2(incoming.z, std::hypot(incoming.x, incoming.y)));

  const std::size_t waves = table_.wavelength_nm.size(), azimuths = table_.azimuth_deg.size(), elevations = table_.elevation_deg.size();
  const auto place = [](double x, double per_deg, std::size_t count, float& share) {
    const double at = std::clamp(x * per_deg, 0.0, static_cast<double>(count - 1));
    const std::size_t node = std::min(static_cast<std::size_t>(at), count - 2);
    share = static_cast<float>(at - static_cast<double>(node));
    return node;
  };
  float up, aside;
  const std::size_t row = place(elevation_deg - table_.elevation_deg.front(), elevations_per_deg_, elevations, up);
  const std::size_t column = place(azimuth_deg, azimuths_per_deg_, azimuths, aside);
  const std::uint16_t* cell = &map_[((static_cast<std::size_t>(size) * elevations + row) * azimuths + column) * waves];
  const std::size_t step = waves > 1 ? 1 : 0;
  const Columns columns = columns_of(wavelengths);
  Spectrum value;
  const auto add = [&](const std::uint16_t* values, float weight) {
    Spectrum low, high;
    for (int i = 0; i < wavelength_count; ++i) {
      low[i] = float_of_half(values[columns.first[i]]);
      high[i] = float_of_half(values[static_cast<std::size_t>(columns.first[i]) + step]);
    }
    value += (low + (high - low) * columns.share) * weight;
  };
  add(cell, (1 - up) * (1 - aside));
  add(cell + waves, (1 - up) * aside);
  add(cell + azimuths * waves, up * (1 - aside));
  add(cell + azimuths * waves + waves, up * aside);
  return value / extinction(size, incoming.z, columns);
}

OrientedCrystals::RayDraw OrientedCrystals::draw(int size, const Vec3& incoming, double wavelength_nm, Random& random) const {
  const Node& node = *nodes_[static_cast<std::size_t>(size)];
  // Between the nodes of wavelengths the index is straight to 4e-5 where they are 20 nm apart.
  const std::vector<CrystalWave>& waves = settings_.waves;
  std::size_t low = 0;
  while (low + 2 < waves.size() && waves[low + 1].wavelength_nm <= wavelength_nm) ++low;
  const std::size_t high = std::min(low + 1, waves.size() - 1);
  const double width = waves[high].wavelength_nm - waves[low].wavelength_nm;
  const double share = width > 0 ? std::clamp((wavelength_nm - waves[low].wavelength_nm) / width, 0.0, 1.0) : 0;
  const double n = std::lerp(waves[low].n, waves[high].n, share);
  const double absorption = std::lerp(waves[low].absorption_per_um, waves[high].absorption_per_um, share);

  const bool keeps_diffraction = settings_.diffraction && !node.leaves_out_diffraction;
  while (true) {
    const CrystalPopulation::Lying lying = node.crystals.draw_met(incoming, random);
    const Vec3 light = lying.orientation.to_crystal(incoming);
    const double factor = crystal_size_factor(settings_.size_spread, random);
    const double shadow = lying.shape.projected_area(light) * factor * factor;
    if (keeps_diffraction && random.uniform() < 0.5f) return {deflected(incoming, shadow, wavelength_nm, random), 1};
    const CrystalRays tracer(lying.shape, n, absorption * factor);
    const auto exit = tracer.draw(light, tracer.entry(light, random), random);
    if (!exit) return {incoming, 0};
    const Vec3 outgoing = lying.orientation.to_world(exit->direction);
    const bool is_undeviated = squared_length(outgoing - incoming) < 1e-9;
    // Where diffraction is kept, light that goes straight on is blurred with the rest.
    if (is_undeviated && settings_.remove_forward && !keeps_diffraction) continue;
    return {settings_.diffraction ? deflected(outgoing, shadow, wavelength_nm, random) : outgoing, static_cast<float>(exit->light.i)};
  }
}

std::size_t OrientedCrystals::memory_bytes() const { return map_.size() * sizeof(std::uint16_t) + extinction_.size() * sizeof(float); }

}  // namespace arcus::phase
