#pragma once
// The elements between which contacts are counted: beads, residues or chains.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "motions/scene/scene.h"

namespace kds {

enum class ContactElement : std::uint8_t { bead, residue, chain };
/// Names of the enumerators, in their order.
inline constexpr std::array<std::string_view, 3> contact_element_names{"bead", "residue", "chain"};
[[nodiscard]] constexpr std::string_view name_of(ContactElement element) {
  return contact_element_names[static_cast<std::size_t>(element)];
}

/// Elements are numbered from 0 along the scene's beads.
struct ContactElements {
  std::vector<std::uint32_t> of_bead;  ///< the element of each bead
  std::vector<std::uint32_t> chains;   ///< the necklace of each element
  std::vector<std::string> names;      ///< of each element: "ALA 12", "chain A", or "bead 3" without a name
};

/// A residue is a run of neighbouring beads of one necklace whose names have the same residue. A chain is a
/// necklace. Names of residues include the chain if there are several necklaces. Throws InputError if
/// residues are asked for and a bead has none.
[[nodiscard]] ContactElements elements_of(const Scene& scene, ContactElement kind);

}  // namespace kds
