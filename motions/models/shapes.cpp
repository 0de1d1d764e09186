#include "motions/models/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "motions/models/curve.h"
#include "motions/models/elementary.h"

namespace kds::models {

namespace {

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

}  // namespace

Shape spline(std::size_t beads, double bond) {
  static const std::array<Eigen::Vector3d, 5> controls{Eigen::Vector3d{0, 0, 0}, Eigen::Vector3d{1, 2, 0.5},
                                                       Eigen::Vector3d{2, -1, 1}, Eigen::Vector3d{3, 2, 0.5},
                                                       Eigen::Vector3d{4, 0, 0}};
  const auto at = [](double t) -> Eigen::Vector3d {
    const double part = std::min(std::floor(3 * t), 2.0);
    const double u = 3 * t - part;
    const auto i = static_cast<std::size_t>(part);
    // Clamped, with knots at thirds: pieces meet halfway between control points.
    const Eigen::Vector3d first = i == 0 ? controls[0] : Eigen::Vector3d((controls[i] + controls[i + 1]) / 2);
    const Eigen::Vector3d last =
        i == 2 ? controls[4] : Eigen::Vector3d((controls[i + 1] + controls[i + 2]) / 2);
    return (1 - u) * (1 - u) * first + 2 * u * (1 - u) * controls[i + 1] + u * u * last;
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

  std::vector<Eigen::Vector3d> places;
  bool right = true, up = true;
  std::size_t row = 0, layer = 0;
  const auto x_of = [&](std::size_t i) { return step * static_cast<double>(right ? i : side - 1 - i); };
  while (places.size() < beads) {
    const double y = apart * static_cast<double>(row), z = apart * static_cast<double>(layer);
    for (std::size_t i = 0; i < side; ++i) places.emplace_back(x_of(i), y, z);
    const bool layer_ends = dimension == 3 && (up ? row + 1 == side : row == 0);
    const double x = x_of(side - 1) + (right ? beside : -beside);
    const double half = apart / 2;
    if (layer_ends) {
      places.emplace_back(x, y, z + half);
      up = !up;
      ++layer;
    } else {
      places.emplace_back(x, up ? y + half : y - half, z);
      row = up ? row + 1 : row - 1;
    }
    right = !right;
  }
  Shape shape(3, static_cast<Eigen::Index>(beads));
  for (std::size_t b = 0; b < beads; ++b) shape.col(static_cast<Eigen::Index>(b)) = places[b];
  return shape;
}

}  // namespace kds::models
