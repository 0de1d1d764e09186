#pragma once
// Reads files that tests write, and checks what readers say of them.

#include <zlib.h>

#include <initializer_list>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motions/readers/atom_frames.h"
#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"

namespace kds::test {

/// Reads what it is given as a file of this name.
struct FileReader {
  std::string_view name;
  Trajectory operator()(std::string_view bytes, const ReadOptions& options = {}) const {
    return read_trajectory(write_file(std::string(name), bytes), options);
  }
};

/// Expects that a file of this name is refused by a message with all parts.
struct FileRefusal {
  std::string_view name;
  void operator()(std::string_view bytes, std::initializer_list<std::string_view> parts,
                  const ReadOptions& options = {}) const {
    const auto path = write_file(std::string(name), bytes);
    expect_refused([&] { static_cast<void>(read_trajectory(path, options)); }, parts);
  }
};

inline std::filesystem::path write_gzipped(const std::string& name, std::string_view bytes) {
  const std::filesystem::path path = temporary(name);
  const gzFile out = gzopen(path.c_str(), "wb");
  gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(out);
  return path;
}

inline std::vector<std::size_t> all_atoms(const AtomFrames& file) {
  std::vector<std::size_t> atoms(file.atom_count());
  std::iota(atoms.begin(), atoms.end(), std::size_t{0});
  return atoms;
}

inline FrameRead read_frame(AtomFrames& file, std::size_t k, std::span<const std::size_t> atoms) {
  FrameRead frame;
  file.read(k, atoms, frame);
  return frame;
}
inline FrameRead read_frame(AtomFrames& file, std::size_t k) { return read_frame(file, k, all_atoms(file)); }

}  // namespace kds::test
