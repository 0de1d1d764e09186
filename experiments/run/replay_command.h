#pragma once
// `kds replay`

#include "experiments/program/command_line.h"

namespace kds {

/// 0 where the log's fingerprint comes out again, 1 where another does; what goes wrong is thrown.
int replay_command(const Arguments& arguments);

}  // namespace kds
