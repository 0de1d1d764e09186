#pragma once
// The certificates of a convex hull: the order of two beads along the axes, and the turn of three beads.

#include <array>
#include <cstdint>

#include "certificates/types/orientation.h"
#include "certificates/types/precedes.h"
#include "kds/certificate_table.h"

namespace kds {

/// The order of two beads: along the first axis or, if they are level for the rest of the step, along the
/// second axis.
enum class Ordered : std::uint8_t { before, together, after };

struct OrderGuard {
  CertificateHandle x = CertificateHandle::violated;
  CertificateHandle y = CertificateHandle::violated;

  [[nodiscard]] bool is_held() const { return x != CertificateHandle::violated; }
};

class HullGuards {
 public:
  enum Table : unsigned { orders_in_x, orders_in_y, turns };

  HullGuards(Simulator& simulator, KineticStructure& owner, std::size_t structure, const MotionRef<2>& motion)
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

  /// Returns the order of two beads just after now, and guards it while it is so. If the first bead comes
  /// after the second, creates no guard.
  [[nodiscard]] Ordered watch_order(BeadId first, BeadId second, std::uint32_t place, OrderGuard& guard) {
    guard.x = watch(x_, Precedes{{first, second}}, place);
    if (guard.x == CertificateHandle::violated) return Ordered::after;
    if (guard.x != CertificateHandle::zero) return Ordered::before;
    guard.y = watch(y_, PrecedesAlong<1>{{first, second}}, place);
    if (guard.y == CertificateHandle::zero) return Ordered::together;
    if (guard.y != CertificateHandle::violated) return Ordered::before;
    drop(guard);
    return Ordered::after;
  }
  /// Guards that three beads in this order turn counterclockwise (side 1) or clockwise (-1), or that they
  /// never turn.
  [[nodiscard]] CertificateHandle watch_turn(const std::array<BeadId, 3>& beads, int side,
                                             std::uint32_t place) {
    return watch(turns_, Orientation<2>{beads, side}, place);
  }
  void drop(OrderGuard& guard) {
    x_.drop(guard.x);
    y_.drop(guard.y);
    guard = {};
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

}  // namespace kds
