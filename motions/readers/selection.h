#pragma once
// Which atoms of a structure become beads: a name, or an atom selection in gemmi's syntax.
//
// An atom selection has the form /MODEL/CHAINS/RESIDUES/ATOMS, as in //A/10-40/CA,CB. Parts may be missing:
// A/10-40, 10-40/CA, (ALA,GLY), [C], CA[C]:A. Conditions follow semicolons: ;q>0.5, ;b<30, ;polymer.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kds {

class Selection {
 public:
  enum Kind {
    automatic,  ///< backbone if residues are known (else CA, else BB), otherwise all
    backbone,   ///< N, CA, C of each residue that has all three
    ca,
    bb,     ///< BB, the backbone beads of Martini
    p,      ///< P, the phosphorus atoms of nucleic acids
    heavy,  ///< all atoms but hydrogens
    all,
    atoms,  ///< those of an atom selection, from any residue of any chain
  };

  Selection(Kind kind = automatic) : kind_(kind) {}  // NOLINT: a kind is a selection
  /// Returns the selection that `text` asks for: a name in upper or lower case, or an atom selection. Returns
  /// nothing if `text` is neither a name nor shaped like an atom selection. Throws InputError naming
  /// `option` if an atom selection is malformed.
  [[nodiscard]] static std::optional<Selection> parse(std::string_view text,
                                                      std::string_view option = "--select");

  [[nodiscard]] Kind kind() const { return kind_; }
  /// Returns the text that `parse` takes; "automatic" if there is none.
  [[nodiscard]] std::string text() const;
  /// Returns whether atoms must have names: not for `automatic` and `all`.
  [[nodiscard]] bool needs_names() const { return kind_ != automatic && kind_ != all; }

  friend bool operator==(const Selection&, const Selection&) = default;
  friend bool operator==(const Selection& selection, Kind kind) { return selection.kind_ == kind; }

 private:
  Kind kind_;
  std::string atoms_;  ///< for the kind `atoms`
};

/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 7> selection_names{"automatic", "backbone", "ca", "bb",
                                                                 "p",         "heavy",    "all"};
/// The form of an atom selection, for messages and help texts.
inline constexpr std::string_view selection_example = "//A/10-40/CA,CB";

}  // namespace kds
