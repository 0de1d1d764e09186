#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kds/stopwatch.h"
#include "structures/box/enclosing_box.h"
#include "structures/closest/kinetic_closest_pair.h"
#include "structures/hull/convex_hull.h"
#include "structures/session/own_structures.h"
#include "structures/sorted/sorted_list.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

/// Returns the beads that make up the structure's state. Tournaments begin anew in each step, so only their
/// winners are part of it.
template <int D>
std::vector<BeadId> state_of(const SortedList<D>& list) {
  return {list.order().begin(), list.order().end()};
}
template <int D>
std::vector<BeadId> state_of(const EnclosingBox<D>& box) {
  return {box.ends().begin(), box.ends().end()};
}
std::vector<BeadId> state_of(const ConvexHull& hull) { return hull.state(); }
template <int D>
std::vector<BeadId> state_of(const KineticClosestPair<D>& closest) {
  if (!closest.pair()) return {};
  return {closest.pair()->begin(), closest.pair()->end()};
}

/// A structure of points in a run. Three functions say in what such structures differ: dump(structure) and
/// elements(structure) return its state at a frame, build(structure, centers) returns a StaticBuild.
template <class Structure, class Dump, class Elements, class Build>
class PointsInRun final : public RunningStructure {
 public:
  template <int D>
  PointsInRun(Simulator& simulator, const Scene& scene, const MotionRef<D>& motion, Dump dump,
              Elements elements, Build build)
      : scene_(scene), structure_(simulator, motion), dump_(dump), elements_(elements), build_(build) {}

  [[nodiscard]] KineticStructure& kinetic() override { return structure_; }
  void count_certificates(std::span<const BeadId>) override {
    if constexpr (requires { structure_.count_certificates(); }) structure_.count_certificates();
  }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {dump_(structure_)}; }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    return elements_(structure_);
  }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override { return state_of(structure_); }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_per_call<WallClock>(build_(structure_, scene_.centers(frame)));
  }

 private:
  const Scene& scene_;
  Structure structure_;
  Dump dump_;
  Elements elements_;
  Build build_;
};

/// Returns a specification's `make` for the structure Structure<D>, which exists in dimensions Least to Most.
/// The specification must refuse other scenes beforehand.
template <template <int> class Structure, int Least, int Most = 3, class Dump, class Elements, class Build>
auto make_of_points(Dump dump, Elements elements, Build build) {
  return make_of_motion<Least>([=]<int D>(Simulator& simulator, const Scene& scene,
                                          const MotionRef<D>& motion,
                                          const StructureSettings&) -> std::unique_ptr<RunningStructure> {
    if constexpr (D > Most) {
      return nullptr;
    } else {
      using InRun = PointsInRun<Structure<D>, Dump, Elements, Build>;
      return std::make_unique<InRun>(simulator, scene, motion, dump, elements, build);
    }
  });
}

using Centers = Eigen::Matrix3Xd;

template <int>
using ConvexHullIn = ConvexHull;

}  // namespace

StructureSpec sorted_structure() {
  StructureSpec spec;
  spec.name = "sorted";
  spec.order = 10;
  spec.by_default = [](const Scene& scene) { return scene.dimension() == 1; };
  spec.make = make_of_points<SortedList, 1>(
      [](const auto& list) { return dump_sorted(list.order()); },
      [](const auto& list) { return elements_in_order(list.order()); },
      [](const auto&, const Centers& centers) { return order_by_sorting(centers); });
  return spec;
}

StructureSpec box_structure() {
  StructureSpec spec;
  spec.name = "box";
  spec.order = 12;
  spec.make = make_of_points<EnclosingBox, 1>(
      [](const auto& box) { return dump_box(box.ends()); },
      [](const auto& box) { return elements_in_order(box.ends()); },
      [](const auto&, const Centers& centers) { return box_by_scanning(centers); });
  return spec;
}

StructureSpec hull_structure() {
  StructureSpec spec;
  spec.name = "hull";
  spec.order = 14;
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() == 2) return std::nullopt;
    return "needs points in the plane, this input has " + std::to_string(scene.dimension()) +
           (scene.dimension() == 1 ? " coordinate" : " coordinates");
  };
  spec.make = make_of_points<ConvexHullIn, 2, 2>(
      [](const ConvexHull& hull) { return dump_hull(hull.corners()); },
      [](const ConvexHull& hull) {
        CombinatorialElements elements{1, {}};
        for (const BeadId bead : hull.corners()) elements.add({bead});
        return elements;
      },
      [](const ConvexHull&, const Centers& centers) { return hull_by_cgal(centers); });
  return spec;
}

StructureSpec closest_structure() {
  StructureSpec spec;
  spec.name = "closest";
  spec.order = 16;
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() < 2) return needs_plane_or_space(scene);
    return std::nullopt;
  };
  spec.make = make_of_points<KineticClosestPair, 2>(
      [](const auto& closest) { return dump_closest(closest.pair()); },
      [](const auto& closest) {
        CombinatorialElements elements{1, {}};
        if (const auto& pair = closest.pair()) elements.add({0}, *pair);
        return elements;
      },
      // One edge of the Delaunay triangulation joins the closest pair.
      []<int D>(const KineticClosestPair<D>&, const Centers& centers) {
        const std::vector<double> no_weights(static_cast<std::size_t>(centers.cols()), 0);
        return triangulation_by_cgal<D>(centers, no_weights);
      });
  return spec;
}

}  // namespace kds
