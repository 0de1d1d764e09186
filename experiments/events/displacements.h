#pragma once
// Records how far beads move from frame to frame during a run.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kds {

class Displacements {
 public:
  struct Bin {
    std::size_t first_frame = 0;  ///< number in the file of the bin's first frame
    std::size_t steps = 0;
    double sum_of_means = 0;  ///< sum over the steps of the beads' mean displacement
    double most = 0;          ///< largest displacement of a bead in a step
    [[nodiscard]] double mean() const { return sum_of_means / static_cast<double>(steps); }
  };

  Displacements() = default;
  /// `width` is the number of steps in a bin.
  explicit Displacements(std::size_t width) : width_(width) {}

  /// Adds the next frame and its number in the file. Each frame has the same number of beads.
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
