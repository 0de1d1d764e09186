#pragma once
// Starts the real program as a process and waits for it.

#include <string>
#include <vector>

namespace kds::test {

struct ProgramRun {
  int code = -1;  ///< -1: ended by a signal
  std::string out, err;
  long peak_kilobytes = 0;  ///< peak memory
};

[[nodiscard]] ProgramRun run_program(std::vector<std::string> arguments);

/// Runs a shell command line in which $0 is the program and $1, $2, ... are the arguments.
[[nodiscard]] ProgramRun run_shell(const std::string& line, std::vector<std::string> arguments = {});

/// Returns the path of a file in the data folder.
[[nodiscard]] std::string data_file(const std::string& name);

}  // namespace kds::test
