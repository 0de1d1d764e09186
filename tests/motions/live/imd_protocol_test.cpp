// The protocol of simulations, from bytes in memory: valid streams bit for bit, and mutated ones.

#include "motions/live/imd_protocol.h"

#include <gtest/gtest.h>

#include <random>

#include "motions/base/input_error.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/imd_maker.h"
#include "tests/support/rounds.h"

namespace kds::imd_protocol_test {
namespace {

using test::ImdMaker;

bool operator==(const LiveFrame& a, const LiveFrame& b) {
  const auto same = [](const std::vector<float>& c, const std::vector<float>& d) {
    return c.size() == d.size() && std::memcmp(c.data(), d.data(), c.size() * sizeof(float)) == 0;
  };
  return a.picoseconds == b.picoseconds && a.step == b.step && a.cell.has_value() == b.cell.has_value() &&
         (!a.cell || std::memcmp(&*a.cell, &*b.cell, 36) == 0) && same(a.positions, b.positions) &&
         same(a.velocities, b.velocities);
}

struct Stream {
  std::vector<LiveFrame> frames;
  std::string error;  // empty if the stream ended in order
};

// Reads a connection. Checks that the memory taken is bounded by the bytes that came.
Stream read_stream(std::string_view bytes, std::size_t piece, std::span<const std::size_t> atoms = {}) {
  test::BytesInMemory source(bytes, piece);
  Stream stream;
  std::size_t held = 0;
  try {
    ImdProtocol protocol("imd://sim:1", source);
    protocol.read_handshake();
    static_cast<void>(protocol.read_atom_count());
    if (!atoms.empty()) protocol.choose(atoms);
    protocol.ask_velocities();
    for (LiveFrame frame; protocol.next(frame); frame = {}) {
      held += (frame.positions.capacity() + frame.velocities.capacity()) * sizeof(float);
      EXPECT_LE(held, 2 * source.bytes_read());
      stream.frames.push_back(std::move(frame));
    }
  } catch (const InputError& error) {
    stream.error = error.what();
    EXPECT_EQ(stream.error.find('\n'), std::string::npos);
    EXPECT_TRUE(stream.error.starts_with("imd://sim:1: ")) << stream.error;
  }
  EXPECT_LE(source.calls(), bytes.size() + 2);
  EXPECT_LE(source.most_asked(), 50'000U);
  return stream;
}

std::vector<ImdMaker> all_kinds() {
  std::vector<ImdMaker> kinds;
  for (const bool big : {false, true}) {
    kinds.push_back({.big_endian = big, .energies = false});
    kinds.push_back({.big_endian = big});
    for (unsigned sent = 0; sent < 32; ++sent) {
      const auto has = [&](unsigned bit) { return (sent >> bit & 1U) != 0; };
      kinds.push_back({3, big, 3, 4, has(0), has(1), has(2), has(3), has(4)});
    }
  }
  return kinds;
}

void expect_frame(const LiveFrame& frame, const ImdMaker& maker, std::size_t k) {
  const bool is_new = maker.version == 3;
  EXPECT_EQ(frame.picoseconds, is_new && maker.time ? std::optional(ImdMaker::time_of(k)) : std::nullopt);
  const bool has_step = is_new ? maker.time : maker.energies;
  EXPECT_EQ(frame.step, has_step ? std::optional(maker.step_of(k)) : std::nullopt);
  EXPECT_EQ(frame.cell.has_value(), is_new && maker.cell);
  if (frame.cell) {
    EXPECT_EQ(*frame.cell, (std::array<float, 9>{40, 0, 0, 5, 41, 0, 6, 7, 42}));
  }
  ASSERT_EQ(frame.positions.size(), 3 * maker.atoms);
  ASSERT_EQ(frame.velocities.size(), is_new && maker.velocities ? 3 * maker.atoms : 0);
  for (std::size_t i = 0; i < 3 * maker.atoms; ++i) {
    EXPECT_EQ(frame.positions[i], ImdMaker::coordinate(k, i / 3, i % 3));
    if (!frame.velocities.empty()) {
      EXPECT_EQ(frame.velocities[i], ImdMaker::velocity(k, i / 3, i % 3));
    }
  }
}

TEST(ImdProtocol, ReadsBothVersionsAndByteOrdersBitForBit) {
  for (const ImdMaker& maker : all_kinds()) {
    for (const std::size_t piece : {1, 7, 1 << 20}) {
      const Stream stream = read_stream(maker.bytes(), piece);
      EXPECT_EQ(stream.error, "");
      ASSERT_EQ(stream.frames.size(), 4U);
      for (std::size_t k = 0; k < 4; ++k) expect_frame(stream.frames[k], maker, k);
    }
  }
}

TEST(ImdProtocol, KeepsTheChosenAtomsOfLargeFrames) {
  const ImdMaker maker{.version = 3, .big_endian = true, .atoms = 10'000, .frames = 2};
  const std::vector<std::size_t> atoms{9'999, 0, 4'095, 4'096, 17};
  const Stream stream = read_stream(maker.bytes(), 1000, atoms);
  ASSERT_EQ(stream.frames.size(), 2U) << stream.error;
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_EQ(stream.frames[1].positions[i], ImdMaker::coordinate(1, atoms[i / 3], i % 3));
    EXPECT_EQ(stream.frames[1].velocities[i], ImdMaker::velocity(1, atoms[i / 3], i % 3));
  }
  EXPECT_EQ(read_stream(maker.bytes(), 1 << 20).frames[1].positions.size(), 30'000U);
}

TEST(ImdProtocol, EndsInOrderBetweenFramesOnly) {
  const ImdMaker old, recent{.version = 3};
  const std::string end = ImdMaker::header(0, 0);
  for (const ImdMaker& maker : {old, recent}) {
    EXPECT_EQ(read_stream(maker.bytes() + end + "more", 100).error, "");
    const std::string bytes = maker.bytes();
    const std::size_t last = bytes.size() - maker.frame(3).size();
    for (std::size_t size = last + 1; size < bytes.size(); ++size) {
      const Stream cut = read_stream(std::string_view(bytes).substr(0, size), 100);
      EXPECT_EQ(cut.frames.size(), 3U);
      // Energies are a packet between the frames of version 2.
      const bool between = maker.version == 2 && size == last + 48;
      EXPECT_EQ(cut.error.find("frame 3: the connection has ended") == std::string::npos, between)
          << cut.error;
    }
  }
  const std::string half = recent.bytes() + recent.frame(4).substr(0, 32) + end;
  EXPECT_NE(read_stream(half, 100).error.find("frame 4: expected a packet of energies, found disconnect"),
            std::string::npos);
}

TEST(ImdProtocol, RefusesWhatNoSimulationSends) {
  const ImdMaker old{.energies = false}, recent{.version = 3};
  const auto expect_error = [](const std::string& bytes, std::string_view expected) {
    const Stream stream = read_stream(bytes, 100);
    EXPECT_NE(stream.error.find(expected), std::string::npos) << stream.error;
  };
  expect_error("SSH-2.0-OpenSSH", "expected the handshake of a simulation (IMD), found other bytes");
  expect_error("", "the connection has ended inside a packet, 0 of 8 bytes came");
  expect_error(ImdMaker{.version = 1}.bytes(), "expected version 2 or 3 of the protocol IMD, found 1");
  expect_error(ImdMaker{.version = 4, .big_endian = true}.bytes(), "found 4");
  expect_error(old.handshake(), "frame 0: the simulation has ended before the first frame");
  for (const int type : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, -1})
    expect_error(old.bytes() + ImdMaker::header(type, 1), "frame 4: expected a packet of coordinates, found");
  expect_error(old.handshake() + ImdMaker::header(2, 0), "claims 0 atoms, expected 1 to 50000000");
  expect_error(old.handshake() + ImdMaker::header(2, 0x7fffffff), "claims 2147483647 atoms");
  expect_error(old.handshake() + ImdMaker::header(2, -3), "claims -3 atoms");
  expect_error(old.bytes() + ImdMaker{.atoms = 4}.frame(0).substr(48),
               "frame 4: coordinates of 4 atoms, expected 3 as in frame 0");
  expect_error(old.bytes() + ImdMaker::header(1, 2),
               "expected a packet of energies with the length 1, found 2");
  std::string silent = recent.bytes();
  silent[8 + 8 + 3] = 0;
  expect_error(silent, "the simulation is set to send no coordinates");
  std::string timeless = recent.bytes();
  timeless.replace(23 + 8 + 8, 8, recent.number(std::numeric_limits<double>::infinity()));
  expect_error(timeless, "frame 0: has the time inf ps");
  // 50 million atoms are claimed and none come: `read_stream` checks the memory.
  expect_error(old.handshake() + ImdMaker::header(2, 50'000'000), "the connection has ended inside a packet");
}

// libFuzzer starts from these connections of three frames.
TEST(ImdProtocol, ReadsTheCorpusOfTheFuzzer) {
  int files = 0;
  for (const auto& file : std::filesystem::directory_iterator(test::data_file("../tests/fuzz/corpus/imd"))) {
    const Stream stream = read_stream(test::read_bytes(file.path()), 100);
    EXPECT_EQ(stream.error, "") << file.path();
    EXPECT_EQ(stream.frames.size(), 3U) << file.path();
    ++files;
  }
  EXPECT_GE(files, 4);
}

std::string mutated_stream(const ImdMaker& maker, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::string bytes = maker.bytes();
  for (std::size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t place = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(8)));
        break;
      case 1:
        bytes.resize(place);
        break;
      case 2:
        bytes.erase(place, 1 + below(20));
        break;
      case 3: {  // another length or type in a header
        const std::string header =
            ImdMaker::header(static_cast<int>(below(18)), static_cast<int>(std::uint32_t{1} << below(32)));
        const std::size_t begin = below(2) * 4;
        const std::size_t found = bytes.find(std::string(3, '\0') + static_cast<char>(1 + below(15)), place);
        if (found != std::string::npos && found + 8 <= bytes.size())
          bytes.replace(found + begin, 4, header, begin, 4);
        break;
      }
      case 4:
        bytes.insert(place, ImdMaker::header(static_cast<int>(below(18)), static_cast<int>(below(4))));
        break;
      default:
        bytes.insert(place, bytes.substr(below(bytes.size()), below(200)));
        break;
    }
  }
  return bytes;
}

// Each mutated stream gives the frames before the first changed byte, bit for bit. It ends in order or in one
// line; `read_stream` checks the line, the memory and the number of calls.
TEST(ImdProtocol, SurvivesMutatedStreams) {
  const std::vector<ImdMaker> kinds = all_kinds();
  std::vector<Stream> wholes;
  for (const ImdMaker& maker : kinds) wholes.push_back(read_stream(maker.bytes(), 1 << 20));
  std::mt19937 random(56);
  std::size_t refused = 0, whole = 0, frames_kept = 0;
  const std::size_t rounds = test::rounds(100'000);
  for (std::size_t round = 0; round < rounds && !testing::Test::HasFailure(); ++round) {
    const std::size_t kind = round % kinds.size();
    const ImdMaker& maker = kinds[kind];
    const std::string valid = maker.bytes(), bytes = mutated_stream(maker, random);
    const auto same = static_cast<std::size_t>(
        std::mismatch(valid.begin(), valid.end(), bytes.begin(), bytes.end()).first - valid.begin());
    const Stream found = read_stream(bytes, round % 3 == 0 ? 5 : 1 << 20);
    (found.error.empty() ? whole : refused) += 1;
    const std::size_t head = maker.handshake().size(), frame = maker.frame(0).size();
    const std::size_t kept = same < head ? 0 : (same - head) / frame;
    frames_kept += kept;
    ASSERT_GE(found.frames.size(), kept) << "round " << round << ": " << found.error;
    for (std::size_t k = 0; k < kept; ++k) ASSERT_TRUE(found.frames[k] == wholes[kind].frames[k]);
  }
  EXPECT_GT(refused, rounds / 3);
  EXPECT_GT(whole, rounds / 20);
  EXPECT_GT(frames_kept, rounds);
}

}  // namespace
}  // namespace kds::imd_protocol_test
