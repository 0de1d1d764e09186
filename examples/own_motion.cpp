// A user-defined motion: a screw, which is a rotation about an axis and a translation along it. A screw is
// not a polynomial curve. Cubic Hermite interpolation matches the screw's positions and velocities at both
// ends of a step, and error() bounds the distance between the two curves.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "kds/simulator.h"
#include "motions/curves/motion.h"
#include "structures/contacts/contacts.h"

namespace {

/// Beads that turn by `angle` about the z axis and rise by `rise` in each step.
class ScrewMotion {
 public:
  static constexpr int dimension = 3;
  static constexpr int degree = 3;

  struct Bead {
    double distance, phase, height;  ///< distance from the axis, angle about the axis, height along the axis
    bool turns;                      ///< false: the bead rests
  };

  ScrewMotion(std::vector<Bead> beads, double angle, double rise, double radius)
      : beads_(std::move(beads)), angle_(angle), rise_(rise), curves_(beads_.size()) {
    for (Curve& curve : curves_) std::fill(std::begin(curve.radius), std::end(curve.radius), radius);
  }

  // Members that the Motion concept requires (motions/curves/motion.h). A weight follows each control point;
  // no structure here reads the weights.
  [[nodiscard]] std::size_t bead_count() const { return curves_.size(); }
  [[nodiscard]] const double* control_point(kds::BeadId bead, int k) const { return curves_[bead].point[k]; }
  [[nodiscard]] double coordinate(kds::BeadId bead, int k, int axis) const {
    return curves_[bead].point[k][axis];
  }
  [[nodiscard]] double weight(kds::BeadId bead, int k) const { return curves_[bead].point[k][3]; }
  [[nodiscard]] const double* radii(kds::BeadId bead) const { return curves_[bead].radius; }
  [[nodiscard]] double radius(kds::BeadId bead, int k) const { return curves_[bead].radius[k]; }

  /// Computes the cubics of a step: a cubic with ends p and q and velocities v and w there has the control
  /// points p, p + v/3, q - w/3, q.
  void load(int step) {
    for (std::size_t b = 0; b < beads_.size(); ++b) {
      const Bead& bead = beads_[b];
      for (int end = 0; end < 2; ++end) {
        const double turned = bead.turns ? angle_ : 0, u = step + end, phase = bead.phase + turned * u;
        const double at[3] = {bead.distance * std::cos(phase), bead.distance * std::sin(phase),
                              bead.height + (bead.turns ? rise_ * u : 0)};
        const double velocity[3] = {-turned * at[1], turned * at[0], bead.turns ? rise_ : 0};
        for (int axis = 0; axis < 3; ++axis) {
          curves_[b].point[3 * end][axis] = at[axis];
          curves_[b].point[1 + end][axis] = at[axis] + (end == 0 ? 1 : -1) * velocity[axis] / 3;
        }
      }
    }
  }

  /// Returns an upper bound of the distance between a bead and its screw at any time: the error of cubic
  /// Hermite interpolation is at most the fourth derivative, distance * angle^4, divided by 384. Rounding
  /// adds about 1e-16 of the coordinates.
  [[nodiscard]] double error() const {
    double farthest = 0;
    for (const Bead& bead : beads_) farthest = std::max(farthest, bead.distance);
    return farthest * std::pow(angle_, 4) / 384;
  }

  /// Measures the largest distance between the beads and their screws at sampled times of the loaded step.
  [[nodiscard]] double measured_error(int step) const {
    double largest = 0;
    for (std::size_t b = 0; b < beads_.size(); ++b) {
      const Bead& bead = beads_[b];
      for (double u = 0; u <= 1; u += 0x1p-10) {
        const double v = 1 - u, phase = bead.phase + (bead.turns ? angle_ * (step + u) : 0);
        const double on_screw[3] = {bead.distance * std::cos(phase), bead.distance * std::sin(phase),
                                    bead.height + (bead.turns ? rise_ * (step + u) : 0)};
        double squared = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const auto p = [&](int k) { return curves_[b].point[k][axis]; };
          const double at = v * v * v * p(0) + 3 * v * v * u * p(1) + 3 * v * u * u * p(2) + u * u * u * p(3);
          squared += (at - on_screw[axis]) * (at - on_screw[axis]);
        }
        largest = std::max(largest, std::sqrt(squared));
      }
    }
    return largest;
  }

 private:
  struct Curve {
    // Beads are equally spaced in memory, and the control points of a bead are contiguous.
    double point[4][4] = {};
    double radius[4] = {};
  };
  std::vector<Bead> beads_;
  double angle_, rise_;
  std::vector<Curve> curves_;
};

static_assert(kds::Motion<ScrewMotion>);

}  // namespace

int main() {
  // A thread of 24 beads moves on screws past four beads at rest.
  std::vector<ScrewMotion::Bead> bead_list;
  for (int i = 0; i < 24; ++i) bead_list.push_back({3.0, 0.5 * i, 0.35 * i, true});
  for (int i = 0; i < 4; ++i) bead_list.push_back({4.7, 0.3 + 1.6 * i, 5.1, false});
  constexpr double pi = 3.14159265358979323846;
  ScrewMotion motion(bead_list, pi / 12, 0.35 * pi / 6, 1.0);

  motion.load(0);
  kds::Simulator simulator(kds::AuditMode::events);
  kds::Contacts<3> contacts(simulator, motion, {{{0, 23}, {24, 27}}, /*within=*/false});
  simulator.build();
  double measured = 0;
  for (int step = 0; step < 24; ++step) {  // one turn
    motion.load(step);
    measured = std::max(measured, motion.measured_error(step));
    simulator.run_step();
  }
  simulator.finish();
  std::printf("distance from a screw: at most %.2g stated, %s\n", motion.error(),
              measured <= motion.error() ? "kept" : "broken");
  std::printf("contacts: %d begin, %d end, %d touch\n",
              static_cast<int>(contacts.statistics.events_by_kind[0]),
              static_cast<int>(contacts.statistics.events_by_kind[1]),
              static_cast<int>(contacts.statistics.events_by_kind[2]));
}
