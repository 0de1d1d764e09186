#pragma once
// Kinetic crossings of chains: reports when two bonds that share no bead pass through each other, and when
// they only touch. Straight paths between frames that are far apart let chains cross which in reality cannot.
//
// Each pair of bonds that may meet in a step (NearBalls, with balls around bonds) has one certificate, the
// sign of its orientation. When the certificate fails or touches zero, the four ends are coplanar; the pair
// has an event if the bonds meet at that moment (feature_pair.h).
//
// Signs before and after an event tell what it is:
//
//   cross_plus, cross_minus   the sign changes to + (-), and the bonds meet inside both: they pass through
//                             each other. The linking number of two closed strands along the bonds rises
//                             (falls) by one, the writhe of one strand by two.
//   end_plus, end_minus       the sign changes, but an end of one bond lies on the other. If the strands pass
//                             through each other at this bead, both of its bonds have such an event with
//                             equal signs. If they do not, the signs differ.
//   touch                     the sign does not change
//
// Bonds that meet at a frame compare the sign before the frame with that after it; at the first and the last
// frame there is no event. Bonds that meet and stay in one plane for whole steps have an event when they
// leave it, a touch unless they met all the time.
//
// In a periodic cell, a bond may meet any image of another one, but not its own images or those of bonds that
// share a bead with it. All results are exact.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "kds/certificate_table.h"
#include "kds/structure_base.h"
#include "structures/contacts/near_balls.h"
#include "structures/crossings/chain_bonds.h"
#include "structures/images/shifted_beads.h"
#include "structures/impacts/feature_pair.h"

namespace kds {

class Crossings final : public StructureBase {
 public:
  /// Kinds of events. The ids are the beads of the first bond, then those of the second; bonds ascend.
  enum Kind : std::uint8_t { cross_plus, cross_minus, end_plus, end_minus, touch };

  /// `is_periodic`: whether the motion has a cell in each step.
  Crossings(Simulator& simulator, const MotionRef<3>& motion, ChainBonds bonds, bool is_periodic);

  [[nodiscard]] const ChainBonds& bonds() const { return bonds_; }
  /// Returns the bonds that meet at the end of the step just run, with the signs before (0 if they stayed in
  /// a plane), which determine all later events (RunningStructure::state). Empty before the first step.
  [[nodiscard]] std::vector<BeadId> state() const;

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  using Shift = CellShift<3>;
  /// A pair of bonds that may meet in the step.
  struct NearPair {
    BeadPair bonds;
    Shift shift{};  // of the second bond
    FeaturePair pair;
    int sign = 0;  // of the orientation now
    friend bool operator<(const NearPair& a, const NearPair& b) {
      return std::tie(a.bonds, a.shift) < std::tie(b.bonds, b.shift);
    }
  };

  void find_pairs();
  /// Returns the sign that the pair had at the end of the previous step, or 0 if that is not known.
  [[nodiscard]] int sign_before(const NearPair& pair) const;
  /// Settles what happens to a pair at the start of the step, and watches it.
  void start(std::uint32_t place);
  void watch(std::uint32_t place, KnownAtStart birth);
  void record_meeting(const NearPair& near, bool passes);
  [[nodiscard]] int sign_now(const NearPair& near, const Instant& time) const;

  MotionRef<3> motion_;
  ChainBonds bonds_;
  BondBalls balls_;
  NearBalls<3> near_balls_;
  bool is_periodic_;
  ShiftedBeads<3> shifted_;  // unused without a cell
  CertificateTable<SegmentsOrientation> orientation_;
  FeaturePairTest test_;
  PairsOfImages found_;
  std::vector<NearPair> near_, before_;  // ascending: of this step, and of the step before
  bool has_step_before_ = false;
};

}  // namespace kds
