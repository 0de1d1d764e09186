// Beads are inserted, erased and change course in the enclosing box, the closest pair, the convex hull and
// the hierarchy of boxes on one clock: at rational times, at the irrational times of events, and at times
// with many simultaneous events. There are two slow references: the same structures, built on the present
// beads and their current curves and run from the start to that time; and brute force on the exact positions
// a moment later.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "structures/box/enclosing_box.h"
#include "structures/closest/kinetic_closest_pair.h"
#include "structures/hierarchy/box_hierarchy.h"
#include "structures/hull/convex_hull.h"
#include "tests/support/inputs/courses.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/moving_points.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::box_closest_hull_random_edits_test {
namespace {

using namespace test;

using Beads = std::vector<BeadId>;

// Finds the ends of the box from exact positions; among beads that tie, the least bead counts.

Beads ends_of(const ExactPoints& at, const Beads& present, std::size_t dimension) {
  Beads ends;
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    for (const bool high : {false, true}) {
      BeadId end = no_bead;
      for (const BeadId b : present)
        if (end == no_bead || (high ? at[b][axis] > at[end][axis] : at[b][axis] < at[end][axis])) end = b;
      ends.push_back(end);
    }
  }
  return ends;
}

Beads closest_of(const ExactPoints& at, const Beads& present) {
  Beads closest;
  second::Integer least;
  for (const BeadId a : present) {
    for (const BeadId b : present) {
      if (a >= b) continue;
      second::Integer square = 0;
      for (std::size_t axis = 0; axis < at[a].size(); ++axis)
        square += (at[a][axis] - at[b][axis]) * (at[a][axis] - at[b][axis]);
      if (!closest.empty() && least <= square) continue;
      closest = {a, b};
      least = square;
    }
  }
  return closest;
}

/// Finds the corners by gift wrapping, counterclockwise from the least corner.
Beads corners_of(const ExactPoints& at, const Beads& present) {
  if (present.empty()) return {};
  const auto first =
      *std::min_element(present.begin(), present.end(), [&](BeadId a, BeadId b) { return at[a] < at[b]; });
  Beads corners;
  BeadId last = first;
  do {
    corners.push_back(last);
    BeadId next = last;
    for (const BeadId b : present) {
      if (at[b] == at[last]) continue;
      const second::Integer turn = next == last ? second::Integer(-1)
                                                : (at[next][0] - at[last][0]) * (at[b][1] - at[last][1]) -
                                                      (at[next][1] - at[last][1]) * (at[b][0] - at[last][0]);
      const bool is_between = turn == 0 && (at[next] < at[last] ? at[b] < at[next] : at[next] < at[b]);
      if (turn < 0 || is_between) next = b;  // the farthest of collinear beads
    }
    last = next;
  } while (at[last] != at[first]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// The radius of a bead in quarters, which only the boxes use.
int quarters_of_radius(BeadId bead) { return static_cast<int>(bead % 3); }
double radius_of(BeadId bead) { return 0.25 * quarters_of_radius(bead); }

/// Finds the supports of all nodes and sides from exact positions, as the balls' reach along each direction
/// says; among balls that tie, the least bead counts. `quarter` is the length of 1/4 in units of `at`.
template <int D>
Beads supports_of(const BoxHierarchy<D>& boxes, const ExactPoints& at, const second::Integer& quarter,
                  const Beads& present) {
  Beads supports;
  for (const BeadRange& range : boxes.tree().ranges())
    for (std::uint32_t side = 0; side < boxes.side_count(); ++side) {
      const SlabDirection& direction = boxes.directions()[side / 2];
      BeadId support = no_bead;
      for (const BeadId b : present) {
        if (b < range.first || range.last < b) continue;
        if (support == no_bead) {
          support = b;
          continue;
        }
        second::Integer along = 0;
        for (std::size_t axis = 0; axis < D; ++axis)
          along += (side % 2 == 0 ? -1 : 1) * direction.steps[axis] * (at[b][axis] - at[support][axis]);
        const second::Integer larger = quarter * (quarters_of_radius(b) - quarters_of_radius(support));
        const second::Integer of_radii = direction.square() * larger * larger;
        const bool is_further =
            larger >= 0 ? along > 0 || along * along < of_radii : along > 0 && along * along > of_radii;
        if (is_further) support = b;
      }
      supports.push_back(support);
    }
  return supports;
}

/// A structure, its answer, and the expected answer.
struct Subject {
  KineticStructure* structure;
  BeadEdits* edits;
  std::function<Beads()> answer;
  /// Takes positions, the length of 1/4 in their unit, and the beads that are present.
  std::function<Beads(const ExactPoints&, const second::Integer&, const Beads&)> right;

  [[nodiscard]] Beads present(std::size_t beads) const {
    Beads all;
    for (BeadId b = 0; b < beads; ++b)
      if (!edits->is_absent(b)) all.push_back(b);
    return all;
  }
};

struct None {
  template <class M, class... Extra>
  None(Simulator&, const M&, const Extra&...) {}
};

/// All structures that exist in the dimension.
template <int D>
struct Structures {
  template <class M>
  Structures(Simulator& simulator, const M& motion)
      : box(simulator, motion),
        closest(simulator, motion),
        hull(simulator, motion),
        boxes(simulator, motion,
              std::array<BeadRange, 2>{{{0, 2}, {3, static_cast<BeadId>(motion.bead_count() - 1)}}},
              Radii::any, D == 3 ? 3 : 4) {
    using Unit = second::Integer;
    all.push_back(
        {&box, &box, [this] { return box.ends(); },
         [](const ExactPoints& at, const Unit&, const Beads& present) { return ends_of(at, present, D); }});
    if constexpr (D > 1) {
      const auto pair = [this] {
        return closest.pair() ? Beads(closest.pair()->begin(), closest.pair()->end()) : Beads();
      };
      all.push_back({&closest, &closest, pair, [](const ExactPoints& at, const Unit&, const Beads& present) {
                       return closest_of(at, present);
                     }});
    }
    if constexpr (D > 1) {
      const auto supports = [this] {
        Beads of_nodes;
        for (NodeId node = 0; node < boxes.tree().node_count(); ++node)
          of_nodes.insert(of_nodes.end(), boxes.supports(node).begin(), boxes.supports(node).end());
        return of_nodes;
      };
      all.push_back({&boxes, &boxes, supports,
                     [this](const ExactPoints& at, const Unit& quarter, const Beads& present) {
                       return supports_of<D>(boxes, at, quarter, present);
                     }});
    }
    if constexpr (D == 2)
      all.push_back(
          {&hull, &hull, [this] { return hull.corners(); },
           [](const ExactPoints& at, const Unit&, const Beads& present) { return corners_of(at, present); }});
  }

  EnclosingBox<D> box;
  std::conditional_t<(D > 1), KineticClosestPair<std::max(D, 2)>, None> closest;
  std::conditional_t<D == 2, ConvexHull, None> hull;
  std::conditional_t<(D > 1), BoxHierarchy<std::max(D, 2)>, None> boxes;
  std::vector<Subject> all;
};

/// On a grid half of the beads rest, which makes ties for the rest of the step.
template <class M>
void set_curve(M& motion, BeadId b, Random& random, Places places) {
  const bool rests = places == Places::grid && random() % 2 == 0;
  for (int k = 0; k <= M::degree; ++k)
    for (int axis = 0; axis < M::dimension; ++axis)
      motion.set_coordinate(b, k, axis,
                            rests && k > 0 ? motion.coordinate(b, 0, axis) : draw_place(random, places));
}

struct Totals {
  std::uint64_t edits = 0, at_no_dyadic_times = 0, empty = 0, turned = 0, events = 0;
};

template <class M>
class EditedRun {
 public:
  static constexpr int dimension = M::dimension;

  EditedRun(unsigned seed, Places places, Totals& totals, Kernel kernel = Kernel::filtered)
      : random_(2 * seed + static_cast<unsigned>(places)),
        places_(places),
        totals_(totals),
        motion_(7 + seed % 6),
        simulator_(AuditMode::events, kernel),
        structures_(simulator_, motion_) {
    simulator_.listen(history_);
    for (BeadId b = 0; b < motion_.bead_count(); ++b) {
      for (int k = 0; k <= M::degree; ++k) motion_.set_radius(b, k, radius_of(b));
      set_curve(motion_, b, random_, places_);
    }
    first_ = motion_;
    leave_out_ = seed % 3 == 0 ? motion_.bead_count() : 2;
    leave_some_out(structures_);
  }

  void run() {
    simulator_.build();
    for (int step = 0; step < 2; ++step) {
      if (step > 0) carry_on(motion_, [&](BeadId b) { set_curve(motion_, b, random_, places_); });
      simulator_.enter_step();
      compare();
      edit();
      for (int stand = 1; stand < 10; ++stand) {
        double u = 0.1 * stand;
        if (stand % 3 == 0) u = 0x1p-3 * std::floor(8 * u);  // a time of many simultaneous events on a grid
        if (simulator_.now().lower() <= u) {
          simulator_.run_until(Dyadic(u));
          compare();
          edit();
        }
        if (!simulator_.run_next()) continue;
        totals_.at_no_dyadic_times += simulator_.now().exact().is_dyadic() ? 0 : 1;
        compare();
        edit();
      }
      simulator_.leave_step();
      for (const Subject& s : structures_.all) EXPECT_TRUE(books_balance(s.structure->statistics));
    }
    simulator_.finish();
    totals_.events += history_.events.size();
  }

  void expect_replay_goes_the_same_way() {
    Simulator simulator;
    Structures<dimension> again(simulator, first_);
    leave_some_out(again);
    KnownEvents(simulator).build_for_replay();
    for (std::size_t step = 0; step < 2; ++step) {
      std::vector<ReplayedEvent> events;
      for (const Event& e : history_.of_step(step))
        events.push_back({e.structure_index, e.lower, e.upper, e.change, "the log"});
      KnownEvents(simulator).replay_step(events);
    }
    EXPECT_EQ(simulator.fingerprint(), simulator_.fingerprint());
    for (std::size_t s = 0; s < again.all.size(); ++s) {
      EXPECT_EQ(again.all[s].answer(), structures_.all[s].answer());
      EXPECT_EQ(again.all[s].present(motion_.bead_count()), structures_.all[s].present(motion_.bead_count()));
    }
  }

  [[nodiscard]] std::uint64_t fingerprint() const { return simulator_.fingerprint(); }

 private:
  void leave_some_out(Structures<dimension>& structures) {
    for (const Subject& s : structures.all)
      for (BeadId b = 0; b < leave_out_; ++b) s.edits->leave_out(b);
  }

  void edit() {
    const auto count = static_cast<BeadId>(motion_.bead_count());
    const bool all_go = random_() % 12 == 0, some_come = random_() % 6 == 0;
    for (const Subject& s : structures_.all) {
      for (BeadId i = 0; all_go && i < count; ++i)
        if (const BeadId b = (5 * i + 2) % count; !s.edits->is_absent(b)) s.edits->erase(b);
      if (all_go) compare();
      for (BeadId i = 0; some_come && i < count; ++i)
        if (const BeadId b = (3 * i + 1) % count; s.edits->is_absent(b)) s.edits->insert(b);
      const auto b = static_cast<BeadId>(random_() % count);
      s.edits->is_absent(b) ? s.edits->insert(b) : s.edits->erase(b);
      ++totals_.edits;
    }
    compare();
    change_courses();
    compare();
  }

  void change_courses() {
    const ExactTime& now = simulator_.now().exact();
    const auto count = static_cast<BeadId>(motion_.bead_count());
    const auto b = static_cast<BeadId>(random_() % count);
    Beads beads{b};
    const auto set_all = [&] {
      for (const BeadId other : beads) set_curve(motion_, other, random_, places_);
    };
    switch (random_() % 6) {
      case 0:
        return simulator_.change_motion(beads, set_all);
      case 1:  // a bend, if coordinates have few enough bits to bend without rounding
        if (M::degree > 1 || !now.is_dyadic()) return;
        ++totals_.turned;
        return simulator_.change_motion(beads, [&] { bend(motion_, b, now.lower().round_down(), random_); });
      case 2:
        beads = {b, (b + 1) % count, (b + 2) % count};
        return simulator_.change_motion(beads, set_all);
      case 3:
        for (BeadId other = 0; other < count; ++other) beads.push_back(other);
        if (random_() % 2 == 0) return simulator_.change_motion(beads, [] {});  // without an effect
        return simulator_.change_motion(beads, set_all);
      default:
        return;
    }
  }

  void compare() {
    const Dyadic soon = next_on_grid(simulator_.now().exact(), 200);  // before the next event
    const ExactPoints at = points_at(motion_, second::of(soon));
    const second::Integer quarter = quarter_at(motion_, second::of(soon));
    Simulator simulator;
    Structures<dimension> twins(simulator, motion_);
    for (std::size_t s = 0; s < twins.all.size(); ++s)
      for (BeadId b = 0; b < motion_.bead_count(); ++b)
        if (structures_.all[s].edits->is_absent(b)) twins.all[s].edits->leave_out(b);
    simulator.build();
    simulator.enter_step();
    simulator.run_until(soon);
    for (std::size_t s = 0; s < twins.all.size(); ++s) {
      const Subject& subject = structures_.all[s];
      const Beads present = subject.present(motion_.bead_count());
      totals_.empty += present.empty() ? 1 : 0;
      EXPECT_EQ(subject.answer(), twins.all[s].answer()) << subject.structure->name();
      EXPECT_EQ(subject.answer(), subject.right(at, quarter, present)) << subject.structure->name();
    }
  }

  Random random_;
  Places places_;
  Totals& totals_;
  std::size_t leave_out_ = 0;
  M motion_, first_{0};
  Simulator simulator_;
  History history_;
  Structures<dimension> structures_;
};

template <class M>
void run_all(unsigned seeds) {
  for (const Places places : {Places::generic, Places::grid}) {
    Totals totals;
    for (unsigned seed = 0; seed < seeds && !testing::Test::HasFailure(); ++seed) {
      SCOPED_TRACE(text_of("seed ", seed, ", places ", static_cast<int>(places)));
      EditedRun<M> run(seed, places, totals);
      run.run();
      run.expect_replay_goes_the_same_way();
    }
    EXPECT_GT(totals.edits, 10 * seeds);
    EXPECT_GT(totals.events, 40 * seeds);
    EXPECT_GT(totals.empty, seeds);
    EXPECT_EQ(totals.turned > 0, M::degree == 1);
    EXPECT_GT(totals.at_no_dyadic_times, seeds);
  }
}

TEST(BoxClosestHullRandomEdits, OnALine) { run_all<BezierMotion<1, 1>>(rounds(40U)); }
TEST(BoxClosestHullRandomEdits, InThePlane) { run_all<BezierMotion<2, 1>>(rounds(20U)); }
TEST(BoxClosestHullRandomEdits, InSpace) { run_all<Space>(rounds(20U)); }
TEST(BoxClosestHullRandomEdits, OnQuadraticCurvesInThePlane) { run_all<BezierMotion<2, 2>>(rounds(8U)); }
TEST(BoxClosestHullRandomEdits, OnCubicCurvesInSpace) { run_all<BezierMotion<3, 3>>(rounds(4U)); }

TEST(BoxClosestHullRandomEdits, KernelsAgree) {
  Totals totals;
  for (const Places places : {Places::generic, Places::grid}) {
    for (unsigned seed = 50; seed < 50 + rounds(6U); ++seed) {
      using Run = EditedRun<BezierMotion<2, 1>>;
      Run filtered(seed, places, totals), exact(seed, places, totals, Kernel::exact);
      filtered.run();
      exact.run();
      EXPECT_EQ(filtered.fingerprint(), exact.fingerprint());
    }
  }
}

}  // namespace
}  // namespace kds::box_closest_hull_random_edits_test
