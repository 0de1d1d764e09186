#include "structures/necklace/balls.h"

#include <bit>
#include <string>
#include <type_traits>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace {

using Row = Lanes::Vector;
using Bits = Lanes::Mask;

/// Replaces the weight by the radius.
[[gnu::always_inline]] inline Row with_radius(const Row& point, const Row& radius) {
  return __builtin_shufflevector(point, radius, 0, 1, 2, 7);
}
template <int D>
[[gnu::always_inline]] inline Row row_of(const Curves<D>& curves, BeadId bead, int k) {
  const double* const point = curves.control_point(bead, k);
  if constexpr (D == 2) return Row{point[0], point[1], curves.radius(bead, k), 0};
  return with_radius(Lanes::load(point), Lanes(curves.radius(bead, k)).v);
}
template <int D>
[[gnu::always_inline]] inline Bits bits_of(const BallRow<D>& row) {
  return reinterpret_cast<Bits>(Lanes::load(row.center.data()));
}

constexpr long long exponent = 0x7ffLL << 52;

/// Observations, number by number, about the rows that were copied.
struct Seen {
  Bits changed{};         // bits that differ from before
  Bits finite = ~Bits{};  // sign bit set while all numbers are finite
  Bits other_start{};     // bits of the beads at the start that differ from the known start
};

// The loop has no branch and no running sum to wait for.
template <int D, bool looks_at_start>
[[KDS_LANES_TARGETS]] Seen copy_rows(const Curves<D>& curves, int k, BallRow<D>* rows,
                                     const BallRow<D>* start) {
  Seen seen;
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    const Row row = row_of(curves, b, k);
    const Bits bits = reinterpret_cast<Bits>(row);
    seen.changed |= bits ^ bits_of(rows[b]);
    seen.finite &= (bits & exponent) - exponent;
    if constexpr (looks_at_start)
      seen.other_start |= reinterpret_cast<Bits>(row_of(curves, b, 0)) ^ bits_of(start[b]);
    __builtin_memcpy(static_cast<void*>(rows + b), &row, sizeof row);
  }
  if (D == 2) seen.other_start[3] = 0;  // the unused fourth double
  return seen;
}

/// Copies rows in space if all radii are known to be unchanged, which is the usual case.
template <bool looks_at_start>
[[KDS_LANES_TARGETS]] Seen copy_centers(const Curves<3>& curves, int k, double radius, BallRow<3>* rows,
                                        const BallRow<3>* start) {
  Seen seen;
  const Row radii = Lanes(radius).v;
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    const Row row = with_radius(Lanes::load(curves.control_point(b, k)), radii);
    seen.finite &= (reinterpret_cast<Bits>(row) & exponent) - exponent;
    if constexpr (looks_at_start)
      seen.other_start |= reinterpret_cast<Bits>(Lanes::load(curves.control_point(b, 0))) ^ bits_of(start[b]);
    __builtin_memcpy(static_cast<void*>(rows + b), &row, sizeof row);
  }
  seen.other_start[3] = 0;  // the fourth number is a weight
  return seen;
}

/// Returns whether all numbers equal `value`, bit for bit.
[[KDS_LANES_TARGETS]] bool all_are(double value, const double* numbers, std::size_t count) {
  const Bits wanted = reinterpret_cast<Bits>(Lanes(value).v);
  Bits other{};
  std::size_t i = 0;
  for (; i + Lanes::width <= count; i += Lanes::width)
    other |= reinterpret_cast<Bits>(Lanes::load(numbers + i)) ^ wanted;
  for (; i < count; ++i) other[0] |= std::bit_cast<long long>(numbers[i]) ^ wanted[0];
  return !Lanes::any(other);
}
template <int D>
bool all_radii_are(double radius, const Curves<D>& curves) {
  const std::size_t beads = curves.bead_count(), each = static_cast<std::size_t>(curves.own_degree()) + 1;
  if (beads > 1 && curves.radii(1) != curves.radii(0) + each) return false;  // radii are not one array
  return beads > 0 && all_are(radius, curves.radii(0), beads * each);
}

template <int D>
[[noreturn]] void refuse(const BallRow<D>* rows) {
  for (BeadId b = 0;; ++b) {
    for (const double x : rows[b].center)
      if (x - x != 0) throw InputError("bead " + std::to_string(b) + ": expected finite coordinates");
    const double r = rows[b].radius;
    if (!(r >= 0 && r - r == 0))
      throw InputError("bead " + std::to_string(b) + ": expected a finite radius, not negative");
  }
}

/// The loop handles four beads at a time; memory beyond the last bead is writable.
template <int D>
[[KDS_LANES_TARGETS]] void spread_rows(const BallRow<D>* rows, std::size_t beads,
                                       const std::array<double*, static_cast<std::size_t>(D)>& centers) {
  for (std::size_t b = 0; b < beads; b += Lanes::width) {
    const auto numbers = Lanes::transposed(rows[b].center.data(), rows[b + 1].center.data(),
                                           rows[b + 2].center.data(), rows[b + 3].center.data());
    for (std::size_t axis = 0; axis < D; ++axis)
      __builtin_memcpy(centers[axis] + b, &numbers[axis].v, sizeof numbers[axis].v);
  }
}

}  // namespace

template <int D>
auto BallRows<D>::copy(const Curves<D>& curves, int k, const BallRows* start) -> Copied {
  const std::size_t beads = curves.bead_count();
  const bool others = rows_.size() != beads + padding;
  const bool looks_at_start = start != nullptr && start->size() == beads;
  rows_.resize(beads + padding);
  const BallRow<D>* const start_rows = looks_at_start ? start->rows() : nullptr;
  const auto radii_stay = [&] {
    return !others && equal_radii_ && (!looks_at_start || start->all_have(rows_[0].radius)) &&
           all_radii_are(rows_[0].radius, curves);
  };
  const auto copied = [&]<bool looks>(std::bool_constant<looks>) {
    if constexpr (D == 3)
      if (radii_stay()) return copy_centers<looks>(curves, k, rows_[0].radius, rows_.data(), start_rows);
    return copy_rows<D, looks>(curves, k, rows_.data(), start_rows);
  };
  const Seen seen = looks_at_start ? copied(std::true_type{}) : copied(std::false_type{});
  bool wrong = false;
  for (std::size_t i = 0; i <= D; ++i) wrong |= seen.finite[i] >= 0;
  const bool others_radii = others || seen.changed[D] != 0;
  if (others_radii) {
    equal_radii_ = true;
    for (std::size_t b = 0; b < beads; ++b) {
      equal_radii_ &= rows_[b].radius == rows_[0].radius;
      wrong |= !(rows_[b].radius >= 0);
    }
  }
  if (wrong) {
    const auto rows = std::exchange(rows_, {});
    refuse(rows.data());
  }
  return {others_radii, looks_at_start && !Lanes::any(seen.other_start)};
}

template class BallRows<2>;
template class BallRows<3>;

template <int D>
bool Balls<D>::copy(const Curves<D>& curves, int k, const Balls* start) {
  const auto [others_radii, start_is_known] = BallRows<D>::copy(curves, k, start);
  std::array<double*, static_cast<std::size_t>(D)> centers;
  for (std::size_t axis = 0; axis < D; ++axis) {
    centers_[axis].resize(rows_.size());
    centers[axis] = centers_[axis].data();
  }
  spread_rows(rows_.data(), size(), centers);
  if (others_radii) {
    radii_.resize(rows_.size());
    for (std::size_t b = 0; b < size(); ++b) radii_[b] = rows_[b].radius;
  }
  return start_is_known;
}

template class Balls<2>;
template class Balls<3>;

}  // namespace kds
