#pragma once
// A polynomial whose coefficients are known exactly, in double: each coefficient rounded by itself, so that a
// function that is zero but for what its beads' coordinates were rounded by has as many true digits as any
// other. Its descents are found without the long numbers of its exact roots. Bounded work; what it cannot
// prove it says so.
//
// Every coefficient c comes with a size m >= |c|, and errs by at most E m: E = 4u at first (u = 2^-53;
// truncated, and divided by a binomial). A mean v a + t b of two of them, v = 1-t, errs by E (v m_a + t m_b),
// and by at most 4u times that for v, two products and their sum; its size is the same mean of sizes, rounded
// alike, which keeps m >= |c|. Halving multiplies by 1/2, exactly, and rounds but the sum. So E grows by 4u a
// round of de Casteljau, by u where it halves. Sizes are at least 2^-800 of the largest coefficient: nothing
// underflows that counts. Where a polynomial's values are small near one end, so are the sizes there.

#include <cstdint>
#include <optional>

#include "certificates/exact/exact_polynomial.h"
#include "motions/numbers/coefficients.h"

namespace kds {

class RoundedPolynomial {
 public:
  /// Not of a wide one, whose coefficients are apart by more than doubles are. Roots at 0 and at 1 are
  /// divided out: signs are those in (0,1), and 0 is where they are just after it.
  explicit RoundedPolynomial(const ExactPolynomial& exact);

  /// 1 or -1 if that is the sign all over [lower, upper], for certain, else 0.
  [[nodiscard]] int sign_on(double lower, double upper) const;

  /// A root at which it turns negative: the only one in [lower, upper], where it is certainly positive at
  /// lower and negative at upper. `last`: there is no other after it, and none at 1.
  struct Descent {
    double lower, upper;
    bool last;
  };
  enum class Verdict : std::uint8_t { never, found, undecided };
  struct Result {
    Verdict verdict;
    Descent descent;
  };
  /// The first one after `from`, where it is known to be positive, or just after it.
  [[nodiscard]] Result first_descent(double from) const;

 private:
  /// The polynomial as seen on [lower, lower + 2^-halvings].
  struct Part {
    Coefficients<double> c, m;
    double lower = 0;
    int halvings = 0;

    [[nodiscard]] double width() const;
    [[nodiscard]] double upper() const { return lower + width(); }
    [[nodiscard]] double error() const;
    [[nodiscard]] Part halve();  ///< becomes its left half; the right one
  };
  struct Value {
    double value, slope, error;
  };
  enum class Shape : std::uint8_t { positive, descent, ascent, unclear };

  [[nodiscard]] static Shape shape_of(const Part& part);
  /// At s of [0,1] in the part.
  [[nodiscard]] static Value value_at(const Part& part, double s);
  [[nodiscard]] std::optional<Descent> narrowed(const Part& part, double from) const;

  Part whole_;
  bool zero_at_start_ = false, zero_at_end_ = false;
};

}  // namespace kds
