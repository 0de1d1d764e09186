#pragma once
// Counts the allocations of this process through every operator new and through GMP.

#include <cstdint>

namespace kds::bench {

[[nodiscard]] std::uint64_t allocations();

}  // namespace kds::bench
