#pragma once
// Polynomials in scaled Bernstein form: values, restrictions to parts of the step, sign changes, and
// Bernstein subdivision, which halves a part by de Casteljau's algorithm on integers, using only additions.
// Functions in `detail` take any number type: whole numbers, or balls (ball_number.h),
// whose sign may be unknown. Used only by the files of the exact stage.

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "certificates/exact/exact_work.h"
#include "motions/numbers/exact_number.h"

namespace kds {

/// Bounds on the number of sign changes of a polynomial's coefficients, as far as their signs are certain.
struct Variations {
  int least = 0, most = 0;
  int sign = 0;  ///< if there is no change: the sign of the coefficients that are not 0; known if most is 0
};

/// The plain Bernstein coefficients of a polynomial given in scaled form, times `multiple`, a common
/// multiple of the binomials. Additions alone halve them.
struct Unscaled {
  std::vector<Integer> coefficients;
  Integer multiple;
};
[[nodiscard]] Unscaled unscaled(const std::vector<Integer>& scaled);

/// Computes both halves, times 2^degree. `local` becomes the right half.
void halve(std::vector<Integer>& local, std::vector<Integer>& left);

/// A polynomial restricted to a part of the step: integers with a common error bound.
class Halves {
 public:
  /// Takes scaled coefficients with an error of at most `error` each.
  Halves(const std::vector<Integer>& scaled, const Integer& error);

  /// Counts the sign changes, given the signs at both ends (0 stands for a root).
  [[nodiscard]] Variations variations(int sign_at_lower, int sign_at_upper) const;
  /// Returns the sign at an end if it is certain.
  [[nodiscard]] std::optional<int> sign_at_lower() const { return sign_of(c_.front()); }
  [[nodiscard]] std::optional<int> sign_at_upper() const { return sign_of(c_.back()); }
  /// Divides the part into 2^digits equal cells and returns the cells that would hold a cluster of
  /// `multiplicity` roots, with one more cell on each side. The cluster is located from the values and slopes
  /// at both ends, by Newton's step for a root of that multiplicity. Returns nothing if the two ends
  /// disagree. The result is a guess, not a proof.
  struct Cells {
    Integer first, last;
  };
  [[nodiscard]] std::optional<Cells> cells_of_cluster(int multiplicity, unsigned digits) const;
  /// Becomes the right half and returns the left half.
  [[nodiscard]] Halves halve();
  /// Returns how many times the part has been halved.
  [[nodiscard]] int depth() const { return depth_; }

 private:
  Halves() = default;

  [[nodiscard]] std::optional<int> sign_of(const Integer& x) const;

  std::vector<Integer> c_;
  Integer error_;
  int depth_ = 0;
};

namespace detail {

// Counts the fewest and the most sign changes of a sequence whose signs are given one after the other.
class VariationCount {
 public:
  void add(int sign) {
    add({sign<0, sign == 0, sign> 0});
    if (sign != 0 && first_ == 0) first_ = sign;
  }
  void add_unknown() { add({true, true, true}); }

  [[nodiscard]] Variations value() const {
    Variations all{far, -1, first_};
    for (const Range& range : ranges_) {
      all.least = std::min(all.least, range.least);
      all.most = std::max(all.most, range.most);
    }
    return all;
  }

 private:
  static constexpr int far = std::numeric_limits<int>::max();
  // Bounds over all sequences that end on a negative number, are all 0, or end on a positive number.
  struct Range {
    int least = far, most = -1;
    void include(const Range& other, int more) {
      if (other.most < 0) return;
      least = std::min(least, other.least + more);
      most = std::max(most, other.most + more);
    }
  };
  using Ranges = std::array<Range, 3>;

  /// Appends a number that may be negative, 0 or positive, as `may_be` says.
  void add(const std::array<bool, 3>& may_be) {
    Ranges next;
    for (std::size_t before = 0; before < 3; ++before) {
      for (std::size_t now = 0; now < 3; ++now) {
        if (!may_be[now]) continue;
        next[now == 1 ? before : now].include(ranges_[before], before + now == 2 && now != 1 ? 1 : 0);
      }
    }
    ranges_ = next;
  }

  Ranges ranges_{Range{}, Range{0, 0}, Range{}};
  int first_ = 0;
};

/// Counts the sign changes of `c`. The caller may supply the signs of the first and the last coefficient.
template <class Number>
[[nodiscard]] Variations variations_of(const std::vector<Number>& c, std::optional<int> first,
                                       std::optional<int> last) {
  VariationCount count;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const std::optional<int> known = k == 0 ? first : k + 1 == c.size() ? last : std::nullopt;
    const int sign = known.value_or(c[k].certain_sign());
    if (sign == 0 && !known && !c[k].is_zero()) {
      count.add_unknown();
    } else {
      count.add(sign);
    }
  }
  return count.value();
}

/// Returns the number of sign changes among the non-zero coefficients.
[[nodiscard]] inline int sign_variations_of(const std::vector<Integer>& c) {
  int variations = 0, last = 0;
  for (const Integer& x : c) {
    const int sign = sgn(x);
    if (sign == 0) continue;
    if (last != 0 && sign != last) ++variations;
    last = sign;
  }
  return variations;
}

inline void add_product(Integer& sum, const Integer& a, const Integer& b) {
  mpz_addmul(sum.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
}

/// Returns the approximate length in 64-bit limbs.
[[nodiscard]] inline std::size_t limbs_of(const Integer& x) { return mpz_size(x.get_mpz_t()) + 1; }

/// The ends of an interval and their distances from 1, over a common denominator 2^exponent.
struct Ends {
  unsigned exponent;
  Integer lower, upper, above_lower, above_upper;

  Ends(const Dyadic& from, const Dyadic& to) : exponent(std::max(from.exponent(), to.exponent())) {
    const Integer one = Integer(1) << exponent;
    lower = from.numerator() << (exponent - from.exponent());
    upper = to.numerator() << (exponent - to.exponent());
    above_lower = one - lower;
    above_upper = one - upper;
  }
};

/// Returns the polynomial restricted to an interval, times a positive number. Substitutes u = lower (1-s) +
/// upper s and 1-u = above_lower (1-s) + above_upper s.
template <class Number>
std::vector<Number> seen_on(const std::vector<Number>& c, const Number& one, const Number& lower,
                            const Number& upper, const Number& above_lower, const Number& above_upper) {
  // Horner's scheme in u with the growing power of (1-u); both are linear forms in (1-s, s).
  ExactWork::spend(c.size() * c.size() * (limbs_of(c.back()) + limbs_of(above_lower)));
  std::vector<Number> value(c.size());
  std::vector<Number> power(c.size());
  value[0] = c.back();
  power[0] = one;
  for (std::size_t size = 2; size <= c.size(); ++size) {
    const Number& next = c[c.size() - size];
    for (std::size_t i = size; i-- > 0;) {
      power[i] *= above_lower;
      value[i] *= lower;
      if (i > 0) {
        add_product(power[i], above_upper, power[i - 1]);
        add_product(value[i], upper, value[i - 1]);
      }
      add_product(value[i], next, power[i]);
    }
  }
  return value;
}

/// Returns the value at u = later / (later + earlier), times a power of (later + earlier).
template <class Number>
[[nodiscard]] Number value_of(const std::vector<Number>& c, const Number& one, const Number& later,
                              const Number& earlier) {
  ExactWork::spend(c.size() * (limbs_of(c.back()) + limbs_of(earlier)));
  Number value = c.back();
  Number power = one;
  for (std::size_t k = c.size() - 1; k-- > 0;) {
    power *= earlier;
    value *= later;
    add_product(value, c[k], power);
  }
  return value;
}

}  // namespace detail

}  // namespace kds
