#pragma once
// Exact positions of all beads at one time, in integers of the tests (second_numbers.h), and the structures
// by brute force.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/curves.h"
#include "structures/hierarchy/box_hierarchy.h"
#include "structures/necklace/bead_pairs.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test {

/// Lengths are multiplied by one positive number, and weights by its square, which makes all of them whole.
struct ExactBalls {
  std::vector<std::vector<second::Integer>> centers;
  std::vector<second::Integer> radii, weights;
  second::Integer one;                             ///< the length 1
  std::vector<std::vector<second::Integer>> cell;  ///< the vectors of a periodic cell; empty if there is none

  [[nodiscard]] std::size_t dimension() const { return centers.front().size(); }
  /// Returns the square of the distance of two centres.
  [[nodiscard]] second::Integer square(BeadId a, BeadId b) const {
    second::Integer sum = 0;
    for (std::size_t axis = 0; axis < dimension(); ++axis) {
      const second::Integer along = centers[a][axis] - centers[b][axis];
      sum += along * along;
    }
    return sum;
  }
};

/// Computes the balls at time u of the step by the definition of Bezier curves.
template <int Dimension>
[[nodiscard]] ExactBalls balls_at(const Curves<Dimension>& curves, const Dyadic& u) {
  const auto rows = static_cast<BeadId>(curves.bead_count());
  const auto column = [&](auto value) {
    std::vector<double> numbers;
    for (int k = 0; k <= curves.own_degree(); ++k) numbers.push_back(value(k));
    return numbers;
  };
  std::vector<double> lengths{1}, squares;
  for (BeadId b = 0; b < rows; ++b)
    for (int k = 0; k <= curves.own_degree(); ++k) {
      for (int axis = 0; axis < Dimension; ++axis) lengths.push_back(curves.coordinate(b, k, axis));
      lengths.push_back(curves.radius(b, k));
      squares.push_back(curves.weight(b, k));
    }
  for (int i = 0; curves.cell() != nullptr && i < Dimension * (curves.own_degree() + 1) * Dimension; ++i)
    lengths.push_back(curves.cell()[i]);
  // Rounds the unit of squares down to twice a unit of lengths.
  const int of_squares = second::unit_of(squares);
  const int unit = std::min(second::unit_of(lengths), of_squares / 2 - 1);
  const second::Rational time = second::of(u);
  const second::Integer power = pow(denominator(time), static_cast<unsigned>(curves.own_degree()));
  ExactBalls balls;
  balls.one = second::whole_value(column([](int) { return 1.0; }), time, unit);
  for (int vector = 0; curves.cell() != nullptr && vector < Dimension; ++vector) {
    auto& along = balls.cell.emplace_back();
    for (int axis = 0; axis < Dimension; ++axis)
      along.push_back(second::whole_value(
          column([&](int k) { return curves.cell_coordinate(vector, k, axis); }), time, unit));
  }
  for (BeadId b = 0; b < rows; ++b) {
    auto& center = balls.centers.emplace_back();
    for (int axis = 0; axis < Dimension; ++axis)
      center.push_back(
          second::whole_value(column([&](int k) { return curves.coordinate(b, k, axis); }), time, unit));
    balls.radii.push_back(
        second::whole_value(column([&](int k) { return curves.radius(b, k); }), time, unit));
    balls.weights.push_back(
        power * second::whole_value(column([&](int k) { return curves.weight(b, k); }), time, 2 * unit));
  }
  return balls;
}

using Beads = std::vector<BeadId>;

// The answers of structures by their definitions, for the beads that are present. Among beads that tie, the
// least bead counts.

/// Returns the first and last bead along each axis.
[[nodiscard]] Beads box_of(const ExactBalls& balls, const Beads& present);
// In a cell, distances are those of nearest images, among images that are at most six cells away along each
// vector.

/// Returns the two beads, or nothing if fewer are present.
[[nodiscard]] Beads closest_of(const ExactBalls& balls, const Beads& present);
/// Returns the corners of the convex hull in the plane by gift wrapping, counterclockwise from the least.
[[nodiscard]] Beads hull_of(const ExactBalls& balls, const Beads& present);
/// Returns the beads of each node that reach furthest along each side of the directions.
[[nodiscard]] Beads supports_of(const ExactBalls& balls, const Beads& present,
                                const std::vector<BeadRange>& nodes,
                                std::span<const SlabDirection> directions);
/// Returns the pairs in question whose closed balls intersect, two ids for each pair.
[[nodiscard]] Beads contacts_of(const ExactBalls& balls, const Beads& present, const PairsAsked& asked);

/// Explains why the order is not that along the first axis, or returns nothing. Beads may tie in any order.
[[nodiscard]] std::optional<std::string> not_sorted(const ExactBalls& balls, const Beads& present,
                                                    const Beads& order);
/// Explains why these cells are not a regular triangulation of the present beads, or returns nothing. In
/// degenerate position every regular triangulation is accepted. Cells have dimension + 1 beads.
[[nodiscard]] std::optional<std::string> not_regular(const ExactBalls& balls, const Beads& present,
                                                     const std::vector<Beads>& cells);
/// Explains why these simplices are not the dual complex of the cells, or returns nothing. A simplex is
/// listed by its ascending beads.
[[nodiscard]] std::optional<std::string> not_dual(const ExactBalls& balls, const Beads& present,
                                                  const std::vector<Beads>& cells,
                                                  const std::vector<Beads>& simplices);
/// Returns the Betti numbers of a complex over the field of two elements, from the ranks of its boundary
/// matrices. Each simplex is listed by its ascending beads, with all its faces.
[[nodiscard]] std::array<std::int64_t, 3> betti_by_ranks(const std::vector<Beads>& simplices);
/// Explains why the smallest sphere through the basis is not the smallest one around a node's beads, or
/// returns nothing. All radii must be equal.
[[nodiscard]] std::optional<std::string> not_smallest(const ExactBalls& balls, const BeadRange& node,
                                                      const Beads& basis);

}  // namespace kds::test
