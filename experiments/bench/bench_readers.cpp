#include "experiments/bench/benches.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "experiments/program/timing.h"
#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/readers/read_options.h"
#include "motions/readers/reader_registry.h"

namespace kds {

namespace {

const ReaderSpec& frame_reader_of(const std::filesystem::path& path) {
  const ReaderSpec* const reader = reader_registry().find(path);
  if (reader == nullptr || !reader->open)
    throw InputError(fmt::format("--trajectories: {} has no frames; expected {}", path.string(),
                                 reader_registry().endings()));
  return *reader;
}

std::size_t read_frames(FrameReader& frames) {
  std::size_t atoms = 0;
  frames.rewind();
  for (FrameRead frame; frames.next(frame);) atoms += static_cast<std::size_t>(frame.positions.cols());
  return atoms;
}

void read_bytes(InputFile& file, std::vector<char>& block) {
  file.rewind();
  while (file.read(block.data(), block.size()) > 0) {
  }
}

// Adds two rows: time per atom, and atoms per second.
void add_rows(const std::filesystem::path& path, std::size_t rounds, std::vector<BenchRow>& rows) {
  constexpr double most_for_xtc = 200;           // ns/atom
  constexpr Eigen::Index fewest_for_goal = 100;  // atoms in a frame; headers dominate in smaller ones
  const ReaderSpec& reader = frame_reader_of(path);
  const FramesOpened opened = reader.open(path, {.selection = Selection::all});
  InputFile file(path);
  std::vector<char> block(std::size_t{1} << 20U);
  FrameRead first;
  (void)opened.frames->next(first);
  const bool has_goal = reader.name == "xtc" && first.positions.cols() >= fewest_for_goal;
  const std::size_t atoms = read_frames(*opened.frames);
  const auto seconds = seconds_in_turn(
      rounds, {[&] { return processor_seconds_per_call([&] { (void)read_frames(*opened.frames); }); },
               [&] { return processor_seconds_per_call([&] { read_bytes(file, block); }); }});
  const double nanoseconds = 1e9 / static_cast<double>(atoms);
  const std::optional<double> goal = has_goal ? std::optional(most_for_xtc) : std::nullopt;
  const std::string name = "read " + reader.name, input = path.filename().string();
  const double ours = median_of(seconds[0]) * nanoseconds, bytes = median_of(seconds[1]) * nanoseconds;
  rows.push_back(with_spread({name, input, atoms, ours, "ns/atom", "reading the bytes", bytes, goal, true},
                             seconds[0], nanoseconds));
  rows.push_back(
      {name + ", speed", input, atoms, 1e3 / ours, "million atoms/s", "", std::nullopt, std::nullopt});
}

}  // namespace

std::vector<BenchRow> bench_readers(const ReaderBenchOptions& options,
                                    const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<BenchRow> rows;
  std::size_t done = 0;
  for (const std::filesystem::path& path : options.trajectories) {
    add_rows(path, options.rounds, rows);
    progress(++done, options.trajectories.size());
  }
  return rows;
}

}  // namespace kds
