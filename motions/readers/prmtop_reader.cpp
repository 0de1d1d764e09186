#include "motions/readers/prmtop_reader.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
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

// The form of a section's lines, as in (20a4), (10I8) or (5E16.8): so many fields of this width in a line.
struct FieldForm {
  std::size_t fields = 0, width = 0;

  static std::optional<FieldForm> of(std::string_view format) {
    const std::size_t letter = format.find_first_of("aAiIeEfF");
    if (letter == std::string_view::npos || !format.starts_with('(')) return std::nullopt;
    const std::size_t end = format.find_first_of(".)", letter);
    if (end == std::string_view::npos) return std::nullopt;
    const auto fields =
        letter == 1 ? std::optional<std::size_t>(1) : parse_count(format.substr(1, letter - 1));
    const auto width = parse_count(format.substr(letter + 1, end - letter - 1));
    constexpr std::size_t most = 1000;
    if (!fields || !width || *fields == 0 || *width == 0 || *fields > most || *width > most)
      return std::nullopt;
    return FieldForm{*fields, *width};
  }
};

struct Section {
  std::size_t line = 0;  // the line of %FLAG
  std::vector<std::string> fields;
};

constexpr std::array<std::string_view, 8> sections_read{
    "POINTERS",      "ATOM_NAME", "RESIDUE_LABEL",          "RESIDUE_POINTER",
    "ATOMIC_NUMBER", "MASS",      "BONDS_WITHOUT_HYDROGEN", "RESIDUE_CHAINID"};

class Prmtop {
 public:
  explicit Prmtop(const std::filesystem::path& path) : lines_(path) {
    Section* section = nullptr;
    std::optional<FieldForm> form;
    std::string section_name;
    for (std::string_view line; lines_.next(line);) {
      if (line.starts_with("%FLAG")) {
        const std::string name(trimmed(line.substr(5)));
        section_name = name;
        const bool is_read =
            std::find(sections_read.begin(), sections_read.end(), name) != sections_read.end();
        section = is_read ? &sections_[name] : nullptr;
        form.reset();
        if (section != nullptr && section->line != 0) throw refuse(fmt::format("{} once", name), line);
        if (section != nullptr) section->line = lines_.number();
      } else if (line.starts_with("%FORMAT")) {
        form = FieldForm::of(trimmed(line.substr(7)));
        if (section != nullptr && !form) throw refuse("a format as in %FORMAT(20a4)", line);
      } else if (section != nullptr && !line.starts_with("%COMMENT")) {
        if (!form) throw refuse("%FORMAT after %FLAG", line);
        if (lines_.cut() && line.size() % form->width != 0)
          throw InputError(
              fmt::format("{}:{}: the file ends inside section {}: its last value may be cut off, expected a "
                          "line end after it",
                          lines_.name(), lines_.number(), section_name));
        take_fields(line, *form, section->fields);
      }
    }
    ends_inside_line_ = lines_.cut();
    if (sections_.empty())
      throw InputError(
          fmt::format("{}: no section POINTERS, expected a topology of AMBER 7 or later (%VERSION, %FLAG)",
                      lines_.name()));
  }

  bool has(const std::string& name) const { return sections_.count(name) > 0; }
  // Returns whether the last line has no line end.
  bool ends_inside_line() const { return ends_inside_line_; }

  // Returns `count` fields of a section. Throws InputError if the section has another number of them.
  const std::vector<std::string>& texts(const std::string& name, std::size_t count) {
    Section& section = named(name);
    std::vector<std::string>& fields = section.fields;
    while (fields.size() > count && fields.back().empty()) fields.pop_back();
    if (fields.size() != count)
      throw InputError(fmt::format("{}:{}: section {} holds {}, expected {}", lines_.name(), section.line,
                                   name, counted(fields.size(), "value"), count));
    return fields;
  }

  // Like `texts`, and throws InputError if a name is blank: a line that lost one shifts the names after it.
  const std::vector<std::string>& names(const std::string& name, std::size_t count) {
    const std::vector<std::string>& fields = texts(name, count);
    const auto blank = std::find(fields.begin(), fields.end(), "");
    if (blank != fields.end())
      throw InputError(fmt::format("{}:{}: value {} of section {} is blank, expected a name", lines_.name(),
                                   named(name).line, 1 + (blank - fields.begin()), name));
    return fields;
  }

  // Returns a number of a section that `texts` has returned.
  double number(const std::string& name, std::size_t i) const {
    const Section& section = named(name);
    const auto number = i < section.fields.size() ? parse_double(section.fields[i]) : std::nullopt;
    if (!number)
      throw InputError(fmt::format("{}:{}: expected a number as value {} of section {}, found {}",
                                   lines_.name(), section.line, i + 1, name,
                                   in_quotes(i < section.fields.size() ? section.fields[i] : "")));
    return *number;
  }
  // Returns a whole number from `least` to `most`.
  std::size_t count(const std::string& name, std::size_t i, std::size_t least, std::size_t most) const {
    const double read = number(name, i);
    const auto whole = parse_count(sections_.at(name).fields[i]);
    if (!whole || *whole < least || *whole > most)
      throw InputError(
          fmt::format("{}:{}: expected a number from {} to {} as value {} of section {}, found {}",
                      lines_.name(), sections_.at(name).line, least, most, i + 1, name, read));
    return *whole;
  }

  const std::string& file() const { return lines_.name(); }

 private:
  InputError refuse(std::string_view expected, std::string_view found) const {
    return InputError(fmt::format("{}:{}: expected {}, found {}", lines_.name(), lines_.number(), expected,
                                  in_quotes(found)));
  }

  const Section& named(const std::string& name) const {
    const auto found = sections_.find(name);
    if (found == sections_.end())
      throw InputError(fmt::format("{}: no section {}, expected %FLAG {} in a topology of AMBER",
                                   lines_.name(), name, name));
    return found->second;
  }
  Section& named(const std::string& name) { return const_cast<Section&>(std::as_const(*this).named(name)); }

  // Fields need not have blanks between them. Lines may lack the blanks at their end.
  void take_fields(std::string_view line, const FieldForm& form, std::vector<std::string>& fields) const {
    // The previous line was full, even if blanks at its end are missing.
    while (fields.size() % form.fields != 0) fields.emplace_back();
    if (line.size() > form.fields * form.width && !trimmed(line.substr(form.fields * form.width)).empty())
      throw refuse(fmt::format("at most {} of {} characters", counted(form.fields, "value"), form.width),
                   line);
    for (std::size_t i = 0; i < form.fields && i * form.width < line.size(); ++i)
      fields.emplace_back(trimmed(line.substr(i * form.width, form.width)));
  }

  LineReader lines_;
  std::map<std::string, Section> sections_;
  bool ends_inside_line_ = false;
};

BondedResidues read_bonds(Prmtop& prmtop, const std::vector<std::size_t>& residue_of, std::size_t bonds) {
  BondedResidues bonded(residue_of);
  const std::string section = "BONDS_WITHOUT_HYDROGEN";
  static_cast<void>(prmtop.texts(section, 3 * bonds));
  for (std::size_t bond = 0; bond < bonds; ++bond) {
    // Numbers of atoms are multiplied by 3.
    const std::size_t most = 3 * (residue_of.size() - 1);
    bonded.add(prmtop.count(section, 3 * bond, 0, most) / 3,
               prmtop.count(section, 3 * bond + 1, 0, most) / 3);
  }
  return bonded;
}

StructureModel read_prmtop(const std::filesystem::path& path) {
  Prmtop prmtop(path);
  constexpr std::size_t most = 2'000'000'000;
  const std::size_t atoms = prmtop.count("POINTERS", 0, 1, most),
                    residues = prmtop.count("POINTERS", 11, 1, atoms),
                    bonds = prmtop.count("POINTERS", 12, 0, most);
  const std::vector<std::string>& names = prmtop.names("ATOM_NAME", atoms);
  const std::vector<std::string>& labels = prmtop.names("RESIDUE_LABEL", residues);
  static_cast<void>(prmtop.texts("RESIDUE_POINTER", residues));
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < residues; ++i) {
    begins.push_back(prmtop.count("RESIDUE_POINTER", i, i == 0 ? 1 : begins.back() + 2, i == 0 ? 1 : atoms) -
                     1);
  }
  begins.push_back(atoms);
  std::vector<std::size_t> residue_of;
  for (std::size_t i = 0; i < residues; ++i) residue_of.resize(begins[i + 1], i);

  StructureModel model;
  if (prmtop.ends_inside_line())
    model.notes.emplace_back("the last line has no line end; the file may be cut off");
  std::optional<BondedResidues> bonded;
  model.lists_bonds = prmtop.has("BONDS_WITHOUT_HYDROGEN");
  if (model.lists_bonds)
    bonded = read_bonds(prmtop, residue_of, bonds);
  else
    model.notes.emplace_back("no section BONDS_WITHOUT_HYDROGEN: molecules are not distinguished");
  const std::vector<std::string>* chains = nullptr;
  if (prmtop.has("RESIDUE_CHAINID")) chains = &prmtop.texts("RESIDUE_CHAINID", residues);
  ResidueGrouping grouping;
  std::size_t molecule = 0;
  for (std::size_t i = 0; i < residues; ++i) {
    if (bonded && !bonded->follows(i)) ++molecule;
    StructureResidue residue;
    if (chains != nullptr) residue.chain = (*chains)[i];
    residue.number = std::to_string(i + 1);
    residue.name = labels[i];
    residue.molecule = std::to_string(molecule);
    for (std::size_t index = begins[i]; index < begins[i + 1]; ++index) {
      StructureAtom atom;
      atom.name = names[index];
      atom.index = index;
      grouping.add(residue, std::move(atom));
    }
  }
  model.atom_count = atoms;
  model.residues = grouping.take();
  mark_polymers(model.residues);
  bool all_known = prmtop.has("ATOMIC_NUMBER");
  if (all_known) {
    static_cast<void>(prmtop.texts("ATOMIC_NUMBER", atoms));
    for (StructureResidue& residue : model.residues)
      for (StructureAtom& atom : residue.atoms) {
        const double number = prmtop.number("ATOMIC_NUMBER", atom.index);
        atom.element_is_given = number >= 1 && number < 104;
        if (atom.element_is_given) atom.element = gemmi::Element(static_cast<int>(number));
        all_known = all_known && atom.element_is_given;
      }
  }
  if (!all_known) {
    static_cast<void>(prmtop.texts("MASS", atoms));
    std::vector<double> masses;
    for (std::size_t i = 0; i < atoms; ++i) masses.push_back(prmtop.number("MASS", i));
    if (const auto note = set_elements_by_mass(model.residues, masses)) model.notes.push_back(*note);
  }
  return model;
}

}  // namespace

bool looks_like_prmtop(std::string_view start) {
  return start.starts_with("%VERSION") || start.starts_with("%FLAG");
}

std::unique_ptr<StructureModels> open_prmtop(const std::filesystem::path& path) {
  return std::make_unique<LoneModel>(read_prmtop(path));
}

}  // namespace kds
