#pragma once
// The distance at which two beads are in contact.

#include <span>
#include <vector>

namespace kds {

/// When two beads are in contact: while the distance of their centres, or of their surfaces, is at most
/// `length`.
struct ContactDistance {
  double length = 0;
  bool between_surfaces = false;
};
/// Returns radii with which balls meet exactly while the beads are in contact by this distance. Half of
/// `length` is added to each bead's radius (or to 0, between centres) and the sum is rounded once. So a
/// distance between centres is exact, and one between surfaces is exact if the sums are.
[[nodiscard]] std::vector<double> contact_radii(const ContactDistance& distance,
                                                std::span<const double> radii);

}  // namespace kds
