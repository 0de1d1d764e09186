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

PdbText split_pdb_models(std::string_view text) {
  std::vector<PdbModel> models;
  std::optional<Cell> cell;
  bool inside = false;
  std::size_t closed = 0;
  const char* begin = text.data();
  const auto close = [&](const char* end) {
    if (inside) models.back().text = {begin, static_cast<std::size_t>(end - begin)};
    inside = false;
  };
  const auto open = [&](std::string_view line, std::size_t number) {
    close(line.data());
    begin = line.data();
    models.push_back({{}, number, cell});
    inside = true;
  };
  std::string_view rest = text;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = next_line(rest);
    if (is_record(line, "CRYST1")) {
      cell = box_cell(line);
      if (inside) models.back().cell = cell;  // some programs write it behind MODEL
    } else if (is_record(line, "MODEL")) {
      open(line, number);
    } else if (is_record(line, "ENDMDL") || is_record(line, "END")) {
      if (inside) ++closed;
      close(line.data());
    } else if (!inside && is_atom(line)) {
      open(line, number);
    }
  }
  const bool ends_inside = inside && models.size() > 1 && closed + 1 == models.size();
  close(text.data() + text.size());
  return {std::move(models), ends_inside};
}

std::string atom_lines(const std::string& file, const PdbModel& model) {
  std::string lines;
  lines.reserve(model.text.size());
  std::size_t atoms = 0;
  std::string_view rest = model.text;
  for (std::size_t number = model.first_line; !rest.empty(); ++number) {
    // Behind column 78 stands the charge, which nothing here needs and not every program writes properly.
    const std::string_view line = next_line(rest).substr(0, 78);
    if (is_atom(line)) {
      check_atom_line(file, number, line);
      lines.append(line.substr(0, 6)).append(serial_field(atoms++)).append(line.substr(11));
    } else if (is_record(line, "TER")) {
      lines.append(line);
    } else {
      continue;
    }
    lines += '\n';
  }
  return lines;
}

}  // namespace kds
