#include "experiments/output/destinations.h"

#include <cerrno>
#include <cstdio>

#include "experiments/output/output_error.h"

namespace kds {

void print_to_stdout(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  fail_to_write("cannot write to standard output", errno);
}

}  // namespace kds
