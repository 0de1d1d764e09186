#pragma once
// The interface of a reader for one file format. A reader returns the frames in sequence, before the chain is
// made whole and chain breaks are detected. Only the requested frame is in memory.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motions/base/bead_groups.h"
#include "motions/frames/frame_stamp.h"
#include "motions/frames/live_state.h"
#include "motions/frames/periodic.h"

namespace kds {

struct ChainRead {
  std::string name;
  std::size_t bead_count = 0;
  std::size_t residues = 0, residues_read = 0;  ///< in the file's chain; 0 if none
};

/// Consecutive beads of one chain that follow one another by bonds. A periodic cell makes pieces whole, one
/// by one.
struct PieceRead {
  std::size_t first = 0;  ///< its first bead; it ends at the next piece or with its chain
  bool polymer = true;    ///< false: a water, ion or lipid, which stays in the image that the file gives
};

/// The bonds along the beads. Guides are atoms of residues that the selection leaves out between two beads of
/// a polymer. Guides are read to follow the bonds across these residues and are dropped afterwards.
struct BondPaths {
  std::vector<PieceRead> pieces;           ///< in order; empty: each chain is one piece
  std::vector<std::size_t> guides_before;  ///< for each guide, in order: the bead that follows it
};

struct FrameRead {
  FrameStamp stamp;
  /// One column per bead, in the file's length unit (angstrom). Readers add one column per guide.
  Eigen::Matrix3Xd positions;
  std::optional<Cell> cell;
  /// One column per bead or guide, in angstrom per picosecond. Empty if the frame has none, or if none are
  /// asked for (ReadOptions::velocities). An image of a bead
  /// has the bead's velocity, which is exact while the cell stays the same.
  Eigen::Matrix3Xd velocities = {};
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
  /// Reads the next of the frames asked for; returns false after the last one. In files with periodic cells
  /// the frames between come as well. `frame.asked` is true before the call, and the reader sets it to false
  /// for a frame between. Throws InputError naming file and frame.
  [[nodiscard]] virtual bool next(FrameRead& frame) = 0;
  /// Starts again at the first frame. A reader of a running simulation can do so only until its second frame
  /// has been read.
  virtual void rewind() = 0;

  /// Ends the reading of a running simulation before its end. A reader of a file does nothing.
  virtual void close() {}
  /// Returns lines about how the frames came and ended, each with the input's name. If `is_cut`, the first
  /// says why. Complete once `next` has returned false.
  [[nodiscard]] virtual std::vector<std::string> closing_notes() const { return {}; }
  /// Returns whether the connection to the simulation broke before the last frame asked for.
  [[nodiscard]] virtual bool is_cut() const { return false; }
  /// Returns the state of the running simulation, nothing for a file. May be called at any time.
  [[nodiscard]] virtual std::optional<LiveState> live() const { return {}; }
};

/// An open file of frames.
struct FramesOpened {
  std::string file;                   ///< name, for messages
  std::vector<ChainRead> chains;      ///< the chains of the beads, in order; empty: one chain without a name
  std::vector<double> element_radii;  ///< van der Waals radius of each bead; empty if elements are unknown
  std::string element_lack;           ///< a message that says why elements are unknown, if any are
  std::vector<std::string> bead_names;  ///< "CA of ALA 12 in chain A"; empty if the file has no residues
  BeadGroups bead_groups;               ///< empty if no groups are asked for or the file does not name atoms
  std::vector<std::string> warnings;    ///< one line each
  BondPaths bonds;
  bool chain_like = true;  ///< consecutive beads are meant to be bonded
  bool truncated = false;  ///< frames are missing at the end (FramesAsked)
  bool at_rest = false;    ///< the file holds only one frame
  /// A running simulation makes the frames: `next` waits for them, and their number is unknown.
  bool live = false;
  std::unique_ptr<FrameReader> frames;
};

}  // namespace kds
