#pragma once
// One axis of a plot: where values stand on it, and at which of them there are ticks.

#include <cstddef>
#include <string>
#include <vector>

namespace kds {

struct Tick {
  double value;
  std::string label;
};

class Axis {
 public:
  /// From `least` to `most`, finite; where they are as good as equal, or on a logarithmic axis not above 0, a
  /// range around them.
  Axis(double least, double most, bool logarithmic);

  /// 0 at its start, 1 at its end.
  [[nodiscard]] double share(double value) const;
  /// About `most` at round values; on a logarithmic axis at powers of ten where these are two or more.
  [[nodiscard]] std::vector<Tick> ticks(std::size_t most) const;
  /// Lets a linear axis go on to the next round values.
  void widen_to_ticks(std::size_t most);

 private:
  [[nodiscard]] double step(std::size_t most) const;

  double from_, to_;
  bool logarithmic_;
};

/// A value as ticks, and what the pointer shows, have it: 12,000, 0.25, 3·10⁻⁷.
[[nodiscard]] std::string tick_label(double value);

}  // namespace kds
