#pragma once
// Polynomials whose coefficients are thousands of bits long because the input numbers differ wildly in size
// (function_values.h gives the width at which this class takes over). An answer seldom needs all bits. Ball
// arithmetic (ball_number.h) is tried first for signs, with 128 bits and then with twice as many at each
// attempt. Common factors are first sought modulo a prime. The whole integers are formed only if these
// methods do not decide. Every answer is exact, or says that it is undecided.
//
// Results are cached. An object must therefore be used by one thread only.

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "certificates/exact/ball_number.h"
#include "certificates/exact/exact_polynomial.h"
#include "certificates/exact/halves.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/modular.h"

namespace kds {

/// Computes a polynomial's coefficients to the requested precision.
class CoefficientSource {
 public:
  virtual ~CoefficientSource() = default;
  /// Returns the coefficients in numbers of `bits` bits, one of `precisions`.
  [[nodiscard]] virtual std::vector<BallNumber> balls(std::size_t bits) const = 0;
  static constexpr std::array<std::size_t, 3> precisions{BallNumber::first_bits, 512, 1024};
  /// Returns the coefficients modulo 2^61 - fold.
  [[nodiscard]] virtual std::vector<Residue> residues(std::uint64_t fold) const = 0;
  [[nodiscard]] virtual std::vector<Integer> whole() const = 0;
};

class WidePolynomial {
 public:
  explicit WidePolynomial(std::vector<Integer> scaled) : whole_(std::move(scaled)) {}
  explicit WidePolynomial(std::unique_ptr<const CoefficientSource> source) : source_(std::move(source)) {}
  /// Constructs the negative of `opposite`, which must not itself be a negation. The two polynomials share
  /// all results about roots.
  explicit WidePolynomial(std::shared_ptr<const WidePolynomial> opposite) : opposite_(std::move(opposite)) {}

  /// Returns null unless this polynomial was constructed as the negative of another.
  [[nodiscard]] const std::shared_ptr<const WidePolynomial>& opposite() const { return opposite_; }

  [[nodiscard]] const std::vector<Integer>& whole() const;
  /// Returns the coefficients with this precision. Half of the bits are correct, except in coefficients that
  /// others outweigh. The reference is valid until the next call.
  [[nodiscard]] const std::vector<BallNumber>& balls(std::size_t bits = BallNumber::first_bits) const;
  /// Returns the coefficients modulo the first of the primes.
  [[nodiscard]] const std::vector<Residue>& residues() const;
  /// Returns the formal degree plus 1.
  [[nodiscard]] std::size_t size() const { return balls().size(); }
  /// Returns the bit length of the longest coefficient, computed from balls; it may be one too
  /// large.
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] bool is_zero() const;
  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// Returns the sign on [lower, upper] if balls of 128 bits decide it, else 0.
  [[nodiscard]] int sign_on(const Dyadic& lower, const Dyadic& upper) const;
  [[nodiscard]] int sign_variations() const;
  /// Counts sign changes of the polynomial restricted to [lower, upper], by balls of 128 bits. The caller may
  /// supply the signs at both ends.
  [[nodiscard]] Variations variations_on(const Dyadic& lower, const Dyadic& upper,
                                         std::optional<int> sign_at_lower = {},
                                         std::optional<int> sign_at_upper = {}) const;

  /// Returns the sign of the first coefficient that is not 0.
  [[nodiscard]] int first_sign() const;

  /// A part of [0,1] in which roots have not been isolated yet (wide_roots.h).
  struct Part {
    Dyadic lower, upper;
    int sign_at_lower = 0, sign_at_upper = 0;
    bool with_lower = false;  ///< a root at the lower end belongs to this part
    int changes = 0;          ///< the number of sign changes, if known
    unsigned digits = 0;      ///< by how many digits it was narrowed without losing a sign change
    /// The precision at which this part, or the part around it, was last examined.
    std::size_t bits = BallNumber::first_bits;
  };
  /// Results found so far.
  struct Found {
    /// All roots in [0,1], isolated and narrowed, and the parts that may contain more roots, ascending. Empty
    /// at first.
    std::list<std::variant<RootInterval, Part>> roots;
    std::vector<RootInterval> some_roots;  ///< narrowed roots in parts not yet isolated
    /// The square-free part, or null if the polynomial itself is square-free.
    std::optional<std::shared_ptr<const WidePolynomial>> square_free;
    /// Common factors with other polynomials. Only the last few non-trivial ones are kept.
    struct Common {
      std::weak_ptr<const WidePolynomial> other;
      std::shared_ptr<const WidePolynomial> factor;
    };
    std::vector<Common> common;
  };
  [[nodiscard]] Found& found() const { return opposite_ ? opposite_->found_ : found_; }

 private:
  /// Returns coefficients with `bits` correct leading bits where they matter, or null if that needs the whole
  /// integers.
  [[nodiscard]] const std::vector<BallNumber>* formed_to(std::size_t bits) const;

  std::unique_ptr<const CoefficientSource> source_;
  std::shared_ptr<const WidePolynomial> opposite_;
  mutable std::optional<std::vector<Integer>> whole_;
  mutable std::vector<BallNumber> formed_;  // formed with `formed_bits_` bits
  mutable std::size_t formed_bits_ = 0;
  mutable std::map<std::size_t, std::vector<BallNumber>> balls_;  // coefficients, by their number of bits
  mutable std::optional<std::vector<Residue>> residues_;
  mutable Found found_;
};

// Values, and sign changes on parts of the step, by balls of increasing precision, finally with all bits.
// Exact.

/// Returns the value at u, exact or with at least `digits` correct leading binary digits.
[[nodiscard]] BallNumber value_at(const WidePolynomial& polynomial, const Dyadic& u, std::size_t digits);

/// Returns the sign on [lower, upper] if about as many digits as the interval has decide it, else 0.
[[nodiscard]] int sign_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper);

/// Returns the polynomial restricted to [lower, upper], with numbers of `bits` bits. The ends must
/// have the same scale.
[[nodiscard]] Halves seen_closely(const WidePolynomial& polynomial, const Dyadic& lower, const Dyadic& upper,
                                  std::size_t bits);

/// Counts the sign changes of the polynomial restricted to [lower, upper]. In the result least == most, or
/// both are at least 2, since callers need no more.
[[nodiscard]] Variations exact_variations(const WidePolynomial& polynomial, const Dyadic& lower,
                                          const Dyadic& upper);

/// Like exact_variations, for cases that 128 bits do not decide. Starts with numbers of `bits` bits, and sets
/// `bits` to the number that decided.
[[nodiscard]] Variations variations_closely(const WidePolynomial& polynomial, const Dyadic& lower,
                                            const Dyadic& upper, std::size_t& bits);

}  // namespace kds
