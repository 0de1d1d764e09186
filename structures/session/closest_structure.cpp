#include <algorithm>

#include "structures/closest/kinetic_closest_pair.h"
#include "structures/session/dump_files.h"
#include "structures/session/make_of_motion.h"
#include "structures/session/own_structures.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

namespace {

template <int Dimension>
class ClosestInRun final : public RunningStructure {
 public:
  ClosestInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion)
      : scene_(scene), closest_(simulator, motion) {}

  [[nodiscard]] KineticStructure& kinetic() override { return closest_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override {
    return {dump_closest(closest_.pair())};
  }
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t) const override {
    CombinatorialElements elements{1, {}};
    if (const auto& pair = closest_.pair()) elements.add({0}, *pair);
    return elements;
  }
  /// Times a Delaunay triangulation, because one of its edges joins the closest pair.
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    const std::vector<double> no_weights(scene_.bead_count(), 0);
    return seconds_to_triangulate<Dimension>(scene_.centers(frame), no_weights).clock;
  }

 private:
  const Scene& scene_;
  KineticClosestPair<Dimension> closest_;
};

}  // namespace

StructureSpec closest_structure() {
  StructureSpec spec;
  spec.name = "closest";
  spec.order = 16;
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() < 2) return needs_plane_or_space(scene);
    return std::nullopt;
  };
  spec.make = make_of_motion<ClosestInRun, 2>();
  return spec;
}

}  // namespace kds
