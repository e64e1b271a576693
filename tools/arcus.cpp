// The program: names the subcommands, hands over, and turns what went wrong into the exit code.

#include <CLI/CLI.hpp>

#include <iostream>
#include <new>

#include "phase/base/error.h"
#include "tools/command.h"
#include "phase/base/version.h"

namespace arcus::tools {

namespace {

/// The nearest command or option to the first word that is neither; empty where all words are known, or none is near.
std::string suggestion(const CLI::App& program, int argc, char** argv) {
  const CLI::App* app = &program;
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    word = word.substr(0, word.find('='));
    std::vector<std::string> known;
    if (word.starts_with("-")) {
      if (app->get_option_no_throw(word)) continue;
      for (const CLI::Option* option : app->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    } else {
      const CLI::App* next = nullptr;
      for (const CLI::App* one : app->get_subcommands([](const CLI::App*) { return true; })) {
        known.push_back(one->get_name());
        if (one->get_name() == word) next = one;
      }
      if (known.empty()) continue;  // a file, or an option's value
      if (next) {
        app = next;
        continue;
      }
    }
    const std::string nearest = nearest_name(word, known);
    return nearest.empty() ? "" : "'" + word + "' is not known. Did you mean '" + nearest + "'?";
  }
  return "";
}

}  // namespace

static int run(int argc, char** argv) {
  CLI::App program("Renders light in weather: rainbows, fogbows, coronas, glories and halos from clouds in OpenVDB files.",
                   "arcus");
  program.set_version_flag("--version", std::string("arcus ") + version);
  program.require_subcommand(1);
  program.get_formatter()->column_width(36);
  add_render(program);
  add_tile(program);
  add_merge(program);
  add_status(program);
  add_farm(program);
  add_author(program);
  add_phase(program);
  add_info(program);
  add_profile(program);
  add_compare(program);
  add_compare_droplets(program);
  add_reference(program);
  try {
    program.parse(argc, argv);
    return exit_done;
  } catch (const CLI::ParseError& error) {
    const int code = program.exit(error, std::cout, std::cerr);
    if (code == 0) return exit_done;
    if (const std::string text = suggestion(program, argc, argv); !text.empty()) std::cerr << "arcus: " << text << '\n';
    return static_cast<int>(Fault::input);
  } catch (const Exit& exit) {
    return exit.code;
  }
}

}  // namespace arcus::tools

int main(int argc, char** argv) {
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
    std::cerr << "arcus: needs a processor with AVX2 and FMA (x86-64-v3)\n";
    return static_cast<int>(arcus::Fault::failed);
  }
  try {
    return arcus::tools::run(argc, argv);
  } catch (const arcus::Error& error) {
    std::cerr << "arcus: " << error.what() << '\n';
    return static_cast<int>(error.fault());
  } catch (const std::bad_alloc&) {
    std::cerr << "arcus: out of memory; a smaller picture, table or grid needs less\n";
    return static_cast<int>(arcus::Fault::failed);
  } catch (const std::exception& error) {
    std::cerr << "arcus: " << error.what() << '\n';
    return static_cast<int>(arcus::Fault::failed);
  }
}
