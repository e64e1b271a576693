// arcus info: what a file holds, in words.

#include <CLI/CLI.hpp>

#include "tools/command.h"

namespace arcus::tools {

void add_info(CLI::App& program) { program.add_subcommand("info", "What a .vdb, .nc, .exr or .toml file holds"); }

}  // namespace arcus::tools
