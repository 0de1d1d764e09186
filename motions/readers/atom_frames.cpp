#include "motions/readers/atom_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/topology.h"

namespace kds {

namespace {

// The atoms that are beads, and what is known of them.
struct ChosenAtoms {
  std::vector<std::size_t> places;
  std::vector<double> element_radii;
  std::vector<std::string> names;
  BeadGroups groups;
  std::vector<ChainRead> chains;
  bool chain_like = true;
};

InputError needs_names(const char* option, const std::string& file, const char* what) {
  return InputError(fmt::format("{}: {} does not name its {}; give a file that does with --topology ({})",
                                option, file, what, reader_registry().topology_endings()));
}

// Chooses among all atoms by the topology. A topology of the selected atoms alone suits a trajectory of
// these.
ChosenAtoms choose_atoms(const std::string& file, const ReadOptions& options, std::size_t atom_count,
                         std::vector<std::string>& warnings) {
  ChosenAtoms chosen;
  chosen.places.resize(atom_count);
  std::iota(chosen.places.begin(), chosen.places.end(), std::size_t{0});
  if (!options.topology) {
    if (options.selection.needs_names()) throw needs_names("--select", file, "atoms");
    if (options.chain) throw needs_names("--chain", file, "chains");
    if (std::any_of(options.groups.begin(), options.groups.end(),
                    [](const Selection& group) { return group.needs_names(); }))
      throw needs_names("--groups", file, "atoms");
    return chosen;
  }
  Topology topology = read_topology(*options.topology, options);
  if (topology.atom_count == atom_count) {
    chosen.places = std::move(topology.selected);
    warnings.insert(warnings.end(), topology.warnings.begin(), topology.warnings.end());
  } else if (topology.selected.size() != atom_count) {
    throw InputError(fmt::format("{}: {} a frame, but {} names {} ({} of them selected)", file,
                                 counted(atom_count, "atom"), options.topology->string(), topology.atom_count,
                                 topology.selected.size()));
  }
  chosen.element_radii = std::move(topology.element_radii);
  chosen.names = std::move(topology.bead_names);
  chosen.groups = std::move(topology.bead_groups);
  chosen.chains = std::move(topology.chains);
  chosen.chain_like = topology.chain_like;
  return chosen;
}

class ChosenFrames final : public FrameReader {
 public:
  ChosenFrames(std::unique_ptr<AtomFrames> frames, std::vector<std::size_t> atoms, const FramesAsked& asked)
      : frames_(std::move(frames)), atoms_(std::move(atoms)), walk_(asked, frames_->may_have_cell()) {}

  bool next(FrameRead& frame) override {
    if (!walk_.next()) return false;
    frame.asked = walk_.is_asked();
    frame.stamp = {walk_.frame(), std::nullopt};
    frame.cell.reset();
    frames_->read(walk_.frame(), atoms_, frame);
    return true;
  }
  void rewind() override { walk_.rewind(); }

 private:
  std::unique_ptr<AtomFrames> frames_;
  std::vector<std::size_t> atoms_;
  FrameWalk walk_;
};

}  // namespace

FramesOpened open_atom_frames(const std::filesystem::path& path, const ReadOptions& options,
                              std::unique_ptr<AtomFrames> frames) {
  FramesOpened opened;
  opened.file = path.string();
  const FramesHeld held = frames->held();
  const FramesAsked asked =
      select_frames(opened.file, options.frames, held, options.until_damage, opened.warnings);
  opened.truncated = asked.truncated;
  for (const std::string& note : frames->notes())
    opened.warnings.push_back(fmt::format("{}: {}", opened.file, note));
  ChosenAtoms atoms = choose_atoms(opened.file, options, frames->atom_count(), opened.warnings);
  opened.element_radii = std::move(atoms.element_radii);
  if (opened.element_radii.empty()) {
    FrameRead first;
    frames->read(asked[0], {}, first);
    const std::vector<double> radii = frames->element_radii(opened.warnings);
    for (std::size_t i = 0; i < atoms.places.size() && !radii.empty(); ++i)
      opened.element_radii.push_back(radii[atoms.places[i]]);
  }
  opened.bead_names = std::move(atoms.names);
  opened.bead_groups = std::move(atoms.groups);
  opened.chains = std::move(atoms.chains);
  opened.chain_like = atoms.chain_like;
  opened.frames = std::make_unique<ChosenFrames>(std::move(frames), std::move(atoms.places), asked);
  return opened;
}

}  // namespace kds
