#pragma once
// Betti numbers by GUDHI (Simplex_tree, Persistent_cohomology, Alpha_complex_3d), which shares no code with
// kds. Tests that call these functions are skipped if the tests were built without GUDHI.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/support/judges/exact_checks.h"

namespace kds::test {

/// Numbers of components, tunnels and voids.
using Betti = std::array<std::size_t, 3>;

/// Returns whether the tests were built with GUDHI. Otherwise the functions below throw std::logic_error.
[[nodiscard]] bool has_gudhi();

/// Returns the Betti numbers of a complex over the integers modulo 11. Each simplex has its beads ascending;
/// unused entries hold no_bead. Throws std::invalid_argument if a simplex is listed twice or a face is
/// missing.
[[nodiscard]] Betti gudhi_betti(std::span<const std::array<BeadId, 4>> simplices);

/// Returns the Betti numbers of a union of balls: of GUDHI's weighted alpha complex at alpha = 0, computed
/// with exact numbers. Throws std::invalid_argument if the points lie in one plane.
[[nodiscard]] Betti gudhi_betti_of_union(std::span<const ExactPoint> balls);

}  // namespace kds::test
