#pragma once
// What the reader of one format hands over: its frames one after the other, before the chain is made whole
// and searched for breaks. Only the frame asked for is in memory.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_stamp.h"
#include "motions/frames/periodic.h"

namespace kds {

struct ChainRead {
  std::string name;
  std::size_t bead_count = 0;
  std::size_t residues = 0, residues_read = 0;  ///< of the chain in the file; 0 if it has no residues
};

struct FrameRead {
  FrameStamp stamp;
  Eigen::Matrix3Xd positions;  ///< one column a bead, in the file's length unit (angstrom)
  std::optional<Cell> cell;
  /// Why the cell in the file is not used; empty if the cell is used or the file has none.
  std::string cell_doubt = {};
  /// A warning about how this frame is read; empty if there is none.
  std::string note = {};
};

class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// The next of the frames asked for; false behind the last one, which nobody need know before. Throws
  /// InputError naming file and frame.
  [[nodiscard]] virtual bool next(FrameRead& frame) = 0;
  /// Begins again with the first.
  virtual void rewind() = 0;
};

/// A file of frames, open.
struct FramesOpened {
  std::string file;                   ///< for messages
  std::vector<ChainRead> chains;      ///< that the beads belong to, in order; empty: one without a name
  std::vector<double> element_radii;  ///< van der Waals radius of each bead; empty where elements are unknown
  std::vector<std::string> bead_names;  ///< "CA of ALA 12 in chain A"; empty where the file has no residues
  std::vector<std::string> warnings;    ///< one line each
  bool chain_like = true;               ///< beads that follow each other are meant to be bonded
  std::unique_ptr<FrameReader> frames;
};

}  // namespace kds
