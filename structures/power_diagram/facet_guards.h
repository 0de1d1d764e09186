#pragma once
// The certificates of a power diagram's facets (facet_certificate.h), made and given up together. Facets that
// filters find to hold all over a step have no certificate of their own and are counted only.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "certificates/filters/cell_filter.h"
#include "kds/certificate_table.h"
#include "motions/views/length_unit.h"
#include "structures/power_diagram/diagram_state.h"
#include "structures/power_diagram/facet_filter.h"
#include "structures/power_diagram/facet_foresight.h"
#include "structures/power_diagram/facet_guard.h"
#include "structures/power_diagram/facet_slack.h"
#include "structures/power_diagram/known_failures.h"

namespace kds {

template <int Dimension>
class FacetGuards {
  using State = DiagramState<Dimension>;
  using Beads = typename State::Beads;

 public:
  /// Numbers of its tables.
  enum : unsigned { powers = 0, orientations = 1 };

  explicit FacetGuards(State& state);

  /// The guards of the step before are gone.
  void start_step();
  /// Guards all facets; those that rest in this step need no certificate, and those whose test is positive
  /// all over the step, as most are, nothing but to be counted.
  void watch_all();
  /// Guards all facets of new cells. Those between two of them, where an event made these, have all of its
  /// beads, and its function.
  void watch_around(std::span<const CellId> cells);
  /// Gives up a facet's guard; where there is none any more, nothing.
  void drop(CellId cell, int i) {
    const FacetGuard facet = guard(cell, i);
    bool vanishes = facet.about == About::power ? state_.give_up(power_tests_, facet.guard)
                                                : state_.give_up(orientations_, facet.guard);
    if (facet.about == About::cell) {
      const auto [other, k] = state_.across(cell, i);
      vanishes |= state_.give_up(orientations_, guard(other, k).guard);
    }
    if (vanishes) state_.touch(std::array{cell, state_.neighbor(cell, i)});
    forget(cell, i);
  }
  /// All those of some cells; the second drop of a facet between two of them finds it gone.
  void drop_around(std::span<const CellId> cells) {
    for (const CellId cell : cells) {
      for (int i = 0; i <= Dimension; ++i) drop(cell, i);
    }
  }
  void drop_all();
  /// From now on what is found out about certificates is kept, and asked for before they are searched: while
  /// time stands still and all diagrams that follow are of the same curves.
  void remember() {
    if (all_move() && !known_ && state_.simulator.kernel() != Kernel::fast) known_.emplace();
  }
  void forget_known() { known_.reset(); }
  /// Another triangulation follows: nothing is known of its cells and facets, and none is guarded.
  void forget_cells();
  /// Beads are about to go on along other curves.
  void forget_courses() { foresight_.forget_all(); }

  /// A certificate that fails, or touches zero, and what asks for a flip.
  struct Failed {
    CellId cell;
    int facet;
    Identity identity;
  };
  [[nodiscard]] std::optional<Failed> take_failure(unsigned table, std::uint32_t slot);

  /// Whether `holds(table, guard)` of all guards.
  template <class Holds>
  [[nodiscard]] bool all_of(Holds holds) const {
    const auto guard_holds = [&](FacetGuard g) {
      return g.about == About::power ? holds(power_tests_, g.guard) : holds(orientations_, g.guard);
    };
    bool all = true;
    for_all_facets([&](CellId cell, int i) {
      const auto [other, k] = state_.across(cell, i);
      all = all && guard_holds(guard(cell, i)) &&
            (guard(cell, i).about != About::cell || guard_holds(guard(other, k)));
    });
    return all;
  }

  /// Calls `visit` with the certificates that do not hold just after now, at most so many: negated they do.
  template <class Visit>
  void for_violated(std::size_t most, Visit visit) const {
    if (!guarded_) return;
    const auto look_at_cell = [&](CellId cell, int i) {
      if (guard(cell, i).guard == CertificateHandle::violated && most > 0) {
        --most;
        visit(Orientation<Dimension>(state_.beads_of(cell), 1));
      }
    };
    for_all_facets([&](CellId cell, int i) {
      if (guard(cell, i).about == About::cell) {
        const auto [other, k] = state_.across(cell, i);
        look_at_cell(cell, i);
        look_at_cell(other, k);
      } else if (guard(cell, i).guard == CertificateHandle::violated && most > 0) {
        --most;
        with_facet_certificate(state_.beads_of(cell), state_.apex(cell, i), visit);
      }
    });
  }

  /// From now on only the beads marked, one entry a bead, move in a step. Facets of beads that all rest need
  /// no certificate. Empty: all beads move.
  void move_only(std::vector<char> moving);
  [[nodiscard]] bool all_move() const { return moving_.empty(); }
  /// Cells that flips made since then, some more than once, some gone again.
  [[nodiscard]] std::span<const CellId> flipped() const { return flipped_; }

  /// Of each cell whether it is known to be positive where the step ends; fewer than there are cells, or
  /// none.
  [[nodiscard]] std::span<const std::uint8_t> known_positive_at_end() const { return ends_positive_; }
  void forget_ends() { ends_positive_.clear(); }

  /// A flip there comes near: first its cell, then what that names.
  void fetch(CellId cell, bool next) const;

 private:
  using About = FacetGuard::About;
  static constexpr std::uint32_t resting_note = FacetGuard{CertificateHandle::never, About::power}.packed();

  [[nodiscard]] FacetGuard guard(CellId cell, int i) const {
    return FacetGuard::of(state_.triangulation.cells()[cell].note[static_cast<std::size_t>(i)]);
  }
  /// As this cell has it alone.
  [[gnu::always_inline]] void set_own_guard(CellId cell, int i, FacetGuard value) {
    state_.triangulation.note(cell, i) = value.packed();
    if (notes_ != Notes::any && value.packed() != resting_note) remember_noted(cell);
  }
  void remember_noted(CellId cell);
  void set_guard(CellId cell, int i, FacetGuard value) {
    set_own_guard(cell, i, value);
    const auto [other, k] = state_.across(cell, i);
    set_own_guard(other, k, value);
  }
  void forget(CellId cell, int i) { set_guard(cell, i, {}); }
  template <class Visit>
  void for_all_facets(Visit visit) const {
    for (CellId cell = 0; cell < state_.triangulation.cells().size(); ++cell) {
      if (!state_.triangulation.is_live(cell)) continue;
      for (int i = 0; i <= Dimension; ++i) {
        if (cell < state_.neighbor(cell, i)) visit(cell, i);
      }
    }
  }

  /// Facets are guarded together: enqueue some, then watch them.
  void enqueue(CellId cell, int i);
  void enqueue(const FacetCertificates<Dimension + 1>& certificates, CellId cell, int i, KnownAtStart known);
  void watch_enqueued();
  /// One certificate of a facet, searched for with others, or known.
  template <class Certificate, class Make>
  void enqueue_in(CertificateTable<Certificate>& table, FacetId place, KnownAtStart birth, Make make);
  template <class Certificate>
  void remember(const CertificateTable<Certificate>& table, FacetId facet, CertificateHandle guard);
  /// With the filter, or, without lanes, one facet at a time.
  template <bool in_lanes>
  void watch_all_moving();
  [[nodiscard]] auto taking_doubts();
  /// What is not known from steps before is looked at ahead, and then as it is. Returns how many are known.
  std::uint64_t watch_with_foresight(FacetFilter<Dimension>& positive);
  [[nodiscard]] std::uint64_t watch_hull_ahead();
  /// Where beads are not known ahead, only one step is found out about.
  [[nodiscard]] bool looks_ahead() const { return foresight_.any() && foresight_.ahead().all_known(); }
  void watch_marked();
  void note_resting();
  void hold_inner(CellId cell, int i);
  void watch_cells_beside(CellId cell, int i);
  void watch_cell(CellId cell, int i);
  [[nodiscard]] std::array<unsigned, few_cells> found_around(std::span<const CellId> cells);
  /// Fetches the failures that a flip will cancel.
  void fetch_scheduled(CellId cell) const {
    for (int i = 0; i <= Dimension; ++i) {
      if (const FacetGuard facet = guard(cell, i); facet.about == About::power)
        power_tests_.fetch_scheduled(facet.guard);
    }
  }

  State& state_;
  CertificateTable<PowerTest<Dimension>> power_tests_;
  CertificateTable<Orientation<Dimension>> orientations_;
  std::unique_ptr<CellFilter<Dimension>> filter_;
  bool guarded_ = false;
  /// What the notes of cells say: anything, or that all facets rest but perhaps those of `noted_`.
  enum class Notes : std::uint8_t { any, resting };
  Notes notes_ = Notes::any;
  std::vector<CellId> noted_;
  FacetCover cover_;
  LengthUnit unit_;  // near the cells' lengths in this step
  std::vector<std::uint8_t> ends_positive_;
  FacetSlack<Dimension> slack_;
  std::optional<KnownFailures> known_;
  FacetForesight<Dimension> foresight_;
  std::unique_ptr<CellFilter<Dimension>> filter_ahead_;
  std::vector<FacetId> on_hull_;  // to be looked at ahead
  std::vector<char> moving_;      // of each bead; empty: all move
  std::vector<CellId> flipped_;
};

extern template class FacetGuards<2>;
extern template class FacetGuards<3>;

}  // namespace kds
