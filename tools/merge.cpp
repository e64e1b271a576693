// arcus merge: tiles become a picture.

#include <CLI/CLI.hpp>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <memory>

#include "phase/base/error.h"
#include "phase/base/whole_file.h"
#include "src/film/image_file.h"
#include "src/render/merge.h"
#include "src/render/tile.h"
#include "tools/command.h"

namespace arcus::tools {
namespace {

struct MergeCommand {
  std::string folder, output;
  render::MergeOptions options;
  bool no_png = false, quiet = false;
};

void run(const MergeCommand& command) {
  const std::filesystem::path exr(command.output);
  if (exr.extension() != ".exr") throw bad_input("-o", "'" + command.output + "'", "a name that ends in .exr expected", "A .png is written beside it");
  const std::string png = std::filesystem::path(exr).replace_extension(".png").string();
  check_writable(command.output);  // before the work, not after it
  if (!command.no_png) check_writable(png);
  render::load_image_files();
  watch_for_interruption();
  const render::Merge merge = render::merge_tiles(command.folder, command.output, command.no_png ? "" : png, command.options);
  if (!merge.is_complete) throw Exit{stop_request() == SIGINT ? exit_interrupted : exit_terminated};
  if (merge.refused > 0)
    std::cerr << "arcus: warning: " << merge.refused << " samples were not finite and are left out; `arcus render --crop` around a black pixel names them\n";
  if (command.quiet) return;
  std::cerr << command.output << (command.no_png ? "" : " and .png");
  if (!merge.left_out.empty()) std::cerr << ": not complete: missing " << render::text_of_tiles(merge.left_out);
  std::cerr << '\n';
}

}  // namespace

void add_merge(CLI::App& program) {
  auto command = std::make_shared<MergeCommand>();
  CLI::App* app = program.add_subcommand("merge", "Check that tiles belong together and are complete, and join them");
  app->add_option("DIR", command->folder, "folder of the tiles")->required();
  app->add_option("-o,--output", command->output, "the picture, OUT.exr; a tone-mapped OUT.png is written beside it")->required();
  app->add_flag("--allow-partial", command->options.allow_partial, "a preview of what is there; the rest stays black");
  app->add_flag("--repair", command->options.repair, "delete damaged tiles, so that they are made again");
  app->add_flag("--no-png", command->no_png, "write the EXR alone");
  app->add_flag("--quiet", command->quiet, "say nothing but errors and warnings");
  command->options.stop_request = &stop_request();
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
