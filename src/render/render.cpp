#include "src/render/render.h"

#include <tbb/parallel_for.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "src/integrator/make_integrator.h"
#include "src/render/threads.h"

namespace arcus::render {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int block_size = 16;              // pixels; small enough to spread unequal work, large enough to share memory
constexpr long long samples_per_pass = 16;  // after the first passes, which are shorter: there is a picture early

/// Calls a report at intervals until destroyed, and a last time then.
class Reporter {
 public:
  Reporter(std::function<void()> report) : report_(std::move(report)) {
    if (!report_) return;
    thread_ = std::thread([this] {
      std::unique_lock lock(mutex_);
      while (!done_.wait_for(lock, std::chrono::milliseconds(200), [this] { return is_done_; })) report_();
    });
  }
  ~Reporter() {
    if (!report_) return;
    {
      const std::lock_guard lock(mutex_);
      is_done_ = true;
    }
    done_.notify_one();
    thread_.join();
    report_();
  }

 private:
  std::function<void()> report_;
  std::mutex mutex_;
  std::condition_variable done_;
  bool is_done_ = false;
  std::thread thread_;
};

/// Without an integrator, because it was stopped before there was one, nothing is added.
RunResult render_since(Clock::time_point begin, const Scene& scene, const Integrator* integrator, const RenderSettings& settings,
                       const RunOptions& options, Film& film) {
  const auto seconds_since_begin = [begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const auto seed = static_cast<std::uint64_t>(settings.seed);
  const PixelBox area = film.box();
  const int blocks_x = (area.width() + block_size - 1) / block_size;
  const int blocks_y = (area.height() + block_size - 1) / block_size;

  long long samples_before = 0;
  for (int y = area.y0; y < area.y1; ++y)
    for (int x = area.x0; x < area.x1; ++x) samples_before += film.next_sample(x, y);
  std::atomic<long long> samples_done{samples_before};
  std::atomic<bool> is_stopped{integrator == nullptr}, is_paused{false};
  // However short the limits and slow the machine, a run does something before it stops or saves.
  std::atomic<bool> did_something{false}, has_news{false};
  double last_checkpoint_s = seconds_since_begin();
  const auto progress = [&] {
    return Progress{seconds_since_begin(), static_cast<double>(samples_before), static_cast<double>(samples_done.load()),
                    static_cast<double>(settings.samples_per_pixel) * area.width() * area.height()};
  };
  const auto must_stop = [&] {
    if (options.stop_request && options.stop_request->load() != 0) return true;
    return options.time_limit_s > 0 && did_something && seconds_since_begin() >= options.time_limit_s;
  };

  const auto checkpoint_is_due = [&] {
    return options.checkpoint && has_news && seconds_since_begin() - last_checkpoint_s >= options.checkpoint_s;
  };

  /// Up to the sample `last`, not included; returns how many.
  const auto render_pixel = [&](int x, int y, long long last, Work& work) {
    const long long first = film.next_sample(x, y);
    const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(film.width_px()) +
                       static_cast<std::uint64_t>(x);
    for (long long i = first; i < last; ++i) {
      const auto sample = static_cast<std::uint32_t>(i);
      const FirstNumbers numbers = first_numbers(seed, pixel, sample);
      Random random(seed, pixel, sample);
      const Wavelengths wavelengths = draw_wavelengths(numbers.wavelength);
      const auto ray = scene.camera->ray(x + numbers.pixel_x, y + numbers.pixel_y);
      const Spectrum radiance = ray ? integrator->radiance(*ray, wavelengths, numbers, random, work) : Spectrum();
      film.add_sample(x, y, sample, radiance, wavelengths);
    }
    return std::max(last - first, 0LL);
  };

  RunResult result;
  std::mutex work_mutex;
  {
    Reporter reporter(options.report ? std::function<void()>([&] { options.report(progress()); }) : nullptr);
    on_threads(options.threads, [&] {
      long long done = 0;
      while (done < settings.samples_per_pixel && !is_stopped) {
        const long long pass = std::min({std::max(1LL, done), samples_per_pass, settings.samples_per_pixel - done});
        tbb::parallel_for(0, blocks_x * blocks_y, [&](int block) {
          if (is_stopped || must_stop()) {
            is_stopped = true;
            return;
          }
          if (is_paused || checkpoint_is_due()) {
            is_paused = true;
            return;
          }
          const int left = area.x0 + block % blocks_x * block_size, top = area.y0 + block / blocks_x * block_size;
          const int right = std::min(left + block_size, area.x1), bottom = std::min(top + block_size, area.y1);
          long long samples = 0;
          Work work;
          for (int y = top; y < bottom; ++y)
            for (int x = left; x < right; ++x) samples += render_pixel(x, y, done + pass, work);
          {
            const std::lock_guard lock(work_mutex);
            result.work += work;
          }
          samples_done += samples;
          if (samples > 0) did_something = has_news = true;
        });
        if (is_paused && !is_stopped) {  // then the same pass again: pixels that have had it are passed over
          options.checkpoint(film);
          last_checkpoint_s = seconds_since_begin();
          is_paused = has_news = false;
        } else {
          done += pass;
        }
      }
    });
    if (is_stopped && options.checkpoint) options.checkpoint(film);
  }
  result.progress = progress();
  result.is_complete = result.progress.samples_done == result.progress.samples_in_all;
  return result;
}

}  // namespace

std::unique_ptr<const Integrator> prepare_integrator(const Scene& scene, const RenderSettings& settings, const RunOptions& options) {
  std::unique_ptr<const Integrator> integrator;
  on_threads(options.threads, [&] { integrator = make_integrator(scene, settings, options.stop_request); });
  return integrator;
}

RunResult render(const Scene& scene, const Integrator& integrator, const RenderSettings& settings, const RunOptions& options, Film& film) {
  return render_since(Clock::now(), scene, &integrator, settings, options, film);
}

RunResult render(const Scene& scene, const RenderSettings& settings, const RunOptions& options, Film& film) {
  const auto begin = Clock::now();
  const auto integrator = prepare_integrator(scene, settings, options);
  return render_since(begin, scene, integrator.get(), settings, options, film);
}

}  // namespace arcus::render
