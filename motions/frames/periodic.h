#pragma once
// Periodic images: a chain that was cut at the walls of a simulation box is put together again.

#include <Eigen/Core>
#include <optional>

namespace kds {

/// The columns are the three vectors that span the cell.
using Cell = Eigen::Matrix3d;

/// From the lengths of the vectors and the cosines of the angles between b and c, a and c, a and b. None if
/// they span no volume, or where a length is at most 1: files without a cell write 0 or 1.
[[nodiscard]] std::optional<Cell> cell_from_lengths(const Eigen::Vector3d& lengths,
                                                    const Eigen::Vector3d& cosines);

/// The same from angles in degrees.
[[nodiscard]] std::optional<Cell> cell_from_angles(const Eigen::Vector3d& lengths,
                                                   const Eigen::Vector3d& degrees);

/// Makes the frames of a chain whole, one after the other: takes for each bead the image nearest to the bead
/// before it, and for each frame the image of the whole chain whose centroid is nearest to that of the frame
/// before. Each bead moves by whole cell vectors, in one rounding; what need not move keeps its bits.
class WholeChain {
 public:
  using Frame = Eigen::Ref<Eigen::Matrix3Xd, 0, Eigen::OuterStride<>>;

  /// Returns whether something moved. A frame without a cell stays as it is.
  bool make_whole(Frame frame, const std::optional<Cell>& cell);
  /// The next frame is the first.
  void restart() { last_centroid_.reset(); }

 private:
  std::optional<Eigen::Vector3d> last_centroid_;
};

}  // namespace kds
