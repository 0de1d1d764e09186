#pragma once
// Starts the real program and waits for it.

#include <string>
#include <vector>

namespace kds::test {

struct ProgramRun {
  int code = -1;  ///< -1: ended by a signal
  std::string out, err;
  long peak_kilobytes = 0;  ///< of memory
};

[[nodiscard]] ProgramRun run_program(std::vector<std::string> arguments);

/// A command line of the shell, in which $0 is the program and $1, $2, ... the arguments.
[[nodiscard]] ProgramRun run_shell(const std::string& line, std::vector<std::string> arguments = {});

/// A file of the data folder.
[[nodiscard]] std::string data_file(const std::string& name);

}  // namespace kds::test
