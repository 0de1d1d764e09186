#pragma once
// Counts events by time and by bead: in bins of neighbouring steps, and along the chain.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "kds/event.h"
#include "motions/frames/frame_stamp.h"
#include "motions/scene/scene.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/kinetic_run.h"

namespace kds {

struct EventBin {
  FrameStamp first_frame;    ///< the bin's first frame
  std::uint64_t events = 0;  ///< in the bin
};

/// Returns the number of steps per bin such that there are at most `most` bins.
[[nodiscard]] std::size_t bin_width(std::size_t steps, std::size_t most);

/// The number of events of a structure over the course of a run. If the run has more steps than most_bins
/// bins hold, pairs of bins are joined and the width doubles.
class EventCourse {
 public:
  static constexpr std::size_t most_bins = 600;  ///< a plot is about this many pixels wide

  /// `width` is the initial number of steps in a bin.
  explicit EventCourse(std::size_t width = 1) : width_(width) {}

  /// Adds the next step, which begins at this frame.
  void add(std::uint64_t events, const FrameStamp& frame);
  [[nodiscard]] std::size_t steps() const { return steps_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] const std::vector<EventBin>& bins() const { return bins_; }

 private:
  std::size_t width_;
  std::size_t steps_ = 0;
  std::vector<EventBin> bins_;
};

/// Returns {steps: width of a bin, events: [events of each bin], frames: [number of its first frame]}, and
/// `picoseconds` of these frames if they have times.
[[nodiscard]] Json over_time_json(const EventCourse& course);

/// How a structure's external events are distributed along the chain, and by depth in its tree.
struct EventDistribution {
  /// Number of events that name each bead. A node's event names the beads of its new basis. An event counts
  /// at each of its beads.
  std::vector<std::uint64_t> by_bead;
  /// Number of events at the nodes of each tree level, where roots have level 0. Empty if events do not occur
  /// at nodes.
  std::vector<std::uint64_t> by_level;
};

/// Listens to all events of a run.
class EventDistributions final : public EventListener {
 public:
  EventDistributions(const KineticRun& run, const Scene& scene);
  void on_event(const Event& event) override;
  /// In the order of the run's structures.
  [[nodiscard]] const std::vector<EventDistribution>& distributions() const { return distributions_; }

 private:
  NecklaceTree tree_;
  std::vector<std::size_t> levels_;  ///< levels of the tree's nodes
  std::vector<EventDistribution> distributions_;
  std::vector<BeadId> named_;  // by the present event
};

/// Returns "bead 54, N of ALA 59 in chain A", or "bead 54" if `name` is empty.
[[nodiscard]] std::string bead_text(std::size_t bead, const std::string& name);

}  // namespace kds
