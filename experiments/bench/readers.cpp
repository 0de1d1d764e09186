// Measures how long a reader takes for all atoms of all frames of a file. The peer reads the bytes of the
// file and nothing else. The time to open the file does not count.

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/bench/bench.h"
#include "experiments/bench/chains.h"
#include "experiments/program/input_options.h"
#include "motions/base/input_file.h"
#include "motions/readers/read_options.h"
#include "motions/readers/reader_registry.h"

namespace kds::bench {

namespace {

std::size_t read_frames(FrameReader& frames) {
  std::size_t atoms = 0;
  frames.rewind();
  for (FrameRead frame; frames.next(frame);) atoms += static_cast<std::size_t>(frame.positions.cols());
  return atoms;
}

void add_reader(const std::filesystem::path& path) {
  const ReaderSpec& reader = *reader_registry().find(path);
  const auto opened = std::make_shared<FramesOpened>(reader.open(path, {.selection = Selection::all}));
  const std::size_t atoms = read_frames(*opened->frames);
  const std::string measure =
      fmt::format("readers/{}/{}/read {}", path.filename().string(), atoms, reader.name);
  add(measure, [=] {
    return Work{atoms, "ns/atom", [=] { benchmark::DoNotOptimize(read_frames(*opened->frames)); }};
  });
  add(measure + " beside reading the bytes", [=] {
    const auto file = std::make_shared<InputFile>(path);
    const auto block = std::make_shared<std::vector<char>>(std::size_t{1} << 20U);
    return Work{atoms, "ns/atom", [=] {
                  file->rewind();
                  while (file->read(block->data(), block->size()) > 0) {
                  }
                }};
  });
}

}  // namespace

void add_readers() {
  std::vector<std::filesystem::path> files = trajectories();
  std::vector<std::filesystem::path> others;
  for (const auto& entry : std::filesystem::directory_iterator(source_data_folder() / "formats")) {
    const ReaderSpec* const reader = reader_registry().find_by_ending(entry.path());
    if (reader != nullptr && reader->open && reader->takes_topology) others.push_back(entry.path());
  }
  std::sort(others.begin(), others.end());
  files.insert(files.end(), others.begin(), others.end());
  for (const std::filesystem::path& file : files) add_reader(file);
}

}  // namespace kds::bench
