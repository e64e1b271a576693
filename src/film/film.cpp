#include "src/film/film.h"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <tuple>

#include "phase/base/error.h"

namespace arcus::render {
namespace {

bool has(const std::vector<std::string>& words, std::string_view word) {
  for (const auto& w : words)
    if (w == word) return true;
  return false;
}

constexpr std::size_t colour_sums = 3, square_sums = 3;

std::size_t sums_a_pixel_of(const FilmSettings& settings) {
  return colour_sums + (has(settings.channels, "variance") ? square_sums : 0) +
         (has(settings.channels, "spectral") ? static_cast<std::size_t>(settings.spectral_bins)
                                             : 0);
}

double bin_width_nm(const FilmSettings& settings) {
  return (longest_wavelength_nm - shortest_wavelength_nm) /
         static_cast<double>(settings.spectral_bins);
}

std::string bin_name(const FilmSettings& settings, std::size_t bin) {
  char name[40];
  std::snprintf(name, sizeof name, "S0.%.1fnm",
                shortest_wavelength_nm + (static_cast<double>(bin) + 0.5) * bin_width_nm(settings));
  return name;
}

std::vector<double> allocated(std::size_t count, double bytes) {
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  const std::string what =
      "no memory for the film of " + std::to_string(std::llround(bytes / 1e6)) + " MB";
  if (bytes > memory)
    throw cannot(what, "the machine has " + std::to_string(std::llround(memory / 1e6)) +
                           " MB; choose a smaller picture, fewer channels, or a crop");
  try {
    return std::vector<double>(count);
  } catch (const std::bad_alloc&) {
    throw cannot(what, "choose a smaller picture, fewer channels, or a crop");
  }
}

}  // namespace

void list_keys(Keys& keys, FilmSettings& film) {
  keys.number(
      "exposure_ev", film.exposure_ev, between(-100, 100),
      "of the PNG, in stops; 0 shows a white matte surface that faces the sun or moon as a bright white");
  keys.choice("adaptation", film.adaptation, {"day", "night"},
              "of the PNG; night: below some 4 cd/m2 colours fade, below 0.01 the rods alone see, by the picture's physical luminance, in the bluish grey "
              "of Jensen and others (2001); exposure_ev then makes it bright or dark");
  keys.word_or_number(
      "white", film.white, {"auto", "D65", "equal_energy"}, between(1000, 1e5),
      "what is white: the sun's or moon's spectrum (auto), D65, equal_energy, or the temperature of a Planck "
      "radiator [K]");
  keys.choices("channels", film.channels, {"rgb", "xyz", "variance", "spectral"},
               "what the EXR holds");
  if (film.channels.empty())
    keys.refuse("channels", "an empty array", "at least one channel expected");
  keys.integer("spectral_bins", film.spectral_bins, between(1, 400),
               "number of the spectral channels, equally wide over 380 to 780 nm");
}

Film::Film(int width_px, int height_px, PixelBox box, const FilmSettings& settings,
           const ToRgb& to_rgb)
    : width_px_(width_px),
      height_px_(height_px),
      box_(box),
      settings_(settings),
      to_rgb_(to_rgb),
      keeps_squares_(has(settings.channels, "variance")),
      keeps_bins_(has(settings.channels, "spectral")),
      sums_a_pixel_(sums_a_pixel_of(settings)),
      sums_{allocated(box.pixels() * sums_a_pixel_,
                      needed_bytes(static_cast<double>(box.pixels()), settings)),
            std::vector<std::uint32_t>(box.pixels()), std::vector<std::uint32_t>(box.pixels())} {}

void Film::set_sums(FilmSums sums) {
  assert(sums.values.size() == sums_.values.size() && sums.samples.size() == sums_.samples.size() &&
         sums.tried.size() == sums_.tried.size());
  sums_ = std::move(sums);
}

double Film::needed_bytes(double pixels, const FilmSettings& settings) {
  return pixels *
         static_cast<double>(sums_a_pixel_of(settings) * sizeof(double) + 2 * sizeof(std::uint32_t));
}

void Film::add_sample(int x, int y, std::uint32_t sample, const Spectrum& radiance,
                      const Wavelengths& wavelengths) {
  const std::size_t p = pixel(x, y);
  ++sums_.tried[p];
  if (!std::isfinite(radiance.sum())) return refuse(x, y, sample);
  double* sum = sums_.values.data() + p * sums_a_pixel_;
  const Xyz c = xyz_of_sample(radiance, wavelengths);
  sum[0] += c.x;
  sum[1] += c.y;
  sum[2] += c.z;
  sum += colour_sums;
  if (keeps_squares_) {
    const Rgb rgb = to_rgb_(c);
    sum[0] += rgb.r * rgb.r;
    sum[1] += rgb.g * rgb.g;
    sum[2] += rgb.b * rgb.b;
    sum += square_sums;
  }
  if (keeps_bins_) {
    const double width_nm = bin_width_nm(settings_);
    for (int i = 0; i < wavelength_count; ++i) {
      const double nm = wavelengths[i];
      const auto bin = std::min(static_cast<long long>((nm - shortest_wavelength_nm) / width_nm),
                                settings_.spectral_bins - 1);
      sum[bin] += radiance[i] / (wavelength_count * width_nm * wavelength_density_per_nm(nm));
    }
  }
  ++sums_.samples[p];
}

void Film::refuse(int x, int y, std::uint32_t sample) {
  const std::lock_guard lock(refused_mutex_);
  const auto place = [](int px, int py, std::uint32_t s) { return std::tuple(py, px, s); };
  if (refused_.count == 0 || place(x, y, sample) < place(refused_.x, refused_.y, refused_.sample))
    refused_ = {refused_.count, x, y, sample};
  ++refused_.count;
}

RefusedSamples Film::refused() const {
  const std::lock_guard lock(refused_mutex_);
  return refused_;
}

Xyz Film::mean_xyz(int x, int y) const {
  const std::size_t p = pixel(x, y);
  if (sums_.samples[p] == 0) return {};
  const double* sum = sums_.values.data() + p * sums_a_pixel_;
  return Xyz{sum[0], sum[1], sum[2]} * (1.0 / sums_.samples[p]);
}

Image Film::to_image() const { return filled(settings_.channels); }

Image Film::rgb_image() const { return filled({"rgb"}); }

Image Film::filled(const std::vector<std::string>& channels) const {
  Image image(header_of(channels));
  put_into(channels, image);
  return image;
}

std::size_t Film::bins_in(const std::vector<std::string>& channels) const {
  return keeps_bins_ && has(channels, "spectral") ? static_cast<std::size_t>(settings_.spectral_bins) : 0;
}

ImageHeader Film::header_of(const std::vector<std::string>& channels) const {
  ImageHeader header{width_px_, height_px_, box_, {}, {}};
  std::vector<std::string>& names = header.channel_names;
  if (has(channels, "rgb")) names.insert(names.end(), {"R", "G", "B"});
  if (has(channels, "xyz")) names.insert(names.end(), {"X", "Y", "Z"});
  if (keeps_squares_ && has(channels, "variance")) names.insert(names.end(), {"variance.R", "variance.G", "variance.B"});
  const std::size_t bins = bins_in(channels);
  for (std::size_t bin = 0; bin < bins; ++bin) names.push_back(bin_name(settings_, bin));
  if (bins > 0) {
    header.metadata.set("spectralLayoutVersion", std::string("1.0"));
    header.metadata.set("emissiveUnits", std::string("W.m^-2.sr^-1.nm^-1"));
  }
  return header;
}

void Film::put_into(const std::vector<std::string>& channels, Image& image) const {
  assert(image.channel_names() == header_of(channels).channel_names);
  const bool rgb = has(channels, "rgb"), xyz = has(channels, "xyz");
  const bool variance = keeps_squares_ && has(channels, "variance");
  const std::size_t bins = bins_in(channels);
  for (int y = box_.y0; y < box_.y1; ++y) {
    float* out = &image.value(box_.x0, y, 0);
    const auto put = [&](double value) { *out++ = static_cast<float>(value); };
    for (int x = box_.x0; x < box_.x1; ++x) {
      const Xyz c = mean_xyz(x, y);
      const Rgb mean = to_rgb_(c);
      if (rgb)
        for (const double v : {mean.r, mean.g, mean.b}) put(v);
      if (xyz)
        for (const double v : {c.x, c.y, c.z}) put(v);
      const double count = sums_.samples[pixel(x, y)];
      const double* more = sums_.values.data() + pixel(x, y) * sums_a_pixel_ + colour_sums;
      if (variance) {
        const double means[] = {mean.r, mean.g, mean.b};
        for (std::size_t i = 0; i < 3; ++i)
          put(count == 0   ? 0
              : count == 1 ? std::numeric_limits<double>::infinity()
                           : std::fmax(0, more[i] / count - means[i] * means[i]) / (count - 1));
      }
      if (keeps_squares_) more += square_sums;
      for (std::size_t bin = 0; bin < bins; ++bin) put(count > 0 ? more[bin] / count : 0);
    }
  }
}

}  // namespace arcus::render
