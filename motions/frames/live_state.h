#pragma once
// What is known of a running simulation whose frames are followed.

#include <cstddef>

namespace kds {

struct LiveState {
  std::size_t received = 0;   ///< frames that have arrived whole
  std::size_t taken = 0;      ///< frames that were handed out or passed over
  double seconds_waited = 0;  ///< kds waited for frames
  double seconds_full = 0;    ///< no frame had room any more, so the simulation may have waited for kds
};

}  // namespace kds
