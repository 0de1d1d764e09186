#pragma once
// Floats that undergo the same operations side by side. Floats serve proofs for which 24 binary digits
// suffice, and do twice the work of the four doubles of lanes.h in the same time. The width is eight or four.
// Four is for processors without vectors of eight floats, which would execute comparisons of eight one by
// one.

#include <array>
#include <cstddef>

#include "motions/numbers/lanes.h"

// Functions on four floats are compiled as long functions (in_long_lanes), because formulas of many numbers
// then keep more values in registers. Functions on eight floats are compiled under a name of their own for
// each kind of processor with long enough vectors. Only code that has checked for such a processor may call
// them. Every version gives the same bits.
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define KDS_EIGHT_FLOATS_AVX2 KDS_FOR_TARGET("avx2")
#define KDS_EIGHT_FLOATS_AVX512 KDS_FOR_TARGET("arch=x86-64-v4")
#else
#define KDS_EIGHT_FLOATS_AVX2 gnu::noinline
#define KDS_EIGHT_FLOATS_AVX512 gnu::noinline
#endif

namespace kds {

namespace detail {

template <std::size_t Width>
struct FloatVector;
template <>
struct FloatVector<4> {
  using Type = float __attribute__((vector_size(16)));
};
template <>
struct FloatVector<8> {
  using Type = float __attribute__((vector_size(32)));
};

}  // namespace detail

template <std::size_t Width>
class FloatLanesIn {
  static_assert(Width == 4 || Width == 8);

 public:
  static constexpr std::size_t width = Width;
  using Vector = typename detail::FloatVector<Width>::Type;
  using Mask = decltype(Vector{} < Vector{});  // lanes of whole numbers: -1 if true, else 0
  using Row = float __attribute__((vector_size(16)));

  Vector v;

  FloatLanesIn() {}  // uninitialized, because arrays of lanes are filled right away
  [[gnu::always_inline]] FloatLanesIn(Vector vector) : v(vector) {}
  /// Fills four floats first: in a function compiled for several targets, g++ 12 fills eight one by one.
  [[gnu::always_inline]] explicit FloatLanesIn(float all) {
    const Row four{all, all, all, all};
    if constexpr (width == 4) {
      v = four;
    } else {
      v = __builtin_shufflevector(four, four, 0, 1, 2, 3, 4, 5, 6, 7);
    }
  }

  [[gnu::always_inline]] FloatLanesIn& operator+=(const FloatLanesIn& o) {
    v += o.v;
    return *this;
  }
  [[gnu::always_inline]] FloatLanesIn& operator-=(const FloatLanesIn& o) {
    v -= o.v;
    return *this;
  }
  [[gnu::always_inline]] friend FloatLanesIn operator+(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v + b.v;
  }
  [[gnu::always_inline]] friend FloatLanesIn operator-(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v - b.v;
  }
  [[gnu::always_inline]] friend FloatLanesIn operator*(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v * b.v;
  }
  [[gnu::always_inline]] friend FloatLanesIn operator-(const FloatLanesIn& a) { return -a.v; }
  [[gnu::always_inline]] friend Mask operator>(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v > b.v;
  }
  [[gnu::always_inline]] friend Mask operator<=(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v <= b.v;
  }
  [[gnu::always_inline]] friend Mask operator>=(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v >= b.v;
  }

  /// Returns the larger of a and b, like std::max.
  [[gnu::always_inline]] static FloatLanesIn max(const FloatLanesIn& a, const FloatLanesIn& b) {
    return a.v < b.v ? b.v : a.v;
  }
  [[gnu::always_inline]] static FloatLanesIn abs(const FloatLanesIn& a) {
    const Mask magnitude = Mask{} + 0x7fffffff;
    return reinterpret_cast<Vector>(reinterpret_cast<Mask>(a.v) & magnitude);
  }

  /// Returns four doubles rounded to floats.
  [[gnu::always_inline]] static Row rounded(const Lanes::Vector& four) {
    return __builtin_convertvector(four, Row);
  }
  /// Transposes rows: lane i of the k-th result is number k of row i.
  [[gnu::always_inline]] static std::array<FloatLanesIn, 4> transposed(const std::array<Row, width>& row) {
    if constexpr (width == 4) {
      const Row ab01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
      const Row ab23 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
      const Row cd01 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
      const Row cd23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
      return {FloatLanesIn(__builtin_shufflevector(ab01, cd01, 0, 1, 4, 5)),
              FloatLanesIn(__builtin_shufflevector(ab01, cd01, 2, 3, 6, 7)),
              FloatLanesIn(__builtin_shufflevector(ab23, cd23, 0, 1, 4, 5)),
              FloatLanesIn(__builtin_shufflevector(ab23, cd23, 2, 3, 6, 7))};
    } else {
      const Vector a = __builtin_shufflevector(row[0], row[4], 0, 1, 2, 3, 4, 5, 6, 7);
      const Vector b = __builtin_shufflevector(row[1], row[5], 0, 1, 2, 3, 4, 5, 6, 7);
      const Vector c = __builtin_shufflevector(row[2], row[6], 0, 1, 2, 3, 4, 5, 6, 7);
      const Vector d = __builtin_shufflevector(row[3], row[7], 0, 1, 2, 3, 4, 5, 6, 7);
      const Vector ab01 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
      const Vector ab23 = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
      const Vector cd01 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
      const Vector cd23 = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
      return {FloatLanesIn(__builtin_shufflevector(ab01, cd01, 0, 1, 8, 9, 4, 5, 12, 13)),
              FloatLanesIn(__builtin_shufflevector(ab01, cd01, 2, 3, 10, 11, 6, 7, 14, 15)),
              FloatLanesIn(__builtin_shufflevector(ab23, cd23, 0, 1, 8, 9, 4, 5, 12, 13)),
              FloatLanesIn(__builtin_shufflevector(ab23, cd23, 2, 3, 10, 11, 6, 7, 14, 15))};
    }
  }
};

using FloatLanes = FloatLanesIn<8>;

}  // namespace kds
