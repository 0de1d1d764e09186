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
#include "structures/necklace/ball_distance.h"
#include "structures/necklace/pairs_in_question.h"

namespace kds {

namespace {

Eigen::Vector3d center_of(const BallRow<2>& ball) { return {ball.center[0], ball.center[1], 0}; }
Eigen::Vector3d center_of(const BallRow<3>& ball) { return {ball.center[0], ball.center[1], ball.center[2]}; }

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
  return images_.shortest(difference(a, b)).norm() - (balls_.radius(a) + balls_.radius(b));
}

// The nearest image in doubles may not be the nearest if two are about equally near. The nearest one is then
// among its neighbours in the reduced basis.
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
  double largest = 0;
  for (std::size_t b = 0; b < balls.size(); ++b) largest = std::max(largest, balls.rows()[b].radius);
  if (2 * largest + distance > 4 * Images(cell).reduced().col(0).norm())  // too many images to lay out
    return image_pairs_by_force(balls, cell, asked, distance);
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

namespace {

/// Keeps the closest of the pairs that are offered, decided exactly. Of equally close pairs, the first
/// offered.
template <int D>
class ClosestImages {
 public:
  ClosestImages(const Balls<D>& balls, const Cell& cell) : images_(balls, cell) {}
  void offer(BeadId a, BeadId b) {
    const double distance = images_.distance(a, b);
    if (closest_ && distance > closest_->distance + 2 * images_.error()) return;
    auto gap = images_.gap(a, b);
    if (closest_ && compare_gaps(gap.square, least_.square, gap.reach - least_.reach) >= 0) return;
    closest_ = ClosestPair{a, b, 0, distance};
    least_ = std::move(gap);
  }
  [[nodiscard]] std::optional<ClosestPair> result() const {
    std::optional<ClosestPair> result = closest_;
    if (result) result->sign = compare_gaps(least_.square, Rational(0), least_.reach);
    return result;
  }

 private:
  NearestImages<D> images_;
  std::optional<ClosestPair> closest_;
  typename NearestImages<D>::Gap least_;
};

}  // namespace

template <int D>
std::optional<ClosestPair> closest_images_by_force(const Balls<D>& balls, const Cell& cell,
                                                   const PairsAsked& asked) {
  ClosestImages<D> closest(balls, cell);
  Interruptible interruptible;
  PairsInQuestion(asked).for_each([&](BeadId a, BeadId b) {
    interruptible.ask();
    closest.offer(a, b);
  });
  return closest.result();
}

// Pairs that overlap are searched first, then those within more and more.
template <int D>
std::optional<ClosestPair> closest_images_by_cells(const Balls<D>& balls, const Cell& cell,
                                                   const PairsAsked& asked) {
  const double width = Images(cell).reduced().col(0).norm();
  for (double distance = 0; distance < width; distance = distance == 0 ? width / 64 : 2 * distance) {
    const std::vector<BeadPair> pairs = image_pairs_by_cells(balls, cell, asked, distance);
    if (pairs.empty()) continue;
    ClosestImages<D> closest(balls, cell);
    for (const BeadPair& pair : pairs) closest.offer(pair.first, pair.second);
    return closest.result();
  }
  return closest_images_by_force(balls, cell, asked);
}

template class NearestImages<2>;
template class NearestImages<3>;
template std::vector<BeadPair> image_pairs_by_force(const Balls<2>&, const Cell&, const PairsAsked&, double);
template std::vector<BeadPair> image_pairs_by_force(const Balls<3>&, const Cell&, const PairsAsked&, double);
template std::vector<BeadPair> image_pairs_by_cells(const Balls<2>&, const Cell&, const PairsAsked&, double);
template std::vector<BeadPair> image_pairs_by_cells(const Balls<3>&, const Cell&, const PairsAsked&, double);
template std::optional<ClosestPair> closest_images_by_force(const Balls<2>&, const Cell&, const PairsAsked&);
template std::optional<ClosestPair> closest_images_by_force(const Balls<3>&, const Cell&, const PairsAsked&);

template std::optional<ClosestPair> closest_images_by_cells(const Balls<2>&, const Cell&, const PairsAsked&);
template std::optional<ClosestPair> closest_images_by_cells(const Balls<3>&, const Cell&, const PairsAsked&);

}  // namespace kds
