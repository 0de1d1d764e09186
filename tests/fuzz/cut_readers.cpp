// Cuts a trajectory of two frames inside its last frame, again and again:
// kds_cut_readers FORMAT [ATOMS [STRIDE [ENDS [READ]]]].
//
// The last frame is cut at each of its first and last ENDS bytes (default: 5000) and at every STRIDE-th byte
// between (default: 1). Each time the file is opened and must hold one frame. After every READ-th cut
// (default: 1000) the frames are read: frame 0 must be unchanged, and the reader must say that the file is
// truncated. A file whose lost bytes hold no number may give both frames, unchanged. Prints the counts; exits
// with 1 at the first cut that is read otherwise.

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/base/text_input.h"
#include "motions/readers/necklace_stream.h"
#include "motions/readers/reader_registry.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/gromacs_files.h"
#include "tests/support/inputs/netcdf_maker.h"

namespace {

using namespace kds;

constexpr std::size_t frame_count = 2;

// A coordinate in thousandths of the unit of length. Atoms are near each other in sequence and fill a cube.
std::int32_t thousandths(std::size_t frame, std::size_t atom, std::size_t axis) {
  constexpr std::array<double, 3> speeds{0.7, 0.011, 0.00013};
  const auto turn = static_cast<double>(atom) * speeds[axis] + static_cast<double>(frame);
  return static_cast<std::int32_t>(std::lround(9000 * std::sin(turn))) + 10'000;
}
double coordinate(std::size_t frame, std::size_t atom, std::size_t axis) {
  return thousandths(frame, atom, axis) / 1000.0;
}

/// A file, and where its last frame begins.
struct File {
  std::string bytes;
  std::size_t last_frame = 0;
};

File text_file(std::size_t atoms, const std::function<std::string(std::size_t)>& head,
               const std::function<std::string(std::size_t, std::size_t)>& line, std::string_view end) {
  File file;
  for (std::size_t k = 0; k < frame_count; ++k) {
    file.last_frame = file.bytes.size();
    file.bytes += head(k);
    for (std::size_t i = 0; i < atoms; ++i) file.bytes += line(k, i);
    file.bytes += end;
  }
  return file;
}

File make_xyz(std::size_t atoms) {
  return text_file(
      atoms, [&](std::size_t k) { return fmt::format("{}\nframe {}\n", atoms, k); },
      [](std::size_t k, std::size_t i) {
        return fmt::format("C {:.3f} {:.3f} {:.3f}\n", coordinate(k, i, 0), coordinate(k, i, 1),
                           coordinate(k, i, 2));
      },
      "");
}

File make_gro(std::size_t atoms) {
  return text_file(
      atoms, [&](std::size_t k) { return fmt::format("atoms t= {}.0\n{}\n", k, atoms); },
      [](std::size_t k, std::size_t i) {
        return fmt::format("{:>5}{:<5}{:>5}{:>5}{:>8.3f}{:>8.3f}{:>8.3f}\n", (i + 1) % 100'000, "ALA", "CA",
                           (i + 1) % 100'000, coordinate(k, i, 0), coordinate(k, i, 1), coordinate(k, i, 2));
      },
      "  40.00000  40.00000  40.00000\n");
}

File make_pdb(std::size_t atoms) {
  return text_file(
      atoms, [](std::size_t k) { return fmt::format("MODEL     {:>4}\n", k + 1); },
      [](std::size_t k, std::size_t i) {
        return fmt::format(
            "ATOM  {:>5}  CA  ALA A{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00  0.00           C  \n",
            (i + 1) % 100'000, (i + 1) % 10'000, coordinate(k, i, 0), coordinate(k, i, 1),
            coordinate(k, i, 2));
      },
      "ENDMDL\n");
}

File make_lammps(std::size_t atoms) {
  return text_file(
      atoms,
      [&](std::size_t k) {
        return fmt::format(
            "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp pp\n0 40\n0 40\n0 40\n"
            "ITEM: ATOMS id x y z\n",
            k, atoms);
      },
      [](std::size_t k, std::size_t i) {
        return fmt::format("{} {:.3f} {:.3f} {:.3f}\n", i + 1, coordinate(k, i, 0), coordinate(k, i, 1),
                           coordinate(k, i, 2));
      },
      "");
}

// Fills the frames of a maker whose atoms are arrays of three numbers.
template <class Maker, class Coordinate>
void fill(Maker& maker, std::size_t atoms, const Coordinate& coordinate_of) {
  for (std::size_t k = 0; k < frame_count; ++k) {
    auto& frame = maker.frames.emplace_back(atoms);
    for (std::size_t i = 0; i < atoms; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        frame[i][axis] = static_cast<std::decay_t<decltype(frame[i][axis])>>(coordinate_of(k, i, axis));
  }
}

File make_dcd(std::size_t atoms) {
  test::DcdMaker maker;
  maker.cell = true;
  fill(maker, atoms, coordinate);
  return {maker.bytes(), maker.bytes().size() - maker.frame(1).size()};
}

File make_netcdf(std::size_t atoms) {
  test::NetcdfMaker maker;
  maker.version = 2;
  maker.cell = {40, 40, 40, 90, 90, 90};
  maker.times = {0, 1};
  fill(maker, atoms, coordinate);
  return {maker.bytes(), maker.bytes().size() - maker.frame_bytes()};
}

File make_xtc(std::size_t atoms) {
  test::XtcMaker maker;
  fill(maker, atoms, thousandths);
  return {maker.bytes(), maker.frame_bytes(0).size()};
}

File make_trr(std::size_t atoms) {
  test::TrrMaker maker;
  fill(maker, atoms, coordinate);
  return {maker.bytes(), maker.frame_bytes(0).size()};
}

const std::map<std::string, File (*)(std::size_t)> makers{
    {"xyz", make_xyz}, {"gro", make_gro},       {"pdb", make_pdb}, {"lammps", make_lammps},
    {"dcd", make_dcd}, {"netcdf", make_netcdf}, {"xtc", make_xtc}, {"trr", make_trr}};

/// A file in memory, which can only become shorter.
class ShrinkingFile {
 public:
  explicit ShrinkingFile(std::string_view bytes) : descriptor_(memfd_create("cut", MFD_CLOEXEC)) {
    for (std::size_t written = 0; written < bytes.size();) {
      const ssize_t more = write(descriptor_, bytes.data() + written, bytes.size() - written);
      if (more <= 0) throw std::runtime_error("cannot write a file in memory");
      written += static_cast<std::size_t>(more);
    }
  }
  ShrinkingFile(const ShrinkingFile&) = delete;
  ShrinkingFile& operator=(const ShrinkingFile&) = delete;
  ~ShrinkingFile() { close(descriptor_); }

  void cut_at(std::size_t size) const {
    if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0)
      throw std::runtime_error("cannot cut a file in memory");
  }
  [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

struct FramesFound {
  std::vector<Eigen::Matrix3Xd> frames;
  bool truncated = false;
};

FramesFound read_frames(const std::string& path, const std::string& format) {
  NecklaceStream stream(path, {.selection = Selection::all, .format = format});
  FramesFound found;
  for (FrameRead frame; stream.next(frame);) found.frames.push_back(frame.positions);
  found.truncated = stream.is_truncated();
  return found;
}

// Returns whether the file holds frame 1. Reads no frame.
bool holds_both(const std::string& path, const std::string& format) {
  try {
    static_cast<void>(reader_registry()
                          .find(path, format)
                          ->open(path, {.selection = Selection::all, .frames = {1}, .format = format}));
    return true;
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find("holds 1 frame") == std::string_view::npos) throw;
    return false;
  }
}

// Returns a fault of the frames that are read, or an empty text.
std::string fault_of(const FramesFound& found, const FramesFound& whole, bool both, bool cut_at_boundary) {
  if (found.frames.size() != (both ? frame_count : 1))
    return fmt::format("{} frames are read, {} held", found.frames.size(), both ? frame_count : 1);
  for (std::size_t k = 0; k < found.frames.size(); ++k)
    if (found.frames[k] != whole.frames[k]) return fmt::format("frame {} has other coordinates", k);
  if (!both && !found.truncated && !cut_at_boundary) return "one frame, and no word of the other";
  return "";
}

int cut_everywhere(const std::string& format, std::size_t atoms, std::size_t stride, std::size_t ends,
                   std::size_t read_every) {
  const auto maker = makers.find(format);
  if (maker == makers.end()) {
    std::fprintf(stderr,
                 "kds_cut_readers: expected a format: xyz, gro, pdb, lammps, dcd, netcdf, xtc or trr\n");
    return 2;
  }
  const File file = maker->second(atoms);
  const ShrinkingFile shrinking(file.bytes);
  const FramesFound whole = read_frames(shrinking.path(), format);
  if (whole.frames.size() != frame_count || whole.truncated) {
    std::fprintf(stderr, "%s: the whole file has %zu frames\n", format.c_str(), whole.frames.size());
    return 1;
  }
  const std::size_t size_of_frame = file.bytes.size() - file.last_frame;
  const auto begin = std::chrono::steady_clock::now();
  std::size_t cuts = 0, reads = 0, held_both = 0;
  for (std::size_t kept = size_of_frame; kept-- > 0;) {
    if (kept >= ends && size_of_frame - kept > ends && kept % stride != 0) continue;
    shrinking.cut_at(file.last_frame + kept);
    std::string wrong;
    try {
      constexpr std::size_t most_behind_numbers = 8;  // bytes, as ENDMDL and its line end
      const bool both = kept > 0 && holds_both(shrinking.path(), format);
      if (both) ++held_both;
      if (both && size_of_frame - kept > most_behind_numbers) wrong = "two frames are held";
      if (both || cuts % read_every == 0) {
        ++reads;
        const FramesFound found = read_frames(shrinking.path(), format);
        if (wrong.empty()) wrong = fault_of(found, whole, both, kept == 0);
      }
    } catch (const std::exception& error) {
      wrong = error.what();
    }
    ++cuts;
    if (wrong.empty()) continue;
    std::fprintf(stderr, "%s: cut after %zu of the %zu bytes of the last frame: %s\n", format.c_str(), kept,
                 size_of_frame, wrong.c_str());
    return 1;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  std::printf(
      "%s: %zu atoms, last frame of %zu bytes cut at %zu places (read at %zu): one frame %zu times, both "
      "frames %zu times (no number lost), %.0f s\n",
      format.c_str(), atoms, size_of_frame, cuts, reads, cuts - held_both, held_both, seconds.count());
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  const auto number = [&](int place, std::size_t otherwise) {
    const auto given = count > place ? parse_count(arguments[place]) : std::optional(otherwise);
    return given ? *given : 0;
  };
  const std::size_t atoms = number(2, 100'000), stride = number(3, 1), ends = number(4, 5000),
                    read_every = number(5, 1000);
  if (count < 2 || count > 6 || atoms == 0 || stride == 0 || read_every == 0) {
    std::fprintf(stderr, "usage: kds_cut_readers FORMAT [ATOMS [STRIDE [ENDS [READ]]]]\n");
    return 2;
  }
  return cut_everywhere(arguments[1], atoms, stride, ends, read_every);
}
