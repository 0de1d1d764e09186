#include "motions/readers/gro_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/element_guess.h"
#include "motions/readers/nanometres.h"
#include "motions/readers/residue_grouping.h"
#include "motions/readers/residue_kind.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

// The columns of an atom's line. Numbers begin after column 20. The width of a number is the distance between
// the first two decimal points. If the first number does not end where this width says, the names before it
// are not in their columns.
class GroColumns {
 public:
  static constexpr std::size_t names_end = 20;

  // Returns nothing if no three numbers with decimal points follow the names of the line.
  static std::optional<GroColumns> of(std::string_view line) {
    const std::size_t first = line.find('.', names_end);
    if (first == std::string_view::npos) return std::nullopt;
    const std::size_t second = line.find('.', first + 1);
    if (second == std::string_view::npos) return std::nullopt;
    GroColumns columns;
    columns.point_ = first - names_end;
    columns.width_ = second - first;
    if (columns.point_ >= columns.width_ || !columns.position_in(line)) return std::nullopt;
    std::size_t decimals = columns.width_;  // numbers may touch, but not all three do
    for (std::size_t point = first, axis = 0; axis < 3; ++axis, point += columns.width_)
      decimals = std::min(decimals,
                          std::min(line.find_first_not_of("0123456789", point + 1), line.size()) - point - 1);
    if (columns.point_ + 1 + decimals != columns.width_) return std::nullopt;
    return columns;
  }

  // Whether the decimal points are where they should be. A number that is too wide moves the numbers after
  // it.
  bool fit(std::string_view line) const {
    if (line.size() < names_end + 3 * width_) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (line[names_end + axis * width_ + point_] != '.') return false;
    return true;
  }

  // Returns the position in nanometres, or nothing if the line does not hold three numbers in these columns.
  std::optional<Eigen::Vector3d> position_in(std::string_view line) const {
    if (!fit(line)) return std::nullopt;
    Eigen::Vector3d position;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto number = parse_double(trimmed(line.substr(names_end + axis * width_, width_)));
      if (!number || !(std::abs(*number) < 1e30)) return std::nullopt;
      position[static_cast<Eigen::Index>(axis)] = *number;
    }
    return position;
  }

 private:
  std::size_t width_ = 0, point_ = 0;
};

// Returns the time in a title, as in "protein in water t= 12.00000 step= 6000".
std::optional<double> time_in(std::string_view title) {
  for (std::size_t offset = title.rfind("t="); offset != std::string_view::npos;
       offset = offset == 0 ? std::string_view::npos : title.rfind("t=", offset - 1)) {
    if (offset > 0 && title[offset - 1] != ' ' && title[offset - 1] != ',') continue;
    std::string_view rest = trimmed(title.substr(offset + 2));
    rest = rest.substr(0, rest.find_first_of(" \t,;"));
    const auto time = parse_double(rest);
    if (time && std::isfinite(*time)) return time;
  }
  return std::nullopt;
}

// The numbers of the line after the atoms.
struct GroBox {
  std::vector<double> lengths;  // 3 or 9
  bool same_digits = true;      // after the decimal points, at least one

  static std::optional<GroBox> of(std::string_view line) {
    GroBox box;
    std::optional<std::size_t> digits;
    for (const std::string_view field : split_fields(line)) {
      const auto number = parse_double(field);
      if (!number || !(std::abs(*number) < 1e30)) return std::nullopt;
      box.lengths.push_back(*number);
      const std::size_t point = std::min(field.find('.'), field.size());
      if (field.size() - point < 2 || field.size() - point != digits.value_or(field.size() - point))
        box.same_digits = false;
      digits = field.size() - point;
    }
    if (box.lengths.size() != 3 && box.lengths.size() != 9) return std::nullopt;
    return box;
  }

  // The numbers are xx, yy, zz, then xy, xz, yx, yz, zx, zy, where xy is the y coordinate of the first
  // vector.
  CellRead cell() const {
    constexpr std::array<std::pair<int, int>, 9> indices{
        {{0, 0}, {1, 1}, {2, 2}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}}};
    Eigen::Matrix3d vectors = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < lengths.size(); ++i)
      vectors(indices[i].first, indices[i].second) = angstrom_of_nanometres(lengths[i]);
    return read_cell(vectors);
  }
};

// Returns whether numbers of a box have no blank between them.
bool numbers_touch(std::string_view line) {
  const auto fields = split_fields(line);
  return std::any_of(fields.begin(), fields.end(), [](std::string_view field) {
    return std::count(field.begin(), field.end(), '.') > 1 || field.find('-', 1) != std::string_view::npos;
  });
}

enum class MoleculeKind { protein, nucleic, water, other };

MoleculeKind molecule_kind_of(const StructureResidue& residue) {
  const ResidueKind kind = kind_of(residue);
  if (kind == ResidueKind::protein) return MoleculeKind::protein;
  if (kind == ResidueKind::nucleic) return MoleculeKind::nucleic;
  return is_water(residue.name) ? MoleculeKind::water : MoleculeKind::other;
}

bool has_one_of(const StructureResidue& residue, std::initializer_list<std::string_view> atoms) {
  return std::any_of(atoms.begin(), atoms.end(),
                     [&](std::string_view atom) { return first_named(residue, atom) != nullptr; });
}

bool begins_chain(const StructureResidue& residue, MoleculeKind kind) {
  if (kind == MoleculeKind::protein) return has_one_of(residue, {"H2", "H3", "HN2", "HN3", "HT2", "2HT"});
  if (kind == MoleculeKind::nucleic) return has_one_of(residue, {"HO5'", "H5T"});
  return residue.name == "ACE" || residue.name == "FOR";
}

bool ends_chain(const StructureResidue& residue, MoleculeKind kind) {
  if (kind == MoleculeKind::protein) return has_one_of(residue, {"OXT", "OC2", "OT2", "O2"});
  if (kind == MoleculeKind::nucleic) return has_one_of(residue, {"HO3'", "H3T"});
  return is_cap(residue.name) && !begins_chain(residue, kind);
}

// Whether two residues in sequence belong to different molecules.
bool are_apart(const StructureResidue& before, const StructureResidue& residue) {
  const MoleculeKind first = molecule_kind_of(before), second = molecule_kind_of(residue);
  const bool one_is_other = first == MoleculeKind::other || second == MoleculeKind::other;
  if (first != second && !one_is_other) return true;
  if (ends_chain(before, first) || begins_chain(residue, second)) return true;
  const auto number_before = parse_count(before.number), number = parse_count(residue.number);
  if (!number_before || !number) return first != second;
  constexpr std::size_t numbers = 100000;  // a residue number has five digits
  // A residue of unknown kind belongs to a chain if its number continues those of the chain.
  if (one_is_other)
    return before.atoms.size() == 1 || residue.atoms.size() == 1 || *number != (*number_before + 1) % numbers;
  return *number < *number_before && *number_before + 1 != *number + numbers;
}

// Divides the residues into molecules and groups their atoms.
std::vector<StructureResidue> divided(std::vector<StructureResidue> blocks) {
  ResidueGrouping grouping;
  std::size_t molecule = 0;
  for (StructureResidue& block : blocks) guess_elements_by_name(block);
  std::vector<std::string> molecules;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i > 0 && are_apart(blocks[i - 1], blocks[i])) ++molecule;
    molecules.push_back(std::to_string(molecule));
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    std::vector<StructureAtom> atoms = std::exchange(blocks[i].atoms, {});
    blocks[i].molecule = molecules[i];
    const bool continues_protein =
        (i > 0 && molecules[i - 1] == molecules[i] && is_tabulated_monomer(blocks[i - 1].name)) ||
        (i + 1 < blocks.size() && molecules[i + 1] == molecules[i] &&
         is_tabulated_monomer(blocks[i + 1].name));
    if (is_cap(blocks[i].name) && continues_protein) blocks[i].entity = Entity::polymer;
    for (StructureAtom& atom : atoms) grouping.add(blocks[i], std::move(atom));
  }
  return grouping.take();
}

class GroModels final : public StructureModels {
 public:
  explicit GroModels(const std::filesystem::path& path) : lines_(path) {
    std::size_t timed = 0;
    try {
      for (Found found; (found = read(held_.whole, nullptr)) != Found::end;) {
        if (found == Found::cut) {
          held_.ends_inside = true;
          break;
        }
        if (time_) ++timed;
        ++held_.whole;
      }
    } catch (const DamagedFrame& damage) {
      held_.damage = damage;
    } catch (const CutFile&) {
      held_.ends_inside = true;
    }
    held_.end = lines_.offset();
    has_times_ = timed > 0 && timed == held_.whole;
    if (timed > 0 && !has_times_)
      notes_.push_back(
          fmt::format("{} of {} have no time (t=) in their titles: frames have numbers and no times",
                      held_.whole - timed, counted(held_.whole, "frame")));
    if (upright_without_line_end_)
      notes_.emplace_back(
          "the box has no line end after it; its 3 numbers are read as an upright box, though a file that "
          "is cut off may have lost the other 6");
    start_again();
  }

  FramesHeld held() const override { return held_; }
  bool may_have_cell() const override { return true; }
  bool lone_cell_is_crystal() const override { return false; }
  std::vector<std::string> notes() const override { return notes_; }

  StructureModel model(std::size_t k) override {
    if (k >= held_.whole) {
      if (held_.damage) throw DamagedFrame(*held_.damage);
      throw InputError(fmt::format("{}: the file {}", lines_.name(),
                                   held_.ends_inside ? "ends inside frame 0" : "holds no frame"));
    }
    if (k < next_) start_again();
    bool there = true;
    for (; there && next_ < k; ++next_) there = read(next_, nullptr) == Found::frame;
    StructureModel model;
    if (!there || read(k, &model) != Found::frame)
      throw InputError(fmt::format("{}: frame {}: is gone since the file was first read", lines_.name(), k));
    ++next_;
    if (has_times_) model.picoseconds = time_;
    return model;
  }

 private:
  enum class Found { frame, end, cut };

  void start_again() {
    lines_.rewind();
    next_ = 0;
    box_size_ = 0;
  }

  bool next_line(std::string_view& line) {
    line_begin_ = lines_.offset();
    return lines_.next(line);
  }

  DamagedFrame damage(std::size_t k, std::string_view expected, std::string_view line) const {
    return {lines_.name(), k, line_begin_,
            fmt::format("line {}: expected {}, found {}", lines_.number(), expected, in_quotes(line))};
  }

  // Reads the title and the number of atoms. Blank lines may follow the last frame.
  Found read_head(std::size_t k, std::size_t& atoms) {
    std::string_view line;
    std::size_t blank = 0;
    do {
      if (!next_line(line)) return Found::end;
    } while (trimmed(line).empty() && ++blank > 0);
    std::optional<std::size_t> count = blank > 0 ? parse_count(trimmed(line)) : std::nullopt;
    time_ = count ? std::nullopt : time_in(line);
    if (!count) {
      if (!next_line(line)) return Found::cut;
      count = parse_count(trimmed(line));
    }
    if (lines_.cut()) return Found::cut;
    if (!count)
      throw damage(k, k == 0 ? "the number of atoms in the second line of a GRO file" : "the number of atoms",
                   line);
    atoms = *count;
    return Found::frame;
  }

  // Reads frame k. Without a model, the numbers of the atoms are not parsed.
  Found read(std::size_t k, StructureModel* model) {
    std::size_t atoms = 0;
    if (const Found found = read_head(k, atoms); found != Found::frame) return found;
    std::string_view line;
    std::optional<GroColumns> columns;
    std::vector<StructureResidue> blocks;
    for (std::size_t i = 0; i < atoms; ++i) {
      if (!next_line(line) || lines_.cut()) return Found::cut;
      if (!columns) columns = GroColumns::of(line);
      if (!columns || !columns->fit(line))
        throw damage(k,
                     fmt::format("atom {} of {} with {}", i + 1, atoms,
                                 columns ? "its numbers in the columns of atom 1"
                                         : "names in columns 1 to 20, then three decimal numbers"),
                     line);
      if (model != nullptr) add_atom(k, i, line, *columns, blocks);
    }
    if (!next_line(line)) return Found::cut;
    const std::optional<GroBox> box = GroBox::of(line);
    if (lines_.cut() && !(box && box->same_digits && (box_size_ == 0 || box->lengths.size() == box_size_))) {
      held_.lacks_line_end = box.has_value();
      return Found::cut;
    }
    if (!box)
      throw damage(k,
                   fmt::format("a box of 3 or 9 numbers after {}{}", counted(atoms, "atom"),
                               numbers_touch(line) ? ", not numbers that touch" : ""),
                   line);
    upright_without_line_end_ = lines_.cut() && box_size_ == 0 && box->lengths.size() == 3;
    box_size_ = box->lengths.size();
    if (model == nullptr) return Found::frame;
    model->cell = box->cell();
    model->atom_count = atoms;
    model->residues = divided(std::move(blocks));
    return Found::frame;
  }

  void add_atom(std::size_t k, std::size_t index, std::string_view line, const GroColumns& columns,
                std::vector<StructureResidue>& blocks) const {
    const std::optional<Eigen::Vector3d> position = columns.position_in(line);
    if (!position) throw damage(k, fmt::format("three coordinates of atom {}", index + 1), line);
    std::string_view number = trimmed(line.substr(0, 5));
    const std::string_view name = trimmed(line.substr(5, 5));
    if (number.empty()) number = "?";
    if (blocks.empty() || blocks.back().number != number || blocks.back().name != name) {
      blocks.emplace_back().number = number;
      blocks.back().name = name;
    }
    StructureAtom& atom = blocks.back().atoms.emplace_back();
    atom.name = trimmed(line.substr(10, 5));
    atom.index = index;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      atom.position[axis] = angstrom_of_nanometres((*position)[axis]);
  }

  LineReader lines_;
  FramesHeld held_;
  std::vector<std::string> notes_;
  std::size_t next_ = 0;
  std::uint64_t line_begin_ = 0;           // where the line read last begins, in bytes
  std::size_t box_size_ = 0;               // numbers in the box of the frame read last
  bool upright_without_line_end_ = false;  // the only frame ends after 3 numbers of its box
  std::optional<double> time_;             // the time of the frame read last
  bool has_times_ = false;
};

}  // namespace

bool looks_like_gro(std::string_view start) {
  static_cast<void>(next_line(start));
  if (!parse_count(trimmed(next_line(start)))) return false;
  const std::string_view atom = next_line(start);
  return !start.empty() && GroColumns::of(atom).has_value();
}

std::unique_ptr<StructureModels> open_gro(const std::filesystem::path& path) {
  return std::make_unique<GroModels>(path);
}

}  // namespace kds
