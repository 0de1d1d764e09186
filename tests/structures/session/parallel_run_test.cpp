// The law of splits: a run that is cut at frames into parts on several threads has the events, fingerprint,
// dumps and counts of an uncut KineticRun, also on degenerate scenes.

#include "structures/session/parallel_run.h"
#include "kds/event_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/frames/trajectory.h"
#include "structures/contacts/contacts.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random.h"
#include "tests/support/rounds.h"

namespace kds::parallel_run_test {
namespace {

using namespace test;

/// Results of a run at its frames and after its end.
struct Shown {
  std::vector<std::string> dumps;  // of all frames
  std::vector<std::vector<CombinatorialElement>> elements;
  std::vector<std::vector<std::uint64_t>> events_by_kind, events_per_step;
  std::vector<std::uint64_t> rebuilds, audits;
  std::uint64_t fingerprint = 0;
  std::string error;

  void add(const KineticRun& run, std::size_t frame) {
    for (const DumpFile& file : run.dump(frame)) dumps.push_back(file.ending + "\n" + file.text);
    for (std::size_t s = 0; s < run.structures().size(); ++s) {
      std::optional<CombinatorialElements> of_frame = run.elements(s, frame);
      if (!of_frame) continue;
      std::sort(of_frame->all.begin(), of_frame->all.end());
      elements.push_back(std::move(of_frame->all));
    }
  }
  void add_end(KineticRun& run) {
    for (const KineticStructure* const structure : run.structures()) {
      events_by_kind.push_back(structure->statistics.events_by_kind);
      events_per_step.push_back(structure->statistics.events_per_step);
      rebuilds.push_back(structure->statistics.rebuilds);
      audits.push_back(structure->statistics.audits_run);
    }
    fingerprint = run.simulator().fingerprint();
  }
};

void expect_same(const Shown& cut, const Shown& whole) {
  EXPECT_EQ(cut.dumps, whole.dumps);
  EXPECT_EQ(cut.elements, whole.elements);
  EXPECT_EQ(cut.error, whole.error);
  if (!whole.error.empty()) return;
  EXPECT_EQ(cut.events_by_kind, whole.events_by_kind);
  EXPECT_EQ(cut.events_per_step, whole.events_per_step);
  EXPECT_EQ(cut.rebuilds, whole.rebuilds);
  EXPECT_EQ(cut.audits, whole.audits);
  EXPECT_EQ(cut.fingerprint, whole.fingerprint);
}

/// Compares each event of a run with the next one of a log.
class SameEvents final : public EventListener {
 public:
  explicit SameEvents(const EventLog& log) : log_(log) {}
  void on_event(const Event& event) override {
    if (next_ >= log_.events.size()) return static_cast<void>(++next_);
    const Event& other = log_.events[next_++];
    EXPECT_EQ(other.step, event.step);
    EXPECT_EQ(other.structure, event.structure);
    EXPECT_EQ(other.change, event.change);
    EXPECT_EQ(other.from.number, event.from.number);
    EXPECT_EQ(other.to.number, event.to.number);
    EXPECT_EQ(other.lower, event.lower);
    EXPECT_EQ(other.upper, event.upper);
  }
  [[nodiscard]] std::size_t count() const { return next_; }

 private:
  const EventLog& log_;
  std::size_t next_ = 0;
};

/// Runs the scene uncut and cut into parts. Returns how it was cut.
PartCounts expect_law(const Scene& scene, const KineticRunOptions& options, std::size_t steps_per_part,
                      std::size_t threads) {
  ParallelOptions parallel{threads, steps_per_part, true, true};
  ParallelRun cut(scene, options, parallel);
  EXPECT_EQ(cut.uncut(), std::nullopt);
  EventLog log;
  cut.listen(log);
  Shown of_cut;
  try {
    cut.run([&](std::size_t frame) { of_cut.add(cut.whole(), frame); });
    of_cut.add_end(cut.whole());
  } catch (const InputError& error) {
    of_cut.error = error.what();
  }
  KineticRun whole(scene, options);
  SameEvents same(log);
  whole.listen(same);
  Shown of_whole;
  try {
    whole.build();
    of_whole.add(whole, 0);
    for (std::size_t frame = 1; whole.run_step(); ++frame) of_whole.add(whole, frame);
    whole.finish();
    of_whole.add_end(whole);
  } catch (const InputError& error) {
    of_whole.error = error.what();
  }
  expect_same(of_cut, of_whole);
  EXPECT_EQ(log.events.size(), same.count());
  return cut.parts();
}

/// A chain whose beads wander.
Trajectory wandering_chain(std::uint64_t seed, int beads, int frames) {
  Random random(seed);
  Trajectory necklace;
  necklace.file = "chain of seed " + std::to_string(seed);
  for (int frame = 0; frame < frames; ++frame) {
    Eigen::Matrix3Xd positions = frame == 0 ? Eigen::Matrix3Xd(3, beads) : necklace.frames.back();
    for (int bead = 0; bead < beads; ++bead)
      for (int axis = 0; axis < 3; ++axis)
        positions(axis, bead) =
            (frame == 0 ? (axis == 0 ? bead : 0) : positions(axis, bead)) + uniform(random, -0.4, 0.4);
    necklace.frames.push_back(positions);
  }
  return necklace;
}

const std::vector<std::string> all_structures{"sorted", "box",   "closest", "wrapped",
                                              "boxes",  "power", "dual",    "contacts"};

Scene scene_of(const Trajectory& necklace, std::vector<double> radii,
               FrameMotion motion = FrameMotion::linear) {
  if (radii.size() == 1) radii.resize(static_cast<std::size_t>(necklace.frames[0].cols()), radii[0]);
  return {std::span(&necklace, 1), std::move(radii), motion};
}

TEST(ParallelRun, IsTheUncutRunOfWanderingChains) {
  Random random(5);
  for (std::uint64_t seed = 0; seed < test::rounds(8U); ++seed) {
    SCOPED_TRACE(seed);
    const Trajectory chain = wandering_chain(seed, 20, 9);
    std::vector<double> radii{0.5};
    if (seed % 2 == 1)
      for (int bead = 0; bead < 19; ++bead) radii.push_back(0.2 + 0.1 * static_cast<double>(random() % 6));
    const Scene scene = scene_of(chain, radii, seed % 4 < 2 ? FrameMotion::linear : FrameMotion::hermite);
    const PartCounts parts =
        expect_law(scene, {all_structures}, 1 + random() % 4, 1 + static_cast<std::size_t>(random() % 5));
    EXPECT_GT(parts.parts, 1U);
    EXPECT_EQ(parts.run_again, 0U);  // no ties at frames
  }
}

TEST(ParallelRun, IsTheUncutRunOfShippedTrajectories) {
  Random random(11);
  for (const auto& [name, frames] :
       {std::pair("villin_hp36_300K.dcd", 24U), std::pair("random100_400K_first200.dcd", 16U),
        std::pair("dhodh363_1000K_first20.dcd", 4U)}) {
    SCOPED_TRACE(name);
    const auto first = static_cast<std::size_t>(random() % 3);
    ReadOptions reading;
    reading.frames = {first, first + frames, 1};
    const Trajectory trajectory = read_trajectory(data(std::string("trajectories/") + name), reading);
    const Scene scene = scene_of(trajectory, {1.9});
    const PartCounts parts =
        expect_law(scene, {{"wrapped", "power", "contacts"}}, 1 + random() % (frames / 2),
                   1 + static_cast<std::size_t>(random() % 5));
    EXPECT_EQ(parts.run_again, 0U);
  }
}

TEST(ParallelRun, AuditsAsOften) {
  const Scene scene = scene_of(wandering_chain(3, 12, 7), {0.5});
  for (const AuditMode audits : {AuditMode::frames, AuditMode::events})
    expect_law(scene, {all_structures, Kernel::filtered, audits}, 2, 3);
}

TEST(ParallelRun, RunsStructuresAddedByType) {
  const Scene scene = scene_of(wandering_chain(4, 20, 9), {1.1});
  const PairsAsked asked{scene.necklaces(), true, 2, true, {}};
  ParallelRun cut(scene, {.by_default = false}, {3, 2});
  cut.add<Contacts<3>>(asked, std::vector<double>());
  std::size_t built = 0;
  EventLog log;
  cut.simulator().listen(log);  // as good as ParallelRun::listen
  cut.run([&](std::size_t frame) { built += frame == 0 ? cut.whole().built(0).size() : 0; });
  KineticRun whole(scene, {.by_default = false});
  const auto& contacts = whole.add<Contacts<3>>(asked, std::vector<double>());
  whole.build();
  EXPECT_EQ(built, contacts.pairs().size());
  EXPECT_GT(built, 0U);
  whole.run();
  EXPECT_EQ(cut.simulator().fingerprint(), whole.simulator().fingerprint());
  const std::vector<std::uint64_t>& by_kind = contacts.statistics.events_by_kind;
  EXPECT_EQ(log.events.size(), std::reduce(by_kind.begin(), by_kind.end()));
  EXPECT_FALSE(log.events.empty());
  EXPECT_EQ(cut.parts().parts, 4U);
}

TEST(ParallelRun, IsNotCutIfStatesDependOnEarlierFrames) {
  const Scene scene = scene_of(wandering_chain(4, 20, 9), {0.7});
  KineticRunOptions chords{{"wrapped"}};
  chords.settings.between = Between::chord;
  for (const KineticRunOptions& options : {chords, KineticRunOptions{{"layered"}}}) {
    ParallelRun run(scene, options, {4, 2});
    EXPECT_NE(run.uncut(), std::nullopt);
    EXPECT_EQ(run.threads(), 1U);
    std::size_t frames = 0;
    run.run([&](std::size_t frame) { EXPECT_EQ(frame, frames++); });
    EXPECT_EQ(frames, 9U);
    KineticRun whole(scene, options);
    whole.run();
    EXPECT_EQ(run.simulator().fingerprint(), whole.simulator().fingerprint());
  }
}

/// Frames of a chain, one of which cannot be read.
class FramesWithFault final : public FrameSource {
 public:
  FramesWithFault(const Trajectory& necklace, std::size_t fault)
      : frames_(std::span(&necklace, 1)), fault_(fault) {}
  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return frames_.necklaces(); }
  [[nodiscard]] bool next(FrameRead& frame) override {
    if (next_ == fault_) throw InputError("the frame is damaged");
    ++next_;
    return frames_.next(frame);
  }
  void seek(std::size_t k) override {
    frames_.seek(k);
    next_ = k;
  }

 private:
  MemoryFrames frames_;
  std::size_t fault_, next_ = 0;
};

TEST(ParallelRun, TellsAllEventsBeforeAFaultyFrame) {
  const Trajectory chain = wandering_chain(6, 20, 12);
  MemoryFrames frames(std::span(&chain, 1));
  const FrameSurvey survey = survey_frames(frames, false);
  for (const FrameMotion motion : {FrameMotion::linear, FrameMotion::hermite}) {
    for (const std::size_t fault : {1U, 5U, 6U, 11U}) {
      SCOPED_TRACE(fault);
      const auto scene = [&] {
        return Scene(std::make_unique<FramesWithFault>(chain, fault), survey, std::vector<double>(20, 0.5),
                     motion);
      };
      const Scene for_cut = scene(), for_whole = scene();
      ParallelRun cut(for_cut, {{"wrapped", "power"}}, {3, 2});
      EventLog of_cut, of_whole;
      cut.listen(of_cut);
      std::size_t cut_reached = 0, whole_reached = 0;
      EXPECT_THROW(cut.run([&](std::size_t) { ++cut_reached; }), InputError);
      KineticRun whole(for_whole, {{"wrapped", "power"}});
      whole.listen(of_whole);
      EXPECT_THROW(
          {
            whole.build();
            ++whole_reached;
            while (whole.run_step()) ++whole_reached;
          },
          InputError);
      EXPECT_EQ(cut_reached, whole_reached);
      EXPECT_EQ(of_cut.events.size(), of_whole.events.size());
    }
  }
}

TEST(ParallelRun, EndsIfItsCallerIsInterrupted) {
  struct Enough {};
  const Scene scene = scene_of(wandering_chain(7, 20, 12), {0.5});
  for (const std::size_t most : {0U, 30U, 1000U}) {
    ParallelRun run(scene, {{"wrapped"}}, {3, 2});
    std::size_t asked = 0, reached = 0;
    const InterruptionCheck check([&] {
      if (++asked > most) throw Enough();
    });
    const auto never_ends = [](KineticRun&, std::optional<std::size_t> step,
                               const std::function<void()>& work) {
      work();
      while (step && *step >= 5) InterruptionCheck::ask();
    };
    EXPECT_THROW(run.run([&](std::size_t frame) { reached = frame; }, never_ends), Enough);
    EXPECT_LT(reached, 6U);
  }
}

TEST(ParallelRun, EndsWithTheFirstExceptionOfAListenerOrStep) {
  const Scene scene = scene_of(wandering_chain(7, 20, 12), {0.5});
  ParallelRun run(scene, {{"wrapped"}}, {3, 2});
  const auto fails_late = [](KineticRun&, std::optional<std::size_t> step,
                             const std::function<void()>& work) {
    work();
    if (step && *step >= 5) throw std::runtime_error("step " + std::to_string(*step));
  };
  std::size_t reached = 0;
  try {
    run.run([&](std::size_t frame) { reached = frame; }, fails_late);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "step 5");
  }
  EXPECT_EQ(reached, 5U);
}

}  // namespace
}  // namespace kds::parallel_run_test
