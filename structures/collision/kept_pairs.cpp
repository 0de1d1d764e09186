#include "structures/collision/kept_pairs.h"

#include <algorithm>
#include <cmath>

namespace kds {

template <int Dimension>
void KeptPairs<Dimension>::keep(const Balls<Dimension>& balls, std::span<const BeadPair> near, double skin,
                                const FloatFrame<Dimension>& frame) {
  skin_ = skin;
  scale_ = frame.scale;
  pairs_.clear();
  starts_.fill(0);
  replace(balls, {}, near, 0);
}

// An unmarked bead may have been nearer to a marked bead at its reference position than now, by up to
// `moved`. The stored gap is reduced by this amount.
template <int Dimension>
void KeptPairs<Dimension>::replace(const Balls<Dimension>& balls, std::span<const unsigned char> marks,
                                   std::span<const BeadPair> near, double moved) {
  const double of_skin = classes / (skin_ * scale_), moved_since = moved * scale_;
  // Without a skin all pairs are in the first class.
  const double classes_a_gap = of_skin < 0x1p1000 ? of_skin * (1 - 0x1p-40) : 0.0;
  std::array<std::size_t, classes> added{};
  class_of_.resize(near.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    const auto [a, b] = near[k];
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = balls.coordinates(axis)[a] * scale_ - balls.coordinates(axis)[b] * scale_;
      square += d * d;
    }
    const double distance = std::sqrt(square), reach = balls.radii()[a] * scale_ + balls.radii()[b] * scale_;
    const double gap = distance - reach - (distance + reach) * 0x1p-46 - moved_since;
    const double share = gap * classes_a_gap, some = share > 0 ? share : 0.0;
    const auto its = static_cast<std::size_t>(static_cast<int>(some < classes - 1.0 ? some : classes - 1.0));
    class_of_[k] = static_cast<unsigned char>(its);
    ++added[its];
  }
  // Each class holds first the pairs that stay, in their order, then the new pairs.
  more_pairs_.resize(pairs_.size() + near.size() + 1);
  std::array<std::size_t, classes> places;
  std::size_t out = 0;
  for (std::size_t c = 0; c < classes; ++c) {
    const std::size_t begin = out;
    for (std::size_t k = starts_[c]; k < starts_[c + 1]; ++k) {
      const BeadPair pair = pairs_[k];
      more_pairs_[out] = pair;
      out += (marks[pair.first] | marks[pair.second]) == 0 ? 1 : 0;
    }
    starts_[c] = begin;
    places[c] = out;
    out += added[c];
  }
  starts_[classes] = out;
  for (std::size_t k = 0; k < near.size(); ++k) more_pairs_[places[class_of_[k]]++] = near[k];
  more_pairs_.resize(out);
  pairs_.swap(more_pairs_);
  const auto first = pairs_.begin(), last = first + static_cast<std::ptrdiff_t>(starts_[1]),
             middle = last - static_cast<std::ptrdiff_t>(added[0]);
  first_class_.assign(middle, last);
  sorter_.sort(first_class_, balls.size());
  std::copy(first_class_.begin(), first_class_.end(), middle);
  if (middle != first) std::inplace_merge(first, middle, last);
}

template <int Dimension>
void KeptPairs<Dimension>::find_meeting(const Balls<Dimension>& balls, double moved,
                                        std::vector<BeadPair>& meeting) {
  meeting.clear();
  const MeetingBalls meet(balls);
  std::size_t in_order = 0;
  for (std::size_t c = 0; c < classes; ++c) {
    // The gaps of class c are at least c / classes of the skin.
    if (c > 0 && 2 * moved < static_cast<double>(c) / classes * skin_ * (1 - 0x1p-40)) break;
    for (std::size_t k = starts_[c]; k < starts_[c + 1]; ++k)
      if (meet(pairs_[k].first, pairs_[k].second)) meeting.push_back(pairs_[k]);
    looked_at_ += starts_[c + 1] - starts_[c];
    if (c == 0) in_order = meeting.size();
  }
  if (in_order == meeting.size()) return;
  const auto middle = meeting.begin() + static_cast<std::ptrdiff_t>(in_order);
  std::sort(middle, meeting.end());
  std::inplace_merge(meeting.begin(), middle, meeting.end());
}

template class KeptPairs<2>;
template class KeptPairs<3>;

}  // namespace kds
