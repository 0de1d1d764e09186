#include "motions/readers/atom_filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/residue_kind.h"
#include "motions/readers/selection.h"

namespace kds {

namespace {

bool is_numeral(char c) { return c >= '0' && c <= '9'; }
bool is_latin(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// An atom selection and the option that gives it.
struct GivenText {
  std::string text;
  std::string option;
};

InputError malformed(const GivenText& given, std::string_view what) {
  return InputError(fmt::format("{}: {} {}; expected a selection as in {}", argument(given.option),
                                in_quotes(given.text), what, selection_example));
}

// A residue number with its insertion code. A number without a code means the residue without one, and `*`
// stands for any code.
struct ResidueNumber {
  int number = 0;
  char code = ' ';
};

// Takes a number with its insertion code, as 52, 52A, 52.A, 52.* or -3, off the start of `rest`.
std::optional<ResidueNumber> take_number(std::string_view& rest) {
  ResidueNumber read;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), read.number);
  if (error != std::errc()) return std::nullopt;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  if (rest.starts_with('.')) rest.remove_prefix(1);
  if (!rest.empty() && (is_latin(rest[0]) || rest[0] == '*')) {
    read.code = rest[0];
    rest.remove_prefix(1);
  }
  return read;
}

// Returns the offset of the hyphen between the two numbers of a range. A hyphen is a sign if it stands before
// the second number or, where another hyphen follows, before the first.
std::size_t hyphen_of_range(std::string_view text) {
  const bool first_is_sign = text.starts_with('-') && text.size() > 1 && is_numeral(text[1]) &&
                             text.find('-', 1) != std::string_view::npos;
  return text.find('-', first_is_sign ? 1 : 0);
}

struct ResidueRange {
  std::optional<ResidueNumber> first, last;

  // 0 if they are the same, and the sign of the difference otherwise.
  static int compare(const ResidueNumber& bound, const ResidueNumber& residue) {
    if (bound.number != residue.number) return bound.number < residue.number ? -1 : 1;
    if (bound.code == '*' || bound.code == residue.code) return 0;
    return bound.code < residue.code ? -1 : 1;
  }
  bool has(const std::string& number) const {
    if (!first && !last) return true;
    std::string_view rest = number;
    const auto residue = take_number(rest);
    if (!residue || !rest.empty()) return false;
    return (!first || compare(*first, *residue) <= 0) && (!last || compare(*last, *residue) >= 0);
  }
};

// Parses 10, 10-40, 10-, -40 (up to 40), -5--1 and so on. Returns nothing if the text is malformed.
std::optional<ResidueRange> parse_range(std::string_view text) {
  ResidueRange range;
  if (text.empty() || text == "*" || text == "." || text == "*.") return range;
  const std::size_t hyphen = hyphen_of_range(text);
  std::string_view first = text.substr(0, hyphen);
  if (!first.empty()) {
    range.first = take_number(first);
    if (!range.first || !first.empty()) return std::nullopt;
  }
  if (hyphen == std::string_view::npos) {
    range.last = range.first;
    return range;
  }
  std::string_view last = text.substr(hyphen + 1);
  if (!last.empty()) {
    range.last = take_number(last);
    if (!range.last || !last.empty()) return std::nullopt;
  }
  if (!range.first && !range.last) return std::nullopt;
  return range;
}

// A list of names with commas, which allows those names; all others if it begins with !, and any name if it
// is a star.
struct NameList {
  bool any = true, inverted = false;
  std::vector<std::string> names;

  bool has(const std::string& name) const {
    return any || (std::find(names.begin(), names.end(), name) != names.end()) != inverted;
  }
};

enum class Comparison { less, equal, greater };

// A condition on occupancies or B factors.
struct NumberCondition {
  bool is_occupancy = true;
  Comparison comparison = Comparison::equal;
  double value = 0;

  bool holds_for(double number) const {
    switch (comparison) {
      case Comparison::less:
        return number < value;
      case Comparison::greater:
        return number > value;
      default:
        return number == value;
    }
  }
};

// The parts of a selection as texts. A part that is missing allows everything.
struct SelectionTexts {
  std::string model, chains = "*", residue_names = "*", numbers, atoms = "*", conditions;
};

std::vector<std::string> split_list(std::string_view list, char separator) {
  std::vector<std::string> items;
  for (;;) {
    const std::size_t end = list.find(separator);
    items.emplace_back(list.substr(0, end));
    if (end == std::string_view::npos) return items;
    list.remove_prefix(end + 1);
  }
}

// Separates the names in brackets from the numbers of RESIDUES.
void take_residues(const GivenText& given, std::string residues, SelectionTexts& parts) {
  const std::size_t open = residues.find('(');
  if (open != std::string::npos) {
    const std::size_t close = residues.find(')', open);
    if (close == std::string::npos) throw malformed(given, "has no ) after its (");
    parts.residue_names = residues.substr(open + 1, close - open - 1);
    residues.erase(open, close - open + 1);
  }
  parts.numbers = std::move(residues);
}

// Which parts are missing follows from the first character that is special, as in gemmi.
SelectionTexts texts_of(const GivenText& given) {
  std::string dense;  // blanks belong to no name
  for (const char c : given.text)
    if (c != ' ' && c != '\t') dense += c;
  SelectionTexts parts;
  const std::size_t semicolon = std::min(dense.find(';'), dense.size());
  parts.conditions = dense.substr(semicolon);
  const std::string head = dense.substr(0, semicolon);
  if (head.empty()) return parts;
  std::vector<std::string> fields = split_list(head, '/');
  const std::size_t special = head.find_first_of("/([:");
  std::size_t first = 3;  // index of the first field among /model/chain/residues/atoms
  if (head[0] == '/') {
    fields.erase(fields.begin());
    first = 0;
  } else if (is_numeral(head[0]) || std::string_view(".-(").find(head[0]) != std::string_view::npos) {
    first = 2;
  } else if (special == std::string::npos || head[special] == '/') {
    first = 1;
  } else if (head[special] == '(') {
    first = 2;
  }
  if (first + fields.size() > 4) throw malformed(given, "has too many parts");
  std::string residues;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    std::string* const targets[] = {&parts.model, &parts.chains, &residues, &parts.atoms};
    *targets[first + i] = fields[i];
  }
  take_residues(given, residues, parts);
  return parts;
}

NameList parse_list(const GivenText& given, std::string_view list) {
  if (list == "*") return {};
  NameList read;
  read.any = false;
  read.inverted = list.starts_with('!');
  if (read.inverted) list.remove_prefix(1);
  if (const std::size_t wrong = list.find_first_of("[]()!*/:;"); wrong != std::string_view::npos)
    throw malformed(given, fmt::format("has {} in a list of names", in_quotes(list.substr(wrong, 1))));
  read.names = split_list(list, ',');
  return read;
}

// Returns the symbols of the elements as gemmi writes them.
NameList parse_elements(const GivenText& given, std::string_view list) {
  NameList read = parse_list(given, list);
  for (std::string& symbol : read.names) {
    const gemmi::Element element(symbol);
    if (symbol.empty() || symbol.size() > 2 || (element == gemmi::El::X && symbol != "X" && symbol != "x"))
      throw malformed(given, fmt::format("has {} in [ ], which is no element", in_quotes(symbol)));
    symbol = element.name();
  }
  return read;
}

NumberCondition parse_number_condition(const GivenText& given, std::string_view condition) {
  NumberCondition read;
  read.is_occupancy = condition.starts_with('q');
  const std::optional<double> value = condition.size() < 2 ? std::nullopt : parse_double(condition.substr(2));
  if ((!read.is_occupancy && !condition.starts_with('b')) || !value)
    throw malformed(
        given, fmt::format("has the condition {}, which is not as in q>0.5 or b<30", in_quotes(condition)));
  const char sign = condition[1];
  if (sign != '<' && sign != '=' && sign != '>')
    throw malformed(
        given, fmt::format("has the condition {}, which is not as in q>0.5 or b<30", in_quotes(condition)));
  read.comparison = sign == '<' ? Comparison::less : sign == '>' ? Comparison::greater : Comparison::equal;
  read.value = *value;
  return read;
}

// The kind of a residue as conditions name it.
std::string kind_name_of(const StructureResidue& residue) {
  if (kind_of(residue) != ResidueKind::none) return "polymer";
  return is_water(residue.name) ? "solvent" : "";
}

}  // namespace

struct AtomFilter::Rules {
  GivenText given;
  NameList chains, residue_names, kinds, atom_names, elements, locations;
  ResidueRange numbers;
  std::vector<NumberCondition> conditions;

  explicit Rules(GivenText its_given) : given(std::move(its_given)) {
    const SelectionTexts parts = texts_of(given);
    if (!parts.model.empty() && parts.model != "*" && parts.model != "0")
      throw malformed(
          given, fmt::format("names model {}, which {} chooses", in_quotes(parts.model), frames_argument()));
    chains = parse_list(given, parts.chains);
    residue_names = parse_list(given, parts.residue_names);
    const auto range = parse_range(parts.numbers);
    if (!range) {
      std::string advice;
      if (given.text == parts.numbers)
        advice = fmt::format(" (//*//{} chooses atoms by name)", parts.numbers);
      else if (!given.text.starts_with('/') && parts.residue_names == "*")
        advice = fmt::format(" (names of residues stand in brackets: ({})/{})", parts.chains, parts.numbers);
      throw malformed(given, fmt::format("has the residues {}, which are no number or range{}",
                                         in_quotes(parts.numbers), advice));
    }
    numbers = *range;
    take_atoms(parts.atoms);
    if (!parts.conditions.empty())
      for (const std::string& condition : split_list(std::string_view(parts.conditions).substr(1), ';'))
        take_condition(condition);
  }

  // Parses NAMES[ELEMENTS]:LOCATIONS.
  void take_atoms(std::string_view atoms) {
    const std::size_t end = std::min(atoms.find_first_of("[:"), atoms.size());
    if (end > 0) atom_names = parse_list(given, atoms.substr(0, end));
    atoms.remove_prefix(end);
    if (atoms.starts_with('[')) {
      const std::size_t close = atoms.find(']');
      if (close == std::string_view::npos) throw malformed(given, "has no ] after its [");
      elements = parse_elements(given, atoms.substr(1, close - 1));
      atoms.remove_prefix(close + 1);
    }
    if (atoms.empty()) return;
    if (atoms[0] != ':') throw malformed(given, fmt::format("has {} after ]", in_quotes(atoms)));
    locations = parse_list(given, atoms.substr(1));
  }

  void take_condition(const std::string& condition) {
    if (condition.find_first_of("<=>") != std::string::npos) {
      conditions.push_back(parse_number_condition(given, condition));
      return;
    }
    kinds = parse_list(given, condition);
    for (const std::string& kind : kinds.names)
      if (kind != "polymer" && kind != "solvent")
        throw malformed(given, fmt::format("has the condition {}, which is not polymer, solvent, q or b",
                                           in_quotes(condition)));
  }

  bool takes(const StructureResidue& residue) const {
    return chains.has(residue.chain) && numbers.has(residue.number) && residue_names.has(residue.name) &&
           (kinds.any || kinds.has(kind_name_of(residue)));
  }

  bool takes(const std::string& file, const StructureResidue& residue, const StructureAtom& atom) const {
    if (!atom_names.has(atom.name) ||
        !locations.has(atom.alternate == '\0' ? "" : std::string(1, atom.alternate)))
      return false;
    if (!elements.any && !elements.has(element_of(residue, atom).name())) return false;
    return std::all_of(conditions.begin(), conditions.end(), [&](const NumberCondition& condition) {
      const std::optional<double>& value = condition.is_occupancy ? atom.occupancy : atom.b_factor;
      if (!value)
        throw InputError(fmt::format("{}: {} compares {}, which {} does not give for {} of {} {}",
                                     argument(given.option), in_quotes(given.text),
                                     condition.is_occupancy ? "occupancies (q)" : "B factors (b)", file,
                                     atom.name, residue.name, residue.number));
      return condition.holds_for(*value);
    });
  }
};

AtomFilter::AtomFilter(const std::string& text, std::string_view option)
    : rules_(std::make_shared<const Rules>(GivenText{text, std::string(option)})) {}

std::vector<const StructureAtom*> AtomFilter::atoms_of(const std::string& file,
                                                       const StructureResidue& residue) const {
  std::vector<const StructureAtom*> atoms;
  if (!rules_->takes(residue)) return atoms;
  std::set<std::string_view> with_alternates;
  for (const StructureAtom& atom : residue.atoms)
    if (rules_->takes(file, residue, atom) &&
        (atom.alternate == '\0' || with_alternates.insert(atom.name).second))
      atoms.push_back(&atom);
  return atoms;
}

bool AtomFilter::takes(const std::string& file, const StructureResidue& residue,
                       const StructureAtom& atom) const {
  return rules_->takes(residue) && rules_->takes(file, residue, atom);
}

}  // namespace kds
