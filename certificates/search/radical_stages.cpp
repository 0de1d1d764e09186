#include "certificates/search/radical_stages.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "certificates/search/exact_search.h"

namespace kds {

namespace {

/// Returns a narrower bracket around the only root of the norm in `bracket`, where the norm changes from
/// `sign`. The bracket surrounds the root of the polynomial as computed in double, as closely as signs are
/// certain.
[[nodiscard]] BoundedPolynomial::Bracket narrowed(const RadicalInDouble& certificate,
                                                  BoundedPolynomial::Bracket bracket, int sign) {
  const double root =
      (sign > 0 ? certificate.norm() : -certificate.norm()).root_between(bracket.lower, bracket.upper);
  bool below = true, above = true;  // ends still to be found
  for (double reach = 0x1p-38; (below || above) && reach < 0.1; reach *= 64) {
    if (below && root - reach > bracket.lower && certificate.certain_norm_at(root - reach) == sign) {
      bracket.lower = root - reach;
      below = false;
    }
    if (above && root + reach < bracket.upper && certificate.certain_norm_at(root + reach) == -sign) {
      bracket.upper = root + reach;
      above = false;
    }
  }
  return bracket;
}

/// Walks from candidate to candidate while they are proved not to be failures. Starts at `from`, where the
/// certificate must hold. `known` is the norm's sign there, or 0.
[[nodiscard]] std::optional<Failure> walk_candidates(const RadicalInDouble& certificate, double from,
                                                     int known = 0) {
  constexpr int most_candidates = 8;
  // A wider bracket would overlap others, and few signs would be certain on all of it.
  constexpr double wide = 0x1p-30;
  for (int candidate = 0; candidate < most_candidates; ++candidate, known = 0) {
    const BoundedPolynomial& norm = certificate.norm();
    const int sign = known != 0 ? known : certificate.certain_norm_at(from);
    if (sign == 0) return std::nullopt;
    const auto next = (sign > 0 ? norm : -norm).first_descent(from, true);
    if (next.verdict == Verdict::never) return Failure{};
    if (next.verdict == Verdict::undecided) return std::nullopt;
    auto bracket = next.bracket;
    if (bracket.upper - bracket.lower > wide) bracket = narrowed(certificate, bracket, sign);
    const auto [lower, upper] = bracket;
    // The norm has one zero in the bracket. If the signs of A and B are certain on all of it, they determine
    // the sign just after the zero, or the certificate has become unusable before. Otherwise the signs at the
    // bracket's end determine it, unless the certificate may become unusable in between.
    int after = certificate.sign_by_norm(-sign, lower, upper);
    if (after == 0 && certificate.is_usable_on(lower, upper))
      after = certificate.sign_by_norm(-sign, upper, upper);
    if (after == 0) return std::nullopt;
    if (after < 0) return Failure{Failure::Kind::later, {lower, upper, 0, true}};
    from = upper;
  }
  return std::nullopt;
}

ExactPolynomial product(const ExactPolynomial& a, const ExactPolynomial& b) {
  if (a.scaled().empty() || b.scaled().empty()) return {};
  std::vector<Integer> scaled(a.scaled().size() + b.scaled().size() - 1);
  for (std::size_t i = 0; i < a.scaled().size(); ++i) {
    for (std::size_t j = 0; j < b.scaled().size(); ++j) scaled[i + j] += a.scaled()[i] * b.scaled()[j];
  }
  return ExactPolynomial(std::move(scaled));
}

}  // namespace

std::optional<Failure> proved_failure(const RadicalInDouble& certificate, const Instant& now,
                                      KnownAtStart known) {
  if (known == KnownAtStart::at_own_root) {
    if (!now.isolating()) return std::nullopt;
    const int norm = certificate.norm_while_it_holds(now.lower(), now.upper());
    return norm == 0 ? std::nullopt : walk_candidates(certificate, now.upper(), norm);
  }
  static_cast<void>(certificate.norm());  // computed first: it is needed soon, and computing it yields signs
  const int sign = certificate.certain_sign_on(now.lower(), now.upper());
  // A negative sign may come from beads at one position, which have no sphere. Integers decide that.
  if (sign <= 0) return std::nullopt;
  return walk_candidates(certificate, now.upper());
}

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
      return answer(decided(to_failure(candidates, failure), DecidedBy::exact));
    }
  }
  return answer(zero ? Failure{Failure::Kind::zero, {}} : Failure{});
}

}  // namespace kds
