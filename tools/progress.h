#pragma once
// How far a rendering is: a line for people, one JSON object a line for programs, or nothing.

#include <functional>
#include <string>

#include "src/render/render.h"

namespace arcus::tools {

/// kind: auto (a line that is rewritten on a terminal, nothing in a pipe) | json | none. All goes to stderr.
std::function<void(const render::Progress&)> progress_report(const std::string& kind);

/// Ends the line that is rewritten, if there is one.
void end_progress(const std::string& kind);

}  // namespace arcus::tools
