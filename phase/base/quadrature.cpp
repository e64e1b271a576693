#include "phase/base/quadrature.h"

#include <cassert>
#include <cmath>

#include "phase/base/units.h"

namespace arcus {

Quadrature gauss_legendre(int n) {
  assert(n >= 1);
  Quadrature rule;
  rule.nodes.resize(static_cast<std::size_t>(n));
  rule.weights.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = std::cos(pi * (i + 0.75) / (n + 0.5));
    double derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double previous = 1, value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      derivative = n * (x * value - previous) / (x * x - 1);
      const double step = value / derivative;
      x -= step;
      if (std::fabs(step) < 1e-15) break;
    }
    const double weight = 2 / ((1 - x * x) * derivative * derivative);
    const auto low = static_cast<std::size_t>(i), high = static_cast<std::size_t>(n - 1 - i);
    rule.nodes[low] = -x;
    rule.nodes[high] = x;
    rule.weights[low] = rule.weights[high] = weight;
  }
  if (n % 2 == 1) rule.nodes[static_cast<std::size_t>(n / 2)] = 0;
  return rule;
}

namespace {

double by_rule(const std::function<double(double)>& f, double a, double b) {
  static const Quadrature rule = gauss_legendre(15);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    sum += rule.weights[i] * f(0.5 * ((b - a) * rule.nodes[i] + a + b));
  return 0.5 * (b - a) * sum;
}

double by_halving(const std::function<double(double)>& f, double a, double b, double whole,
                  double tolerance, int depth) {
  const double middle = 0.5 * (a + b);
  const double left = by_rule(f, a, middle), right = by_rule(f, middle, b);
  if (depth == 0 || std::fabs(left + right - whole) <= tolerance) return left + right;
  return by_halving(f, a, middle, left, 0.5 * tolerance, depth - 1) +
         by_halving(f, middle, b, right, 0.5 * tolerance, depth - 1);
}

}  // namespace

double integrate(const std::function<double(double)>& f, double a, double b, double tolerance) {
  return by_halving(f, a, b, by_rule(f, a, b), tolerance, 40);
}

}  // namespace arcus
