// Contacts by nearest image, judged by all images of each pair over rationals.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/frames/periodic.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/scene.h"
#include "structures/contacts/contacts.h"
#include "structures/images/image_pairs.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_cells.h"
#include "tests/support/judges/image_events.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::periodic_contacts_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using ContactRig = Rig<Contacts<M::dimension>, M>;

PairsAsked all_pairs(std::size_t beads) { return {{{0, static_cast<BeadId>(beads - 1)}}, true, 1, true}; }

template <Motion M>
void expect_right(const std::vector<M>& steps, int most_shift = 6) {
  const PairsAsked asked = all_pairs(steps.front().bead_count());
  ContactRig<M> filtered(steps.front(), AuditMode::events, Kernel::filtered, asked);
  filtered.motion = steps.front();
  filtered.simulator.build();
  const std::vector<BeadPair> at_start = filtered.structure.pairs();
  for (const M& step : steps) ASSERT_NO_THROW(filtered.step(step));
  filtered.simulator.finish();
  const auto judge = [&](const std::vector<M>& all, const BeadPair& pair) {
    return history_of_images(all, pair, most_shift);
  };
  EXPECT_EQ(
      contact_history_fault(steps, asked, filtered.history, at_start, filtered.structure.pairs(), judge),
      std::nullopt);
  EXPECT_TRUE(books_balance(filtered.structure.statistics));

  ContactRig<M> exact(steps.front(), AuditMode::none, Kernel::exact, asked);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(exact.structure.pairs(), filtered.structure.pairs());
}

/// Runs two balls of radius 1 in a cell: the first rests, the second is at the given places in the frames.
std::vector<std::string> told_of(const Points& places, const Cell& cell) {
  std::vector<Points> frames;
  for (const auto& place : places) frames.push_back({{0, 0, 0}, place});
  std::vector<Space> steps = through(frames);
  for (Space& step : steps) {
    for (BeadId b = 0; b < 2; ++b)
      for (int k = 0; k <= 1; ++k) step.set_radius(b, k, 1);
    step.own_cell().set(cell, cell, 1);
  }
  expect_right(steps);
  ContactRig<Space> rig(steps.front(), AuditMode::events, all_pairs(2));
  rig.run(steps);
  std::vector<std::string> lines;
  for (const Event& e : rig.history.events)
    lines.push_back(text_of(rig.structure.kinds()[e.change.kind].name, " at ",
                            static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  return lines;
}

TEST(PeriodicContacts, AcrossAWall) {
  EXPECT_THAT(told_of({{4, 0, 0}, {12, 0, 0}}, box(16, 16, 16)), IsEmpty());
  EXPECT_THAT(told_of({{12, 0, 0}, {20, 0, 0}}, box(16, 16, 16)),
              ElementsAre("begin at 0.25", "end at 0.75"));
  EXPECT_THAT(told_of({{12, 0, 0}, {16, 0, 0}, {20, 0, 0}}, box(16, 16, 16)),
              ElementsAre("begin at 0.5", "end at 1.5"));
  EXPECT_THAT(told_of({{-20, 2, 16}, {-12, 2, 16}}, box(16, 16, 16)), ElementsAre("touch at 0.5"));
  EXPECT_THAT(told_of({{4, 0, 0}, {68, 0, 0}}, box(16, 16, 16)),
              ElementsAre("begin at 0.15625", "end at 0.21875", "begin at 0.40625", "end at 0.46875",
                          "begin at 0.65625", "end at 0.71875", "begin at 0.90625", "end at 0.96875"));
}

TEST(PeriodicContacts, OneVectorOnly) {
  EXPECT_THAT(told_of({{12, 0, 0}, {20, 0, 0}}, box(16, 0, 0)), ElementsAre("begin at 0.25", "end at 0.75"));
  EXPECT_THAT(told_of({{12, 0, 0}, {20, 0, 0}}, box(0, 16, 0)), IsEmpty());
}

// Between two images that are as far apart as twice the reach, one ends as the other begins.
TEST(PeriodicContacts, HalfACellIsTheReach) {
  EXPECT_THAT(told_of({{0, 0, 0}, {8, 0, 0}}, box(4, 16, 16)), IsEmpty());
  EXPECT_THAT(told_of({{2, 0, 0}, {2, 0, 0}}, box(4, 16, 16)), IsEmpty());
  EXPECT_THAT(told_of({{2, 0, 0}, {2, 1, 0}}, box(4, 16, 16)), ElementsAre("touch at 0"));
  EXPECT_THAT(told_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}}, box(4, 16, 16)), ElementsAre("end at 1"));
  EXPECT_THAT(told_of({{2, -1, 0}, {2, 1, 0}}, box(4, 16, 16)), ElementsAre("touch at 0.5"));
  EXPECT_THAT(told_of({{2, -1, 0}, {2, 0, 0}, {2, 1, 0}}, box(4, 16, 16)), ElementsAre("touch at 1"));
  EXPECT_THAT(told_of({{2, 1, 0}, {2, 0, 0}, {3, 0, 0}}, box(4, 16, 16)), ElementsAre("begin at 1"));
}

// Several images are in contact at once.
TEST(PeriodicContacts, SmallCell) {
  EXPECT_THAT(told_of({{0, 4, 0}, {0, 0, 0}, {0, 4, 0}}, box(1.5, 16, 16)),
              ElementsAre("begin at 0.5", "end at 1.5"));
  EXPECT_THAT(told_of({{0, 0, 0}, {4, 4, 4}}, box(1.5, 1.5, 1.5)), IsEmpty());
}

template <class M>
void expect_random_scenes_right(int count) {
  Random random(52);
  for (int round = 0; round < rounds(count, 1); ++round) {
    for (const CellKind kind : cell_kinds(M::dimension)) {
      for (const bool on_grid : {false, true}) {
        SCOPED_TRACE(text_of("round ", round, ", cell ", static_cast<int>(kind), on_grid ? ", grid" : ""));
        expect_right(random_steps_in_cell<M>(random, kind, 4, on_grid), kind == CellKind::small ? 12 : 6);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(PeriodicContacts, RandomInSpace) { expect_random_scenes_right<BezierMotion<3, 1>>(3); }
TEST(PeriodicContacts, RandomInThePlane) { expect_random_scenes_right<BezierMotion<2, 1>>(12); }
TEST(PeriodicContacts, RandomOfHigherDegree) {
  expect_random_scenes_right<BezierMotion<2, 2>>(1);
  expect_random_scenes_right<BezierMotion<2, 3>>(1);
}

/// Frames of beads that take small steps in dyadic numbers, in a cell, and the events of their contacts.
struct Wanderers {
  Cell cell = box(8, 12, 16);
  std::vector<Eigen::Matrix3Xd> frames;

  Wanderers() {
    Random random(7);
    cell(0, 1) = 3;
    Eigen::Matrix3Xd at(3, 30);
    for (double& x : at.reshaped()) x = 0.125 * pick(random, 0, 96);
    for (int frame = 0; frame < 12; ++frame) {
      frames.push_back(at);
      for (double& x : at.reshaped()) x += 0.125 * pick(random, -12, 12);
    }
  }
  /// Returns the frames, moved by a vector and wrapped into the cell again.
  [[nodiscard]] std::vector<Eigen::Matrix3Xd> wrapped(const Eigen::Vector3d& by) const {
    std::vector<Eigen::Matrix3Xd> moved = frames;
    for (Eigen::Matrix3Xd& frame : moved) {
      frame.colwise() += by;
      for (Eigen::Index b = 0; b < frame.cols(); ++b) {
        const Eigen::Vector3d share = cell.triangularView<Eigen::Upper>().solve(frame.col(b));
        frame.col(b) -= cell * share.array().floor().matrix();
      }
    }
    return moved;
  }
};

/// Returns the events of a run through frames whose beads are unwrapped, as sorted lines, with the pairs in
/// contact at the start.
std::vector<std::string> events_through(std::vector<Eigen::Matrix3Xd> frames, const Cell& cell) {
  UnwrappedBeads beads;
  for (Eigen::Matrix3Xd& frame : frames) beads.follow(frame, cell);
  const auto count = static_cast<std::size_t>(frames.front().cols());
  std::vector<Space> steps;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
    Space& step = steps.emplace_back(count);
    step.set_ends(frames[k].data(), frames[k + 1].data(), std::vector<double>(count, 1).data());
    step.own_cell().set(cell, cell, 1);
  }
  ContactRig<Space> rig(steps.front(), AuditMode::frames, all_pairs(count));
  rig.motion = steps.front();
  rig.simulator.build();
  std::vector<std::string> lines;
  for (const BeadPair& pair : rig.structure.pairs())
    lines.push_back(text_of("at first ", pair.first, " ", pair.second));
  for (const Space& step : steps) rig.step(step);
  rig.simulator.finish();
  for (const Event& e : rig.history.events)
    lines.push_back(text_of(rig.structure.kinds()[e.change.kind].name, " ", e.change.ids[0], " ",
                            e.change.ids[1], " at ", e.step, " ", e.lower, " ", e.upper));
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST(PeriodicContacts, DoNotDependOnWhereTheWallsAre) {
  const Wanderers wanderers;
  const auto lines = events_through(wanderers.wrapped({0, 0, 0}), wanderers.cell);
  EXPECT_GT(lines.size(), 100U);
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(-40.5, 7.25, 111.125)})
    EXPECT_EQ(events_through(wanderers.wrapped(by), wanderers.cell), lines);
}

TEST(PeriodicContacts, OfASupercellAreEightTimesAsMany) {
  const Wanderers wanderers;
  const std::vector<Eigen::Matrix3Xd> frames = wanderers.wrapped({0, 0, 0});
  std::vector<Eigen::Matrix3Xd> copies;
  UnwrappedBeads beads;
  for (Eigen::Matrix3Xd frame : frames) {
    beads.follow(frame, wanderers.cell);
    Eigen::Matrix3Xd& all = copies.emplace_back(3, 8 * frame.cols());
    for (int copy = 0; copy < 8; ++copy) {
      const Eigen::Vector3d shift = wanderers.cell * Eigen::Vector3d(copy % 2, copy / 2 % 2, copy / 4);
      all.middleCols(copy * frame.cols(), frame.cols()) = frame.colwise() + shift;
    }
  }
  EXPECT_EQ(events_through(copies, 2 * wanderers.cell).size(),
            8 * events_through(frames, wanderers.cell).size());
}

// The vector that a bead passes is longer at the end of the step than in the middle.
TEST(PeriodicContacts, AcrossTheWallOfACellThatGrows) {
  Space step = moving({{6, 0, 0}, {1.875, 0, 0}}, {{13.875, 0, 0}, {1.875, 0, 0}});
  for (BeadId b = 0; b < 2; ++b)
    for (int k = 0; k <= 1; ++k) step.set_radius(b, k, 0.125);
  step.own_cell().set(box(8, 0, 0), box(12, 0, 0), 1);
  expect_right(std::vector<Space>{step});
  ContactRig<Space> rig(step, AuditMode::events, all_pairs(2));
  rig.run();
  EXPECT_EQ(rig.history.events.size(), 1U);
}

// One image of an inserted bead is in contact throughout, and another one begins later.
TEST(PeriodicContacts, OfAnInsertedBeadCountOnce) {
  std::vector<Space> steps =
      through({{{0, 0, 0}, {0.5, 0, 0}}, {{0, 0, 0}, {0.5, 0, 0}}, {{0, 0, 0}, {1.5, 0, 0}}});
  for (Space& step : steps) {
    for (BeadId b = 0; b < 2; ++b)
      for (int k = 0; k <= 1; ++k) step.set_radius(b, k, 1);
    step.own_cell().set(box(3, 0, 0), box(3, 0, 0), 1);
  }
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    ContactRig<Space> rig(steps.front(), AuditMode::events, kernel, all_pairs(2));
    rig.simulator.build();
    rig.simulator.enter_step();
    rig.simulator.run_until(Dyadic(0.5));
    rig.structure.erase(1);
    rig.simulator.leave_step();
    rig.motion = steps.back();
    rig.simulator.enter_step();
    rig.simulator.run_until(Dyadic(0.25));
    rig.structure.insert(1);
    rig.simulator.leave_step();
    rig.simulator.finish();
    std::vector<std::string> kinds;
    for (const Event& e : rig.history.events) kinds.emplace_back(rig.structure.kinds()[e.change.kind].name);
    EXPECT_THAT(kinds, ElementsAre("end", "erase", "insert", "begin"));
  }
}

/// Runs many beads, some of which are fast, with both kernels.
void expect_kernels_agree(const Cell& start, const Cell& end, int beads, double usual, double fast) {
  Random random(3);
  Space step(static_cast<std::size_t>(beads));
  for (BeadId b = 0; b < step.bead_count(); ++b) {
    const Eigen::Vector3d share(uniform(random), uniform(random), uniform(random));
    for (int axis = 0; axis < 3; ++axis) {
      step.set_coordinate(b, 0, axis, (2 * start * share)[axis]);
      step.set_coordinate(b, 1, axis,
                          (2 * end * share)[axis] + (b % 50 == 0 ? fast : usual) * uniform(random));
    }
    for (int k = 0; k <= 1; ++k) step.set_radius(b, k, 0.75);
  }
  step.own_cell().set(start, end, 1);
  std::vector<std::uint64_t> fingerprints;
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    ContactRig<Space> rig(step, AuditMode::frames, kernel, all_pairs(step.bead_count()));
    rig.run();
    EXPECT_GT(rig.history.events.size(), 10U);
    fingerprints.push_back(rig.simulator.fingerprint());
  }
  EXPECT_EQ(fingerprints[0], fingerprints[1]);
}

TEST(PeriodicContacts, ManyBeadsInAGridOfManyBins) {
  const int beads = 60;
  const Cell upright = box(12, 16, 20);
  Cell skewed = upright;
  skewed(0, 1) = 5;
  skewed(0, 2) = -4;
  skewed(1, 2) = 7;
  expect_kernels_agree(upright, upright, beads, 4, 30);
  expect_kernels_agree(skewed, skewed, beads, 3, 12);
  expect_kernels_agree(upright, 1.25 * upright, beads, 4, 4);
  expect_kernels_agree(upright, skewed, beads, 4, 20);
  expect_kernels_agree(upright, 1.75 * upright, beads, 4, 4);  // too much for a grid
}

// The peptide and its water cross walls all the time.
TEST(PeriodicContacts, OfASolvatedPeptideAreThoseOfFrames) {
  ReadOptions reading;
  reading.frames = {0, 12};
  const Trajectory read =
      read_trajectory(std::string(KDS_DATA_DIR) + "/trajectories/enkephalin_water.xtc", reading);
  const std::size_t beads = read.bead_count();
  const std::vector<double> radii(beads, 1.75013);  // no distance is the cutoff
  const Scene scene(std::span(&read, 1), radii);
  ASSERT_TRUE(scene.is_periodic());
  std::vector<Space> steps(scene.step_count(), Space(beads));
  for (std::size_t k = 0; k < steps.size(); ++k) scene.load(k, steps[k]);
  const PairsAsked asked = all_pairs(beads);
  ContactRig<Space> rig(steps.front(), AuditMode::frames, asked);
  rig.motion = steps.front();
  rig.simulator.build();
  for (std::size_t k = 0; k <= steps.size(); ++k) {
    const Balls<3> balls(scene.centers(k), radii);
    EXPECT_EQ(rig.structure.pairs(), image_pairs_by_force(balls, read.cells[k], asked, 0.0)) << "frame " << k;
    EXPECT_GT(rig.structure.pairs().size(), 1000U);
    if (k < steps.size()) rig.step(steps[k]);
  }
}

// Contacts between two groups are those of all pairs that join them, also with radii of their own.
TEST(PeriodicContacts, OfTwoGroups) {
  Random random(6);
  const std::vector<Space> steps = random_steps_in_cell<Space>(random, CellKind::skewed, 24, false);
  const std::vector<double> radii(24, 1.5);
  const auto events_of = [&](const PairsAsked& asked, const PairsAsked& counted) {
    ContactRig<Space> rig(steps.front(), AuditMode::events, Kernel::filtered, asked, radii);
    rig.run(steps);
    std::vector<std::string> lines;
    for (const Event& e : rig.history.events)
      if (counted.asks({e.change.ids[0], e.change.ids[1]}))
        lines.push_back(
            text_of(int{e.change.kind}, " ", e.change.ids[0], " ", e.change.ids[1], " ", e.lower));
    return lines;
  };
  PairsAsked groups = all_pairs(24);
  for (unsigned b = 0; b < 24; ++b) groups.groups.push_back(static_cast<std::uint8_t>(b % 4));
  const auto lines = events_of(groups, groups);
  EXPECT_GT(lines.size(), 5U);
  EXPECT_EQ(lines, events_of(all_pairs(24), groups));
}

TEST(PeriodicContacts, CellsThatChangeTooMuchAreRefused) {
  const auto run = [](const Cell& start, const Cell& end, double far) {
    Space step = moving({{0, 0, 0}, {3, 0, 0}}, {{0, 0, 0}, {3 + far, 0, 0}});
    for (BeadId b = 0; b < 2; ++b)
      for (int k = 0; k <= 1; ++k) step.set_radius(b, k, 1);
    step.own_cell().set(start, end, 1);
    ContactRig<Space> rig(step, AuditMode::none, all_pairs(2));
    rig.run();
  };
  EXPECT_NO_THROW(run(box(8, 8, 8), box(12, 12, 12), 1));
  EXPECT_THROW(run(box(8, 8, 8), box(800, 8, 8), 1), InputError);
  EXPECT_THROW(run(box(8, 8, 8), box(-8, 8, 8), 1), InputError);
  EXPECT_THROW(run(box(8, 8, 8), box(8, 8, 8), 1e9), InputError);
  EXPECT_THROW(run(box(0.01, 0.01, 0.01), box(0.01, 0.01, 0.01), 0), InputError);
}

// A shift is the exact sum of the cell's vectors.
TEST(ShiftedBeads, AreExact) {
  Random random(4);
  for (int round = 0; round < 100; ++round) {
    Space step(1);
    Cell cell = Cell::Zero();
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j <= i; ++j)
        cell(j, i) = uniform(random) * std::ldexp(100.0, -pick(random, 0, 20) * int{i != j});
    step.own_cell().set(cell, cell, 1);
    ShiftNumbers<3> shifts;
    const CellShift<3> shift{pick(random, -1000, 1000), pick(random, -3, 3), pick(random, -1000000, 1000000)};
    const std::uint32_t number = shifts.number_of(shift);
    ShiftedBeads<3> beads(1);
    beads.set(Curves<3>(step), shifts);
    for (int axis = 0; axis < 3; ++axis) {
      Rational sum = 0;
      for (int v = 0; v < 3; ++v) sum += shift[static_cast<std::size_t>(v)] * Rational(cell(axis, v));
      EXPECT_EQ(Rational(beads.coordinate(beads.to(number), 1, axis)) -
                    Rational(beads.coordinate(beads.from(number), 1, axis)),
                sum);
    }
  }
}

}  // namespace
}  // namespace kds::periodic_contacts_test
