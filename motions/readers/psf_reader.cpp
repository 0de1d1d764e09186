#include "motions/readers/psf_reader.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/element_guess.h"
#include "motions/readers/residue_grouping.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

struct PsfAtom {
  std::string_view segment, number, residue, name;
  double mass = 0;
};

// The form of the atoms' lines: serial number, segment, residue number, residue, atom, type, charge, mass.
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

  // Returns nothing if the line is not in this form.
  std::optional<PsfAtom> parse(std::string_view line) const {
    // Columns go first, because they show a segment without a name. VMD writes names that are too wide for
    // their columns, and then separates them by blanks.
    if (has_columns)
      if (const auto atom = parse_columns(line)) return atom;
    const std::vector<std::string_view> fields = split_fields(line);
    if (fields.size() < 8 || !parse_count(fields[0]) || !parse_double(fields[6])) return std::nullopt;
    const auto mass = parse_double(fields[7]);
    if (!mass) return std::nullopt;
    return PsfAtom{fields[1], fields[2], fields[3], fields[4], *mass};
  }

 private:
  std::optional<PsfAtom> parse_columns(std::string_view line) const {
    if (line.size() < serial || !parse_count(trimmed(line.substr(0, serial)))) return std::nullopt;
    std::array<std::string_view, 4> names;
    std::size_t place = serial;
    for (std::string_view& text : names) {
      if (line.size() < place + 1 + name || line[place] != ' ') return std::nullopt;
      text = trimmed(line.substr(place + 1, name));
      if (text.find(' ') != std::string_view::npos) return std::nullopt;
      place += 1 + name;
    }
    if (line.size() <= place || line[place] != ' ') return std::nullopt;
    // The type, which has four or six columns, then charge and mass.
    const std::vector<std::string_view> rest = split_fields(line.substr(place));
    if (rest.size() < 3 || !parse_double(rest[1])) return std::nullopt;
    const auto mass = parse_double(rest[2]);
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
    const std::size_t atoms = read_count();
    ResidueGrouping grouping;
    std::vector<double> masses;
    StructureResidue residue;
    for (std::size_t i = 0; i < atoms; ++i) {
      if (!lines_.next(line))
        throw InputError(fmt::format("{}: the file ends after atom {} of {}", lines_.name(), i, atoms));
      const std::optional<PsfAtom> read = form.parse(line);
      if (!read)
        throw refuse(
            fmt::format("atom {} of {} (serial number, segment, residue number, residue, atom, type, "
                        "charge, mass)",
                        i + 1, atoms),
            line);
      residue.chain = read->segment;
      residue.number = read->number.empty() ? "?" : read->number;
      residue.name = read->residue;
      StructureAtom atom;
      atom.name = read->name;
      atom.place = i;
      masses.push_back(read->mass);
      grouping.add(residue, std::move(atom));
    }
    StructureModel model;
    model.atom_count = atoms;
    model.residues = grouping.take();
    if (const auto note = set_elements_by_mass(model.residues, masses)) model.notes.push_back(*note);
    return model;
  }

 private:
  InputError refuse(std::string_view expected, std::string_view found) const {
    return InputError(fmt::format("{}:{}: expected {}, found {}", lines_.name(), lines_.number(), expected,
                                  in_quotes(found)));
  }

  // Continues after the line of !NATOM and returns its number.
  std::size_t read_count() {
    for (std::string_view line; lines_.next(line);) {
      const std::size_t key = line.find("!NATOM");
      if (key == std::string_view::npos) continue;
      const auto count = parse_count(trimmed(line.substr(0, key)));
      if (!count || *count == 0) throw refuse("the number of atoms before !NATOM", line);
      return *count;
    }
    throw InputError(
        fmt::format("{}: no line with !NATOM, expected the number of atoms there", lines_.name()));
  }

  LineReader lines_;
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
