#pragma once
// --events: every event of a run, one a line, with its beads and their residues, for other programs; written
// while the run goes on.

#include <ostream>

#include "experiments/program/command_line.h"
#include "kds/event_log.h"
#include "motions/scene/scene.h"

namespace kds {

inline constexpr OptionSpec kEventsOption{
    "--events", "FILE", "write every event there, as CSV, with its beads and residues (default: none)"};

/// Header `frame,lower,upper,structure,kind,external,node,beads,residues`; where the file has times
/// `picoseconds` follows `upper`. `frame` is the number in the file of the frame that the event's step begins
/// with, `lower` and `upper` bracket its time in the step, `picoseconds` is its time, rounded. `node` is
/// FIRST-LAST, of an event of a hierarchy; `beads` are the others that it names, between spaces, and
/// `residues` what the file says of each of them, as CHAIN:RESIDUE:NUMBER:ATOM, - where it says nothing.
/// Rebuilds, which change nothing, have no line.
class EventTable final : public EventListener {
 public:
  /// Writes the header. The scene must outlive it.
  EventTable(std::ostream& stream, const Scene& scene);
  void on_event(const KineticStructure& structure, const LoggedEvent& event) override;

 private:
  std::ostream& stream_;
  const Scene& scene_;
  bool timed_;
};

}  // namespace kds
