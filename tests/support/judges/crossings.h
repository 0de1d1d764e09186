#pragma once
// Judges which bonds of chains pass through each other between frames of whole coordinates, by the impacts of
// all pairs of bonds (impacts.h). Shares only Crossings::Kind with the structure.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "kds/event.h"
#include "structures/crossings/crossings.h"
#include "tests/support/judges/impacts.h"
#include "tests/support/text_of.h"

namespace kds::test {

struct JudgedCrossing {
  std::size_t step = 0;
  JudgedTime time;
  Crossings::Kind kind{};
  std::array<BeadId, 4> beads{};
};

/// Frames of beads with whole coordinates, bead after bead.
using WholeFrames = std::vector<std::vector<std::array<int, 3>>>;

/// Appends the events of the bonds a to a+1 and b to b+1, ascending in time.
inline void judge_bonds(const WholeFrames& frames, BeadId a, BeadId b, std::vector<JudgedCrossing>& events) {
  const std::array<BeadId, 4> beads{a, a + 1, b, b + 1};
  int before = 0;  // the sign, 0 if it is unknown
  for (std::size_t step = 0; step + 1 < frames.size(); ++step) {
    std::vector<int> points;
    for (const BeadId bead : beads)
      for (const std::size_t frame : {step, step + 1})
        points.insert(points.end(), frames[frame][bead].begin(), frames[frame][bead].end());
    const ImpactJudge judge(ImpactKind::edge_edge, 1, points);
    const sturm::Polynomial orientation = judge.orientation();
    const JudgedTime start = ImpactJudge::number(0);
    if (orientation.empty()) {  // contact that ends in the plane is a touch
      const std::vector<JudgedTime> times = judge.critical_in_plane();
      if (!judge.meet(start)) before = 0;
      for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        if (ImpactJudge::are_equal(times[k], times[k + 1])) continue;
        if (!judge.meet(times[k]) || judge.meet(ImpactJudge::between(times[k], times[k + 1]))) continue;
        if (step > 0 || !ImpactJudge::are_equal(times[k], start))
          events.push_back({step, times[k], Crossings::touch, beads});
        before = 0;
      }
      continue;
    }
    std::vector<JudgedTime> times;
    ImpactJudge::add_roots(orientation, times);
    const auto sign_after = [&](std::size_t k) {
      const JudgedTime next = k + 1 < times.size() ? times[k + 1] : ImpactJudge::number(1);
      return sturm::sign_at(orientation, ImpactJudge::between(times[k], next).root.lower);
    };
    const auto add = [&](const JudgedTime& time, int after) {
      if (!judge.meet(time)) return;
      Crossings::Kind kind = Crossings::touch;
      if (before == -after) {
        const bool at_end = judge.meet_at_end(time);
        kind = after > 0 ? (at_end ? Crossings::end_plus : Crossings::cross_plus)
                         : (at_end ? Crossings::end_minus : Crossings::cross_minus);
      }
      events.push_back({step, time, kind, beads});
    };
    std::size_t k = 0;
    if (!times.empty() && ImpactJudge::are_equal(times[0], start)) {
      if (step > 0) add(start, sign_after(0));
      before = sign_after(k++);
    } else {
      before = sturm::sign_at(orientation, 0);
    }
    for (; k < times.size() && !ImpactJudge::are_equal(times[k], ImpactJudge::number(1)); ++k) {
      add(times[k], sign_after(k));
      before = sign_after(k);
    }
  }
}

/// Returns whether the time lies in the event's bracket.
inline bool is_within(const JudgedTime& time, const Event& event) {
  const Rational lower(event.lower), upper(event.upper);
  sturm::Root root = time.root;
  while (!root.is_number() && (root.lower < lower || upper < root.upper)) {
    if (root.upper < lower || upper < root.lower) return false;
    sturm::halve(*time.sequence, root);
  }
  return root.is_number() ? lower <= root.lower && root.lower <= upper : true;
}

/// Explains what is wrong with the events of a run over the frames, whose bonds begin at the beads `bonds`,
/// or returns nothing.
inline std::optional<std::string> crossings_fault(const WholeFrames& frames, const std::vector<BeadId>& bonds,
                                                  std::vector<Event> found) {
  std::vector<JudgedCrossing> right;
  for (const BeadId a : bonds)
    for (const BeadId b : bonds)
      if (a + 1 < b) judge_bonds(frames, a, b, right);
  std::stable_sort(right.begin(), right.end(), [](const auto& a, const auto& b) {
    return std::tie(a.step, a.beads) < std::tie(b.step, b.beads);
  });
  const auto key_of = [](const Event& e) {
    const auto& ids = e.change.ids;
    return std::tuple(e.step, std::array{ids[0], ids[1], ids[2], ids[3]});
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const Event& a, const Event& b) { return key_of(a) < key_of(b); });
  if (found.size() != right.size()) return text_of(found.size(), " events, expected ", right.size());
  for (std::size_t k = 0; k < right.size(); ++k) {
    const std::string name =
        text_of("event ", k, " of bonds ", right[k].beads[0], " and ", right[k].beads[2]);
    if (key_of(found[k]) != std::tuple(right[k].step, right[k].beads)) return name + ": other step or beads";
    if (found[k].change.kind != right[k].kind)
      return name + text_of(": kind ", int{found[k].change.kind}, ", expected ", int{right[k].kind});
    if (!is_within(right[k].time, found[k])) return name + ": wrong time";
  }
  return std::nullopt;
}

}  // namespace kds::test
