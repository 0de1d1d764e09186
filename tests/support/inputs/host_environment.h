#pragma once
// Floating-point environments that a host program may have set before it calls the library.

#include <xmmintrin.h>

#include <array>
#include <cfenv>

namespace kds::test {

struct HostEnvironment {
  const char* name;
  int rounding;
  unsigned flushing;  ///< flush bits of the control register
};

inline constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
inline constexpr std::array<HostEnvironment, 5> host_environments{
    {{"upward", FE_UPWARD, 0},
     {"downward", FE_DOWNWARD, 0},
     {"towards zero", FE_TOWARDZERO, 0},
     {"flush to zero", FE_TONEAREST, flush_to_zero},
     {"denormals are zero", FE_TONEAREST, flush_to_zero | denormals_are_zero}}};

inline void set(const HostEnvironment& host) {
  std::fesetround(host.rounding);
  _mm_setcsr(_mm_getcsr() | host.flushing);
}

[[nodiscard]] inline bool is_set(const HostEnvironment& host) {
  return std::fegetround() == host.rounding &&
         (_mm_getcsr() & (flush_to_zero | denormals_are_zero)) == host.flushing;
}

}  // namespace kds::test
