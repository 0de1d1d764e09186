#include "motions/numbers/modular.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "tests/support/inputs/random.h"

namespace kds::modular_test {
namespace {

using test::Random;

Integer modulus(std::size_t i) { return Residue::modulus(residue_folds[i]); }

// Returns the residue in [0, modulus).
std::uint64_t residue_of(const Integer& x, std::size_t i) {
  return mpz_fdiv_ui(x.get_mpz_t(), Residue::modulus(residue_folds[i]));
}

Residue random_residue(Random& random, std::uint64_t fold) {
  switch (random() % 4) {
    case 0:
      return {random() % 3, fold};
    case 1:
      return {Residue::modulus(fold) - 1 - random() % 3, fold};
    default:
      return {random() % Residue::modulus(fold), fold};
  }
}

TEST(Residue, ModuliAreDifferentPrimes) {
  for (std::size_t i = 0; i < residue_folds.size(); ++i) {
    EXPECT_NE(mpz_probab_prime_p(modulus(i).get_mpz_t(), 30), 0);
    if (i > 0) {
      EXPECT_LT(residue_folds[i - 1], residue_folds[i]);
    }
    EXPECT_LT(residue_folds[i], 1U << 11U);
  }
}

TEST(Residue, CalculatesAsWholeNumbersDo) {
  Random random(61);
  for (int round = 0; round < 20000; ++round) {
    const std::size_t i = random() % residue_folds.size();
    const std::uint64_t fold = residue_folds[i];
    const Residue a = random_residue(random, fold);
    const Residue b = random_residue(random, fold);
    const Integer x = a.value;
    const Integer y = b.value;
    EXPECT_EQ((a + b).value, residue_of(x + y, i));
    EXPECT_EQ((a - b).value, residue_of(x - y, i));
    EXPECT_EQ((a * b).value, residue_of(x * y, i));
    EXPECT_EQ((-a).value, residue_of(-x, i));
    const auto factor = static_cast<std::int64_t>(random() >> (random() % 40 + 4)) * (random() % 2 ? 1 : -1);
    EXPECT_EQ(Residue::of(factor, fold).value, residue_of(factor, i));
    Residue c = a;
    c *= factor;
    EXPECT_EQ(c.value, residue_of(x * factor, i));
    const auto shift = static_cast<unsigned>(random() % 4200);
    c = a;
    c <<= shift;
    EXPECT_EQ(c.value, residue_of(x << shift, i));
    const Wide wide = (Wide{random()} << 64U) | random();
    EXPECT_EQ(
        Residue::reduced(wide, fold).value,
        residue_of(
            (Integer(static_cast<std::uint64_t>(wide >> 64U)) << 64) + static_cast<std::uint64_t>(wide), i));
    if (a.value != 0) {
      EXPECT_EQ((a * a.inverse()).value, 1U);
    }
  }
}

TEST(Residue, AddsUpAnyNumberOfProducts) {
  for (const std::uint64_t fold : residue_folds) {
    const Residue most{Residue::modulus(fold) - 1, fold};  // -1
    SumOfProducts<Residue> sum(most, most);
    for (std::uint64_t n = 2; n <= 300; ++n) {
      sum.add(most, most);
      EXPECT_EQ(SumOfProducts<Residue>(sum).value().value, n);
    }
  }
}

TEST(Residue, WholeNumbersComeBack) {
  Random random(62);
  std::vector<std::uint64_t> residues;
  const auto round_trip = [&residues](const Integer& x) {
    for (std::size_t i = 0; i < residues.size(); ++i) residues[i] = residue_of(x, i);
    return whole_number(residues);
  };
  Integer product = 1;
  for (std::size_t count = 1; count <= residue_folds.size(); ++count) {
    product *= modulus(count - 1);
    residues.resize(count);
    // The largest width for which this number of primes is enough.
    int bits = static_cast<int>(Residue::bits * count);
    while (residues_for(bits) > count) --bits;
    ASSERT_GE(bits, static_cast<int>(Residue::bits * count) - 2);
    const Integer limit = Integer(1) << static_cast<unsigned>(bits);
    ASSERT_LT(2 * limit, product);
    for (const Integer& x : {Integer(0), Integer(1), Integer(limit - 1), Integer(product / 2)}) {
      EXPECT_EQ(round_trip(x), x);
      EXPECT_EQ(round_trip(-x), -x);
    }
    for (int i = 0; i < 200; ++i) {
      Integer x = 0;
      for (std::size_t word = 0; word <= count; ++word) x = (x << 64) + random();
      x %= limit;
      x >>= static_cast<unsigned>(random() % 61 * count);
      EXPECT_EQ(round_trip(x), x);
      EXPECT_EQ(round_trip(-x), -x);
    }
  }
}

}  // namespace
}  // namespace kds::modular_test
