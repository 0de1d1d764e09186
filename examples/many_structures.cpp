// Four structures on one set of moving beads, on one clock: an observer hears of every change as it happens
// and keeps a log, and a second run makes the logged changes again, without a certificate.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "kds/simulator.h"
#include "motions/curves/bezier_motion.h"
#include "structures/contacts/contacts.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/sorted/sorted_list.h"

namespace {

constexpr kds::BeadId beads = 40;
constexpr int steps = 3;
using Motion = kds::BezierMotion<3, 1>;  // in space, linear between two frames

/// A coil that winds up: where a bead is at a frame.
void place(kds::BeadId bead, int frame, double (&at)[3]) {
  const double angle = 0.6 * bead * (1 + 0.15 * frame), radius = 2 + 0.3 * std::sin(1.7 * bead + frame);
  at[0] = radius * std::cos(angle);
  at[1] = radius * std::sin(angle);
  at[2] = 0.45 * bead * (1 - 0.08 * frame);
}

/// Sets the motion to that from one frame to the next.
void load(Motion& motion, int step) {
  double at[3];
  for (kds::BeadId bead = 0; bead < beads; ++bead) {
    for (int end = 0; end < 2; ++end) {
      place(bead, step + end, at);
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(bead, end, axis, at[axis]);
      motion.set_radius(bead, end, 0.9);
      motion.set_weight(bead, end, 0.9 * 0.9);
    }
  }
}

/// The structures of a run, in the order in which they act.
struct Structures {
  const std::vector<kds::BeadRange> necklaces{{0, beads - 1}};
  kds::SortedList<3> sorted;
  kds::WrappedHierarchy<3> wrapped;
  kds::PowerDiagram<3> power;
  kds::Contacts<3> contacts;

  Structures(kds::Simulator& simulator, const Motion& motion)
      : sorted(simulator, motion),
        wrapped(simulator, motion, necklaces, kds::Radii::equal),
        power(simulator, motion),
        contacts(simulator, motion, {necklaces}) {}
};

/// Prints the first contacts, and keeps everything.
class Observer final : public kds::EventListener {
 public:
  void on_event(const kds::KineticStructure& structure, const kds::LoggedEvent& event) override {
    if (structure.name() == "contacts" && printed_++ < 3) {
      const std::string kind(structure.kinds()[event.change.kind].name);
      std::printf("step %d, u = %.3f: beads %u and %u %s\n", static_cast<int>(event.step), event.lower,
                  event.change.ids[0], event.change.ids[1], kind.c_str());
    }
    log.push_back(event);
  }

  std::vector<kds::LoggedEvent> log;

 private:
  int printed_ = 0;
};

}  // namespace

int main() {
  Motion motion(beads);
  load(motion, 0);
  kds::Simulator simulator;
  Structures structures(simulator, motion);
  Observer observer;
  simulator.listen(observer);
  simulator.build();
  for (int step = 0; step < steps; ++step) {
    load(motion, step);
    simulator.run_step();
  }
  simulator.finish();

  // The same structures again, led by the log; after each step they are compared with static builds.
  load(motion, 0);
  kds::Simulator replay(kds::AuditMode::frames);
  const Structures replayed(replay, motion);
  replay.build_for_replay();
  for (int step = 0; step < steps; ++step) {
    load(motion, step);
    std::vector<kds::Simulator::Replayed> events;
    for (const kds::LoggedEvent& event : observer.log)
      if (event.step == static_cast<std::size_t>(step))
        events.push_back({event.structure, event.lower, event.upper, event.change, "the log"});
    replay.replay_step(events);
  }
  std::printf("%d events, replayed: %s\n", static_cast<int>(observer.log.size()),
              replay.fingerprint() == simulator.fingerprint() ? "the same" : "others");
}
