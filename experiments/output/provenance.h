#pragma once
// Where a result comes from: every report carries the version and the machine.

#include <string>

namespace kds {

/// Release and commit, as in 0.1.0+1a2b3c4d5e6f.
[[nodiscard]] std::string program_version();

struct Machine {
  std::string cpu;
  unsigned cores = 0;
  std::string os;
  std::string compiler;
};

/// What cannot be found out is "unknown".
[[nodiscard]] Machine this_machine();

}  // namespace kds
