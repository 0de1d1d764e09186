#include "structures/contacts/frame_contacts.h"

#include <algorithm>

namespace kds {

FrameContacts::FrameContacts(std::span<const std::size_t> spacings, std::size_t bridge) : bridge_(bridge) {
  for (const std::size_t spacing : spacings) rows_.push_back({{spacing, 0}, 0, {}});
}

/// Returns the samples in a closed interval.
FrameContacts::Run FrameContacts::samples_in(const ContactInterval& interval, std::size_t spacing) {
  const std::size_t first = (interval.begin.tick_after() + spacing - 1) / spacing,
                    last = interval.end.tick_before() / spacing;
  return first <= last ? Run{first, last} : Run{};
}

FrameContacts::Pair& FrameContacts::pair_of(const ContactInterval& interval) {
  const std::uint64_t key = (std::uint64_t{interval.first} << 32U) | interval.second;
  const auto [at, is_new] = pairs_.try_emplace(key);
  if (is_new) {
    at->second.index = seen_.size();
    seen_.resize(seen_.size() + rows_.size());
  }
  return at->second;
}

void FrameContacts::close(Run& run, Sums& sums) {
  if (run.is_empty()) return;
  ++sums.contacts;
  sums.time += static_cast<double>(run.last - run.first + 1);
  run = {};
}

/// Appends samples to a run if at most `bridge` samples lie between. Otherwise closes the run and begins
/// another.
void FrameContacts::extend(Run& run, const Run& by, std::size_t bridge, Sums& sums) {
  if (!run.is_empty() && by.first - run.last - 1 <= bridge) {
    run.last = by.last;
    return;
  }
  close(run, sums);
  run = by;
}

void FrameContacts::close_outer(Seen& seen, Sums& sums) {
  if (!seen.outer.is_empty() && seen.inner != none) {
    ++sums.contacts;
    sums.time += static_cast<double>(seen.outer.last - seen.inner + 1);
  }
  seen.outer = {};
  seen.inner = none;
}

void FrameContacts::add_inner(const ContactInterval& interval) {
  Pair& pair = pair_of(interval);
  ++exact_[plain].contacts;
  exact_[plain].time += interval.length();
  if (!pair.is_inside) pair.begin = interval.begin;
  pair.is_inside = true;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    Row& row = rows_[k];
    const Run samples = samples_in(interval, row.sampling.spacing);
    if (samples.is_empty()) continue;
    ++row.found;
    Seen& seen = seen_[pair.index + k];
    extend(seen.plain, samples, 0, row.sums[plain]);
    extend(seen.bridged, samples, bridge_, row.sums[bridged]);
    if (seen.pending == none) seen.pending = samples.first;
  }
}

void FrameContacts::add_outer(const ContactInterval& interval) {
  Pair& pair = pair_of(interval);
  if (pair.is_inside) {
    ++exact_[1].contacts;
    ContactInterval whole = interval;
    whole.begin = pair.begin;
    exact_[1].time += whole.length();
  }
  pair.is_inside = false;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    Row& row = rows_[k];
    const Run samples = samples_in(interval, row.sampling.spacing);
    if (samples.is_empty()) continue;
    Seen& seen = seen_[pair.index + k];
    const bool goes_on = !seen.outer.is_empty() && samples.first - seen.outer.last == 1;
    if (!goes_on) close_outer(seen, row.sums[dual]);
    if (seen.outer.is_empty()) seen.outer.first = samples.first;
    seen.outer.last = samples.last;
    if (seen.inner == none) seen.inner = seen.pending;
    seen.pending = none;
  }
}

void FrameContacts::finish(std::size_t steps) {
  for (auto& [key, pair] : pairs_) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      Seen& seen = seen_[pair.index + k];
      close(seen.plain, rows_[k].sums[plain]);
      close(seen.bridged, rows_[k].sums[bridged]);
      close_outer(seen, rows_[k].sums[dual]);
    }
  }
  for (Row& row : rows_) row.sampling.samples = steps * ticks_per_frame / row.sampling.spacing + 1;
}

}  // namespace kds
