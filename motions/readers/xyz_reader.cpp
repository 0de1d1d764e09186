#include "motions/readers/xyz_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/frames/frame_selection.h"
#include "motions/readers/extended_xyz.h"
#include "motions/readers/vdw_radii.h"

namespace kds {

namespace {

// Returns the element of an amino acid's atom name in capitals. Some of these names are also symbols of
// elements.
std::optional<char> element_of_atom_name(std::string_view name) {
  constexpr std::array<std::string_view, 12> heavy{"CA", "CB", "CG", "CD", "CE", "CZ",
                                                   "NE", "NZ", "OG", "OH", "SD", "SG"};
  constexpr std::array<std::string_view, 9> hydrogens{"HA", "HB", "HG", "HD", "HE", "HZ", "HH", "HN", "HO"};
  if (name == "OXT" || std::find(heavy.begin(), heavy.end(), name) != heavy.end() ||
      std::find(hydrogens.begin(), hydrogens.end(), name) != hydrogens.end())
    return name[0];
  // Names such as CG1, OD2, HB3 or HD11 consist of an element, a remoteness letter and digits.
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits != 2 || name.size() > 4 ||
      name.find_first_not_of("0123456789", digits) != std::string_view::npos)
    return std::nullopt;
  const bool is_element = std::string_view("CNOH").find(name[0]) != std::string_view::npos;
  const bool is_remote = std::string_view("ABGDEZH").find(name[1]) != std::string_view::npos;
  return is_element && is_remote ? std::optional(name[0]) : std::nullopt;
}

// Decides from the whole column whether it holds atom names or element symbols: names if some entries are not
// symbols, or if CA occurs alone or with N.
bool holds_atom_names(const std::vector<std::string>& symbols) {
  bool has_alpha = false, has_nitrogen = false, all_alpha = true;
  for (const std::string& symbol : symbols) {
    if (element_of_atom_name(symbol) && !van_der_waals_radius(symbol)) return true;
    if (symbol == "CA") has_alpha = true;
    if (symbol == "N") has_nitrogen = true;
    if (symbol != "CA") all_alpha = false;
  }
  return has_alpha && (has_nitrogen || all_alpha);
}

std::vector<double> element_radii_of(const std::string& file, const std::vector<std::string>& symbols,
                                     std::vector<std::string>& warnings) {
  const bool names = holds_atom_names(symbols);
  std::vector<std::string> guessed;
  std::vector<double> radii;
  for (const std::string& symbol : symbols) {
    const auto number = parse_count(symbol);
    auto radius = number ? van_der_waals_radius(*number) : van_der_waals_radius(symbol);
    if (const auto letter = element_of_atom_name(symbol)) {
      if (radius && std::find(guessed.begin(), guessed.end(), symbol) == guessed.end())
        guessed.push_back(symbol);
      if (names) radius = van_der_waals_radius(std::string_view(&*letter, 1));
    }
    radii.push_back(radius.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (std::any_of(radii.begin(), radii.end(), [](double radius) { return std::isnan(radius); })) return radii;
  for (const std::string& symbol : guessed)
    warnings.push_back(
        fmt::format("{}: {} is taken for {}", file, symbol,
                    names ? "an atom name of amino acids; the element is written as in Ca"
                          : "an element, because no atom name of amino acids is among the others"));
  return radii;
}

class XyzFrames final : public AtomFrames {
 public:
  explicit XyzFrames(const std::filesystem::path& path) : lines_(path) {
    try {
      while (skip_frame(held_)) {
      }
    } catch (const CutFile&) {
      held_.ends_inside = true;
    } catch (const DamagedFrame& damage) {
      held_.damage = damage;
    }
    held_.end = lines_.offset();
    rewind();
  }

  std::size_t atom_count() const override { return atoms_; }
  FramesHeld held() const override { return held_; }
  // A frame may have a cell if a comment names a lattice.
  bool may_have_cell() const override { return may_have_cell_; }
  std::vector<double> element_radii(std::vector<std::string>& warnings) const override {
    return element_radii_of(lines_.name(), symbols_, warnings);
  }

  std::vector<std::size_t> ids() const override {
    std::vector<std::size_t> ids;
    for (const std::string& text : ids_) {
      const auto id = parse_count(text);
      if (!id) return {};
      ids.push_back(*id);
    }
    return ids;
  }

  // All frames must have the atoms of the one read first.
  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    if (k < next_) rewind();
    FramesHeld held{next_};
    for (; next_ < k; ++next_)
      if (!skip_frame(held)) fail_gone(k);
    if (!read_count() || atoms_in_frame() != atoms_ || !read_line()) fail_gone(k);
    ++next_;
    XyzComment comment = comment_of(line_);
    frame.cell = comment.cell.cell;
    frame.cell_doubt = std::move(comment.cell.doubt);
    frame.note = std::move(comment.misspelt);
    if (comment.near_lattice)
      frame.cell_doubt =
          fmt::format("expected it as Lattice=, found the key {}", in_quotes(*comment.near_lattice));
    const bool skipped = !frame.asked && !frame.cell;
    for (std::size_t i = 0; skipped && i < atoms_; ++i)
      if (!read_line()) fail_gone(k);
    if (skipped) return;
    positions_.resize(3, static_cast<Eigen::Index>(atoms_));
    for (Eigen::Index i = 0; i < positions_.cols(); ++i) {
      if (!read_line()) fail_gone(k);
      positions_.col(i) = atom(comment.columns, k, static_cast<std::size_t>(i));
    }
    if (!first_frame_) first_frame_ = k;
    frame.positions.resize(3, static_cast<Eigen::Index>(atoms.size()));
    for (std::size_t i = 0; i < atoms.size(); ++i)
      frame.positions.col(static_cast<Eigen::Index>(i)) = positions_.col(static_cast<Eigen::Index>(atoms[i]));
  }

 private:
  void rewind() {
    lines_.rewind();
    next_ = 0;
  }

  bool read_line() { return lines_.next(line_); }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", lines_.name(), lines_.number(), message));
  }

  [[noreturn]] void fail_count(std::size_t k, const std::string& message) const {
    throw DamagedFrame(fmt::format("{}:{}", lines_.name(), lines_.number()), k, lines_.offset(), message);
  }

  [[noreturn]] void fail_gone(std::size_t k) const {
    throw InputError(fmt::format("{}: frame {}: is gone since the file was first read", lines_.name(), k));
  }

  // Reads the line with the number of atoms. Returns false if no frame follows.
  bool read_count() {
    while (read_line())
      if (!trimmed(line_).empty()) return true;
    return false;
  }

  std::optional<std::size_t> atoms_in_frame() const {
    const auto fields = split_fields(line_);
    return fields.size() == 1 ? parse_count(fields.front()) : std::nullopt;
  }

  // Skips a frame by counting lines. Contents are examined only in the requested frames.
  bool skip_frame(FramesHeld& held) {
    const std::uint64_t frame_begin = lines_.offset();
    if (!read_count()) return false;
    const auto count = atoms_in_frame();
    if (!count)
      fail_count(held.whole, fmt::format("expected the number of atoms of frame {}, found {}", held.whole,
                                         in_quotes(line_)));
    if (*count == 0) fail_count(held.whole, "expected at least 1 atom, found 0");
    if (held.whole == 0) atoms_ = *count;
    if (!skip_atoms(*count, held)) {
      held.ends_inside = true;
      return false;
    }
    if (*count != atoms_)
      throw DamagedFrame(lines_.name(), held.whole, frame_begin,
                         fmt::format("{}, expected {} as in frame 0", counted(*count, "atom"), atoms_));
    ++held.whole;
    return true;
  }

  // Skips the atoms. Returns whether the frame is complete. The last line of a truncated file may be
  // truncated itself.
  bool skip_atoms(std::size_t count, FramesHeld& held) {
    if (!read_line()) return false;
    const std::string comment(line_);
    may_have_cell_ = may_have_cell_ || names_lattice(comment);
    const std::uint64_t first_atom = lines_.offset();
    const std::size_t first_line = lines_.number() + 1;
    for (std::size_t i = 0; i < count; ++i)
      if (!read_line()) return false;
    if (!lines_.cut()) return true;
    const std::optional<XyzColumns> columns = columns_of(comment);
    if (!columns) return true;  // reading the frame reports the reason
    if (!is_atom_line(*columns)) return false;
    held.lacks_line_end = !is_last_column_whole(*columns, first_atom, first_line, count);
    return !held.lacks_line_end;
  }

  static bool names_lattice(std::string_view comment) {
    constexpr std::string_view key = "lattice";
    const auto same = [](char c, char small) { return c == small || c == small - 'a' + 'A'; };
    return std::search(comment.begin(), comment.end(), key.begin(), key.end(), same) != comment.end();
  }

  static std::optional<XyzColumns> columns_of(std::string_view comment) {
    try {
      return read_xyz_comment(comment).columns;
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

  // Whether the last column that is read cannot be cut off: something follows the number, or it is a
  // coordinate with all decimals.
  bool is_last_column_whole(const XyzColumns& columns, std::uint64_t first_atom, std::size_t first_line,
                            std::size_t count) {
    if (line_.ends_with(' ') || line_.ends_with('\t')) return true;
    const std::size_t last = split_fields(line_).size() - 1;
    if (columns.species == last || columns.id == last) return false;
    return last >= columns.position + 3 || has_equal_decimals(columns, first_atom, first_line, count);
  }

  // Whether all coordinates of the frame have as many decimals as the first one. A last number that is cut
  // off has fewer. Integers have none, so a cut cannot be noticed: returns false.
  bool has_equal_decimals(const XyzColumns& columns, std::uint64_t first_atom, std::size_t first_line,
                          std::size_t count) {
    lines_.seek(first_atom, first_line);
    std::optional<std::size_t> decimals;
    bool equal = true;
    for (std::size_t i = 0; i < count && read_line(); ++i) {
      const auto fields = split_fields(line_);
      for (std::size_t at = columns.position; at < std::min(columns.position + 3, fields.size()); ++at) {
        const std::size_t point = std::min(fields[at].find('.'), fields[at].size());
        const std::size_t behind = fields[at].size() - point;
        equal = equal && behind > 1 && behind == decimals.value_or(behind);
        decimals = behind;
      }
    }
    return equal;
  }

  bool is_atom_line(const XyzColumns& columns) const {
    const auto fields = split_fields(line_);
    if (fields.size() < columns.count) return false;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!parse_fortran_double(fields[columns.position + axis])) return false;
    return true;
  }

  XyzComment comment_of(std::string_view line) const {
    try {
      return read_xyz_comment(line);
    } catch (const InputError& error) {
      fail(error.what());
    }
  }

  // Returns how many numbers follow the symbol. A line that has lost one would be read one column off.
  static std::size_t numbers_after(const std::vector<std::string_view>& fields) {
    std::size_t numbers = 1;
    while (numbers < fields.size() && parse_fortran_double(fields[numbers])) ++numbers;
    return numbers - 1;
  }

  Eigen::Vector3d atom(const XyzColumns& columns, std::size_t frame, std::size_t i) {
    const auto fields = split_fields(line_);
    if (columns.named && fields.size() != columns.count)
      fail(fmt::format("expected the {} of Properties, found {}", counted(columns.count, "column"),
                       fields.size()));
    if (fields.size() < columns.count)
      fail(fmt::format("expected a symbol and 3 coordinates, found {}", counted(fields.size(), "field")));
    if (!columns.named && has_number(fields[0]))
      fail(fmt::format("expected a symbol, found {}: do columns run together?", in_quotes(fields[0])));
    if (!columns.named && (i == 0 || fields.size() > 4 || numbers_ > 3)) {
      const std::size_t numbers = numbers_after(fields);
      if (i == 0) numbers_ = numbers;
      const bool is_cut = lines_.cut() && numbers < numbers_;  // the file ends inside this line
      if (numbers >= 3 && numbers != numbers_ && !is_cut)
        fail(fmt::format("expected {} after the symbol as in the frame's first atom, found {}",
                         counted(numbers_, "number"), numbers));
    }
    Eigen::Vector3d position;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string_view field = fields[columns.position + axis];
      const auto value = parse_fortran_double(field);
      if (!value) fail(fmt::format("expected a coordinate, found {}", in_quotes(field)));
      position[static_cast<Eigen::Index>(axis)] = *value;
    }
    if (columns.species) check_same(symbols_, fields[*columns.species], "symbol", frame, i);
    if (columns.id) check_same(ids_, fields[*columns.id], "id", frame, i);
    return position;
  }

  // Returns whether the symbol contains a number, as in C-100.125, where a coordinate fills its column. Types
  // such as C.3 contain no number.
  static bool has_number(std::string_view symbol) {
    const auto is_digit = [&](std::size_t i) {
      return i < symbol.size() && symbol[i] >= '0' && symbol[i] <= '9';
    };
    const std::size_t point = symbol.find('.');
    return point != std::string_view::npos && point > 0 && is_digit(point - 1) && is_digit(point + 1);
  }

  // Keeps the fields of the first frame. Other frames must have the same fields, atom by atom.
  void check_same(std::vector<std::string>& kept, std::string_view field, const char* what, std::size_t frame,
                  std::size_t i) {
    if (!first_frame_) {
      if (kept.size() <= i) kept.resize(i + 1);
      kept[i] = field;
    } else if (i < kept.size() && kept[i] != field) {
      fail(fmt::format("frame {}: atom {} has {} {}, expected {} as in frame {}; atoms must keep their order",
                       frame, i, what, in_quotes(field), in_quotes(kept[i]), *first_frame_));
    }
  }

  LineReader lines_;
  std::string_view line_;
  std::size_t atoms_ = 0;
  FramesHeld held_;
  bool may_have_cell_ = false;
  std::size_t next_ = 0;  // frame that the next line begins
  std::optional<std::size_t> first_frame_;
  std::size_t numbers_ = 0;                 // how many follow the symbol of the frame's first atom
  std::vector<std::string> symbols_, ids_;  // the atoms' symbols and ids in the first frame
  Eigen::Matrix3Xd positions_;              // for all atoms
};

}  // namespace

bool looks_like_xyz(std::string_view start) {
  const std::string_view count = trimmed(next_line(start));
  (void)next_line(start);
  const auto fields = split_fields(next_line(start));
  if (!parse_count(count) || start.empty() || fields.size() < 4) return false;
  return std::all_of(fields.begin() + 1, fields.begin() + 4,
                     [](std::string_view field) { return parse_fortran_double(field).has_value(); });
}

std::unique_ptr<AtomFrames> open_xyz(const std::filesystem::path& path, const ReadOptions&) {
  return std::make_unique<XyzFrames>(path);
}

}  // namespace kds
