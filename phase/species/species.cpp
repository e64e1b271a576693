#include "phase/species/species.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "phase/base/curve.h"
#include "phase/population/sine_nodes.h"

namespace arcus::phase {
namespace {

constexpr double reference_nm = 550;      // where extinction coefficients are given
constexpr double wavelength_step_nm = 1;  // of cross-sections, which are linear between a table's nodes
constexpr int guide_cells = 256;

Curve row_of(const ScatteringTable& table, const std::vector<double>& values, std::size_t size) {
  const auto row = values.begin() + static_cast<std::ptrdiff_t>(table.row(size, 0));
  return Curve(table.wavelength_nm, {row, row + static_cast<std::ptrdiff_t>(table.wavelength_nm.size())}, "wavelength_nm");
}

}  // namespace

std::vector<double> cross_sections_at_550_nm_m2(const ScatteringTable& table) {
  std::vector<double> result;
  for (std::size_t size = 0; size < table.size_um.size(); ++size)
    result.push_back(row_of(table, table.extinction_cross_section_m2, size)(reference_nm));
  return result;
}

void Species::make_wavelength_grid(double first_nm, double last_nm) {
  wavelength_count_ = std::max(2, static_cast<int>(std::ceil((last_nm - first_nm) / wavelength_step_nm)) + 1);
  first_wavelength_nm_ = first_nm;
  wavelengths_per_nm_ = last_nm > first_nm ? (wavelength_count_ - 1) / (last_nm - first_nm) : 0;
}

Species::Species(const PhaseFunction& function, double exponent) : function_(function), size_um_{1}, log_size_{0} {
  make_wavelength_grid(shortest_wavelength_nm, longest_wavelength_nm);
  for (int i = 0; i < wavelength_count_; ++i) {
    const double nm = first_wavelength_nm_ + i / wavelengths_per_nm_;
    extinction_ratio_.push_back(static_cast<float>(std::pow(nm / reference_nm, exponent)));
  }
  albedo_.assign(extinction_ratio_.size(), 1.0f);
  largest_extinction_ratio_ = *std::max_element(extinction_ratio_.begin(), extinction_ratio_.end());
}

void Species::set_sizes(const std::vector<double>& size_um) {
  size_um_ = size_um;
  for (const double size : size_um_) log_size_.push_back(static_cast<float>(std::log(size)));
  if (size_um_.size() == 1) return;
  const float span = log_size_.back() - log_size_.front();
  guide_scale_ = guide_cells / span;
  for (int cell = 0; cell <= guide_cells; ++cell) {
    const float start = log_size_.front() + span * static_cast<float>(cell) / guide_cells;
    const auto above = std::upper_bound(log_size_.begin() + 1, log_size_.end() - 1, start);
    guide_.push_back(static_cast<unsigned short>(above - log_size_.begin() - 1));
  }
}

Species::Species(std::unique_ptr<const OrientedCrystals> crystals) : oriented_(std::move(crystals)) {
  const std::vector<double>& nm = oriented_->table().wavelength_nm;
  set_sizes(oriented_->table().size_um);
  make_wavelength_grid(nm.front(), nm.back());
  const auto at = [&](int i) { return first_wavelength_nm_ + (wavelengths_per_nm_ > 0 ? i / wavelengths_per_nm_ : 0); };
  constexpr int nodes = sine_node_count;
  directed_extinction_ratio_.resize(nodes);
  for (int size = 0; size < oriented_->size_count(); ++size) {
    for (int node = 0; node < nodes; ++node)
      for (int i = 0; i < wavelength_count_; ++i)
        directed_extinction_ratio_[static_cast<std::size_t>(node)].push_back(
            static_cast<float>(oriented_->extinction_ratio(size, sine_of_node(node), at(i))));
    for (int i = 0; i < wavelength_count_; ++i)
      extinction_ratio_.push_back(static_cast<float>(oriented_->mean_extinction_ratio(size, at(i))));
  }
  // What is absorbed is in the map, and in what is drawn.
  albedo_.assign(extinction_ratio_.size(), 1.0f);
  for (const auto& ratios : directed_extinction_ratio_)
    largest_extinction_ratio_ = std::max(largest_extinction_ratio_, *std::max_element(ratios.begin(), ratios.end()));
}

Species::Species(ScatteringTable table, const SphereTableOptions& options, const std::vector<double>& counted_m2)
    : table_(std::move(table)), lobes_(std::make_unique<const SphereTable>(table_, options)) {
  set_sizes(table_.size_um);
  make_wavelength_grid(table_.wavelength_nm.front(), table_.wavelength_nm.back());
  const std::vector<double> reference_m2 = counted_m2.empty() ? cross_sections_at_550_nm_m2(table_) : counted_m2;
  assert(reference_m2.size() == size_um_.size());
  for (std::size_t size = 0; size < size_um_.size(); ++size) {
    const Curve extinction = row_of(table_, table_.extinction_cross_section_m2, size);
    const Curve scattering = row_of(table_, table_.scattering_cross_section_m2, size);
    const Curve fraction = row_of(table_, table_.forward_fraction, size);
    for (int i = 0; i < wavelength_count_; ++i) {
      const double nm = first_wavelength_nm_ + (wavelengths_per_nm_ > 0 ? i / wavelengths_per_nm_ : 0);
      // What is in no p11 cannot be kept.
      const double f = options.clip_forward_lobe || table_.forward_angle_deg == 0 ? fraction(nm) : 0;
      extinction_ratio_.push_back(static_cast<float>((1 - f) * extinction(nm) / reference_m2[size]));
      const double albedo = (scattering(nm) / extinction(nm) - f) / (1 - f);
      albedo_.push_back(static_cast<float>(std::clamp(albedo, 0.0, 1.0)));
    }
  }
  largest_extinction_ratio_ = *std::max_element(extinction_ratio_.begin(), extinction_ratio_.end());
}

Species::Place Species::place_of(float size_um) const {
  if (log_size_.size() == 1) return {0, 0.0f};
  const float t = std::log(std::max(size_um, 1e-6f));
  if (!(t > log_size_.front())) return {0, 0.0f};
  const int last = static_cast<int>(log_size_.size()) - 2;
  if (t >= log_size_.back()) return {last, 1.0f};
  const int cell = std::min(static_cast<int>((t - log_size_.front()) * guide_scale_), guide_cells);
  int node = guide_[static_cast<std::size_t>(cell)];
  const auto at = [this](int i) { return log_size_[static_cast<std::size_t>(i)]; };
  while (node < last && at(node + 1) <= t) ++node;
  while (node > 0 && at(node) > t) --node;
  return {node, (t - at(node)) / (at(node + 1) - at(node))};
}

Spectrum Species::read(const std::vector<float>& values, Place place, const Wavelengths& wavelengths) const {
  const std::size_t lower = static_cast<std::size_t>(place.node) * static_cast<std::size_t>(wavelength_count_);
  const std::size_t upper = log_size_.size() == 1 ? lower : lower + static_cast<std::size_t>(wavelength_count_);
  Spectrum result;
  for (int i = 0; i < arcus::wavelength_count; ++i) {
    const double position = std::clamp((wavelengths[i] - first_wavelength_nm_) * wavelengths_per_nm_, 0.0,
                                       static_cast<double>(wavelength_count_ - 1));
    const int column = std::min(static_cast<int>(position), wavelength_count_ - 2);
    const float share = static_cast<float>(position - column);
    const float* a = &values[lower + static_cast<std::size_t>(column)];
    const float* b = &values[upper + static_cast<std::size_t>(column)];
    const float low = a[0] + share * (a[1] - a[0]), high = b[0] + share * (b[1] - b[0]);
    result[i] = low + place.share * (high - low);
  }
  return result;
}

Spectrum Species::extinction_ratio(float size_um, const Wavelengths& wavelengths) const {
  return read(extinction_ratio_, place_of(size_um), wavelengths);
}

Spectrum Species::directed_extinction_ratio(float size_um, int sine_node, const Wavelengths& wavelengths) const {
  return read(directed_extinction_ratio_[static_cast<std::size_t>(sine_node)], place_of(size_um), wavelengths);
}

Spectrum Species::albedo(float size_um, const Wavelengths& wavelengths) const {
  return read(albedo_, place_of(size_um), wavelengths);
}

PhaseFunction Species::phase_function(float size_um, float u) const {
  if (!lobes_ && !oriented_) return function_;
  const Place place = place_of(size_um);
  const int node = u < place.share ? place.node + 1 : place.node;
  return lobes_ ? PhaseFunction(SphereLobe{lobes_.get(), node}) : PhaseFunction(OrientedLobe{oriented_.get(), node});
}

double Species::forward_fraction(double size_um, double wavelength_nm) const {
  if (!lobes_) return 0;
  const Place place = place_of(static_cast<float>(size_um));
  const auto at = [&](std::size_t size) {
    const std::size_t count = table_.wavelength_nm.size();
    const auto row = table_.forward_fraction.begin() + static_cast<std::ptrdiff_t>(size * count);
    return Curve(table_.wavelength_nm, {row, row + static_cast<std::ptrdiff_t>(count)}, "wavelength_nm")(wavelength_nm);
  };
  const auto lower = static_cast<std::size_t>(place.node);
  return place.share == 0 ? at(lower) : (1 - place.share) * at(lower) + place.share * at(lower + 1);
}

std::size_t Species::memory_bytes() const {
  const std::size_t table = (table_.p11.size() + table_.p12.size() + table_.p33.size() + table_.p34.size()) * 4 +
                            table_.extinction_cross_section_m2.size() * 32;
  return table + (lobes_ ? lobes_->memory_bytes() : 0) + (oriented_ ? oriented_->memory_bytes() : 0) + (extinction_ratio_.size() + albedo_.size()) * 4;
}

}  // namespace arcus::phase
