#include "motions/models/spiral.h"

#include <numbers>

#include "motions/models/elementary.h"

namespace kds::models {

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

}  // namespace kds::models
