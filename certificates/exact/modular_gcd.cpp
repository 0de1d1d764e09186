#include "certificates/exact/modular_gcd.h"

#include <cstddef>
#include <utility>

#include "motions/numbers/modular.h"

namespace kds {

namespace {

constexpr std::uint64_t fold = residue_folds[0];

std::vector<Residue> reduce(const std::vector<Integer>& p) {
  std::vector<Residue> residues;
  residues.reserve(p.size());
  for (const Integer& x : p) {
    residues.push_back({mpz_fdiv_ui(x.backend().data(), Residue::modulus(fold)), fold});
  }
  return residues;
}

void drop_zeros(std::vector<Residue>& p) {
  while (!p.empty() && p.back().value == 0) p.pop_back();
}

// Euclid's algorithm; multiples of the remainders will do. Leading coefficients not zero.
bool coprime(std::vector<Residue> f, std::vector<Residue> g) {
  if (f.size() < g.size()) std::swap(f, g);
  while (!g.empty()) {
    const Residue lead = g.back();
    while (f.size() >= g.size()) {
      const Residue factor = -f.back();
      const std::size_t shift = f.size() - g.size();
      for (std::size_t i = 0; i < shift; ++i) f[i] *= lead;
      for (std::size_t i = 0; i < g.size(); ++i) {
        SumOfProducts<Residue> sum(f[i + shift], lead);
        sum.add(factor, g[i]);
        f[i + shift] = std::move(sum).value();
      }
      drop_zeros(f);
    }
    std::swap(f, g);
  }
  return f.size() == 1;
}

}  // namespace

bool certainly_coprime(const std::vector<Integer>& a, const std::vector<Integer>& b) {
  std::vector<Residue> f = reduce(a);
  std::vector<Residue> g = reduce(b);
  if (f.empty() || g.empty() || f.back().value == 0 || g.back().value == 0) return false;
  return coprime(std::move(f), std::move(g));
}

bool certainly_square_free(const std::vector<Integer>& p) {
  std::vector<Residue> f = reduce(p);
  if (f.back().value == 0) return false;
  std::vector<Residue> derivative(f.begin() + 1, f.end());
  for (std::size_t k = 0; k < derivative.size(); ++k) derivative[k] *= static_cast<long long>(k + 1);
  return coprime(std::move(f), std::move(derivative));
}

}  // namespace kds
