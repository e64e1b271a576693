#include "tools/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace arcus::tools {
namespace {

bool is_line_wanted(const std::string& kind) { return kind == "auto" && ::isatty(STDERR_FILENO) == 1; }

std::string duration(double seconds) {
  char text[40];
  const long whole = std::lround(seconds);
  if (whole < 60) std::snprintf(text, sizeof text, "%ld s", whole);
  else if (whole < 3600) std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  else std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  return text;
}

}  // namespace

std::function<void(const render::Progress&)> progress_report(const std::string& kind) {
  if (is_line_wanted(kind)) {
    return [](const render::Progress& p) {
      std::fprintf(stderr, "\r%5.1f %%  %.2f million samples/s  %s left   ",
                   100 * p.samples_done / p.samples_in_all, 1e-6 * p.samples_per_second(),
                   duration(p.seconds_left()).c_str());
      std::fflush(stderr);
    };
  }
  if (kind == "json") {
    return [](const render::Progress& p) {
      std::fprintf(stderr,
                   "{\"fraction\": %.6f, \"samples_per_second\": %.6g, \"seconds\": %.3f, \"seconds_left\": %.3f}\n",
                   p.samples_done / p.samples_in_all, p.samples_per_second(), p.seconds, p.seconds_left());
    };
  }
  return nullptr;
}

void end_progress(const std::string& kind) {
  if (is_line_wanted(kind)) std::fputc('\n', stderr);
}

}  // namespace arcus::tools
