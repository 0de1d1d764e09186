#pragma once
// The floating-point environment that filters and proofs need: rounding to nearest, underflow that is
// gradual, no traps. A host may have set another: some libraries are linked such that all that loads them
// flushes what is tiny to zero.
//
// Whatever computes behind a public function of the library runs under a guard, worker threads too. Who calls
// a search of failure times or a filter without a simulator sets up one for itself.

#include <cfenv>

namespace kds {

/// Sets the environment, and puts the host's back at the end of its life.
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
