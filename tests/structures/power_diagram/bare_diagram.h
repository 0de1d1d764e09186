#pragma once
// Gives tests access to the parts of a power diagram: a structure that is built and, in a step, does only
// what the test asks of its parts.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/diagram_checks.h"
#include "structures/power_diagram/diagram_editor.h"
#include "structures/power_diagram/diagram_flips.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::test {

template <int Dimension>
class BareDiagram final : public KineticStructure {
 public:
  using Events = DiagramEvents<Dimension>;

  BareDiagram(Simulator& simulator, const MotionRef<Dimension>& motion)
      : state(simulator, motion, *this, simulator.add(*this)),
        facets(state),
        hidden(state),
        flips(state, facets, hidden),
        rebuilder(state, facets, hidden),
        editor(state, facets, hidden, rebuilder) {}

  [[nodiscard]] std::string_view name() const override { return "bare"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override { return Events::all_kinds(); }
  void build() override { rebuilder.build_from_control_points(0); }
  void start_step() override {
    state.curves = state.motion.curves();
    state.triangulation.make_mirror();
    facets.start_step();
    hidden.start_step();
    rebuilder.start_step();
    state.within_step = true;
  }
  void fail(unsigned table, std::uint32_t slot) override {
    failed.emplace_back(table, slot);
    if (flipping) flips.fail(table, slot);
  }
  void after_batch() override { rebuilder.after_batch(); }
  void apply(const Change& change) override { flips.apply(change); }
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override {
    return audit_of(state, time);
  }

  /// Returns the number of certificates that count as alive: one for each facet, and dimension + 2 for each
  /// hidden bead.
  [[nodiscard]] std::uint64_t expected_alive() const {
    return state.triangulation.live_count() * (Dimension + 1) / 2 + state.hidden.size() * (Dimension + 2);
  }
  /// Returns the number of certificates with a failure in the queue.
  [[nodiscard]] std::size_t waiting() const {
    std::size_t count = 0;
    const auto look = [&](const auto&, CertificateHandle handle) {
      count += has_slot(handle) ? 1 : 0;
      return true;
    };
    static_cast<void>(facets.all_of(look) && hidden.all_of(look));
    return count;
  }

  DiagramState<Dimension> state;
  FacetCertificates<Dimension> facets;
  HiddenCertificates<Dimension> hidden;
  DiagramFlips<Dimension> flips;
  DiagramRebuilder<Dimension> rebuilder;
  DiagramEditor<Dimension> editor;
  bool flipping = true;
  std::vector<std::pair<unsigned, std::uint32_t>> failed;
};

template <int Dimension>
using BareRig = Rig<BareDiagram<Dimension>, BezierMotion<Dimension, 1>>;

/// Makes random beads in a square or cube, some of them so heavy that they hide others. Each bead moves by up
/// to `step`.
template <int Dimension>
BezierMotion<Dimension, 1> random_beads(unsigned seed, BeadId beads, double step, double heaviest = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere(0, 1), move(-step, step);
  BezierMotion<Dimension, 1> motion(beads);
  for (BeadId b = 0; b < beads; ++b) {
    for (int axis = 0; axis < Dimension; ++axis) {
      motion.set_coordinate(b, 0, axis, anywhere(random));
      motion.set_coordinate(b, 1, axis, motion.coordinate(b, 0, axis) + move(random));
    }
    const double weight = b % 5 == 0 ? heaviest : 0;
    for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weight);
  }
  return motion;
}

}  // namespace kds::test
