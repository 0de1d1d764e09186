#pragma once
// Reads the necklaces of one file frame by frame. Coordinates are checked to be finite, chains are made whole
// across a periodic cell, and chain breaks are found. Two frames are in memory, whatever the length of the
// file.
//
// A chain consists of pieces of beads that follow one another by bonds (BondPaths). Each piece is made whole
// on its own. Pieces that are not of a polymer, such as waters, begin in the image that the file gives.
//
// With Unwrap::beads, each bead moves on its own instead; with Unwrap::none, nothing is moved.
//
// Chains of one file are placed next to each other in the first frame: a chain moves to its periodic image
// nearest to the chains before it if that is much nearer than the chain itself. From then on each chain moves
// continuously: its image follows through all frames from the first one asked for, so that a stride finds the
// images that the whole file has. A warning names other chains with a nearer image.
//
// If a chain is longer than the cell in some frame, the cell cannot be that of the coordinates. It is not
// used from that frame on, unless bonds have been joined across its walls before.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/frames/periodic.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/read_options.h"

namespace kds {

class NecklaceStream {
 public:
  /// Opens the file and reads its first frame. Throws InputError as read_trajectories does.
  NecklaceStream(const std::filesystem::path& path, const ReadOptions& options);

  /// Returns the data of each necklace known from the start: its name, radii by element, breaks and first
  /// frame.
  [[nodiscard]] const std::vector<Trajectory>& heads() const { return heads_; }
  /// Reads the next frame of all necklaces, side by side. Returns false after the last frame. Throws
  /// InputError as the constructor does.
  [[nodiscard]] bool next(FrameRead& frame);
  /// Starts again at the first frame. Possible for a running simulation only until its second frame is read.
  void rewind();
  /// Returns whether a running simulation makes the frames. Then `next` waits for them. It throws InputError
  /// if fewer than two frames come. Once two frames have come, any fault ends the frames: `next` returns
  /// false, `warnings` says why, and `is_truncated` is true.
  [[nodiscard]] bool is_live() const { return opened_.live; }
  /// Disconnects from the running simulation, if there is one. `next` does so after the last frame.
  void close() { opened_.frames->close(); }
  /// Returns the state of the running simulation, nothing for a file.
  [[nodiscard]] std::optional<LiveState> live() const { return opened_.frames->live(); }
  /// Returns whether consecutive beads are meant to be bonded.
  [[nodiscard]] bool chain_like() const { return chain_like_; }
  /// Returns whether the file has only one frame, whatever ReadOptions::frames selects. A file that is
  /// truncated or damaged after its first frame had more.
  [[nodiscard]] bool holds_one_frame() const { return opened_.at_rest; }
  /// Returns the warnings about a necklace. The warnings are complete once all frames have been read.
  [[nodiscard]] std::vector<std::string> warnings(std::size_t necklace) const;
  /// Returns whether frames are missing at the end: the file ends inside a frame, a damaged frame has ended
  /// the reading, or the connection to a simulation broke. Complete once all frames have been read.
  [[nodiscard]] bool is_truncated() const {
    return opened_.truncated || !damage_.empty() || opened_.frames->is_cut();
  }

 private:
  /// Findings about one necklace, for its warnings.
  struct Notes {
    std::vector<std::string> placed;                      ///< lines about shifts of the first frame
    std::size_t frames_joined = 0;                        ///< bonds were joined across the walls
    std::size_t frames_shifted = 0, first_shifted = 0;    ///< a piece moved as a whole
    std::vector<std::size_t> later_breaks;                ///< in the first frame with breaks of its own
    std::size_t frames_doubtful = 0, first_doubtful = 0;  ///< where the cell does not suit the bonds
    std::size_t frames_apart = 0, first_apart = 0;        ///< a piece is in another image than at first
    std::size_t pieces = 0;
    std::size_t pieces_left = 0;  ///< those in the image that the file gives
  };
  /// Beads that follow one another by bonds.
  struct Piece {
    std::size_t necklace = 0;
    Eigen::Index first = 0, bead_count = 0;
    std::vector<Eigen::Index>
        route;           ///< columns of its beads and of the guides between them, along the bonds
    bool placed = true;  ///< next to the pieces before it, not where the file has it
    WholeChain whole = {};
    /// Shift that takes the centroid to its image nearest to the centroid of the first placed piece, in the
    /// first frame.
    std::optional<Eigen::Vector3d> apart_at_first = {};
  };
  /// Reads the next frame; `next` adds what --until-damage asks for.
  [[nodiscard]] bool read(FrameRead& frame);
  /// For a file that names no molecules, finds out whether its beads are a fluid or several chains, which
  /// move bead by bead.
  void look_for_molecules(const FrameRead& first);
  /// Places the pieces of the first frame next to each other.
  void place(FrameRead& first);
  /// Divides the necklaces into pieces. Notes the gaps between bonded beads.
  void find_pieces();
  /// Returns the shift of the first frame, in cell vectors, for a piece that has this image.
  Eigen::Vector3d place_beside_earlier(const Piece& piece, const ImageBeside& beside);
  [[nodiscard]] WholeChain::Outcome make_whole(Piece& piece, Eigen::Matrix3Xd& positions,
                                               const std::optional<Images>& images);
  void drop_guides(Eigen::Matrix3Xd& numbers) const;
  /// Removes a cell that is not that of the coordinates.
  void judge_cell(FrameRead& frame);
  void check_bead_count(const FrameRead& frame) const;
  /// Makes the pieces whole and drops the guides. Notes what happens only in frames asked for.
  void follow(FrameRead& frame);
  void note_apart(const FrameRead& frame);
  void note_cell(const FrameRead& frame);
  /// Notes a time that is not later than that of the frame before.
  void note_time(const FrameStamp& stamp);
  void note_breaks(std::size_t n, const Eigen::Ref<const Eigen::Matrix3Xd>& chain, std::size_t frame);

  FramesOpened opened_;
  Unwrap unwrap_ = Unwrap::chains;
  std::optional<Cell> last_cell_;  ///< of the frame before
  bool chain_like_ = true;
  bool is_fluid_ = false;     ///< `unwrap_` is beads because of the first frame
  bool are_several_ = false;  ///< `unwrap_` is beads, and beads of the first frame are joined
  UnwrappedBeads paths_;      ///< if `unwrap_` is beads
  std::optional<double> time_step_;
  bool until_damage_;
  std::vector<Trajectory> heads_;
  std::vector<Piece> pieces_;              ///< for all necklaces, in order
  std::vector<Notes> notes_;               ///< for each necklace
  std::vector<Eigen::Index> bead_counts_;  ///< for each necklace
  bool bonds_joined_ = false;              ///< some frame had a bond across the walls of its cell
  std::string cell_unsuited_;              ///< why cells are no longer used
  std::optional<std::size_t> last_read_;   ///< number of the last frame read
  std::optional<FrameStamp> last_timed_;   ///< the last frame read that has a time
  std::size_t times_disordered_ = 0;       ///< frames not later than the frame before
  std::string first_disordered_;           ///< about the first of these
  bool ended_ = false;                     ///< a damaged frame has ended the reading
  std::string damage_;                     ///< a warning about that frame
  bool has_times_ = false;                 ///< the file has times, but --dt replaces them
  bool surveyed_ = false;                  ///< all frames have been searched for chain breaks
  std::size_t frames_with_cell_ = 0, frames_without_cell_ = 0;
  std::size_t first_with_cell_ = 0, first_without_cell_ = 0;
  std::size_t cells_unused_ = 0;  ///< frames
  std::string first_doubt_;       ///< about the first of these
  std::size_t frames_noted_ = 0;  ///< frames whose reader has a warning
  std::string first_note_;        ///< about the first of these
};

}  // namespace kds
