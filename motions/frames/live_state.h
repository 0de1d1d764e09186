#pragma once
// Who waits for whom while a run follows a simulation.

#include <cstddef>

namespace kds {

struct LiveState {
  std::size_t received = 0, taken = 0;  ///< frames that have arrived, and those that the run has read
  double seconds_waited = 0;            ///< the run waited for frames
  /// The memory for received frames was full, so that the simulation may have waited for the run.
  double seconds_full = 0;
};

}  // namespace kds
