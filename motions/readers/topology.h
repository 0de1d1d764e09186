#pragma once
// The atoms of a structure or topology file. These atoms give names to the atoms of a trajectory.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"

namespace kds {

/// The atoms of a structure's first model, by their index in the file.
struct Topology {
  std::size_t atom_count = 0;         ///< with all alternate locations, waters and ligands
  std::vector<std::size_t> selected;  ///< indices of the beads, in the order of the chains
  std::vector<std::size_t> guides;    ///< indices of the guides of `bonds`
  BondPaths bonds;                    ///< along the beads
  std::vector<ChainRead> chains;      ///< the chains of the beads
  std::vector<std::string> warnings;  ///< about parts left out or guessed, one line each
  std::vector<double> element_radii;  ///< one per bead; empty if elements are unknown
  std::string element_lack;           ///< a message that says why elements are unknown, if any are
  std::vector<std::string> bead_names;
  BeadGroups bead_groups;  ///< empty if no groups are asked for
  bool chain_like = true;  ///< consecutive beads are meant to be bonded
};

/// Reads the names of the atoms that `options` select. Throws InputError naming the file if its format names
/// no atoms.
[[nodiscard]] Topology read_topology(const std::filesystem::path& path, const ReadOptions& options);

}  // namespace kds
