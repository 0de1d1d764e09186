#include "structures/power_diagram/power_diagram.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "motions/base/input_error.h"
#include "structures/power_diagram/diagram_checks.h"
#include "structures/power_diagram/diagram_editor.h"
#include "structures/power_diagram/diagram_flips.h"
#include "structures/power_diagram/diagram_rebuilder.h"
#include "structures/power_diagram/diagram_state.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

template <int Dimension>
struct PowerDiagram<Dimension>::Parts {
  Parts(Simulator& simulator, const MotionRef<Dimension>& motion, PowerDiagram& diagram)
      : state(simulator, motion, diagram, simulator.add(diagram)),
        facets(state),
        hidden(state),
        flips(state, facets, hidden),
        rebuilder(state, facets, hidden),
        editor(state, facets, hidden, rebuilder) {}

  DiagramState<Dimension> state;
  FacetCertificates<Dimension> facets;
  HiddenCertificates<Dimension> hidden;
  DiagramFlips<Dimension> flips;
  DiagramRebuilder<Dimension> rebuilder;
  DiagramEditor<Dimension> editor;
};

template <int Dimension>
PowerDiagram<Dimension>::PowerDiagram(Simulator& simulator, const MotionRef<Dimension>& motion)
    : parts_(std::make_unique<Parts>(simulator, motion, *this)) {}

template <int Dimension>
PowerDiagram<Dimension>::~PowerDiagram() = default;

template <int Dimension>
void PowerDiagram<Dimension>::build() {
  parts_->state.present_beads.structure_is_built();
  const std::size_t beads = parts_->state.present_beads.count();
  if (beads <= Dimension) {
    throw InputError("the power diagram needs at least " + std::to_string(Dimension + 1) +
                     " beads, the input has " + std::to_string(beads));
  }
  parts_->rebuilder.build_from_control_points(0);
}

template <int Dimension>
void PowerDiagram<Dimension>::start_step() {
  auto& [state, facets, hidden, flips, rebuilder, editor] = *parts_;
  state.curves = state.motion.curves();
  state.triangulation.make_mirror();
  facets.start_step();
  hidden.start_step();
  rebuilder.start_step();
  if (state.flat) {  // any cell may turn over
    for (CellId cell = 0; cell < state.triangulation.cells().size(); ++cell) state.touch(std::array{cell});
  }
  state.vanished_until = state.flat ? 0.0 : -1.0;
  const bool wrong = state.flat && is_wrong_just_after(state);
  state.clear_doubt();
  // Create the certificates of a wrong diagram too: they limit the time of the rebuild.
  if (wrong) facets.remember();
  if (state.has_cells()) rebuilder.watch_all();
  if ((wrong || !state.has_cells()) && !rebuilder.try_to_rebuild()) {
    // All beads stay in one plane or on one line: there are no cells and no events.
    rebuilder.build_from_control_points(0);
  }
  state.flat = false;
  state.within_step = facets.all_move();
  if (state.within_step) count_certificates();
}

template <int Dimension>
void PowerDiagram<Dimension>::fail(unsigned table, std::uint32_t slot) {
  parts_->flips.fail(table, slot);
}

template <int Dimension>
void PowerDiagram<Dimension>::fetch(unsigned table, std::uint32_t place, bool next) const {
  if (table < HiddenCertificates<Dimension>::appearing) parts_->facets.fetch(cell_of(place), next);
}

template <int Dimension>
std::uint64_t PowerDiagram<Dimension>::tie_of(unsigned table, std::uint32_t place) const {
  return table < HiddenCertificates<Dimension>::appearing ? parts_->facets.tie_of(place) : place;
}

template <int Dimension>
void PowerDiagram<Dimension>::after_batch() {
  parts_->rebuilder.after_batch();
}

template <int Dimension>
void PowerDiagram<Dimension>::finish_step() {
  parts_->state.within_step = false;
  if (parts_->facets.all_move()) reach_frame();
}

template <int Dimension>
void PowerDiagram<Dimension>::finish() {
  rebuild_if_flat();
  const std::size_t steps = parts_->state.simulator.step();
  if (!parts_->state.has_had_cells && steps > 0) DiagramRebuilder<Dimension>::refuse_flat(steps - 1);
}

template <int Dimension>
void PowerDiagram<Dimension>::reach_frame() {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  auto& [state, facets, hidden, flips, rebuilder, editor] = *parts_;
  const Curves<Dimension> curves = state.motion.curves();
  if (!state.has_cells()) {
    rebuilder.build_from_control_points(curves.own_degree());
    ++statistics.rebuilds;
    return;
  }
  const Snapshot<Dimension>& end = state.triangulation.set_points(curves, curves.own_degree());
  const int least = least_orientation(state.triangulation, end, facets.known_positive_at_end());
  facets.forget_ends();
  if (least < 0) throw std::logic_error("a cell of the power diagram is inverted");
  state.flat = least == 0;
}

template <int Dimension>
void PowerDiagram<Dimension>::rebuild_if_flat() {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  if (!parts_->state.flat) return;
  parts_->rebuilder.build_from_control_points(parts_->state.motion.degree());
  ++statistics.rebuilds;
}

template <int Dimension>
void PowerDiagram<Dimension>::build_at_end() {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  parts_->rebuilder.build_bare_at_end();
}

template <int Dimension>
void PowerDiagram<Dimension>::apply(const Change& change) {
  if (change.kind < this->rebuild) {
    parts_->flips.apply(change);
  } else if (change.kind == this->rebuild) {
    parts_->rebuilder.apply(change);
  } else {
    parts_->editor.apply(change);
  }
}

template <int Dimension>
std::optional<std::string> PowerDiagram<Dimension>::audit(const Dyadic& time) {
  return audit_of(parts_->state, time);
}

template <int Dimension>
void PowerDiagram<Dimension>::set_follower(CellFollower* follower) {
  if (follower_ != nullptr) throw std::logic_error("a power diagram has one follower");
  follower_ = follower;
  parts_->state.triangulation.set_follower(follower);
}

template <int Dimension>
std::vector<BeadId> PowerDiagram<Dimension>::neighbors(BeadId bead) const {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  auto& state = parts_->state;
  state.present_beads.require(bead, false);
  if (!state.has_cells())
    throw std::logic_error(
        "neighbors of a bead are asked for where all beads lie in one plane, or on one line");
  if (!state.has_had_cells)
    throw std::logic_error("neighbors of a bead are asked for before the diagram is built");
  state.triangulation.make_mirror();
  std::vector<BeadId> neighbors;
  if (state.hidden.contains(bead)) return neighbors;
  for (const CellId cell : state.triangulation.cells_around(bead))
    for (const BeadId other : state.beads_of(cell))
      if (other != bead && other != infinite_bead) neighbors.push_back(other);
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return neighbors;
}

template <int Dimension>
StaticTriangulation<Dimension> PowerDiagram<Dimension>::at_frame(bool first) const {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  const auto& state = parts_->state;
  if (is_solid()) return {state.triangulation.finite_cells(), state.hidden.beads(), Dimension};
  return static_diagram_at_end(state, first ? 0 : state.motion.degree());
}

template <int Dimension>
std::optional<std::vector<BeadId>> PowerDiagram<Dimension>::state() const {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  auto& state = parts_->state;
  if (!is_solid()) return std::nullopt;
  for (const HiddenBead& hidden : state.hidden.with_hosts()) {
    if (hidden.host == no_cell) continue;  // just built: the next step finds the host
    for (int i = 0; i <= Dimension; ++i) {
      const CellBeads<Dimension> cell =
          DiagramState<Dimension>::with(state.beads_of(hidden.host), i, hidden.bead);
      if (state.sign_now(Orientation<Dimension>(cell, 1)) <= 0) return std::nullopt;
    }
  }
  auto cells = state.triangulation.finite_cells();
  for (CellBeads<Dimension>& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
  std::vector<BeadId> numbers = state.hidden.beads();
  numbers.push_back(no_bead);
  for (const CellBeads<Dimension>& cell : cells) numbers.insert(numbers.end(), cell.begin(), cell.end());
  return numbers;
}

template <int Dimension>
DiagramEdges PowerDiagram<Dimension>::edges_at_frame(bool first) const {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  const auto& state = parts_->state;
  if (state.has_cells()) return edges_of(state.triangulation, state.bead_count(), state.hidden.beads());
  return static_edges_at_end(state, first ? 0 : state.motion.degree());
}

template <int Dimension>
void PowerDiagram<Dimension>::leave_out(BeadId bead) {
  parts_->state.present_beads.leave_out(bead);
}

template <int Dimension>
void PowerDiagram<Dimension>::insert(BeadId bead, BeadId near) {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  parts_->editor.insert(bead, near);
  if (follower_ != nullptr) follower_->edited();
}

template <int Dimension>
void PowerDiagram<Dimension>::erase(BeadId bead) {
  const Simulator::ComputeScope scope(parts_->state.simulator);
  parts_->editor.erase(bead);
  if (follower_ != nullptr) follower_->edited();
}

template <int Dimension>
void PowerDiagram<Dimension>::change_motion(BeadId bead, const std::function<void()>& set_curve) {
  parts_->state.present_beads.require(bead, false);
  parts_->state.simulator.change_motion({&bead, 1}, set_curve);
}

template <int Dimension>
void PowerDiagram<Dimension>::require_release(std::span<const BeadId> beads) const {
  BeadEdits::require_release(beads);
  parts_->editor.require_release(beads);
}

template <int Dimension>
void PowerDiagram<Dimension>::release(std::span<const BeadId> beads) {
  parts_->editor.release(beads);
}

template <int Dimension>
void PowerDiagram<Dimension>::take_up(std::span<const BeadId>) {
  parts_->editor.take_up();
}

template <int Dimension>
bool PowerDiagram<Dimension>::is_absent(BeadId bead) const {
  return parts_->state.present_beads.is_absent(bead);
}

template <int Dimension>
void PowerDiagram<Dimension>::move_only(std::vector<char> moving) {
  parts_->facets.move_only(std::move(moving));
}

template <int Dimension>
std::span<const CellId> PowerDiagram<Dimension>::flipped() const {
  return parts_->facets.flipped();
}

template <int Dimension>
bool PowerDiagram<Dimension>::is_solid() const {
  return parts_->state.has_cells() && !parts_->state.flat;
}

template <int Dimension>
const RegularTriangulation<Dimension>& PowerDiagram<Dimension>::triangulation() const {
  return parts_->state.triangulation;
}

template <int Dimension>
void PowerDiagram<Dimension>::make_mirror() {
  parts_->state.triangulation.make_mirror();
}

template <int Dimension>
const HiddenBeads& PowerDiagram<Dimension>::hidden() const {
  return parts_->state.hidden;
}

template <int Dimension>
void PowerDiagram<Dimension>::house(BeadId hidden, CellId host) {
  if (host != no_cell) parts_->state.hidden.enter(hidden, host);
}

template <int Dimension>
CellId PowerDiagram<Dimension>::some_finite_cell() const {
  return parts_->state.some_finite_cell();
}

/// Counts, for each bead, the certificates that name it. A facet's certificate names the beads of the facet
/// and the two beads opposite it. A bead is a vertex of Dimension facets in each of its cells, and each such
/// facet is shared by two of these cells; in addition, each of its cells has one facet opposite to the bead.
/// This makes 5/2 certificates for each cell in space, and 2 in the plane.
template <int Dimension>
void PowerDiagram<Dimension>::count_certificates(std::span<const BeadId> beads) {
  const auto& state = parts_->state;
  if (!state.has_cells()) return;
  const auto count_of = [](std::uint64_t cells) { return cells * (Dimension + 2) / 2; };
  const auto cells_at = state.triangulation.cells_at();
  std::uint64_t most = 0;
  if (beads.empty() && !cells_at.empty())
    most = count_of(*std::max_element(cells_at.begin(), cells_at.end()));
  for (const BeadId bead : beads)
    if (bead < cells_at.size()) most = std::max(most, count_of(cells_at[bead]));
  if (!state.hidden.empty()) {
    std::vector<std::uint64_t> more(state.bead_count(), 0);
    for (const HiddenBead& hidden : state.hidden.with_hosts()) {
      if (hidden.host == no_cell) continue;
      more[hidden.bead] += Dimension + 2;
      for (const BeadId b : state.beads_of(hidden.host)) more[b] += Dimension + 1;
    }
    for (BeadId b = 0; b < more.size(); ++b) most = std::max(most, more[b] + count_of(cells_at[b]));
  }
  statistics.certificates.per_bead_max = std::max(statistics.certificates.per_bead_max, most);
}

template class PowerDiagram<2>;
template class PowerDiagram<3>;

}  // namespace kds
