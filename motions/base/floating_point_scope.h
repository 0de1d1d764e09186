#pragma once
// The properties of compiler and processor that all filters and proofs rely on: each operation on doubles is
// rounded to nearest, with gradual underflow and without traps, and no operation is replaced by one that is
// equal only for real numbers.

#include <cfenv>
#include <cmath>
#include <stdexcept>

#if defined(__FAST_MATH__)
#error "kds: compiled with -ffast-math; its error bounds hold only without"
#endif

namespace kds {

/// Sets the floating-point environment, and restores the host's environment on destruction. A host program
/// may have changed the environment; for example, some libraries are linked so that every program which loads
/// them flushes subnormal numbers to zero.
///
/// All computations behind public functions of the library run in such a scope, including those of worker
/// threads. Code that calls a failure-time search or a filter without a simulator must create a scope itself.
class FloatingPointScope {
 public:
  FloatingPointScope();
  ~FloatingPointScope();
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  bool changed_;
  std::fenv_t of_host_;
};

/// Returns the number, a control point. Throws std::invalid_argument if it is infinite or a NaN: these have
/// no exact value, so certificates over them would have no function.
[[nodiscard]] inline double finite(double value) {
  if (!std::isfinite(value)) [[unlikely]]
    throw std::invalid_argument("a control point is not a finite number");
  return value;
}

}  // namespace kds
