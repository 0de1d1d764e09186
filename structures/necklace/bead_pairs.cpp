#include "structures/necklace/bead_pairs.h"

#include <stdexcept>
#include <string>

namespace kds {

void check_groups(const PairsAsked& asked) {
  if (!asked.at_rest.empty() && asked.at_rest.size() != asked.necklaces.size())
    throw std::invalid_argument("expected whether each of " + std::to_string(asked.necklaces.size()) +
                                " necklaces is at rest, found " + std::to_string(asked.at_rest.size()));
  const std::size_t beads = asked.necklaces.empty() ? 0 : std::size_t{asked.necklaces.back().last} + 1;
  if (asked.groups.empty() || asked.groups.size() == beads) return;
  throw std::invalid_argument("expected the groups of " + std::to_string(beads) + " beads, found those of " +
                              std::to_string(asked.groups.size()));
}

void refuse_groups(const PairsAsked& asked, std::string_view method) {
  if (asked.groups.empty()) return;
  throw std::invalid_argument(std::string(method) +
                              " takes no groups of beads; expected contacts, a cell list or brute force");
}

BeadPairs::BeadPairs(std::size_t beads, std::span<const Pair> pairs) : start_(beads + 1, 0) {
  for (const auto& [a, b] : pairs) {
    if (a >= beads || b >= beads || a == b)
      throw std::invalid_argument("expected two different beads of " + std::to_string(beads) + ", found " +
                                  std::to_string(a) + " and " + std::to_string(b));
    ++start_[a + 1];
    ++start_[b + 1];
  }
  for (std::size_t b = 0; b < beads; ++b) start_[b + 1] += start_[b];
  neighbors_.resize(2 * pairs.size());
  std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
  for (const auto& [a, b] : pairs) {
    neighbors_[next[a]++] = b;
    neighbors_[next[b]++] = a;
  }
  auto kept = neighbors_.begin();
  for (std::size_t b = 0; b < beads; ++b) {
    const auto first = neighbors_.begin() + static_cast<std::ptrdiff_t>(start_[b]);
    const auto end = neighbors_.begin() + static_cast<std::ptrdiff_t>(next[b]);
    std::sort(first, end);
    start_[b] = static_cast<std::size_t>(kept - neighbors_.begin());
    kept = std::unique_copy(first, end, kept);
  }
  start_[beads] = static_cast<std::size_t>(kept - neighbors_.begin());
  neighbors_.erase(kept, neighbors_.end());
}

BeadPairs BeadPairs::along(std::size_t beads, std::span<const BeadRange> necklaces) {
  std::vector<Pair> pairs;
  for (const BeadRange& range : necklaces) {
    for (BeadId b = range.first; b < range.last; ++b) pairs.emplace_back(b, b + 1);
  }
  return {beads, pairs};
}

}  // namespace kds
