// The state that a replay's initial elements and changes give is the state of the run:
// - at each event, what the structures themselves hold
// - at each frame, what structures built statically at the frame hold
// - backward from the last frame, the state of each frame before, down to the initial one

#include "structures/session/replay_recorder.h"
#include "kds/event_log.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "motions/readers/instance.h"
#include "motions/readers/read_trajectory.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/hard_scenes.h"
#include "tests/support/inputs/random.h"
#include "tests/support/judges/static_contacts.h"
#include "tests/support/rounds.h"

namespace kds::replay_recorder_test {
namespace {

using namespace test;

using Ids = std::vector<BeadId>;
using State = std::set<Ids>;

/// Applies changes to a set, forward or backward, and checks each of them.
class Player {
 public:
  explicit Player(const ReplayRecorder::Layer& layer) : layer_(layer), arity_(layer.layer.arity) {
    for (std::size_t i = 0; i < layer.initial.size(); i += arity_)
      EXPECT_TRUE(state.insert(ids_at(layer.initial, i)).second);
    for (std::size_t at = 0; at < layer.changes.size();) {
      starts_.push_back(at);
      at += 3 + arity_ * (layer.changes[at + 1] + layer.changes[at + 2]);
    }
    EXPECT_EQ(starts_.size(), layer.change_count);
  }
  /// Applies the changes of all events before `events`, or undoes those from there on.
  void go_to(std::size_t events) {
    for (; done_ < starts_.size() && layer_.changes[starts_[done_]] < events; ++done_)
      change(starts_[done_], false);
    for (; done_ > 0 && layer_.changes[starts_[done_ - 1]] >= events; --done_)
      change(starts_[done_ - 1], true);
  }

  State state;

 private:
  [[nodiscard]] Ids ids_at(const std::vector<std::uint32_t>& from, std::size_t place) const {
    const auto begin = from.begin() + static_cast<std::ptrdiff_t>(place);
    return {begin, begin + static_cast<std::ptrdiff_t>(arity_)};
  }
  void change(std::size_t at, bool back) {
    const std::size_t gone = layer_.changes[at + 1], all = gone + layer_.changes[at + 2];
    const auto visit = [&](bool removals) {
      for (std::size_t k = removals ? 0 : gone; k < (removals ? gone : all); ++k) {
        const Ids ids = ids_at(layer_.changes, at + 3 + arity_ * k);
        if (removals != back) {
          EXPECT_EQ(state.erase(ids), 1U);
        } else {
          EXPECT_TRUE(state.insert(ids).second);
        }
      }
    };
    visit(!back);
    visit(back);
  }

  const ReplayRecorder::Layer& layer_;
  std::size_t arity_;
  std::vector<std::size_t> starts_;
  std::size_t done_ = 0;
};

template <int Dimension>
void add_static_diagram(const Scene& scene, std::size_t frame, std::map<std::string, State>& states) {
  const auto built = static_triangulation<Dimension>(scene.centers(frame), scene.weights(frame));
  State& edges = states["edges"];
  for (const auto& cell : built.cells)
    for (std::size_t i = 0; i <= Dimension; ++i)
      for (std::size_t j = i + 1; j <= Dimension; ++j) edges.insert({cell[i], cell[j]});
  State& hidden = states["hidden"];
  for (const BeadId bead : built.hidden) hidden.insert({bead});
}

/// Returns the state of each layer at a frame, from static structures and from the dump.
std::map<std::string, State> states_at(const Scene& scene, KineticRun& run, std::size_t frame) {
  std::map<std::string, State> states;
  if (scene.dimension() == 3) {
    add_static_diagram<3>(scene, frame, states);
  } else {
    add_static_diagram<2>(scene, frame, states);
  }
  State& contacts = states["contacts"];
  for (const BeadPair& pair :
       contacts_of(scene.centers(frame), scene.radii(), PairsAsked{scene.necklaces(), true, 2, true, {}}))
    contacts.insert({pair.first, pair.second});
  State& cages = states["cages"];
  for (const DumpFile& file : run.dump(frame)) {
    if (file.ending != "wrapped.csv") continue;
    std::istringstream lines(file.text);
    std::string line;
    std::getline(lines, line);
    for (BeadId node = 0; std::getline(lines, line); ++node) {
      Ids cage{node};
      const std::size_t begin = line.find(',', line.find(',') + 1) + 1;
      std::istringstream basis(line.substr(begin, line.find(',', begin) - begin));
      for (BeadId bead = 0; basis >> bead;) cage.push_back(bead);
      cage.resize(5, no_bead);
      cages.insert(cage);
    }
  }
  return states;
}

State state_of(std::vector<ReplayElement> elements, std::size_t arity) {
  State state;
  for (const ReplayElement& element : elements)
    EXPECT_TRUE(
        state.insert(Ids(element.begin(), element.begin() + static_cast<std::ptrdiff_t>(arity))).second);
  return state;
}

/// Compares the elements that the recorder has now with those that the structures hold.
void expect_elements_of_run(const ReplayRecorder& recorder, KineticRun& run) {
  for (std::size_t s = 0; s < recorder.structures().size(); ++s) {
    const auto elements = run.running(s).replay_elements(false);
    for (std::size_t l = 0; l < elements.size(); ++l) {
      std::vector<ReplayElement> own = elements[l];
      std::sort(own.begin(), own.end());
      ASSERT_EQ(recorder.elements(s, l), own) << recorder.structures()[s].name << ", layer " << l;
    }
  }
}

/// Runs event by event. At each event compares the recorder with the structures, and at each frame with
/// static ones if the scene is in general position there. Then replays all frames forward and backward.
void expect_replay(const Scene& scene, const KineticRunOptions& options, bool general_position,
                   std::size_t least_events) {
  KineticRun run(scene, options);
  ReplayRecorder recorder(run);
  run.listen(recorder);
  EventLog log;
  run.listen(log);
  run.build();
  recorder.begin();
  using Counts = std::vector<std::size_t>;  // of events, for each structure
  std::vector<std::vector<std::map<std::string, State>>> at_frames;
  std::vector<Counts> events_at;
  const auto reach = [&](std::size_t frame) {
    Counts& counts = events_at.emplace_back();
    at_frames.emplace_back();
    for (std::size_t s = 0; s < recorder.structures().size(); ++s) {
      const ReplayRecorder::Structure& structure = recorder.structures()[s];
      counts.push_back(structure.events.count());
      std::map<std::string, State>& states = at_frames.back().emplace_back();
      const auto elements = run.running(s).replay_elements(frame == 0);
      for (std::size_t l = 0; l < structure.layers.size(); ++l)
        states[std::string(structure.layers[l].layer.name)] =
            state_of(elements[l], structure.layers[l].layer.arity);
      if (!general_position) continue;
      const auto expected = states_at(scene, run, frame);
      for (const auto& [name, state] : states) EXPECT_EQ(state, expected.at(name)) << name << ' ' << frame;
    }
  };
  reach(0);
  for (std::size_t frame = 1; frame < scene.frame_count(); ++frame) {
    while (run.enter_step()) {
      const bool more = run.simulator().run_next();
      ASSERT_NO_FATAL_FAILURE(expect_elements_of_run(recorder, run)) << "before frame " << frame;
      if (!more) break;
    }
    ASSERT_TRUE(run.run_step());
    recorder.reach_frame();
    reach(frame);
  }

  std::size_t events = 0, own_events = 0;
  for (std::size_t s = 0; s < recorder.structures().size(); ++s) {
    const ReplayRecorder::Structure& structure = recorder.structures()[s];
    events += structure.events.count();
    for (const std::uint8_t kind : structure.events.kind)
      own_events += kind < run.structures()[s]->kinds().size() ? 1 : 0;
    EXPECT_TRUE(std::is_sorted(structure.events.step.begin(), structure.events.step.end()));
    for (const ReplayRecorder::Layer& layer : structure.layers) {
      Player player(layer);
      const std::string name(layer.layer.name);
      const auto expect_frame = [&](std::size_t frame) {
        player.go_to(events_at[frame][s]);
        ASSERT_EQ(player.state, at_frames[frame][s].at(name)) << name << " at " << frame;
      };
      for (std::size_t frame = 0; frame < scene.frame_count(); ++frame) expect_frame(frame);
      for (std::size_t frame = scene.frame_count(); frame-- > 0;) expect_frame(frame);
    }
  }
  EXPECT_EQ(own_events, log.events.size());
  EXPECT_GE(events, least_events);
}

const KineticRunOptions three{{"wrapped", "power", "contacts"}};

Scene wandering_scene(int dimension, std::uint64_t seed, FrameMotion motion) {
  Random random(seed);
  const std::size_t beads = 24, frames = 5;
  Trajectory necklace;
  for (std::size_t f = 0; f < frames; ++f) {
    Eigen::Matrix3Xd positions = f == 0 ? Eigen::Matrix3Xd::Zero(3, beads) : necklace.frames.back();
    for (Eigen::Index b = 0; b < positions.cols(); ++b)
      for (int axis = 0; axis < dimension; ++axis)
        positions(axis, b) += uniform(random, 0, f == 0 ? 4 : 1) - (f == 0 ? 0 : 0.5);
    necklace.frames.push_back(positions);
  }
  std::vector<double> radii(beads);
  for (double& radius : radii) radius = uniform(random, 0.1, 1.2);
  return {{&necklace, 1}, radii, motion};
}

class RecordedIn : public testing::TestWithParam<std::pair<int, FrameMotion>> {};

TEST_P(RecordedIn, RandomScenes) {
  const auto [dimension, motion] = GetParam();
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expect_replay(wandering_scene(dimension, seed, motion), three, true, 100);
}
INSTANTIATE_TEST_SUITE_P(ReplayRecorder, RecordedIn,
                         testing::Values(std::pair(2, FrameMotion::linear), std::pair(3, FrameMotion::linear),
                                         std::pair(2, FrameMotion::hermite),
                                         std::pair(3, FrameMotion::hermite)));

TEST(ReplayRecorder, KeepsChangesOfTiesRepairsAndRebuilds) {
  std::size_t rebuilds = 0;
  for (std::uint64_t seed = 1; seed <= rounds(40U, 8U); ++seed) {
    const auto lattice = lattice_balls(seed);
    const Scene scene({&lattice.necklace, 1}, lattice.radii);
    SCOPED_TRACE(seed);
    try {
      KineticRun run(scene, three);
      run.finish();
      rebuilds += run.structures()[1]->statistics.rebuilds;
    } catch (const InputError&) {
      continue;  // too many ties for a power diagram
    }
    expect_replay(scene, three, false, 0);
  }
  EXPECT_GT(rebuilds, rounds(10U));
}

TEST(ReplayRecorder, KeepsDegenerateInstances) {
  std::vector<const char*> names{"d2_n64_swap", "w3_n64_half", "d3_n64_gridrand", "d3_n64_swap"};
  names.resize(rounds(4U, 2U));
  for (const char* name : names) {
    SCOPED_TRACE(name);
    const Scene scene(read_instance(std::string(KDS_DATA_DIR) + "/kinetic/degenerate_" + name + ".txt"));
    expect_replay(scene, {{"power"}}, false, 10);
  }
}

TEST(ReplayRecorder, KeepsAProtein) {
  ReadOptions reading;
  reading.frames.last = 12;
  const Trajectory villin =
      read_trajectory(std::string(KDS_DATA_DIR) + "/trajectories/villin_hp36_300K.dcd", reading);
  const Scene scene({&villin, 1}, std::vector<double>(villin.bead_count(), 1.9));
  expect_replay(scene, three, true, 500);
}

TEST_P(RecordedIn, PointsAndBoxesOfRandomScenes) {
  const auto [dimension, motion] = GetParam();
  KineticRunOptions options{{"sorted", "box", "closest", "boxes"}};
  if (dimension == 2) options.structures.push_back("hull");
  expect_replay(wandering_scene(dimension, 1, motion), options, false, 100);
}

TEST(ReplayRecorder, KeepsSpheresOnCurves) {
  const Scene scene = wandering_scene(3, 1, FrameMotion::hermite);
  KineticRun run(scene, {{"layered"}});
  ReplayRecorder recorder(run);
  run.listen(recorder);
  run.build();
  recorder.begin();
  const ReplayRecorder::Structure& structure = recorder.structures()[0];
  const std::size_t nodes = structure.sphere_nodes.size();
  EXPECT_EQ(nodes, structure.nodes.size());
  for (std::size_t frame = 1; run.run_step(); ++frame) {
    recorder.reach_frame();
    ASSERT_EQ(structure.spheres.size(), nodes * (1 + 3 * frame));  // three control points a step
    const std::vector<NodeSphere> expected = run.running(0).spheres_at(Dyadic(1.0));
    for (std::size_t k = 0; k < nodes; ++k) {
      const auto& sphere = structure.spheres[structure.spheres.size() - nodes + k];
      EXPECT_NEAR(sphere[0], expected[k].sphere.center[0], 1e-4);
      EXPECT_NEAR(sphere[3], expected[k].sphere.radius, 1e-4);
    }
  }
}

TEST(ReplayRecorder, MustBeBegun) {
  const Scene scene = wandering_scene(2, 1, FrameMotion::linear);
  KineticRun run(scene, {{"hull", "boxes"}});
  ReplayRecorder recorder(run);
  run.listen(recorder);
  EXPECT_THROW(run.finish(), std::logic_error);  // begin() was not called
  EXPECT_THROW(static_cast<void>(recorder.elements(2, 0)), std::invalid_argument);
}

TEST(ReplayRecorder, KeepsTheDualComplex) {
  for (const int dimension : {2, 3}) {
    const Scene scene = wandering_scene(dimension, 2, FrameMotion::linear);
    KineticRun run(scene, {{"dual"}});
    ReplayRecorder recorder(run);
    run.listen(recorder);
    run.build();
    recorder.begin();
    expect_elements_of_run(recorder, run);
    std::size_t events = 0;
    for (; run.next_event() && events < 200; ++events) expect_elements_of_run(recorder, run);
    EXPECT_EQ(events, 200U);
  }
}

TEST(ReplayRecorder, RecordsEditsOfBeads) {
  const Scene scene = wandering_scene(3, 4, FrameMotion::linear);
  KineticRun run(scene, {{"sorted", "box", "closest", "boxes", "power", "contacts"}});
  ReplayRecorder recorder(run);
  run.listen(recorder);
  run.build();
  recorder.begin();
  run.go_to(0.5);
  for (std::size_t s = 0; s < recorder.structures().size(); ++s) {
    for (const BeadId bead : {3U, 11U, 17U}) run.erase(s, bead);
    expect_elements_of_run(recorder, run);
    for (const BeadId bead : {11U, 3U}) run.insert(s, bead);
    expect_elements_of_run(recorder, run);
  }
  run.go_to(1.25);
  recorder.reach_frame();
  expect_elements_of_run(recorder, run);
}

}  // namespace
}  // namespace kds::replay_recorder_test
