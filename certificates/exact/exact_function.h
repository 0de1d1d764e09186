#pragma once
// A function of beads on whole numbers. Its coefficients' bound in lengths tells how long they are at the
// width of these beads' control points: most fit into numbers of a fixed width. Longer ones are evaluated
// modulo as many primes as they ask for; where they are longer than the primes reach, on whole numbers
// outright. Exact.
//
// Where the control points themselves are of wildly different size, the function is wide (wide_polynomial.h):
// its coefficients are formed when they are asked for, and as precisely.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "certificates/base/certificate.h"
#include "certificates/exact/exact_polynomial.h"
#include "certificates/exact/exact_work.h"
#include "certificates/exact/recent_functions.h"
#include "certificates/exact/wide_polynomial.h"
#include "motions/curves/copied_curves.h"
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

/// Lengths of so many bits make a function wide: two doubles and 2^54 between them. Those of ordinary input,
/// decimal numbers or rounded ones with what is nearly zero among them, are shorter.
inline constexpr int wide_length_bits = 160;

namespace detail {

/// What forming so many coefficients of so many bits takes.
inline void spend_on_forming(std::size_t count, int bits) {
  ExactWork::spend(count * count * (static_cast<std::size_t>(bits) / 64 + 1));
}

/// The coefficients, `size` bounding them, of curves whose lengths are whole at this scale.
template <class Function, Motion M>
[[nodiscard]] std::vector<Integer> whole_coefficients(const Function& function, const M& motion,
                                                      const CoefficientBits& size, const WholeScale& scale) {
  constexpr Channels channels = channels_of<Function>;
  const int bits = size.bits + size.power * (scale.bits + 1);
  std::vector<Integer> scaled;
  if (bits < FixedInteger::bits) {
    const auto p = function_of(function, FixedView<M, channels>(motion, scale));
    scaled.reserve(p.scaled.size());
    for (const FixedInteger& c : p.scaled) scaled.push_back(c.whole_number());
    spend_on_forming(scaled.size(), bits);
    return scaled;
  }
  const std::size_t count = residues_for(bits);
  if (count > residue_folds.size()) {
    const auto p = function_of(function, IntegerView<M, channels>(motion, scale));
    spend_on_forming(p.scaled.size(), bits);
    return {p.scaled.begin(), p.scaled.end()};
  }

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
  spend_on_forming(scaled.size(), bits);
  return scaled;
}

/// Whether a function is the negative of its formula.
template <class Function>
[[nodiscard]] bool is_negative(const Function& function) {
  if constexpr (requires { function.side(); }) {
    return !function.side();
  } else {
    return false;
  }
}

/// The coefficients of a wide function's formula, from its beads' curves as they were when it was made. `C`:
/// Curves or LiftedCurves.
template <class Function, class C>
class WideFunction final : public CoefficientSource {
  static constexpr Channels channels = channels_of<Function>;

 public:
  template <Motion M>
  WideFunction(const Function& function, const M& motion, const CoefficientBits& size,
               const WholeScale& scale)
      : function_(function), curves_(motion, function.beads), size_(size), scale_(scale) {
    for (std::size_t i = 0; i < function_.beads.size(); ++i) function_.beads[i] = static_cast<BeadId>(i);
  }

  /// All that the formula is of.
  [[nodiscard]] const std::vector<double>& numbers() const { return curves_.numbers(); }

  [[nodiscard]] std::vector<LeadingDigits> leading_digits() const override {
    const auto p = Function::formula(DigitsView<C, channels>(curves_.curves(), scale_), function_.beads);
    spend_on_forming(p.scaled.size(), LeadingDigits::most_bits);
    return {p.scaled.begin(), p.scaled.end()};
  }
  [[nodiscard]] std::vector<Residue> residues(std::uint64_t fold) const override {
    const auto p =
        Function::formula(ResidueView<C, channels>(curves_.curves(), scale_, {fold}), function_.beads);
    spend_on_forming(p.scaled.size(), Residue::bits);
    return {p.scaled.begin(), p.scaled.end()};
  }
  [[nodiscard]] std::vector<Integer> whole() const override {
    std::vector<Integer> scaled = whole_coefficients(function_, curves_.curves(), size_, scale_);
    if (is_negative(function_))
      for (Integer& x : scaled) x = -x;
    return scaled;
  }

 private:
  Function function_;  // of beads numbered from 0
  CopiedCurves<C> curves_;
  CoefficientBits size_;
  WholeScale scale_;
};

}  // namespace detail

template <class Function, Motion M>
[[nodiscard]] ExactPolynomial exact_function_of(const Function& function, const M& motion,
                                                const CoefficientBits& size) {
  const WholeScale scale = whole_scale<channels_of<Function>>(motion, function.beads);
  if (scale.bits < wide_length_bits)
    return ExactPolynomial(detail::whole_coefficients(function, motion, size, scale));
  static const char formula = 0;  // its place is the formula's name
  auto source = std::make_unique<detail::WideFunction<Function, CurvesOf<M>>>(function, motion, size, scale);
  const std::vector<double> numbers = source->numbers();
  return ExactPolynomial(ExactWork::current().recent_functions().of(&formula, numbers, std::move(source),
                                                                    detail::is_negative(function)));
}

}  // namespace kds
