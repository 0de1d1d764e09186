#include "motions/readers/dcd_reader.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/dcd_cell.h"
#include "motions/readers/dcd_layout.h"

namespace kds {

namespace {

class DcdFile {
 public:
  explicit DcdFile(const std::filesystem::path& path)
      : file_(path.string()),
        input_(path),
        layout_(read_dcd_layout(input_)),
        cell_form_(layout_.version, layout_.title) {}

  const DcdLayout& layout() const { return layout_; }

  // Finds the form of the cells from at most 64 of these frames.
  void look_at_cells(const FramesAsked& frames) {
    constexpr std::size_t most = 64;
    if (!layout_.has_cell) return;
    const std::size_t every = (frames.count + most - 1) / most;
    for (std::size_t i = 0; i < frames.count; i += every) {
      const auto numbers = numbers_at(frames[i]);
      if (!numbers) return;
      cell_form_.look_at(*numbers);
    }
  }

  // Whether the frame has a cell that is used; reads nothing else of the frame.
  bool has_cell(std::size_t k) {
    const auto numbers = numbers_at(k);
    return numbers && cell_form_.read(*numbers).cell;
  }

  // Returns the frames of the file. If the file ends inside a frame, records that disagree with the header
  // may be the reason: then the first frame with such a record is damaged.
  FramesHeld held() {
    FramesHeld held = layout_.frames_held();
    for (std::size_t k = 0; held.ends_inside && k <= held.whole; ++k) {
      try {
        check_markers(k);
      } catch (const DamagedFrame& damage) {
        return {k, false, 0, damage};
      }
    }
    held.end = layout_.file_size;
    return held;
  }

  void load(std::size_t k) {
    bytes_.resize(layout_.frame_size(k));
    if (!input_.read_at(layout_.frame_begin(k), bytes_.data(), bytes_.size()))
      throw InputError(fmt::format("{}: frame {}: cannot read it", file_, k));
    const char* record = bytes_.data();
    records_.clear();
    for (const std::uint64_t size : record_sizes(k)) {
      const std::uint64_t offset =
          layout_.frame_begin(k) + static_cast<std::uint64_t>(record - bytes_.data());
      check_marker(k, offset, layout_.marker(record), size);
      check_marker(k, offset, layout_.marker(record + layout_.marker_size + size), size);
      records_.push_back(record + layout_.marker_size);
      record += layout_.record_size(size);
    }
  }

  // Returns the x, y or z coordinate of the i-th atom in the loaded frame.
  float coordinate(std::size_t axis, std::size_t i) const {
    return layout_.number<float>(records_[axis + (layout_.has_cell ? 1 : 0)] + 4 * i);
  }

  // Returns the cell of the loaded frame.
  CellRead cell() const { return layout_.has_cell ? cell_form_.read(cell_numbers(records_[0])) : CellRead(); }

 private:
  std::optional<DcdCellForm::Numbers> numbers_at(std::size_t k) {
    std::array<char, DcdLayout::cell_bytes> bytes;
    if (!input_.read_at(layout_.frame_begin(k) + layout_.marker_size, bytes.data(), bytes.size()))
      return std::nullopt;
    return cell_numbers(bytes.data());
  }

  DcdCellForm::Numbers cell_numbers(const char* bytes) const {
    DcdCellForm::Numbers numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = layout_.number<double>(bytes + 8 * i);
    return numbers;
  }

  std::vector<std::uint64_t> record_sizes(std::size_t k) const {
    std::vector<std::uint64_t> sizes(layout_.has_fourth ? 4 : 3, 4 * layout_.atoms_in_frame(k));
    if (layout_.has_cell) sizes.insert(sizes.begin(), DcdLayout::cell_bytes);
    return sizes;
  }

  // Checks the markers before the records of a frame, as far as the file reaches.
  void check_markers(std::size_t k) {
    std::uint64_t offset = layout_.frame_begin(k);
    for (const std::uint64_t size : record_sizes(k)) {
      std::array<char, 8> marker{};
      if (!input_.read_at(offset, marker.data(), layout_.marker_size)) return;
      check_marker(k, offset, layout_.marker(marker.data()), size);
      offset += layout_.record_size(size);
    }
  }

  void check_marker(std::size_t k, std::uint64_t offset, std::uint64_t found, std::uint64_t expected) const {
    if (found == expected) return;
    const std::uint64_t atoms = layout_.atoms_in_frame(k);
    if (expected == 4 * atoms && found % 4 == 0 && layout_.with_sign(found) >= 0)
      throw DamagedFrame(file_, k, offset,
                         fmt::format("record holds {}, expected {}", counted(found / 4, "atom"), atoms));
    throw DamagedFrame(file_, k, offset,
                       fmt::format("record holds {} bytes, expected {}", layout_.with_sign(found), expected));
  }

  std::string file_;
  InputFile input_;
  DcdLayout layout_;
  DcdCellForm cell_form_;
  std::vector<char> bytes_;
  std::vector<const char*> records_;
};

// The positions of all atoms. The positions are kept up to date if frames hold only the free atoms.
class Atoms {
 public:
  Atoms(DcdFile& dcd, const FramesHeld& held) : dcd_(dcd) {
    if (dcd_.layout().free_atoms.empty() || held.whole == 0) return;
    dcd_.load(0);
    first_.resize(3, static_cast<Eigen::Index>(dcd_.layout().atom_count));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < dcd_.layout().atom_count; ++i)
        first_(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)) = dcd_.coordinate(axis, i);
    free_index_of_.assign(dcd_.layout().atom_count, fixed);
    for (std::size_t i = 0; i < dcd_.layout().free_atoms.size(); ++i)
      free_index_of_[dcd_.layout().free_atoms[i]] = i;
  }

  void read(std::size_t k, std::span<const std::size_t> atoms, Eigen::Matrix3Xd& frame) {
    dcd_.load(k);
    frame.resize(3, static_cast<Eigen::Index>(atoms.size()));
    for (std::size_t bead = 0; bead < atoms.size(); ++bead)
      for (std::size_t axis = 0; axis < 3; ++axis)
        frame(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(bead)) =
            coordinate(k, axis, atoms[bead]);
  }

 private:
  double coordinate(std::size_t k, std::size_t axis, std::size_t atom) const {
    if (k == 0 || free_index_of_.empty()) return dcd_.coordinate(axis, atom);
    if (free_index_of_[atom] == fixed)
      return first_(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(atom));
    return dcd_.coordinate(axis, free_index_of_[atom]);
  }

  static constexpr std::size_t fixed = static_cast<std::size_t>(-1);
  DcdFile& dcd_;
  Eigen::Matrix3Xd first_;
  std::vector<std::size_t> free_index_of_;
};

class DcdFrames final : public AtomFrames {
 public:
  explicit DcdFrames(const std::filesystem::path& path)
      : dcd_(path), held_(dcd_.held()), atoms_(dcd_, held_) {
    dcd_.look_at_cells({0, 1, held_.whole});
  }

  std::size_t atom_count() const override { return dcd_.layout().atom_count; }
  FramesHeld held() const override { return held_; }
  bool may_have_cell() const override { return dcd_.layout().has_cell; }

  void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) override {
    if (!frame.asked && !dcd_.has_cell(k)) return;
    if (const auto& times = dcd_.layout().times)
      frame.stamp.picoseconds = times->first + static_cast<double>(k) * times->step;
    atoms_.read(k, atoms, frame.positions);
    CellRead cell = dcd_.cell();
    frame.cell = cell.cell;
    frame.cell_doubt = std::move(cell.doubt);
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    const DcdLayout& layout = dcd_.layout();
    if (!held_.ends_inside && !held_.damage &&
        layout.frames_claimed != static_cast<std::int64_t>(held_.whole))
      notes.push_back(
          fmt::format("the header claims {} frames, the file holds {}", layout.frames_claimed, held_.whole));
    for (const std::string& note : {layout.title_note, layout.times_note})
      if (!note.empty()) notes.push_back(note);
    return notes;
  }

 private:
  DcdFile dcd_;
  FramesHeld held_;
  Atoms atoms_;
};

}  // namespace

bool looks_like_dcd(std::string_view start) {
  for (const std::size_t marker : {4U, 8U})
    if (start.size() > marker + 4 && start.substr(marker, 4) == "CORD") return true;
  return false;
}

std::unique_ptr<AtomFrames> open_dcd(const std::filesystem::path& path, const ReadOptions&) {
  return std::make_unique<DcdFrames>(path);
}

}  // namespace kds
