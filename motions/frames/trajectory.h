#pragma once
// The sampled frames of one necklace, as read from a file.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace kds {

struct Trajectory {
  std::string file;                        ///< file of origin, for messages
  std::vector<Eigen::Matrix3Xd> frames;    ///< one column per bead, in the file's length unit (angstrom)
  std::vector<std::size_t> frame_numbers;  ///< position of each frame in the file, from 0
  std::vector<double> times;               ///< times of the frames in picoseconds; empty if the file has none
  std::vector<double> element_radii;    ///< van der Waals radius of each bead; empty if elements are unknown
  std::vector<std::string> bead_names;  ///< "CA of ALA 12 in chain A"; empty if residues are unknown
  std::size_t residues = 0;             ///< of the file's chain, without waters and ligands; 0 if unknown
  std::size_t residues_read = 0;        ///< residues with beads
  std::vector<std::size_t> breaks;      ///< b if a chain break lies between beads b and b+1
  std::vector<std::string> warnings;    ///< one line each, without trailing newline

  [[nodiscard]] std::size_t bead_count() const {
    return frames.empty() ? 0 : static_cast<std::size_t>(frames.front().cols());
  }
  /// Returns the number of frame k for messages and results.
  [[nodiscard]] std::size_t frame_number(std::size_t k) const {
    return k < frame_numbers.size() ? frame_numbers[k] : k;
  }
};

}  // namespace kds
