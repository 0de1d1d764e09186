#pragma once
// Writes a run's events as text for other programs, as the events happen. Changes that are counted apart
// (rebuilds and edits) get no line, because they are not events of the motion. The owner of the stream must
// check whether all text could be written.

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include "kds/event.h"
#include "motions/scene/scene.h"

namespace kds {

/// Returns the scene's name of a bead: CHAIN:RESIDUE:NUMBER:ATOM, or - if the bead has none.
[[nodiscard]] std::string residue_of(const Scene& scene, BeadId bead);

/// Writes events as CSV with the header `frame,lower,upper,structure,kind,external,node,beads,residues`. If
/// frames have times, `picoseconds` follows `upper`.
///
/// - `frame` is the number of the frame with which the event's step begins.
/// - `lower` and `upper` are the canonical bracket of the event's time in the step (kds/event.h).
/// - `picoseconds` is the event's time, rounded; empty if its frames have none.
/// - `node` is FIRST-LAST for an event of a hierarchy.
/// - `beads` are the other beads that the event names, separated by spaces.
/// - `residues` are the scene's names of these beads.
class EventCsv final : public EventListener {
 public:
  /// The scene must outlive the writer; its first frame determines whether there are times. Writes the header
  /// now if the first frame exists, otherwise before the first event.
  EventCsv(std::ostream& stream, const Scene& scene);
  void on_event(const Event& event) override;
  [[nodiscard]] bool prints_time_of(const Event& event) const override {
    return is_timed() && !event.kind.counted_apart;
  }
  /// Writes the header if it has not been written, which happens in a run without events.
  void finish();

 private:
  [[nodiscard]] bool is_timed() const {
    return scene_.frame_count() > 0 && scene_.stamp(0).picoseconds.has_value();
  }

  std::ostream& stream_;
  const Scene& scene_;
  bool begun_ = false, timed_ = false;
};

/// Writes one JSON object a line, with these members:
///
/// - `step` and `frame`, the number of the frame with which the step begins.
/// - `time`, the event's time counted in frames, rounded; and, if frames have times, `picoseconds`.
/// - `lower` and `upper`, the canonical bracket of the time in the step.
/// - `structure`, `kind` and `external`.
/// - `ids`, an object with one array for each role of ids; null means the infinite vertex.
/// - `residues`, if the scene names beads: the names of the beads in `ids`, in the same order.
class EventJsonLines final : public EventListener {
 public:
  /// The scene must outlive the writer.
  EventJsonLines(std::ostream& stream, const Scene& scene) : stream_(stream), scene_(scene) {}
  void on_event(const Event& event) override;
  [[nodiscard]] bool prints_time_of(const Event& event) const override { return !event.kind.counted_apart; }

 private:
  std::ostream& stream_;
  const Scene& scene_;
};

/// Returns a writer for the format of this file name: JSON lines if it ends in .jsonl, otherwise CSV.
[[nodiscard]] std::unique_ptr<EventListener> make_event_writer(const std::filesystem::path& file,
                                                               std::ostream& stream, const Scene& scene);

}  // namespace kds
