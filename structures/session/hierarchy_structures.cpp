#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kds/stopwatch.h"
#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/chord_hierarchy.h"
#include "structures/collision/box_tree.h"
#include "structures/enclosing_sphere/exact_sphere.h"
#include "structures/enclosing_sphere/integer_balls.h"
#include "structures/hierarchy/box_hierarchy.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/session/own_structures.h"
#include "structures/session/structure_spec.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

// A hierarchy of chord cages in a run: the common part of wrapped and layered hierarchies.
template <class Hierarchy>
class ChordsInRun : public RunningStructure {
 public:
  static constexpr int dimension = Hierarchy::dimension;

  ChordsInRun(Simulator& simulator, const Scene& scene, const MotionRef<dimension>& motion,
              const NodeSelection& nodes, std::optional<double> tightness)
      : scene_(scene),
        hierarchy_(simulator, motion, scene.necklaces(), tightness),
        keeps_(select_nodes(hierarchy_.cages().tree(), nodes)) {}

  [[nodiscard]] KineticStructure& kinetic() override { return hierarchy_; }
  [[nodiscard]] std::vector<NodeSphere> spheres_at(const Dyadic& u) const override {
    std::vector<NodeSphere> nodes;
    for (NodeId id = 0; id < keeps_.size(); ++id) {
      if (keeps(id)) nodes.push_back({cages().tree().range(id), hierarchy_.sphere_at(id, u.round_down())});
    }
    return nodes;
  }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    ReplayScheme scheme{{}, replay_nodes(cages().tree()), {}};
    for (NodeId id = 0; id < keeps_.size(); ++id)
      if (keeps(id)) scheme.sphere_nodes.push_back(id);
    return scheme;
  }
  [[nodiscard]] std::vector<Sphere> replay_spheres(bool built) const override {
    std::vector<Sphere> spheres;
    for (int k = built ? 0 : 1; k <= (built ? 0 : cages().degree()); ++k) {
      const auto at_control = cages().cages(k);
      for (NodeId id = 0; id < keeps_.size(); ++id)
        if (keeps(id)) spheres.push_back(sphere_of(at_control[id], 0));
    }
    return spheres;
  }

 protected:
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const ChordCages<Hierarchy>& cages() const { return hierarchy_.cages(); }
  [[nodiscard]] bool keeps(NodeId node) const { return keeps_[node] != 0; }

 private:
  const Scene& scene_;
  ChordHierarchy<Hierarchy> hierarchy_;
  std::vector<std::uint8_t> keeps_;
};

template <int Dimension>
class LayeredInRun final : public ChordsInRun<LayeredHierarchy<Dimension>> {
 public:
  using ChordsInRun<LayeredHierarchy<Dimension>>::ChordsInRun;

  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    const auto& cages = this->cages();
    std::vector<NodeSphere> nodes;
    for (NodeId id = 0; id < cages.tree().node_count(); ++id) {
      if (!this->keeps(id)) continue;
      Sphere sphere = sphere_of(cages.cages(cages.last())[id], 0);
      sphere.center = this->scene().in_input(sphere.center);
      nodes.push_back({cages.tree().range(id), sphere});
    }
    return {dump_layered(nodes)};
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const Balls<Dimension> balls(this->scene().centers(frame), this->scene().radii());
    return seconds_per_call<WallClock>(
        [&] { LayeredHierarchy<Dimension>(this->scene().necklaces()).build(balls); });
  }
};

template <int Dimension>
class WrappedInRun final : public RunningStructure {
 public:
  WrappedInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion,
               const NodeSelection& nodes)
      : scene_(scene),
        motion_(motion),
        hierarchy_(simulator, motion, scene.necklaces(), scene.equal_radii() ? Radii::equal : Radii::any,
                   nodes) {
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id)
      if (hierarchy_.keeps(id)) kept_.push_back(hierarchy_.tree().range(id));
  }

  [[nodiscard]] KineticStructure& kinetic() override { return hierarchy_; }
  void follow_certificates() override { hierarchy_.follow_certificates(); }
  void count_certificates(std::span<const BeadId>) override { hierarchy_.count_certificates(); }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const override {
    // At a frame, the basis from events may contain beads that the sphere does not need; the sphere must be
    // computed from a basis without them.
    const std::vector<Basis> bases = hierarchy_.bases_at(Dyadic(frame == 0 ? 0.0 : 1.0));
    const Balls<Dimension> balls(scene_.centers(frame), scene_.radii());
    std::vector<WrappedNode> nodes;
    for (NodeId id = 0; id < bases.size(); ++id) {
      if (!hierarchy_.keeps(id)) continue;
      Sphere sphere = exact_sphere_of(bases[id], balls);
      sphere.center = scene_.in_input(sphere.center);
      nodes.push_back({hierarchy_.tree().range(id), hierarchy_.basis(id), sphere});
    }
    return {dump_wrapped(nodes)};
  }
  [[nodiscard]] std::vector<NodeSphere> spheres_at(const Dyadic& u) const override {
    const IntegerBalls<Dimension> whole = integer_balls_at(motion_.curves(), u);
    std::vector<NodeSphere> nodes;
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id) {
      if (!hierarchy_.keeps(id)) continue;
      const Basis basis = proper_part(hierarchy_.basis(id), whole);
      const auto balls = whole.of(std::span(basis.begin(), basis.end()));
      Sphere sphere = ExactSphere<Dimension>::touching(balls)->rounded(whole.unit);
      enlarge(sphere);
      nodes.push_back({hierarchy_.tree().range(id), sphere});
    }
    return nodes;
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{2, {}};
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id) {
      if (!hierarchy_.keeps(id)) continue;
      const BeadRange& range = hierarchy_.tree().range(id);
      const Basis& basis = hierarchy_.basis(id);
      elements.add({range.first, range.last}, {basis.begin(), basis.end()});
    }
    return elements;
  }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    return {{{"cages", 5, 1}}, replay_nodes(hierarchy_.tree())};
  }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    std::vector<std::vector<ReplayElement>> elements(1);
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id)
      if (hierarchy_.keeps(id)) elements[0].push_back(cage_of(id, hierarchy_.basis(id)));
    return elements;
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    if (change.kind == WrappedHierarchy<Dimension>::changes) return true;
    const NodeId node = *hierarchy_.tree().find({change.ids[0], change.ids[1]});
    edits.push_back({0, true, cage_of(node, {change.ids.data() + 2, change.size - std::size_t{2}})});
    return true;
  }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override {
    std::vector<BeadId> state;
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id) {
      if (!hierarchy_.keeps(id)) continue;
      state.insert(state.end(), hierarchy_.basis(id).begin(), hierarchy_.basis(id).end());
      state.push_back(no_bead);
    }
    return state;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_per_call<WallClock>(
        spheres_by_cgal<Dimension>(kept_, scene_.centers(frame), scene_.radii()));
  }

 private:
  [[nodiscard]] static ReplayElement cage_of(NodeId node, const Basis& basis) {
    return cage_of(node, std::span(basis.begin(), basis.end()));
  }
  [[nodiscard]] static ReplayElement cage_of(NodeId node, std::span<const BeadId> basis) {
    ReplayElement cage{node, no_bead, no_bead, no_bead, no_bead};
    std::copy(basis.begin(), basis.end(), cage.begin() + 1);
    return cage;
  }
  /// Enlarges the sphere so that it contains all beads of the node. Each of its numbers may be rounded by
  /// 2^-52 of itself.
  void enlarge(Sphere& sphere) const {
    constexpr double rounding = 0x1p-49;
    sphere.radius = sphere.radius * (1 + rounding) + rounding * sphere.center.lpNorm<1>();
  }

  const Scene& scene_;
  MotionRef<Dimension> motion_;
  WrappedHierarchy<Dimension> hierarchy_;
  std::vector<BeadRange> kept_;
};

template <int Dimension>
class WrappedChordsInRun final : public ChordsInRun<StaticWrappedHierarchy<Dimension>> {
 public:
  using ChordsInRun<StaticWrappedHierarchy<Dimension>>::ChordsInRun;

  /// Dumps the cages, which contain the beads exactly.
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    const StaticWrappedHierarchy<Dimension>& at_frame = this->cages().hierarchy();
    const auto cages = this->cages().cages(this->cages().last());
    std::vector<WrappedNode> nodes;
    for (NodeId id = 0; id < at_frame.tree().node_count(); ++id) {
      if (!this->keeps(id)) continue;
      Sphere sphere = sphere_of(cages[id], 0);
      sphere.center = this->scene().in_input(sphere.center);
      nodes.push_back({at_frame.tree().range(id), at_frame.basis(id), sphere});
    }
    return {dump_wrapped(nodes)};
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_per_call<WallClock>(spheres_by_cgal<Dimension>(
        this->cages().tree().ranges(), this->scene().centers(frame), this->scene().radii()));
  }
};

template <int Dimension>
class BoxesInRun final : public RunningStructure {
 public:
  BoxesInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion,
             const NodeSelection& nodes, int directions)
      : scene_(scene),
        directions_(directions),
        hierarchy_(simulator, motion, scene.necklaces(), scene.equal_radii() ? Radii::equal : Radii::any,
                   directions, nodes) {}

  [[nodiscard]] KineticStructure& kinetic() override { return hierarchy_; }
  void follow_certificates() override { hierarchy_.follow_certificates(); }
  void count_certificates(std::span<const BeadId>) override { hierarchy_.count_certificates(); }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const override {
    const Eigen::Matrix3Xd centers = scene_.centers(frame);
    std::vector<BoxesNode> nodes;
    for_each_node([&](const BeadRange& range, std::span<const BeadId> supports) {
      if (supports.front() == no_bead) return;  // all beads of the node are absent
      BoxesNode& node = nodes.emplace_back(BoxesNode{range, {supports.begin(), supports.end()}, {}});
      for (std::size_t side = 0; side < supports.size(); ++side)
        node.ends.push_back(end_of(supports[side], side, centers));
    });
    return {dump_boxes(nodes)};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{3, {}};
    for_each_node([&](const BeadRange& range, std::span<const BeadId> supports) {
      for (BeadId side = 0; side < supports.size(); ++side)
        elements.add({range.first, range.last, side}, supports.subspan(side, 1));
    });
    return elements;
  }
  [[nodiscard]] ReplayScheme replay_scheme() const override {
    return {{{"supports", 3, 2}}, replay_nodes(hierarchy_.tree())};
  }
  [[nodiscard]] std::vector<std::vector<ReplayElement>> replay_elements(bool) const override {
    std::vector<std::vector<ReplayElement>> elements(1);
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id) {
      if (!hierarchy_.keeps(id)) continue;
      const auto supports = hierarchy_.supports(id);
      for (BeadId side = 0; side < supports.size(); ++side)
        if (supports[side] != no_bead) elements[0].push_back(replay_element({id, side, supports[side]}));
    }
    return elements;
  }
  [[nodiscard]] bool replay_edits(const Change& change, std::vector<ReplayEdit>& edits) const override {
    if (change.kind != BoxHierarchy<Dimension>::support_changes) return true;
    const NodeId node = *hierarchy_.tree().find({change.ids[0], change.ids[1]});
    const BeadId was = change.ids[3], is = change.ids[4];
    if (was != no_bead || is != no_bead)
      edits.push_back({0, is != no_bead, replay_element({node, change.ids[2], is})});
    return true;
  }
  [[nodiscard]] bool can_be_cut() const override { return true; }
  /// Includes nodes that are not kept, because nodes above them depend on them.
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override {
    std::vector<BeadId> state;
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id) {
      const auto supports = hierarchy_.supports(id);
      state.insert(state.end(), supports.begin(), supports.end());
    }
    return state;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const Balls<Dimension> balls(scene_.centers(frame), scene_.radii());
    return seconds_per_call<WallClock>(
        [&] { BoxTree<Dimension>(scene_.necklaces(), directions_).build(balls); });
  }

 private:
  template <class Visit>
  void for_each_node(Visit visit) const {
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id)
      if (hierarchy_.keeps(id)) visit(hierarchy_.tree().range(id), hierarchy_.supports(id));
  }
  /// Returns where the support's ball ends along the side's direction, rounded.
  [[nodiscard]] double end_of(BeadId support, std::size_t side, const Eigen::Matrix3Xd& centers) const {
    const SlabDirection& direction = hierarchy_.directions()[side / 2];
    double along = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      along += direction.steps[axis] * centers(static_cast<Eigen::Index>(axis), support);
    const double reach = scene_.radii()[support] * std::sqrt(static_cast<double>(direction.square()));
    return side % 2 == 0 ? along - reach : along + reach;
  }

  const Scene& scene_;
  int directions_;
  BoxHierarchy<Dimension> hierarchy_;
};

/// Throws StructureRefusal if boxes cannot have this number of directions in the scene.
template <int Dimension>
void check_directions(int directions) {
  const auto counts = box_direction_counts<Dimension>();
  if (std::find(counts.begin(), counts.end(), directions) == counts.end())
    throw StructureRefusal("boxes", fmt::format("{} directions ({}); expected {} {}", directions,
                                                Dimension == 2 ? "beads in the plane" : "beads in space",
                                                "--directions"_arg, fmt::join(counts, " or ")));
}

}  // namespace

void add_hierarchy_structures(StructureRegistry& registry) {
  registry.add(
      {.name = "wrapped",
       .about = "smallest sphere around the beads under each node of a balanced tree over each necklace",
       .net_changes = "bases of nodes",
       .order = 20,
       .by_default = [](const Scene& scene) { return scene.has_radii(); },
       .refusal = refusal_of_spheres,
       .has_events = [](const StructureSettings& settings) { return settings.between == Between::events; },
       .make = make_of_motion<2>(
           []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& ref,
                     const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
             if (settings.between == Between::chord)
               return std::make_unique<WrappedChordsInRun<D>>(simulator, scene, ref, settings.nodes,
                                                              settings.tightness);
             return std::make_unique<WrappedInRun<D>>(simulator, scene, ref, settings.nodes);
           })});
  registry.add({.name = "boxes",
                .about = "axis-aligned box, or k-DOP, around the balls under each node of that tree",
                .net_changes = "supports of nodes",
                .order = 22,
                .refusal = refusal_of_spheres,
                .make = make_of_motion<2>(
                    []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& ref,
                              const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
                      const int directions = settings.directions.value_or(D);
                      check_directions<D>(directions);
                      return std::make_unique<BoxesInRun<D>>(simulator, scene, ref, settings.nodes,
                                                             directions);
                    })});
  registry.add(
      {.name = "layered",
       .about =
           "at each node of that tree the smallest sphere around the two children's spheres, without events",
       .order = 25,
       .refusal = refusal_of_spheres,
       .has_events = [](const StructureSettings&) { return false; },
       .make = make_of_motion<2>(
           []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& ref,
                     const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
             return std::make_unique<LayeredInRun<D>>(simulator, scene, ref, settings.nodes, std::nullopt);
           })});
}

}  // namespace kds
