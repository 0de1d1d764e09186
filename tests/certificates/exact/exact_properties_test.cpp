// Compares many random and adversarial polynomials with Sturm sequences: isolating intervals, multiplicities,
// the order of times, signs at and just after times, touches, and the results of the whole cascade from
// doubles to integers. Each case tests isolation or one of the other properties.
// tests/support/property_runs.h sets the number of cases and the seed.

#include <gtest/gtest.h>

#include <iostream>
#include <tuple>

#include "certificates/search/define_certificate_search.h"
#include "certificates/types/precedes.h"
#include "motions/curves/bezier_motion.h"
#include "tests/support/judges/judged_failure.h"
#include "tests/support/property_runs.h"
#include "tests/support/searches.h"

namespace kds {
namespace exact_properties_test {
namespace {

namespace sturm = test::sturm;
using test::Random;
using test::Scaled;

constexpr unsigned parts = 16;

// Records the first property that did not hold.
struct Faults {
  std::string first;
  void expect(bool holds, const char* what) {
    if (!holds && first.empty()) first = what;
  }
};

// A nonzero polynomial and all facts about its roots in [0, 1).
struct Judged {
  explicit Judged(const ExactPolynomial& p)
      : ours(p), simple(p.square_free()), power(sturm::from_scaled(p.scaled())), sequence(power) {
    roots = sturm::roots_on(sequence, 0, 1);
    if (!roots.empty() && sequence.is_root(1)) roots.pop_back();
    const bool all_simple = sequence.square_free_part().size() == power.size();
    int sign = sturm::sign_after(power, 0);
    for (const sturm::Root& root : roots) {
      multiplicities.push_back(all_simple ? 1 : sturm::multiplicity(sequence, root, power));
      const bool at_start = root.is_number() && root.upper == 0;
      if (!at_start && multiplicities.back() % 2 == 1) sign = -sign;
      signs_after.push_back(sign);
    }
  }

  [[nodiscard]] std::size_t before(const Rational& x) const {
    return up_to(x) - (sequence.is_root(x) ? 1 : 0);
  }
  [[nodiscard]] std::size_t up_to(const Rational& x) const {
    return static_cast<std::size_t>(sequence.roots_on(0, x));
  }
  [[nodiscard]] int sign_after(const Rational& x) const { return sturm::sign_after(power, x); }
  // Returns whether root number `index` is the only root strictly between the two numbers.
  [[nodiscard]] bool isolates(const Rational& lower, const Rational& upper, std::size_t index) const {
    return up_to(lower) == index && before(upper) == index + 1;
  }
  [[nodiscard]] bool is_number(const Rational& x, std::size_t index) const {
    return sequence.is_root(x) && before(x) == index;
  }
  [[nodiscard]] bool encloses(const ExactTime& time, std::size_t index) const {
    return time.is_dyadic() ? is_number(time.lower().rational(), index)
                            : isolates(time.lower().rational(), time.upper().rational(), index);
  }

  ExactPolynomial ours, simple;
  sturm::Polynomial power;
  sturm::Sequence sequence;
  std::vector<sturm::Root> roots;
  std::vector<int> multiplicities, signs_after;
};

ExactPolynomial negative(const ExactPolynomial& p) {
  Scaled scaled = p.scaled();
  for (Integer& x : scaled) x = -x;
  return ExactPolynomial(scaled);
}

ExactPolynomial derivative(const ExactPolynomial& p) {
  const Scaled& c = p.scaled();
  Scaled d;
  for (std::size_t k = 0; k + 1 < c.size(); ++k) d.push_back(c[k + 1] * (k + 1) - c[k] * (c.size() - 1 - k));
  return ExactPolynomial(d);
}

void expect_isolation(const Judged& p, const Dyadic& lower, const Dyadic& upper, Faults& faults) {
  const auto found = isolate_roots(p.simple, lower, upper);
  const std::size_t first = p.before(lower.rational());
  // A root at the very end of the step may be kept or dropped, so it is not compared.
  const std::size_t end = std::min(p.up_to(upper.rational()), p.roots.size());
  const std::size_t count =
      found.size() - (!found.empty() && found.back().lower == Dyadic(1.0) && end == p.roots.size() ? 1 : 0);
  faults.expect(count == end - first, "number of roots isolated");
  for (std::size_t i = 0; i < std::min(count, end - first); ++i) {
    faults.expect(lower <= found[i].lower && found[i].upper <= upper, "interval outside");
    faults.expect(p.encloses(ExactTime(p.simple, found[i]), first + i), "isolating interval");
  }
}

std::vector<ExactTime> times_of(const Judged& p) {
  std::vector<ExactTime> times;
  for (RootInterval& root : isolate_roots(p.simple, Dyadic(0.0), Dyadic(1.0))) {
    if (times.size() < p.roots.size()) times.emplace_back(p.simple, std::move(root));
  }
  return times;
}

// At a root of multiplicity m the first m-1 derivatives vanish, and the next derivative gives the sign after
// the root.
void expect_multiplicities(const Judged& p, Faults& faults) {
  std::vector<ExactTime> times = times_of(p);
  for (std::size_t i = 0; i < times.size(); ++i) {
    ExactPolynomial f = p.ours;
    for (int k = 0; k < p.multiplicities[i]; ++k) {
      faults.expect(sign_at(f, times[i]) == 0, "multiplicity too low");
      f = derivative(f);
    }
    faults.expect(sign_at(f, times[i]) == p.signs_after[i], "multiplicity too high, or sign of a derivative");
    faults.expect(sign_after(p.ours, times[i]) == p.signs_after[i], "sign just after a root");
  }
}

// Follows all failures of the step. After each failure the function gets the sign that makes it positive just
// after now.
void expect_failures(const Judged& p, const Dyadic& from, TouchPolicy touches, Faults& faults) {
  ExactTime now(from);
  int sign = p.sign_after(from.rational());
  for (std::size_t i = p.up_to(from.rational()); i <= p.roots.size() && from < Dyadic(1.0); ++i) {
    const bool touch = i < p.roots.size() && p.multiplicities[i] % 2 == 0;
    if (touch && touches == TouchPolicy::ignored) continue;
    const ExactPolynomial f = sign > 0 ? p.ours : negative(p.ours);
    faults.expect(sign_after(f, now) > 0, "sign just after now");
    const auto failure = first_failure_after(f, now, touches);
    faults.expect(failure.has_value() == (i < p.roots.size()), "whether it fails");
    if (!failure || i == p.roots.size()) return;
    faults.expect(failure->touch == touch, "touch or failure");
    faults.expect(p.encloses(failure->time, i), "failure time");
    now = failure->time;
    sign = p.signs_after[i];
  }
}

// Compares times of two polynomials and a number: their order, and the signs of `q` at these times.
void expect_order(const Judged& p, const Judged& q, const Dyadic& number, Random& random, Faults& faults) {
  const Judged at_number{ExactPolynomial(test::linear(number.numerator(), Integer(1) << number.exponent()))};
  struct Time {
    const Judged* of;
    std::size_t index;
    ExactTime ours;
  };
  std::vector<Time> times;
  for (const Judged* of : {&p, &q, &at_number}) {
    const std::size_t first = times.size();
    for (ExactTime& time : times_of(*of)) times.push_back({of, times.size() - first, std::move(time)});
  }
  for (int pair = 0; pair < 2 && !times.empty(); ++pair) {
    Time a = times[random() % times.size()];
    Time b = times[random() % times.size()];
    const int order =
        sturm::compare(a.of->sequence, a.of->roots[a.index], b.of->sequence, b.of->roots[b.index]);
    faults.expect(ExactTime::compare(a.ours, b.ours) == order, "order of times");
    faults.expect(ExactTime::compare(b.ours, a.ours) == -order, "order of times, once narrowed");
    faults.expect(a.of->encloses(a.ours, a.index) && b.of->encloses(b.ours, b.index), "narrowed interval");
    const sturm::Root& root = a.of->roots[a.index];
    const int after = sturm::sign_after(q.power, q.sequence, a.of->sequence, root);
    const bool zero = sturm::shares(a.of->sequence, root, q.power);
    faults.expect(sign_after(q.ours, a.ours) == after, "sign just after another's root");
    faults.expect(sign_at(q.ours, a.ours) == (zero ? 0 : after), "sign at another's root");
  }
}

// A certificate whose function is any polynomial of degree 6 or 15 in a cubic motion. Beads 1 and 2 move
// along (1-u)^i u^(3-i), and the other beads along the coefficients of the polynomial, four coefficients per
// bead.
template <int Degree>
struct AnyCurve {
  static_assert(Degree == 6 || Degree == 15);
  static constexpr CertificateType type{2000 + Degree, "any_curve"};
  static constexpr std::size_t pieces = Degree == 6 ? 2 : 4;

  std::array<BeadId, 3 + pieces> beads{};
  int sign = 1;

  [[nodiscard]] Identity identity() const { return {type.number, {}}; }
  [[nodiscard]] bool side() const { return sign > 0; }
  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 3 + pieces>& b) {
    // Bead 1 moves along (1-u)^3 and u^3, and bead 2 along (1-u)^2 u and (1-u) u^2. Each further bead carries
    // one part of the polynomial.
    const auto ends = view.difference(b[1], b[0]), middle = view.difference(b[2], b[0]);
    const auto part = [&](std::size_t i) { return view.difference(b[3 + i], b[0])[0]; };
    if constexpr (Degree == 6) {
      return part(0) * ends[0] + part(1) * ends[1];
    } else {
      const auto left = ends[0] * ends[0], right = ends[1] * ends[1];
      return (part(0) * left) * left + (part(1) * left) * (middle[0] * ends[1]) +
             (part(2) * right) * (ends[0] * middle[1]) + (part(3) * right) * right;
    }
  }
};

}  // namespace
}  // namespace exact_properties_test

using exact_properties_test::AnyCurve;

template <>
std::unique_ptr<CertificateSearch<AnyCurve<6>>> search_over(const MotionRef<2>& motion) {
  return std::make_unique<detail::SearchInLanes<AnyCurve<6>, FixedCurves<2, 3>>>(motion);
}
template <>
std::unique_ptr<CertificateSearch<AnyCurve<15>>> search_over(const MotionRef<2>& motion) {
  return std::make_unique<detail::SearchInLanes<AnyCurve<15>, FixedCurves<2, 3>>>(motion);
}

namespace exact_properties_test {
namespace {

// A motion and a certificate whose function is a positive multiple of a polynomial.
template <class M, class C>
struct OnAMotion {
  M motion;
  C certificate;
  bool as_it_was = true;  // true while no coefficient has been rounded

  /// Returns false if the number is too large for a double.
  [[nodiscard]] bool set(BeadId bead, int k, const Integer& x) {
    const double control = x.get_d();
    if (!std::isfinite(control)) return false;
    as_it_was &= Integer(control) == x;
    motion.set_coordinate(bead, k, 0, control);
    return true;
  }
};

template <Motion M>
std::optional<OnAMotion<M, Precedes>> as_way_of_a_bead(const Scaled& scaled, M motion) {
  const auto degree = static_cast<int>(scaled.size()) - 1;
  const std::int64_t common = degree == 3 ? 3 : degree == 6 ? 60 : 45045;  // a multiple of all binomials
  OnAMotion<M, Precedes> result{std::move(motion), Precedes({0, 1})};
  for (int k = 0; k <= degree; ++k) {
    if (!result.set(1, k, scaled[static_cast<std::size_t>(k)] * (common / binomial(degree, k))))
      return std::nullopt;
  }
  return result;
}

template <int Degree>
std::optional<OnAMotion<BezierMotion<2, 3>, AnyCurve<Degree>>> as_any_curve(const Scaled& scaled) {
  constexpr std::size_t pieces = AnyCurve<Degree>::pieces;
  OnAMotion<BezierMotion<2, 3>, AnyCurve<Degree>> result{BezierMotion<2, 3>(3 + pieces), {}};
  for (BeadId b = 0; b < 3 + pieces; ++b) result.certificate.beads[b] = b;
  for (int axis = 0; axis < 2; ++axis) {
    result.motion.set_coordinate(1, 3 * axis, axis, 1);
    // This term is a third of the function, because the middle binomials are 3.
    result.motion.set_coordinate(2, 1 + axis, axis, 1);
  }
  for (std::size_t part = 0; part < pieces; ++part) {
    // At degree 6 two pieces share a coefficient, which belongs to the first piece.
    const std::size_t first = Degree == 6 ? 3 * part : 4 * part;
    for (std::size_t k = Degree == 6 && part > 0 ? 1 : 0; k <= 3; ++k) {
      // Products with bead 2 are three times too large, so the other terms are multiplied by 3.
      const std::int64_t times = (k == 0 || k == 3 ? 3 : 1) * (part == 0 || part + 1 == pieces ? 3 : 1);
      if (!result.set(static_cast<BeadId>(3 + part), static_cast<int>(k), scaled[first + k] * times))
        return std::nullopt;
    }
  }
  return result;
}

// Tests the same polynomial as a certificate's function, through all stages.
template <class M, class C>
void expect_cascade(const Judged& p, std::optional<OnAMotion<M, C>> made, const Dyadic& from, Random& random,
                    Faults& faults) {
  if (!made) return;
  const M& motion = made->motion;
  C certificate = made->certificate;
  const bool as_it_was = made->as_it_was;
  std::optional<Judged> rounded;
  if (!as_it_was) {
    const ExactPolynomial function = test::exact_function(certificate, motion);
    if (function.is_zero()) return;
    rounded.emplace(function);
  }
  const Judged& judge = as_it_was ? p : *rounded;

  const double start = from.round_down();
  const auto touches = random() % 2 ? TouchPolicy::ignored : TouchPolicy::reported;
  test::Functions functions;
  Instant now(start);
  const Rational start_rational = Dyadic(start).rational();
  int sign = judge.sign_after(start_rational);
  std::size_t index = judge.up_to(start_rational);
  KnownAtStart birth = KnownAtStart::unknown;
  for (StageCounts stages; start < 1;) {
    faults.expect(test::sign_just_after(Kernel::filtered, certificate, motion, now, stages) == sign,
                  "filtered sign");
    if (sign < 0) {
      const auto at_birth =
          test::first_failure(Kernel::filtered, certificate, motion, now, KnownAtStart::unknown, stages);
      faults.expect(at_birth.kind == Failure::Kind::at_birth, "filtered failure at birth");
      certificate.sign = -certificate.sign;
    }
    const Failure failure =
        test::first_failure(Kernel::filtered, certificate, motion, now, birth, stages, touches);
    // If touches are not requested, the search may skip them.
    while (touches == TouchPolicy::ignored && index < judge.roots.size() &&
           judge.multiplicities[index] % 2 == 0)
      ++index;
    if (index >= judge.roots.size()) {
      faults.expect(failure.kind == Failure::Kind::never, "filtered failure where there is none");
      return;
    }
    faults.expect(failure.kind == Failure::Kind::later, "no filtered failure where there is one");
    if (!faults.first.empty()) return;
    const FailureTime& time = failure.time;
    const Rational lower = test::rational_of(time.lower);
    const Rational upper = test::rational_of(time.upper);
    const bool even = judge.multiplicities[index] % 2 == 0;
    faults.expect(time.touch == even, "filtered touch or failure");
    if (lower == upper) {
      faults.expect(judge.is_number(lower, index), "filtered time");
    } else {
      faults.expect(judge.up_to(lower) <= index && index < judge.before(upper), "filtered bracket");
      faults.expect(judge.before(lower) + time.ordinal == index, "filtered ordinal");
      faults.expect(!time.isolating || judge.isolates(lower, upper, index), "filtered isolating bracket");
    }
    now = Instant(time, functions, functions.add(test::exact_function(certificate, motion)));
    if (!even) certificate.sign = -certificate.sign;
    birth = !even && random() % 4 != 0 ? KnownAtStart::at_own_root : KnownAtStart::unknown;
    // From now on the certificate holds just after each time `now`.
    sign = 1;
    ++index;
  }
}

struct Case {
  Scaled p, q;
  Dyadic from, to;
  std::uint64_t seed;  // for the random choices within the case
};

std::string fault_of(const Case& c) {
  Random random(c.seed);
  const ExactPolynomial zero_or_not(c.p);
  Faults faults;
  if (zero_or_not.is_zero()) {
    ExactTime now(c.from);
    faults.expect(sign_after(zero_or_not, now) == 0 && sign_at(zero_or_not, now) == 0, "sign of zero");
    faults.expect(!first_failure_after(zero_or_not, now).has_value(), "failure of zero");
    return faults.first;
  }
  const Judged p(zero_or_not);
  expect_isolation(p, c.from, c.to, faults);
  switch (random() % 4) {
    case 0:
      expect_multiplicities(p, faults);
      break;
    case 1:
      expect_failures(p, c.from, random() % 2 ? TouchPolicy::ignored : TouchPolicy::reported, faults);
      break;
    case 2:
      if (const ExactPolynomial q(c.q); !q.is_zero()) expect_order(p, Judged(q), c.to, random, faults);
      break;
    default:
      // Functions of cubic motions use the vectorized code; curves of higher degree use the code for one
      // function.
      const bool in_lanes = random() % 4 != 0;
      const auto elevated = [&](std::size_t degree) {
        Scaled scaled = p.ours.scaled();
        while (scaled.size() <= degree) scaled = test::product(scaled, {1, 1});
        return scaled;
      };
      if (c.p.size() <= 4) {
        expect_cascade(p, as_way_of_a_bead(elevated(3), BezierMotion<1, 3>(2)), c.from, random, faults);
      } else if (c.p.size() <= 7) {
        if (in_lanes) {
          expect_cascade(p, as_any_curve<6>(elevated(6)), c.from, random, faults);
        } else {
          expect_cascade(p, as_way_of_a_bead(elevated(6), AnyDegreeMotion<1>(2, 6)), c.from, random, faults);
        }
      } else if (c.p.size() <= 16) {
        if (in_lanes) {
          expect_cascade(p, as_any_curve<15>(elevated(15)), c.from, random, faults);
        } else {
          expect_cascade(p, as_way_of_a_bead(elevated(15), AnyDegreeMotion<1>(2, 15)), c.from, random,
                         faults);
        }
      }
  }
  return faults.first;
}

Case random_case(Random& random) {
  const bool small = random() % 100 != 0;
  const auto fresh = [&] { return small ? test::small_polynomial(random) : test::random_polynomial(random); };
  Case c{fresh(), {}, Dyadic(0.0), Dyadic(1.0), 0};
  c.q = random() % 2 ? test::relative_of(c.p, random) : fresh();
  if (random() % 10 == 0) std::tie(c.p, c.q) = test::close_relatives(random);
  if (random() % 2) c.from = test::random_dyadic(random);
  if (random() % 2) c.to = test::random_dyadic(random);
  if (c.to < c.from) std::swap(c.from, c.to);
  c.seed = random();
  return c;
}

class ExactProperties : public testing::TestWithParam<unsigned> {};

TEST_P(ExactProperties, HoldAsSturmSays) {
  const std::uint64_t cases = test::property_cases() / parts;
  RecordProperty("seed", std::to_string(test::property_seed()));
  std::cout << cases << " cases, KDS_PROPERTY_SEED=" << test::property_seed() << std::endl;
  Random random = test::property_random(GetParam());
  for (std::uint64_t i = 0; i < cases; ++i) {
    Case c = random_case(random);
    if (fault_of(c).empty()) continue;
    c.q = test::shrunk(c.q, [&](const Scaled& q) {
      return !fault_of({c.p, q, c.from, c.to, c.seed}).empty();
    });
    c.p = test::shrunk(c.p, [&](const Scaled& p) {
      return !fault_of({p, c.q, c.from, c.to, c.seed}).empty();
    });
    FAIL() << "seed " << test::property_seed() << ", part " << GetParam() << ", case " << i << ": "
           << fault_of(c) << ": " << test::describe(c.p) << " and " << test::describe(c.q) << " on ["
           << c.from.rational() << ", " << c.to.rational() << "], drawn with " << c.seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, ExactProperties, testing::Range(0U, parts));

}  // namespace
}  // namespace exact_properties_test
}  // namespace kds
