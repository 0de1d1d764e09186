#pragma once
// Number of threads of a computation. Results do not depend on it.

#include <cstdint>

namespace kds {

enum class Threads : std::uint8_t { one, all };

}  // namespace kds
