#include "structures/session/dump_files.h"
#include "structures/session/make_of_motion.h"
#include "structures/session/own_structures.h"
#include "structures/sorted/sorted_list.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int Dimension>
class SortedInRun final : public RunningStructure {
 public:
  SortedInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), list_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return list_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    return {dump_sorted(list_.order())};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    return elements_in_order(list_.order());
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_sort(scene_.centers(frame)).clock;
  }

 private:
  const Scene& scene_;
  SortedList<Dimension> list_;
};

}  // namespace

StructureSpec sorted_structure() {
  StructureSpec spec;
  spec.name = "sorted";
  spec.order = 10;
  spec.by_default = [](const Scene& scene) { return scene.dimension() == 1; };
  spec.make = make_of_motion<SortedInRun, 1>();
  return spec;
}

}  // namespace kds
