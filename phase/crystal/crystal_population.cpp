#include "phase/crystal/crystal_population.h"

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/normal_quantile.h"
#include "phase/base/units.h"
#include "phase/crystal/silhouette_diffraction.h"
#include "phase/optics/refractive_index.h"
#include "phase/settings/number_text.h"

namespace arcus::phase {
namespace {

constexpr int spread_shapes = 32;

}  // namespace

CrystalSettings crystals_of_habit(const std::string& name) {
  // Ratios as in C. A. Tricker, Ice Crystal Haloes (1979), and W. Tape (1994): thin plates, columns two to three times
  // as long as wide. Pyramidal crystals that make odd-radius halos tumble.
  CrystalSettings crystal;
  crystal.name = name;
  HabitSettings& habit = crystal.habit;
  OrientationSettings& lies = crystal.orientation;
  const PyramidSettings whole{.height = 1}, cut{.height = 0.7};
  if (name == "plate") {
    habit.aspect_ratio = 0.1;
    lies.type = "plate";
  } else if (name == "column") {
    habit.aspect_ratio = 2.5;
    lies.type = "column";
  } else if (name == "needle") {
    habit.aspect_ratio = 10;
    lies.type = "column";
  } else if (name == "prism") {
    habit.aspect_ratio = 1;
    lies.type = "random";
  } else if (name == "pyramid") {
    habit.aspect_ratio = 0.5;
    habit.upper = habit.lower = cut;
    lies.type = "random";
  } else if (name == "bullet") {
    habit.aspect_ratio = 2;
    habit.upper = whole;
    lies.type = "column";
  } else if (name == "triangle") {
    habit.aspect_ratio = 0.1;
    habit.side_distances = {1, 2, 1, 2, 1, 2};
    lies.type = "plate";
  } else {
    throw bad_input("habit", "'" + name + "'", "must be plate, column, needle, prism, pyramid, bullet or triangle");
  }
  return crystal;
}

void list_keys(Keys& keys, CrystalSettings& crystal) {
  const std::string before = crystal.name;
  keys.choice("habit", crystal.name, {"plate", "column", "needle", "prism", "pyramid", "bullet", "triangle"},
              "shape, and how the crystals lie: the defaults of the keys that follow");
  if (crystal.name != before) crystal = crystals_of_habit(crystal.name);
  list_keys(keys, crystal.habit);
  keys.number("aspect_spread", crystal.aspect_spread, between(0, 2),
              "standard deviation of the logarithm of the aspect ratio");
  keys.table("orientation", crystal.orientation, "how the crystals lie");
}

CrystalPopulation::CrystalPopulation(const CrystalSettings& settings, double maximum_dimension_um)
    : orientations_(settings.orientation) {
  const double spread = settings.aspect_spread;
  if (!(spread >= 0 && spread <= 2))
    throw bad_input("aspect_spread", number_text(spread), "must be between 0 and 2");
  const int count = spread > 0 ? spread_shapes : 1;
  for (int i = 0; i < count; ++i) {
    HabitSettings habit = settings.habit;
    if (count > 1) habit.aspect_ratio *= std::exp(spread * normal_quantile((i + 0.5) / count));
    shapes_.push_back(make_crystal(habit, maximum_dimension_um));
    // No shadow is larger than half of the surface.
    largest_shadow_um2_ = std::max(largest_shadow_um2_, 0.5 * shapes_.back().surface());
  }
}

double CrystalPopulation::mean_projected_area_um2() const {
  double sum = 0;
  for (const CrystalShape& shape : shapes_) sum += shape.mean_projected_area();
  return sum / static_cast<double>(shapes_.size());
}

CrystalPopulation::Lying CrystalPopulation::draw_any(Random& random) const {
  const auto which =
      static_cast<std::size_t>(random.uniform() * static_cast<float>(shapes_.size()));
  return {shapes_[which], orientations_.draw(random)};
}

CrystalPopulation::Lying CrystalPopulation::draw_met(const Vec3& incoming, Random& random) const {
  while (true) {
    const Lying lying = draw_any(random);
    const double shadow = lying.shape.projected_area(lying.orientation.to_crystal(incoming));
    if (random.uniform_double() * largest_shadow_um2_ < shadow) return lying;
  }
}

std::optional<CrystalExit> CrystalPopulation::draw(const Vec3& incoming, double n,
                                                   double absorption_per_um, Random& random) const {
  const Lying lying = draw_met(incoming, random);
  const Vec3 light = lying.orientation.to_crystal(incoming);
  const CrystalRays tracer(lying.shape, n, absorption_per_um);
  auto exit = tracer.draw(light, tracer.entry(light, random), random);
  if (exit) {
    exit->direction = lying.orientation.to_world(exit->direction);
    exit->place = lying.orientation.to_world(exit->place);
  }
  return exit;
}

double crystal_size_factor(double size_spread, Random& random) {
  if (size_spread == 0) return 1;
  const double u = random.uniform_double(), v = random.uniform_double();
  const double normal = std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * pi * v);
  // exp(m + s z) has the mean 1 for m = -s^2 / 2; weights of size^2 shift z by 2 s.
  return std::exp(size_spread * (normal + 1.5 * size_spread));
}

bool is_diffraction_narrow(const CrystalPopulation& crystals) {
  return SilhouetteDiffraction(crystals.mean_projected_area_um2(), 550).width_rad() < radians(0.36);
}

double absorption_per_um(double k, double vacuum_wavelength_nm) {
  return 4 * pi * k * air_index(vacuum_wavelength_nm) / um_from_nm(vacuum_wavelength_nm);
}

}  // namespace arcus::phase
