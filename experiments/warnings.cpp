#include "experiments/warnings.h"

#include <fmt/format.h>

#include "experiments/text.h"

namespace kds {

void print_warning(ProgressBar& bar, const std::string& warning) {
  bar.erase();
  fmt::print(stderr, "kds: warning: {}\n", one_line(warning));
}

}  // namespace kds
