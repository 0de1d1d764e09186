#pragma once
// Updates of a power diagram by motion (diagram_update.h): all beads in time order, or only those that have
// to move.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/curves/snapshot.h"
#include "structures/power_diagram/diagram_update.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/snapshot_faults.h"

namespace kds {

/// A power diagram on a clock of its own that goes from frame to frame.
template <Motion M>
class MovingDiagram : public DiagramUpdate<M::dimension> {
 public:
  static constexpr int dimension = M::dimension;

  MovingDiagram();
  ~MovingDiagram() override;
  void build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
  [[nodiscard]] StaticTriangulation<dimension> diagram() const override;
  [[nodiscard]] std::optional<std::string> fault() const override;

 protected:
  /// All beads move, in one step.
  void move_all(const Eigen::Matrix3Xd& centers, std::span<const double> weights, UpdateCounts& counts);
  /// The same, but given up, and false, where many more events come than a rebuild takes time for: it is to
  /// be rebuilt then.
  [[nodiscard]] bool try_to_move_all(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                     UpdateCounts& counts);
  /// Only beads that must, in as many steps as it takes. Falls back on move_all where cells are flat or
  /// missing, and where most beads would have to move at once.
  void move_some(const Eigen::Matrix3Xd& centers, std::span<const double> weights, UpdateCounts& counts);
  void rebuild(const Eigen::Matrix3Xd& centers, std::span<const double> weights, UpdateCounts& counts);
  [[nodiscard]] RegularTriangulation<dimension>& triangulation();
  [[nodiscard]] bool is_solid() const;
  [[nodiscard]] std::size_t bead_count() const;

 private:
  struct Machine;  // the diagram takes long to compile: in one file

  void load(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void set_end(BeadId bead, const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void rest_at_end(BeadId bead);
  void run_step(UpdateCounts& counts);
  void add_up(UpdateCounts& counts);
  void activate(const SnapshotFaults& faults, std::vector<char>& moves) const;
  void hidden_that_show(const Snapshot<dimension>& next, std::vector<char>& moves);
  void house_hidden(const Snapshot<dimension>& next);

  std::unique_ptr<Machine> machine_;
};

template <Motion M>
class KineticUpdate final : public MovingDiagram<M> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
};

template <int Dimension>
class Activation final : public MovingDiagram<BezierMotion<Dimension, 1>> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
};

/// What it has seen fail counts the less the longer ago: motion goes on much as before, and a sample of one
/// frame is small.
template <int Dimension>
class AutomaticUpdate final : public MovingDiagram<BezierMotion<Dimension, 1>> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;

 private:
  double tested_ = 0, failed_ = 0;
  unsigned skip_ = 0, next_skip_ = 0, skip_after_giving_up_ = 0;  // updates without a sample
  std::uint64_t samples_ = 0;
};

extern template class MovingDiagram<BezierMotion<2, 1>>;
extern template class MovingDiagram<BezierMotion<3, 1>>;
extern template class MovingDiagram<LiftedMotion<2>>;
extern template class MovingDiagram<LiftedMotion<3>>;

}  // namespace kds
