#include "experiments/run/met_contacts.h"

#include <stdexcept>

namespace kds {

namespace {

// The end of a step equals the start of the next step.
MetContacts::Moment moment_of(const Event& event, double u) {
  return u < 1 ? MetContacts::Moment{event.step, u} : MetContacts::Moment{event.step + 1, 0};
}

}  // namespace

void MetContacts::on_event(const Event& event) {
  if (event.kind.counted_apart) return;
  const Pair pair{event.ids()[0], event.ids()[1]};
  if (event.kind.name != "end") {
    events_.add({event, contacts_.size()});
    contacts_.push_back({pair, moment_of(event, event.lower)});
    if (event.kind.name == "begin") open_[pair] = contacts_.size() - 1;
    if (event.kind.name == "touch") contacts_.back().latest = moment_of(event, event.upper);
    return;
  }
  const auto begun = open_.find(pair);
  if (begun == open_.end()) throw std::logic_error("a contact ends that has not begun");
  events_.add({event, begun->second});
  contacts_[begun->second].latest = moment_of(event, event.upper);
  open_.erase(begun);
}

std::vector<std::uint8_t> holding(std::span<const MetContacts::Contact> contacts,
                                  std::span<const MetContacts::Contact> within) {
  std::map<MetContacts::Pair, std::vector<std::size_t>> of_pair;
  for (std::size_t k = 0; k < contacts.size(); ++k) of_pair[contacts[k].pair].push_back(k);
  std::vector<std::uint8_t> holds(contacts.size(), 0);
  for (const MetContacts::Contact& inner : within) {
    const auto same = of_pair.find(inner.pair);
    if (same == of_pair.end()) continue;
    std::vector<std::size_t> may_hold;
    for (const std::size_t k : same->second)
      if (contacts[k].earliest <= inner.latest && contacts[k].latest >= inner.earliest) may_hold.push_back(k);
    if (may_hold.size() == 1) holds[may_hold.front()] = 1;
  }
  return holds;
}

}  // namespace kds
