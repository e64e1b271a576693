#include "phase/population/map_rays.h"

#include <algorithm>
#include <cmath>

#include "phase/base/quick_math.h"
#include "phase/base/units.h"
#include "phase/optics/refractive_index.h"

namespace arcus::phase {
namespace {

/// Sizes around the population's, drawn by their areas. With ln s normal around -w^2/2 (mean 1), the mean of s^2 is exp(w^2), and
/// ln s weighted with s^2 is normal around 3/2 w^2.
class SizeSpread {
 public:
  explicit SizeSpread(double spread) : spread_(spread) {}
  double mean_square() const { return std::exp(spread_ * spread_); }
  void draw(RandomColumns& random, Column& factor) const {
    if (spread_ == 0) {
      std::fill_n(factor.values, column_rays, 1.0f);
      return;
    }
    Column u, v;
    random.uniform(u.values, column_rays);
    random.uniform(v.values, column_rays);
    for (int i = 0; i < column_rays; ++i) {
      const double normal = std::sqrt(-2 * quick_logarithm(1 - u[i])) * quick_sine_and_cosine_of_turn(v[i]).cosine;
      factor[i] = static_cast<float>(std::exp(spread_ * (normal + 1.5 * spread_)));
    }
  }

 private:
  double spread_;
};

/// Sums by column, so that loops over rays stay vectors.
struct Sums {
  Column shadow{}, straight{}, absorbed{}, cut_off{};
};

void add(const Sums& sums, double factor, RayAccount& account) {
  for (int i = 0; i < column_rays; ++i) {
    account.shadow += factor * sums.shadow[i];
    account.straight += factor * sums.straight[i];
    account.absorbed += factor * sums.absorbed[i];
    account.cut_off += factor * sums.cut_off[i];
  }
}

void count_rays(const CrystalBatch& batch, Sums& sums) {
  const float* area = batch.projected_areas().data();
  for (int i = 0; i < column_rays; ++i) {
    sums.shadow[i] += area[i];
    sums.absorbed[i] += area[i] * static_cast<float>(batch.absorbed(i));
    sums.cut_off[i] += area[i] * static_cast<float>(batch.cut_off(i));
  }
}

/// Cross-sections of what leaves in an event; light that goes straight on apart.
void weigh(const CrystalShower& shower, int event, bool keep_straight, Column& light, Column& straight) {
  const CrystalBatch& batch = shower.batch();
  const float* area = batch.projected_areas().data();
  const float* power = batch.column(event, CrystalBatch::i).data();
  const float* x = batch.column(event, CrystalBatch::x).data();
  const float* y = batch.column(event, CrystalBatch::y).data();
  const float* z = batch.column(event, CrystalBatch::z).data();
  const VectorColumns& in = shower.incoming();
  for (int i = 0; i < column_rays; ++i) {
    const float dx = x[i] - in.x[i], dy = y[i] - in.y[i], dz = z[i] - in.z[i];
    const bool is_straight = dx * dx + dy * dy + dz * dz < 1e-9f;  // CrystalLight::is_undeviated
    const float weight = power[i] * area[i];
    straight[i] += is_straight ? weight : 0;
    light[i] = is_straight && !keep_straight ? 0 : weight;
  }
}

/// The cell in which a viewer sees light of this direction.
void find_cells(const VectorColumns& light, const SkyGrid& grid, std::int32_t* cell) {
  const auto scale = static_cast<float>(1 / grid.step_rad());
  const std::int32_t row = grid.steps() + 1;
  for (int i = 0; i < column_rays; ++i) {
    const float x = light.x[i], y = light.y[i];
    const float level = std::sqrt(x * x + y * y);
    // Nothing divides by 0 if light comes from straight above.
    const float from_below = quick_angle(level + 1e-30f, light.z[i]);
    const float azimuth = quick_angle(std::fabs(y) + 1e-30f, -x);
    const std::int32_t up = static_cast<std::int32_t>(from_below * scale + 0.5f);
    const std::int32_t around = static_cast<std::int32_t>(azimuth * scale + 0.5f);
    cell[i] = std::min(up, row - 1) * row + std::min(around, row - 1);
  }
}

/// Takes light away whose path does not count.
void keep(const PathFilter& paths, const CrystalBatch& batch, int event, Column& weight) {
  for (int i = 0; i < column_rays; ++i)
    if (weight[i] > 0 && !paths.lets_through(batch.path(event, i))) weight[i] = 0;
}

/// Traces at least that many rays and calls deposit(directions of travel, their cross-sections [um2], event) for each event, and with
/// no_event for diffracted light. Gives their number.
constexpr int no_event = -1;
template <class Deposit>
double trace_rays(CrystalShower& shower, const CrystalWave& wave, const MapOptions& options, const SunLight& sun, double rays,
                  RandomColumns& random, RayAccount& account, const Deposit& deposit) {
  const AiryColumns airy;
  const SizeSpread sizes(options.size_spread);
  const auto x_of_root = static_cast<float>(size_parameter(1, wave.wavelength_nm) / std::sqrt(pi));
  const CrystalBatch& batch = shower.batch();
  const double batches = std::ceil(rays / column_rays);
  const bool filtered = !options.paths.lets_all_through();
  VectorColumns light, crystal, seen;
  Column factor, weight, x;
  AiryColumns::Turns turns;
  for (double sent = 0; sent < batches; ++sent) {
    Sums sums;
    sun.draw(random, light);
    sizes.draw(random, factor);
    shower.trace(light, factor, random);
    count_rays(batch, sums);
    const float* area = batch.projected_areas().data();
    if (options.blur || options.diffracted_light) {
      for (int i = 0; i < column_rays; ++i) x[i] = x_of_root * factor[i] * std::sqrt(area[i]);
      airy.draw(x, random, turns);
    }
    for (int event = 0; event <= shower.events(); ++event) {
      weigh(shower, event, options.keep_straight, weight, sums.straight);
      if (filtered) keep(options.paths, batch, event, weight);
      std::copy_n(batch.column(event, CrystalBatch::x).data(), column_rays, crystal.x.values);
      std::copy_n(batch.column(event, CrystalBatch::y).data(), column_rays, crystal.y.values);
      std::copy_n(batch.column(event, CrystalBatch::z).data(), column_rays, crystal.z.values);
      if (options.blur) turn(turns, crystal);
      shower.orientations().to_world(crystal, seen);
      deposit(seen, weight, event);
    }
    if (options.diffracted_light && options.paths.lets_diffracted_light_through()) {
      std::copy_n(area, column_rays, weight.values);
      turn(turns, light);
      deposit(light, weight, no_event);
    }
    add(sums, sizes.mean_square(), account);
  }
  // Only now, as sums by cell are of the population's own size.
  const double sent = batches * column_rays;
  for (double* mean : {&account.shadow, &account.straight, &account.absorbed, &account.cut_off}) *mean /= sent;
  return sent;
}

}  // namespace

double add_rays(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, const SunLight& sun,
                const SkyGrid& grid, double rays, RandomColumns& random, std::vector<MapCell>& cells, RayAccount& account) {
  CrystalShower shower(crystals, wave, options.events);
  MapCell* map = cells.data();
  std::int32_t cell[column_rays];
  return trace_rays(shower, wave, options, sun, rays, random, account,
                    [&](const VectorColumns& directions, const Column& weight, int) {
                      find_cells(directions, grid, cell);
                      for (int i = 0; i < column_rays; ++i) {
                        if (!(weight[i] > 0)) continue;
                        MapCell& at = map[cell[i]];
                        at.light += weight[i];
                        at.squares += weight[i] * weight[i];
                      }
                    });
}

double add_paths(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, const SunLight& sun,
                 const SkyPlace& place, double rays, RandomColumns& random, LightByPath& paths) {
  CrystalShower shower(crystals, wave, options.events);
  RayAccount account;
  // The sun is above x; clockwise from above turns x against y.
  const double level = std::cos(radians(place.elevation_deg)), azimuth = radians(place.azimuth_deg);
  const auto x = static_cast<float>(level * std::cos(azimuth)), y = static_cast<float>(-level * std::sin(azimuth)),
             z = static_cast<float>(std::sin(radians(place.elevation_deg)));
  const double chord = 2 * std::sin(0.5 * radians(place.radius_deg));
  const auto nearest = static_cast<float>(chord * chord);
  return trace_rays(shower, wave, options, sun, rays, random, account,
                    [&](const VectorColumns& directions, const Column& weight, int event) {
                      for (int i = 0; i < column_rays; ++i) {
                        const float dx = directions.x[i] + x, dy = directions.y[i] + y, dz = directions.z[i] + z;
                        if (!(weight[i] > 0) || dx * dx + dy * dy + dz * dz > nearest) continue;
                        PathLight& light = paths[event == no_event ? FacePath() : shower.batch().path(event, i)];
                        light.light_um2 += weight[i];
                        light.squares_um4 += static_cast<double>(weight[i]) * weight[i];
                        ++light.rays;
                      }
                    });
}

namespace {

VectorColumns parallel_light(double sine_elevation) {
  VectorColumns light;
  for (int i = 0; i < column_rays; ++i) {
    light.x[i] = static_cast<float>(-std::sqrt(std::max(0.0, 1 - sine_elevation * sine_elevation)));
    light.y[i] = 0;
    light.z[i] = static_cast<float>(-sine_elevation);
  }
  return light;
}

}  // namespace

int sufficient_events(const CrystalPopulation& crystals, const CrystalWave& wave, double sine_elevation) {
  constexpr int most = 48, batches = 64;
  constexpr double left = 0.003;
  CrystalShower shower(crystals, wave, most);
  RandomColumns random(0x6576656e7473, 0, 0);
  const VectorColumns light = parallel_light(sine_elevation);
  Column as_they_are;
  std::fill_n(as_they_are.values, column_rays, 1.0f);
  double whole = 0, after[most + 1] = {};  // what leaves at that event
  Column straight{}, ignored;
  for (int sent = 0; sent < batches; ++sent) {
    shower.trace(light, as_they_are, random);
    const CrystalBatch& batch = shower.batch();
    for (int event = 0; event <= most; ++event) {
      weigh(shower, event, true, ignored, straight);
      for (int i = 0; i < column_rays; ++i)
        after[event] += batch.column(event, CrystalBatch::i)[static_cast<std::size_t>(i)] * batch.projected_area(i);
    }
    for (int i = 0; i < column_rays; ++i) whole += batch.projected_area(i) * (1 - batch.absorbed(i));
  }
  double gone = 0, deviated = whole;
  for (const float s : straight.values) deviated -= s;
  for (int event = 0; event < most; ++event) {
    gone += after[event];
    if (whole - gone < left * deviated) return event;
  }
  return most;
}

RayAccount account_of(const CrystalPopulation& crystals, const CrystalWave& wave, const MapOptions& options, double sine_elevation,
                      int rays, RandomColumns& random) {
  CrystalShower shower(crystals, wave, options.events);
  const SizeSpread sizes(options.size_spread);
  const VectorColumns light = parallel_light(sine_elevation);
  Column factor, ignored;
  RayAccount account;
  const int batches = (rays + column_rays - 1) / column_rays;
  for (int sent = 0; sent < batches; ++sent) {
    Sums sums;
    sizes.draw(random, factor);
    shower.trace(light, factor, random);
    count_rays(shower.batch(), sums);
    for (int event = 0; event <= shower.events(); ++event) weigh(shower, event, true, ignored, sums.straight);
    add(sums, sizes.mean_square(), account);
  }
  for (double* mean : {&account.shadow, &account.straight, &account.absorbed, &account.cut_off})
    *mean /= static_cast<double>(batches) * column_rays;
  return account;
}

}  // namespace arcus::phase
