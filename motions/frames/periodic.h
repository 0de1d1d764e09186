#pragma once
// Periodic images: reassembles a chain that was cut at the walls of a simulation box.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kds {

/// The columns are the vectors that span the cell. A column of zeros means that the cell is not periodic
/// along that vector.
using Cell = Eigen::Matrix3d;

/// The cell of a frame, if its file gives one.
struct CellRead {
  std::optional<Cell> cell;
  std::string doubt;  ///< why the file's cell is not used, for messages; empty if there is no doubt
};

/// Whether a space group is P 1, as simulation boxes have it; case and blanks do not count.
[[nodiscard]] bool is_space_group_p1(std::string_view group);

/// Reads a cell from its three vectors (columns) and the axes that are periodic. A cell is used if its
/// periodic vectors are linearly independent and shorter than 1e8, and no lattice vector is shorter than 1.
/// Files without a cell write lengths from 0 to 1: these give no cell and no doubt.
[[nodiscard]] CellRead read_cell(const Eigen::Matrix3d& vectors,
                                 const std::array<bool, 3>& periodic = {true, true, true});
/// Reads a cell from the lengths of its vectors and the cosines of the angles between b and c, a and c, a
/// and b.
[[nodiscard]] CellRead read_cell_from_lengths(const Eigen::Vector3d& lengths, const Eigen::Vector3d& cosines);
/// Reads a cell from the lengths of its vectors and the angles in degrees, each between 0 and 180.
[[nodiscard]] CellRead read_cell_from_angles(const Eigen::Vector3d& lengths, const Eigen::Vector3d& degrees);

/// Finds the nearest periodic image of a point. The lattice is Minkowski-reduced first, so the result is
/// correct for cells of any shape. With a reduced basis b1, b2, b3, every face of the Voronoi cell belongs to
/// a vector i b1 + j b2 + k b3 with i, j, k in {-1, 0, 1}. A point that none of these 26 vectors shortens is
/// therefore in the Voronoi cell.
class Images {
 public:
  explicit Images(const Cell& cell);

  /// Returns the shift, in whole cell vectors, that makes `difference` shortest; zero if it is shortest
  /// already.
  [[nodiscard]] Eigen::Vector3d nearest(const Eigen::Vector3d& difference) const;
  /// Returns the shortest of the images of a difference, rounded.
  [[nodiscard]] Eigen::Vector3d shortest(const Eigen::Vector3d& difference) const {
    return shifted(difference, nearest(difference));
  }
  /// Returns the point moved by a shift. If the shift is zero, the point keeps its bits.
  [[nodiscard]] Eigen::Vector3d shifted(const Eigen::Vector3d& point, const Eigen::Vector3d& shift) const;
  /// The Minkowski-reduced basis; columns beyond its rank are zero.
  [[nodiscard]] const Eigen::Matrix3d& reduced() const { return reduced_; }
  /// The whole multiples of the cell's vectors that make the vectors of the reduced basis, a column each.
  [[nodiscard]] const Eigen::Matrix3d& steps() const { return steps_; }

 private:
  Cell cell_;
  Eigen::Matrix3d reduced_;  ///< the reduced basis, cell_ * steps_
  Eigen::Matrix3d steps_;    ///< whole multiples of the cell's vectors
  Eigen::Matrix3d inverse_;  ///< coordinates in the reduced basis
  bool upright_;             ///< the cell lies along the axes, so rounding finds the nearest image
};

/// The periodic image of a chain that is nearest to other chains.
struct ImageBeside {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< shift to the nearest image, in cell vectors
  double distance = 0;                              ///< least distance of two beads, for the nearest image
  double present = 0;  ///< least distance of two beads, for the chain at its present position

  /// Returns true if the image is so much nearer that the chain should be moved to it, or, if the other
  /// chains are in other files, that a warning should name it.
  [[nodiscard]] bool is_much_nearer() const {
    constexpr double much = 1.5;
    return distance * much < present;
  }
};
/// Finds the image of `chain` nearest to `others`. If there are very many pairs, only every n-th bead is
/// considered.
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

/// A chain that is longer than its cell along one of the lattice's shortest vectors.
struct LongerThanCell {
  double chain = 0, cell = 0;  ///< lengths along that vector
};
/// Returns whether the chain, as it lies, is longer than its cell by more than a hundredth though no bond is
/// nearer across the walls. Such a chain was not put into this cell, or the cell is in another unit.
[[nodiscard]] std::optional<LongerThanCell> longer_than_cell(const Eigen::Ref<const Eigen::Matrix3Xd>& chain,
                                                             const Cell& cell);

/// Makes the frames of a chain whole, one after the other: takes for each bead the image nearest to the bead
/// before it, and for each frame the image of the whole chain whose centroid is nearest to that of the frame
/// before. Each bead moves by whole cell vectors, in one rounding; what need not move keeps its bits.
///
/// A cell that does not belong to the coordinates makes bonds shorter but not more alike. A frame is
/// therefore left unchanged unless making it whole reduces the sum of the deviations of the logarithms of
/// bond lengths from their median. A chain of two beads has only one bond, which allows no such test, so it
/// is always made whole.
class WholeChain {
 public:
  using Frame = Eigen::Ref<Eigen::Matrix3Xd, 0, Eigen::OuterStride<>>;
  enum class Outcome {
    unmoved,   ///< but by the shift of the first frame
    joined,    ///< bonds across the walls of the cell were joined
    shifted,   ///< moved as a whole, to the image nearest to the frame before
    doubtful,  ///< left as it is, because bonds would not be more alike
  };

  /// Makes a frame whole. A frame without a cell is left unchanged.
  Outcome make_whole(Frame frame, const std::optional<Cell>& cell);
  /// Makes a frame whole in the cell whose images are given.
  Outcome make_whole(Frame frame, const Images& images);
  /// Shifts the first frame by `shift`, in cell vectors.
  void start_shifted(const Eigen::Vector3d& shift) { start_ = shift; }
  /// Starts again: the next frame is the first.
  void restart() { last_centroid_.reset(); }

 private:
  std::optional<Eigen::Vector3d> last_centroid_;
  Eigen::Vector3d start_ = Eigen::Vector3d::Zero();
};

/// Returns the vectors of the same lattice that are nearest to those of the frame before. Programs let the
/// tilt of a cell jump by a whole vector; these vectors go on without a jump. Returns a cell that does not
/// jump unchanged, and so a cell that is periodic along fewer than three vectors.
[[nodiscard]] Cell continued(const Cell& cell, const Cell& before);

/// Follows single beads through the frames: a bead moves to the image nearest to where it was in the frame
/// before, whatever the cell does in between. Beads of the first frame stay where they are, unless they are
/// joined. Each bead is moved by whole cell vectors of the present frame, in one rounding.
class UnwrappedBeads {
 public:
  /// Moves some beads of the first frame to the image nearest to the bead before: those with `joined[bead]`.
  void join_first_frame(std::vector<bool> joined) { joined_ = std::move(joined); }
  void follow(WholeChain::Frame frame, const Cell& cell);
  /// Starts again: the next frame is the first.
  void restart() { last_.resize(3, 0); }

 private:
  Eigen::Matrix3Xd last_;     // the frame before, as the file has it
  Eigen::Matrix3Xd shifts_;   // of each bead, in cell vectors
  std::vector<bool> joined_;  // empty: none
};

/// How the beads of a file that names no molecules follow one another, by the distances of consecutive beads
/// across the walls of the cell.
enum class SequenceInCell {
  chain,           ///< no distance is more than a third of the lattice's shortest vector, or too few to tell
  several_chains,  ///< some distances are longer, so the nearest image does not tell which beads are bonded
  fluid,           ///< the median distance is longer
};
[[nodiscard]] SequenceInCell sequence_in_cell(const Eigen::Ref<const Eigen::Matrix3Xd>& beads,
                                              const Cell& cell);

}  // namespace kds
