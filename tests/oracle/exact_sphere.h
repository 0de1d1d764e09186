#pragma once
// Smallest enclosing spheres in exact numbers, in two ways: a proof for beads of equal radii, and CGAL for
// all beads.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "dump.h"
#include "rational.h"
#include "scene.h"

namespace oracle {

/// a + b sqrt(d), d >= 0.
struct RootNumber {
  Rational a = 0, b = 0, d = 0;
};

[[nodiscard]] CGAL::Sign compare(const RootNumber& x, const RootNumber& y);
[[nodiscard]] double to_double(const RootNumber& x);

struct ExactSphere {
  std::array<double, 3> centre{};  ///< rounded
  double radius = 0;               ///< rounded
  RootNumber exact_radius;
  std::array<RootNumber, 3> exact_centre;  ///< all have the same square root as the radius
  std::vector<unsigned> support;           ///< ascending
};

/// Returns CGAL's smallest sphere around the given balls, by its LP algorithm: the default heuristic misses
/// beads of cospherical sets.
[[nodiscard]] ExactSphere cgal_sphere(const Frame& frame, const std::vector<unsigned>& beads);

/// Returns whether a ball inside the sphere touches it: the distance of the centres equals the difference of
/// the radii.
[[nodiscard]] bool touches(const ExactSphere& sphere, const Ball& ball);

struct Proof {
  ExactSphere sphere;  ///< through the basis, without its exact radius
  std::optional<std::string>
      objection;  ///< the reason why it is not the node's smallest sphere, or why the basis is not minimal
};

/// Proves the sphere of a node with beads of equal radii. Three conditions are sufficient: the basis centres
/// are affinely independent, the centre lies strictly inside their hull, and no centre of the node lies
/// outside their circumsphere.
[[nodiscard]] Proof prove_sphere(const Frame& frame, const Node& node);

}  // namespace oracle
