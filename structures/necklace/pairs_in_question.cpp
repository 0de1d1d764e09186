#include "structures/necklace/pairs_in_question.h"

#include <algorithm>

namespace kds {

PairsInQuestion::PairsInQuestion(const PairsAsked& asked) : asked_(&asked) {
  check_groups(asked);
  const BeadId beads = asked.necklaces.empty() ? 0 : asked.necklaces.back().last + 1;
  for (BeadId b = 0; b < beads; ++b) {
    if (asked.groups.empty()) partners_[0].push_back(b);
    for (unsigned groups = 1; groups < partners_.size() && !asked.groups.empty(); ++groups)
      if (PairsAsked::joins(groups, asked.groups[b])) partners_[groups].push_back(b);
  }
}

std::array<std::span<const BeadId>, 2> PairsInQuestion::partners(BeadId bead, std::size_t necklace) const {
  const std::vector<BeadId>& all = partners_[asked_->groups.empty() ? 0 : asked_->groups[bead] % 4];
  const BeadId end = asked_->necklaces[necklace].last + 1, beads = asked_->necklaces.back().last + 1;
  const BeadId apart = end - bead > asked_->apart ? bead + asked_->apart : end;
  const auto run = [&all](BeadId from, BeadId to) -> std::span<const BeadId> {
    const auto first = std::lower_bound(all.begin(), all.end(), from);
    return {first, std::lower_bound(first, all.end(), to)};
  };
  return {run(apart, asked_->within ? end : apart), run(end, asked_->between ? beads : end)};
}

std::uint64_t PairsInQuestion::count() const {
  std::uint64_t count = 0;
  for (std::size_t n = 0; n < asked_->necklaces.size(); ++n)
    for (BeadId i = asked_->necklaces[n].first; i <= asked_->necklaces[n].last; ++i)
      for (const std::span<const BeadId> run : partners(i, n)) count += run.size();
  return count;
}

}  // namespace kds
