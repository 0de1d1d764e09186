#pragma once
// The specifications of the framework's own structures.

#include "structures/session/structure_spec.h"

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

[[nodiscard]] StructureSpec sorted_structure();
[[nodiscard]] StructureSpec box_structure();
[[nodiscard]] StructureSpec hull_structure();
[[nodiscard]] StructureSpec closest_structure();
[[nodiscard]] StructureSpec layered_structure();
[[nodiscard]] StructureSpec wrapped_structure();
[[nodiscard]] StructureSpec power_structure();
[[nodiscard]] StructureSpec contacts_structure();

}  // namespace kds
