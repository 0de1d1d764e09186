#include "certificates/modular_gcd.h"

#include <cstdint>
#include <utility>

namespace kds {

namespace {

__extension__ using Wide = unsigned __int128;
constexpr std::uint64_t prime = (std::uint64_t{1} << 61U) - 1;

std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::uint64_t>(Wide{a} * b % prime);
}

std::uint64_t inverse(std::uint64_t a) {
  std::uint64_t result = 1;
  for (std::uint64_t exponent = prime - 2; exponent != 0; exponent >>= 1U) {
    if ((exponent & 1U) != 0) result = multiply(result, a);
    a = multiply(a, a);
  }
  return result;
}

std::vector<std::uint64_t> reduce(const std::vector<Integer>& p) {
  std::vector<std::uint64_t> residues;
  residues.reserve(p.size());
  for (const Integer& x : p) residues.push_back(mpz_fdiv_ui(x.backend().data(), prime));
  return residues;
}

void drop_zeros(std::vector<std::uint64_t>& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

}  // namespace

bool certainly_coprime(const std::vector<Integer>& a, const std::vector<Integer>& b) {
  std::vector<std::uint64_t> f = reduce(a);
  std::vector<std::uint64_t> g = reduce(b);
  if (f.empty() || g.empty() || f.back() == 0 || g.back() == 0) return false;
  if (f.size() < g.size()) std::swap(f, g);
  while (!g.empty()) {
    const std::uint64_t scale = inverse(g.back());
    while (f.size() >= g.size()) {
      const std::uint64_t factor = multiply(f.back(), scale);
      const std::size_t shift = f.size() - g.size();
      for (std::size_t i = 0; i < g.size(); ++i) {
        f[i + shift] = (f[i + shift] + prime - multiply(factor, g[i])) % prime;
      }
      drop_zeros(f);
    }
    std::swap(f, g);
  }
  return f.size() == 1;
}

}  // namespace kds
