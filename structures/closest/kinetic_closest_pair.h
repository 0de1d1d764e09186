#pragma once
// The closest pair of beads, by their centres, while they move. A kinetic tournament keeps the closest of the
// pairs that may be the closest at some time of the step. If pairs are equally close for the rest of the
// step, the first by ids wins. Radii are ignored; for pairs of balls that meet, see the structure `contacts`.
//
// In a periodic cell (HasCell), the distance of two beads is that of their nearest images, and the candidates
// are images. An image that overtakes another of the same pair causes no event where the pair stays the
// closest.
//
// Inserting, erasing or redirecting a bead costs as much as the start of a step. If a bead in no candidate
// pair is inserted or erased, it costs only a search for candidates. Edits throw InputError if more than 10^8
// pairs might be the closest afterwards. In this case, insert and erase change nothing; after a change of
// curves, the run is over.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "certificates/types/distances.h"
#include "kds/structure_base.h"
#include "motions/curves/curves.h"
#include "motions/curves/motion_ref.h"
#include "structures/images/near_images.h"
#include "structures/images/shifted_beads.h"
#include "structures/tournament/tournament.h"

namespace kds {

template <int Dimension>
class KineticClosestPair final : public EditableBase {
 public:
  using Pair = std::array<BeadId, 2>;

  /// Ids: the pair that was closest (`replace`) or closer inside the tournament (`overtake`), then the pair
  /// that is so now; no_bead twice if there is none. Ids of an edit: the bead; the replacement that it causes
  /// follows.
  enum Kind : std::uint8_t { overtake, replace, inserts, erases, changes };

  KineticClosestPair(Simulator& simulator, const MotionRef<Dimension>& motion);

  /// Returns the closest pair, ascending, or nothing if fewer than two beads are present.
  [[nodiscard]] const std::optional<Pair>& pair() const { return pair_; }

  void build() override;
  void start_step() override;
  /// Updates statistics.certificates.per_bead_max, the largest number of certificates on one bead.
  void count_certificates();
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  /// Makes certificates between candidates, which are named by their indices in the list.
  struct Ahead {
    const KineticClosestPair* of;
    Closer operator()(std::uint32_t ahead, std::uint32_t behind) const {
      return {of->shifted_pair(of->candidates_[ahead]), of->shifted_pair(of->candidates_[behind])};
    }
  };

  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override;
  void edit(std::uint8_t kind, BeadId bead) override;
  /// Finds the candidates of the step among the beads that are not marked.
  [[nodiscard]] std::vector<ImagePair> find_candidates(std::span<const char> absent);
  /// Starts the tournament anew among other candidates, at the present time.
  void start_among(std::vector<ImagePair> candidates);
  [[nodiscard]] Closer::Pair shifted_pair(const ImagePair& image) const;
  [[nodiscard]] std::optional<std::string> fault_of_images(const Dyadic& time);

  MotionRef<Dimension> motion_;
  ShiftNumbers<Dimension> shifts_;
  ShiftedBeads<Dimension> shifted_;  // the motion of the certificates
  CertificateTable<Closer> table_;
  std::vector<ImagePair> candidates_;
  Tournament<Ahead> tournament_;
  std::optional<Pair> pair_;
};

static_assert(EditableStructure<KineticClosestPair<2>>);

extern template class KineticClosestPair<2>;
extern template class KineticClosestPair<3>;

}  // namespace kds
