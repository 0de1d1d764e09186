#pragma once
// The certificates of a hierarchy of boxes: one table for beads of equal radii, whose function is a
// polynomial, and one for balls of unequal radii, whose function is a radical (reaches_further.h). A
// tournament uses both as if they were one table.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "certificates/base/radical.h"
#include "certificates/search/support_searches.h"
#include "certificates/types/reaches_further.h"
#include "kds/certificate_tables.h"
#include "motions/curves/motion_ref.h"

namespace kds {

/// States that the ball `ahead` reaches further than the ball `behind` along a direction.
struct Reach {
  BeadId ahead, behind;
  SlabDirection direction;
};

template <int Dimension>
class SupportTables {
  using Tables = CertificateTables<ReachesFurther, BallReachesFurther>;

 public:
  /// Holds the certificates of `owner`, a structure that has number `index` in the simulator. If `radii`
  /// promises equal radii, the motion's radii are not looked at.
  SupportTables(Simulator& simulator, KineticStructure& owner, std::size_t index,
                const MotionRef<Dimension>& motion, Radii radii)
      : motion_(motion),
        radii_(radii),
        tables_(simulator, owner, index, motion, [radii]<class Certificate>(std::type_identity<Certificate>) {
          const bool needed = std::is_same_v<Certificate, ReachesFurther> || radii == Radii::any;
          return needed ? std::optional(TouchPolicy::ignored) : std::nullopt;
        }) {}

  // These functions act like those of CertificateTable with these names. A handle here has the table in its
  // lowest bit and the slot in the others.

  [[nodiscard]] CertificateHandle watch(const Reach& reach, std::uint32_t place, KnownAtStart known) {
    return visit(reach, [&]<class Certificate>(const Certificate& certificate) {
      return with_table<Certificate>(tables_.template of<Certificate>().watch(certificate, place, known));
    });
  }
  void enqueue_one_of_many(const Reach& reach, std::uint32_t place, KnownAtStart known) {
    visit(reach, [&]<class Certificate>(const Certificate& certificate) {
      tables_.template of<Certificate>().enqueue_one_of_many(certificate, place, known);
    });
  }
  template <class Visit>
  void watch_enqueued(Visit visit) {
    const auto watch_in = [&]<class Certificate>(std::type_identity<Certificate>) {
      tables_.template of<Certificate>().watch_enqueued([&](std::uint32_t place, CertificateHandle handle) {
        visit(place, with_table<Certificate>(handle));
      });
    };
    watch_in(std::type_identity<ReachesFurther>{});
    if (radii_ == Radii::any) watch_in(std::type_identity<BallReachesFurther>{});
  }
  void drop(CertificateHandle handle) {
    if (!has_slot(handle)) return tables_.template of<ReachesFurther>().drop(handle);
    const auto in_table = static_cast<CertificateHandle>(slot_of(handle) / 2);
    if (slot_of(handle) % 2 == 0) {
      tables_.template of<ReachesFurther>().drop(in_table);
    } else {
      tables_.template of<BallReachesFurther>().drop(in_table);
    }
  }

  /// Returns the place in the structure of a certificate, given by table and slot as for
  /// KineticStructure::fail.
  [[nodiscard]] std::uint32_t place_in_structure(unsigned number, std::uint32_t slot) {
    std::uint32_t place = 0;
    tables_.visit(number, [&](const auto& table) { place = table.place_in_structure(slot); });
    return place;
  }
  /// Returns the sign just after the start of the step: 1, 0 or -1. Exact.
  [[nodiscard]] int sign_at_start(const Reach& reach) {
    StageCounts not_counted;
    return visit(reach, [&]<class Certificate>(const Certificate& certificate) {
      return tables_.template of<Certificate>().search().sign_just_after(Kernel::filtered, certificate,
                                                                         Instant(0.0), not_counted);
    });
  }

 private:
  template <class Certificate>
  [[nodiscard]] static CertificateHandle with_table(CertificateHandle handle) {
    if (!has_slot(handle)) return handle;
    return static_cast<CertificateHandle>(2 * slot_of(handle) +
                                          (std::is_same_v<Certificate, BallReachesFurther> ? 1 : 0));
  }
  [[nodiscard]] bool have_equal_radii(BeadId a, BeadId b) const {
    if (radii_ == Radii::equal) return true;
    const Curves<Dimension> curves = motion_.curves();
    for (int k = 0; k <= curves.own_degree(); ++k)
      if (curves.radius(a, k) != curves.radius(b, k)) return false;
    return true;
  }
  /// Calls `visit` with the certificate.
  template <class Visit>
  decltype(auto) visit(const Reach& reach, Visit visit) const {
    const auto& [ahead, behind, direction] = reach;
    if (have_equal_radii(ahead, behind)) return visit(ReachesFurther(ahead, behind, direction));
    return visit(BallReachesFurther(ahead, behind, direction));
  }

  MotionRef<Dimension> motion_;
  Radii radii_;
  Tables tables_;
};

}  // namespace kds
