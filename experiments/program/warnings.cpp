#include "experiments/program/warnings.h"

#include <fmt/format.h>

#include <cstdio>

#include "experiments/output/text.h"

namespace kds {

void print_warning(ProgressBar& bar, const std::string& warning) {
  bar.erase();
  std::fputs(fmt::format("kds: warning: {}\n", one_line(warning)).c_str(), stderr);
}

}  // namespace kds
