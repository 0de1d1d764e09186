#include "python/static_structures.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "motions/base/input_error.h"
#include "python/arrays.h"
#include "python/balls_given.h"
#include "python/watch.h"
#include "structures/collision/auto_detector.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds::python {

namespace py = pybind11;

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

namespace {

template <template <int> class Hierarchy>
py::tuple nodes_of(const Numbers& centers, const Numbers& radii, const std::vector<std::size_t>& necklaces) {
  const BallsGiven balls(centers, radii);
  const std::vector<BeadRange> ranges = balls.ranges(necklaces);
  std::vector<std::int64_t> beads;
  std::vector<double> spheres;
  {
    const Watch watch;
    balls.in_dimension([&](auto dimension) {
      Hierarchy<dimension> hierarchy(ranges);
      hierarchy.build(Balls<dimension>(balls.centers, balls.radii));
      for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
        const BeadRange range = hierarchy.tree().range(node);
        beads.insert(beads.end(), {range.first, range.last});
      }
      spheres = spheres_of(hierarchy);
    });
  }
  return py::make_tuple(array_of_ids(std::move(beads)), array_of_spheres(std::move(spheres)));
}

}  // namespace

py::tuple wrapped_hierarchy(const Numbers& centers, const Numbers& radii,
                            const std::vector<std::size_t>& necklaces) {
  return nodes_of<StaticWrappedHierarchy>(centers, radii, necklaces);
}

py::tuple layered_hierarchy(const Numbers& centers, const Numbers& radii,
                            const std::vector<std::size_t>& necklaces) {
  return nodes_of<LayeredHierarchy>(centers, radii, necklaces);
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
