#include "structures/contacts/sampled_contacts.h"

#include "structures/contacts/contacts.h"

namespace kds {

SampledContacts::SampledContacts(std::span<const std::size_t> strides) {
  for (const std::size_t stride : strides) samplings_.push_back({stride, 0, 0});
}

void SampledContacts::add_built(std::span<const BeadPair> pairs) {
  for (const BeadPair& pair : pairs) since_[pair] = 0;
}

void SampledContacts::on_event(const Event& event) {
  using Kind = Contacts<3>::Kind;
  if (event.structure != "contacts") return;
  const BeadPair pair{event.change.ids[0], event.change.ids[1]};
  // If the bracket is a single number, this number is the time itself.
  const bool at_frame = event.lower == 0 && event.upper == 0;
  const std::size_t next_frame = event.step + (at_frame ? 0 : 1), frame_before = event.step;
  switch (static_cast<Kind>(event.change.kind)) {
    case Kind::begin:
      since_[pair] = next_frame;
      break;
    case Kind::end:
      count(since_[pair], frame_before);
      since_.erase(pair);
      break;
    case Kind::touch:
      count(next_frame, frame_before);
      break;
    default:  // an edit of a bead
      break;
  }
}

void SampledContacts::finish(std::size_t last_frame) {
  for (const auto& [pair, first_frame] : since_) count(first_frame, last_frame);
  since_.clear();
}

// Counts a contact that lasts over these frames. If the last frame precedes the first, the contact contains
// no frame.
void SampledContacts::count(std::size_t first_frame, std::size_t last_frame) {
  for (Sampling& sampling : samplings_) {
    const std::size_t looked_at = (first_frame + sampling.stride - 1) / sampling.stride * sampling.stride;
    ++sampling.contacts;
    if (looked_at <= last_frame) ++sampling.found;
  }
}

}  // namespace kds
