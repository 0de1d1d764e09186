#include "structures/sphere_path.h"

#include <algorithm>
#include <cmath>

#include "certificates/determinant.h"
#include "structures/lane_bounds.h"
#include "structures/period_lanes.h"
#include "structures/point_sphere.h"

namespace kds {

namespace {

// Relative to the lengths that went in. Four balls in cubic motion in a part of the step are the worst: a
// control point is rounded by up to 37 units of 2^-53, a product of three by 130, a residual with its sphere
// by 220, below 2^-45.
constexpr double margin = 0x1p-42;
constexpr double up = 1 + 0x1p-30;

template <int D>
using Vec = std::array<Lanes, static_cast<std::size_t>(D)>;

/// The beads of four bases, place by place.
template <std::size_t Size>
using BeadLanes = std::array<std::array<BeadId, Lanes::width>, Size>;

template <std::size_t Size>
BeadLanes<Size> beads_of(std::span<const Basis> bases) {
  BeadLanes<Size> beads;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
    const Basis& basis = bases[std::min(lane, bases.size() - 1)];
    for (std::size_t i = 0; i < Size; ++i) beads[i][lane] = basis.beads[i];
  }
  return beads;
}
[[gnu::always_inline]] inline Lanes gather(const double* column, const std::array<BeadId, Lanes::width>& at) {
  return Lanes::Vector{column[at[0]], column[at[1]], column[at[2]], column[at[3]]};
}

/// Four chords side by side.
template <int D>
struct ChordLanes {
  std::array<Vec<D>, 2> center;
  std::array<Lanes, 2> limit;
  Lanes::Mask proved, stays;
};

template <int D>
void give(const ChordLanes<D>& lanes, std::span<SphereChord<D>> chords) {
  for (std::size_t lane = 0; lane < chords.size(); ++lane) {
    SphereChord<D>& chord = chords[lane];
    chord.proved = lanes.proved[lane] != 0;
    chord.stays = static_cast<std::uint8_t>(lanes.stays[lane]);
    for (std::size_t e = 0; e < 2; ++e) {
      chord.limit[e] = lanes.limit[e].v[lane];
      for (std::size_t axis = 0; axis < D; ++axis) chord.center[e][axis] = lanes.center[e][axis].v[lane];
    }
  }
}

/// At one end: the touching sphere, seen from the first ball.
template <int D, std::size_t M>
struct End {
  Vec<D> z;
  Lanes rho;
  std::array<Lanes, M + 1> weight;  // barycentric coordinates of z
};

template <bool equal, int D, std::size_t M>
[[gnu::always_inline]] inline End<D, M> end_of(const std::array<Vec<D>, M>& d,
                                               const std::array<Lanes, M>& s) {
  detail::BasisBalls<Lanes, D, M> balls;
  balls.center[0].fill(Lanes(0.0));
  for (std::size_t i = 0; i < M; ++i) balls.center[i + 1] = d[i];
  const detail::Span<Lanes, D, M> span(balls);
  End<D, M> end;
  std::array<Lanes, M> weight;
  if constexpr (equal) {
    end.z = span.circumcenter(weight);
    end.rho = root(detail::dot(end.z, end.z));
  } else {
    std::array<Lanes, M> e, yq;
    for (std::size_t i = 0; i < M; ++i) e[i] = Lanes(0.5) * (span.square[i] - s[i] * s[i]);
    const Vec<D> p = span.point_of(e, weight);
    const Vec<D> q = span.point_of(s, yq);
    const Lanes a = detail::dot(q, q) - Lanes(1.0), b = detail::dot(p, q), c = detail::dot(p, p);
    end.rho = c / (root(Lanes::max(b * b - a * c, Lanes(0.0))) - b);
    for (std::size_t i = 0; i < M; ++i) weight[i] += end.rho * yq[i];
    for (std::size_t axis = 0; axis < D; ++axis) end.z[axis] = p[axis] + end.rho * q[axis];
  }
  end.weight[0] = Lanes(1.0);
  for (std::size_t i = 0; i < M; ++i) {
    end.weight[i + 1] = weight[i];
    end.weight[0] -= weight[i];
  }
  return end;
}

/// What solving for a point by its products with the c_i costs: from residuals r_i the point errs by sum
/// gain_i |r_i| / volume at most. One by the height of ball i > 0 is gain_i / volume too.
template <std::size_t M>
struct Simplex {
  std::array<Lanes, M> gain;
  Lanes gain_of_first;
  Lanes volume;    // the least
  Lanes off_hull;  // how far z' leaves the affine hull, times the volume
};

template <int D, std::size_t M, int K>
[[gnu::always_inline]] inline Simplex<M> simplex_of(const std::array<CurveLanes<K, D>, M>& d,
                                                    const CurveLanes<1, D>& z) {
  Simplex<M> simplex;
  simplex.off_hull = Lanes(0.0);
  if constexpr (M == 1) {
    simplex.gain[0] = simplex.gain_of_first = Lanes(1.0);
    simplex.volume = least_length(d[0]);
    if constexpr (D == 2) {
      simplex.off_hull = most_between(d[0][0] * z[1] - d[0][1] * z[0]);
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
      simplex.volume = least_magnitude(minor(d[0][0], d[0][1], d[1][0], d[1][1]));
    } else {
      const auto normal = cross(d[0], d[1]);
      simplex.volume = least_length(normal);
      simplex.off_hull = most_between(dot(normal, z));
    }
  } else {
    std::array<CurveLanes<2 * K, 3>, 3> normals{cross(d[1], d[2]), cross(d[2], d[0]), cross(d[0], d[1])};
    simplex.volume = least_magnitude(dot(normals[0], d[0]));
    for (std::size_t i = 0; i < 3; ++i) simplex.gain[i] = most(normals[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) normals[0][axis] += normals[1][axis] + normals[2][axis];
    simplex.gain_of_first = most(normals[0]);
  }
  return simplex;
}

template <int D, std::size_t M, int K, bool equal>
[[KDS_LANES_TARGETS]] void find_chords(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads,
                                       const PeriodLanes& period, ChordLanes<D>& chords) {
  // Curves seen from the first ball; their ends.
  std::array<CurveLanes<K, D>, M> d;
  std::array<PolynomialLanes<K>, M> s;
  std::array<std::array<Vec<D>, M>, 2> d_at;
  std::array<std::array<Lanes, M>, 2> s_at;
  for (auto& at_end : s_at) at_end.fill(Lanes(0.0));
  Lanes size(0.0);
  for (int axis = 0; axis < D + (equal ? 0 : 1); ++axis) {
    const auto place = static_cast<std::size_t>(axis);
    std::array<std::array<Lanes, K + 1>, M> control;
    for (std::size_t k = 0; k <= K; ++k) {
      const double* column = paths.column(static_cast<int>(k), axis);
      const Lanes base = gather(column, beads[0]);
      for (std::size_t i = 0; i < M; ++i) {
        control[i][k] = gather(column, beads[i + 1]) - base;
        size = Lanes::max(size, abs(control[i][k]));
      }
    }
    for (std::size_t i = 0; i < M; ++i) {
      cut(control[i], period);
      auto& curve = axis < D ? d[i][place] : s[i];
      for (std::size_t k = 0; k <= K; ++k)
        curve.scaled[k] = control[i][k] * Lanes(static_cast<double>(binomial(K, static_cast<int>(k))));
      for (std::size_t e = 0; e < 2; ++e) (axis < D ? d_at[e][i][place] : s_at[e][i]) = control[i][e * K];
    }
  }
  size = size * Lanes(detail::root_of[3]);  // no longer curve
  // Within these, products keep clear of overflow and of subnormal numbers.
  Lanes::Mask proved = (size > Lanes(0x1p-150)) & (Lanes(paths.extent()) < Lanes(0x1p150));
  const std::array<End<D, M>, 2> end{end_of<equal, D, M>(d_at[0], s_at[0]),
                                     end_of<equal, D, M>(d_at[1], s_at[1])};
  CurveLanes<1, D> z;
  for (std::size_t axis = 0; axis < D; ++axis) z[axis].scaled = {end[0].z[axis], end[1].z[axis]};
  const PolynomialLanes<1> rho{{end[0].rho, end[1].rho}};
  const Lanes l = Lanes::max(size, most(z));
  const Lanes rounding = Lanes(margin) * l;

  const Simplex<M> simplex = simplex_of<D, M, K>(d, z);
  Lanes power(1.0);  // size to the (M - 1)-th
  for (std::size_t i = 1; i < M; ++i) power = power * size;
  const Lanes volume = simplex.volume * Lanes(1 - 0x1p-30) - Lanes(margin) * power * size;
  proved &= volume > Lanes(0.0);
  const Lanes over = Lanes(up) / volume;

  // x = z' + (what follows from the residuals) + (slope of the radii) * (rho - rho').
  Lanes stray = (simplex.off_hull + power * size * rounding) * over, slope(0.0);
  for (std::size_t i = 0; i < M; ++i) {
    // 2 r_i = |c_i|^2 - s_i^2 + 2 s_i rho' - 2 c_i.z'
    auto product = dot(d[i], z);
    if constexpr (!equal) product -= s[i] * rho;
    product += product;
    auto twice = dot(d[i], d[i]);
    if constexpr (!equal) twice -= s[i] * s[i];
    twice -= elevate<2 * K>(product);
    const Lanes gain = (simplex.gain[i] + Lanes(margin) * power) * over;
    stray += gain * (Lanes(0.5) * most_between(twice) + l * rounding);
    if constexpr (!equal) slope += gain * (most(s[i]) + Lanes(margin) * size);
  }
  const Lanes nearest = least_length(z) - rounding;
  proved &= (nearest > Lanes(0.0)) & (slope < Lanes(0.9));
  // | |z'| - rho' |: the length of z' sags below its chord.
  Lanes change(0.0), mismatch(0.0);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const Lanes step = end[1].z[axis] - end[0].z[axis];
    change += step * step;
  }
  if constexpr (!equal) {
    for (const End<D, M>& e : end) mismatch = Lanes::max(mismatch, abs(root(detail::dot(e.z, e.z)) - e.rho));
  }
  const Lanes sag = change / (Lanes(8.0) * nearest) * Lanes(up) + mismatch + rounding;
  Lanes radius_strays = (sag + stray) * Lanes(up);
  Lanes strays = stray * Lanes(up);
  if constexpr (!equal) {
    radius_strays = radius_strays / (Lanes(1.0) - slope) * Lanes(up);
    strays = (stray + slope * radius_strays) * Lanes(up);
  }

  // How far z' is from sum w_i c_i.
  CurveLanes<K + 1, D> bend;
  for (std::size_t axis = 0; axis < D; ++axis) {
    bend[axis] = elevate<K + 1>(z[axis]);
    for (std::size_t i = 0; i < M; ++i)
      bend[axis] -= PolynomialLanes<1>{{end[0].weight[i + 1], end[1].weight[i + 1]}} * d[i][axis];
  }
  Lanes heaviest(1.0);
  for (const End<D, M>& e : end)
    for (const Lanes& w : e.weight) heaviest = Lanes::max(heaviest, abs(w));
  const Lanes apart = (strays + most_between(bend) + heaviest * rounding) * Lanes(up) * over;
  chords.stays = Lanes::Mask{};
  for (std::size_t i = 0; i <= M; ++i) {
    const Lanes weight = Lanes::min(end[0].weight[i], end[1].weight[i]) - heaviest * Lanes(margin);
    const Lanes gain = (i == 0 ? simplex.gain_of_first : simplex.gain[i - 1]) + Lanes(margin) * power;
    chords.stays |= (weight > apart * gain) & (Lanes::Mask{} + (1L << i));
  }
  // Each ball is touched from outside.
  Lanes room = Lanes::min(end[0].rho, end[1].rho);
  if constexpr (!equal) {
    for (std::size_t i = 0; i < M; ++i) room = Lanes::min(room, least(elevate<K>(rho) - s[i]));
  }
  proved &= room > radius_strays + rounding;
  const Lanes loss = strays + radius_strays + Lanes(margin) * (Lanes(paths.extent()) + l);
  for (std::size_t e = 0; e < 2; ++e) {
    chords.center[e] = end[e].z;
    chords.limit[e] = end[e].rho - loss;
  }
  chords.proved = proved & (loss < Lanes(4.0) * l);  // nor where a bound is no number
}

/// Of two balls of one radius in linear motion: the midpoint moves linearly, and the two never part.
template <int D>
[[KDS_LANES_TARGETS]] void find_chords_of_pairs(const BeadPaths<D>& paths, const BeadLanes<2>& beads,
                                                const PeriodLanes& period, ChordLanes<D>& chords) {
  std::array<Lanes, 2> square{Lanes(0.0), Lanes(0.0)};
  Lanes change(0.0), size(0.0);
  for (int axis = 0; axis < D; ++axis) {
    std::array<Lanes, 2> d;
    for (std::size_t e = 0; e < 2; ++e) {
      const double* column = paths.column(static_cast<int>(e), axis);
      d[e] = gather(column, beads[1]) - gather(column, beads[0]);
      size = Lanes::max(size, abs(d[e]));
    }
    cut(d, period);
    for (std::size_t e = 0; e < 2; ++e) {
      chords.center[e][static_cast<std::size_t>(axis)] = Lanes(0.5) * d[e];
      square[e] += d[e] * d[e];
    }
    change += (d[1] - d[0]) * (d[1] - d[0]);
  }
  const std::array<Lanes, 2> length{root(square[0]), root(square[1])};
  const Lanes longest = size * Lanes(detail::root_of[3]);  // or more
  // Half of what bounds the length from below.
  const Lanes nearest = Lanes(0.25) * (length[0] + length[1] - root(change)) - Lanes(margin) * longest;
  chords.proved =
      (longest > Lanes(0x1p-150)) & (Lanes(paths.extent()) < Lanes(0x1p150)) & (nearest > Lanes(0.0));
  chords.stays = Lanes::Mask{} + 3;
  const Lanes loss =
      Lanes(0.03125) * change / nearest * Lanes(up) + Lanes(margin) * (Lanes(paths.extent()) + longest);
  for (std::size_t e = 0; e < 2; ++e) chords.limit[e] = Lanes(0.5) * length[e] - loss;
}

template <int D, int K, bool equal>
void find_chords_of_degree(const BeadPaths<D>& paths, std::span<const Basis> bases,
                           std::span<const Period> periods, std::span<SphereChord<D>> chords) {
  const std::size_t size = bases.front().size;
  if (size == 1) {  // a ball that holds the others
    for (SphereChord<D>& chord : chords) {
      chord = {};
      chord.limit[0] = chord.limit[1] = -margin * paths.extent();
      chord.proved = paths.extent() > 0x1p-150 && paths.extent() < 0x1p150;
      chord.stays = 1;
    }
    return;
  }
  const PeriodLanes period(periods);
  ChordLanes<D> lanes;
  if (size == 2) {
    if constexpr (equal) {
      find_chords_of_pairs(paths, beads_of<2>(bases), period, lanes);
    } else {
      find_chords<D, 1, K, equal>(paths, beads_of<2>(bases), period, lanes);
    }
  } else if (D == 2 || size == 3) {
    find_chords<D, 2, K, equal>(paths, beads_of<3>(bases), period, lanes);
  } else if constexpr (D == 3) {
    find_chords<D, 3, K, equal>(paths, beads_of<4>(bases), period, lanes);
  }
  give(lanes, chords);
}

template <int D, int K>
void find_chords_of_degree(const BeadPaths<D>& paths, std::span<const Basis> bases,
                           std::span<const Period> periods, std::span<SphereChord<D>> chords) {
  // A form of its own where it matters.
  return K == 1 && paths.equal_radii() ? find_chords_of_degree<D, K, K == 1>(paths, bases, periods, chords)
                                       : find_chords_of_degree<D, K, false>(paths, bases, periods, chords);
}

}  // namespace

template <int Dimension>
void sphere_chords(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                   std::span<const Period> periods, std::span<SphereChord<Dimension>> chords) {
  switch (paths.degree()) {
    case 1:
      return find_chords_of_degree<Dimension, 1>(paths, bases, periods, chords);
    case 2:
      return find_chords_of_degree<Dimension, 2>(paths, bases, periods, chords);
    default:
      return find_chords_of_degree<Dimension, 3>(paths, bases, periods, chords);
  }
}

template void sphere_chords(const BeadPaths<2>&, std::span<const Basis>, std::span<const Period>,
                            std::span<SphereChord<2>>);
template void sphere_chords(const BeadPaths<3>&, std::span<const Basis>, std::span<const Period>,
                            std::span<SphereChord<3>>);

}  // namespace kds
