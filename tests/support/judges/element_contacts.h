#pragma once
// Judges intervals of contact between elements (beads or groups of beads) by the history of each pair of
// balls alone (contact_events.h). Times are rational numbers within 2^-100 of the exact ones: equal times of
// the small scenes of tests are found equal, and different ones are much farther apart.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "tests/support/judges/contact_events.h"

namespace kds::test {

/// A contact from one time to another, counted in steps.
struct JudgedInterval {
  Rational begin, end;
  bool open_at_start = false, open_at_end = false;
};
using JudgedIntervals = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<JudgedInterval>>;

inline const Rational& tie() {
  static const Rational least = Rational(1) / Rational(Integer(1) << 90U);
  return least;
}

inline Rational time_of(const PairEvent& event) {
  sturm::Root root = event.root;
  while (root.upper - root.lower > tie() / 1024) sturm::halve(*event.sequence, root);
  return Rational((root.lower + root.upper) / 2 + static_cast<unsigned long>(event.step));
}

/// Joins intervals whose absence is shorter than `gap`, or has length zero.
inline std::vector<JudgedInterval> joined(std::vector<JudgedInterval> parts, const Rational& gap) {
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  std::vector<JudgedInterval> whole;
  for (const JudgedInterval& part : parts) {
    const bool goes_on = !whole.empty() && (part.begin - whole.back().end < tie() ||
                                            part.begin - whole.back().end < gap - tie());
    if (!goes_on) {
      whole.push_back(part);
      continue;
    }
    JudgedInterval& last = whole.back();
    if (part.end > last.end) last.end = part.end;
    last.open_at_start = last.open_at_start || part.open_at_start;
    last.open_at_end = last.open_at_end || part.open_at_end;
  }
  return whole;
}

/// Returns the intervals of all pairs of elements. Balls have the radii of `steps`.
template <Motion M>
JudgedIntervals judged_intervals(const std::vector<M>& steps, const std::vector<std::uint32_t>& elements) {
  enum : std::uint8_t { begin, end, touch };
  JudgedIntervals parts;
  const Rational last(static_cast<unsigned long>(steps.size()));
  const auto beads = static_cast<BeadId>(steps.front().bead_count());
  for (BeadId i = 0; i < beads; ++i) {
    for (BeadId j = i + 1; j < beads; ++j) {
      if (elements[i] == elements[j]) continue;
      const PairHistory history = judged_history(steps, {i, j});
      auto& own = parts[std::minmax(elements[i], elements[j])];
      JudgedInterval now{0, 0, history.in_contact_at_start, false};
      bool on = history.in_contact_at_start;
      for (const PairEvent& event : history.events) {
        const Rational time = time_of(event);
        if (event.kind == touch) own.push_back({time, time, time < tie(), false});
        if (event.kind == begin) now = {time, 0, false, false};
        if (event.kind == end) {
          now.end = time;
          own.push_back(now);
        }
        if (event.kind != touch) on = event.kind == begin;
      }
      if (on) own.push_back({now.begin, last, now.open_at_start, true});
    }
  }
  for (auto& [pair, own] : parts) own = joined(own, 0);
  return parts;
}

/// Returns the contacts that begin within the inner cutoff and end outside the outer one.
inline JudgedIntervals with_two_cutoffs(const JudgedIntervals& inner, const JudgedIntervals& outer) {
  JudgedIntervals all;
  for (const auto& [pair, whole] : outer) {
    const auto found = inner.find(pair);
    if (found == inner.end()) continue;
    for (const JudgedInterval& around : whole) {
      for (const JudgedInterval& part : found->second) {
        if (part.begin < around.begin - tie() || part.end > around.end + tie()) continue;
        all[pair].push_back({part.begin, around.end, part.open_at_start, around.open_at_end});
        break;
      }
    }
  }
  return all;
}

inline JudgedIntervals with_gap(JudgedIntervals intervals, const Rational& gap) {
  for (auto& [pair, own] : intervals) own = joined(own, gap);
  return intervals;
}

}  // namespace kds::test
