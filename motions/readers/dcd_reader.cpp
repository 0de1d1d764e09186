#include "motions/readers/dcd_reader.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/base/text_input.h"
#include "motions/readers/dcd_cell.h"
#include "motions/readers/dcd_layout.h"
#include "motions/readers/pdb_reader.h"

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

  // Tells the form of the cells from at most 64 of these frames.
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

  // Where records disagree with the header, a file ends where no frame does: tell of the first such record.
  void check_all_markers() {
    for (std::size_t k = 0; layout_.frame_begin(k) < layout_.file_size; ++k) {
      std::uint64_t place = layout_.frame_begin(k);
      for (const std::uint64_t size : record_sizes(k)) {
        if (place + layout_.marker_size > layout_.file_size) return;
        std::array<char, 8> marker{};
        if (!read_at(input_, place, marker.data(), layout_.marker_size)) return;
        check_marker(k, layout_.marker(marker.data()), size);
        place += layout_.record_size(size);
      }
    }
  }

  // Checks the frame's layout before memory is allocated according to the header.
  void check_markers(std::size_t k) {
    std::uint64_t place = layout_.frame_begin(k);
    for (const std::uint64_t size : record_sizes(k)) {
      std::array<char, 8> marker{};
      if (!read_at(input_, place, marker.data(), layout_.marker_size))
        throw InputError(fmt::format("{}: frame {}: cannot read it", file_, k));
      check_marker(k, layout_.marker(marker.data()), size);
      place += layout_.record_size(size);
    }
  }

  void load(std::size_t k) {
    bytes_.resize(layout_.frame_size(k));
    if (!read_at(input_, layout_.frame_begin(k), bytes_.data(), bytes_.size()))
      throw InputError(fmt::format("{}: frame {}: cannot read it", file_, k));
    const char* record = bytes_.data();
    records_.clear();
    for (const std::uint64_t size : record_sizes(k)) {
      check_marker(k, layout_.marker(record), size);
      check_marker(k, layout_.marker(record + layout_.marker_size + size), size);
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
    if (!read_at(input_, layout_.frame_begin(k) + layout_.marker_size, bytes.data(), bytes.size()))
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

  void check_marker(std::size_t k, std::uint64_t found, std::uint64_t expected) const {
    if (found == expected) return;
    const std::uint64_t atoms = layout_.atoms_in_frame(k);
    if (expected == 4 * atoms && found % 4 == 0)
      throw InputError(fmt::format("{}: frame {}: record holds {}, expected {}", file_, k,
                                   counted(found / 4, "atom"), atoms));
    throw InputError(fmt::format("{}: frame {}: record holds {}, expected {}", file_, k,
                                 counted(found, "byte"), expected));
  }

  std::string file_;
  InputFile input_;
  DcdLayout layout_;
  DcdCellForm cell_form_;
  std::vector<char> bytes_;
  std::vector<const char*> records_;
};

// The atoms of the DCD that are beads, and their radii.
struct Beads {
  std::vector<std::size_t> atoms;
  std::vector<double> element_radii;
  std::vector<std::string> names;
  std::vector<ChainRead> chains;
  std::vector<std::string> warnings;  ///< about the topology
};

Beads all_beads(std::uint64_t atom_count) {
  Beads beads;
  beads.atoms.resize(atom_count);
  std::iota(beads.atoms.begin(), beads.atoms.end(), std::size_t{0});
  return beads;
}

Beads choose_beads(const std::string& file, const ReadOptions& options, std::uint64_t atom_count) {
  if (!options.topology) {
    if (options.selection == Selection::backbone || options.selection == Selection::ca)
      throw InputError(
          fmt::format("--select: {} does not name its atoms; give the PDB or mmCIF file that does with "
                      "--topology",
                      file));
    if (options.chain)
      throw InputError(
          fmt::format("--chain: {} does not name its chains; give the PDB or mmCIF file that does with "
                      "--topology",
                      file));
    return all_beads(atom_count);
  }
  Topology topology = read_topology(*options.topology, options.selection, options.chain);
  Beads beads;
  if (topology.atom_count == atom_count) {
    beads.atoms = std::move(topology.selected);
    beads.warnings = std::move(topology.warnings);
  } else if (topology.selected.size() == atom_count) {
    beads = all_beads(atom_count);
  } else {
    throw InputError(fmt::format("{}: {} a frame, but {} names {} ({} of them selected)", file,
                                 counted(atom_count, "atom"), options.topology->string(), topology.atom_count,
                                 topology.selected.size()));
  }
  beads.element_radii = std::move(topology.element_radii);
  beads.names = std::move(topology.bead_names);
  beads.chains = std::move(topology.chains);
  return beads;
}

// The positions of all atoms. They are kept up to date if frames hold only the free atoms.
class Atoms {
 public:
  explicit Atoms(DcdFile& dcd) : dcd_(dcd) {
    if (dcd_.layout().free_atoms.empty()) return;
    dcd_.load(0);
    first_.resize(3, static_cast<Eigen::Index>(dcd_.layout().atom_count));
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < dcd_.layout().atom_count; ++i)
        first_(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)) = dcd_.coordinate(axis, i);
    place_of_.assign(dcd_.layout().atom_count, fixed);
    for (std::size_t i = 0; i < dcd_.layout().free_atoms.size(); ++i)
      place_of_[dcd_.layout().free_atoms[i]] = i;
  }

  void read_beads(std::size_t k, const std::vector<std::size_t>& atoms, Eigen::Matrix3Xd& frame) {
    dcd_.load(k);
    frame.resize(3, static_cast<Eigen::Index>(atoms.size()));
    for (std::size_t bead = 0; bead < atoms.size(); ++bead)
      for (std::size_t axis = 0; axis < 3; ++axis)
        frame(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(bead)) =
            coordinate(k, axis, atoms[bead]);
  }

 private:
  double coordinate(std::size_t k, std::size_t axis, std::size_t atom) const {
    if (k == 0 || place_of_.empty()) return dcd_.coordinate(axis, atom);
    if (place_of_[atom] == fixed)
      return first_(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(atom));
    return dcd_.coordinate(axis, place_of_[atom]);
  }

  static constexpr std::size_t fixed = static_cast<std::size_t>(-1);
  DcdFile& dcd_;
  Eigen::Matrix3Xd first_;
  std::vector<std::size_t> place_of_;
};

class DcdFrames final : public FrameReader {
 public:
  DcdFrames(std::unique_ptr<DcdFile> dcd, std::vector<std::size_t> beads, const FramesAsked& asked)
      : dcd_(std::move(dcd)),
        atoms_(*dcd_),
        beads_(std::move(beads)),
        walk_(asked, dcd_->layout().has_cell) {}

  bool next(FrameRead& frame) override {
    if (!walk_.next()) return false;
    const std::size_t k = walk_.frame();
    frame.asked = walk_.is_asked();
    if (!frame.asked && !dcd_->has_cell(k)) {
      frame.cell.reset();
      return true;
    }
    frame.stamp = {k, std::nullopt};
    if (const auto& times = dcd_->layout().times)
      frame.stamp.picoseconds = times->first + static_cast<double>(k) * times->step;
    atoms_.read_beads(k, beads_, frame.positions);
    CellRead cell = dcd_->cell();
    frame.cell = cell.cell;
    frame.cell_doubt = std::move(cell.doubt);
    return true;
  }

  void rewind() override { walk_.rewind(); }

 private:
  std::unique_ptr<DcdFile> dcd_;
  Atoms atoms_;
  std::vector<std::size_t> beads_;
  FrameWalk walk_;
};

void warn_of_false_count(const DcdLayout& layout, const FramesHeld& held, FramesOpened& opened) {
  if (held.ends_inside || layout.frames_claimed == static_cast<std::int64_t>(held.whole)) return;
  opened.warnings.push_back(fmt::format("{}: the header claims {} frames, the file holds {}", opened.file,
                                        layout.frames_claimed, held.whole));
}

}  // namespace

FramesOpened open_dcd(const std::filesystem::path& path, const ReadOptions& options) {
  FramesOpened opened;
  opened.file = path.string();
  auto dcd = std::make_unique<DcdFile>(path);
  const DcdLayout& layout = dcd->layout();
  const FramesHeld held = layout.frames_held();
  if (held.ends_inside && (!options.frames.last || *options.frames.last > held.whole))
    dcd->check_all_markers();
  const FramesAsked asked = select_frames(opened.file, options.frames, held, opened.warnings);
  warn_of_false_count(layout, held, opened);
  dcd->check_markers(asked[0]);
  dcd->look_at_cells({0, 1, held.whole});
  if (!layout.times_note.empty()) opened.warnings.push_back(layout.times_note);

  Beads beads = choose_beads(opened.file, options, layout.atom_count);
  opened.element_radii = std::move(beads.element_radii);
  opened.bead_names = std::move(beads.names);
  for (std::string& warning : beads.warnings) opened.warnings.push_back(std::move(warning));
  opened.chains = std::move(beads.chains);
  opened.chain_like = !options.topology || options.selection != Selection::all;
  opened.frames = std::make_unique<DcdFrames>(std::move(dcd), std::move(beads.atoms), asked);
  return opened;
}

}  // namespace kds
