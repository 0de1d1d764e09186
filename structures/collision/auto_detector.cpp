#include "structures/collision/auto_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "motions/base/floating_point_scope.h"

namespace kds {

template <int Dimension>
void KeptPairs<Dimension>::keep(const Balls<Dimension>& balls, std::span<const BeadPair> near, double skin,
                                const FloatConversion<Dimension>& conversion) {
  skin_ = skin;
  scale_ = conversion.scale;
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
  std::array<std::size_t, classes> starts;
  std::size_t out = 0;
  for (std::size_t c = 0; c < classes; ++c) {
    const std::size_t begin = out;
    for (std::size_t k = starts_[c]; k < starts_[c + 1]; ++k) {
      const BeadPair pair = pairs_[k];
      more_pairs_[out] = pair;
      out += (marks[pair.first] | marks[pair.second]) == 0 ? 1 : 0;
    }
    starts_[c] = begin;
    starts[c] = out;
    out += added[c];
  }
  starts_[classes] = out;
  for (std::size_t k = 0; k < near.size(); ++k) more_pairs_[starts[class_of_[k]]++] = near[k];
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

namespace {

constexpr double frames_to_keep = 64;  // the skin should last this many frames if it is not too wide then
constexpr double fewest_frames = 4;    // for fewer frames, a search from scratch is cheaper
constexpr std::uint64_t longest_wait = 16;
// Above the first limit the next skin is shorter. Above the second no pairs are kept.
constexpr std::size_t most_pairs_a_bead = 4, most_kept_a_bead = 32;
// Blocks that have moved farther than far_in_skins are searched again alone if they are at most 1 /
// share_of_few of all blocks.
constexpr double far_in_skins = 0.25;
constexpr std::size_t share_of_few = 4;

}  // namespace

template <int Dimension>
AutoDetector<Dimension>::AutoDetector(PairsAsked asked, std::optional<double> speed, VectorTarget target)
    : target_(target), tree_(std::move(asked), std::nullopt, target), speed_(speed) {
  if (speed_ && !(*speed_ >= 0 && std::isfinite(*speed_)))
    throw std::invalid_argument("expected a finite speed, not negative");
}

template <int Dimension>
void AutoDetector<Dimension>::forget() {
  mode_ = Mode::nothing;
  tree_.forget_order();
}

template <int Dimension>
bool AutoDetector<Dimension>::same_radii(const Balls<Dimension>& balls) const {
  const std::size_t count = balls.equal_radii() ? std::min<std::size_t>(balls.size(), 1) : balls.size();
  return radii_.size() == count && std::equal(radii_.begin(), radii_.end(), balls.radii());
}

// Sets the longest initial skin: half the mean radius, or a fourth of the mean bond if beads have no radius.
// If the skin is zero or not finite, no pairs are kept.
template <int Dimension>
void AutoDetector<Dimension>::measure_scene(const Balls<Dimension>& balls) {
  const std::size_t beads = balls.size();
  radii_.assign(balls.radii(),
                balls.radii() + (balls.equal_radii() ? std::min<std::size_t>(beads, 1) : beads));
  const std::size_t stride = beads / 1024 + 1;
  double radii = 0, bonds = 0, count = 0;
  for (BeadId b = 0; b + 1 < beads; b += static_cast<BeadId>(stride)) {
    double square = 0;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      const double d = balls.coordinate(b + 1, axis) - balls.coordinate(b, axis);
      square += d * d;
    }
    radii += balls.radius(b);
    bonds += std::sqrt(square);
    ++count;
  }
  longest_skin_ = count > 0 ? (radii > 0 ? 0.5 * radii : 0.25 * bonds) / count : 0;
  if (!std::isfinite(longest_skin_)) longest_skin_ = 0;
  too_wide_ = std::numeric_limits<double>::infinity();
}

template <int Dimension>
const std::vector<BeadPair>& AutoDetector<Dimension>::from_scratch(const Balls<Dimension>& balls) {
  ++counts_.from_scratch;
  mode_ = Mode::scratch;
  if (const auto* found = tree_.pairs_unless(balls, most_kept_a_bead * balls.size())) return *found;
  ++counts_.by_cells;
  if (!cells_) cells_.emplace(tree_.asked());
  return cells_->pairs(balls);
}

template <int Dimension>
const std::vector<BeadPair>& AutoDetector<Dimension>::rebuild(const Balls<Dimension>& balls, double step) {
  const double skin = std::clamp(2 * frames_to_keep * step, longest_skin_ / 16, longest_skin_);
  const auto near = tree_.near_pairs(balls, skin, most_kept_a_bead * balls.size());
  if (!near) {
    longest_skin_ = 0.5 * skin;
    until_look_ = look_every_ = longest_wait;
    return from_scratch(balls);
  }
  ++counts_.rebuilds;
  kept_.keep(balls, *near, skin, tree_.conversion());
  // A wide skin suits scenes in which few beads are near others.
  if (kept_.size() > most_pairs_a_bead * balls.size()) longest_skin_ = std::min(longest_skin_, 0.5 * skin);
  mode_ = Mode::kept;
  moved_ = 0;
  frames_kept_ = 0;
  kept_.find_meeting(balls, 0, pairs_);
  return pairs_;
}

// Returns a bound of how far the beads of all but a few blocks have moved.
template <int Dimension>
double AutoDetector<Dimension>::most_stray(std::span<const double> strays) {
  strays_.assign(strays.begin(), strays.end());
  const std::size_t few = strays_.size() / share_of_few;
  const auto most = strays_.end() - 1 - static_cast<std::ptrdiff_t>(few);
  std::nth_element(strays_.begin(), most, strays_.end());
  return *most;
}

// Returns how far beads have moved since the frame before. If beads have moved too far for keeping pairs,
// returns how far all but a few blocks have moved, because repairs handle the few.
template <int Dimension>
double AutoDetector<Dimension>::usual_step(const Balls<Dimension>& balls) {
  if (speed_) return *speed_;
  const double step = tree_.strayed(balls);
  return 2 * fewest_frames * step < longest_skin_ ? step : most_stray(tree_.strayed_by_block(balls));
}

// Searches again the pairs of blocks that have moved far. Returns false if there are too many pairs. The
// other pairs stay valid: no bead is farther than half the skin from where its pairs were found, so two beads
// that meet now were at most the skin apart there.
template <int Dimension>
bool AutoDetector<Dimension>::repair(const Balls<Dimension>& balls, std::span<const double> strays) {
  const double near_enough = far_in_skins * kept_.skin();
  far_blocks_.clear();
  moved_ = 0;
  for (std::uint32_t block = 0; block < strays.size(); ++block) {
    if (strays[block] <= near_enough) {
      moved_ = std::max(moved_, strays[block]);
    } else {
      far_blocks_.push_back(block);
    }
  }
  const std::size_t most = most_kept_a_bead * balls.size();
  const auto near = tree_.near_pairs_of(balls, far_blocks_, most - std::min(most, kept_.size()));
  if (!near) return false;
  kept_.replace(balls, tree_.looked_at_again(), *near, moved_);
  ++counts_.repairs;
  return true;
}

// Widens the skin if almost no pairs are near. Each attempt doubles the skin. An attempt that finds more
// pairs is the last.
template <int Dimension>
void AutoDetector<Dimension>::widen_skin(const Balls<Dimension>& balls, double wanted) {
  constexpr int most_tries = 4;
  const std::size_t few = balls.size() / 64;
  const auto& counts = tree_.counts();
  if (mode_ == Mode::kept && kept_.size() > few) return;  // counts may be those of a repair
  for (int k = 0; k < most_tries && longest_skin_ <= wanted && longest_skin_ < 0x1p900; ++k) {
    const double wider = 2 * longest_skin_;
    if (wider >= too_wide_ || counts.group_pairs + counts.candidates > few) return;
    if (!tree_.near_pairs(balls, wider, few) || counts.group_pairs > few) {
      too_wide_ = wider;
      return;
    }
    longest_skin_ = wider;
  }
}

template <int Dimension>
const std::vector<BeadPair>& AutoDetector<Dimension>::pairs(const Balls<Dimension>& balls) {
  const FloatingPointScope to_nearest;
  if (mode_ == Mode::nothing || balls.size() != tree_.bead_count() || balls.size() == 0 ||
      (!speed_ && !radii_.empty() && !same_radii(balls))) {
    radii_.clear();  // measure the scene only once a second frame needs it
    until_look_ = 0;
    look_every_ = 1;
    return from_scratch(balls);
  }
  if (mode_ == Mode::scratch) {
    if (until_look_ > 0) {
      --until_look_;
      return from_scratch(balls);
    }
    if (radii_.empty()) measure_scene(balls);
    // The tree still holds the positions of the previous frame.
    const double step = usual_step(balls);
    widen_skin(balls, 2 * frames_to_keep * step);
    if (longest_skin_ > 2 * fewest_frames * step) return rebuild(balls, step);
    look_every_ = std::min(2 * look_every_, longest_wait);
    until_look_ = look_every_;
    return from_scratch(balls);
  }
  ++frames_kept_;
  if (speed_) moved_ = (moved_ + *speed_) * (1 + 0x1p-50);
  const double most = 0.5 * kept_.skin();
  if (speed_ && moved_ <= most) {
    ++counts_.unread;
  } else if (const double strayed = tree_.strayed(balls); strayed <= most) {
    look_every_ = 1;
    moved_ = strayed;
    ++counts_.read;
  } else {
    const auto strays = tree_.strayed_by_block(balls);
    const double usual = most_stray(strays);
    if (!(usual <= far_in_skins * kept_.skin() && repair(balls, strays))) {
      const auto frames = static_cast<double>(frames_kept_);
      const double step = speed_ ? *speed_ : usual / frames;
      widen_skin(balls, 2 * frames_to_keep * step);
      if (frames >= fewest_frames && step < longest_skin_) return rebuild(balls, step);
      until_look_ = look_every_ = std::min(2 * look_every_, longest_wait);
      return from_scratch(balls);
    }
    look_every_ = 1;
  }
  kept_.find_meeting(balls, moved_, pairs_);
  return pairs_;
}

template class AutoDetector<2>;
template class AutoDetector<3>;

}  // namespace kds
