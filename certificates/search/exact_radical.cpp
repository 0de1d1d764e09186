#include "certificates/search/exact_radical.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "certificates/search/exact_search.h"

namespace kds {

namespace {

ExactPolynomial product(const ExactPolynomial& a, const ExactPolynomial& b) {
  if (a.scaled().empty() || b.scaled().empty()) return {};
  std::vector<Integer> scaled(a.scaled().size() + b.scaled().size() - 1);
  for (std::size_t i = 0; i < a.scaled().size(); ++i) {
    for (std::size_t j = 0; j < b.scaled().size(); ++j) scaled[i + j] += a.scaled()[i] * b.scaled()[j];
  }
  return ExactPolynomial(std::move(scaled));
}

}  // namespace

int ExactRadical::sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const {
  const int a = sign_of(rational, time);
  const int b = sign_of(root, time);
  return a == b ? a : sign_of_radical(a, b, sign_of(norm, time));
}

int ExactRadicalCertificate::sign(ExactTime& time, int (*sign_of)(const ExactPolynomial&, ExactTime&)) const {
  int sign = radical.sign(time, sign_of);
  if (sign >= 0 && condition && condition->sign(time, sign_of) < 0) sign = -1;
  return side ? sign : -sign;
}

bool ExactRadicalCertificate::touches(ExactTime& candidate) const {
  if (sign(candidate, sign_at) != 0) return false;
  ExactTime before(candidate.lower());
  return candidate.is_dyadic() || sign(before, sign_at) > 0;
}

ExactPolynomial ExactRadicalCertificate::candidates() const {
  return radical.norm.is_zero() ? product(radical.rational, radical.root) : radical.norm;
}

std::size_t ExactRadicalCertificate::largest_bit_length() const {
  return std::max({radical.rational.largest_bit_length(), radical.root.largest_bit_length(),
                   radical.norm.largest_bit_length()});
}

Failure exact_first_failure(const ExactRadicalCertificate& certificate, const Instant& now,
                            StageCounts& stages, TouchPolicy touches) {
  const ExactPolynomial candidates = certificate.candidates();
  if (candidates.is_zero()) {
    ++stages.identically_zero;
    return {Failure::Kind::zero, {}};
  }
  stages.largest_bits = std::max<std::uint64_t>(stages.largest_bits, certificate.largest_bit_length());
  ExactTime& time = now.exact();
  const int first = certificate.sign(time, sign_after);
  // Narrows the present time until there is no candidate between it and its upper end.
  static_cast<void>(sign_after(candidates, time));
  bool zero = first == 0;
  const auto answer = [&](const Failure& failure) {
    ++(zero ? stages.identically_zero : stages.exact);
    return failure;
  };
  if (first < 0) return answer({Failure::Kind::at_birth, {now.lower(), now.upper(), 0, false}});

  const Dyadic end(1.0);
  const ExactPolynomial simple = candidates.square_free();
  if (time.upper() < end) {
    for (RootInterval& root : isolate_roots(simple, time.upper(), end)) {
      if (root.lower == end) break;  // events at u = 1 belong to the next step
      if (time.is_dyadic() && root.upper == time.upper()) continue;  // the present time itself
      ExactTime candidate(simple, std::move(root));
      const int after = certificate.sign(candidate, sign_after);
      zero &= after == 0;
      const bool touch = after > 0 && touches == TouchPolicy::reported && certificate.touches(candidate);
      if (after >= 0 && !touch) continue;
      ExactFailure failure{std::move(candidate), touch};
      return answer(to_failure(candidates, failure));
    }
  }
  return answer(zero ? Failure{Failure::Kind::zero, {}} : Failure{});
}

}  // namespace kds
