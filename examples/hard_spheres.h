#pragma once
// Event-driven hard spheres: balls of diameter and mass 1 fly in a periodic cube and collide elastically. An
// example of a simulation that changes the course of beads at the exact times of events.
//
// Exact: in a step, each ball has a flight plan, the straight line between two points in doubles. Contacts
// finds the exact times at which balls of the plan meet, so no collision is missed, and their order is right.
//
// Rounded: after a collision, two balls follow new lines. Their velocities and first points are rounded to
// doubles. The points are put 1 + 1e-12 apart. The gap exceeds all rounding errors while coordinates are
// below 1000, so no line begins with an overlap. Only +, -, *, /, sqrt and round are used, and never fused
// (kds sets -ffp-contract=off). IEEE 754 rounds them alike on all machines, so each machine finds the same
// events.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <vector>

#include "kds/simulator.h"
#include "motions/curves/bezier_motion.h"
#include "structures/contacts/contacts.h"

class HardSpheres {
 public:
  using Vector = Eigen::Vector3d;

  /// Makes 4 * side^3 balls in a face-centred cubic lattice, with random velocities whose sum is 0, but for
  /// rounding. Packing is the balls' share of the volume. The speed of a run depends on the duration of a
  /// step.
  HardSpheres(int side, double packing, double duration, kds::Kernel kernel = kds::Kernel::filtered)
      : duration_(duration),
        velocities_(side < 2
                        ? throw std::invalid_argument("the side of the lattice: expected 2 cells or more")
                        : std::size_t{4} * side * side * side),
        motion_(count()),
        simulator_(kds::AuditMode::none, kernel) {
    if (!(packing > 0 && packing < 0.74))
      throw std::invalid_argument("the packing: expected a number between 0 and 0.74");
    const double n = static_cast<double>(count()), volume = n * 0.52359877559829887308 / packing;  // pi / 6
    for (int k = 0; k < 100; ++k) edge_ = (2 * edge_ + volume / (edge_ * edge_)) / 3;  // Newton's cube root
    motion_.own_cell().set(kds::Cell::Identity() * edge_, kds::Cell::Identity() * edge_, 1);
    std::mt19937_64 random(1);
    Vector sum = Vector::Zero();
    for (Vector& v : velocities_) {
      for (double& x : v) x = static_cast<double>(random() >> 11U) * 0x1p-52 - 1;
      sum += v;
    }
    kds::BeadId ball = 0;
    for (int x = 0; x < 2 * side; ++x)
      for (int y = 0; y < 2 * side; ++y)
        for (int z = (x + y) % 2; z < 2 * side; z += 2, ++ball) {
          velocities_[ball] -= sum / n;
          fly(ball, Vector(x, y, z) * (edge_ / (2 * side)), 0);
        }
    contacts_.emplace(simulator_, motion_, kds::PairsAsked{{{0, ball - 1}}, /*within=*/true, /*apart=*/1},
                      std::vector<double>(count(), 0.5));
    simulator_.build();
  }

  /// Runs the step whose lines are in the motion, and makes the lines of the next.
  void step() {
    simulator_.enter_step();
    do collide_now();
    while (simulator_.run_next());
    simulator_.leave_step();
    time += duration_;
    for (kds::BeadId i = 0; i < count(); ++i) fly(i, place(i, 1), 0);
  }
  [[nodiscard]] double energy() const {
    double sum = 0;
    for (const Vector& v : velocities_) sum += dot(v, v) / 2;
    return sum;
  }
  [[nodiscard]] std::size_t count() const { return velocities_.size(); }
  [[nodiscard]] const std::vector<Vector>& velocities() const { return velocities_; }
  [[nodiscard]] const kds::BezierMotion<3, 1>& motion() const { return motion_; }
  [[nodiscard]] const kds::Simulator& simulator() const { return simulator_; }

  std::size_t collisions = 0;
  double time = 0;    ///< at the end of the last step
  double virial = 0;  ///< sum over all collisions of the momentum that passes from ball to ball
  /// Called after each collision, while both balls are at its place.
  std::function<void(kds::BeadId, kds::BeadId)> on_collision = [](kds::BeadId, kds::BeadId) {};

 private:
  /// Adds in the same order with all versions of Eigen.
  static double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  /// Lets a ball follow the line that passes through a point at time u of the step.
  void fly(kds::BeadId i, const Vector& point, double u) {
    const Vector way = duration_ * velocities_[i], start = point - u * way, end = point + (1 - u) * way;
    if (!(start.cwiseAbs().maxCoeff() < 1000 && end.cwiseAbs().maxCoeff() < 1000))
      throw std::range_error("a ball is 1000 diameters from the origin, where rounding could make overlaps");
    for (int k = 0; k < 3; ++k) {
      motion_.set_coordinate(i, 0, k, start[k]);
      motion_.set_coordinate(i, 1, k, end[k]);
    }
  }
  [[nodiscard]] Vector place(kds::BeadId i, double u) const {
    return (1 - u) * Vector::Map(motion_.control_point(i, 0)) + u * Vector::Map(motion_.control_point(i, 1));
  }
  /// Returns the vector at time u from ball j to the image of ball i that is nearest at time `when`.
  [[nodiscard]] Vector between(kds::BeadId i, kds::BeadId j, double u, double when) const {
    Vector way = place(i, u) - place(j, u);
    const Vector apart = place(i, when) - place(j, when);
    for (int k = 0; k < 3; ++k) way[k] -= edge_ * std::round(apart[k] / edge_);
    return way;
  }
  /// Returns the present time in the step, rounded, at which two balls meet. The bracket of `now()` depends
  /// on the kernel.
  [[nodiscard]] double meeting_time(kds::BeadId i, kds::BeadId j) const {
    const double near = simulator_.now().lower();
    const Vector start = between(i, j, 0, near), way = between(i, j, 1, near) - start;
    const double a = dot(way, way), b = dot(start, way), c = dot(start, start) - 1;  // a u^2 + 2 b u + c = 0
    return std::max(0.0, c / (std::sqrt(std::max(0.0, b * b - a * c)) - b));
  }
  void collide_now() {
    std::optional<double> u;
    for (auto pairs = contacts_->pairs(); !pairs.empty(); pairs = contacts_->pairs()) {
      const auto [i, j] = pairs.front();
      if (!u) u = meeting_time(i, j);
      collide(i, j, *u);
    }
  }
  void collide(kds::BeadId i, kds::BeadId j, double u) {
    const Vector way = between(i, j, u, u);
    const double distance = std::sqrt(dot(way, way));
    const Vector normal = way / distance, push = (1 + 1e-12 - distance) / 2 * normal;
    const double approach = std::min(0.0, dot(velocities_[i], normal) - dot(velocities_[j], normal));
    velocities_[i] -= approach * normal;
    velocities_[j] += approach * normal;
    const Vector a = place(i, u) + push, b = place(j, u) - push;
    simulator_.change_motion(std::array{i, j}, [&] {
      fly(i, a, u);
      fly(j, b, u);
    });
    ++collisions;
    virial -= approach;
    on_collision(i, j);
  }

  double duration_, edge_ = 1;
  std::vector<Vector> velocities_;
  kds::BezierMotion<3, 1> motion_;
  kds::Simulator simulator_;
  std::optional<kds::Contacts<3>> contacts_;
};
