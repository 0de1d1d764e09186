#include "experiments/events/events_csv.h"

#include <fmt/format.h>

namespace kds {

EventsCsv::EventsCsv(std::ostream& stream, bool timed) : stream_(stream), timed_(timed) {
  stream_ << "frame,structure,events,cumulative" << (timed_ ? ",picoseconds\n" : "\n");
}

void EventsCsv::add(const FrameStamp& frame, std::string_view structure, std::uint64_t events) {
  auto so_far = cumulative_.find(structure);
  if (so_far == cumulative_.end()) so_far = cumulative_.emplace(structure, 0).first;
  so_far->second += events;
  stream_ << fmt::format("{},{},{},{}", frame.number, structure, events, so_far->second);
  if (timed_) stream_ << fmt::format(",{:.10g}", frame.picoseconds.value_or(0));
  stream_ << '\n';
}

}  // namespace kds
