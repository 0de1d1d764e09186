#pragma once
// The power diagram from one frame to the next, in the plane or in space, by several techniques. All end in
// the static diagram of the next frame, cells and hidden beads, exactly; they differ in what they look at on
// the way:
//
//   rebuild    CGAL builds it anew.
//   reinsert   Beads of failed certificates, one of each, are taken out until what is left holds at the old
//              positions and at the new ones; they are put in again there.
//   greedy     The same, first the bead of most failed certificates.
//   kinetic    All beads move linearly from frame to frame, flips follow in order (power_diagram.h).
//   lifted     The same in lifted motion (motions/curves/lifted_motion.h).
//   activate   All certificates are tested at the new positions, only beads of failed ones move, kinetically;
//              then beads of what still fails there, until nothing does (Guibas & Russel, An empirical
//              comparison of techniques for updating Delaunay triangulations, 2004).
//   automatic  Rebuilds, or moves all beads or some, as the share of failed certificates in a sample tells.
//
// Certificates are tested exactly: signs of power tests and orientations. A triangulation is never flipped
// towards positions that no motion leads to. Positions: centres and weights (squared lengths) in doubles, as
// many beads as at the start; centres have three rows, in the plane the third is not looked at.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "structures/power_diagram/update_technique.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// What an update did.
struct UpdateCounts {
  std::uint64_t tested = 0;     ///< certificates tested at the new positions; `automatic`: of its sample
  std::uint64_t failed = 0;     ///< of these
  std::uint64_t activated = 0;  ///< beads that moved kinetically
  std::uint64_t removed = 0;    ///< beads taken out and put in again
  std::uint64_t events = 0;     ///< flips, and beads that become hidden or come back
  std::uint64_t rebuilds = 0;   ///< whole diagrams built anew, asked for or not
};

template <int Dimension>
class DiagramUpdate {
 public:
  virtual ~DiagramUpdate() = default;
  /// At the first frame. Throws InputError where there are too few beads.
  virtual void build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) = 0;
  /// To the next frame.
  virtual UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) = 0;
  /// At the frame reached.
  [[nodiscard]] virtual StaticTriangulation<Dimension> diagram() const = 0;
  /// What is wrong with it by the definition, exactly, or nothing: for degenerate frames, whose diagram is
  /// not the only one.
  [[nodiscard]] virtual std::optional<std::string> fault() const = 0;
};

template <int Dimension>
[[nodiscard]] std::unique_ptr<DiagramUpdate<Dimension>> make_diagram_update(UpdateTechnique technique);

/// Above this share of beads taken out it is cheaper to rebuild: so reinsert and greedy do.
inline constexpr double most_taken_out = 0.1;

}  // namespace kds
