#pragma once
// The recorded formula of a type of functions (motions/numbers/recorded_formula.h), and the bounds that
// follow from it for motions of a degree. These are derived on first use and cached.

#include <map>
#include <memory>
#include <mutex>

#include "certificates/filters/error_bound.h"
#include "motions/numbers/recorded_formula.h"
#include "motions/views/channels.h"

namespace kds {

/// All coefficients are below 2^(bits + power * length_bits) in size if differences and sums of two lengths
/// are below 2^length_bits, and those of their squares below 2^(2 length_bits).
struct CoefficientBits {
  int bits = 0;
  int power = 0;
};

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

}  // namespace kds
