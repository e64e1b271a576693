#include "src/film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "phase/base/error.h"
#include "phase/base/random.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {
namespace {

FilmSettings with_channels(std::vector<std::string> channels) {
  FilmSettings settings;
  settings.channels = std::move(channels);
  return settings;
}

ToRgb plain() { return to_rgb_from_white(equal_energy_white()); }

Wavelengths wavelengths_of(Random& random) { return draw_wavelengths(random.uniform_double()); }

}  // namespace

TEST(Film, PixelIsTheMeanOfItsSamples) {
  Film film(3, 2, {0, 0, 3, 2}, with_channels({"rgb", "xyz"}), plain());
  Random random(5, 6, 7);
  Xyz sum;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const Wavelengths wavelengths = wavelengths_of(random);
    const Spectrum radiance(random.uniform(), random.uniform(), random.uniform(), random.uniform());
    film.add_sample(2, 1, i, radiance, wavelengths);
    sum += xyz_of_sample(radiance, wavelengths);
  }
  const Image image = film.to_image();
  EXPECT_EQ(image.channel_names(), (std::vector<std::string>{"R", "G", "B", "X", "Y", "Z"}));
  const Rgb mean = plain()(sum * 1e-3);
  EXPECT_FLOAT_EQ(image.value(2, 1, 0), static_cast<float>(mean.r));
  EXPECT_FLOAT_EQ(image.value(2, 1, 2), static_cast<float>(mean.b));
  EXPECT_FLOAT_EQ(image.value(2, 1, 4), static_cast<float>(sum.y * 1e-3));
  EXPECT_EQ(film.samples(2, 1), 1000u);
  EXPECT_EQ(image.value(1, 1, 0), 0) << "no sample there";
  EXPECT_EQ(film.rgb_image().value(2, 1, 1), image.value(2, 1, 1));
}

TEST(Film, VarianceOfThePixelIsThatOfItsMean) {
  // Many films of 16 samples: the scatter of their means is what each of them estimates.
  const ToRgb to_rgb = plain();
  constexpr int films = 4000, samples = 16;
  Random random(11, 12, 13);
  double sum[3] = {}, squares[3] = {}, claimed[3] = {};
  Film film(films, 1, {0, 0, films, 1}, with_channels({"rgb", "variance"}), to_rgb);
  for (int x = 0; x < films; ++x)
    for (std::uint32_t i = 0; i < samples; ++i) {
      const float level = random.uniform() < 0.3f ? 2.0f : 0.5f;
      film.add_sample(x, 0, i, Spectrum::filled(level), wavelengths_of(random));
    }
  const Image image = film.to_image();
  for (int x = 0; x < films; ++x)
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = image.value(x, 0, c);
      sum[c] += value;
      squares[c] += value * value;
      claimed[c] += image.value(x, 0, 3 + c);
    }
  for (std::size_t c = 0; c < 3; ++c) {
    const double scatter = squares[c] / films - std::pow(sum[c] / films, 2);
    EXPECT_NEAR(claimed[c] / films / scatter, 1, 0.1) << image.channel_names()[3 + c];
    // A film that forgot the division by the number of samples would be off by 16.
  }
}

TEST(Film, VarianceIsUnknownWithOneSample) {
  Film film(2, 1, {0, 0, 2, 1}, with_channels({"variance"}), plain());
  film.add_sample(0, 0, 0, Spectrum::filled(1), draw_wavelengths(0.1));
  const Image image = film.to_image();
  EXPECT_TRUE(std::isinf(image.value(0, 0, 0)));
  EXPECT_EQ(image.value(1, 0, 0), 0);
}

TEST(Film, SpectralChannelsHoldTheMeanRadianceOfTheirBin) {
  FilmSettings settings = with_channels({"spectral"});
  settings.spectral_bins = 40;
  Film film(1, 1, {0, 0, 1, 1}, settings, plain());
  constexpr std::uint32_t count = 40000;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Wavelengths wavelengths = draw_wavelengths((i + 0.5) / count);
    Spectrum radiance;
    for (int k = 0; k < wavelength_count; ++k) radiance[k] = wavelengths[k] / 500;
    film.add_sample(0, 0, i, radiance, wavelengths);
  }
  const Image image = film.to_image();
  ASSERT_EQ(image.channel_names().size(), 40u);
  EXPECT_EQ(image.channel_names()[0], "S0.385.0nm");
  EXPECT_EQ(image.channel_names()[39], "S0.775.0nm");
  for (std::size_t bin = 0; bin < 40; ++bin)
    EXPECT_NEAR(image.value(0, 0, bin), (385 + 10.0 * static_cast<double>(bin)) / 500, 2e-3);
}

TEST(Film, SamplesThatAreNotFiniteAreLeftOutAndReported) {
  Film film(4, 4, {1, 1, 4, 4}, with_channels({"rgb"}), plain());
  const Wavelengths wavelengths = draw_wavelengths(0.4);
  film.add_sample(2, 3, 0, Spectrum::filled(1), wavelengths);
  film.add_sample(2, 3, 1, Spectrum::filled(std::numeric_limits<float>::quiet_NaN()), wavelengths);
  film.add_sample(2, 3, 2, Spectrum(0, 0, std::numeric_limits<float>::infinity(), 0), wavelengths);
  film.add_sample(3, 1, 9, Spectrum::filled(std::numeric_limits<float>::infinity()), wavelengths);
  EXPECT_EQ(film.samples(2, 3), 1u);
  EXPECT_EQ(film.mean_xyz(2, 3).y, xyz_of_sample(Spectrum::filled(1), wavelengths).y);
  const RefusedSamples refused = film.refused();
  EXPECT_EQ(refused.count, 3u);
  EXPECT_EQ(refused.x, 3);
  EXPECT_EQ(refused.y, 1);
  EXPECT_EQ(refused.sample, 9u);
}

TEST(Film, MoreThanTheMachinesMemoryIsRefusedInWords) {
  FilmSettings settings = with_channels({"spectral", "variance"});
  settings.spectral_bins = 400;
  try {
    Film film(1 << 20, 1 << 20, {0, 0, 1 << 20, 1 << 20}, settings, plain());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.fault(), Fault::failed);
    EXPECT_NE(std::string(error.what()).find("MB"), std::string::npos) << error.what();
  }
}

TEST(FilmSettings, WhiteIsAWordOrATemperature) {
  EXPECT_EQ(settings_from_text<FilmSettings>("white = 5500\n", "scene.toml").white, "5500");
  EXPECT_EQ(settings_from_text<FilmSettings>("white = 'D65'\n", "scene.toml").white, "D65");
  for (const char* text : {"white = 5500\n", "white = 'D65'\nchannels = ['xyz', 'variance']\n"}) {
    const std::string written = text_of(settings_from_text<FilmSettings>(text, "scene.toml"));
    EXPECT_EQ(text_of(settings_from_text<FilmSettings>(written, "copy")), written);
  }
  for (const char* text :
       {"white = 'D56'\n", "white = 20\n", "channels = []\n", "channels = ['rgba']\n"})
    EXPECT_THROW(settings_from_text<FilmSettings>(text, "scene.toml"), Error) << text;
}

}  // namespace arcus::render
