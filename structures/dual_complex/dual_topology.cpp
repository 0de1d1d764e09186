#include "structures/dual_complex/dual_topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace kds {

namespace {

using Components = FollowedComponents;

constexpr std::array<IdRole, 2> component_roles{{{"component", 1, IdRole::Of::number}, {"simplex", 0}}};
constexpr std::array<IdRole, 2> components_roles{{{"components", 2, IdRole::Of::number}, {"simplex", 0}}};
constexpr std::array<IdRole, 2> void_roles{{{"void", 1, IdRole::Of::number}, {"simplex", 0}}};
constexpr std::array<IdRole, 2> voids_roles{{{"voids", 2, IdRole::Of::number}, {"simplex", 0}}};
constexpr std::array<IdRole, 1> tunnel_roles{{{"simplex", 0}}};
constexpr std::array<EventKind, 14> topology_kinds{{{"component_begin", true, false, component_roles},
                                                    {"component_end", true, false, component_roles},
                                                    {"component_merge", true, false, components_roles},
                                                    {"component_split", true, false, components_roles},
                                                    {"void_begin", true, false, void_roles},
                                                    {"void_end", true, false, void_roles},
                                                    {"void_merge", true, false, voids_roles},
                                                    {"void_split", true, false, voids_roles},
                                                    {"void_open", true, false, void_roles},
                                                    {"void_close", true, false, void_roles},
                                                    {"cell_begin", false, false, void_roles},
                                                    {"cell_end", false, false, void_roles},
                                                    {"tunnel_begin", true, false, tunnel_roles},
                                                    {"tunnel_end", true, false, tunnel_roles}}};

/// Returns the first simplex of this dimension that `suits`. If none does, returns the first one of the
/// dimension, or null.
template <class Suits>
const DimensionAndBeads* find_simplex(std::span<const DimensionAndBeads> among, int dimension, Suits suits) {
  const DimensionAndBeads* found = nullptr;
  for (const DimensionAndBeads& simplex : among) {
    if (simplex.first != dimension) continue;
    if (suits(simplex.second)) return &simplex;
    if (found == nullptr) found = &simplex;
  }
  return found;
}

/// Returns whether an edge that ends was a side of a triangle whose other sides stay in the complex, so that
/// its ends stay joined. Returns false if more than 32 simplices end.
bool has_way_around(std::span<const DimensionAndBeads> ends, const SimplexBeads& edge) {
  constexpr std::size_t few = 32;
  if (ends.size() > few) return false;
  const auto ends_too = [&](BeadId a, BeadId b) {
    const DimensionAndBeads side{1, {std::min(a, b), std::max(a, b), no_bead, no_bead}};
    return std::find(ends.begin(), ends.end(), side) != ends.end();
  };
  return std::any_of(ends.begin(), ends.end(), [&](const DimensionAndBeads& simplex) {
    const auto& [dimension, beads] = simplex;
    if (dimension != 2 || !std::includes(beads.begin(), beads.begin() + 3, edge.begin(), edge.begin() + 2))
      return false;
    const BeadId third = beads[0] != edge[0] ? beads[0] : beads[1] != edge[1] ? beads[1] : beads[2];
    return !ends_too(edge[0], third) && !ends_too(edge[1], third);
  });
}

bool are(std::array<Components::Number, 2> numbers, Components::Number a, Components::Number b) {
  return std::minmax(numbers[0], numbers[1]) == std::minmax(a, b);
}

}  // namespace

/// Graph whose nodes are the beads of the complex and whose arcs are its edges.
template <int Dimension>
class DualTopology<Dimension>::ComponentGraph {
 public:
  explicit ComponentGraph(const DualComplex<Dimension>& complex) : complex_(complex) {}

  template <class Visit>
  void for_neighbours(BeadId bead, Visit visit) const {
    complex_.faces().any_coface({0, bead}, [&](SimplexName edge, BeadId other) {
      if (complex_.has(edge)) visit(other);
      return false;
    });
  }
  [[nodiscard]] static bool is_outer(BeadId) { return false; }
  [[nodiscard]] static bool is_before(BeadId a, BeadId b) { return a < b; }
  [[nodiscard]] static Number heir_of(BeadId) { return Components::none; }

 private:
  const DualComplex<Dimension>& complex_;
};

/// Graph of the cells outside the complex, which facets outside the complex join.
template <int Dimension>
class DualTopology<Dimension>::VoidGraph {
 public:
  VoidGraph(const DualComplex<Dimension>& complex, const std::vector<Number>& heir_of)
      : complex_(complex), heir_of_(heir_of) {}

  template <class Visit>
  void for_neighbours(CellId cell, Visit visit) const {
    for (int i = 0; i <= Dimension; ++i) {
      const auto facet = complex_.faces().facet(cell, i);
      if (!facet || !complex_.has(*facet)) visit(cell_of(complex_.triangulation().beyond(cell, i)));
    }
  }
  [[nodiscard]] bool is_outer(CellId cell) const { return !complex_.faces().is_live({Dimension, cell}); }
  [[nodiscard]] bool is_before(CellId a, CellId b) const { return beads_of(a) < beads_of(b); }
  [[nodiscard]] Number heir_of(CellId cell) const {
    return cell < heir_of_.size() ? heir_of_[cell] : Components::none;
  }
  /// Returns the beads, ascending, with the infinite one last.
  [[nodiscard]] CellBeads<Dimension> beads_of(CellId cell) const {
    auto beads = complex_.triangulation().cells()[cell].vertex;
    std::sort(beads.begin(), beads.end());
    return beads;
  }
  /// Returns whether a live cell is a node: infinite, or outside the complex.
  [[nodiscard]] bool has(CellId cell) const { return is_outer(cell) || !complex_.has({Dimension, cell}); }

 private:
  const DualComplex<Dimension>& complex_;
  const std::vector<Number>& heir_of_;
};

template <int Dimension>
DualTopology<Dimension>::DualTopology(Simulator& simulator, std::size_t bead_count,
                                      DualComplex<Dimension>& complex)
    : StructureBase(simulator, bead_count, "voids",
                    std::span(topology_kinds).first(Dimension == 3 ? tunnel_end + 1 : tunnel_begin)),
      complex_(complex) {
  complex.set_follower(this);
}

template <int Dimension>
std::int64_t DualTopology<Dimension>::euler_of_complex() const {
  std::int64_t euler = 0;
  for (int dimension = 0; dimension <= Dimension; ++dimension) {
    const auto count = static_cast<std::int64_t>(complex_.simplices(dimension).size());
    euler += dimension % 2 == 0 ? count : -count;
  }
  return euler;
}

template <int Dimension>
std::int64_t DualTopology<Dimension>::tunnels() const {
  if constexpr (Dimension == 2) return 0;
  return components_.count() + voids_.count() - euler_;
}

template <int Dimension>
std::array<std::int64_t, 3> DualTopology<Dimension>::betti() const {
  if (replayed_) return replayed_->betti;
  if constexpr (Dimension == 2) return {components_.count(), voids_.count(), 0};
  return {components_.count(), tunnels(), voids_.count()};
}

template <int Dimension>
auto DualTopology<Dimension>::voids() const -> std::map<Number, std::vector<SimplexBeads>> {
  std::map<Number, std::vector<SimplexBeads>> voids;
  if (replayed_) return voids;
  for (const auto& [cell, beads] : void_cells_) voids[voids_.of(cell)].push_back(beads);
  for (auto& [number, cells] : voids) std::sort(cells.begin(), cells.end());
  return voids;
}

template <int Dimension>
std::map<Components::Number, std::vector<ComplementCell>> DualTopology<Dimension>::complement_cells() const
    requires(Dimension == 3) {
  std::map<Number, std::vector<ComplementCell>> voids;
  if (replayed_) return voids;
  for (const auto& [cell, beads] : void_cells_) {
    ComplementCell found{complex_.triangulation().cells()[cell].vertex};
    for (int i = 0; i < 4; ++i) {
      const unsigned bit = 1U << static_cast<unsigned>(i);
      if (complex_.has({0, found.beads[static_cast<std::size_t>(i)]}))
        found.vertices = static_cast<std::uint8_t>(found.vertices | bit);
      if (const auto facet = complex_.faces().facet(cell, i); complex_.has(*facet))
        found.triangles = static_cast<std::uint8_t>(found.triangles | bit);
    }
    for (std::size_t e = 0; e < tetrahedron_edges.size(); ++e)
      if (complex_.has(complex_.faces().edge(cell, e)))
        found.edges = static_cast<std::uint8_t>(found.edges | 1U << e);
    voids[voids_.of(cell)].push_back(found);
  }
  return voids;
}

template <int Dimension>
auto DualTopology<Dimension>::components() const -> std::map<Number, std::vector<BeadId>> {
  std::map<Number, std::vector<BeadId>> components;
  if (replayed_) return components;
  for (BeadId bead = 0; bead < bead_count(); ++bead)
    if (const Number number = components_.of(bead); number != Components::none)
      components[number].push_back(bead);
  return components;
}

template <int Dimension>
std::vector<SimplexBeads> DualTopology<Dimension>::void_cells() const {
  if (replayed_) return {replayed_->void_cells.begin(), replayed_->void_cells.end()};
  std::vector<SimplexBeads> all;
  for (const auto& [cell, beads] : void_cells_) all.push_back(beads);
  std::sort(all.begin(), all.end());
  return all;
}

template <int Dimension>
void DualTopology<Dimension>::build() {
  components_ = Components(false);
  voids_ = Components(true);
  void_cells_.clear();
  replayed_.reset();
  heir_of_.clear();
  made_.clear();
  cut_.clear();
  euler_ = 0;
  if (!complex_.knows_faces()) return;
  euler_ = euler_of_complex();
  std::vector<BeadId> beads;
  for (const SimplexBeads& vertex : complex_.simplices(0)) beads.push_back(vertex[0]);
  static_cast<void>(components_.update(ComponentGraph(complex_), std::move(beads), {}, {}));
  const VoidGraph graph(complex_, heir_of_);
  std::vector<CellId> cells;
  for (CellId cell = 0; cell < complex_.triangulation().cells().size(); ++cell)
    if (complex_.triangulation().is_live(cell) && graph.has(cell)) cells.push_back(cell);
  static_cast<void>(voids_.update(graph, cells, {}, {}));
  for (const CellId cell : cells)
    if (voids_.of(cell) != Components::outside)
      void_cells_.emplace(cell, complex_.faces().beads_of({Dimension, cell}));
}

template <int Dimension>
auto DualTopology<Dimension>::void_or_heir(CellId cell) const -> Number {
  const Number number = voids_.of(cell);
  return number == Components::none && cell < heir_of_.size() ? heir_of_[cell] : number;
}

template <int Dimension>
void DualTopology<Dimension>::name_heirs(std::span<const CellId> made, const BeadsOfVoids& beads_of) {
  made_.insert(made_.end(), made.begin(), made.end());
  heir_of_.resize(std::max(heir_of_.size(), complex_.triangulation().cells().size()), Components::none);
  for (const CellId cell : made) {
    heir_of_[cell] = Components::none;
    const auto& vertices = complex_.triangulation().cells()[cell].vertex;
    for (const auto& [number, beads] : beads_of)
      if (std::all_of(vertices.begin(), vertices.end(), [&](BeadId b) { return beads.contains(b); })) {
        heir_of_[cell] = number;
        break;
      }
  }
}

template <int Dimension>
void DualTopology<Dimension>::exchanged(std::span<const CellId> gone, std::span<const CellId> made) {
  BeadsOfVoids beads_of;
  for (const CellId cell : gone) {
    const Number number = void_or_heir(cell);
    voids_.forget(cell);
    if (number == Components::none || number == Components::outside) continue;
    const auto before = void_cells_.find(cell);
    if (before != void_cells_.end()) beads_of[number].insert(before->second.begin(), before->second.end());
  }
  if (beads_of.size() == 1)  // all beads that the new cells may have
    for (const CellId cell : made)
      beads_of.begin()->second.insert(complex_.triangulation().cells()[cell].vertex.begin(),
                                      complex_.triangulation().cells()[cell].vertex.end());
  name_heirs(made, beads_of);
}

template <int Dimension>
void DualTopology<Dimension>::replaced_all() {
  BeadsOfVoids beads_of;
  for (const auto& [cell, beads] : void_cells_)
    if (const Number number = void_or_heir(cell); number != Components::none)
      beads_of[number].insert(beads.begin(), beads.end());
  voids_.forget_all();
  made_.clear();
  std::vector<CellId> made;
  for (CellId cell = 0; cell < complex_.triangulation().cells().size(); ++cell)
    if (complex_.triangulation().is_live(cell)) made.push_back(cell);
  name_heirs(made, beads_of);
}

template <int Dimension>
void DualTopology<Dimension>::cut_around(CellId cell) {
  for (int i = 0; i <= Dimension; ++i) cut_.push_back(cell_of(complex_.triangulation().beyond(cell, i)));
}

template <int Dimension>
void DualTopology<Dimension>::report(Kind kind, std::initializer_list<Number> numbers,
                                     const DimensionAndBeads* simplex) {
  Change change{kind, static_cast<std::uint8_t>(numbers.size()), {}};
  std::copy(numbers.begin(), numbers.end(), change.ids.begin());
  if (simplex != nullptr) {
    const auto count = static_cast<std::size_t>(simplex->first) + 1;
    std::copy_n(simplex->second.begin(), count, change.ids.begin() + change.size);
    change.size = static_cast<std::uint8_t>(change.size + count);
    reported_.push_back(simplex);
  }
  record(change);
}

template <int Dimension>
void DualTopology<Dimension>::follow_components(const ComplexChange& change) {
  std::vector<BeadId> added, cut;
  std::vector<Components::Join> joins;
  for (const auto& [dimension, beads] : change.ends) {
    if (dimension == 0) components_.forget(beads[0]);
    if (dimension == 1 && !has_way_around(change.ends, beads)) cut.insert(cut.end(), {beads[0], beads[1]});
  }
  for (std::uint32_t i = 0; i < change.begins.size(); ++i) {
    const auto& [dimension, beads] = change.begins[i];
    if (dimension == 0) added.push_back(beads[0]);
    if (dimension == 1) joins.push_back({beads[0], beads[1], i});
  }
  const Components::Changes& what =
      components_.update(ComponentGraph(complex_), std::move(added), joins, std::move(cut));
  const auto any = [](const SimplexBeads&) { return true; };
  for (const auto& [kept, gone, by] : what.merges)
    report(component_merge, {kept, gone},
           by != Components::by_no_arc ? &change.begins[by] : find_simplex(change.begins, 1, any));
  for (const auto& [from, made, first] : what.splits)
    report(component_split, {from, made}, find_simplex(change.ends, 1, [&](const SimplexBeads& beads) {
             return are({components_.of(beads[0]), components_.of(beads[1])}, from, made);
           }));
  for (const auto& [number, last] : what.ended)
    report(component_end, {number},
           find_simplex(change.ends, 0, [&](const SimplexBeads& beads) { return beads[0] == last; }));
  for (const auto& born : what.born)
    report(component_begin, {born.number},
           find_simplex(change.begins, 0, [&](const SimplexBeads& beads) { return beads[0] == born.first; }));
}

template <int Dimension>
void DualTopology<Dimension>::follow_voids(const ComplexChange& change) {
  const VoidGraph graph(complex_, heir_of_);
  std::vector<CellId> added;
  std::vector<Components::Join> joins;
  for (const CellId cell : made_) {
    if (!complex_.triangulation().is_live(cell)) continue;
    if (graph.has(cell)) added.push_back(cell);
    cut_around(cell);
  }
  std::vector<std::pair<std::array<CellId, 2>, SimplexBeads>> closed;  // facets that began
  for (std::uint32_t i = 0; i < change.changed.size(); ++i) {
    const SimplexName simplex = change.changed[i];
    if (simplex.dimension < Dimension - 1) continue;
    const bool belongs = complex_.has(simplex);
    if (simplex.dimension == Dimension) {
      if (belongs) voids_.forget(simplex.number);
      belongs ? cut_around(simplex.number) : added.push_back(simplex.number);
      continue;
    }
    const auto cells = complex_.faces().cells_of(simplex);
    if (belongs) {
      cut_.insert(cut_.end(), cells.begin(), cells.end());
      closed.emplace_back(cells, complex_.faces().beads_of(simplex));
    } else {
      joins.push_back({cells[0], cells[1], i});
    }
  }
  const Components::Changes& what = voids_.update(graph, std::move(added), joins, std::move(cut_));
  const auto any = [](const SimplexBeads&) { return true; };
  const auto is = [](const SimplexBeads& wanted) {
    return [&wanted](const SimplexBeads& beads) { return beads == wanted; };
  };
  for (const auto& [kept, gone, by] : what.merges) {
    const DimensionAndBeads* facet =
        by == Components::by_no_arc
            ? find_simplex(change.ends, Dimension - 1, any)
            : find_simplex(change.ends, Dimension - 1, is(complex_.faces().beads_of(change.changed[by])));
    kept == Components::outside ? report(void_open, {gone}, facet) : report(void_merge, {kept, gone}, facet);
  }
  for (const auto& [from, made, first] : what.splits) {
    const auto between = [&, from = from, made = made](const SimplexBeads& beads) {
      return std::any_of(closed.begin(), closed.end(), [&](const auto& facet) {
        return facet.second == beads &&
               are({voids_.of(facet.first[0]), voids_.of(facet.first[1])}, from, made);
      });
    };
    const DimensionAndBeads* facet = find_simplex(change.begins, Dimension - 1, between);
    from == Components::outside ? report(void_close, {made}, facet) : report(void_split, {from, made}, facet);
  }
  for (const auto& [number, last] : what.ended)
    report(void_end, {number},
           find_simplex(change.begins, Dimension, is(complex_.faces().beads_of({Dimension, last}))));
  for (const auto& born : what.born)
    report(void_begin, {born.number},
           find_simplex(change.ends, Dimension, is(complex_.faces().beads_of({Dimension, born.first}))));
  follow_void_cells(what.added);
  for (const CellId cell : made_) heir_of_[cell] = Components::none;
  made_.clear();
  cut_.clear();
}

template <int Dimension>
void DualTopology<Dimension>::follow_void_cells(std::span<const CellId> added) {
  std::vector<std::pair<SimplexBeads, Number>> begins, ends;
  const auto is_kept = [&](CellId cell, const SimplexBeads& beads) {
    const Number number = voids_.of(cell);
    return number != Components::none && number != Components::outside &&
           complex_.faces().beads_of({Dimension, cell}) == beads;
  };
  std::erase_if(void_cells_, [&](const auto& entry) {
    if (is_kept(entry.first, entry.second)) return false;
    ends.emplace_back(entry.second, 0);
    return true;
  });
  for (const CellId cell : added) {
    if (voids_.of(cell) == Components::outside) continue;
    const SimplexBeads& beads = complex_.faces().beads_of({Dimension, cell});
    if (void_cells_.emplace(cell, beads).second) begins.emplace_back(beads, voids_.of(cell));
  }
  const auto report_all = [this](Kind kind, auto& cells) {
    std::sort(cells.begin(), cells.end());
    for (const auto& [beads, number] : cells) {
      const DimensionAndBeads simplex{Dimension, beads};
      report(kind, {number}, &simplex);
    }
  };
  report_all(cell_end, ends);
  report_all(cell_begin, begins);
}

/// Reports that the number of tunnels has changed. Prefers simplices that have no event yet.
template <int Dimension>
void DualTopology<Dimension>::report_tunnels(const ComplexChange& change, std::int64_t more) {
  const auto fits = [&](const DimensionAndBeads& simplex, bool begins) {
    return simplex.first == 1 ? begins == (more > 0) : simplex.first == 2 && begins == (more < 0);
  };
  std::vector<const DimensionAndBeads*> candidates;
  for (const DimensionAndBeads& simplex : change.ends)
    if (fits(simplex, false)) candidates.push_back(&simplex);
  for (const DimensionAndBeads& simplex : change.begins)
    if (fits(simplex, true)) candidates.push_back(&simplex);
  std::stable_partition(candidates.begin(), candidates.end(), [this](const DimensionAndBeads* simplex) {
    return std::find(reported_.begin(), reported_.end(), simplex) == reported_.end();
  });
  for (std::size_t i = 0; i < static_cast<std::size_t>(std::abs(more)); ++i)
    report(more > 0 ? tunnel_begin : tunnel_end, {},
           candidates.empty() ? nullptr : candidates[std::min(i, candidates.size() - 1)]);
}

template <int Dimension>
void DualTopology<Dimension>::settled(const ComplexChange& change) {
  const std::int64_t tunnels_before = tunnels();
  for (const auto& [dimension, beads] : change.ends) euler_ -= dimension % 2 == 0 ? 1 : -1;
  for (const auto& [dimension, beads] : change.begins) euler_ += dimension % 2 == 0 ? 1 : -1;
  follow_components(change);
  follow_voids(change);
  if (const std::int64_t more = tunnels() - tunnels_before; more != 0) report_tunnels(change, more);
  reported_.clear();
}

template <int Dimension>
void DualTopology<Dimension>::apply(const Change& change) {
  if (!replayed_) {
    const std::vector<SimplexBeads> cells = void_cells();
    replayed_ = Replayed{betti(), {cells.begin(), cells.end()}};
  }
  auto& [betti, cells] = *replayed_;
  if (change.kind == cell_begin || change.kind == cell_end) {
    if (change.size != Dimension + 2) throw std::invalid_argument("a cell has another number of beads");
    SimplexBeads beads{no_bead, no_bead, no_bead, no_bead};
    std::copy_n(change.ids.begin() + 1, Dimension + 1, beads.begin());
    const bool changed = change.kind == cell_begin ? cells.insert(beads).second : cells.erase(beads) > 0;
    if (!changed) throw std::invalid_argument("a cell of a void begins twice, or ends without a begin");
    return;
  }
  const bool is_of_component = change.kind <= component_split, is_of_tunnel = change.kind >= tunnel_begin;
  constexpr std::array more{component_begin, component_split, void_begin,
                            void_split,      void_close,      tunnel_begin};
  const bool is_more = std::find(more.begin(), more.end(), change.kind) != more.end();
  const int of = is_of_component ? 0 : is_of_tunnel ? 1 : Dimension - 1;
  betti[static_cast<std::size_t>(of)] += is_more ? 1 : -1;
}

template <int Dimension>
std::optional<std::string> DualTopology<Dimension>::audit(const Dyadic&) {
  if (replayed_ || !complex_.knows_faces()) return std::nullopt;
  // Searches each component and compares its nodes' numbers: one number for each component.
  const auto fault_of = [](const auto& graph, const Components& followed, std::vector<std::uint32_t> nodes,
                           std::string_view name, std::int64_t outside) -> std::optional<std::string> {
    std::set<std::uint32_t> left(nodes.begin(), nodes.end());
    std::set<Number> numbers;
    while (!left.empty()) {
      std::vector<std::uint32_t> reached{*left.begin()};
      const Number number = followed.of(reached[0]);
      left.erase(left.begin());
      for (std::size_t next = 0; next < reached.size(); ++next) {
        if (followed.of(reached[next]) != number)
          return fmt::format("one {} has the numbers {} and {}", name, number, followed.of(reached[next]));
        graph.for_neighbours(reached[next], [&](std::uint32_t node) {
          if (left.erase(node) > 0) reached.push_back(node);
        });
      }
      if (!numbers.insert(number).second) return fmt::format("two {}s have the number {}", name, number);
    }
    const auto count = static_cast<std::int64_t>(numbers.size()) - outside;
    if (followed.count() != count)
      return fmt::format("there are {} {}s, not {}", count, name, followed.count());
    return std::nullopt;
  };
  std::vector<std::uint32_t> beads, cells;
  for (const SimplexBeads& vertex : complex_.simplices(0)) beads.push_back(vertex[0]);
  if (auto fault = fault_of(ComponentGraph(complex_), components_, beads, "component", 0)) return fault;
  const VoidGraph graph(complex_, heir_of_);
  std::size_t in_voids = 0;
  for (CellId cell = 0; cell < complex_.triangulation().cells().size(); ++cell) {
    if (!complex_.triangulation().is_live(cell) || !graph.has(cell)) continue;
    cells.push_back(cell);
    if (graph.is_outer(cell) && voids_.of(cell) != Components::outside)
      return "an infinite cell is in a void";
    if (voids_.of(cell) == Components::outside) continue;
    ++in_voids;
    const auto known = void_cells_.find(cell);
    if (known == void_cells_.end() || known->second != complex_.faces().beads_of({Dimension, cell}))
      return "a cell of a void is missing";
  }
  if (in_voids != void_cells_.size()) return "a cell is wrongly in a void";
  if (auto fault = fault_of(graph, voids_, cells, "void", 1)) return fault;
  if (euler_ != euler_of_complex())
    return fmt::format("the Euler characteristic is {}, not {}", euler_of_complex(), euler_);
  return std::nullopt;
}

template class DualTopology<2>;
template class DualTopology<3>;

}  // namespace kds
