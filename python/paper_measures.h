#pragma once
// Quantities of balls at rest that the scripts of experiments/paper count and time. Arguments are those of
// static_structures.h. Times are processor times in seconds, one for each round.

#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>
#include <vector>

#include "python/static_structures.h"

namespace kds::python {

/// Returns the size of a separating family, the number of pairs of nodes that were compared, and the times of
/// the search. `hierarchy` is wrapped or layered. `rule` is a rule of the search (more beads, larger sphere,
/// first node), explicit, or smallest. Nodes of at most `leaf` beads are not split.
[[nodiscard]] pybind11::tuple separating_family(const Numbers& centers, const Numbers& radii,
                                                const std::vector<std::size_t>& necklaces,
                                                const std::string& hierarchy, const std::string& rule,
                                                std::size_t leaf, std::size_t apart, bool between,
                                                std::size_t rounds);
/// Returns the closest pair by the power diagram as closest_pair_of does, the numbers of pairs that were
/// looked at, a dictionary, and the times.
[[nodiscard]] pybind11::tuple closest_by_diagram(const Numbers& centers, const Numbers& radii,
                                                 const std::vector<std::size_t>& necklaces,
                                                 std::size_t rounds);
/// Returns the bases of the nodes at `before`, an array (nodes, 4) in which -1 is no bead, the spheres that
/// these bases have at `after`, an array (nodes, 4), and an array (rounds, 2) of times: of computing the
/// spheres, and of verifying all bases.
[[nodiscard]] pybind11::tuple trusted_hierarchy(const Numbers& before, const Numbers& after,
                                                const Numbers& radii, std::size_t rounds);

}  // namespace kds::python
