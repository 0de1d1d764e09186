#pragma once
// What a structure file says of a bead, in one text and in its parts.

#include <optional>
#include <string>
#include <string_view>

namespace kds {

/// The residue's number has its insertion code with it, as in 52A.
struct BeadName {
  std::string atom, residue, number, chain;

  friend bool operator==(const BeadName&, const BeadName&) = default;
};

/// "CA of ALA 12 in chain A"
[[nodiscard]] std::string text_of(const BeadName& name);
/// Its parts again; none where the text is no such name, as an empty one is not.
[[nodiscard]] std::optional<BeadName> bead_name_of(std::string_view text);

}  // namespace kds
