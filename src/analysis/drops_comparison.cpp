#include "src/analysis/drops_comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "media/tracking/optical_depth.h"
#include "phase/base/error.h"
#include "src/render/picture.h"

namespace arcus::render {
namespace {

using Series = std::vector<std::vector<double>>;  // [run][place]

RunMeans means_of(const Series& runs) {
  RunMeans result;
  const auto n = static_cast<double>(runs.size());
  for (std::size_t place = 0; place < runs.front().size(); ++place) {
    double sum = 0, squares = 0;
    for (const auto& run : runs) sum += run[place];
    for (const auto& run : runs) squares += (run[place] - sum / n) * (run[place] - sum / n);
    result.mean.push_back(sum / n);
    result.standard_error.push_back(std::sqrt(squares / (n * (n - 1))));
  }
  return result;
}

/// Mean luminance of blocks of pixels, row by row.
std::vector<double> block_means(const Image& image, int along_longer_edge) {
  const int width = image.width_px(), height = image.height_px();
  const int edge = std::max(1, (std::max(width, height) + along_longer_edge - 1) / along_longer_edge);
  const std::size_t luminance = *image.channel("Y");
  std::vector<double> means;
  for (int y0 = 0; y0 < height; y0 += edge)
    for (int x0 = 0; x0 < width; x0 += edge) {
      const int x1 = std::min(x0 + edge, width), y1 = std::min(y0 + edge, height);
      double sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += static_cast<double>(image.value(x, y, luminance));
      means.push_back(sum / (static_cast<double>(x1 - x0) * (y1 - y0)));
    }
  return means;
}

/// One way to show the medium, over all runs.
struct Shown {
  Image image;
  Series profiles, blocks;
  Profile last;
  ToneSettings tone;

  void add(Picture picture, const DropsComparisonOptions& options, bool has_directions, std::string_view where) {
    tone = picture.tone;
    blocks.push_back(block_means(picture.image, options.blocks));
    if (has_directions) {
      last = measure_profile(picture.image, options.profile, where);
      profiles.push_back(last.channel("Y")->mean);
    }
    if (blocks.size() == 1) {
      image = std::move(picture.image);
      return;
    }
    for (std::size_t i = 0; i < image.values().size(); ++i)
      image.values()[i] += (picture.image.values()[i] - image.values()[i]) / static_cast<float>(blocks.size());
  }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Comparer {
 public:
  Comparer(const SceneSettings& scene, const DropsComparisonOptions& options) : options_(options), scene_(scene) {
    if (scene_.media.empty()) throw bad_input(scene_.path, "no [[medium]]", "one to draw drops from expected");
    for (std::size_t i = 0; i < scene_.media.size(); ++i)
      if (scene_.media[i].name.empty()) scene_.media[i].name = "medium " + std::to_string(i);
    // Drops that the scene draws from a medium are replaced; others stay in both.
    std::erase_if(scene_.droplets, [](const DropletsSettings& drops) { return !drops.medium.empty(); });
    if (!scene_.droplets.empty()) throw bad_input(scene_.path + ": droplets", "drops in a box", "media alone expected: the drops are drawn from them");
    scene_.film.channels = {"rgb", "xyz"};
    scene_.render.intersector = "hierarchy";
    samples_ = std::max(1LL, scene_.render.samples_per_pixel / options_.runs);
  }

  SceneSettings as_medium(bool is_geometric) const {
    SceneSettings scene = scene_;
    scene.render.integrator = "volume_path";
    scene.render.samples_per_pixel = samples_;
    for (MediumSettings& medium : scene.media) medium.is_geometric = is_geometric;
    return scene;
  }

  SceneSettings as_drops(long long count, int run) const {
    SceneSettings scene = scene_;
    scene.render.integrator = "path";
    // A drop is several surfaces; one scattering in the medium.
    scene.render.max_bounces = std::min(1000000000LL, scene.render.max_bounces * 8);
    scene.render.samples_per_pixel = samples_;
    scene.render.seed += run;
    for (const MediumSettings& medium : scene.media) {
      DropletsSettings drops;
      drops.medium = medium.name;
      drops.count = count;
      drops.seed = run;
      scene.droplets.push_back(drops);
    }
    return scene;
  }

  DropsComparison compare() {
    DropsComparison result;
    const bool has_directions = scene_.camera.type != "orthographic";
    result.scene = scene_.path;
    result.sun_radius_deg = scene_.sun.angular_radius_deg;
    result.drops = options_.drops;
    Shown medium, drops, waves;
    const SceneSettings medium_settings = as_medium(true), wave_settings = as_medium(false);
    say("the medium by geometric optics, " + std::to_string(options_.runs) + " runs of " + std::to_string(samples_) + " samples a pixel");
    const Scene medium_scene = build_scene(medium_settings, options_.build);
    const auto render_runs = [&](SceneSettings settings, const Scene& scene, Shown& shown) {
      for (int run = 0; run < options_.runs && !is_stopped(); ++run) {
        settings.render.seed = scene_.render.seed + run;
        shown.add(render_picture(settings, scene, {}, options_.run), options_, has_directions, scene_.path);
      }
    };
    render_runs(medium_settings, medium_scene, medium);
    std::vector<double> passed;
    for (int run = 0; run < options_.runs && !is_stopped(); ++run) {
      say("explicit drops, run " + std::to_string(run + 1) + " of " + std::to_string(options_.runs));
      BuildOptions build = options_.build;
      if (run > 0) build.log = {};
      const SceneSettings settings = as_drops(options_.drops, run);
      const Scene scene = build_scene(settings, build);
      compare_depth(medium_scene, scene, passed, result.depth);
      drops.add(render_picture(settings, scene, {}, options_.run), options_, has_directions, scene_.path);
    }
    say("the medium by its own optics");
    if (!is_stopped()) render_runs(wave_settings, build_scene(wave_settings, options_.build), waves);
    if (!is_stopped()) take_times(result);
    if (is_stopped()) return result;

    result.runs = options_.runs;
    result.samples_per_pixel = samples_ * options_.runs;
    finish_depth(passed, result.depth);
    result.tone = medium.tone;
    result.medium_blocks = means_of(medium.blocks);
    result.drops_blocks = means_of(drops.blocks);
    result.block_agreement = agreement_of(drops.blocks, medium.blocks);
    if (has_directions) {
      result.around = medium.last.around;
      result.angle_deg = medium.last.angle_deg;
      result.medium_profile = means_of(medium.profiles);
      result.drops_profile = means_of(drops.profiles);
      result.waves_profile = means_of(waves.profiles);
      result.profile_agreement = agreement_of(drops.profiles, medium.profiles);
    }
    result.medium = std::move(medium.image);
    result.explicit_drops = std::move(drops.image);
    result.waves = std::move(waves.image);
    return result;
  }

 private:
  bool is_stopped() const { return options_.run.stop_request && options_.run.stop_request->load() != 0; }
  void say(const std::string& words) const {
    if (options_.log && !is_stopped()) options_.log(words);
  }

  /// One more run of drops: the share of the camera's rays through the medium that meets none.
  void compare_depth(const Scene& medium, const Scene& drops, std::vector<double>& passed, DepthComparison& depth) const {
    const int width = scene_.camera.width_px, height = scene_.camera.height_px;
    const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(width) * height / 40000)));
    double by_medium = 0, by_drops = 0;
    depth.rays = 0;
    for (int y = 0; y < height; y += step)
      for (int x = 0; x < width; x += step) {
        auto ray = medium.camera->ray(x + 0.5, y + 0.5);
        if (!ray) continue;
        const auto end = medium.surfaces.nearest_hit(*ray);
        if (end) ray->farthest_m = end->distance_m * (1 - 1e-9);
        const double tau = media::optical_depth(*medium.medium, *ray, 550);
        if (!(tau > 1e-3)) continue;
        by_medium += std::exp(-tau);
        by_drops += drops.surfaces.is_blocked(*ray) ? 0 : 1;
        ++depth.rays;
      }
    const auto rays = static_cast<double>(std::max<std::size_t>(depth.rays, 1));
    depth.medium = by_medium / rays;
    passed.push_back(by_drops / rays);
  }

  static void finish_depth(const std::vector<double>& passed, DepthComparison& depth) {
    Series runs;
    for (const double share : passed) runs.push_back({share});
    const RunMeans mean = means_of(runs);
    depth.medium = -std::log(depth.medium);
    depth.drops = -std::log(mean.mean[0]);
    depth.drops_error = mean.mean[0] > 0 ? mean.standard_error[0] / mean.mean[0] : 0;
  }

  void take_times(DropsComparison& result) {
    if (options_.timed_counts.empty()) return;
    result.timed_samples = std::min(samples_, 4LL);
    const auto timed = [&](SceneSettings settings, const std::string& name, long long count) {
      if (is_stopped()) return;
      settings.render.samples_per_pixel = result.timed_samples;
      BuildOptions build = options_.build;
      build.log = {};
      const auto start = std::chrono::steady_clock::now();
      const Scene scene = build_scene(settings, build);
      TimedRender time{name, count, seconds_since(start), 0};
      RunOptions run = options_.run;
      run.report = {};
      time.render_s = render_picture(settings, scene, {}, run).run.progress.seconds;
      result.times.push_back(time);
    };
    say("times");
    timed(as_medium(true), "medium", 0);
    for (const long long count : options_.timed_counts) {
      try {
        timed(as_drops(count, 0), "drops", count);
      } catch (const Error& error) {
        // So few and large ones that they have no room, or so many that the memory is too small: a point without a time.
        if (options_.log) options_.log(std::string("no time: ") + error.what());
      }
    }
  }

  const DropsComparisonOptions& options_;
  SceneSettings scene_;
  long long samples_;  // a pixel and run
};

}  // namespace

Agreement agreement_of(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  const RunMeans mean_a = means_of(a), mean_b = means_of(b);
  Agreement result;
  for (std::size_t i = 0; i < mean_a.mean.size(); ++i) {
    const double ea = mean_a.standard_error[i], eb = mean_b.standard_error[i], variance = ea * ea + eb * eb;
    if (!(variance > 0)) continue;
    const double difference = mean_a.mean[i] - mean_b.mean[i];
    // Welch and Satterthwaite's degrees of freedom.
    const double freedom = variance * variance / (std::pow(ea, 4) / static_cast<double>(a.size() - 1) + std::pow(eb, 4) / static_cast<double>(b.size() - 1));
    ++result.places;
    result.chi_square += difference * difference / variance;
    result.expected += freedom > 2.5 ? freedom / (freedom - 2) : 5;
  }
  if (result.places > 0) {
    const auto n = static_cast<double>(result.places);
    const double width = 2 / (9 * n);
    result.sigma = (std::cbrt(result.chi_square / result.expected) - (1 - width)) / std::sqrt(width);
  }
  const auto totals = [](const Series& runs) {
    Series sums;
    for (const auto& run : runs) {
      double sum = 0;
      for (const double v : run) sum += v;
      sums.push_back({sum});
    }
    return means_of(sums);
  };
  const RunMeans total_a = totals(a), total_b = totals(b);
  if (total_b.mean[0] > 0) {
    result.mean_ratio = total_a.mean[0] / total_b.mean[0];
    result.mean_ratio_error =
        result.mean_ratio * std::hypot(total_a.standard_error[0] / std::max(total_a.mean[0], 1e-300), total_b.standard_error[0] / total_b.mean[0]);
  }
  return result;
}

DropsComparison compare_drops(const SceneSettings& scene, const DropsComparisonOptions& options) { return Comparer(scene, options).compare(); }

}  // namespace arcus::render
