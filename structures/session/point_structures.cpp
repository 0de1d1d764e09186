#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
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

/// The layers of a structure of points, for replays.
template <class Structure>
struct Shown;

template <int D>
struct Shown<SortedList<D>> {
  static constexpr ReplayLayer layer{"order", 2, 1};

  std::vector<BeadId> order, ranks;  // followed, because a search for a bead would be slow

  std::vector<ReplayElement> elements(const SortedList<D>& list) {
    order = list.order();
    ranks.assign(order.empty() ? 0 : *std::max_element(order.begin(), order.end()) + 1, no_bead);
    std::vector<ReplayElement> all;
    for (BeadId rank = 0; rank < order.size(); ++rank) {
      ranks[order[rank]] = rank;
      all.push_back(replay_element({rank, order[rank]}));
    }
    return all;
  }
  bool edits(const Change& change, std::vector<ReplayEdit>& edits) {
    if (change.kind == SortedList<D>::interchanges) {
      const auto [first, second] = std::pair(change.ids[0], change.ids[1]);
      std::swap(ranks[first], ranks[second]);
      for (const BeadId bead : {first, second}) {
        order[ranks[bead]] = bead;
        edits.push_back({0, true, replay_element({ranks[bead], bead})});
      }
    } else if (change.kind != SortedList<D>::changes) {
      insert_or_erase(change, edits);
    }
    return true;
  }

 private:
  /// Every bead behind the place gets another rank.
  void insert_or_erase(const Change& change, std::vector<ReplayEdit>& edits) {
    const BeadId bead = change.ids[0];
    const bool inserts = change.kind == SortedList<D>::inserts;
    const BeadId place = !inserts ? ranks[bead] : change.ids[1] == no_bead ? 0 : ranks[change.ids[1]] + 1;
    if (inserts)
      order.insert(order.begin() + place, bead);
    else
      order.erase(order.begin() + place);
    if (bead >= ranks.size()) ranks.resize(bead + std::size_t{1}, no_bead);
    for (BeadId rank = place; rank < order.size(); ++rank) {
      ranks[order[rank]] = rank;
      edits.push_back({0, true, replay_element({rank, order[rank]})});
    }
    if (!inserts) edits.push_back({0, false, replay_element({static_cast<BeadId>(order.size())})});
  }
};

template <int D>
struct Shown<EnclosingBox<D>> {
  static constexpr ReplayLayer layer{"ends", 2, 1};

  static std::vector<ReplayElement> elements(const EnclosingBox<D>& box) {
    std::vector<ReplayElement> all;
    for (BeadId end = 0; end < box.ends().size(); ++end)
      if (box.ends()[end] != no_bead) all.push_back(replay_element({end, box.ends()[end]}));
    return all;
  }
  static bool edits(const Change& change, std::vector<ReplayEdit>& edits) {
    using Box = EnclosingBox<D>;
    if (change.kind < Box::first_end || change.kind >= Box::inserts) return true;
    const BeadId end = change.kind - BeadId{Box::first_end}, bead = change.ids[1];
    edits.push_back({0, bead != no_bead, replay_element({end, bead})});
    return true;
  }
};

template <>
struct Shown<ConvexHull> {
  static constexpr ReplayLayer layer{"hull", 2, 1};

  static std::vector<ReplayElement> elements(const ConvexHull& hull) {
    std::vector<ReplayElement> all;
    const auto& corners = hull.corners();
    for (std::size_t k = 0; k < corners.size(); ++k)
      all.push_back(replay_element({corners[k], corners[(k + 1) % corners.size()]}));
    return all;
  }
  static bool edits(const Change& change, std::vector<ReplayEdit>& edits) {
    const auto [corner, before, after] = std::tuple(change.ids[0], change.ids[1], change.ids[2]);
    if (change.kind == ConvexHull::enter) {
      edits.push_back({0, true, replay_element({corner, after})});
      if (before != corner) edits.push_back({0, true, replay_element({before, corner})});
    } else if (change.kind == ConvexHull::leave) {
      edits.push_back({0, false, replay_element({corner})});
      if (before != corner) edits.push_back({0, true, replay_element({before, after})});
    }
    return true;
  }
};

template <int D>
struct Shown<KineticClosestPair<D>> {
  static constexpr ReplayLayer layer{"closest", 2, 2};

  static std::vector<ReplayElement> elements(const KineticClosestPair<D>& closest) {
    if (!closest.pair()) return {};
    return {replay_element({(*closest.pair())[0], (*closest.pair())[1]})};
  }
  static bool edits(const Change& change, std::vector<ReplayEdit>& edits) {
    if (change.kind != KineticClosestPair<D>::replace) return true;
    for (const std::size_t at : {0U, 2U})
      if (change.ids[at] != no_bead)
        edits.push_back({0, at == 2, replay_element({change.ids[at], change.ids[at + 1]})});
    return true;
  }
};

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
  [[nodiscard]] ReplayScheme replay_scheme() const override { return {{Shown<Structure>::layer}, {}}; }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    return {shown_.elements(structure_)};
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    return shown_.edits(change, edits);
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_per_call<WallClock>(build_(structure_, scene_.centers(frame)));
  }

 private:
  const Scene& scene_;
  Structure structure_;
  mutable Shown<Structure> shown_;  // follows the changes, for replays
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
                .about = "closest pair of centres, of nearest images in a cell; in the plane or in space",
                .net_changes = "the pair",
                .order = 16,
                .refusal = [](const Scene& scene) -> std::optional<std::string> {
                  if (scene.dimension() < 2) return needs_plane_or_space(scene);
                  return std::nullopt;
                },
                .across_walls = "closest pairs",
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
