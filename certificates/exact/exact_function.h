#pragma once
// A function of beads on whole numbers, formed as precisely as it is asked for: by leading digits, modulo one
// prime, or outright. Then it is evaluated modulo a few primes, as many as its coefficients' bound in lengths
// asks for at the width of these beads' control points; where those are wider than the primes reach, on whole
// numbers. Exact.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "certificates/base/certificate.h"
#include "certificates/exact/exact_polynomial.h"
#include "certificates/exact/recent_functions.h"
#include "motions/curves/lifted_motion.h"
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

namespace detail {

/// Control points of a few beads, numbered from 0, by themselves: their motion may change or go.
template <int DimensionValue>
class CopiedCurves {
 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = any_degree;

  template <Motion M>
  CopiedCurves(const M& motion, std::span<const BeadId> beads)
      : degree_(degree_of(motion)), beads_(beads.size()) {
    const auto points = static_cast<std::size_t>(degree_) + 1;
    numbers_.reserve(beads_ * points * (dimension + 2));
    for (const BeadId bead : beads) {
      for (int k = 0; k <= degree_; ++k) {
        for (int axis = 0; axis < dimension; ++axis) numbers_.push_back(motion.coordinate(bead, k, axis));
        numbers_.push_back(motion.weight(bead, k));
      }
    }
    for (const BeadId bead : beads)
      for (int k = 0; k <= degree_; ++k) numbers_.push_back(motion.radius(bead, k));
  }

  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }
  [[nodiscard]] int own_degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return numbers_.data() + (bead * (degree_ + 1U) + static_cast<std::size_t>(k)) * (dimension + 1);
  }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const {
    return numbers_.data() + (beads_ * (dimension + 1) + bead) * (degree_ + 1U);
  }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }

 private:
  int degree_;
  std::size_t beads_;
  std::vector<double> numbers_;
};

/// The coefficients of a function of beads, from their curves as they were when it was made.
template <class Function, class C>
class FunctionSource final : public CoefficientSource {
  static constexpr Channels channels = channels_of<Function>;

 public:
  template <Motion M>
  FunctionSource(const Function& function, const M& motion, const CoefficientBits& size)
      : function_(function),
        copied_(motion, function.beads),
        curves_(curves_of(copied_, motion)),
        size_(size) {
    std::iota(function_.beads.begin(), function_.beads.end(), BeadId{0});
    scale_ = whole_scale<channels>(curves_, function_.beads);
  }

  /// All that the function is made from.
  [[nodiscard]] std::vector<double> numbers() const {
    std::vector<double> all = copied_.numbers();
    if constexpr (requires { function_.side(); }) all.push_back(function_.side() ? 1 : -1);
    if constexpr (lifted<C>)
      for (int axis = 0; axis < C::dimension; ++axis) all.push_back(curves_.drift(axis));
    all.push_back(copied_.own_degree());
    return all;
  }

  [[nodiscard]] std::vector<Enclosure> leading_digits() const override {
    const auto p = function_of(function_, EnclosureView<C, channels>(curves_, scale_));
    return {p.scaled.begin(), p.scaled.end()};
  }
  [[nodiscard]] std::vector<Residue> residues(std::uint64_t fold) const override {
    const auto p = function_of(function_, ResidueView<C, channels>(curves_, scale_, {fold}));
    return {p.scaled.begin(), p.scaled.end()};
  }
  [[nodiscard]] std::vector<Integer> whole() const override {
    const std::size_t count = residues_for(size_.bits + size_.power * (scale_.bits + 1));
    if (count > residue_folds.size()) {
      auto p = function_of(function_, IntegerView<C, channels>(curves_, scale_));
      return {std::make_move_iterator(p.scaled.begin()), std::make_move_iterator(p.scaled.end())};
    }
    using Residual = std::array<std::uint64_t, residue_folds.size()>;
    std::vector<Residual> residues;  // of each coefficient
    for (std::size_t i = 0; i < count; ++i) {
      const auto p = function_of(function_, ResidueView<C, channels>(curves_, scale_, {residue_folds[i]}));
      residues.resize(p.scaled.size());
      for (std::size_t k = 0; k < p.scaled.size(); ++k) residues[k][i] = p.scaled[k].value;
    }
    std::vector<Integer> scaled;
    scaled.reserve(residues.size());
    for (const auto& coefficient : residues)
      scaled.push_back(whole_number(std::span(coefficient).first(count)));
    return scaled;
  }

 private:
  template <class Copied, Motion M>
  static C curves_of(const Copied& copied, const M& motion) {
    const Curves<C::dimension> curves(copied);
    if constexpr (lifted<C>) {
      typename C::Vector drift{};
      for (int axis = 0; axis < C::dimension; ++axis)
        drift[static_cast<std::size_t>(axis)] = motion.drift(axis);
      return C(curves, drift);
    } else {
      return curves;
    }
  }

  Function function_;
  CopiedCurves<C::dimension> copied_;
  C curves_;  // of the copy
  CoefficientBits size_;
  WholeScale scale_;
};

}  // namespace detail

template <class Function, Motion M>
[[nodiscard]] ExactPolynomial exact_function_of(const Function& function, const M& motion,
                                                const CoefficientBits& size) {
  static const char formula = 0;  // its place is the formula's name
  auto source = std::make_unique<detail::FunctionSource<Function, CurvesOf<M>>>(function, motion, size);
  const std::vector<double> numbers = source->numbers();
  return recent_functions().of(&formula, numbers, std::move(source));
}

}  // namespace kds
