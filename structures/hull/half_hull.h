#pragma once
// The upper or the lower half of a kinetic convex hull: a chain of beads in their order (HullCertificates),
// and every other bead under one of its edges. There are three kinds of certificates:
//
//   each bead of the chain comes before the next                            (1)
//   the chain turns strictly, always to the same side, at each inner bead   (2)
//   a bead under an edge comes between its ends, and not beyond its line    (3)
//
// Proof that they imply the answer, for the upper half: turn the first axis by an arbitrarily small angle, so
// that no two beads are level. By (1) and (2), the chain is the graph of a concave function over this axis,
// with a corner at each inner bead. By (3), no bead lies above the graph, or before or after it. Therefore
// the chain is the upper hull, and its beads are the corners.
//
// When a certificate fails, a bead of the chain leaves it, or a bead moves to the next edge or into the
// chain. The certificates around are then created anew. The repair ends even if many certificates fail
// at one time: each step either removes a pair of beads in the chain that are in the wrong order, or it
// increases the function between such pairs. No step creates such a pair.
//
// Beads that stay together count as one, represented by the least of them. The others may lie under an edge
// at this bead, or under the bead itself if it is the whole chain.
//
// Inserted and erased beads enter and leave the chain in the same way. Beads that change course keep their
// places, in the chain or not, until the certificates around them are created anew. Whatever order the chain
// then has, beads leave it until (1) and (2) hold, before other beads are considered.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "certificates/types/orientation.h"
#include "certificates/types/precedes.h"
#include "kds/certificate_table.h"

namespace kds {

/// The order of two beads: along the first axis or, if they are level for the rest of the step, along the
/// second axis.
enum class Ordered : std::uint8_t { before, together, after };

struct OrderHandles {
  CertificateHandle x = CertificateHandle::violated;
  CertificateHandle y = CertificateHandle::violated;

  [[nodiscard]] bool is_held() const { return x != CertificateHandle::violated; }
};

/// The certificates of a convex hull: the order of two beads along the axes, and the turn of three beads.
class HullCertificates {
 public:
  enum Table : unsigned { orders_in_x, orders_in_y, turns };

  HullCertificates(Simulator& simulator, KineticStructure& owner, std::size_t structure,
                   const MotionRef<2>& motion)
      : x_(simulator, owner, structure, orders_in_x, motion),
        y_(simulator, owner, structure, orders_in_y, motion),
        turns_(simulator, owner, structure, turns, motion) {}

  /// The certificate that fails now. Until failure_is_over, a new certificate with its function is known to
  /// have a root now.
  struct Failed {
    std::uint32_t place;
    BeadId before, after;  // for an order: the order before the failure
  };
  [[nodiscard]] Failed failure(unsigned table, std::uint32_t slot) {
    const auto in = [&](const auto& held) -> Failed {
      const auto& certificate = held.certificate(slot);
      failed_ = certificate.identity();
      failed_side_ = certificate.side();
      const std::array<BeadId, 2> order{certificate.beads[0], certificate.beads[1]};
      return {held.place_in_structure(slot), order[failed_side_ ? 0 : 1], order[failed_side_ ? 1 : 0]};
    };
    return table == orders_in_x ? in(x_) : table == orders_in_y ? in(y_) : in(turns_);
  }
  void failure_is_over() { failed_ = {}; }

  /// Returns the order of two beads just after now, and creates the certificates that hold while the order
  /// lasts. If the first bead comes after the second, creates none.
  [[nodiscard]] Ordered watch_order(BeadId first, BeadId second, std::uint32_t place, OrderHandles& handles) {
    handles.x = watch(x_, Precedes{{first, second}}, place);
    if (handles.x == CertificateHandle::violated) return Ordered::after;
    if (handles.x != CertificateHandle::zero) return Ordered::before;
    handles.y = watch(y_, PrecedesAlong<1>{{first, second}}, place);
    if (handles.y == CertificateHandle::zero) return Ordered::together;
    if (handles.y != CertificateHandle::violated) return Ordered::before;
    drop(handles);
    return Ordered::after;
  }
  /// Creates the certificate that three beads in this order turn counterclockwise (side 1) or clockwise (-1),
  /// or that they never turn.
  [[nodiscard]] CertificateHandle watch_turn(const std::array<BeadId, 3>& beads, int side,
                                             std::uint32_t place) {
    return watch(turns_, Orientation<2>{beads, side}, place);
  }
  void drop(OrderHandles& handles) {
    x_.drop(handles.x);
    y_.drop(handles.y);
    handles = {};
  }
  void drop(CertificateHandle& turn) {
    turns_.drop(turn);
    turn = CertificateHandle::violated;
  }

  /// Returns signs just after the start of the step.
  [[nodiscard]] int order_at_start(Kernel kernel, BeadId first, BeadId second, StageCounts& stages) const {
    if (const int sign = at_start(x_, Precedes{{first, second}}, kernel, stages)) return -sign;
    return -at_start(y_, PrecedesAlong<1>{{first, second}}, kernel, stages);
  }
  [[nodiscard]] int turn_at_start(Kernel kernel, const std::array<BeadId, 3>& beads,
                                  StageCounts& stages) const {
    return at_start(turns_, Orientation<2>{beads, 1}, kernel, stages);
  }

 private:
  template <class Certificate>
  [[nodiscard]] CertificateHandle watch(CertificateTable<Certificate>& table, const Certificate& certificate,
                                        std::uint32_t place) {
    if (certificate.identity() != failed_) return table.watch(certificate, place);
    if (certificate.side() == failed_side_) return CertificateHandle::violated;
    return table.watch(certificate, place, KnownAtStart::at_own_root);
  }
  template <class Certificate>
  [[nodiscard]] static int at_start(const CertificateTable<Certificate>& table,
                                    const Certificate& certificate, Kernel kernel, StageCounts& stages) {
    return table.search().sign_just_after(kernel, certificate, Instant(0), stages);
  }

  CertificateTable<Precedes> x_;
  CertificateTable<PrecedesAlong<1>> y_;
  CertificateTable<Orientation<2>> turns_;
  Identity failed_;  // a default value if nothing fails
  bool failed_side_ = false;
};

class HalfHull {
 public:
  HalfHull(HullCertificates& certificates, bool upper) : certificates_(certificates), upper_(upper) {}

  /// Sets the number of beads, the absent beads (if any are marked) and a chain of some present beads, with
  /// which start() begins.
  void assign(std::size_t beads, std::span<const char> absent, const std::vector<BeadId>& chain);
  /// Called at the start of a step.
  void start();
  /// Handles the failure, at the present time, of the certificate at this place of this table.
  void fail(unsigned table, std::uint32_t place);
  // Edits, while time stands still within a step:
  void insert(BeadId bead);
  void erase(BeadId bead);
  /// Drops all certificates of a bead that is present, until hold_all().
  void give_up(BeadId bead);
  void hold_all();
  [[nodiscard]] static bool is_upper(std::uint32_t place) { return place / 2 % 2 == 1; }

  /// Returns the beads of the chain from the first to the last.
  [[nodiscard]] std::vector<BeadId> chain() const;
  /// Returns whether beads entered or left the chain since the last call.
  [[nodiscard]] bool take_changed() { return std::exchange(changed_, false); }
  void count_certificates(CertificatesPerBead& per_bead) const;

 private:
  static constexpr std::uint32_t not_under = 0xffffffffU;

  struct Bead {
    bool present = true;
    bool in_chain = false;
    // A bead of the chain has neighbours in the chain. Any other bead has the edge above or below it.
    BeadId left = no_bead;    // the left neighbour, or the left end of the edge
    BeadId right = no_bead;   // the right neighbour
    OrderHandles after_left;  // the order with the right neighbour, or with the left end
    OrderHandles before_right;
    CertificateHandle turn =
        CertificateHandle::violated;  // the chain turns properly at the bead, or it is not beyond its edge
    std::vector<BeadId> under;        // beads under the edge that begins at this bead
    std::uint32_t index_under = not_under;
  };

  void hold(BeadId vertex);
  void put(BeadId bead);
  void put_under(BeadId bead, BeadId left);
  void put_in(BeadId bead, BeadId after);
  void take_out(BeadId vertex);
  void remove(BeadId vertex);
  void stand_in(BeadId bead, BeadId vertex);
  void open_edge(BeadId left, BeadId look_from);
  void loosen(BeadId vertex);
  void take_away(BeadId bead);
  void displace(BeadId bead);
  void release(BeadId bead);
  [[nodiscard]] std::uint32_t place_of(BeadId bead, bool right = false) const {
    return 4 * bead + (upper_ ? 2 : 0) + (right ? 1 : 0);
  }

  HullCertificates& certificates_;
  bool upper_;
  BeadId first_ = no_bead;
  std::vector<Bead> beads_;
  std::vector<BeadId> unheld_;     // in the chain, with certificates missing
  std::vector<BeadId> displaced_;  // neither in the chain nor under it
  bool changed_ = false;
};

}  // namespace kds
