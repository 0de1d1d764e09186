#pragma once
// Bounds the contacts that a run with a stride may have missed or invented. The frames left out are read only
// for the deviation of each bead (motions/scene/stride_deviation.h). Contacts are then computed again with
// each ball enlarged, and again with each ball shrunk, by its bead's deviation.
//
// The truth is the linear motion between all frames up to the run's last one. At any time the true position
// of a bead lies within its deviation of its position in the run, so the distance of two beads changes by at
// most the sum of their deviations. A pair that truly comes within the sum of its radii is therefore in
// contact in the run with enlarged balls: the pair is *possible*. A pair in contact in the run with shrunk
// balls is truly in contact at that time: the pair is *sure*. The argument holds for each single contact of a
// pair too (met_contacts.h). Deviations are rounded up and radii outward.

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "experiments/run/met_contacts.h"
#include "experiments/run/run_options.h"
#include "kds/event_log.h"
#include "motions/scene/stride_deviation.h"

namespace kds {

/// Pairs of beads that are in contact at some time. The lower bead comes first.
using PairsMet = std::set<std::pair<BeadId, BeadId>>;

struct ContactBounds {
  PairsMet found;     ///< found by the run; contains `sure`, lies within `possible`
  PairsMet sure;      ///< truly in contact
  PairsMet possible;  ///< contains every pair truly in contact up to the run's last frame
};

/// The contacts of a run, with a flag for each.
struct ContactList {
  std::shared_ptr<const MetContacts> met;
  std::vector<std::uint8_t> flags;  ///< one per contact

  /// Calls `visit(event, flag)` for the begin, end and touch events of the contacts, in order.
  template <class Visit>
  void for_each_event(const Visit& visit) const {
    if (met)
      met->for_each_event(
          [&](const Event& event, std::size_t contact) { visit(event, flags[contact] != 0); });
  }
};
struct ContactLists {
  /// The contacts that the run found. If the run uses the kernel `fast`, an exact run finds them instead. The
  /// flag says whether the contact is sure: its beads truly meet during this contact.
  ContactList found;
  /// Contacts such that each true contact lies within one of them. The flag says whether the run certainly
  /// found a contact within this one.
  ContactList possible;
};

struct StrideCertificate {
  StrideDeviation deviation;
  std::optional<ContactBounds> contacts;  ///< only if the run has contacts
  ContactLists listed;                    ///< empty if the run has no contacts
};

/// Certifies a run over `scene`. Throws InputError if the run leaves out no frame or its input has no frames.
[[nodiscard]] StrideCertificate certify_stride(const RunOptions& options, const Scene& scene);

/// Throws InputError if --certify has nothing to certify.
void refuse_needless_certificate(const RunOptions& options);

}  // namespace kds
