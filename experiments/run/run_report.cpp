#include "experiments/run/run_report.h"

#include <algorithm>

namespace kds {

std::string StructureReport::label_of(const std::string& kind) const {
  return std::ranges::find(internal_kinds, kind) == internal_kinds.end() ? kind : kind + " (internal)";
}

}  // namespace kds
