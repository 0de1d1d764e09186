#include "certificates/exact/recent_functions.h"

#include <bit>
#include <cstddef>
#include <utility>

namespace kds {

namespace {

// Bit by bit: 0 and -0 make the same function, but need not share it.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

std::uint64_t hash_of(const void* formula, const std::vector<double>& numbers) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
  auto hash = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(formula)) * odd;
  for (const double x : numbers) hash = std::rotl((hash ^ std::bit_cast<std::uint64_t>(x)) * odd, 29);
  return hash;
}

}  // namespace

ExactPolynomial RecentFunctions::of(const void* formula, const std::vector<double>& numbers,
                                    std::unique_ptr<const CoefficientSource> source) {
  std::optional<Known>& known = known_[hash_of(formula, numbers) % room];
  if (!known || known->formula != formula || !same(known->numbers, numbers))
    known = Known{formula, numbers, ExactPolynomial(std::move(source))};
  return known->function;
}

RecentFunctions& recent_functions() {
  thread_local RecentFunctions functions;
  return functions;
}

}  // namespace kds
