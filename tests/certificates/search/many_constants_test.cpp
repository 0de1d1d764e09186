// Compares certificates with four to six constants over curves of degree 4 and above with rational
// references.

#include <gtest/gtest.h>

#include <array>

#include "certificates/search/define_certificate_search.h"
#include "tests/support/judges/searched_constants.h"
#include "tests/support/rounds.h"

namespace kds::many_constants_test {
namespace {

using test::difference;
using test::MotionKind;
using test::pick;
using test::product;
using test::Random;
using test::RationalCurve;
using test::sum;

/// The squared distance of two beads is greater than a b + s - t, with lengths a, b and squared lengths s, t.
struct FourConstants {
  static constexpr CertificateType type{1003, "four"};
  struct Constants {
    Constant<1> a, b;
    Constant<2> s, t;
  };
  std::array<BeadId, 2> beads{};
  bool above = true;
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return above; }
  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& b) {
    const auto d = view.difference(b[0], b[1]);
    return dot(d, d) - view.constant(&Constants::a) * view.constant(&Constants::b) -
           elevate<2 * View::degree>(view.constant(&Constants::s) - view.constant(&Constants::t));
  }
};

/// The difference d of two beads satisfies (d[0] - u) x + (d[1] - v) y > z w, with six lengths.
struct SixConstants {
  static constexpr CertificateType type{1004, "six"};
  struct Constants {
    Constant<1> x, y, z, u, v, w;
  };
  std::array<BeadId, 2> beads{};
  bool above = true;
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return above; }
  template <MotionView View>
  [[nodiscard]] static auto formula(const View& view, const std::array<BeadId, 2>& b) {
    const auto d = view.difference(b[0], b[1]);
    return (d[0] - view.constant(&Constants::u)) * view.constant(&Constants::x) +
           (d[1] - view.constant(&Constants::v)) * view.constant(&Constants::y) -
           view.constant(&Constants::z) * view.constant(&Constants::w);
  }
};

template <class Certificate>
Certificate opposite(Certificate certificate) {
  certificate.above = !certificate.above;
  return certificate;
}

/// Random constants, some with one control point, and their rational references.
template <int Degree, std::size_t Count>
struct Drawn {
  std::array<std::vector<double>, Count> numbers;
  std::array<RationalCurve, Count> curves;
  Drawn(Random& random, int exponent, std::size_t squares_from) {
    for (std::size_t i = 0; i < Count; ++i) {
      numbers[i] = test::random_constant(random, Degree, i < squares_from ? exponent : 2 * exponent);
      curves[i] = test::rational_curve(numbers[i], Degree);
    }
  }
};

template <Motion M>
RationalCurve apart(const M& motion, int axis) {
  return difference(test::rational_coordinate(motion, 0, axis), test::rational_coordinate(motion, 1, axis));
}

template <Motion M, class Certificate>
void judge(const M& motion, const Certificate& certificate, const typename Certificate::Constants& constants,
           const RationalCurve& twin, test::DecidedInDouble& count) {
  const auto search = search_over<Certificate>(MotionRef<M::dimension>(motion));
  search->set_constants(constants);
  test::expect_judged_all_along(
      *search, certificate, twin, 0, [](const Certificate& c) { return opposite(c); }, count);
}

template <Motion M>
void expect_as_judged(int rounds, int exponent) {
  Random random(2105);
  test::DecidedInDouble count;
  for (int i = 0; i < rounds; ++i) {
    for (const MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("round " + std::to_string(i) + ", kind " + std::to_string(static_cast<int>(kind)));
      auto motion = test::random_motion<M>(random, 2, kind);
      test::scale(motion, exponent);
      const bool above = random() % 2 == 0;

      const Drawn<M::degree, 4> four(random, exponent, 2);
      RationalCurve square{0};
      for (int axis = 0; axis < M::dimension; ++axis)
        square = sum(square, product(apart(motion, axis), apart(motion, axis)));
      judge(motion, FourConstants{{0, 1}, above},
            {.a = Constant<1>(four.numbers[0]),
             .b = Constant<1>(four.numbers[1]),
             .s = Constant<2>(four.numbers[2]),
             .t = Constant<2>(four.numbers[3])},
            difference(difference(square, product(four.curves[0], four.curves[1])),
                       difference(four.curves[2], four.curves[3])),
            count);

      const Drawn<M::degree, 6> six(random, exponent, 6);
      const auto& [x, y, z, u, v, w] = six.curves;
      judge(motion, SixConstants{{0, 1}, above},
            {.x = Constant<1>(six.numbers[0]),
             .y = Constant<1>(six.numbers[1]),
             .z = Constant<1>(six.numbers[2]),
             .u = Constant<1>(six.numbers[3]),
             .v = Constant<1>(six.numbers[4]),
             .w = Constant<1>(six.numbers[5])},
            difference(
                sum(product(difference(apart(motion, 0), u), x), product(difference(apart(motion, 1), v), y)),
                product(z, w)),
            count);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(count.in_double, 0);
}

TEST(ManyConstants, OnCurvesOfDegreeFourAndAboveAreAsJudged) {
  expect_as_judged<BezierMotion<2, 4>>(test::rounds(4), 0);
  expect_as_judged<BezierMotion<3, 5>>(test::rounds(2), 0);
}

TEST(ManyConstants, OfAllScalesAreAsJudged) {
  for (const int exponent : {-200, 200}) expect_as_judged<BezierMotion<2, 4>>(1, exponent);
}

}  // namespace
}  // namespace kds::many_constants_test
