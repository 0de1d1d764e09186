#pragma once
// Structures of balls at rest. Centres have the shape (beads, 3) or (beads, 2); radii have one number for
// each bead. Everything is exact: signs are decided on integers where doubles do not suffice.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <vector>

namespace kds::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Returns the edges of the power diagram with the weights r^2, an array (m, 2), and the hidden beads.
[[nodiscard]] pybind11::tuple power_diagram(const Numbers& centers, const Numbers& radii);
/// Returns the smallest sphere around all balls: centre and radius, and the beads of its basis.
[[nodiscard]] pybind11::tuple enclosing_sphere(const Numbers& centers, const Numbers& radii);
/// Returns the nodes of the wrapped hierarchy, first and last bead of each (nodes, 2), and their spheres
/// (nodes, 4). `necklaces` are the numbers of beads of each necklace; empty: one necklace.
[[nodiscard]] pybind11::tuple wrapped_hierarchy(const Numbers& centers, const Numbers& radii,
                                                const std::vector<std::size_t>& necklaces);
/// Returns nodes and spheres of the layered hierarchy in the same form.
[[nodiscard]] pybind11::tuple layered_hierarchy(const Numbers& centers, const Numbers& radii,
                                                const std::vector<std::size_t>& necklaces);
/// Returns the pairs of balls whose distance is at most `within`, an array (m, 2). Beads of one necklace are
/// at least `apart` apart along it.
[[nodiscard]] pybind11::array_t<std::int64_t> colliding_pairs(const Numbers& centers, const Numbers& radii,
                                                              const std::vector<std::size_t>& necklaces,
                                                              std::size_t apart, double within);
/// Returns the closest pair and its distance, rounded; None if no pair is asked for.
[[nodiscard]] pybind11::object closest_pair_of(const Numbers& centers, const Numbers& radii,
                                               const std::vector<std::size_t>& necklaces, std::size_t apart);

}  // namespace kds::python
