#pragma once
// Updates of a power diagram from one frame to the next, in the plane or in space, by several techniques. All
// techniques end in exactly the static diagram of the next frame, with its cells and hidden beads; they
// differ in the work done on the way:
//
//   rebuild    CGAL builds it anew.
//   reinsert   Takes out one bead of each failed certificate until the remaining diagram is correct at the
//              old and at the new positions, and then inserts the beads again at the new positions.
//   greedy     As `reinsert`, but takes out the beads of the most failed certificates first.
//   kinetic    Moves all beads linearly from frame to frame and makes all flips in order (power_diagram.h).
//   lifted     As `kinetic`, in lifted motion (motions/curves/lifted_motion.h).
//   activate   Tests all certificates at the new positions and moves only the beads of failed ones,
//              kinetically; then the beads of certificates that still fail there, until none does (Guibas &
//              Russel, An empirical comparison of techniques for updating Delaunay triangulations, 2004).
//   automatic  Rebuilds, or moves all or some beads, depending on how many certificates fail in a sample.
//
// Certificates are tested exactly, by signs of power tests and orientations. A triangulation is never flipped
// towards positions to which no motion leads. Positions are centres and weights (squared lengths) in doubles.
// The number of beads is the same as at the start. Centres have three rows; the third is ignored in the
// plane.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "motions/curves/snapshot.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

enum class UpdateTechnique : std::uint8_t { rebuild, reinsert, greedy, kinetic, lifted, activate, automatic };
/// Names of the techniques, in the order of the enumerators.
inline constexpr std::array<std::string_view, 7> update_technique_names{
    "rebuild", "reinsert", "greedy", "kinetic", "lifted", "activate", "auto"};
[[nodiscard]] constexpr std::string_view name_of(UpdateTechnique technique) {
  return update_technique_names[static_cast<std::size_t>(technique)];
}

/// Counts the work of an update.
struct UpdateCounts {
  std::uint64_t tested = 0;     ///< certificates tested at the new positions; with `automatic`, in its sample
  std::uint64_t failed = 0;     ///< tested certificates that failed
  std::uint64_t activated = 0;  ///< beads that moved kinetically
  std::uint64_t removed = 0;    ///< beads taken out and inserted again
  std::uint64_t events = 0;     ///< flips, and beads that become hidden or visible
  std::uint64_t rebuilds = 0;   ///< whole diagrams built anew, requested or not
};

template <int Dimension>
class DiagramUpdate {
 public:
  virtual ~DiagramUpdate() = default;
  /// Builds the diagram at the first frame. Throws InputError if there are too few beads.
  virtual void build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) = 0;
  /// Updates the diagram to the next frame.
  virtual UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) = 0;
  /// Returns the diagram at the frame reached.
  [[nodiscard]] virtual StaticTriangulation<Dimension> diagram() const = 0;
  /// Checks the diagram exactly by the definition. Returns a description of a fault, or nothing. Use it for
  /// degenerate frames, which have several correct diagrams.
  [[nodiscard]] virtual std::optional<std::string> fault() const = 0;
};

template <int Dimension>
[[nodiscard]] std::unique_ptr<DiagramUpdate<Dimension>> make_diagram_update(UpdateTechnique technique);

/// `reinsert` and `greedy` rebuild if a larger share of beads than this would be taken out, because a rebuild
/// is then cheaper.
inline constexpr double most_taken_out = 0.1;

}  // namespace kds
