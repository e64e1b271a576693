#pragma once
// Mean and variance of a stream of numbers, without cancellation.

#include <cmath>
#include <cstdint>

namespace arcus::statistics {

/// Running mean and variance: Welford, Technometrics 4 (1962), 419.
class Moments {
 public:
  void add(double x) {
    ++count_;
    const double step = x - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (x - mean_);
  }
  std::int64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Of one number, unbiased; 0 for fewer than two.
  double variance() const { return count_ < 2 ? 0 : squares_ / static_cast<double>(count_ - 1); }
  double variance_of_mean() const { return variance() / static_cast<double>(count_); }
  double standard_error() const { return std::sqrt(variance_of_mean()); }

 private:
  std::int64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// Means of consecutive batches, for numbers with a heavy tail: their mean over 1000 batches is
/// near enough to normal for Student's t where single numbers are not. An unfinished batch is not
/// counted.
class Batches {
 public:
  explicit Batches(std::int64_t size) : size_(size) {}
  void add(double x) {
    sum_ += x;
    if (++in_batch_ < size_) return;
    means_.add(sum_ / static_cast<double>(size_));
    sum_ = 0;
    in_batch_ = 0;
  }
  const Moments& means() const { return means_; }

 private:
  std::int64_t size_, in_batch_ = 0;
  double sum_ = 0;
  Moments means_;
};

}  // namespace arcus::statistics
