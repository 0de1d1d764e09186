#pragma once
// Computes the expected failure by Sturm sequences, and checks whether an answer agrees.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "certificates/exact/exact_polynomial.h"
#include "certificates/exact/exact_time.h"
#include "certificates/exact/instant.h"
#include "tests/support/inputs/polynomials.h"
#include "tests/support/judges/sturm.h"

namespace kds::test {

/// The present time in the judge's representation.
struct JudgedTime {
  std::shared_ptr<const sturm::Sequence> sequence;
  sturm::Root root;
};

inline JudgedTime judged(double u) {
  const Rational x = u;
  return {std::make_shared<sturm::Sequence>(sturm::with_root(x)), {x, x}};
}

inline Rational rational_of(double x) { return Dyadic(x).rational(); }

struct JudgedFailure {
  Failure::Kind kind = Failure::Kind::never;
  JudgedTime time{};
};

inline JudgedFailure judged_failure(const ExactPolynomial& function, const JudgedTime& now) {
  sturm::Polynomial f = sturm::from_scaled(function.scaled());
  sturm::normalize(f);
  if (f.empty()) return {Failure::Kind::zero, {}};
  if (sturm::sign_after(f, *now.sequence, now.root) < 0) return {Failure::Kind::at_birth, now};
  const auto sequence = std::make_shared<const sturm::Sequence>(f);
  for (const sturm::Root& root : sturm::roots_on(*sequence, 0, 1)) {
    if (root.is_number() && root.upper == 1) continue;
    if (sturm::compare(*sequence, root, *now.sequence, now.root) <= 0) continue;
    if (sturm::sign_after(f, *sequence, root) < 0) return {Failure::Kind::later, {sequence, root}};
  }
  return {};
}

/// How the function behaves at a failure time: it turns negative, as the certificate's own function does, or
/// it only changes sign.
enum class AtFailure { descends, changes };

/// Checks that the answer is the expected one, and that its claims about its bracket hold.
inline void expect_confirmed(const std::string& kernel, const Failure& answer,
                             const ExactPolynomial& function, const JudgedFailure& expected,
                             AtFailure at_failure = AtFailure::descends) {
  SCOPED_TRACE(kernel + ": " + describe(function.scaled()));
  ASSERT_EQ(static_cast<int>(answer.kind), static_cast<int>(expected.kind));
  if (answer.kind != Failure::Kind::later) return;
  const Rational lower = rational_of(answer.time.lower);
  const Rational upper = rational_of(answer.time.upper);
  const sturm::Sequence& sequence = *expected.time.sequence;
  const sturm::Root& root = expected.time.root;
  const auto order = [&](const Rational& x) {
    return sturm::compare(sequence, root, sturm::Sequence(sturm::with_root(x)), {x, x});
  };
  ASSERT_TRUE(0 <= lower && lower <= upper && upper <= 1);
  if (lower == upper) {
    EXPECT_EQ(order(lower), 0);
    EXPECT_FALSE(answer.time.isolating);
    return;
  }
  EXPECT_EQ(order(lower), 1);
  EXPECT_EQ(order(upper), -1);
  int earlier = 0;
  for (const sturm::Root& other : sturm::roots_on(sequence, lower, upper))
    earlier += sturm::compare(sequence, other, sequence, root) < 0;
  EXPECT_EQ(answer.time.ordinal, earlier);
  if (answer.time.isolating) {
    EXPECT_EQ(sequence.roots_on(lower, upper), 1);
    const int before = function.sign_at(Dyadic(answer.time.lower));
    const int after = function.sign_at(Dyadic(answer.time.upper));
    EXPECT_LT(before * after, 0);
    if (at_failure == AtFailure::descends) {
      EXPECT_GT(before, 0);
    }
  }
}

/// Holds functions by slot, for instants.
class Functions final : public CertificateSource {
 public:
  std::uint32_t add(ExactPolynomial function) {
    functions_.push_back(std::make_shared<const ExactPolynomial>(std::move(function)));
    return static_cast<std::uint32_t>(functions_.size() - 1);
  }
  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override { return functions_[slot]; }

 private:
  std::vector<ExactFunction> functions_;
};

}  // namespace kds::test
