#pragma once
// Long runs have more frames than a plot has pixels: neighbouring steps are drawn as one.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kds {

struct EventBin {
  std::size_t first_step = 0, steps = 0;
  std::uint64_t events = 0;      ///< in the bin
  std::uint64_t cumulative = 0;  ///< up to its end
};

/// Steps a bin needs so that there are at most `most` bins.
[[nodiscard]] std::size_t bin_width(std::size_t steps, std::size_t most);

[[nodiscard]] std::vector<EventBin> bin_events(std::span<const std::uint64_t> events_per_step,
                                               std::size_t width);

}  // namespace kds
