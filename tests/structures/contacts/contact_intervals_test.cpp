#include "structures/contacts/contact_intervals.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <vector>

#include "motions/base/input_error.h"
#include "structures/contacts/contacts.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/element_contacts.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::contact_intervals_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

/// A dyadic length of time in frames, cutoffs, and the element of each bead.
struct Asked {
  std::vector<std::uint32_t> elements;
  double inner = 2, outer = 2;
  double gap = 0;
  Kernel kernel = Kernel::filtered;
};

std::vector<ContactInterval> followed(const std::vector<Space>& steps, const Asked& asked) {
  Simulator simulator(AuditMode::none, asked.kernel);
  Space motion = steps.front();
  const auto beads = static_cast<BeadId>(motion.bead_count());
  const PairsAsked pairs{{{0, beads - 1}}, true, 1, true};
  const auto radii = [&](double cutoff) {
    return contact_radii({cutoff, false}, std::vector<double>(beads, 0));
  };
  Contacts<3> inner(simulator, motion, pairs, radii(asked.inner));
  std::optional<Contacts<3>> wider;
  if (asked.outer != asked.inner) wider.emplace(simulator, motion, pairs, radii(asked.outer));
  const Contacts<3>& outer = wider ? *wider : inner;
  std::vector<ContactInterval> told;
  ContactIntervals intervals(
      simulator, {.elements = asked.elements, .gap = asked.gap, .inner = 0, .outer = wider ? 1U : 0U},
      [&](const ContactInterval& interval) { told.push_back(interval); });
  simulator.listen(intervals);
  simulator.build();
  const auto frame = [](std::size_t k) { return FrameStamp{k, {}}; };
  intervals.add_built(inner.pairs(), outer.pairs(), frame(0), frame(1));
  for (std::size_t k = 0; k < steps.size(); ++k) {
    motion = steps[k];
    simulator.set_frames(frame(k), frame(k + 1));
    simulator.run_step();
  }
  simulator.finish();
  intervals.finish(steps.size() - 1, frame(steps.size() - 1), frame(steps.size()));
  EXPECT_EQ(intervals.size(), 0U);
  return told;
}

std::vector<Space> with_cutoff(std::vector<Space> steps, double cutoff) {
  for (Space& step : steps)
    for (BeadId b = 0; b < step.bead_count(); ++b)
      for (int k = 0; k <= 1; ++k) step.set_radius(b, k, cutoff / 2);
  return steps;
}

JudgedIntervals judged(const std::vector<Space>& steps, const Asked& asked) {
  const auto within = [&](double cutoff) {
    return judged_intervals(with_cutoff(steps, cutoff), asked.elements);
  };
  JudgedIntervals all = within(asked.inner);
  if (asked.outer != asked.inner) all = with_two_cutoffs(all, within(asked.outer));
  return with_gap(std::move(all), Rational(asked.gap));
}

std::string described(std::uint32_t a, std::uint32_t b, double begin, double end, bool at_start,
                      bool at_end) {
  return text_of(a, " ", b, " from ", begin, at_start ? " (open)" : "", " to ", end, at_end ? " (open)" : "");
}
std::vector<std::string> lines(const JudgedIntervals& intervals) {
  std::vector<std::string> lines;
  for (const auto& [pair, own] : intervals)
    for (const JudgedInterval& i : own)
      lines.push_back(
          described(pair.first, pair.second, i.begin.get_d(), i.end.get_d(), i.open_at_start, i.open_at_end));
  return lines;
}
std::vector<std::string> lines(std::vector<ContactInterval> intervals) {
  std::stable_sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  std::vector<std::string> lines;
  for (const ContactInterval& i : intervals) {
    const auto at = [](const ContactMoment& m) { return static_cast<double>(m.step) + m.u(); };
    lines.push_back(described(i.first, i.second, at(i.begin), at(i.end), i.open_at_start, i.open_at_end));
    EXPECT_NEAR(i.length(), at(i.end) - at(i.begin), 1e-12);
    EXPECT_NEAR(i.begin.rounded.frame, at(i.begin), 1e-9);
  }
  return lines;
}

std::vector<std::uint32_t> each_bead(std::size_t beads) {
  std::vector<std::uint32_t> elements(beads);
  for (std::size_t b = 0; b < beads; ++b) elements[b] = static_cast<std::uint32_t>(b);
  return elements;
}

/// Runs a ball at rest and one at the given places. They are in contact within 2.
std::vector<std::string> told(const std::vector<double>& x, double gap = 0, double outer = 2) {
  std::vector<Points> frames;
  for (const double place : x) frames.push_back({{0, 0, 0}, {place, 0, 0}});
  const Asked asked{{0, 1}, 2, outer, gap};
  const auto found = lines(followed(through(frames), asked));
  EXPECT_EQ(found, lines(judged(through(frames), asked)));
  return found;
}

TEST(ContactIntervals, OpenAtTheEnds) {
  EXPECT_THAT(told({-4, 4}), ElementsAre("0 1 from 0.25 to 0.75"));
  EXPECT_THAT(told({0, 4}), ElementsAre("0 1 from 0 (open) to 0.5"));
  EXPECT_THAT(told({4, 0, 0}), ElementsAre("0 1 from 0.5 to 2 (open)"));
  EXPECT_THAT(told({0, 1, 0}), ElementsAre("0 1 from 0 (open) to 2 (open)"));
  EXPECT_THAT(told({4, 4}), IsEmpty());
}

TEST(ContactIntervals, ATouchHasLengthZero) {
  EXPECT_THAT(told({4, 2, 4}), ElementsAre("0 1 from 1 to 1"));
  EXPECT_THAT(told({2, 4}), ElementsAre("0 1 from 0 (open) to 0"));
  EXPECT_THAT(told({0, 2, 4}), ElementsAre("0 1 from 0 (open) to 1"));
  EXPECT_THAT(told({4, 2, 0}), ElementsAre("0 1 from 1 to 2 (open)"));
  EXPECT_THAT(told({4, 2}), IsEmpty());  // its events would belong to a step after the last frame
}

// The ball leaves at 0.5 and is back at 1.5.
TEST(ContactIntervals, AnAbsenceAsLongAsTheGapEndsAContact) {
  const std::vector<double> x{0, 4, 0, 0};
  EXPECT_THAT(told(x), ElementsAre("0 1 from 0 (open) to 0.5", "0 1 from 1.5 to 3 (open)"));
  EXPECT_THAT(told(x, 1), ElementsAre("0 1 from 0 (open) to 0.5", "0 1 from 1.5 to 3 (open)"));
  EXPECT_THAT(told(x, std::nextafter(1, 2)), ElementsAre("0 1 from 0 (open) to 3 (open)"));
  EXPECT_THAT(told({0, 4, 0, 4}, 1.5), ElementsAre("0 1 from 0 (open) to 2.5"));
  EXPECT_THAT(told({4, 2, 4, 2, 4, 4}, 2), ElementsAre("0 1 from 1 to 1", "0 1 from 3 to 3"));
  EXPECT_THAT(told({4, 2, 4, 2, 4, 4}, 2.5), ElementsAre("0 1 from 1 to 3"));
}

TEST(ContactIntervals, TwoCutoffs) {
  EXPECT_THAT(told({4, 0, 3, 0, 4}, 0, 3), ElementsAre("0 1 from 0.5 to 3.75"));
  EXPECT_THAT(told({4, 0, 4, 2.5, 4}, 0, 3), ElementsAre("0 1 from 0.5 to 1.75"));
  EXPECT_THAT(told({2.5, 4, 2.5, 2.5}, 0, 3), IsEmpty());  // never within the inner cutoff
  EXPECT_THAT(told({2.5, 0, 4}, 0, 3), ElementsAre("0 1 from 0.2 to 1.75"));
  EXPECT_THAT(told({4, 2, 4}, 0, 3), ElementsAre("0 1 from 1 to 1.5"));
  EXPECT_THAT(told({0, 4, 0}, 0.875, 3), ElementsAre("0 1 from 0 (open) to 2 (open)"));
  EXPECT_THAT(told({0, 4, 0}, 0.75, 3), ElementsAre("0 1 from 0 (open) to 0.75", "0 1 from 1.5 to 2 (open)"));
  EXPECT_THAT(told({0, 4, 0}, 0.75, 2.5),
              ElementsAre("0 1 from 0 (open) to 0.625", "0 1 from 1.5 to 2 (open)"));
}

// The least distance of any two beads decides: ball 2 stays within the outer cutoff of ball 0, and was never
// within the inner one.
TEST(ContactIntervals, TwoCutoffsOfElementsAreOfTheLeastDistance) {
  const auto at = [](double x) { return Points{{0, 0, 0}, {x, 0, 0}, {0, 2.5, 0}}; };
  const auto steps = through({at(4), at(0), at(4)});
  EXPECT_THAT(lines(followed(steps, {{0, 1, 1}, 2, 3})), ElementsAre("0 1 from 0.5 to 2 (open)"));
  EXPECT_THAT(lines(followed(steps, {{0, 1, 2}, 2, 3})), ElementsAre("0 1 from 0.5 to 1.75"));
}

// At the time at which ball 1 leaves ball 0, ball 2 touches ball 0. Balls 1 and 2 are one element.
TEST(ContactIntervals, AnAbsenceOfLengthZeroEndsNothing) {
  const auto steps = through({{{0, 0, 0}, {0, 0, 0}, {0, 4, 0}}, {{0, 0, 0}, {4, 0, 0}, {0, 0, 0}}});
  EXPECT_THAT(lines(followed(steps, {{0, 1, 1}})), ElementsAre("0 1 from 0 (open) to 1 (open)"));
  EXPECT_THAT(lines(followed(steps, {{1, 0, 0}, 2, 2, 0.25})), ElementsAre("0 1 from 0 (open) to 1 (open)"));
  EXPECT_THAT(lines(followed(steps, {{0, 1, 2}})),
              ElementsAre("0 1 from 0 (open) to 0.5", "0 2 from 0.5 to 1 (open)"));
}

TEST(ContactIntervals, NearElementsOfAChainAreLeftOut) {
  const auto steps = through({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
  const auto counted = [&](std::vector<std::uint32_t> chains) {
    Simulator simulator;
    Space motion = steps.front();
    Contacts<3> contacts(simulator, motion, {{{0, 2}}, true, 1, true}, std::vector<double>(3, 1));
    int count = 0;
    ContactIntervals intervals(simulator, {.elements = {0, 1, 2}, .chains = std::move(chains), .apart = 2},
                               [&](const ContactInterval&) { ++count; });
    simulator.build();
    intervals.add_built(contacts.pairs(), contacts.pairs(), {0, {}}, {1, {}});
    intervals.finish(0, {0, {}}, {1, {}});
    return count;
  };
  EXPECT_EQ(counted({}), 3);
  EXPECT_EQ(counted({0, 0, 0}), 1);
  EXPECT_EQ(counted({0, 0, 1}), 2);
}

TEST(ContactIntervals, RefusesGapsAndTimesThatSayNothing) {
  Simulator simulator;
  const auto sink = [](const ContactInterval&) {};
  EXPECT_THROW(ContactIntervals(simulator, {.gap = -1}, sink), std::invalid_argument);
  EXPECT_THROW(ContactIntervals(simulator, {.gap = INFINITY}, sink), std::invalid_argument);
  ContactIntervals timed(simulator, {.clock = ContactClock::picoseconds}, sink);
  EXPECT_THROW(timed.add_built({}, {}, {0, 1.0}, {1, 1.0}), InputError);
  EXPECT_THROW(timed.add_built({}, {}, {0, {}}, {1, 1.0}), InputError);
}

/// Makes frames with whole coordinates: touches, ties, and contacts at frames.
std::vector<Space> grid_steps(std::mt19937& random, std::size_t beads, int range, std::size_t count) {
  std::vector<Points> frames;
  for (std::size_t k = 0; k <= count; ++k) {
    frames.push_back(random_grid_points(random, beads, range));
    for (std::size_t b = 0; k > 0 && b < beads; ++b)
      if (random() % 4 == 0) frames[k][b] = frames[k - 1][b];  // the bead rests
  }
  return through(frames);
}

TEST(ContactIntervals, AreThoseOfEachPairAlone) {
  std::mt19937 random(38);
  std::size_t intervals = 0, open = 0, touches = 0;
  for (int round = 0; round < rounds(60) && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const std::size_t beads = 2 + random() % 5;
    const auto steps = grid_steps(random, beads, 3 + static_cast<int>(random() % 4), 5);
    Asked asked{each_bead(beads)};
    if (random() % 2 == 0)
      for (auto& element : asked.elements) element = random() % 3;
    asked.inner = 1 + static_cast<double>(random() % 2);
    asked.outer = asked.inner + static_cast<double>(random() % 3) / 2;
    if (random() % 2 == 0) asked.gap = 0.125 * static_cast<double>(random() % 9);
    if (random() % 4 == 0) asked.kernel = Kernel::exact;
    const std::vector<ContactInterval> found = followed(steps, asked);
    EXPECT_EQ(lines(found), lines(judged(steps, asked)))
        << asked.inner << ":" << asked.outer << ", gap " << asked.gap;
    intervals += found.size();
    for (const ContactInterval& i : found) {
      open += i.open_at_start || i.open_at_end ? 1 : 0;
      touches += i.length() == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(intervals, rounds(200U));
  EXPECT_GT(open, rounds(30U));
  EXPECT_GE(touches, rounds(5U, 0U));
}

// Ball 1 passes at distance 1, so it leaves and comes back at irrational times. Over linear motion an
// irrational absence never equals a gap, because it is a number minus a multiple of a root. TimeSpan tests
// have equal ones.
TEST(ContactIntervals, GapsNearAnIrrationalAbsence) {
  for (const double speed : {1.0, 0.5, 3.0}) {
    const double reach = 8 * speed;
    const auto steps = through({{{0, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {reach, 1, 0}}, {{0, 0, 0}, {0, 1, 0}}});
    const double absence = 2 * (1 - std::sqrt(3.0) / reach);
    const auto count = [&](double gap) { return followed(steps, {{0, 1}, 2, 2, gap}).size(); };
    EXPECT_EQ(count(absence * (1 - 0x1p-51)), 2U);
    EXPECT_EQ(count(absence * (1 + 0x1p-51)), 1U);
  }
}

}  // namespace
}  // namespace kds::contact_intervals_test
