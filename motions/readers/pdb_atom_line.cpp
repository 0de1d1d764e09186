#include "motions/readers/pdb_atom_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_column_blank(char c) { return c == ' ' || c == '\t'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

char column(std::string_view line, std::size_t number) {
  return number <= line.size() ? line[number - 1] : ' ';
}

// Returns whether a number is too wide for its columns. Such a number pushes the rest of the line to the
// right: its last digits run into the next columns, and its decimal point is after column `point`.
bool overflows(std::string_view line, std::size_t first, std::size_t last, std::size_t point) {
  if (!is_digit(column(line, last)) || !is_digit(column(line, last + 1))) return false;
  const std::size_t found = line.substr(0, last).rfind('.');
  return found != std::string_view::npos && found + 1 > point && found + 1 >= first;
}

double coordinate(const std::string& file, std::size_t line_number, std::string_view line,
                  std::size_t first) {
  const std::string_view field = columns(line, first, first + 7);
  const auto value = parse_double(field);
  const bool shifted = is_digit(column(line, 11)) && is_digit(column(line, 12));
  const char* const reason = shifted ? "; the atom's serial number overflows into column 12" : "";
  if (!value)
    throw InputError(fmt::format("{}:{}: expected a coordinate in columns {} to {}, found {}{}", file,
                                 line_number, first, first + 7, in_quotes(field), reason));
  if (overflows(line, first, first + 7, first + 4))
    throw InputError(fmt::format("{}:{}: the coordinate in columns {} to {} overflows them: {}{}", file,
                                 line_number, first, first + 7, in_quotes(line.substr(first - 1, 16)),
                                 reason));
  return *value;
}

std::optional<double> read_occupancy(const std::string& file, std::size_t line_number,
                                     std::string_view line) {
  const std::string_view field = columns(line, 55, 60);
  const std::optional<double> occupancy = parse_double(field);
  if (!field.empty() && !occupancy)
    throw InputError(fmt::format("{}:{}: expected an occupancy in columns 55 to 60, found {}", file,
                                 line_number, in_quotes(field)));
  if (overflows(line, 55, 60, 58))
    throw InputError(fmt::format("{}:{}: the occupancy in columns 55 to 60 overflows them: {}", file,
                                 line_number, in_quotes(line.substr(54, 12))));
  return occupancy;
}

// Returns the element in columns 77 and 78, or X if they give none.
gemmi::Element element_given_in(std::string_view line) {
  if (is_letter(column(line, 77)) || is_letter(column(line, 78)))
    return gemmi::Element(std::string{column(line, 77), column(line, 78)});
  return gemmi::El::X;
}

// Returns the element given by the atom's name, which is right-aligned in columns 13 and 14. A name of four
// characters that begins with H is a hydrogen.
gemmi::Element element_of_name(std::string_view line) {
  const char first = column(line, 13), second = column(line, 14);
  if ((first == 'H' || first == 'h') && column(line, 16) != ' ') return gemmi::El::H;
  if (is_digit(first)) return gemmi::Element(std::string(1, second));
  if (is_digit(second)) return gemmi::Element(std::string(1, first));
  return gemmi::Element(std::string{first, second});
}

// Returns a residue number, which is decimal, or hybrid-36 from A000 = 10000 on. Other texts, such as
// hexadecimal 2b5f, are labels and stay unchanged.
std::string residue_number(std::string_view text) {
  if (text.empty()) return "?";
  int value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc() && stop == end) return std::to_string(value);
  const bool hybrid =
      text.size() == 4 && text[0] >= 'A' && text[0] <= 'Z' &&
      std::all_of(text.begin(), text.end(), [](char c) { return is_digit(c) || (c >= 'A' && c <= 'Z'); });
  if (!hybrid || std::from_chars(text.data(), end, value, 36).ptr != end) return std::string(text);
  return std::to_string(value - 10 * 36 * 36 * 36 + 10000);
}

}  // namespace

std::string_view columns(std::string_view line, std::size_t first, std::size_t last) {
  if (line.size() < first) return {};
  // Simpler and faster than trimmed(), because trajectory files have many columns.
  std::size_t begin = first - 1, end = std::min(last, line.size());
  while (begin < end && is_column_blank(line[begin])) ++begin;
  while (begin < end && is_column_blank(line[end - 1])) --end;
  return line.substr(begin, end - begin);
}

PdbAtom read_atom_line(const std::string& file, std::size_t line_number, std::string_view line) {
  if (std::any_of(line.begin(), line.end(), [](char c) { return c >= '\0' && c < ' '; }))
    throw InputError(
        fmt::format("{}:{}: a tab or another control character stands in this atom's line, expected "
                    "columns filled with blanks, and LF or CR LF at the end",
                    file, line_number));
  // The charge after column 78 is not needed, and not every program writes it correctly.
  line = line.substr(0, 78);
  if (line.size() < 54)
    throw InputError(
        fmt::format("{}:{}: this atom's line ends before its coordinates do (column 54)", file, line_number));
  if (column(line, 30) != ' ' && (is_digit(column(line, 31)) || column(line, 31) == '.'))
    throw InputError(fmt::format("{}:{}: expected a blank in column 30 before the coordinates, found {}",
                                 file, line_number, in_quotes(line.substr(27, 11))));
  PdbAtom read;
  read.atom.position = {coordinate(file, line_number, line, 31), coordinate(file, line_number, line, 39),
                        coordinate(file, line_number, line, 47)};
  read.atom.occupancy = read_occupancy(file, line_number, line);
  read.atom.b_factor = parse_double(columns(line, 61, 66));
  read.atom.name = columns(line, 13, 16);
  read.atom.alternate = line[16] == ' ' ? '\0' : line[16];
  read.atom.element = element_given_in(line);
  read.atom.element_is_given = read.atom.element != gemmi::El::X;
  if (!read.atom.element_is_given) read.atom.element = element_of_name(line);
  read.residue = columns(line, 18, 20);
  read.column_21 = line[20];
  read.chain = line[21];
  read.number = residue_number(columns(line, 23, 26));
  if (line[26] != ' ') read.number += line[26];
  read.segment = columns(line, 73, 76);
  read.het = line[0] == 'H' || line[0] == 'h';
  return read;
}

}  // namespace kds
