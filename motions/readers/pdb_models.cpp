#include "motions/readers/pdb_models.h"

#include <fmt/format.h>

#include <array>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

// Record names take six columns, padded with blanks, and are read in either case.
bool is_record(std::string_view line, std::string_view name) {
  for (std::size_t i = 0; i < 6; ++i) {
    const char expected = i < name.size() ? name[i] : ' ';
    char found = i < line.size() ? line[i] : ' ';
    if (found >= 'a' && found <= 'z') found = static_cast<char>(found - 'a' + 'A');
    if (found != expected) return false;
  }
  return true;
}

bool is_atom(std::string_view line) { return is_record(line, "ATOM") || is_record(line, "HETATM"); }

std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  if (line.size() < first) return {};
  return trimmed(line.substr(first - 1, last - first + 1));
}

std::optional<Cell> box_cell(std::string_view cryst1) {
  const std::string_view group = columns(cryst1, 56, 66);
  if (!group.empty() && group != "P 1" && group != "P1") return std::nullopt;
  std::array<double, 6> values{};
  constexpr std::array<std::size_t, 7> starts{7, 16, 25, 34, 41, 48, 55};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = parse_double(columns(cryst1, starts[i], starts[i + 1] - 1));
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return cell_from_angles({values[0], values[1], values[2]}, {values[3], values[4], values[5]});
}

// Five columns hold 99999; beyond go letters (hybrid-36), which gemmi reads.
std::string serial_field(std::size_t number) {
  constexpr std::size_t decimals = 100000;
  if (number < decimals) return fmt::format("{:5}", number);
  number = number - decimals + 10 * 36 * 36 * 36 * 36;
  std::string field(5, ' ');
  for (std::size_t i = 5; i-- > 0; number /= 36)
    field[i] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"[number % 36];
  return field;
}

void check_atom_line(const std::string& file, std::size_t line_number, std::string_view line) {
  if (line.size() < 54)
    throw InputError(
        fmt::format("{}:{}: this atom's line ends before its coordinates do (column 54)", file, line_number));
  for (const std::size_t first : {31U, 39U, 47U}) {
    const std::string_view field = columns(line, first, first + 7);
    if (!parse_double(field))
      throw InputError(fmt::format("{}:{}: expected a coordinate in columns {} to {}, found {}", file,
                                   line_number, first, first + 7, in_quotes(field)));
  }
}

}  // namespace

void PdbModelReader::add_line(std::string_view line, std::size_t atoms, std::string& atom_lines) const {
  // Behind column 78 stands the charge, which nothing here needs and not every program writes properly.
  line = line.substr(0, 78);
  if (is_atom(line)) {
    check_atom_line(lines_.name(), lines_.number(), line);
    atom_lines.append(line.substr(0, 6)).append(serial_field(atoms)).append(line.substr(11));
  } else {
    atom_lines.append(line);
  }
  atom_lines += '\n';
  if (atom_lines.size() > most_whole)
    throw InputError(
        fmt::format("{}:{}: the atoms of this model take more than the {} bytes that are read of one",
                    lines_.name(), lines_.number(), most_whole));
}

bool PdbModelReader::read(PdbModel* model) {
  if (model != nullptr) *model = {};
  bool inside = false;
  std::size_t atoms = 0;
  const auto open = [&] {
    inside = true;
    ++models_;
    if (model != nullptr) model->cell = cell_;
  };
  if (!opening_.empty()) open();
  opening_.clear();
  for (std::string_view line; lines_.next(line);) {
    if (is_record(line, "CRYST1")) {
      cell_ = box_cell(line);
      if (inside && model != nullptr) model->cell = cell_;  // some programs write it behind MODEL
    } else if (is_record(line, "MODEL")) {
      if (inside) {
        opening_ = "MODEL";
        return true;
      }
      open();
    } else if (is_record(line, "ENDMDL") || is_record(line, "END")) {
      if (!inside) continue;
      ++closed_;
      return true;
    } else if (is_atom(line)) {
      if (!inside) open();
      if (model != nullptr) add_line(line, atoms++, model->atom_lines);
    } else if (inside && model != nullptr && is_record(line, "TER")) {
      add_line(line, atoms, model->atom_lines);
    }
  }
  if (inside) ended_ = true;
  return inside;
}

void PdbModelReader::rewind() {
  lines_.rewind();
  opening_.clear();
  cell_.reset();
  models_ = closed_ = 0;
  ended_ = false;
}

FramesHeld PdbModelReader::held() const {
  const bool ends_inside = ended_ && models_ > 1 && closed_ + 1 == models_;
  return {models_ - (ends_inside ? 1 : 0), ends_inside};
}

}  // namespace kds
