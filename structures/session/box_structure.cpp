#include "structures/box/enclosing_box.h"
#include "structures/session/dump_files.h"
#include "structures/session/make_of_motion.h"
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
    return elements_in_order(box_.ends());
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
  spec.make = make_of_motion<BoxInRun, 1>();
  return spec;
}

}  // namespace kds
