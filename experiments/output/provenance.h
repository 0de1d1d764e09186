#pragma once
// Provenance of a result: each report states the version and the machine.

#include <string>

namespace kds {

/// Returns release and commit, as in 0.1.0+1a2b3c4d5e6f.
[[nodiscard]] std::string program_version();

struct Machine {
  std::string cpu;
  unsigned cores = 0;
  std::string os;
  std::string compiler;
};

/// Returns the description of this machine. A property that cannot be determined is "unknown".
[[nodiscard]] Machine this_machine();

}  // namespace kds
