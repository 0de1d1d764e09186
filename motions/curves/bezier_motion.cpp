#include "motions/curves/bezier_motion.h"

#include "motions/numbers/lanes.h"

namespace kds {

namespace {

/// Sets one control point. Returns a NaN if a number is not finite: zero times such a number is NaN.
template <int Dimension>
double set_one_by_one(const double* center, double weight, double* point) {
  double none = 0 * weight;
  for (int axis = 0; axis < Dimension; ++axis) {
    point[axis] = center[axis];
    none += 0 * center[axis];
  }
  point[Dimension] = weight;
  return none;
}

/// Sets one control point. Sets sign bits of `wrong` if a number is not finite, which avoids the latency of a
/// sum.
[[gnu::always_inline]] inline void set_row(const double* center, double weight, double* point,
                                           Lanes::Mask& wrong) {
  constexpr long long exponent = 0x7ffLL << 52, one = 1LL << 52;
  Lanes::Vector row = Lanes::load(center);  // the fourth number is the next bead's; replaced below
  row[3] = weight;
  wrong |= (reinterpret_cast<Lanes::Mask>(row) & exponent) + one;
  __builtin_memcpy(point, &row, sizeof row);
}

/// Sets the control points of linear motion in space. Reads one double behind the centres of `beads` beads,
/// so the caller leaves the last bead out. Returns whether all numbers are finite.
[[KDS_LANES_TARGETS]] bool set_rows(const double* start, const double* end, const double* radii,
                                    std::size_t beads, double* points, double* own_radii) {
  Lanes::Mask wrong{};
  for (std::size_t b = 0; b < beads; ++b) {
    const double radius = radii[b], weight = radius * radius;
    set_row(start + 3 * b, weight, points + 8 * b, wrong);
    set_row(end + 3 * b, weight, points + 8 * b + 4, wrong);
    own_radii[2 * b] = own_radii[2 * b + 1] = radius;
  }
  return ((wrong[0] | wrong[1]) | (wrong[2] | wrong[3])) >= 0;
}

}  // namespace

template <int Dimension>
bool detail::set_linear_ends(const double* start, const double* end, const double* radii, std::size_t beads,
                             double* points, double* own_radii) {
  double none = 0;
  std::size_t done = 0;
  bool finite = true;
  if (Dimension == 3 && beads > 1) {
    done = beads - 1;
    finite = set_rows(start, end, radii, done, points, own_radii);
  }
  constexpr std::size_t numbers = Dimension + 1;
  for (std::size_t b = done; b < beads; ++b) {
    const double radius = radii[b], weight = radius * radius;
    none += set_one_by_one<Dimension>(start + 3 * b, weight, points + 2 * numbers * b);
    none += set_one_by_one<Dimension>(end + 3 * b, weight, points + 2 * numbers * b + numbers);
    own_radii[2 * b] = own_radii[2 * b + 1] = radius;
  }
  return finite && none == 0;  // an infinite radius has an infinite weight
}

template bool detail::set_linear_ends<1>(const double*, const double*, const double*, std::size_t, double*,
                                         double*);
template bool detail::set_linear_ends<2>(const double*, const double*, const double*, std::size_t, double*,
                                         double*);
template bool detail::set_linear_ends<3>(const double*, const double*, const double*, std::size_t, double*,
                                         double*);

}  // namespace kds
