#include <vector>

#include "kds/seconds.h"
#include "structures/session/chords_in_run.h"
#include "structures/session/dump_files.h"
#include "structures/session/make_of_motion.h"
#include "structures/session/own_structures.h"

namespace kds {

namespace {

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
    return seconds_of([&] { LayeredHierarchy<Dimension>(this->scene().necklaces()).build(balls); }).clock;
  }
};

}  // namespace

StructureSpec layered_structure() {
  StructureSpec spec;
  spec.name = "layered";
  spec.order = 25;
  spec.refusal = refusal_of_spheres;
  spec.has_events = [](const StructureSettings&) { return false; };
  spec.make =
      make_of_motion<2>([]<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& ref,
                                  const StructureSettings& settings) -> std::unique_ptr<RunningStructure> {
        return std::make_unique<LayeredInRun<D>>(simulator, scene, ref, settings.nodes, std::nullopt);
      });
  return spec;
}

}  // namespace kds
