#include "structures/chord_cages/tight_cages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "structures/chord_cages/chord_cages.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/enclosing_sphere/sphere_of_balls.h"
#include "structures/enclosing_sphere/sphere_scan.h"

namespace kds {

// Proves that a moving sphere is not much larger than the minimum enclosing sphere at all times of a part of
// a step.
//
// The bound. Let balls x_i(u), r_i(u) lie in a sphere of radius S at c, and let m_i >= 0 be weights whose sum
// is 1. Then (S - r_i)^2 >= |x_i - c|^2. The weighted sum of these inequalities, with bars for weighted
// means, is
//
//   (S - r-bar)^2 + sum m_i (r_i - r-bar)^2 >= sum m_i |x_i - c|^2 >= sum m_i |x_i - x-bar|^2.
//
// So the smallest radius is at least r-bar + sqrt(V - v) for any weights, where V is the weighted variance of
// the points and v that of the radii. Equality holds at one time if the weights are the barycentric
// coordinates of the smallest sphere's centre in the basis that spans it. The bound is then tangent to the
// smallest radius at that time, and better elsewhere, because sqrt(V) is convex in linear motion. For the
// sphere R(u) under test, let rho = R - r-bar. Then
//
//   G(u) = rho^2 + v - V
//
// is a polynomial of twice the motion's degree. Let tau = R / (1 + eps) - r-bar. R <= (1 + eps) R_opt holds
// wherever tau <= 0 or G <= rho^2 - tau^2, because the latter gives r-bar + sqrt(rho^2 - G) >= R / (1 + eps).
// With s := rho - tau = eps / (1 + eps) R, the limit is rho^2 - tau^2 = s (s + 2 tau). If tau is positive
// there, this limit is least for the least R and the greatest r-bar. The limit is never less than s^2 for the
// least R. In linear motion G = (1-u) G_0 + u G_2 + u (1-u) Q, which is at most
// max(G_0, G_2) + max(Q, 0) / 4.
//
// Rounding: weights need no accuracy, because any weights give a bound. Positions are taken relative to the
// sphere's centres, so that all numbers have the size of R. The rounding errors are far below the allowance
// of 2^-42 R^2.

namespace {

using detail::BasisBalls;
using detail::dot;
using detail::minus;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 0x1p-42;  // relative rounding error of squares

// A bead at the k-th control point of its curve's part: coordinates, then radius. The numbers are rounded
// unless the part is the whole step.
template <int Dimension>
using ControlBall = std::array<double, static_cast<std::size_t>(Dimension) + 1>;
template <int Dimension>
ControlBall<Dimension> control_ball(const Curves<Dimension>& curves, BeadId bead, double from, double to,
                                    int k);
// Returns an upper bound of the distance between a control ball and the exact one, the error of its radius
// included. No coordinate or radius of the bead's control points exceeds `size`.
double control_ball_error(int degree, double size) { return degree * (0x1p-49 * size + 0x1p-1060); }

// Returns whether the sixth powers of lengths of this size keep their digits. No other lengths are judged.
bool is_judged(double radius) { return radius >= 0x1p-150 && radius <= 0x1p150; }

// Input for judging many nodes in linear motion at once: balls, cages and bases at both ends.
template <int Dimension>
struct LinearStep {
  const Balls<Dimension>& start;
  const Balls<Dimension>& end;
  OutwardCages<Dimension> start_cages, end_cages;
  std::span<const Basis> start_bases;
};

/// Returns the barycentric coordinates of the centre of the sphere around a basis. The coordinates sum to 1
/// up to rounding, and are arbitrary if the basis is degenerate in doubles.
template <bool of_points, class N, int D, std::size_t M>
[[gnu::always_inline]] inline std::array<N, M + 1> weights_of(const BasisBalls<N, D, M>& balls) {
  const detail::Span<N, D, M> span(balls);
  if constexpr (of_points) {
    std::array<N, M> y;
    (void)span.circumcenter(y);
    std::array<N, M + 1> weights;
    weights[0] = N(1.0);
    for (std::size_t i = 0; i < M; ++i) {
      weights[i + 1] = y[i];
      weights[0] = weights[0] - y[i];
    }
    return weights;
  } else {
    std::array<N, M> s;
    for (std::size_t i = 0; i < M; ++i) s[i] = balls.radius[i + 1] - balls.radius[0];
    return detail::tangent_sphere(span, s).weight;
  }
}

/// Returns an upper limit of G under which the radius is tight, given the extremes of R and of the mean
/// radius.
template <class N>
[[gnu::always_inline]] inline N most_allowed(const N& least_radius, const N& greatest_radius,
                                             const N& least_mean, const N& greatest_mean, double tightness) {
  using Is = NumberTraits<N>;
  const N share(1 / (1 + tightness)), rest(tightness / (1 + tightness));
  const N tau = Is::max(least_radius * (share - N(0x1p-48)) - greatest_mean, N(0.0));
  const N step = rest * least_radius;
  return Is::choose(greatest_radius * (share + N(0x1p-48)) <= least_mean, N(infinity),
                    step * (step + N(2.0) * tau));
}

// One piece of a motion of any degree.

/// Means, and the Bernstein coefficients of G.
template <int D>
struct Gap {
  std::array<double, 2 * 61 + 1> coefficients;
  double least_mean, greatest_mean;  // bounds of the mean radius over all control points
};

template <int D>
using Vector = std::array<double, static_cast<std::size_t>(D)>;

template <int D, std::size_t M>
std::array<double, Basis::max_size> weights_at(const std::array<ControlBall<D>, Basis::max_size>& at_end,
                                               bool equal) {
  BasisBalls<double, D, M> balls;
  for (std::size_t i = 0; i <= M; ++i) {
    std::copy_n(at_end[i].begin(), D, balls.center[i].begin());
    balls.radius[i] = at_end[i].back();
  }
  std::array<double, Basis::max_size> weights{};
  const auto some = equal ? weights_of<true>(balls) : weights_of<false>(balls);
  std::copy(some.begin(), some.end(), weights.begin());
  return weights;
}

/// Computes G with the weights of the basis at one end. Returns false if that fails.
template <int D>
bool find_gap(const Curves<D>& curves, const CagePiece<D>& piece, std::size_t which, Gap<D>& gap) {
  const Basis& basis = piece.bases[which];
  const int degree = curves.own_degree();
  const auto controls = static_cast<std::size_t>(degree) + 1;
  constexpr std::size_t most_controls = 62;
  if (controls > most_controls) return false;
  std::array<std::array<ControlBall<D>, Basis::max_size>, most_controls> balls;
  for (std::size_t k = 0; k < controls; ++k)
    for (std::size_t i = 0; i < basis.size; ++i)
      balls[k][i] = control_ball(curves, basis.beads[i], piece.from, piece.to, static_cast<int>(k));
  const auto& at_end = balls[which == 0 ? 0 : controls - 1];
  std::array<double, Basis::max_size> weights{1};
  if (basis.size > 1) {
    bool equal = true;
    for (std::size_t i = 1; i < basis.size; ++i) equal &= at_end[i].back() == at_end[0].back();
    if (basis.size == 2) {
      weights = weights_at<D, 1>(at_end, equal);
    } else if (basis.size == 3) {
      weights = weights_at<D, 2>(at_end, equal);
    } else if constexpr (D == 3) {
      weights = weights_at<D, 3>(at_end, equal);
    }
    double sum = 0;
    for (double& weight : weights) sum += weight = std::max(weight, 0.0);
    if (!(sum >= 0.5 && sum <= 2)) return false;
    for (double& weight : weights) weight /= sum;
  }
  std::array<Vector<D>, most_controls> mean{};  // relative to the cage's centre
  std::array<std::array<Vector<D>, Basis::max_size>, most_controls> seen;
  std::array<double, most_controls> mean_radius{};
  gap.least_mean = infinity;
  gap.greatest_mean = 0;
  for (std::size_t k = 0; k < controls; ++k) {
    for (std::size_t i = 0; i < basis.size; ++i) {
      for (std::size_t axis = 0; axis < D; ++axis) {
        seen[k][i][axis] = balls[k][i][axis] - piece.cages[k].center[axis];
        mean[k][axis] += weights[i] * seen[k][i][axis];
      }
      mean_radius[k] += weights[i] * balls[k][i].back();
    }
    gap.least_mean = std::min(gap.least_mean, mean_radius[k]);
    gap.greatest_mean = std::max(gap.greatest_mean, mean_radius[k]);
  }
  // The product of control points i and j contributes to Bernstein coefficient i + j.
  std::fill_n(gap.coefficients.begin(), 2 * degree + 1, 0.0);
  for (std::size_t k = 0; k < controls; ++k) {
    for (std::size_t l = 0; l < controls; ++l) {
      double product = (piece.cages[k].radius - mean_radius[k]) * (piece.cages[l].radius - mean_radius[l]);
      for (std::size_t i = 0; i < basis.size; ++i)
        product +=
            weights[i] * ((balls[k][i].back() - mean_radius[k]) * (balls[l][i].back() - mean_radius[l]) -
                          dot(seen[k][i], seen[l][i]));
      product += dot(mean[k], mean[l]);
      const auto share = static_cast<double>(binomial(degree, static_cast<int>(k))) *
                         static_cast<double>(binomial(degree, static_cast<int>(l))) /
                         static_cast<double>(binomial(2 * degree, static_cast<int>(k + l)));
      gap.coefficients[k + l] += share * product;
    }
  }
  return true;
}

/// A polynomial in Bernstein form, without heap memory.
struct GapCoefficients {
  std::size_t count;
  std::array<double, 2 * 61 + 1> of;
};
void halve(const GapCoefficients& p, GapCoefficients& left, GapCoefficients& right) {
  left.count = right.count = p.count;
  std::copy_n(p.of.begin(), p.count, right.of.begin());
  for (std::size_t last = p.count; last > 0; --last) {
    left.of[p.count - last] = right.of[0];
    for (std::size_t k = 0; k + 1 < last; ++k) right.of[k] = 0.5 * (right.of[k] + right.of[k + 1]);
  }
}

/// Returns whether everywhere at least one of two polynomials is at most its limit (Bernstein subdivision).
bool one_is_below(const std::array<GapCoefficients, 2>& of, const std::array<double, 2>& limit,
                  int halvings) {
  for (std::size_t which = 0; which < 2; ++which) {
    const auto* const begin = of[which].of.begin();
    if (std::all_of(begin, begin + of[which].count, [&](double c) { return c <= limit[which]; })) return true;
  }
  if (halvings == 0) return false;
  std::array<GapCoefficients, 2> left, right;
  for (std::size_t which = 0; which < 2; ++which) halve(of[which], left[which], right[which]);
  // Both polynomials exceed their limits in the middle.
  if (!(right[0].of[0] <= limit[0]) && !(right[1].of[0] <= limit[1])) return false;
  return one_is_below(left, limit, halvings - 1) && one_is_below(right, limit, halvings - 1);
}

// Many nodes in linear motion.

/// Returns which of four nodes, whose bases have M + 1 beads, are proved tight.
template <bool of_points, int D, std::size_t M>
[[gnu::always_inline]] inline Lanes::Mask are_tight(const LinearStep<D>& step, const FourIndices& nodes,
                                                    double tightness) {
  using Numbers = std::array<Lanes, static_cast<std::size_t>(D)>;
  const Basis* const bases = step.start_bases.data();
  const auto row = [&](const Balls<D>& balls, std::size_t j) __attribute__((always_inline)) {
    return FourBalls<D>(balls.rows(), {bases[nodes[0]].beads[j], bases[nodes[1]].beads[j],
                                       bases[nodes[2]].beads[j], bases[nodes[3]].beads[j]});
  };
  const FourBalls<D> start_cages = step.start_cages.four(nodes), end_cages = step.end_cages.four(nodes);
  BasisBalls<Lanes, D, M> balls;
  for (std::size_t j = 0; j <= M; ++j) {
    const FourBalls<D> members = row(step.start, j);
    for (std::size_t axis = 0; axis < D; ++axis) balls.center[j][axis].v = members.center[axis].v;
    balls.radius[j].v = members.radius.v;
  }
  const std::array<Lanes, M + 1> weights = weights_of<of_points>(balls);
  Lanes least = weights[0], of_start(0.0), of_end(0.0), mixed(0.0);  // of_start, of_end and mixed: variances
  Numbers start_mean, end_mean;
  start_mean.fill(Lanes(0.0));
  end_mean.fill(Lanes(0.0));
  Lanes start_mean_radius(0.0), end_mean_radius(0.0);
  for (std::size_t j = 0; j <= M; ++j) {
    least = Lanes::min(least, weights[j]);
    const FourBalls<D> there = row(step.end, j);
    Numbers at_start, at_end;
    for (std::size_t axis = 0; axis < D; ++axis) {
      at_start[axis] = balls.center[j][axis] - start_cages.center[axis];
      at_end[axis] = there.center[axis] - end_cages.center[axis];
      start_mean[axis] += weights[j] * at_start[axis];
      end_mean[axis] += weights[j] * at_end[axis];
    }
    of_start += weights[j] * dot(at_start, at_start);
    of_end += weights[j] * dot(at_end, at_end);
    mixed += weights[j] * dot(at_start, at_end);
    if constexpr (!of_points) {
      const Lanes r = balls.radius[j], s = there.radius;
      start_mean_radius += weights[j] * r;
      end_mean_radius += weights[j] * s;
      of_start -= weights[j] * r * r;
      of_end -= weights[j] * s * s;
      mixed -= weights[j] * r * s;
    }
  }
  of_start -= dot(start_mean, start_mean);
  of_end -= dot(end_mean, end_mean);
  mixed -= dot(start_mean, end_mean);
  if constexpr (of_points) {
    start_mean_radius = Lanes(step.start.radii()[0]);
    end_mean_radius = Lanes(step.end.radii()[0]);
  } else {
    of_start += start_mean_radius * start_mean_radius;
    of_end += end_mean_radius * end_mean_radius;
    mixed += start_mean_radius * end_mean_radius;
  }
  const Lanes start_rho = start_cages.radius - start_mean_radius,
              end_rho = end_cages.radius - end_mean_radius;
  const Lanes g0 = start_rho * start_rho - of_start, g2 = end_rho * end_rho - of_end,
              g1 = start_rho * end_rho - mixed;
  const Lanes bulge = Lanes(2.0) * g1 - g0 - g2;
  const Lanes greatest = Lanes::max(start_cages.radius, end_cages.radius);
  const Lanes most = Lanes::max(g0, g2) + Lanes::max(Lanes(0.25) * bulge, Lanes(0.0)) +
                     Lanes(rounding) * (greatest * greatest);
  const Lanes allowed = most_allowed(Lanes::min(start_cages.radius, end_cages.radius), greatest,
                                     Lanes::min(start_mean_radius, end_mean_radius),
                                     Lanes::max(start_mean_radius, end_mean_radius), tightness);
  // Comparisons with NaN are false. Lengths whose squares lose digits prove nothing.
  const auto sized = (greatest >= Lanes(0x1p-400)) & (greatest <= Lanes(0x1p400));
  return (least >= Lanes(0.0)) & (bulge <= Lanes(infinity)) & (most <= allowed) & sized;
}

template <bool of_points, int D, std::size_t M>
[[KDS_LANES_TARGETS]] void look_at(const LinearStep<D>& step, std::span<const NodeId> nodes, double tightness,
                                   std::vector<NodeId>& loose) {
  for (std::size_t i = 0; i < nodes.size(); i += Lanes::width) {
    std::array<NodeId, Lanes::width> four;
    for (std::size_t lane = 0; lane < Lanes::width; ++lane)
      four[lane] = nodes[std::min(i + lane, nodes.size() - 1)];
    const Lanes::Mask tight = are_tight<of_points, D, M>(step, four, tightness);
    if (Lanes::all(tight)) continue;
    for (std::size_t lane = 0; lane < Lanes::width && i + lane < nodes.size(); ++lane)
      if (tight[lane] == 0) loose.push_back(four[lane]);
  }
}

template <bool of_points, int D>
void look_at_all(const LinearStep<D>& step, double tightness, std::vector<NodeId>& loose) {
  constexpr std::size_t at_a_time = 512;
  std::array<std::array<NodeId, at_a_time + 1>, Basis::max_size> nodes;
  for (std::size_t first = 0; first < step.start_bases.size(); first += at_a_time) {
    std::array<std::size_t, Basis::max_size> count{};
    const std::size_t end = std::min(step.start_bases.size(), first + at_a_time);
    for (std::size_t node = first; node < end; ++node) {  // no branch, and no counter to wait for
      const std::size_t size = step.start_bases[node].size;
      for (std::size_t m = 0; m < Basis::max_size; ++m) {
        nodes[m][count[m]] = static_cast<NodeId>(node);
        count[m] += size == m + 1 ? 1 : 0;
      }
    }
    loose.insert(loose.end(), nodes[0].begin(), nodes[0].begin() + static_cast<std::ptrdiff_t>(count[0]));
    look_at<of_points, D, 1>(step, {nodes[1].data(), count[1]}, tightness, loose);
    look_at<of_points, D, 2>(step, {nodes[2].data(), count[2]}, tightness, loose);
    if constexpr (D == 3) look_at<of_points, D, 3>(step, {nodes[3].data(), count[3]}, tightness, loose);
  }
}

// The control points of a curve's part are blossom values whose arguments are the two ends of the part, each
// repeated some number of times. De Casteljau's algorithm computes them with one parameter per level. Every
// level averages numbers that are at most `size`, with rounding errors below 5 * 2^-53 `size`.
template <int D>
ControlBall<D> control_ball(const Curves<D>& curves, BeadId bead, double from, double to, int k) {
  const int degree = curves.own_degree();
  ControlBall<D> ball;
  const auto number = [&](int index, std::size_t which) {
    return which == D ? curves.radius(bead, index) : curves.coordinate(bead, index, static_cast<int>(which));
  };
  if (from == 0 && to == 1) {
    for (std::size_t which = 0; which <= D; ++which) ball[which] = number(k, which);
    return ball;
  }
  if (degree == 1) {
    const double t = k == 1 ? to : from;
    for (std::size_t which = 0; which <= D; ++which)
      ball[which] = number(0, which) + t * (number(1, which) - number(0, which));
    return ball;
  }
  std::array<double, 64> points{};
  for (std::size_t which = 0; which <= D; ++which) {
    for (int index = 0; index <= degree; ++index)
      points[static_cast<std::size_t>(index)] = number(index, which);
    for (int level = 1; level <= degree; ++level) {
      const double t = level <= k ? to : from;
      for (std::size_t index = 0; index + static_cast<std::size_t>(level) <= static_cast<std::size_t>(degree);
           ++index)
        points[index] += t * (points[index + 1] - points[index]);
    }
    ball[which] = points[0];
  }
  return ball;
}

// Returns whether the radius is proved to be within 1 + tightness of the smallest at all times of the piece.
// `error` bounds the error of the control balls.
template <int D>
bool is_proved_tight(const Curves<D>& curves, const CagePiece<D>& piece, double tightness, double error) {
  double least = infinity, greatest = 0;
  for (const Cage<D>& cage : piece.cages) {
    least = std::min(least, cage.radius);
    greatest = std::max(greatest, cage.radius);
  }
  if (!is_judged(greatest)) return greatest == 0;
  const double spare = rounding * (greatest * greatest) + 8 * error * (greatest + error);
  if (curves.own_degree() > 61) return false;
  const auto count = static_cast<std::size_t>(2 * curves.own_degree() + 1);
  std::array<GapCoefficients, 2> gaps;
  std::array<double, 2> limits{};
  for (std::size_t which = 0; which < 2; ++which) {
    Gap<D> gap;
    gaps[which].count = count;
    if (find_gap(curves, piece, which, gap)) {
      std::copy_n(gap.coefficients.begin(), count, gaps[which].of.begin());
      limits[which] = most_allowed(least, greatest, gap.least_mean, gap.greatest_mean, tightness) - spare;
    } else {
      std::fill_n(gaps[which].of.begin(), count, infinity);
    }
  }
  return one_is_below(gaps, limits, 4);
}

// Finds the nodes that a first test, four nodes at a time, does not prove tight.
template <int D>
void find_loose_nodes(const LinearStep<D>& step, double tightness, std::vector<NodeId>& loose) {
  loose.clear();
  if (step.start.equal_radii() && step.end.equal_radii()) {
    look_at_all<true>(step, tightness, loose);
  } else {
    look_at_all<false>(step, tightness, loose);
  }
}

}  // namespace

template <int D>
void TightCages<D>::prove(const ChordCages<StaticWrappedHierarchy<D>>& cages, const Curves<D>& curves) {
  const FloatingPointScope to_nearest;
  bisections_ = unproved_ = 0;
  bisected_.clear();
  parts_.clear();
  const NecklaceTree& tree = cages.tree();
  if (cages.degree() == 1) {
    find_loose_nodes<D>({cages.balls(0), cages.balls(1), cages.cages(0), cages.cages(1), cages.start_bases()},
                        tightness_, loose_);
    std::sort(loose_.begin(), loose_.end());
  } else {
    loose_.resize(tree.node_count());
    for (NodeId node = 0; node < loose_.size(); ++node) loose_[node] = node;
  }
  CagePiece<D> whole;
  whole.cages.resize(static_cast<std::size_t>(cages.degree()) + 1);
  if (!loose_.empty()) there_ = cages.balls(0);
  for (const NodeId node : loose_) {
    whole.bases = {cages.start_bases()[node], cages.hierarchy().basis(node)};
    for (int k = 0; k <= cages.degree(); ++k) whole.cages[static_cast<std::size_t>(k)] = cages.cages(k)[node];
    if (!is_proved_tight(curves, whole, tightness_, 0)) bisect(node, tree.range(node), whole, curves);
  }
}

// Depth-first search from the left: the parts on the stack are not proved yet.
template <int D>
void TightCages<D>::bisect(NodeId node, const BeadRange& range, const CagePiece<D>& whole,
                           const Curves<D>& curves) {
  const int degree = curves.own_degree();
  double size = 0;
  for (BeadId b = range.first; b <= range.last; ++b) {
    for (int k = 0; k <= degree; ++k) {
      for (int axis = 0; axis < D; ++axis) size = std::max(size, std::abs(curves.coordinate(b, k, axis)));
      size = std::max(size, curves.radius(b, k));
    }
  }
  double greatest = 0;
  for (const Cage<D>& cage : whole.cages) greatest = std::max(greatest, cage.radius);
  const double error = control_ball_error(degree, size);
  if (!is_judged(greatest) || error > 0x1p-3 * tightness_ * greatest) {  // no part could be proved
    ++unproved_;
    return;
  }
  const std::size_t first = parts_.size();
  std::vector<std::pair<CagePiece<D>, int>> stack{{whole, 0}};
  while (!stack.empty()) {
    const auto [part, halvings] = std::move(stack.back());
    stack.pop_back();
    if (halvings > 0 && is_proved_tight(curves, part, tightness_, error)) {
      parts_.push_back(part);
      continue;
    }
    const std::size_t parts = parts_.size() - first + stack.size() + 1;
    if (halvings == most_halvings || parts == most_parts) {
      ++unproved_;
      parts_.push_back(part);
      continue;
    }
    ++bisections_;
    const double middle = 0.5 * (part.from + part.to);
    CagePiece<D> left, right;
    left.from = part.from;
    left.to = right.from = middle;
    right.to = part.to;
    Basis basis = part.bases[0];
    left.cages.push_back(part.cages.front());
    for (int k = 1; k <= degree; ++k)
      left.cages.push_back(cage_at(range, curves, left.from, left.to, k, error, basis));
    left.bases = {part.bases[0], basis};
    right.cages.push_back(left.cages.back());
    for (int k = 1; k < degree; ++k)
      right.cages.push_back(cage_at(range, curves, right.from, right.to, k, error, basis));
    right.cages.push_back(part.cages.back());
    right.bases = {left.bases[1], part.bases[1]};
    stack.emplace_back(std::move(right), halvings + 1);
    stack.emplace_back(std::move(left), halvings + 1);
  }
  bisected_.push_back({node, first, parts_.size()});
}

// Returns the smallest sphere around a node's control balls. The search starts from `basis`, which becomes
// the sphere's basis.
template <int D>
Cage<D> TightCages<D>::cage_at(const BeadRange& range, const Curves<D>& curves, double from, double to, int k,
                               double error, Basis& basis) {
  for (BeadId b = range.first; b <= range.last; ++b) {
    const ControlBall<D> ball = control_ball(curves, b, from, to, k);
    Point<D> center;
    std::copy_n(ball.begin(), D, center.begin());
    there_.place(b, center, ball[D]);
  }
  const SmallestSphere smallest =
      smallest_sphere(there_, range.first, range.last, {basis.begin(), basis.end()});
  basis = smallest.basis;
  Cage<D> cage;
  for (std::size_t axis = 0; axis < D; ++axis)
    cage.center[axis] = smallest.sphere.center[static_cast<Eigen::Index>(axis)];
  cage.radius = (outward_radius(there_, range.first, range.last, cage.center) + error) * (1 + 0x1p-51);
  return cage;
}

template <int D>
std::span<const CagePiece<D>> TightCages<D>::parts(NodeId node) const {
  const auto found = std::lower_bound(bisected_.begin(), bisected_.end(), node,
                                      [](const Parts& parts, NodeId id) { return parts.node < id; });
  if (found == bisected_.end() || found->node != node) return {};
  return std::span(parts_).subspan(found->first, found->end - found->first);
}

template class TightCages<2>;
template class TightCages<3>;

}  // namespace kds
