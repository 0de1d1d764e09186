#pragma once
// Balls at rest that Python gives, and arrays for what is made of them.

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

/// Balls of the caller, checked.
struct BallsGiven {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;
  int dimension = 3;

  BallsGiven(const Numbers& points, const Numbers& lengths) {
    if (points.ndim() != 2 || (points.shape(1) != 3 && points.shape(1) != 2) || points.shape(0) == 0)
      throw InputError(fmt::format("centers: has the shape {}; expected (beads, 3) or (beads, 2)",
                                   std::string(py::str(points.attr("shape")))));
    const auto beads = static_cast<std::size_t>(points.shape(0));
    if (lengths.size() != 1 && static_cast<std::size_t>(lengths.size()) != beads)
      throw InputError(fmt::format("radii: has {} numbers; expected {}, one for each bead, or one for all",
                                   lengths.size(), beads));
    dimension = static_cast<int>(points.shape(1));
    centers.setZero(3, static_cast<Eigen::Index>(beads));
    for (std::size_t bead = 0; bead < beads; ++bead) {
      for (int axis = 0; axis < dimension; ++axis) {
        const double x =
            points.data()[bead * static_cast<std::size_t>(dimension) + static_cast<std::size_t>(axis)];
        if (!std::isfinite(x))
          throw InputError(fmt::format("centers: bead {} has {} = {}, expected a finite coordinate", bead,
                                       "xyz"[axis], x));
        centers(axis, static_cast<Eigen::Index>(bead)) = x;
      }
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

/// Returns the numbers of spheres_of as an array (nodes, 4).
inline py::array_t<double> array_of_spheres(std::vector<double> spheres) {
  const auto nodes = static_cast<py::ssize_t>(spheres.size() / 4);
  return array_of(std::move(spheres), {nodes, 4});
}

}  // namespace kds::python
