#pragma once
// Sets how many cases property tests try, and their seed:
//
//   KDS_PROPERTY_CASES   cases of all parts of a test together
//   KDS_PROPERTY_SEED
//
// The cases of a part depend only on the seed and the part.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/support/inputs/polynomials.h"

namespace kds::test {

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::stoull(text);
}

#ifdef KDS_SANITIZED
inline constexpr std::uint64_t default_property_cases = 3000;
#else
inline constexpr std::uint64_t default_property_cases = 50000;
#endif

inline std::uint64_t property_cases() {
  return from_environment("KDS_PROPERTY_CASES", default_property_cases);
}
inline std::uint64_t property_seed() { return from_environment("KDS_PROPERTY_SEED", 20040611); }

inline Random property_random(unsigned part) {
  const std::uint64_t seed = property_seed();
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), part};
  return Random(sequence);
}

/// Shrinks a polynomial that has a fault: drops, zeroes or halves coefficients as long as `is_faulty` holds.
template <class Predicate>
Scaled shrunk(Scaled p, const Predicate& is_faulty) {
  int tries_left = 3000;
  const auto taken = [&](const Scaled& smaller) {
    if (smaller.empty() || smaller == p || --tries_left < 0 || !is_faulty(smaller)) return false;
    p = smaller;
    return true;
  };
  for (bool smaller = true; smaller;) {
    smaller = taken(Scaled(p.begin(), p.end() - 1)) || taken(Scaled(p.begin() + 1, p.end()));
    for (std::size_t k = 0; k < p.size(); ++k) {
      for (const Integer& less : {Integer(0), Integer(p[k] / 65536), Integer(p[k] / 2)}) {
        Scaled candidate = p;
        candidate[k] = less;
        smaller |= taken(candidate);
      }
    }
  }
  return p;
}

}  // namespace kds::test
