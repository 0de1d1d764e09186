#pragma once
// The figures of the paper's tables for one frame of a subject, or for the step between two frames. Works
// whose times are compared run in turn, round by round.
//
// Beads are their centres (radius 0), except in families. The paper's counts fit centres: its straight chain
// of 1000 beads has a set of 1000 pairs, but touching beads need at least 998 pairs for beads two apart and,
// in a balanced tree, about 2000. With centres, neighbouring subchains of a straight chain have disjoint
// spheres, so that a chain of n beads has n - 1 pairs, one per internal node. No set that the paper prints is
// smaller than that. Bases, frontiers and cells do not depend on the radius if all radii are equal.

#include <cstddef>
#include <cstdint>

#include "experiments/program/timing.h"
#include "experiments/reproduce/subjects.h"
#include "structures/hierarchy/layered_hierarchy.h"

namespace kds {

/// Seconds of one work, and their ratio to the seconds of another work, by round.
struct Timed {
  Spread seconds;
  std::vector<double> by_round;

  [[nodiscard]] Spread per(const Timed& other) const { return ratios_by_round(by_round, other.by_round); }
};

/// Table 1: building each structure from nothing.
struct Construction {
  Timed wrapped, layered;
  Timed cgal;     ///< the smallest sphere of each node by CGAL, from its beads: the paper's way
  Timed diagram;  ///< by CGAL
  Tightness tightness;
};
[[nodiscard]] Construction construction_of(const Subject& subject, std::size_t frame, std::size_t rounds);

/// Tables 3 and 4: collisions within the necklace. The times cover only the searches; the hierarchies are
/// built beforehand. The quadratic search tests pair by pair and stops at the first collision.
struct SelfCollision {
  Timed quadratic, wrapped, layered;
  std::uint64_t wrapped_pairs = 0, layered_pairs = 0;    ///< sets of centres, pairs of all beads
  std::uint64_t wrapped_family = 0, layered_family = 0;  ///< families (S1, S2) of touching beads
  std::uint64_t collisions = 0;  ///< pairs of touching beads that families leave out, since they collide
  std::uint64_t edges = 0;       ///< of the diagram, also those to the infinite vertex
};
[[nodiscard]] SelfCollision self_collision_of(const Subject& subject, std::size_t frame, std::size_t rounds);

/// Tables 2, 5 and 6: the step from one frame to another, or to itself. The times are those of the wrapped
/// hierarchy at the later frame. It is verified with the bases of that frame, so that nothing is to be
/// repaired.
struct Step {
  Timed lazy;                                 ///< computes the spheres of the old bases
  Timed cascade;                              ///< computes spheres, and verifies them by cages first
  Timed naive;                                ///< computes spheres, and verifies them bead by bead
  double cascade_tests = 0, naive_tests = 0;  ///< of beads and cages against spheres, repairs included
  double frontier = 0;                        ///< average over all nodes, beads included
  std::uint64_t bases_changed = 0;
  std::uint64_t cells_changed = 0;  ///< cells of the later diagram that the earlier one does not have
};
[[nodiscard]] Step step_of(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds);

/// Section 3.2: bringing the power diagram from one frame to another.
struct DiagramStep {
  Timed rebuild, reinsert, greedy;  ///< techniques of structures/power_diagram/diagram_update.h
  std::uint64_t rebuilds = 0;       ///< how many of the two removals rebuilt the diagram instead
};
[[nodiscard]] DiagramStep diagram_step_of(const Subject& subject, std::size_t from, std::size_t to,
                                          std::size_t rounds);

/// Table 7: collisions between two necklaces from one frame to the next. The times cover updating and
/// searching the hierarchy.
struct CollisionBetween {
  Timed layered;  ///< builds all spheres anew
  Timed lazy;     ///< computes the spheres that the search visits, of the old bases
  Timed full;     ///< verifies all nodes by the cascade and repairs their bases
  std::uint64_t layered_pairs = 0, wrapped_pairs = 0;
  double frontier = 0;  ///< average over all nodes, beads included
};
[[nodiscard]] CollisionBetween collision_between(const Subject& subject, std::size_t from, std::size_t to,
                                                 std::size_t rounds);

}  // namespace kds
