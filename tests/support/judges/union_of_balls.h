#pragma once
// Areas and volumes of a union of few balls from all pairs and triples of balls, without a triangulation.
// Contact areas are computed with numbers of 50 digits; areas and the volume of the union are integrals over
// heights.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kds::test {

class UnionOfBalls {
 public:
  UnionOfBalls(const Eigen::Matrix3Xd& centers, std::vector<double> radii);

  /// Returns the area of sphere i outside all other balls: the integral of the exposed arc's angle over
  /// heights.
  [[nodiscard]] double area(std::size_t i) const;
  /// Returns the area in which the power cells of two balls meet, within the balls: a disc clipped by
  /// half-planes.
  [[nodiscard]] double contact(std::size_t i, std::size_t j) const;
  /// Returns the volume of ball i in its power cell: pyramids over `area` and all contacts.
  [[nodiscard]] double volume(std::size_t i) const;
  /// Returns the volume of the union: the integral of the areas of cross-sections.
  [[nodiscard]] double volume() const;

 private:
  Eigen::Matrix3Xd centers_;
  std::vector<double> radii_;
  // For each ball, the heights at which its cross-section changes: the ends of its sphere and of its circles,
  // and its exposed corners.
  std::vector<std::vector<double>> heights_;
};

}  // namespace kds::test
