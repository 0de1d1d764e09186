#pragma once
// Statistics of the lives of contacts: figures of each pair, and the survival function of all contacts.
//
// A contact that is open at the first or the last frame is censored: it lives at least as long as its
// interval. Lengths of time are in units of the clock of the intervals (contact_intervals.h).
//
// - Mean, median and longest life are those of the intervals as they are, open ones included.
// - The rate of beginning is the number of beginnings divided by the time without contact. The rate of end is
//   the number of ends divided by the time in contact. Both are the maximum likelihood estimates if contacts
//   begin and end at constant rates. The residence time is the inverse of the rate of end.
// - The survival function is the product-limit estimate of Kaplan and Meier (1958), S(t) = product of 1 - d/n
//   over all lengths up to t, where n contacts reach a length and d of them end there. Its 95% band is
//   S^exp(+-1.96 sqrt(V) / log S) with Greenwood's V = sum of d / (n (n - d)) (Kalbfleisch and Prentice, The
//   Statistical Analysis of Failure Time Data, 1.4). The band takes contacts as independent, which contacts
//   of one trajectory are not: it is a lower bound of the uncertainty.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "structures/contacts/contact_intervals.h"

namespace kds {

/// The length of one contact.
struct ContactLife {
  std::uint64_t pair = 0;  ///< 2^32 times the first element, plus the second
  double length = 0;
  bool is_censored = false;

  /// Orders by pair, then by length. Ends come before censored lives of equal length.
  friend bool operator<(const ContactLife& a, const ContactLife& b) {
    if (a.pair != b.pair) return a.pair < b.pair;
    if (a.length != b.length) return a.length < b.length;
    return !a.is_censored && b.is_censored;
  }
};

/// Keeps lives and returns them sorted. LivesInMemory is the simplest one; another may keep them on disk.
class LifeStore {
 public:
  virtual ~LifeStore() = default;
  virtual void add(const ContactLife& life) = 0;
  /// Calls `visit` for all lives in ascending order. May be called several times.
  virtual void visit_sorted(const std::function<void(const ContactLife&)>& visit) = 0;
};

class LivesInMemory final : public LifeStore {
 public:
  void add(const ContactLife& life) override { lives_.push_back(life); }
  void visit_sorted(const std::function<void(const ContactLife&)>& visit) override;

 private:
  std::vector<ContactLife> lives_;
};

/// The figures of one pair, or of all pairs together.
struct LifetimeFigures {
  std::uint64_t contacts = 0, open_at_start = 0, open_at_end = 0;
  std::uint64_t open_at_both = 0;  ///< counted in the two above too
  double total = 0;                ///< time in contact
  double longest = 0;
  double median = 0;      ///< the middle length, or the mean of the two middle ones
  double run_length = 0;  ///< length of the run, or the sum over all pairs

  [[nodiscard]] std::uint64_t begins() const { return contacts - open_at_start; }
  [[nodiscard]] std::uint64_t ends() const { return contacts - open_at_end; }
  [[nodiscard]] double mean() const { return contacts == 0 ? 0 : total / static_cast<double>(contacts); }
  /// Returns the share of time in contact, 0 to 1; 0 if there is no pair.
  [[nodiscard]] double occupancy() const {
    return total < run_length ? total / run_length : run_length > 0 ? 1 : 0;
  }
  // Return nothing if there is no time to divide by, or no end.
  [[nodiscard]] std::optional<double> begin_rate() const;
  [[nodiscard]] std::optional<double> end_rate() const;
  [[nodiscard]] std::optional<double> residence() const;
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
  double survival = 1;
  std::optional<double> lower = {}, upper = {};  ///< ends of the band; none where the function is 0
};

class ContactLifetimes {
 public:
  ContactLifetimes()
      : ContactLifetimes(std::make_unique<LivesInMemory>(), std::make_unique<LivesInMemory>()) {}
  /// Takes two empty stores: for the lives by pair, and for the lives of all pairs.
  ContactLifetimes(std::unique_ptr<LifeStore> by_pair, std::unique_ptr<LifeStore> of_all)
      : by_pair_(std::move(by_pair)), of_all_(std::move(of_all)) {}

  /// Adds an interval. Intervals of one pair must come in their order.
  void add(const ContactInterval& interval);

  [[nodiscard]] std::size_t pair_count() const { return pairs_.size(); }
  /// Visits all pairs that are ever in contact, ascending. `run_length` is the length of the run.
  void visit_pairs(double run_length, const std::function<void(const PairLifetimes&)>& visit) const;
  /// Returns the figures of all contacts. Occupancy is the mean of the pairs that are ever in contact.
  [[nodiscard]] LifetimeFigures all(double run_length) const;
  /// Returns the survival function: the lengths at which contacts end, and the last length. Leaves out points
  /// until the function has fallen by `least_drop` since the point before. Empty without contacts.
  [[nodiscard]] std::vector<SurvivalPoint> survival(double least_drop = 0) const;

 private:
  std::map<std::uint64_t, PairLifetimes> pairs_;
  std::unique_ptr<LifeStore> by_pair_, of_all_;
};

}  // namespace kds
