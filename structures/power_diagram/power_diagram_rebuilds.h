#pragma once
// Part of PowerDiagram: where flips do not suffice. Simultaneous events that block each other, cells that
// turn over unseen, frames where beads coincide or all lie in one plane: then the diagram is built anew, by
// CGAL with exact numbers, at a time after the present one so near that nothing is skipped, and the rebuild
// is counted. And the audit.

#include "motions/views/integer_view.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/exact_triangulation.h"

namespace kds {

/// The triangulation of some beads, which it numbers from 0, with their own names.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> with_names(StaticTriangulation<Dimension> triangulation,
                                                        std::span<const BeadId> beads) {
  for (auto& cell : triangulation.cells) {
    for (BeadId& b : cell) b = b == infinite_bead ? b : beads[b];
  }
  for (BeadId& b : triangulation.hidden) b = beads[b];
  return triangulation;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::after_batch() {
  const bool wrong = doubt_ == Doubt::wrong || is_wrong_just_after();
  settled();
  if (!wrong) return;
  if constexpr (std::same_as<K, Fast>) {
    rebuild_roughly();
  } else {
    rebuild_at_first_time_that_works();
  }
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::is_wrong_just_after() {
  if constexpr (std::same_as<K, Fast>) return false;
  return regularity_fault(
             triangulation_, bead_count(), hidden_.with_hosts(), false,
             [this](const auto& function) {
               return sign_just_after<K>(function, motion_, simulator_.now(), statistics.stages);
             },
             absent_)
      .has_value();
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::build_from_control_points(int k) {
  if (absent_count_ == 0)
    return forget_steps(triangulation_.build(control_points(motion_, k), control_weights(motion_, k)));
  const auto built = exact_static(Dyadic(k == 0 ? 0.0 : 1.0), true);
  triangulation_.assign(motion_.bead_count(), built.cells);
  triangulation_.set_points(control_points(motion_, k), control_weights(motion_, k));
  forget_steps(built);
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::forget_steps(const StaticTriangulation<dimension>& built) {
  tolerances_.forget_all();
  ends_positive_.clear();
  notes_ = Notes::any;
  hidden_.assign(motion_.bead_count(), built.hidden);
  affine_dimension_ = built.dimension;
  has_had_cells_ |= built.dimension == dimension;
  flat_ = false;
}

template <Motion M, Kernel K>
std::vector<BeadId> PowerDiagram<M, K>::beads_present() const {
  std::vector<BeadId> beads;
  beads.reserve(motion_.bead_count() - absent_count_);
  for (BeadId b = 0; b < motion_.bead_count(); ++b) {
    if (!is_absent(b)) beads.push_back(b);
  }
  return beads;
}

template <Motion M, Kernel K>
auto PowerDiagram<M, K>::exact_static(std::span<const BeadId> beads, const Dyadic& time, bool oriented) const
    -> StaticTriangulation<dimension> {
  std::vector<ExactBead> positions(beads.size());
  for (std::size_t i = 0; i < beads.size(); ++i) {
    const auto position = exact_position(motion_, beads[i], time);
    std::copy(position.begin(), position.end() - 1, positions[i].center.begin());
    positions[i].weight = position.back();
  }
  return with_names(static_triangulation<dimension>(positions, oriented), beads);
}

template <Motion M, Kernel K>
auto PowerDiagram<M, K>::static_at_end(int k) const -> StaticTriangulation<dimension> {
  Eigen::Matrix3Xd points = control_points(motion_, k);
  std::vector<double> weights = control_weights(motion_, k);
  const std::vector<BeadId> beads = beads_present();
  for (std::size_t i = 0; i < beads.size(); ++i) {  // each moves to the front
    points.col(static_cast<Eigen::Index>(i)) = points.col(Eigen::Index{beads[i]});
    weights[i] = weights[beads[i]];
  }
  points.conservativeResize(3, static_cast<Eigen::Index>(beads.size()));
  weights.resize(beads.size());
  return with_names(static_triangulation<dimension>(points, weights), beads);
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::assign_static(const Dyadic& time) {
  const auto built = exact_static(time, true);
  if (built.dimension < dimension) return false;
  affine_dimension_ = dimension;
  has_had_cells_ = true;
  hidden_.assign(motion_.bead_count(), built.hidden);
  triangulation_.assign(motion_.bead_count(), built.cells);
  return true;
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::drop_all() {
  tolerances_.forget_all();  // what follows is another triangulation
  ends_positive_.clear();
  notes_ = Notes::any;
  if (!guarded_) return;
  for_all_facets([this](CellId cell, int i) { drop(cell, i); });
  for (BeadId bead = 0; bead < hidden_guards_.size(); ++bead) drop_hidden(bead);
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
void PowerDiagram<M, K>::apply_rebuild(const Change& change) {
  if (change.size < 1 || change.ids[0] > finest_grid)
    throw std::invalid_argument("this is no time of a rebuild");
  Integer numerator = 0;
  for (std::size_t i = change.size; i-- > 1;) numerator = (numerator << 32U) + change.ids[i];
  const Dyadic time(numerator, change.ids[0]);
  if (!(time < Dyadic(1.0)) || !assign_static(time))
    throw std::invalid_argument("no diagram can be built at this time");
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::nothing_fails_until(const Dyadic& time) {
  ExactTime limit(time);
  const auto later = [&](auto& table, CertificateHandle guard) {
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
  for (const Guards& guards : hidden_guards_) {
    for (std::size_t i = 0; i <= dimension; ++i) all_later = all_later && later(departures_, guards[i]);
    all_later = all_later && later(appearances_, guards.back());
  }
  return all_later;
}

template <Motion M, Kernel K>
bool PowerDiagram<M, K>::try_to_rebuild() {
  drop_all();
  present_ = {};
  bool solid = false;  // at some time
  for (unsigned bits = coarsest_that_worked_; bits <= finest_grid; bits += bits < 32 ? 4 : 12) {
    const Dyadic time = next_on_grid(simulator_.now().exact(), bits);
    if (!(time < Dyadic(1.0))) continue;
    if (!assign_static(time)) continue;
    solid = true;
    settled();
    watch_all();
    if (doubt_ != Doubt::wrong && nothing_fails_until(time)) {
      settled();
      coarsest_that_worked_ = bits;
      record_rebuild(time);
      return true;
    }
    drop_all();
  }
  settled();
  if (!solid) return false;
  if constexpr (std::same_as<K, Fast>) {  // doubles contradict themselves
    rebuild_roughly();
    return true;
  }
  throw InputError("step " + std::to_string(simulator_.step()) + " at u = " +
                   std::to_string(simulator_.now().upper()) + ": events of the power diagram within 2^-" +
                   std::to_string(finest_grid) + " of the step, closer than it can be rebuilt between");
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::rebuild_at_first_time_that_works() {
  if (!try_to_rebuild()) refuse_flat();
}

template <Motion M, Kernel K>
void PowerDiagram<M, K>::refuse_flat() const {
  throw InputError(
      std::string("all beads stay ") + (dimension == 3 ? "in one plane" : "on one line") + " in step " +
      std::to_string(simulator_.step()) + "; the power diagram " +
      (dimension == 3 ? "in space needs four that do not" : "in the plane needs three that do not"));
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

template <Motion M, Kernel K>
std::optional<std::string> PowerDiagram<M, K>::audit(const Dyadic& time) {
  const bool start = time == Dyadic(0.0);
  const bool end = time == Dyadic(1.0);
  if (affine_dimension_ < dimension)
    return std::nullopt;  // at a frame only, where the answer is CGAL's (at_frame)
  if ((start || end) && !flat_) {
    const int k = start ? 0 : M::degree;
    const auto built = static_at_end(k);
    if (triangulation_.is_valid() && built.cells == triangulation_.finite_cells() &&
        built.hidden == hidden_.beads())
      return std::nullopt;
  } else if (!start && !end) {
    const auto built = exact_static(time, false);
    if (built.cells == triangulation_.finite_cells() && built.hidden == hidden_.beads()) return std::nullopt;
  }
  // Degenerate positions have several regular triangulations: ours must satisfy the definition. Between
  // events what is zero at this very moment only is judged by its sign just after.
  const bool frame = start || end;
  return regularity_fault(
      triangulation_, bead_count(), hidden_.with_hosts(), flat_,
      [&](const auto& function) {
        const int sign = function_of(function, MomentView<M>(motion_, function.beads, time)).scaled[0].sign();
        return sign != 0 || frame ? sign : exact_function(function, motion_).sign_after(time);
      },
      absent_);
}

}  // namespace kds
