#pragma once
// Random numbers, and sine, cosine, logarithm and cube root, computed only from +, -, *, / and square roots,
// which IEEE 754 rounds identically everywhere. A model therefore has the same bits on every platform, which
// the C library's functions do not guarantee. Errors are a few units in the last place.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace kds::models {

struct SineCosine {
  double sine, cosine;
};

/// Returns sine and cosine of an angle in full turns.
[[nodiscard]] SineCosine sine_cosine(double turns);

/// Returns the natural logarithm of x > 0, which must be finite.
[[nodiscard]] double logarithm(double x);

/// Returns the cube root of x >= 0, which must be finite.
[[nodiscard]] double cube_root(double x);

/// Random numbers. The C++ standard prescribes the engine but not its distributions, so the distributions are
/// implemented here.
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
