#pragma once
// How far beads move from frame to frame in the course of a run.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kds {

class Displacements {
 public:
  struct Bin {
    std::size_t first_frame = 0;  ///< number in the file of the frame that it begins at
    std::size_t steps = 0;
    double sum_of_means = 0;  ///< of the beads, step by step
    double most = 0;          ///< of any bead in any step
    [[nodiscard]] double mean() const { return sum_of_means / static_cast<double>(steps); }
  };

  Displacements() = default;
  /// So many steps make a bin.
  explicit Displacements(std::size_t width) : width_(width) {}

  /// The next frame, of so many beads as the one before, and its number in the file.
  void add_frame(Eigen::Matrix3Xd centers, std::size_t number);
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] const std::vector<Bin>& bins() const { return bins_; }

 private:
  std::size_t width_ = 1;
  std::size_t steps_ = 0, number_ = 0;
  Eigen::Matrix3Xd last_;
  std::vector<Bin> bins_;
};

}  // namespace kds
