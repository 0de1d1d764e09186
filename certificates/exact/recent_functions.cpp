#include "certificates/exact/recent_functions.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

namespace kds {

namespace {

// Compares bit by bit, so 0 and -0 give two entries of one function.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

std::uint64_t hash_of(const std::vector<double>& numbers) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
  std::uint64_t hash = 0;
  for (const double x : numbers) hash = std::rotl((hash ^ std::bit_cast<std::uint64_t>(x)) * odd, 29);
  return hash;
}

}  // namespace

std::shared_ptr<const WidePolynomial> RecentFunctions::of(const void* formula,
                                                          const std::vector<double>& numbers,
                                                          std::unique_ptr<const CoefficientSource> source,
                                                          bool negative) {
  Shelf& shelf = shelves_[hash_of(numbers) % shelves_.size()];
  for (const Known& known : shelf.known) {
    if (known.formula == formula && same(known.numbers, numbers))
      return negative ? known.negative : known.function;
  }
  Known& entry = shelf.known[shelf.oldest];
  shelf.oldest = (shelf.oldest + 1) % shelf.known.size();
  const auto function = std::make_shared<const WidePolynomial>(std::move(source));
  entry = {formula, numbers, function, std::make_shared<const WidePolynomial>(function)};
  return negative ? entry.negative : entry.function;
}

std::size_t RecentCoefficients::entry_of(const Key& key) {
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
  const Known& known = known_[entry_of(key)];
  // Compare bit by bit: 0 and -0 make the same function, but it is not worth a special case to share it.
  const bool same = known.formula == key.formula && known.numbers.size() == key.numbers.size() &&
                    std::memcmp(known.numbers.data(), key.numbers.data(), key.numbers.size_bytes()) == 0;
  return same ? &known.coefficients : nullptr;
}

void RecentCoefficients::keep(const Key& key, const std::vector<Integer>& coefficients) {
  if (known_.empty()) known_.resize(room);
  Known& known = known_[entry_of(key)];
  known.formula = key.formula;
  known.numbers.assign(key.numbers.begin(), key.numbers.end());
  known.coefficients = coefficients;
}

}  // namespace kds
