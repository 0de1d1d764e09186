#pragma once
// How long a conservative test can prove that something holds, by pieces of time that double when proved and
// halve when not. Early, never late: it may give up at once, and what it says holds.

#include <algorithm>
#include <concepts>

namespace kds {

/// Pieces tried before a test gives up.
inline constexpr int default_pieces = 24;

/// The end of the last proved piece: `proves(lower, upper)` was true of pieces that cover [from, the answer].
template <std::predicate<double, double> Proves>
[[nodiscard]] double proved_until(double from, int pieces, Proves proves) {
  double proved = from;
  double step = 1 - from;
  while (proved < 1 && pieces-- > 0) {
    const double upper = std::min(1.0, proved + step);
    if (!(upper > proved)) break;
    if (proves(proved, upper)) {
      proved = upper;
      step *= 2;
    } else {
      step *= 0.5;
    }
  }
  return proved;
}

}  // namespace kds
