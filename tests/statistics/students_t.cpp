#include "tests/statistics/students_t.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/statistics/budget.h"
#include "tests/statistics/seed.h"

namespace arcus::statistics {

namespace {

testing::AssertionResult judged(const std::string& what, double difference, double error,
                                double degrees, double scale, const MeanOptions& options) {
  std::ostringstream text;
  text.precision(8);
  text << what << "; difference " << difference << " +- " << error;
  if (options.tolerance > 0) text << ", of which " << options.tolerance << " is allowed";
  const double excess = std::max(0.0, std::fabs(difference) - options.tolerance);
  bool accepted = false;
  if (!std::isfinite(difference) || !std::isfinite(error)) {
    text << "; not finite";
  } else if (error == 0) {
    accepted = excess <= 1e-12 * scale;
    text << "; no spread, so they must be equal";
  } else {
    const double t = excess / error, p = students_p(t, degrees);
    const double level = sidak(false_alarms_per_test, options.comparisons);
    accepted = p >= level;
    text << "; t = " << t << " (" << degrees << " degrees of freedom), p = " << p
         << ", rejected below " << level;
  }
  text << "; " << test_name() << ", " << how_to_repeat();
  return (accepted ? testing::AssertionSuccess() : testing::AssertionFailure()) << text.str();
}

}  // namespace

double students_p(double t, double degrees) {
  if (std::isinf(t)) return 0;
  const boost::math::students_t distribution(degrees);
  return 2 * boost::math::cdf(boost::math::complement(distribution, std::fabs(t)));
}

testing::AssertionResult mean_is(const Moments& found, double expected, MeanOptions options) {
  if (found.count() < 2)
    return testing::AssertionFailure() << "a mean of " << found.count() << " numbers has no error";
  std::ostringstream what;
  what.precision(8);
  what << "mean " << found.mean() << " of " << found.count() << ", expected " << expected;
  return judged(what.str(), found.mean() - expected, found.standard_error(),
                static_cast<double>(found.count() - 1), std::fabs(expected), options);
}

testing::AssertionResult means_agree(const Moments& a, const Moments& b, MeanOptions options) {
  if (a.count() < 2 || b.count() < 2)
    return testing::AssertionFailure()
           << "means of " << a.count() << " and " << b.count() << " numbers have no error";
  const double va = a.variance_of_mean(), vb = b.variance_of_mean(), sum = va + vb;
  const double degrees =
      sum * sum /
      (va * va / static_cast<double>(a.count() - 1) + vb * vb / static_cast<double>(b.count() - 1));
  std::ostringstream what;
  what.precision(8);
  what << "means " << a.mean() << " of " << a.count() << " and " << b.mean() << " of " << b.count();
  return judged(what.str(), a.mean() - b.mean(), std::sqrt(sum), degrees, std::fabs(b.mean()),
                options);
}

}  // namespace arcus::statistics
