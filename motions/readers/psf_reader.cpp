#include "motions/readers/psf_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/bonded_residues.h"
#include "motions/readers/element_guess.h"
#include "motions/readers/residue_grouping.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

struct PsfAtom {
  std::string_view segment, number, residue, name;
  double mass = 0;
};

// Returns the mass at the end of an atom's line: type, charge, mass, a whole number, and further numbers in
// pairs (fluctuating charges, polarizabilities). Returns nothing if a column is missing or one too many.
std::optional<double> mass_in(std::span<const std::string_view> rest) {
  const auto is_number = [](std::string_view field) { return parse_double(field).has_value(); };
  if (rest.size() < 4 || rest.size() % 2 != 0 || !std::all_of(rest.begin() + 1, rest.end(), is_number))
    return std::nullopt;
  const std::string_view whole = rest[3];
  if (!parse_count(whole.substr(whole.starts_with('-') ? 1 : 0))) return std::nullopt;
  return parse_double(rest[2]);
}

// The form of the atoms' lines: serial number, segment, residue number, residue, atom, then as in mass_in.
// NAMD separates them by blanks alone. The other forms have columns of this width, with a blank after each.
struct PsfForm {
  bool has_columns = true;
  std::size_t serial = 8, name = 4;

  explicit PsfForm(std::string_view first_line) {
    for (const std::string_view word : split_fields(first_line)) {
      if (word == "NAMD") has_columns = false;
      if (word == "EXT") {
        serial = 10;
        name = 8;
      }
    }
  }

  // Returns the numbers of a line of bonds. In files of columns, numbers may touch.
  std::vector<std::string_view> numbers_in(std::string_view line) const {
    std::vector<std::string_view> fields = split_fields(line);
    const bool touch = std::any_of(fields.begin(), fields.end(),
                                   [&](std::string_view field) { return field.size() > serial; });
    if (!has_columns || !touch) return fields;
    fields.clear();
    for (std::size_t index = 0; index < line.size(); index += serial)
      fields.push_back(trimmed(line.substr(index, serial)));
    return fields;
  }

  // Returns nothing if the line is not in this form.
  std::optional<PsfAtom> parse(std::string_view line) const {
    // Columns go first, because they show a segment without a name. VMD writes names that are too wide for
    // their columns, and then separates them by blanks.
    if (has_columns)
      if (const auto atom = parse_columns(line)) return atom;
    const std::vector<std::string_view> fields = split_fields(line);
    if (fields.size() < 9 || !parse_count(fields[0])) return std::nullopt;
    const auto mass = mass_in(std::span(fields).subspan(5));
    if (!mass) return std::nullopt;
    return PsfAtom{fields[1], fields[2], fields[3], fields[4], *mass};
  }

 private:
  std::optional<PsfAtom> parse_columns(std::string_view line) const {
    if (line.size() < serial || !parse_count(trimmed(line.substr(0, serial)))) return std::nullopt;
    std::array<std::string_view, 4> names;
    std::size_t index = serial;
    for (std::string_view& text : names) {
      if (line.size() < index + 1 + name || line[index] != ' ') return std::nullopt;
      text = trimmed(line.substr(index + 1, name));
      if (text.find(' ') != std::string_view::npos) return std::nullopt;
      index += 1 + name;
    }
    if (line.size() <= index || line[index] != ' ') return std::nullopt;
    // The type, which has four or six columns, then charge and mass.
    const auto mass = mass_in(split_fields(line.substr(index)));
    if (!mass || names[3].empty()) return std::nullopt;
    return PsfAtom{names[0], names[1], names[2], names[3], *mass};
  }
};

class PsfFile {
 public:
  explicit PsfFile(const std::filesystem::path& path) : lines_(path) {}

  StructureModel read() {
    std::string_view line;
    if (!lines_.next(line) || !looks_like_psf(line))
      throw refuse("PSF in the first line of a PSF file", line);
    const PsfForm form(line);
    read_atoms(form, read_count("!NATOM", 1));
    StructureModel model;
    const std::optional<BondedResidues> bonded = read_bonds(form, model.notes);
    model.lists_bonds = bonded.has_value();
    ResidueGrouping grouping;
    std::size_t molecule = 0;
    for (std::size_t i = 0; i < atoms_.size(); ++i) {
      const std::size_t residue = residue_of_[i];
      const bool begins = i == 0 || residue != residue_of_[i - 1];
      if (bonded && begins && !bonded->follows(residue)) ++molecule;
      StructureResidue& of_atom = residues_[residue];
      of_atom.molecule = std::to_string(molecule);
      grouping.add(of_atom, std::move(atoms_[i]));
    }
    model.atom_count = atoms_.size();
    model.residues = grouping.take();
    if (bonded) mark_polymers(model.residues);
    if (const auto note = set_elements_by_mass(model.residues, masses_)) model.notes.push_back(*note);
    return model;
  }

 private:
  InputError refuse(std::string_view expected, std::string_view found, std::string_view count = "") const {
    return InputError(fmt::format("{}:{}: expected {}, found {}{}", lines_.name(), lines_.number(), expected,
                                  count, in_quotes(found)));
  }
  InputError refuse_cut_line() const {
    return InputError(fmt::format(
        "{}:{}: the file ends inside this line: its last number may be cut off, expected a line end "
        "after it",
        lines_.name(), lines_.number()));
  }

  // Continues after the line of a section, as !NATOM, and returns its number. Returns nothing if the file
  // has no such line.
  std::optional<std::size_t> find_count(std::string_view section, std::size_t least) {
    for (std::string_view line; lines_.next(line);) {
      const std::size_t key = line.find(section);
      if (key == std::string_view::npos) continue;
      const auto count = parse_count(trimmed(line.substr(0, key)));
      if (!count || *count < least)
        throw refuse(fmt::format("the number of {} before {}", least == 0 ? "bonds" : "atoms", section),
                     line);
      return count;
    }
    return std::nullopt;
  }
  std::size_t read_count(std::string_view section, std::size_t least) {
    if (const auto count = find_count(section, least)) return *count;
    throw InputError(
        fmt::format("{}: no line with {}, expected the number of atoms there", lines_.name(), section));
  }

  void read_atoms(const PsfForm& form, std::size_t atoms) {
    std::string_view line;
    std::set<std::string, std::less<>> names;  // names of the atoms of the last residue
    for (std::size_t i = 0; i < atoms; ++i) {
      if (!lines_.next(line))
        throw InputError(fmt::format("{}: the file ends after atom {} of {}", lines_.name(), i, atoms));
      if (lines_.cut()) throw refuse_cut_line();
      const std::optional<PsfAtom> read = form.parse(line);
      if (!read)
        throw refuse(
            fmt::format("atom {} of {} in 9, 11 or 13 columns (serial number, segment, residue number, "
                        "residue, atom, type, charge, mass, 0)",
                        i + 1, atoms),
            line, counted(split_fields(line).size(), "column") + ": ");
      const std::string_view number = read->number.empty() ? "?" : read->number;
      const bool continues = !residues_.empty() && residues_.back().chain == read->segment &&
                             residues_.back().number == number && residues_.back().name == read->residue &&
                             names.count(read->name) == 0;
      if (!continues) {
        StructureResidue& residue = residues_.emplace_back();
        residue.chain = read->segment;
        residue.number = number;
        residue.name = read->residue;
        names.clear();
      }
      names.emplace(read->name);
      residue_of_.push_back(residues_.size() - 1);
      StructureAtom& atom = atoms_.emplace_back();
      atom.name = read->name;
      atom.index = i;
      masses_.push_back(read->mass);
    }
  }

  // Returns nothing if the file lists no bonds.
  std::optional<BondedResidues> read_bonds(const PsfForm& form, std::vector<std::string>& notes) {
    const std::optional<std::size_t> bonds = find_count("!NBOND", 0);
    if (!bonds) {
      notes.emplace_back("no section !NBOND: molecules are not distinguished; the file may be cut off");
      return std::nullopt;
    }
    if (*bonds == 0) return std::nullopt;
    BondedResidues bonded(residue_of_);
    std::size_t one = 0;  // the first atom of a bond whose second one follows, 0 if none
    std::size_t read = 0;
    for (std::string_view line; read < *bonds;) {
      if (!lines_.next(line) || trimmed(line).empty() || line.find('!') != std::string_view::npos)
        throw InputError(fmt::format("{}:{}: the section !NBOND ends after bond {} of {}", lines_.name(),
                                     lines_.number(), read, *bonds));
      for (const std::string_view field : form.numbers_in(line)) {
        const auto atom = parse_count(field);
        if (!atom || *atom == 0 || *atom > atoms_.size() || read == *bonds)
          throw refuse(read == *bonds ? fmt::format("{} bonds", *bonds)
                                      : fmt::format("numbers of atoms from 1 to {} in bond {} of {}",
                                                    atoms_.size(), read + 1, *bonds),
                       field);
        if (one > 0) {
          bonded.add(one - 1, *atom - 1);
          ++read;
          one = 0;
        } else {
          one = *atom;
        }
      }
      if (lines_.cut() && (!form.has_columns || line.size() % form.serial != 0)) throw refuse_cut_line();
    }
    return bonded;
  }

  LineReader lines_;
  std::vector<StructureAtom> atoms_;
  std::vector<double> masses_;
  std::vector<std::size_t> residue_of_;     // of each atom: an index in residues_
  std::vector<StructureResidue> residues_;  // in sequence, without atoms
};

}  // namespace

bool looks_like_psf(std::string_view start) {
  const std::string_view line = next_line(start);
  return line.starts_with("PSF") && (line.size() == 3 || line[3] == ' ');
}

std::unique_ptr<StructureModels> open_psf(const std::filesystem::path& path) {
  return std::make_unique<LoneModel>(PsfFile(path).read());
}

}  // namespace kds
