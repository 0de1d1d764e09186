#pragma once
// Compares the search of a certificate type with constants with its rational reference, which uses Sturm
// sequences. The comparison covers a whole step, and at each failure the negated certificate.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "certificates/search/certificate_search.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/judged_failure.h"
#include "tests/support/judges/rational_curves.h"

namespace kds::test {

/// Returns typical values of constants, times 2^exponent: one number, or one for each control point.
inline std::vector<double> random_constant(Random& random, int degree, int exponent = 0) {
  const int kind = pick(random, 0, 5);
  const auto number = [&] {
    switch (kind) {
      case 0:
        return 0.0;
      case 1:
      case 2:
        return std::ldexp(pick(random, -3, 3), exponent);
      default:
        return std::ldexp(uniform(random, -2, 2), exponent);
    }
  };
  std::vector<double> numbers{number()};
  if (random() % 2)
    for (int k = 1; k <= degree; ++k) numbers.push_back(number());
  return numbers;
}

/// Counts over the searches from the start of the step.
struct DecidedInDouble {
  int decided = 0, in_double = 0;
};

/// `positive` is the reference for the certificate that is not negated; `opposite(certificate)` negates a
/// certificate.
template <class Certificate, class Opposite>
void expect_judged_all_along(const CertificateSearch<Certificate>& search, Certificate certificate,
                             const RationalCurve& positive, double start, Opposite opposite,
                             DecidedInDouble& count) {
  Functions functions;
  Instant now(start);
  JudgedTime judged_now = judged(start);
  KnownAtStart known = KnownAtStart::unknown;
  for (int event = 0; event < 20; ++event) {
    const ExactPolynomial function = exact_polynomial(positive, certificate.side() ? 1 : -1);
    const JudgedFailure expected = judged_failure(function, judged_now);
    sturm::Polynomial power = sturm::from_scaled(function.scaled());
    sturm::normalize(power);
    const int sign_after = sturm::sign_after(power, *judged_now.sequence, judged_now.root);
    Failure failure;
    for (const Kernel kernel : {Kernel::exact, Kernel::filtered}) {
      StageCounts stages;
      search.first_failures(kernel, {&certificate, 1}, now, {&known, 1}, stages, TouchPolicy::ignored,
                            {&failure, 1});
      expect_confirmed(std::string(name_of(kernel)), failure, function, expected);
      EXPECT_EQ(search.sign_just_after(kernel, certificate, now, stages), sign_after);
      if (kernel == Kernel::filtered && event == 0) {
        ++count.decided;
        count.in_double += stages.exact + stages.identically_zero == 0;
      }
    }
    for (const double time : {0.0, 0.125, 0.7, 1.0})
      EXPECT_EQ(search.sign_at(certificate, Dyadic(time)), function.sign_at(Dyadic(time)));
    // Stops if the certificate never fails or its function is zero.
    if (testing::Test::HasFailure() || failure.kind <= Failure::Kind::zero) return;
    if (failure.kind == Failure::Kind::later) {
      now = Instant(failure.time, functions, functions.add(function));
      judged_now = expected.time;
      known = event % 3 == 2 ? KnownAtStart::unknown : KnownAtStart::at_own_root;
    }
    certificate = opposite(certificate);
  }
  FAIL() << "more failures than the function has roots";
}

}  // namespace kds::test
