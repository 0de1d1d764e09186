#include "motions/models/shape_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motions/base/interruption.h"
#include "motions/models/elementary.h"
#include "motions/scene/near_pairs.h"

namespace kds::models {

namespace {

using Eigen::Index;
using Eigen::Vector3d;

double dot(const Vector3d& a, const Vector3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Returns the least squared distance while the difference goes from `start` to `end`.
double least_square(const Vector3d& start, const Vector3d& end) {
  const Vector3d way = end - start;
  const double at_start = dot(start, way);
  if (at_start >= 0) return dot(start, start);
  if (dot(end, way) <= 0) return dot(end, end);
  return dot(start, start) - at_start * at_start / dot(way, way);
}

// Lists the nonadjacent beads that each bead might approach within one frame.
class Neighbours {
 public:
  Neighbours(const Shape& shape, double step) : lists_(static_cast<std::size_t>(shape.cols())) {
    const std::vector<double> reach(lists_.size(), clear_distance / 2 + step);
    visit_near_pairs(shape, reach, [&](BeadId a, BeadId b) {
      if (b - a < 2) return;
      lists_[a].push_back(b);
      lists_[b].push_back(a);
    });
  }
  [[nodiscard]] const std::vector<BeadId>& of(Index bead) const {
    return lists_[static_cast<std::size_t>(bead)];
  }

 private:
  std::vector<std::vector<BeadId>> lists_;
};

// Returns whether the bead's bonds stay short enough. Beads before this one have already moved, beads after
// it have not.
bool keeps_bonds(const Shape& before, const Shape& now, Index bead, const Vector3d& position) {
  constexpr double longest = 2 * radius * usual_bond;
  for (const Index other : {bead - 1, bead + 1}) {
    if (other < 0 || other >= now.cols()) continue;
    const double limit = std::max(longest * longest, squared_distance(before.col(bead), before.col(other)));
    if (squared_distance(position, now.col(other)) > limit) return false;
  }
  return true;
}

bool keeps_apart(const Shape& before, const Shape& now, const Neighbours& neighbours, Index bead,
                 const Vector3d& position) {
  constexpr double clear = clear_distance * radius;
  return std::all_of(neighbours.of(bead).begin(), neighbours.of(bead).end(), [&](BeadId other) {
    const Vector3d start = before.col(bead) - before.col(other);
    const Vector3d end = position - now.col(other);
    return least_square(start, end) >= std::min(clear * clear, dot(start, start));
  });
}

}  // namespace

std::vector<Shape> rotating(const Shape& shape, std::size_t frames, double step, int dimension) {
  const double norm = std::sqrt(14.0);
  const Vector3d axis = dimension == 2 ? Vector3d::UnitZ() : Vector3d{1 / norm, 2 / norm, 3 / norm};
  const Vector3d middle = centroid(shape);
  const auto cross = [&](const Vector3d& v) {
    return Vector3d{axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                    axis[0] * v[1] - axis[1] * v[0]};
  };
  double farthest = 0;
  for (Index b = 0; b < shape.cols(); ++b) {
    const Vector3d arm = cross(shape.col(b) - middle);
    farthest = std::max(farthest, dot(arm, arm));
  }
  const double turns = farthest == 0 ? 0 : step * radius / (2 * std::numbers::pi * std::sqrt(farthest));
  if (turns == 0) return std::vector<Shape>(frames, shape);
  std::vector<Shape> result{shape};
  for (std::size_t frame = 1; frame < frames; ++frame) {
    InterruptionCheck::ask();
    const auto [sine, cosine] = sine_cosine(turns * static_cast<double>(frame));
    Shape turned = shape;
    for (Index b = 0; b < shape.cols(); ++b) {
      const Vector3d v = shape.col(b) - middle;
      const Vector3d along = dot(axis, v) * axis;
      turned.col(b) = middle + along + cosine * (v - along) + sine * cross(v);
    }
    result.push_back(std::move(turned));
  }
  return result;
}

std::vector<Shape> wandering(const Shape& shape, std::size_t frames, double step, Random& random,
                             int dimension) {
  constexpr int tries = 20;
  std::vector<Shape> result{shape};
  while (result.size() < frames) {
    const Shape& before = result.back();
    const Neighbours neighbours(before, step * radius);
    Shape now = before;
    for (Index bead = 0; bead < now.cols(); ++bead) {
      InterruptionCheck::ask();
      for (int n = 0; n < tries; ++n) {
        const Vector3d position = before.col(bead) + step * radius * random.direction(dimension);
        if (!keeps_bonds(before, now, bead, position)) continue;
        if (!keeps_apart(before, now, neighbours, bead, position)) continue;
        now.col(bead) = position;
        break;
      }
    }
    result.push_back(std::move(now));
  }
  return result;
}

}  // namespace kds::models
