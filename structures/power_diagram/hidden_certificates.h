#pragma once
// The certificates of hidden beads. Each hidden bead has a power test against its host cell and an
// orientation for each facet of the host. When the power test fails, the bead becomes visible (1-4). When an
// orientation fails, the bead wanders to the cell beyond that facet, or becomes visible there if that cell is
// infinite.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "kds/certificate_table.h"
#include "structures/power_diagram/diagram_state.h"

namespace kds {

template <int Dimension>
class HiddenCertificates {
  using State = DiagramState<Dimension>;
  using Events = typename State::Events;
  using Beads = typename State::Beads;

 public:
  /// Numbers of the tables.
  enum : unsigned { appearing = 2, departing = 3 };

  explicit HiddenCertificates(State& state);

  /// Called at the start of a step, when the certificates of the previous step are gone.
  void start_step() { handles_.clear(); }
  /// Finds a new host for each hidden bead that has no host or has left it, and creates the certificates of
  /// all hidden beads.
  void watch_all();
  /// Drops the certificates of a hidden bead.
  void drop(BeadId bead);
  void drop_all();

  /// Hides a bead that was visible; it has no certificates yet.
  void hide(BeadId bead);
  /// Sets the host of a hidden bead and creates its certificates there.
  void enter(BeadId bead, CellId host);
  /// Moves a hidden bead that leaves its host through `facet` into the cell where it is now, and creates its
  /// certificates there.
  void wander(BeadId bead, int facet);
  /// Makes the certificates of a bead anew; its host stays the same.
  void watch(BeadId bead);

  /// Called before these cells are removed: their hidden beads have no host and no certificates until
  /// rehouse.
  void displace(std::span<const CellId> cells);
  /// Returns the displaced beads, ascending.
  [[nodiscard]] std::span<const BeadId> displaced() const { return displaced_; }
  void forget_displaced() { displaced_.clear(); }
  /// Adds a bead hidden just now to the displaced beads, or removes a bead that became visible from them.
  void add_displaced(BeadId bead);
  void remove_displaced(BeadId bead) { std::erase(displaced_, bead); }
  /// Finds hosts for all displaced beads, searching from `near`, and creates their certificates.
  void rehouse(CellId near);

  /// Walks from `cell`, entered through facet `came_from`, to the cell that contains the bead just after now.
  /// This cell is infinite if the bead is outside the hull. Returns no_cell if signs contradict each other.
  [[nodiscard]] CellId walk_to(BeadId bead, CellId cell, int came_from = -1);

  /// A certificate that fails and calls for a repair: the bead becomes visible in its host, or leaves it
  /// through a facet.
  struct Failed {
    BeadId bead;
    std::optional<int> facet;
    Identity identity;
  };
  [[nodiscard]] std::optional<Failed> take_failure(unsigned table, std::uint32_t slot);

  /// Returns whether `holds(table, handle)` is true for all certificates.
  template <class Holds>
  [[nodiscard]] bool all_of(Holds holds) const {
    for (const Handles& handles : handles_) {
      for (std::size_t i = 0; i <= Dimension; ++i)
        if (!holds(departures_, handles[i])) return false;
      if (!holds(appearances_, handles.back())) return false;
    }
    return true;
  }

 private:
  /// One orientation for each facet of the host, then the power test.
  using Handles = std::array<CertificateHandle, Dimension + 2>;
  static constexpr Handles no_handles = [] {
    Handles none{};
    none.fill(CertificateHandle::violated);
    return none;
  }();

  [[nodiscard]] CellId find_host(BeadId bead, CellId cell, int came_from = -1);
  void enqueue(BeadId bead);
  void watch_enqueued();

  State& state_;
  CertificateTable<PowerTest<Dimension>> appearances_;
  CertificateTable<Orientation<Dimension>> departures_;
  std::vector<Handles> handles_;  // for each bead; empty if none is hidden
  std::vector<BeadId> displaced_;
};

extern template class HiddenCertificates<2>;
extern template class HiddenCertificates<3>;

}  // namespace kds
