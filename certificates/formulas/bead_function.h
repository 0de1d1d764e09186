#pragma once
// A function of a few beads together with its recorded formula: the argument of everything that plays
// formulas.

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "certificates/base/certificate.h"
#include "certificates/filters/bounded_polynomial.h"
#include "motions/numbers/recorded_formula.h"
#include "motions/views/motion_view.h"

namespace kds {

/// All coefficients are below 2^(bits + power * length_bits) in size if differences and sums of two lengths
/// are below 2^length_bits, and those of their squares below 2^(2 length_bits).
struct CoefficientBits {
  int bits = 0;
  int power = 0;
};

/// The recorded formula of a type of functions (motions/numbers/recorded_formula.h), and the bounds that
/// follow from it for motions of a degree. The bounds are derived on first use and cached.
class KnownFormula {
 public:
  /// `dimension`: 1 to 3. `lifted`: over lifted motion (motions/curves/lifted_motion.h).
  KnownFormula(RecordedFormula formula, Channels channels, int dimension, bool lifted);

  [[nodiscard]] const RecordedFormula& formula() const { return formula_; }
  [[nodiscard]] Channels channels() const { return channels_; }

  /// Returns the error bound of the formula in double under a motion of this degree. Throws std::logic_error
  /// if the formula adds unlike powers of length.
  [[nodiscard]] const ErrorBound& error_bound(int degree) const { return of(degree).error; }
  [[nodiscard]] const CoefficientBits& coefficient_bits(int degree) const { return of(degree).bits; }

 private:
  struct Derived {
    ErrorBound error;
    CoefficientBits bits;
  };
  [[nodiscard]] const Derived& of(int degree) const;
  [[nodiscard]] Derived derive(int degree) const;

  RecordedFormula formula_;
  Channels channels_;
  int dimension_;
  bool lifted_;
  mutable std::mutex mutex_;
  mutable std::map<int, std::unique_ptr<Derived>> derived_;
};

struct BeadFunction {
  const KnownFormula& known;       ///< its bounds hold for all functions of the type
  const RecordedFormula& formula;  ///< the type's formula, or one with numbers of this function's own
  std::span<const BeadId> beads;
  bool negative = false;  ///< whether the negative of the formula is meant
};

namespace detail {

/// Records the formula of a function. `arguments`: beads numbered 0, 1, 2 ... `C`: Curves or LiftedCurves.
template <class F, class C>
[[nodiscard]] RecordedFormula recorded(const decltype(F{}.beads) & arguments) {
  RecordedFormula formula;
  const RecordingView<C::dimension, lifted<C>, channels_of<F>> view(formula);
  formula.finish(F::formula(view, arguments).step);
  return formula;
}

template <class F>
[[nodiscard]] auto arguments_of(const F& function) {
  auto arguments = function.beads;
  std::iota(arguments.begin(), arguments.end(), BeadId{0});
  return arguments;
}

template <class F, class C>
[[nodiscard]] const KnownFormula& known_formula() {
  static const KnownFormula known(recorded<F, C>(arguments_of(F{})), channels_of<F>, C::dimension, lifted<C>);
  return known;
}

/// Records the formula of a function whose beads come with numbers that enter the formula and the
/// comparison of beads (DirectedBeads). The last formula is cached, because these numbers are usually the
/// same for all functions of a run.
template <class F, class C>
[[nodiscard]] const RecordedFormula& own_formula(const F& function) {
  using Arguments = decltype(arguments_of(function));
  thread_local std::optional<std::pair<Arguments, RecordedFormula>> last;
  const Arguments arguments = arguments_of(function);
  if (!last || last->first != arguments) last.emplace(arguments, recorded<F, C>(arguments));
  return last->second;
}

template <class F>
[[nodiscard]] bool is_negative(const F& function) {
  if constexpr (requires { function.side(); }) {
    return !function.side();
  } else {
    return false;
  }
}

}  // namespace detail

/// Calls `ask` with the function and its formula, and returns the result.
template <class C, class F, class Ask>
decltype(auto) with_bead_function(const F& function, Ask ask) {
  const KnownFormula& known = detail::known_formula<F, C>();
  const std::span<const BeadId> beads(function.beads);
  if constexpr (std::is_same_v<decltype(F{}.beads), std::array<BeadId, bead_arity<F>>>) {
    return ask(BeadFunction{known, known.formula(), beads, detail::is_negative(function)});
  } else {
    return ask(
        BeadFunction{known, detail::own_formula<F, C>(function), beads, detail::is_negative(function)});
  }
}

}  // namespace kds
