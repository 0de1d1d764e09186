#include "motions/readers/pdb_reader.h"

#include <fmt/format.h>

#include <gemmi/model.hpp>
#include <iterator>
#include <utility>

#include "motions/base/file_ending.h"
#include "motions/base/input_error.h"
#include "motions/readers/frame_selection.h"
#include "motions/readers/polymer_selection.h"
#include "motions/readers/structure_models.h"

namespace kds {

namespace {

std::unique_ptr<StructureModels> open_structure(const std::filesystem::path& path) {
  std::string ending = file_ending(path);
  if (ending == ".gz") ending = file_ending(path.stem());
  return ending == ".cif" || ending == ".mmcif" ? open_mmcif(path) : open_pdb(path);
}

Eigen::Matrix3Xd positions(const std::vector<SelectedAtom>& atoms) {
  Eigen::Matrix3Xd frame(3, static_cast<Eigen::Index>(atoms.size()));
  Eigen::Index bead = 0;
  for (const SelectedAtom& selected : atoms) {
    const gemmi::Position& place = selected.atom->pos;
    frame.col(bead++) << place.x, place.y, place.z;
  }
  return frame;
}

std::vector<std::string> names_of(const std::vector<SelectedAtom>& atoms) {
  std::vector<std::string> names;
  for (const SelectedAtom& selected : atoms) names.push_back(selected.name);
  return names;
}

// All frames are frames of one necklace: the same atoms in the same order.
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

struct SelectedChains {
  std::vector<SelectedAtom> atoms;
  std::vector<ChainRead> chains;
};

SelectedChains select_chains(const std::string& place, const gemmi::Model& model, Selection selection,
                             const std::optional<std::string>& list) {
  SelectedChains selected;
  for (const std::string& chain : chains_asked_for(place, model, list)) {
    std::vector<SelectedAtom> atoms = select_polymer_atoms(place, model, selection, chain);
    selected.chains.push_back({chain, atoms.size()});
    std::move(atoms.begin(), atoms.end(), std::back_inserter(selected.atoms));
  }
  return selected;
}

// Who names chains knows the others.
std::optional<std::string> unread_chains(const std::string& file, const gemmi::Model& model,
                                         Selection selection, const std::optional<std::string>& list,
                                         const SelectedChains& selected) {
  if (list) return std::nullopt;
  return describe_unread_chains(file, model, selected.chains.front().name, selection);
}

}  // namespace

FramesRead read_structure(const std::filesystem::path& path, const ReadOptions& options) {
  const std::unique_ptr<StructureModels> models = open_structure(path);
  const FramesHeld held = models->held();
  FramesRead read;
  Trajectory& trajectory = read.trajectory;
  trajectory.file = path.string();
  trajectory.frame_numbers = select_frames(trajectory.file, options.frames, held, trajectory.warnings);
  std::vector<std::string> names;
  for (const std::size_t k : trajectory.frame_numbers) {
    const gemmi::Model model = models->model(k);
    const std::string place =
        held.whole == 1 ? trajectory.file : fmt::format("{}: frame {}", trajectory.file, k);
    SelectedChains selected = select_chains(place, model, options.selection, options.chain);
    const std::vector<SelectedAtom>& atoms = selected.atoms;
    if (trajectory.frames.empty()) {
      names = names_of(atoms);
      trajectory.element_radii = element_radii_of(atoms);
      if (auto unread = unread_chains(trajectory.file, model, options.selection, options.chain, selected))
        trajectory.warnings.push_back(std::move(*unread));
      read.chains = std::move(selected.chains);
    } else {
      check_same_atoms(trajectory.file, trajectory.frame_numbers.front(), names, k, atoms);
    }
    trajectory.frames.push_back(positions(atoms));
    read.cells.push_back(held.whole > 1 ? models->cell(k) : std::nullopt);
  }
  read.chain_like = options.selection != Selection::all;
  return read;
}

Topology read_topology(const std::filesystem::path& path, Selection selection,
                       const std::optional<std::string>& chain) {
  const gemmi::Model model = open_structure(path)->model(0);
  Topology topology;
  for (const gemmi::Chain& part : model.chains)
    for (const gemmi::Residue& residue : part.residues) topology.atom_count += residue.atoms.size();
  SelectedChains selected = select_chains(path.string(), model, selection, chain);
  for (const SelectedAtom& atom : selected.atoms)
    topology.selected.push_back(static_cast<std::size_t>(atom.atom->serial));
  topology.element_radii = element_radii_of(selected.atoms);
  topology.unread = unread_chains(path.string(), model, selection, chain, selected);
  topology.chains = std::move(selected.chains);
  return topology;
}

}  // namespace kds
