#pragma once
// The program as a function, for programs that add their own structures, readers or certificates.

namespace kds {

/// Runs the command that `argv` names. Turns each error into a one-line message and an exit code.
[[nodiscard]] int kds_main(int argc, char** argv);

}  // namespace kds
