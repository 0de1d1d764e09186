#pragma once
// Whole numbers modulo primes of 61 bits: a formula is evaluated modulo a few of them, and its exact value
// put together from the residues, as long as it is known to be small enough. A product costs a multiplication
// for each prime, whatever the width.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "motions/numbers/bernstein.h"
#include "motions/numbers/exact_number.h"

namespace kds {

__extension__ using Wide = unsigned __int128;

/// 0 <= value < modulus = 2^61 - fold, a prime. Only numbers of one modulus mix.
struct Residue {
  static constexpr int bits = 61;

  std::uint64_t value = 0;
  std::uint64_t fold = 1;

  [[nodiscard]] static constexpr Residue reduced(Wide x, std::uint64_t fold) {
    // 2^64 = 8 fold and 2^61 = fold
    const Wide y = (x >> 64U) * (8 * fold) + static_cast<std::uint64_t>(x);
    const std::uint64_t z = (static_cast<std::uint64_t>(y) & ((std::uint64_t{1} << bits) - 1)) +
                            static_cast<std::uint64_t>(y >> bits) * fold;
    return Residue{z, fold}.once();
  }
  /// |x| < 2^61 - 2^11
  [[nodiscard]] static constexpr Residue of(long long x, std::uint64_t fold) {
    return {x < 0 ? modulus(fold) - static_cast<std::uint64_t>(-x) : static_cast<std::uint64_t>(x), fold};
  }
  [[nodiscard]] static constexpr std::uint64_t modulus(std::uint64_t fold) {
    return (std::uint64_t{1} << bits) - fold;
  }

  constexpr Residue& operator+=(const Residue& other) {
    value += other.value;
    return *this = once();
  }
  constexpr Residue& operator-=(const Residue& other) {
    value += modulus(fold) - other.value;
    return *this = once();
  }
  constexpr Residue& operator*=(const Residue& other) {
    return *this = reduced(Wide{value} * other.value, fold);
  }
  constexpr Residue& operator*=(long long factor) { return *this *= of(factor, fold); }
  constexpr Residue& operator<<=(unsigned shift) {
    for (; shift > 60; shift -= 60) *this = reduced(Wide{value} << 60U, fold);
    return *this = reduced(Wide{value} << shift, fold);
  }
  friend constexpr Residue operator+(Residue a, const Residue& b) { return a += b; }
  friend constexpr Residue operator-(Residue a, const Residue& b) { return a -= b; }
  friend constexpr Residue operator*(Residue a, const Residue& b) { return a *= b; }
  friend constexpr Residue operator-(const Residue& a) { return Residue{0, a.fold} - a; }
  friend constexpr bool operator==(const Residue& a, const Residue& b) = default;

  /// The inverse, as a^(modulus-2); a must not be zero.
  [[nodiscard]] constexpr Residue inverse() const {
    Residue result{1, fold};
    Residue power = *this;
    for (std::uint64_t e = modulus(fold) - 2; e != 0; e >>= 1U) {
      if ((e & 1U) != 0) result *= power;
      power *= power;
    }
    return result;
  }

 private:
  [[nodiscard]] constexpr Residue once() const {
    return {value >= modulus(fold) ? value - modulus(fold) : value, fold};
  }
};

/// Adds products up unreduced as long as 128 bits hold the sum.
template <>
class SumOfProducts<Residue> {
 public:
  constexpr SumOfProducts(const Residue& a, const Residue& b)
      : sum_(Wide{a.value} * b.value), fold_(a.fold) {}
  constexpr void add(const Residue& a, const Residue& b) {
    if ((sum_ >> 127U) != 0) sum_ = Residue::reduced(sum_, fold_).value;
    sum_ += Wide{a.value} * b.value;
  }
  [[nodiscard]] constexpr Residue value() && { return Residue::reduced(sum_, fold_); }

 private:
  Wide sum_;
  std::uint64_t fold_;
};

/// The largest primes below 2^61, as 2^61 - fold.
inline constexpr std::array<std::uint64_t, 32> residue_folds{
    1,   31,  45,  229, 259, 283,  339,  391,  403,  465,  531,  579,  675,  759,  799,  819,
    829, 843, 859, 939, 985, 1015, 1153, 1195, 1215, 1281, 1299, 1351, 1371, 1425, 1489, 1525};

/// How many residues distinguish all whole numbers below 2^bits in size.
[[nodiscard]] constexpr std::size_t residues_for(int bits) {
  // Twice that for the sign; the product of n moduli is above 2^(61 n - 1).
  return static_cast<std::size_t>((bits + 2 + Residue::bits - 1) / Residue::bits);
}

/// The whole number nearest to zero with these residues, modulo the first of the primes.
[[nodiscard]] Integer whole_number(std::span<const std::uint64_t> residues);

}  // namespace kds
