#pragma once
// PDB and mmCIF files, plain or gzipped: their models are the frames. Cells of crystals are no simulation
// boxes: a cell counts where a file has several models, its space group is P 1 and its lengths are above 1
// angstrom.

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
  std::vector<std::size_t> selected;  ///< places of the beads, in chain order
  std::vector<ChainRead> chains;      ///< that they belong to
  std::vector<std::string> warnings;  ///< on what is left out or guessed, one line each
  std::vector<double> element_radii;  ///< of the beads; empty where elements are unknown
  std::vector<std::string> bead_names;
};

[[nodiscard]] Topology read_topology(const std::filesystem::path& path, Selection selection,
                                     const std::optional<std::string>& chain);

}  // namespace kds
