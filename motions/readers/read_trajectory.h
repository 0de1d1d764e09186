#pragma once
// Reads necklaces, one unless several chains are asked for: the format is told by the file's ending (.pdb
// .ent .cif .mmcif [.gz], .dcd, .xyz).

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/readers/trajectory.h"

namespace kds {

/// 0-based frames first, first+stride, ... below last.
struct FrameRange {
  std::size_t first = 0;
  std::optional<std::size_t> last = {};  ///< excluded; none: to the end
  std::size_t stride = 1;                ///< at least 1
};

enum class Selection {
  automatic,  ///< backbone where residues are known (CA where none has N and C), else all
  backbone,   ///< N, CA, C of each residue that has all three
  ca,
  all,
};
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 4> selection_names{"automatic", "backbone", "ca", "all"};
[[nodiscard]] constexpr std::string_view name_of(Selection selection) {
  return selection_names[static_cast<std::size_t>(selection)];
}

struct ReadOptions {
  std::optional<std::filesystem::path> topology = {};  ///< PDB or mmCIF that names the atoms of a DCD
  Selection selection = Selection::automatic;
  std::optional<std::string> chain = {};  ///< or several between commas; none: the first polymer chain
  FrameRange frames = {};
};

/// From the text of --frames, FIRST:LAST:STRIDE; parts may be left empty (":100", "10:", "::2"), a lone
/// number has no meaning. Throws InputError naming the option.
[[nodiscard]] FrameRange parse_frame_range(std::string_view text);

/// The beads are made whole where the file gives a periodic cell, and chain breaks are looked for where
/// consecutive beads are meant to be bonded (not for `all` atoms of known residues). Throws InputError naming
/// the file and, where it applies, the frame, bead or option at fault.
[[nodiscard]] Trajectory read_trajectory(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for as many chains as `options` name, a necklace each, in that order.
[[nodiscard]] std::vector<Trajectory> read_trajectories(const std::filesystem::path& path,
                                                        const ReadOptions& options = {});

}  // namespace kds
