#include "src/shape/droplets.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "phase/base/error.h"
#include "phase/base/random.h"
#include "phase/population/size_draw.h"
#include "phase/settings/number_text.h"

namespace arcus::render {
namespace {

constexpr unsigned most_attempts = 100;

/// Bytes that a drop takes, its share of the hierarchy and the latter's building included: 112 of 10⁷ measured (docs/explicit_drops.md).
constexpr double bytes_per_drop = 130;

void check_memory(std::size_t count, const std::string& where) {
  const double have = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  const double need = bytes_per_drop * static_cast<double>(count);
  if (need <= have) return;
  throw cannot(where, number_text(static_cast<double>(count)) + " drops need about " + number_text(std::round(need / 1e8) / 10) + " GB; this machine has " +
                          number_text(std::round(have / 1e8) / 10) + " GB, enough for " + number_text(std::floor(have / bytes_per_drop / 1e5) * 1e5));
}

/// The cubes of space that drops lie in, each as wide as the largest drop.
struct Cubes {
  Vec3 low_m;
  double per_edge;
  std::int64_t count[3];

  std::int64_t number(const std::int64_t (&at)[3]) const { return (at[0] * count[1] + at[1]) * count[2] + at[2]; }
  void place(const Sphere& s, std::int64_t (&at)[3]) const {
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = std::clamp(static_cast<std::int64_t>((s.offset_m()[axis] - low_m[axis]) * per_edge), std::int64_t{0}, count[axis] - 1);
  }
};

Cubes cubes_around(const std::vector<Sphere>& spheres) {
  media::Box box;
  double largest_m = 0;
  for (const Sphere& s : spheres) {
    box.include(s.offset_m());
    largest_m = std::max(largest_m, static_cast<double>(s.radius_m));
  }
  // No more than a million cubes along an edge, so that their numbers stay in range.
  const double edge_m = std::max({2 * largest_m, box.size().x * 1e-6, box.size().y * 1e-6, box.size().z * 1e-6, 1e-12});
  Cubes cubes{box.low, 1 / edge_m, {}};
  for (int axis = 0; axis < 3; ++axis) cubes.count[axis] = static_cast<std::int64_t>(box.size()[axis] / edge_m) + 1;
  return cubes;
}

struct Placed {
  std::int64_t cube;
  std::uint32_t drop;
  bool operator<(const Placed& o) const { return cube != o.cube ? cube < o.cube : drop < o.drop; }
};

/// Whether a drop overlaps with another.
bool overlap(const Sphere& a, const Sphere& b) {
  const double both = static_cast<double>(a.radius_m) + b.radius_m;
  return squared_length(a.offset_m() - b.offset_m()) <= both * both;
}

/// Drops that overlap with one of a smaller number. They are asked in the order of their cubes, so that in each of the nine rows of
/// cubes around, the place of the neighbours only moves on: 10⁷ drops take seconds.
std::vector<std::uint32_t> overlapping(const std::vector<Sphere>& spheres) {
  const Cubes cubes = cubes_around(spheres);
  std::vector<Placed> placed(spheres.size());
  tbb::parallel_for(std::size_t{0}, spheres.size(), [&](std::size_t i) {
    std::int64_t at[3];
    cubes.place(spheres[i], at);
    placed[i] = {cubes.number(at), static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(placed.begin(), placed.end());
  std::vector<char> is_wrong(spheres.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, placed.size(), 10000), [&](const tbb::blocked_range<std::size_t>& range) {
    std::size_t neighbour[9];
    bool is_known[9] = {};
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      const Sphere& drop = spheres[placed[p].drop];
      std::int64_t at[3];
      cubes.place(drop, at);
      for (int row = 0; row < 9; ++row) {
        const std::int64_t x = at[0] + row / 3 - 1, y = at[1] + row % 3 - 1;
        if (x < 0 || y < 0 || x >= cubes.count[0] || y >= cubes.count[1]) continue;
        const std::int64_t low[3] = {x, y, std::max<std::int64_t>(at[2] - 1, 0)}, high[3] = {x, y, std::min(at[2] + 1, cubes.count[2] - 1)};
        const std::int64_t first = cubes.number(low), last = cubes.number(high);
        std::size_t& n = neighbour[row];
        if (!is_known[row]) {
          n = static_cast<std::size_t>(std::lower_bound(placed.begin(), placed.end(), Placed{first, 0}) - placed.begin());
          is_known[row] = true;
        }
        while (n < placed.size() && placed[n].cube < first) ++n;
        for (std::size_t other = n; other < placed.size() && placed[other].cube <= last; ++other)
          if (placed[other].drop < placed[p].drop && overlap(drop, spheres[placed[other].drop])) is_wrong[placed[p].drop] = 1;
      }
    }
  });
  std::vector<std::uint32_t> wrong;
  for (std::size_t i = 0; i < is_wrong.size(); ++i)
    if (is_wrong[i]) wrong.push_back(static_cast<std::uint32_t>(i));
  return wrong;
}

}  // namespace

void list_keys(Keys& keys, DropRadiiSettings& radii) {
  keys.number("effective", radii.effective, above(0), "effective radius <r^3>/<r^2> [um]");
  list_keys(keys, radii.shape);
}

void list_keys(Keys& keys, DropletsSettings& droplets) {
  keys.text("name", droplets.name, "for messages");
  keys.text("medium", droplets.medium,
            "name of a medium of drops that is shown as these drops instead: enlarged, so that they take as much light as all that it means");
  keys.integer("count", droplets.count, between(1, 4e9), "how many drops");
  if (keys.only_if(droplets.medium.empty(), "without a medium")) {
    keys.table("radius_um", droplets.radius_um, "radii of the drops");
    keys.box("box_m", droplets.low_m, droplets.high_m, "where the drops lie, evenly spread, none within another");
    keys.number("scale", droplets.scale, above(0), "multiplies the radii, so that a render can resolve the drops; light fades in them as in the small ones");
    list_index_key(keys, droplets.material);
  }
  list_filter_keys(keys, droplets.material);
  keys.integer("seed", droplets.seed, between(0, 9e15), "another seed, other places");
}

PieceGroup place_drops(std::size_t count, const std::function<DropDraw(std::size_t, unsigned)>& draw, const std::string& where) {
  check_memory(count, where);
  PieceGroup group;
  group.centre_m = count > 0 ? draw(0, 0).centre_m : Vec3(0);
  group.spheres.resize(count);
  const auto set = [&](std::size_t i, unsigned attempt) {
    const DropDraw drop = draw(i, attempt);
    const Vec3 offset = drop.centre_m - group.centre_m;
    group.spheres[i] = {static_cast<float>(offset.x), static_cast<float>(offset.y), static_cast<float>(offset.z), static_cast<float>(drop.radius_m)};
  };
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { set(i, 0); });
  for (unsigned attempt = 1;; ++attempt) {
    const std::vector<std::uint32_t> wrong = overlapping(group.spheres);
    if (wrong.empty()) return group;
    if (attempt == most_attempts)
      throw bad_input(where, std::to_string(wrong.size()) + " of " + std::to_string(count) + " drops without room",
                      "must fill less of the space", "Give fewer or smaller drops, a smaller scale or a larger box");
    for (const std::uint32_t i : wrong) set(i, attempt);
  }
}

PieceGroup drops_in_box(const DropletsSettings& settings, const std::string& where) {
  const phase::SizeDraw radii(phase::Sizes(settings.radius_um.shape, settings.radius_um.effective));
  const auto seed = static_cast<std::uint64_t>(settings.seed);
  const Vec3 size_m = settings.high_m - settings.low_m;
  return place_drops(
      static_cast<std::size_t>(settings.count),
      [&](std::size_t i, unsigned attempt) {
        Random random(seed, i, attempt);
        DropDraw drop;
        drop.radius_m = radii.radius_um(random.uniform_double()) * settings.scale * 1e-6;
        for (int axis = 0; axis < 3; ++axis) {
          const double room = size_m[axis] - 2 * drop.radius_m;
          if (room < 0)
            throw bad_input(where + ": box_m", "a drop of radius " + number_text(drop.radius_m) + " m", "must fit into the box of " + number_text(size_m[axis]) + " m");
          drop.centre_m[axis] = settings.low_m[axis] + drop.radius_m + room * random.uniform_double();
        }
        return drop;
      },
      where);
}

}  // namespace arcus::render
