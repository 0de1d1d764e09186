#include "structures/contacts/contacts.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "motions/curves/positions.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/contact_events.h"
#include "tests/support/judges/static_contacts.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::contacts_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using ContactRig = Rig<Contacts<M::dimension>, M>;

PairsAsked all_pairs(std::size_t beads, BeadId apart = 1) {
  return {{{0, static_cast<BeadId>(beads - 1)}}, true, apart, true};
}

/// Returns the events as lines such as "begin 0 1 at 0.25", in order of time.
template <Motion M>
std::vector<std::string> told(const ContactRig<M>& rig) {
  std::vector<std::string> lines;
  for (const Event& e : rig.history.events)
    lines.push_back(text_of(rig.structure.kinds()[e.change.kind].name, " ", e.change.ids[0], " ",
                            e.change.ids[1], " at ",
                            static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  return lines;
}

Space with_radii(Space motion, const std::vector<double>& radii) {
  for (BeadId b = 0; b < motion.bead_count(); ++b)
    for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, radii[b % radii.size()]);
  return motion;
}

std::vector<Space> with_radii(std::vector<Space> steps, const std::vector<double>& radii) {
  for (Space& step : steps) step = with_radii(std::move(step), radii);
  return steps;
}

template <Motion M>
void expect_right(const std::vector<M>& steps, const PairsAsked& asked, bool replayed = true) {
  ContactRig<M> filtered(steps.front(), AuditMode::events, Kernel::filtered, asked);
  std::vector<BeadPair> at_start;
  filtered.motion = steps.front();
  filtered.simulator.build();
  at_start = filtered.structure.pairs();
  for (const M& step : steps) ASSERT_NO_THROW(filtered.step(step));
  filtered.simulator.finish();
  EXPECT_EQ(contact_history_fault(steps, asked, filtered.history, at_start, filtered.structure.pairs()),
            std::nullopt);
  EXPECT_TRUE(books_balance(filtered.structure.statistics));

  ContactRig<M> exact(steps.front(), AuditMode::none, Kernel::exact, asked);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(exact.structure.pairs(), filtered.structure.pairs());
  if (!replayed) return;
  ContactRig<M> again(steps.front(), AuditMode::frames, Kernel::filtered, asked);
  ASSERT_NO_THROW(again.replay(steps, filtered.history));
  EXPECT_EQ(again.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(again.structure.pairs(), filtered.structure.pairs());
}

/// Runs two balls of radius 1: the first rests at the origin, and the second is at the given places in the
/// frames.
std::vector<std::string> told_of(const Points& places, bool in_contact_at_start = false) {
  std::vector<Points> frames;
  for (const auto& place : places) frames.push_back({{0, 0, 0}, place});
  const auto steps = with_radii(through(frames), {1});
  expect_right(steps, all_pairs(2));
  ContactRig<Space> rig(steps.front(), AuditMode::events, all_pairs(2));
  rig.motion = steps.front();
  rig.simulator.build();
  EXPECT_EQ(rig.structure.pairs().size(), in_contact_at_start ? 1U : 0U);
  for (const Space& step : steps) rig.step(step);
  rig.simulator.finish();
  return told(rig);
}

TEST(Contacts, BeginAndEnd) {
  EXPECT_THAT(told_of({{-4, 0, 0}, {4, 0, 0}}), ElementsAre("begin 0 1 at 0.25", "end 0 1 at 0.75"));
  EXPECT_THAT(told_of({{-4, 0, 0}, {0, 0, 0}}), ElementsAre("begin 0 1 at 0.5"));
  EXPECT_THAT(told_of({{0, 0, 0}, {4, 0, 0}}, true), ElementsAre("end 0 1 at 0.5"));
  EXPECT_THAT(told_of({{-4, 0, 0}, {0, 0, 0}, {4, 0, 0}}), ElementsAre("begin 0 1 at 0.5", "end 0 1 at 1.5"));
  EXPECT_THAT(told_of({{-4, 3, 0}, {4, 3, 0}}), IsEmpty());
}

TEST(Contacts, ATouchIsNoBeginning) {
  EXPECT_THAT(told_of({{-4, 2, 0}, {4, 2, 0}}), ElementsAre("touch 0 1 at 0.5"));
  EXPECT_THAT(told_of({{-4, 2, 0}, {0, 2, 0}, {4, 2, 0}}), ElementsAre("touch 0 1 at 1"));
  EXPECT_THAT(told_of({{-4, 2, 0}, {0, 2, 0}, {-4, 2, 0}}), ElementsAre("touch 0 1 at 1"));
  EXPECT_THAT(told_of({{2, 0, 0}, {4, 0, 0}}), ElementsAre("touch 0 1 at 0"));
  // A touch at the very end is not an event, because no motion follows.
  EXPECT_THAT(told_of({{4, 0, 0}, {2, 0, 0}}), IsEmpty());
  EXPECT_THAT(told_of({{4, 0, 0}, {2, 0, 0}, {4, 0, 0}}), ElementsAre("touch 0 1 at 1"));
}

TEST(Contacts, AtFrames) {
  EXPECT_THAT(told_of({{4, 0, 0}, {2, 0, 0}, {0, 0, 0}}), ElementsAre("begin 0 1 at 1"));
  EXPECT_THAT(told_of({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, true), ElementsAre("end 0 1 at 1"));
  EXPECT_THAT(told_of({{2, 0, 0}, {0, 0, 0}}, true), IsEmpty());
  // A contact that shrinks to touching and grows again goes on without an event.
  EXPECT_THAT(told_of({{0, 0, 0}, {2, 0, 0}, {0, 0, 0}}, true), IsEmpty());
}

TEST(Contacts, BallsThatStayInTouchAreInContact) {
  EXPECT_THAT(told_of({{2, 0, 0}, {2, 0, 0}}, true), IsEmpty());
  EXPECT_THAT(told_of({{2, 0, 0}, {2, 0, 0}, {4, 0, 0}}, true), ElementsAre("end 0 1 at 1"));
  EXPECT_THAT(told_of({{2, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 0}}, true), IsEmpty());
  EXPECT_THAT(told_of({{4, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0}, {4, 0, 0}}),
              ElementsAre("begin 0 1 at 1", "end 0 1 at 3"));
  EXPECT_THAT(told_of({{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0, 0, 0}}, true), IsEmpty());
}

TEST(Contacts, TouchingBallsThatMoveAlike) {
  const auto steps =
      with_radii(through({{{0, 0, 0}, {2, 0, 0}}, {{5, 7, -3}, {7, 7, -3}}, {{5, 8, -3}, {8, 8, -3}}}), {1});
  expect_right(steps, all_pairs(2));
}

TEST(Contacts, CoincidentCentres) {
  expect_right(
      with_radii(through({{{0, 0, 0}, {0, 0, 0}}, {{1, 0, 0}, {1, 0, 0}}, {{3, 0, 0}, {1, 0, 0}}}), {0.5}),
      all_pairs(2));
  // Points meet if they coincide.
  expect_right(with_radii(through({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {0, 0, 0}}}), {0}), all_pairs(2));
  expect_right(
      with_radii(through({{{0, 0, 0}, {0, 0, 0}}, {{1, 1, 1}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}}), {0}),
      all_pairs(2));
}

TEST(Contacts, PairsNearAlongTheChainAreLeftOut) {
  Points from, to;
  for (int i = 0; i < 40; ++i) {
    from.push_back({3.0 * i, 0, 0});
    to.push_back({0, 0, 0});
  }
  const std::vector<Space> steps{with_radii(moving(from, to), {1})};
  for (const BeadId apart : {1U, 2U, 5U, 17U, 39U, 40U}) {
    ContactRig<Space> rig(steps.front(), AuditMode::events, all_pairs(40, apart));
    rig.run(steps);
    EXPECT_EQ(rig.history.events.size(), (40 - apart) * (41 - apart) / 2) << apart;
    for (const Event& e : rig.history.events) EXPECT_GE(e.change.ids[1] - e.change.ids[0], apart);
    EXPECT_EQ(contact_history_fault(steps, all_pairs(40, apart), rig.history, {}, rig.structure.pairs()),
              std::nullopt);
  }
}

/// Makes steps whose frames have whole coordinates: touches, ties, and contacts at frames.
std::vector<Space> random_grid_steps(std::mt19937& random, std::size_t beads, int range, std::size_t count) {
  std::vector<Points> frames;
  for (std::size_t k = 0; k <= count; ++k) {
    frames.push_back(random_grid_points(random, beads, range));
    for (std::size_t b = 0; k > 0 && b < beads; ++b)
      if (random() % 4 == 0) frames[k][b] = frames[k - 1][b];  // the bead rests
  }
  std::vector<double> radii;
  for (std::size_t b = 0; b < beads; ++b) radii.push_back(0.5 * static_cast<double>(random() % 4));
  return with_radii(through(frames), radii);
}

TEST(Contacts, RandomFramesFullOfTies) {
  std::mt19937 random(5);
  for (int round = 0; round < rounds(60); ++round) {
    SCOPED_TRACE(round);
    const std::size_t beads = 2 + random() % 9;
    const auto steps = random_grid_steps(random, beads, 3 + static_cast<int>(random() % 6), 4);
    expect_right(steps, all_pairs(beads, 1 + random() % 2));
    if (HasFailure()) return;
  }
}

TEST(Contacts, SeveralNecklaces) {
  std::mt19937 random(6);
  for (int round = 0; round < rounds(4); ++round) {
    SCOPED_TRACE(round);
    const std::size_t beads = 45;
    const auto steps = random_grid_steps(random, beads, 12, 3);
    PairsAsked asked{{{0, 19}, {20, 20}, {21, 44}}, true, 3, true};
    expect_right(steps, asked);
    asked.within = false;
    expect_right(steps, asked);
    asked = {{{0, 19}, {20, 20}, {21, 44}}, true, 2, false};
    expect_right(steps, asked);
    asked = {{{0, 19}, {20, 20}, {21, 44}}, true, 2, true, {}, {true, round % 2 == 0, round > 1}};
    expect_right(steps, asked);
    if (HasFailure()) return;
  }
}

/// Puts each bead in the first group, in the second, in both or in none, at random.
BeadGroups random_groups(std::mt19937& random, std::size_t beads) {
  BeadGroups groups(beads);
  for (std::uint8_t& of_bead : groups) of_bead = static_cast<std::uint8_t>(random() % 4);
  return groups;
}

bool joins(const BeadGroups& groups, const Event& event) {
  const auto is_in = [&](std::size_t end, unsigned group) {
    return (groups[event.change.ids[end]] & group) != 0;
  };
  return (is_in(0, 1) && is_in(1, 2)) || (is_in(0, 2) && is_in(1, 1));
}

/// Expects the events of a run with groups to be the events of the run without them that join both groups.
/// Returns the number of these events.
std::size_t expect_part_of_all(const std::vector<Space>& steps, PairsAsked asked) {
  const BeadGroups groups = asked.groups;
  ContactRig<Space> some(steps.front(), AuditMode::frames, asked);
  some.run(steps);
  asked.groups.clear();
  ContactRig<Space> all(steps.front(), AuditMode::none, asked);
  all.run(steps);
  std::vector<Event> expected = all.history.events;
  std::erase_if(expected, [&](const Event& event) { return !joins(groups, event); });
  const std::vector<Event>& found = some.history.events;
  EXPECT_EQ(found.size(), expected.size());
  for (std::size_t e = 0; e < std::min(found.size(), expected.size()); ++e) {
    EXPECT_EQ(found[e].step, expected[e].step);
    EXPECT_EQ(found[e].change.kind, expected[e].change.kind);
    EXPECT_EQ(found[e].change.ids, expected[e].change.ids);
    // Both brackets enclose one root, and either may have been narrowed.
    EXPECT_LE(std::max(found[e].lower, expected[e].lower), std::min(found[e].upper, expected[e].upper));
  }
  return found.size();
}

TEST(Contacts, OfTwoGroups) {
  std::mt19937 random(23);
  std::size_t events = 0;
  for (int round = 0; round < rounds(24, 12); ++round) {
    SCOPED_TRACE(round);
    const std::size_t beads = 2 + random() % 30;
    const auto steps = random_grid_steps(random, beads, 3 + static_cast<int>(random() % 6), 3);
    PairsAsked asked = all_pairs(beads, 1 + random() % 4);
    if (beads > 8 && round % 2 == 0)
      asked = {{{0, 3}, {4, 4}, {5, static_cast<BeadId>(beads - 1)}}, round % 3 != 0, 2, round % 5 != 0};
    asked.groups = random_groups(random, beads);
    if (round < 8) expect_right(steps, asked);
    events += expect_part_of_all(steps, asked);
    if (HasFailure()) return;
  }
  EXPECT_GT(events, rounds(24U, 12U));
}

// Most blocks have beads of one group or of none, so that pairs of blocks are left out.
TEST(Contacts, OfGroupsAlongALongChain) {
  constexpr std::size_t beads = 400;
  std::mt19937 random(29);
  const auto steps = random_grid_steps(random, beads, 12, 2);
  PairsAsked asked = all_pairs(beads, 3);
  asked.groups.assign(beads, 0);
  for (std::size_t b = 30; b < 75; ++b) asked.groups[b] = 1;
  for (std::size_t b = 70; b < 300; b += b % 7 + 1) asked.groups[b] |= 2;
  EXPECT_GT(expect_part_of_all(steps, asked), 20U);
  ContactRig<Space> some(steps.front(), AuditMode::none, asked);
  some.run(steps);
  asked.groups.clear();
  ContactRig<Space> all(steps.front(), AuditMode::none, asked);
  all.run(steps);
  EXPECT_LT(some.structure.statistics.certificates.created,
            all.structure.statistics.certificates.created / 4);
}

TEST(Contacts, GroupsMustBeThoseOfAllBeads) {
  const Points three{{0, 0, 0}, {1, 0, 0}, {9, 0, 0}};
  const Space motion = with_radii(moving(three, three), {1});
  PairsAsked asked = all_pairs(3);
  asked.groups = {1, 2};
  EXPECT_THROW((ContactRig<Space>(motion, AuditMode::none, asked)), std::invalid_argument);
  asked.groups = {1, 0, 2};
  ContactRig<Space> rig(motion, AuditMode::none, asked);
  rig.run();
  EXPECT_THAT(rig.structure.pairs(), IsEmpty());
  EXPECT_THROW(rig.structure.apply({Contacts<3>::begin, 2, {0, 1}}), std::invalid_argument);
  EXPECT_NO_THROW(rig.structure.apply({Contacts<3>::begin, 2, {0, 2}}));
}

template <class M>
class ContactMotions : public testing::Test {};
using MotionsOfAllKinds = testing::Types<BezierMotion<2, 1>, BezierMotion<3, 1>, BezierMotion<2, 3>,
                                         BezierMotion<3, 3>, BezierMotion<3, 2>>;
TYPED_TEST_SUITE(ContactMotions, MotionsOfAllKinds);

// Motions with grazing, coincident and resting beads, at tiny, far and mixed scales, with changing radii.
TYPED_TEST(ContactMotions, AgreeWithEachPairsOwnPolynomial) {
  Random random(11);
  for (const MotionKind kind : all_motion_kinds) {
    for (int round = 0; round < rounds(5); ++round) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      const std::size_t beads = 2 + random() % 7;
      const std::vector<TypeParam> steps{random_motion<TypeParam>(random, beads, kind)};
      expect_right(steps, all_pairs(beads));
      if (this->HasFailure()) return;
    }
  }
}

TEST(Contacts, HugeAndTinyLengths) {
  std::mt19937 random(7);
  for (const int power : {-1070, -1000, -520, -300, 300, 480}) {
    SCOPED_TRACE(power);
    std::vector<Space> steps = random_grid_steps(random, 20, 6, 2);
    for (Space& step : steps) {
      for (BeadId b = 0; b < step.bead_count(); ++b) {
        for (int k = 0; k <= 1; ++k) {
          for (int axis = 0; axis < 3; ++axis)
            step.set_coordinate(b, k, axis, std::ldexp(step.coordinate(b, k, axis), power));
          step.set_radius(b, k, std::ldexp(step.radius(b, k), power));
        }
      }
    }
    expect_right(steps, all_pairs(20));
  }
}

// One bead is so far away that floats cannot distinguish the other beads.
TEST(Contacts, OneBeadFarAway) {
  constexpr std::size_t beads = 10 + rounds(30U);
  std::mt19937 random(8);
  for (const double far : {1e6, 1e12, 1e30, 1e150}) {
    SCOPED_TRACE(far);
    std::vector<Space> steps = random_grid_steps(random, beads, 8, 2);
    for (Space& step : steps)
      for (int k = 0; k <= 1; ++k) step.set_coordinate(7, k, 1, far);
    expect_right(steps, all_pairs(beads));
  }
}

// Floats cannot decide these pairs. Adding a large `apart` to a bead number must not overflow.
TEST(Contacts, NoPairIsAskedForBeyondTheChain) {
  Points from, to;
  for (int i = 0; i < 24; ++i) {
    from.push_back({1e306 * (i % 3), 1e150 * i, 0});
    to.push_back({1e306 * (i % 3), 0, 0});
  }
  const std::vector<Space> steps{with_radii(moving(from, to), {1e152})};
  for (const BeadId apart : {24U, no_bead - 10, no_bead}) {
    ContactRig<Space> rig(steps.front(), AuditMode::none, all_pairs(24, apart));
    rig.run(steps);
    EXPECT_THAT(rig.history.events, IsEmpty()) << apart;
    EXPECT_THAT(rig.structure.pairs(), IsEmpty()) << apart;
  }
}

// One pair of three beads is in question. The pair has one certificate, and the box of the chain another.
TEST(Contacts, CertificatesAreCountedThatThereAre) {
  const auto steps = std::vector{
      with_radii(moving({{0, 0, 0}, {5, 0, 0}, {10, 0, 0}}, {{0, 0, 0}, {5, 0, 0}, {1, 0, 0}}), {1})};
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    ContactRig<Space> rig(steps.front(), AuditMode::none, kernel, all_pairs(3, 2));
    rig.run(steps);
    EXPECT_EQ(rig.history.events.size(), 1U);
    EXPECT_LE(rig.structure.statistics.certificates.created, 2U);
  }
}

/// Returns steps of a protein's backbone. The radius of the balls is `times` times half of the longest bond.
std::vector<Space> backbone_steps(const std::string& name, const std::string& topology, std::size_t frames,
                                  std::size_t stride, double times) {
  ReadOptions options;
  options.topology = data("trajectories/" + topology);
  options.frames = {0, frames * stride + 1, stride};
  const Trajectory trajectory = read_trajectory(data("trajectories/" + name), options);
  const double longest = [&] {
    double most = 0;
    const auto& frame = trajectory.frames.front();
    for (Eigen::Index b = 0; b + 1 < frame.cols(); ++b)
      most = std::max(most, (frame.col(b + 1) - frame.col(b)).norm());
    return most;
  }();
  const Scene scene(std::span(&trajectory, 1),
                    std::vector<double>(trajectory.bead_count(), 0.5 * longest * times));
  std::vector<Space> steps(scene.step_count(), Space(scene.bead_count()));
  for (std::size_t k = 0; k < steps.size(); ++k) scene.load(k, steps[k]);
  return steps;
}

// Compares each frame with the quadratic of each pair.
TEST(Contacts, OfProteins) {
  const auto villin = backbone_steps("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", rounds(4U), 3, 2.5);
  expect_right(villin, all_pairs(villin.front().bead_count(), 5));
  const auto chain = backbone_steps("random100_400K_first200.dcd", "random100_400K.pdb", 1, 8, 2.8);
  const PairsAsked asked = all_pairs(chain.front().bead_count(), 5);
  ContactRig<Space> rig(chain.front(), AuditMode::events, asked);
  rig.motion = chain.front();
  rig.simulator.build();
  const std::vector<BeadPair> at_start = rig.structure.pairs();
  for (const Space& step : chain) ASSERT_NO_THROW(rig.step(step));
  EXPECT_FALSE(rig.history.events.empty());
  EXPECT_EQ(contact_history_fault(chain, asked, rig.history, at_start, rig.structure.pairs()), std::nullopt);
}

TEST(Contacts, AreThoseOfFrames) {
  const auto steps = backbone_steps("random100_400K_first200.dcd", "random100_400K.pdb", 12, 8, 2.4);
  const PairsAsked asked = all_pairs(steps.front().bead_count(), 5);
  ContactRig<Space> rig(steps.front(), AuditMode::none, asked);
  rig.motion = steps.front();
  rig.simulator.build();
  for (const Space& step : steps) {
    rig.step(step);
    EXPECT_EQ(rig.structure.pairs(), contacts_of(control_points(step, 1), control_radii(step, 1), asked));
  }
}

// Many blocks: three levels of boxes, with blocks grouped by position and regrouped as the family grows.
TEST(Contacts, OfALongChainAreThoseOfFrames) {
  constexpr std::size_t beads = rounds(6000U, 1500U), first = beads * 2 / 3;
  std::mt19937 random(17);
  const auto wandering = [&](double x) { return x + std::uniform_real_distribution<double>(-1, 1)(random); };
  std::vector<Points> frames(1, Points(beads));
  for (std::size_t b = 0; b < beads; ++b)
    for (std::size_t axis = 0; axis < 3; ++axis)
      frames[0][b][axis] = b == 0 ? 0 : 0.995 * wandering(frames[0][b - 1][axis]);
  for (std::size_t k = 1; k < 6; ++k) {
    frames.push_back(frames.back());
    // In the second half of the run the beads contract, which makes the family grow.
    for (auto& point : frames.back())
      for (double& x : point) x = (k < 3 ? 1 : 0.6) * x + 0.2 * wandering(0);
  }
  const auto steps = with_radii(through(frames), {0.3, 0.2});
  const PairsAsked asked{{{0, first - 1}, {first, beads - 1}}, true, 3, true};
  ContactRig<Space> rig(steps.front(), AuditMode::frames, asked);
  rig.motion = steps.front();
  rig.simulator.build();
  const auto at_frame = [&](const Space& step, int k) {
    return contacts_of(control_points(step, k), control_radii(step, k), asked);
  };
  EXPECT_EQ(rig.structure.pairs(), at_frame(steps.front(), 0));
  for (const Space& step : steps) {
    ASSERT_NO_THROW(rig.step(step));
    EXPECT_EQ(rig.structure.pairs(), at_frame(step, 1));
  }
  EXPECT_GT(rig.history.events.size(), beads / 6);
  const auto& c = rig.structure.statistics.certificates;
  EXPECT_LT(c.created, steps.size() * beads * 1000);  // each bead has 3000 pairs
}

// Two runs of contacts have functions of their own of the same beads, whose roots may differ by less than a
// double can tell.
TEST(Contacts, OfTwoCutoffsThatHardlyDiffer) {
  const Space motion = with_radii(moving({{0, 0, 0}, {-5, 0.3, 0}}, {{0, 0, 0}, {4, 0.7, 0}}), {1});
  Simulator simulator(AuditMode::events);
  History history;
  const PairsAsked asked = all_pairs(2);
  const Contacts<3> inner(simulator, motion, asked, {1, 1});
  const Contacts<3> outer(simulator, motion, asked, {1, std::nextafter(1.0, 2.0)});
  simulator.listen(history);
  simulator.build();
  simulator.run_step();
  simulator.finish();
  std::vector<std::string> order;
  for (const Event& e : history.events)
    order.push_back(
        text_of(e.structure_index == 0 ? "inner" : "outer", e.change.kind == 0 ? " begins" : " ends"));
  EXPECT_THAT(order, ElementsAre("outer begins", "inner begins", "inner ends", "outer ends"));
}

TEST(Contacts, BeadsAtRestCostNothing) {
  // Two necklaces rest side by side, and a third moves far away from both.
  Points from, to;
  for (int i = 0; i < 96; ++i) {
    const double x = i % 32;
    from.push_back({x, i < 32 ? 0.0 : i < 64 ? 0.5 : 90.0, 0});
    to.push_back(from.back());
    if (i >= 64) to.back()[2] = 5;
  }
  const auto steps = with_radii(through({from, to, from, to}), {0.5});
  const PairsAsked asked{{{0, 31}, {32, 63}, {64, 95}}, true, 2, true};
  ContactRig<Space> rig(steps.front(), AuditMode::events, asked);
  rig.run(steps);
  const StructureStatistics& s = rig.structure.statistics;
  EXPECT_FALSE(rig.structure.pairs().empty());
  EXPECT_THAT(rig.history.events, IsEmpty());
  // The structure examines only the moving necklace: its own pairs, and its boxes against the boxes at rest.
  const PairsAsked alone{{{0, 31}}, true, 2, true};
  Points lone_from(from.begin() + 64, from.end()), lone_to(to.begin() + 64, to.end());
  const auto lone = with_radii(through({lone_from, lone_to, lone_from, lone_to}), {0.5});
  ContactRig<Space> moving_one(lone.front(), AuditMode::none, alone);
  moving_one.run(lone);
  EXPECT_LT(s.certificates.created, 2 * moving_one.structure.statistics.certificates.created);
}

/// Returns the pairs of a family that are not proved apart, by brute force over all pairs of blocks.
PairsOfBlocks looked_at(const Space& motion, BeadId apart, bool short_vectors) {
  const std::vector<BeadRange> necklaces{{0, static_cast<BeadId>(motion.bead_count() - 1)}};
  const std::vector<BeadBlock> blocks = blocks_of(necklaces);
  BlockBeads<3> beads(blocks, 1);
  if (short_vectors) beads.use_short_vectors();
  beads.move_to(Curves<3>(motion), {0, 0, 0}, 16);
  std::vector<BlockPair> all;
  for (std::uint32_t a = 0; a < blocks.size(); ++a)
    for (std::uint32_t b = a; b < blocks.size(); ++b) all.push_back({a, b});
  PairsOfBlocks pairs;
  beads.look_at(all, apart, true, pairs);
  std::sort(pairs.unclear.begin(), pairs.unclear.end());
  std::sort(pairs.overlapping.begin(), pairs.overlapping.end());
  return pairs;
}

// Floats settle almost all pairs, and settle none wrongly.
TEST(Contacts, WhatFloatsProve) {
  Random random(13);
  for (int round = 0; round < rounds(6); ++round) {
    SCOPED_TRACE(round);
    Space motion(90);
    for (BeadId b = 0; b < 90; ++b) {
      const double radius = uniform(random, 0, 3);
      for (int k = 0; k <= 1; ++k) {
        for (int axis = 0; axis < 3; ++axis)
          motion.set_coordinate(b, k, axis,
                                k == 0 ? uniform(random, -8, 8)
                                       : motion.coordinate(b, 0, axis) + 1 + uniform(random, -0.5, 0.5));
        motion.set_radius(b, k, radius);
      }
    }
    const PairsOfBlocks pairs = looked_at(motion, 3, false);
    EXPECT_EQ(looked_at(motion, 3, true).unclear, pairs.unclear);
    EXPECT_EQ(looked_at(motion, 3, true).overlapping, pairs.overlapping);
    std::size_t undecided = 0;
    for (BeadId i = 0; i < 90; ++i) {
      for (BeadId j = i + 1; j < 90; ++j) {
        const PairHistory right = judged_history(std::vector{motion}, {i, j});
        const auto is_among = [&](const std::vector<BeadPair>& some) {
          return std::binary_search(some.begin(), some.end(), BeadPair{i, j});
        };
        const bool unclear = is_among(pairs.unclear), overlapping = is_among(pairs.overlapping);
        if (j - i < 3) {
          EXPECT_FALSE(unclear || overlapping) << i << " " << j;
          continue;
        }
        if (overlapping) {
          EXPECT_TRUE(right.in_contact_at_start && right.events.empty()) << i << " " << j;
        } else if (!unclear) {
          EXPECT_TRUE(!right.in_contact_at_start && right.events.empty()) << i << " " << j;
        } else if (right.events.empty()) {
          ++undecided;
        }
      }
    }
    EXPECT_LT(undecided, 20U);
  }
}

TEST(ContactSet, HoldsWhatASetHolds) {
  std::mt19937 random(3);
  ContactSet contacts;
  std::set<BeadPair> right;
  for (int round = 0; round < 20000; ++round) {
    const BeadId first = random() % 20;
    const BeadPair pair{first, first + 1 + static_cast<BeadId>(random() % 20)};
    if (random() % 2 == 0) {
      EXPECT_EQ(contacts.insert(pair), right.insert(pair).second);
    } else {
      EXPECT_EQ(contacts.erase(pair), right.erase(pair) == 1);
    }
    EXPECT_EQ(contacts.contains(pair), right.contains(pair));
    EXPECT_EQ(contacts.size(), right.size());
  }
  EXPECT_EQ(contacts.pairs(), std::vector<BeadPair>(right.begin(), right.end()));
  contacts.clear();
  EXPECT_THAT(contacts.pairs(), IsEmpty());
}

TEST(Contacts, AuditsNoticeEveryWrongContact) {
  const Points three{{0, 0, 0}, {1, 0, 0}, {9, 0, 0}};
  ContactRig<Space> rig(with_radii(moving(three, three), {1}), AuditMode::none, all_pairs(3));
  rig.run();
  using Kind = Contacts<3>::Kind;
  for (const double time : {0.0, 0.5, 1.0}) EXPECT_EQ(rig.structure.audit(Dyadic(time)), std::nullopt);
  for (const Change& wrong : {Change{Kind::end, 2, {0, 1}}, Change{Kind::begin, 2, {0, 2}}}) {
    rig.structure.apply(wrong);
    for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
    rig.structure.apply({wrong.kind == Kind::end ? Kind::begin : Kind::end, 2, wrong.ids});
  }
}

TEST(Contacts, RefuseChangesThatCannotBe) {
  const Points three{{0, 0, 0}, {1, 0, 0}, {9, 0, 0}};
  ContactRig<Space> rig(with_radii(moving(three, three), {1}), AuditMode::none, all_pairs(3));
  rig.run();
  using Kind = Contacts<3>::Kind;
  for (const Change& wrong :
       {Change{Kind::begin, 2, {0, 1}}, Change{Kind::touch, 2, {0, 1}}, Change{Kind::end, 2, {0, 2}},
        Change{Kind::begin, 2, {2, 0}}, Change{Kind::begin, 2, {2, 2}}, Change{Kind::begin, 2, {0, 3}}})
    EXPECT_THROW(rig.structure.apply(wrong), std::invalid_argument);
}

}  // namespace
}  // namespace kds::contacts_test
