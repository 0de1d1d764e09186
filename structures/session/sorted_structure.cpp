#include "structures/session/dump_files.h"
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
    CombinatorialElements elements{1, {}};
    for (const BeadId bead : list_.order()) {
      CombinatorialElement& element = elements.all.emplace_back();
      element.fill(no_bead);
      element[0] = static_cast<BeadId>(elements.all.size() - 1);
      element[1] = bead;
    }
    return elements;
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
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings&) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          return std::make_unique<SortedInRun<D>>(simulator, scene, ref);
        },
        motion);
  };
  return spec;
}

}  // namespace kds
