#pragma once
// Statistics of the lives of contacts: figures of each pair and of all pairs with 95% intervals
// (contact_estimates.h), and the survival function. Lengths of time are in units of the clock of the
// intervals (contact_intervals.h).
//
// All figures are those of a run in equilibrium, in which pairs begin and end contacts as often at any time.
//
// - Rate of beginning: beginnings seen / time out of contact. Rate of end: ends seen / time in contact.
//   Residence: time in contact / ends seen, which is the mean life of the contacts that begin in a long run.
//   The mean length of the intervals would be too small, because the run cuts open ones.
// - Figures of all pairs: sums over all pairs that were asked for, also those that never meet.
// - Survival function: the share S(t) of the contacts that begin which last longer than t. It is the
//   product-limit estimate of Kaplan and Meier (1958) over contacts whose beginning was seen. Contacts that
//   are open at the last frame are censored. Contacts that are open at the first frame are left out, because
//   their age is unknown. The rest of their life is shorter than their life. To count them as censored when
//   they end would also be wrong, because censoring must not depend on when a contact ends.
// - Band of S(t), for each t alone: S^exp(+-q sqrt(V) / log S), where V is the variance of log S
//   with contacts grouped by pair (Ying and Wei, 1994): V = n / (n - 1) * sum over pairs of (sum of r over
//   the pair's contacts)^2, and q is Student's quantile with n - 1 degrees of freedom. A contact that ends at
//   x has r = G(min(t, x)) - [x <= t] / (Y(x) - d(x)), and a censored one the first term only. Here Y
//   contacts reach a length, d of them end there, and G(t) is the sum of d / (Y (Y - d)) up to t. n is Kish's
//   effective number of pairs, (sum of c)^2 / sum of c^2, where a pair has c contacts. With a single pair,
//   each contact takes the place of a pair, and V is n / (n - 1) times Greenwood's variance G. The band
//   covers any dependence between the contacts of one pair, and none between pairs.
//
// Lengths that are equal in truth differ in their last digits. Lengths that are less than 1e-12 times the
// largest reading of the clock above the least one of a step belong to that step of S.

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "structures/contacts/contact_estimates.h"
#include "structures/contacts/contact_intervals.h"

namespace kds {

/// The figures of one pair, or of all pairs together.
struct LifetimeFigures {
  std::uint64_t contacts = 0, open_at_start = 0, open_at_end = 0;
  std::uint64_t open_at_both = 0;  ///< counted in the two above too
  double total = 0;                ///< time in contact
  double longest = 0;              ///< the longest interval, open ones as they are
  double run_length = 0;           ///< length of the run, or the sum over all pairs
  Estimate occupancy;              ///< share of the time in contact, 0 to 1
  Estimate begin_rate, end_rate;   ///< missing without time out of contact, or in contact
  Estimate residence;              ///< inverse of end_rate: without an end, there is a lower bound only

  [[nodiscard]] std::uint64_t begins() const { return contacts - open_at_start; }
  [[nodiscard]] std::uint64_t ends() const { return contacts - open_at_end; }
  /// Returns the time out of contact.
  [[nodiscard]] double apart() const { return total < run_length ? run_length - total : 0; }
};

struct PairLifetimes : LifetimeFigures {
  std::uint32_t first = 0, second = 0;  ///< elements
  ContactMoment first_begin, last_end;
};

/// A value of the survival function. It holds from this length to the next one.
struct SurvivalPoint {
  double length = 0;
  std::uint64_t at_risk = 0;  ///< contacts that reach this length
  std::uint64_t ended = 0, censored = 0;
  Estimate survival = {};  ///< without a band where the function is 0 or 1, and if there is one contact only
};

struct Survival {
  /// The lengths at which contacts end, and the last length.
  std::vector<SurvivalPoint> points;
  Estimate median;  ///< the least length at which the function, and each end of its band, is at most 1/2
  std::uint64_t contacts = 0, left_out = 0;  ///< whose beginning was seen, and that are open at the start
};

class ContactLifetimes {
 public:
  /// Adds an interval, which takes 16 bytes. Intervals of one pair must come in their order.
  void add(const ContactInterval& interval);

  /// Returns the figures of the pairs that are ever in contact, ascending. `run_length` is the length of the
  /// run.
  [[nodiscard]] std::vector<PairLifetimes> pairs(double run_length) const;
  /// Returns the figures of all pairs. `asked` is the number of pairs that could be in contact.
  [[nodiscard]] LifetimeFigures all(double run_length, std::uint64_t asked) const;
  /// Returns the survival function. Leaves out points until the function has fallen by `least_drop` since the
  /// point before. Takes time to sort the contacts, and then constant time for each.
  [[nodiscard]] Survival survival(double least_drop = 0) const;

 private:
  /// The length of a contact whose beginning was seen.
  struct Life {
    double length = 0;
    std::uint32_t pair = 0;  // pairs are numbered as they are added
    bool is_censored = false;
  };
  struct Pair {
    PairLifetimes figures;
    std::uint32_t index = 0;
  };

  std::map<std::uint64_t, Pair> pairs_;
  std::vector<Life> lives_;
  double largest_reading_ = 0;
};

}  // namespace kds
