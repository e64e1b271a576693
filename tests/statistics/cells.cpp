#include "tests/statistics/cells.h"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace arcus::statistics {

namespace {

/// Integration error allowed in one piece, as a share of a cell: a million draws in a cell would
/// notice 1e-3.
constexpr double share_of_error = 1e-6;

template <unsigned n>
struct Rule {
  std::array<double, n> nodes, weights;  // on (0, 1)
  Rule() {
    static_assert(n % 2 == 0);
    using Half = boost::math::quadrature::gauss<double, n>;
    for (unsigned i = 0; i < n / 2; ++i) {
      nodes[i] = 0.5 * (1 - Half::abscissa()[i]);
      nodes[n - 1 - i] = 0.5 * (1 + Half::abscissa()[i]);
      weights[i] = weights[n - 1 - i] = 0.5 * Half::weights()[i];
    }
  }
};

struct Integral {
  double value = 0;
  bool positive = false;  // anywhere
};

void check(double density) {
  if (!(density >= 0) || !std::isfinite(density))
    throw std::invalid_argument("density " + std::to_string(density) + " found; must be 0 or more");
}

void check_count(int count) {
  if (count < 1)
    throw std::invalid_argument("cells: " + std::to_string(count) + " found; 1 or more");
}

struct Piece {
  double from, to;
  Integral integral;
};

/// Cuts [from, to] until the integral of each piece is known and small, and appends the pieces in
/// order.
class IntervalCutter {
 public:
  IntervalCutter(const std::function<double(double)>& density, double limit,
                 std::vector<Piece>& pieces)
      : density_(density), limit_(limit), pieces_(pieces) {}

  void cut(double from, double to) { cut({from, to, integral(from, to)}, 0); }

 private:
  Integral integral(double from, double to) const {
    Integral sum;
    for (std::size_t i = 0; i < rule_.nodes.size(); ++i) {
      const double density = density_(from + (to - from) * rule_.nodes[i]);
      check(density);
      sum.value += rule_.weights[i] * density * (to - from);
      sum.positive |= density > 0;
    }
    return sum;
  }

  void cut(const Piece& whole, int depth) {
    const double middle = 0.5 * (whole.from + whole.to);
    const Piece left{whole.from, middle, integral(whole.from, middle)};
    const Piece right{middle, whole.to, integral(middle, whole.to)};
    const double sum = left.integral.value + right.integral.value;
    const bool known = std::fabs(sum - whole.integral.value) <= share_of_error * limit_;
    if ((known && sum <= limit_ / 8) || depth == 50) {
      const bool positive = left.integral.positive || right.integral.positive;
      pieces_.push_back({whole.from, whole.to, {sum, positive}});
      return;
    }
    cut(left, depth + 1);
    cut(right, depth + 1);
  }

  const std::function<double(double)>& density_;
  double limit_;
  std::vector<Piece>& pieces_;
  Rule<8> rule_;
};

}  // namespace

IntervalCells::IntervalCells(const std::function<double(double)>& density, double from, double to,
                             int count, const std::vector<double>& breaks) {
  check_count(count);
  if (!(from < to)) throw std::invalid_argument("cells: the range is empty");
  std::vector<double> starts;
  for (int i = 0; i < 256; ++i) starts.push_back(from + (to - from) * i / 256);
  for (const double x : breaks)
    if (x > from && x < to) starts.push_back(x);
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  starts.push_back(to);

  const double limit = 1.0 / count;
  std::vector<Piece> pieces;
  IntervalCutter cutter(density, limit, pieces);
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) cutter.cut(starts[i], starts[i + 1]);

  edges_.push_back(from);
  double sum = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    sum += pieces[i].integral.value;
    const bool last = i + 1 == pieces.size();
    const bool changes = !last && pieces[i].integral.positive != pieces[i + 1].integral.positive;
    if (!last && !changes && sum < limit * (1 - 1e-9)) continue;
    edges_.push_back(pieces[i].to);
    probabilities_.push_back(sum);
    sum = 0;
  }
}

std::optional<std::size_t> IntervalCells::find(double x) const {
  if (!(x >= edges_.front() && x <= edges_.back())) return std::nullopt;
  const auto above = std::upper_bound(edges_.begin(), edges_.end(), x);
  return std::min<std::size_t>(static_cast<std::size_t>(above - edges_.begin()) - 1, size() - 1);
}

std::string IntervalCells::name(std::size_t cell) const {
  std::ostringstream text;
  text.precision(9);
  text << edges_[cell] << " .. " << edges_[cell + 1];
  return text.str();
}

struct SphereCells::Builder {
  SphereCells& cells;
  const std::function<double(const Vec3&)>& density_per_sr;
  double limit;
  std::vector<Point> peaks;
  Rule<6> rule;

  Integral integral(const Point& low, const Point& high) const {
    Integral sum;
    const double area = 2 * (high[0] - low[0]) * (high[1] - low[1]);  // dω = 2 ds dφ
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
      for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
        const double s = low[0] + (high[0] - low[0]) * rule.nodes[i];
        const double azimuth = low[1] + (high[1] - low[1]) * rule.nodes[j];
        const double density = density_per_sr(direction_at(cells.frame_, s, azimuth));
        check(density);
        sum.value += rule.weights[i] * rule.weights[j] * density * area;
        sum.positive |= density > 0;
      }
    return sum;
  }

  static std::array<Node, 2> halves(const Node& node, int coordinate) {
    std::array<Node, 2> two{Node{node.low, node.high}, Node{node.low, node.high}};
    two[0].high[coordinate] = two[1].low[coordinate] =
        0.5 * (node.low[coordinate] + node.high[coordinate]);
    return two;
  }

  /// Extent of a patch in angle [rad], across and along the azimuth.
  static Point extent(const Node& node) {
    const double low = 2 * std::asin(std::sqrt(node.low[0]));
    const double high = 2 * std::asin(std::sqrt(node.high[0]));
    const double sine = low < pi / 2 && high > pi / 2 ? 1 : std::max(std::sin(low), std::sin(high));
    return {high - low, sine * (node.high[1] - node.low[1])};
  }

  /// Must it be cut before its integral can be trusted, and where?
  std::optional<int> forced(const Node& node) const {
    if (node.high[1] - node.low[1] > 0.8) return 1;
    const bool at_pole = node.low[0] == 0 || node.high[0] == 1;
    if (at_pole && node.high[0] - node.low[0] > 1e-12) return 0;
    const Point size = extent(node);
    for (const Point& peak : peaks) {
      const bool inside = peak[0] >= node.low[0] && peak[0] <= node.high[0] &&
                          peak[1] >= node.low[1] && peak[1] <= node.high[1];
      if (inside && std::max(size[0], size[1]) > 1e-4) return size[0] > size[1] ? 0 : 1;
    }
    return std::nullopt;
  }

  void refine(std::size_t index, double value, int depth) {
    const Node node = cells.nodes_[index];
    double error[2];
    Integral sums[2];
    std::array<std::array<double, 2>, 2> parts;
    for (int coordinate = 0; coordinate < 2; ++coordinate) {
      const auto two = halves(node, coordinate);
      for (int i = 0; i < 2; ++i) {
        const Integral part = integral(two[i].low, two[i].high);
        parts[coordinate][i] = part.value;
        sums[coordinate].value += part.value;
        sums[coordinate].positive |= part.positive;
      }
      error[coordinate] = std::fabs(sums[coordinate].value - value);
    }
    std::optional<int> cut = forced(node);
    if (!cut && std::max(error[0], error[1]) > share_of_error * limit)
      cut = error[0] > error[1] ? 0 : 1;
    const Point size = extent(node);
    if (!cut && value > limit) cut = size[0] > size[1] ? 0 : 1;
    if (!cut || depth == 120) {
      Node& leaf = cells.nodes_[index];
      leaf.probability = sums[0].value;
      leaf.bright = sums[0].positive || sums[1].positive;
      leaf.dark = !leaf.bright;
      return;
    }
    const std::size_t first = cells.nodes_.size();
    const auto two = halves(node, *cut);
    cells.nodes_.insert(cells.nodes_.end(), two.begin(), two.end());
    cells.nodes_[index].halved = *cut;
    cells.nodes_[index].children = static_cast<int>(first);
    for (int i = 0; i < 2; ++i) refine(first + i, parts[*cut][i], depth + 1);
    for (std::size_t i = first; i < first + 2; ++i) {
      cells.nodes_[index].probability += cells.nodes_[i].probability;
      cells.nodes_[index].bright |= cells.nodes_[i].bright;
      cells.nodes_[index].dark |= cells.nodes_[i].dark;
    }
  }

  /// The largest parts of the tree that hold no more than a cell may, and not both light and dark.
  void number(std::size_t index) {
    Node& node = cells.nodes_[index];
    const bool whole = node.probability <= limit && !(node.bright && node.dark);
    if (node.children >= 0 && !whole) {
      number(static_cast<std::size_t>(node.children));
      number(static_cast<std::size_t>(node.children) + 1);
      return;
    }
    node.children = -1;
    node.cell = cells.probabilities_.size();
    cells.probabilities_.push_back(node.probability);
    cells.node_of_cell_.push_back(index);
  }
};

SphereCells::SphereCells(const std::function<double(const Vec3&)>& density_per_sr, const Vec3& axis,
                         int count, const std::vector<Vec3>& peaks)
    : frame_(frame_around(axis)) {
  check_count(count);
  Builder builder{*this, density_per_sr, 1.0 / count, {}, {}};
  for (const Vec3& peak : peaks) builder.peaks.push_back(coordinates(peak));
  nodes_.push_back({{0, 0}, {1, 2 * pi}});
  builder.refine(0, 0, 0);
  builder.number(0);
}

SphereCells::Point SphereCells::coordinates(const Vec3& direction) const {
  const double azimuth = std::atan2(dot(direction, frame_.other), dot(direction, frame_.side));
  return {sin2_half_angle(frame_.along, direction), azimuth < 0 ? azimuth + 2 * pi : azimuth};
}

std::optional<std::size_t> SphereCells::find(const Vec3& direction) const {
  if (!(std::fabs(squared_length(direction) - 1) < 2e-4)) return std::nullopt;
  const Point at = coordinates(direction);
  std::size_t index = 0;
  while (nodes_[index].children >= 0) {
    const Node& node = nodes_[index];
    const double middle = 0.5 * (node.low[node.halved] + node.high[node.halved]);
    index = static_cast<std::size_t>(node.children) + (at[node.halved] < middle ? 0 : 1);
  }
  return nodes_[index].cell;
}

std::string SphereCells::name(std::size_t cell) const {
  const Node& node = nodes_[node_of_cell_[cell]];
  const auto angle_deg = [](double s) { return degrees(2 * std::asin(std::sqrt(s))); };
  std::ostringstream text;
  text << "angle " << angle_deg(node.low[0]) << " .. " << angle_deg(node.high[0])
       << " deg, azimuth " << degrees(node.low[1]) << " .. " << degrees(node.high[1]) << " deg";
  return text.str();
}

}  // namespace arcus::statistics
