#pragma once
// What becomes a picture: sums, counts and, on request, squares and spectral bins of every pixel.

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "phase/base/spectrum.h"
#include "phase/base/wavelengths.h"
#include "phase/settings/keys.h"
#include "src/film/colour.h"
#include "src/film/image.h"

namespace arcus::render {

struct FilmSettings {
  double exposure_ev = 0;      ///< of the PNG, in stops; the EXR is never exposed
  std::string adaptation = "day";  ///< of the PNG: day | night; the EXR is what it is
  std::string white = "auto";  ///< auto | D65 | equal_energy | a temperature in K; see white_of
  std::vector<std::string> channels{
      "rgb"};                    ///< rgb | xyz | variance | spectral, any number of them
  long long spectral_bins = 20;  ///< of equal width over 380 to 780 nm
};
void list_keys(Keys& keys, FilmSettings& film);

/// Samples that were not finite and were left out.
struct RefusedSamples {
  std::uint64_t count = 0;
  int x = 0, y = 0;  ///< the first pixel of those, in reading order (meaningless while count is 0)
  std::uint32_t sample = 0;  ///< the first sample there
};

/// What a film keeps.
struct FilmSums {
  std::vector<double> values;          ///< [pixel][X Y Z, then R2 G2 B2 if kept, then bins if kept]
  std::vector<std::uint32_t> samples;  ///< [pixel] samples in the sums
  std::vector<std::uint32_t> tried;    ///< [pixel] and with those that were refused
};

class Film {
 public:
  /// An empty film of the pixels in `box`, part of a picture of width_px x height_px. Throws
  /// cannot() where the machine has less memory than the film needs.
  Film(int width_px, int height_px, PixelBox box, const FilmSettings& settings,
       const ToRgb& to_rgb);

  /// Adds the radiance that sample number `sample` of the pixel in column x and row y has found [W
  /// m-2 sr-1 nm-1]. A sample that is not finite is refused and counted. Different pixels may be
  /// filled at the same time; the samples of one pixel must come from one thread at a time, in an
  /// order that does not depend on threads.
  void add_sample(int x, int y, std::uint32_t sample, const Spectrum& radiance,
                  const Wavelengths& wavelengths);

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  const PixelBox& box() const { return box_; }
  /// Samples of a pixel so far, refused ones not included.
  std::uint32_t samples(int x, int y) const { return sums_.samples[pixel(x, y)]; }
  /// Number of the next sample that a pixel waits for: those before it have been added or refused.
  std::uint32_t next_sample(int x, int y) const { return sums_.tried[pixel(x, y)]; }
  RefusedSamples refused() const;
  /// Mean so far; black where there is no sample yet.
  Xyz mean_xyz(int x, int y) const;

  /// The picture so far, with the channels of the settings:
  ///   rgb       R, G, B: linear Rec.709 under the white that to_rgb was made for
  ///   xyz       X, Y, Z
  ///   variance  variance.R, .G, .B: of the pixel's value (not of one sample), from the scatter of
  ///   its samples as
  ///             if they were independent; samples that are spread evenly are better than that.
  ///             Infinite with one sample, 0 with none.
  ///   spectral  S0.<centre>nm: mean radiance in a bin of wavelengths [W m-2 sr-1 nm-1], after
  ///   Fichet et al.,
  ///             "An OpenEXR Layout for Spectral Images", JCGT 10(3), 2021
  Image to_image() const;
  /// The picture so far with R, G, B alone.
  Image rgb_image() const;
  /// What to_image has beside its values.
  ImageHeader image_header() const { return header_of(settings_.channels); }
  /// Puts the values of to_image into their place in a picture of the same channels whose box contains the film's.
  void put_into(Image& image) const { put_into(settings_.channels, image); }

  /// All that is kept; set_sums takes what a film of the same box and channels had.
  const FilmSums& sums() const { return sums_; }
  void set_sums(FilmSums sums);

  /// Memory that a film of so many pixels takes.
  static double needed_bytes(double pixels, const FilmSettings& settings);

 private:
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y - box_.y0) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(x - box_.x0);
  }
  void refuse(int x, int y, std::uint32_t sample);
  ImageHeader header_of(const std::vector<std::string>& channels) const;
  void put_into(const std::vector<std::string>& channels, Image& image) const;
  Image filled(const std::vector<std::string>& channels) const;
  std::size_t bins_in(const std::vector<std::string>& channels) const;

  int width_px_, height_px_;
  PixelBox box_;
  FilmSettings settings_;
  ToRgb to_rgb_;
  bool keeps_squares_, keeps_bins_;
  std::size_t sums_a_pixel_;
  FilmSums sums_;
  mutable std::mutex refused_mutex_;
  RefusedSamples refused_;
};

}  // namespace arcus::render
