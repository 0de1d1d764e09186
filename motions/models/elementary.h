#pragma once
// Sine, cosine, logarithm and cube root computed only from +, -, *, / and square roots, which IEEE 754 rounds
// identically everywhere. A model therefore has the same bits on every platform, which the C library's
// functions do not guarantee. Errors are a few units in the last place.

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

}  // namespace kds::models
