#pragma once
// Sine, cosine, logarithm and cube root from +, -, *, / and square roots alone, which IEEE 754 rounds alike
// everywhere: a model has the same bits on every platform, which the functions of C do not promise. Errors
// are a few units in the last place.

namespace kds::models {

struct SineCosine {
  double sine, cosine;
};

/// Of an angle in full turns.
[[nodiscard]] SineCosine sine_cosine(double turns);

/// Natural; x > 0 and finite.
[[nodiscard]] double logarithm(double x);

/// x >= 0 and finite.
[[nodiscard]] double cube_root(double x);

}  // namespace kds::models
