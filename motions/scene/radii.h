#pragma once
// The bead radii of a run, by the policies of `--radius`.

#include <span>
#include <string>
#include <vector>

#include "motions/frames/frame_source.h"
#include "motions/frames/trajectory.h"
#include "motions/scene/frame_survey.h"

namespace kds {

/// Returns one radius per bead for all necklaces of a run, in scene order. `policy` is one of
/// - auto: half the longest bond over all frames without chain breaks, rounded up so that its beads meet; one
///   radius for all beads of the run
/// - a number: that radius for all beads (finite, positive)
/// - element: van der Waals radii
/// - array: the radii given with positions in memory (NecklaceBeads::element_radii)
/// - element:fit: van der Waals radii times one factor such that nonadjacent beads are disjoint in the first
///   frame
/// - file:PATH: one radius per line in bead order, or a single one for all beads (finite, not negative)
///
/// Throws InputError naming the option, file, line or bead. `survey` is that of the necklaces' frames; `auto`
/// needs its bonds.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy,
                                             std::span<const NecklaceBeads> necklaces,
                                             const FrameSurvey& survey);
/// Returns the radii of necklaces in memory. The necklaces may have different numbers of frames.
[[nodiscard]] std::vector<double> bead_radii(const std::string& policy,
                                             std::span<const Trajectory> necklaces);

}  // namespace kds
