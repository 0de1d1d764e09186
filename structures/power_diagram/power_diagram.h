#pragma once
// Kinetic power diagram in the plane or in space: CGAL's regular triangulation flipped while time runs. Each
// facet has its certificate (facet_certificate.h), each hidden bead some; parts of this class by theme:
//
//   power_diagram_facets.h    which certificate guards a facet
//   power_diagram_flips.h     what happens when one fails
//   power_diagram_hidden.h    hidden beads: how they are guarded, come back and vanish
//   power_diagram_edits.h     beads that come, go and change course while time runs
//   power_diagram_rebuilds.h  where flips do not suffice, audits

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "kds/certificate_table.h"
#include "motions/base/grow_little.h"
#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "structures/power_diagram/facet_filter.h"
#include "structures/power_diagram/facet_guard.h"
#include "structures/power_diagram/facet_slack.h"
#include "structures/triangulation/diagram_edges.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/regularity_fault.h"
#include "structures/triangulation/snapshot_faults.h"

namespace kds {

template <Motion M, Kernel K>
class PowerDiagram final : public KineticStructure {
  static_assert(M::dimension == 2 || M::dimension == 3);

 public:
  static constexpr int dimension = M::dimension;
  static constexpr unsigned coarsest_grid = 8, finest_grid = 200;  // binary places of a rebuild's time
  using Beads = CellBeads<dimension>;

  PowerDiagram(Simulator& simulator, const M& motion)
      : simulator_(simulator),
        motion_(motion),
        index_(simulator.add(*this)),
        power_tests_(simulator, *this, index_, 0, motion, TouchPolicy::reported),
        orientations_(simulator, *this, index_, 1, motion, TouchPolicy::reported),
        appearances_(simulator, *this, index_, appearing, motion),
        departures_(simulator, *this, index_, departing, motion) {}

  /// In the plane `to_edge` is the 2-2 flip, and there is no `to_facet`.
  enum Kind : std::uint8_t {
    to_edge,
    to_facet,
    hides = dimension == 3 ? 2 : 1,
    shows,
    wanders,
    rebuild,
    // Edits: all their cells that go and that come, then what it was.
    clears,
    fills,
    inserts,
    erases,
    changes,
  };

  [[nodiscard]] std::string_view name() const override { return "power"; }
  /// Ids of a flip: those of the face that goes, then those of the face that comes, in space the triangle
  /// first; each ascending. Where a bead vanishes or comes back: those of the one cell, ascending, then the
  /// bead. Where one wanders: itself, then its host's, ascending. Ids of a rebuild: its time numerator /
  /// 2^exponent as exponent, then 32-bit words of the numerator, lowest first. Ids of a cell that an edit
  /// clears: ascending; of one that fills its place, positively oriented: ascending but for the last two
  /// perhaps. Of an insert, erase or change: the bead.
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr EventKind wander{"wander", false};
    static constexpr EventKind rebuilt{"rebuild", false, true};
    static constexpr EventKind clear{"clear", false, true}, fill{"fill", false, true};
    static constexpr EventKind insert{"insert", false, true}, erase{"erase", false, true},
        change{"change", false, true};
    static constexpr std::array<EventKind, 11> in_space{
        {{"2-3"}, {"3-2"}, {"4-1"}, {"1-4"}, wander, rebuilt, clear, fill, insert, erase, change}};
    static constexpr std::array<EventKind, 10> in_plane{
        {{"2-2"}, {"3-1"}, {"1-3"}, wander, rebuilt, clear, fill, insert, erase, change}};
    if constexpr (dimension == 3) return in_space;
    return in_plane;
  }

  void build() override {
    const std::size_t beads = motion_.bead_count() - absent_count_;
    if (beads <= dimension) {
      throw InputError("the power diagram needs at least " + std::to_string(dimension + 1) +
                       " beads, the input has " + std::to_string(beads));
    }
    build_from_control_points(0);
  }

  void start_step() override {
    triangulation_.make_mirror();
    // Tolerances take weights as constant.
    if constexpr (!std::same_as<K, Exact> && !lifted<M>) {
      if (moving_.empty()) tolerances_.start_step(motion_, triangulation_);
    }
    rebuilds_in_step_ = 0;
    coarsest_that_worked_ = coarsest_grid;
    guarded_ = false;  // the guards of the step before are gone
    ends_positive_.clear();
    hidden_guards_.clear();
    if (affine_dimension_ == dimension && !(flat_ && is_wrong_just_after())) {
      watch_all();
    } else if (!try_to_rebuild()) {
      build_from_control_points(0);  // all beads stay in one plane, or on one line: no cells, no events
    }
    flat_ = false;
    within_step_ = moving_.empty();
    if (within_step_ && affine_dimension_ == dimension) count_certificates_per_bead();
  }

  void fail(unsigned table, std::uint32_t slot) override;
  void fetch(unsigned table, std::uint32_t place, bool next) const override {
    if (table < appearing) fetch_cell(cell_of(place), next);
  }
  void after_batch() override;
  void finish_step(bool last) override {
    within_step_ = false;
    if (moving_.empty()) reach_frame(last);
    if (last && !has_had_cells_) refuse_flat();
  }

  // Steps that bring but a part of the beads to the next frame (diagram_update.h).

  /// From now on only the beads marked, one entry a bead, move in a step, and a step does not end at a frame:
  /// that is for reach_frame. Facets of beads that all rest need no certificate. Empty: all beads move.
  void move_only(std::vector<char> moving) {
    moving_ = std::move(moving);
    flipped_.clear();
    ends_positive_.clear();  // steps of other beads end elsewhere
    if (!moving_.empty()) tolerances_.forget_all();
  }
  /// Cells that flips made since then, some more than once, some gone again.
  [[nodiscard]] std::span<const CellId> flipped() const { return flipped_; }
  /// Whether cells are neither missing nor flat, so that flips alone lead on.
  [[nodiscard]] bool is_solid() const { return affine_dimension_ == dimension && !flat_; }
  /// Built anew at the end of the motion's step, run to its end or given up, as CGAL does it; the mirror is
  /// made when a step starts.
  void build_at_end() {
    settled();
    const auto built =
        triangulation_.build_bare(control_points(motion_, M::degree), control_weights(motion_, M::degree));
    forget_steps(built);
  }
  [[nodiscard]] RegularTriangulation<dimension>& triangulation() { return triangulation_; }
  [[nodiscard]] const HiddenBeads& hidden() const { return hidden_; }
  void house(BeadId hidden, CellId host) {
    if (host != no_cell) hidden_.enter(hidden, host);
  }
  [[nodiscard]] CellId some_finite_cell() const;
  /// All beads are where the motion's step ends.
  void reach_frame(bool last) {
    if (affine_dimension_ < dimension) {
      build_from_control_points(M::degree);
      ++statistics.rebuilds;
      return;
    }
    const int least =
        least_orientation(triangulation_, triangulation_.set_points(motion_, M::degree), ends_positive_);
    ends_positive_.clear();
    if (least < 0 && !std::same_as<K, Fast>)
      throw std::logic_error("a cell of the power diagram is inverted");
    flat_ = least == 0;
    if (least < 0 || (flat_ && last)) {  // end as CGAL builds it; on the way, flat cells open again
      build_from_control_points(M::degree);
      ++statistics.rebuilds;
      flat_ = false;
    }
  }

  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// Finite cells and hidden beads at the frame just reached, as a static build has them where cells are flat
  /// there.
  [[nodiscard]] StaticTriangulation<dimension> at_frame(bool first) const {
    if (!flat_ && affine_dimension_ == dimension)
      return {triangulation_.finite_cells(), hidden_.beads(), dimension};
    return static_at_end(first ? 0 : M::degree);
  }

  /// Its edges there, of all beads, none being absent: what closest_pair (closest_pair.h) asks for.
  [[nodiscard]] DiagramEdges edges_at_frame(bool first) const {
    if (affine_dimension_ == dimension)
      return edges_of(triangulation_, motion_.bead_count(), hidden_.beads());
    const int k = first ? 0 : M::degree;
    return static_edges<dimension>(control_points(motion_, k), control_weights(motion_, k));
  }

  // Edits, within a step while the simulator stands still between events (Simulator::run_until): afterwards
  // the diagram is the one of the beads then present, just after that time. Cost: the beads around, and the
  // way to them. Where ties decide how cells lie, the diagram is built anew instead, and the rebuild counted.
  // Bad calls are refused by std::invalid_argument, and nothing is changed; if all beads left stay in one
  // plane (on one line), InputError. Other structures on the same motion are not told.

  /// Before it is built: the bead does not take part until it is inserted. Its curve may be anything finite.
  void leave_out(BeadId bead);
  /// The bead takes part from now on, on the curve that the motion has. It is looked for from `near`, if
  /// given.
  void insert(BeadId bead, BeadId near = no_bead);
  /// It does not any more.
  void erase(BeadId bead);
  /// The bead goes on along the curve that `set_curve()` gives it in the motion; where it jumps now it is
  /// erased and inserted. That of beads absent can be set at any time. A log does not hold curves: a replay
  /// must follow the same motion.
  template <std::invocable SetCurve>
  void change_motion(BeadId bead, SetCurve set_curve);
  [[nodiscard]] bool is_absent(BeadId bead) const { return bead < absent_.size() && absent_[bead] != 0; }

 private:
  /// In general position an event changes one flip's beads and nothing else. Where more happens at once, or a
  /// certificate touches zero, the diagram is checked after it, and rebuilt if it is wrong: cells can turn
  /// over unseen only at such moments.
  enum class Doubt : std::uint8_t { none, unclear, wrong };
  void suspect(Doubt doubt) {
    doubt_ = std::max(doubt_, doubt);
    needs_after_batch = true;
  }
  void settled() {
    doubt_ = Doubt::none;
    needs_after_batch = false;
  }
  [[nodiscard]] bool is_wrong_just_after();
  [[nodiscard]] BeadId bead_count() const { return static_cast<BeadId>(motion_.bead_count()); }

  using About = FacetGuard::About;
  static constexpr std::uint32_t resting_note = FacetGuard{CertificateHandle::never, About::power}.packed();

  // Building.

  void build_from_control_points(int k);
  void forget_steps(const StaticTriangulation<dimension>& built);
  [[nodiscard]] std::vector<BeadId> beads_present() const;
  /// Of some beads, ascending.
  [[nodiscard]] StaticTriangulation<dimension> exact_static(std::span<const BeadId> beads, const Dyadic& time,
                                                            bool oriented) const;
  [[nodiscard]] StaticTriangulation<dimension> exact_static(const Dyadic& time, bool oriented) const {
    return exact_static(beads_present(), time, oriented);
  }
  /// From the k-th control points, an end of the step.
  [[nodiscard]] StaticTriangulation<dimension> static_at_end(int k) const;
  /// The static diagram at `time`; false, and nothing changed, where it is flat.
  bool assign_static(const Dyadic& time);
  /// Rebuilds at the first time on ever finer grids after now before which nothing fails.
  void rebuild_at_first_time_that_works();
  /// False, and no cells, where all beads stay in one plane or on one line.
  [[nodiscard]] bool try_to_rebuild();
  [[noreturn]] void refuse_flat() const;
  /// `fast`: rebuilds near now from doubles, a few times a step; what is violated then stays so.
  void rebuild_roughly();
  void drop_all();
  [[nodiscard]] bool nothing_fails_until(const Dyadic& time);
  void record_rebuild(const Dyadic& time);
  void apply_rebuild(const Change& change);

  // Facets.

  [[nodiscard]] int place_of(CellId cell, BeadId bead) const {
    const auto& v = triangulation_.cells()[cell].vertex;
    return static_cast<int>(std::find(v.begin(), v.end(), bead) - v.begin());
  }
  [[nodiscard]] BeadId vertex(CellId cell, int i) const {
    return triangulation_.cells()[cell].vertex[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] CellId neighbor(CellId cell, int i) const { return cell_of(triangulation_.beyond(cell, i)); }
  /// The same facet as the cell beyond it has it.
  [[nodiscard]] std::pair<CellId, int> across(CellId cell, int i) const {
    const FacetId beyond = triangulation_.beyond(cell, i);
    return {cell_of(beyond), index_of(beyond)};
  }
  /// The bead beyond facet i.
  [[nodiscard]] BeadId apex(CellId cell, int i) const { return triangulation_.apex_beyond(cell, i); }
  [[nodiscard]] FacetGuard guard(CellId cell, int i) const {
    return FacetGuard::of(triangulation_.cells()[cell].note[static_cast<std::size_t>(i)]);
  }
  /// As this cell has it alone.
  void set_own_guard(CellId cell, int i, FacetGuard value) {
    triangulation_.note(cell, i) = value.packed();
    if (notes_ == Notes::any || value.packed() == resting_note) return;
    append_little(noted_, cell);
    if (8 * noted_.size() > triangulation_.cells().size()) notes_ = Notes::any;  // then it does not pay
  }
  void set_guard(CellId cell, int i, FacetGuard value) {
    set_own_guard(cell, i, value);
    const auto [other, k] = across(cell, i);
    set_own_guard(other, k, value);
  }
  void forget(CellId cell, int i) { set_guard(cell, i, {}); }

  template <class Certificate>
  [[nodiscard]] KnownAtStart birth_of(const Certificate& certificate) const {
    return certificate.identity() == present_ ? KnownAtStart::at_own_root : KnownAtStart::unknown;
  }
  /// What FacetFilter finds.
  struct Finding {
    PowerDiagram& diagram;
    void doubt(FacetId facet) const { diagram.enqueue(cell_of(facet), index_of(facet)); }
    void at_end(CellId cell, bool positive) const { diagram.ends_positive_[cell] = positive ? 1 : 0; }
  };
  /// Facets are guarded together: enqueue some, then watch them.
  void enqueue(CellId cell, int i);
  void enqueue(const FacetCertificates<dimension + 1>& certificates, CellId cell, int i, KnownAtStart birth);
  [[nodiscard]] std::array<unsigned, few_cells> positive_all_over(std::span<const CellId> cells);
  void watch_enqueued();
  void hold_inner(CellId cell, int i);
  void watch_cells_beside(CellId cell, int i);
  void watch_cell(CellId cell, int i);
  void drop(CellId cell, int i);
  template <class Certificate>
  void give_up(CertificateTable<Certificate, M, K>& table, CertificateHandle guard);
  void watch_all();
  void watch_moving();
  void note_resting();
  template <class Visit>
  void for_all_facets(Visit visit) const {
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (!triangulation_.is_live(cell)) continue;
      for (int i = 0; i <= dimension; ++i) {
        if (cell < neighbor(cell, i)) visit(cell, i);
      }
    }
  }
  void count_certificates_per_bead();

  // Hidden beads.

  /// Tables of their certificates.
  enum : unsigned { appearing = 2, departing = 3 };
  /// Against the host's facets, then the power test.
  using Guards = std::array<CertificateHandle, dimension + 2>;
  static constexpr Guards no_guards = [] {
    Guards none{};
    none.fill(CertificateHandle::violated);
    return none;
  }();
  void fail_hidden(unsigned table, std::uint32_t slot);
  void wander(BeadId bead, int facet);
  void show(BeadId bead, CellId cell);
  void hide(CellId cell, int i);
  [[nodiscard]] CellId find_host(BeadId bead, CellId cell, int came_from = -1);
  [[nodiscard]] bool is_infinite(CellId cell) const { return place_of(cell, infinite_bead) <= dimension; }
  void enqueue_hidden(BeadId bead);
  void watch_all_hidden();
  void drop_hidden(BeadId bead);
  void displace(std::span<const CellId> cells);
  void rehouse(CellId near);
  [[nodiscard]] static Change change_of(Kind kind, const Beads& cell, BeadId bead) {
    Change change{kind, dimension + 2, {}};
    std::copy(cell.begin(), cell.end(), change.ids.begin());
    std::sort(change.ids.begin(), change.ids.begin() + dimension + 1);
    change.ids[dimension + 1] = bead;
    return change;
  }

  // Edits.

  void require_edit(BeadId bead, bool present) const;
  [[nodiscard]] Dyadic time_of_edit() const;
  void set_absent(BeadId bead, bool absent);
  void put_in(BeadId bead, CellId from);
  void take_out(BeadId bead, std::span<const CellId> hole, const Dyadic& time);
  void take_out_hidden(BeadId bead);
  [[nodiscard]] CellId cell_near(BeadId near) const;
  [[nodiscard]] CellId walk_to(BeadId bead, CellId cell, int came_from = -1);
  template <class Function>
  [[nodiscard]] int sign_after_edit(const Function& function) {
    return sign_just_after<K>(function, motion_, simulator_.now(), statistics.stages);
  }
  [[nodiscard]] int power_against(BeadId bead, CellId cell);
  [[nodiscard]] std::vector<CellId> cells_in_conflict(BeadId bead, CellId start, bool zero_too);
  [[nodiscard]] std::vector<Beads> star_in_place_of(std::span<const CellId> hole, BeadId bead) const;
  [[nodiscard]] std::vector<Beads> fill_of(std::span<const CellId> hole, BeadId bead,
                                           std::vector<BeadId> beads, const Dyadic& time) const;
  [[nodiscard]] bool can_fill(std::span<const CellId> hole, std::span<const Beads> made);
  void drop_around(std::span<const CellId> cells);
  void fill(std::span<const CellId> hole, std::span<const Beads> made);
  void finish_edit(Kind kind, BeadId bead);
  void rebuild_after_edit(Kind kind, BeadId bead);
  [[nodiscard]] std::vector<CellId> exchange_cells(std::span<const CellId> hole, std::span<const Beads> made);
  void apply_edit(const Change& change);

  // Flips.

  /// A flip there comes near: first its cell, then what that names.
  void fetch_cell(CellId cell, bool next) const;
  /// Fetches the failures that the flip will cancel.
  void fetch_scheduled(CellId cell) const {
    for (int i = 0; i <= dimension; ++i) {
      if (const FacetGuard facet = guard(cell, i); facet.about == About::power)
        power_tests_.fetch_scheduled(facet.guard);
    }
  }
  /// The certificate that fails now.
  void begin_event(const Identity& identity);
  void repair(CellId cell, int facet);
  /// Whether new cells may take the place of old ones.
  [[nodiscard]] bool can_replace(std::span<const Beads> old, std::span<const Beads> made);
  /// The cell with e in place i instead: its orientation is that of the cell if e is on the same side.
  [[nodiscard]] static Beads with(Beads cell, int i, BeadId e) {
    cell[static_cast<std::size_t>(i)] = e;
    return cell;
  }
  void flip_to_edge(CellId cell, int facet);
  void flip_to_facet(CellId cell, int facet, int other) requires(dimension == 3);
  void apply_to_facet(const Change& change) requires(dimension == 3);
  void apply_to_hidden(const Change& change);
  /// In exact geometry new cells that are positive have no face that stands already, unless more happens at
  /// once.
  [[nodiscard]] bool may_stand_already() const {
    return std::same_as<K, Fast> || doubt_ != Doubt::none ||
           present_.type == static_cast<std::uint32_t>(CertificateType::orientation);
  }
  /// Whether a face of these beads stands, each of them a vertex of one of two cells.
  [[nodiscard]] bool stands_already(std::span<const BeadId> face, CellId a, CellId b) const;
  void watch_around(std::span<const CellId> cells);

  Simulator& simulator_;
  const M& motion_;
  std::size_t index_;
  CertificateTable<PowerTest<dimension>, M, K> power_tests_;
  CertificateTable<Orientation<dimension>, M, K> orientations_;
  CertificateTable<PowerTest<dimension>, M, K> appearances_;  // of hidden beads
  CertificateTable<Orientation<dimension>, M, K> departures_;
  RegularTriangulation<dimension> triangulation_;
  bool guarded_ = false;
  /// What the notes of cells say: anything, or that all facets rest but perhaps those of `noted_`.
  enum class Notes : std::uint8_t { any, resting };
  Notes notes_ = Notes::any;
  std::vector<CellId> noted_;
  FacetCover cover_;
  LengthUnit unit_;  // near the cells' lengths in this step
  /// Of each cell whether it is known to be positive where the step ends; fewer than there are cells, or
  /// none.
  std::vector<std::uint8_t> ends_positive_;
  FacetSlack<M> tolerances_;
  std::vector<char> moving_;  // of each bead; empty: all move
  std::vector<CellId> flipped_;
  HiddenBeads hidden_;
  std::vector<Guards> hidden_guards_;  // of each bead, if any is hidden
  std::vector<BeadId> displaced_;
  int affine_dimension_ = dimension;  // of the beads; below, no cells
  bool has_had_cells_ = false;
  bool flat_ = false;  // some cell is flat at the frame just reached
  int rebuilds_in_step_ = 0;
  unsigned coarsest_that_worked_ = coarsest_grid;  // in this step: blocked flips come in crowds
  Doubt doubt_ = Doubt::none;
  std::vector<char> absent_;  // of each bead, if any was ever left out
  std::size_t absent_count_ = 0;
  bool within_step_ = false;
  // Replay: cells that the edit being read clears and fills.
  std::vector<CellId> cleared_;
  std::vector<Beads> filled_;
  Identity present_;  // of the certificate that fails now
  Identity last_identity_;
  std::uint64_t last_moment_ = 0;
};

}  // namespace kds

#include "structures/power_diagram/power_diagram_edits.h"
#include "structures/power_diagram/power_diagram_facets.h"
#include "structures/power_diagram/power_diagram_flips.h"
#include "structures/power_diagram/power_diagram_hidden.h"
#include "structures/power_diagram/power_diagram_rebuilds.h"
