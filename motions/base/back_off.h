#pragma once
// Back-off: after failed attempts at an optimization, it is tried less and less often, because motion that is
// too fast for it usually stays so for a while.

#include <algorithm>

namespace kds {

class BackOff {
 public:
  /// After the first failed attempt, `first` occasions are skipped, then more and more, at most `most`.
  constexpr BackOff(unsigned first, unsigned most) : first_(first), most_(most), next_(first) {}

  /// Returns whether to skip this occasion.
  [[nodiscard]] constexpr bool skips() {
    if (left_ == 0) return false;
    --left_;
    return true;
  }
  /// Records a failed attempt.
  constexpr void lengthen() {
    left_ = next_;
    next_ = std::min(2 * next_ + 1, most_);
  }
  /// Records a successful attempt.
  constexpr void reset() {
    left_ = 0;
    next_ = first_;
  }

 private:
  unsigned first_, most_;
  unsigned left_ = 0, next_;
};

}  // namespace kds
