#pragma once
// Operations beyond arithmetic that formulas need, for a single double and for four in lanes.

#include <algorithm>
#include <cmath>
#include <concepts>

#include "motions/numbers/lanes.h"

namespace kds {

template <class N>
concept LanesOrDouble = std::same_as<N, double> || std::same_as<N, Lanes>;

template <LanesOrDouble N>
struct NumberTraits;

template <>
struct NumberTraits<double> {
  using Flag = bool;
  [[gnu::always_inline]] static double choose(bool flag, double a, double b) { return flag ? a : b; }
  [[gnu::always_inline]] static double max(double a, double b) { return a < b ? b : a; }
  [[gnu::always_inline]] static double min(double a, double b) { return b < a ? b : a; }
  [[gnu::always_inline]] static double abs(double a) { return std::abs(a); }
  [[gnu::always_inline]] static double sqrt(double a) { return std::sqrt(a); }
};

template <>
struct NumberTraits<Lanes> {
  using Flag = Lanes::Mask;
  [[gnu::always_inline]] static Lanes choose(const Flag& flag, const Lanes& a, const Lanes& b) {
    return Lanes::choose(flag, a, b);
  }
  [[gnu::always_inline]] static Lanes max(const Lanes& a, const Lanes& b) { return Lanes::max(a, b); }
  [[gnu::always_inline]] static Lanes min(const Lanes& a, const Lanes& b) { return Lanes::min(a, b); }
  [[gnu::always_inline]] static Lanes abs(const Lanes& a) { return Lanes::abs(a); }
  [[gnu::always_inline]] static Lanes sqrt(const Lanes& a) {
    // Built from all lanes at once, which compiles to a single instruction if the target allows it.
    return Lanes::Vector{std::sqrt(a.v[0]), std::sqrt(a.v[1]), std::sqrt(a.v[2]), std::sqrt(a.v[3])};
  }
};

}  // namespace kds
