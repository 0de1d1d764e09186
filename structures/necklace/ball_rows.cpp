#include "structures/necklace/ball_rows.h"

#include <string>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace {

using Row = Lanes::Vector;
using Bits = Lanes::Mask;

template <int D>
[[gnu::always_inline]] inline Row row_of(const Curves<D>& curves, BeadId bead, int k) {
  const double* const point = curves.control_point(bead, k);
  if constexpr (D == 2) return Row{point[0], point[1], curves.radius(bead, k), 0};
  Row row = Lanes::load(point);
  row[3] = curves.radius(bead, k);  // in the weight's place
  return row;
}
template <int D>
[[gnu::always_inline]] inline Bits bits_of(const BallRow<D>& row) {
  return reinterpret_cast<Bits>(Lanes::load(row.center.data()));
}

/// What was seen of rows that were copied, number by number.
struct Seen {
  Bits changed{};         // bits that are others than before
  Bits finite = ~Bits{};  // negative where all are
  Bits other_start{};     // bits of beads at the start that are others than those known
};

// No branch, and no sum to wait for.
template <int D, bool looks_at_start>
[[KDS_LANES_TARGETS]] void copy_rows(const Curves<D>& curves, int k, BallRow<D>* rows,
                                     const BallRow<D>* start, Seen& result) {
  constexpr long long exponent = 0x7ffLL << 52;
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
  if (D == 2) seen.other_start[3] = 0;  // nobody's
  result = seen;
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

}  // namespace

template <int D>
auto BallRows<D>::copy(const Curves<D>& curves, int k, const BallRows* start) -> Copied {
  const std::size_t beads = curves.bead_count();
  const bool others = rows_.size() != beads + padding;
  const bool looks_at_start = start != nullptr && start->size() == beads;
  rows_.resize(beads + padding);
  Seen seen;
  if (looks_at_start) {
    copy_rows<D, true>(curves, k, rows_.data(), start->rows(), seen);
  } else {
    copy_rows<D, false>(curves, k, rows_.data(), nullptr, seen);
  }
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

}  // namespace kds
