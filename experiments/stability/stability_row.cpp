#include "experiments/stability/stability_row.h"

#include <fmt/format.h>

#include <algorithm>

namespace kds {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void note_trouble(StabilityRow& row, std::size_t number, const std::string& reason,
                  const std::string& motion) {
  if (!row.motion.empty()) return;
  row.reason = fmt::format("case {}: {}", number, reason);
  row.motion = motion;
}

}  // namespace kds
