#pragma once
// The balls of a scene at one time as an array of structures: each ball is a row of four doubles, the layout
// that vector loads take.

#include <array>
#include <cstddef>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/curves.h"

namespace kds {

/// A centre and a radius. In the plane the fourth double is unused.
template <int Dimension>
struct alignas(32) BallRow {
  std::array<double, static_cast<std::size_t>(Dimension)> center{};
  double radius = 0;
};

template <int Dimension>
class BallRows {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  /// Number of rows that are readable beyond the last ball.
  static constexpr std::size_t padding = 8;

  BallRows() = default;
  /// Constructs the balls of a motion at its k-th control points. Throws InputError naming the bead if a
  /// coordinate or radius is not finite, or if a radius is negative.
  BallRows(const Curves<Dimension>& curves, int k) { (void)move_to(curves, k); }

  /// Moves the balls to the k-th control points of a motion and reuses their memory. Returns whether any
  /// radius, or the number of radii, differs from before. If this throws, the object holds no balls any more.
  bool move_to(const Curves<Dimension>& curves, int k) { return copy(curves, k, nullptr).others_radii; }
  /// Moves the balls to the first control points after the start. Returns whether `start` equals the balls at
  /// the start, bit for bit. The comparison takes place in the same pass.
  [[nodiscard]] bool move_on_from(const BallRows& start, const Curves<Dimension>& curves) {
    return copy(curves, 1, &start).start_is_known;
  }

  [[nodiscard]] std::size_t size() const { return rows_.empty() ? 0 : rows_.size() - padding; }
  [[nodiscard]] bool equal_radii() const { return equal_radii_; }
  /// Returns true if all radii are known to equal `radius`, else false.
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
