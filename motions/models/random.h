#pragma once
// Random numbers that are the same for the same seed on every platform. The C++ standard prescribes the
// engine but not its distributions, so the distributions are implemented here.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace kds::models {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Returns a number in [0, 1), a multiple of 2^-53.
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }

  /// Returns a random unit vector whose coordinates from index `dimension` on are zero, by rejection from the
  /// cube around the ball.
  [[nodiscard]] Eigen::Vector3d direction(int dimension = 3) {
    for (;;) {
      Eigen::Vector3d d = Eigen::Vector3d::Zero();
      for (Eigen::Index axis = 0; axis < dimension; ++axis) d[axis] = 2 * uniform() - 1;
      const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      if (square <= 1 && square >= 0x1p-20) return d / std::sqrt(square);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace kds::models
