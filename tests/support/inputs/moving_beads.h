#pragma once
// Motions for tests of structures, and helpers that run a structure on a motion and inspect it during the
// run.

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kds/known_events.h"
#include "kds/simulator.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/scene.h"

namespace kds::test {

using Space = BezierMotion<3, 1>;
using Points = std::vector<std::array<double, 3>>;

inline std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(KDS_DATA_DIR) / name;
}

/// Makes one linear step. All beads have the same weight; its value does not change any result.
inline Space moving(const Points& from, const Points& to, double weight = 0) {
  Space motion(from.size());
  for (BeadId b = 0; b < from.size(); ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      motion.set_coordinate(b, 0, axis, from[b][static_cast<std::size_t>(axis)]);
      motion.set_coordinate(b, 1, axis, to[b][static_cast<std::size_t>(axis)]);
    }
    for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weight);
  }
  return motion;
}

/// Makes the steps between consecutive frames.
inline std::vector<Space> through(const std::vector<Points>& frames) {
  std::vector<Space> steps;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) steps.push_back(moving(frames[k], frames[k + 1]));
  return steps;
}

/// Makes the steps between frames [first, last] of a trajectory, taking every `stride`-th frame, with all
/// atoms.
inline std::vector<Space> trajectory_steps(const std::string& name, std::size_t first, std::size_t last,
                                           std::size_t stride = 1) {
  ReadOptions options;
  options.frames = {first, last + 1, stride};
  const Trajectory trajectory = read_trajectory(data("trajectories/" + name), options);
  const Scene scene(std::span(&trajectory, 1), std::vector<double>(trajectory.bead_count(), 1.5));
  std::vector<Space> steps(scene.step_count(), Space(scene.bead_count()));
  for (std::size_t k = 0; k < steps.size(); ++k) scene.load(k, steps[k]);
  return steps;
}

/// Reads the only step of an instance file in data/kinetic.
template <Motion M>
M instance_motion(const std::string& name) {
  const Scene scene(read_instance(data("kinetic/" + name + ".txt")));
  M motion(scene.bead_count());
  scene.load(0, motion);
  return motion;
}

/// Makes random points with whole coordinates in [0, range). A smaller range gives more ties.
inline Points random_grid_points(std::mt19937& random, std::size_t beads, int range) {
  Points points(beads);
  for (auto& point : points) {
    for (double& x : point) x = static_cast<double>(random() % static_cast<unsigned>(range));
  }
  return points;
}

/// Records every event.
struct History final : EventListener {
  std::vector<Event> events;
  void on_event(const Event& event) override { events.push_back(event); }
  [[nodiscard]] std::vector<Event> of_step(std::size_t step) const {
    std::vector<Event> some;
    for (const Event& e : events) {
      if (e.step == step) some.push_back(e);
    }
    return some;
  }
};

/// A structure that makes no changes: it inspects the other structures at each audit.
class Witness final : public KineticStructure {
 public:
  using Look = std::function<std::optional<std::string>(const Dyadic&)>;

  Witness(Simulator& simulator, Look look) : look_(std::move(look)) { (void)simulator.add(*this); }

  [[nodiscard]] std::string_view name() const override { return "witness"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override { return {}; }
  void build() override {}
  void start_step() override {}
  void fail(unsigned, std::uint32_t) override {}
  void apply(const Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override { return look_(time); }

 private:
  Look look_;
};

/// A structure with its own simulator.
template <class Structure, Motion M>
class Rig {
 public:
  template <class... Extra>
  Rig(const M& first, AuditMode audits, Kernel kernel, const Extra&... extra)
      : motion(first), simulator(audits, kernel), structure(simulator, motion, extra...) {
    simulator.listen(history);
  }
  template <class... Extra>
  explicit Rig(const M& first, AuditMode audits = AuditMode::none, const Extra&... extra)
      : Rig(first, audits, Kernel::filtered, extra...) {}

  void run(const std::vector<M>& steps) {
    motion = steps.front();
    simulator.build();
    for (const M& next : steps) step(next);
    simulator.finish();
  }
  void run() { run({M(motion)}); }
  void step(const M& next) {
    motion = next;
    simulator.run_step();
  }
  /// Replays the changes of another run's history without certificates.
  void replay(const std::vector<M>& steps, const History& log) {
    motion = steps.front();
    KnownEvents(simulator).build_for_replay();
    for (std::size_t k = 0; k < steps.size(); ++k) {
      motion = steps[k];
      std::vector<ReplayedEvent> events;
      for (const Event& e : log.of_step(k))
        events.push_back({e.structure_index, e.lower, e.upper, e.change, ""});
      KnownEvents(simulator).replay_step(events);
    }
    simulator.finish();
  }

  [[nodiscard]] std::uint64_t external_events() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t events : structure.statistics.events_per_step) sum += events;
    return sum;
  }

  M motion;
  Simulator simulator;
  History history;
  Structure structure;
};

/// Checks that created = never failing + cancelled + failed.
inline bool books_balance(const StructureStatistics& statistics) {
  const CertificateCounts& c = statistics.certificates;
  return c.created == c.never_failing + c.cancelled + c.failed + c.touched && c.alive == 0;
}

}  // namespace kds::test
