#pragma once
// Sampled frames of one necklace, as they come out of a file.

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace kds {

struct Trajectory {
  std::string file;                        ///< where it was read, for messages
  std::vector<Eigen::Matrix3Xd> frames;    ///< one column a bead, in the file's length unit (angstrom)
  std::vector<std::size_t> frame_numbers;  ///< 0-based place of each frame in the file
  std::vector<double> times;               ///< of the frames, in picoseconds; empty where the file has none
  std::vector<double> element_radii;  ///< van der Waals radius of each bead; empty where elements are unknown
  std::vector<std::string> bead_names;  ///< "CA of ALA 12 in chain A"; empty where residues are unknown
  std::size_t residues = 0;           ///< of the chain in the file, without waters and ligands; 0 if unknown
  std::size_t residues_read = 0;      ///< those with beads
  std::vector<std::size_t> breaks;    ///< b: beads b and b+1 are joined across a chain break
  std::vector<std::string> warnings;  ///< one line each, without trailing newline

  [[nodiscard]] std::size_t bead_count() const {
    return frames.empty() ? 0 : static_cast<std::size_t>(frames.front().cols());
  }
  /// For messages and results.
  [[nodiscard]] std::size_t frame_number(std::size_t k) const {
    return k < frame_numbers.size() ? frame_numbers[k] : k;
  }
};

}  // namespace kds
