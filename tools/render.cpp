// arcus render: a scene becomes a picture.

#include <CLI/CLI.hpp>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "phase/species/species_cache.h"
#include "src/film/image_file.h"
#include "src/render/picture.h"
#include "tools/command.h"
#include "tools/progress.h"

namespace arcus::tools {
namespace {

struct RenderCommand {
  std::string scene, output, crop, progress = "auto", cache_folder;
  std::vector<std::string> overrides;
  long long samples = 0, seed = -1;
  int threads = 0;
  double time_limit_s = 0, checkpoint_s = 60;
  bool no_png = false, quiet = false, resume = false;
};

render::PixelBox parsed_crop(const std::string& text, int width, int height) {
  render::PixelBox box;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d,%d,%d,%d%c", &box.x0, &box.y0, &box.x1, &box.y1, &rest) != 4)
    throw bad_input("--crop", "'" + text + "'", "X0,Y0,X1,Y1 expected: pixels from the top left, the last ones excluded");
  if (!(0 <= box.x0 && box.x0 < box.x1 && box.x1 <= width && 0 <= box.y0 && box.y0 < box.y1 && box.y1 <= height))
    throw bad_input("--crop", "'" + text + "'",
                    "a rectangle with at least one pixel within the picture of " + std::to_string(width) + " x " +
                        std::to_string(height) + " expected");
  return box;
}

void run(const RenderCommand& command) {
  std::vector<std::string> overrides = command.overrides;
  if (command.samples > 0) overrides.push_back("render.samples_per_pixel=" + std::to_string(command.samples));
  if (command.seed >= 0) overrides.push_back("render.seed=" + std::to_string(command.seed));
  const render::SceneSettings settings = render::read_scene(command.scene, overrides);

  const std::string exr = command.output.empty()
                              ? std::filesystem::path(command.scene).stem().string() + ".exr"
                              : command.output;
  const std::filesystem::path exr_path(exr);
  if (exr_path.extension() != ".exr")
    throw bad_input("-o", "'" + exr + "'", "a name that ends in .exr expected", "A .png is written beside it");
  const std::string png = std::filesystem::path(exr_path).replace_extension(".png").string();
  check_writable(exr);  // before the work, not after it
  if (!command.no_png) check_writable(png);
  std::optional<render::PixelBox> crop;
  if (!command.crop.empty())
    crop = parsed_crop(command.crop, settings.camera.width_px, settings.camera.height_px);

  const auto say = [&](std::string_view text) {
    if (!command.quiet) std::cerr << text << '\n';
  };
  render::BuildOptions build;
  build.cache_folder = command.cache_folder.empty() ? phase::default_cache_folder() : command.cache_folder;
  build.log = say;
  const render::Scene scene = render::build_scene(settings, build);

  render::load_image_files();  // likewise before the work
  watch_for_interruption();
  render::RunOptions options;
  options.threads = command.threads;
  options.time_limit_s = command.time_limit_s;
  options.checkpoint_s = command.checkpoint_s;
  options.stop_request = &stop_request();
  if (!command.quiet) options.report = progress_report(command.progress);
  const render::Picture picture = render_picture(settings, scene, crop, options, command.resume ? exr + ".checkpoint" : "");
  if (options.report) end_progress(command.progress);

  if (picture.refused.count > 0)
    std::cerr << "arcus: warning: " << picture.refused.count << " samples were not finite and are left out; the first: pixel "
              << picture.refused.x << "," << picture.refused.y << ", sample " << picture.refused.sample << '\n';
  render::write_exr(exr, picture.image);
  if (!command.no_png) render::write_png(png, tone_mapped(picture.image, picture.tone));

  char line[1000];
  const double samples = std::max(1.0, picture.run.progress.samples_done - picture.run.progress.samples_before);
  const render::Work& work = picture.run.work;
  std::snprintf(line, sizeof line, "%s%s: %.1f s, %.3g million samples/s; a sample: %.3g scatterings, %.3g tentative collisions, %.3g sun rays%s", exr.c_str(),
                command.no_png ? "" : " and .png", picture.run.progress.seconds,
                1e-6 * picture.run.progress.samples_per_second(),
                static_cast<double>(work.scatterings) / samples, static_cast<double>(work.tentative_collisions) / samples, static_cast<double>(work.sun_rays) / samples,
                picture.run.is_complete ? ""
                : command.resume        ? ", stopped before it was done; the same command goes on"
                                        : ", stopped before it was done");
  say(line);
  if (stop_request() == SIGINT) throw Exit{exit_interrupted};
  if (stop_request() == SIGTERM) throw Exit{exit_terminated};
}

}  // namespace

void add_render(CLI::App& program) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App* app = program.add_subcommand("render", "Render a scene");
  app->add_option("SCENE", command->scene, "scene file (TOML)")->required();
  app->add_option("-o,--output", command->output, "the picture, OUT.exr; a tone-mapped OUT.png is written beside it");
  app->add_option("--set", command->overrides, "table.key=VALUE: overrides the scene file; may be repeated")
      ->expected(1)
      ->take_all();
  app->add_option("--spp", command->samples, "samples per pixel")->check(CLI::Range(1LL, 4294967295LL));
  app->add_option("--seed", command->seed, "another seed, another noise")->check(CLI::NonNegativeNumber);
  app->add_option("--threads", command->threads, "0: as many as there are cores")->check(CLI::Range(0, 4096));
  app->add_option("--crop", command->crop, "X0,Y0,X1,Y1: only these pixels, the last column and row excluded");
  app->add_option("--time-limit", command->time_limit_s, "stop after so many seconds with what is done")
      ->check(CLI::NonNegativeNumber);
  app->add_flag("--resume", command->resume,
                "go on from what an interrupted run with this option has left in OUT.exr.checkpoint, and leave one");
  app->add_option("--checkpoint-seconds", command->checkpoint_s, "with --resume: how often the checkpoint is written")
      ->check(CLI::PositiveNumber);
  app->add_flag("--no-png", command->no_png, "write the EXR alone");
  app->add_flag("--quiet", command->quiet, "say nothing but errors and warnings");
  app->add_option("--progress", command->progress, "auto | json | none")
      ->check(CLI::IsMember({"auto", "json", "none"}));
  app->add_option("--cache", command->cache_folder, "folder of the phase tables (default: $XDG_CACHE_HOME/arcus/phase)");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
