#include "structures/power_diagram/power_diagram.h"
#include "structures/session/dump_files.h"
#include "structures/session/make_of_motion.h"
#include "structures/session/own_structures.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

namespace {

template <int Dimension>
class PowerInRun final : public RunningStructure {
 public:
  PowerInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), diagram_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return diagram_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const override {
    const auto at_frame = diagram_.at_frame(frame == 0);
    return {dump_cells(at_frame.cells), dump_hidden(at_frame.hidden)};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t frame) const override {
    CombinatorialElements elements{Dimension + 1, {}};
    for (CellBeads<Dimension> cell : diagram_.at_frame(frame == 0).cells) {
      std::sort(cell.begin(), cell.end());
      elements.add({}, cell);
    }
    return elements;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_triangulate<Dimension>(scene_.centers(frame), scene_.weights(frame)).clock;
  }

 private:
  const Scene& scene_;
  PowerDiagram<Dimension> diagram_;
};

}  // namespace

StructureSpec power_structure() {
  StructureSpec spec;
  spec.name = "power";
  spec.order = 30;
  spec.by_default = [](const Scene& scene) { return scene.dimension() > 1; };
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    scene.require_weights();
    if (scene.dimension() < 2) return needs_plane_or_space(scene);
    return std::nullopt;
  };
  spec.make = make_of_motion<PowerInRun, 2>();
  return spec;
}

}  // namespace kds
