#include "structures/hull/convex_hull.h"
#include "structures/session/dump_files.h"
#include "structures/session/own_structures.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

class HullInRun final : public RunningStructure {
 public:
  HullInRun(Simulator& simulator, const Scene& scene, const MotionRef<2>& motion)
      : scene_(scene), hull_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return hull_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    return {dump_hull(hull_.corners())};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{1, {}};
    for (const BeadId bead : hull_.corners()) elements.add({bead});
    return elements;
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_hull(scene_.centers(frame)).clock;
  }

 private:
  const Scene& scene_;
  ConvexHull hull_;
};

}  // namespace

StructureSpec hull_structure() {
  StructureSpec spec;
  spec.name = "hull";
  spec.order = 14;
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() == 2) return std::nullopt;
    return "needs points in the plane, this input has " + std::to_string(scene.dimension()) +
           (scene.dimension() == 1 ? " coordinate" : " coordinates");
  };
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings&) -> std::unique_ptr<RunningStructure> {
    return std::make_unique<HullInRun>(simulator, scene, std::get<MotionRef<2>>(motion));
  };
  return spec;
}

}  // namespace kds
