#include "experiments/compare/net_changes.h"

#include <algorithm>
#include <compare>
#include <utility>

namespace kds {

std::uint64_t net_changes(CombinatorialElements before, CombinatorialElements after) {
  std::sort(before.all.begin(), before.all.end());
  std::sort(after.all.begin(), after.all.end());
  const auto place_ids = static_cast<std::ptrdiff_t>(after.place_ids);
  std::uint64_t changes = 0;
  auto a = before.all.begin(), b = after.all.begin();
  while (a != before.all.end() && b != after.all.end()) {
    const std::strong_ordering order = std::lexicographical_compare_three_way(
        a->begin(), a->begin() + place_ids, b->begin(), b->begin() + place_ids);
    changes += *a != *b ? 1 : 0;
    if (order <= 0) ++a;
    if (order >= 0) ++b;
  }
  return changes + static_cast<std::uint64_t>((before.all.end() - a) + (after.all.end() - b));
}

void NetChanges::add(std::optional<CombinatorialElements> frame) {
  if (last_ && frame) count_ += net_changes(std::move(*last_), *frame);
  last_ = std::move(frame);
}

}  // namespace kds
