#pragma once
// Eight floats that go through the same operations side by side (lanes.h: four doubles): twice the work in
// the same time, where 24 binary digits will do for a proof.

#include <array>
#include <cstddef>

#include "motions/lanes.h"

namespace kds {

class FloatLanes {
 public:
  static constexpr std::size_t width = 8;
  using Vector = float __attribute__((vector_size(32)));
  using Mask = decltype(Vector{} < Vector{});  // of whole numbers: -1 where true, else 0
  using Row = float __attribute__((vector_size(16)));

  Vector v;

  FloatLanes() {}  // left as it is: arrays of lanes are filled right away
  [[gnu::always_inline]] FloatLanes(Vector vector) : v(vector) {}
  [[gnu::always_inline]] explicit FloatLanes(float all) : v{all, all, all, all, all, all, all, all} {}

  [[gnu::always_inline]] FloatLanes& operator+=(const FloatLanes& o) {
    v += o.v;
    return *this;
  }
  [[gnu::always_inline]] FloatLanes& operator-=(const FloatLanes& o) {
    v -= o.v;
    return *this;
  }
  [[gnu::always_inline]] friend FloatLanes operator+(const FloatLanes& a, const FloatLanes& b) {
    return a.v + b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator-(const FloatLanes& a, const FloatLanes& b) {
    return a.v - b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator*(const FloatLanes& a, const FloatLanes& b) {
    return a.v * b.v;
  }
  [[gnu::always_inline]] friend FloatLanes operator-(const FloatLanes& a) { return -a.v; }
  [[gnu::always_inline]] friend Mask operator>(const FloatLanes& a, const FloatLanes& b) { return a.v > b.v; }
  [[gnu::always_inline]] friend Mask operator<=(const FloatLanes& a, const FloatLanes& b) {
    return a.v <= b.v;
  }
  [[gnu::always_inline]] friend Mask operator>=(const FloatLanes& a, const FloatLanes& b) {
    return a.v >= b.v;
  }

  /// As std::max.
  [[gnu::always_inline]] static FloatLanes max(const FloatLanes& a, const FloatLanes& b) {
    return a.v < b.v ? b.v : a.v;
  }
  [[gnu::always_inline]] static FloatLanes abs(const FloatLanes& a) {
    constexpr int m = 0x7fffffff;
    const Mask magnitude{m, m, m, m, m, m, m, m};
    return reinterpret_cast<Vector>(reinterpret_cast<Mask>(a.v) & magnitude);
  }

  /// Four doubles rounded to floats.
  [[gnu::always_inline]] static Row rounded(const Lanes::Vector& four) {
    return __builtin_convertvector(four, Row);
  }
  /// Lane i of the k-th result is number k of row i.
  [[gnu::always_inline]] static std::array<FloatLanes, 4> transposed(const std::array<Row, width>& row) {
    const Vector a = __builtin_shufflevector(row[0], row[4], 0, 1, 2, 3, 4, 5, 6, 7);
    const Vector b = __builtin_shufflevector(row[1], row[5], 0, 1, 2, 3, 4, 5, 6, 7);
    const Vector c = __builtin_shufflevector(row[2], row[6], 0, 1, 2, 3, 4, 5, 6, 7);
    const Vector d = __builtin_shufflevector(row[3], row[7], 0, 1, 2, 3, 4, 5, 6, 7);
    const Vector ab01 = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const Vector ab23 = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const Vector cd01 = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const Vector cd23 = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    return {FloatLanes(__builtin_shufflevector(ab01, cd01, 0, 1, 8, 9, 4, 5, 12, 13)),
            FloatLanes(__builtin_shufflevector(ab01, cd01, 2, 3, 10, 11, 6, 7, 14, 15)),
            FloatLanes(__builtin_shufflevector(ab23, cd23, 0, 1, 8, 9, 4, 5, 12, 13)),
            FloatLanes(__builtin_shufflevector(ab23, cd23, 2, 3, 10, 11, 6, 7, 14, 15))};
  }
};

}  // namespace kds
