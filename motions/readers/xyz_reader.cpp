#include "motions/readers/xyz_reader.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/line_reader.h"
#include "motions/base/text_input.h"
#include "motions/frames/frame_selection.h"
#include "motions/readers/vdw_radii.h"

namespace kds {

namespace {

class XyzFile {
 public:
  explicit XyzFile(const std::filesystem::path& path) : lines_(path) {
    FramesHeld held;
    while (skip_frame(held)) {
    }
    held_ = held;
    rewind();
  }

  FramesHeld held() const { return held_; }

  void rewind() {
    lines_.rewind();
    next_ = 0;
  }

  // Quick where frames are asked for in their order. Symbols are read into `symbols` where given.
  void read_frame(std::size_t k, FrameRead& frame, std::vector<std::string>* symbols = nullptr) {
    if (k < next_) rewind();
    FramesHeld held{next_, false};
    for (; next_ < k; ++next_)
      if (!skip_frame(held)) fail_gone(k);
    if (!read_count() || atoms_in_frame() != atoms_ || !read_line()) fail_gone(k);
    ++next_;
    frame.stamp = {k, std::nullopt};
    frame.cell = cell_of(line_);
    check_columns(line_);
    frame.positions.resize(3, static_cast<Eigen::Index>(atoms_));
    for (Eigen::Index i = 0; i < frame.positions.cols(); ++i) {
      if (!read_line()) fail_gone(k);
      frame.positions.col(i) = atom(symbols);
    }
  }

 private:
  bool read_line() { return lines_.next(line_); }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", lines_.name(), lines_.number(), message));
  }

  [[noreturn]] void fail_gone(std::size_t k) const {
    throw InputError(fmt::format("{}: frame {}: is gone since the file was first read", lines_.name(), k));
  }

  // The line of a frame's number of atoms; false where no frame follows.
  bool read_count() {
    while (read_line())
      if (!trimmed(line_).empty()) return true;
    return false;
  }

  std::optional<std::size_t> atoms_in_frame() const {
    const auto fields = split_fields(line_);
    return fields.size() == 1 ? parse_count(fields.front()) : std::nullopt;
  }

  // Counts lines only: what they hold is looked at in the frames asked for.
  bool skip_frame(FramesHeld& held) {
    if (!read_count()) return false;
    const auto count = atoms_in_frame();
    if (!count)
      fail(fmt::format("expected the number of atoms of frame {}, found {}", held.whole, in_quotes(line_)));
    if (*count == 0) fail("expected at least 1 atom, found 0");
    if (held.whole == 0) atoms_ = *count;
    if (!skip_atoms(*count)) {
      held.ends_inside = true;
      return false;
    }
    if (*count != atoms_)
      throw InputError(fmt::format("{}: frame {}: {}, expected {} as in frame 0", lines_.name(), held.whole,
                                   counted(*count, "atom"), atoms_));
    ++held.whole;
    return true;
  }

  // Whether the frame is all there; the last line of a cut file may be cut itself.
  bool skip_atoms(std::size_t count) {
    if (!read_line()) return false;
    for (std::size_t i = 0; i < count; ++i)
      if (!read_line()) return false;
    return !lines_.cut() || is_atom_line();
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

  LineReader lines_;
  std::string_view line_;
  std::size_t atoms_ = 0;
  FramesHeld held_;
  std::size_t next_ = 0;  // frame that the next line begins
};

class XyzFrames final : public FrameReader {
 public:
  XyzFrames(XyzFile file, const FramesAsked& asked) : file_(std::move(file)), asked_(asked) {}

  bool next(FrameRead& frame) override {
    if (next_ == asked_.count) return false;
    file_.read_frame(asked_[next_++], frame);
    return true;
  }
  void rewind() override { next_ = 0; }

 private:
  XyzFile file_;
  FramesAsked asked_;
  std::size_t next_ = 0;
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

FramesOpened open_xyz(const std::filesystem::path& path, const ReadOptions& options) {
  if (options.selection == Selection::backbone || options.selection == Selection::ca)
    throw InputError(fmt::format(
        "--select: {} does not name residues; an XYZ file is read with all its atoms", path.string()));
  if (options.chain)
    throw InputError(fmt::format("--chain: {} does not name chains; an XYZ file is read with all its atoms",
                                 path.string()));
  FramesOpened opened;
  opened.file = path.string();
  XyzFile file(path);
  const FramesAsked asked = select_frames(opened.file, options.frames, file.held(), opened.warnings);
  std::vector<std::string> symbols;
  FrameRead first;
  file.read_frame(asked[0], first, &symbols);
  opened.element_radii = radii_of(symbols);
  opened.frames = std::make_unique<XyzFrames>(std::move(file), asked);
  return opened;
}

}  // namespace kds
