#pragma once
// Counts what this process allocates: every operator new, and what GMP asks for.

#include <cstdint>

namespace kds::bench {

[[nodiscard]] std::uint64_t allocations();

}  // namespace kds::bench
