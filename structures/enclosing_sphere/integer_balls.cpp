#include "structures/enclosing_sphere/integer_balls.h"

#include <algorithm>
#include <array>
#include <limits>

namespace kds {

template <int Dimension>
Basis proper_part(const Basis& basis, const IntegerBalls<Dimension>& whole) {
  const auto balls = whole.of(std::span(basis.begin(), basis.end()));
  const auto sphere = ExactSphere<Dimension>::touching(balls);
  if (sphere && sphere->is_proper()) return basis;
  Basis part;
  for (const std::size_t index : exact_basis_among<Dimension>(balls))
    part.beads[part.size++] = basis.beads[index];
  return part;
}

template <int Dimension>
bool is_surely_basis_of(const Basis& basis, const BeadRange& range,
                        const RoundedPositions<Dimension>& positions) {
  using Ball = BallOver<Dimension, TrackedDouble>;
  const auto ball_of = [&](BeadId bead) {
    Ball ball;
    for (std::size_t axis = 0; axis < Dimension; ++axis) ball.center[axis] = positions.coordinate(bead, axis);
    ball.radius = positions.radius(bead);
    return ball;
  };
  std::array<Ball, Dimension + 1> members;
  std::transform(basis.begin(), basis.end(), members.begin(), ball_of);
  const auto sphere = TouchingSphere<Dimension, TrackedDouble>::touching({members.data(), basis.size});
  if (!sphere || !sphere->is_proper()) return false;
  for (BeadId b = range.first; b <= range.last; ++b)
    if (!basis.contains(b) && !sphere->holds(ball_of(b))) return false;
  return true;
}

template <int Dimension>
std::optional<BeadId> bead_outside(const Basis& basis, const BeadRange& range,
                                   const IntegerBalls<Dimension>& whole) {
  const auto sphere = ExactSphere<Dimension>::touching(whole.of(std::span(basis.begin(), basis.end())));
  for (BeadId b = range.first; b <= range.last; ++b)
    if (!basis.contains(b) && !sphere->holds(whole.balls[b])) return b;
  return std::nullopt;
}

template <int Dimension>
IntegerBalls<Dimension> integer_balls_at(const Curves<Dimension>& curves, const Dyadic& time) {
  const int degree = curves.own_degree();
  int lowest = std::numeric_limits<int>::max();
  const auto each_number = [&](auto&& visit) {
    for (BeadId b = 0; b < curves.bead_count(); ++b) {
      for (int k = 0; k <= degree; ++k) {
        for (int axis = 0; axis < Dimension; ++axis) visit(curves.coordinate(b, k, axis));
        visit(curves.radius(b, k));
      }
    }
  };
  each_number([&](double x) {
    if (x != 0) lowest = std::min(lowest, split(x).exponent);
  });
  if (lowest == std::numeric_limits<int>::max()) lowest = 0;
  const Integer later = time.numerator();
  const Integer earlier = (Integer(1) << time.exponent()) - later;
  // De Casteljau's algorithm; each round multiplies by another factor 2^exponent of the time.
  const auto at_time = [&](auto&& control) {
    std::vector<Integer> p;
    for (int k = 0; k <= degree; ++k) {
      const SplitDouble parts = split(control(k));
      p.push_back(parts.mantissa == 0
                      ? Integer(0)
                      : Integer(Integer(parts.mantissa) << static_cast<unsigned>(parts.exponent - lowest)));
    }
    for (std::size_t round = p.size() - 1; round > 0; --round) {
      for (std::size_t i = 0; i < round; ++i) p[i] = p[i] * earlier + p[i + 1] * later;
    }
    return p[0];
  };
  IntegerBalls<Dimension> whole;
  whole.unit = lowest - degree * static_cast<int>(time.exponent());
  whole.balls.resize(curves.bead_count());
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    for (int axis = 0; axis < Dimension; ++axis)
      whole.balls[b].center[static_cast<std::size_t>(axis)] =
          at_time([&](int k) { return curves.coordinate(b, k, axis); });
    whole.balls[b].radius = at_time([&](int k) { return curves.radius(b, k); });
  }
  return whole;
}

template IntegerBalls<2> integer_balls_at(const Curves<2>&, const Dyadic&);
template IntegerBalls<3> integer_balls_at(const Curves<3>&, const Dyadic&);
template Basis proper_part(const Basis&, const IntegerBalls<2>&);
template Basis proper_part(const Basis&, const IntegerBalls<3>&);
template bool is_surely_basis_of(const Basis&, const BeadRange&, const RoundedPositions<2>&);
template bool is_surely_basis_of(const Basis&, const BeadRange&, const RoundedPositions<3>&);
template std::optional<BeadId> bead_outside(const Basis&, const BeadRange&, const IntegerBalls<2>&);
template std::optional<BeadId> bead_outside(const Basis&, const BeadRange&, const IntegerBalls<3>&);

}  // namespace kds
