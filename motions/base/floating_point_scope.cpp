#include "motions/base/floating_point_scope.h"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace kds {
namespace {

// Setting the environment takes half a microsecond and is nearly always unnecessary, so check first.
bool is_default() {
#ifdef __SSE2__
  constexpr unsigned raised = 0x3f, at_start = 0x1f80;
  return (_mm_getcsr() & ~raised) == at_start;
#else
  return false;
#endif
}

}  // namespace

// The default environment is that at the start of a program: rounding to nearest, no flushing to zero, no
// traps.
FloatingPointScope::FloatingPointScope() : changed_(!is_default()) {
  if (!changed_) return;
  std::fegetenv(&of_host_);
  std::fesetenv(FE_DFL_ENV);
}

FloatingPointScope::~FloatingPointScope() {
  if (changed_) std::fesetenv(&of_host_);
}

}  // namespace kds
