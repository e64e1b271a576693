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

/// The medium gets so many times fewer samples: it is a thousand times less noisy.
constexpr long long fewer_for_medium = 16;

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
  double seconds = 0;

  void add(Picture picture, const DropsComparisonOptions& options, bool has_directions, std::string_view where) {
    tone = picture.tone;
    seconds += picture.run.progress.seconds;
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

/// Squared standard errors, all together.
double noise(const RunMeans& means) {
  double sum = 0;
  for (const double error : means.standard_error) sum += error * error;
  return sum;
}

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
    medium_samples_ = std::max(1LL, samples_ / fewer_for_medium);
  }

  SceneSettings as_medium(bool is_geometric) const {
    SceneSettings scene = scene_;
    scene.render.integrator = "volume_path";
    scene.render.samples_per_pixel = medium_samples_;
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
    say("the medium by geometric optics, " + std::to_string(options_.runs) + " runs of " + std::to_string(medium_samples_) + " samples a pixel");
    const Scene medium_scene = build_scene(medium_settings, options_.build);
    const auto render_runs = [&](SceneSettings settings, const Scene& scene, Shown& shown) {
      for (int run = 0; run < options_.runs && !is_stopped(); ++run) {
        settings.render.seed = scene_.render.seed + run;
        shown.add(render_picture(settings, scene, {}, options_.run), options_, has_directions, scene_.path);
      }
    };
    render_runs(medium_settings, medium_scene, medium);
    const std::vector<media::Ray> rays = rays_through(medium_scene, result.depth);
    std::vector<double> passed;
    for (int run = 0; run < options_.runs && !is_stopped(); ++run) {
      say("explicit drops, run " + std::to_string(run + 1) + " of " + std::to_string(options_.runs));
      BuildOptions build = options_.build;
      if (run > 0) build.log = {};
      const SceneSettings settings = as_drops(options_.drops, run);
      const Scene scene = build_scene(settings, build);
      passed.push_back(share_without_drops(rays, scene));
      drops.add(render_picture(settings, scene, {}, options_.run), options_, has_directions, scene_.path);
    }
    say("the medium by its own optics");
    if (!is_stopped()) render_runs(wave_settings, build_scene(wave_settings, options_.build), waves);
    if (!is_stopped()) take_times(result);
    if (is_stopped()) return result;

    result.runs = options_.runs;
    result.samples_per_pixel = samples_ * options_.runs;
    result.medium_samples_per_pixel = medium_samples_ * options_.runs;
    result.drops_s = drops.seconds;
    result.medium_s = medium.seconds;
    finish_depth(passed, result.depth);
    result.tone = medium.tone;
    result.medium_blocks = means_of(medium.blocks);
    result.drops_blocks = means_of(drops.blocks);
    result.block_agreement = agreement_of(drops.blocks, medium.blocks);
    result.time_for_equal_error = noise(result.drops_blocks) * drops.seconds / (noise(result.medium_blocks) * medium.seconds);
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

  /// The camera's rays through the medium, up to the surfaces behind it.
  std::vector<media::Ray> rays_through(const Scene& medium, DepthComparison& depth) const {
    const int width = scene_.camera.width_px, height = scene_.camera.height_px;
    const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(width) * height / 40000)));
    std::vector<media::Ray> rays;
    double passed = 0;
    for (int y = 0; y < height; y += step)
      for (int x = 0; x < width; x += step) {
        auto ray = medium.camera->ray(x + 0.5, y + 0.5);
        if (!ray) continue;
        const auto end = medium.surfaces.nearest_hit(*ray);
        if (end) ray->farthest_m = end->distance_m * (1 - 1e-9);
        const double tau = media::optical_depth(*medium.medium, *ray, 550);
        if (!(tau > 1e-3)) continue;
        passed += std::exp(-tau);
        rays.push_back(*ray);
      }
    depth.rays = rays.size();
    depth.medium = -std::log(passed / static_cast<double>(std::max<std::size_t>(rays.size(), 1)));
    return rays;
  }

  static double share_without_drops(const std::vector<media::Ray>& rays, const Scene& drops) {
    const auto passed = std::count_if(rays.begin(), rays.end(), [&](const media::Ray& ray) { return !drops.surfaces.is_blocked(ray); });
    return static_cast<double>(passed) / static_cast<double>(std::max<std::size_t>(rays.size(), 1));
  }

  static void finish_depth(const std::vector<double>& passed, DepthComparison& depth) {
    Series runs;
    for (const double share : passed) runs.push_back({share});
    const RunMeans mean = means_of(runs);
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
  long long samples_, medium_samples_;  // a pixel and run
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
