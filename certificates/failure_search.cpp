#include "certificates/failure_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kds {

namespace {

// Where the time roughly is: bisection in double on the polynomial's coefficients over its interval.
double rough(const ExactTime& time) {
  const ExactPolynomial local = time.polynomial().restricted(time.lower(), time.upper());
  const auto shift = static_cast<long>(local.largest_bit_length());
  std::vector<double> c;
  for (const Integer& x : local.scaled()) {
    long exponent = 0;
    const double fraction = mpz_get_d_2exp(&exponent, x.backend().data());
    c.push_back(std::ldexp(fraction, static_cast<int>(std::max(exponent - shift, -1100L))));
  }
  const auto value = [&c](double s) {
    double sum = c.back();
    double power = 1;
    for (std::size_t k = c.size() - 1; k-- > 0;) {
      power *= 1 - s;
      sum = sum * s + c[k] * power;
    }
    return sum;
  };
  const bool rising = c.front() < 0;
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((value(middle) < 0) == rising ? low : high) = middle;
  }
  const double lower = time.lower().round_down();
  return lower + (time.upper().round_up() - lower) * low;
}

// To about 2^-44, which keeps nearly all failure times of a step apart: at a guess, or by bisection.
void narrow(ExactTime& time) {
  constexpr double width = 0x1p-44;
  if (time.is_dyadic()) return;
  const double guess = rough(time);
  for (const double reach : {0x1p-46, 0x1p-42}) {
    if (time.narrow_to(Dyadic(guess - reach), Dyadic(guess + reach))) return;
  }
  while (!time.is_dyadic() && time.upper().round_up() - time.lower().round_down() > width) time.refine();
}

}  // namespace

Failure to_failure(const ExactPolynomial& function, ExactFailure& failure) {
  ExactTime& root = failure.time;
  const bool touch = failure.touch;
  const Dyadic before = root.lower();
  const Dyadic after = root.upper();
  narrow(root);
  const double lower = root.lower().round_down();
  const double upper = root.upper().round_up();
  if (lower == upper) return {Failure::Kind::later, {lower, upper, 0, false, touch}};

  const Dyadic from(lower);
  const Dyadic to(upper);
  const auto proved = [&] { return function.sign_at(from) * function.sign_at(to) < 0; };
  if (before <= from && to <= after && proved()) return {Failure::Kind::later, {lower, upper, 0, true}};

  // Doubles are too coarse to isolate it: which of the roots in the widened bracket is it?
  const ExactPolynomial simple = function.square_free();
  auto roots = isolate_roots(simple, from, to);
  const bool isolating = roots.size() == 1 && proved();
  std::uint16_t ordinal = 0;
  for (RootInterval& interval : roots) {
    ExactTime candidate(simple, std::move(interval));
    if (ExactTime::compare(candidate, root) == 0) break;
    ++ordinal;
  }
  return {Failure::Kind::later, {lower, upper, ordinal, isolating, touch}};
}

Failure exact_first_failure(const ExactPolynomial& function, const Instant& now, StageCounts& stages,
                            Touches touches) {
  if (function.is_zero()) {
    ++stages.identically_zero;
    return {Failure::Kind::zero, {}};
  }
  ++stages.exact;
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, function.largest_bit_length());
  ExactTime& time = now.exact();
  if (sign_after(function, time) < 0) return {Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}};
  std::optional<ExactFailure> root = first_failure_after(function, time, touches);
  if (!root) return {};
  return to_failure(function, *root);
}

}  // namespace kds
