#pragma once
// An exact polynomial rounded to double. The coefficients are known exactly, and each is rounded by itself.
// Some functions would vanish if coordinates were real numbers and differ from zero only because coordinates
// are rounded. Such a function keeps full relative precision here. This class finds the descents of such a
// function without integers of the length that exact roots have. The work is bounded; if a result cannot be
// proved, the class says so.
//
// The error analysis, with u = 2^-53:
//
// - Every coefficient c has a size m >= |c| and an error of at most E m. At first E = 4u (truncation and
//   division by a binomial).
// - A mean v a + t b of two coefficients, v = 1-t, inherits an error E (v m_a + t m_b). Its rounding (two
//   products and a sum) and that of v add at most 4u times that size. Its size is the same mean of sizes,
//   rounded in the same way, so m >= |c| still holds.
// - Halving multiplies by 1/2, which is exact, so only the sum is rounded.
// - E thus grows by 4u per round of de Casteljau, and by u per round if the part is halved.
// - Sizes are at least 2^-800 of the largest coefficient, so no underflow matters.
//
// Near an end where the polynomial's values are small, the sizes are small too, so the error bound is
// relative to them.

#include <cstdint>
#include <optional>

#include "certificates/exact/exact_polynomial.h"
#include "motions/numbers/bernstein.h"

namespace kds {

class RoundedPolynomial {
 public:
  /// Rounds `exact`, which must not be wide: wide coefficients differ by more than the range of doubles.
  /// Roots at 0 and 1 are divided out. Signs are therefore those in (0,1), and the sign at 0 is the sign just
  /// after it.
  explicit RoundedPolynomial(const ExactPolynomial& exact);

  /// Returns 1 or -1 if that is certainly the sign on all of [lower, upper], else 0.
  [[nodiscard]] int sign_on(double lower, double upper) const;

  /// A root at which the polynomial turns negative. This root is the only one in [lower, upper]; the
  /// polynomial is certainly positive at lower and negative at upper. `last`: there is no later root, and
  /// none at 1.
  struct Descent {
    double lower, upper;
    bool last;
  };
  enum class Verdict : std::uint8_t { never, found, undecided };
  struct Result {
    Verdict verdict;
    Descent descent;
  };
  /// Returns the first descent after `from`. The polynomial must be known to be positive at `from` or just
  /// after it.
  [[nodiscard]] Result first_descent(double from) const;

 private:
  /// The polynomial restricted to [lower, lower + 2^-halvings].
  struct Part {
    Coefficients<double> c, m;
    double lower = 0;
    int halvings = 0;

    [[nodiscard]] double width() const;
    [[nodiscard]] double upper() const { return lower + width(); }
    [[nodiscard]] double error() const;
    [[nodiscard]] Part halve();  ///< becomes the left half and returns the right half
  };
  struct Value {
    double value, slope, error;
  };
  enum class Shape : std::uint8_t { positive, descent, ascent, unclear };

  [[nodiscard]] static Shape shape_of(const Part& part);
  /// Evaluates at the position s in [0,1] of the part.
  [[nodiscard]] static Value value_at(const Part& part, double s);
  [[nodiscard]] std::optional<Descent> narrowed(const Part& part, double from) const;

  Part whole_;
  bool zero_at_start_ = false, zero_at_end_ = false;
};

}  // namespace kds
