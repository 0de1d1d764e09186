#pragma once
// The interface of a reader for one file format. It returns the frames in sequence, before the chain is made
// whole and chain breaks are detected. Only the requested frame is in memory.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motions/base/bead_groups.h"
#include "motions/frames/frame_stamp.h"
#include "motions/frames/periodic.h"

namespace kds {

struct ChainRead {
  std::string name;
  std::size_t bead_count = 0;
  std::size_t residues = 0, residues_read = 0;  ///< of the chain in the file; 0 if none
};

struct FrameRead {
  FrameStamp stamp;
  Eigen::Matrix3Xd positions;  ///< one column per bead, in the file's length unit (angstrom)
  std::optional<Cell> cell;
  /// Why the cell in the file is not used; empty if the cell is used or the file has none.
  std::string cell_doubt = {};
  /// A warning about how this frame is read; empty if there is none.
  std::string note = {};
  /// Whether the run asks for this frame. Images of chains follow through the frames between those asked for,
  /// too; such a frame needs no positions if it has no cell.
  bool asked = true;
};

class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// Reads the next of the frames asked for; returns false behind the last one. In files with periodic cells
  /// the frames between come as well. `frame.asked` is true before the call, and the reader sets it to false
  /// for a frame between. Throws InputError naming file and frame.
  [[nodiscard]] virtual bool next(FrameRead& frame) = 0;
  /// Starts again at the first frame.
  virtual void rewind() = 0;
};

/// An open file of frames.
struct FramesOpened {
  std::string file;                   ///< name, for messages
  std::vector<ChainRead> chains;      ///< the chains of the beads, in order; empty: one chain without a name
  std::vector<double> element_radii;  ///< van der Waals radius of each bead; empty if elements are unknown
  std::vector<std::string> bead_names;  ///< "CA of ALA 12 in chain A"; empty if the file has no residues
  BeadGroups bead_groups;               ///< empty if no groups are asked for or the file does not name atoms
  std::vector<std::string> warnings;    ///< one line each
  bool chain_like = true;               ///< consecutive beads are meant to be bonded
  bool truncated = false;               ///< frames are missing at the end, as FramesAsked tells it
  std::unique_ptr<FrameReader> frames;
};

}  // namespace kds
