#include "motions/readers/residue_kind.h"

#include <algorithm>
#include <array>
#include <gemmi/resinfo.hpp>
#include <span>

namespace kds {

namespace {

bool has_atom(const StructureResidue& residue, std::string_view name, gemmi::El element) {
  return std::any_of(residue.atoms.begin(), residue.atoms.end(),
                     [&](const StructureAtom& atom) { return atom.name == name && atom.element == element; });
}

bool is_among(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Names of protonation states and of chain ends that the table of residues does not hold.
constexpr std::array<std::string_view, 17> amino_acids{"HSD",  "HSE",  "HSP",  "HID",  "HIE", "HIP",
                                                       "HISD", "HISE", "HISH", "CYX",  "CYM", "ASH",
                                                       "GLH",  "LYN",  "ARN",  "CYSH", "LYSH"};
constexpr std::array<std::string_view, 5> nucleotides{"ADE", "CYT", "GUA", "THY", "URA"};
constexpr std::array<std::string_view, 19> waters{"SOL",  "WAT", "TIP3", "TIP4", "TIP5", "TIP", "TP3",
                                                  "TP3M", "T3P", "T4P",  "SPC",  "SPCE", "OPC", "OPC3",
                                                  "TP4",  "W",   "WF",   "PW",   "HOH"};

// Returns whether AMBER gives this name to a nucleotide. Such a name has up to three letters: D or R, which
// may be missing; the base; and 5, 3 or N at an end of a strand. Without the last letter the name must begin
// with R, because gemmi knows the others.
bool is_amber_nucleotide(std::string_view name) {
  if (name.size() > 1 && (name.back() == '5' || name.back() == '3' || name.back() == 'N')) {
    name.remove_suffix(1);
  } else if (!name.starts_with('R')) {
    return false;
  }
  if (name.size() == 2 && (name[0] == 'D' || name[0] == 'R')) name.remove_prefix(1);
  return name.size() == 1 && std::string_view("ACGTU").find(name[0]) != std::string_view::npos;
}

// Lipids have P too. A nucleotide has a sugar, or no more beads than a coarse model.
bool is_nucleotide_by_atoms(const StructureResidue& residue) {
  constexpr std::array<std::string_view, 6> sugar{"C1'", "C1*", "O5'", "O5*", "O3'", "O3*"};
  constexpr std::size_t most_beads = 3;
  return has_atom(residue, "P", gemmi::El::P) &&
         (residue.atoms.size() <= most_beads ||
          std::any_of(residue.atoms.begin(), residue.atoms.end(),
                      [&](const StructureAtom& atom) { return is_among(sugar, atom.name); }));
}

}  // namespace

bool is_water(const std::string& name) {
  return is_among(waters, name) || gemmi::find_tabulated_residue(name).is_water();
}

bool is_cap(const std::string& name) {
  return name == "ACE" || name == "FOR" || name == "NME" || name == "NMA" || name == "NAC" || name == "NH2";
}

bool is_martini(const StructureResidue& residue) { return first_named(residue, "BB") != nullptr; }

bool names_site(const StructureResidue& residue, const std::string& name) {
  if (name.starts_with("LP") || name.starts_with("EP") || name == "M" || name == "MW") return true;
  if (name.starts_with('M')) return is_tabulated_monomer(residue.name) || is_water(residue.name);
  if (name == "OM") return is_water(residue.name);
  return name.size() > 1 && name[0] == 'D' && std::string_view("CNOSP").find(name[1]) != std::string::npos &&
         first_named(residue, std::string_view(name).substr(1)) != nullptr;
}

bool is_site(const StructureResidue& residue, const StructureAtom& atom) {
  if (atom.is_massless) return true;
  if (atom.element_is_given && atom.element != gemmi::El::X) return false;
  return names_site(residue, atom.name) && !is_martini(residue);
}

gemmi::Element element_of(const StructureResidue& residue, const StructureAtom& atom) {
  using gemmi::El;
  if (is_martini(residue) || is_site(residue, atom)) return El::X;
  if (atom.element_is_given) return atom.element;
  for (const El usual : {El::C, El::N, El::O, El::S, El::H, El::D, El::P, El::Se})
    if (atom.element == usual) return atom.element;
  const std::size_t letter = atom.name.find_first_of("CNOSHDP");
  if (letter == std::string::npos || atom.name.find_first_not_of("0123456789") != letter) return atom.element;
  return gemmi::Element(atom.name.substr(letter, 1));
}

const StructureAtom* first_named(const StructureResidue& residue, std::string_view name) {
  for (const StructureAtom& atom : residue.atoms)
    if (atom.name == name) return &atom;
  return nullptr;
}

bool has_backbone(const StructureResidue& residue) {
  return first_named(residue, "N") != nullptr && first_named(residue, "CA") != nullptr &&
         first_named(residue, "C") != nullptr;
}

bool is_tabulated_monomer(const std::string& name) {
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(name);
  if (info.found()) return info.is_amino_acid() || info.is_nucleic_acid();
  return is_among(amino_acids, name) || is_among(nucleotides, name) || is_amber_nucleotide(name);
}

ResidueKind kind_of(const StructureResidue& residue) {
  if (residue.entity == Entity::other) return ResidueKind::none;
  const bool said_to_be = residue.entity == Entity::polymer;
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(residue.name);
  if (info.is_water() || is_among(waters, residue.name)) return ResidueKind::none;
  // A standard residue as HETATM is a free molecule in the buffer, unless the file says otherwise.
  if (!said_to_be && info.found() && info.is_standard() && residue.het) return ResidueKind::none;
  if (info.found() && info.is_amino_acid()) return ResidueKind::protein;
  if (info.found() && info.is_nucleic_acid()) return ResidueKind::nucleic;
  if (info.found() && !said_to_be) return ResidueKind::none;
  if (has_atom(residue, "CA", gemmi::El::C) || has_backbone(residue) || is_martini(residue))
    return ResidueKind::protein;
  if (!info.found() && (is_among(nucleotides, residue.name) || is_amber_nucleotide(residue.name)))
    return ResidueKind::nucleic;
  if (is_nucleotide_by_atoms(residue)) return ResidueKind::nucleic;
  return said_to_be ? ResidueKind::cap : ResidueKind::none;
}

}  // namespace kds
