#include "certificates/formulas/bead_function.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "certificates/formulas/formula_player.h"
#include "motions/views/motion_view.h"

namespace kds {

namespace {

template <class View>
Coefficients<Magnitude> magnitudes_over(const View& view, const RecordedFormula& formula) {
  return play(formula, ViewedBeads<View>(view));
}

ErrorBound error_bound_of(const Coefficients<Magnitude>& magnitudes) {
  const auto degree = static_cast<int>(magnitudes.size()) - 1;
  constexpr double inflation = 1 + 0x1p-30;
  constexpr double u = Magnitude::unit_roundoff;

  ErrorBound bound;
  bound.coefficient.resize(magnitudes.size());
  for (std::size_t k = 0; k < magnitudes.size(); ++k) {
    const Magnitude& m = magnitudes[k];
    const auto choose = static_cast<double>(binomial(degree, static_cast<int>(k)));
    bound.power = m.power;
    bound.coefficient[k] = m.error * inflation;
    bound.uniform = std::max(bound.uniform, (m.error + u * (m.bound + m.error)) / choose * inflation);
  }
  return bound;
}

CoefficientBits bits_of(const Coefficients<Magnitude>& magnitudes) {
  CoefficientBits bits;
  for (const Magnitude& m : magnitudes) {
    // The bound is rounded, but by far less than one bit.
    bits = {std::max(bits.bits, std::ilogb(m.bound) + 2), m.power};
  }
  return bits;
}

}  // namespace

KnownFormula::KnownFormula(RecordedFormula formula, Channels channels, int dimension, bool lifted)
    : formula_(std::move(formula)), channels_(channels), dimension_(dimension), lifted_(lifted) {}

const KnownFormula::Derived& KnownFormula::of(int degree) const {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<Derived>& known = derived_[degree];
  if (!known) known = std::make_unique<Derived>(derive(degree));
  return *known;
}

KnownFormula::Derived KnownFormula::derive(int degree) const {
  const auto over = [&]<int dimension>(std::integral_constant<int, dimension>) -> Derived {
    const Coefficients<Magnitude> magnitudes =
        lifted_ ? magnitudes_over(MagnitudeView<dimension, 1, true>(), formula_)
                : magnitudes_over(MagnitudeView<dimension, any_degree>(degree), formula_);
    return {error_bound_of(magnitudes), bits_of(magnitudes)};
  };
  switch (dimension_) {
    case 1:
      return over(std::integral_constant<int, 1>{});
    case 2:
      return over(std::integral_constant<int, 2>{});
    case 3:
      return over(std::integral_constant<int, 3>{});
    default:
      throw std::logic_error("a formula of other than 1 to 3 dimensions");
  }
}

}  // namespace kds
