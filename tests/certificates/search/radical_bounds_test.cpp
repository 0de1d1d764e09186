// Compares the derived error bounds of a radical's polynomials with exact coefficients.
#include <gtest/gtest.h>

#include "certificates/formulas/function_values.h"
#include "certificates/search/radical_stages.h"
#include "motions/views/integer_view.h"
#include "tests/support/inputs/ball_motions.h"

namespace kds::radical_bounds_test {
namespace {

using test::Random;

/// Returns the largest |double - exact| / bound among the coefficients, for the type's own filter and for
/// tracked errors.
template <class Part, class M>
double share_used(const M& motion) {
  detail::SignedPart<Part> part;
  for (std::size_t i = 0; i < part.beads.size(); ++i) part.beads[i] = static_cast<BeadId>(i);
  constexpr Channels radii_alone{.weights = false, .radii = true};
  const DoubleView<M> view(motion);
  const auto rounded = function_of(part, view);
  const auto tracked = function_of(part, TrackedView<M>(motion, part.beads, radii_alone));
  const auto exact = function_of(part, IntegerView<M>(motion, part.beads, radii_alone));
  const ErrorBound& bound =
      FunctionValues<detail::SignedPart<Part>, Curves<M::dimension>>::error_bound(M::degree);
  const double scale = bound.scale(view.largest_length());
  const int shift = whole_scale(motion, part.beads, radii_alone).exponent * bound.power;
  const Rational power(Integer(1) << static_cast<unsigned>(std::abs(shift)));
  Rational unit(1);
  for (int i = 0; i < bound.power; ++i)
    unit *= Dyadic(scale_to_unit(motion, part.beads, radii_alone)).rational();
  double share = 0;
  for (std::size_t k = 0; k < rounded.scaled.size(); ++k) {
    const Rational value = shift > 0 ? Rational(exact.scaled[k] / power) : Rational(exact.scaled[k] * power);
    const auto error = [&](double x) { return Rational(abs(Dyadic(x).rational() - value)); };
    if (!std::isnan(scale)) {
      share = std::max(
          share,
          Rational(error(rounded.scaled[k]) / Dyadic(bound.coefficient[k] * scale).rational()).get_d());
    }
    EXPECT_LE(abs(Dyadic(tracked.scaled[k].value).rational() - value * unit),
              Dyadic(tracked.scaled[k].error * TrackedDouble::inflation).rational());
  }
  return share;
}

template <class T>
class RadicalBounds : public testing::Test {};

using Cases = testing::Types<test::BallCase<2, 1, 2>, test::BallCase<2, 2, 3>, test::BallCase<2, 3, 1>,
                             test::BallCase<3, 2, 1>, test::BallCase<3, 3, 1>, test::BallCase<3, 4, 1>,
                             test::BallCase<3, 4, 2>>;
TYPED_TEST_SUITE(RadicalBounds, Cases);

TYPED_TEST(RadicalBounds, HoldAtAllScales) {
  using C = typename TypeParam::C;
  using M = typename TypeParam::M;
  Random random(791);
  double rational = 0;
  double root = 0;
  double norm = 0;
  double condition = 0;
  for (int i = 0; i < 60; ++i) {
    test::BallShape shape;
    if (i % 4 == 0) shape.largest_radius = 50;
    auto motion = test::motion_of<TypeParam>(random, shape);
    test::scale(motion, test::pick(random, -60, 60));
    rational = std::max(rational, share_used<typename C::Radical::Rational>(motion));
    root = std::max(root, share_used<typename C::Radical::Root>(motion));
    norm = std::max(norm, share_used<typename C::Radical::Norm>(motion));
    if constexpr (ConditionalFor<C, M>) {
      condition = std::max(condition, share_used<typename C::Condition::Rational>(motion));
      condition = std::max(condition, share_used<typename C::Condition::Norm>(motion));
    }
  }
  for (const double share : {rational, root, norm, condition}) EXPECT_LE(share, 1);
  // The bounds are not far too large.
  for (const double share : {rational, root, norm}) EXPECT_GT(share, 1e-7);
}

}  // namespace
}  // namespace kds::radical_bounds_test
