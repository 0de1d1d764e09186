#pragma once
// The collision detector to use: all pairs of beads that meet, frame after frame. It starts from scratch with
// a block tree (block_tree.h), which itself chooses the order of beads; from the second frame on, where beads
// move little, it keeps near pairs (kept_pairs.h) and looks only at those that can meet by now. Where a few
// blocks of beads have gone far, pairs are repaired: those of these blocks are found anew, the others stay.
// What it does follows from what it has counted, not from clocks: the same frames, the same work.
//
// Where floats tell nothing, coordinates being huge beside radii, or where very many beads are near, a scene
// is left to a cell list.
//
// With a declared speed, the farthest that any bead moves from one frame to the next, whatever it is, it does
// not even read the positions of beads that are too far from others: not before they can have come near.
//
// Exact whatever beads do: at rest, slow, fast, or somewhere else.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "structures/collision/block_tree.h"
#include "structures/collision/cell_list.h"
#include "structures/collision/distance_queries.h"
#include "structures/collision/kept_pairs.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

template <int Dimension>
class AutoDetector {
 public:
  /// `speed`: no bead moves farther than this between two calls; finite, not negative, and taken on trust.
  /// Throws std::invalid_argument as BlockTree does.
  explicit AutoDetector(PairsAsked asked, std::optional<double> speed = std::nullopt,
                        VectorTarget target = widest_vector_target());

  /// All pairs asked about that meet, in order. Valid until the next call. Radii may change between calls
  /// only without a declared speed.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls);

  /// Distance queries (distance_queries.h). They begin with each scene anew, and cost memory once asked.
  [[nodiscard]] std::optional<ClosestPair> closest_pair(const Balls<Dimension>& balls) {
    return distances().closest_pair(balls);
  }
  const std::vector<BeadPair>& pairs_within(const Balls<Dimension>& balls, double distance) {
    return distances().pairs_within(balls, distance);
  }

  /// What comes next is another scene.
  void forget();

  struct Counts {
    std::uint64_t from_scratch = 0;  ///< frames searched without anything kept
    std::uint64_t by_cells = 0;      ///< of these, those left to a cell list
    std::uint64_t rebuilds = 0;      ///< frames at which near pairs were found anew to be kept
    std::uint64_t repairs = 0;       ///< frames at which those of a few blocks were
    std::uint64_t read = 0;          ///< frames answered from kept pairs, all positions read
    std::uint64_t unread = 0;        ///< the same, but for those of pairs that can meet
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
  double longest_skin_ = 0;        // worth keeping pairs for
  double too_wide_ = 0;            // with such a skin more than a few are near
  double moved_ = 0;               // no bead is farther from where it was when its pairs were found
  std::uint64_t frames_kept_ = 0;  // since the rebuild
  std::uint64_t until_look_ = 0, look_every_ = 1;  // frames from scratch before motion is measured again
  std::vector<double> radii_;                      // that kept pairs are of; one where all are equal
  std::vector<BeadPair> pairs_;
  std::vector<double> strays_;
  std::vector<std::uint32_t> far_blocks_;
  std::optional<DistanceQueries<Dimension>> distances_;  // with a tree of its own: the other is of a frame
  Counts counts_;
};

}  // namespace kds
