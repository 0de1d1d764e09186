#pragma once
// The kinds of changes of a kinetic power diagram: events, and edits as they are logged.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "kds/kinetic_structure.h"

namespace kds {

/// The ids of an event:
///   flip                   the face that is removed, then the face that is added, each ascending; in
///                          space the triangle comes before the edge
///   hides, shows           the beads of the one cell, ascending, then the bead
///   wanders                the bead, then its host's beads, ascending
///   rebuild                no beads, but the time u = numerator / 2^exponent of the step at which the whole
///                          diagram is built anew from exact positions: the exponent, then at most seven
///                          32-bit words of the numerator, lowest first
///   clears                 the beads of a cell that is removed, ascending
///   fills                  the beads of a cell that is added, positively oriented: ascending, except that
///                          the last two may be exchanged
///   inserts, erases,       the bead
///   changes
///   repairs                the least bead of the cells filled before
/// A rebuild does not list the cells that change, so a listener that follows cells must read all of them
/// again.
template <int Dimension>
struct DiagramEvents {
  /// In the plane, `to_edge` is the 2-2 flip, and `to_facet` does not exist.
  enum Kind : std::uint8_t {
    to_edge,
    to_facet,
    hides = Dimension == 3 ? 2 : 1,
    shows,
    wanders,
    rebuild,
    // Edits: first all cells cleared and filled, then the edit itself.
    clears,
    fills,
    inserts,
    erases,
    changes,
    // A repair after flips that block each other: first all cells cleared and filled, then this kind.
    repairs,
  };

  [[nodiscard]] static std::span<const EventKind> all_kinds() {
    static constexpr std::uint8_t all_of_cell = Dimension + 1;
    static constexpr std::array<IdRole, 2> triangle_edge{{{"triangle", 3}, {"edge", 2}}};
    static constexpr std::array<IdRole, 2> edges{{{"gone", 2}, {"new", 2}}};
    static constexpr std::array<IdRole, 2> cell_bead{{{"cell", all_of_cell}, {"bead"}}};
    static constexpr std::array<IdRole, 2> bead_cell{{{"bead"}, {"cell", 0}}};
    static constexpr std::array<IdRole, 1> cell{{{"cell", 0}}}, bead{{{"bead"}}};
    static constexpr std::array<IdRole, 1> time{{{"time", 0, IdRole::Of::number}}};
    static constexpr EventKind wander{"wander", false, false, bead_cell};
    static constexpr EventKind rebuilt{"rebuild", false, true, time};
    static constexpr EventKind clear{"clear", false, true, cell}, fill{"fill", false, true, cell};
    static constexpr EventKind insert{"insert", false, true, bead}, erase{"erase", false, true, bead},
        change{"change", false, true, bead}, repair{"repair", false, true, bead};
    static constexpr std::array<EventKind, 12> in_space{{{"2-3", true, false, triangle_edge},
                                                         {"3-2", true, false, triangle_edge},
                                                         {"4-1", true, false, cell_bead},
                                                         {"1-4", true, false, cell_bead},
                                                         wander,
                                                         rebuilt,
                                                         clear,
                                                         fill,
                                                         insert,
                                                         erase,
                                                         change,
                                                         repair}};
    static constexpr std::array<EventKind, 11> in_plane{{{"2-2", true, false, edges},
                                                         {"3-1", true, false, cell_bead},
                                                         {"1-3", true, false, cell_bead},
                                                         wander,
                                                         rebuilt,
                                                         clear,
                                                         fill,
                                                         insert,
                                                         erase,
                                                         change,
                                                         repair}};
    if constexpr (Dimension == 3) return in_space;
    return in_plane;
  }

  /// Returns the change in which a bead becomes hidden in a cell, or becomes visible there.
  [[nodiscard]] static Change of_hidden(Kind kind, const std::array<BeadId, Dimension + 1>& cell,
                                        BeadId bead) {
    Change change{kind, Dimension + 2, {}};
    std::copy(cell.begin(), cell.end(), change.ids.begin());
    std::sort(change.ids.begin(), change.ids.begin() + Dimension + 1);
    change.ids[Dimension + 1] = bead;
    return change;
  }
};

}  // namespace kds
