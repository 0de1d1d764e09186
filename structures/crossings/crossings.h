#pragma once
// Kinetic crossings of chains: reports when two bonds that share no bead pass through each other, and when
// they only touch. Chains can cross on straight paths between frames that are far apart; bonds of molecules
// cannot.
//
// Each pair of bonds that may meet in a step (NearBalls, with balls around bonds) has one certificate, the
// sign of its orientation. When the certificate fails or touches zero, the four ends are coplanar; the pair
// has an event if the bonds meet at that moment (feature_pair.h). A pair that stays coplanar for the whole
// step has certificates on the sides and ends of its bonds instead, and an event if the bonds part.
//
// The signs before and after an event determine its kind:
//
//   cross_plus, cross_minus   the sign changes to + (-), and the bonds meet inside both: they pass through
//                             each other. The linking number of two closed strands along the bonds rises
//                             (falls) by one, the writhe of one strand by two.
//   end_plus, end_minus       the sign changes, but an end of one bond lies on the other. Each bond at this
//                             bead has an event of its own. The strands pass through each other if the two
//                             signs are equal.
//   touch                     the sign does not change, or the bonds were coplanar before or after
//
// If bonds meet at a frame, the signs before and after the frame decide the kind. The first and the last
// frame have no events. Bonds that keep meeting while they are coplanar have their event when they part, and
// the signs before they met and after they parted decide.
//
// In a periodic cell, a bond may meet images of other bonds. Its own images, and images of bonds that share a
// bead with it, are left out.
//
// All results are exact. A step costs as much as NearBalls, and one certificate for each near pair.

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
  /// Returns the pairs of bonds that meet at the end of the step, each with its shift and with the sign
  /// before they met (0: unknown). These pairs determine all later events (RunningStructure::state). Empty
  /// before the first step.
  [[nodiscard]] std::vector<BeadId> state() const;

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  /// A pair of bonds that may meet in the step.
  struct NearPair {
    BeadPair bonds;
    CellShift<3> shift{};  // of the second bond
    FeaturePair features;
    int sign = 0;  // of the orientation now; if the bonds stay coplanar, that before they met, or 0
    std::uint64_t settled = ~std::uint64_t{0};  // the moment at which coplanar bonds were settled last
    friend bool operator<(const NearPair& a, const NearPair& b) {
      return std::tie(a.bonds, a.shift) < std::tie(b.bonds, b.shift);
    }
  };

  /// Returns the motion of the certificates: with points for shifts in a cell, otherwise that of the run.
  [[nodiscard]] MotionRef<3> points() const { return is_periodic_ ? MotionRef<3>(shifted_) : motion_; }
  [[nodiscard]] TableMotion whose() const {
    return is_periodic_ ? TableMotion::of_structure : TableMotion::of_run;
  }
  void find_pairs();
  /// Returns the pair's sign at the end of the previous step, or 0 if the sign is not known.
  [[nodiscard]] int sign_before(const NearPair& near) const;
  /// Settles what happens to a pair at the start of the step, and watches it.
  void start(std::uint32_t place);
  void watch(std::uint32_t place, KnownAtStart birth);
  /// Watches the sides and ends of coplanar bonds.
  void watch_in_plane(std::uint32_t place);
  template <class Certificate>
  void watch_in_plane(CertificateTable<Certificate>& table, Certificate certificate, std::uint32_t place);
  template <class Certificate>
  void fail_in_plane(CertificateTable<Certificate>& table, std::uint32_t slot);
  void record_meeting(const NearPair& near, bool passes);
  [[nodiscard]] int orientation_now(const NearPair& near, const Instant& time) const;

  MotionRef<3> motion_;
  ChainBonds bonds_;
  BondBalls balls_;
  NearBalls<3> near_balls_;
  bool is_periodic_;
  ShiftedBeads<3> shifted_;  // unused without a cell
  CertificateTable<SegmentsOrientation> orientation_;
  CertificateTable<CrossComponent<0>> sides_x_;  // this and the tables below: of coplanar bonds
  CertificateTable<CrossComponent<1>> sides_y_;
  CertificateTable<CrossComponent<2>> sides_z_;
  CertificateTable<BeyondEnds> ends_;
  FeaturePairTest test_;
  PairsOfImages found_;
  CertificatesPerBead per_bead_;         // all zero between steps
  std::vector<NearPair> near_, before_;  // ascending: of this step, and of the step before
  bool has_step_before_ = false;
};

}  // namespace kds
