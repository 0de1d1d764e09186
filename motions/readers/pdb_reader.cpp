#include "motions/readers/pdb_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/frames/frame_selection.h"
#include "motions/readers/polymer_selection.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

// Reads only the first model. The models of a biological assembly (.pdb1, .pdb2) are copies at different
// places, not frames.
class FirstModel : public StructureModels {
 public:
  explicit FirstModel(std::unique_ptr<StructureModels> models) : models_(std::move(models)) {}

  FramesHeld held() const override { return {1}; }
  StructureModel model(std::size_t k) override { return models_->model(k); }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes = models_->notes();
    notes.push_back(
        fmt::format("a biological assembly: its {} are copies side by side, not frames; only the first is "
                    "read (ending .pdb reads frames)",
                    counted(models_->held().whole, "model")));
    return notes;
  }

 private:
  std::unique_ptr<StructureModels> models_;
};

// Opens the models of a file, or the first one of a biological assembly.
std::unique_ptr<StructureModels> open_frames(const std::filesystem::path& path, OpenModels open) {
  std::unique_ptr<StructureModels> models = open(path);
  const std::string ending = file_ending(file_ending(path) == ".gz" ? path.stem() : path);
  const FramesHeld held = models->held();
  if (!is_assembly_ending(ending) || held.whole + (held.ends_inside ? 1 : 0) == 1) return models;
  return std::make_unique<FirstModel>(std::move(models));
}

void warn(const std::string& file, const std::vector<std::string>& notes,
          std::vector<std::string>& warnings) {
  for (const std::string& note : notes) warnings.push_back(fmt::format("{}: {}", file, note));
}

// Returns the positions of the beads, then those of `guide_count` guides.
Eigen::Matrix3Xd positions(const SelectedChains& selected, std::size_t guide_count) {
  const std::size_t beads = selected.atoms.size();
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(beads + guide_count));
  for (std::size_t i = 0; i < beads + std::min(guide_count, selected.guides.size()); ++i)
    frame.col(static_cast<Eigen::Index>(i)) =
        (i < beads ? selected.atoms[i] : selected.guides[i - beads]).atom->position;
  return frame;
}

// Returns nothing if there are no groups.
BeadGroups groups_of(const std::vector<SelectedAtom>& atoms, const std::vector<Selection>& groups) {
  BeadGroups of_atoms;
  for (const SelectedAtom& selected : atoms)
    if (!groups.empty()) of_atoms.push_back(selected.groups);
  return of_atoms;
}

std::vector<std::string> names_of(const std::vector<SelectedAtom>& atoms) {
  std::vector<std::string> names;
  for (const SelectedAtom& selected : atoms) names.push_back(selected.name);
  return names;
}

// Throws unless this frame has the same atoms in the same order as the first frame: all frames belong to one
// necklace.
void check_same_atoms(const std::string& file, std::size_t first_frame,
                      const std::vector<std::string>& expected, std::size_t frame,
                      const std::vector<SelectedAtom>& atoms) {
  for (std::size_t i = 0; i < std::min(expected.size(), atoms.size()); ++i)
    if (atoms[i].name != expected[i])
      throw InputError(fmt::format("{}: frame {}: bead {} is {}, in frame {} it is {}", file, frame, i,
                                   atoms[i].name, first_frame, expected[i]));
  if (atoms.size() != expected.size())
    throw InputError(fmt::format("{}: frame {}: {} beads, expected {} as in frame {}", file, frame,
                                 atoms.size(), expected.size(), first_frame));
}

class StructureFrames final : public FrameReader {
 public:
  StructureFrames(std::string file, std::unique_ptr<StructureModels> models, const ReadOptions& options,
                  const FramesAsked& asked)
      : file_(std::move(file)),
        models_(std::move(models)),
        selection_(options.selection),
        chain_(options.chain),
        groups_(options.groups),
        asked_(asked),
        alone_(models_->held().whole == 1),
        ignores_cell_(alone_ && models_->lone_cell_is_crystal()),
        walk_(asked, !ignores_cell_ && models_->may_have_cell()) {}

  // Describes what the first frame determines for all frames.
  void describe(FramesOpened& opened) {
    const StructureModel model = models_->model(asked_[0]);
    SelectedChains selected = select_chains(name_of(asked_[0]), model, selection_, chain_, groups_);
    names_ = names_of(selected.atoms);
    guide_names_ = names_of(selected.guides);
    opened.bonds = std::move(selected.bonds);
    opened.element_radii = element_radii_of(file_, selected.atoms, opened.element_lack);
    opened.bead_names = names_;
    opened.bead_groups = groups_of(selected.atoms, groups_);
    opened.chain_like = selected.chain_like;
    warn(file_, models_->notes(), opened.warnings);
    warn(file_, model.notes, opened.warnings);
    warn(file_, selected.notes, opened.warnings);
    opened.chains = std::move(selected.chains);
  }

  bool next(FrameRead& frame) override {
    if (!walk_.next()) return false;
    const std::size_t k = walk_.frame();
    frame.asked = walk_.is_asked();
    const StructureModel read = models_->model(k);
    const SelectedChains selected = select_chains(name_of(k), read, selection_, chain_);
    check_same_atoms(file_, asked_[0], names_, k, selected.atoms);
    frame.stamp = {k, read.picoseconds};
    frame.positions = positions(selected, guide_names_.size());
    frame.cell = ignores_cell_ ? std::nullopt : read.cell.cell;
    frame.cell_doubt = ignores_cell_ ? std::string() : read.cell.doubt;
    if (frame.cell && names_of(selected.guides) != guide_names_)
      throw InputError(
          fmt::format("{}: frame {}: the residues that {} leaves out are not those of frame {}, so the chain "
                      "cannot be made whole across the periodic cell; {} ca reads all residues",
                      file_, k, "--select"_arg, asked_[0], "--select"_arg));
    return true;
  }

  void rewind() override { walk_.rewind(); }

 private:
  std::string name_of(std::size_t k) const { return alone_ ? file_ : fmt::format("{}: frame {}", file_, k); }

  std::string file_;
  std::unique_ptr<StructureModels> models_;
  Selection selection_;
  std::optional<std::string> chain_;
  std::vector<Selection> groups_;
  FramesAsked asked_;
  bool alone_;
  bool ignores_cell_;
  FrameWalk walk_;
  std::vector<std::string> names_, guide_names_;  // beads and guides in the first frame
};

FramesOpened open_models(const std::filesystem::path& path, const ReadOptions& options, OpenModels open) {
  FramesOpened opened;
  opened.file = path.string();
  std::unique_ptr<StructureModels> models = open_frames(path, open);
  const FramesHeld held = models->held();
  const FramesAsked asked =
      select_frames(opened.file, options.frames, held, options.until_damage, opened.warnings);
  opened.truncated = asked.truncated;
  opened.at_rest = asked.at_rest;
  auto frames = std::make_unique<StructureFrames>(opened.file, std::move(models), options, asked);
  frames->describe(opened);
  opened.frames = std::move(frames);
  return opened;
}

Topology topology_of(const std::filesystem::path& path, const ReadOptions& options, OpenModels open) {
  const std::unique_ptr<StructureModels> models = open_frames(path, open);
  const StructureModel model = models->model(0);
  Topology topology;
  topology.atom_count = model.atom_count;
  SelectedChains selected =
      select_chains(path.string(), model, options.selection, options.chain, options.groups);
  for (const SelectedAtom& atom : selected.atoms) topology.selected.push_back(atom.atom->index);
  for (const SelectedAtom& guide : selected.guides) topology.guides.push_back(guide.atom->index);
  topology.bonds = std::move(selected.bonds);
  topology.element_radii = element_radii_of(path.string(), selected.atoms, topology.element_lack);
  topology.bead_names = names_of(selected.atoms);
  topology.bead_groups = groups_of(selected.atoms, options.groups);
  warn(path.string(), models->notes(), topology.warnings);
  warn(path.string(), model.notes, topology.warnings);
  warn(path.string(), selected.notes, topology.warnings);
  topology.chains = std::move(selected.chains);
  topology.chain_like = selected.chain_like;
  return topology;
}

}  // namespace

ReaderSpec topology_format(std::string name, std::vector<std::string> endings,
                           std::function<bool(std::string_view)> recognises, OpenModels open) {
  ReaderSpec spec{std::move(name), std::move(endings)};
  spec.recognises = std::move(recognises);
  spec.topology = [open](const std::filesystem::path& path, const ReadOptions& options) {
    return topology_of(path, options, open);
  };
  return spec;
}

ReaderSpec structure_format(std::string name, std::vector<std::string> endings,
                            std::function<bool(std::string_view)> recognises, OpenModels open) {
  ReaderSpec spec = topology_format(std::move(name), std::move(endings), std::move(recognises), open);
  spec.open = [open](const std::filesystem::path& path, const ReadOptions& options) {
    return open_models(path, options, open);
  };
  return spec;
}

bool looks_like_pdb(std::string_view start) {
  std::string_view line;
  do line = next_line(start);
  while (!start.empty() && trimmed(line).empty());
  constexpr std::array<std::string_view, 16> records{
      "HEADER", "OBSLTE", "TITLE ", "SPLIT ", "CAVEAT", "COMPND", "SOURCE", "KEYWDS",
      "EXPDTA", "AUTHOR", "REVDAT", "REMARK", "CRYST1", "MODEL ", "ATOM  ", "HETATM"};
  return std::any_of(records.begin(), records.end(),
                     [&](std::string_view record) { return line.starts_with(record); });
}

bool looks_like_mmcif(std::string_view start) {
  std::string_view line;
  do line = trimmed(next_line(start));
  while (!start.empty() && (line.empty() || line.starts_with('#')));
  constexpr std::string_view data = "data_";
  return line.size() >= data.size() &&
         std::equal(data.begin(), data.end(), line.begin(),
                    [](char small, char c) { return c == small || c == small - 'a' + 'A'; });
}

}  // namespace kds
