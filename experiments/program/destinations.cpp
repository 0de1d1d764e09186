#include "experiments/program/destinations.h"

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace kds {

void print_to_stdout(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  throw std::runtime_error("cannot write to standard output: " + std::generic_category().message(errno));
}

}  // namespace kds
