#pragma once
// What is tried in vain is tried less and less often: motion that is too fast for something is so for a
// while.

#include <algorithm>

namespace kds {

class BackOff {
 public:
  /// After the first attempt in vain `first` occasions go by, then more and more, at most `most`.
  constexpr BackOff(unsigned first, unsigned most) : first_(first), most_(most), next_(first) {}

  /// Whether this occasion goes by.
  [[nodiscard]] constexpr bool skips() {
    if (left_ == 0) return false;
    --left_;
    return true;
  }
  /// An attempt was in vain.
  constexpr void lengthen() {
    left_ = next_;
    next_ = std::min(2 * next_ + 1, most_);
  }
  /// An attempt was worth while.
  constexpr void reset() {
    left_ = 0;
    next_ = first_;
  }

 private:
  unsigned first_, most_;
  unsigned left_ = 0, next_;
};

}  // namespace kds
