#include "python/static_structures.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "motions/base/input_error.h"
#include "python/arrays.h"
#include "python/watch.h"
#include "structures/collision/auto_detector.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds::python {

namespace py = pybind11;

namespace {

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

py::array_t<std::int64_t> array_of_ids(std::vector<std::int64_t> ids) {
  const auto pairs = static_cast<py::ssize_t>(ids.size() / 2);
  return array_of(std::move(ids), {pairs, 2});
}

}  // namespace

py::tuple power_diagram(const Numbers& centers, const Numbers& radii) {
  const BallsGiven balls(centers, radii);
  std::vector<std::int64_t> ids, hidden;
  {
    const Watch watch;
    std::vector<double> weights;
    for (const double radius : balls.radii) weights.push_back(radius * radius);
    const DiagramEdges diagram =
        balls.in_dimension([&](auto dimension) { return static_edges<dimension>(balls.centers, weights); });
    for (BeadId bead = 0; bead < balls.radii.size(); ++bead)
      for (const BeadId other : diagram.edges.of(bead))
        if (bead < other) ids.insert(ids.end(), {bead, other});
    hidden.assign(diagram.hidden.begin(), diagram.hidden.end());
  }
  return py::make_tuple(array_of_ids(std::move(ids)), array_of(std::move(hidden)));
}

py::tuple enclosing_sphere(const Numbers& centers, const Numbers& radii) {
  const BallsGiven balls(centers, radii);
  const auto last = static_cast<BeadId>(balls.radii.size() - 1);
  const SmallestSphere smallest = [&] {
    const Watch watch;
    return balls.in_dimension([&](auto dimension) {
      return smallest_sphere<dimension>(Balls<dimension>(balls.centers, balls.radii), 0, last);
    });
  }();
  const Eigen::Vector3d& center = smallest.sphere.center;
  std::vector<std::int64_t> basis(smallest.basis.begin(), smallest.basis.end());
  return py::make_tuple(array_of(std::vector<double>(center.data(), center.data() + balls.dimension)),
                        smallest.sphere.radius, array_of(std::move(basis)));
}

py::tuple wrapped_hierarchy(const Numbers& centers, const Numbers& radii,
                            const std::vector<std::size_t>& necklaces) {
  const BallsGiven balls(centers, radii);
  const std::vector<BeadRange> ranges = balls.ranges(necklaces);
  std::vector<std::int64_t> beads;
  std::vector<double> spheres;
  {
    const Watch watch;
    balls.in_dimension([&](auto dimension) {
      StaticWrappedHierarchy<dimension> hierarchy(ranges);
      hierarchy.build(Balls<dimension>(balls.centers, balls.radii));
      for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
        const BeadRange range = hierarchy.tree().range(node);
        const Sphere sphere = hierarchy.sphere(node);
        beads.insert(beads.end(), {range.first, range.last});
        spheres.insert(spheres.end(),
                       {sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius});
      }
    });
  }
  const auto nodes = static_cast<py::ssize_t>(spheres.size() / 4);
  return py::make_tuple(array_of_ids(std::move(beads)), array_of(std::move(spheres), {nodes, 4}));
}

py::array_t<std::int64_t> colliding_pairs(const Numbers& centers, const Numbers& radii,
                                          const std::vector<std::size_t>& necklaces, std::size_t apart,
                                          double within) {
  const BallsGiven balls(centers, radii);
  if (!(within >= 0) || !std::isfinite(within))
    throw InputError(fmt::format("within: {} is no distance; expected a finite number from 0", within));
  const PairsAsked asked = balls.pairs(necklaces, apart);
  std::vector<std::int64_t> ids;
  {
    const Watch watch;
    balls.in_dimension([&](auto dimension) {
      AutoDetector<dimension> detector(asked);
      const Balls<dimension> given(balls.centers, balls.radii);
      for (const BeadPair& pair : within > 0 ? detector.pairs_within(given, within) : detector.pairs(given))
        ids.insert(ids.end(), {pair.first, pair.second});
    });
  }
  return array_of_ids(std::move(ids));
}

py::object closest_pair_of(const Numbers& centers, const Numbers& radii,
                           const std::vector<std::size_t>& necklaces, std::size_t apart) {
  const BallsGiven balls(centers, radii);
  const PairsAsked asked = balls.pairs(necklaces, apart);
  std::optional<ClosestPair> pair;
  {
    const Watch watch;
    pair = balls.in_dimension([&](auto dimension) {
      return AutoDetector<dimension>(asked).closest_pair(Balls<dimension>(balls.centers, balls.radii));
    });
  }
  if (!pair) return py::none();
  return py::make_tuple(pair->first, pair->second, pair->distance);
}

}  // namespace kds::python
