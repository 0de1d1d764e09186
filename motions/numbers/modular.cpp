#include "motions/numbers/modular.h"

namespace kds {

namespace {

constexpr std::size_t primes = residue_folds.size();

/// inverses[i][j]: the inverse of prime j modulo prime i, j < i
constexpr auto inverses = [] {
  std::array<std::array<std::uint64_t, primes>, primes> table{};
  for (std::size_t i = 0; i < primes; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      table[i][j] = Residue{residue_folds[i] - residue_folds[j], residue_folds[i]}.inverse().value;
    }
  }
  return table;
}();

}  // namespace

Integer whole_number(std::span<const std::uint64_t> residues) {
  // Garner: x = d0 + p0 (d1 + p1 (d2 + ...)) with digits between -p/2 and p/2.
  std::array<long long, primes> digits;
  for (std::size_t i = 0; i < residues.size(); ++i) {
    const std::uint64_t fold = residue_folds[i];
    Residue x{residues[i], fold};
    for (std::size_t j = 0; j < i; ++j) {
      x -= Residue::of(digits[j], fold);
      x *= Residue{inverses[i][j], fold};
    }
    const auto digit = static_cast<long long>(x.value);
    const auto modulus = static_cast<long long>(Residue::modulus(fold));
    digits[i] = digit > modulus / 2 ? digit - modulus : digit;
  }
  Integer result = 0;
  mpz_ptr whole = result.get_mpz_t();
  for (std::size_t i = residues.size(); i-- > 0;) {
    mpz_mul_ui(whole, whole, Residue::modulus(residue_folds[i]));
    if (digits[i] < 0) {
      mpz_sub_ui(whole, whole, static_cast<unsigned long>(-digits[i]));
    } else {
      mpz_add_ui(whole, whole, static_cast<unsigned long>(digits[i]));
    }
  }
  return result;
}

}  // namespace kds
