#include "structures/images/near_images.h"

#include <fmt/format.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/base/interruption.h"

namespace kds {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
/// If the cell changes by more in a step, all pairs are tested.
constexpr double most_strain = 0.25;
/// The most images on each side along a vector that are compared, and those of a pair that are listed.
constexpr int most_images = 32, most_in_box = 100'000;

/// Replaces the control points of a curve, `columns` numbers each, by those of its part between two times.
void restrict_curve(double* points, std::size_t row, std::size_t columns, double from, double to) {
  const auto halve = [&](double share, bool keeps_end) {
    for (std::size_t level = 1; level < row; ++level) {
      for (std::size_t i = 0; i + level < row; ++i) {
        const std::size_t at = keeps_end ? i : row - 1 - i;
        const std::size_t first = keeps_end ? at : at - 1;
        for (std::size_t c = 0; c < columns; ++c) {
          const double a = points[first * columns + c], b = points[(first + 1) * columns + c];
          points[at * columns + c] = a + share * (b - a);
        }
      }
    }
  };
  if (from > 0) halve(from, true);
  if (to < 1) halve((to - from) / (1 - from), false);
}

/// Calls `visit` with all shifts from -most to most.
template <std::size_t N, class Visit>
void for_each_shift(const std::array<std::int32_t, N>& most, const Visit& visit) {
  std::array<std::int32_t, N> shift;
  for (std::size_t a = 0; a < N; ++a) shift[a] = -most[a];
  for (;;) {
    visit(shift);
    std::size_t a = N;
    while (a-- > 0) {
      if (++shift[a] <= most[a]) break;
      shift[a] = -most[a];
    }
    if (a == static_cast<std::size_t>(-1)) return;
  }
}

}  // namespace

template <int D>
NearImages<D>::NearImages(PairsAsked asked) : asked_(std::move(asked)) {
  check_groups(asked_);
  for (std::uint32_t n = 0; n < asked_.necklaces.size(); ++n)
    necklaces_.resize(std::size_t{asked_.necklaces[n].last} + 1, n);
}

template <int D>
void NearImages<D>::lay_lattice(const Curves<D>& curves) {
  lattice_ = {};
  largest_ = 0;
  std::vector<Cell> cells;
  for (std::size_t k = 0; k < row_; ++k) cells.push_back(cell_of(curves, static_cast<int>(k)));
  const Images images(0.5 * (cells.front() + cells.back()));
  lattice_.steps = images.steps();
  lattice_.middle = images.reduced();
  int rank = 0;
  while (rank < D && !lattice_.middle.col(rank).isZero(0))
    lattice_.periodic[static_cast<std::size_t>(rank++)] = true;
  const auto spans = [&](int vector) { return !cells.front().col(vector).isZero(0); };
  if (rank != int{spans(0)} + int{spans(1)} + int{spans(2)})
    throw InputError(
        "a vector of the periodic cell turns into its opposite in one step; expected smaller changes");
  lattice_.shortest = rank > 0 ? lattice_.middle.col(0).norm() : unbounded;
  // Completes the basis by unit vectors across all vectors before, in the plane first.
  std::vector<Eigen::Vector3d> units;
  const auto across = [&](Eigen::Vector3d vector) {
    for (const Eigen::Vector3d& unit : units) vector -= vector.dot(unit) * unit;
    return vector;
  };
  for (int vector = 0; vector < 3; ++vector) {
    Eigen::Vector3d best = across(lattice_.middle.col(vector));
    for (int axis = 0; vector >= rank && axis < (vector < D ? D : 3); ++axis)
      if (across(Eigen::Vector3d::Unit(axis)).norm() > best.norm())
        best = across(Eigen::Vector3d::Unit(axis));
    units.push_back(best.normalized());
    if (vector >= rank) lattice_.middle.col(vector) = units.back();
  }
  lattice_.inverse = lattice_.middle.inverse();
  for (const Cell& cell : cells) {
    Eigen::Matrix3d control = lattice_.middle;
    control.leftCols(rank) = cell * lattice_.steps.leftCols(rank);
    largest_ = std::max(largest_, (cell.cwiseAbs() * lattice_.steps.cwiseAbs()).sum());
    lattice_.controls.push_back(control);
    lattice_.strain =
        std::max(lattice_.strain, ((control - lattice_.middle) * lattice_.inverse).norm() * (1 + 0x1p-40));
  }
}

template <int D>
auto NearImages<D>::measure_bead(const Curves<D>& curves, BeadId bead) -> Measured {
  Measured found;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto point = [&](std::size_t k) {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < D; ++axis) at[axis] = curves.coordinate(bead, static_cast<int>(k), axis);
    return at;
  };
  for (std::size_t k = 0; k < row_; ++k) {
    const Eigen::Vector3d at = point(k);
    found.farthest = std::max(found.farthest, at.cwiseAbs().maxCoeff());
    mean += at / static_cast<double>(row_);
    found.radius = std::max(found.radius, curves.radius(bead, static_cast<int>(k)));
  }
  const Eigen::Vector3d share = lattice_.inverse * mean;
  for (std::size_t a = 0; a < dimension; ++a) {
    if (!lattice_.periodic[a]) continue;
    const double home = std::floor(share[static_cast<Eigen::Index>(a)]);
    if (!(std::abs(home) < ShiftNumbers<D>::most / 8))
      throw InputError(
          fmt::format("bead {} is more than 131,072 cells away from the origin; expected fewer", bead));
    homes_[bead][a] = static_cast<std::int32_t>(home);
  }
  const Eigen::Vector3d first = point(0) - vector_of(homes_[bead], lattice_.controls[0]);
  for (std::size_t k = 1; k < row_; ++k)
    found.move =
        std::max(found.move, (point(k) - vector_of(homes_[bead], lattice_.controls[k]) - first).norm());
  return found;
}

template <int D>
void NearImages<D>::measure(const Curves<D>& curves) {
  homes_.assign(curves.bead_count(), {});
  radius_ = farthest_ = 0;
  double squares = 0;
  std::size_t asked = 0;
  for (BeadId bead = 0; bead < curves.bead_count(); ++bead) {
    if (groups_of(bead) == 0) continue;
    ++asked;
    const Measured of_bead = measure_bead(curves, bead);
    farthest_ = std::max(farthest_, of_bead.farthest);
    radius_ = std::max(radius_, of_bead.radius);
    squares += of_bead.move * of_bead.move;
  }
  rms_move_ = std::sqrt(squares / std::max<double>(1, static_cast<double>(asked)));
  largest_ = 8 * (largest_ + farthest_ + radius_);
  margin_ = 0x1p-44 * largest_;
}

/// Returns the largest stray of a swept ball that the grid is laid for.
template <int D>
double NearImages<D>::stray_wanted() const {
  double volume = 1;  // of the periodic vectors
  int rank = 0;
  for (int a = 0; a < D; ++a) {
    if (!lattice_.periodic[static_cast<std::size_t>(a)]) continue;
    volume *= lattice_.middle.col(a).norm();
    ++rank;
  }
  const double spacing =
      std::pow(volume / std::max<double>(1, static_cast<double>(homes_.size())), 1.0 / rank);
  return std::max({0.5 * radius_, 0.125 * spacing, margin_});
}

template <int D>
void NearImages<D>::set_points(const Curves<D>& curves, BeadId bead, double from, double to) {
  double* const points = &points_[bead * row_ * dimension];
  for (std::size_t k = 0; k < row_; ++k) {
    const Eigen::Vector3d home = vector_of(homes_[bead], lattice_.controls[k]);
    for (std::size_t axis = 0; axis < dimension; ++axis)
      points[k * dimension + axis] = curves.coordinate(bead, static_cast<int>(k), static_cast<int>(axis)) -
                                     home[static_cast<Eigen::Index>(axis)];
  }
  double* const radii = &radii_[bead * row_];
  std::copy_n(curves.radii(bead), row_, radii);
  if (from > 0 || to < 1) {
    restrict_curve(points, row_, dimension, from, to);
    restrict_curve(radii, row_, 1, from, to);
  }
}

template <int D>
void NearImages<D>::enter_piece(const Curves<D>& curves, double from, double to, double most_stray) {
  const std::size_t beads = curves.bead_count();
  points_.resize(beads * row_ * dimension);
  radii_.resize(beads * row_);
  piece_ = lattice_.controls;
  if (from > 0 || to < 1) restrict_curve(piece_.front().data(), row_, 9, from, to);
  swept_.clear();
  places_.resize(beads);
  for (BeadId bead = 0; bead < beads; ++bead) {
    if (groups_of(bead) == 0) continue;
    set_points(curves, bead, from, to);
    const double* const points = &points_[bead * row_ * dimension];
    const double* const radii = &radii_[bead * row_];
    places_[bead] = static_cast<std::uint32_t>(swept_.size());
    const double stray = ball_around(points).second;
    const double radius = *std::max_element(radii, radii + row_);
    if (stray <= most_stray) {
      swept_.push_back(swept_of(bead, points, radius));
      continue;
    }
    constexpr double most_parts = 1024;  // a bead that jumps farther makes the bins wider
    const auto parts = static_cast<std::size_t>(std::min(most_parts, std::ceil(stray / most_stray)));
    std::vector<double> part(row_ * dimension);
    for (std::size_t p = 0; p < parts; ++p) {
      std::copy_n(points, part.size(), part.begin());
      restrict_curve(part.data(), row_, dimension, static_cast<double>(p) / static_cast<double>(parts),
                     static_cast<double>(p + 1) / static_cast<double>(parts));
      swept_.push_back(swept_of(bead, part.data(), radius));
    }
    in_parts_ = true;
  }
}

template <int D>
auto NearImages<D>::ball_around(const double* points) const -> std::pair<Point, double> {
  Point center{};
  for (std::size_t axis = 0; axis < dimension; ++axis) {
    double low = points[axis], high = low;
    for (std::size_t k = 1; k < row_; ++k) {
      low = std::min(low, points[k * dimension + axis]);
      high = std::max(high, points[k * dimension + axis]);
    }
    center[axis] = 0.5 * (low + high);
  }
  double most = 0;
  for (std::size_t k = 0; k < row_; ++k) {
    double square = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const double d = points[k * dimension + axis] - center[axis];
      square += d * d;
    }
    most = std::max(most, square);
  }
  return {center, std::sqrt(most)};
}

template <int D>
auto NearImages<D>::swept_of(BeadId bead, const double* points, double radius) const -> Swept {
  const auto [center, stray] = ball_around(points);
  Swept swept{center, radius + stray + margin_, bead, groups_of(bead), homes_[bead]};
  for (std::size_t a = 0; a < dimension; ++a) {
    if (!lattice_.periodic[a]) continue;
    const double away = std::floor(coordinate_of(swept.center, a));
    if (away == 0) continue;
    swept.wrapped[a] += static_cast<std::int32_t>(away);
    // The bead moves with the vectors at its time, its swept ball with those in the middle.
    swept.reach +=
        std::abs(away) * lattice_.strain * lattice_.middle.col(static_cast<Eigen::Index>(a)).norm();
    for (std::size_t axis = 0; axis < dimension; ++axis)
      swept.center[axis] -=
          away * lattice_.middle(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(a));
  }
  return swept;
}

template <int D>
auto NearImages<D>::bin_of(const Swept& swept) const -> Shift {
  Shift bin{};
  for (std::size_t a = 0; a < dimension; ++a) {
    const double at = width_[a] > 0 ? (coordinate_of(swept.center, a) - low_[a]) / width_[a] : 0;
    bin[a] = static_cast<std::int32_t>(std::clamp(std::floor(at), 0.0, bins_[a] - 1.0));
  }
  return bin;
}

template <int D>
void NearImages<D>::fill_grid() {
  double reach = 0;
  Point low, high;
  low.fill(unbounded);
  high.fill(-unbounded);
  for (const Swept& swept : swept_) {
    reach = std::max(reach, swept.reach);
    for (std::size_t a = 0; a < dimension; ++a) {
      const double at = coordinate_of(swept.center, a);
      low[a] = std::min(low[a], at);
      high[a] = std::max(high[a], at);
    }
  }
  // For an image t that is compared, with M the vectors in the middle: |M t| is at most the distance of two
  // points in the cell, `spread`, and the reach, `wobble_` included. The vectors at another time differ by
  // strain |M t|.
  double spread = 0;
  for (int a = 0; a < D; ++a)
    if (lattice_.periodic[static_cast<std::size_t>(a)]) spread += lattice_.middle.col(a).norm();
  grid_reach_ = reach;
  wobble_ = lattice_.strain * (2 * reach + spread) / (1 - lattice_.strain);
  const double width = 2 * reach + wobble_;
  std::array<double, dimension> heights{};  // between cells of the lattice, or one unit
  double wanted = 1;
  std::array<double, dimension> counts{};
  for (std::size_t a = 0; a < dimension; ++a) {
    heights[a] = 1 / lattice_.inverse.row(static_cast<Eigen::Index>(a)).norm();
    const double length = lattice_.periodic[a] ? heights[a] : (high[a] - low[a]) * heights[a];
    counts[a] = std::max(1.0, std::floor(length / (width * (1 + 0x1p-20))));
    wanted *= counts[a];
  }
  // At most a few bins per swept ball.
  const double most = 4 * static_cast<double>(swept_.size()) + 64;
  for (; wanted > most; wanted = std::accumulate(counts.begin(), counts.end(), 1.0, std::multiplies<>()))
    for (double& count : counts) count = std::max(1.0, std::floor(count * std::pow(most / wanted, 1.0 / D)));
  std::size_t bins = 1;
  for (std::size_t a = 0; a < dimension; ++a) {
    bins_[a] = static_cast<std::int32_t>(counts[a]);
    low_[a] = lattice_.periodic[a] ? 0 : low[a];
    const double length = lattice_.periodic[a] ? 1 : high[a] - low[a];
    width_[a] = length / bins_[a];
    const double within = std::ceil(width / (width_[a] * heights[a]) * (1 + 0x1p-30));
    const bool is_alone = !lattice_.periodic[a] && bins_[a] == 1;
    if (!is_alone && !(within <= most_images))
      throw InputError(fmt::format(
          "two beads are within reach at a distance of {:.4g}, more than {} times the width of the periodic "
          "cell; expected a shorter reach",
          width, most_images));
    reach_[a] = is_alone ? 0 : static_cast<std::int32_t>(within);
    bins *= static_cast<std::size_t>(bins_[a]);
  }
  begins_.assign(bins + 1, 0);
  groups_.assign(bins, 0);
  in_bins_.resize(swept_.size());
  for (std::size_t i = 0; i < swept_.size(); ++i) {
    const Shift place = bin_of(swept_[i]);
    std::size_t bin = 0;
    for (std::size_t a = 0; a < dimension; ++a)
      bin = bin * static_cast<std::size_t>(bins_[a]) + static_cast<std::size_t>(place[a]);
    in_bins_[i] = static_cast<std::uint32_t>(bin);
    ++begins_[bin + 1];
    groups_[bin] |= swept_[i].groups;
  }
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  sorted_.resize(swept_.size());
  next_.assign(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < swept_.size(); ++i) sorted_[next_[in_bins_[i]]++] = swept_[i];
}

// Looks at each pair of a bin and a bin not before it, counted across the walls, so that each pair of a
// bead and an image is met once.
template <int D>
void NearImages<D>::compare_bins(bool list_overlapping, ShiftNumbers<D>& shifts, PairsOfImages& pairs) {
  std::vector<Shift> offsets;
  for_each_shift(reach_, [&](const Shift& offset) {
    if (offset >= Shift{}) offsets.push_back(offset);
  });
  Shift bin{};
  for (std::size_t at = 0; at + 1 < begins_.size(); ++at) {
    InterruptionCheck::ask();
    if (begins_[at] != begins_[at + 1]) {
      for (const Shift& by : offsets) compare(bin, at, by, list_overlapping, shifts, pairs);
    }
    for (std::size_t a = dimension; a-- > 0;) {
      if (++bin[a] < bins_[a]) break;
      bin[a] = 0;
    }
  }
}

template <int D>
auto NearImages<D>::neighbour(const Shift& bin, const Shift& by) const
    -> std::optional<std::pair<std::size_t, Shift>> {
  std::pair<std::size_t, Shift> found{};
  auto& [at, image] = found;
  for (std::size_t a = 0; a < dimension; ++a) {
    std::int32_t index = bin[a] + by[a];
    if (index < 0 || index >= bins_[a]) {
      if (!lattice_.periodic[a]) return std::nullopt;
      image[a] = index < 0 ? -((bins_[a] - 1 - index) / bins_[a]) : index / bins_[a];
      index -= image[a] * bins_[a];
    }
    at = at * static_cast<std::size_t>(bins_[a]) + static_cast<std::size_t>(index);
  }
  return found;
}

template <int D>
auto NearImages<D>::vector_to(const Shift& image) const -> Point {
  Point vector{};
  for (std::size_t a = 0; a < dimension; ++a)
    for (std::size_t axis = 0; image[a] != 0 && axis < dimension; ++axis)
      vector[axis] +=
          image[a] * lattice_.middle(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(a));
  return vector;
}

template <int D>
void NearImages<D>::compare(const Shift& bin, std::size_t at, const Shift& by, bool list_overlapping,
                            ShiftNumbers<D>& shifts, PairsOfImages& pairs) {
  const auto other_bin = neighbour(bin, by);
  if (!other_bin) return;
  const auto& [other_at, image] = *other_bin;
  const Point moved = vector_to(image);
  if (begins_[other_at] == begins_[other_at + 1] || !PairsAsked::joins(groups_[at], groups_[other_at]))
    return;
  const bool within = is_zero(by);
  const std::uint32_t end = begins_[other_at + 1];
  const bool grouped = !asked_.groups.empty();
  const double wobble = is_zero(image) ? 0 : wobble_;
  for (std::uint32_t i = begins_[at]; i < begins_[at + 1]; ++i) {
    const Swept& one = sorted_[i];
    Point from;
    for (std::size_t axis = 0; axis < dimension; ++axis) from[axis] = one.center[axis] - moved[axis];
    const double reach = one.reach + wobble;
    for (std::uint32_t j = within ? i + 1 : begins_[other_at]; j < end; ++j) {
      const Swept& other = sorted_[j];
      if (grouped && !PairsAsked::joins(one.groups, other.groups)) continue;
      double square = 0;
      for (std::size_t axis = 0; axis < dimension; ++axis) {
        const double d = other.center[axis] - from[axis];
        square += d * d;
      }
      const double sum_of_reaches = reach + other.reach;
      if (square <= sum_of_reaches * sum_of_reaches)
        look_at(one, other, image, list_overlapping, shifts, pairs);
    }
  }
}

template <int D>
bool NearImages<D>::asks(BeadId one, BeadId other) const {
  const BeadPair pair = one < other ? BeadPair{one, other} : BeadPair{other, one};
  const std::uint32_t first = necklaces_[pair.first], second = necklaces_[pair.second];
  return asked_.asks_of(first, second) && (first != second || pair.second - pair.first >= asked_.apart);
}

template <int D>
void NearImages<D>::look_at(const Swept& one, const Swept& other, const Shift& image, bool list_overlapping,
                            ShiftNumbers<D>& shifts, PairsOfImages& pairs) {
  if (one.bead == other.bead || !asks(one.bead, other.bead)) return;
  const bool in_order = one.bead < other.bead;
  const Swept& first = in_order ? one : other;
  const Swept& second = in_order ? other : one;
  // The second bead's shift in the reduced lattice, from the images that have been compared.
  Shift shift = plus(first.wrapped, second.wrapped, -1);
  shift = plus(shift, image, in_order ? 1 : -1);
  const Shift from_homes = plus(plus(shift, homes_[second.bead]), homes_[first.bead], -1);
  const double* const a = &points_[first.bead * row_ * dimension];
  const double* const b = &points_[second.bead * row_ * dimension];
  differences_.resize(row_);
  Point toward{};
  for (std::size_t k = 0; k < row_; ++k) {
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    if (!is_zero(from_homes)) moved = vector_of(from_homes, piece_[k]);
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const double d =
          b[k * dimension + axis] - a[k * dimension + axis] + moved[static_cast<Eigen::Index>(axis)];
      differences_[k][axis] = d;
      if (k == 0 || k + 1 == row_) toward[axis] += d;
    }
  }
  double length = 0;
  for (const double x : toward) length += x * x;
  bool apart = true, inside = is_whole_step_;
  for (std::size_t k = 0; k < row_; ++k) {
    const double reach = radii_[first.bead * row_ + k] + radii_[second.bead * row_ + k];
    double along = 0, square = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      along += toward[axis] * differences_[k][axis];
      square += differences_[k][axis] * differences_[k][axis];
    }
    const double outer = reach + margin_, inner = reach - margin_;
    apart = apart && along > 0 && along * along > outer * outer * length * (1 + 0x1p-40);
    inside = inside && inner > 0 && square * (1 + 0x1p-40) < inner * inner;
  }
  if (apart || (inside && !list_overlapping)) {
    ++pairs.proved;
    return;
  }
  const ImagePair found{{first.bead, second.bead}, number_of(shift, shifts)};
  (inside ? pairs.overlapping : pairs.unclear).push_back(found);
}

template <int D>
std::uint32_t NearImages<D>::number_of(const Shift& reduced, ShiftNumbers<D>& shifts) const {
  if (is_zero(reduced)) return 0;
  Shift shift{};
  for (std::size_t v = 0; v < dimension; ++v) {
    double multiple = 0;  // exact up to 2^53
    for (std::size_t a = 0; a < dimension; ++a)
      multiple += reduced[a] * lattice_.steps(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(a));
    shift[v] = static_cast<std::int32_t>(
        std::clamp(multiple, -2.0 * ShiftNumbers<D>::most, 2.0 * ShiftNumbers<D>::most));
  }
  return shifts.number_of(shift);
}

template <int D>
void NearImages<D>::find(const Curves<D>& curves, bool list_overlapping, ShiftNumbers<D>& shifts,
                         PairsOfImages& pairs) {
  pairs.clear();
  row_ = static_cast<std::size_t>(curves.own_degree()) + 1;
  lay_lattice(curves);
  if (lattice_.strain > most_strain) return find_by_boxes(curves, shifts, pairs);
  measure(curves);
  const double wanted = stray_ = stray_wanted();
  has_grid_ = false;
  forget_moved();
  const auto pieces = static_cast<std::size_t>(std::clamp(std::ceil(0.5 * rms_move_ / wanted), 1.0, 1024.0));
  in_parts_ = false;
  is_whole_step_ = pieces == 1;
  for (std::size_t p = 0; p < pieces; ++p) {
    const double from = static_cast<double>(p) / static_cast<double>(pieces);
    const double to = p + 1 == pieces ? 1 : static_cast<double>(p + 1) / static_cast<double>(pieces);
    enter_piece(curves, from, to, wanted);
    fill_grid();
    compare_bins(list_overlapping, shifts, pairs);
  }
  if (pieces > 1 || in_parts_) {
    for (auto* const found : {&pairs.unclear, &pairs.overlapping}) {
      std::sort(found->begin(), found->end());
      found->erase(std::unique(found->begin(), found->end()), found->end());
    }
  }
  may_repeat_ = (1 - lattice_.strain) * lattice_.shortest <= 4 * (1 + 0x1p-20) * radius_ + margin_;
  pairs.may_repeat = may_repeat_;
  has_grid_ = is_whole_step_ && !in_parts_;
}

template <int D>
void NearImages<D>::find_of(const Curves<D>& curves, std::span<const BeadId> beads, bool list_overlapping,
                            ShiftNumbers<D>& shifts, PairsOfImages& pairs) {
  for (const BeadId bead : beads)
    if (!has_grid_ || !replace(curves, bead)) return find(curves, list_overlapping, shifts, pairs);
  pairs.clear();
  pairs.may_repeat = may_repeat_;
  constexpr std::size_t most_moved = 64;
  if (moved_.size() > most_moved) {
    fill_grid();
    forget_moved();
  }
  for (std::size_t i = 0; i < beads.size(); ++i)
    compare_bead(beads[i], beads.first(i), list_overlapping, shifts, pairs);
}

template <int D>
void NearImages<D>::forget_moved() {
  moved_.clear();
  is_moved_.assign(homes_.size(), 0);
}

template <int D>
bool NearImages<D>::replace(const Curves<D>& curves, BeadId bead) {
  if (groups_of(bead) == 0) return true;
  const Measured found = measure_bead(curves, bead);
  if (found.farthest > farthest_ || found.radius > radius_) return false;
  set_points(curves, bead, 0, 1);
  const double* const points = &points_[bead * row_ * dimension];
  const Swept swept = swept_of(bead, points, found.radius);
  if (swept.reach > grid_reach_ || ball_around(points).second > stray_) return false;
  swept_[places_[bead]] = swept;
  if (is_moved_[bead] == 0) moved_.push_back(bead);
  is_moved_[bead] = 1;
  return true;
}

template <int D>
void NearImages<D>::compare_bead(BeadId bead, std::span<const BeadId> done, bool list_overlapping,
                                 ShiftNumbers<D>& shifts, PairsOfImages& pairs) {
  if (groups_of(bead) == 0) return;
  const Swept& one = swept_[places_[bead]];
  Point from{};  // center of the bead's image
  double own_reach = 0;
  const auto look_from = [&](const Shift& image) {
    const Point moved = vector_to(image);
    for (std::size_t axis = 0; axis < dimension; ++axis) from[axis] = one.center[axis] - moved[axis];
    own_reach = one.reach + (is_zero(image) ? 0 : wobble_);
  };
  const auto compare_with = [&](const Swept& other, const Shift& image) {
    double square = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      const double d = other.center[axis] - from[axis];
      square += d * d;
    }
    const double reach = own_reach + other.reach;
    if (square > reach * reach || other.bead == bead || !PairsAsked::joins(one.groups, other.groups)) return;
    if (std::ranges::find(done, other.bead) == done.end())
      look_at(one, other, image, list_overlapping, shifts, pairs);
  };
  // In the grid, apart from beads that have moved.
  const Shift bin = bin_of(one);
  for_each_shift(reach_, [&](const Shift& by) {
    const auto other_bin = neighbour(bin, by);
    if (!other_bin) return;
    const auto& [at, image] = *other_bin;
    look_from(image);
    for (std::uint32_t j = begins_[at]; j < begins_[at + 1]; ++j)
      if (is_moved_[sorted_[j].bead] == 0) compare_with(sorted_[j], image);
  });
  // The images that bins within reach can lie in.
  Shift most{};
  for (std::size_t a = 0; a < dimension; ++a)
    if (lattice_.periodic[a]) most[a] = (reach_[a] + bins_[a] - 1) / bins_[a];
  Point low, high;  // a box of the beads that have moved
  low.fill(unbounded);
  high.fill(-unbounded);
  for (const BeadId other : moved_)
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      low[axis] = std::min(low[axis], swept_[places_[other]].center[axis]);
      high[axis] = std::max(high[axis], swept_[places_[other]].center[axis]);
    }
  for_each_shift(most, [&](const Shift& image) {
    look_from(image);
    const double reach = own_reach + grid_reach_;  // grid_reach_ is at least the reach of each moved bead
    for (std::size_t axis = 0; axis < dimension; ++axis)
      if (low[axis] - from[axis] > reach || from[axis] - high[axis] > reach) return;
    for (const BeadId other : moved_) compare_with(swept_[places_[other]], image);
  });
}

// With d_k the differences of two beads' control points and R_k the vectors at these, an image t meets at
// some time only if |R t + d| <= r. For row a of the inverse of the vectors in the middle, n, n R t differs
// from t_a, the multiple of vector a, by at most |n| strain |M t|, M in the middle, and |M t| is at most (|d|
// + r) / (1 - strain).
template <int D>
void NearImages<D>::find_by_boxes(const Curves<D>& curves, ShiftNumbers<D>& shifts, PairsOfImages& pairs) {
  pairs.clear();
  pairs.may_repeat = true;
  has_grid_ = false;
  row_ = static_cast<std::size_t>(curves.own_degree()) + 1;
  lay_lattice(curves);
  measure(curves);
  if (lattice_.strain > 0.9)
    throw InputError("the periodic cell changes by almost its own size in one step; expected less");
  std::vector<Eigen::Vector3d> differences(row_, Eigen::Vector3d::Zero());
  for (BeadId first = 0; first < curves.bead_count(); ++first) {
    InterruptionCheck::ask();
    for (BeadId second = first + 1; second < curves.bead_count(); ++second) {
      if (!asked_.joins_groups({first, second}) || !asks(first, second)) continue;
      double reach = 0, longest = 0;
      for (std::size_t k = 0; k < row_; ++k) {
        const int point = static_cast<int>(k);
        reach = std::max(reach, curves.radius(first, point) + curves.radius(second, point));
        for (int axis = 0; axis < D; ++axis)
          differences[k][axis] =
              curves.coordinate(second, point, axis) - curves.coordinate(first, point, axis);
        longest = std::max(longest, differences[k].norm());
      }
      const double half =
          (reach + lattice_.strain * (longest + reach) / (1 - lattice_.strain) + margin_) * (1 + 0x1p-20);
      Shift low{}, high{};
      double images = 1;
      for (std::size_t a = 0; a < dimension; ++a) {
        if (!lattice_.periodic[a]) continue;
        const auto row = lattice_.inverse.row(static_cast<Eigen::Index>(a));
        double least = unbounded, most = -unbounded;
        for (const Eigen::Vector3d& d : differences) {
          least = std::min(least, -row.dot(d));
          most = std::max(most, -row.dot(d));
        }
        images *= most - least + 2 * row.norm() * half + 1;
        if (!(images <= most_in_box))
          throw InputError(
              fmt::format("beads {} and {} may meet more than {} images of each other in one step; "
                          "expected a shorter reach, shorter moves or smaller changes of the cell",
                          first, second, most_in_box));
        low[a] = static_cast<std::int32_t>(std::ceil(least - row.norm() * half));
        high[a] = static_cast<std::int32_t>(std::floor(most + row.norm() * half));
      }
      add_box({first, second}, low, high, shifts, pairs);
    }
  }
}

template <int D>
void NearImages<D>::add_box(const BeadPair& pair, const Shift& low, const Shift& high,
                            ShiftNumbers<D>& shifts, PairsOfImages& pairs) const {
  for (std::size_t a = 0; a < dimension; ++a)
    if (low[a] > high[a]) return;
  for (Shift at = low;;) {
    pairs.unclear.push_back({pair, number_of(at, shifts)});
    std::size_t a = 0;
    for (; a < dimension; ++a) {
      if (++at[a] <= high[a]) break;
      at[a] = low[a];
    }
    if (a == dimension) return;
  }
}

template class NearImages<2>;
template class NearImages<3>;

}  // namespace kds
