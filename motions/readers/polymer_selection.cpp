#include "motions/readers/polymer_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/bead_name.h"
#include "motions/readers/residue_kind.h"
#include "motions/readers/vdw_radii.h"

namespace kds {

namespace {

using Residues = std::vector<const StructureResidue*>;

std::string joined(std::vector<std::string> texts, std::size_t most) {
  const std::size_t count = texts.size();
  texts.resize(std::min(most, count));
  const std::string text = fmt::format("{}", fmt::join(texts, ", "));
  return count > most ? fmt::format("{} and {} more", text, count - most) : text;
}

std::string name_of(const StructureResidue& residue) { return residue.name + ' ' + residue.number; }

// Returns whether two residues at one position are alternates. They are if all atoms of the second residue
// say so.
bool is_alternate_of(const StructureResidue& residue, const StructureResidue& before) {
  return before.number == residue.number && before.sequence == residue.sequence &&
         before.molecule == residue.molecule &&
         std::all_of(residue.atoms.begin(), residue.atoms.end(),
                     [](const StructureAtom& atom) { return atom.alternate != '\0'; });
}

// A chain, or a molecule of a chain, as --chain can name it.
struct PolymerPart {
  std::string label;
  std::string chain;
  std::optional<std::string> molecule;     // a molecule of the chain; none: all its molecules
  Residues polymer;                        // its residues, without alternates of a preceding residue
  std::vector<std::string> free_residues;  // amino acids of the chain that are treated as ligands
  bool protein = false;                    // true: protein; false: nucleic acid, if `polymer` is not empty
};

// Returns a label as messages show it.
std::string shown(const std::string& label) { return label.empty() ? "' '" : label; }

std::vector<std::string> labels_of(const std::vector<const PolymerPart*>& parts) {
  std::vector<std::string> labels;
  for (const PolymerPart* part : parts) labels.push_back(shown(part->label));
  return labels;
}

class Parts {
 public:
  explicit Parts(const StructureModel& model) : model_(model) {
    for (const StructureResidue& residue : model.residues) {
      if (find(chains_, residue.chain) == nullptr)
        chains_.push_back(PolymerPart{residue.chain, residue.chain, {}, {}, {}});
      const ResidueKind kind = kind_of(residue);
      PolymerPart& chain = *find(chains_, residue.chain);
      if (kind == ResidueKind::none && is_tabulated_monomer(residue.name) && has_backbone(residue))
        chain.free_residues.push_back(name_of(residue));
      if (kind == ResidueKind::none) continue;
      if (!chain.polymer.empty() && is_alternate_of(residue, *chain.polymer.back())) continue;
      add(chain, residue, kind);
      add(molecule_of(residue), residue, kind);
    }
    // Caps and chain ends alone are not a polymer.
    for (PolymerPart& chain : chains_)
      if (!has_monomers(chain)) chain.polymer.clear();
    std::erase_if(molecules_, [](const PolymerPart& molecule) { return !has_monomers(molecule); });
    for (PolymerPart& molecule : molecules_) {
      std::size_t number = 1;
      for (const PolymerPart* before = molecules_.data(); before != &molecule; ++before)
        if (before->chain == molecule.chain) ++number;
      molecule.label =
          molecule.chain.empty() ? std::to_string(number) : fmt::format("{}.{}", molecule.chain, number);
    }
  }

  // Returns the part with this name, or null.
  const PolymerPart* named(const std::string& label) const {
    const PolymerPart* const chain = find(chains_, label);
    return chain != nullptr ? chain : find(molecules_, label);
  }

  // Whether --chain reads this part by its label; otherwise a chain has the label as its name.
  bool can_be_named(const PolymerPart& part) const { return named(part.label) == &part; }

  std::vector<const PolymerPart*> molecules_of(const PolymerPart& chain) const {
    std::vector<const PolymerPart*> parts;
    for (const PolymerPart& molecule : molecules_)
      if (molecule.chain == chain.chain) parts.push_back(&molecule);
    return parts;
  }

  // Returns the named chains and the unnamed molecules that are polymers. Returns all chains if there are no
  // polymers.
  std::vector<const PolymerPart*> default_parts() const {
    std::vector<const PolymerPart*> parts;
    for (const PolymerPart& chain : chains_) {
      const std::vector<const PolymerPart*> molecules = molecules_of(chain);
      if (chain.label.empty() && molecules.size() > 1)
        parts.insert(parts.end(), molecules.begin(), molecules.end());
      else if (!chain.polymer.empty())
        parts.push_back(&chain);
    }
    if (parts.empty())
      for (const PolymerPart& chain : chains_) parts.push_back(&chain);
    return parts;
  }

  bool has_polymer() const { return !molecules_.empty(); }

  // Returns the residues to select from.
  Residues candidates(const PolymerPart& part, Selection selection) const {
    if (!part.polymer.empty() || selection != Selection::all) return part.polymer;
    Residues residues;
    for (const StructureResidue& residue : model_.residues)
      if (residue.chain == part.chain) residues.push_back(&residue);
    return residues;
  }

  // Describes the contents, as in "1,024 residues (HOH, NAG)", and says how many residues would be a polymer
  // if they were no HETATM records.
  std::string contents() const {
    std::vector<std::string> names;
    for (const StructureResidue& residue : model_.residues)
      if (std::find(names.begin(), names.end(), residue.name) == names.end() && names.size() < 6)
        names.push_back(residue.name);
    const auto is_het_monomer = [](const StructureResidue& residue) {
      return residue.het && is_tabulated_monomer(residue.name);
    };
    const auto het = std::count_if(model_.residues.begin(), model_.residues.end(), is_het_monomer);
    return fmt::format(
        "{} ({}){}", counted(model_.residues.size(), "residue"), joined(names, 5),
        het == 0
            ? ""
            : fmt::format(
                  ", {} of them amino acids or nucleotides in HETATM records, which are taken for free ones",
                  het));
  }

 private:
  static bool is_monomer(ResidueKind kind) {
    return kind == ResidueKind::protein || kind == ResidueKind::nucleic;
  }
  static bool has_monomers(const PolymerPart& part) {
    return std::any_of(part.polymer.begin(), part.polymer.end(),
                       [](const StructureResidue* residue) { return is_monomer(kind_of(*residue)); });
  }

  static void add(PolymerPart& part, const StructureResidue& residue, ResidueKind kind) {
    part.polymer.push_back(&residue);
    part.protein = part.protein || kind == ResidueKind::protein;
  }

  static const PolymerPart* find(const std::vector<PolymerPart>& parts, const std::string& label) {
    const auto found = std::find_if(parts.begin(), parts.end(),
                                    [&](const PolymerPart& part) { return part.label == label; });
    return found == parts.end() ? nullptr : &*found;
  }
  static PolymerPart* find(std::vector<PolymerPart>& parts, const std::string& label) {
    return const_cast<PolymerPart*>(find(std::as_const(parts), label));
  }

  PolymerPart& molecule_of(const StructureResidue& residue) {
    for (auto part = molecules_.rbegin(); part != molecules_.rend(); ++part)
      if (part->chain == residue.chain && part->molecule == residue.molecule) return *part;
    return molecules_.emplace_back(PolymerPart{{}, residue.chain, residue.molecule, {}, {}});
  }

  const StructureModel& model_;
  std::vector<PolymerPart> chains_, molecules_;
};

// Returns the first part with amino acids, otherwise the first with nucleotides, otherwise the first part.
const PolymerPart& default_part(const std::vector<const PolymerPart*>& parts) {
  for (const PolymerPart* part : parts)
    if (part->protein) return *part;
  for (const PolymerPart* part : parts)
    if (!part->polymer.empty()) return *part;
  return *parts.front();
}

std::vector<const StructureAtom*> named_atoms(const StructureResidue& residue, Selection selection) {
  const StructureAtom* ca = first_named(residue, "CA");
  if (!ca) return {};
  if (selection == Selection::ca) return {ca};
  const StructureAtom* n = first_named(residue, "N");
  const StructureAtom* c = first_named(residue, "C");
  if (!n || !c) return {};
  return {n, ca, c};
}

// Returns the atoms without alternates, and the first of each group of alternates.
std::vector<const StructureAtom*> all_atoms(const StructureResidue& residue) {
  std::vector<const StructureAtom*> atoms;
  std::set<std::string> with_alternates;
  for (const StructureAtom& atom : residue.atoms)
    if (atom.alternate == '\0' || with_alternates.insert(atom.name).second) atoms.push_back(&atom);
  return atoms;
}

std::vector<const StructureAtom*> selected_atoms(const StructureResidue& residue, Selection selection) {
  if (selection == Selection::all) return all_atoms(residue);
  return named_atoms(residue, selection);
}

bool holds_copies(const StructureResidue& residue, const std::vector<const StructureAtom*>& atoms) {
  return std::any_of(atoms.begin(), atoms.end(), [&](const StructureAtom* selected) {
    return std::count_if(residue.atoms.begin(), residue.atoms.end(), [&](const StructureAtom& atom) {
             return atom.name == selected->name && atom.alternate == selected->alternate;
           }) > 1;
  });
}

// Returns the element that the file gives for the atom. If the file gives none, a name in the wrong column
// would turn CA into calcium and HG into mercury. An atom of a chain whose element would be unusual there
// therefore gets the element of its name's first letter.
std::string element_of(const StructureAtom& atom) {
  using gemmi::El;
  if (atom.element_is_given) return atom.element.name();
  for (const El usual : {El::C, El::N, El::O, El::S, El::H, El::D, El::P, El::Se})
    if (atom.element == usual) return atom.element.name();
  const std::size_t letter = atom.name.find_first_of("CNOSHDP");
  if (letter == std::string::npos || atom.name.find_first_not_of("0123456789") != letter)
    return atom.element.name();
  return atom.name.substr(letter, 1);
}

struct PartRead {
  std::vector<SelectedAtom> atoms;
  ChainRead chain;
  std::vector<std::string> lacking;   // residues that lack an atom of the selection
  std::vector<std::string> repeated;  // residues read whose number repeats an earlier one
  std::vector<std::string> copies;    // residues read that contain a selected atom twice
  Selection selection = Selection::automatic;
};

PartRead read_part(const Parts& parts, const PolymerPart& part, Selection selection) {
  PartRead read;
  read.chain.name = part.label;
  read.selection = selection;
  const Residues candidates = parts.candidates(part, selection);
  read.chain.residues = candidates.size();
  for (const StructureResidue* residue : candidates) {
    const std::vector<const StructureAtom*> atoms = selected_atoms(*residue, selection);
    if (atoms.empty()) {
      read.lacking.push_back(name_of(*residue));
      continue;
    }
    ++read.chain.residues_read;
    if (residue->repeated && !part.polymer.empty()) read.repeated.push_back(name_of(*residue));
    if (selection != Selection::all && holds_copies(*residue, atoms))
      read.copies.push_back(name_of(*residue));
    for (const StructureAtom* atom : atoms)
      read.atoms.push_back({atom, element_of(*atom),
                            text_of({atom->name, residue->name, residue->number, shown(part.label)})});
  }
  read.chain.bead_count = read.atoms.size();
  if (read.atoms.empty() && selection == Selection::automatic)
    return read_part(parts, part, Selection::ca);  // a coarse-grained model
  return read;
}

const char* atoms_of(Selection selection) { return selection == Selection::ca ? "CA" : "N, CA and C"; }

// For a molecule whose label is the name of a chain.
std::string advice_to_rename(const PolymerPart& molecule) {
  return fmt::format("molecule {0} cannot be named by --chain, because a chain has the name {0}: rename it",
                     molecule.label);
}

// Adds notes about residues of a part that are left out or doubtful.
void add_notes(const Parts& parts, const PolymerPart& part, const PartRead& read,
               std::vector<std::string>& notes) {
  constexpr std::size_t most = 5;
  const std::string label = shown(part.label);
  if (!read.lacking.empty())
    notes.push_back(fmt::format("chain {}: {} of {} read; {} without {}: {}", label, read.chain.residues_read,
                                counted(read.chain.residues, "residue"), read.lacking.size(),
                                atoms_of(read.selection), joined(read.lacking, most)));
  if (!read.repeated.empty())
    notes.push_back(fmt::format("chain {}: {} with the number of an earlier one, read too: {}", label,
                                counted(read.repeated.size(), "residue"), joined(read.repeated, most)));
  if (!read.copies.empty())
    notes.push_back(fmt::format("chain {}: {} with an atom of the selection twice, the first counts: {}",
                                label, counted(read.copies.size(), "residue"), joined(read.copies, most)));
  if (!part.free_residues.empty())
    notes.push_back(fmt::format("chain {}: {} taken for free ones (HETATM) and not read: {}", label,
                                counted(part.free_residues.size(), "amino acid"),
                                joined(part.free_residues, most)));
  const std::vector<const PolymerPart*> molecules = parts.molecules_of(part);
  if (!part.molecule && molecules.size() > 1) {
    std::string line =
        fmt::format("chain {} has {} molecules and is read as one necklace", label, molecules.size());
    std::vector<std::string> labels, hidden;
    for (const PolymerPart* molecule : molecules) {
      if (parts.can_be_named(*molecule)) {
        labels.push_back(molecule->label);
      } else {
        hidden.push_back(advice_to_rename(*molecule));
      }
    }
    if (!labels.empty()) line += fmt::format("; --chain {} reads one each", fmt::join(labels, ","));
    for (const std::string& advice : hidden) line += "; " + advice;
    notes.push_back(line);
  }
}

// Returns a note about the parts that are not read by default.
std::optional<std::string> describe_unread(const Parts& parts, const PolymerPart& read, const PartRead& beads,
                                           Selection selection) {
  constexpr std::size_t most = 10;
  std::vector<const PolymerPart*> unread, readable, hidden;
  bool chains = !read.molecule;
  std::size_t residues = beads.chain.residues;
  for (const PolymerPart* part : parts.default_parts()) {
    if (part == &read) continue;
    unread.push_back(part);
    chains = chains || !part->molecule;
    const PartRead other = read_part(parts, *part, selection);
    residues += other.chain.residues;
    if (!other.atoms.empty()) (parts.can_be_named(*part) ? readable : hidden).push_back(part);
  }
  if (unread.empty()) return std::nullopt;
  const std::string noun = chains ? "chain" : "molecule", labels = joined(labels_of(unread), most);
  std::string line = fmt::format("{}{} {} not read", noun, unread.size() == 1 ? "" : "s", labels);
  if (!chains)
    line = fmt::format("no chain has a name: molecule {} is read, {} of {}; {}", read.label,
                       beads.chain.residues_read, counted(residues, "residue"), line);
  if (!readable.empty()) {
    const std::string label = shown(readable.front()->label);
    const std::string both =
        parts.can_be_named(read) ? fmt::format(" or --chain {},{}", shown(read.label), label) : "";
    line +=
        fmt::format("; --chain {}{} reads {}", label, both, readable.size() == 1 ? "it" : "them likewise");
  }
  for (const PolymerPart* part : hidden) line += fmt::format("; {}", advice_to_rename(*part));
  return line;
}

InputError no_polymer_in(const std::string& file, const Parts& parts) {
  return InputError(
      fmt::format("{}: no chain of amino acids or nucleotides in this file, which holds {}; "
                  "--select all reads them",
                  file, parts.contents()));
}

std::vector<const PolymerPart*> parts_asked_for(const std::string& file, const Parts& parts,
                                                Selection selection, const std::optional<std::string>& list) {
  if (!parts.has_polymer() && selection != Selection::all && !list) throw no_polymer_in(file, parts);
  if (!list) return {&default_part(parts.default_parts())};
  std::vector<const PolymerPart*> wanted;
  for (std::string_view rest = *list;;) {
    const std::size_t comma = rest.find(',');
    const std::string name(trimmed(rest.substr(0, comma)));
    const PolymerPart* const part = parts.named(name);
    if (part == nullptr) {
      if (!parts.has_polymer() && selection != Selection::all) throw no_polymer_in(file, parts);
      std::vector<std::string> expected;
      for (const PolymerPart* one : parts.default_parts()) {
        if (parts.can_be_named(*one)) expected.push_back(shown(one->label));
        const std::vector<const PolymerPart*> molecules = parts.molecules_of(*one);
        if (!one->molecule && molecules.size() > 1)
          for (const PolymerPart* molecule : molecules)
            if (parts.can_be_named(*molecule)) expected.push_back(molecule->label);
      }
      throw InputError(fmt::format("--chain: {} has no chain {}; expected {}", file, in_quotes(name),
                                   joined(expected, expected.size())));
    }
    if (std::find(wanted.begin(), wanted.end(), part) != wanted.end())
      throw InputError(fmt::format("--chain: {} is listed twice for {}", in_quotes(name), file));
    for (const PolymerPart* other : wanted)
      if (other->chain == part->chain && (!other->molecule || !part->molecule))
        throw InputError(fmt::format("--chain: molecule {} of {} is part of chain {}, which is listed too",
                                     part->molecule ? part->label : other->label, file,
                                     in_quotes(part->chain)));
    wanted.push_back(part);
    if (comma == std::string_view::npos) return wanted;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace

SelectedChains select_chains(const std::string& file, const StructureModel& model, Selection selection,
                             const std::optional<std::string>& list) {
  if (model.residues.empty()) throw InputError(fmt::format("{}: no atoms", file));
  const Parts parts(model);
  SelectedChains selected;
  for (const PolymerPart* part : parts_asked_for(file, parts, selection, list)) {
    PartRead read = read_part(parts, *part, selection);
    if (read.atoms.empty())
      throw InputError(
          fmt::format("--select: chain {} of {} does not hold {} in any residue of a polymer; "
                      "--select all reads its {}",
                      in_quotes(part->label), file, selection == Selection::ca ? "an atom CA" : "N, CA and C",
                      counted(parts.candidates(*part, Selection::all).size(), "residue")));
    // A list of chains leaves out the others on purpose.
    if (!list)
      if (auto unread = describe_unread(parts, *part, read, selection))
        selected.notes.push_back(std::move(*unread));
    add_notes(parts, *part, read, selected.notes);
    selected.chains.push_back(std::move(read.chain));
    std::move(read.atoms.begin(), read.atoms.end(), std::back_inserter(selected.atoms));
  }
  return selected;
}

std::vector<double> element_radii_of(const std::vector<SelectedAtom>& atoms) {
  std::vector<double> radii;
  for (const SelectedAtom& selected : atoms) {
    const auto radius = van_der_waals_radius(selected.element);
    if (!radius) return {};
    radii.push_back(*radius);
  }
  return radii;
}

}  // namespace kds
