#pragma once
// A function of beads on whole numbers. Its coefficients' bound in lengths tells how long they are at the
// width of these beads' control points: most fit into numbers of a fixed width. Longer ones are evaluated
// modulo as many primes as they ask for; where they are longer than the primes reach, on whole numbers
// outright. Exact.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "certificates/base/certificate.h"
#include "certificates/exact/exact_polynomial.h"
#include "motions/numbers/magnitude.h"
#include "motions/views/integer_view.h"

namespace kds {

/// All coefficients are below 2^(bits + power * length_bits) in size where differences and sums of two
/// lengths are below 2^length_bits and those of their squares below 2^(2 length_bits).
struct CoefficientBits {
  int bits = 0;
  int power = 0;
};

/// The bound of a function's coefficients, by its values over magnitudes (motions/numbers/magnitude.h).
template <class Magnitudes>
[[nodiscard]] CoefficientBits coefficient_bits(const Magnitudes& magnitudes) {
  CoefficientBits result;
  for (const Magnitude& m : magnitudes.scaled) {
    // Rounded on the way: by far less than one bit.
    result = {std::max(result.bits, std::ilogb(m.bound) + 2), m.power};
  }
  return result;
}

template <class Function, Motion M>
[[nodiscard]] ExactPolynomial exact_function_of(const Function& function, const M& motion,
                                                const CoefficientBits& size) {
  constexpr Channels channels = channels_of<Function>;
  const WholeScale scale = whole_scale<channels>(motion, function.beads);
  const int bits = size.bits + size.power * (scale.bits + 1);
  std::vector<Integer> scaled;
  if (bits < FixedInteger::bits) {
    const auto p = function_of(function, FixedView<M, channels>(motion, scale));
    scaled.reserve(p.scaled.size());
    for (const FixedInteger& c : p.scaled) scaled.push_back(c.whole_number());
    return ExactPolynomial(std::move(scaled));
  }
  const std::size_t count = residues_for(bits);
  if (count > residue_folds.size())
    return ExactPolynomial(function_of(function, IntegerView<M, channels>(motion, scale)));

  using Residual = std::array<std::uint64_t, residue_folds.size()>;
  Coefficients<Residual> residues;  // of each coefficient
  for (std::size_t i = 0; i < count; ++i) {
    const auto p = function_of(function, ResidueView<M, channels>(motion, scale, {residue_folds[i]}));
    residues.resize(p.scaled.size());
    for (std::size_t k = 0; k < p.scaled.size(); ++k) residues[k][i] = p.scaled[k].value;
  }
  scaled.reserve(residues.size());
  for (const auto& coefficient : residues)
    scaled.push_back(whole_number(std::span(coefficient).first(count)));
  return ExactPolynomial(std::move(scaled));
}

}  // namespace kds
