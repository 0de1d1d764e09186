#pragma once
// Bounds what frames left out (a stride in --frames) may hide from `kds contacts`, for the task's rule.
//
// Truth, deviations, shrunk and enlarged balls are those of experiments/run/certify_stride.h: shrunk balls
// meet only while two beads are truly within a cutoff, and enlarged balls meet whenever they are. Time runs
// evenly from each frame used to the next.
//
// Let S, F, T and P be the sets of times at which a pair is in contact: with shrunk balls, in the run, in
// truth, and with enlarged balls. Each set is a function of the times within the inner and the outer cutoff
// that is monotone: more times within a cutoff give more times in contact. For two cutoffs, a time is in
// contact if some earlier time is within the inner cutoff and all times from there on are within the outer
// one. For a gap, a time is in contact too if it lies in an absence shorter than the gap, and more times in
// contact make absences shorter. So S lies in F and in T, and F and T lie in P. In each frame used, the beads
// of the run are at their true positions. A pair that is within the inner cutoff in such a frame is in
// contact in the run, in truth and in P: the frame is a *sure moment*. It follows that:
//
// - A contact of the run that contains a contact of S or a sure moment is *sure*: the pair is truly in
//   contact during it.
// - Each true contact lies within one contact of P, a *possible* contact.
// - Contacts of P that contain a contact of S or a sure moment are at most as many as true contacts.
// - The true time in contact is at least that of S and at most that of P.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/contacts/follow_contacts.h"
#include "motions/scene/stride_deviation.h"

namespace kds {

/// Bounds of one pair, or of all pairs together.
struct ContactBoundsOfPair {
  std::uint64_t sure = 0;   ///< contacts of the run during which the pair is truly in contact
  std::uint64_t least = 0;  ///< lower bound of the true number of contacts
  double least_time = 0;    ///< lower bound of the true time in contact, in units of the clock
  double most_time = 0;     ///< upper bound of the true time in contact
};

struct ContactsCertificate {
  StrideDeviation deviation;
  std::string bead_name;  ///< of the bead that deviates most; empty without a name
  std::map<std::pair<std::uint32_t, std::uint32_t>, ContactBoundsOfPair> pairs;  ///< all possible pairs
  ContactBoundsOfPair all;                                                       ///< the sums
  std::size_t sure_pairs = 0;            ///< pairs with a sure contact
  std::vector<std::uint8_t> is_sure;     ///< of the intervals of the report, in their order
  std::vector<IntervalRecord> possible;  ///< in the order of their ends
  std::vector<std::uint8_t> is_found;    ///< whether a contact of the run lies in the possible one
};

/// Bounds the contacts of a report that follow_contacts returned. Reads all frames and runs the contacts
/// three more times. Throws InputError for faults of the input.
[[nodiscard]] ContactsCertificate certify_contacts(
    const ContactsTask& task, const Scene& scene, const ContactsReport& report,
    const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace kds
