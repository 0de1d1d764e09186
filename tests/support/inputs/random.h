#pragma once
// Random numbers. One seed gives the same numbers on every machine with the same standard library.

#include <random>

#include "motions/numbers/exact_number.h"

namespace kds::test {

using Random = std::mt19937_64;

inline int pick(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

inline double uniform(Random& random, double low = -1, double high = 1) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Returns a random dyadic number in [0, 1], often a special one.
inline Dyadic random_dyadic(Random& random) {
  switch (pick(random, 0, 4)) {
    case 0:
      return Dyadic(0.0);
    case 1:
      return Dyadic(0.5);
    case 2: {
      const int bits = pick(random, 1, 6);
      return Dyadic(Integer(pick(random, 0, 1 << bits)), static_cast<unsigned>(bits));
    }
    default: {
      const auto bits = static_cast<unsigned>(pick(random, 20, 64));
      return Dyadic(Integer(random()) >> (64 - bits), bits);
    }
  }
}

}  // namespace kds::test
