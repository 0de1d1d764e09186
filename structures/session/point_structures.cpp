#include <fmt/format.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

/// Lines axis,min,max.
DumpFile dump_box(std::span<const BeadId> ends) {
  std::string text = "axis,min,max\n";
  for (std::size_t e = 0; e + 1 < ends.size(); e += 2)
    text += fmt::format("{},{},{}\n", "xyz"[e / 2], ends[e], ends[e + 1]);
  return {"box.csv", std::move(text)};
}

using Centers = Eigen::Matrix3Xd;

template <int>
using ConvexHullIn = ConvexHull;

}  // namespace

void add_point_structures(StructureRegistry& registry) {
  registry.add({.name = "sorted",
                .about = "order of the beads along the first axis",
                .net_changes = "ranks",
                .order = 10,
                .by_default = [](const Scene& scene) { return scene.dimension() == 1; },
                .make = make_of_points<SortedList, 1>(
                    [](const auto& list) {
                      return DumpFile{"sorted.csv", bead_lines(list.order())};
                    },
                    [](const auto& list) { return elements_in_order(list.order()); },
                    [](const auto&, const Centers& centers) { return order_by_sorting(centers); })});
  registry.add({.name = "box",
                .about = "smallest axis-aligned box around the centres: the bead at each of its ends",
                .net_changes = "ends with another bead",
                .order = 12,
                .make = make_of_points<EnclosingBox, 1>(
                    [](const auto& box) { return dump_box(box.ends()); },
                    [](const auto& box) { return elements_in_order(box.ends()); },
                    [](const auto&, const Centers& centers) { return box_by_scanning(centers); })});
  registry.add({.name = "hull",
                .about = "convex hull of the centres, in the plane",
                .net_changes = "corners",
                .order = 14,
                .refusal = [](const Scene& scene) -> std::optional<std::string> {
                  if (scene.dimension() == 2) return std::nullopt;
                  return "needs points in the plane, this input has " + std::to_string(scene.dimension()) +
                         (scene.dimension() == 1 ? " coordinate" : " coordinates");
                },
                .make = make_of_points<ConvexHullIn, 2, 2>(
                    [](const ConvexHull& hull) {
                      return DumpFile{"hull.csv", bead_lines(hull.corners())};
                    },
                    [](const ConvexHull& hull) {
                      CombinatorialElements elements{1, {}};
                      for (const BeadId bead : hull.corners()) elements.add({bead});
                      return elements;
                    },
                    [](const ConvexHull&, const Centers& centers) { return hull_by_cgal(centers); })});
  registry.add({.name = "closest",
                .about = "closest pair of centres, in the plane or in space",
                .net_changes = "the pair",
                .order = 16,
                .refusal = [](const Scene& scene) -> std::optional<std::string> {
                  if (scene.dimension() < 2) return needs_plane_or_space(scene);
                  return std::nullopt;
                },
                .make = make_of_points<KineticClosestPair, 2>(
                    [](const auto& closest) {
                      const auto& pair = closest.pair();
                      return DumpFile{"closest.csv",
                                      pair ? fmt::format("i,j\n{},{}\n", (*pair)[0], (*pair)[1]) : "i,j\n"};
                    },
                    [](const auto& closest) {
                      CombinatorialElements elements{1, {}};
                      if (const auto& pair = closest.pair()) elements.add({0}, *pair);
                      return elements;
                    },
                    // One edge of the Delaunay triangulation joins the closest pair.
                    []<int D>(const KineticClosestPair<D>&, const Centers& centers) {
                      const std::vector<double> no_weights(static_cast<std::size_t>(centers.cols()), 0);
                      return triangulation_by_cgal<D>(centers, no_weights);
                    })});
}

}  // namespace kds
