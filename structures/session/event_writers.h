#pragma once
// A run's events as text, for other programs; written while the run goes on. What is counted apart, rebuilds
// and edits, has no line: it is no event of what is described. Who owns the stream looks whether all could be
// written.

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>

#include "kds/event_log.h"
#include "motions/scene/scene.h"

namespace kds {

/// What a scene's names say of a bead: CHAIN:RESIDUE:NUMBER:ATOM, or -.
[[nodiscard]] std::string residue_of(const Scene& scene, BeadId bead);

/// Header `frame,lower,upper,structure,kind,external,node,beads,residues`; where frames have times
/// `picoseconds` follows `upper`. `frame` is the number of the frame that the event's step begins with,
/// `lower` and `upper` bracket its time in the step, `picoseconds` is its time, rounded, empty where
/// its frames have none. `node` is
/// FIRST-LAST, of an event of a hierarchy; `beads` are the others that it names, between spaces, and
/// `residues` what the scene says of each of them.
class EventCsv final : public EventListener {
 public:
  /// The scene must outlive it; its first frame tells whether there are times. Where it is there already the
  /// header is written now, else at the first event.
  EventCsv(std::ostream& stream, const Scene& scene);
  void on_event(const Event& event) override;
  [[nodiscard]] bool prints_time_of(const Event& event) const override {
    return is_timed() && !event.kind.counted_apart;
  }
  /// Writes the header if it is not there yet: of a run without events.
  void finish();

 private:
  [[nodiscard]] bool is_timed() const {
    return scene_.frame_count() > 0 && scene_.stamp(0).picoseconds.has_value();
  }

  std::ostream& stream_;
  const Scene& scene_;
  bool begun_ = false, timed_ = false;
};

/// An object a line: `step`; `frame`, the number of the frame that it begins with; `time`, that of the event
/// by the numbers of frames, rounded, and, where frames have times, `picoseconds`; `lower` and `upper`, the
/// bracket in the step; `structure`, `kind`, `external`; `ids`, an object of arrays by the roles that they
/// have, null the infinite vertex; and where the scene names beads, `residues` of those in `ids`, in their
/// order.
class EventJsonLines final : public EventListener {
 public:
  /// The scene must outlive it.
  EventJsonLines(std::ostream& stream, const Scene& scene) : stream_(stream), scene_(scene) {}
  void on_event(const Event& event) override;
  [[nodiscard]] bool prints_time_of(const Event& event) const override { return !event.kind.counted_apart; }

 private:
  std::ostream& stream_;
  const Scene& scene_;
};

/// As a file of this name has it: JSON lines where it ends in .jsonl, else CSV.
[[nodiscard]] std::unique_ptr<EventListener> make_event_writer(const std::filesystem::path& file,
                                                               std::ostream& stream, const Scene& scene);

}  // namespace kds
