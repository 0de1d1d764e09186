#include "motions/readers/xyz_reader.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <fstream>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/frame_selection.h"
#include "motions/readers/vdw_radii.h"

namespace kds {

namespace {

class XyzFile {
 public:
  explicit XyzFile(const std::filesystem::path& path)
      : file_(path.string()), stream_(path, std::ios::binary) {
    std::error_code ignored;
    if (!stream_ || !std::filesystem::is_regular_file(path, ignored))
      throw InputError(fmt::format("{}: cannot open this file", file_));
    find_frames();
  }

  FramesHeld held() const { return held_; }

  // Symbols are read into `symbols` where given.
  Eigen::Matrix3Xd frame(std::size_t k, std::optional<Cell>& cell, std::vector<std::string>* symbols) {
    stream_.clear();
    stream_.seekg(starts_[k].place);
    line_number_ = starts_[k].line;
    read_line();
    read_line();
    cell = cell_of(line_);
    check_columns(line_);
    Eigen::Matrix3Xd positions(3, static_cast<Eigen::Index>(atoms_));
    for (Eigen::Index i = 0; i < positions.cols(); ++i) {
      read_line();
      positions.col(i) = atom(symbols);
    }
    return positions;
  }

 private:
  struct Start {
    std::streamoff place;
    std::size_t line;
  };

  bool read_line() {
    if (!std::getline(stream_, line_)) return false;
    ++line_number_;
    return true;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line_number_, message));
  }

  // Counts lines only: what they hold is looked at in the frames asked for.
  void find_frames() {
    for (;;) {
      const Start start{stream_.tellg(), line_number_};
      if (!read_line()) return;
      if (trimmed(line_).empty()) continue;
      const auto fields = split_fields(line_);
      const auto count = parse_count(fields.front());
      if (!count || fields.size() != 1)
        fail(
            fmt::format("expected the number of atoms of frame {}, found {}", held_.whole, in_quotes(line_)));
      if (*count == 0) fail("expected at least 1 atom, found 0");
      if (held_.whole == 0) atoms_ = *count;
      if (!skip_atoms(*count)) {
        held_.ends_inside = true;
        return;
      }
      if (*count != atoms_)
        throw InputError(fmt::format("{}: frame {}: {}, expected {} as in frame 0", file_, held_.whole,
                                     counted(*count, "atom"), atoms_));
      starts_.push_back(start);
      ++held_.whole;
    }
  }

  // Whether the frame is all there; the last line of a cut file may be cut itself.
  bool skip_atoms(std::size_t count) {
    if (!read_line()) return false;
    for (std::size_t i = 0; i < count; ++i)
      if (!read_line()) return false;
    return !stream_.eof() || is_atom_line();
  }

  bool is_atom_line() const {
    const auto fields = split_fields(line_);
    return fields.size() >= 4 && parse_double(fields[1]) && parse_double(fields[2]) &&
           parse_double(fields[3]);
  }

  Eigen::Vector3d atom(std::vector<std::string>* symbols) const {
    const auto fields = split_fields(line_);
    if (fields.size() < 4)
      fail(fmt::format("expected a symbol and 3 coordinates, found {}", counted(fields.size(), "field")));
    Eigen::Vector3d position;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto value = parse_double(fields[axis + 1]);
      if (!value) fail(fmt::format("expected a coordinate, found {}", in_quotes(fields[axis + 1])));
      position[static_cast<Eigen::Index>(axis)] = *value;
    }
    if (symbols) symbols->emplace_back(fields[0]);
    return position;
  }

  std::optional<Cell> cell_of(std::string_view comment) const {
    constexpr std::string_view key = "Lattice=\"";
    const std::size_t begin = comment.find(key);
    if (begin == std::string_view::npos) return std::nullopt;
    comment.remove_prefix(begin + key.size());
    const auto fields = split_fields(comment.substr(0, comment.find('"')));
    if (fields.size() != 9) fail(fmt::format("expected 9 numbers in Lattice, found {}", fields.size()));
    Cell cell;
    for (std::size_t i = 0; i < 9; ++i) {
      const auto value = parse_double(fields[i]);
      if (!value) fail(fmt::format("expected a number in Lattice, found {}", in_quotes(fields[i])));
      cell(static_cast<Eigen::Index>(i % 3), static_cast<Eigen::Index>(i / 3)) = *value;
    }
    if (!cell.allFinite() || !cell.inverse().allFinite() || cell.colwise().norm().minCoeff() <= 1)
      return std::nullopt;
    return cell;
  }

  // Extended XYZ may name other columns; the first four must be the plain ones.
  void check_columns(std::string_view comment) const {
    constexpr std::string_view key = "Properties=";
    const std::size_t begin = comment.find(key);
    if (begin == std::string_view::npos) return;
    comment.remove_prefix(begin + key.size());
    if (comment.starts_with('"')) comment.remove_prefix(1);
    constexpr std::string_view plain = "species:S:1:pos:R:3";
    if (!comment.starts_with(plain))
      fail(fmt::format("expected columns that begin with {}, found {}", plain, in_quotes(comment)));
  }

  std::string file_;
  std::ifstream stream_;
  std::string line_;
  std::size_t line_number_ = 0;
  std::size_t atoms_ = 0;
  std::vector<Start> starts_;
  FramesHeld held_;
};

std::vector<double> radii_of(const std::vector<std::string>& symbols) {
  std::vector<double> radii;
  for (const std::string& symbol : symbols) {
    const auto radius = van_der_waals_radius(symbol);
    if (!radius) return {};
    radii.push_back(*radius);
  }
  return radii;
}

}  // namespace

FramesRead read_xyz(const std::filesystem::path& path, const ReadOptions& options) {
  if (options.selection == Selection::backbone || options.selection == Selection::ca)
    throw InputError(fmt::format(
        "--select: {} does not name residues; an XYZ file is read with all its atoms", path.string()));
  if (options.chain)
    throw InputError(fmt::format("--chain: {} does not name chains; an XYZ file is read with all its atoms",
                                 path.string()));
  FramesRead read;
  Trajectory& trajectory = read.trajectory;
  trajectory.file = path.string();
  XyzFile xyz(path);
  trajectory.frame_numbers = select_frames(trajectory.file, options.frames, xyz.held(), trajectory.warnings);
  std::vector<std::string> symbols;
  for (const std::size_t k : trajectory.frame_numbers) {
    std::optional<Cell> cell;
    trajectory.frames.push_back(xyz.frame(k, cell, trajectory.frames.empty() ? &symbols : nullptr));
    read.cells.push_back(cell);
  }
  trajectory.element_radii = radii_of(symbols);
  return read;
}

}  // namespace kds
