#pragma once
// Polynomials whose coefficients are thousands of bits long because the numbers they are made from are of
// wildly different size (formula_in_integers.h says from which width on). An answer seldom needs all those
// bits: it is looked for in the coefficients' leading digits first (motions/numbers/leading_digits.h),
// whether there are common factors modulo a prime, and only where these do not tell are the whole numbers
// formed. Every answer is exact, or says that it is none.
//
// What has been found out is kept: for one thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

#include "certificates/exact/root_interval.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/fixed_digits.h"
#include "motions/numbers/leading_digits.h"
#include "motions/numbers/modular.h"

namespace kds {

/// Says what a polynomial's coefficients are, as precisely as it is asked.
class CoefficientSource {
 public:
  virtual ~CoefficientSource() = default;
  [[nodiscard]] virtual std::vector<LeadingDigits> leading_digits() const = 0;
  /// By numbers of so many words, one of `word_counts`.
  [[nodiscard]] virtual std::vector<LongDigits> digits(std::size_t words) const = 0;
  static constexpr std::array<std::size_t, 2> word_counts{8, 16};
  /// Modulo 2^61 - fold.
  [[nodiscard]] virtual std::vector<Residue> residues(std::uint64_t fold) const = 0;
  [[nodiscard]] virtual std::vector<Integer> whole() const = 0;
};

/// How often a polynomial's coefficients change sign, as far as their leading digits tell.
struct Variations {
  int least = 0, most = 0;
  int sign = 0;  ///< of all that are not 0, where none change: known if most is 0
};

class WidePolynomial {
 public:
  explicit WidePolynomial(std::vector<Integer> scaled) : whole_(std::move(scaled)) {}
  explicit WidePolynomial(std::unique_ptr<const CoefficientSource> source) : source_(std::move(source)) {}
  /// The negative of another, which is nobody's negative. What is found out about the roots is both's.
  explicit WidePolynomial(std::shared_ptr<const WidePolynomial> opposite) : opposite_(std::move(opposite)) {}

  /// Null where it was not made as the negative of another.
  [[nodiscard]] const std::shared_ptr<const WidePolynomial>& opposite() const { return opposite_; }

  [[nodiscard]] const std::vector<Integer>& whole() const;
  [[nodiscard]] const std::vector<LeadingDigits>& leading_digits() const;
  /// By numbers of 4, 8, 16 or 32 words, of which half are right, but for coefficients that others
  /// outweigh.
  template <int Words>
  [[nodiscard]] const std::vector<FixedDigits<Words>>& in_words() const;
  /// Modulo the first of the primes.
  [[nodiscard]] const std::vector<Residue>& residues() const;
  /// The degree that it is written with, plus 1.
  [[nodiscard]] std::size_t size() const { return leading_digits().size(); }
  /// Of the longest coefficient: by its leading digits, one more than it is at the most.
  [[nodiscard]] std::size_t largest_bit_length() const;

  [[nodiscard]] bool is_zero() const;
  [[nodiscard]] int sign_at(const Dyadic& u) const;
  /// The sign all over [lower, upper] if its leading digits tell, else 0.
  [[nodiscard]] int sign_on(const Dyadic& lower, const Dyadic& upper) const;
  [[nodiscard]] int sign_variations() const;
  /// Of the polynomial as seen on [lower, upper], whose signs at both ends may be given, by leading digits.
  [[nodiscard]] Variations variations_on(const Dyadic& lower, const Dyadic& upper,
                                         std::optional<int> sign_at_lower = {},
                                         std::optional<int> sign_at_upper = {}) const;

  /// The sign of the first coefficient that is not 0.
  [[nodiscard]] int first_sign() const;

  /// A part of [0,1] in which roots have not been looked for (wide_roots.h).
  struct Part {
    Dyadic lower, upper;
    int sign_at_lower = 0, sign_at_upper = 0;
    bool with_lower = false;  ///< a root at its lower end is one of its own
    int changes = 0;          ///< of sign there, where they are known
    unsigned digits = 0;      ///< by which it has been narrowed without losing one
    std::size_t bits =
        LeadingDigits::most_bits;  ///< with which it, or the part that it is of, was looked at closely
  };
  /// What others have found out about it.
  struct Found {
    /// All that there are in [0,1], isolated and narrowed, and where others may be; ascending. None at first.
    std::list<std::variant<RootInterval, Part>> roots;
    std::vector<RootInterval> some_roots;  ///< that were narrowed where others have not been looked for
    /// Its part without multiple roots; null where it is that itself.
    std::optional<std::shared_ptr<const WidePolynomial>> square_free;
    /// What it has in common with others: the last few of those that it has something in common with.
    struct Common {
      std::weak_ptr<const WidePolynomial> other;
      std::shared_ptr<const WidePolynomial> factor;
    };
    std::vector<Common> common;
  };
  [[nodiscard]] Found& found() const { return opposite_ ? opposite_->found_ : found_; }

 private:
  /// Of which so many leading bits are right, where they matter, or null where that takes the whole ones.
  [[nodiscard]] const std::vector<LongDigits>* formed_to(std::size_t bits) const;

  template <int Words>
  using InWords = std::optional<std::vector<FixedDigits<Words>>>;

  std::unique_ptr<const CoefficientSource> source_;
  std::shared_ptr<const WidePolynomial> opposite_;
  mutable std::optional<std::vector<Integer>> whole_;
  mutable std::optional<std::vector<LeadingDigits>> leading_;
  mutable std::vector<LongDigits> formed_;  // by so many words
  mutable std::size_t formed_words_ = 0;
  mutable std::tuple<InWords<4>, InWords<8>, InWords<16>, InWords<32>> in_words_;
  mutable std::optional<std::vector<Residue>> residues_;
  mutable Found found_;
};

}  // namespace kds
