#pragma once
// The certificates of hidden beads. Each is guarded against its host cell: a power test (when it fails the
// bead comes back, 1-4), and an orientation for each facet (when one fails the bead wanders to the cell
// beyond, or comes back there if that is an infinite one).

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "kds/certificate_table.h"
#include "structures/power_diagram/diagram_state.h"

namespace kds {

template <int Dimension>
class HiddenGuards {
  using State = DiagramState<Dimension>;
  using Events = typename State::Events;
  using Beads = typename State::Beads;

 public:
  /// Numbers of its tables.
  enum : unsigned { appearing = 2, departing = 3 };

  explicit HiddenGuards(State& state);

  /// The guards of the step before are gone.
  void start_step() { guards_.clear(); }
  /// Hosts all hidden beads anew where they are in no cell, or not in theirs any more, and guards them.
  void watch_all();
  /// Gives up the guards of a hidden bead.
  void drop(BeadId bead);
  void drop_all();

  /// A bead that was visible, without guards yet, becomes hidden.
  void hide(BeadId bead);
  /// It enters a cell, and is guarded there.
  void enter(BeadId bead, CellId host);
  /// A hidden bead that leaves its host through a facet enters the cell where it is.
  void wander(BeadId bead, int facet);
  /// The certificates of a bead that stays where it is are made anew.
  void watch(BeadId bead);

  /// The hidden beads of cells that will go are without host and guards until they are housed again.
  void displace(std::span<const CellId> cells);
  /// Such beads, ascending.
  [[nodiscard]] std::span<const BeadId> displaced() const { return displaced_; }
  void forget_displaced() { displaced_.clear(); }
  /// A bead hidden just now is to be housed with them; one that comes back is not.
  void add_displaced(BeadId bead);
  void remove_displaced(BeadId bead) { std::erase(displaced_, bead); }
  /// They are looked for from `near`, and guarded.
  void rehouse(CellId near);

  /// The cell in which a bead is just after now, an infinite one where it is outside the hull, on a walk from
  /// some cell, on which it came through a facet; no_cell where signs contradict each other.
  [[nodiscard]] CellId walk_to(BeadId bead, CellId cell, int came_from = -1);

  /// A certificate that fails and asks for a repair: the bead comes back into its host, or leaves it through
  /// a facet.
  struct Failed {
    BeadId bead;
    std::optional<int> facet;
    Identity identity;
  };
  [[nodiscard]] std::optional<Failed> take_failure(unsigned table, std::uint32_t slot);

  /// Whether `holds(table, guard)` of all guards.
  template <class Holds>
  [[nodiscard]] bool all_of(Holds holds) const {
    for (const Guards& guards : guards_) {
      for (std::size_t i = 0; i <= Dimension; ++i)
        if (!holds(departures_, guards[i])) return false;
      if (!holds(appearances_, guards.back())) return false;
    }
    return true;
  }

 private:
  /// Against the host's facets, then the power test.
  using Guards = std::array<CertificateHandle, Dimension + 2>;
  static constexpr Guards no_guards = [] {
    Guards none{};
    none.fill(CertificateHandle::violated);
    return none;
  }();

  [[nodiscard]] CellId find_host(BeadId bead, CellId cell, int came_from = -1);
  void enqueue(BeadId bead);
  void watch_enqueued();

  State& state_;
  CertificateTable<PowerTest<Dimension>> appearances_;
  CertificateTable<Orientation<Dimension>> departures_;
  std::vector<Guards> guards_;  // of each bead, if any is hidden
  std::vector<BeadId> displaced_;
};

extern template class HiddenGuards<2>;
extern template class HiddenGuards<3>;

}  // namespace kds
