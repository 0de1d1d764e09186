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

std::vector<std::span<const BeadId>> PairsInQuestion::partners(BeadId bead, std::size_t necklace) const {
  const std::vector<BeadId>& all = partners_[asked_->groups.empty() ? 0 : asked_->groups[bead] % 4];
  const std::vector<BeadRange>& necklaces = asked_->necklaces;
  std::vector<std::span<const BeadId>> runs;
  const auto add = [&](BeadId from, BeadId to) {
    const auto first = std::lower_bound(all.begin(), all.end(), from);
    runs.push_back({first, std::lower_bound(first, all.end(), to)});
  };
  const BeadId end = necklaces[necklace].last + 1;
  if (asked_->asks_of(necklace, necklace) && end - bead > asked_->apart) add(bead + asked_->apart, end);
  if (asked_->between && !asked_->rests(necklace)) add(end, necklaces.back().last + 1);
  for (std::size_t n = necklace + 1; asked_->rests(necklace) && n < necklaces.size(); ++n)
    if (asked_->asks_of(necklace, n)) add(necklaces[n].first, necklaces[n].last + 1);
  return runs;
}

std::uint64_t PairsInQuestion::count() const {
  std::uint64_t count = 0;
  for (std::size_t n = 0; n < asked_->necklaces.size(); ++n)
    for (BeadId i = asked_->necklaces[n].first; i <= asked_->necklaces[n].last; ++i)
      for (const std::span<const BeadId> run : partners(i, n)) count += run.size();
  return count;
}

}  // namespace kds
