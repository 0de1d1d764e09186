// Frames of simulations that run in threads of the test, read over the loopback address.

#include "motions/readers/imd_reader.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

#include "motions/base/interruption.h"
#include "motions/readers/necklace_stream.h"
#include "motions/readers/reader_registry.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/imd_maker.h"

namespace kds::imd_reader_test {
namespace {

using test::ImdMaker;
using test::ImdPeer;
using test::ImdSimulation;
using testing::ElementsAre;
using testing::HasSubstr;
using Word = std::optional<std::pair<int, int>>;

constexpr std::pair go{3, 0}, disconnect{0, 0};
constexpr const char* left = "kds disconnected after frame";

/// Everything that a stream gives.
struct Read {
  std::vector<FrameRead> frames;
  std::vector<std::string> warnings;
  bool truncated = false;
  LiveState state;
};

Read read_all(const std::string& address, ReadOptions options = {}) {
  options.unwrap = options.unwrap.value_or(Unwrap::none);
  NecklaceStream stream(address, options);
  EXPECT_TRUE(stream.is_live());
  EXPECT_FALSE(stream.holds_one_frame());
  Read read;
  for (FrameRead frame; stream.next(frame);) read.frames.push_back(frame);
  FrameRead more;
  EXPECT_FALSE(stream.next(more));
  read.warnings = stream.warnings(0);
  read.truncated = stream.is_truncated();
  read.state = stream.live().value();
  return read;
}

std::vector<std::size_t> numbers_of(const Read& read) {
  std::vector<std::size_t> numbers;
  for (const FrameRead& frame : read.frames) numbers.push_back(frame.stamp.number);
  return numbers;
}

void expect_coordinates(const FrameRead& frame, std::vector<std::size_t> atoms) {
  ASSERT_EQ(frame.positions.cols(), static_cast<Eigen::Index>(atoms.size()));
  for (std::size_t bead = 0; bead < atoms.size(); ++bead)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(frame.positions(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(bead)),
                static_cast<double>(ImdMaker::coordinate(frame.stamp.number, atoms[bead], axis)));
}

double seconds_of(const std::function<void()>& call) {
  const auto begin = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// Sends the handshake and frames, then what the test adds.
std::function<void(ImdPeer&)> after_frames(const ImdMaker& maker, std::function<void(ImdPeer&)> then) {
  return [maker, then = std::move(then)](ImdPeer& peer) {
    peer.send(maker.handshake());
    if (!peer.next_word()) return;
    for (std::size_t k = 0; k < maker.frames; ++k) peer.send(maker.frame(k));
    then(peer);
  };
}

TEST(ImdReader, GivesTheFramesOfBothVersionsBitForBit) {
  for (const int version : {2, 3}) {
    for (const bool big : {false, true}) {
      const ImdMaker maker{.version = version, .big_endian = big};
      ImdSimulation simulation(maker);
      const Read read = read_all(simulation.address(), {.velocities = true});
      ASSERT_THAT(numbers_of(read), ElementsAre(0, 1, 2, 3));
      for (const FrameRead& frame : read.frames) {
        expect_coordinates(frame, {0, 1, 2});
        EXPECT_EQ(frame.cell.has_value(), version == 3);
        EXPECT_EQ(frame.velocities.cols(), version == 3 ? 3 : 0);
        const double time = ImdMaker::time_of(frame.stamp.number);
        EXPECT_EQ(frame.stamp.picoseconds, version == 3 ? std::optional(time) : std::nullopt);
      }
      if (version == 3) {
        const FrameRead& last = read.frames.back();
        EXPECT_EQ(last.cell, (Cell{{40, 5, 6}, {0, 41, 7}, {0, 0, 42}}));
        EXPECT_EQ(last.velocities(1, 2), static_cast<double>(ImdMaker::velocity(3, 2, 1)));
      }
      EXPECT_FALSE(read.truncated);
      if (version == 3)
        EXPECT_THAT(read.warnings, ElementsAre());
      else
        EXPECT_THAT(read.warnings,
                    ElementsAre(HasSubstr("no times (--dt PS gives them) and no periodic cell")));
      EXPECT_EQ(read.state.received, 4U);
      EXPECT_EQ(read.state.taken, 4U);
    }
  }
}

TEST(ImdReader, SaysNothingButGoRateAndDisconnect) {
  std::vector<Word> words;
  ImdSimulation simulation([&](ImdPeer& peer) {
    const ImdMaker maker{.version = 3, .steps_between = 7};
    peer.send(maker.handshake());
    for (int i = 0; i < 2; ++i) words.push_back(peer.next_word());
    for (std::size_t k = 0; k < 9; ++k) peer.send(maker.frame(k));
    for (int i = 0; i < 2; ++i) words.push_back(peer.next_word());
  });
  const Read read = read_all(simulation.address(), {.frames = {1, 7, 2}, .rate = 5});
  simulation.join();
  EXPECT_THAT(numbers_of(read), ElementsAre(1, 3, 5));
  EXPECT_THAT(words, ElementsAre(go, std::pair(8, 5), disconnect, std::nullopt));
  EXPECT_THAT(read.warnings,
              ElementsAre(HasSubstr(left),
                          HasSubstr("frame 1 is 7 steps after the frame before, expected 5 (5 frames)")));
  EXPECT_FALSE(read.truncated);
}

TEST(ImdReader, TakesTheAtomsThatATopologySelects) {
  std::string pdb;
  const char* const names[] = {"N", "CA", "C"};
  for (int i = 0; i < 9; ++i)
    pdb += fmt::format("ATOM  {:>5}  {:<3} ALA A{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00  0.00           {}\n",
                       i + 1, names[i % 3], i / 3 + 1, 1.3 * i, 0.5 * (i % 2), 0.0, names[i % 3][0]);
  const auto topology = test::write_file("a.pdb", pdb);
  {
    ImdSimulation simulation(ImdMaker{.atoms = 9});
    const Read read =
        read_all(simulation.address(), {.topology = topology, .selection = Selection::ca, .time_step = 0.5});
    ASSERT_EQ(read.frames.size(), 4U);
    for (const FrameRead& frame : read.frames) expect_coordinates(frame, {1, 4, 7});
    EXPECT_EQ(read.frames[3].stamp.picoseconds, 1.5);
  }
  ImdSimulation simulation(ImdMaker{.atoms = 10}, true);
  test::expect_refused([&] { read_all(simulation.address(), {.topology = topology}); },
                       {simulation.address(), "10 atoms a frame", "names 9"});
}

TEST(ImdReader, SaysThatStepsWereSkipped) {
  ImdSimulation simulation([](ImdPeer& peer) {
    const ImdMaker maker{.version = 3};
    peer.send(maker.handshake());
    for (const std::size_t k : {0, 1, 2, 5, 6}) peer.send(maker.frame(k));
    static_cast<void>(peer.next_word());
  });
  const Read read = read_all(simulation.address());
  EXPECT_THAT(read.warnings,
              ElementsAre(HasSubstr("frame 3 is 30 steps after the frame before, expected 10 (1 frame)")));
}

TEST(ImdReader, EndsAfterUntil) {
  const auto frames_until = [](const ImdMaker& maker, const ReadOptions& options) {
    ImdSimulation simulation(maker, true);  // waits for the disconnect
    return read_all(simulation.address(), options).frames.size();
  };
  const ImdMaker old{.frames = 9}, recent{.version = 3, .frames = 9};
  EXPECT_EQ(frames_until(old, {.until = 2}), 3U);
  EXPECT_EQ(frames_until(old, {.time_step = 0.5, .until = 2}), 5U);
  EXPECT_EQ(frames_until(old, {.time_step = 0.1, .until = 0.3}), 4U);  // 3 * 0.1 > 0.3 in doubles
  EXPECT_EQ(frames_until(recent, {.until = ImdMaker::time_of(3)}), 4U);
  EXPECT_EQ(frames_until(recent, {.until = ImdMaker::time_of(3) - 0.001}), 3U);
  EXPECT_EQ(frames_until(recent, {.frames = {3, {}, 2}, .time_step = 1, .until = 6}), 2U);
}

TEST(ImdReader, SaysThatTheSimulationEndedTooEarly) {
  for (const ReadOptions& options : {ReadOptions{.frames = {0, 100}}, ReadOptions{.until = 50}}) {
    ImdSimulation simulation(ImdMaker{.version = 3});
    const Read read = read_all(simulation.address(), options);
    EXPECT_EQ(read.frames.size(), 4U);
    EXPECT_THAT(
        read.warnings,
        ElementsAre(HasSubstr("the simulation has ended after frame 3, before the last frame asked")));
  }
}

TEST(ImdReader, SaysThatNoFrameAskedForHasCome) {
  const auto expect_refused = [](const ReadOptions& options, std::string_view why) {
    ImdSimulation simulation(ImdMaker{.version = 3}, true);
    test::expect_refused([&] { read_all(simulation.address(), options); }, {simulation.address(), why});
  };
  expect_refused({.until = 0.1}, ": no frame asked for has come; expected two frames at least");
  expect_refused({.frames = {5}, .patience = 0.3}, ": frame 4: the simulation is silent or too slow");
}

TEST(ImdReader, KeepsTheFramesBeforeABreak) {
  const ImdMaker maker{.version = 3, .frames = 3};
  const ReadOptions options{.patience = 0.3};
  const auto expect_broken = [&](const std::function<void(ImdPeer&)>& then, std::string_view why) {
    ImdSimulation simulation(after_frames(maker, then));
    EXPECT_LT(seconds_of([&] {
                const Read read = read_all(simulation.address(), options);
                EXPECT_THAT(numbers_of(read), ElementsAre(0, 1, 2));
                EXPECT_TRUE(read.truncated);
                ASSERT_FALSE(read.warnings.empty());
                EXPECT_THAT(read.warnings.front(), HasSubstr(why));
              }),
              4);
  };
  std::atomic<bool> disconnected = false;
  const auto wait = [&](ImdPeer& peer) { disconnected = peer.next_word() == disconnect; };
  expect_broken(wait,
                "frame 3: the simulation is silent or too slow, waited 0.3 s (--patience S waits longer)");
  EXPECT_TRUE(disconnected);
  expect_broken(
      [&](ImdPeer& peer) {  // a byte now and then, forever
        const std::string frame = maker.frame(3);
        for (std::size_t i = 0; i < frame.size() && peer.send(frame.substr(i, 1)); ++i)
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
      },
      "frame 3: the simulation is silent or too slow, waited 0.3 s");
  expect_broken([&](ImdPeer& peer) { peer.send(maker.frame(3).substr(0, 100)); },
                "frame 3: the connection has ended inside a packet, ");
  expect_broken(
      [&](ImdPeer& peer) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));  // a reset drops what has not been read
        peer.reset();
      },
      "frame 3: the connection is broken: ");
  expect_broken([](ImdPeer& peer) { peer.send(ImdMaker{.version = 3, .atoms = 4}.frame(3)); },
                "frame 3: coordinates of 4 atoms, expected 3 as in frame 0");
  disconnected = false;
  expect_broken(
      [&](ImdPeer& peer) {
        std::string frame = maker.frame(3);
        const std::size_t place = frame.find(ImdMaker::header(2, 3)) + 8;
        frame.replace(place, 4, maker.number(std::numeric_limits<float>::quiet_NaN()));
        peer.send(frame);
        wait(peer);
      },
      "frame 3: bead 0 has x = nan, expected a finite coordinate; frames up to 2 are read");
  EXPECT_TRUE(disconnected);
}

TEST(ImdReader, RefusesLessThanTwoFrames) {
  const auto expect_refused = [](ImdSimulation simulation, std::initializer_list<std::string_view> parts) {
    test::expect_refused([&] { read_all(simulation.address(), {.patience = 0.3}); }, parts);
  };
  expect_refused(ImdSimulation(ImdMaker{.frames = 0}),
                 {"frame 0: the simulation has ended before the first frame"});
  expect_refused(ImdSimulation(ImdMaker{.frames = 1}),
                 {"the frames have ended after frame 0; expected two frames"});
  expect_refused(ImdSimulation(ImdMaker{.frames = 1}, true),
                 {"frame 1: the simulation is silent", "; expected two frames"});
  expect_refused(ImdSimulation(ImdMaker{.frames = 0}, true),
                 {"frame 0: the simulation is silent or too slow, waited 0.3 s"});
  expect_refused(ImdSimulation([](ImdPeer& peer) { static_cast<void>(peer.next_word()); }),
                 {"imd://", "the simulation is silent or too slow, waited 0.3 s"});
  expect_refused(ImdSimulation([](ImdPeer& peer) { peer.send("HTTP/1.1 400 Bad Request\r\n"); }),
                 {"expected the handshake of a simulation (IMD), found other bytes"});
  expect_refused(ImdSimulation(ImdMaker{.version = 1}),
                 {"expected version 2 or 3 of the protocol IMD, found 1"});
  expect_refused(ImdSimulation(after_frames(
                     {.frames = 0}, [](ImdPeer& peer) { peer.send(ImdMaker::header(2, 50'000'000)); })),
                 {"frame 0: the connection has ended inside a packet"});
}

TEST(ImdReader, ReadsTheFirstFrameTwiceAndNoOther) {
  ImdSimulation simulation(ImdMaker{});
  NecklaceStream stream(simulation.address(), {});
  FrameRead frame;
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(stream.next(frame));
    EXPECT_EQ(frame.stamp.number, 0U);
    stream.rewind();
  }
  ASSERT_TRUE(stream.next(frame) && stream.next(frame));
  stream.rewind();
  EXPECT_THROW(static_cast<void>(stream.next(frame)), std::logic_error);
}

TEST(ImdReader, BoundsTheFramesThatWait) {
  const ImdMaker maker{.atoms = 200'000, .frames = 20, .energies = false};  // 2.4 MB a frame
  ImdSimulation simulation(maker);
  NecklaceStream stream(simulation.address(), {});
  FrameRead frame;
  ASSERT_TRUE(stream.next(frame));
  const auto begin = std::chrono::steady_clock::now();
  while (stream.live()->seconds_full < 0.1 &&
         std::chrono::steady_clock::now() - begin < std::chrono::seconds(60))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_GE(stream.live()->seconds_full, 0.1);
  EXPECT_EQ(stream.live()->taken, 1U);
  EXPECT_LE(stream.live()->received, 1U + 6U + 1U);
  std::size_t frames = 1;
  while (stream.next(frame)) ++frames;
  EXPECT_EQ(frames, 20U);
  EXPECT_EQ(stream.live()->received, 20U);
}

TEST(ImdReader, StopsWaitingOnRequestAndOnInterruption) {
  Word word;
  const auto script = after_frames({.frames = 3}, [&](ImdPeer& peer) { word = peer.next_word(); });
  {
    ImdSimulation simulation(script);
    std::thread user([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      request_live_end();
    });
    const Read read = read_all(simulation.address());
    user.join();
    withdraw_live_end();
    EXPECT_EQ(read.frames.size(), 3U);
    EXPECT_FALSE(read.truncated);
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("sends no times"), HasSubstr(left)));
    EXPECT_GT(read.state.seconds_waited, 0.1);
  }
  EXPECT_EQ(word, disconnect);
  struct Enough {};
  std::size_t asked = 0;
  const InterruptionCheck check([&] {
    if (++asked > 3) throw Enough();
  });
  ImdSimulation simulation(script);
  EXPECT_THROW(read_all(simulation.address()), Enough);
  simulation.join();
  EXPECT_EQ(word, disconnect);
}

TEST(ImdReader, WaitsForASimulationThatDoesNotListenYet) {
  int waits = 0;
  const ReadOptions options{.patience = 0.3, .on_wait = [&] { ++waits; }};
  {
    ImdSimulation simulation([](ImdPeer&) {}, false);
    const double seconds = seconds_of([&] {
      test::expect_refused([&] { read_all(simulation.address(), options); },
                           {simulation.address() + ": no simulation listens there, waited 0.3 s"});
    });
    EXPECT_GE(seconds, 0.3);
    EXPECT_LT(seconds, 2);
    EXPECT_EQ(waits, 1);
  }
  ImdSimulation late(after_frames({}, [](ImdPeer&) {}), false);
  std::thread starts([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    late.listen();
  });
  EXPECT_EQ(read_all(late.address(), {.on_wait = [&] { ++waits; }}).frames.size(), 4U);
  EXPECT_EQ(waits, 2);
  starts.join();
}

TEST(ImdReader, RefusesAddressesInOneLine) {
  const auto expect_refused = [](const std::string& address, std::string_view why) {
    test::expect_refused([&] { read_all(address, {.patience = 0.2}); }, {address, why});
  };
  for (const char* const none : {"imd://", "imd://host", "imd://[::1]", "imd://host/8888"})
    expect_refused(none, "has no port; expected imd://HOST:PORT, such as imd://localhost:8888");
  expect_refused("imd://:8888", "has no host");
  for (const char* const port : {"0", "65536", "", "-1", "12x", "99999999999999999999"})
    expect_refused(fmt::format("imd://host:{}", port), fmt::format("'{}' is no port from 1 to 65535", port));
  expect_refused("imd://::1:8888", "an IPv6 address needs brackets, as in imd://[::1]:8888");
  expect_refused("imd://a b:1", "'a b' is no host");
  expect_refused("imd://no-such-host.invalid:8888", "cannot find the host no-such-host.invalid: ");
  EXPECT_EQ(parse_live_address("imd://[fe80::1]:1").host, "fe80::1");
  EXPECT_EQ(reader_registry().find("imd://h:1")->name, "imd");
  test::expect_refused([] { static_cast<void>(reader_registry().find("imd://h:1", "xtc")); },
                       {"--format", "imd://h:1 has the format imd, found xtc"});
  const auto file = test::write_file("a.xyz", "1\n\nC 0 0 0\n");
  test::expect_refused([&] { NecklaceStream(file, {.format = "imd"}); },
                       {file.string(), "is not the address of a simulation"});
}

}  // namespace
}  // namespace kds::imd_reader_test
