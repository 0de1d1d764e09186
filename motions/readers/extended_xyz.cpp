#include "motions/readers/extended_xyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

struct Value {
  std::vector<std::string> items;
  std::vector<std::size_t> rows;  // number of items in each row of a matrix; empty if not a matrix
  std::string text;               // the content of a string
  std::string_view source;        // the text in the line, with its quotes or brackets
  bool whole = true;              // whether the closing quote or bracket is present
};

struct Pair {
  std::string key;
  Value value;
};

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

class PairReader {
 public:
  explicit PairReader(std::string_view text) : text_(text) {}

  std::vector<Pair> read() {
    std::vector<Pair> pairs;
    for (skip_blanks(); !at_end(); skip_blanks()) {
      const std::size_t begin = at_;
      bool whole = true;
      const bool is_quoted = is_quote(peek());
      std::string key = is_quoted ? quoted(whole) : bare("=");
      if (!whole) {
        open_from_ = begin;
        break;
      }
      skip_blanks();
      if (at_end() || peek() != '=') {
        if (key.empty() && !at_end()) ++at_;
        if (is_quoted) quoted_words_.push_back(std::move(key));
        continue;  // a word of a plain comment
      }
      ++at_;
      skip_blanks();
      const std::size_t start = at_;
      pairs.push_back({std::move(key), value()});
      pairs.back().value.source = text_.substr(start, at_ - start);
    }
    return pairs;
  }

  // Returns the rest of the line from a quote that is never closed, or an empty text if there is no such
  // quote.
  std::string_view open_rest() const { return open_from_ ? text_.substr(*open_from_) : std::string_view(); }
  // Returns the quoted words that are not keys.
  const std::vector<std::string>& quoted_words() const { return quoted_words_; }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  char peek() const { return text_[at_]; }
  static bool is_quote(char c) { return c == '"' || c == '\''; }
  void skip_blanks() {
    while (!at_end() && is_blank(peek())) ++at_;
  }

  std::string bare(std::string_view stops) {
    std::string word;
    while (!at_end() && !is_blank(peek()) && stops.find(peek()) == std::string_view::npos) {
      if (peek() == '\\' && at_ + 1 < text_.size()) ++at_;
      word += text_[at_++];
    }
    return word;
  }

  std::string quoted(bool& whole) {
    const char quote = text_[at_++];
    std::string word;
    while (!at_end() && peek() != quote) {
      if (peek() == '\\' && at_ + 1 < text_.size()) {
        ++at_;
        word += peek() == 'n' ? '\n' : peek();
        ++at_;
      } else {
        word += text_[at_++];
      }
    }
    whole = !at_end();
    if (whole) ++at_;
    return word;
  }

  Value value() {
    Value value;
    if (at_end()) return value;
    if (is_quote(peek())) {
      value.text = quoted(value.whole);
      // An array in the old style, or an array in brackets that was quoted.
      PairReader inner(value.text);
      inner.skip_blanks();
      if (!inner.at_end() && (inner.peek() == '[' || inner.peek() == '{')) {
        Value array = inner.value();
        value.items = std::move(array.items);
        value.rows = std::move(array.rows);
        value.whole = value.whole && array.whole;
      } else {
        inner.items_until('\0', value);
      }
    } else if (peek() == '[') {
      ++at_;
      skip_blanks();
      if (!at_end() && peek() == '[') {
        matrix(value);
      } else {
        items_until(']', value);
      }
    } else if (peek() == '{') {
      ++at_;
      items_until('}', value);
    } else {
      value.text = bare("");
      value.items.push_back(value.text);
    }
    return value;
  }

  // Reads the rows of a matrix after its outer bracket.
  void matrix(Value& value) {
    while (value.whole && !at_end() && peek() == '[') {
      ++at_;
      const std::size_t before = value.items.size();
      items_until(']', value);
      value.rows.push_back(value.items.size() - before);
      while (!at_end() && (is_blank(peek()) || peek() == ',')) ++at_;
    }
    if (at_end() || peek() != ']') {
      value.whole = false;
    } else {
      ++at_;
    }
  }

  // Reads items up to the closing bracket, or up to the end of the text if `close` is '\0'.
  void items_until(char close, Value& value) {
    while (true) {
      while (!at_end() && (is_blank(peek()) || peek() == ',')) ++at_;
      if (at_end()) {
        value.whole = value.whole && close == '\0';
        return;
      }
      if (peek() == close) {
        ++at_;
        return;
      }
      bool whole = true;
      const std::size_t begin = at_;
      value.items.push_back(is_quote(peek()) && close != '\0' ? quoted(whole) : bare(",[]{}"));
      value.whole = value.whole && whole;
      if (at_ == begin) ++at_;  // a misplaced bracket counts as an empty item
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::optional<std::size_t> open_from_;
  std::vector<std::string> quoted_words_;
};

[[noreturn]] void refuse(const std::string& message) { throw InputError(message); }

Eigen::Matrix3d read_lattice(const Value& value) {
  if (!value.whole) refuse("expected 9 numbers in Lattice, its bracket or quote is not closed");
  const bool is_matrix = value.rows.empty() || value.rows == std::vector<std::size_t>{3, 3, 3};
  if (!is_matrix || (value.items.size() != 9 && value.items.size() != 3))
    refuse(fmt::format(
        "expected 9 numbers in Lattice (three vectors, one after the other) or 3 (its diagonal), found {}{}",
        value.items.size(), value.rows.empty() ? "" : fmt::format(" in {} rows", value.rows.size())));
  Eigen::Matrix3d vectors = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const auto number = parse_fortran_double(value.items[i]);
    if (!number) refuse(fmt::format("expected a number in Lattice, found {}", in_quotes(value.items[i])));
    const auto at = static_cast<Eigen::Index>(i);
    if (value.items.size() == 3)
      vectors(at, at) = *number;
    else
      vectors(at % 3, at / 3) = *number;
  }
  return vectors;
}

std::optional<bool> logical(const std::string& item) {
  if (item == "T" || item == "True" || item == "true" || item == "TRUE" || item == "1") return true;
  if (item == "F" || item == "False" || item == "false" || item == "FALSE" || item == "0") return false;
  return std::nullopt;
}

std::array<bool, 3> read_periodic(const Value& value) {
  std::vector<bool> periodic;
  for (const std::string& item : value.items) {
    const std::optional<bool> yes = logical(item);
    if (!yes) refuse(fmt::format("expected T or F in pbc, found {}", in_quotes(item)));
    periodic.push_back(*yes);
  }
  if (!value.whole || (periodic.size() != 3 && periodic.size() != 1))
    refuse(fmt::format("expected T or F three times in pbc, found {}", counted(periodic.size(), "value")));
  if (periodic.size() == 1) return {periodic[0], periodic[0], periodic[0]};
  return {periodic[0], periodic[1], periodic[2]};
}

XyzColumns read_columns(const Value& value) {
  const std::string& text = value.text;
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  if (!value.whole || parts.size() % 3 != 0)
    refuse(fmt::format("expected Properties as name:type:count, as in species:S:1:pos:R:3, found {}",
                       in_quotes(text)));
  XyzColumns columns{std::nullopt, 0, std::nullopt, 0, true};
  std::optional<std::size_t> position, number;
  const auto once = [&](std::optional<std::size_t>& index, const std::string& name) {
    if (index) refuse(fmt::format("Properties names {} twice", in_quotes(name)));
    index = columns.count;
  };
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const std::string name = lower_case(trimmed(parts[i])), type(trimmed(parts[i + 1]));
    const auto width = parse_count(trimmed(parts[i + 2]));
    constexpr std::size_t most = 10000;
    if (name.empty() || type.size() != 1 || std::string_view("SIRL").find(type) == std::string_view::npos ||
        !width || *width == 0 || *width > most)
      refuse(fmt::format("expected name:type:count in Properties (types S, I, R, L), found {}",
                         in_quotes(parts[i] + ":" + parts[i + 1] + ":" + parts[i + 2])));
    if (name == "pos") {
      if (*width != 3 || (type != "R" && type != "I"))
        refuse(fmt::format("expected pos:R:3 in Properties, found {}",
                           in_quotes(parts[i] + ":" + parts[i + 1] + ":" + parts[i + 2])));
      once(position, name);
    } else if (name == "species" && *width == 1) {
      once(columns.species, name);
    } else if (name == "z" && *width == 1 && type == "I") {
      once(number, name);
    } else if (name == "id" && *width == 1 && type == "I") {
      once(columns.id, name);
    }
    columns.count += *width;
  }
  if (!position) refuse(fmt::format("expected pos:R:3 in Properties, found {}", in_quotes(text)));
  columns.position = *position;
  if (!columns.species) columns.species = number;
  return columns;
}

// Returns whether a part of the line that could not be parsed contains one of the supported keys.
bool names_a_key(std::string_view rest) {
  const std::string text = lower_case(rest);
  for (const std::string_view key : {"lattice", "properties", "pbc"}) {
    const std::size_t at = text.find(key);
    if (at == std::string::npos) continue;
    const std::size_t next = text.find_first_not_of(" \t\"'", at + key.size());
    if (next != std::string::npos && text[next] == '=') return true;
  }
  return false;
}

std::string singular(std::string_view word) {
  if (word.ends_with("ies")) return std::string(word.substr(0, word.size() - 3)) + 'y';
  return std::string(word.substr(0, word.size() - (word.ends_with('s') ? 1 : 0)));
}

// `key` is in lower case.
bool is_near(std::string_view key, std::string_view name) {
  if (key.size() > name.size() + 1) return false;
  return edit_distance(key, name) <= 1 || singular(key) == singular(name);
}

// Returns messages about keys of the file that are probably misspelt names of the expected keys. Many words
// are one letter away from pbc, so for pbc the value must be suitable as well.
std::string misspelt_keys(const std::vector<Pair>& pairs) {
  std::string text;
  for (const std::string_view name : {"Lattice", "Properties", "pbc"}) {
    const std::string ours = lower_case(name);
    const auto is_ours = [&](const Pair& pair) { return lower_case(pair.key) == ours; };
    if (std::any_of(pairs.begin(), pairs.end(), is_ours)) continue;
    for (const Pair& pair : pairs) {
      if (!is_near(lower_case(pair.key), ours)) continue;
      const std::vector<std::string>& items = pair.value.items;
      if (name == "pbc" && std::none_of(items.begin(), items.end(),
                                        [](const std::string& item) { return logical(item).has_value(); }))
        continue;
      text += fmt::format("{}the key {} is not read, did you mean {}?", text.empty() ? "" : " ",
                          in_quotes(pair.key), name);
    }
  }
  return text;
}

// Reads the comment of i-PI, which names the unit of positions in braces and writes its cell as CELL(abcABC):
// or CELL{H}:.
std::optional<std::string> read_ipi_comment(std::string_view line) {
  const std::string text = lower_case(line);
  constexpr std::string_view positions = "positions{";
  if (const std::size_t at = text.find(positions); at != std::string::npos) {
    const std::string unit = text.substr(at + positions.size(), text.find('}', at) - at - positions.size());
    if (unit != "angstrom")
      refuse(fmt::format("expected positions in angstrom, found the unit {}", in_quotes(unit)));
  }
  for (const std::string_view key : {"cell(abcabc)", "cell{h}", "cell[h]"})
    if (const std::size_t at = text.find(key); at != std::string::npos)
      return std::string(line.substr(at, key.size()));
  return std::nullopt;
}

}  // namespace

XyzComment read_xyz_comment(std::string_view line) {
  PairReader reader(line);
  const std::vector<Pair> pairs = reader.read();
  if (names_a_key(reader.open_rest()))
    refuse(
        fmt::format("expected key=value pairs, a quote is not closed in {}", in_quotes(reader.open_rest())));
  for (const std::string& word : reader.quoted_words())
    if (names_a_key(word))
      refuse(fmt::format("expected key=value pairs, a key stands inside the quotes of {}", in_quotes(word)));
  XyzComment comment;
  comment.near_lattice = read_ipi_comment(line);
  std::optional<Value> lattice, properties, periodic;
  for (const Pair& pair : pairs) {
    const std::string key = lower_case(pair.key);
    std::optional<Value>* const ours = key == "lattice"      ? &lattice
                                       : key == "properties" ? &properties
                                       : key == "pbc"        ? &periodic
                                                             : nullptr;
    if (ours == nullptr) {
      if (key == "cell" || key == "box" || key == "unitcell" || key == "unit_cell")
        comment.near_lattice = pair.key;
      if (!pair.value.whole && names_a_key(pair.value.source))
        refuse(fmt::format("expected key=value pairs, the value of {} is not closed", in_quotes(pair.key)));
      continue;
    }
    if (*ours) refuse(fmt::format("{} is given twice", pair.key));
    *ours = pair.value;
  }
  if (lattice) {
    const Eigen::Matrix3d vectors = read_lattice(*lattice);
    comment.cell = read_cell(vectors, periodic ? read_periodic(*periodic) : std::array{true, true, true});
    comment.near_lattice.reset();
  } else if (periodic) {
    (void)read_periodic(*periodic);
  }
  if (properties) comment.columns = read_columns(*properties);
  comment.misspelt = misspelt_keys(pairs);
  return comment;
}

std::optional<double> parse_fortran_double(std::string_view field) {
  if (const auto value = parse_double(field)) return value;
  std::string text(field);
  const std::size_t exponent = text.find_first_of("dD");
  if (exponent == std::string::npos || exponent == 0) return std::nullopt;
  text[exponent] = 'e';
  return parse_double(text);
}

}  // namespace kds
