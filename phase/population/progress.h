#pragma once
// How far a long computation has come.

#include <algorithm>
#include <functional>
#include <mutex>

namespace arcus::phase {

/// Share done, from 0 to 1; called from one thread at a time.
using Progress = std::function<void(double)>;

/// Counts what is done and tells it, one thread at a time.
class Work {
 public:
  Work(const Progress& progress, double whole) : progress_(progress), whole_(whole) {}
  void done(double amount) {
    const std::lock_guard guard(mutex_);
    done_ += amount;
    if (progress_) progress_(std::min(1.0, done_ / whole_));
  }

 private:
  const Progress& progress_;
  double whole_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace arcus::phase
