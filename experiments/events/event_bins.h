#pragma once
// Counts events in bins of neighbouring steps. Long runs have more frames than a plot has pixels, and more
// than a report should keep.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kds {

struct EventBin {
  std::size_t first_step = 0, steps = 0;
  std::size_t first_frame = 0;   ///< number in the file of the bin's first frame
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

  /// Adds the next step, which begins at the frame with this number in the file.
  void add(std::uint64_t events, std::size_t frame);
  [[nodiscard]] std::size_t steps() const { return steps_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] const std::vector<EventBin>& bins() const { return bins_; }

 private:
  std::size_t width_;
  std::size_t steps_ = 0;
  std::vector<EventBin> bins_;
};

}  // namespace kds
