#pragma once
// Kinetic power diagram in space, equal weights: CGAL's regular triangulation flipped while time runs. One
// certificate a facet: the power test of its two cells, or, where the infinite vertex is among the five, the
// orientation of the other four (the hull is locally convex there).
//
// When it fails, the Radon partition of the five beads decides the flip. In general position the cells
// themselves tell which it is: 3-2 if an edge of the facet has just three cells, all among the five beads,
// else 2-3. What general position does not guarantee is checked: finite new cells must be positive just after
// the event, and on the hull the triangles that go and those that come must turn the same way in their common
// plane now. Where that fails, or a certificate is violated at its birth, the diagram is rebuilt at a time
// after the event so near that nothing is skipped, and the rebuild is counted.

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificates/orientation.h"
#include "certificates/power_test.h"
#include "certificates/same_turn.h"
#include "kds/certificate_table.h"
#include "motions/input_error.h"
#include "motions/positions.h"
#include "structures/bead_names.h"
#include "structures/regular_triangulation.h"

namespace kds {

template <Motion M, Kernel K>
class PowerDiagram final : public KineticStructure {
  static_assert(M::dimension == 3);

 public:
  PowerDiagram(Simulator& simulator, const M& motion)
      : simulator_(simulator),
        motion_(motion),
        index_(simulator.add(*this)),
        power_tests_(simulator, *this, index_, 0, motion),
        orientations_(simulator, *this, index_, 1, motion) {}

  enum Kind : std::uint8_t { flip23, flip32, rebuild };
  static constexpr unsigned finest_grid = 200;  // binary places of a rebuild's time

  [[nodiscard]] std::string_view name() const override { return "power"; }
  /// Ids of a flip: the triangle's three beads, then the edge's two, each ascending. Ids of a rebuild: its
  /// time numerator / 2^exponent as exponent, then 32-bit words of the numerator, lowest first.
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 3> kinds{{{"2-3"}, {"3-2"}, {"rebuild", false, true}}};
    return kinds;
  }

  void build() override {
    if (motion_.bead_count() < 4) {
      throw InputError("the power diagram needs at least 4 beads, the input has " +
                       std::to_string(motion_.bead_count()));
    }
    build_from_control_points(0);
  }

  void start_step() override {
    rebuilds_in_step_ = 0;
    guards_.clear();  // those of the step before are gone
    if (!hidden_.empty() || dimension_ < 3 || (flat_ && !flat_cells_open())) {
      rebuild_at_first_time_that_works();
    } else {
      watch_all();
    }
    flat_ = false;
    count_certificates_per_bead();
  }

  void fail(unsigned table, std::uint32_t slot) override {
    const std::uint32_t place =
        table == 0 ? power_tests_.place_in_structure(slot) : orientations_.place_in_structure(slot);
    const CellId cell = place / 4;
    const int facet = static_cast<int>(place % 4);
    forget(cell, facet);
    if (unsettled) return;  // a rebuild is due
    present_ = table == 0 ? power_tests_.identity(slot) : orientations_.identity(slot);
    repair(cell, facet);
    present_ = {};
  }

  void settle() override {
    if constexpr (std::same_as<K, Fast>) {
      rebuild_roughly();
    } else {
      rebuild_at_first_time_that_works();
    }
  }

  void finish_step(bool last) override {
    triangulation_.set_points(control_points(motion_, M::degree), control_weights(motion_, M::degree));
    const int least = triangulation_.least_orientation();
    if (least < 0 && !std::same_as<K, Fast>)
      throw std::logic_error("a cell of the power diagram is inverted");
    flat_ = least == 0;
    if (least < 0 || (flat_ && last)) {  // end as CGAL builds it; on the way, flat cells open again
      build_from_control_points(M::degree);
      ++statistics.rebuilds;
      flat_ = false;
    }
  }

  void apply(const Change& change) override {
    if (change.kind == rebuild) {
      if (change.size < 1 || change.ids[0] > finest_grid)
        throw std::invalid_argument("this is no time of a rebuild");
      Integer numerator = 0;
      for (std::size_t i = change.size; i-- > 1;) numerator = (numerator << 32U) + change.ids[i];
      const Dyadic time(numerator, change.ids[0]);
      if (!(time < Dyadic(1.0)) || !assign_static(time)) {
        throw std::invalid_argument("no diagram can be built at this time");
      }
      return;
    }
    if (change.size != 5) throw std::invalid_argument("a flip has five beads");
    const auto& id = change.ids;
    const auto cell = triangulation_.find_cell(change.kind == flip23 ? CellBeads{id[0], id[1], id[2], id[3]}
                                                                     : CellBeads{id[0], id[1], id[3], id[4]});
    if (!cell) throw std::invalid_argument("the diagram has no such cell");
    if (change.kind == flip23) {
      const int facet = place_of(*cell, id[3]);
      if (apex(*cell, facet) != id[4]) throw std::invalid_argument("the facet has another apex");
      if (triangulation_.is_edge(id[3], id[4])) throw std::invalid_argument("the beads are joined already");
      triangulation_.flip_facet(*cell, facet);
    } else {
      if (!triangulation_.find_cell({id[0], id[2], id[3], id[4]}) ||
          !triangulation_.find_cell({id[1], id[2], id[3], id[4]})) {
        throw std::invalid_argument("the edge has other cells");
      }
      triangulation_.flip_edge(*cell, place_of(*cell, id[3]), place_of(*cell, id[4]));
    }
  }

  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// Finite cells and hidden beads at the frame just reached, as a static build has them where cells are flat
  /// there.
  [[nodiscard]] StaticTriangulation at_frame(bool first) const {
    if (!flat_ && dimension_ == 3) return {triangulation_.finite_cells(), hidden_, 3};
    const int k = first ? 0 : M::degree;
    return static_triangulation(control_points(motion_, k), control_weights(motion_, k));
  }

 private:
  struct FacetGuard {
    Guard guard = Guard::violated;
    bool orientation = false;
  };

  // Building.

  void build_from_control_points(int k) {
    const StaticTriangulation built =
        triangulation_.build(control_points(motion_, k), control_weights(motion_, k));
    hidden_ = built.hidden;
    dimension_ = built.dimension;
    flat_ = false;
  }

  [[nodiscard]] StaticTriangulation exact_static(const Dyadic& time, bool oriented) const {
    std::vector<ExactBead> beads(motion_.bead_count());
    for (BeadId b = 0; b < beads.size(); ++b) {
      auto position = exact_position(motion_, b, time);
      beads[b] = {{position[0], position[1], position[2]}, position[3]};
    }
    return static_triangulation(beads, oriented);
  }

  bool assign_static(const Dyadic& time) {
    const StaticTriangulation built = exact_static(time, true);
    if (built.dimension < 3 || !built.hidden.empty()) {
      hidden_ = built.hidden;
      return false;
    }
    triangulation_.assign(motion_.bead_count(), built.cells);
    hidden_.clear();
    dimension_ = 3;
    return true;
  }

  /// Rebuilds at the first time on ever finer grids after now before which nothing fails.
  void rebuild_at_first_time_that_works();
  /// `fast`: rebuilds near now from doubles, a few times a step; what is violated then stays so.
  void rebuild_roughly();
  void drop_all();
  [[nodiscard]] bool nothing_fails_until(const Dyadic& time);
  void record_rebuild(const Dyadic& time);

  /// Whether the cells that are flat at the start of the step are positive just after.
  [[nodiscard]] bool flat_cells_open() {
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (triangulation_.is_live(cell) && !positive_just_after(triangulation_.cells()[cell].vertex))
        return false;
    }
    return true;
  }

  // Facets.

  [[nodiscard]] int place_of(CellId cell, BeadId bead) const {
    const auto& v = triangulation_.cells()[cell].vertex;
    return static_cast<int>(std::find(v.begin(), v.end(), bead) - v.begin());
  }
  [[nodiscard]] BeadId vertex(CellId cell, int i) const {
    return triangulation_.cells()[cell].vertex[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] CellId neighbor(CellId cell, int i) const {
    return triangulation_.cells()[cell].neighbor[static_cast<std::size_t>(i)];
  }
  /// The bead across facet i.
  [[nodiscard]] BeadId apex(CellId cell, int i) const {
    return vertex(neighbor(cell, i), triangulation_.mirror_index(cell, i));
  }
  FacetGuard& guard(CellId cell, int i) { return guards_[cell][static_cast<std::size_t>(i)]; }
  void set_guard(CellId cell, int i, FacetGuard value) {
    guard(cell, i) = value;
    guard(neighbor(cell, i), triangulation_.mirror_index(cell, i)) = value;
  }
  void forget(CellId cell, int i) { set_guard(cell, i, {Guard::violated, false}); }

  void watch(CellId cell, int i);
  void drop(CellId cell, int i) {
    const FacetGuard g = guard(cell, i);
    if (g.orientation) {
      orientations_.drop(g.guard);
    } else {
      power_tests_.drop(g.guard);
    }
    forget(cell, i);
  }
  void watch_all() {
    guards_.assign(triangulation_.cells().size(), {});
    for_all_facets([this](CellId cell, int i) { watch(cell, i); });
  }
  template <class Visit>
  void for_all_facets(Visit visit) const {
    for (CellId cell = 0; cell < triangulation_.cells().size(); ++cell) {
      if (!triangulation_.is_live(cell)) continue;
      for (int i = 0; i < 4; ++i) {
        if (cell < neighbor(cell, i)) visit(cell, i);
      }
    }
  }
  void count_certificates_per_bead();

  // Flips.

  void repair(CellId cell, int facet);
  [[nodiscard]] bool positive_just_after(const CellBeads& cell);
  [[nodiscard]] bool can_replace(std::span<const CellBeads> old, std::span<const CellBeads> made);
  /// The cell with e in place i instead: its orientation is that of the cell if e is on the same side.
  [[nodiscard]] static CellBeads with(CellBeads cell, int i, BeadId e) {
    cell[static_cast<std::size_t>(i)] = e;
    return cell;
  }
  /// The finite facet of an infinite cell, counterclockwise from outside; none of a finite cell.
  [[nodiscard]] static std::optional<std::array<BeadId, 3>> hull_triangle(const CellBeads& v) {
    const auto place = std::find(v.begin(), v.end(), infinite_bead) - v.begin();
    if (place == 4) return std::nullopt;
    if (place == 3) return std::array{v[0], v[1], v[2]};
    std::array<BeadId, 3> triangle{v[0], v[1], v[2]};
    triangle[static_cast<std::size_t>(place)] = v[3];
    std::swap(triangle[0], triangle[1]);  // one exchange made good by another
    return triangle;
  }
  void flip_to_edge(CellId cell, int facet);
  void flip_to_facet(CellId cell, int facet, int other);
  template <std::size_t N>
  void watch_around(const std::array<CellId, N>& cells);

  Simulator& simulator_;
  const M& motion_;
  std::size_t index_;
  CertificateTable<PowerTest, M, K> power_tests_;
  CertificateTable<Orientation, M, K> orientations_;
  RegularTriangulation triangulation_;
  std::vector<std::array<FacetGuard, 4>> guards_;
  std::vector<BeadId> hidden_;
  int dimension_ = 3;
  bool flat_ = false;  // some cell is flat at the frame just reached
  int rebuilds_in_step_ = 0;
  Identity present_;  // of the certificate that fails now
};

template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch(CellId cell, int i) {
  const CellBeads& v = triangulation_.cells()[cell].vertex;
  const std::array<BeadId, 5> five{v[0], v[1], v[2], v[3], apex(cell, i)};
  const std::uint32_t place = 4 * cell + static_cast<std::uint32_t>(i);
  const auto infinite = std::find(five.begin(), five.end(), infinite_bead);
  const auto birth = [this](const Identity& identity) {
    return identity == present_ ? Birth::at_own_root : Birth::unknown;
  };
  FacetGuard g;
  if (infinite == five.end()) {
    const PowerTest test(five, 1);
    g = {power_tests_.watch(test, place, birth(test.identity())), false};
  } else {
    // A row (0,0,0,1) at place k: expand the power test's determinant along it.
    std::array<BeadId, 4> four{};
    std::copy(infinite + 1, five.end(), std::copy(five.begin(), infinite, four.begin()));
    const Orientation orientation(four, (infinite - five.begin()) % 2 == 0 ? 1 : -1);
    g = {orientations_.watch(orientation, place, birth(orientation.identity())), true};
  }
  if (g.guard == Guard::violated) unsettled = true;
  set_guard(cell, i, g);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::repair(CellId cell, int facet) {
  // Edges of the facet with three cells only: across the facet's other vertices, both cells meet the same
  // one.
  const CellId other = neighbor(cell, facet);
  int edges = 0;
  int removed = 0;
  for (int k = 0; k < 4; ++k) {
    if (k == facet) continue;
    if (neighbor(cell, k) == neighbor(other, place_of(other, vertex(cell, k)))) {
      ++edges;
      removed = k;
    }
  }
  if (edges == 0) {
    flip_to_edge(cell, facet);
  } else if (edges == 1) {
    flip_to_facet(cell, facet, removed);
  } else {
    unsettled = true;  // a bead would vanish: equal weights do that only where beads meet
  }
}

/// Whether a finite cell, in this order of vertices, has positive orientation just after now.
template <Motion M, Kernel K>
bool PowerDiagram<M, K>::positive_just_after(const CellBeads& cell) {
  if (std::find(cell.begin(), cell.end(), infinite_bead) != cell.end()) return true;
  const Orientation orientation(cell, 1);
  if (orientation.identity() == present_) return true;  // flat right now, and opening: that is the event
  return sign_just_after<K>(orientation, motion_, simulator_.now(), statistics.stages) > 0;
}

/// Whether the new cells are right just after now, given that the old ones were just before.
template <Motion M, Kernel K>
bool PowerDiagram<M, K>::can_replace(std::span<const CellBeads> old, std::span<const CellBeads> made) {
  std::vector<std::array<BeadId, 3>> hull;
  for (const auto cells : {old, made}) {
    for (const CellBeads& cell : cells) {
      if (const auto triangle = hull_triangle(cell)) hull.push_back(*triangle);
    }
  }
  for (std::size_t t = 1; t < hull.size(); ++t) {
    const auto& a = hull[0];
    const auto& b = hull[t];
    const SameTurn turn{{a[0], a[1], a[2], b[0], b[1], b[2]}};
    if (sign_now<K>(turn, motion_, simulator_.now(), statistics.stages) <= 0) return false;
  }
  return std::all_of(made.begin(), made.end(), [this](const CellBeads& c) { return positive_just_after(c); });
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::flip_to_edge(CellId cell, int facet) {
  const CellBeads v = triangulation_.cells()[cell].vertex;
  const BeadId d = v[static_cast<std::size_t>(facet)];
  const BeadId e = apex(cell, facet);
  const CellId other = neighbor(cell, facet);
  std::array<CellBeads, 3> new_cells{};
  for (int k = 0, next = 0; k < 4; ++k) {
    if (k != facet) new_cells[static_cast<std::size_t>(next++)] = with(v, k, e);
  }
  const std::array<CellBeads, 2> old_cells{v, triangulation_.cells()[other].vertex};
  if (triangulation_.is_edge(d, e) || !can_replace(old_cells, new_cells)) {
    unsettled = true;
    return;
  }

  Change change{flip23, 5, {}};
  std::size_t next = 0;
  for (const BeadId b : v) {
    if (b != d) change.ids[next++] = b;
  }
  std::sort(change.ids.begin(), change.ids.begin() + 3);
  change.ids[3] = std::min(d, e);
  change.ids[4] = std::max(d, e);

  for (int i = 0; i < 4; ++i) {
    if (i != facet) drop(cell, i);
    if (neighbor(other, i) != cell) drop(other, i);
  }
  const std::array<CellId, 3> made = triangulation_.flip_facet(cell, facet);
  guards_.resize(triangulation_.cells().size());
  simulator_.record(index_, change);
  watch_around(made);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::flip_to_facet(CellId cell, int facet, int other_vertex) {
  // The edge joins the facet's two vertices other than `other_vertex`; d, e and `other_vertex` make the new
  // facet.
  const CellBeads v = triangulation_.cells()[cell].vertex;
  const BeadId d = v[static_cast<std::size_t>(facet)];
  const BeadId e = apex(cell, facet);
  const BeadId c = v[static_cast<std::size_t>(other_vertex)];
  std::array<int, 2> edge{};
  std::size_t found = 0;
  for (int k = 0; k < 4; ++k) {
    if (k != facet && k != other_vertex) edge[found++] = k;
  }
  const std::array<CellId, 3> old{cell, neighbor(cell, facet), neighbor(cell, other_vertex)};
  std::array<CellBeads, 3> old_cells{};
  for (std::size_t o = 0; o < 3; ++o) old_cells[o] = triangulation_.cells()[old[o]].vertex;
  if (!can_replace(old_cells, std::array{with(v, edge[0], e), with(v, edge[1], e)})) {
    unsettled = true;
    return;
  }

  Change change{flip32, 5, {c, d, e}};
  std::sort(change.ids.begin(), change.ids.begin() + 3);
  const auto [low, high] =
      std::minmax(v[static_cast<std::size_t>(edge[0])], v[static_cast<std::size_t>(edge[1])]);
  change.ids[3] = low;
  change.ids[4] = high;

  for (const CellId o : old) {
    for (int i = 0; i < 4; ++i) drop(o, i);  // the second drop of an inner facet finds it gone
  }
  const std::array<CellId, 2> made = triangulation_.flip_edge(cell, edge[0], edge[1]);
  simulator_.record(index_, change);
  watch_around(made);
}

/// Guards all facets of the new cells.
template <Motion M, Kernel K>
template <std::size_t N>
void PowerDiagram<M, K>::watch_around(const std::array<CellId, N>& cells) {
  for (std::size_t c = 0; c < N; ++c) {
    for (int i = 0; i < 4; ++i) {
      // A facet between two new cells is met twice.
      const auto before = cells.begin() + static_cast<std::ptrdiff_t>(c);
      if (std::find(cells.begin(), before, neighbor(cells[c], i)) == before) watch(cells[c], i);
    }
  }
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::count_certificates_per_bead() {
  std::vector<std::uint64_t> count(motion_.bead_count(), 0);
  for_all_facets([&](CellId cell, int i) {
    for (int k = 0; k < 4; ++k) {
      if (vertex(cell, k) != infinite_bead) ++count[vertex(cell, k)];
    }
    if (apex(cell, i) != infinite_bead) ++count[apex(cell, i)];
  });
  for (const std::uint64_t c : count) {
    statistics.certificates.per_bead_max = std::max(statistics.certificates.per_bead_max, c);
  }
}

// Rebuilding.

template <Motion M, Kernel K>
void PowerDiagram<M, K>::drop_all() {
  if (guards_.size() != triangulation_.cells().size()) return;
  for_all_facets([this](CellId cell, int i) { drop(cell, i); });
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::record_rebuild(const Dyadic& time) {
  ++statistics.rebuilds;
  Change change{rebuild, 1, {time.exponent()}};
  for (Integer rest = time.numerator(); rest != 0 && change.size < change.ids.size(); rest >>= 32U) {
    change.ids[change.size++] = static_cast<BeadId>(Integer(rest & 0xffffffffU));
  }
  simulator_.record(index_, change);
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::nothing_fails_until(const Dyadic& time) {
  ExactTime limit(time);
  const auto later = [&](auto& table, Guard guard) {
    if (!has_slot(guard)) return true;
    ExactTime failure = exact_time(table.exact_function(slot_of(guard)), table.time(slot_of(guard)));
    return ExactTime::compare(limit, failure) < 0;
  };
  bool all_later = true;
  for_all_facets([&](CellId cell, int i) {
    const FacetGuard g = guard(cell, i);
    if (all_later) all_later = g.orientation ? later(orientations_, g.guard) : later(power_tests_, g.guard);
  });
  return all_later;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::rebuild_at_first_time_that_works() {
  drop_all();
  present_ = {};
  for (unsigned bits = 8; bits <= finest_grid; bits += bits < 32 ? 4 : 12) {
    const Dyadic time = next_on_grid(simulator_.now().exact(), bits);
    if (!(time < Dyadic(1.0)) || !assign_static(time)) continue;
    unsettled = false;
    watch_all();
    if (!unsettled && nothing_fails_until(time)) {
      record_rebuild(time);
      return;
    }
    drop_all();
  }
  unsettled = false;
  if (!hidden_.empty()) {
    throw InputError("bead " + std::to_string(hidden_.front()) + " is hidden in the power diagram in step " +
                     std::to_string(simulator_.step()) +
                     " (it stays in one place with another bead); hidden beads are not supported yet");
  }
  throw InputError("all beads stay in one plane in step " + std::to_string(simulator_.step()) +
                   "; the power diagram in space needs four that do not");
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::rebuild_roughly() {
  constexpr int most_in_a_step = 8;
  if (++rebuilds_in_step_ > most_in_a_step) return;
  drop_all();
  present_ = {};
  const Dyadic time(std::min(1.0, simulator_.now().upper() + 0x1p-16));
  if (!assign_static(time)) return;
  watch_all();
  unsettled = false;
  record_rebuild(time);
}

// Auditing.

template <Motion M, Kernel K>
std::optional<std::string> PowerDiagram<M, K>::audit(const Dyadic& time) {
  const bool start = time == Dyadic(0.0);
  const bool end = time == Dyadic(1.0);
  if ((start || end) && !flat_ && dimension_ == 3) {
    const int k = start ? 0 : M::degree;
    const StaticTriangulation built =
        static_triangulation(control_points(motion_, k), control_weights(motion_, k));
    if (triangulation_.is_valid() && built.cells == triangulation_.finite_cells() && built.hidden == hidden_)
      return std::nullopt;
  } else if (!start && !end) {
    if (exact_static(time, false).cells == triangulation_.finite_cells()) return std::nullopt;
  }
  // Degenerate positions have several regular triangulations: check ours against all it must satisfy.
  std::optional<std::string> difference;
  const bool frame = start || end;
  for (CellId cell = 0; cell < triangulation_.cells().size() && !difference; ++cell) {
    const CellBeads& v = triangulation_.cells()[cell].vertex;
    if (!triangulation_.is_live(cell) || std::find(v.begin(), v.end(), infinite_bead) != v.end()) continue;
    const Orientation orientation(v, 1);
    const int sign = orientation.function(MomentView<M>(motion_, v, time)).scaled[0].sign();
    // A cell may be flat for a moment without any event, where its orientation has a double root.
    if (sign < 0 || (sign == 0 && !frame && exact_function(orientation, motion_).sign_after(time) <= 0))
      difference = "the cell of beads " + bead_names(v) + " is " + (sign < 0 ? "inverted" : "flat");
  }
  for_all_facets([&](CellId cell, int i) {
    if (difference) return;
    const CellBeads& v = triangulation_.cells()[cell].vertex;
    std::array<BeadId, 5> five{v[0], v[1], v[2], v[3], apex(cell, i)};
    const auto infinite = std::find(five.begin(), five.end(), infinite_bead);
    int sign = 0;
    if (infinite == five.end()) {
      sign = PowerTest(five, 1).function(MomentView<M>(motion_, five, time)).scaled[0].sign();
    } else {
      std::array<BeadId, 4> four{};
      std::copy(infinite + 1, five.end(), std::copy(five.begin(), infinite, four.begin()));
      sign = Orientation(four, (infinite - five.begin()) % 2 == 0 ? 1 : -1)
                 .function(MomentView<M>(motion_, four, time))
                 .scaled[0]
                 .sign();
    }
    if (sign < 0) difference = "the facet between beads " + bead_names(five) + " fails its test";
  });
  return difference;
}

}  // namespace kds
