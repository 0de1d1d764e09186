#include "structures/contacts/sampled_contacts.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "structures/contacts/contacts.h"
#include "structures/session/session.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::sampled_contacts_test {
namespace {

using namespace test;
using testing::ElementsAre;

constexpr std::array<std::size_t, 7> strides{1, 2, 4, 8, 16, 32, 64};

std::vector<std::uint64_t> found(const SampledContacts& sampled) {
  std::vector<std::uint64_t> found;
  for (const SampledContacts::Sampling& sampling : sampled.samplings()) found.push_back(sampling.found);
  return found;
}

/// Runs two balls of radius 1. One rests, and the other is at x at each frame.
SampledContacts sampled(const std::vector<double>& x) {
  std::vector<Points> frames;
  for (const double place : x) frames.push_back({{0, 0, 0}, {place, 0, 0}});
  std::vector<Space> steps = through(frames);
  for (Space& step : steps)
    for (BeadId b = 0; b < 2; ++b)
      for (int k = 0; k <= 1; ++k) step.set_radius(b, k, 1);
  Simulator simulator;
  Space motion = steps.front();
  Contacts<3> contacts(simulator, motion, {{{0, 1}}, true, 1, true});
  SampledContacts sampled(std::array<std::size_t, 3>{1, 2, 4});
  simulator.listen(sampled);
  simulator.build();
  sampled.add_built(contacts.pairs());
  for (const Space& step : steps) {
    motion = step;
    simulator.run_step();
  }
  simulator.finish();
  sampled.finish(steps.size());
  return sampled;
}

TEST(SampledContacts, AreFoundWhereAFrameLiesInThem) {
  EXPECT_THAT(found(sampled({-9, 9})), ElementsAre(0, 0, 0));           // passes through between two frames
  EXPECT_THAT(found(sampled({-9, 0, 9})), ElementsAre(1, 0, 0));        // in contact at frame 1
  EXPECT_THAT(found(sampled({-9, -4, 0, 9})), ElementsAre(1, 1, 0));    // in contact at frame 2
  EXPECT_THAT(found(sampled({0, 9})), ElementsAre(1, 1, 1));            // in contact at the start
  EXPECT_THAT(found(sampled({-9, -9, -9, 0})), ElementsAre(1, 0, 0));   // in contact at the end
  EXPECT_THAT(found(sampled({-9, -2, -9})), ElementsAre(1, 0, 0));      // touches at frame 1
  EXPECT_THAT(found(sampled({-9, -9, -2, -9})), ElementsAre(1, 1, 0));  // touches at frame 2
  EXPECT_THAT(found(sampled({-9, -2, 0, -2, -9})), ElementsAre(1, 1, 0));  // begins and ends at frames
  EXPECT_THAT(found(sampled({-9, 9, -9, 0, 9})), ElementsAre(1, 0, 0));    // the last of three
}

// The share of missed contacts grows with the stride, as in the trial in the design document (2.5 times the
// radius).
TEST(SampledContacts, OfAProteinMostAreMissedBetweenFrames) {
  ReadOptions options;
  options.topology = data("trajectories/random100_400K.pdb");
  const Trajectory trajectory = read_trajectory(data("trajectories/random100_400K_first200.dcd"), options);
  double longest = 0;
  for (const Eigen::Matrix3Xd& frame : trajectory.frames)
    for (Eigen::Index b = 0; b + 1 < frame.cols(); ++b)
      longest = std::max(longest, (frame.col(b + 1) - frame.col(b)).norm());
  const Scene scene(std::span(&trajectory, 1), std::vector<double>(trajectory.bead_count(), 1.25 * longest));
  SessionOptions session_options{{"contacts"}, Kernel::filtered, AuditMode::none, {}};
  session_options.settings.apart = 5;
  Session session(scene, session_options);
  SampledContacts sampled(strides);
  session.simulator().listen(sampled);
  session.load(0);
  session.simulator().build();
  std::vector<BeadPair> at_start;
  for (const Event& event : session.built(0)) at_start.push_back({event.ids()[0], event.ids()[1]});
  sampled.add_built(at_start);
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    session.load(step);
    session.simulator().run_step();
  }
  session.simulator().finish();
  sampled.finish(scene.step_count());
  const auto& samplings = sampled.samplings();
  const auto& events = session.structures().front()->statistics.events_by_kind;
  EXPECT_EQ(samplings.front().contacts, at_start.size() + events[0] + events[2]);
  std::string missed;
  for (const auto& sampling : samplings) missed += std::to_string(sampling.missed()) + " ";
  RecordProperty("missed", missed);
  EXPECT_LT(samplings[0].missed(), 0.03) << missed;
  EXPECT_NEAR(samplings[1].missed(), 0.22, 0.06) << missed;
  EXPECT_NEAR(samplings[2].missed(), 0.42, 0.08) << missed;
  EXPECT_NEAR(samplings[3].missed(), 0.61, 0.1) << missed;
  EXPECT_NEAR(samplings[4].missed(), 0.79, 0.1) << missed;
  for (std::size_t s = 1; s < samplings.size(); ++s)
    EXPECT_GE(samplings[s].missed(), samplings[s - 1].missed()) << missed;
}

}  // namespace
}  // namespace kds::sampled_contacts_test
