#include <vector>

#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/chord_hierarchy.h"
#include "structures/session/dump_files.h"
#include "structures/session/own_structures.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int Dimension>
class LayeredInRun final : public RunningStructure {
 public:
  LayeredInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion,
               const NodeSelection& nodes)
      : scene_(scene),
        hierarchy_(simulator, motion, scene.necklaces()),
        keeps_(select_nodes(hierarchy_.cages().tree(), nodes)) {}

  [[nodiscard]] KineticStructure& kinetic() override { return hierarchy_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    const ChordCages<LayeredHierarchy<Dimension>>& cages = hierarchy_.cages();
    std::vector<NodeSphere> nodes;
    for (NodeId id = 0; id < keeps_.size(); ++id) {
      if (keeps_[id] == 0) continue;
      Sphere sphere = sphere_of(cages.cages(cages.last())[id], 0);
      sphere.center = scene_.in_input(sphere.center);
      nodes.push_back({cages.tree().range(id), sphere});
    }
    return {dump_layered(nodes)};
  }
  [[nodiscard]] std::vector<NodeSphere> spheres_at(const Dyadic& u) const override {
    std::vector<NodeSphere> nodes;
    for (NodeId id = 0; id < keeps_.size(); ++id) {
      if (keeps_[id] != 0)
        nodes.push_back({hierarchy_.cages().tree().range(id), hierarchy_.sphere_at(id, u.round_down())});
    }
    return nodes;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_wrap<Dimension>(hierarchy_.cages().tree().ranges(), scene_.centers(frame),
                                      scene_.radii())
        .clock;
  }

 private:
  const Scene& scene_;
  ChordHierarchy<LayeredHierarchy<Dimension>> hierarchy_;
  std::vector<std::uint8_t> keeps_;
};

}  // namespace

StructureSpec layered_structure() {
  StructureSpec spec;
  spec.name = "layered";
  spec.order = 20;
  spec.refusal = refusal_of_spheres;
  spec.has_events = [](const StructureSettings&) { return false; };
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings& settings) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          if constexpr (D == 1) {
            return nullptr;
          } else {
            return std::make_unique<LayeredInRun<D>>(simulator, scene, ref, settings.nodes);
          }
        },
        motion);
  };
  return spec;
}

}  // namespace kds
