#pragma once
// The event log as a text file with one event per line. The file is written whole or not at all, and read
// line by line.
//
//   kds event log 2
//   {"version": ..., "arguments": [...], "beads": ..., "steps": ...}
//   STEP STRUCTURE KIND LOWER UPPER ID...
//   edit STEP at|before TIME insert|erase STRUCTURE BEAD
//   edit STEP at|before TIME change BEADS
//   curve BEAD COORDINATE...                       (for each bead that changes course)
//   step STEP EVENTS HASH                          (after the lines of each step that has any)
//   end EVENTS FINGERPRINT
//
// A log that may have edits has version 3 in its first line. An edit stands before the events that it causes.
// Its time is exactly TIME (`at`), a hexadecimal number, or that of the last failure before TIME (`before`).
// Coordinates have the digits that give the same double again.
//
// The time of an event lies strictly between LOWER and UPPER, or equals both. HASH is a hash of the step's
// lines, so that a line which the run did not write is detected. The arguments are the arguments of kds run.
// Version 1 had no hashes to detect changed times, so the reader refuses it.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/run/run_options.h"
#include "kds/event.h"
#include "kds/event_log.h"
#include "motions/base/input_file.h"
#include "motions/scene/scene.h"

namespace kds {

class EventLogWriter final : public EventListener {
 public:
  /// Writes version 3 if the run may have `edits`.
  EventLogWriter(const std::filesystem::path& path, const RunOptions& options, const Scene& scene,
                 const std::vector<KineticStructure*>& structures, bool edits);
  void on_event(const Event& event) override;
  void on_edit(const Edit& edit) override;
  /// Writes the last line of the log.
  void end(std::uint64_t fingerprint);
  [[nodiscard]] AtomicFiles& file() { return file_; }

 private:
  void begin(std::size_t step);
  void add(const std::string& line);
  void end_step();

  AtomicFiles file_;
  std::ostream& stream_;
  std::vector<std::string_view> structures_;
  std::uint64_t events_ = 0;
  std::size_t step_ = 0;  ///< step of the lines hashed in step_hash_
  bool in_step_ = false;  ///< whether step_hash_ has a line
  std::uint64_t step_events_ = 0;
  WordHash step_hash_;
};

/// The header of a log: what it says about its run before the first event.
struct EventLogHeader {
  std::string version;  ///< the version that wrote the log; empty if unknown
  std::vector<std::string> arguments;
  std::size_t beads = 0;
  std::size_t steps = 0;
  bool has_edits = false;  ///< version 3
};

/// Reads a log event by event. Throws an InputError that names the file and line.
class EventLogReader {
 public:
  explicit EventLogReader(const std::filesystem::path& path);

  struct Entry {
    std::size_t line = 0;  ///< counted from 1
    std::size_t step = 0;
    std::string structure, kind;
    double lower = 0, upper = 0;
    std::vector<BeadId> ids;
    /// If set, the entry is an edit: `kind`, `lower`, `upper` and `ids` are not valid, and `structure` is
    /// that of an insertion or erasure.
    std::optional<Edit> edit;
  };

  [[nodiscard]] const EventLogHeader& header() const { return header_; }
  /// Returns the next event or edit, or null after the last. The pointer is valid until the next call.
  [[nodiscard]] const Entry* next();
  /// The fingerprint in the last line. Valid at the end of the log.
  [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_; }
  /// Number of events read so far.
  [[nodiscard]] std::uint64_t events() const { return events_; }

 private:
  void begin_entry(std::size_t step);
  void read_event(std::string_view line);
  void read_edit(std::string_view line);
  void read_curve(Edit& edit);
  void add_bead(Edit& edit, BeadId bead) const;
  void read_step_end(std::string_view line);
  void read_end(std::string_view line);
  [[nodiscard]] std::string where() const;

  LineReader lines_;
  EventLogHeader header_;
  Entry entry_;
  std::uint64_t events_ = 0, step_events_ = 0;
  bool in_step_ = false;
  std::size_t first_free_step_ = 0;  ///< the first step whose events have not ended
  WordHash step_hash_;
  bool ended_ = false;
  std::uint64_t fingerprint_ = 0;
};

}  // namespace kds
