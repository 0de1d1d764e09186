#include "structures/box/enclosing_box.h"
#include "structures/session/dump_files.h"
#include "structures/session/own_structures.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int Dimension>
class BoxInRun final : public RunningStructure {
 public:
  BoxInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), box_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return box_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {dump_box(box_.ends())}; }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{1, {}};
    for (const BeadId bead : box_.ends()) {
      CombinatorialElement& element = elements.all.emplace_back();
      element.fill(no_bead);
      element[0] = static_cast<BeadId>(elements.all.size() - 1);
      element[1] = bead;
    }
    return elements;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_box(scene_.centers(frame)).clock;
  }

 private:
  const Scene& scene_;
  EnclosingBox<Dimension> box_;
};

}  // namespace

StructureSpec box_structure() {
  StructureSpec spec;
  spec.name = "box";
  spec.order = 12;
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings&) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          return std::make_unique<BoxInRun<D>>(simulator, scene, ref);
        },
        motion);
  };
  return spec;
}

}  // namespace kds
