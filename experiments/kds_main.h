#pragma once
// The program as a function, for programs that add structures, readers or certificates of their own to it.

namespace kds {

/// Finds the command, and turns what goes wrong into one line and an exit code.
[[nodiscard]] int kds_main(int argc, char** argv);

}  // namespace kds
