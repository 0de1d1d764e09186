#pragma once
// The closest pair of beads, by their centres, while they move: a kinetic tournament among the pairs that may
// be the closest at some time of the step (candidate_pairs.h). Of pairs equally close for the rest of the
// step the first by ids. Radii are not looked at: the pairs of balls that meet are what contacts are about.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "certificates/types/closer.h"
#include "kds/kinetic_structure.h"
#include "motions/curves/motion_ref.h"
#include "structures/tournament/tournament.h"

namespace kds {

template <int Dimension>
class KineticClosestPair final : public KineticStructure {
 public:
  using Pair = std::array<BeadId, 2>;

  /// Ids: the pair that was closest, or, further down in the tournament, closer; then the pair that is.
  enum Kind : std::uint8_t { overtake, replace };

  KineticClosestPair(Simulator& simulator, const MotionRef<Dimension>& motion);

  [[nodiscard]] std::string_view name() const override { return "closest"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  /// Ascending; none where there are fewer than two beads.
  [[nodiscard]] const std::optional<Pair>& pair() const { return pair_; }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  /// Of candidates by their places in the list.
  struct Ahead {
    const std::vector<Pair>* candidates;
    Closer operator()(std::uint32_t ahead, std::uint32_t behind) const {
      return {(*candidates)[ahead], (*candidates)[behind]};
    }
  };

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  std::size_t index_;
  CertificateTable<Closer> table_;
  std::vector<Pair> candidates_;
  Tournament<Ahead> tournament_;
  std::optional<Pair> pair_;
};

extern template class KineticClosestPair<2>;
extern template class KineticClosestPair<3>;

}  // namespace kds
