#include "motions/readers/polymer_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/atom_filter.h"
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

// Returns whether two residues at one position are alternates. Two residues are alternates if all atoms of
// the second residue have alternate locations.
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
  bool rest = false;                       // only the residues of the chain that are in no molecule
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
        chains_.push_back(PolymerPart{residue.chain, residue.chain, {}, false, {}, {}});
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

  // Returns all residues of the model: by chain, and by molecule if a chain with several has no name.
  std::vector<PolymerPart> whole_parts() const {
    std::vector<PolymerPart> parts;
    for (const PolymerPart& chain : chains_) {
      PolymerPart rest = chain;
      const std::vector<const PolymerPart*> molecules = molecules_of(chain);
      if (chain.label.empty() && molecules.size() > 1) {
        for (const PolymerPart* molecule : molecules) parts.push_back(*molecule);
        rest.rest = true;
      }
      parts.push_back(std::move(rest));
    }
    return parts;
  }

  bool has_polymer() const { return !molecules_.empty(); }

  // Returns the residues to select from.
  Residues candidates(const PolymerPart& part, const Selection& selection) const {
    const bool any_residue =
        selection == Selection::atoms || (part.polymer.empty() && selection == Selection::all);
    if (!any_residue) return part.polymer;
    const std::vector<const PolymerPart*> molecules =
        part.rest ? molecules_of(part) : std::vector<const PolymerPart*>{};
    Residues residues;
    for (const StructureResidue& residue : model_.residues) {
      if (residue.chain != part.chain || (part.molecule && residue.molecule != *part.molecule)) continue;
      if (std::any_of(molecules.begin(), molecules.end(),
                      [&](const PolymerPart* molecule) { return residue.molecule == *molecule->molecule; }))
        continue;
      residues.push_back(&residue);
    }
    return residues;
  }

  const StructureModel& model() const { return model_; }

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
    return molecules_.emplace_back(PolymerPart{{}, residue.chain, residue.molecule, false, {}, {}});
  }

  const StructureModel& model_;
  std::vector<PolymerPart> chains_, molecules_;
};

// Returns the first part with amino acids, otherwise the first with nucleotides, otherwise the first part.
// The selection `p` asks for nucleotides first.
const PolymerPart& default_part(const std::vector<const PolymerPart*>& parts, const Selection& selection) {
  for (const PolymerPart* part : parts)
    if (!part->polymer.empty() && part->protein != (selection == Selection::p)) return *part;
  for (const PolymerPart* part : parts)
    if (!part->polymer.empty()) return *part;
  return *parts.front();
}

// The names of the atoms that a selection takes from each residue that has them all.
std::vector<std::string_view> atom_names_of(const Selection& selection) {
  switch (selection.kind()) {
    case Selection::ca:
      return {"CA"};
    case Selection::bb:
      return {"BB"};
    case Selection::p:
      return {"P"};
    default:
      return {"N", "CA", "C"};
  }
}

std::vector<const StructureAtom*> named_atoms(const StructureResidue& residue, const Selection& selection) {
  std::vector<const StructureAtom*> atoms;
  for (const std::string_view name : atom_names_of(selection)) {
    const StructureAtom* const atom = first_named(residue, name);
    if (atom == nullptr) return {};
    atoms.push_back(atom);
  }
  return atoms;
}

// Returns the atoms without alternates, and the first of each group of alternates.
std::vector<const StructureAtom*> all_atoms(const StructureResidue& residue) {
  std::vector<const StructureAtom*> atoms;
  std::set<std::string> with_alternates;
  for (const StructureAtom& atom : residue.atoms)
    if (atom.alternate == '\0' || with_alternates.insert(atom.name).second) atoms.push_back(&atom);
  return atoms;
}

bool is_heavy(const StructureResidue& residue, const StructureAtom& atom) {
  const gemmi::Element element = element_of(residue, atom);
  return element != gemmi::El::H && element != gemmi::El::D && !is_site(residue, atom);
}

// A selection, ready to be applied to residues.
class AtomChoice {
 public:
  AtomChoice(std::string file, const Selection& selection, std::string_view option = "--select")
      : file_(std::move(file)), selection_(selection) {
    if (selection == Selection::atoms) filter_.emplace(selection.text(), option);
  }
  // Uses the filter of another choice.
  AtomChoice(const AtomChoice& other, const Selection& selection)
      : file_(other.file_), selection_(selection), filter_(other.filter_) {}

  const Selection& selection() const { return selection_; }
  // Whether the selection takes atoms by their names from each residue, and a residue without them is missed.
  bool is_by_name() const {
    return selection_ != Selection::all && selection_ != Selection::heavy && selection_ != Selection::atoms;
  }
  std::vector<const StructureAtom*> atoms_of(const StructureResidue& residue) const {
    if (filter_) return filter_->atoms_of(file_, residue);
    if (is_by_name()) return named_atoms(residue, selection_);
    std::vector<const StructureAtom*> atoms = all_atoms(residue);
    if (selection_ == Selection::heavy)
      std::erase_if(atoms, [&](const StructureAtom* atom) { return !is_heavy(residue, *atom); });
    return atoms;
  }
  // Returns whether the selection has this atom of the residue, be it the first of its alternates or not.
  bool takes(const StructureResidue& residue, bool in_polymer, const StructureAtom& atom) const {
    if (filter_) return filter_->takes(file_, residue, atom);
    if (selection_ == Selection::heavy) return is_heavy(residue, atom);
    if (!is_by_name()) return true;
    const std::vector<std::string_view> names = atom_names_of(selection_);
    return in_polymer && std::find(names.begin(), names.end(), atom.name) != names.end() &&
           !named_atoms(residue, selection_).empty();
  }

 private:
  std::string file_;
  Selection selection_;
  std::optional<AtomFilter> filter_;
};

// Returns the groups of a bead, which are those of its atom. The atom is one of the residue's atoms.
std::uint8_t groups_of(const std::vector<AtomChoice>& groups, const StructureResidue& residue,
                       bool in_polymer, const StructureAtom& atom) {
  unsigned of_bead = 0;
  for (std::size_t k = 0; k < groups.size(); ++k)
    if (groups[k].takes(residue, in_polymer, atom)) of_bead |= 1U << k;
  return static_cast<std::uint8_t>(of_bead);
}

bool holds_copies(const StructureResidue& residue, const std::vector<const StructureAtom*>& atoms) {
  return std::any_of(atoms.begin(), atoms.end(), [&](const StructureAtom* selected) {
    return std::count_if(residue.atoms.begin(), residue.atoms.end(), [&](const StructureAtom& atom) {
             return atom.name == selected->name && atom.alternate == selected->alternate;
           }) > 1;
  });
}

// Returns the atom that stands for a residue in the bonds along its polymer.
const StructureAtom& guide_of(const StructureResidue& residue) {
  for (const std::string_view name : {"CA", "BB", "P"})
    if (const StructureAtom* const atom = first_named(residue, name)) return *atom;
  return residue.atoms.front();
}

// Follows the residues of a part in order, from each that is read to the next one by bonds.
class BondWalk {
 public:
  explicit BondWalk(bool lists_bonds) : lists_bonds_(lists_bonds) {}

  // Notes a residue that is left out.
  void leave_out(const StructureResidue& residue) {
    if (last_ == nullptr || !is_bonded_to_last(residue)) return;
    const StructureResidue& before = left_out_.empty() ? *last_ : *left_out_.back();
    if (!is_alternate_of(residue, before)) left_out_.push_back(&residue);
  }
  // Goes on to a residue that is read. Returns whether bonds lead to it from the residue read before. The
  // bonds lead through the residues left_out().
  bool go_to(const StructureResidue& residue) {
    left_out_behind_.clear();
    const bool bonded = last_ != nullptr && is_bonded_to_last(residue);
    if (bonded) left_out_behind_.swap(left_out_);
    left_out_.clear();
    if (!bonded) is_polymer_ = is_in_polymer(residue);
    last_ = &residue;
    return bonded;
  }
  const Residues& left_out() const { return left_out_behind_; }
  // Whether the residue that is read last belongs to a polymer.
  bool is_polymer() const { return is_polymer_; }

 private:
  static bool is_in_polymer(const StructureResidue& residue) {
    return kind_of(residue) != ResidueKind::none || is_cap(residue.name);
  }
  bool is_bonded_to_last(const StructureResidue& residue) const {
    if (residue.chain != last_->chain || residue.molecule != last_->molecule) return false;
    return lists_bonds_ || (is_polymer_ && is_in_polymer(residue));
  }

  bool lists_bonds_;
  bool is_polymer_ = false;
  const StructureResidue* last_ = nullptr;
  Residues left_out_, left_out_behind_;
};

struct PartRead {
  std::vector<SelectedAtom> atoms;
  ChainRead chain;
  BondPaths bonds;                    // numbers of beads count from the part's first one
  std::vector<SelectedAtom> guides;   // the guides of `bonds`
  std::vector<std::string> lacking;   // residues that lack an atom of the selection
  std::vector<std::string> repeated;  // residues read whose number repeats an earlier one
  std::vector<std::string> copies;    // residues read that contain a selected atom twice
  std::vector<std::string> sites;     // massless sites that the selection `heavy` leaves out
  Selection selection = Selection::automatic;
};

PartRead read_part(const Parts& parts, const PolymerPart& part, const AtomChoice& choice,
                   const std::vector<AtomChoice>& groups) {
  const Selection& selection = choice.selection();
  PartRead read;
  read.chain.name = part.label;
  read.selection = selection;
  const Residues candidates = parts.candidates(part, selection);
  read.chain.residues = candidates.size();
  BondWalk walk(parts.model().lists_bonds);
  const auto selected = [&](const StructureAtom& atom, const StructureResidue& residue) {
    return SelectedAtom{&atom, element_of(residue, atom).name(),
                        text_of({atom.name, residue.name, residue.number, part.label})};
  };
  const StructureResidue* last = nullptr;  // the residue that was read last
  for (const StructureResidue* residue : candidates) {
    if (last != nullptr && selection == Selection::atoms && is_alternate_of(*residue, *last)) continue;
    const std::vector<const StructureAtom*> atoms = choice.atoms_of(*residue);
    if (selection == Selection::heavy)
      for (const StructureAtom* atom : all_atoms(*residue))
        if (is_site(*residue, *atom)) read.sites.push_back(atom->name + " of " + name_of(*residue));
    if (!atoms.empty()) last = residue;
    if (atoms.empty()) {
      if (choice.is_by_name()) read.lacking.push_back(name_of(*residue));
      if (selection == Selection::atoms) walk.leave_out(*residue);
      continue;
    }
    ++read.chain.residues_read;
    if (!walk.go_to(*residue)) read.bonds.pieces.push_back({read.atoms.size(), walk.is_polymer()});
    for (const StructureResidue* between : walk.left_out()) {
      read.guides.push_back(selected(guide_of(*between), *between));
      read.bonds.guides_before.push_back(read.atoms.size());
    }
    if (residue->repeated && !part.polymer.empty()) read.repeated.push_back(name_of(*residue));
    if (choice.is_by_name() && holds_copies(*residue, atoms)) read.copies.push_back(name_of(*residue));
    const bool in_polymer = !part.polymer.empty() && kind_of(*residue) != ResidueKind::none;
    for (const StructureAtom* atom : atoms) {
      read.atoms.push_back(selected(*atom, *residue));
      read.atoms.back().groups = groups_of(groups, *residue, in_polymer, *atom);
    }
  }
  read.chain.bead_count = read.atoms.size();
  if (read.atoms.empty() && selection == Selection::automatic) {
    // A coarse-grained model may have CA or Martini's BB.
    for (const Selection::Kind kind : {Selection::ca, Selection::bb}) {
      PartRead coarse = read_part(parts, part, AtomChoice(choice, kind), groups);
      if (!coarse.atoms.empty()) return coarse;
    }
  }
  return read;
}

std::string atoms_of(const Selection& selection) {
  const std::vector<std::string_view> names = atom_names_of(selection);
  return names.size() == 1 ? std::string(names[0]) : "N, CA and C";
}

// For a molecule whose label is the name of a chain.
std::string advice_to_rename(const PolymerPart& molecule) {
  return fmt::format("molecule {0} cannot be named by {1}, because a chain has the name {0}: rename it",
                     molecule.label, "--chain"_arg);
}

// Adds notes about residues of a part that are left out or doubtful.
void add_notes(const Parts& parts, const PolymerPart& part, const PartRead& read, const Selection& asked,
               std::vector<std::string>& notes) {
  constexpr std::size_t most = 5;
  const std::string label = shown(part.label);
  if (asked == Selection::automatic && read.selection == Selection::bb)
    notes.push_back(
        fmt::format("chain {}: no residue has N, CA and C; the BB beads of Martini are read", label));
  if (!read.lacking.empty())
    notes.push_back(fmt::format("chain {}: {} of {} read; {} without {}: {}", label, read.chain.residues_read,
                                counted(read.chain.residues, "residue"), read.lacking.size(),
                                atoms_of(read.selection), joined(read.lacking, most)));
  if (!read.sites.empty())
    notes.push_back(fmt::format(
        "chain {}: {} (lone pairs, virtual sites, Drude particles) left out, as they are no heavy atoms: {}",
        label, counted(read.sites.size(), "massless site"), joined(read.sites, most)));
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
    if (!labels.empty()) line += fmt::format("; {} {} reads one each", "--chain"_arg, fmt::join(labels, ","));
    for (const std::string& advice : hidden) line += "; " + advice;
    notes.push_back(line);
  }
}

// Returns a note about the parts that are not read by default.
std::optional<std::string> describe_unread(const Parts& parts, const PolymerPart& read, const PartRead& beads,
                                           const AtomChoice& choice) {
  constexpr std::size_t most = 10;
  std::vector<const PolymerPart*> unread, readable, hidden;
  bool chains = !read.molecule;
  std::size_t residues = beads.chain.residues;
  for (const PolymerPart* part : parts.default_parts()) {
    if (part == &read) continue;
    unread.push_back(part);
    chains = chains || !part->molecule;
    const PartRead other = read_part(parts, *part, choice, {});
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
        parts.can_be_named(read) ? fmt::format(" or {} {},{}", "--chain"_arg, shown(read.label), label) : "";
    line += fmt::format("; {} {}{} reads {}", "--chain"_arg, label, both,
                        readable.size() == 1 ? "it" : "them likewise");
  }
  for (const PolymerPart* part : hidden) line += fmt::format("; {}", advice_to_rename(*part));
  return line;
}

InputError no_polymer_in(const std::string& file, const Parts& parts) {
  return InputError(fmt::format(
      "{}: no chain of amino acids or nucleotides in this file, which holds {}; {} all reads them", file,
      parts.contents(), "--select"_arg));
}

std::vector<const PolymerPart*> parts_asked_for(const std::string& file, const Parts& parts,
                                                const Selection& selection,
                                                const std::optional<std::string>& list) {
  const bool needs_polymer = selection != Selection::all && selection != Selection::atoms;
  if (!parts.has_polymer() && needs_polymer && !list) throw no_polymer_in(file, parts);
  if (!list) return {&default_part(parts.default_parts(), selection)};
  std::vector<const PolymerPart*> wanted;
  for (std::string_view rest = *list;;) {
    const std::size_t comma = rest.find(',');
    const std::string name(trimmed(rest.substr(0, comma)));
    const PolymerPart* const part = parts.named(name);
    if (part == nullptr) {
      if (!parts.has_polymer() && needs_polymer) throw no_polymer_in(file, parts);
      std::vector<std::string> expected;
      for (const PolymerPart* one : parts.default_parts()) {
        if (parts.can_be_named(*one)) expected.push_back(shown(one->label));
        const std::vector<const PolymerPart*> molecules = parts.molecules_of(*one);
        if (!one->molecule && molecules.size() > 1)
          for (const PolymerPart* molecule : molecules)
            if (parts.can_be_named(*molecule)) expected.push_back(molecule->label);
      }
      throw InputError("--chain", fmt::format("{} has no chain {}; expected {}", file, in_quotes(name),
                                              joined(expected, expected.size())));
    }
    if (std::find(wanted.begin(), wanted.end(), part) != wanted.end())
      throw InputError("--chain", fmt::format("{} is listed twice for {}", in_quotes(name), file));
    for (const PolymerPart* other : wanted)
      if (other->chain == part->chain && (!other->molecule || !part->molecule))
        throw InputError("--chain", fmt::format("molecule {} of {} is part of chain {}, which is listed too",
                                                part->molecule ? part->label : other->label, file,
                                                in_quotes(part->chain)));
    wanted.push_back(part);
    if (comma == std::string_view::npos) return wanted;
    rest.remove_prefix(comma + 1);
  }
}

// Returns the first few of the texts that differ.
template <class Text>
std::string first_few(const StructureModel& model, std::size_t most, const Text& text_of_residue) {
  std::vector<std::string> texts;
  for (const StructureResidue& residue : model.residues) {
    const std::string text = text_of_residue(residue);
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
    if (texts.size() > most) {
      texts.back() = "...";
      break;
    }
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Returns a selection that may have been meant, as the end of a message.
std::string advice_on_selection(const StructureModel& model, const std::string& text) {
  const auto any_residue = [&](const auto& holds) {
    return std::any_of(model.residues.begin(), model.residues.end(), holds);
  };
  // A selection without leading slash begins with chains.
  const std::size_t slash = text.find('/');
  const std::string names = text.substr(0, slash);
  if (!names.empty() && names.find('(') == std::string::npos &&
      any_residue([&](const StructureResidue& residue) { return residue.name == names; }))
    return fmt::format("; {0} is the name of a residue, not of a chain: ({0}) chooses it", names);
  const bool named = any_residue([](const StructureResidue& residue) { return !residue.chain.empty(); });
  if (!named && text.starts_with("//") && !text.starts_with("//*"))
    return fmt::format("; no chain has a name here: //*/ allows any, and {} 1 takes the first molecule",
                       "--chain"_arg);
  return "";
}

InputError nothing_selected(const std::string& file, const StructureModel& model, const Selection& selection,
                            const std::optional<std::string>& list) {
  constexpr std::size_t most = 6;
  const StructureResidue& middle = model.residues[model.residues.size() / 2];
  std::vector<std::string> atoms;
  for (const StructureAtom& atom : middle.atoms) atoms.push_back(atom.name);
  return InputError(
      "--select",
      fmt::format(
          "{} selects no atom of {}{}, which has the chains {}; residues {} to {} ({}); {} has the atoms "
          "{}{}",
          in_quotes(selection.text()), file, list ? fmt::format(" in {} {}", "--chain"_arg, *list) : "",
          first_few(model, most, [](const StructureResidue& residue) { return shown(residue.chain); }),
          name_of(model.residues.front()), name_of(model.residues.back()),
          first_few(model, most, [](const StructureResidue& residue) { return residue.name; }),
          name_of(middle), joined(atoms, most), advice_on_selection(model, selection.text())));
}

// Explains why a chain that was asked for has no beads.
InputError no_beads(const std::string& file, const Parts& parts, const PolymerPart& part,
                    const Selection& selection) {
  const bool has_p =
      std::any_of(part.polymer.begin(), part.polymer.end(),
                  [](const StructureResidue* residue) { return first_named(*residue, "P") != nullptr; });
  const std::string names = atoms_of(selection);
  return InputError(
      "--select",
      fmt::format("chain {} of {} does not hold {} in any residue of a polymer; {}{} all reads its {}",
                  in_quotes(part.label.empty() ? " " : part.label), file,
                  selection == Selection::heavy          ? "an atom heavier than hydrogen"
                  : names.find(',') == std::string::npos ? "an atom " + names
                                                         : names,
                  has_p && selection != Selection::p ? "--select"_arg + " p reads its P atoms, " : "",
                  "--select"_arg, counted(parts.candidates(part, Selection::all).size(), "residue")));
}

// Returns whether the atom's name is that of an atom of a backbone.
bool is_chain_atom(const SelectedAtom& selected) {
  constexpr std::array<std::string_view, 5> names{"N", "CA", "C", "BB", "P"};
  return std::find(names.begin(), names.end(), selected.atom->name) != names.end();
}

bool is_chain_like(const Selection& selection, const std::vector<SelectedAtom>& atoms) {
  if (selection == Selection::atoms) return std::all_of(atoms.begin(), atoms.end(), is_chain_atom);
  return selection != Selection::all && selection != Selection::heavy;
}

}  // namespace

SelectedChains select_chains(const std::string& file, const StructureModel& model, const Selection& selection,
                             const std::optional<std::string>& list, std::span<const Selection> groups) {
  if (model.residues.empty()) throw InputError(fmt::format("{}: no atoms", file));
  const Parts parts(model);
  const AtomChoice choice(file, selection);
  std::vector<AtomChoice> group_choices;
  for (const Selection& group : groups) group_choices.emplace_back(file, group, "--groups");
  SelectedChains selected;
  const auto take = [&](PartRead&& read) {
    const std::size_t first = selected.atoms.size();
    for (const PieceRead& piece : read.bonds.pieces)
      selected.bonds.pieces.push_back({first + piece.first, piece.polymer});
    for (const std::size_t bead : read.bonds.guides_before)
      selected.bonds.guides_before.push_back(first + bead);
    std::move(read.guides.begin(), read.guides.end(), std::back_inserter(selected.guides));
    selected.chains.push_back(std::move(read.chain));
    std::move(read.atoms.begin(), read.atoms.end(), std::back_inserter(selected.atoms));
  };
  if (selection == Selection::atoms && !list) {
    for (const PolymerPart& part : parts.whole_parts())
      if (PartRead read = read_part(parts, part, choice, group_choices); !read.atoms.empty())
        take(std::move(read));
    if (selected.atoms.empty()) throw nothing_selected(file, model, selection, list);
    selected.chain_like = is_chain_like(selection, selected.atoms);
    return selected;
  }
  for (const PolymerPart* part : parts_asked_for(file, parts, selection, list)) {
    PartRead read = read_part(parts, *part, choice, group_choices);
    if (read.atoms.empty())
      throw selection == Selection::atoms ? nothing_selected(file, model, selection, part->label)
                                          : no_beads(file, parts, *part, selection);
    // A list of chains leaves out the others on purpose.
    if (!list)
      if (auto unread = describe_unread(parts, *part, read, choice))
        selected.notes.push_back(std::move(*unread));
    add_notes(parts, *part, read, selection, selected.notes);
    take(std::move(read));
  }
  selected.chain_like = is_chain_like(selection, selected.atoms);
  return selected;
}

std::vector<double> element_radii_of(const std::string& file, const std::vector<SelectedAtom>& atoms,
                                     std::string& lack) {
  std::vector<double> radii;
  for (const SelectedAtom& selected : atoms) {
    const auto radius = van_der_waals_radius(selected.element);
    if (!radius) {
      lack = fmt::format("{} does not tell the element of {}", file, selected.name);
      return {};
    }
    radii.push_back(*radius);
  }
  return radii;
}

}  // namespace kds
