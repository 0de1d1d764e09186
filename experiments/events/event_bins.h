#pragma once
// Long runs have more frames than a plot has pixels, and than a report should keep: neighbouring steps are
// counted as one.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kds {

struct EventBin {
  std::size_t first_step = 0, steps = 0;
  std::size_t first_frame = 0;   ///< number in the file of the frame that it begins at
  std::uint64_t events = 0;      ///< in the bin
  std::uint64_t cumulative = 0;  ///< up to its end
};

/// Steps a bin needs so that there are at most `most` bins.
[[nodiscard]] std::size_t bin_width(std::size_t steps, std::size_t most);

/// The events of a structure in the course of a run.
class EventCourse {
 public:
  static constexpr std::size_t most_bins =
      600;  ///< more would only blur: a plot is about as many pixels wide

  /// So many steps make a bin.
  explicit EventCourse(std::size_t width = 1) : width_(width) {}

  /// The next step, from the frame of this number in the file on.
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
