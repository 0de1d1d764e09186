#include "tests/laws/law_structures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "structures/crossings/crossings.h"
#include "structures/dual_complex/dual_topology.h"
#include "structures/hull/convex_hull.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/spanner/spanner.h"
#include "tests/support/judges/spanner_checks.h"

namespace kds::test {

namespace {

std::optional<std::string> differs(const Beads& has, const Beads& expected) {
  if (has == expected) return std::nullopt;
  return fmt::format("the structure has {}, brute force finds {}", has, expected);
}

KineticStructure& kinetic(const RunningStructure& structure) {
  return const_cast<RunningStructure&>(structure).kinetic();  // NOLINT: not changed
}

std::optional<std::string> fault_of_sorted(const Judged& judged) {
  return not_sorted(judged.balls, judged.present, *judged.structure.state());
}
std::optional<std::string> fault_of_box(const Judged& judged) {
  return differs(*judged.structure.state(), box_of(judged.balls, judged.present));
}
std::optional<std::string> fault_of_closest(const Judged& judged) {
  return differs(*judged.structure.state(), closest_of(judged.balls, judged.present));
}
std::optional<std::string> fault_of_hull(const Judged& judged) {
  const auto& hull = dynamic_cast<const ConvexHull&>(kinetic(judged.structure));
  return differs(hull.corners(), hull_of(judged.balls, judged.present));
}
std::optional<std::string> fault_of_contacts(const Judged& judged) {
  const PairsAsked asked{judged.scene.necklaces(), true, 2, true, {}, judged.scene.at_rest()};
  const auto layers = judged.structure.replay_elements(false);
  Beads pairs;
  for (const ReplayElement& pair : layers[0]) pairs.insert(pairs.end(), {pair[0], pair[1]});
  return differs(pairs, contacts_of(judged.balls, judged.present, asked));
}

template <int Stretch>
std::optional<std::string> fault_of_spanner(const Judged& judged) {
  const auto fault_in = [&](const auto& spanner) {
    return not_a_spanner(spanner, judged.present, Stretch, judged.balls.one,
                         [&](BeadId a, BeadId b) { return judged.balls.square(a, b); });
  };
  if (const auto* plane = dynamic_cast<const Spanner<2>*>(&kinetic(judged.structure)))
    return fault_in(*plane);
  return fault_in(dynamic_cast<const Spanner<3>&>(kinetic(judged.structure)));
}

std::optional<std::string> fault_of_boxes(const Judged& judged) {
  const auto fault_in = [&]<int D>(const BoxHierarchy<D>& boxes) {
    const auto ranges = boxes.tree().ranges();
    return differs(
        *judged.structure.state(),
        supports_of(judged.balls, judged.present, {ranges.begin(), ranges.end()}, boxes.directions()));
  };
  if (const auto* boxes = dynamic_cast<const BoxHierarchy<2>*>(&kinetic(judged.structure)))
    return fault_in(*boxes);
  return fault_in(dynamic_cast<const BoxHierarchy<3>&>(kinetic(judged.structure)));
}

// Spheres of unequal balls have irrational centres; audits and the program in tests/oracle look at them.
std::optional<std::string> fault_of_wrapped(const Judged& judged) {
  if (!judged.scene.equal_radii()) return std::nullopt;
  const auto nodes = judged.structure.replay_scheme().nodes;
  const auto layers = judged.structure.replay_elements(false);
  if (layers[0].size() != nodes.size()) return "not every node has a basis";
  for (const ReplayElement& cage : layers[0]) {
    Beads basis(cage.begin() + 1, std::find(cage.begin() + 1, cage.end(), no_bead));
    if (const auto fault = not_smallest(judged.balls, nodes[cage[0]].beads, basis)) return fault;
  }
  return std::nullopt;
}

std::vector<Beads> cells_of(const RunningStructure& power) {
  std::vector<Beads> cells;
  const auto add = [&](const auto& diagram) {
    for (const auto& cell : diagram.at_frame(false).cells) cells.emplace_back(cell.begin(), cell.end());
  };
  if (const auto* diagram = dynamic_cast<const PowerDiagram<2>*>(&kinetic(power))) {
    add(*diagram);
  } else {
    add(dynamic_cast<const PowerDiagram<3>&>(kinetic(power)));
  }
  return cells;
}

std::optional<std::string> fault_of_power(const Judged& judged) {
  if (judged.scene.is_lifted()) return std::nullopt;  // weights between frames are not those of the curves
  return not_regular(judged.balls, judged.present, cells_of(judged.structure));
}

std::optional<std::string> fault_of_dual(const Judged& judged) {
  std::vector<Beads> cells = cells_of(*judged.base), simplices;
  for (Beads& cell : cells) std::sort(cell.begin(), cell.end());
  for (const auto& layer : judged.structure.replay_elements(false))
    for (const ReplayElement& simplex : layer)
      simplices.emplace_back(simplex.begin(), std::find(simplex.begin(), simplex.end(), no_bead));
  return not_dual(judged.balls, judged.present, cells, simplices);
}

template <int Dimension>
std::optional<std::string> fault_of_betti(const DualTopology<Dimension>& topology,
                                          const RunningStructure& complex) {
  std::vector<Beads> simplices;
  for (const auto& layer : complex.replay_elements(false))
    for (const ReplayElement& simplex : layer)
      simplices.emplace_back(simplex.begin(), std::find(simplex.begin(), simplex.end(), no_bead));
  const auto found = topology.betti(), expected = betti_by_ranks(simplices);
  if (found == expected) return std::nullopt;
  return fmt::format("the Betti numbers are {}, ranks of the boundaries give {}", found, expected);
}

std::optional<std::string> fault_of_topology(const Judged& judged) {
  if (const auto* plane = dynamic_cast<const DualTopology<2>*>(&kinetic(judged.structure)))
    return fault_of_betti(*plane, *judged.base);
  return fault_of_betti(dynamic_cast<const DualTopology<3>&>(kinetic(judged.structure)), *judged.base);
}

}  // namespace

std::string LawStructure::title() const {
  return name + (settings.between == Between::chord ? " between chords" : "") +
         (settings.directions ? fmt::format(" with {} directions", *settings.directions) : "") +
         (settings.stretch == StructureSettings{}.stretch ? ""
                                                          : fmt::format(" of stretch {}", settings.stretch));
}

const std::vector<LawStructure>& law_structures() {
  static const std::vector<LawStructure> rows{
      {"sorted", {}, Edits::beads, false, fault_of_sorted},
      {"box", {}, Edits::beads, true, fault_of_box},
      {"hull", {}, Edits::beads, true, fault_of_hull},
      {"closest", {}, Edits::beads, true, fault_of_closest},
      {.name = "spanner",
       .fault = fault_of_spanner<3>,
       .judge_every = 8,
       .most_beads = 16,
       .accepts_ties = true,
       .takes_long_numbers = false},
      {.name = "spanner",
       .settings = {.stretch = 10},
       .fault = fault_of_spanner<10>,
       .judge_every = 8,
       .most_beads = 16,
       .accepts_ties = true,
       .takes_long_numbers = false},
      {"wrapped", {}, Edits::courses, false, fault_of_wrapped},
      {"wrapped", {.between = Between::chord}, Edits::none},
      {"layered", {}, Edits::none},
      {"boxes", {}, Edits::beads, true, fault_of_boxes},
      {"boxes", {.directions = 4}, Edits::beads, true, fault_of_boxes},
      {"boxes", {.directions = 7}, Edits::beads, true, fault_of_boxes},
      {"power", {}, Edits::beads, false, fault_of_power},
      {"dual", {}, Edits::beads, false, fault_of_dual, 40, 16},
      {"voids", {}, Edits::beads, false, fault_of_topology, 40, 16},
      {"contacts", {}, Edits::beads, true, fault_of_contacts},
      {"crossings", {}, Edits::none},
  };
  return rows;
}

Beads state_now(const RunningStructure& structure) {
  Beads ids;
  // A hull's own state also has its tournaments, which a replay does not run.
  if (const auto* hull = dynamic_cast<const ConvexHull*>(&kinetic(structure))) return hull->corners();
  // Between crossings nothing is left of them; their state is about the bonds that meet at a frame.
  if (dynamic_cast<const Crossings*>(&kinetic(structure)) != nullptr) return ids;
  if (structure.replay_scheme().layers.empty()) return structure.state().value_or(ids);
  for (auto& layer : structure.replay_elements(false)) {
    std::sort(layer.begin(), layer.end());
    for (const ReplayElement& element : layer) ids.insert(ids.end(), element.begin(), element.end());
    ids.push_back(no_bead);
  }
  return ids;
}

}  // namespace kds::test
