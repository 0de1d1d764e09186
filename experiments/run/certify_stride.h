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
// pair too (MetContacts). Deviations are rounded up and radii outward. With --cutoff, two balls meet while
// their beads are within the cutoff (contact_distance.h).

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "experiments/run/run_options.h"
#include "kds/event.h"
#include "motions/base/bead.h"
#include "motions/scene/stride_deviation.h"

namespace kds {

/// Records the contacts of a run. Each contact is an interval of time from its begin to its end. `holding`
/// then says which contacts contain a contact of the same beads in another run of the same motion with
/// smaller balls.
///
/// Smaller balls meet only while the larger balls meet, so a contact of the smaller balls lies within exactly
/// one contact of the larger balls. Times are known only as brackets. If the brackets leave several
/// candidates, no candidate is reported as the container.
class MetContacts final : public EventListener {
 public:
  using Pair = std::pair<BeadId, BeadId>;
  /// A step, and a time within the step before its end.
  using Moment = std::pair<std::size_t, double>;
  struct Contact {
    Pair pair;
    Moment earliest;  ///< lower bound of the begin
    /// Upper bound of the end. The default means that the contact lasts to the end of the run.
    Moment latest{std::numeric_limits<std::size_t>::max(), 0};
  };

  void on_event(const Event& event) override;
  /// Returns true because the events are printed after the run.
  [[nodiscard]] bool prints_time_of(const Event&) const override { return true; }

  struct OfContact {
    Event event;
    std::size_t contact;  ///< index of the event's contact
  };
  [[nodiscard]] std::span<const OfContact> events() const { return events_; }
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }

 private:
  std::vector<OfContact> events_;
  std::vector<Contact> contacts_;     // ordered by their begins
  std::map<Pair, std::size_t> open_;  // contacts that have not ended
};

/// Returns for each element of `contacts` whether it certainly contains an element of `within`.
[[nodiscard]] std::vector<std::uint8_t> holding(std::span<const MetContacts::Contact> contacts,
                                                std::span<const MetContacts::Contact> within);

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
    if (!met) return;
    for (const auto& [event, contact] : met->events()) visit(event, flags[contact] != 0);
  }
};
struct ContactLists {
  /// The contacts that the run found. The flag says whether the contact is sure: its beads truly meet during
  /// this contact.
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

/// Returns the radii of the enlarged and the shrunk balls. Throws InputError that names --certify if a
/// deviation is too large.
[[nodiscard]] RadiiWithin certified_radii(const StrideDeviation& deviation, std::span<const double> radii);

/// Throws InputError if --certify has nothing to certify, because all frames are read. `otherwise` ends the
/// message.
void refuse_needless_certificate(const InputOptions& input, std::string_view otherwise = "");

}  // namespace kds
