#pragma once
// Kinetic power diagram in space, equal weights: CGAL's regular triangulation flipped while time runs. Each
// facet has its certificate (facet_certificate.h).
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

#include "kds/certificate_table.h"
#include "motions/input_error.h"
#include "motions/positions.h"
#include "structures/facet_certificate.h"
#include "structures/regular_triangulation.h"
#include "structures/triangulation_fault.h"

namespace kds {

template <Motion M, Kernel K>
class PowerDiagram final : public KineticStructure {
  static_assert(M::dimension == 3);

 public:
  PowerDiagram(Simulator& simulator, const M& motion)
      : simulator_(simulator),
        motion_(motion),
        index_(simulator.add(*this)),
        power_tests_(simulator, *this, index_, 0, motion, Touches::reported),
        orientations_(simulator, *this, index_, 1, motion, Touches::reported) {}

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
    if (!hidden_.empty() || dimension_ < 3 || (flat_ && is_wrong_just_after())) {
      rebuild_at_first_time_that_works();
    } else {
      watch_all();
    }
    flat_ = false;
    count_certificates_per_bead();
  }

  void fail(unsigned table, std::uint32_t slot) override {
    const FacetId place =
        table == 0 ? power_tests_.place_in_structure(slot) : orientations_.place_in_structure(slot);
    const CellId cell = cell_of(place);
    const int facet = index_of(place);
    const bool touch = table == 0 ? power_tests_.touches(slot) : orientations_.touches(slot);
    if (touch) suspect(Doubt::unclear);
    if (FacetGuard& held = guard(cell, facet); held.about == About::cell) {
      held.guard = Guard::violated;
      if (!touch) return suspect(Doubt::wrong);  // cospherical cells turn over: no flip tells how to go on
      return watch_cell(cell, facet);
    }
    forget(cell, facet);
    if (doubt_ == Doubt::wrong) return;
    if (touch) {
      enqueue(cell, facet);
      return watch_enqueued();
    }
    present_ = table == 0 ? power_tests_.identity(slot) : orientations_.identity(slot);
    if (simulator_.moment() == last_moment_ && present_ != last_identity_) suspect(Doubt::unclear);
    last_moment_ = simulator_.moment();
    last_identity_ = present_;
    repair(cell, facet);
    present_ = {};
  }

  void settle() override {
    const bool wrong = doubt_ == Doubt::wrong || is_wrong_just_after();
    settled();
    if (!wrong) return;
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
      if (triangulation_.is_facet(id[0], id[1], id[2]))
        throw std::invalid_argument("the facet stands already");
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
  /// In general position an event changes one flip's beads and nothing else. Where more happens at once, or a
  /// certificate touches zero, the diagram is checked after it, and rebuilt if it is wrong: cells can turn
  /// over unseen only at such moments.
  /// Certificates to be watched together.
  template <class Certificate>
  struct Batch {
    std::vector<Certificate> certificates;
    std::vector<std::uint32_t> places;
    std::vector<Birth> births;
    std::vector<Guard> guards;

    void add(const Certificate& certificate, std::uint32_t place, Birth birth) {
      certificates.push_back(certificate);
      places.push_back(place);
      births.push_back(birth);
    }
    void clear() {
      certificates.clear();
      places.clear();
      births.clear();
    }
  };

  enum class Doubt : std::uint8_t { none, unclear, wrong };
  void suspect(Doubt doubt) {
    doubt_ = std::max(doubt_, doubt);
    unsettled = true;
  }
  void settled() {
    doubt_ = Doubt::none;
    unsettled = false;
  }
  [[nodiscard]] bool is_wrong_just_after() {
    if constexpr (std::same_as<K, Fast>) return false;
    const auto sign = [this](const auto& function) {
      return sign_just_after<K>(function, motion_, simulator_.now(), statistics.stages);
    };
    return triangulation_fault(triangulation_, bead_count(), false, sign).has_value();
  }
  [[nodiscard]] BeadId bead_count() const { return static_cast<BeadId>(motion_.bead_count()); }

  /// What a facet's guard is about. Where a power test is zero for the whole step, five beads cospherical, it
  /// would not see the facet's cells turn over: then each side guards its own cell's orientation instead.
  enum class About : std::uint8_t { power, hull, cell };
  struct FacetGuard {
    Guard guard = Guard::violated;
    About about = About::power;
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
    hidden_ = built.hidden;
    dimension_ = built.dimension;
    if (dimension_ < 3 || !hidden_.empty()) return false;
    triangulation_.assign(motion_.bead_count(), built.cells);
    return true;
  }

  /// Rebuilds at the first time on ever finer grids after now before which nothing fails.
  void rebuild_at_first_time_that_works();
  /// `fast`: rebuilds near now from doubles, a few times a step; what is violated then stays so.
  void rebuild_roughly();
  void drop_all();
  [[nodiscard]] bool nothing_fails_until(const Dyadic& time);
  void record_rebuild(const Dyadic& time);

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
  [[nodiscard]] BeadId apex(CellId cell, int i) const {
    return triangulation_.apex(triangulation_.beyond(cell, i));
  }
  FacetGuard& guard(CellId cell, int i) { return guards_[cell][static_cast<std::size_t>(i)]; }
  void set_guard(CellId cell, int i, FacetGuard value) {
    guard(cell, i) = value;
    const auto [other, k] = across(cell, i);
    guard(other, k) = value;
  }
  void forget(CellId cell, int i) { set_guard(cell, i, {}); }

  template <class Certificate>
  [[nodiscard]] Birth birth_of(const Certificate& certificate) const {
    return certificate.identity() == present_ ? Birth::at_own_root : Birth::unknown;
  }
  auto& batch_of(const PowerTest&) { return power_batch_; }
  auto& batch_of(const Orientation&) { return hull_batch_; }
  /// Facets are guarded together: enqueue some, then watch them.
  void enqueue(CellId cell, int i);
  void watch_enqueued();
  void watch_cells_beside(CellId cell, int i);
  void watch_cell(CellId cell, int i);
  void drop(CellId cell, int i);
  void watch_all() {
    guards_.assign(triangulation_.cells().size(), {});
    for_all_facets([this](CellId cell, int i) { enqueue(cell, i); });
    watch_enqueued();
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
  [[nodiscard]] bool can_replace(std::span<const CellBeads> old, std::span<const CellBeads> made);
  /// The cell with e in place i instead: its orientation is that of the cell if e is on the same side.
  [[nodiscard]] static CellBeads with(CellBeads cell, int i, BeadId e) {
    cell[static_cast<std::size_t>(i)] = e;
    return cell;
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
  Batch<PowerTest> power_batch_;
  Batch<Orientation> hull_batch_;
  RegularTriangulation triangulation_;
  std::vector<std::array<FacetGuard, 4>> guards_;
  std::vector<BeadId> hidden_;
  int dimension_ = 3;
  bool flat_ = false;  // some cell is flat at the frame just reached
  int rebuilds_in_step_ = 0;
  Doubt doubt_ = Doubt::none;
  Identity present_;  // of the certificate that fails now
  Identity last_identity_;
  std::uint64_t last_moment_ = 0;
};

template <Motion M, Kernel K>
void PowerDiagram<M, K>::enqueue(CellId cell, int i) {
  with_facet_certificate(triangulation_.cells()[cell].vertex, apex(cell, i),
                         [&]<class Certificate>(const Certificate& certificate) {
                           batch_of(certificate).add(certificate, facet_id(cell, i), birth_of(certificate));
                         });
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_enqueued() {
  const auto watch = [this](auto& table, auto& batch, About about) {
    batch.guards.resize(batch.certificates.size());
    table.watch(batch.certificates, batch.places, batch.births, batch.guards);
    for (std::size_t b = 0; b < batch.guards.size(); ++b) {
      const CellId cell = cell_of(batch.places[b]);
      const int i = index_of(batch.places[b]);
      if (batch.guards[b] == Guard::violated) suspect(Doubt::wrong);
      set_guard(cell, i, {batch.guards[b], about});
      if (batch.guards[b] == Guard::zero && about == About::power) watch_cells_beside(cell, i);
    }
    batch.clear();
  };
  watch(power_tests_, power_batch_, About::power);
  watch(orientations_, hull_batch_, About::hull);
}

/// Where a power test is zero for the whole step.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_cells_beside(CellId cell, int i) {
  power_tests_.drop(guard(cell, i).guard);
  for (const auto& [own, k] : {std::pair(cell, i), across(cell, i)}) watch_cell(own, k);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::watch_cell(CellId cell, int i) {
  const Orientation orientation(triangulation_.cells()[cell].vertex, 1);
  guard(cell, i) = {orientations_.watch(orientation, facet_id(cell, i), birth_of(orientation)), About::cell};
  if (guard(cell, i).guard == Guard::violated) suspect(Doubt::wrong);
}

/// Gives up a facet's guard. One of other beads that fails right now as well would have meant another change.
template <Motion M, Kernel K>
void PowerDiagram<M, K>::drop(CellId cell, int i) {
  const auto give_up = [&](auto& table, Guard guard) {
    if (has_slot(guard) && table.time(slot_of(guard)).lower <= simulator_.now().upper() &&
        table.identity(slot_of(guard)) != present_)
      suspect(Doubt::unclear);
    table.drop(guard);
  };
  const FacetGuard facet = guard(cell, i);
  if (facet.about == About::power) {
    give_up(power_tests_, facet.guard);
  } else {
    give_up(orientations_, facet.guard);
  }
  if (facet.about == About::cell) {
    const auto [other, k] = across(cell, i);
    give_up(orientations_, guard(other, k).guard);
  }
  forget(cell, i);
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
    suspect(Doubt::wrong);  // a bead would vanish: equal weights do that only where beads meet
  }
}

/// Whether new cells may take the place of old ones.
template <Motion M, Kernel K>
bool PowerDiagram<M, K>::can_replace(std::span<const CellBeads> old, std::span<const CellBeads> made) {
  const Instant& now = simulator_.now();
  std::array<Orientation, 3> finite;
  std::size_t count = 0;
  for (const CellBeads& cell : made) {
    const Orientation orientation(cell, 1);
    if (orientation.beads[3] == infinite_bead) continue;
    if (orientation.identity() == present_) continue;  // flat now, and opening: that is the event
    finite[count++] = orientation;
  }
  if (!all_positive_now<K>(std::span<const Orientation>(finite.data(), count), motion_, now,
                           statistics.stages)) {
    suspect(Doubt::unclear);
    for (std::size_t i = 0; i < count; ++i) {
      if (sign_just_after<K>(finite[i], motion_, now, statistics.stages) <= 0) return false;
    }
  }
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
    if (sign_now<K>(turn, motion_, now, statistics.stages) <= 0) return false;
  }
  return true;
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
  // In exact geometry new cells that are positive have no edge that stands already.
  const bool doubtful = std::same_as<K, Fast> || present_.beads[4] == no_bead;
  if ((doubtful && triangulation_.is_edge(d, e)) || !can_replace(old_cells, new_cells)) {
    suspect(Doubt::wrong);
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
  if ((std::same_as<K, Fast> && triangulation_.is_facet(c, d, e)) ||
      !can_replace(old_cells, std::array{with(v, edge[0], e), with(v, edge[1], e)})) {
    suspect(Doubt::wrong);
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
      if (std::find(cells.begin(), before, neighbor(cells[c], i)) == before) enqueue(cells[c], i);
    }
  }
  watch_enqueued();
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
  if (guards_.empty()) return;
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
  const auto facet_later = [&](FacetGuard g) {
    return g.about == About::power ? later(power_tests_, g.guard) : later(orientations_, g.guard);
  };
  bool all_later = true;
  for_all_facets([&](CellId cell, int i) {
    const auto [other, k] = across(cell, i);
    all_later = all_later && facet_later(guard(cell, i)) &&
                (guard(cell, i).about != About::cell || facet_later(guard(other, k)));
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
    settled();
    watch_all();
    if (doubt_ != Doubt::wrong && nothing_fails_until(time)) {
      settled();
      record_rebuild(time);
      return;
    }
    drop_all();
  }
  settled();
  if (!hidden_.empty()) {
    throw InputError("bead " + std::to_string(hidden_.front()) + " is hidden in the power diagram in step " +
                     std::to_string(simulator_.step()) +
                     " (it stays in one place with another bead); hidden beads are not supported yet");
  }
  if (dimension_ < 3) {
    throw InputError("all beads stay in one plane in step " + std::to_string(simulator_.step()) +
                     "; the power diagram in space needs four that do not");
  }
  throw InputError("step " + std::to_string(simulator_.step()) + " at u = " +
                   std::to_string(simulator_.now().upper()) + ": events of the power diagram within 2^-" +
                   std::to_string(finest_grid) + " of the step, closer than it can be rebuilt between");
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::rebuild_roughly() {
  constexpr int most_in_a_step = 8;
  if (++rebuilds_in_step_ > most_in_a_step) return;
  drop_all();
  present_ = {};
  const Dyadic time(simulator_.now().upper() + 0x1p-16);
  if (!(time < Dyadic(1.0)) || !assign_static(time)) return watch_all();  // as it is
  watch_all();
  settled();
  record_rebuild(time);
}

// Auditing.

template <Motion M, Kernel K>
std::optional<std::string> PowerDiagram<M, K>::audit(const Dyadic& time) {
  const bool start = time == Dyadic(0.0);
  const bool end = time == Dyadic(1.0);
  if (dimension_ < 3) return std::nullopt;  // at a frame only, where the answer is CGAL's (at_frame)
  if ((start || end) && !flat_ && dimension_ == 3) {
    const int k = start ? 0 : M::degree;
    const StaticTriangulation built =
        static_triangulation(control_points(motion_, k), control_weights(motion_, k));
    if (triangulation_.is_valid() && built.cells == triangulation_.finite_cells() && built.hidden == hidden_)
      return std::nullopt;
  } else if (!start && !end) {
    if (exact_static(time, false).cells == triangulation_.finite_cells()) return std::nullopt;
  }
  // Degenerate positions have several regular triangulations: ours must satisfy the definition. Between
  // events what is zero at this very moment only is judged by its sign just after.
  const bool frame = start || end;
  return triangulation_fault(triangulation_, bead_count(), flat_, [&](const auto& function) {
    const int sign = function_of(function, MomentView<M>(motion_, function.beads, time)).scaled[0].sign();
    return sign != 0 || frame ? sign : exact_function(function, motion_).sign_after(time);
  });
}

}  // namespace kds
