#pragma once
// Periodic images: a chain that was cut at the walls of a simulation box is put together again.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace kds {

/// The columns are the vectors that span the cell. A column of zeros means that the cell is not periodic
/// along that vector.
using Cell = Eigen::Matrix3d;

/// The cell of a frame, as far as its file tells one.
struct CellRead {
  std::optional<Cell> cell;
  std::string doubt;  ///< why the cell in the file is not used, for messages; empty if there is none
};

/// Reads a cell from its three vectors (columns) and the axes that are periodic. A cell is used if its
/// periodic vectors are finite and linearly independent, and no lattice vector is shorter than 1. Files
/// without a cell write lengths from 0 to 1: these give no cell and no doubt.
[[nodiscard]] CellRead read_cell(const Eigen::Matrix3d& vectors,
                                 const std::array<bool, 3>& periodic = {true, true, true});
/// Reads a cell from the lengths of its vectors and the cosines of the angles between b and c, a and c, a
/// and b.
[[nodiscard]] CellRead read_cell_from_lengths(const Eigen::Vector3d& lengths, const Eigen::Vector3d& cosines);
/// Reads a cell from the lengths of its vectors and the angles in degrees.
[[nodiscard]] CellRead read_cell_from_angles(const Eigen::Vector3d& lengths, const Eigen::Vector3d& degrees);

/// These two return the cell without the doubt.
[[nodiscard]] inline std::optional<Cell> cell_from_lengths(const Eigen::Vector3d& lengths,
                                                           const Eigen::Vector3d& cosines) {
  return read_cell_from_lengths(lengths, cosines).cell;
}
[[nodiscard]] inline std::optional<Cell> cell_from_angles(const Eigen::Vector3d& lengths,
                                                          const Eigen::Vector3d& degrees) {
  return read_cell_from_angles(lengths, degrees).cell;
}

/// The nearest periodic image of a point. The lattice is Minkowski-reduced first, so the image is the nearest
/// one in cells of any shape: with a reduced basis b1, b2, b3 every face of the Voronoi cell belongs to a
/// vector i b1 + j b2 + k b3 with i, j, k in {-1, 0, 1}, and a point that none of the 26 shortens is in the
/// Voronoi cell.
class Images {
 public:
  explicit Images(const Cell& cell);

  /// The shift, in whole cell vectors, that makes `difference` shortest; zero if it is shortest already.
  [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& difference) const;
  /// The point moved by a shift, with its bits kept if the shift is zero.
  [[nodiscard]] Eigen::Vector3d shifted(const Eigen::Vector3d& point, const Eigen::Vector3d& shift) const;

 private:
  Cell cell_;
  Eigen::Matrix3d reduced_;  ///< the reduced basis, cell_ * steps_
  Eigen::Matrix3d steps_;    ///< whole numbers
  Eigen::Matrix3d inverse_;  ///< coordinates in the reduced basis
  bool upright_;             ///< the cell lies along the axes, so rounding finds the nearest image
};

/// A chain and its periodic image nearest to other chains.
struct ImageBeside {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< to the nearest image, in cell vectors
  double distance = 0;                              ///< of the nearest image: least distance of two beads
  double present = 0;                               ///< of the chain as it lies

  /// Chains are moved, or reported across files, only if the image is much nearer.
  [[nodiscard]] bool is_much_nearer() const {
    constexpr double much = 1.5;
    return distance * much < present;
  }
};
/// Finds the image of `chain` nearest to `others`. Looks at every n-th bead if there are very many pairs.
[[nodiscard]] ImageBeside nearest_image_beside(const Eigen::Matrix3Xd& others, const Eigen::Matrix3Xd& chain,
                                               const Cell& cell);

/// Necklaces of one frame, one after the other, each compared with all that were added before it.
class EarlierNecklaces {
 public:
  /// Returns the image of the chain nearest to the necklaces before it in the same cell, if it is nearer than
  /// the chain as it lies.
  [[nodiscard]] std::optional<ImageBeside> nearer_image(const Eigen::Matrix3Xd& chain,
                                                        const std::optional<Cell>& cell) const;
  void add(const Eigen::Matrix3Xd& chain, const std::optional<Cell>& cell);

 private:
  struct InCell {
    Cell cell;
    std::vector<double> coordinates;  ///< x, y and z of each bead
  };
  std::vector<InCell> cells_;
};

/// Makes the frames of a chain whole, one after the other: takes for each bead the image nearest to the bead
/// before it, and for each frame the image of the whole chain whose centroid is nearest to that of the frame
/// before. Each bead moves by whole cell vectors, in one rounding; what need not move keeps its bits.
///
/// A cell that is not that of the coordinates makes bonds shorter, but not more alike. Such a frame stays as
/// it is: the deviations of the logarithms of bond lengths from their median must add up to less than before.
/// Chains of two beads have one bond, which tells nothing, and are made whole.
class WholeChain {
 public:
  using Frame = Eigen::Ref<Eigen::Matrix3Xd, 0, Eigen::OuterStride<>>;
  enum class Outcome {
    unmoved,
    moved,
    doubtful,  ///< left as it is, because bonds would not be more alike
  };

  /// A frame without a cell stays as it is.
  Outcome make_whole(Frame frame, const std::optional<Cell>& cell);
  /// Moves the first frame by this shift, in cell vectors.
  void start_shifted(const Eigen::Vector3d& shift) { start_ = shift; }
  /// The next frame is the first.
  void restart() { last_centroid_.reset(); }

 private:
  std::optional<Eigen::Vector3d> last_centroid_;
  Eigen::Vector3d start_ = Eigen::Vector3d::Zero();
};

}  // namespace kds
