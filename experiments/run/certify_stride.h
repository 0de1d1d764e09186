#pragma once
// What a run of every so-manieth frame may have missed: the frames it left out are read for the deviation
// alone (motions/scene/stride_deviation.h), and contacts are looked for again with balls made larger and
// smaller by each bead's own.
//
// Taken for the truth are the beads of all frames up to the run's last one, in linear motion between them. At
// any time a bead is within its deviation of where the run has it, so that the distance of two changes by at
// most the sum of theirs. A pair that comes within the sum of its radii there is in contact in the run with
// balls so much larger: it is *possible*. A pair in contact in the run with balls so much smaller is in
// contact there, at that time: it is *sure*. So it is with each contact of a pair by itself (met_contacts.h).
// Deviations are rounded up, radii outward.

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

/// Pairs of beads that are in contact at some time, the lower one first.
using PairsMet = std::set<std::pair<BeadId, BeadId>>;

struct ContactBounds {
  PairsMet found;     ///< by the run; all sure ones are among them, and they among the possible
  PairsMet sure;      ///< in contact in truth
  PairsMet possible;  ///< no other pair is in contact in truth, up to the run's last frame
};

/// Contacts of a run, with a flag for each.
struct ContactList {
  std::shared_ptr<const MetContacts> met;
  std::vector<std::uint8_t> flags;  ///< of the contacts

  /// Calls `visit(event, flag)` for begin, end and touch of the contacts, in order.
  template <class Visit>
  void for_each_event(const Visit& visit) const {
    if (met)
      met->for_each_event(
          [&](const Event& event, std::size_t contact) { visit(event, flags[contact] != 0); });
  }
};
struct ContactLists {
  /// By the run, or with the kernel fast by one that is exact; whether it is sure: in truth its beads meet
  /// during this contact.
  ContactList found;
  /// Any contact there is in truth lies within one of these; whether the run has certainly found one in it.
  ContactList possible;
};

struct StrideCertificate {
  StrideDeviation deviation;
  std::optional<ContactBounds> contacts;  ///< where the run has them
  ContactLists listed;                    ///< likewise, else empty
};

/// Throws InputError where the run leaves out no frame, or its input has none. `scene` is the run's.
[[nodiscard]] StrideCertificate certify_stride(const RunOptions& options, const Scene& scene);

/// Throws InputError where --certify has nothing to certify.
void refuse_needless_certificate(const RunOptions& options);

}  // namespace kds
