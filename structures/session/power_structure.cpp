#include "structures/power_diagram/power_diagram.h"
#include "structures/session/dump_files.h"
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
      CombinatorialElement& element = elements.all.emplace_back();
      element.fill(no_bead);
      std::copy(cell.begin(), cell.end(), element.begin());
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
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings&) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          if constexpr (D == 1) {
            return nullptr;
          } else {
            return std::make_unique<PowerInRun<D>>(simulator, scene, ref);
          }
        },
        motion);
  };
  return spec;
}

}  // namespace kds
