// One model is in memory at a time, so a long file needs memory only for the requested frames.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/pdb_models.h"
#include "motions/readers/residue_grouping.h"
#include "motions/readers/residue_kind.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

// The use of column 21. Column 21 holds the fourth letter of a residue's name (LYSH) in simulation files, or
// the first letter of a chain's name in files of large structures. Along a chain, names of residues change
// but names of chains do not, so consecutive amino acids or nucleotides vote: equal letters are votes for a
// chain name, different letters for a residue name. If no amino acid or nucleotide uses the column, the
// letters belong to residue names that are in no table (TIP3, DPPC).
enum class Column21 { residue_name, guessed_residue_name, chain_name };

Column21 use_of_column_21(const PdbModel& model) {
  const bool used = std::any_of(model.atoms.begin(), model.atoms.end(),
                                [](const PdbAtom& atom) { return atom.column_21 != ' '; });
  if (!used) return Column21::residue_name;
  std::size_t same = 0, different = 0;
  bool on_monomers = false;
  const PdbAtom* before = nullptr;
  std::size_t end = 0;
  for (std::size_t i = 0; i < model.atoms.size(); ++i) {
    for (; end < model.ends.size() && model.ends[end] <= i; ++end) before = nullptr;
    const PdbAtom& atom = model.atoms[i];
    const bool monomer = is_tabulated_monomer(atom.residue);
    on_monomers = on_monomers || (monomer && atom.column_21 != ' ');
    const bool follows = before != nullptr && before->chain == atom.chain && before->number != atom.number;
    if (follows && (monomer || is_tabulated_monomer(before->residue))) {
      if (before->column_21 != atom.column_21)
        ++different;
      else if (atom.column_21 != ' ')
        ++same;
    }
    before = atom.het ? nullptr : &atom;
  }
  if (!on_monomers) return Column21::residue_name;
  return different > same ? Column21::guessed_residue_name : Column21::chain_name;
}

std::string chain_of(const PdbAtom& atom, bool named_by_column_21) {
  std::string name;
  if (named_by_column_21 && atom.column_21 != ' ') name += atom.column_21;
  if (atom.chain != ' ') name += atom.chain;
  return name;
}

// The polymers ended by TER. All residues of a chain up to its first TER belong to the polymer. Ligands,
// waters or further pieces of the polymer follow. A piece belongs to the polymer if it contains amino acids
// or nucleotides. HETATM residues count only if TER ends their piece.
class Terminations {
 public:
  std::string before(const std::string& chain) { return std::to_string(ended_[chain]); }
  void end(const std::string& chain) { ++ended_[chain]; }

  void tell_entities(std::vector<StructureResidue>& residues, const std::vector<std::size_t>& piece_of) {
    std::set<std::pair<std::string, std::size_t>> polymers;
    for (std::size_t r = 0; r < residues.size(); ++r) {
      const StructureResidue& residue = residues[r];
      const bool may_be_one = !residue.het || piece_of[r] < ended_[residue.chain];
      if (may_be_one && (is_tabulated_monomer(residue.name) || has_backbone(residue)))
        polymers.emplace(residue.chain, piece_of[r]);
    }
    for (std::size_t r = 0; r < residues.size(); ++r) {
      StructureResidue& residue = residues[r];
      const std::size_t piece = piece_of[r];
      if (piece > 0 && polymers.count({residue.chain, piece}) == 0)
        residue.entity = Entity::other;
      else if (piece < ended_[residue.chain])
        residue.entity = Entity::polymer;
    }
  }

 private:
  std::map<std::string, std::size_t> ended_;  // number of TER records, by chain
};

StructureModel structure_of(PdbModel&& read) {
  StructureModel model;
  model.cell = read.cell;
  model.atom_count = read.atoms.size();
  const Column21 use = use_of_column_21(read);
  if (use == Column21::guessed_residue_name)
    model.notes.emplace_back(
        "column 21 is read as the fourth letter of residue names, not as part of chain names");
  Terminations terminations;
  ResidueGrouping grouping;
  StructureResidue residue;
  std::size_t end = 0;
  for (std::size_t i = 0; i < read.atoms.size(); ++i) {
    for (; end < read.ends.size() && read.ends[end] <= i; ++end)
      if (i > 0) terminations.end(residue.chain);
    PdbAtom& atom = read.atoms[i];
    residue.chain = chain_of(atom, use == Column21::chain_name);
    residue.name = std::move(atom.residue);
    if (use != Column21::chain_name && atom.column_21 != ' ') residue.name += atom.column_21;
    residue.number = std::move(atom.number);
    residue.het = atom.het;
    residue.molecule = terminations.before(residue.chain) + ' ';
    residue.molecule += atom.segment;
    grouping.add(residue, std::move(atom.atom));
  }
  if (end < read.ends.size()) terminations.end(residue.chain);
  model.residues = grouping.take();
  std::vector<std::size_t> piece_of;
  for (const StructureResidue& grouped : model.residues)
    piece_of.push_back(*parse_count(grouped.molecule.substr(0, grouped.molecule.find(' '))));
  terminations.tell_entities(model.residues, piece_of);
  return model;
}

std::string say(const LinesLeftOut& lines, std::string_view what) {
  return fmt::format("{} {} not read (line {}{})", counted(lines.count, "line"),
                     fmt::format("{} {}", what, lines.count == 1 ? "is" : "are"), lines.first,
                     lines.count == 1 ? "" : " first");
}

class PdbModels : public StructureModels {
 public:
  explicit PdbModels(const std::filesystem::path& path) : file_(path.string()), reader_(path) {
    while (reader_.skip()) {
    }
    held_ = reader_.held();
    if (reader_.near_misses().count > 0)
      notes_.push_back(say(reader_.near_misses(), "that begin like ATOM or HETATM but are no such records"));
    if (reader_.outside().count > 0)
      notes_.push_back(say(reader_.outside(), "with atoms outside MODEL and ENDMDL"));
    if (held_.whole == 0 && held_.ends_inside)
      throw InputError(
          fmt::format("{}: the file ends inside its only model (after {} bytes): its last line may be cut "
                      "off, expected a "
                      "line end after it",
                      file_, held_.end));
    if (reader_.lacks_end() && held_.whole == 1 && !held_.ends_inside)
      notes_.emplace_back("MODEL begins its only model and no ENDMDL ends it; the file may be cut off");
    if (const std::size_t models = held_.whole + (held_.ends_inside ? 1 : 0); models < reader_.announced())
      notes_.push_back(fmt::format("NUMMDL announces {}, the file has {}; it may be cut off",
                                   counted(reader_.announced(), "model"), models));
    if (held_.whole == 0)
      throw InputError(fmt::format("{}: no ATOM or HETATM line{}; is this a PDB file?", file_,
                                   notes_.empty() ? "" : ", " + notes_.front()));
    reader_.rewind();
  }

  FramesHeld held() const override { return held_; }
  bool may_have_cell() const override { return reader_.has_met_cell(); }
  std::vector<std::string> notes() const override { return notes_; }

  StructureModel model(std::size_t k) override {
    if (k < next_) {
      reader_.rewind();
      next_ = 0;
    }
    bool there = true;
    for (; there && next_ < k; ++next_) there = reader_.skip();
    PdbModel read;
    if (!there || !reader_.next(read))
      throw InputError(fmt::format("{}: frame {}: is gone since the file was first read", file_, k));
    ++next_;
    return structure_of(std::move(read));
  }

 private:
  std::string file_;
  PdbModelReader reader_;
  FramesHeld held_;
  std::vector<std::string> notes_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<StructureModels> open_pdb(const std::filesystem::path& path) {
  return std::make_unique<PdbModels>(path);
}

}  // namespace kds
