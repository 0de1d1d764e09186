// A simulation of one's own, a chain of springs that falls on a peg: it hands over one frame after the other,
// nothing is stored, and when beads meet the peg and part from it is known as it happens, between frames,
// too.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "kds/simulator.h"
#include "motions/curves/bezier_motion.h"
#include "structures/contacts/contacts.h"

namespace {

constexpr kds::BeadId links = 12, peg = links;  // the peg is the last bead, and rests
constexpr double time_step = 0.01, radius = 0.3;
using Positions = std::array<std::array<double, 2>, links + 1>;

/// Knows nothing of kds.
class SpringChain {
 public:
  SpringChain() {
    for (kds::BeadId i = 0; i < links; ++i) at_[i] = {0.7 * i - 2.9, 2.0};
    at_[peg] = {0.1, 0.0};
  }
  [[nodiscard]] const Positions& positions() const { return at_; }

  void advance() {
    std::array<std::array<double, 2>, links> force{};
    for (kds::BeadId i = 0; i < links; ++i) {
      force[i] = {0, -1};
      push_apart(force[i], at_[i], at_[peg], 2.2 * radius, 60);  // the peg is soft
      if (i > 0) pull_together(force[i], at_[i], at_[i - 1]);
      if (i + 1 < links) pull_together(force[i], at_[i], at_[i + 1]);
    }
    for (kds::BeadId i = 0; i < links; ++i) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        velocity_[i][axis] = 0.999 * (velocity_[i][axis] + time_step * force[i][axis]);
        at_[i][axis] += time_step * velocity_[i][axis];
      }
    }
  }

 private:
  using Vector = std::array<double, 2>;
  static void pull_together(Vector& force, const Vector& from, const Vector& to) {
    add_spring(force, from, to, 0.7, 200);
  }
  static void push_apart(Vector& force, const Vector& from, const Vector& to, double reach, double strength) {
    const double x = to[0] - from[0], y = to[1] - from[1];
    if (x * x + y * y < reach * reach) add_spring(force, from, to, reach, strength);
  }
  static void add_spring(Vector& force, const Vector& from, const Vector& to, double length,
                         double strength) {
    const double x = to[0] - from[0], y = to[1] - from[1], distance = std::sqrt(x * x + y * y);
    const double share = strength * (distance - length) / distance;
    force[0] += share * x;
    force[1] += share * y;
  }

  Positions at_{};
  std::array<Vector, links> velocity_{};
};

/// Tells of contacts as they happen.
class Reporter final : public kds::EventListener {
 public:
  void on_event(const kds::KineticStructure& structure, const kds::LoggedEvent& event) override {
    const double time = time_step * (static_cast<double>(event.step) + event.lower);
    const std::string kind(structure.kinds()[event.change.kind].name);
    std::printf("%.4f: bead %u and the peg, contacts %s\n", time, event.change.ids[0], kind.c_str());
  }
};

}  // namespace

int main() {
  SpringChain chain;
  kds::BezierMotion<2, 1> motion(links + 1);  // straight lines from one frame to the next
  const auto set = [&](int end) {
    for (kds::BeadId bead = 0; bead <= peg; ++bead) {
      for (int axis = 0; axis < 2; ++axis)
        motion.set_coordinate(bead, end, axis, chain.positions()[bead][static_cast<std::size_t>(axis)]);
      motion.set_radius(bead, end, radius);
    }
  };
  set(0);
  set(1);
  kds::Simulator simulator;
  kds::Contacts<2> contacts(simulator, motion, {{{0, links - 1}, {peg, peg}}, /*within=*/false});
  Reporter reporter;
  simulator.listen(reporter);
  simulator.build();
  for (int frame = 1; frame <= 600; ++frame) {
    set(0);  // where the step before ended
    chain.advance();
    set(1);
    simulator.run_step();
  }
  simulator.finish();
  std::printf("%d contacts now\n", static_cast<int>(contacts.pairs().size()));
}
