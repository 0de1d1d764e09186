#include "motions/models/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"

namespace kds::models {

namespace {

using Curve = std::function<Eigen::Vector3d(double)>;  ///< maps t in [0, 1] to a point

/// Returns `beads` (at least 2) beads at equal arc lengths along the curve, ends included. The curve is
/// scaled so that consecutive beads are `bond` diameters apart along it, so their distance in space is at
/// most that. The curve is approximated by a polyline of `pieces` equal parts of [0, 1]; its corners should
/// be among the ends of the parts.
Shape beads_along(const Curve& curve, std::size_t beads, double bond, std::size_t pieces) {
  std::vector<Eigen::Vector3d> corners;
  std::vector<double> lengths;  // from the start to each corner
  for (std::size_t i = 0; i <= pieces; ++i) {
    corners.push_back(curve(static_cast<double>(i) / static_cast<double>(pieces)));
    lengths.push_back(i == 0 ? 0 : lengths.back() + std::sqrt(squared_distance(corners[i], corners[i - 1])));
  }
  const double gap = lengths.back() / static_cast<double>(beads - 1);
  const double scale = 2 * radius * bond / gap;
  Shape shape(3, static_cast<Eigen::Index>(beads));
  std::size_t piece = 1;
  for (std::size_t b = 0; b < beads; ++b) {
    const double position = std::min(gap * static_cast<double>(b), lengths.back());
    while (piece < pieces && lengths[piece] < position) ++piece;
    const double share = (position - lengths[piece - 1]) / (lengths[piece] - lengths[piece - 1]);
    shape.col(static_cast<Eigen::Index>(b)) =
        scale * ((1 - share) * corners[piece - 1] + share * corners[piece]);
  }
  return shape;
}

std::size_t pieces_for(std::size_t beads, std::size_t parts) {
  return parts * std::max<std::size_t>(1000, 4 * beads);
}

// Returns a point of the grill: six segments and five arcs, each on an eleventh of [0, 1]. Segments have
// length 4 and are 1 apart, and arcs are as deep as they are wide.
Eigen::Vector3d grill_at(double t) {
  constexpr double length = 4;
  const double part = std::min(std::floor(11 * t), 10.0);
  const double u = 11 * t - part;
  const int row = static_cast<int>(part) / 2;
  const bool forth = row % 2 == 0;
  double x = 0, y = row;
  if (static_cast<int>(part) % 2 == 0) {
    x = length * u;
  } else {
    x = length + 4 * u * (1 - u);
    y += u;
  }
  return {forth ? x : length - x, y, 0};
}

// A hash map of beads by grid cells, whose side is the distance that nonadjacent beads keep. The map is used
// only for look-up, so its order does not matter.
class Occupied {
 public:
  void add(const Eigen::Vector3d& position) { cells_[key(position, 0, 0, 0)].push_back(position); }
  void remove(const Eigen::Vector3d& position) {
    auto& cell = cells_[key(position, 0, 0, 0)];
    cell.erase(std::find(cell.begin(), cell.end(), position));
  }
  [[nodiscard]] bool near(const Eigen::Vector3d& position) const {
    for (int n = 0; n < 27; ++n) {
      const auto cell = cells_.find(key(position, n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
      if (cell == cells_.end()) continue;
      for (const Eigen::Vector3d& other : cell->second)
        if (squared_distance(position, other) < clear_distance * clear_distance) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] static std::int64_t key(const Eigen::Vector3d& position, int x, int y, int z) {
    const auto number = [](double at, int shift) {  // numbers from 0 on
      return static_cast<std::int64_t>(at / clear_distance) + shift + 1;
    };
    return (number(position[0], x) << 42U) + (number(position[1], y) << 21U) + number(position[2], z);
  }
  std::unordered_map<std::int64_t, std::vector<Eigen::Vector3d>> cells_;
};

}  // namespace

Shape spline(std::size_t beads, double bond, int dimension) {
  static const std::array<Eigen::Vector3d, 5> controls{Eigen::Vector3d{0, 0, 0}, Eigen::Vector3d{1, 2, 0.5},
                                                       Eigen::Vector3d{2, -1, 1}, Eigen::Vector3d{3, 2, 0.5},
                                                       Eigen::Vector3d{4, 0, 0}};
  const double height = dimension == 2 ? 0 : 1;
  const auto at = [height](double t) -> Eigen::Vector3d {
    const double part = std::min(std::floor(3 * t), 2.0);
    const double u = 3 * t - part;
    const auto i = static_cast<std::size_t>(part);
    // Clamped, with knots at thirds: pieces meet halfway between control points.
    const Eigen::Vector3d first = i == 0 ? controls[0] : Eigen::Vector3d((controls[i] + controls[i + 1]) / 2);
    const Eigen::Vector3d last =
        i == 2 ? controls[4] : Eigen::Vector3d((controls[i + 1] + controls[i + 2]) / 2);
    Eigen::Vector3d point = (1 - u) * (1 - u) * first + 2 * u * (1 - u) * controls[i + 1] + u * u * last;
    point.z() *= height;
    return point;
  };
  return beads_along(at, beads, bond, pieces_for(beads, 3));
}

Shape helix(std::size_t beads, double turns, double bond) {
  const auto gaps = static_cast<double>(beads - 1);
  const double sine = sine_cosine(turns / gaps / 2).sine;
  const double side = 2 * radius * bond / std::sqrt(sine * sine + 1 / (gaps * gaps));
  Shape shape(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) {
    const double share = static_cast<double>(b) / gaps;
    const auto [s, c] = sine_cosine(turns * share);
    shape.col(static_cast<Eigen::Index>(b)) << side / 2 * c, side / 2 * s, side * (share - 0.5);
  }
  return shape;
}

double turns_at_pitch(std::size_t beads, double pitch) {
  // A turn is pi sides long, so a bond is about pi turns / beads sides, and turns are 1 / turns sides apart.
  return std::sqrt(static_cast<double>(beads) / (std::numbers::pi * pitch));
}

Shape grill(std::size_t beads, double bond) {
  return beads_along(grill_at, beads, bond, pieces_for(beads, 11));
}

Shape packed_grid(std::size_t beads, int dimension, double gap, double bond) {
  const double step = 2 * radius * bond;
  const double apart = 2 * radius * (1 + gap);
  const double beside = std::sqrt(step * step - apart * apart / 4);
  const auto count = static_cast<double>(beads);
  const double root = dimension == 2 ? std::sqrt(count) : cube_root(count);
  const auto side = std::max<std::size_t>(2, static_cast<std::size_t>(std::nearbyint(root)));

  std::vector<Eigen::Vector3d> positions;
  bool right = true, up = true;
  std::size_t row = 0, layer = 0;
  const auto x_of = [&](std::size_t i) { return step * static_cast<double>(right ? i : side - 1 - i); };
  while (positions.size() < beads) {
    const double y = apart * static_cast<double>(row), z = apart * static_cast<double>(layer);
    for (std::size_t i = 0; i < side; ++i) positions.emplace_back(x_of(i), y, z);
    const bool layer_ends = dimension == 3 && (up ? row + 1 == side : row == 0);
    const double x = x_of(side - 1) + (right ? beside : -beside);
    const double half = apart / 2;
    if (layer_ends) {
      positions.emplace_back(x, y, z + half);
      up = !up;
      ++layer;
    } else {
      positions.emplace_back(x, up ? y + half : y - half, z);
      row = up ? row + 1 : row - 1;
    }
    right = !right;
  }
  Shape shape(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) shape.col(static_cast<Eigen::Index>(b)) = positions[b];
  return shape;
}

Shape spiral(std::size_t beads, double turns, double rolled, double bond) {
  constexpr double last_over_first = 5;
  const double step = 2 * radius * bond;
  const double length = step * static_cast<double>(beads - 1);
  const double first = length / (last_over_first - 1);
  const double turns_per_log = turns * rolled / logarithm(last_over_first);
  const double k = 2 * std::numbers::pi * turns_per_log;
  Shape shape(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) {
    const double s = first + step * static_cast<double>(b);
    const auto [sine, cosine] = sine_cosine(turns_per_log * logarithm(s / (first + length)));
    const double scale = s / (1 + k * k);
    shape.col(static_cast<Eigen::Index>(b)) << scale * (cosine + k * sine), scale * (sine - k * cosine), 0;
  }
  const Eigen::Vector3d middle = centroid(shape);
  for (Eigen::Index b = 0; b < shape.cols(); ++b) shape.col(b) -= middle;
  return shape;
}

Shape facing_spiral(const Shape& spiral, double distance, double bond) {
  Shape other = -spiral;
  const double length = 2 * radius * bond * static_cast<double>(spiral.cols() - 1);
  for (Eigen::Index b = 0; b < other.cols(); ++b) other(1, b) += distance * length;
  return other;
}

Shape random_chain(std::size_t beads, double fill, Random& random, double bond) {
  constexpr int tries_a_bead = 200;
  constexpr std::size_t steps_back = 30;
  const double volume = 4 * std::numbers::pi / 3 * static_cast<double>(beads) / fill;
  const double side = cube_root(volume);
  std::vector<Eigen::Vector3d> chain{Eigen::Vector3d::Constant(side / 2)};
  Occupied occupied;  // all beads except the last
  std::size_t dead_ends = 0;
  while (chain.size() < beads) {
    InterruptionCheck::ask();
    int tries = tries_a_bead;
    for (; tries > 0; --tries) {
      const Eigen::Vector3d next = chain.back() + 2 * radius * bond * random.direction();
      const bool inside = next.minCoeff() >= 0 && next.maxCoeff() <= side;
      if (!inside || occupied.near(next)) continue;
      occupied.add(chain.back());
      chain.push_back(next);
      break;
    }
    if (tries > 0) continue;
    if (++dead_ends > 100 + beads)
      throw InputError(
          "--fill",
          fmt::format("found no chain of {} beads that fill {} of their cube; give less", beads, fill));
    for (std::size_t back = 0; back < steps_back && chain.size() > 1; ++back) {
      chain.pop_back();
      occupied.remove(chain.back());
    }
  }
  Shape shape(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) shape.col(static_cast<Eigen::Index>(b)) = chain[b];
  return shape;
}

Shape jittered(Shape shape, double distance, Random& random, int dimension) {
  for (Eigen::Index bead = 0; bead < shape.cols(); ++bead) {
    const double length = distance * radius * random.uniform();
    shape.col(bead) += length * random.direction(dimension);
  }
  return shape;
}

}  // namespace kds::models
