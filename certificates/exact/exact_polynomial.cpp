#include "certificates/exact/exact_polynomial.h"

#include <algorithm>
#include <cstddef>
#include <deque>

#include "certificates/exact/halves.h"
#include "certificates/exact/polynomial_gcd.h"
#include "certificates/exact/wide_roots.h"

namespace kds {

namespace {

using detail::Ends;
using detail::sign_variations_of;
using Integers = std::vector<Integer>;

void drop_leading_zeros(Integers& c) {
  while (!c.empty() && c.back() == 0) c.pop_back();
}

// Divides out all factors 1 + t, that is (1-u) + u = 1. A polynomial written with more than its true degree
// has such factors. Such factors would count as repeated roots and as common roots.
void drop_elevation(Integers& c) {
  while (c.size() > 1) {
    Integers quotient(c.size() - 1);
    Integer rest = 0;
    for (std::size_t k = c.size() - 1; k > 0; --k) {
      rest = c[k] - rest;
      quotient[k - 1] = rest;
    }
    if (c[0] != rest) return;
    c = std::move(quotient);
  }
}

Integers square_free_part(Integers c) {
  drop_leading_zeros(c);
  if (c.size() <= 2 || certainly_square_free(c)) return c;
  drop_elevation(c);
  return c.size() <= 2 || certainly_square_free(c) ? c : without_repeated_factors(c);
}

}  // namespace

const Integers& ExactPolynomial::wide_whole() const { return wide_->whole(); }

ExactPolynomial ExactPolynomial::alike(Integers scaled) const {
  return wide_ ? ExactPolynomial(std::make_shared<const WidePolynomial>(std::move(scaled)))
               : ExactPolynomial(std::move(scaled));
}

bool ExactPolynomial::is_zero() const {
  if (wide_) return wide_->is_zero();
  return std::all_of(scaled_.begin(), scaled_.end(), [](const Integer& x) { return x == 0; });
}

bool ExactPolynomial::is_constant() const {
  const Integers& c = scaled();
  return c.empty() || std::all_of(c.begin() + 1, c.end(), [](const Integer& x) { return x == 0; });
}

std::size_t ExactPolynomial::largest_bit_length() const {
  if (wide_) return wide_->largest_bit_length();
  std::size_t bits = 0;
  for (const Integer& x : scaled_) {
    if (x != 0) bits = std::max(bits, bit_length(x));
  }
  return bits;
}

int ExactPolynomial::sign_at(const Dyadic& u) const {
  if (wide_) return wide_->sign_at(u);
  if (scaled_.empty()) return 0;
  if (u.exponent() == 0 && u.numerator() == 0) return sgn(scaled_.front());
  return sgn(detail::value_of(scaled_, Integer(1), u.numerator(),
                              Integer((Integer(1) << u.exponent()) - u.numerator())));
}

int ExactPolynomial::sign_after(const Dyadic& u) const {
  if (const int sign = sign_at(u)) return sign;
  const ExactPolynomial from_u =
      restricted(u, Dyadic(u.numerator() + (Integer(1) << u.exponent()), u.exponent()));
  if (from_u.wide_) return from_u.wide_->first_sign();
  for (const Integer& x : from_u.scaled_) {
    if (x != 0) return sgn(x);
  }
  return 0;
}

int ExactPolynomial::sign_variations() const {
  return wide_ ? wide_->sign_variations() : sign_variations_of(scaled_);
}

int ExactPolynomial::sign_between(const Dyadic& lower, const Dyadic& upper, bool exactly) const {
  if (wide_) {
    if (const int sign = wide_->sign_on(lower, upper)) return sign;
    // An interval with only a few digits needs no more than the bits that sign_on() used.
    const bool closely = exactly || has_digits({lower, upper}, BallNumber::first_bits / 2);
    const int sign = closely ? sign_closely(*wide_, lower, upper) : 0;
    if (sign != 0 || !exactly) return sign;
    // There is a root between ends of opposite sign.
    const int at_upper = sign_at(upper);
    if (at_upper != 0 && at_upper == -sign_at(lower)) return 0;
    const Variations variations = exact_variations(*wide_, lower, upper);
    return variations.most == 0 ? variations.sign : 0;
  }
  const ExactPolynomial local = restricted(lower, upper);
  if (local.sign_variations() != 0) return 0;
  for (const Integer& x : local.scaled_) {
    if (x != 0) return sgn(x);
  }
  return 0;
}

bool ExactPolynomial::has_few_roots_between(const Dyadic& lower, const Dyadic& upper) const {
  return wide_ ? exact_variations(*wide_, lower, upper).most <= 1
               : restricted(lower, upper).sign_variations() <= 1;
}

ExactPolynomial ExactPolynomial::restricted(const Dyadic& lower, const Dyadic& upper) const {
  if (lower.numerator() == 0 && upper.exponent() == 0 && upper.numerator() == 1) return *this;
  if (scaled().empty()) return {};
  const Ends ends(lower, upper);
  return alike(
      detail::seen_on(scaled(), Integer(1), ends.lower, ends.upper, ends.above_lower, ends.above_upper));
}

ExactPolynomial ExactPolynomial::square_free() const {
  if (!wide_) return ExactPolynomial(square_free_part(scaled_));
  // A function and its negative share one square-free part, so equal addresses show that their roots are
  // the same.
  const std::shared_ptr<const WidePolynomial>& own = wide_->opposite() ? wide_->opposite() : wide_;
  auto& known = own->found().square_free;
  if (!known)
    known = certainly_square_free(own->residues())
                ? nullptr
                : std::make_shared<const WidePolynomial>(square_free_part(own->whole()));
  return ExactPolynomial(*known ? *known : own);
}

namespace {

using Shared = std::shared_ptr<const WidePolynomial>;

// Returns null if the gcd is not known.
Shared known_gcd(const Shared& a, const Shared& b) {
  for (const auto& [one, two] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (const auto& common : (*one)->found().common)
      if (common.other.lock() == *two) return common.factor;
  return nullptr;
}

void keep_gcd(const Shared& a, const Shared& b, Shared factor) {
  constexpr std::size_t few = 16;
  auto& known = a->found().common;
  if (known.size() == few) known.erase(known.begin());
  known.push_back({b, std::move(factor)});
}

}  // namespace

ExactPolynomial ExactPolynomial::gcd(const ExactPolynomial& a, const ExactPolynomial& b) {
  if (a.wide_ && a.wide_ == b.wide_) return a;
  const bool both_wide = a.wide_ && b.wide_;
  if (both_wide)
    if (const Shared known = known_gcd(a.wide_, b.wide_)) return ExactPolynomial(known);
  const auto coefficients = [](const ExactPolynomial& p) {
    Integers c = p.scaled();
    drop_leading_zeros(c);
    return c;
  };
  const auto residues = [](const ExactPolynomial& p) {
    return p.wide_ ? p.wide_->residues() : image_of(p.scaled_);
  };
  const ExactPolynomial none({Integer(1)});
  if (certainly_coprime(residues(a), residues(b))) return none;
  Integers of_a = coefficients(a), of_b = coefficients(b);
  drop_elevation(of_a);
  drop_elevation(of_b);
  const ExactPolynomial common = (a.wide_ ? a : b).alike(polynomial_gcd(of_a, of_b));
  if (both_wide) keep_gcd(a.wide_, b.wide_, common.wide_);
  return common;
}

namespace {

class Isolation {
 public:
  explicit Isolation(const RootVisitor& visit) : visit_(visit) {}

  // Visits the roots in the open interval (lower, upper), and at `lower` if `with_lower`. `local` is the
  // polynomial on [lower, upper], unscaled; it is destroyed. Returns false if the visitor wants no more
  // roots.
  bool visit(Integers& local, const Dyadic& lower, const Dyadic& upper, bool with_lower,
             std::size_t depth = 0) {
    const bool root_at_lower = local.front() == 0;
    const bool root_at_upper = local.back() == 0;
    if (root_at_lower && with_lower && !visit_({lower, lower})) return false;
    const int variations = sign_variations_of(local);
    if (variations == 0) return true;
    if (variations == 1 && !root_at_lower && !root_at_upper) return visit_({lower, upper});
    const Dyadic middle = Dyadic::midpoint(lower, upper);
    if (left_.size() == depth) left_.emplace_back(local.size());
    halve(local, left_[depth]);
    return visit(left_[depth], lower, middle, false, depth + 1) &&
           visit(local, middle, upper, true, depth + 1);
  }

 private:
  const RootVisitor& visit_;
  std::deque<Integers> left_;  // one buffer per level, reused
};

}  // namespace

void visit_roots(const ExactPolynomial& square_free, const Dyadic& lower, const Dyadic& upper,
                 const RootVisitor& visit) {
  if (square_free.is_zero()) return;
  if (lower == upper) {
    if (square_free.sign_at(lower) == 0) visit({lower, lower});
    return;
  }
  if (square_free.wide() != nullptr) return visit_wide_roots(*square_free.wide(), lower, upper, visit);
  Integers local = unscaled(square_free.restricted(lower, upper).scaled()).coefficients;
  const bool root_at_upper = local.back() == 0;
  if (Isolation(visit).visit(local, lower, upper, true) && root_at_upper) visit({upper, upper});
}

std::vector<RootInterval> isolate_roots(const ExactPolynomial& square_free, const Dyadic& lower,
                                        const Dyadic& upper) {
  std::vector<RootInterval> roots;
  visit_roots(square_free, lower, upper, [&roots](RootInterval root) {
    roots.push_back(std::move(root));
    return true;
  });
  return roots;
}

}  // namespace kds
