#include "experiments/view/replay_columns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kds {

namespace {

constexpr std::uint8_t kNoId = 255, kOtherId = 254;

/// Adds 32-bit words as differences from the word before, the first one from 0.
class Differences {
 public:
  void add(BlockBytes& block, std::uint32_t word) {
    block.add_varint(static_cast<std::int32_t>(word - before_));
    before_ = word;
  }

 private:
  std::uint32_t before_ = 0;
};

void add_differences(BlockBytes& block, std::span<const std::uint32_t> words) {
  Differences differences;
  for (const std::uint32_t word : words) differences.add(block, word);
}

void add_times(BlockBytes& block, const ReplayRecorder::Events& events) {
  BlockBytes reaches;
  std::int64_t before = 0;
  for (std::size_t e = 0; e < events.count(); ++e) {
    const ShownTime time = shown_time(events.lower[e], events.upper[e]);
    if (e > 0 && events.step[e] != events.step[e - 1]) before = 0;
    block.add_varint(time.middle - before);
    before = time.middle;
    reaches.add_byte(time.reach);
  }
  block.add(reaches);
}

/// Returns for each event the index of its first id in `ids`, and the end.
std::vector<std::size_t> starts_of_ids(const ReplayRecorder::Events& events) {
  std::vector<std::size_t> starts{0};
  for (const std::uint8_t size : events.size) starts.push_back(starts.back() + size);
  return starts;
}

/// Adds the first ids of all events, then the second ones, and so on.
void add_ids(BlockBytes& block, const ReplayRecorder::Events& events) {
  const std::vector<std::size_t> starts = starts_of_ids(events);
  const std::size_t most =
      events.count() == 0 ? 0 : *std::max_element(events.size.begin(), events.size.end());
  for (std::size_t k = 0; k < most; ++k) {
    for (std::size_t e = 0; e < events.count(); ++e) {
      if (k >= events.size[e]) continue;
      const std::size_t at = starts[e] + k;
      block.add_varint(static_cast<std::int32_t>(events.ids[at] - (k == 0 ? 0 : events.ids[at - 1])));
    }
  }
}

}  // namespace

ShownTime shown_time(double lower, double upper) {
  const double from = lower * replay_time_scale, to = upper * replay_time_scale;  // exact
  double middle = std::floor(from + (to - from) / 2 + 0.5);
  if (from == to && middle == from) return {static_cast<std::int64_t>(middle), 0};
  if (to > 0) middle = std::max(middle, 1.0);
  std::uint8_t reach = 1;
  for (double away = 1; middle - away > from || middle + away < to; away *= 2) ++reach;
  return {static_cast<std::int64_t>(middle), reach};
}

BlockBytes event_columns(const ReplayRecorder::Events& events) {
  BlockBytes block;
  add_differences(block, events.order);
  add_differences(block, events.step);
  add_times(block, events);
  for (const std::uint8_t kind : events.kind) block.add_byte(kind);
  for (const DecidedBy stage : events.stage) block.add_byte(static_cast<std::uint8_t>(stage));
  for (const std::uint8_t size : events.size) block.add_byte(size);
  add_ids(block, events);
  return block;
}

BlockBytes change_columns(const ReplayRecorder::Layer& layer, const ReplayRecorder::Events& events) {
  const std::vector<std::size_t> starts = starts_of_ids(events);
  const std::vector<std::uint32_t>& words = layer.changes;
  BlockBytes block, removed, added, places, others;
  Differences of_events;
  for (std::size_t at = 0; at < words.size();) {
    const std::uint32_t event = words[at], gone = words[at + 1], come = words[at + 2];
    of_events.add(block, event);
    removed.add_varint(gone);
    added.add_varint(come);
    at += 3;
    const auto ids = std::span(events.ids).subspan(starts[event], events.size[event]);
    Differences of_others;
    for (const std::size_t end = at + (gone + come) * layer.layer.arity; at < end; ++at) {
      const auto place = std::find(ids.begin(), ids.end(), words[at]) - ids.begin();
      if (words[at] == no_bead) {
        places.add_byte(kNoId);
      } else if (place < static_cast<std::ptrdiff_t>(ids.size()) && place < kOtherId) {
        places.add_byte(static_cast<std::uint8_t>(place));
      } else {
        places.add_byte(kOtherId);
        of_others.add(others, words[at]);
      }
    }
  }
  for (const BlockBytes* const column : {&removed, &added, &places, &others}) block.add(*column);
  return block;
}

}  // namespace kds
