#pragma once
// The specifications of the framework's own structures, and what they share: reasons for refusals, the
// construction for each dimension, and the files of --dump.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/structure_spec.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Reasons for refusals that several structures share.
inline constexpr const char* fictitious_radii =
    "in lifted motion radii between frames are fictitious, and it needs physical ones";
[[nodiscard]] inline std::string needs_plane_or_space(const Scene& scene) {
  return "needs points in the plane or in space, this input has " + std::to_string(scene.dimension()) +
         " coordinate";
}

/// Returns the reason why hierarchies refuse a scene, or nothing if they accept it.
[[nodiscard]] inline std::optional<std::string> refusal_of_spheres(const Scene& scene) {
  if (scene.is_lifted()) return fictitious_radii;
  if (scene.dimension() < 2) return needs_plane_or_space(scene);
  if (!scene.equal_radii() && !scene.has_radii())
    return "the points of an instance have weights that differ, and those are no radii; expected equal "
           "weights, or a trajectory";
  return std::nullopt;
}

// Add the specifications of one file each: point_structures.cpp, hierarchy_structures.cpp,
// ball_structures.cpp, dual_structures.cpp, bond_structures.cpp, spanner_structures.cpp.
void add_point_structures(StructureRegistry& registry);
void add_hierarchy_structures(StructureRegistry& registry);
void add_ball_structures(StructureRegistry& registry);
void add_dual_structures(StructureRegistry& registry);
void add_bond_structures(StructureRegistry& registry);
void add_spanner_structures(StructureRegistry& registry);

/// Returns a specification's `make`, which calls make(simulator, scene, motion, settings) for motions of at
/// least LeastDimension dimensions. The specification must refuse scenes of fewer dimensions beforehand.
template <int LeastDimension, class Make>
[[nodiscard]] auto make_of_motion(Make make) {
  return [make = std::move(make)](Simulator& simulator, const Scene& scene, const SceneMotion::Ref& motion,
                                  const StructureSettings& settings) {
    return std::visit(
        [&]<int D>(const MotionRef<D>& ref) -> std::unique_ptr<RunningStructure> {
          if constexpr (D < LeastDimension) {
            return nullptr;
          } else {
            return make(simulator, scene, ref, settings);
          }
        },
        motion);
  };
}

/// Same for a structure without settings, constructed by InRun<D>(simulator, scene, motion).
template <template <int> class InRun, int LeastDimension>
[[nodiscard]] auto make_of_motion() {
  return make_of_motion<LeastDimension>(
      []<int D>(Simulator& simulator, const Scene& scene, const MotionRef<D>& motion,
                const StructureSettings&) { return std::make_unique<InRun<D>>(simulator, scene, motion); });
}

struct WrappedNode {
  BeadRange range;
  Basis basis;
  Sphere sphere;
};

struct BoxesNode {
  BeadRange range;
  std::vector<BeadId> supports;  ///< one for each side
  std::vector<double> ends;      ///< the ends of the slabs, one for each side
};

// The files written by --dump. Doubles are printed with enough digits to read back the same double.

[[nodiscard]] DumpFile dump_wrapped(std::span<const WrappedNode> nodes);  ///< first,last,basis,x,y,z,radius
[[nodiscard]] DumpFile dump_boxes(std::span<const BoxesNode> nodes);      ///< first,last,supports,ends
[[nodiscard]] DumpFile dump_layered(std::span<const NodeSphere> nodes);   ///< first,last,x,y,z,radius
[[nodiscard]] DumpFile dump_cells(std::span<const CellBeads<2>> cells);   ///< a,b,c
[[nodiscard]] DumpFile dump_cells(std::span<const CellBeads<3>> cells);   ///< a,b,c,d
[[nodiscard]] std::string bead_lines(std::span<const BeadId> beads);      ///< bead

}  // namespace kds
