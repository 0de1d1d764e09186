#pragma once
// The double stage: a polynomial whose Bernstein coefficients are known up to a proved error, and the first
// place where it certainly turns negative. No allocation, bounded work. What it cannot prove it says so.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace kds {

enum class Verdict : std::uint8_t { never, found, undecided };

template <int Degree>
struct BoundedPolynomial {
  using Coefficients = std::array<double, static_cast<std::size_t>(Degree) + 1>;

  Coefficients bernstein;  ///< plain Bernstein coefficients on [0,1]
  double value_error;      ///< of any value at a double
  double local_error;      ///< of the coefficients after subdivision; NaN: nothing can be proved

  struct Bracket {
    double lower, upper;
  };
  struct Result {
    Verdict verdict;
    Bracket bracket;
  };

  [[nodiscard]] double value_at(double u) const {
    Coefficients c = bernstein;
    const double v = 1 - u;
    for (std::size_t round = Degree; round > 0; --round) {
      for (std::size_t i = 0; i < round; ++i) c[i] = v * c[i] + u * c[i + 1];
    }
    return c[0];
  }

  /// 1 or -1 if that is the sign at u for certain, else 0.
  [[nodiscard]] int certain_sign_at(double u) const {
    const double value = value_at(u);
    return value > value_error ? 1 : value < -value_error ? -1 : 0;
  }

  /// 1 or -1 if that is the sign all over [lower, upper] for certain, else 0.
  [[nodiscard]] int certain_sign_on(double lower, double upper) const {
    const double value = value_at(upper);
    double reach = value_error;
    if (lower < upper) {
      double steepest = 0;
      for (std::size_t i = 0; i < Degree; ++i)
        steepest = std::max(steepest, std::abs(bernstein[i + 1] - bernstein[i]));
      // |p'| <= Degree * steepest; coefficients err by value_error each.
      reach += Degree * (steepest + 2 * value_error) * (upper - lower) * (1 + 0x1p-40);
    }
    return value > reach ? 1 : value < -reach ? -1 : 0;
  }

  /// The first root after `from` at which the polynomial turns negative, in a bracket that proves it:
  /// certainly positive on [from, lower], negative at upper, and one root between. `from` must be certainly
  /// positive.
  [[nodiscard]] Result first_descent(double from) const;

 private:
  struct Segment {
    double lower, upper;
    Coefficients c;
    int depth = 0;  // subdivisions that led here: the error bound allows for so many
  };

  enum class Shape : std::uint8_t { positive, one_descent, unclear };
  [[nodiscard]] Shape shape_of(const Coefficients& c) const;
  static void split(const Segment& whole, double middle, Segment& left, Segment& right);
  [[nodiscard]] Bracket narrow(const Segment& segment) const;
};

template <int Degree>
auto BoundedPolynomial<Degree>::shape_of(const Coefficients& c) const -> Shape {
  // +...+ ? -...-, with one doubtful coefficient or none, has exactly one sign variation whatever that one
  // is: one root, by Descartes.
  std::size_t positive = 0;
  while (positive <= Degree && c[positive] > local_error) ++positive;
  if (positive > Degree) return Shape::positive;
  std::size_t negative = 0;
  while (negative <= Degree && c[Degree - negative] < -local_error) ++negative;
  const bool doubtful = positive + negative == Degree && !std::isnan(c[positive]);
  const bool one_descent = positive > 0 && negative > 0 && (doubtful || positive + negative > Degree);
  return one_descent ? Shape::one_descent : Shape::unclear;
}

template <int Degree>
void BoundedPolynomial<Degree>::split(const Segment& whole, double middle, Segment& left, Segment& right) {
  const double t = (middle - whole.lower) / (whole.upper - whole.lower);
  const double s = 1 - t;
  right.c = whole.c;
  left.c[0] = whole.c[0];
  for (std::size_t round = Degree; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) right.c[i] = s * right.c[i] + t * right.c[i + 1];
    left.c[Degree - round + 1] = right.c[0];
  }
  left.lower = whole.lower;
  left.upper = right.lower = middle;
  right.upper = whole.upper;
  left.depth = right.depth = whole.depth + 1;
}

template <int Degree>
auto BoundedPolynomial<Degree>::narrow(const Segment& segment) const -> Bracket {
  // Newton on the segment, guarded by the bracket of signs seen so far.
  double low = 0;
  double high = 1;
  double t = segment.c[0] / (segment.c[0] - segment.c[Degree]);
  double slope = 0;
  for (int iteration = 0; iteration < 70; ++iteration) {
    Coefficients c = segment.c;
    const double s = 1 - t;
    for (std::size_t round = Degree; round > 1; --round) {
      for (std::size_t i = 0; i < round; ++i) c[i] = s * c[i] + t * c[i + 1];
    }
    const double value = s * c[0] + t * c[1];
    slope = Degree * (c[1] - c[0]);
    if (value > 0) {
      low = t;
    } else {
      high = t;
    }
    double next = t - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool settled = std::abs(next - t) <= 0x1p-36;
    t = next;
    if (settled) break;
  }
  const double length = segment.upper - segment.lower;
  const double root = segment.lower + length * t;
  // Far enough on both sides for the signs to be certain, also where a later search starts; the segment's own
  // ends are.
  const double doubtful = 4 * local_error * length / std::abs(slope);
  double reach = std::max({doubtful, length * 0x1p-40, root * 0x1p-50});
  Bracket bracket{segment.lower, segment.upper};
  for (int attempt = 0; attempt < 6; ++attempt, reach *= 16) {
    const double lower = root - reach;
    const double upper = root + reach;
    if (lower > bracket.lower && certain_sign_at(lower) > 0) bracket.lower = lower;
    if (upper < bracket.upper && certain_sign_at(upper) < 0) bracket.upper = upper;
    if (bracket.lower != segment.lower && bracket.upper != segment.upper) break;
  }
  return bracket;
}

template <int Degree>
auto BoundedPolynomial<Degree>::first_descent(double from) const -> Result {
  // Segments yet to be searched, the leftmost on top. Depth and number are bounded, so is the work.
  constexpr int max_depth = 30;
  constexpr int max_segments = 200;
  std::array<Segment, max_depth + 2> stack;
  int top = 0;
  stack[0] = {0, 1, bernstein, 0};
  if (from > 0) {
    Segment before;
    const Segment whole = stack[0];
    split(whole, from, before, stack[0]);
  }
  for (int count = 0; count < max_segments; ++count) {
    const Segment segment = stack[static_cast<std::size_t>(top)];
    switch (shape_of(segment.c)) {
      case Shape::positive:
        if (top == 0) return {Verdict::never, {}};
        --top;
        continue;
      case Shape::one_descent:
        return {Verdict::found, narrow(segment)};
      case Shape::unclear:
        break;
    }
    if (segment.depth >= max_depth || !(segment.c[0] > local_error)) break;
    // A root at the middle itself would never be settled: look aside for a certain sign.
    const double length = segment.upper - segment.lower;
    bool certain = false;
    for (const double share : {0.5, 0.4375, 0.578125, 0.3515625}) {
      const double middle = segment.lower + share * length;
      if (!(middle > segment.lower && middle < segment.upper)) break;
      split(segment, middle, stack[static_cast<std::size_t>(top) + 1], stack[static_cast<std::size_t>(top)]);
      const double value = stack[static_cast<std::size_t>(top)].c[0];
      if (value > local_error || value < -local_error) {
        certain = true;
        break;
      }
    }
    if (!certain) break;
    ++top;
  }
  return {Verdict::undecided, {}};
}

}  // namespace kds
