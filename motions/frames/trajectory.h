#pragma once
// The sampled frames of one necklace, as read from a file, and its chain breaks.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "motions/base/bead_groups.h"
#include "motions/frames/periodic.h"

namespace kds {

/// Frames that have chain breaks which the first frame has not.
struct LaterBreaks {
  std::size_t frames = 0;       ///< how many
  std::size_t first_frame = 0;  ///< the first of these, by its number in the file
};

struct Trajectory {
  std::string file;                        ///< where it was read, for messages
  std::vector<Eigen::Matrix3Xd> frames;    ///< one column a bead, in the file's length unit (angstrom)
  std::vector<std::size_t> frame_numbers;  ///< 0-based index of each frame in the file
  std::vector<Cell> cells;                 ///< one a frame; empty unless all frames have a periodic cell
  std::vector<double> times;          ///< one a frame, in picoseconds; empty unless all frames have a time
  std::vector<double> element_radii;  ///< van der Waals radius of each bead; empty where elements are unknown
  std::string element_lack;           ///< a message that says why elements are unknown, if any are
  std::vector<std::string> bead_names;  ///< "CA of ALA 12 in chain A"; empty where residues are unknown
  BeadGroups bead_groups;               ///< empty unless asked for
  std::size_t residues = 0;             ///< in the file's chain, without waters and ligands; 0 if unknown
  std::size_t residues_read = 0;        ///< those with beads
  std::vector<std::size_t>
      breaks;                     ///< b: beads b and b+1 are joined across a chain break, in the first frame
  std::vector<std::size_t> gaps;  ///< b: beads b and b+1 are not bonded, as the names in the file say
  bool truncated = false;         ///< frames are missing at the end (FrameSource::is_truncated)
  LaterBreaks later_breaks;       ///< complete once all frames have been read
  std::vector<std::string> warnings;  ///< one line each, without trailing newline

  [[nodiscard]] std::size_t bead_count() const {
    return frames.empty() ? 0 : static_cast<std::size_t>(frames.front().cols());
  }
  /// Returns the number of frame k for messages and results.
  [[nodiscard]] std::size_t frame_number(std::size_t k) const {
    return k < frame_numbers.size() ? frame_numbers[k] : k;
  }
};

/// Finds chain breaks: gaps where residues are missing, so that two consecutive beads are far apart.
/// Returns b for each bond b to b+1 of this frame that is longer than 1.5 times the median bond. Needs two
/// bonds. There is no bond at `gaps`, which are in ascending order.
[[nodiscard]] std::vector<std::size_t> find_chain_breaks(const Eigen::Ref<const Eigen::Matrix3Xd>& frame,
                                                         const std::vector<std::size_t>& gaps = {});

/// Returns one line that names the first ten breaks.
[[nodiscard]] std::string describe_chain_breaks(const std::string& file,
                                                const std::vector<std::size_t>& breaks);

/// Returns the frames 0, n, 2n ... with their numbers in the file. For n above 1 the times are dropped. A
/// trajectory at rest is returned unchanged.
[[nodiscard]] Trajectory every_nth(const Trajectory& trajectory, std::size_t n);

}  // namespace kds
