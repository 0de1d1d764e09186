// Fuzzes the reader of one format with libFuzzer: kds_fuzz_readers --format=NAME CORPUS... Whatever the bytes
// of a file are, reading it must give valid frames, the same ones twice, or an InputError in one line. For
// the format imd the bytes are those that a simulation sends.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/live/imd_protocol.h"
#include "motions/readers/necklace_stream.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/topology.h"
#include "tests/support/inputs/imd_maker.h"

namespace {

using namespace kds;

const ReaderSpec* reader = nullptr;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

void require(bool holds, const char* what) {
  if (!holds) fail(what);
}

// Writes the bytes to a file in memory and returns its path.
std::string write_in_memory(const std::uint8_t* bytes, std::size_t size) {
  static const int file = memfd_create("fuzzed", MFD_CLOEXEC);
  require(file >= 0 && ftruncate(file, 0) == 0 && pwrite(file, bytes, size, 0) == static_cast<ssize_t>(size),
          "cannot write a file in memory");
  return "/proc/self/fd/" + std::to_string(file);
}

struct Frame {
  std::size_t number;
  std::optional<double> time;
  Eigen::Matrix3Xd positions;

  bool operator==(const Frame&) const = default;
};

std::vector<Frame> read_all(NecklaceStream& stream) {
  std::vector<Frame> frames;
  for (FrameRead frame; stream.next(frame);) {
    require(frame.positions.allFinite(), "a coordinate is not finite");
    require(frames.empty() || frame.positions.cols() == frames.back().positions.cols(),
            "frames differ in their numbers of beads");
    frames.push_back({frame.stamp.number, frame.stamp.picoseconds, frame.positions});
  }
  return frames;
}

void read_frames(const std::string& path, bool until_damage) {
  NecklaceStream stream(path, {.format = reader->name, .until_damage = until_damage});
  const std::vector<Frame> first = read_all(stream);
  require(!first.empty(), "no frame, and no InputError");
  stream.rewind();
  require(read_all(stream) == first, "a second reading gives other frames");
}

void read_topology_of(const std::string& path) {
  const Topology topology = reader->topology(path, {.selection = Selection::all});
  for (const std::size_t place : topology.selected)
    require(place < topology.atom_count, "a bead is not one of the atoms");
}

// Reads what a simulation sends, which arrives in pieces. Counts the memory that frames take.
void read_connection(std::string_view bytes, std::size_t piece) {
  test::BytesInMemory source(bytes, piece);
  ImdProtocol protocol("imd://fuzzed:1", source);
  protocol.read_handshake();
  const std::size_t atoms = protocol.read_atom_count();
  protocol.ask_velocities();
  std::size_t held = 0;
  for (LiveFrame frame; protocol.next(frame); frame = {}) {
    require(frame.positions.size() == 3 * atoms, "a frame has other atoms than frame 0");
    held += (frame.positions.capacity() + frame.velocities.capacity()) * sizeof(float);
    require(held <= 2 * source.bytes_read(), "frames take more memory than twice the bytes that came");
  }
  require(source.calls() <= bytes.size() + 2, "bytes are asked for after their end");
}

template <class Read>
void expect_sound(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos, "a message of two lines");
  } catch (const std::exception& error) {
    fail(std::string("not an InputError: ") + error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  constexpr std::string_view option = "--format=";
  for (int i = 1; i < *count; ++i)
    if (const std::string_view argument = (*arguments)[i]; argument.starts_with(option))
      reader = reader_registry().find({}, std::string(argument.substr(option.size())));
  require(reader != nullptr, "expected --format=NAME");
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (reader->name == "imd") {
    const std::string_view sent(reinterpret_cast<const char*>(bytes), size);
    expect_sound([&] { read_connection(sent, size % 2 == 0 ? 7 : size + 1); });
    return 0;
  }
  const std::string path = write_in_memory(bytes, size);
  const bool until_damage = size % 2 == 0;
  if (reader->open) expect_sound([&] { read_frames(path, until_damage); });
  if (reader->topology) expect_sound([&] { read_topology_of(path); });
  return 0;
}
