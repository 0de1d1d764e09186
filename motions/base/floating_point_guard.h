#pragma once
// The floating-point environment that filters and proofs need: rounding to nearest, gradual underflow, no
// traps. A host program may have changed it; for example, some libraries are linked so that every program
// which loads them flushes subnormal numbers to zero.
//
// All computations behind public functions of the library run under a guard, including worker threads. Code
// that calls a failure-time search or a filter without a simulator must create a guard itself.

#include <cfenv>

namespace kds {

/// Sets the environment, and restores the host's environment on destruction.
class FloatingPointGuard {
 public:
  FloatingPointGuard();
  ~FloatingPointGuard();
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  bool changed_;
  std::fenv_t of_host_;
};

}  // namespace kds
