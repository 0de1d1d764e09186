#pragma once
// Runs of one structure over one scene, whose results the laws compare.

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "kds/event_log.h"
#include "motions/base/input_error.h"
#include "tests/laws/law_structures.h"

namespace kds::test {

/// Everything that two runs must have in common.
struct Outcome {
  std::string ending;   // "done", "too much work", or the message of an exception
  bool failed = false;  // whether the run ended by any other exception than a refusal or the limit of work
  std::vector<Event> events;
  std::vector<std::string> dumps;  // of all frames
  Beads state;                     // at the end
  std::vector<std::uint64_t> events_by_kind;
  std::uint64_t rebuilds = 0, fingerprint = 0;

  [[nodiscard]] bool is_decided() const { return ending != "too much work"; }
  void add_dumps(const std::vector<DumpFile>& files) {
    for (const DumpFile& file : files) dumps.push_back(file.ending + "\n" + file.text);
  }
  void add_end(Simulator& simulator, const RunningStructure& structure,
               const StructureStatistics& statistics) {
    state = state_now(structure);
    fingerprint = simulator.fingerprint();
    events_by_kind = statistics.events_by_kind;
    rebuilds = statistics.rebuilds;
    ending = "done";
  }
};

/// Explains in which event, or in what else, two runs differ, or returns nothing.
[[nodiscard]] std::optional<std::string> difference(const std::vector<Event>& some,
                                                    const std::vector<Event>& others);
[[nodiscard]] std::optional<std::string> difference(const Outcome& run, const Outcome& other);

/// Ends an outcome with the reason why `run` did not end by itself, if there is one.
template <class Run>
void note_ending(Outcome& outcome, Run run) {
  try {
    run();
  } catch (const InputError& refusal) {  // input beyond a stated limit
    outcome.ending = refusal.what();
  } catch (const WorkLimitReached&) {
    outcome.ending = "too much work";
  } catch (const std::exception& error) {  // a failed audit, an internal error
    outcome.ending = error.what();
    outcome.failed = true;
  }
}

[[nodiscard]] Beads all_beads(const Scene& scene);

/// Returns the number of structures on which the structure stands.
[[nodiscard]] std::size_t bases_of(const StructureSpec& spec);
/// Returns whether the scene suits the row's structure and settings.
[[nodiscard]] bool is_accepted(const Scene& scene, const LawStructure& row);

/// Runs the scene, with at most so many limb operations of exact work. If `judged`, brute force judges at
/// audits between events. With 12 or more beads it judges only every n^2/16-th audit.
[[nodiscard]] Outcome run_scene(const Scene& scene, const LawStructure& row, Kernel kernel, AuditMode audits,
                                bool judged, std::uint64_t most_work);

}  // namespace kds::test
