#pragma once
// The name of a bead in a structure file, as one text and in its parts.

#include <optional>
#include <string>
#include <string_view>

namespace kds {

/// `number` is the residue's number including its insertion code, as in 52A. `chain` is empty if the chain
/// has no name.
struct BeadName {
  std::string atom, residue, number, chain;

  friend bool operator==(const BeadName&, const BeadName&) = default;
};

/// Returns the name as text: "CA of ALA 12 in chain A". A chain without a name is ' '.
[[nodiscard]] std::string text_of(const BeadName& name);
/// Returns the residue as text: "ALA 12", and "ALA 12 in chain A" if `with_chain` and the chain has a name.
[[nodiscard]] std::string residue_text(const BeadName& name, bool with_chain);
/// Parses the text of text_of. Returns nothing if the text is empty or no bead name.
[[nodiscard]] std::optional<BeadName> bead_name_of(std::string_view text);

}  // namespace kds
