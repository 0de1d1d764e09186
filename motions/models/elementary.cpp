#include "motions/models/elementary.h"

#include <cmath>
#include <numbers>

namespace kds::models {

SineCosine sine_cosine(double turns) {
  const double part = turns - std::nearbyint(turns);  // exact, like the next two lines
  const double quarters = std::nearbyint(4 * part);
  const double x = 2 * std::numbers::pi * (part - quarters / 4);  // at most pi/4
  const double square = x * x;
  double sine = 0, cosine = 0;
  for (int n = 18; n >= 2; n -= 2) {  // Taylor series, summed from the last term
    cosine = (1 - cosine) * square / (n * (n - 1));
    sine = (1 - sine) * square / (n * (n + 1));
  }
  sine = x * (1 - sine);
  cosine = 1 - cosine;
  switch (static_cast<int>(quarters)) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case -1:
      return {-cosine, sine};
    default:
      return {-sine, -cosine};
  }
}

double logarithm(double x) {
  int power = 0;
  double fraction = std::frexp(x, &power);
  if (fraction < std::numbers::sqrt2 / 2) {
    fraction *= 2;
    --power;
  }
  const double z = (fraction - 1) / (fraction + 1);  // log((1+z)/(1-z)) = 2 (z + z^3/3 + z^5/5 + ...)
  double series = 0;
  for (int n = 25; n >= 1; n -= 2) series = series * (z * z) + 1.0 / n;
  return 2 * z * series + power * std::numbers::ln2;
}

double cube_root(double x) {
  if (x == 0) return 0;
  int power = 0;
  static_cast<void>(std::frexp(x, &power));
  double root = std::ldexp(1.0, power / 3);
  for (int round = 0; round < 12; ++round) root = (2 * root + x / root / root) / 3;  // Newton's iteration
  return root;
}

}  // namespace kds::models
