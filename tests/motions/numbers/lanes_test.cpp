// Lanes that are passed by reference arrive unchanged, whatever processor the function is compiled for.

#include "motions/numbers/lanes.h"

#include <gtest/gtest.h>

#include <array>

#include "motions/numbers/float_lanes.h"

namespace kds::lanes_test {
namespace {

using Row = std::array<double, Lanes::width>;
using EightFloats = FloatLanesIn<8>;

[[KDS_LANES_TARGETS]] void scale(const double* row, const Lanes& factor, Lanes& result) {
  result = factor * Lanes(Lanes::load(row));
}
void scale_long(const double* row, const Lanes& factor, Lanes& result) {
  result = factor * Lanes(Lanes::load(row));
}
[[KDS_EIGHT_FLOATS_AVX2]] void add(const float* one, const EightFloats& more, EightFloats& result) {
  result = EightFloats(*one) + more;
}

// Called with values unknown to the compiler, so that they are really passed.

[[gnu::noinline]] void expect_scaled(const Row& row, double factor) {
  Lanes result;
  scale(row.data(), Lanes(factor), result);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(result.v[i], factor * row[static_cast<std::size_t>(i)]) << i;
}
[[gnu::noinline]] void expect_scaled_long(const Row& row, double factor) {
  Lanes result;
  in_long_lanes<&scale_long>(row.data(), Lanes(factor), result);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(result.v[i], factor * row[static_cast<std::size_t>(i)]) << i;
}
[[gnu::noinline]] void expect_sum(float one, float more) {
  EightFloats result(0.0F);
  add(&one, EightFloats(more), result);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(result.v[i], one + more) << i;
}

TEST(Lanes, ArriveInFunctionsForOneTarget) {
  for (const double factor : {2.0, 3.0}) expect_scaled({factor, 2, 3, 4}, factor);
}

TEST(Lanes, ArriveInLongFunctions) {
  for (const double factor : {2.0, 3.0}) expect_scaled_long({factor, 2, 3, 4}, factor);
}

TEST(Lanes, ArriveInFunctionsOfEightFloats) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") == 0) GTEST_SKIP() << "needs AVX2";
#endif
  for (const float more : {2.0F, 3.0F}) expect_sum(1.5F, more);
}

}  // namespace
}  // namespace kds::lanes_test
