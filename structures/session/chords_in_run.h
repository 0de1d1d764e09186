#pragma once
// A hierarchy of chord cages in a run: the common part of wrapped and layered hierarchies.

#include <cstdint>
#include <optional>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "structures/chord_cages/chord_hierarchy.h"
#include "structures/session/structure_spec.h"

namespace kds {

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

 protected:
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const ChordCages<Hierarchy>& cages() const { return hierarchy_.cages(); }
  [[nodiscard]] bool keeps(NodeId node) const { return keeps_[node] != 0; }

 private:
  const Scene& scene_;
  ChordHierarchy<Hierarchy> hierarchy_;
  std::vector<std::uint8_t> keeps_;
};

}  // namespace kds
