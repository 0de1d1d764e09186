#include "check_dump.h"

#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "check_power.h"
#include "check_wrapped.h"
#include "dump.h"

namespace oracle {
namespace {

namespace fs = std::filesystem;

const std::array<std::string, 3> kinds{"power", "hidden", "wrapped"};

// Every frame must have the same files as frame 0, and no file may belong to a frame after the last.
void check_files(const Scene& scene, const fs::path& dir, Report& report) {
  for (const std::string& kind : kinds) {
    const bool expected = fs::exists(dump_file(dir, 0, kind));
    for (std::size_t k = 1; k < scene.frames.size(); ++k) {
      const fs::path file = dump_file(dir, k, kind);
      if (fs::exists(file) != expected) {
        report.mismatch(file.filename().string() +
                        (expected ? ": is missing" : ": frame 0 has none of this kind"));
      }
    }
  }
  if (fs::exists(dump_file(dir, 0, "power")) != fs::exists(dump_file(dir, 0, "hidden"))) {
    report.mismatch("frame 0: cells and hidden beads belong together");
  }
  if (!fs::exists(dump_file(dir, 0, "power")) && !fs::exists(dump_file(dir, 0, "wrapped"))) {
    report.mismatch("frame 0: there is nothing to check");
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("frame-")) continue;
    std::size_t frame = 0;
    const auto parsed = std::from_chars(name.data() + 6, name.data() + name.size(), frame);
    if (parsed.ec != std::errc() || frame >= scene.frames.size()) {
      report.mismatch(name + ": the run has " + std::to_string(scene.frames.size()) + " frames");
    }
  }
}

// Reads a file of the dump. Reports a wrong form as a mismatch and returns nothing.
template <class Read>
auto read_file(const fs::path& file, const Read& read, Report& report)
    -> std::optional<decltype(read(file))> {
  try {
    return read(file);
  } catch (const FormError& error) {
    report.mismatch(file.filename().string() + ": " + error.what());
    return std::nullopt;
  }
}

}  // namespace

Report check_dump(const Scene& scene, const fs::path& dir, std::size_t every) {
  if (!fs::is_directory(dir)) throw UsageError(dir.string() + ": no such directory");
  Report report;
  check_files(scene, dir, report);
  for (std::size_t k = 0; k < scene.frames.size(); ++k) {
    const Frame& frame = scene.frames[k];
    const std::string where = "frame " + std::to_string(k) + ": ";
    ++report.frames;
    if (fs::exists(dump_file(dir, k, "power")) && fs::exists(dump_file(dir, k, "hidden"))) {
      const auto cells = read_file(
          dump_file(dir, k, "power"), [&](const fs::path& file) { return read_cells(file, scene.dimension); },
          report);
      const auto hidden = read_file(dump_file(dir, k, "hidden"), read_hidden, report);
      if (cells && hidden) check_power(scene.in_plane(k), scene.dimension, {*cells, *hidden}, where, report);
    }
    if (fs::exists(dump_file(dir, k, "wrapped"))) {
      const auto nodes = read_file(dump_file(dir, k, "wrapped"), read_nodes, report);
      if (nodes) check_wrapped(frame, scene.ends, *nodes, every, where, report);
    }
  }
  return report;
}

void write_static_dump(const Scene& scene, const fs::path& dir) {
  fs::create_directories(dir);
  for (std::size_t k = 0; k < scene.frames.size(); ++k) {
    const PowerDiagram diagram = static_power_diagram(scene.in_plane(k), scene.dimension);
    write_cells(dump_file(dir, k, "power"), diagram.cells, scene.dimension);
    write_hidden(dump_file(dir, k, "hidden"), diagram.hidden);
    write_nodes(dump_file(dir, k, "wrapped"), static_hierarchy(scene.frames[k], scene.ends));
  }
}

}  // namespace oracle
