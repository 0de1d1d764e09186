// Compares a certificate with three kinds of constants, a cylinder that moves, turns and grows, with its
// rational reference.

#include <gtest/gtest.h>

#include <array>

#include "certificates/base/determinant.h"
#include "certificates/search/define_certificate_search.h"
#include "tests/support/judges/searched_constants.h"
#include "tests/support/rounds.h"

namespace kds::constant_axis_test {
namespace {

using test::difference;
using test::product;
using test::Random;
using test::RationalCurve;

/// A bead is within a distance of an axis.
struct InCylinder {
  static constexpr CertificateType type{1005, "in_cylinder"};
  struct Constants {
    ConstantPoint<3> foot;
    ConstantVector<3> axis;
    Constant<1> radius;
  };
  std::array<BeadId, 1> beads{};
  bool inside = true;
  [[nodiscard]] Identity identity() const { return identity_of(type, beads); }
  [[nodiscard]] bool side() const { return inside; }
  static constexpr auto formula(const MotionView auto& view, const std::array<BeadId, 1>& b) {
    const auto axis = view.constant(&Constants::axis);
    const auto radius = view.constant(&Constants::radius);
    const auto off = cross(view.difference(b[0], view.bead(&Constants::foot)), axis);
    return radius * radius * dot(axis, axis) - dot(off, off);
  }
};

using Curves3 = std::array<RationalCurve, 3>;
RationalCurve squared(const Curves3& v) {
  return test::sum(test::sum(product(v[0], v[0]), product(v[1], v[1])), product(v[2], v[2]));
}

template <Motion M>
void expect_cylinders_as_judged(int rounds, int exponent) {
  Random random(2131);
  test::DecidedInDouble count;
  for (int i = 0; i < rounds; ++i) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      SCOPED_TRACE("round " + std::to_string(i) + ", kind " + std::to_string(static_cast<int>(kind)));
      auto motion = test::random_motion<M>(random, 1, kind);
      test::scale(motion, exponent);
      std::array<std::vector<std::array<double, 3>>, 2> vectors;  // the foot and the axis
      std::array<Curves3, 2> curves;
      for (std::size_t which = 0; which < 2; ++which) {
        const bool turns = random() % 2 == 0;
        vectors[which].resize(turns ? M::degree + 1 : 1);
        for (auto& vector : vectors[which])
          for (double& x : vector)
            x = std::ldexp(test::pick(random, -6, 6) * 0.25, which == 0 ? exponent : 0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          std::vector<double> control_points;
          for (const auto& vector : vectors[which]) control_points.push_back(vector[axis]);
          curves[which][axis] = test::rational_curve(control_points, M::degree);
        }
      }
      const auto radius = test::random_constant(random, M::degree, exponent);
      Curves3 d, off;
      for (std::size_t axis = 0; axis < 3; ++axis)
        d[axis] = difference(test::rational_coordinate(motion, 0, static_cast<int>(axis)), curves[0][axis]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
        off[axis] = difference(product(d[y], curves[1][z]), product(d[z], curves[1][y]));
      }
      const RationalCurve r = test::rational_curve(radius, M::degree);
      const auto search = search_over<InCylinder>(MotionRef<3>(motion));
      using Vectors = std::span<const std::array<double, 3>>;
      search->set_constants({.foot = ConstantPoint<3>(Vectors(vectors[0])),
                             .axis = ConstantVector<3>(Vectors(vectors[1])),
                             .radius = Constant<1>(radius)});
      test::expect_judged_all_along(
          *search, InCylinder{{0}, random() % 2 == 0},
          difference(product(product(r, r), squared(curves[1])), squared(off)), 0,
          [](InCylinder c) {
            c.inside = !c.inside;
            return c;
          },
          count);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ConstantAxis, CylindersAreAsJudged) {
  expect_cylinders_as_judged<BezierMotion<3, 1>>(test::rounds(10), 0);
  expect_cylinders_as_judged<BezierMotion<3, 1>>(1, 300);
  expect_cylinders_as_judged<BezierMotion<3, 1>>(1, -300);
}

}  // namespace
}  // namespace kds::constant_axis_test
