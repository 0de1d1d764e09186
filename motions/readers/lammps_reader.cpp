#include "motions/readers/lammps_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/lammps_layout.h"
#include "motions/readers/nanometres.h"
#include "motions/readers/vdw_radii.h"

namespace kds {

namespace {

struct DumpHeader {
  std::size_t atoms = 0;
  std::optional<double> time;
  std::optional<DumpBox> box;
  std::string units;    // empty if the frame does not name them
  std::string columns;  // names of the columns
};

class LammpsFrames final : public AtomFrames {
 public:
  LammpsFrames(const std::filesystem::path& path, const ReadOptions& options)
      : lines_(path), units_asked_(options.units) {
    count_frames();
    choose_units(options.units);
    if (options.velocities) to_angstrom_per_picosecond_ = velocity_unit();
    if (held_.whole == 0) return;
    if (!columns_.note.empty()) notes_.push_back(columns_.note);
    if (options.velocities && columns_.velocity && !to_angstrom_per_picosecond_)
      notes_.push_back(
          fmt::format("velocities are left unread, because their unit is not known ({} real, metal or nano)",
                      "--units"_arg));
    read_atoms_of_first_frame();
  }

  std::size_t atom_count() const override { return first_.atoms; }
  FramesHeld held() const override { return held_; }
  bool may_have_cell() const override { return may_have_cell_; }
  std::vector<std::string> notes() const override { return notes_; }

  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    const DumpHeader header = go_to(k);
    frame.stamp.number = k;
    frame.stamp.picoseconds = picoseconds(header.time);
    CellRead cell;
    if (header.box)
      cell =
          read_cell(header.box->vectors * (units_ == LammpsUnits::nano ? 10.0 : 1.0), header.box->periodic);
    frame.cell = cell.cell;
    frame.cell_doubt = std::move(cell.doubt);
    if (!frame.asked && !frame.cell) return;
    place_atoms(atoms);
    frame.positions.resize(3, static_cast<Eigen::Index>(atoms.size()));
    if (to_angstrom_per_picosecond_ && frame.asked) frame.velocities.resizeLike(frame.positions);
    seen_.assign(first_.atoms, false);
    for (std::size_t row = 0; row < first_.atoms; ++row) {
      require_row(k);
      const std::size_t atom = columns_.id ? atom_of_row(k) : row;
      if (column_of_[atom] == unwanted) continue;
      const auto column = static_cast<Eigen::Index>(column_of_[atom]);
      frame.positions.col(column) = position_of_row(k, header.box);
      if (frame.velocities.cols() > 0)
        frame.velocities.col(column) = three_of_row(k, *columns_.velocity) * *to_angstrom_per_picosecond_;
    }
  }

  std::vector<std::size_t> ids() const override { return columns_.id ? ids_ : std::vector<std::size_t>(); }

  std::vector<double> element_radii(std::vector<std::string>& warnings) const override {
    if (elements_.empty()) return {};
    std::vector<double> radii;
    for (const std::string& element : elements_)
      radii.push_back(van_der_waals_radius(element).value_or(std::numeric_limits<double>::quiet_NaN()));
    if (elements_.size() > 1 &&
        std::all_of(elements_.begin(), elements_.end(), [](const auto& e) { return e == "C"; }))
      warnings.push_back(
          fmt::format("{}: all elements are C, which LAMMPS writes unless dump_modify element names them",
                      lines_.name()));
    return radii;
  }

 private:
  struct FrameBegin {
    std::uint64_t byte = 0;
    std::size_t line = 1;
  };

  // Reads the next line. Returns false at the end of the file, or if the file ends inside the line.
  bool read_line() {
    line_begin_ = lines_.offset();
    return lines_.next(line_) && !lines_.cut();
  }

  [[noreturn]] void fail(std::size_t k, const std::string& what) const {
    throw DamagedFrame(lines_.name(), k, line_begin_, fmt::format("{} (line {})", what, lines_.number()));
  }

  // Finds the frames and their numbers of atoms. Atoms are read with their frames.
  void count_frames() {
    try {
      for (bool more = true; more;) more = count_frame();
    } catch (const DamagedFrame& damage) {
      held_.damage = damage;
    } catch (const CutFile&) {
      held_.ends_inside = true;
    }
    if (held_.ends_inside) held_.end = lines_.offset();
  }

  bool count_frame() {
    const std::size_t k = held_.whole;
    const FrameBegin begin{lines_.offset(), lines_.number() + 1};
    DumpHeader header;
    if (!read_header(k, header)) return false;
    if (k == 0) {
      const auto columns = read_dump_columns(header.columns);
      if (!columns)
        fail(k, fmt::format("expected columns x y z, xs ys zs, xu yu zu or xsu ysu zsu, found {}",
                            in_quotes(header.columns)));
      columns_ = *columns;
      first_ = header;
    }
    check_header(k, header);
    for (std::size_t row = 0; row < header.atoms; ++row) {
      if (!read_line()) {
        held_.ends_inside = true;
        return false;
      }
      if (line_.starts_with("ITEM:"))
        fail(k, fmt::format("expected {}, found {}", counted(header.atoms, "atom"), row));
    }
    may_have_cell_ =
        may_have_cell_ || (header.box && header.box->periodic != std::array{false, false, false});
    frames_.push_back(begin);
    ++held_.whole;
    return true;
  }

  void check_header(std::size_t k, const DumpHeader& header) const {
    if (header.atoms == 0) fail(k, "expected at least 1 atom, found 0");
    if (header.atoms != first_.atoms)
      fail(k,
           fmt::format("expected {} as in frame 0, found {}", counted(first_.atoms, "atom"), header.atoms));
    if (header.columns != first_.columns)
      fail(k, fmt::format("expected the columns {} as in frame 0, found {}", in_quotes(first_.columns),
                          in_quotes(header.columns)));
    if (!header.box && (columns_.scaled || columns_.image))
      fail(k, "expected ITEM: BOX BOUNDS before ITEM: ATOMS, as its coordinates depend on the box");
  }

  // Reads a frame up to ITEM: ATOMS. Returns false at the end of the file; if the file ends inside the
  // header, then held_ says so.
  bool read_header(std::size_t k, DumpHeader& header) {
    do {
      if (!read_line()) {
        held_.ends_inside = held_.ends_inside || (lines_.cut() && line_begin_ < lines_.offset());
        return false;
      }
    } while (trimmed(line_).empty());
    bool has_atoms = false;
    for (bool more = true; more; more = read_line()) {
      constexpr std::string_view item = "ITEM: ";
      if (!line_.starts_with(item)) fail(k, fmt::format("expected a line ITEM:, found {}", in_quotes(line_)));
      const std::string name(trimmed(line_.substr(item.size())));  // the next line overwrites this one
      if (name.starts_with("ATOMS")) {
        if (!has_atoms) fail(k, "expected ITEM: NUMBER OF ATOMS before ITEM: ATOMS");
        header.columns = trimmed(std::string_view(name).substr(5));
        return true;
      }
      const bool is_whole =
          name.starts_with("BOX BOUNDS") ? read_box(k, name.substr(10), header) : read_item(k, name, header);
      if (!is_whole) break;
      has_atoms = has_atoms || name.starts_with("NUMBER OF ATOMS");
    }
    held_.ends_inside = true;
    return false;
  }

  // Reads the value of an item of one line. Returns false if the file ends inside the item.
  bool read_item(std::size_t k, const std::string& name, DumpHeader& header) {
    const bool is_count = name == "TIMESTEP" || name == "NUMBER OF ATOMS";
    if (!is_count && name != "TIME" && name != "UNITS")
      fail(k,
           fmt::format("expected ITEM: TIMESTEP, TIME, UNITS, NUMBER OF ATOMS, BOX BOUNDS or ATOMS, found {}",
                       in_quotes(name)));
    if (!read_line()) return false;
    const std::string_view value = trimmed(line_);
    const auto count = parse_count(value);
    const auto number = parse_double(value);
    if (is_count ? !count : name == "TIME" && (!number || !std::isfinite(*number)))
      fail(k, fmt::format("expected a {} of ITEM: {}, found {}", is_count ? "whole number" : "number", name,
                          in_quotes(value)));
    if (name == "NUMBER OF ATOMS") header.atoms = *count;
    if (name == "TIME") header.time = *number;
    if (name == "UNITS") header.units = value;
    if (name == "UNITS" && k > 0) check_units(k, header.units);
    return true;
  }

  // All frames have the units of frame 0, or those of --units if frame 0 names none.
  void check_units(std::size_t k, std::string_view units) const {
    if (first_.units.empty() && !units_asked_)
      fail(k,
           fmt::format("expected no units, as frame 0 names none, found {} ({} {} names those of all frames)",
                       in_quotes(units), "--units"_arg, fmt::join(lammps_units_names, "|")));
    const std::string_view expected = first_.units.empty() ? name_of(*units_asked_) : first_.units;
    if (units != expected)
      fail(k, fmt::format("expected units {} as {}, found {}", expected,
                          first_.units.empty() ? "--units"_arg + " says" : "in frame 0", units));
  }

  // Reads a box: xlo xhi; with tilt xlo_bound xhi_bound xy; or, in a general box, a vector and a coordinate
  // of the origin. Two letters for each axis follow the names: p (periodic), f, s or m. Without letters, as
  // old versions write it, the box is periodic.
  bool read_box(std::size_t k, const std::string& names, DumpHeader& header) {
    const std::vector<std::string_view> words = split_fields(names);
    const auto begins = [&](const std::vector<std::string_view>& start) {
      return words.size() >= start.size() && std::equal(start.begin(), start.end(), words.begin());
    };
    const std::size_t columns = begins({"xy", "xz", "yz"}) ? 3 : begins({"abc", "origin"}) ? 4 : 2;
    const std::size_t flags = columns == 3 ? 3 : columns == 4 ? 2 : 0;
    if (words.size() != flags && words.size() != flags + 3)
      fail(k, fmt::format("expected pp, ff or the like for each axis of BOX BOUNDS, found {}",
                          in_quotes(names)));
    std::array<std::array<double, 4>, 3> bounds{};
    for (auto& bound : bounds) {
      if (!read_line()) return false;
      const std::vector<std::string_view> fields = split_fields(line_);
      bool is_good = fields.size() == columns;
      for (std::size_t i = 0; is_good && i < columns; ++i) {
        const auto number = parse_double(fields[i]);
        is_good = number && std::isfinite(*number);
        if (is_good) bound[i] = *number;
      }
      if (!is_good)
        fail(k, fmt::format("expected {} numbers of BOX BOUNDS, found {}", columns, in_quotes(line_)));
    }
    header.box = read_dump_box(bounds, columns);
    for (std::size_t axis = 0; axis < 3; ++axis)
      header.box->periodic[axis] = words.size() == flags || words[flags + axis] == "pp";
    return true;
  }

  void choose_units(const std::optional<LammpsUnits>& asked) {
    const auto known = std::find(lammps_units_names.begin(), lammps_units_names.end(), first_.units);
    std::optional<LammpsUnits> units = asked;
    if (known != lammps_units_names.end()) {
      const auto own = static_cast<LammpsUnits>(known - lammps_units_names.begin());
      if (asked && *asked != own)
        notes_.push_back(fmt::format("units are {} ({}), though the file says {}", name_of(*asked),
                                     "--units"_arg, first_.units));
      if (!asked) units = own;
    } else if (!first_.units.empty() && !asked) {
      throw InputError(fmt::format(
          "{}: units {} are not read, expected {}; {} lj reads the numbers as they are", lines_.name(),
          in_quotes(first_.units), fmt::join(lammps_units_names, ", "), "--units"_arg));
    }
    if (!units) {
      notes_.push_back(fmt::format("the file names no units; lengths are taken as angstrom{} ({} {})",
                                   first_.time ? ", and times are left unread" : "", "--units"_arg,
                                   fmt::join(lammps_units_names, "|")));
      return;
    }
    units_ = units;
  }

  std::optional<double> picoseconds(const std::optional<double>& time) const {
    if (!time || !units_ || *units_ == LammpsUnits::lj) return std::nullopt;
    return *units_ == LammpsUnits::real ? *time / 1e3 : *units_ == LammpsUnits::nano ? *time * 1e3 : *time;
  }

  // Returns nothing if there are no velocities, or if their unit is not known.
  std::optional<double> velocity_unit() const {
    if (!columns_.velocity || !units_ || *units_ == LammpsUnits::lj) return std::nullopt;
    return *units_ == LammpsUnits::real ? 1e3 : *units_ == LammpsUnits::nano ? 1e-2 : 1;
  }

  DumpHeader go_to(std::size_t k) {
    lines_.seek(frames_[k].byte, frames_[k].line);
    DumpHeader header;
    if (!read_header(k, header)) fail(k, "the frame is gone since the file was first read");
    check_header(k, header);
    return header;
  }

  // Reads the line of an atom and splits it.
  void require_row(std::size_t k) {
    if (!read_line()) fail(k, "the frame is gone since the file was first read");
    fields_.clear();
    const char* const end = line_.data() + line_.size();
    for (const char* at = line_.data();;) {
      while (at != end && (*at == ' ' || *at == '\t')) ++at;
      if (at == end) break;
      const char* const begin = at;
      while (at != end && *at != ' ' && *at != '\t') ++at;
      fields_.emplace_back(begin, static_cast<std::size_t>(at - begin));
    }
    if (fields_.size() != columns_.count)
      fail(k, fmt::format("expected {}, found {}", counted(columns_.count, "column"), fields_.size()));
  }

  std::size_t id_of_row(std::size_t k) const {
    const auto id = parse_count(fields_[*columns_.id]);
    if (!id) fail(k, fmt::format("expected the id of an atom, found {}", in_quotes(fields_[*columns_.id])));
    return *id;
  }

  void read_atoms_of_first_frame() {
    static_cast<void>(go_to(0));
    if (!columns_.id) notes_.push_back("atoms have no ids and are assumed to keep their order in the file");
    std::vector<std::pair<std::size_t, std::string>> atoms;
    for (std::size_t row = 0; row < first_.atoms; ++row) {
      require_row(0);
      atoms.emplace_back(columns_.id ? id_of_row(0) : row,
                         columns_.element ? fields_[*columns_.element] : "");
    }
    std::stable_sort(atoms.begin(), atoms.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [id, element] : atoms) {
      ids_.push_back(id);
      if (columns_.element) elements_.push_back(std::move(element));
    }
  }

  // Returns the index among all atoms of the atom in this row. Each index comes once in a frame.
  std::size_t atom_of_row(std::size_t k) {
    const std::size_t id = id_of_row(k);
    std::size_t atom = id - ids_.front();  // if there are no gaps between ids
    if (atom >= ids_.size() || ids_[atom] != id)
      atom = static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
    if (atom >= ids_.size() || ids_[atom] != id)
      fail(k, fmt::format("expected the ids of frame 0, found {}", id));
    if (seen_[atom]) fail(k, fmt::format("expected each id once, found {} twice", id));
    seen_[atom] = true;
    return atom;
  }

  Eigen::Vector3d three_of_row(std::size_t k, const std::array<std::size_t, 3>& columns) const {
    Eigen::Vector3d numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto number = parse_double(fields_[columns[axis]]);
      if (!number)
        fail(k, fmt::format("expected a coordinate, image flag or velocity, found {}",
                            in_quotes(fields_[columns[axis]])));
      numbers[static_cast<Eigen::Index>(axis)] = *number;
    }
    return numbers;
  }

  Eigen::Vector3d position_of_row(std::size_t k, const std::optional<DumpBox>& box) const {
    Eigen::Vector3d position = three_of_row(k, columns_.position);
    if (columns_.scaled) position = box->origin + box->vectors * position;
    if (columns_.image) position += box->vectors * three_of_row(k, *columns_.image);
    if (units_ == LammpsUnits::nano) position = position.unaryExpr(&angstrom_of_nanometres);
    return position;
  }

  // Finds the column of each atom among those asked for.
  void place_atoms(std::span<const std::size_t> atoms) {
    if (!column_of_.empty() && std::equal(atoms.begin(), atoms.end(), wanted_.begin(), wanted_.end())) return;
    wanted_.assign(atoms.begin(), atoms.end());
    column_of_.assign(first_.atoms, unwanted);
    for (std::size_t i = 0; i < atoms.size(); ++i) column_of_[atoms[i]] = i;
  }

  static constexpr std::size_t unwanted = std::numeric_limits<std::size_t>::max();

  LineReader lines_;
  std::string_view line_;
  std::uint64_t line_begin_ = 0;
  std::vector<std::string_view> fields_;  // the fields of a line
  FramesHeld held_;
  std::vector<FrameBegin> frames_;
  DumpHeader first_;  // header of frame 0
  DumpColumns columns_;
  bool may_have_cell_ = false;
  std::optional<LammpsUnits> units_, units_asked_;
  std::optional<double> to_angstrom_per_picosecond_;  // if velocities are read
  std::vector<std::size_t> ids_;                      // sorted
  std::vector<std::string> elements_;                 // in the order of the ids
  std::vector<std::size_t> wanted_, column_of_;
  std::vector<bool> seen_;
  std::vector<std::string> notes_;
};

}  // namespace

bool looks_like_lammps(std::string_view start) {
  return start.starts_with("ITEM: TIME") || start.starts_with("ITEM: UNITS");
}

std::unique_ptr<AtomFrames> open_lammps(const std::filesystem::path& path, const ReadOptions& options) {
  return std::make_unique<LammpsFrames>(path, options);
}

}  // namespace kds
