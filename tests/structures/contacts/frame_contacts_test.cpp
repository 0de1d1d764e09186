#include "structures/contacts/frame_contacts.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "structures/contacts/contact_lifetimes.h"
#include "structures/contacts/contacts.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/element_contacts.h"
#include "tests/support/rounds.h"

namespace kds::frame_contacts_test {
namespace {

using namespace test;
using testing::ElementsAre;

constexpr std::size_t frame = ticks_per_frame;

struct Setting {
  std::vector<std::uint32_t> elements;
  double inner = 2, outer = 2;
  std::size_t bridge = 1;
  std::vector<std::size_t> spacings{frame, 2 * frame, 4 * frame};
};

FrameContacts sampled(const std::vector<Space>& steps, const Setting& setting) {
  Simulator simulator;
  Space motion = steps.front();
  const auto beads = static_cast<BeadId>(motion.bead_count());
  const PairsAsked pairs{{{0, beads - 1}}, true, 1, true};
  const auto radii = [&](double cutoff) {
    return contact_radii({cutoff, false}, std::vector<double>(beads, 0));
  };
  Contacts<3> inner(simulator, motion, pairs, radii(setting.inner));
  Contacts<3> outer(simulator, motion, pairs, radii(setting.outer));
  FrameContacts frames(setting.spacings, setting.bridge);
  const auto rule = [&](std::size_t structure) {
    return ContactRule{
        .elements = setting.elements, .inner = structure, .outer = structure, .rounds_times = false};
  };
  ContactIntervals of_inner(simulator, rule(0), [&](const ContactInterval& i) { frames.add_inner(i); });
  ContactIntervals of_outer(simulator, rule(1), [&](const ContactInterval& i) { frames.add_outer(i); });
  simulator.listen(of_inner);
  simulator.listen(of_outer);
  simulator.build();
  const FrameStamp first{0, {}}, second{1, {}}, last{steps.size(), {}}, before{steps.size() - 1, {}};
  of_inner.add_built(inner.pairs(), inner.pairs(), first, second);
  of_outer.add_built(outer.pairs(), outer.pairs(), first, second);
  for (const Space& step : steps) {
    motion = step;
    simulator.run_step();
  }
  simulator.finish();
  of_inner.finish(steps.size() - 1, before, last);
  of_outer.finish(steps.size() - 1, before, last);
  frames.finish(steps.size());
  return frames;
}

/// One ball rests, and the other is at x at each frame.
std::vector<Space> along(const std::vector<double>& x) {
  std::vector<Points> frames;
  for (const double place : x) frames.push_back({{0, 0, 0}, {place, 0, 0}});
  return through(frames);
}

std::vector<std::uint64_t> found(const std::vector<double>& x) {
  const FrameContacts frames = sampled(along(x), {{0, 1}});
  std::vector<std::uint64_t> found;
  for (const FrameContacts::Row& row : frames.rows()) found.push_back(row.found);
  return found;
}

TEST(FrameContacts, AreFoundWhereAFrameLiesInThem) {
  EXPECT_THAT(found({-9, 9}), ElementsAre(0, 0, 0));              // passes through between two frames
  EXPECT_THAT(found({-9, 0, 9}), ElementsAre(1, 0, 0));           // in contact at frame 1
  EXPECT_THAT(found({-9, -4, 0, 9}), ElementsAre(1, 1, 0));       // in contact at frame 2
  EXPECT_THAT(found({0, 9}), ElementsAre(1, 1, 1));               // in contact at the start
  EXPECT_THAT(found({-9, -9, -9, 0}), ElementsAre(1, 0, 0));      // in contact at the end
  EXPECT_THAT(found({-9, -2, -9}), ElementsAre(1, 0, 0));         // touches at frame 1
  EXPECT_THAT(found({-9, -9, -2, -9}), ElementsAre(1, 1, 0));     // touches at frame 2
  EXPECT_THAT(found({-9, -2, 0, -2, -9}), ElementsAre(1, 1, 0));  // begins and ends at frames
  EXPECT_THAT(found({-9, 9, -9, 0, 9}), ElementsAre(1, 0, 0));    // the last of three
}

std::vector<double> figures(const FrameContacts& frames, FrameContacts::Kind kind) {
  const FrameContacts::Row& row = frames.rows().front();
  return {static_cast<double>(row.sums[kind].contacts), row.length(kind), row.occupancy(kind, 1)};
}

TEST(FrameContacts, AbsencesAreBridged) {
  const auto frames = sampled(along({0, 9, 0, 9, 9, 0, 0, 9}), {{0, 1}, 2, 2, 1});
  EXPECT_EQ(frames.exact(FrameContacts::plain).contacts, 3U);
  EXPECT_THAT(figures(frames, FrameContacts::plain), ElementsAre(3, 4 / 3.0, 0.5));
  EXPECT_THAT(figures(frames, FrameContacts::bridged), ElementsAre(2, 2.5, 5 / 8.0));
  // Every second frame sees 0, 0, 9, 0.
  EXPECT_EQ(frames.rows()[1].sums[FrameContacts::plain].contacts, 2U);
  EXPECT_EQ(frames.rows()[1].length(FrameContacts::plain), 3);
  EXPECT_EQ(frames.rows()[1].length(FrameContacts::bridged), 8);
}

TEST(FrameContacts, TwoCutoffs) {
  const auto frames = sampled(along({3, 3, 0, 3, 9, 3, 9, 0, 0}), {{0, 1}, 2, 4, 0});
  EXPECT_EQ(frames.exact(FrameContacts::dual).contacts, 2U);
  EXPECT_THAT(figures(frames, FrameContacts::dual), ElementsAre(2, 2, 4 / 9.0));
  EXPECT_THAT(figures(frames, FrameContacts::plain), ElementsAre(2, 1.5, 3 / 9.0));
  // Between the frames that are seen, the ball leaves and comes back.
  const auto missed = sampled(along({0, 9, 3, 3, 9}), {{0, 1}, 2, 4, 0});
  EXPECT_EQ(missed.rows()[1].sums[FrameContacts::dual].contacts, 1U);
  EXPECT_EQ(missed.rows()[1].sums[FrameContacts::dual].time, 2);
}

// As in ContactIntervals: bead 2 stays within the outer cutoff.
TEST(FrameContacts, TwoCutoffsOfElementsAreOfTheLeastDistance) {
  const auto at = [](double x) { return Points{{0, 0, 0}, {x, 0, 0}, {0, 2.5, 0}}; };
  const auto steps = through({at(4), at(0), at(4), at(4)});
  EXPECT_THAT(figures(sampled(steps, {{0, 1, 1}, 2, 3}), FrameContacts::dual), ElementsAre(1, 3, 3 / 4.0));
  EXPECT_THAT(figures(sampled(steps, {{0, 1, 2}, 2, 3}), FrameContacts::dual), ElementsAre(1, 1, 1 / 4.0));
}

bool contains(const std::vector<JudgedInterval>& intervals, const Rational& time) {
  for (const JudgedInterval& i : intervals)
    if (i.begin - tie() < time && time < i.end + tie()) return true;
  return false;
}

/// Counts contacts at samples one by one.
FrameContacts::Sums counted(const std::vector<bool>& inner, const std::vector<bool>& outer,
                            std::size_t bridge) {
  FrameContacts::Sums sums;
  for (std::size_t k = 0; k < inner.size(); ++k) {
    if (!inner[k]) continue;
    std::size_t last = k;
    for (std::size_t next = k + 1; next < inner.size(); ++next) {
      if (outer[next] || inner[next]) {
        last = next;
      } else if (next - last > bridge) {
        break;
      }
    }
    ++sums.contacts;
    sums.time += static_cast<double>(last - k + 1);
    k = last;
  }
  return sums;
}

TEST(FrameContacts, AreThoseOfEachSampleAlone) {
  std::mt19937 random(39);
  std::uint64_t contacts = 0;
  for (int round = 0; round < rounds(30) && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    const std::size_t beads = 2 + random() % 4;
    std::vector<Points> points;
    for (int k = 0; k <= 9; ++k) points.push_back(random_grid_points(random, beads, 4));
    const auto steps = through(points);
    Setting setting{{}, 1 + static_cast<double>(random() % 2), 0, random() % 3};
    setting.outer = setting.inner + 0.5 * static_cast<double>(random() % 3);
    setting.spacings = {frame / 8, frame / 2, frame, 2 * frame, 3 * frame};
    for (std::size_t b = 0; b < beads; ++b) setting.elements.push_back(random() % 3);
    const FrameContacts frames = sampled(steps, setting);
    const auto within = [&](double cutoff) {
      std::vector<Space> balls = steps;
      for (Space& step : balls)
        for (BeadId b = 0; b < beads; ++b)
          for (int k = 0; k <= 1; ++k) step.set_radius(b, k, cutoff / 2);
      return judged_intervals(balls, setting.elements);
    };
    const JudgedIntervals inner = within(setting.inner), outer = within(setting.outer);
    for (const FrameContacts::Row& row : frames.rows()) {
      std::array<FrameContacts::Sums, 3> expected;
      const auto add = [&](FrameContacts::Kind kind, const FrameContacts::Sums& sums) {
        expected[kind].contacts += sums.contacts;
        expected[kind].time += sums.time;
      };
      for (const auto& [pair, around] : outer) {
        std::vector<bool> in, out;
        for (std::size_t k = 0; k < row.sampling.samples; ++k) {
          const Rational time = Rational(static_cast<unsigned long>(k * row.sampling.spacing)) /
                                static_cast<unsigned long>(frame);
          const auto own = inner.find(pair);
          in.push_back(own != inner.end() && contains(own->second, time));
          out.push_back(contains(around, time));
        }
        add(FrameContacts::plain, counted(in, in, 0));
        add(FrameContacts::bridged, counted(in, in, setting.bridge));
        add(FrameContacts::dual, counted(in, out, 0));
      }
      for (const auto kind : {FrameContacts::plain, FrameContacts::bridged, FrameContacts::dual}) {
        EXPECT_EQ(row.sums[kind].contacts, expected[kind].contacts) << kind << " " << row.sampling.spacing;
        EXPECT_EQ(row.sums[kind].time, expected[kind].time) << kind << " " << row.sampling.spacing;
        contacts += expected[kind].contacts;
      }
    }
    std::uint64_t exact = 0, dual = 0;
    for (const auto& [pair, own] : inner) exact += own.size();
    for (const auto& [pair, own] : with_two_cutoffs(inner, outer)) dual += own.size();
    EXPECT_EQ(frames.exact(FrameContacts::plain).contacts, exact);
    EXPECT_EQ(frames.exact(FrameContacts::dual).contacts, dual);
  }
  EXPECT_GT(contacts, rounds(400U));
}

// Contacts of a protein, sampled up to 256 times a frame: number, life and occupancy come to the exact ones.
TEST(FrameContacts, ConvergeToTheExactOnes) {
  auto steps = trajectory_steps("random100_400K_first200.dcd", 0, 199);
  Setting setting{{}, 6, 6.5};
  for (BeadId b = 0; b < steps.front().bead_count(); ++b) setting.elements.push_back(b / 3);
  setting.spacings = {1, 4, 16, 64, frame, 4 * frame};
  const FrameContacts frames = sampled(steps, setting);
  for (const auto kind : {FrameContacts::plain, FrameContacts::dual}) {
    const FrameContacts::Sums exact = frames.exact(kind);
    ASSERT_GT(exact.contacts, 200U);
    double last = 0;
    for (const FrameContacts::Row& row : frames.rows()) {
      const auto share = [&](double value, double right) { return std::abs(value / right - 1); };
      const double number =
          share(static_cast<double>(row.sums[kind].contacts), static_cast<double>(exact.contacts));
      const double length = share(row.length(kind), exact.time / static_cast<double>(exact.contacts));
      if (row.sampling.spacing == 1) {
        EXPECT_LT(number, 0.01);
        EXPECT_LT(length, 0.01);
      }
      EXPECT_GE(number, last) << row.sampling.spacing;
      last = number;
    }
    EXPECT_GT(last, kind == FrameContacts::plain ? 0.2 : 0.02);
  }
}

}  // namespace
}  // namespace kds::frame_contacts_test
