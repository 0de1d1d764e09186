#pragma once
// Four doubles that undergo the same operations side by side (SIMD), each rounded like an ordinary double.
// Functions marked KDS_LANES_TARGETS are compiled for AVX2 if the build defines KDS_NEEDS_AVX2. Otherwise
// they are compiled twice, with and without AVX2, and the right version is selected when the program starts.
// Every version gives the same bits. Builds with the address sanitizer compile them only once, to keep
// compile times bearable.

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "motions/base/floating_point_scope.h"

namespace kds {

// Code compiled for another target passes vectors by another calling convention. Everything called from such
// a function must therefore be inlined into it, and callers must pass lanes by reference. The function must
// also not be cloned: g++ 14 makes a clone that takes the vector by value (-fipa-sra), and callers store the
// vector where the clone does not read.
#define KDS_FOR_TARGET(name) gnu::target(name), gnu::flatten, gnu::noinline, gnu::noclone
#if defined(__x86_64__) && defined(__OPTIMIZE__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define KDS_LANES_ARE_COMPILED_FOR_TARGETS 1
#ifdef KDS_NEEDS_AVX2
#define KDS_LANES_TARGETS KDS_FOR_TARGET("avx2")
#else
#define KDS_LANES_TARGETS gnu::target_clones("avx2", "default"), gnu::flatten, gnu::noinline
#endif
#else
#define KDS_LANES_ARE_COMPILED_FOR_TARGETS 0
#define KDS_LANES_TARGETS gnu::noinline
#endif

// The alignment must be explicit: g++ may access lanes by aligned loads and stores, but code compiled for a
// target without AVX would not align them.
class alignas(32) Lanes {
 public:
  static constexpr std::size_t width = 4;
  using Vector = double __attribute__((vector_size(32)));
  using Mask = decltype(Vector{} < Vector{});  // lanes of whole numbers: -1 if true, else 0

  Vector v;

  Lanes() {}  // uninitialized, because arrays of lanes are filled right away
  [[gnu::always_inline]] Lanes(Vector vector) : v(vector) {}
  [[gnu::always_inline]] explicit Lanes(double all) : v{all, all, all, all} {}

  [[gnu::always_inline]] Lanes& operator+=(const Lanes& o) {
    v += o.v;
    return *this;
  }
  [[gnu::always_inline]] Lanes& operator-=(const Lanes& o) {
    v -= o.v;
    return *this;
  }
  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) { return a.v + b.v; }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) { return a.v - b.v; }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) { return a.v * b.v; }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) { return a.v / b.v; }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) { return -a.v; }
  [[gnu::always_inline]] friend Mask operator<(const Lanes& a, const Lanes& b) { return a.v < b.v; }
  [[gnu::always_inline]] friend Mask operator>(const Lanes& a, const Lanes& b) { return a.v > b.v; }
  [[gnu::always_inline]] friend Mask operator<=(const Lanes& a, const Lanes& b) { return a.v <= b.v; }
  [[gnu::always_inline]] friend Mask operator>=(const Lanes& a, const Lanes& b) { return a.v >= b.v; }

  /// Returns a in the lanes where the mask is true, else b.
  [[gnu::always_inline]] static Lanes choose(const Mask& mask, const Lanes& a, const Lanes& b) {
    return mask ? a.v : b.v;
  }
  /// Returns the larger of a and b, like std::max: a unless a < b. A NaN in a is therefore kept.
  [[gnu::always_inline]] static Lanes max(const Lanes& a, const Lanes& b) { return choose(a < b, b, a); }
  [[gnu::always_inline]] static Lanes min(const Lanes& a, const Lanes& b) { return choose(b < a, b, a); }
  [[gnu::always_inline]] static Lanes abs(const Lanes& a) {
    const Mask magnitude{0x7fffffffffffffffLL, 0x7fffffffffffffffLL, 0x7fffffffffffffffLL,
                         0x7fffffffffffffffLL};
    return reinterpret_cast<Vector>(reinterpret_cast<Mask>(a.v) & magnitude);
  }
  [[gnu::always_inline]] static Lanes sqrt(const Lanes& a) {
    return Vector{__builtin_sqrt(a.v[0]), __builtin_sqrt(a.v[1]), __builtin_sqrt(a.v[2]),
                  __builtin_sqrt(a.v[3])};
  }
  /// Transposes four rows of four numbers: lane i of the k-th result is number k of row i.
  [[gnu::always_inline]] static std::array<Lanes, 4> transposed(const double* row0, const double* row1,
                                                                const double* row2, const double* row3) {
    const Vector a = load(row0), b = load(row1), c = load(row2), d = load(row3);
    const Vector ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Vector ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Vector cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Vector cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    return {Lanes(__builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5)),
            Lanes(__builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5)),
            Lanes(__builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7)),
            Lanes(__builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7))};
  }
  [[gnu::always_inline]] static Vector load(const double* four) {
    Vector v;
    __builtin_memcpy(&v, four, sizeof v);
    return v;
  }
  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) { return Lanes::abs(a); }
  [[gnu::always_inline]] static bool any(const Mask& mask) {
    return ((mask[0] | mask[1]) | (mask[2] | mask[3])) != 0;
  }
  [[gnu::always_inline]] static bool all(const Mask& mask) {
    return ((mask[0] & mask[1]) & (mask[2] & mask[3])) != 0;
  }
};

/// Returns whether the processor supports x86-64-v4, that is AVX-512 with twice as many vector registers.
[[nodiscard]] inline bool processor_has_avx512() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

/// Returns a sentence that names the instructions which the libraries need and this processor lacks, or
/// nothing if the libraries can run here. On a processor that lacks them, a function on lanes would
/// crash.
[[nodiscard]] std::optional<std::string> missing_in_processor();

// Long functions on lanes, each compiled in one file. These functions are compiled like KDS_LANES_TARGETS and
// once more for processors with AVX-512, which have twice the registers. Every version gives the same bits.

namespace detail {

inline const bool here_is_avx512 = processor_has_avx512();  // cached, since the check is slow

template <auto function>
struct LongLanes;
/// `function` is inlined into each version, so it must not be marked noinline itself.
template <class... P, void (*function)(P...)>
struct LongLanes<function> {
#if KDS_LANES_ARE_COMPILED_FOR_TARGETS && defined(KDS_NEEDS_AVX2)
  [[KDS_FOR_TARGET("avx2")]] static void with_avx2(P... arguments) { function(arguments...); }
  [[KDS_FOR_TARGET("arch=x86-64-v4")]] static void with_avx512(P... arguments) { function(arguments...); }
  static void call(P... arguments) { here_is_avx512 ? with_avx512(arguments...) : with_avx2(arguments...); }
#elif KDS_LANES_ARE_COMPILED_FOR_TARGETS
  [[gnu::target_clones("arch=x86-64-v4", "avx2", "default"), gnu::flatten, gnu::noinline]] static void call(
      P... arguments) {
    function(arguments...);
  }
#else
  static void call(P... arguments) { function(arguments...); }
#endif
};

}  // namespace detail

/// Calls `function` in the version for this processor. The parameters of `function` must be references, spans
/// or numbers.
template <auto function>
inline constexpr auto in_long_lanes = &detail::LongLanes<function>::call;

}  // namespace kds
