#pragma once
// The layout of a DCD file (CHARMM, NAMD, LAMMPS): its header and the position of each frame.
//
// Every record stands between two markers that give its size. A marker has 4 bytes (8 bytes from some
// compilers), in the byte order of the machine that wrote it. The file holds a header, a title, the number of
// atoms, and a list of the free atoms if some are fixed. Each frame then holds the unit cell (optional), x,
// y, z, and a fourth coordinate (optional). If atoms are fixed, frame 0 holds all atoms and the other frames
// only the free ones.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "motions/base/input_file.h"
#include "motions/frames/frame_selection.h"

namespace kds {

struct DcdLayout {
  bool swapped = false;         ///< the byte order is not that of this machine
  std::size_t marker_size = 4;  ///< 4 or 8
  std::int64_t frames_claimed = 0;
  bool has_cell = false;
  bool has_fourth = false;
  std::uint64_t atom_count = 0;
  std::vector<std::uint32_t> free_atoms;  ///< numbered from 0; empty if no atom is fixed
  /// The time of frame 0 and the time between frames, in picoseconds. None if the header's values are
  /// implausible.
  struct Times {
    double first = 0, step = 0;
  };
  std::optional<Times> times;
  std::string times_note;    ///< a message that the unit of time is guessed or unknown; empty if it is known
  std::int32_t version = 0;  ///< CHARMM's version number, which other programs copy
  std::string title;         ///< all lines of the title
  std::string title_note;    ///< a message if the record of the title has a wrong size; else empty
  std::uint64_t frames_begin = 0;  ///< offset in the file
  std::uint64_t file_size = 0;     ///< size after unpacking
  bool cut = false;                ///< the gzipped file is truncated after these bytes

  [[nodiscard]] std::uint64_t atoms_in_frame(std::size_t k) const {
    return k == 0 || free_atoms.empty() ? atom_count : free_atoms.size();
  }
  /// Returns the size of a record including the markers around it.
  [[nodiscard]] std::uint64_t record_size(std::uint64_t bytes) const { return bytes + 2 * marker_size; }
  [[nodiscard]] std::uint64_t frame_size(std::size_t k) const {
    return (has_cell ? record_size(cell_bytes) : 0) +
           (has_fourth ? 4 : 3) * record_size(4 * atoms_in_frame(k));
  }
  [[nodiscard]] std::uint64_t frame_begin(std::size_t k) const {
    return k == 0 ? frames_begin : frames_begin + frame_size(0) + (k - 1) * frame_size(1);
  }
  [[nodiscard]] FramesHeld frames_held() const;

  /// Converts a number from the file's byte order. `bytes` need not be aligned.
  template <class Number>
  [[nodiscard]] Number number(const char* bytes) const {
    std::array<char, sizeof(Number)> copy;
    std::memcpy(copy.data(), bytes, sizeof(Number));
    if (swapped) std::reverse(copy.begin(), copy.end());
    return std::bit_cast<Number>(copy);
  }
  [[nodiscard]] std::uint64_t marker(const char* bytes) const {
    return marker_size == 4 ? number<std::uint32_t>(bytes) : number<std::uint64_t>(bytes);
  }
  /// Returns a marker as Fortran writes it, with a sign, for messages.
  [[nodiscard]] std::int64_t with_sign(std::uint64_t marker) const {
    return marker_size == 4 ? static_cast<std::int32_t>(marker) : static_cast<std::int64_t>(marker);
  }

  static constexpr std::uint64_t cell_bytes = 48;
};

/// Reads the layout. Throws InputError naming the file.
[[nodiscard]] DcdLayout read_dcd_layout(InputFile& input);

}  // namespace kds
