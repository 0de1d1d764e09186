#include "motions/base/floating_point_scope.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/inputs/host_environment.h"

namespace kds::floating_point_scope_test {
namespace {

// Divides at run time: `volatile` prevents the compiler from folding the quotient.
double quotient(double a, double b) {
  const volatile double dividend = a, divisor = b;
  return dividend / divisor;
}

class Host : public testing::TestWithParam<test::HostEnvironment> {
 protected:
  void SetUp() override { test::set(GetParam()); }
  void TearDown() override { std::fesetenv(FE_DFL_ENV); }
};

TEST_P(Host, IsSetAsideInAScopeAndComesBack) {
  constexpr double least = std::numeric_limits<double>::min();
  {
    const FloatingPointScope scope;
    const FloatingPointScope within;
    EXPECT_EQ(quotient(1, 3), 1.0 / 3);
    EXPECT_EQ(quotient(-1, 3), -1.0 / 3);
    EXPECT_EQ(quotient(1, 10), 0.1);
    EXPECT_NE(quotient(least, 2), 0);
    EXPECT_EQ(quotient(least / 4, 0x1p-100), least * 0x1p98);
  }
  EXPECT_TRUE(test::is_set(GetParam()));
}

TEST_P(Host, ComesBackWhereAnExceptionPasses) {
  EXPECT_THROW(
      {
        const FloatingPointScope scope;
        throw 1;
      },
      int);
  EXPECT_TRUE(test::is_set(GetParam()));
}

// Without a scope the results differ, so the tests above can fail.
TEST_P(Host, DiffersFromTheDefault) {
  const bool to_nearest = quotient(1, 3) == 1.0 / 3 && quotient(-1, 3) == -1.0 / 3 && quotient(1, 10) == 0.1;
  const bool gradual = quotient(std::numeric_limits<double>::min(), 2) != 0;
  EXPECT_FALSE(to_nearest && gradual);
}

INSTANTIATE_TEST_SUITE_P(All, Host, testing::ValuesIn(test::host_environments));

}  // namespace
}  // namespace kds::floating_point_scope_test
