#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kds/stopwatch.h"
#include "structures/collision/cell_list.h"
#include "structures/contacts/contacts.h"
#include "structures/necklace/pairs_in_question.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/session/own_structures.h"
#include "structures/session/structure_spec.h"
#include "structures/triangulation/diagram_edges.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int Dimension>
class PowerInRun final : public RunningStructure {
 public:
  PowerInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), diagram_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return diagram_; }
  void count_certificates(std::span<const BeadId> changed) override { diagram_.count_certificates(changed); }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const override {
    const auto at_frame = diagram_.at_frame(frame == 0);
    return {dump_cells(at_frame.cells), {"hidden.csv", bead_lines(at_frame.hidden)}};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t frame) const override {
    CombinatorialElements elements{Dimension + 1, {}};
    for (CellBeads<Dimension> cell : diagram_.at_frame(frame == 0).cells) {
      std::sort(cell.begin(), cell.end());
      elements.add({}, cell);
    }
    return elements;
  }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override { return diagram_.state(); }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    return {{{"edges", 2, 2}, {"hidden", 1, 1}}, {}};
  }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool built) const override {
    const DiagramEdges diagram = diagram_.edges_at_frame(built);
    std::vector<std::vector<ReplayElement>> elements(2);
    for (BeadId a = 0; a < scene_.bead_count(); ++a)
      for (const BeadId b : diagram.edges.of(a))
        if (a < b) elements[0].push_back(replay_element({a, b}));
    for (const BeadId bead : diagram.hidden) elements[1].push_back(replay_element({bead}));
    return elements;
  }
  /// A flip of a facet in space adds one edge, a flip of an edge removes one, and a bead that hides or shows
  /// loses or gets its edges to the beads of one cell. Edits and repairs list cleared and filled cells first,
  /// and a rebuild lists none.
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    using Events = DiagramEvents<Dimension>;
    const auto edge = [&](bool adds, BeadId a, BeadId b) {
      if (a != infinite_bead && b != infinite_bead)
        edits.push_back({0, adds, replay_element({std::min(a, b), std::max(a, b)})});
    };
    const auto& ids = change.ids;
    if constexpr (Dimension == 2) {
      if (change.kind == Events::to_edge) {
        edge(false, ids[0], ids[1]);
        edge(true, ids[2], ids[3]);
        return true;
      }
    } else if (change.kind == Events::to_edge || change.kind == Events::to_facet) {
      edge(change.kind == Events::to_edge, ids[3], ids[4]);
      return true;
    }
    if (change.kind == Events::hides || change.kind == Events::shows) {
      const BeadId bead = ids[Dimension + 1];
      const bool hides = change.kind == Events::hides;
      for (std::size_t i = 0; i <= Dimension; ++i) edge(!hides, ids[i], bead);
      edits.push_back({1, hides, replay_element({bead})});
      return true;
    }
    return change.kind == Events::wanders || change.kind == Events::clears || change.kind == Events::fills;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_per_call<WallClock>(
        triangulation_by_cgal<Dimension>(scene_.centers(frame), scene_.weights(frame)));
  }

 private:
  const Scene& scene_;
  PowerDiagram<Dimension> diagram_;
};

template <int Dimension>
class ContactsInRun final : public RunningStructure {
 public:
  ContactsInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion,
                const PairsAsked& asked, const std::optional<ContactDistance>& distance)
      : scene_(scene),
        radii_(distance ? contact_radii(*distance, scene.radii()) : scene.radii()),
        cells_(asked),
        contacts_(simulator, motion, asked, distance ? radii_ : std::vector<double>()) {}

  [[nodiscard]] KineticStructure& kinetic() override { return contacts_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {}; }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{2, {}};
    for (const BeadPair& pair : contacts_.pairs()) elements.add({pair.first, pair.second});
    return elements;
  }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override { return contacts_.state(); }
  [[nodiscard]] std::vector<Change> built() const override { return contacts_.built(); }
  [[nodiscard]] ReplayScheme replay_scheme() const override { return {{{"contacts", 2, 2}}, {}}; }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    std::vector<std::vector<ReplayElement>> elements(1);
    for (const BeadPair& pair : contacts_.pairs())
      elements[0].push_back(replay_element({pair.first, pair.second}));
    return elements;
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    using Events = Contacts<Dimension>;
    if (change.kind == Events::begin || change.kind == Events::end)
      edits.push_back({0, change.kind == Events::begin, replay_element({change.ids[0], change.ids[1]})});
    return true;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const Balls<Dimension> balls(scene_.centers(frame), radii_);
    return seconds_per_call<WallClock>([&] { (void)cells_.pairs(balls); });
  }

 private:
  const Scene& scene_;
  std::vector<double> radii_;
  mutable CellList<Dimension> cells_;  // its results do not depend on earlier use
  Contacts<Dimension> contacts_;
};

// Throws if there are too many pairs for the kernel `exact`, which lists all of them.
void check_exact_pairs(const PairsAsked& asked) {
  constexpr std::uint64_t most = 100'000'000;  // 2.5 GB, and minutes a step
  const std::uint64_t pairs = PairsInQuestion(asked).count();
  if (pairs > most)
    throw StructureRefusal("contacts", fmt::format("kernel exact looks at all {} pairs of beads, more than "
                                                   "{}; expected fewer beads, or kernel filtered",
                                                   pairs, most));
}

}  // namespace

void add_ball_structures(StructureRegistry& registry) {
  registry.add(
      {.name = "power",
       .about = "power diagram in the plane or in space, stored as its dual, the regular triangulation",
       .net_changes = "cells",
       .order = 30,
       .by_default = [](const Scene& scene) { return scene.dimension() > 1; },
       .refusal = [](const Scene& scene) -> std::optional<std::string> {
         scene.require_weights();
         if (scene.dimension() < 2) return needs_plane_or_space(scene);
         return std::nullopt;
       },
       .lacks_images = true,
       .make = make_of_motion<PowerInRun, 2>()});
  registry.add(
      {.name = "contacts",
       .about = "pairs of beads whose closed balls meet",
       .net_changes = "pairs in contact",
       .order = 40,
       .refusal = [](const Scene& scene) -> std::optional<std::string> {
         if (scene.is_lifted()) return fictitious_radii;
         if (scene.dimension() < 2) return needs_plane_or_space(scene);
         if (!scene.has_radii())
           return "the points of an instance have no radii, and contacts are of balls; expected a trajectory";
         return std::nullopt;
       },
       .across_walls = "contacts",
       .make = make_of_motion<2>([]<int D>(
                                     Simulator& simulator, const Scene& scene, const MotionRef<D>& ref,
                                     const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
         const PairsAsked asked{scene.necklaces(), true,           settings.apart, true,
                                settings.groups,   scene.at_rest()};
         if (simulator.kernel() == Kernel::exact) check_exact_pairs(asked);
         return std::make_unique<ContactsInRun<D>>(simulator, scene, ref, asked, settings.contact_distance);
       })});
}

}  // namespace kds
