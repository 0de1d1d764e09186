#pragma once
// How many threads a computation may use. Results do not depend on it.

#include <cstdint>

namespace kds {

enum class Threads : std::uint8_t { one, all };

}  // namespace kds
