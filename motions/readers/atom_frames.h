#pragma once
// Trajectory formats whose frames are arrays of atoms without residues: DCD, XTC, TRR, AMBER NetCDF, LAMMPS
// dumps, XYZ, and the frames of running simulations. A reader of such a format is one class derived from
// AtomFrames and one line of registration (reader_registry.cpp). Which frames and atoms become frames of
// beads, and what a topology says about the atoms, is decided here for all of them.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"
#include "motions/frames/frame_selection.h"
#include "motions/readers/read_options.h"

namespace kds {

class AtomFrames {
 public:
  virtual ~AtomFrames() = default;

  /// Returns the number of atoms in each frame.
  [[nodiscard]] virtual std::size_t atom_count() const = 0;
  /// Returns the frames of the file. The frames are counted when the file is opened, from the frames' headers
  /// where the format allows it. A size in a header must not be believed before it is compared with the
  /// file's size.
  [[nodiscard]] virtual FramesHeld held() const = 0;
  /// Says which atoms all calls of `read` will ask for. Called once, before the first `wait_for`.
  virtual void choose(std::span<const std::size_t> atoms) { static_cast<void>(atoms); }
  /// Waits until frame k is there, if a running simulation makes the frames. Returns false after the last
  /// one. Called before each `read` with the same k.
  [[nodiscard]] virtual bool wait_for(std::size_t k) {
    static_cast<void>(k);
    return true;
  }
  /// Returns whether a frame may have a cell. If none can, frames between those asked for are not read.
  [[nodiscard]] virtual bool may_have_cell() const = 0;
  /// Reads frame k: its time, its cell, and the position of each of `atoms` (a column each, in angstrom).
  /// Calls in ascending order of k are fast. `atoms` are indices in the file, from 0, in any order. The
  /// positions may be left out if `frame.asked` is false and the frame has no cell. If the options ask for
  /// velocities and the file has them, sets `frame.velocities` of a frame asked for. Throws DamagedFrame if
  /// the bytes of the frame are not what the format allows.
  virtual void read(std::size_t k, std::span<const std::size_t> atoms, FrameRead& frame) = 0;

  /// Returns the van der Waals radius of each atom, NaN if its element is unknown; empty if the file does not
  /// name elements. A frame has been read before. Adds lines about elements that are guessed to `warnings`,
  /// with the file's name.
  [[nodiscard]] virtual std::vector<double> element_radii(std::vector<std::string>& warnings) const {
    static_cast<void>(warnings);
    return {};
  }
  /// Returns the number that the file gives each atom, usually from 1 on; empty if it gives none. A frame has
  /// been read before.
  [[nodiscard]] virtual std::vector<std::size_t> ids() const { return {}; }
  /// Returns lines about how the file is read, each without the file's name.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }

  /// As in FrameReader, for running simulations.
  virtual void close() {}
  [[nodiscard]] virtual std::vector<std::string> closing_notes() const { return {}; }
  [[nodiscard]] virtual bool is_cut() const { return false; }
  [[nodiscard]] virtual std::optional<LiveState> live() const { return {}; }
};

/// Throws InputError if an option needs the names of atoms and there is no topology. `file` does not name
/// atoms.
void require_names(const std::string& file, const ReadOptions& options);

/// Returns the frames of beads that `options` ask for: all atoms, or those that the selection takes from the
/// topology. Throws InputError naming file and option if the topology has other atoms by their number or
/// their ids, or if an option needs the names of atoms and there is no topology.
[[nodiscard]] FramesOpened open_atom_frames(const std::filesystem::path& path, const ReadOptions& options,
                                            std::unique_ptr<AtomFrames> frames);

}  // namespace kds
