#pragma once
// The recommended collision detector: finds all pairs of beads that meet, frame after frame. The first frame
// is searched from scratch with a block tree (block_tree.h), which chooses the order of beads itself. From
// the second frame on, if beads move little, the detector keeps near pairs (KeptPairs) and tests only
// pairs that can meet by now. If a few blocks of beads have moved far, only their pairs are searched again.
// All decisions follow from counts, not from clocks, so equal frames cause equal work.
//
// A scene is left to a cell list if floats cannot decide it, because coordinates are huge compared with
// radii, or if very many beads are near each other.
//
// A declared speed is an upper bound of the distance that any bead moves from one frame to the next. With a
// declared speed, the detector does not even read the positions of beads that are too far from others, until
// they can have come near.
//
// The result is exact for every motion: beads at rest, slow, fast, or placed anew.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "structures/blocks/float_conversion.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/block_tree.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/distance_queries.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Keeps near pairs from frame to frame, sorted by gap. While no bead has moved by more than d since the
/// pairs were found, only pairs that were at most 2 d apart then can meet now. Only these pairs are tested.
/// In slow motion they are few, and a frame costs little more than reading the positions of the beads.
///
/// If only some beads have moved far, their pairs are replaced and all others stay.
///
/// The result is exact because gaps are rounded down. A gap is computed from coordinates times a power of
/// two, with an error below 2^-49 of the sum of distance and reach. The stored gap is less by 2^-46 of this
/// sum.
template <int Dimension>
class KeptPairs {
 public:
  /// Keeps the pairs `near`: all pairs that are at most `skin` apart, and possibly others. `conversion` is
  /// the scene's float conversion.
  void keep(const Balls<Dimension>& balls, std::span<const BeadPair> near, double skin,
            const FloatConversion<Dimension>& conversion);
  /// Replaces the pairs with a marked bead; `marks` holds a nonzero mark for each such bead. `near` contains
  /// all pairs with a marked bead that are at most the skin apart, and possibly others. Distances there count
  /// marked beads at their present positions, and other beads where their pairs were found. A marked bead's
  /// reference position becomes its present one. No unmarked bead is farther than `moved` from its reference
  /// position.
  void replace(const Balls<Dimension>& balls, std::span<const unsigned char> marks,
               std::span<const BeadPair> near, double moved);

  [[nodiscard]] double skin() const { return skin_; }
  [[nodiscard]] std::size_t size() const { return pairs_.size(); }

  /// Finds all pairs that meet, in order. No bead may be farther than `moved` from its reference position,
  /// and `moved` is at most half the skin.
  void find_meeting(const Balls<Dimension>& balls, double moved, std::vector<BeadPair>& meeting);
  /// Returns how many pairs find_meeting has tested so far.
  [[nodiscard]] std::size_t looked_at() const { return looked_at_; }

 private:
  static constexpr std::size_t classes = 16;  // classes of gaps, each as wide as skin / classes
  double skin_ = 0, scale_ = 1;
  std::vector<BeadPair> pairs_, more_pairs_;  // class by class; the first class is in order
  std::array<std::size_t, classes + 1> starts_{};
  std::vector<unsigned char> class_of_;
  std::vector<BeadPair> first_class_;
  PairSorter sorter_;
  std::size_t looked_at_ = 0;
};

template <int Dimension>
class AutoDetector {
 public:
  /// `speed` bounds how far a bead moves between two calls. The speed must be finite and not negative. The
  /// motion of beads is not checked against it. Throws std::invalid_argument like BlockTree.
  explicit AutoDetector(PairsAsked asked, std::optional<double> speed = std::nullopt,
                        VectorTarget target = widest_vector_target());

  /// Returns all pairs asked about that meet, in order. The result is valid until the next call. Radii may
  /// change between calls only without a declared speed.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls);

  /// Distance queries (distance_queries.h). Each one treats the scene as new. The first query allocates
  /// memory.
  [[nodiscard]] std::optional<ClosestPair> closest_pair(const Balls<Dimension>& balls) {
    return distances().closest_pair(balls);
  }
  const std::vector<BeadPair>& pairs_within(const Balls<Dimension>& balls, double distance) {
    return distances().pairs_within(balls, distance);
  }

  /// Tells the detector that the next call brings another scene.
  void forget();

  struct Counts {
    std::uint64_t from_scratch = 0;  ///< frames searched without kept pairs
    std::uint64_t by_cells = 0;      ///< frames from scratch that a cell list searched
    std::uint64_t rebuilds = 0;      ///< frames that searched all near pairs again to keep them
    std::uint64_t repairs = 0;       ///< frames that searched the pairs of a few blocks again
    std::uint64_t read = 0;          ///< frames answered from kept pairs after reading all positions
    std::uint64_t unread = 0;        ///< frames answered from kept pairs without reading all positions
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] const BlockTree<Dimension>& tree() const { return tree_; }
  [[nodiscard]] std::size_t kept() const { return kept_.size(); }

 private:
  enum class Mode { nothing, scratch, kept };

  const std::vector<BeadPair>& from_scratch(const Balls<Dimension>& balls);
  const std::vector<BeadPair>& rebuild(const Balls<Dimension>& balls, double step);
  [[nodiscard]] double most_stray(std::span<const double> strays);
  [[nodiscard]] double usual_step(const Balls<Dimension>& balls);
  [[nodiscard]] bool repair(const Balls<Dimension>& balls, std::span<const double> strays);
  void widen_skin(const Balls<Dimension>& balls, double wanted);
  [[nodiscard]] bool same_radii(const Balls<Dimension>& balls) const;
  void measure_scene(const Balls<Dimension>& balls);
  DistanceQueries<Dimension>& distances() {
    if (!distances_) distances_.emplace(tree_.asked(), target_);
    return *distances_;
  }

  VectorTarget target_;
  BlockTree<Dimension> tree_;
  KeptPairs<Dimension> kept_;
  std::optional<CellList<Dimension>> cells_;
  std::optional<double> speed_;
  Mode mode_ = Mode::nothing;
  double longest_skin_ = 0;        // longest skin for which keeping pairs is worthwhile
  double too_wide_ = 0;            // shortest skin known to have more than a few near pairs
  double moved_ = 0;               // bound of each bead's distance from where its pairs were found
  std::uint64_t frames_kept_ = 0;  // since the rebuild
  std::uint64_t until_look_ = 0, look_every_ = 1;  // frames from scratch before motion is measured again
  std::vector<double> radii_;                      // radii of the kept pairs; one if all are equal
  std::vector<BeadPair> pairs_;
  std::vector<double> strays_;
  std::vector<std::uint32_t> far_blocks_;
  // Has a tree of its own, because tree_ holds the beads of a frame.
  std::optional<DistanceQueries<Dimension>> distances_;
  Counts counts_;
};

}  // namespace kds
