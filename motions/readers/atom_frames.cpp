#include "motions/readers/atom_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/topology.h"

namespace kds {

namespace {

// The atoms that are beads or guides, and what is known of them.
struct ChosenAtoms {
  std::vector<std::size_t> indices;  // the beads, then the guides
  std::size_t bead_count = 0;
  BondPaths bonds;
  std::vector<double> element_radii;
  std::string element_lack;
  std::vector<std::string> names;
  BeadGroups groups;
  std::vector<ChainRead> chains;
  bool chain_like = true;
};

InputError needs_names(const char* option, const std::string& file, const char* what) {
  return InputError(option, fmt::format("{} does not name its {}; give a file that does with {} ({})", file,
                                        what, "--topology"_arg, reader_registry().topology_endings()));
}

// Whether the ids are those from 1 to the number of atoms, in any order.
bool number_all(std::vector<std::size_t> ids) {
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < ids.size(); ++i)
    if (ids[i] != i + 1) return false;
  return true;
}

// Returns the index in the file of each selected atom, whose id is one more than its index in the topology.
// Returns nothing, and the first missing bead, if the file does not have all these ids.
std::optional<std::vector<std::size_t>> indices_by_id(const std::vector<std::size_t>& ids,
                                                      const std::vector<std::size_t>& selected,
                                                      std::size_t& missing) {
  std::unordered_map<std::size_t, std::size_t> index_of;
  for (std::size_t index = 0; index < ids.size(); ++index) index_of.emplace(ids[index], index);
  std::vector<std::size_t> indices;
  for (const std::size_t atom : selected) {
    const auto found = index_of.find(atom + 1);
    missing = indices.size();
    if (found == index_of.end()) return std::nullopt;
    indices.push_back(found->second);
  }
  return indices;
}

// Warns if elements of the file contradict those of the topology, unless the file's elements are guessed.
void compare_elements(const std::string& file, const std::string& topology, const AtomFrames& frames,
                      const ChosenAtoms& chosen, std::vector<std::string>& warnings) {
  std::vector<std::string> guesses;
  const std::vector<double> radii = frames.element_radii(guesses);
  const bool all_known = std::none_of(radii.begin(), radii.end(), [](double r) { return std::isnan(r); });
  if (radii.empty() || !all_known || !guesses.empty() || chosen.element_radii.empty()) return;
  std::size_t differ = 0, first = 0;
  for (std::size_t bead = chosen.bead_count; bead-- > 0;) {
    if (radii[chosen.indices[bead]] == chosen.element_radii[bead]) continue;
    ++differ;
    first = bead;
  }
  if (differ == 0) return;
  warnings.push_back(fmt::format(
      "{}: bead {} ({}) has another element than in {} (radius {}, not {}), which is used; do atoms have "
      "the same order? ({})",
      file, first, chosen.names.empty() ? "without a name" : chosen.names[first], topology,
      radii[chosen.indices[first]], chosen.element_radii[first], counted(differ, "bead")));
}

// Begins a piece at each bead that follows guides, for a file without these atoms.
BondPaths without_guides(const BondPaths& bonds) {
  BondPaths cut;
  auto guide = bonds.guides_before.begin();
  for (auto piece = bonds.pieces.begin(); piece != bonds.pieces.end(); ++piece) {
    cut.pieces.push_back(*piece);
    const auto next = std::next(piece);
    for (; guide != bonds.guides_before.end() && (next == bonds.pieces.end() || *guide < next->first);
         ++guide)
      if (cut.pieces.back().first != *guide) cut.pieces.push_back({*guide, false});
  }
  return cut;
}

// Chooses among all atoms by the topology. A topology of the selected atoms alone suits a trajectory of
// these. Ids decide which atoms these are, if the file has ids.
ChosenAtoms choose_atoms(const std::string& file, const ReadOptions& options, const AtomFrames& frames,
                         std::vector<std::string>& warnings) {
  const std::size_t atom_count = frames.atom_count();
  ChosenAtoms chosen;
  chosen.indices.resize(atom_count);
  std::iota(chosen.indices.begin(), chosen.indices.end(), std::size_t{0});
  chosen.bead_count = atom_count;
  require_names(file, options);
  if (!options.topology) return chosen;
  Topology topology = read_topology(*options.topology, options);
  const bool has_all = topology.atom_count == atom_count;
  if (!has_all && topology.selected.size() != atom_count)
    throw InputError(fmt::format("{}: {} a frame, but {} names {} ({} of them selected)", file,
                                 counted(atom_count, "atom"), options.topology->string(), topology.atom_count,
                                 topology.selected.size()));
  const std::vector<std::size_t> ids = frames.ids();
  const std::size_t bead_count = topology.selected.size();
  std::vector<std::size_t> wanted = topology.selected;  // the beads and, if the file has them, the guides
  if (has_all) wanted.insert(wanted.end(), topology.guides.begin(), topology.guides.end());
  std::size_t missing = 0;
  const bool by_id = !ids.empty() && (!has_all || number_all(ids));
  if (const auto indices = by_id ? indices_by_id(ids, wanted, missing) : std::nullopt)
    chosen.indices = *indices;
  else if (has_all)
    chosen.indices = wanted;
  else if (!ids.empty())
    throw InputError(fmt::format(
        "{}: expected the {} selected from {}, found no atom with the id {} (bead {}, {}); {} with a file of "
        "the {} alone names them in their order",
        file, counted(atom_count, "atom"), options.topology->string(), topology.selected[missing] + 1,
        missing, topology.bead_names[missing], "--topology"_arg, counted(atom_count, "atom")));
  chosen.bead_count = bead_count;
  chosen.bonds = has_all ? std::move(topology.bonds) : without_guides(topology.bonds);
  if (has_all) warnings.insert(warnings.end(), topology.warnings.begin(), topology.warnings.end());
  chosen.element_radii = std::move(topology.element_radii);
  chosen.element_lack = std::move(topology.element_lack);
  chosen.names = std::move(topology.bead_names);
  chosen.groups = std::move(topology.bead_groups);
  chosen.chains = std::move(topology.chains);
  chosen.chain_like = topology.chain_like;
  compare_elements(file, options.topology->string(), frames, chosen, warnings);
  return chosen;
}

// Takes the elements that the file itself names for the beads.
void take_own_elements(const AtomFrames& frames, const ChosenAtoms& atoms, FramesOpened& opened) {
  const std::vector<double> radii = frames.element_radii(opened.warnings);
  for (std::size_t i = 0; i < atoms.bead_count; ++i) {
    if (!radii.empty() && !std::isnan(radii[atoms.indices[i]])) {
      opened.element_radii.push_back(radii[atoms.indices[i]]);
      continue;
    }
    opened.element_radii.clear();
    if (opened.element_lack.empty())
      opened.element_lack = radii.empty()
                                ? fmt::format("{} names no elements, which a file given by {} may do",
                                              opened.file, "--topology"_arg)
                                : fmt::format("{} does not tell the element of atom {} (bead {})",
                                              opened.file, atoms.indices[i], i);
    return;
  }
}

class ChosenFrames final : public FrameReader {
 public:
  ChosenFrames(std::unique_ptr<AtomFrames> frames, std::vector<std::size_t> atoms, const FramesAsked& asked)
      : frames_(std::move(frames)), atoms_(std::move(atoms)), walk_(asked, frames_->may_have_cell()) {
    frames_->choose(atoms_);
  }

  bool next(FrameRead& frame) override {
    if (!walk_.next() || !frames_->wait_for(walk_.frame())) {
      frames_->close();
      return false;
    }
    frame.asked = walk_.is_asked();
    frame.stamp = {walk_.frame(), std::nullopt};
    frame.cell.reset();
    frames_->read(walk_.frame(), atoms_, frame);
    return true;
  }
  void rewind() override { walk_.rewind(); }

  void close() override { frames_->close(); }
  [[nodiscard]] std::vector<std::string> closing_notes() const override { return frames_->closing_notes(); }
  [[nodiscard]] bool is_cut() const override { return frames_->is_cut(); }
  [[nodiscard]] std::optional<LiveState> live() const override { return frames_->live(); }

 private:
  std::unique_ptr<AtomFrames> frames_;
  std::vector<std::size_t> atoms_;
  FrameWalk walk_;
};

}  // namespace

void require_names(const std::string& file, const ReadOptions& options) {
  if (options.topology) return;
  if (options.selection.needs_names()) throw needs_names("--select", file, "atoms");
  if (options.chain) throw needs_names("--chain", file, "chains");
  if (std::any_of(options.groups.begin(), options.groups.end(),
                  [](const Selection& group) { return group.needs_names(); }))
    throw needs_names("--groups", file, "atoms");
}

FramesOpened open_atom_frames(const std::filesystem::path& path, const ReadOptions& options,
                              std::unique_ptr<AtomFrames> frames) {
  FramesOpened opened;
  opened.file = path.string();
  const FramesHeld held = frames->held();
  const FramesAsked asked =
      select_frames(opened.file, options.frames, held, options.until_damage, opened.warnings);
  opened.truncated = asked.truncated;
  opened.at_rest = asked.at_rest;
  for (const std::string& note : frames->notes())
    opened.warnings.push_back(fmt::format("{}: {}", opened.file, note));
  opened.live = held.open;
  FrameRead first;
  if (!opened.live) frames->read(asked[0], {}, first);
  ChosenAtoms atoms = choose_atoms(opened.file, options, *frames, opened.warnings);
  opened.element_radii = std::move(atoms.element_radii);
  opened.element_lack = std::move(atoms.element_lack);
  if (opened.element_radii.empty()) take_own_elements(*frames, atoms, opened);
  opened.bonds = std::move(atoms.bonds);
  opened.bead_names = std::move(atoms.names);
  opened.bead_groups = std::move(atoms.groups);
  opened.chains = std::move(atoms.chains);
  opened.chain_like = atoms.chain_like;
  opened.frames = std::make_unique<ChosenFrames>(std::move(frames), std::move(atoms.indices), asked);
  return opened;
}

}  // namespace kds
