#pragma once
// Balls at rest as Python gives them, checked, and helpers that return results as arrays.

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "python/arrays.h"
#include "python/static_structures.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/necklace/necklace_tree.h"

namespace kds::python {

namespace py = pybind11;

/// Returns the points of an array (beads, 2) or (beads, 3) as columns, checked. `name` is the caller's.
inline Eigen::Matrix3Xd points_given(const char* name, const Numbers& points, py::ssize_t least = 1) {
  if (points.ndim() != 2 || (points.shape(1) != 3 && points.shape(1) != 2) || points.shape(0) == 0)
    throw InputError(fmt::format("{}: has the shape {}; expected (beads, 3) or (beads, 2)", name,
                                 std::string(py::str(points.attr("shape")))));
  if (points.shape(0) < least)
    throw InputError(fmt::format("{}: has 1 bead; expected {} or more", name, least));
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Zero(3, points.shape(0));
  for (py::ssize_t bead = 0; bead < points.shape(0); ++bead)
    for (py::ssize_t axis = 0; axis < points.shape(1); ++axis) {
      const double x = points.at(bead, axis);
      if (!std::isfinite(x))
        throw InputError(
            fmt::format("{}: bead {} has {} = {}, expected a finite coordinate", name, bead, "xyz"[axis], x));
      columns(axis, bead) = x;
    }
  return columns;
}

/// Balls of the caller, checked.
struct BallsGiven {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
  int dimension = 3;

  BallsGiven(const Numbers& points, const Numbers& lengths, const char* name = "centers")
      : centers(points_given(name, points)) {
    const auto beads = static_cast<std::size_t>(points.shape(0));
    if (lengths.size() != 1 && static_cast<std::size_t>(lengths.size()) != beads)
      throw InputError(fmt::format("radii: has {} numbers; expected {}, one for each bead, or one for all",
                                   lengths.size(), beads));
    dimension = static_cast<int>(points.shape(1));
    for (std::size_t bead = 0; bead < beads; ++bead) {
      const double radius = lengths.data()[lengths.size() == 1 ? 0 : bead];
      if (!(radius >= 0) || !std::isfinite(radius))
        throw InputError(
            fmt::format("radii: bead {} has the radius {}, expected a finite number from 0", bead, radius));
      radii.push_back(radius);
    }
  }

  /// Calls `visit` with the dimension as a constant.
  template <class Visit>
  auto in_dimension(Visit visit) const {
    if (dimension == 2) return visit(std::integral_constant<int, 2>());
    return visit(std::integral_constant<int, 3>());
  }

  [[nodiscard]] std::vector<BeadRange> ranges(const std::vector<std::size_t>& necklaces) const {
    std::vector<BeadRange> ranges;
    std::size_t first = 0;
    for (const std::size_t beads : necklaces) {
      if (beads == 0 || first + beads > radii.size()) break;
      ranges.push_back({static_cast<BeadId>(first), static_cast<BeadId>(first + beads - 1)});
      first += beads;
    }
    if (necklaces.empty()) return {{0, static_cast<BeadId>(radii.size() - 1)}};
    if (ranges.size() != necklaces.size() || first != radii.size())
      throw InputError(fmt::format("necklaces: expected numbers of beads above 0 with the sum {}, all beads",
                                   radii.size()));
    return ranges;
  }

  [[nodiscard]] PairsAsked pairs(const std::vector<std::size_t>& necklaces, std::size_t apart) const {
    if (apart < 1 || apart > 1'000'000'000)
      throw InputError(fmt::format("apart: {} is no distance along a chain; expected 1 or more", apart));
    return {ranges(necklaces), true, static_cast<BeadId>(apart), true};
  }
};

/// Returns the pairs of ids as an array (m, 2).
inline py::array_t<std::int64_t> array_of_ids(std::vector<std::int64_t> ids) {
  const auto pairs = static_cast<py::ssize_t>(ids.size() / 2);
  return array_of(std::move(ids), {pairs, 2});
}

/// Returns centre and radius of each node's sphere, one after the other.
template <class Hierarchy>
std::vector<double> spheres_of(const Hierarchy& hierarchy) {
  std::vector<double> spheres;
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const Sphere sphere = hierarchy.sphere(node);
    spheres.insert(spheres.end(), {sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius});
  }
  return spheres;
}

/// Returns the numbers of spheres_of as an array (nodes, 4). Refuses coordinates so large that a sphere of
/// theirs is no double.
inline py::array_t<double> array_of_spheres(std::vector<double> spheres) {
  for (const double number : spheres)
    if (!std::isfinite(number))
      throw InputError("centers: are too large, so that the spheres around them overflow doubles");
  const auto nodes = static_cast<py::ssize_t>(spheres.size() / 4);
  return array_of(std::move(spheres), {nodes, 4});
}

}  // namespace kds::python
