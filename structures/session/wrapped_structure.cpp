#include "motions/numbers/exact_number.h"
#include "structures/enclosing_sphere/exact_sphere.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/session/dump_files.h"
#include "structures/session/own_structures.h"
#include "structures/triangulation/static_build.h"

namespace kds {

namespace {

template <int Dimension>
class WrappedInRun final : public RunningStructure {
 public:
  WrappedInRun(Simulator& simulator, const Scene& scene, const MotionRef<Dimension>& motion,
               const NodeSelection& nodes, const Relaxation& relaxation)
      : scene_(scene),
        hierarchy_(simulator, motion, scene.necklaces(), scene.equal_radii() ? Radii::equal : Radii::any,
                   nodes, relaxation) {
    for (NodeId id = 0; id < hierarchy_.tree().node_count(); ++id)
      if (hierarchy_.keeps(id)) kept_.push_back(hierarchy_.tree().range(id));
  }

  [[nodiscard]] KineticStructure& kinetic() override { return hierarchy_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const override {
    const std::vector<Basis> bases = hierarchy_.bases_at(Dyadic(frame == 0 ? 0.0 : 1.0));
    const Balls<Dimension> balls(scene_.centers(frame), scene_.radii());
    std::vector<WrappedNode> nodes;
    for (NodeId id = 0; id < bases.size(); ++id) {
      if (!hierarchy_.keeps(id)) continue;
      Sphere sphere = exact_sphere_of(bases[id], balls);
      sphere.center = scene_.in_input(sphere.center);
      if (hierarchy_.relaxation().any()) enlarge(sphere);
      nodes.push_back({hierarchy_.tree().range(id), bases[id], sphere});
    }
    return {dump_wrapped(nodes)};
  }
  [[nodiscard]] double static_seconds(std::size_t frame) const override {
    return seconds_to_wrap<Dimension>(kept_, scene_.centers(frame), scene_.radii()).clock;
  }

 private:
  /// So that it holds all beads of the node, rounded as its numbers are: each by 2^-52 of itself.
  void enlarge(Sphere& sphere) const {
    constexpr double rounding = 0x1p-49;
    sphere.radius = sphere.radius * (1 + hierarchy_.relaxation().share()) * (1 + rounding) +
                    rounding * sphere.center.lpNorm<1>();
  }

  const Scene& scene_;
  WrappedHierarchy<Dimension> hierarchy_;
  std::vector<BeadRange> kept_;
};

}  // namespace

StructureSpec wrapped_structure() {
  StructureSpec spec;
  spec.name = "wrapped";
  spec.order = 20;
  spec.by_default = [](const Scene& scene) { return scene.has_radii(); };
  spec.refusal = [](const Scene& scene) -> std::optional<std::string> {
    if (scene.is_lifted()) return fictitious_radii;
    if (scene.dimension() < 2) return needs_plane_or_space(scene);
    if (!scene.equal_radii() && !scene.has_radii())
      return "the points of an instance have weights that differ, and those are no radii; expected equal "
             "weights, or a trajectory";
    return std::nullopt;
  };
  spec.make = [](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                 const StructureSettings& settings) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          if constexpr (D == 1) {
            return nullptr;
          } else {
            return std::make_unique<WrappedInRun<D>>(simulator, scene, ref, settings.nodes, settings.relax);
          }
        },
        motion);
  };
  return spec;
}

}  // namespace kds
