// Writes all tiles of a scene with light that is made up: a sky that brightens downwards, each sample as noisy as light in a cloud.
// Merging does not see the difference to a rendering, which would take hours at 8k. Usage: write_noisy_tiles SCENE.toml N FOLDER

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "phase/base/random.h"
#include "src/render/picture.h"
#include "src/render/tile.h"
#include "src/render/tile_folder.h"

namespace arcus::render {
namespace {

void fill(Film& film, const TileJob& job) {
  const PixelBox& box = film.box();
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(job.width_px) + static_cast<std::uint64_t>(x);
      const double brightness = 0.2 + 0.8 * y / job.height_px;
      for (std::uint32_t sample = 0; sample < job.samples_per_pixel; ++sample) {
        Random random(static_cast<std::uint64_t>(job.seed), pixel, sample);
        // Strata of wavelengths, as a rendering has them, so that no bin is empty.
        const Wavelengths wavelengths = draw_wavelengths((sample + random.uniform_double()) / static_cast<double>(job.samples_per_pixel));
        const double weight = -brightness * std::log1p(-random.uniform_double());
        Spectrum radiance;
        for (int i = 0; i < wavelength_count; ++i) radiance[i] = static_cast<float>(weight * (1 + 0.2 * random.uniform()) * 450 / wavelengths[i]);
        film.add_sample(x, y, sample, radiance, wavelengths);
      }
    }
  }
}

void write_tiles(const std::string& scene, long long count, const std::string& folder) {
  const SceneSettings settings = read_scene(scene, {});
  const TileJob job = tile_job(settings, count);
  std::filesystem::create_directories(folder);
  write_record(folder, job);
  tbb::parallel_for(0LL, count, [&](long long tile) {
    Film film(job.width_px, job.height_px, tile_box(job.width_px, job.height_px, count, tile), settings.film, to_rgb_of(settings, job.sun));
    fill(film, job);
    write_tile(tile_path(folder, count, tile), film, job, tile, 1);
  });
}

}  // namespace
}  // namespace arcus::render

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: write_noisy_tiles SCENE.toml N FOLDER\n");
    return 2;
  }
  try {
    arcus::render::write_tiles(argv[1], std::atoll(argv[2]), argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
