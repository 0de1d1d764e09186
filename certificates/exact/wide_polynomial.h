#pragma once
// Polynomials whose coefficients are thousands of bits long because the input numbers differ wildly in size
// (function_values.h gives the width at which this class takes over). An answer seldom needs all bits.
// Signs are first sought with ball arithmetic on the leading digits (motions/numbers/leading_digits.h), and
// common factors modulo a prime. The whole integers are formed only if these do not decide. Every answer is
// exact, or says that it is undecided.
//
// Results are cached. An object must therefore be used by one thread only.

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

#include "certificates/exact/exact_polynomial.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/fixed_digits.h"
#include "motions/numbers/leading_digits.h"
#include "motions/numbers/modular.h"

namespace kds {

/// Computes a polynomial's coefficients to the requested precision.
class CoefficientSource {
 public:
  virtual ~CoefficientSource() = default;
  [[nodiscard]] virtual std::vector<LeadingDigits> leading_digits() const = 0;
  /// Returns the coefficients in numbers of `words` words, one of `word_counts`.
  [[nodiscard]] virtual std::vector<LongDigits> digits(std::size_t words) const = 0;
  static constexpr std::array<std::size_t, 2> word_counts{8, 16};
  /// Returns the coefficients modulo 2^61 - fold.
  [[nodiscard]] virtual std::vector<Residue> residues(std::uint64_t fold) const = 0;
  [[nodiscard]] virtual std::vector<Integer> whole() const = 0;
};

/// Bounds on the number of sign changes of a polynomial's coefficients, as far as their leading digits
/// decide.
struct Variations {
  int least = 0, most = 0;
  int sign = 0;  ///< of the coefficients that are not 0 if there is no change; known if most is 0
};

class WidePolynomial {
 public:
  explicit WidePolynomial(std::vector<Integer> scaled) : whole_(std::move(scaled)) {}
  explicit WidePolynomial(std::unique_ptr<const CoefficientSource> source) : source_(std::move(source)) {}
  /// Constructs the negative of `opposite`, which must not itself be a negation. Both share what is found out
  /// about roots.
  explicit WidePolynomial(std::shared_ptr<const WidePolynomial> opposite) : opposite_(std::move(opposite)) {}

  /// Returns null unless this polynomial was constructed as the negative of another.
  [[nodiscard]] const std::shared_ptr<const WidePolynomial>& opposite() const { return opposite_; }

  [[nodiscard]] const std::vector<Integer>& whole() const;
  [[nodiscard]] const std::vector<LeadingDigits>& leading_digits() const;
  /// Returns the coefficients as balls of 4, 8, 16 or 32 words. Half of the words are correct, except in
  /// coefficients that others outweigh.
  template <int Words>
  [[nodiscard]] const std::vector<FixedDigits<Words>>& in_words() const;
  /// Returns the coefficients modulo the first of the primes.
  [[nodiscard]] const std::vector<Residue>& residues() const;
  /// Returns the formal degree plus 1.
  [[nodiscard]] std::size_t size() const { return leading_digits().size(); }
  /// Returns the bit length of the longest coefficient, computed from leading digits; it may be one too
  /// large.
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] bool is_zero() const;
  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// Returns the sign on [lower, upper] if the leading digits decide it, else 0.
  [[nodiscard]] int sign_on(const Dyadic& lower, const Dyadic& upper) const;
  [[nodiscard]] int sign_variations() const;
  /// Counts sign changes of the polynomial restricted to [lower, upper], using leading digits. The caller may
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
    std::size_t bits =
        LeadingDigits::most_bits;  ///< the precision at which it, or the part around it, was last examined
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
  [[nodiscard]] const std::vector<LongDigits>* formed_to(std::size_t bits) const;

  template <int Words>
  using InWords = std::optional<std::vector<FixedDigits<Words>>>;

  std::unique_ptr<const CoefficientSource> source_;
  std::shared_ptr<const WidePolynomial> opposite_;
  mutable std::optional<std::vector<Integer>> whole_;
  mutable std::optional<std::vector<LeadingDigits>> leading_;
  mutable std::vector<LongDigits> formed_;  // formed with `formed_words_` words
  mutable std::size_t formed_words_ = 0;
  mutable std::tuple<InWords<4>, InWords<8>, InWords<16>, InWords<32>> in_words_;
  mutable std::optional<std::vector<Residue>> residues_;
  mutable Found found_;
};

}  // namespace kds
