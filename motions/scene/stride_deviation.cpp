#include "motions/scene/stride_deviation.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "motions/curves/bezier_motion.h"

namespace kds {

namespace {

constexpr int most_degree = 3;
constexpr double denormal = std::numeric_limits<double>::denorm_min();
using ControlPoints = std::array<Eigen::Matrix3Xd, most_degree + 1>;

template <class M>
void load_control_points(const Scene& scene, std::size_t step, ControlPoints& points) {
  M motion(scene.bead_count());
  scene.load(step, motion);
  for (int k = 0; k <= M::degree; ++k) {
    Eigen::Matrix3Xd& of_degree = points[static_cast<std::size_t>(k)];
    of_degree.resize(3, static_cast<Eigen::Index>(scene.bead_count()));
    for (BeadId b = 0; b < scene.bead_count(); ++b) {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      for (int axis = 0; axis < M::dimension; ++axis) point[axis] = motion.coordinate(b, k, axis);
      of_degree.col(static_cast<Eigen::Index>(b)) = scene.in_input(point);
    }
  }
}

/// Computes the control points of the files' beads for a step of the scene.
void control_points_of(const Scene& scene, std::size_t step, ControlPoints& points) {
  if (scene.dimension() == 2) {
    return scene.degree() == 1 ? load_control_points<BezierMotion<2, 1>>(scene, step, points)
                               : load_control_points<BezierMotion<2, 3>>(scene, step, points);
  }
  return scene.degree() == 1 ? load_control_points<BezierMotion<3, 1>>(scene, step, points)
                             : load_control_points<BezierMotion<3, 3>>(scene, step, points);
}

/// Restricts a curve to the part between two times.
void cut(std::array<Eigen::Vector3d, most_degree + 1>& curve, int degree, double from, double to) {
  const auto size = static_cast<std::size_t>(degree);
  for (std::size_t round = 0; round < size; ++round)  // cut off the part after `to`
    for (std::size_t k = size; k > round; --k) curve[k] = (1 - to) * curve[k - 1] + to * curve[k];
  const double share = from / to;
  for (std::size_t round = size; round > 0; --round)  // and the part before `from`
    for (std::size_t k = 0; k < round; ++k) curve[k] = (1 - share) * curve[k] + share * curve[k + 1];
}

class DeviationSearch {
 public:
  DeviationSearch(const Scene& scene, std::size_t stride, double most)
      : scene_(scene), stride_(stride), most_(most) {
    found_.of_bead.assign(scene.bead_count(), 0);
  }

  /// Adds the part of a step between two consecutive frames of the files.
  void add(const ControlPoints& points, std::size_t part, const FrameRead& before, const FrameRead& after) {
    const int degree = scene_.degree();
    const double from = static_cast<double>(part) / static_cast<double>(stride_);
    const double to = static_cast<double>(part + 1) / static_cast<double>(stride_);
    for (BeadId b = 0; b < scene_.bead_count(); ++b) {
      const auto column = static_cast<Eigen::Index>(b);
      const Eigen::Vector3d first = before.positions.col(column), last = after.positions.col(column);
      std::array<Eigen::Vector3d, most_degree + 1> curve;
      double extent = first.lpNorm<1>() + last.lpNorm<1>();
      for (int k = 0; k <= degree; ++k) {
        curve[static_cast<std::size_t>(k)] = points[static_cast<std::size_t>(k)].col(column);
        extent += curve[static_cast<std::size_t>(k)].lpNorm<1>();
      }
      cut(curve, degree, from, to);
      for (int k = 0; k <= degree; ++k) {
        const double share = static_cast<double>(k) / degree;
        const Eigen::Vector3d apart =
            curve[static_cast<std::size_t>(k)] - ((1 - share) * first + share * last);
        // Covers a dozen roundings of lengths up to `extent` in each coordinate, and the rounding of the
        // norm. Near underflow, each rounding error is at most the smallest double.
        const double rounded = apart.stableNorm() * (1 + 0x1p-45) + 0x1p-45 * extent + 64 * denormal;
        const double bound = rounded < most_ ? rounded : most_;  // also most_ for NaN
        if (bound <= found_.of_bead[b]) continue;
        found_.of_bead[b] = bound;
        if (bound <= found_.largest) continue;
        found_.largest = bound;
        found_.bead = b;
        found_.frame = (2 * k < degree ? before : after).stamp.number;
      }
    }
  }
  void skip() { ++found_.skipped; }
  [[nodiscard]] StrideDeviation take() { return std::move(found_); }

 private:
  const Scene& scene_;
  std::size_t stride_;
  double most_;
  StrideDeviation found_;
};

}  // namespace

StrideDeviation deviation_of_stride(const Scene& scene, FrameSource& every, std::size_t stride,
                                    std::optional<double> most) {
  const FloatingPointScope to_nearest;
  DeviationSearch search(scene, stride, most.value_or(std::numeric_limits<double>::infinity()));
  ControlPoints points;
  FrameRead before, after;
  const auto read = [&](FrameRead& frame, std::size_t k) {
    if (every.next(frame) && frame.positions.cols() == static_cast<Eigen::Index>(scene.bead_count())) return;
    throw InputError(fmt::format("frame {} is gone since the input was first read", scene.frame_number(k)));
  };
  read(before, 0);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    control_points_of(scene, step, points);
    for (std::size_t part = 0; part < stride; ++part) {
      read(after, step);
      if (part + 1 < stride) search.skip();
      search.add(points, part, before, after);
      std::swap(before, after);
    }
    if (before.stamp.number != scene.frame_number(step + 1))
      throw InputError(fmt::format("frame {} is not where it was when the input was first read",
                                   scene.frame_number(step + 1)));
  }
  return search.take();
}

RadiiWithin radii_within(const StrideDeviation& deviation, std::span<const double> radii) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  RadiiWithin within{{radii.begin(), radii.end()}, {radii.begin(), radii.end()}, {}};
  within.has_a_ball.assign(radii.size(), 1);
  for (std::size_t b = 0; b < radii.size(); ++b) {
    const double by = deviation.of_bead[b];
    double& larger = within.larger[b];
    larger = std::nextafter(larger + by, infinity);
    if (!std::isfinite(larger * larger))
      throw InputError(
          fmt::format("bead {} may be {} from its position in the run, too far to decide about contacts; "
                      "expected frames closer to each other, or structures without contacts",
                      b, by));
    double& smaller = within.smaller[b];
    smaller = std::nextafter(smaller - by, -infinity);
    if (smaller > 0) continue;
    smaller = 0;
    within.has_a_ball[b] = 0;
  }
  return within;
}

}  // namespace kds
