#pragma once
// Frames that Python holds: an array, or a function that returns one frame. The library reads them through
// its reader registry, under the format `memory`, so everything that holds for files holds for them: chains
// are made whole across the periodic cell, chain breaks and planes are found, and every command that takes
// inputs takes them.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "motions/frames/frame_reader.h"

namespace kds::python {

/// The chains, names and radii of the beads. A list is empty if it is not known.
struct BeadsInMemory {
  std::string label = {};                  ///< names the input in messages
  std::vector<ChainRead> chains = {};      ///< consecutive; empty: one chain
  std::vector<std::string> names = {};     ///< "CA of ALA 12 in chain A"
  std::vector<std::string> elements = {};  ///< symbol of each bead's element
  std::vector<double> radii = {};          ///< in place of `elements`
  std::vector<std::uint8_t> groups = {};   ///< as BeadGroups
  std::vector<double> times = {};          ///< of each frame, in picoseconds
  std::vector<double> cells = {};  ///< of each frame: three lengths in angstrom and three angles in degrees
  std::size_t first_frame = 0;     ///< number of frame 0, for messages and results
  std::size_t frame_step = 1;      ///< from the number of one frame to that of the next
  bool nanometres = false;         ///< positions are in nanometres; the library takes angstrom
};

/// Registers frames for as long as the object lives. May be destroyed with or without the GIL.
class FramesInMemory {
 public:
  /// Reads an array of the shape (frames, beads, 3) without copying it: C-contiguous, aligned, float32 or
  /// float64. Reading throws InputError once a frame is read again and its numbers have changed. `velocities`
  /// is such an array too, in length per picosecond.
  FramesInMemory(const pybind11::array& positions, const std::optional<pybind11::array>& velocities,
                 BeadsInMemory beads);
  /// Reads frame k by calling `frame(k)`. The function returns the positions, an array (beads, 3) of float32
  /// or float64, the time in picoseconds or None, the cell as six numbers or None, and velocities, an array
  /// or None.
  FramesInMemory(pybind11::function frame, std::size_t frames, std::size_t bead_count, BeadsInMemory beads);
  FramesInMemory(const FramesInMemory&) = delete;
  FramesInMemory& operator=(const FramesInMemory&) = delete;
  ~FramesInMemory();

  /// Returns the name under which options take these frames as their input, with the format `memory`.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const std::string& label() const;

  struct Content;

 private:
  void enter(std::shared_ptr<Content> content);

  std::shared_ptr<const Content> content_;
  std::filesystem::path path_;
};

/// Returns the cell that six numbers describe, three lengths and three angles in degrees, or nothing if there
/// are no numbers. In two dimensions the third vector, upright on the plane, is left out. Throws InputError
/// if it is not a cell.
[[nodiscard]] std::optional<Cell> cell_given(std::span<const double> numbers, int dimension);

/// Adds the format `memory` to the reader registry. Call it once.
void add_memory_reader();

}  // namespace kds::python
