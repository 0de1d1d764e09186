#pragma once
// The event log as a file: text, one event a line, written whole or not at all.
//
//   kds event log 1
//   {"version": ..., "arguments": [...], "beads": ..., "steps": ...}
//   STEP STRUCTURE KIND LOWER UPPER ID...
//   end EVENTS FINGERPRINT
//
// The time of an event lies strictly between LOWER and UPPER, or equals both. The arguments are those of kds
// run.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/run/run_options.h"
#include "kds/event_log.h"
#include "motions/scene/scene.h"

namespace kds {

class EventLogWriter final : public EventListener {
 public:
  EventLogWriter(const std::filesystem::path& path, const RunOptions& options, const Scene& scene);
  void on_event(const KineticStructure& structure, const LoggedEvent& event) override;
  /// Ends the log. Without it nothing is left.
  void commit(std::uint64_t fingerprint);

 private:
  AtomicFile file_;
  std::uint64_t events_ = 0;
};

struct EventLog {
  struct Entry {
    std::size_t line;  ///< from 1
    std::size_t step;
    std::string structure, kind;
    double lower, upper;
    std::vector<BeadId> ids;
  };

  std::vector<std::string> arguments;
  std::size_t beads = 0;
  std::size_t steps = 0;
  std::vector<Entry> entries;
  std::uint64_t fingerprint = 0;
};

/// Throws InputError naming the file and line.
[[nodiscard]] EventLog read_event_log(const std::filesystem::path& path);

}  // namespace kds
