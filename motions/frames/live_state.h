#pragma once
// Counts and waiting times of a running simulation.

#include <cstddef>

namespace kds {

struct LiveState {
  std::size_t received = 0;   ///< frames that have arrived whole
  std::size_t taken = 0;      ///< frames that were handed out or passed over
  double seconds_waited = 0;  ///< kds waited for frames
  /// The memory for received frames was full, so that the simulation may have waited for kds.
  double seconds_full = 0;
};

}  // namespace kds
