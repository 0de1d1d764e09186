#include "structures/dual_complex/dual_complex.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/search/predicate_searches.h"
#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/views/integer_view.h"

namespace kds {

namespace {

constexpr std::array<IdRole, 1> simplex_role{{{"simplex", 0}}};
constexpr std::array<EventKind, 8> simplex_kinds{{{"vertex_begin", true, false, simplex_role},
                                                  {"vertex_end", true, false, simplex_role},
                                                  {"edge_begin", true, false, simplex_role},
                                                  {"edge_end", true, false, simplex_role},
                                                  {"triangle_begin", true, false, simplex_role},
                                                  {"triangle_end", true, false, simplex_role},
                                                  {"tetrahedron_begin", true, false, simplex_role},
                                                  {"tetrahedron_end", true, false, simplex_role}}};

template <std::size_t N>
std::array<BeadId, N> first_of(const SimplexBeads& beads) {
  std::array<BeadId, N> first;
  std::copy_n(beads.begin(), N, first.begin());
  return first;
}

void keep_each_once(std::vector<SimplexName>& simplices) {
  std::sort(simplices.begin(), simplices.end());
  simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
}

std::span<const BeadId> used(const SimplexBeads& beads) {
  return {beads.begin(), std::find(beads.begin(), beads.end(), no_bead)};
}

}  // namespace

template <int Dimension>
DualComplex<Dimension>::DualComplex(Simulator& simulator, const MotionRef<Dimension>& motion,
                                    PowerDiagram<Dimension>& diagram)
    : StructureBase(simulator, motion.bead_count(), "dual",
                    std::span(simplex_kinds).first(2 * (Dimension + 1))),
      motion_(motion),
      diagram_(diagram),
      faces_(diagram.triangulation()),
      vertex_sizes_(simulator, *this, index(), 0, motion, TouchPolicy::reported),
      edge_sizes_(simulator, *this, index(), 1, motion, TouchPolicy::reported),
      triangle_sizes_(simulator, *this, index(), 2, motion, TouchPolicy::reported),
      sides_(centre_side_search<2>(motion), centre_side_search<3>(motion), nullptr) {
  if constexpr (Dimension == 3) {
    tetrahedron_sizes_ = std::make_unique<CertificateTable<SimplexSize<4>>>(simulator, *this, index(), 3U,
                                                                            motion, TouchPolicy::reported);
    std::get<2>(sides_) = centre_side_search<4>(motion);
  }
  diagram.set_follower(this);
}

template <int Dimension>
template <class Visit>
void DualComplex<Dimension>::for_all(int dimension, Visit visit) const {
  for (std::uint32_t number = 0; number < faces_.count(dimension); ++number)
    if (const SimplexName simplex{dimension, number}; faces_.is_live(simplex)) visit(simplex);
}

template <int Dimension>
template <class Visit>
void DualComplex<Dimension>::for_closure(SimplexName simplex, Visit visit) const {
  visit(simplex);
  if (simplex.dimension > 0)
    faces_.for_facets(simplex, [&](SimplexName facet) { for_closure(facet, visit); });
}

template <int Dimension>
template <class Use>
decltype(auto) DualComplex<Dimension>::with_table(int dimension, Use use) {
  if (dimension == 0) return use(vertex_sizes_, std::integral_constant<std::size_t, 1>());
  if (dimension == 1) return use(edge_sizes_, std::integral_constant<std::size_t, 2>());
  if constexpr (Dimension == 3)
    if (dimension == 3) return use(*tetrahedron_sizes_, std::integral_constant<std::size_t, 4>());
  return use(triangle_sizes_, std::integral_constant<std::size_t, 3>());
}

template <int Dimension>
template <std::size_t N>
SimplexSize<N> DualComplex<Dimension>::size_of(SimplexName simplex, int sign) const {
  return {first_of<N>(faces_.beads_of(simplex)), sign};
}

template <int Dimension>
int DualComplex<Dimension>::sign_of_size(SimplexName simplex, Moment moment) {
  return with_table(simplex.dimension,
                    [&]<std::size_t N>(auto& table, std::integral_constant<std::size_t, N>) {
                      return sign_of(table.search(), simulator().kernel(), size_of<N>(simplex, 1), moment,
                                     time(), statistics.stages);
                    });
}

// Exchanges of cells.

template <int Dimension>
void DualComplex<Dimension>::note(Happened what) {
  happened_ = happened_ == Happened::nothing ? what : Happened::much;
  needs_after_batch = true;
}

template <int Dimension>
void DualComplex<Dimension>::exchanged(std::span<const CellId> gone, std::span<const CellId> made,
                                       bool is_flip) {
  if (!has_certificates_) must_read_all_ = true;  // a replay, which makes no sizes
  if (must_read_all_) return;
  note(is_flip ? Happened::flip : Happened::much);
  any_gone_ = gone_is_small_ = small_face_is_gone_ = false;
  for (const CellId cell : gone) {
    const SimplexName simplex{Dimension, cell};
    if (cell >= faces_.count(Dimension) || !faces_.is_live(simplex)) continue;
    if (any_gone_ && of(simplex).is_small != gone_is_small_) note(Happened::much);
    any_gone_ = true;
    gone_is_small_ = of(simplex).is_small;
  }
  follow(faces_.exchange(gone, made));
  if (follower_ != nullptr) follower_->exchanged(gone, made);
}

template <int Dimension>
void DualComplex<Dimension>::replaced_all() {
  must_read_all_ = true;
  if (has_certificates_) note(Happened::much);
}

template <int Dimension>
void DualComplex<Dimension>::read_all_cells() {
  if (!must_read_all_) return;
  must_read_all_ = false;
  note(Happened::much);
  all_changed_ = true;
  follow(faces_.read_all());
  if (follower_ != nullptr) follower_->replaced_all();
}

template <int Dimension>
void DualComplex<Dimension>::follow(const typename TriangulationFaces<Dimension>::Exchange& exchange) {
  for (std::size_t dimension = 0; dimension < known_.size(); ++dimension)
    if (const std::size_t count = faces_.count(static_cast<int>(dimension)); known_[dimension].size() < count)
      known_[dimension].resize(count);
  for (const auto& [simplex, beads] : exchange.removed) {
    drop_gone(simplex);
    if (simplex.dimension < Dimension && of(simplex).is_small) small_face_is_gone_ = true;
    if (of(simplex).belongs) lost_.emplace_back(simplex.dimension, beads);
    of(simplex) = {};
  }
  around_.insert(around_.end(), exchange.kept.begin(), exchange.kept.end());
  for (const SimplexName& simplex : exchange.added) {
    of(simplex) = {};
    of(simplex).is_new = true;
    new_.push_back(simplex);
  }
}

// Sizes and their certificates.

template <int Dimension>
bool DualComplex<Dimension>::is_small_now(SimplexName simplex, Moment moment) {
  return has_small_facets(simplex) && sign_of_size(simplex, moment) <= 0;
}

template <int Dimension>
void DualComplex<Dimension>::find_sizes_of_new(Moment moment) {
  if (all_changed_) {
    new_.clear();
    for (int dimension = 0; dimension <= Dimension; ++dimension)
      for_all(dimension, [this](SimplexName simplex) { new_.push_back(simplex); });
  } else {
    std::sort(new_.begin(), new_.end());  // facets before the simplices that contain them
  }
  for (const SimplexName& simplex : new_) {
    if (!faces_.is_live(simplex) || !of(simplex).is_new) continue;
    of(simplex).is_small = is_small_now(simplex, moment);
    of(simplex).is_new = false;
    if (all_changed_) continue;
    changed_.push_back(simplex);
    for_closure(simplex, [this](SimplexName face) { unchecked_.push_back(face); });
  }
  if (all_changed_) {
    unchecked_.swap(new_);
    new_ = {};
    return;
  }
  new_.clear();
  // A cell at infinity may take the place of one that is gone: then nothing new contains these simplices.
  changed_.insert(changed_.end(), around_.begin(), around_.end());
  unchecked_.insert(unchecked_.end(), around_.begin(), around_.end());
}

template <int Dimension>
bool DualComplex<Dimension>::needs_certificate(SimplexName simplex) const {
  if (of(simplex).is_small)
    return !faces_.any_coface(simplex, [this](SimplexName other, BeadId) { return of(other).is_small; });
  return has_small_facets(simplex);
}

template <int Dimension>
bool DualComplex<Dimension>::has_small_facets(SimplexName simplex) const {
  bool all_small = true;
  if (simplex.dimension > 0)
    faces_.for_facets(simplex, [&](SimplexName facet) { all_small &= of(facet).is_small; });
  return all_small;
}

template <int Dimension>
void DualComplex<Dimension>::enqueue(SimplexName simplex) {
  of(simplex).is_enqueued = true;
  with_table(simplex.dimension, [&]<std::size_t N>(auto& table, std::integral_constant<std::size_t, N>) {
    table.enqueue_one_of_many(size_of<N>(simplex, of(simplex).is_small ? -1 : 1), simplex.number,
                              KnownAtStart::unknown);
  });
}

template <int Dimension>
void DualComplex<Dimension>::watch_enqueued() {
  for (int dimension = 0; dimension <= Dimension; ++dimension)
    with_table(dimension, [&](auto& table, auto) {
      table.watch_enqueued([&](std::uint32_t number, CertificateHandle handle) {
        keep({dimension, number}, handle);
      });
    });
}

/// Watches a simplex whose certificate has just failed or touched zero.
template <int Dimension>
void DualComplex<Dimension>::watch_again(SimplexName simplex) {
  with_table(simplex.dimension, [&]<std::size_t N>(auto& table, std::integral_constant<std::size_t, N>) {
    const int sign = of(simplex).is_small ? -1 : 1;
    keep(simplex, table.watch(size_of<N>(simplex, sign), simplex.number, KnownAtStart::at_own_root));
  });
}

template <int Dimension>
void DualComplex<Dimension>::keep(SimplexName simplex, CertificateHandle handle) {
  of(simplex).certificate = handle;
  of(simplex).is_enqueued = false;
  const bool stays_zero = handle == CertificateHandle::zero && !of(simplex).is_small;
  if (handle != CertificateHandle::violated && !stays_zero) return;
  note(Happened::much);
  toggle(simplex);
}

template <int Dimension>
void DualComplex<Dimension>::drop(SimplexName simplex) {
  if (of(simplex).certificate == CertificateHandle::violated) return;
  with_table(simplex.dimension, [&](auto& table, auto) { table.drop(of(simplex).certificate); });
  of(simplex).certificate = CertificateHandle::violated;
}

template <int Dimension>
void DualComplex<Dimension>::drop_gone(SimplexName simplex) {
  if (const CertificateHandle handle = of(simplex).certificate; has_slot(handle))
    with_table(simplex.dimension, [&](auto& table, auto) {
      if (table.time(slot_of(handle)).lower <= simulator().now().upper()) note(Happened::much);
    });
  drop(simplex);
}

template <int Dimension>
void DualComplex<Dimension>::toggle(SimplexName simplex) {
  of(simplex).is_small = !of(simplex).is_small;
  changed_.push_back(simplex);
  unchecked_.push_back(simplex);
  if (simplex.dimension > 0)
    faces_.for_facets(simplex, [this](SimplexName facet) { unchecked_.push_back(facet); });
  faces_.any_coface(simplex, [this](SimplexName other, BeadId) {
    unchecked_.push_back(other);
    return false;
  });
}

template <int Dimension>
void DualComplex<Dimension>::check_certificates() {
  while (!unchecked_.empty()) {
    while (!unchecked_.empty()) {
      const SimplexName simplex = unchecked_.back();
      unchecked_.pop_back();
      if (!faces_.is_live(simplex) || of(simplex).is_enqueued) continue;
      const bool needed = needs_certificate(simplex);
      if (needed == (of(simplex).certificate != CertificateHandle::violated)) continue;
      needed ? enqueue(simplex) : drop(simplex);
    }
    watch_enqueued();
  }
}

// The complex.

template <int Dimension>
template <class Use>
auto DualComplex<Dimension>::with_side(SimplexName simplex, BeadId beyond, Use use) const {
  const auto with = [&]<std::size_t N>(const CertificateSearch<CentreSide<N>>& search) {
    CentreSide<N> side;
    std::copy_n(faces_.beads_of(simplex).begin(), N - 1, side.beads.begin());
    side.beads[N - 1] = beyond;
    return use(search, side);
  };
  if (simplex.dimension == 0) return with(*std::get<0>(sides_));
  if constexpr (Dimension == 3)
    if (simplex.dimension == 2) return with(*std::get<2>(sides_));
  return with(*std::get<1>(sides_));
}

template <int Dimension>
bool DualComplex<Dimension>::is_attached(SimplexName simplex, Moment moment) {
  return faces_.any_coface(simplex, [&](SimplexName, BeadId beyond) {
    return with_side(simplex, beyond, [&](const auto& search, const auto& side) {
      return sign_of(search, simulator().kernel(), side, moment, time(), statistics.stages) < 0;
    });
  });
}

template <int Dimension>
bool DualComplex<Dimension>::must_belong(SimplexName simplex, Moment moment) {
  return of(simplex).is_small && (faces_.any_coface(simplex, [this](SimplexName other, BeadId) {
           return of(other).belongs;
         }) || !is_attached(simplex, moment));
}

template <int Dimension>
void DualComplex<Dimension>::set_membership(SimplexName simplex, bool belongs) {
  if (of(simplex).belongs == belongs) return;
  of(simplex).belongs = belongs;
  decided_.push_back(simplex);
  (belongs ? begins_ : ends_).emplace_back(simplex.dimension, faces_.beads_of(simplex));
}

/// Adds the simplices that contain the given ones, and all their faces.
template <int Dimension>
void DualComplex<Dimension>::add_all_around(std::vector<SimplexName>& simplices) const {
  for (int dimension = 0; dimension < Dimension; ++dimension) {
    keep_each_once(simplices);
    const std::size_t count = simplices.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (simplices[i].dimension != dimension) continue;
      faces_.any_coface(simplices[i], [&](SimplexName other, BeadId) {
        simplices.push_back(other);
        return false;
      });
    }
  }
  keep_each_once(simplices);
  const std::size_t count = simplices.size();
  for (std::size_t i = 0; i < count; ++i)
    for_closure(simplices[i], [&](SimplexName face) { simplices.push_back(face); });
  keep_each_once(simplices);
}

template <int Dimension>
void DualComplex<Dimension>::decide_membership(Moment moment, bool all_around) {
  const auto ask_about = [this](SimplexName simplex) {
    in_question_[static_cast<std::size_t>(simplex.dimension)].push_back(simplex);
  };
  if (all_changed_) {
    for (int dimension = 0; dimension <= Dimension; ++dimension) for_all(dimension, ask_about);
  } else {
    std::erase_if(changed_, [this](SimplexName simplex) { return !faces_.is_live(simplex); });
    if (all_around) add_all_around(changed_);
    for (const SimplexName& simplex : changed_) ask_about(simplex);
  }
  changed_.clear();
  all_changed_ = false;
  for (int dimension = Dimension; dimension >= 0; --dimension) {
    auto& here = in_question_[static_cast<std::size_t>(dimension)];
    if (here.size() > 2 && !all_around) keep_each_once(here);  // repeats change nothing
    for (const SimplexName& simplex : here) {
      const bool belongs = must_belong(simplex, moment);
      if (!all_around && dimension > 0 && belongs != of(simplex).belongs)
        faces_.for_facets(simplex, [&](SimplexName facet) {
          if (belongs != of(facet).belongs || !belongs) ask_about(facet);
        });
      set_membership(simplex, belongs);
    }
    here.clear();
  }
}

template <int Dimension>
void DualComplex<Dimension>::record_changes() {
  ends_.insert(ends_.end(), lost_.begin(), lost_.end());
  std::sort(ends_.rbegin(), ends_.rend());
  std::sort(begins_.begin(), begins_.end());
  if (happened_ == Happened::much) {  // simplices may go and come again
    std::vector<Simplex> both;
    std::set_intersection(begins_.begin(), begins_.end(), ends_.rbegin(), ends_.rend(),
                          std::back_inserter(both));
    const auto is_in_both = [&](const Simplex& simplex) {
      return std::binary_search(both.begin(), both.end(), simplex);
    };
    std::erase_if(begins_, is_in_both);
    std::erase_if(ends_, is_in_both);
  }
  const auto report = [this](const Simplex& simplex, int by) {
    Change change{static_cast<std::uint8_t>(begins(simplex.first) + by),
                  static_cast<std::uint8_t>(simplex.first + 1),
                  {}};
    std::copy_n(simplex.second.begin(), change.size, change.ids.begin());
    record(change);
  };
  for (const Simplex& simplex : ends_) report(simplex, 1);
  for (const Simplex& simplex : begins_) report(simplex, 0);
}

/// All cells of a flip have one orthogonal sphere at its time, so they are all small, with all their faces,
/// or all large, and then none of the new simplices belongs to the complex. The power of the sphere is not
/// zero: a removed simplex of size zero would have been noticed. A flip at the hull has one finite cell,
/// which is flat.
template <int Dimension>
bool DualComplex<Dimension>::settle_flip() {
  bool is_small = any_gone_ && gone_is_small_;
  if (!any_gone_ || std::none_of(new_.begin(), new_.end(),
                                 [](SimplexName simplex) { return simplex.dimension == Dimension; })) {
    if (is_small) return false;
    for (const SimplexName& simplex : new_)
      if (simplex.dimension == Dimension && sign_of_size(simplex, Moment::now) <= 0) return false;
  }
  if (is_small) {  // faces are in small cells, which alone need certificates
    for (const SimplexName& simplex : new_) {
      of(simplex).is_small = true;
      of(simplex).is_new = false;
      if (simplex.dimension == Dimension) unchecked_.push_back(simplex);
      set_membership(simplex, true);
    }
    new_.clear();
    return true;
  }
  bool any_small_face = small_face_is_gone_;
  std::sort(new_.begin(), new_.end());  // facets before the simplices that contain them
  for (const SimplexName& simplex : new_) {
    Knowledge& known = of(simplex);
    known.is_small = simplex.dimension < Dimension && is_small_now(simplex, Moment::just_after);
    known.is_new = false;
    any_small_face |= known.is_small;
    unchecked_.push_back(simplex);
  }
  // Small faces that come or go change which of the faces around need certificates.
  if (any_small_face) unchecked_.insert(unchecked_.end(), around_.begin(), around_.end());
  new_.clear();
  return true;
}

template <int Dimension>
void DualComplex<Dimension>::settle(Moment moment) {
  read_all_cells();
  if (moment == Moment::now || simulator().kernel() == Kernel::exact) happened_ = Happened::much;
  if (happened_ == Happened::flip && !settle_flip()) happened_ = Happened::much;
  if (happened_ == Happened::much) find_sizes_of_new(moment);
  if (moment == Moment::just_after) check_certificates();
  decide_membership(moment, happened_ == Happened::much);
  if (moment == Moment::just_after) {
    record_changes();
    if (follower_ != nullptr) follower_->settled({ends_, begins_, decided_});
  }
  happened_ = Happened::nothing;
  needs_after_batch = false;  // set while certificates were made
  unchecked_.clear();
  around_.clear();
  lost_.clear();
  ends_.clear();
  begins_.clear();
  decided_.clear();
}

template <int Dimension>
void DualComplex<Dimension>::build() {
  replayed_.reset();
  has_certificates_ = was_flat_ = false;
  for (auto& known : known_) std::fill(known.begin(), known.end(), Knowledge{.is_new = true});
  diagram_.make_mirror();
  if (diagram_.is_solid()) settle(Moment::now);  // otherwise there are no cells
}

template <int Dimension>
void DualComplex<Dimension>::start_step() {
  if (!diagram_.is_solid())
    throw InputError(fmt::format("all beads stay {} in step {}, where the dual complex has no cells",
                                 Dimension == 3 ? "in one plane" : "on one line", simulator().step()));
  // The simplices that had certificates in the last step need them in this one. Others follow below.
  for (int dimension = 0; dimension <= Dimension; ++dimension) {
    InterruptionCheck::ask();
    for (std::uint32_t number = 0; number < known_[static_cast<std::size_t>(dimension)].size(); ++number) {
      const SimplexName simplex{dimension, number};
      if (of(simplex).certificate == CertificateHandle::violated) continue;
      of(simplex).certificate = CertificateHandle::violated;
      if (!must_read_all_) enqueue(simplex);
    }
  }
  if (!std::exchange(has_certificates_, true))
    for (int dimension = 0; dimension <= Dimension; ++dimension)
      for_all(dimension, [this](SimplexName simplex) { unchecked_.push_back(simplex); });
  const std::uint64_t exact_before = statistics.stages.exact;
  watch_enqueued();
  // A size that is zero at the frame only is decided by integers. Then, and where cells are flat, simplices
  // may become attached without an event.
  if (was_flat_ || statistics.stages.exact > exact_before) {
    note(Happened::much);
    all_changed_ = true;
  }
  needs_after_batch = true;  // after the diagram has repaired itself
}

template <int Dimension>
void DualComplex<Dimension>::fail(unsigned table, std::uint32_t slot) {
  with_table(static_cast<int>(table), [&](auto& of_table, auto) {
    const SimplexName simplex{static_cast<int>(table), of_table.place_in_structure(slot)};
    of(simplex).certificate = CertificateHandle::violated;
    if (of_table.touches(slot)) {
      note(Happened::much);
      changed_.push_back(simplex);
    } else {
      note(Happened::failure);
      toggle(simplex);
    }
    watch_again(simplex);
  });
}

// Edits, replay and results.

template <int Dimension>
void DualComplex<Dimension>::release(std::span<const BeadId> beads) {
  read_all_cells();
  for (int dimension = 0; dimension <= Dimension; ++dimension)
    for_all(dimension, [&](SimplexName simplex) {
      const auto own = used(faces_.beads_of(simplex));
      if (std::find_first_of(own.begin(), own.end(), beads.begin(), beads.end()) == own.end()) return;
      drop(simplex);
      of(simplex).is_new = true;
      new_.push_back(simplex);
    });
  note(Happened::much);
}

template <int Dimension>
void DualComplex<Dimension>::take_up(std::span<const BeadId>) {
  settle(Moment::just_after);
}

template <int Dimension>
void DualComplex<Dimension>::apply(const Change& change) {
  if (!replayed_) {
    std::set<Simplex> all;
    for (int dimension = 0; dimension <= Dimension; ++dimension)
      for (const SimplexBeads& beads : simplices(dimension)) all.emplace(dimension, beads);
    replayed_ = std::move(all);
  }
  const int dimension = change.kind / 2;
  if (change.size != dimension + 1) throw std::invalid_argument("a simplex has another number of beads");
  SimplexBeads beads;
  beads.fill(no_bead);
  std::copy_n(change.ids.begin(), change.size, beads.begin());
  const bool is_new = change.kind == begins(dimension);
  const bool changed =
      is_new ? replayed_->emplace(dimension, beads).second : replayed_->erase({dimension, beads}) > 0;
  if (!changed)
    throw std::invalid_argument(fmt::format("the complex {} the simplex {}", is_new ? "already has" : "lacks",
                                            fmt::join(used(beads), " ")));
}

template <int Dimension>
std::vector<SimplexBeads> DualComplex<Dimension>::simplices(int dimension) const {
  std::vector<SimplexBeads> result;
  if (replayed_) {
    for (const auto& [of_dimension, beads] : *replayed_)
      if (of_dimension == dimension) result.push_back(beads);
    return result;
  }
  if (known_[static_cast<std::size_t>(dimension)].empty()) return result;
  for_all(dimension, [&](SimplexName simplex) {
    if (of(simplex).belongs) result.push_back(faces_.beads_of(simplex));
  });
  std::sort(result.begin(), result.end());
  return result;
}

template <int Dimension>
ComplexSimplices DualComplex<Dimension>::simplices_with_faces() const requires(Dimension == 3) {
  if (replayed_) throw std::logic_error("a replayed complex knows no faces");
  ComplexSimplices result;
  std::array<std::vector<std::uint32_t>, 3> places;  // of edges and triangles in the result
  const auto visit_all = [&]<std::size_t N>(int dimension, auto& list, std::integral_constant<std::size_t, N>,
                                            auto add) {
    if (known_[static_cast<std::size_t>(dimension)].empty()) return;
    if (dimension < 3) places[static_cast<std::size_t>(dimension)].resize(faces_.count(dimension));
    for_all(dimension, [&](SimplexName simplex) {
      if (!of(simplex).belongs) return;
      if (dimension < 3)
        places[static_cast<std::size_t>(dimension)][simplex.number] = static_cast<std::uint32_t>(list.size());
      const SimplexBeads& beads = faces_.beads_of(simplex);
      std::array<std::uint32_t, N> facets{};  // facets[i] is opposite to beads[i]
      if (dimension > 1)
        faces_.for_facets(simplex, [&](SimplexName facet) {
          const SimplexBeads& others = faces_.beads_of(facet);
          const auto opposite =
              std::mismatch(beads.begin(), beads.end(), others.begin()).first - beads.begin();
          facets[static_cast<std::size_t>(opposite)] =
              places[static_cast<std::size_t>(dimension - 1)][facet.number];
        });
      add(first_of<N>(beads), facets);
    });
  };
  visit_all(0, result.vertices, std::integral_constant<std::size_t, 1>(),
            [&](const auto& beads, const auto&) { result.vertices.push_back(beads[0]); });
  visit_all(1, result.edges, std::integral_constant<std::size_t, 2>(),
            [&](const auto& beads, const auto&) { result.edges.push_back(beads); });
  visit_all(2, result.triangles, std::integral_constant<std::size_t, 3>(),
            [&](const auto& beads, const auto& facets) {
              result.triangles.push_back({beads, facets});
            });
  visit_all(3, result.tetrahedra, std::integral_constant<std::size_t, 4>(),
            [&](const auto& beads, const auto& facets) {
              auto& tetrahedron = result.tetrahedra.emplace_back();
              tetrahedron.beads = beads;
              tetrahedron.triangles = facets;
              for (std::size_t e = 0; e < 6; ++e) {
                // The edge is opposite to bead l in the triangle opposite to bead k; k < l.
                const auto [k, l] = tetrahedron_edges[5 - e];
                tetrahedron.edges[e] = result.triangles[facets[k]].edges[l - 1];
              }
            });
  return result;
}

template <int Dimension>
std::vector<BeadId> DualComplex<Dimension>::state() const {
  std::vector<BeadId> numbers;
  for (int dimension = 0; dimension <= Dimension; ++dimension) {
    for (const SimplexBeads& beads : simplices(dimension))
      numbers.insert(numbers.end(), beads.begin(), beads.begin() + dimension + 1);
    numbers.push_back(no_bead);
  }
  return numbers;
}

/// Decides about all simplices of the diagram from integers. At a frame, sizes and sides that are zero there
/// may count either way.
template <int Dimension>
std::optional<std::string> DualComplex<Dimension>::audit(const Dyadic& time) {
  if (replayed_ || must_read_all_) return std::nullopt;  // the cells are those of another moment
  const bool frame = time == Dyadic(0.0) || time == Dyadic(1.0);
  const Curves<Dimension> curves = motion_.curves();
  // -1, 0 or 1; zero between frames only if the function stays zero.
  const auto sign = [&]<class Function>(const Function& function, const auto& search) {
    const MomentView view(curves, function.beads, time, {.weights = true});
    const int now = sgn(Function::formula(view, function.beads).scaled[0]);
    return now != 0 || frame ? now : search.exact_function(function)->sign_after(time);
  };
  // Whether each simplex belongs to the complex if zeros count for it, and if they count against it.
  std::array<std::vector<std::array<char, 2>>, static_cast<std::size_t>(Dimension) + 1> can;
  std::optional<std::string> fault;
  for (int dimension = Dimension; dimension >= 0; --dimension) {
    auto& here = can[static_cast<std::size_t>(dimension)];
    here.resize(faces_.count(dimension), {0, 0});
    for_all(dimension, [&](SimplexName simplex) {
      if (fault) return;
      const int size =
          with_table(dimension, [&]<std::size_t N>(auto& table, std::integral_constant<std::size_t, N>) {
            return sign(size_of<N>(simplex, 1), table.search());
          });
      bool in_other = false, surely_in_other = false;
      int least_side = 1;
      if (size <= 0)
        faces_.any_coface(simplex, [&](SimplexName other, BeadId beyond) {
          const auto& above = can[static_cast<std::size_t>(dimension) + 1][other.number];
          in_other |= above[0] != 0;
          surely_in_other |= above[1] != 0;
          least_side =
              std::min(least_side, with_side(simplex, beyond, [&](const auto& search, const auto& side) {
                         return sign(side, search);
                       }));
          return false;
        });
      const bool may = size <= 0 && (in_other || least_side >= 0);
      const bool must =
          (frame ? size < 0 : size <= 0) && (surely_in_other || (frame ? least_side > 0 : least_side >= 0));
      here[simplex.number] = {static_cast<char>(may), static_cast<char>(must)};
      if (!frame && of(simplex).is_small != (size <= 0))
        fault = fmt::format("the size of the simplex of beads {} has the sign {}, not the one that is known",
                            fmt::join(used(faces_.beads_of(simplex)), ", "), size);
      if (!frame && needs_certificate(simplex) != (of(simplex).certificate != CertificateHandle::violated))
        fault = fmt::format("the simplex of beads {} has a certificate that it does not need, or lacks one",
                            fmt::join(used(faces_.beads_of(simplex)), ", "));
      const bool belongs = of(simplex).belongs;
      if (belongs ? may : !must) return;
      fault = fmt::format("the simplex of beads {} {} to the complex, and its size has the sign {}",
                          fmt::join(used(faces_.beads_of(simplex)), ", "),
                          belongs ? "belongs" : "does not belong", size);
    });
  }
  return fault;
}

template class DualComplex<2>;
template class DualComplex<3>;

}  // namespace kds
