#pragma once
// Updates of a power diagram by motion (diagram_update.h): all beads move in time order, or only the beads
// that must.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/base/back_off.h"
#include "motions/curves/snapshot.h"
#include "structures/power_diagram/diagram_update.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

/// The motion of beads between frames.
enum class UpdateMotion : std::uint8_t { linear, lifted };

/// A power diagram with a simulator of its own that moves from frame to frame.
template <int Dimension>
class MovingDiagram : public DiagramUpdate<Dimension> {
 public:
  explicit MovingDiagram(UpdateMotion motion = UpdateMotion::linear);
  ~MovingDiagram() override;
  void build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
  [[nodiscard]] StaticTriangulation<Dimension> diagram() const override;
  [[nodiscard]] std::optional<std::string> fault() const override;

 protected:
  /// Moves all beads in one step.
  void move_all(const Eigen::Matrix3Xd& centers, std::span<const double> weights, UpdateCounts& counts);
  /// Like move_all, but gives up and returns false if handling the events would take longer than a rebuild.
  /// The caller must then rebuild.
  [[nodiscard]] bool try_to_move_all(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                     UpdateCounts& counts);
  /// Moves only the beads that must move, in as many steps as needed. Falls back on move_all if cells are
  /// flat or missing, or if most beads would have to move at once.
  void move_some(const Eigen::Matrix3Xd& centers, std::span<const double> weights, UpdateCounts& counts);
  void rebuild(const Eigen::Matrix3Xd& centers, std::span<const double> weights, UpdateCounts& counts);
  [[nodiscard]] const RegularTriangulation<Dimension>& triangulation() const;
  [[nodiscard]] bool is_solid() const;
  [[nodiscard]] std::size_t bead_count() const;

 private:
  struct Machine;

  void load(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void set_end(BeadId bead, const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void rest_at_end(BeadId bead);
  void run_step(UpdateCounts& counts);
  void add_up(UpdateCounts& counts);
  void activate(const SnapshotFaults& faults, std::vector<char>& moves) const;
  void hidden_that_show(const Snapshot<Dimension>& next, std::vector<char>& moves);
  void house_hidden(const Snapshot<Dimension>& next);

  UpdateMotion motion_;
  std::unique_ptr<Machine> machine_;
};

template <int Dimension>
class KineticUpdate final : public MovingDiagram<Dimension> {
 public:
  using MovingDiagram<Dimension>::MovingDiagram;
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
};

template <int Dimension>
class Activation final : public MovingDiagram<Dimension> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;
};

/// The counts of failed certificates are weighted averages in which older samples count less: motion usually
/// continues as before, and the sample of one frame is small.
template <int Dimension>
class AutomaticUpdate final : public MovingDiagram<Dimension> {
 public:
  UpdateCounts advance(const Eigen::Matrix3Xd& centers, std::span<const double> weights) override;

 private:
  double tested_ = 0, failed_ = 0;
  BackOff samples_{1, 7};          ///< skips samples while their answer is clear
  BackOff given_up_moves_{7, 56};  ///< skips samples after a move that was given up
  std::uint64_t turn_ = 0;         ///< counts samples
};

extern template class MovingDiagram<2>;
extern template class MovingDiagram<3>;

}  // namespace kds
