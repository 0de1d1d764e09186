#pragma once
// The balls of a scene at one time, one by one: each in a row of four doubles, as vectors take them.

#include <array>
#include <cstddef>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/curves.h"

namespace kds {

/// A centre and a radius; in the plane the fourth double is nobody's.
template <int Dimension>
struct alignas(32) BallRow {
  std::array<double, static_cast<std::size_t>(Dimension)> center{};
  double radius = 0;
};

template <int Dimension>
class BallRows {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  /// Behind the last ball there is room for so many, which may be read.
  static constexpr std::size_t padding = 8;

  BallRows() = default;
  /// Those of a motion at its k-th control points. Throws InputError naming the bead whose coordinates or
  /// radius are not finite, or its radius negative.
  BallRows(const Curves<Dimension>& curves, int k) { (void)move_to(curves, k); }

  /// The same, in the memory they have. Whether radii are others than before, or so many. Where it throws
  /// there are no balls any more.
  bool move_to(const Curves<Dimension>& curves, int k) { return copy(curves, k, nullptr).others_radii; }
  /// The same at the first control points after the start. Whether `start` are those there, bit for bit: they
  /// are looked at in the same pass.
  [[nodiscard]] bool move_on_from(const BallRows& start, const Curves<Dimension>& curves) {
    return copy(curves, 1, &start).start_is_known;
  }

  [[nodiscard]] std::size_t size() const { return rows_.empty() ? 0 : rows_.size() - padding; }
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  /// All radii are this; false where that is not known.
  [[nodiscard]] bool all_have(double radius) const {
    return equal_radii_ && size() > 0 && rows_[0].radius == radius;
  }
  [[nodiscard]] const BallRow<Dimension>* rows() const { return rows_.data(); }

 protected:
  struct Copied {
    bool others_radii, start_is_known;
  };
  Copied copy(const Curves<Dimension>& curves, int k, const BallRows* start);

  std::vector<BallRow<Dimension>> rows_;
  bool equal_radii_ = true;
};

}  // namespace kds
