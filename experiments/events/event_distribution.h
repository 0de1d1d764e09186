#pragma once
// Counts events by time and by bead: in bins of neighbouring steps, along the chain, and next to the
// displacements of beads from frame to frame.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kds/event_log.h"
#include "motions/frames/frame_stamp.h"
#include "motions/scene/scene.h"
#include "structures/necklace/necklace_tree.h"
#include "structures/session/kinetic_run.h"

namespace kds {

struct EventBin {
  std::size_t first_step = 0, steps = 0;
  FrameStamp first_frame;        ///< the bin's first frame
  std::uint64_t events = 0;      ///< in the bin
  std::uint64_t cumulative = 0;  ///< up to the end of the bin
};

/// Returns the number of steps per bin such that there are at most `most` bins.
[[nodiscard]] std::size_t bin_width(std::size_t steps, std::size_t most);

/// The number of events of a structure over the course of a run.
class EventCourse {
 public:
  static constexpr std::size_t most_bins = 600;  ///< a plot is about this many pixels wide

  /// `width` is the number of steps in a bin.
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

/// Records how far beads move from frame to frame during a run.
class Displacements {
 public:
  struct Bin {
    FrameStamp first_frame;  ///< the bin's first frame
    std::size_t steps = 0;
    double sum_of_means = 0;  ///< sum over the steps of the beads' mean displacement
    double most = 0;          ///< largest displacement of a bead in a step
    [[nodiscard]] double mean() const { return sum_of_means / static_cast<double>(steps); }
  };

  Displacements() = default;
  /// `width` is the number of steps in a bin.
  explicit Displacements(std::size_t width) : width_(width) {}

  /// Adds the next frame. Each frame has the same number of beads.
  void add_frame(Eigen::Matrix3Xd centers, const FrameStamp& stamp);
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] const std::vector<Bin>& bins() const { return bins_; }

 private:
  std::size_t width_ = 1;
  std::size_t steps_ = 0;
  FrameStamp last_stamp_;
  Eigen::Matrix3Xd last_;
  std::vector<Bin> bins_;
};

/// Counts events by time and by bead at once. Bins of neighbouring steps are the columns, blocks of
/// neighbouring beads are the rows. An event counts once for each of its beads, as in
/// `EventDistribution::by_bead`.
struct EventGrid {
  /// Bound the size of the page. More than two grids share the cells of two.
  static constexpr std::size_t most_bins = 36, most_blocks = 24;

  std::size_t steps_per_bin = 1, beads_per_block = 1;  ///< the last bin and the last block may have fewer
  std::vector<FrameStamp> edges;                       ///< frames at which the bins begin, and the last frame
  std::vector<std::vector<std::uint64_t>> counts;      ///< by bin, then by block

  EventGrid() = default;
  /// `grids` is the number of grids of the run.
  EventGrid(const Scene& scene, std::size_t grids);
};

/// How a structure's external events are distributed along the chain, and by depth in its tree.
struct EventDistribution {
  /// Number of events that name each bead. A node's event names the beads of its new basis. An event counts
  /// at each of its beads.
  std::vector<std::uint64_t> by_bead;
  /// Number of events at the nodes of each tree level, where roots have level 0. Empty if events do not occur
  /// at nodes.
  std::vector<std::uint64_t> by_level;
  EventGrid grid;
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
};

/// Returns "bead 54, N of ALA 59 in chain A", or "bead 54" if `name` is empty.
[[nodiscard]] std::string bead_text(std::size_t bead, const std::string& name);

}  // namespace kds
