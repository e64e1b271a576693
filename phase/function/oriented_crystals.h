#pragma once
// Crystals that lie in the air in a preferred way, as a renderer reads them. Light of the sun is looked up in a map of the sky,
// made for one elevation of the sun; a path of light goes on by tracing a ray through a crystal that it meets, which is an exact
// draw and needs no table. Both are the same function.

#include <memory>
#include <vector>

#include "phase/base/random.h"
#include "phase/base/spectrum.h"
#include "phase/base/vec3.h"
#include "phase/base/wavelengths.h"
#include "phase/crystal/crystal_population.h"
#include "phase/function/large_vector.h"
#include "phase/population/oriented_table.h"
#include "phase/population/tabulate_crystals.h"

namespace arcus::phase {

class OrientedCrystals {
 public:
  /// The table must be that of the settings; without a map (no elevation_deg) there is no sunlit value.
  OrientedCrystals(const CrystalTableSettings& settings, OrientedTable table);
  OrientedCrystals(const OrientedCrystals&) = delete;
  OrientedCrystals& operator=(const OrientedCrystals&) = delete;
  ~OrientedCrystals();

  int size_count() const { return static_cast<int>(table_.size_um.size()); }
  /// What it was made from, without the map's values.
  const OrientedTable& table() const { return table_; }
  bool has_map() const { return !map_.empty(); }

  /// What a renderer counts as stopped (without what goes straight on), over the mean of complete extinction at 550 nm over all
  /// directions; sine_elevation: of the light's direction, its sign doesn't matter.
  double extinction_ratio(int size, double sine_elevation, double wavelength_nm) const;
  /// Its mean over all directions.
  double mean_extinction_ratio(int size, double wavelength_nm) const;

  /// The phase function from `incoming` to the sun's disc, mean over the disc [1/sr], albedo included: what light of the sun that
  /// leaves against `incoming` amounts to, over the extinction in that direction. Directions are those of a path traced backwards
  /// from a viewer; to_centre must be as high as the map's sun.
  Spectrum sunlit_value_per_sr(int size, const Vec3& incoming, const Vec3& to_centre, const Wavelengths& wavelengths) const;

  struct RayDraw {
    Vec3 outgoing;
    float albedo;  ///< what absorption leaves of the light
  };
  /// Where light of a wavelength goes, drawn; what goes straight on is drawn again where the table leaves it out.
  RayDraw draw(int size, const Vec3& incoming, double wavelength_nm, Random& random) const;

  std::size_t memory_bytes() const;

 private:
  struct Node;  // one size
  struct Columns {
    int first[wavelength_count];
    Spectrum share;
  };
  Columns columns_of(const Wavelengths& wavelengths) const;
  Spectrum extinction(int size, double sine_elevation, const Columns& columns) const;

  CrystalTableSettings settings_;
  OrientedTable table_;
  std::vector<std::unique_ptr<const Node>> nodes_;
  std::vector<float> extinction_;      // [size][sine node][wavelength], as extinction_ratio
  LargeVector<std::uint16_t> map_;     // [size][elevation][azimuth][wavelength]: over mean extinction at 550 nm, as half floats [1/sr]
  double elevations_per_deg_ = 0, azimuths_per_deg_ = 0;
};

}  // namespace arcus::phase
