// Runs four structures on one set of moving beads and one clock. A listener is notified of every change as it
// happens and a log records every change. A second run repeats the logged changes without certificates.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "kds/event_log.h"
#include "kds/known_events.h"
#include "motions/curves/bezier_motion.h"
#include "structures/session/kinetic_run.h"

namespace {

constexpr kds::BeadId beads = 40;
constexpr int steps = 3;
using Motion = kds::BezierMotion<3, 1>;  // in space, linear between two frames

/// Computes the position of a bead of a coil that winds up, at a frame.
void set_position(kds::BeadId bead, int frame, double (&at)[3]) {
  const double angle = 0.6 * bead * (1 + 0.15 * frame), radius = 2 + 0.3 * std::sin(1.7 * bead + frame);
  at[0] = radius * std::cos(angle);
  at[1] = radius * std::sin(angle);
  at[2] = 0.45 * bead * (1 - 0.08 * frame);
}

/// Loads the motion from frame `step` to the next frame.
void load(Motion& motion, int step) {
  double at[3];
  for (kds::BeadId bead = 0; bead < beads; ++bead) {
    for (int end = 0; end < 2; ++end) {
      set_position(bead, step + end, at);
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(bead, end, axis, at[axis]);
      motion.set_radius(bead, end, 0.9);
      motion.set_weight(bead, end, 0.9 * 0.9);
    }
  }
}

/// Prints the first contacts.
class Observer final : public kds::EventListener {
 public:
  void on_event(const kds::Event& event) override {
    if (event.structure != "contacts" || printed_++ >= 3) return;
    std::printf("step %d, u = %.3f: beads %u and %u %s\n", static_cast<int>(event.step), event.lower,
                event.ids()[0], event.ids()[1], std::string(event.kind.name).c_str());
  }

 private:
  int printed_ = 0;
};

}  // namespace

int main() {
  Motion motion(beads);
  load(motion, 0);
  const kds::KineticRunOptions options{.structures = {"sorted", "wrapped", "power", "contacts"}};
  kds::KineticRun run(motion, {.radii = {0.9}}, options);
  Observer observer;
  kds::EventLog log;
  run.listen(observer);
  run.listen(log);
  for (int step = 0; step < steps; ++step) {
    load(motion, step);
    run.run_step();
  }
  run.finish();

  // Replays the log on the same four structures and compares them with static builds after each step.
  load(motion, 0);
  kds::KineticRunOptions audited = options;
  audited.audits = kds::AuditMode::frames;
  kds::KineticRun again(motion, {.radii = {0.9}}, audited);
  kds::KnownEvents replay(again.simulator());
  replay.build_for_replay();
  for (int step = 0; step < steps; ++step) {
    load(motion, step);
    std::vector<kds::ReplayedEvent> events;
    for (const kds::Event& event : log.events)
      if (event.step == static_cast<std::size_t>(step))
        events.push_back({event.structure_index, event.lower, event.upper, event.change, "the log"});
    replay.replay_step(events);
  }
  std::printf("%d events, replayed: %s\n", static_cast<int>(log.events.size()),
              again.simulator().fingerprint() == run.simulator().fingerprint() ? "the same" : "others");
}
