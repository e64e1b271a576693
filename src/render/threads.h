#pragma once
// How many threads a piece of work may take.

#include <functional>

namespace arcus::render {

/// Does the work; all that is parallel in it keeps to so many threads, 0: as many as there are cores.
void on_threads(int threads, const std::function<void()>& work);

}  // namespace arcus::render
