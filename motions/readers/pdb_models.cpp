#include "motions/readers/pdb_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

bool starts_with(std::string_view line, std::string_view name) {
  for (std::size_t i = 0; i < name.size(); ++i)
    if (i >= line.size() || upper(line[i]) != name[i]) return false;
  return true;
}

// Returns whether the line is a record of this name. Names take six columns and may be in either case.
// Numbers may run into the blanks after a name, as in "ATOM 100000".
bool is_record(std::string_view line, std::string_view name) {
  if (!starts_with(line, name)) return false;
  for (std::size_t i = name.size(); i < 6 && i < line.size(); ++i)
    if (line[i] != ' ' && (line[i] < '0' || line[i] > '9')) return false;
  return true;
}

bool is_atom(std::string_view line) { return is_record(line, "ATOM") || is_record(line, "HETATM"); }

// Returns whether the text begins like a record of this name and may be all that is left of it.
bool is_part_of(std::string_view text, std::string_view name) {
  return !text.empty() && text.size() < name.size() && starts_with(name.substr(0, text.size()), text);
}

bool looks_like_atom(std::string_view line) {
  const std::string_view text = trimmed(line);
  return starts_with(text, "ATOM") || starts_with(text, "HETAT");
}

CellRead box_cell(std::string_view cryst1) {
  const std::string_view group = columns(cryst1, 56, 66);
  if (!group.empty() && !is_space_group_p1(group)) return {};
  std::array<double, 6> values{};
  constexpr std::array<std::size_t, 7> starts{7, 16, 25, 34, 41, 48, 55};
  for (std::size_t i = 0; i < 6; ++i) {
    const std::string_view text = columns(cryst1, starts[i], starts[i + 1] - 1);
    if (text.empty()) return {};  // no cell is given
    const auto value = parse_double(text);
    if (!value) return {std::nullopt, "CRYST1 has a length or an angle that is no number"};
    values[i] = *value;
  }
  return read_cell_from_angles({values[0], values[1], values[2]}, {values[3], values[4], values[5]});
}

}  // namespace

// Consecutive atoms of the file that form a model or are left out.
struct PdbModelReader::Run {
  PdbModel* model = nullptr;
  bool inside = false;
  bool with_record = false;     ///< the run began with MODEL
  bool outside_models = false;  ///< so far: no MODEL at its start and no ENDMDL at its end
  LinesLeftOut lines;
  std::size_t bytes = 0;
  std::size_t shortest = std::string_view::npos;  // length of the shortest line of an atom
};

void PdbModelReader::open(Run& run, bool with_record) {
  run.inside = true;
  run.with_record = with_record;
  run.outside_models = !with_record && has_model_records_;
  run.lines = {};
  run.bytes = 0;
  run.shortest = std::string_view::npos;
  if (with_record) has_model_records_ = true;
  if (run.model != nullptr) run.model->cell = cell_;
}

// Ends the run. Returns whether it is a model.
bool PdbModelReader::close(Run& run, bool is_model) {
  run.inside = false;
  if (is_model || !run.outside_models) {
    ++models_;
    return true;
  }
  if (outside_.count == 0) outside_.first = run.lines.first;
  outside_.count += run.lines.count;
  if (run.model != nullptr) *run.model = {};
  return false;
}

void PdbModelReader::add_atom(std::string_view line, Run& run) {
  run.lines.add(lines_.number());
  if (run.model == nullptr) return;
  PdbAtom atom = read_atom_line(lines_.name(), lines_.number(), line);
  atom.atom.index = run.model->atoms.size();
  run.model->atoms.push_back(std::move(atom));
  run.bytes += line.size();
  if (run.bytes > most_whole)
    throw InputError(
        fmt::format("{}:{}: the atoms of this model take more than the {} bytes that are read of one",
                    lines_.name(), lines_.number(), most_whole));
}

// Returns whether the file ends inside this line, the last one, which has no line end.
bool PdbModelReader::is_cut_off(std::string_view line, const Run& run) const {
  while (line.ends_with('\r')) line.remove_suffix(1);
  if (trimmed(line).empty()) return false;
  if (!run.inside)
    return models_ > 0 &&
           (is_part_of(line, "MODEL") || is_part_of(line, "ATOM") || is_part_of(line, "HETATM"));
  constexpr std::size_t coordinates_end = 54;  // columns
  if (is_atom(line))
    return line.size() < coordinates_end ||
           (run.shortest != std::string_view::npos && line.size() < run.shortest);
  // Bonds and sums stand after all atoms.
  constexpr std::array<std::string_view, 6> behind_atoms{"MODEL", "ENDMDL", "END", "TER", "CONECT", "MASTER"};
  return std::none_of(behind_atoms.begin(), behind_atoms.end(),
                      [&](std::string_view name) { return is_record(line, name); });
}

bool PdbModelReader::read(PdbModel* model) {
  if (model != nullptr) *model = {};
  Run run;
  run.model = model;
  if (opening_) open(run, true);
  opening_ = false;
  for (std::string_view line; lines_.next(line);) {
    if (const std::size_t end = line.find('\r'); line.find_first_not_of('\r', end) != std::string_view::npos)
      throw InputError(fmt::format("{}:{}: a carriage return inside the line, expected line ends LF or CR LF",
                                   lines_.name(), lines_.number()));
    if (lines_.cut() && is_cut_off(line, run)) {
      ends_inside_line_ = true;
      ended_ = run.inside && close(run, false);
      return ended_;
    }
    if (is_record(line, "CRYST1")) {
      cell_ = box_cell(line);
      has_met_cell_ = has_met_cell_ || cell_.cell;
      if (run.inside && model != nullptr) model->cell = cell_;  // some programs write it after MODEL
    } else if (is_record(line, "MODEL")) {
      // Atoms before the first MODEL are outside the models.
      if (run.inside && !run.with_record) run.outside_models = true;
      if (run.inside && close(run, false)) {
        opening_ = true;
        return true;
      }
      open(run, true);
    } else if (is_record(line, "ENDMDL") || is_record(line, "END")) {
      if (!run.inside || !close(run, is_record(line, "ENDMDL"))) continue;
      ++closed_;
      return true;
    } else if (is_atom(line)) {
      if (!run.inside) open(run, false);
      run.shortest = std::min(run.shortest, line.size());
      add_atom(line, run);
    } else if (is_record(line, "NUMMDL")) {
      announced_ = std::max(announced_, parse_count(columns(line, 11, 14)).value_or(0));
    } else if (is_record(line, "TER")) {
      if (run.inside && model != nullptr) model->ends.push_back(model->atoms.size());
    } else if (looks_like_atom(line)) {
      near_misses_.add(lines_.number());
    } else if (models_ == 0 && !run.inside && starts_with(line, "DATA_")) {
      throw InputError(
          fmt::format("{}:{}: begins as an mmCIF file does, expected a PDB file; mmCIF files end in .cif",
                      lines_.name(), lines_.number()));
    }
  }
  if (!run.inside || !close(run, false)) return false;
  ended_ = true;
  ended_with_record_ = run.with_record;
  return true;
}

void PdbModelReader::rewind() {
  lines_.rewind();
  cell_ = {};
  models_ = closed_ = 0;
  opening_ = has_model_records_ = ended_ = ended_with_record_ = ends_inside_line_ = false;
  outside_ = near_misses_ = {};
}

FramesHeld PdbModelReader::held() const {
  const bool ends_inside_model = ended_ && (ends_inside_line_ || (models_ > 1 && closed_ + 1 == models_));
  return {models_ - (ends_inside_model ? 1 : 0),
          ends_inside_model || ends_inside_line_,
          lines_.offset(),
          {},
          ends_inside_line_};
}

}  // namespace kds
