#include "experiments/trade/match_events.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "structures/contacts/contacts.h"

namespace kds {

namespace {

using Key = std::tuple<std::uint8_t, std::uint8_t, std::array<BeadId, 10>>;

std::map<Key, std::vector<double>> times_by_change(std::span<const TimedEvent> events) {
  std::map<Key, std::vector<double>> times;
  for (const TimedEvent& event : events)
    times[{event.change.kind, event.change.size, event.change.ids}].push_back(event.time);
  return times;
}

void match(std::span<const double> expected, std::span<const double> found, double reach, EventMatch& match) {
  std::size_t e = 0, f = 0;
  while (e < expected.size() && f < found.size()) {
    const double apart = std::abs(expected[e] - found[f]);
    if (apart <= reach) {
      ++match.matched;
      match.time_error_sum += apart;
      match.time_error_max = std::max(match.time_error_max, apart);
      ++e, ++f;
    } else if (expected[e] < found[f]) {
      ++match.missed, ++e;
    } else {
      ++match.invented, ++f;
    }
  }
  match.missed += expected.size() - e;
  match.invented += found.size() - f;
}

}  // namespace

EventMatch match_events(std::span<const TimedEvent> expected, std::span<const TimedEvent> found,
                        double reach) {
  const auto of_expected = times_by_change(expected), of_found = times_by_change(found);
  EventMatch result;
  result.expected = expected.size();
  for (const auto& [change, times] : of_expected) {
    const auto same = of_found.find(change);
    match(times, same == of_found.end() ? std::span<const double>() : std::span(same->second), reach, result);
  }
  for (const auto& [change, times] : of_found) {
    if (!of_expected.contains(change)) result.invented += times.size();
  }
  return result;
}

std::vector<ContactTime> contact_times(std::span<const BeadPair> built, std::span<const TimedEvent> events,
                                       double first, double last) {
  using Kind = Contacts<3>::Kind;  // Contacts<2> has the same kinds
  std::vector<ContactTime> times;
  std::map<BeadPair, double> since;
  for (const BeadPair& pair : built) since[pair] = first;
  for (const TimedEvent& event : events) {
    const BeadPair pair{event.change.ids[0], event.change.ids[1]};
    switch (event.change.kind) {
      case Kind::begin:
        since.emplace(pair, event.time);
        break;
      case Kind::end:
        if (const auto begun = since.find(pair); begun != since.end()) {
          times.push_back({pair, begun->second, event.time});
          since.erase(begun);
        }
        break;
      default:
        times.push_back({pair, event.time, event.time});
    }
  }
  for (const auto& [pair, begun] : since) times.push_back({pair, begun, last});
  std::sort(times.begin(), times.end(), [](const ContactTime& a, const ContactTime& b) {
    return std::tie(a.pair, a.from) < std::tie(b.pair, b.from);
  });
  return times;
}

namespace {

bool share_time(const ContactTime& a, const ContactTime& b, double margin) {
  return a.from <= b.to + margin && b.from <= a.to + margin;
}

std::span<const ContactTime> of_pair(std::span<const ContactTime> contacts, const BeadPair& pair) {
  const auto found = std::ranges::equal_range(contacts, pair, {}, &ContactTime::pair);
  return {found.begin(), found.end()};
}

}  // namespace

ContactMatch match_contacts(std::span<const ContactTime> expected, std::span<const ContactTime> found,
                            double margin) {
  ContactMatch match;
  match.expected = expected.size();
  for (const ContactTime& contact : expected) {
    const auto same = of_pair(found, contact.pair);
    const auto apart = [&](const ContactTime& other) {
      return std::abs(other.from - contact.from) + std::abs(other.to - contact.to);
    };
    const ContactTime* nearest = nullptr;
    for (const ContactTime& other : same) {
      if (share_time(contact, other, margin) && (nearest == nullptr || apart(other) < apart(*nearest)))
        nearest = &other;
    }
    if (nearest == nullptr) {
      ++match.missed;
      continue;
    }
    ++match.timed;
    for (const double error : {std::abs(nearest->from - contact.from), std::abs(nearest->to - contact.to)}) {
      match.time_error_sum += 0.5 * error;
      match.time_error_max = std::max(match.time_error_max, error);
    }
  }
  for (const ContactTime& contact : found) {
    const auto same = of_pair(expected, contact.pair);
    if (std::ranges::none_of(same,
                             [&](const ContactTime& other) { return share_time(contact, other, margin); }))
      ++match.spurious;
  }
  return match;
}

}  // namespace kds
