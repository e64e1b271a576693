// arcus compare: how two pictures of the same thing differ.

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

#include "phase/base/whole_file.h"
#include "src/analysis/compare.h"
#include "src/film/image_file.h"
#include "tools/command.h"

namespace arcus::tools {
namespace {

struct CompareCommand {
  std::string a, b, report;
};

void run(const CompareCommand& command) {
  if (!command.report.empty()) check_writable(command.report);
  const render::Image a = render::read_exr(command.a), b = render::read_exr(command.b);
  const std::string name_a = std::filesystem::path(command.a).filename().string();
  const std::string name_b = std::filesystem::path(command.b).filename().string();
  const render::Comparison comparison = render::compare(a, b, name_a, name_b);
  std::cout << render::figures_text(comparison);
  if (!command.report.empty())
    write_whole_file(command.report, render::html_report(a, b, comparison, name_a, name_b));
}

}  // namespace

void add_compare(CLI::App& program) {
  auto command = std::make_shared<CompareCommand>();
  CLI::App* app = program.add_subcommand("compare", "Error figures of two pictures and a picture of their difference");
  app->add_option("A", command->a, "a picture (EXR)")->required();
  app->add_option("B", command->b, "the picture that it is held against (EXR)")->required();
  app->add_option("-o,--output", command->report, "REPORT.html: figures, both pictures and their difference");
  app->callback([command] { run(*command); });
}

}  // namespace arcus::tools
