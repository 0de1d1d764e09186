#include "structures/sphere_path.h"

#include <algorithm>
#include <cmath>

#include "certificates/determinant.h"
#include "motions/bernstein.h"
#include "motions/lanes.h"
#include "structures/point_sphere.h"

namespace kds {

namespace {

using detail::root_of;

// Relative to the lengths that went in; the roundings of the formulas here add up to less than 2^-48.
constexpr double margin = 0x1p-45;
constexpr double up = 1 + 0x1p-30;

template <int D>
using Vec = std::array<double, static_cast<std::size_t>(D)>;

/// The control points of the part from `from` on.
template <class Value, std::size_t N>
[[gnu::always_inline]] inline void cut(std::array<Value, N>& control, const Value& earlier,
                                       const Value& later) {
  for (std::size_t round = 1; round < N; ++round) {
    for (std::size_t i = 0; i + round < N; ++i) control[i] = earlier * control[i] + later * control[i + 1];
  }
}

/// At one end: the touching sphere, seen from the first ball.
template <int D, std::size_t M>
struct End {
  Vec<D> z;
  double rho = 0;
  std::array<double, M + 1> weight;  // barycentric coordinates of z
};

template <int D, std::size_t M>
End<D, M> end_of(const std::array<Vec<D>, M>& d, const std::array<double, M>& s) {
  detail::BasisBalls<double, D, M> balls;
  balls.center[0] = {};
  for (std::size_t i = 0; i < M; ++i) balls.center[i + 1] = d[i];
  const detail::Span<double, D, M> span(balls);
  std::array<double, M> e, yp, yq;
  for (std::size_t i = 0; i < M; ++i) e[i] = 0.5 * (span.square[i] - s[i] * s[i]);
  const Vec<D> p = span.point_of(e, yp);
  const Vec<D> q = span.point_of(s, yq);
  const double a = detail::dot(q, q) - 1, b = detail::dot(p, q), c = detail::dot(p, p);
  End<D, M> end;
  end.rho = c / (std::sqrt(std::max(b * b - a * c, 0.0)) - b);
  end.weight[0] = 1;
  for (std::size_t i = 0; i < M; ++i) {
    end.weight[i + 1] = yp[i] + end.rho * yq[i];
    end.weight[0] -= end.weight[i + 1];
  }
  for (std::size_t axis = 0; axis < D; ++axis) end.z[axis] = p[axis] + end.rho * q[axis];
  return end;
}

// Bounds of polynomials by their Bernstein coefficients.

template <int N>
inline constexpr auto by_binomial = [] {
  std::array<double, N + 1> by{};
  for (int k = 0; k <= N; ++k) by[static_cast<std::size_t>(k)] = 1.0 / static_cast<double>(binomial(N, k));
  return by;
}();
template <int N>
double coefficient(const Bernstein<double, N>& p, int k) {
  return p.scaled[static_cast<std::size_t>(k)] * by_binomial<N>[static_cast<std::size_t>(k)];
}
template <int N>
double least(const Bernstein<double, N>& p) {
  double lowest = HUGE_VAL;
  for (int k = 0; k <= N; ++k) lowest = std::min(lowest, coefficient(p, k));
  return lowest;
}
template <int N, std::size_t Size>
double square(const std::array<Bernstein<double, N>, Size>& v, int k) {
  double sum = 0;
  for (const auto& p : v) sum += coefficient(p, k) * coefficient(p, k);
  return sum;
}
/// Of the length.
template <int N, std::size_t Size>
double most(const std::array<Bernstein<double, N>, Size>& v) {
  double highest = 0;
  for (int k = 0; k <= N; ++k) highest = std::max(highest, square(v, k));
  return std::sqrt(highest);
}
/// The same where it nearly vanishes at both ends: 1 - u^N - (1-u)^N <= 1 - 2^(1-N).
template <int N, std::size_t Size>
double most_between(const std::array<Bernstein<double, N>, Size>& v) {
  double inner = 0;
  for (int k = 1; k < N; ++k) inner = std::max(inner, square(v, k));
  return (1 - std::ldexp(1.0, 1 - N)) * std::sqrt(inner) + std::sqrt(std::max(square(v, 0), square(v, N)));
}
/// A lower bound of the length.
template <int N, std::size_t Size>
double least_length(const std::array<Bernstein<double, N>, Size>& v) {
  std::array<double, Size> along;
  for (std::size_t i = 0; i < Size; ++i) along[i] = v[i].scaled.front() + v[i].scaled.back();
  const double length = std::sqrt(detail::dot(along, along));
  double lowest = HUGE_VAL;
  for (int k = 0; k <= N; ++k) {
    double projection = 0;
    for (std::size_t i = 0; i < Size; ++i) projection += coefficient(v[i], k) * along[i];
    lowest = std::min(lowest, projection);
  }
  return lowest / length;
}

/// What solving for a point by its products with the c_i costs: from residuals r_i the point errs by sum
/// gain_i |r_i| / volume at most. One by the height of ball i > 0 is gain_i / volume too.
template <std::size_t M>
struct Simplex {
  std::array<double, M> gain;
  double gain_of_first = 0;
  double volume = 0;    // the least
  double off_hull = 0;  // how far z' leaves the affine hull, times the volume
};

template <int D, std::size_t M, int K>
Simplex<M> simplex_of(const std::array<BernsteinVector<double, K, D>, M>& d,
                      const BernsteinVector<double, 1, D>& z) {
  Simplex<M> simplex;
  if constexpr (M == 1) {
    simplex.gain[0] = simplex.gain_of_first = 1;
    simplex.volume = least_length(d[0]);
    if constexpr (D == 2) {
      simplex.off_hull = most_between(std::array{d[0][0] * z[1] - d[0][1] * z[0]});
    } else {
      simplex.off_hull = most_between(std::array{
          d[0][1] * z[2] - d[0][2] * z[1], d[0][2] * z[0] - d[0][0] * z[2], d[0][0] * z[1] - d[0][1] * z[0]});
    }
  } else if constexpr (M == 2) {
    simplex.gain = {most(d[1]), most(d[0])};
    auto edge = d[1];
    for (std::size_t axis = 0; axis < D; ++axis) edge[axis] -= d[0][axis];
    simplex.gain_of_first = most(edge);
    if constexpr (D == 2) {
      simplex.volume = least_length(std::array{minor(d[0][0], d[0][1], d[1][0], d[1][1])});
    } else {
      const auto normal = cross(d[0], d[1]);
      simplex.volume = least_length(normal);
      simplex.off_hull = most_between(std::array{dot(normal, z)});
    }
  } else {
    std::array<BernsteinVector<double, 2 * K, 3>, 3> normals{cross(d[1], d[2]), cross(d[2], d[0]),
                                                             cross(d[0], d[1])};
    simplex.volume = least_length(std::array{dot(normals[0], d[0])});
    for (std::size_t i = 0; i < 3; ++i) simplex.gain[i] = most(normals[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) normals[0][axis] += normals[1][axis] + normals[2][axis];
    simplex.gain_of_first = most(normals[0]);
  }
  return simplex;
}

template <int D, std::size_t M, int K>
SphereChord<D> chord_of(const BeadPaths<D>& paths, const Basis& basis, double from) {
  SphereChord<D> chord;
  // Curves seen from the first ball; their ends.
  std::array<BernsteinVector<double, K, D>, M> d;
  std::array<Bernstein<double, K>, M> s;
  std::array<std::array<Vec<D>, M>, 2> d_at;
  std::array<std::array<double, M>, 2> s_at;
  double size = 0;
  const bool equal = paths.equal_radii();
  for (std::size_t i = 0; i < M; ++i) {
    for (int axis = 0; axis < D + (equal ? 0 : 1); ++axis) {
      std::array<double, K + 1> control;
      for (int k = 0; k <= K; ++k) {
        const double* column = paths.column(k, axis);
        double& value = control[static_cast<std::size_t>(k)];
        value = column[basis.beads[i + 1]] - column[basis.beads[0]];
        size = std::max(size, std::abs(value));
      }
      if (from > 0) cut(control, 1 - from, from);
      auto& curve = axis < D ? d[i][static_cast<std::size_t>(axis)] : s[i];
      for (int k = 0; k <= K; ++k)
        curve.scaled[static_cast<std::size_t>(k)] =
            control[static_cast<std::size_t>(k)] * static_cast<double>(binomial(K, k));
      for (std::size_t e = 0; e < 2; ++e)
        (axis < D ? d_at[e][i][static_cast<std::size_t>(axis)] : s_at[e][i]) = control[e * K];
    }
    if (!equal) continue;
    s[i].scaled.fill(0);
    s_at[0][i] = s_at[1][i] = 0;
  }
  size *= root_of[3];  // no longer curve
  // Within these, products keep clear of overflow and of subnormal numbers.
  if (!(size > 0x1p-150 && paths.extent() < 0x1p150)) return chord;
  const std::array<End<D, M>, 2> end{end_of<D, M>(d_at[0], s_at[0]), end_of<D, M>(d_at[1], s_at[1])};
  BernsteinVector<double, 1, D> z;
  for (std::size_t axis = 0; axis < D; ++axis) z[axis].scaled = {end[0].z[axis], end[1].z[axis]};
  const Bernstein<double, 1> rho{{end[0].rho, end[1].rho}};
  const double l = std::max(size, most(z));
  const double rounding = margin * l;

  const Simplex<M> simplex = simplex_of<D, M, K>(d, z);
  double power = 1;  // size to the (M - 1)-th
  for (std::size_t i = 1; i < M; ++i) power *= size;
  const double volume = simplex.volume * (1 - 0x1p-30) - margin * power * size;
  if (!(volume > 0)) return chord;

  // x = z' + (what follows from the residuals) + (slope of the radii) * (rho - rho').
  double stray = (simplex.off_hull + power * size * rounding) / volume, slope = 0;
  for (std::size_t i = 0; i < M; ++i) {
    // 2 r_i = |c_i|^2 - s_i^2 + 2 s_i rho' - 2 c_i.z'
    auto product = dot(d[i], z);
    double radii = 0;
    if (!equal) {
      product -= s[i] * rho;
      radii = most(std::array{s[i]});
    }
    product += product;
    auto twice = dot(d[i], d[i]);
    if (!equal) twice -= s[i] * s[i];
    twice -= elevate<2 * K>(product);
    const double gain = (simplex.gain[i] + margin * power) / volume;
    stray += gain * (0.5 * most_between(std::array{twice}) + l * rounding);
    slope += gain * (radii + (equal ? 0 : margin * size));
  }
  const double nearest = least_length(z) - rounding;
  if (!(nearest > 0 && slope < 0.9)) return chord;
  // | |z'| - rho' |: the length of z' sags below its chord.
  double change = 0, mismatch = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    const double step = end[1].z[axis] - end[0].z[axis];
    change += step * step;
  }
  for (const End<D, M>& e : end)
    mismatch = std::max(mismatch, std::abs(std::sqrt(detail::dot(e.z, e.z)) - e.rho));
  const double sag = change / (8 * nearest) * up + mismatch + rounding;
  const double radius_strays = (sag + stray) / (1 - slope) * up;
  const double strays = (stray + slope * radius_strays) * up;

  // How far z' is from sum w_i c_i.
  BernsteinVector<double, K + 1, D> bend;
  for (std::size_t axis = 0; axis < D; ++axis) {
    bend[axis] = elevate<K + 1>(z[axis]);
    for (std::size_t i = 0; i < M; ++i)
      bend[axis] -= Bernstein<double, 1>{{end[0].weight[i + 1], end[1].weight[i + 1]}} * d[i][axis];
  }
  double heaviest = 1;
  for (const End<D, M>& e : end)
    for (const double w : e.weight) heaviest = std::max(heaviest, std::abs(w));
  const double apart = (strays + most_between(bend) + heaviest * rounding) * up / volume;
  for (std::size_t i = 0; i <= M; ++i) {
    const double weight = std::min(end[0].weight[i], end[1].weight[i]) - heaviest * margin;
    const double gain = (i == 0 ? simplex.gain_of_first : simplex.gain[i - 1]) + margin * power;
    if (weight > apart * gain) chord.stays = static_cast<std::uint8_t>(chord.stays | 1U << i);
  }
  // Each ball is touched from outside.
  double room = std::min(end[0].rho, end[1].rho);
  for (std::size_t i = 0; i < M && !equal; ++i) room = std::min(room, least(elevate<K>(rho) - s[i]));
  if (!(room > radius_strays + rounding)) return SphereChord<D>();
  const double loss = strays + radius_strays + margin * (paths.extent() + l);
  chord.center = {end[0].z, end[1].z};
  chord.limit = {end[0].rho - loss, end[1].rho - loss};
  // Also where a bound is no number.
  chord.proved = loss < 4 * l;
  return chord;
}

/// Of two balls of one radius in linear motion: the midpoint moves linearly, and the two never part.
template <int D>
SphereChord<D> chord_of_pair(const BeadPaths<D>& paths, const Basis& basis, double from) {
  SphereChord<D> chord;
  const double earlier = 1 - from;
  std::array<double, 2> square{};
  double change = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double* start = paths.column(0, axis);
    const double* stop = paths.column(1, axis);
    const double last = stop[basis.beads[1]] - stop[basis.beads[0]];
    const double first = earlier * (start[basis.beads[1]] - start[basis.beads[0]]) + from * last;
    const auto place = static_cast<std::size_t>(axis);
    chord.center[0][place] = 0.5 * first;
    chord.center[1][place] = 0.5 * last;
    square[0] += first * first;
    square[1] += last * last;
    change += (last - first) * (last - first);
  }
  const std::array<double, 2> length{std::sqrt(square[0]), std::sqrt(square[1])};
  const double longest = std::max(length[0], length[1]);
  if (!(longest > 0x1p-150 && paths.extent() < 0x1p150)) return chord;
  // Half of what bounds the length from below.
  const double nearest = 0.25 * (length[0] + length[1] - std::sqrt(change)) - margin * longest;
  if (!(nearest > 0)) return chord;
  const double loss = 0.03125 * change / nearest * up + margin * (paths.extent() + longest);
  chord.limit = {0.5 * length[0] - loss, 0.5 * length[1] - loss};
  chord.stays = 3;
  chord.proved = true;
  return chord;
}

template <int D, int K>
SphereChord<D> chord_of_degree(const BeadPaths<D>& paths, const Basis& basis, double from) {
  if (basis.size == 1) {  // a ball that holds the others
    SphereChord<D> chord;
    chord.limit[0] = chord.limit[1] = -margin * paths.extent();
    chord.proved = paths.extent() > 0x1p-150 && paths.extent() < 0x1p150;
    chord.stays = 1;
    return chord;
  }
  if (K == 1 && basis.size == 2 && paths.equal_radii()) return chord_of_pair(paths, basis, from);
  if (basis.size == 2) return chord_of<D, 1, K>(paths, basis, from);
  if constexpr (D == 3) {
    if (basis.size == 4) return chord_of<3, 3, K>(paths, basis, from);
  }
  return chord_of<D, 2, K>(paths, basis, from);
}

template <int D, int K, bool equal>
[[KDS_LANES_TARGETS]] void beyond_of(const BeadPaths<D>& paths, const BeadRange& range, BeadId base,
                                     const SphereChord<D>& chord, double from, std::vector<BeadId>& beyond) {
  const Lanes later(from), earlier(1 - from);
  constexpr double below = 1 - 0x1p-40;
  std::array<std::array<double, D>, K + 1> center;
  std::array<double, K + 1> limit;
  for (std::size_t k = 0; k <= K; ++k) {
    const double t = static_cast<double>(k) / K;
    for (std::size_t axis = 0; axis < D; ++axis)
      center[k][axis] = (1 - t) * chord.center[0][axis] + t * chord.center[1][axis];
    limit[k] = ((1 - t) * chord.limit[0] + t * chord.limit[1]) * below;
  }
  beyond.clear();
  for (BeadId b = range.first; b <= range.last; b += Lanes::width) {
    std::array<Lanes, K + 1> square, room;
    for (std::size_t k = 0; k <= K; ++k) {
      square[k] = Lanes(0.0);
      room[k] = Lanes(limit[k]);
    }
    for (int axis = 0; axis < D + (equal ? 0 : 1); ++axis) {
      std::array<Lanes, K + 1> control;
      for (int k = 0; k <= K; ++k) {
        const double* column = paths.column(k, axis);
        control[static_cast<std::size_t>(k)] = Lanes(Lanes::load(column + b)) - Lanes(column[base]);
      }
      cut(control, earlier, later);
      for (std::size_t k = 0; k <= K; ++k) {
        if (axis < D) {
          const Lanes v = control[k] - Lanes(center[k][static_cast<std::size_t>(axis)]);
          square[k] += v * v;
        } else {
          room[k] -= control[k];
        }
      }
    }
    Lanes::Mask inside = (room[0] >= Lanes(0.0)) & (square[0] <= room[0] * room[0]);
    for (std::size_t k = 1; k <= K; ++k)
      inside = inside & (room[k] >= Lanes(0.0)) & (square[k] <= room[k] * room[k]);
    if (Lanes::all(inside)) continue;
    for (BeadId lane = 0; lane < Lanes::width && b + lane <= range.last; ++lane) {
      if (inside[lane] == 0) beyond.push_back(b + lane);
    }
  }
}

template <int D, int K>
void beyond_of_degree(const BeadPaths<D>& paths, const BeadRange& range, BeadId base,
                      const SphereChord<D>& chord, double from, std::vector<BeadId>& beyond) {
  return paths.equal_radii() ? beyond_of<D, K, true>(paths, range, base, chord, from, beyond)
                             : beyond_of<D, K, false>(paths, range, base, chord, from, beyond);
}

}  // namespace

template <int Dimension>
void BeadPaths<Dimension>::measure() {
  extent_ = 0;
  for (int k = 0; k <= degree_; ++k) {
    for (int axis = 0; axis <= Dimension; ++axis) {
      std::vector<double>& column = columns_[place(k, axis)];
      const auto end = column.end() - static_cast<std::ptrdiff_t>(padding);
      if (column.begin() == end) continue;
      const auto [low, high] = std::minmax_element(column.begin(), end);
      const double least = *low, most = *high;
      extent_ = std::max(extent_, most - least);
      if (axis == Dimension) equal_radii_ = equal_radii_ && least == most;
      std::fill(end, column.end(), least);
    }
  }
}

template <int Dimension>
SphereChord<Dimension> sphere_chord(const BeadPaths<Dimension>& paths, const Basis& basis, double from) {
  switch (paths.degree()) {
    case 1:
      return chord_of_degree<Dimension, 1>(paths, basis, from);
    case 2:
      return chord_of_degree<Dimension, 2>(paths, basis, from);
    default:
      return chord_of_degree<Dimension, 3>(paths, basis, from);
  }
}

template <int Dimension>
void find_beyond(const BeadPaths<Dimension>& paths, const BeadRange& range, BeadId base,
                 const SphereChord<Dimension>& chord, double from, std::vector<BeadId>& beyond) {
  switch (paths.degree()) {
    case 1:
      return beyond_of_degree<Dimension, 1>(paths, range, base, chord, from, beyond);
    case 2:
      return beyond_of_degree<Dimension, 2>(paths, range, base, chord, from, beyond);
    default:
      return beyond_of_degree<Dimension, 3>(paths, range, base, chord, from, beyond);
  }
}

template class BeadPaths<2>;
template class BeadPaths<3>;
template SphereChord<2> sphere_chord(const BeadPaths<2>&, const Basis&, double);
template SphereChord<3> sphere_chord(const BeadPaths<3>&, const Basis&, double);
template void find_beyond(const BeadPaths<2>&, const BeadRange&, BeadId, const SphereChord<2>&, double,
                          std::vector<BeadId>&);
template void find_beyond(const BeadPaths<3>&, const BeadRange&, BeadId, const SphereChord<3>&, double,
                          std::vector<BeadId>&);

}  // namespace kds
