#pragma once
// Finds the pairs of a bead and an image of another that may meet in a step. The search is in space: beads
// are sorted into the bins of a grid, whatever their order along a chain. It serves solvents as well as
// chains.
//
// The step is cut into pieces, short enough for the root mean square of the beads' moves. In a piece, a bead
// is in a ball at rest around the box of its curve's control points, a swept ball; the swept ball of a bead
// that moves far is replaced by several, one for each part of its path. The grid lies along the vectors of
// the Minkowski-reduced lattice, and swept balls are moved into one cell of the lattice. A bin is as wide as
// the largest reach of two swept balls, so that only adjacent bins are compared, across the walls too. If the
// lattice's cell is narrower than a bin, several images of it are compared.
//
// Pairs whose swept balls meet are looked at more closely: with d_k the differences of two beads' control
// points in the piece and R_k the sums of their radii, they are apart if all n.d_k > R_k |n| for some
// direction n, and in contact throughout if all |d_k| < R_k (block_beads.h).
//
// The search computes in doubles. A number that decides is a sum of fewer than 100 rounded terms at degrees
// up to 10, each at most a bound B of all coordinates, so its error is below 2^-46 B. Each reach is granted
// 2^-44 B.
//
// With groups, beads of no group are left out, and bins are compared only if one has a bead of one group and
// the other a bead of the other group.
//
// Time is linear in the swept balls of all pieces and their pairs that meet, except that one ball much larger
// than the others makes all bins as large as itself. Memory is linear in the beads and the pairs found.

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/frames/periodic.h"
#include "structures/images/shifted_beads.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// A bead and the image of another that is shifted by `shift` (ShiftNumbers).
struct ImagePair {
  BeadPair pair;
  std::uint32_t shift = 0;  ///< of the second bead
  friend auto operator<=>(const ImagePair&, const ImagePair&) = default;
};

/// A deque gives memory back while its images are taken one after the other.
using ImagePairs = std::deque<ImagePair>;

struct PairsOfImages {
  ImagePairs unclear;        ///< may begin or end to meet in the step; each once
  ImagePairs overlapping;    ///< meet during the whole step; filled only on request
  std::uint64_t proved = 0;  ///< pairs proved apart or in contact throughout, once in each piece
  /// Whether two images of one bead may be in contact with another at the same time.
  bool may_repeat = false;

  void clear() {
    unclear.clear();
    overlapping.clear();
    proved = 0;
    may_repeat = false;
  }
};

template <int Dimension>
class NearImages {
 public:
  explicit NearImages(PairsAsked asked);

  /// Finds the pairs asked about for the step of these curves, which must have a cell. New shifts get
  /// numbers.
  void find(const Curves<Dimension>& curves, bool list_overlapping, ShiftNumbers<Dimension>& shifts,
            PairsOfImages& pairs);
  /// Finds the pairs of these beads after only their curves have changed since the last call, which must have
  /// been in the same step. May find other pairs too. Costs as much as their neighbours, unless the beads
  /// move much farther than all beads did at the last call of `find`; then it costs as much as `find`.
  void find_of(const Curves<Dimension>& curves, std::span<const BeadId> beads, bool list_overlapping,
               ShiftNumbers<Dimension>& shifts, PairsOfImages& pairs);
  /// Tests all pairs: lists each image whose box of fractional coordinates comes within reach. For the kernel
  /// `exact`. Takes quadratic time. Throws InputError if the cell changes by almost its own size.
  void find_by_boxes(const Curves<Dimension>& curves, ShiftNumbers<Dimension>& shifts, PairsOfImages& pairs);

 private:
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  using Point = std::array<double, dimension>;
  using Shift = CellShift<Dimension>;
  /// The lattice of the step in its reduced basis, completed by orthogonal unit vectors.
  struct Lattice {
    Eigen::Matrix3d middle =
        Eigen::Matrix3d::Zero();            // half-way between the ends of the step; columns are vectors
    std::vector<Eigen::Matrix3d> controls;  // at each control point
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d steps = Eigen::Matrix3d::Zero();  // the reduced vectors in multiples of the cell's
    std::array<bool, 3> periodic{};
    double shortest = 0;  // length of the first vector of `middle`
    double strain = 0;    // a shift changes by at most this share of its length in the middle
  };
  /// A ball that holds a bead's ball in a piece of the step. Its centre is in one cell of the lattice; its
  /// bead is there plus `wrapped` reduced vectors.
  struct Swept {
    Point center;
    double reach;
    BeadId bead;
    std::uint8_t groups;
    Shift wrapped;
  };

  void lay_lattice(const Curves<Dimension>& curves);
  /// Finds homes and sizes.
  void measure(const Curves<Dimension>& curves);
  /// How far a bead moves in the step, its largest coordinate by absolute value, and its largest radius.
  struct Measured {
    double move = 0, farthest = 0, radius = 0;
  };
  /// Measures a bead and finds its home.
  [[nodiscard]] Measured measure_bead(const Curves<Dimension>& curves, BeadId bead);
  [[nodiscard]] double stray_wanted() const;
  void enter_piece(const Curves<Dimension>& curves, double from, double to, double most_stray);
  /// Returns a ball around control points.
  [[nodiscard]] std::pair<Point, double> ball_around(const double* points) const;
  [[nodiscard]] Swept swept_of(BeadId bead, const double* points, double radius) const;
  /// Sets the control points of a bead in a piece of the step.
  void set_points(const Curves<Dimension>& curves, BeadId bead, double from, double to);
  void fill_grid();
  /// Returns the bin of a swept ball.
  [[nodiscard]] Shift bin_of(const Swept& swept) const;
  /// Puts the changed curve of a bead in place of its old one. Returns false if the grid does not suit it.
  [[nodiscard]] bool replace(const Curves<Dimension>& curves, BeadId bead);
  void forget_moved();
  /// Compares a bead with all others but those that are `done`.
  void compare_bead(BeadId bead, std::span<const BeadId> done, bool list_overlapping,
                    ShiftNumbers<Dimension>& shifts, PairsOfImages& pairs);
  void compare_bins(bool list_overlapping, ShiftNumbers<Dimension>& shifts, PairsOfImages& pairs);
  void compare(const Shift& bin, std::size_t at, const Shift& by, bool list_overlapping,
               ShiftNumbers<Dimension>& shifts, PairsOfImages& pairs);
  /// Returns the bin `by` bins away, and the image of the lattice that it lies in; nothing beyond the grid.
  [[nodiscard]] std::optional<std::pair<std::size_t, Shift>> neighbour(const Shift& bin,
                                                                       const Shift& by) const;
  /// Returns the vector by which an image of the lattice is moved, in the middle of the step.
  [[nodiscard]] Point vector_to(const Shift& image) const;
  void look_at(const Swept& one, const Swept& other, const Shift& image, bool list_overlapping,
               ShiftNumbers<Dimension>& shifts, PairsOfImages& pairs);
  /// Adds a pair with all shifts in a box.
  void add_box(const BeadPair& pair, const Shift& low, const Shift& high, ShiftNumbers<Dimension>& shifts,
               PairsOfImages& pairs) const;
  [[nodiscard]] std::uint32_t number_of(const Shift& reduced, ShiftNumbers<Dimension>& shifts) const;
  [[nodiscard]] bool asks(BeadId one, BeadId other) const;
  /// Returns the groups of a bead; all of them without groups.
  [[nodiscard]] std::uint8_t groups_of(BeadId bead) const {
    return asked_.groups.empty() ? std::uint8_t{3} : asked_.groups[bead];
  }
  /// Returns a coordinate of a point in vectors of the reduced lattice.
  [[nodiscard]] double coordinate_of(const Point& point, std::size_t vector) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis)
      sum +=
          lattice_.inverse(static_cast<Eigen::Index>(vector), static_cast<Eigen::Index>(axis)) * point[axis];
    return sum;
  }

  PairsAsked asked_;
  std::vector<std::uint32_t> necklaces_;  // of each bead
  Lattice lattice_;
  std::size_t row_ = 2;       // control points of a curve
  double largest_ = 0;        // bounds all numbers that are added
  double margin_ = 0;         // granted to each reach for rounding
  double radius_ = 0;         // largest
  double rms_move_ = 0;       // of the beads in the step
  double farthest_ = 0;       // bounds all coordinates
  std::vector<Shift> homes_;  // of each bead: its cell of the lattice in the middle of the step

  // The present piece of the step.
  std::vector<Eigen::Matrix3d> piece_;  // control points of the lattice
  std::vector<double> points_, radii_;  // those of each bead, its home moved to the origin
  std::vector<Swept> swept_, sorted_;   // in the order of the beads, and by bins
  bool in_parts_ = false;               // some bead has several swept balls
  bool is_whole_step_ = true;           // the step is not cut
  double wobble_ = 0;                   // added to the reach of images
  double grid_reach_ = 0;               // largest of the swept balls that the grid is laid for
  double stray_ = 0;                    // largest stray of a swept ball
  bool may_repeat_ = false;             // as PairsOfImages
  bool has_grid_ = false;               // the grid is that of the whole step, with a swept ball for each bead
  std::vector<std::uint32_t> places_;   // of each bead in `swept_`
  // Beads whose curves have changed since the grid was filled, and a mark for each of them.
  std::vector<BeadId> moved_;
  std::vector<char> is_moved_;
  // The grid along the lattice's vectors: number of bins, bins within reach, first corner and width of a bin
  // in coordinates of the lattice, and where each bin begins in `sorted_`.
  Shift bins_{}, reach_{};
  Point low_{}, width_{};
  std::vector<std::uint32_t> begins_, next_, in_bins_;
  std::vector<std::uint8_t> groups_;  // that occur in each bin
  std::vector<Point> differences_;    // of two beads' control points
};

}  // namespace kds
