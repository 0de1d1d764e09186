#include "certificates/exact/instant.h"
#include "certificates/exact/exact_time.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace kds::instant_test {
namespace {

TEST(Instant, OfABracketAloneDecidesNothing) {
  const Instant replayed(FailureTime{0.25, 0.5, 0, false});
  EXPECT_EQ(replayed.lower(), 0.25);
  EXPECT_EQ(replayed.upper(), 0.5);
  EXPECT_THROW((void)replayed.exact(), std::logic_error);
}

TEST(Instant, OfADoubleIsExact) {
  ExactTime quarter(Dyadic(0.25));
  EXPECT_EQ(ExactTime::compare(Instant(0.25).exact(), quarter), 0);
  EXPECT_EQ(ExactTime::compare(Instant(FailureTime{0.25, 0.25, 0, false}).exact(), quarter), 0);
}

TEST(Instant, OfALongDyadicHasABracketAndIsExact) {
  const Dyadic time = Dyadic(Integer(1) + (Integer(1) << 80), 82);  // slightly above 1/4
  const Instant instant(time);
  EXPECT_LT(instant.lower(), instant.upper());
  ExactTime expected(time);
  EXPECT_EQ(ExactTime::compare(instant.exact(), expected), 0);
}

}  // namespace
}  // namespace kds::instant_test
