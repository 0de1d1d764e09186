// A user's own simulation: a chain of springs falls on a peg. The simulation pushes one frame after another,
// and no frame is stored. Contacts between beads and the peg are reported as they begin and end, also between
// frames.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "structures/contacts/contacts.h"
#include "structures/session/kinetic_run.h"

namespace {

constexpr kds::BeadId links = 12, peg = links;  // the last bead is the peg, which rests
constexpr double time_step = 0.01, radius = 0.3;
/// The simulation itself, which does not depend on kds.
class SpringChain {
 public:
  SpringChain() {
    for (kds::BeadId i = 0; i < links; ++i) at_[i] = {0.7 * i - 2.9, 2.0};
    at_[peg] = {0.1, 0.0};
  }
  [[nodiscard]] std::vector<double> coordinates() const {
    std::vector<double> all;
    for (const Vector& v : at_) all.insert(all.end(), v.begin(), v.end());
    return all;
  }

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

  std::array<Vector, links + 1> at_{};
  std::array<Vector, links> velocity_{};
};

/// Prints contacts as they begin and end.
class Reporter final : public kds::EventListener {
 public:
  void on_event(const kds::Event& event) override {
    const std::string kind(event.kind.name);
    std::printf("%.4f: bead %u and the peg, contacts %s\n", time_step * event.frame(), event.ids()[0],
                kind.c_str());
  }
  [[nodiscard]] bool prints_time_of(const kds::Event&) const override { return true; }
};

}  // namespace

int main() {
  SpringChain chain;
  kds::KineticRun run({.dimension = 2, .necklaces = {links, 1}, .radii = {radius}}, {.by_default = false});
  const auto& contacts =
      run.add<kds::Contacts<2>>(kds::PairsAsked{run.scene().necklaces(), /*within=*/false});
  Reporter reporter;
  run.listen(reporter);
  run.push(chain.coordinates());
  for (int frame = 1; frame <= 600; ++frame) {
    chain.advance();
    run.push(chain.coordinates());
  }
  run.finish();
  std::printf("%d contacts now\n", static_cast<int>(contacts.pairs().size()));
}
