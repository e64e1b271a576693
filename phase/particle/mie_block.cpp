#include "phase/particle/mie_block.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "phase/base/error.h"
#include "phase/base/units.h"
#include "phase/particle/cosine_grid.h"
#include "phase/particle/lanes.h"
#include "phase/particle/legendre_to_chebyshev.h"
#include "phase/particle/mie_waves.h"

namespace arcus::phase {
namespace {

static_assert(mie_block_radii == 2 * lanes);
constexpr int taps = CosineGrid::taps;

void require(bool right, const char* what, double found, const char* expected) {
  if (!right) throw bad_input(what, std::to_string(found), expected);
}

// Eight rows of eight numbers to columns: three rounds of exchanging halves, quarters and eighths.
[[gnu::always_inline]] inline void transpose(Floats8 (&m)[8]) {
  Floats8 t[8];
  for (int i = 0; i < 8; i += 2) {
    t[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    t[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4)
    for (int j = i; j < i + 2; ++j) {
      m[j] = __builtin_shufflevector(t[j], t[j + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      m[j + 2] = __builtin_shufflevector(t[j], t[j + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int j = 0; j < 4; ++j) {
    const Floats8 low = __builtin_shufflevector(m[j], m[j + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    m[j + 4] = __builtin_shufflevector(m[j], m[j + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    m[j] = low;
  }
}

// Amplitudes from the grid at all angles, and their products. Lanes are spheres, until squares of
// eight by eight are turned; the result goes to memory in runs of many angles, which costs fewer
// page look-ups. matrix: [count][element][angle].
template <typename Width>
[[gnu::always_inline]] inline void interpolate(std::span<const int> first_rows,
                                               std::span<const float> weights, const float* grid,
                                               int count, float* matrix) {
  using Floats = typename Width::FullFloats;
  constexpr int parts = Width::parts, run = 64;
  Floats8 turned[mie_block_radii][mie_block_elements][run / 8];
  const int angles = static_cast<int>(first_rows.size());
  for (int start = 0; start < angles; start += run) {
    const int here = std::min(run, angles - start);
    for (int group = 0; group < here; group += 8) {
      Floats element[mie_block_elements][8][parts];
      for (int i = 0; i < 8; ++i) {
        const int angle = start + std::min(group + i, here - 1);
        const Floats* rows = reinterpret_cast<const Floats*>(grid) + 4 * parts * first_rows[angle];
        const float* weight = &weights[angle * taps];
        for (int part = 0; part < parts; ++part) {
          Floats re1 = {}, im1 = {}, re2 = {}, im2 = {};  // S1 and S2
          for (int tap = 0; tap < taps; ++tap) {
            const Floats* row = rows + 4 * tap * parts + part;
            const auto share = filled<Floats>(weight[tap]);
            add_product(re1, share, row[0]);
            add_product(im1, share, row[parts]);
            add_product(re2, share, row[2 * parts]);
            add_product(im2, share, row[3 * parts]);
          }
          const Floats power1 = re1 * re1 + im1 * im1, power2 = re2 * re2 + im2 * im2;
          element[0][i][part] = 0.5f * (power2 + power1);
          element[1][i][part] = 0.5f * (power2 - power1);
          element[2][i][part] = re2 * re1 + im2 * im1;
          element[3][i][part] = im2 * re1 - re2 * im1;
        }
      }
      for (int half = 0; half < 2; ++half)
        for (int e = 0; e < mie_block_elements; ++e) {
          Floats8 square[8];
          for (int i = 0; i < 8; ++i)
            square[i] = reinterpret_cast<const Floats8*>(&element[e][i])[half];
          transpose(square);
          for (int i = 0; i < lanes; ++i) turned[half * lanes + i][e][group / 8] = square[i];
        }
    }
    for (int i = 0; i < count; ++i)
      for (int e = 0; e < mie_block_elements; ++e) {
        float* to =
            matrix + (static_cast<std::ptrdiff_t>(i) * mie_block_elements + e) * angles + start;
        if (here == run)
          std::memcpy(to, turned[i][e], run * sizeof(float));  // of known length: a few wide moves
        else
          std::memcpy(to, turned[i][e], here * sizeof(float));
      }
  }
}

void interpolate_avx2(std::span<const int> first_rows, std::span<const float> weights,
                      const float* grid, int count, float* matrix) {
  interpolate<Narrow>(first_rows, weights, grid, count, matrix);
}

[[gnu::target("arch=x86-64-v4")]] void interpolate_avx512(std::span<const int> first_rows,
                                                          std::span<const float> weights,
                                                          const float* grid, int count,
                                                          float* matrix) {
  interpolate<Wide>(first_rows, weights, grid, count, matrix);
}

}  // namespace

// What the spheres of a table share: reciprocals for the recurrences, the conversion of the series,
// and a grid for every length that a series may have.
struct MieAngles::Plan {
  Plan(std::span<const double> angles_rad, double largest)
      : angles(angles_rad.size()),
        largest_size_parameter(largest),
        conversion(mie_block_terms(largest)),
        inverse(mie_block_terms(largest) + 3) {
    for (std::size_t n = 1; n < inverse.size(); ++n) inverse[n] = 1.0 / static_cast<double>(n);
    for (int points = CosineGrid::points_for(0);; points = CosineGrid::points_for(points * 2 / 3)) {
      grids.emplace(points, CosineGrid(points, angles_rad));
      if (points == CosineGrid::points_for(mie_block_terms(largest))) break;
    }
  }

  std::size_t angles;
  double largest_size_parameter;
  LegendreToChebyshev conversion;
  std::vector<double> inverse;
  std::map<int, CosineGrid> grids;  // by number of points
};

MieAngles::MieAngles(std::span<const double> scattering_angles_rad, double largest_size_parameter) {
  require(!scattering_angles_rad.empty(), "scattering angles", 0, "at least one expected");
  require(largest_size_parameter > 0 && largest_size_parameter <= 1e5, "largest size parameter",
          largest_size_parameter, "must be above 0 and at most 1e5");
  for (const double angle : scattering_angles_rad)
    require(angle >= 0 && angle <= pi * (1 + 1e-15), "scattering angle", angle,
            "must be from 0 to pi (radians)");
  plan_ = std::make_unique<const Plan>(scattering_angles_rad, largest_size_parameter);
}

MieAngles::~MieAngles() = default;
MieAngles::MieAngles(MieAngles&&) noexcept = default;
MieAngles& MieAngles::operator=(MieAngles&&) noexcept = default;
std::size_t MieAngles::size() const { return plan_->angles; }
double MieAngles::largest_size_parameter() const { return plan_->largest_size_parameter; }

struct MieBlock::Memory {
  Memory(const MieAngles& shared_angles, Instructions machine_code)
      : Memory(shared_angles, machine_code,
               mie_block_terms(shared_angles.largest_size_parameter())) {}
  Memory(const MieAngles& shared_angles, Instructions machine_code, int terms)
      : angles(&shared_angles),
        instructions(machine_code),
        legendre(LegendreToChebyshev::series_size(terms)),
        chebyshev(LegendreToChebyshev::series_size(terms)),
        work(std::max<std::size_t>(LegendreToChebyshev::scratch_size(terms),
                                   2 * CosineGrid::points_for(terms))),
        amplitudes(CosineGrid::grid_size(CosineGrid::points_for(terms)) * sizeof(float) /
                   (lanes * sizeof(double))) {}

  float* grid_values() const { return reinterpret_cast<float*>(amplitudes.data()); }

  const MieAngles* angles;
  Instructions instructions;
  LaneMemory legendre, chebyshev, work, amplitudes;
  const CosineGrid* grid = nullptr;
  int count = 0;
  SphereEfficiencies efficiencies[mie_block_radii];
};

MieBlock::MieBlock(const MieAngles& angles, Instructions instructions)
    : memory_(std::make_unique<Memory>(angles, instructions)) {}
MieBlock::~MieBlock() = default;
MieBlock::MieBlock(MieBlock&&) noexcept = default;
MieBlock& MieBlock::operator=(MieBlock&&) noexcept = default;

void MieBlock::compute(std::span<const double> size_parameters,
                       std::complex<double> relative_index) {
  const MieAngles::Plan& plan = memory_->angles->plan();
  const double n = relative_index.real(), k = relative_index.imag();
  require(n > 0 && std::isfinite(n), "real part of a relative index", n, "must be above 0");
  require(k >= 0 && std::isfinite(k), "imaginary part of a relative index", k,
          "must be at least 0");
  require(std::abs(relative_index) <= 1e3, "modulus of a relative index", std::abs(relative_index),
          "must be at most 1000");
  for (const double x : size_parameters)
    require(x >= 1e-3 && x <= plan.largest_size_parameter, "size parameter of a sphere", x,
            "must be at least 0.001 and at most what the angles were prepared for");
  assert(!size_parameters.empty() && size_parameters.size() <= mie_block_radii);

  Memory& memory = *memory_;
  memory.count = static_cast<int>(size_parameters.size());
  const double largest = *std::max_element(size_parameters.begin(), size_parameters.end());
  memory.grid = &plan.grids.at(CosineGrid::points_for(mie_block_terms(largest)));
  for (int half = 0; half < 2; ++half) {
    EightSpheres spheres;
    spheres.relative_index = relative_index;
    for (int i = 0; i < lanes; ++i)  // the last one fills the block
      spheres.size_parameter[i] = size_parameters[std::min(half * lanes + i, memory.count - 1)];
    const int terms = spheres.terms();
    legendre_coefficients(spheres, plan.inverse, memory.legendre.data(),
                          memory.efficiencies + half * lanes, memory.instructions);
    plan.conversion.convert(terms, memory.legendre.data(), memory.chebyshev.data(),
                            memory.work.data(), memory.instructions);
    memory.grid->sum(terms, memory.chebyshev.data(), memory.work.data(), memory.grid_values(), half,
                     memory.instructions);
  }
}

std::span<const SphereEfficiencies> MieBlock::efficiencies() const {
  return {memory_->efficiencies, static_cast<std::size_t>(memory_->count)};
}

void MieBlock::matrix(std::size_t first, std::size_t count, std::span<float> matrix) const {
  const Memory& memory = *memory_;
  assert(memory.grid && first + count <= memory.angles->size());
  assert(matrix.size() == memory.count * mie_block_elements * count);
  (memory.instructions == Instructions::avx512 ? interpolate_avx512 : interpolate_avx2)(
      memory.grid->first_rows().subspan(first, count),
      memory.grid->weights().subspan(first * taps, count * taps), memory.grid_values(),
      memory.count, matrix.data());
}

void mie_block(const MieAngles& angles, std::span<const double> size_parameters,
               std::complex<double> relative_index, std::span<float> matrix,
               std::span<SphereEfficiencies> efficiencies, Instructions instructions) {
  const std::size_t row = mie_block_elements * angles.size();
  assert(matrix.size() == size_parameters.size() * row &&
         efficiencies.size() == size_parameters.size());
  MieBlock block(angles, instructions);
  for (std::size_t start = 0; start < size_parameters.size(); start += mie_block_radii) {
    const std::size_t count =
        std::min<std::size_t>(mie_block_radii, size_parameters.size() - start);
    block.compute(size_parameters.subspan(start, count), relative_index);
    block.matrix(0, angles.size(), matrix.subspan(start * row, count * row));
    std::copy_n(block.efficiencies().begin(), count, efficiencies.begin() + start);
  }
}

}  // namespace arcus::phase
