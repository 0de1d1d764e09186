#pragma once
// PDB and mmCIF files, plain or gzipped; their models are the frames. The cell of a crystal is not a
// simulation box. A cell is therefore used only if the file has several models, the space group is P 1, and
// the lengths are above 1 angstrom.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/readers/read_options.h"

namespace kds {

[[nodiscard]] FramesOpened open_structure_frames(const std::filesystem::path& path,
                                                 const ReadOptions& options);

/// The atoms of a structure's first model, by their place in the file.
struct Topology {
  std::size_t atom_count = 0;         ///< with all alternate locations, waters and ligands
  std::vector<std::size_t> selected;  ///< places of the beads, in the order of the chains
  std::vector<ChainRead> chains;      ///< the chains of the beads
  std::vector<std::string> warnings;  ///< about parts left out or guessed, one line each
  std::vector<double> element_radii;  ///< one per bead; empty if elements are unknown
  std::vector<std::string> bead_names;
};

[[nodiscard]] Topology read_topology(const std::filesystem::path& path, Selection selection,
                                     const std::optional<std::string>& chain);

}  // namespace kds
