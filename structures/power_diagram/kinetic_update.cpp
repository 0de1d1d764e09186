#include "structures/power_diagram/kinetic_update.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certificates/search/snapshot_sign.h"
#include "kds/simulator.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/hidden_beads.h"

namespace kds {

template <int Dimension>
struct MovingDiagram<Dimension>::Machine {
  Machine(std::size_t beads, UpdateMotion kind) : motion(beads), power(simulator, of_kind(kind)) {}
  [[nodiscard]] MotionRef<Dimension> of_kind(UpdateMotion kind) const {
    if (kind == UpdateMotion::lifted) return motion;
    return static_cast<const BezierMotion<Dimension, 1>&>(motion);
  }
  LiftedMotion<Dimension> motion;
  Simulator simulator;
  PowerDiagram<Dimension> power;
};

template <int Dimension>
MovingDiagram<Dimension>::MovingDiagram(UpdateMotion motion) : motion_(motion) {}

template <int Dimension>
MovingDiagram<Dimension>::~MovingDiagram() = default;

template <int Dimension>
auto MovingDiagram<Dimension>::diagram() const -> StaticTriangulation<Dimension> {
  return machine_->power.at_frame(false);
}

template <int Dimension>
auto MovingDiagram<Dimension>::triangulation() const -> const RegularTriangulation<Dimension>& {
  return machine_->power.triangulation();
}

template <int Dimension>
bool MovingDiagram<Dimension>::is_solid() const {
  return machine_->power.is_solid();
}

template <int Dimension>
std::size_t MovingDiagram<Dimension>::bead_count() const {
  return machine_->motion.bead_count();
}

template <int Dimension>
void MovingDiagram<Dimension>::build(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  machine_ = std::make_unique<Machine>(weights.size(), motion_);
  for (BeadId b = 0; b < weights.size(); ++b) {
    set_end(b, centers, weights);
    rest_at_end(b);
  }
  machine_->simulator.build();
}

template <int Dimension>
std::optional<std::string> MovingDiagram<Dimension>::fault() const {
  return machine_->power.audit(Dyadic(1.0));
}

template <int Dimension>
void MovingDiagram<Dimension>::set_end(BeadId bead, const Eigen::Matrix3Xd& centers,
                                       std::span<const double> weights) {
  for (int axis = 0; axis < Dimension; ++axis)
    machine_->motion.set_coordinate(bead, 1, axis, centers(axis, bead));
  machine_->motion.set_weight(bead, 1, weights[bead]);
}

template <int Dimension>
void MovingDiagram<Dimension>::rest_at_end(BeadId bead) {
  auto& motion = machine_->motion;
  for (int axis = 0; axis < Dimension; ++axis)
    motion.set_coordinate(bead, 0, axis, motion.coordinate(bead, 1, axis));
  motion.set_weight(bead, 0, motion.weight(bead, 1));
}

template <int Dimension>
void MovingDiagram<Dimension>::load(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  for (BeadId b = 0; b < weights.size(); ++b) {
    rest_at_end(b);
    set_end(b, centers, weights);
    if (motion_ == UpdateMotion::lifted) {
      for (int axis = 0; axis < Dimension; ++axis)
        moved[axis] += machine_->motion.coordinate(b, 1, axis) - machine_->motion.coordinate(b, 0, axis);
    }
  }
  // Any drift gives a correct motion. With the mean of the displacements, weights sink least between frames.
  if (motion_ == UpdateMotion::lifted) {
    typename LiftedMotion<Dimension>::Vector drift{};
    for (int axis = 0; axis < Dimension; ++axis) {
      const double mean = moved[axis] / static_cast<double>(weights.size());
      drift[static_cast<std::size_t>(axis)] = std::isfinite(mean) ? mean : 0;
    }
    machine_->motion.set_drift(drift);
  }
}

template <int Dimension>
void MovingDiagram<Dimension>::run_step(UpdateCounts& counts) {
  machine_->simulator.run_step();
  machine_->power.rebuild_if_flat();
  add_up(counts);
}

template <int Dimension>
void MovingDiagram<Dimension>::add_up(UpdateCounts& counts) {
  counts.events += machine_->power.statistics.events_per_step.back();
  machine_->power.statistics.events_per_step.clear();
  counts.rebuilds += std::exchange(machine_->power.statistics.rebuilds, 0);
}

template <int Dimension>
void MovingDiagram<Dimension>::move_all(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                        UpdateCounts& counts) {
  load(centers, weights);
  counts.activated += weights.size();
  run_step(counts);
}

template <int Dimension>
bool MovingDiagram<Dimension>::try_to_move_all(const Eigen::Matrix3Xd& centers,
                                               std::span<const double> weights, UpdateCounts& counts) {
  load(centers, weights);
  counts.activated += weights.size();
  // A rebuild takes the time of about two events for each bead in space, and of one in the plane.
  constexpr std::uint64_t most_of_a_bead = Dimension == 3 ? 3 : 2;
  const std::uint64_t most = most_of_a_bead * weights.size();
  const bool moved = machine_->simulator.try_step(most);
  if (moved) machine_->power.rebuild_if_flat();
  add_up(counts);
  return moved;
}

template <int Dimension>
void MovingDiagram<Dimension>::rebuild(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                       UpdateCounts& counts) {
  load(centers, weights);
  machine_->power.build_at_end();
  ++counts.rebuilds;
}

/// Marks all beads of failed certificates.
template <int Dimension>
void MovingDiagram<Dimension>::activate(const SnapshotFaults& faults, std::vector<char>& moves) const {
  const RegularTriangulation<Dimension>& t = machine_->power.triangulation();
  const auto add = [&](BeadId bead) {
    if (bead != infinite_bead) moves[bead] = 1;
  };
  for (const auto* facets : {&faults.facets, &faults.zero_facets}) {
    for (const FacetId f : *facets) {
      for (const BeadId b : t.cells()[cell_of(f)].vertex) add(b);
      add(t.apex_beyond(cell_of(f), index_of(f)));
    }
  }
  for (const auto* cells : {&faults.cells, &faults.flat_cells}) {
    for (const CellId cell : *cells)
      for (const BeadId b : t.cells()[cell].vertex) add(b);
  }
}

namespace {

/// Walks to the finite cell that contains the bead at the positions of `snapshot`. Returns no_cell if there
/// is none or if the walk gets lost among inverted cells.
template <int Dimension>
CellId host_at_snapshot(const RegularTriangulation<Dimension>& t, BeadId bead, CellId cell,
                        const Snapshot<Dimension>& snapshot) {
  for (std::size_t step = 0; step <= t.cells().size(); ++step) {
    const auto& v = t.cells()[cell].vertex;
    if (const auto at = std::find(v.begin(), v.end(), infinite_bead); at != v.end()) {
      if (step > 0) return no_cell;
      cell = cell_of(t.beyond(cell, static_cast<int>(at - v.begin())));
      continue;
    }
    int leaves_by = -1;
    for (int i = 0; i <= Dimension && leaves_by < 0; ++i) {
      auto part = v;
      part[static_cast<std::size_t>(i)] = bead;
      if (snapshot_sign(Orientation<Dimension>(part, 1), snapshot) < 0) leaves_by = i;
    }
    if (leaves_by < 0) return cell;
    cell = cell_of(t.beyond(cell, leaves_by));
  }
  return no_cell;
}

}  // namespace

/// Marks all hidden beads. If the cell that contains a hidden bead at the new positions does not hide it,
/// also marks the beads of this cell.
template <int Dimension>
void MovingDiagram<Dimension>::hidden_that_show(const Snapshot<Dimension>& next, std::vector<char>& moves) {
  PowerDiagram<Dimension>& power = machine_->power;
  const RegularTriangulation<Dimension>& t = power.triangulation();
  const auto move_cell = [&](CellId cell) {
    for (const BeadId b : t.cells()[cell].vertex)
      if (b != infinite_bead) moves[b] = 1;
  };
  for (const HiddenBead& hidden : power.hidden().with_hosts()) {
    moves[hidden.bead] = 1;
    const CellId near = hidden.host == no_cell ? power.some_finite_cell() : hidden.host;
    const CellId host = host_at_snapshot(t, hidden.bead, near, next);
    const auto hides = [&](const auto& certificate) { return snapshot_sign(certificate, next) >= 0; };
    if (host == no_cell) {
      move_cell(near);
    } else if (!with_facet_certificate(t.cells()[host].vertex, hidden.bead, hides)) {
      move_cell(host);
    }
  }
}

/// Sets the hosts of hidden beads to the cells that contain them now.
template <int Dimension>
void MovingDiagram<Dimension>::house_hidden(const Snapshot<Dimension>& next) {
  PowerDiagram<Dimension>& power = machine_->power;
  for (const HiddenBead& hidden : power.hidden().with_hosts()) {
    const CellId near = hidden.host == no_cell ? power.some_finite_cell() : hidden.host;
    power.house(hidden.bead, host_at_snapshot(power.triangulation(), hidden.bead, near, next));
  }
}

template <int Dimension>
void MovingDiagram<Dimension>::move_some(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                         UpdateCounts& counts) {
  PowerDiagram<Dimension>& power = machine_->power;
  if (!power.is_solid()) return move_all(centers, weights, counts);  // no cells to test, or flat ones
  machine_->power.make_mirror();
  const Snapshot<Dimension> next(centers, weights);
  SnapshotFaults faults = snapshot_faults(triangulation(), next);
  counts.tested = faults.tested;
  counts.failed = faults.failed();
  std::vector<char> moved(weights.size(), 0), moves(weights.size(), 0);
  activate(faults, moves);
  hidden_that_show(next, moves);
  const auto count = static_cast<std::size_t>(std::count(moves.begin(), moves.end(), 1));
  // With so many moving beads, hardly any facet would be skipped.
  if (4 * count > 3 * weights.size()) return move_all(centers, weights, counts);

  for (BeadId b = 0; b < weights.size(); ++b) rest_at_end(b);
  while (true) {
    // Beads that have moved rest at their new positions.
    bool any = false;
    for (BeadId b = 0; b < weights.size(); ++b) {
      if (moved[b] != 0) {
        rest_at_end(b);
        moves[b] = 0;
      } else if (moves[b] != 0) {
        set_end(b, centers, weights);
        moved[b] = 1;
        any = true;
        ++counts.activated;
      }
    }
    if (!any) break;
    power.move_only(moves);
    const std::uint64_t before = counts.rebuilds;
    run_step(counts);
    // Cells that no flip touched were already tested at the new positions.
    std::vector<CellId> flipped(power.flipped().begin(), power.flipped().end());
    std::sort(flipped.begin(), flipped.end());
    flipped.erase(std::unique(flipped.begin(), flipped.end()), flipped.end());
    faults = counts.rebuilds > before
                 ? snapshot_faults(triangulation(), next)
                 : snapshot_faults(triangulation(), std::span<const CellId>(flipped), next);
    moves.assign(weights.size(), 0);
    activate(faults, moves);
    hidden_that_show(next, moves);
  }
  // The remaining beads violate nothing at their new positions, so no event matters on their way.
  for (BeadId b = 0; b < weights.size(); ++b) set_end(b, centers, weights);
  power.move_only({});
  house_hidden(next);
  power.reach_frame();
  power.rebuild_if_flat();
}

template <int Dimension>
UpdateCounts KineticUpdate<Dimension>::advance(const Eigen::Matrix3Xd& centers,
                                               std::span<const double> weights) {
  UpdateCounts counts;
  this->move_all(centers, weights, counts);
  return counts;
}

template <int Dimension>
UpdateCounts Activation<Dimension>::advance(const Eigen::Matrix3Xd& centers,
                                            std::span<const double> weights) {
  UpdateCounts counts;
  this->move_some(centers, weights, counts);
  return counts;
}

template <int Dimension>
UpdateCounts AutomaticUpdate<Dimension>::advance(const Eigen::Matrix3Xd& centers,
                                                 std::span<const double> weights) {
  // At about this share of failed certificates, moving takes as long as rebuilding. Measured on
  // trajectories of 100 to 1100 beads at strides up to 64, and on chains and grids of 10240 beads that move
  // 0.1 to 0.4 radii a frame.
  constexpr double limit = 0.165;
  // A sample of four facets near every eighth bead costs about a hundredth of an update. While the answer is
  // clear, samples are taken less and less often.
  constexpr std::size_t every = 8, every_at_first = 2, most_sampled = 64;
  constexpr double remembered = 0.9, clearly = 0.2, very_clearly = 0.5;
  UpdateCounts counts;
  if (!this->is_solid()) {
    this->rebuild(centers, weights, counts);
    return counts;
  }
  if (!samples_.skips() && !given_up_moves_.skips()) {
    const auto sample = this->triangulation().sample(
        centers, weights, std::max(tested_ == 0 ? every_at_first : every, this->bead_count() / most_sampled),
        turn_++);
    counts.tested = sample.tested;
    counts.failed = sample.failed;
    const auto tested = static_cast<double>(sample.tested), failed = static_cast<double>(sample.failed);
    const auto is_clear = [&](double some, double all, double by) {
      return std::abs(some - limit * all) > by * limit * all;
    };
    // The motion has changed: discard older counts.
    if ((failed > limit * tested) != (failed_ > limit * tested_) && is_clear(failed, tested, very_clearly))
      tested_ = failed_ = 0;
    tested_ = remembered * tested_ + tested;
    failed_ = remembered * failed_ + failed;
    if (is_clear(failed_, tested_, clearly)) {
      samples_.lengthen();
    } else {
      samples_.reset();
    }
  }
  if (failed_ > limit * tested_) {
    this->rebuild(centers, weights, counts);
  } else if (this->try_to_move_all(centers, weights, counts)) {
    given_up_moves_.reset();
  } else {
    // The motion has changed, or many events on the way are reversed later, which no sample shows. Try moving
    // less often after each such failure.
    this->rebuild(centers, weights, counts);
    failed_ = tested_;
    samples_.reset();
    given_up_moves_.lengthen();
  }
  return counts;
}

template class MovingDiagram<2>;
template class MovingDiagram<3>;
template class KineticUpdate<2>;
template class KineticUpdate<3>;
template class Activation<2>;
template class Activation<3>;
template class AutomaticUpdate<2>;
template class AutomaticUpdate<3>;

}  // namespace kds
