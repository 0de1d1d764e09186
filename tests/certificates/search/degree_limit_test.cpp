// Functions whose binomials exceed 64 bits are refused when their search is constructed. If the degree of a
// motion changes, the search refuses when it is used.

#include "certificates/search/formula_checks.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "certificates/search/sphere_searches.h"
#include "certificates/types/distances.h"
#include "certificates/types/power_test.h"
#include "motions/curves/bezier_motion.h"
#include "tests/support/searches.h"

namespace kds::degree_limit_test {
namespace {

template <class Certificate, int Dimension>
std::string refusal(int degree) {
  const AnyDegreeMotion<Dimension> motion(1, degree);
  try {
    (void)search_over<Certificate>(MotionRef<Dimension>(motion));
  } catch (const std::invalid_argument& reason) {
    return reason.what();
  }
  return "";
}

TEST(DegreeLimit, IsWhatBinomialsOf64BitsAllow) {
  EXPECT_EQ((refusal<PowerTest<3>, 3>(12)), "");
  EXPECT_EQ((refusal<PowerTest<3>, 3>(13)),
            "power_test over motion of degree 13: its function has degree 65, expected at most 61");
  EXPECT_EQ((refusal<Contact, 3>(30)), "");
  EXPECT_NE((refusal<Contact, 3>(31)), "");
}

TEST(DegreeLimit, OfARadicalIsThatOfItsNorm) {
  EXPECT_EQ((refusal<BallInSphere<3, 3>, 3>(5)), "");
  EXPECT_EQ((refusal<BallInSphere<3, 3>, 3>(6)),
            "ball_in_sphere over motion of degree 6: its function has degree 72, expected at most 61");
}

/// Makes a ball whose path has control points that alternate between two places.
AnyDegreeMotion<1> meeting(int degree) {
  AnyDegreeMotion<1> motion(2, degree);
  for (int k = 0; k <= degree; ++k) {
    motion.set_coordinate(1, k, 0, k % 2 == 0 ? 4 : -3);
    motion.set_radius(0, k, 0.5);
    motion.set_radius(1, k, 0.5);
  }
  return motion;
}

TEST(DegreeLimit, AtItAllKernelsAgree) {
  const AnyDegreeMotion<1> motion = meeting(30);
  const auto search = search_over<Contact>(MotionRef<1>(motion));
  StageCounts stages;
  const Contact contact({0, 1}, 1);
  for (double time = 0; time < 1; time += 0x1p-5) {
    const int exact = search->sign_now(Kernel::exact, contact, Instant(time), stages);
    EXPECT_EQ(search->sign_now(Kernel::filtered, contact, Instant(time), stages), exact) << time;
    const KnownAtStart known = KnownAtStart::unknown;
    Failure filtered, by_integers;
    search->first_failures(Kernel::filtered, {&contact, 1}, Instant(time), {&known, 1}, stages,
                           TouchPolicy::ignored, {&filtered, 1});
    search->first_failures(Kernel::exact, {&contact, 1}, Instant(time), {&known, 1}, stages,
                           TouchPolicy::ignored, {&by_integers, 1});
    EXPECT_EQ(filtered.kind, by_integers.kind) << time;
  }
  EXPECT_GT(stages.exact, 0U);
}

TEST(DegreeOfMotion, IsThatOfTheSearch) {
  AnyDegreeMotion<1> motion = meeting(2);
  const auto search = search_over<Contact>(MotionRef<1>(motion));
  StageCounts stages;
  const Contact contact({0, 1}, 1);
  EXPECT_EQ(search->sign_now(Kernel::filtered, contact, Instant(0), stages), 1);
  motion = meeting(3);
  EXPECT_THROW((void)search->sign_now(Kernel::filtered, contact, Instant(0), stages), std::logic_error);
  const KnownAtStart known = KnownAtStart::unknown;
  Failure failure;
  EXPECT_THROW(search->first_failures(Kernel::filtered, {&contact, 1}, Instant(0), {&known, 1}, stages,
                                      TouchPolicy::ignored, {&failure, 1}),
               std::logic_error);
}

}  // namespace
}  // namespace kds::degree_limit_test
