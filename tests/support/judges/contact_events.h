#pragma once
// Judges the contact events of each pair of balls alone: the pair's polynomial over rationals, and all of its
// roots by Sturm sequences, in every step of a run. The judge uses nothing of certificates/ or
// structures/contacts.

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "structures/contacts/contacts.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/sturm.h"
#include "tests/support/text_of.h"

namespace kds::test {

struct PairEvent {
  std::size_t step;
  std::uint8_t kind;
  std::shared_ptr<const sturm::Sequence> sequence;
  sturm::Root root;
};

struct PairHistory {
  bool in_contact_at_start = false, in_contact_at_end = false;
  std::vector<PairEvent> events;
};

/// Returns a positive multiple of |c_j - c_i|^2 - (r_i + r_j)^2 in powers of u. Coordinates may be rational.
template <class M>
sturm::Polynomial contact_polynomial(const M& motion, const BeadPair& pair) {
  constexpr int degree = M::degree;
  const auto powers_of = [&](auto control) {  // powers of a Bezier curve
    std::vector<Rational> powers(degree + 1);
    for (int k = 0; k <= degree; ++k) {
      Rational binomial = 1;
      for (int i = 0; i < k; ++i) binomial = binomial * (degree - i) / (i + 1);
      Rational term = binomial * control(k);
      for (int i = 0; i + k <= degree; ++i) {  // (1-u)^(degree-k)
        powers[static_cast<std::size_t>(k + i)] += term;
        term = term * -(degree - k - i) / (i + 1);
      }
    }
    return powers;
  };
  std::vector<Rational> sum(2 * degree + 1);
  const auto add_square = [&](const std::vector<Rational>& p, int sign) {
    for (std::size_t a = 0; a < p.size(); ++a)
      for (std::size_t b = 0; b < p.size(); ++b) sum[a + b] += sign * p[a] * p[b];
  };
  for (int axis = 0; axis < M::dimension; ++axis)
    add_square(powers_of([&](int k) -> Rational {
                 return Rational(motion.coordinate(pair.second, k, axis)) -
                        Rational(motion.coordinate(pair.first, k, axis));
               }),
               1);
  add_square(powers_of([&](int k) -> Rational {
               return Rational(motion.radius(pair.first, k)) + Rational(motion.radius(pair.second, k));
             }),
             -1);
  Integer common = 1;
  for (const Rational& x : sum) common = lcm(common, Integer(denominator(x)));
  sturm::Polynomial polynomial;
  for (const Rational& x : sum) polynomial.push_back(Integer(numerator(Rational(x * common))));
  sturm::normalize(polynomial);
  return polynomial;
}

template <Motion M>
PairHistory judged_history(const std::vector<M>& steps, const BeadPair& pair) {
  enum : std::uint8_t { begin, end, touch };
  PairHistory history;
  bool in_contact = false;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    const sturm::Polynomial f = contact_polynomial(steps[step], pair);
    // The factor u adds a root at the start, so that events at the start are found.
    const auto at_start = std::make_shared<const sturm::Sequence>(sturm::Polynomial{0, 1});
    const auto happens_at_start = [&](std::uint8_t kind) {
      history.events.push_back({step, kind, at_start, {0, 0}});
    };
    const int after = f.empty() ? -1 : sturm::sign_after(f, 0);
    const bool meets = f.empty() || sturm::sign_at(f, 0) <= 0;
    if (step == 0) {
      in_contact = history.in_contact_at_start = after < 0;
      if (meets && !in_contact) happens_at_start(touch);
    } else {
      if (in_contact && after > 0) happens_at_start(end);
      if (!in_contact && after < 0) happens_at_start(begin);
      if (!in_contact && after > 0 && meets) happens_at_start(touch);
      in_contact = after < 0;
    }
    if (f.size() < 2) continue;
    const auto sequence = std::make_shared<const sturm::Sequence>(f);
    for (const sturm::Root& root : sturm::roots_on(*sequence, 0, 1)) {
      if (root.is_number() && (root.lower == 0 || root.lower == 1)) continue;
      if (sturm::multiplicity(*sequence, root, f) % 2 == 1) {
        in_contact = !in_contact;
        history.events.push_back({step, in_contact ? begin : end, sequence, root});
      } else if (!in_contact) {
        history.events.push_back({step, touch, sequence, root});
      }
    }
  }
  history.in_contact_at_end = in_contact;
  return history;
}

/// Returns whether the root lies strictly inside the bracket, or equals it if the bracket is a single number.
inline bool is_in_bracket(const PairEvent& event, double lower, double upper) {
  const Rational low(lower), high(upper);
  sturm::Root root = event.root;
  if (low == high) {
    if (!event.sequence->is_root(low)) return false;
    return root.is_number() ? root.lower == low : root.lower < low && low <= root.upper;
  }
  while (true) {
    if (root.is_number()) return low < root.lower && root.lower < high;
    if (low <= root.lower && root.upper < high) return true;
    if (root.upper <= low || high <= root.lower) return false;
    sturm::halve(*event.sequence, root);
  }
}

/// Explains what is wrong with a run's history; returns nothing if each pair in question has exactly its
/// events, in order and at the right times. `judge` returns the history of a pair.
template <Motion M, class Judge = PairHistory (*)(const std::vector<M>&, const BeadPair&)>
std::optional<std::string> contact_history_fault(const std::vector<M>& steps, const PairsAsked& asked,
                                                 const History& history,
                                                 const std::vector<BeadPair>& at_start,
                                                 const std::vector<BeadPair>& at_end,
                                                 const Judge& judge = judged_history<M>) {
  std::map<BeadPair, std::vector<const Event*>> of_pair;
  double earliest = 0;
  for (const Event& event : history.events) {
    of_pair[{event.change.ids[0], event.change.ids[1]}].push_back(&event);
    if (static_cast<double>(event.step) + event.upper < earliest) return "events are out of order";
    earliest = static_cast<double>(event.step) + event.lower;
  }
  const auto has = [](const std::vector<BeadPair>& pairs, const BeadPair& pair) {
    return std::binary_search(pairs.begin(), pairs.end(), pair);
  };
  const auto beads = static_cast<BeadId>(steps.front().bead_count());
  for (BeadId i = 0; i < beads; ++i) {
    for (BeadId j = i + 1; j < beads; ++j) {
      const BeadPair pair{i, j};
      const auto& found = of_pair[pair];
      const std::string name = text_of("beads ", i, " and ", j, ": ");
      if (!asked.asks(pair)) {
        if (!found.empty() || has(at_start, pair)) return name + "not asked about";
        continue;
      }
      const PairHistory expected = judge(steps, pair);
      if (has(at_start, pair) != expected.in_contact_at_start) return name + "wrong at the start";
      if (has(at_end, pair) != expected.in_contact_at_end) return name + "wrong at the end";
      if (found.size() != expected.events.size())
        return name + text_of(found.size(), " events, expected ", expected.events.size());
      for (std::size_t e = 0; e < found.size(); ++e) {
        const PairEvent& right = expected.events[e];
        if (found[e]->step != right.step || found[e]->change.kind != right.kind)
          return name + text_of("event ", e, ": kind ", int{found[e]->change.kind}, " in step ",
                                found[e]->step, ", expected ", int{right.kind}, " in ", right.step);
        if (!is_in_bracket(right, found[e]->lower, found[e]->upper))
          return name + text_of("event ", e, ": not in [", found[e]->lower, ", ", found[e]->upper, "]");
      }
    }
  }
  return std::nullopt;
}

}  // namespace kds::test
