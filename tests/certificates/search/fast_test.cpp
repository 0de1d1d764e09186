// The kernel `fast` proves nothing, but it is correct if certificates are well separated.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/inputs/any_certificate.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/searches.h"

namespace kds::fast_test {
namespace {

using test::Subject;

template <class S>
class FastKernel : public testing::Test {};

using Subjects =
    testing::Types<Subject<Precedes, BezierMotion<1, 1>>, Subject<Precedes, BezierMotion<1, 3>>,
                   Subject<Orientation<2>, BezierMotion<2, 1>>, Subject<Orientation<3>, BezierMotion<3, 1>>,
                   Subject<Orientation<3>, BezierMotion<3, 3>>, Subject<PowerTest<2>, BezierMotion<2, 1>>,
                   Subject<PowerTest<3>, BezierMotion<3, 1>>, Subject<PowerTest<3>, BezierMotion<3, 3>>,
                   Subject<Contact, BezierMotion<3, 1>>>;
TYPED_TEST_SUITE(FastKernel, Subjects);

// Searches all certificates at once, by lanes, with the rest one by one. The kinds of failures are those of
// `filtered`, and the times lie almost within its brackets.
TYPED_TEST(FastKernel, SaysWhatFilteredSaysOfGenericMotion) {
  using C = typename TypeParam::C;
  test::Random random(311);
  int later = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE("seed 311, round " + std::to_string(round));
    const auto motion =
        test::random_motion<typename TypeParam::M>(random, 3 * TypeParam::beads, test::MotionKind::generic);
    std::vector<C> certificates;
    for (int i = 0; i < 7; ++i) {
      C certificate = test::random_certificate<C>(random);
      auto beads = certificate.beads;
      for (std::size_t b = 0; b < beads.size(); ++b)
        beads[b] = static_cast<BeadId>(3 * b + random() % 3);  // ascending, as certificate types require
      certificate.beads = beads;
      certificates.push_back(certificate);
    }
    const auto search = search_over<C>(MotionRef<TypeParam::M::dimension>(motion));
    const std::vector<KnownAtStart> unknown(certificates.size(), KnownAtStart::unknown);
    std::vector<Failure> fast(certificates.size()), filtered(certificates.size());
    const Instant now(0.25 * static_cast<double>(random() % 4));
    StageCounts stages;
    search->first_failures(Kernel::fast, certificates, now, unknown, stages, TouchPolicy::ignored, fast);
    EXPECT_EQ(stages.exact, 0U);
    search->first_failures(Kernel::filtered, certificates, now, unknown, stages, TouchPolicy::ignored,
                           filtered);
    for (std::size_t i = 0; i < certificates.size(); ++i) {
      EXPECT_EQ(fast[i].kind, filtered[i].kind);
      EXPECT_EQ(search->sign_just_after(Kernel::fast, certificates[i], now, stages),
                search->sign_just_after(Kernel::filtered, certificates[i], now, stages));
      EXPECT_EQ(search->sign_now(Kernel::fast, certificates[i], now, stages),
                search->sign_now(Kernel::filtered, certificates[i], now, stages));
      if (fast[i].kind != Failure::Kind::later || filtered[i].kind != Failure::Kind::later) continue;
      ++later;
      EXPECT_EQ(fast[i].time.lower, fast[i].time.upper);
      EXPECT_GT(fast[i].time.lower, filtered[i].time.lower - 1e-9);
      EXPECT_LT(fast[i].time.lower, filtered[i].time.upper + 1e-9);
    }
  }
  EXPECT_GT(later, 30);
}

}  // namespace
}  // namespace kds::fast_test
