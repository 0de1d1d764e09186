#include "certificates/exact/recent_coefficients.h"

#include <cstring>

namespace kds {

std::size_t RecentCoefficients::place_of(const Key& key) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (const double& x : key.numbers) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    hash = (hash ^ hash >> 29U ^ bits) * odd;
  }
  return static_cast<std::size_t>(hash >> 40U) % room;
}

const std::vector<Integer>* RecentCoefficients::of(const Key& key) const {
  if (known_.empty()) return nullptr;
  const Known& known = known_[place_of(key)];
  // Compare bit by bit: 0 and -0 make the same function, but it is not worth a special case to share it.
  const bool same = known.formula == key.formula && known.numbers.size() == key.numbers.size() &&
                    std::memcmp(known.numbers.data(), key.numbers.data(), key.numbers.size_bytes()) == 0;
  return same ? &known.coefficients : nullptr;
}

void RecentCoefficients::keep(const Key& key, const std::vector<Integer>& coefficients) {
  if (known_.empty()) known_.resize(room);
  Known& known = known_[place_of(key)];
  known.formula = key.formula;
  known.numbers.assign(key.numbers.begin(), key.numbers.end());
  known.coefficients = coefficients;
}

}  // namespace kds
