#include "structures/collision/kept_pairs.h"

#include <algorithm>
#include <cmath>

namespace kds {

template <int Dimension>
void KeptPairs<Dimension>::keep(const Balls<Dimension>& balls, std::span<const BeadPair> near, double skin,
                                const FloatFrame<Dimension>& frame) {
  skin_ = skin;
  const double scale = frame.scale, of_skin = classes / (skin * scale);
  starts_.fill(0);
  class_of_.resize(near.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    const auto [a, b] = near[k];
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = balls.coordinates(axis)[a] * scale - balls.coordinates(axis)[b] * scale;
      square += d * d;
    }
    const double distance = std::sqrt(square), reach = balls.radii()[a] * scale + balls.radii()[b] * scale;
    const double gap = distance - reach - (distance + reach) * 0x1p-46;
    // Of no skin all pairs are in the first.
    const double share = gap * of_skin * (1 - 0x1p-40);
    const auto its = share > 0 && of_skin < 0x1p1000
                         ? static_cast<std::size_t>(std::min(share, classes - 1.0))
                         : std::size_t{0};
    class_of_[k] = static_cast<unsigned char>(its);
    ++starts_[its + 1];
  }
  for (std::size_t c = 0; c < classes; ++c) starts_[c + 1] += starts_[c];
  pairs_.resize(near.size());
  auto places = starts_;
  for (std::size_t k = 0; k < near.size(); ++k) pairs_[places[class_of_[k]]++] = near[k];
  first_class_.assign(pairs_.begin(), pairs_.begin() + static_cast<std::ptrdiff_t>(starts_[1]));
  sorter_.sort(first_class_, balls.size());
  std::copy(first_class_.begin(), first_class_.end(), pairs_.begin());
}

template <int Dimension>
void KeptPairs<Dimension>::find_meeting(const Balls<Dimension>& balls, double moved,
                                        std::vector<BeadPair>& meeting) {
  meeting.clear();
  std::size_t in_order = 0;
  for (std::size_t c = 0; c < classes; ++c) {
    // Its gaps are at least that share of the skin.
    if (c > 0 && 2 * moved < static_cast<double>(c) / classes * skin_ * (1 - 0x1p-40)) break;
    for (std::size_t k = starts_[c]; k < starts_[c + 1]; ++k)
      if (balls_meet(balls, pairs_[k].first, pairs_[k].second)) meeting.push_back(pairs_[k]);
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
