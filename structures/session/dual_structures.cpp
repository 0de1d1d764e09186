#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kds/stopwatch.h"
#include "structures/dual_complex/dual_complex.h"
#include "structures/dual_complex/dual_topology.h"
#include "structures/session/own_structures.h"
#include "structures/session/structure_spec.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

ReplayElement simplex_element(std::span<const BeadId> beads, int count) {
  ReplayElement element;
  element.fill(no_bead);
  std::copy_n(beads.begin(), count, element.begin());
  return element;
}

template <int Dimension>
double triangulation_seconds(const Scene& scene, std::size_t frame) {
  return seconds_per_call<WallClock>(
      triangulation_by_cgal<Dimension>(scene.centers(frame), scene.weights(frame)));
}

template <int Dimension>
class DualInRun final : public RunningStructure {
 public:
  DualInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion,
            PowerDiagram<Dimension>& diagram)
      : scene_(scene), diagram_(diagram), complex_(simulator, motion, diagram) {}

  [[nodiscard]] KineticStructure& kinetic() override { return complex_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    std::string text = "beads\n";
    each_simplex([&](const SimplexBeads& beads, int dimension) {
      text += fmt::format("{}\n",
                          fmt::join(std::span(beads).first(static_cast<std::size_t>(dimension) + 1), " "));
    });
    return {{"dual.csv", std::move(text)}};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{4, {}};
    each_simplex([&](const SimplexBeads& beads, int) { elements.add({}, beads); });
    return elements;
  }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override {
    if (!diagram_.is_solid()) return std::nullopt;
    return complex_.state();
  }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    ReplayScheme scheme{{{"balls", 1, 1}, {"links", 2, 2}, {"triangles", 3, 3}}, {}};
    if (Dimension == 3) scheme.layers.push_back({"tetrahedra", 4, 4});
    return scheme;
  }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    std::vector<std::vector<ReplayElement>> elements(Dimension + 1);
    each_simplex([&](const SimplexBeads& beads, int dimension) {
      elements[static_cast<std::size_t>(dimension)].push_back(simplex_element(beads, dimension + 1));
    });
    return elements;
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    const int dimension = change.kind / 2;
    edits.push_back({static_cast<std::size_t>(dimension),
                     change.kind == DualComplex<Dimension>::begins(dimension),
                     simplex_element(change.ids, dimension + 1)});
    return true;
  }
  /// The time of the triangulation, without that of its dual complex.
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return triangulation_seconds<Dimension>(scene_, frame);
  }

 private:
  template <class Visit>
  void each_simplex(Visit visit) const {
    for (int dimension = 0; dimension <= Dimension; ++dimension)
      for (const SimplexBeads& beads : complex_.simplices(dimension)) visit(beads, dimension);
  }

  const Scene& scene_;
  PowerDiagram<Dimension>& diagram_;
  DualComplex<Dimension> complex_;
};

template <int Dimension>
class TopologyInRun final : public RunningStructure {
 public:
  TopologyInRun(Simulator& simulator, const Scene& scene, DualComplex<Dimension>& complex)
      : scene_(scene), topology_(simulator, scene.bead_count(), complex) {}

  [[nodiscard]] KineticStructure& kinetic() override { return topology_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    const auto [components, tunnels, voids] = topology_.betti();
    std::string text = fmt::format("what,beads\nb0,{}\nb1,{}\nb2,{}\n", components, tunnels, voids);
    for (const SimplexBeads& cell : topology_.void_cells())
      text += fmt::format("void_cell,{}\n", fmt::join(std::span(cell).first(Dimension + 1), " "));
    return {{"voids.csv", std::move(text)}};
  }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    return {{{"voids", Dimension + 1, Dimension + 1}}, {}};
  }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    std::vector<ReplayElement> cells;
    for (const SimplexBeads& cell : topology_.void_cells())
      cells.push_back(simplex_element(cell, Dimension + 1));
    return {std::move(cells)};
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    using Topology = DualTopology<Dimension>;
    if (change.kind == Topology::cell_begin || change.kind == Topology::cell_end)
      edits.push_back({0, change.kind == Topology::cell_begin,
                       simplex_element(std::span(change.ids).subspan(1), Dimension + 1)});
    return true;
  }
  /// The time of the triangulation, without that of its topology.
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return triangulation_seconds<Dimension>(scene_, frame);
  }

 private:
  const Scene& scene_;
  DualTopology<Dimension> topology_;
};

/// Returns why a scene has no dual complex, as the end of a sentence, or nothing.
std::optional<std::string> refusal_of_complex(const Scene& scene) {
  if (scene.is_lifted()) return fictitious_radii;
  if (scene.dimension() < 2) return needs_plane_or_space(scene);
  constexpr int most = 7;  // sizes of tetrahedra then have degree 56
  if (scene.degree() > most)
    return fmt::format("takes motions of degree {} at most, this one has {}", most, scene.degree());
  return std::nullopt;
}

}  // namespace

void add_dual_structures(StructureRegistry& registry) {
  registry.add(
      {.name = "dual",
       .about =
           "dual complex of the power diagram: vertices, edges, triangles and tetrahedra of the union of "
           "balls",
       .net_changes = "simplices",
       .stands_on = "power",
       .order = 31,
       .refusal = refusal_of_complex,
       .lacks_images = true,
       .make = make_of_motion<2>(
           []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& motion,
                     const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
             auto& diagram = dynamic_cast<PowerDiagram<D>&>(*settings.base);
             return std::make_unique<DualInRun<D>>(simulator, scene, motion, diagram);
           })});
  registry.add(
      {.name = "voids",
       .about = "topology of the dual complex: connected components, tunnels and voids of the union of balls",
       .stands_on = "dual",
       .order = 32,
       .refusal = refusal_of_complex,
       .lacks_images = true,
       .make = make_of_motion<2>(
           []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>&,
                     const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
             auto& complex = dynamic_cast<DualComplex<D>&>(*settings.base);
             return std::make_unique<TopologyInRun<D>>(simulator, scene, complex);
           })});
}

}  // namespace kds
