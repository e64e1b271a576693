#include "phase/particle/edge_waves.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "phase/base/units.h"

namespace arcus::phase {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t shortest_log2 = 8, longest_log2 = 18;
// Points on the circle for each point of the transform: at the ends of a band that fills the
// transform, six-point interpolation errs by 1e-3, but there the window has faded.
constexpr std::size_t phases = 4;

/// Last partial wave that matters: beyond, the field decays as exp(-(4/3) (2^(1/3) 4.5)^1.5) =
/// 1e-8.
int last_wave(double x) { return static_cast<int>(std::ceil(x + 4.5 * std::cbrt(x))); }

double squared(ComplexPair p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3]; }

}  // namespace

EdgeWaves::EdgeWaves(std::span<const double> angles_rad)
    : angles_rad_(angles_rad.begin(), angles_rad.end()),
      shift_(longest_log2 + 1),
      powers_(longest_log2 + 1),
      tools_(longest_log2 + 1),
      stencils_(longest_log2 + 1) {
  for (const double angle : angles_rad_)
    block_.push_back(
        static_cast<std::uint16_t>(static_cast<std::size_t>(angle / (2 * pi) * blocks) % blocks));
}

const EdgeWaves::Tools& EdgeWaves::tools_for(std::size_t log2) {
  Tools& tools = tools_[log2];
  if (!tools.transform) {
    tools.transform = std::make_shared<const PairTransform>(std::size_t{1} << log2);
    const std::size_t circle = phases << log2;
    for (std::size_t j = 0; j < circle; ++j)
      tools.fine_roots.push_back(
          std::polar(1.0, 2 * pi * static_cast<double>(j) / static_cast<double>(circle)));
  }
  return tools;
}

void EdgeWaves::prepare_stencils(std::size_t log2) {
  if (!stencils_[log2].empty()) return;
  const std::size_t circle = phases << log2;
  stencils_[log2].resize(angles_rad_.size());
  for (std::size_t a = 0; a < angles_rad_.size(); ++a) {
    const double place = angles_rad_[a] * (static_cast<double>(circle) / (2 * pi)),
                 whole = std::floor(place);
    const double t = place - whole + 2;
    Stencil& stencil = stencils_[log2][a];
    stencil.first = static_cast<std::uint32_t>(static_cast<std::size_t>(whole) + circle - 2);
    for (int i = 0; i < 6; ++i) {
      double weight = 1;
      for (int j = 0; j < 6; ++j)
        if (j != i) weight *= (t - j) / (i - j);
      stencil.weight[static_cast<std::size_t>(i)] = weight;
    }
  }
}

/// The carrier in the middle of a transform whose band ends at `last`.
std::size_t EdgeWaves::carrier_for(int last, std::size_t log2) {
  const auto find = [this](int centre) {
    std::size_t i = 0;
    while (i < carriers_used_ && carriers_[i].centre != centre) ++i;
    return i;
  };
  const auto add = [this](int centre) -> Carrier& {
    if (carriers_used_ == carriers_.size()) carriers_.emplace_back();
    Carrier& carrier = carriers_[carriers_used_++];
    carrier.centre = centre;
    carrier.value.resize(angles_rad_.size());
    return carrier;
  };
  // One carrier at the end of the band from sines and cosines, those of the transforms by turning
  // it by powers of two.
  std::size_t end = find(last);
  if (end == carriers_used_) {
    Carrier& carrier = add(last);
    for (std::size_t a = 0; a < angles_rad_.size(); ++a)
      carrier.value[a] = std::polar(1.0, (last + 0.5) * angles_rad_[a]);
  }
  const int half = 1 << (log2 - 1);
  const std::size_t found = find(last - half);
  if (found < carriers_used_) return found;
  std::vector<Complex>& shift = shift_[log2 - 1];
  if (shift.empty())
    for (const double angle : angles_rad_) shift.push_back(std::polar(1.0, -half * angle));
  Carrier& carrier = add(last - half);
  const std::vector<Complex>& base = carriers_[end].value;
  for (std::size_t a = 0; a < angles_rad_.size(); ++a) carrier.value[a] = base[a] * shift[a];
  return carriers_used_ - 1;
}

void EdgeWaves::transform(std::span<const ComplexPair> terms, int first, Strip& strip) {
  std::size_t log2 = shortest_log2;
  while ((std::size_t{1} << log2) < terms.size()) ++log2;
  assert(log2 <= longest_log2);
  const std::size_t length = std::size_t{1} << log2, circle = phases * length;
  prepare_stencils(log2);
  // Counted from the last wave, so that orders whose bands are of like length share a carrier.
  const int last = first + static_cast<int>(terms.size()) - 1;
  strip.transform = log2;
  strip.carrier = carrier_for(last, log2);
  const int centre = carriers_[strip.carrier].centre;
  strip.sums.resize(circle);
  const Tools& tools = tools_for(log2);
  // The points phases j + r of the circle are the transform of the terms turned by exp(2 pi i k r /
  // circle).
  const auto place_of = [&](std::size_t i) {
    return static_cast<std::size_t>(first + static_cast<int>(i) - centre +
                                    static_cast<int>(circle));
  };
  for (std::size_t r = 0; r < phases; ++r) {
    data_.assign(length, ComplexPair{});
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const std::size_t k = place_of(i);
      data_[k & (length - 1)] =
          r == 0 ? terms[i] : times(terms[i], tools.fine_roots[(k * r) & (circle - 1)]);
    }
    tools.transform->run(data_.data(), strip.sums.data() + r * length);
  }
}

/// Largest |F|^2 in each block of the circle and the two on either side of it.
void EdgeWaves::find_bounds(Strip& strip) const {
  static_assert(phases == 4 && blocks == 256 &&
                (phases << shortest_log2) >= 4 * blocks);  // a stencil fits into those blocks
  const std::size_t length = std::size_t{1} << strip.transform, per_block = length / blocks;
  std::array<double, blocks> largest{};
  for (std::size_t r = 0; r < phases; ++r)
    for (std::size_t block = 0; block < blocks; ++block)
      for (std::size_t j = 0; j < per_block; ++j)
        largest[block] =
            std::max(largest[block], squared(strip.sums[r * length + block * per_block + j]));
  for (std::size_t i = 0; i < blocks; ++i)
    strip.bound[i] =
        std::max({largest[(i + blocks - 2) % blocks], largest[(i + blocks - 1) % blocks],
                  largest[i], largest[(i + 1) % blocks], largest[(i + 2) % blocks]});
}

void EdgeWaves::sum(double x, Complex m, std::span<const EdgeWindow> windows,
                    std::span<const RaysOfOrder> rays) {
  assert(windows.size() == rays.size());
  softness_ = std::cbrt(x);
  const int last = last_wave(x);
  const auto first_of = [&](const EdgeWindow& window) {
    return std::max(1, static_cast<int>(std::floor(x * std::sin(window.begin_rad()))));
  };
  int first = last;
  for (const EdgeWindow& window : windows) first = std::min(first, first_of(window));
  waves_ = phase::partial_waves(x, m, first, last);
  carriers_used_ = 0;
  for (auto& power : powers_) power.clear();

  const std::size_t orders = windows.size(), count = waves_.perpendicular.size();
  strips_.resize(2 * orders);
  forward_.assign(orders, Moments{});
  backward_.assign(orders, Moments{});
  incidence_rad_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    incidence_rad_[i] = std::asin(std::min(1.0, (first + static_cast<double>(i) + 0.5) / x));
  power_.resize(count);  // passed_through reflected_inside^(p - 1)
  for (std::size_t p = 0; p < orders; ++p) {
    for (std::size_t i = 0; i < count; ++i) {
      const SurfaceTerms &s = waves_.perpendicular[i], &t = waves_.parallel[i];
      if (p == 1) power_[i] = make_pair_of(s.passed_through, t.passed_through);
      if (p > 1)
        power_[i] = product(power_[i], make_pair_of(s.reflected_inside, t.reflected_inside));
    }
    const EdgeWindow& window = windows[p];
    const bool as_power = p >= first_weak_order;
    const int begin = first_of(window);
    terms_.resize(static_cast<std::size_t>(last - begin + 1));
    for (int l = begin; l <= last; ++l) {
      const double wave = l + 0.5, sine = wave / x;
      const auto i = static_cast<std::size_t>(l - first);
      const bool whole = window.everything || sine >= window.whole_from_sine;
      double share = whole ? 1 : window.value_at(incidence_rad_[i]);
      if (as_power) share = std::sqrt(share);
      ComplexPair c = power_[i] * -share;
      if (p == 0) {
        const double disc = 0.5 * std::erfc((wave - x) / (std::sqrt(2.0) * softness_));
        c = make_pair_of(1 - disc - share * waves_.perpendicular[i].reflected_outside,
                         1 - disc - share * waves_.parallel[i].reflected_outside);
      }
      terms_[static_cast<std::size_t>(l - begin)] = c * std::sqrt(wave);
      const ComplexPair moment = c * wave, slope = moment * ((wave - x) / x);
      forward_[p].zeroth += moment;
      forward_[p].first += slope;
      const double sign = l % 2 == 0 ? 1 : -1;
      backward_[p].zeroth += moment * sign;
      backward_[p].first += slope * sign;
    }
    Strip &inside = strips_[2 * p + inner], &outside = strips_[2 * p + outer];
    inside.transform = outside.transform = 0;
    if (!window.bow_inside || as_power) {
      transform(terms_, begin, outside);
      if (as_power)
        add_power(outside);
      else
        find_bounds(outside);
      continue;
    }
    // The cut through the bow is as soft as half the Airy zone, within which its two rays are one.
    const double bow = *rays[p].bow_incidence_rad(), cosine = std::cos(bow),
                 bow_wave = x * std::sin(bow);
    const double softness =
        0.5 * std::cbrt(x * x * cosine * cosine / std::fabs(rays[p].turned_curvature(bow)));
    const int low = std::clamp(static_cast<int>(bow_wave - 3 * softness), begin, last);
    const int high = std::clamp(static_cast<int>(bow_wave + 3 * softness), begin, last);
    part_.assign(terms_.begin() + (low - begin), terms_.end());
    for (int l = low; l <= high; ++l) {
      const double beyond = 0.5 * std::erfc((bow_wave - l - 0.5) / softness);
      part_[static_cast<std::size_t>(l - low)] *= beyond;
      terms_[static_cast<std::size_t>(l - begin)] *= 1 - beyond;
    }
    terms_.resize(static_cast<std::size_t>(high - begin + 1));
    transform(terms_, begin, inside);
    transform(part_, low, outside);
    find_bounds(inside);
    find_bounds(outside);
  }
}

void EdgeWaves::add_power(const Strip& strip) {
  std::vector<ComplexPair>& power = powers_[strip.transform];
  if (power.empty()) power.assign(strip.sums.size(), ComplexPair{});
  for (std::size_t j = 0; j < power.size(); ++j) {
    const ComplexPair f = strip.sums[j], square = f * f;
    power[j] += ComplexPair{square[0] + square[1], square[2] + square[3], f[2] * f[0] + f[3] * f[1],
                            f[3] * f[0] - f[2] * f[1]};
  }
}

std::array<std::size_t, 6> EdgeWaves::places(const Stencil& stencil, std::size_t log2,
                                             int side) const {
  const std::size_t length = std::size_t{1} << log2, mask = phases * length - 1;
  std::array<std::size_t, 6> result;
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t place =
        (side > 0 ? stencil.first + k : 2 * (mask + 1) - stencil.first - k) & mask;
    result[k] = (place & (phases - 1)) * length + place / phases;
  }
  return result;
}

EdgeWaves::Power EdgeWaves::power(std::size_t angle, int side) const {
  ComplexPair sum{};
  for (std::size_t log2 = shortest_log2; log2 <= longest_log2; ++log2) {
    if (powers_[log2].empty()) continue;
    const Stencil& stencil = stencils_[log2][angle];
    const auto place = places(stencil, log2, side);
    for (std::size_t k = 0; k < 6; ++k) sum += powers_[log2][place[k]] * stencil.weight[k];
  }
  return {std::max(sum[0], 0.0), std::max(sum[1], 0.0), {sum[2], sum[3]}};
}

double EdgeWaves::bound(int order, Branch branch, std::size_t angle, int side) const {
  const Strip& strip = strip_of(order, branch);
  if (strip.transform == 0) return 0;
  return strip.bound[side > 0 ? block_[angle] : (blocks - block_[angle]) % blocks];
}

ComplexPair EdgeWaves::value(int order, Branch branch, std::size_t angle, int side) const {
  const Strip& strip = strip_of(order, branch);
  const Stencil& stencil = stencils_[strip.transform][angle];
  const auto place = places(stencil, strip.transform, side);
  ComplexPair sum{};
  for (std::size_t k = 0; k < 6; ++k) sum += strip.sums[place[k]] * stencil.weight[k];
  const Complex carrier = carriers_[strip.carrier].value[angle];
  return times(sum, side > 0 ? carrier : std::conj(carrier));
}

}  // namespace arcus::phase
