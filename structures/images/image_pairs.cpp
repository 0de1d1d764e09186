#include "structures/images/image_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "structures/images/laid_images.h"
#include "structures/necklace/pairs_in_question.h"

namespace kds {

namespace {

Eigen::Vector3d center_of(const BallRow<2>& ball) { return {ball.center[0], ball.center[1], 0}; }
Eigen::Vector3d center_of(const BallRow<3>& ball) { return {ball.center[0], ball.center[1], ball.center[2]}; }

int sign_of(const Rational& x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Returns the sign of sqrt(a) - sqrt(b) - c.
int compare_roots(const Rational& a, const Rational& b, const Rational& c) {
  if (c < 0) return -compare_roots(b, a, Rational(-c));
  const Rational rest = a - b - c * c;  // compared with 2 c sqrt(b)
  if (rest < 0) return -1;
  return sign_of(Rational(rest * rest - 4 * c * c * b));
}

/// Counts pairs, to ask now and then whether the user has interrupted.
class Interruptible {
 public:
  void ask() {
    if (++visited_ % 4096 == 0) InterruptionCheck::ask();
  }

 private:
  std::uint64_t visited_ = 0;
};

}  // namespace

template <int D>
NearestImages<D>::NearestImages(const Balls<D>& balls, const Cell& cell)
    : balls_(balls), cell_(cell), images_(cell) {
  double largest = cell.cwiseAbs().sum();
  for (std::size_t b = 0; b < balls.size(); ++b) {
    largest = std::max(largest, center_of(balls.rows()[b]).cwiseAbs().maxCoeff());
    largest = std::max(largest, balls.rows()[b].radius);
  }
  const double width = images_.reduced().col(0).norm();
  constexpr double most_cells = 100'000;
  if (!(largest <= most_cells * width))
    throw InputError(
        fmt::format("beads are more than {:.0f} times the width of the periodic cell away from the origin; "
                    "expected them nearer",
                    most_cells));
  // A distance is a sum of fewer than 20 rounded terms. A shift is at most the difference of two centres and
  // the cell, in each of three directions.
  margin_ = 0x1p-44 * largest;
}

template <int D>
Eigen::Vector3d NearestImages<D>::difference(BeadId a, BeadId b) const {
  return center_of(balls_.rows()[b]) - center_of(balls_.rows()[a]);
}

template <int D>
double NearestImages<D>::distance(BeadId a, BeadId b) const {
  const Eigen::Vector3d d = difference(a, b);
  return images_.shifted(d, images_.nearest(d)).norm() - (balls_.radius(a) + balls_.radius(b));
}

// The nearest image in doubles may be another than the nearest one where two are equally near; the nearest
// one is then among its neighbours in the reduced basis.
template <int D>
auto NearestImages<D>::gap(BeadId a, BeadId b) const -> Gap {
  const Eigen::Vector3d d = difference(a, b), nearest = images_.nearest(d);
  const double near = images_.shifted(d, nearest).norm() + 2 * margin_;
  std::optional<Rational> least;
  for (int neighbor = 0; neighbor < 27; ++neighbor) {
    const Eigen::Vector3d by(neighbor % 3 - 1, neighbor / 3 % 3 - 1, neighbor / 9 - 1);
    const Eigen::Vector3d shift = nearest + images_.steps() * by;
    if (images_.shifted(d, shift).norm() > near) continue;
    Rational square = 0;
    for (int axis = 0; axis < D; ++axis) {
      Rational x = Rational(center_of(balls_.rows()[b])[axis]) - Rational(center_of(balls_.rows()[a])[axis]);
      for (int vector = 0; vector < D; ++vector) x += Rational(shift[vector]) * Rational(cell_(axis, vector));
      square += x * x;
    }
    if (!least || square < *least) least = square;
  }
  return {*least, Rational(balls_.radius(a)) + Rational(balls_.radius(b))};
}

template <int D>
bool NearestImages<D>::are_within(BeadId a, BeadId b, double distance) const {
  const double beyond = this->distance(a, b) - distance;
  if (std::abs(beyond) > margin_ + 0x1p-44 * distance) return beyond < 0;
  const Gap gap = this->gap(a, b);
  const Rational reach = gap.reach + Rational(distance);
  return gap.square <= reach * reach;
}

template <int D>
std::vector<BeadPair> image_pairs_by_force(const Balls<D>& balls, const Cell& cell, const PairsAsked& asked,
                                           double distance) {
  const NearestImages<D> images(balls, cell);
  std::vector<BeadPair> pairs;
  Interruptible interruptible;
  PairsInQuestion(asked).for_each([&](BeadId a, BeadId b) {
    interruptible.ask();
    if (images.are_within(a, b, distance)) pairs.push_back({a, b});
  });
  return pairs;
}

template <int D>
std::vector<BeadPair> image_pairs_by_cells(const Balls<D>& balls, const Cell& cell, const PairsAsked& asked,
                                           double distance) {
  const NearestImages<D> images(balls, cell);
  Eigen::Matrix3Xd centers(3, static_cast<Eigen::Index>(balls.size()));
  std::vector<double> radii;
  for (std::size_t b = 0; b < balls.size(); ++b) {
    centers.col(static_cast<Eigen::Index>(b)) = center_of(balls.rows()[b]);
    radii.push_back(balls.rows()[b].radius + 0.5 * distance);
  }
  std::vector<BeadPair> pairs;
  Interruptible interruptible;
  LaidImages<D>(centers, std::move(radii), cell)
      .visit_near([&](BeadId a, BeadId b, const CellShift<D>&, double gap) {
        interruptible.ask();
        if (gap <= 2 * images.error() + 0x1p-40 * distance && asked.asks({a, b})) pairs.push_back({a, b});
      });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::erase_if(pairs,
                [&](const BeadPair& pair) { return !images.are_within(pair.first, pair.second, distance); });
  return pairs;
}

template <int D>
std::optional<ClosestPair> closest_images_by_force(const Balls<D>& balls, const Cell& cell,
                                                   const PairsAsked& asked) {
  const NearestImages<D> images(balls, cell);
  std::optional<ClosestPair> closest;
  typename NearestImages<D>::Gap least;
  Interruptible interruptible;
  PairsInQuestion(asked).for_each([&](BeadId a, BeadId b) {
    interruptible.ask();
    const double distance = images.distance(a, b);
    if (closest && distance > closest->distance + 2 * images.error()) return;
    auto gap = images.gap(a, b);
    if (closest && compare_roots(gap.square, least.square, gap.reach - least.reach) >= 0) return;
    closest = ClosestPair{a, b, 0, distance};
    least = std::move(gap);
  });
  if (closest) closest->sign = compare_roots(least.square, 0, least.reach);
  return closest;
}

template class NearestImages<2>;
template class NearestImages<3>;
template std::vector<BeadPair> image_pairs_by_force(const Balls<2>&, const Cell&, const PairsAsked&, double);
template std::vector<BeadPair> image_pairs_by_force(const Balls<3>&, const Cell&, const PairsAsked&, double);
template std::vector<BeadPair> image_pairs_by_cells(const Balls<2>&, const Cell&, const PairsAsked&, double);
template std::vector<BeadPair> image_pairs_by_cells(const Balls<3>&, const Cell&, const PairsAsked&, double);
template std::optional<ClosestPair> closest_images_by_force(const Balls<2>&, const Cell&, const PairsAsked&);
template std::optional<ClosestPair> closest_images_by_force(const Balls<3>&, const Cell&, const PairsAsked&);

}  // namespace kds
