#include "motions/readers/polymer_selection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <gemmi/model.hpp>
#include <gemmi/resinfo.hpp>
#include <set>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/bead_name.h"
#include "motions/readers/vdw_radii.h"

namespace kds {

namespace {

enum class Polymer { none, protein, nucleic, cap };

const gemmi::Atom* first_named(const gemmi::Residue& residue, const char* name) {
  for (const gemmi::Atom& atom : residue.atoms)
    if (atom.name == name) return &atom;
  return nullptr;
}

bool has_backbone(const gemmi::Residue& residue) {
  return first_named(residue, "N") && first_named(residue, "CA") && first_named(residue, "C");
}

// A file says which residues are the polymer's by TER or by mmCIF's entities; without, we judge by the
// residue.
Polymer polymer_of(const gemmi::Residue& residue) {
  const bool said_to_be = residue.entity_type == gemmi::EntityType::Polymer;
  if (residue.entity_type != gemmi::EntityType::Unknown && !said_to_be) return Polymer::none;
  const gemmi::ResidueInfo info = gemmi::find_tabulated_residue(residue.name);
  if (info.is_water()) return Polymer::none;
  // A standard residue as HETATM is a free one in the buffer, unless the file says otherwise.
  if (!said_to_be && info.found() && info.is_standard() && residue.het_flag == 'H') return Polymer::none;
  if (info.found() && info.is_amino_acid()) return Polymer::protein;
  if (info.found() && info.is_nucleic_acid()) return Polymer::nucleic;
  if (info.found() && !said_to_be) return Polymer::none;
  if (residue.get_ca() || has_backbone(residue)) return Polymer::protein;
  if (residue.get_p()) return Polymer::nucleic;
  return said_to_be ? Polymer::cap : Polymer::none;
}

struct Candidate {
  const gemmi::Residue* residue;
  Polymer polymer;
};

// The polymer residues of all parts of a chain; the first of those that share a position.
std::vector<Candidate> polymer_residues(const gemmi::Model& model, const std::string& chain) {
  std::vector<Candidate> residues;
  for (const gemmi::Chain& part : model.chains) {
    if (part.name != chain) continue;
    const gemmi::Residue* before = nullptr;
    for (const gemmi::Residue& residue : part.residues) {
      const Polymer polymer = polymer_of(residue);
      if (polymer == Polymer::none) continue;
      const bool shares = before && before->seqid == residue.seqid && before->segment == residue.segment;
      if (!shares) residues.push_back({&residue, polymer});
      if (!shares) before = &residue;
    }
  }
  return residues;
}

bool has(const std::vector<Candidate>& residues, Polymer polymer) {
  for (const Candidate& candidate : residues)
    if (candidate.polymer == polymer) return true;
  return false;
}

std::vector<std::string> chain_names(const gemmi::Model& model) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const gemmi::Chain& chain : model.chains)
    if (seen.insert(chain.name).second) names.push_back(chain.name);
  return names;
}

/// Those that a necklace can be of.
std::vector<std::string> polymer_chains(const gemmi::Model& model) {
  std::vector<std::string> names = chain_names(model);
  std::erase_if(names, [&](const std::string& name) {
    const std::vector<Candidate> residues = polymer_residues(model, name);
    return !has(residues, Polymer::protein) && !has(residues, Polymer::nucleic);
  });
  return names;
}

InputError no_polymer_in(const std::string& file) {
  return InputError(fmt::format("{}: no chain of amino acids or nucleotides in this file", file));
}

// The first with amino acids, else the first with nucleotides.
std::string default_chain(const std::string& file, const gemmi::Model& model) {
  const std::vector<std::string> names = chain_names(model);
  for (const Polymer wanted : {Polymer::protein, Polymer::nucleic})
    for (const std::string& name : names)
      if (has(polymer_residues(model, name), wanted)) return name;
  throw no_polymer_in(file);
}

// As in messages.
std::string shown(const std::string& chain) { return chain.empty() ? "' '" : chain; }

std::string listed(const std::vector<std::string>& chains, std::size_t most) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, chains.size()); ++i) names.push_back(shown(chains[i]));
  const std::string text = fmt::format("{}", fmt::join(names, ", "));
  return chains.size() > most ? fmt::format("{} and {} more", text, chains.size() - most) : text;
}

std::vector<const gemmi::Atom*> named_atoms(const gemmi::Residue& residue, Selection selection) {
  const gemmi::Atom* ca = first_named(residue, "CA");
  if (!ca) return {};
  if (selection == Selection::ca) return {ca};
  const gemmi::Atom* n = first_named(residue, "N");
  const gemmi::Atom* c = first_named(residue, "C");
  if (!n || !c) return {};
  return {n, ca, c};
}

// An atom without alternates, or the first of its name.
std::vector<const gemmi::Atom*> all_atoms(const gemmi::Residue& residue) {
  std::vector<const gemmi::Atom*> atoms;
  std::set<std::string> with_alternates;
  for (const gemmi::Atom& atom : residue.atoms)
    if (atom.altloc == '\0' || with_alternates.insert(atom.name).second) atoms.push_back(&atom);
  return atoms;
}

std::vector<const gemmi::Atom*> selected_atoms(const Candidate& candidate, Selection selection) {
  if (selection == Selection::all) return all_atoms(*candidate.residue);
  return named_atoms(*candidate.residue, selection);
}

// Where a file has no column for elements, a name in the wrong column makes calcium of CA and mercury of HG:
// in a chain what is none of its usual elements goes by the first letter of its name.
std::string element_of(const gemmi::Atom& atom) {
  using gemmi::El;
  for (const El usual : {El::C, El::N, El::O, El::S, El::H, El::D, El::P, El::Se})
    if (atom.element == usual) return atom.element.name();
  const std::size_t letter = atom.name.find_first_of("CNOSHDP");
  if (letter == std::string::npos || atom.name.find_first_not_of("0123456789") != letter)
    return atom.element.name();
  return atom.name.substr(letter, 1);
}

std::string describe(const gemmi::Atom& atom, const gemmi::Residue& residue, const std::string& chain) {
  return text_of({atom.name, residue.name, residue.seqid.str(), shown(chain)});
}

std::vector<SelectedAtom> atoms_of_chain(const gemmi::Model& model, Selection selection,
                                         const std::string& chain) {
  std::vector<SelectedAtom> atoms;
  const auto select = [&](Selection which) {
    for (const Candidate& candidate : polymer_residues(model, chain))
      for (const gemmi::Atom* atom : selected_atoms(candidate, which))
        atoms.push_back({atom, element_of(*atom), describe(*atom, *candidate.residue, chain)});
  };
  select(selection);
  if (atoms.empty() && selection == Selection::automatic) select(Selection::ca);  // a coarse-grained model
  return atoms;
}

}  // namespace

std::vector<std::string> chains_asked_for(const std::string& file, const gemmi::Model& model,
                                          const std::optional<std::string>& list) {
  if (!list) return {default_chain(file, model)};
  const std::vector<std::string> held = chain_names(model);
  std::vector<std::string> wanted;
  for (std::string_view rest = *list;;) {
    const std::size_t comma = rest.find(',');
    const std::string name(trimmed(rest.substr(0, comma)));
    if (std::find(held.begin(), held.end(), name) == held.end()) {
      const std::vector<std::string> polymers = polymer_chains(model);
      if (polymers.empty()) throw no_polymer_in(file);
      throw InputError(fmt::format("--chain: {} has no chain {}; expected {}", file, in_quotes(name),
                                   listed(polymers, polymers.size())));
    }
    if (std::find(wanted.begin(), wanted.end(), name) != wanted.end())
      throw InputError(fmt::format("--chain: {} is listed twice for {}", in_quotes(name), file));
    wanted.push_back(name);
    if (comma == std::string_view::npos) return wanted;
    rest.remove_prefix(comma + 1);
  }
}

std::optional<std::string> describe_unread_chains(const std::string& file, const gemmi::Model& model,
                                                  const std::string& read, Selection selection) {
  std::vector<std::string> unread, readable;
  for (const std::string& name : polymer_chains(model)) {
    if (name == read) continue;
    unread.push_back(name);
    if (!atoms_of_chain(model, selection, name).empty()) readable.push_back(name);
  }
  if (unread.empty()) return std::nullopt;
  constexpr std::size_t most = 10;
  std::string line =
      fmt::format("{}: {} {} not read", file, unread.size() == 1 ? "chain" : "chains", listed(unread, most));
  if (!readable.empty())
    line += fmt::format("; --chain {1} or --chain {0},{1} reads {2}", shown(read), shown(readable.front()),
                        readable.size() == 1 ? "it" : "them likewise");
  return line;
}

std::vector<SelectedAtom> select_polymer_atoms(const std::string& file, const gemmi::Model& model,
                                               Selection selection, const std::string& chain) {
  std::vector<SelectedAtom> atoms = atoms_of_chain(model, selection, chain);
  if (atoms.empty()) {
    const char* what = selection == Selection::all  ? "any residue of a polymer"
                       : selection == Selection::ca ? "an atom CA in any residue of a polymer"
                                                    : "N, CA and C in any residue of a polymer";
    throw InputError(fmt::format("--select: chain {} of {} does not hold {}", in_quotes(chain), file, what));
  }
  return atoms;
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
