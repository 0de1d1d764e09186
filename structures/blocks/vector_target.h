#pragma once
// Selects the vector instructions of collision detection's inner loops. The choice is made when a detector is
// constructed. All targets give the same results.

#include <array>
#include <string_view>

namespace kds {

enum class VectorTarget { plain, avx2, avx512 };
/// Names of the targets, in the order of the enumerators.
inline constexpr std::array<std::string_view, 3> vector_target_names{"plain", "AVX2", "AVX-512"};

/// Returns whether both this processor and this build support the target.
[[nodiscard]] bool is_available(VectorTarget target);
[[nodiscard]] VectorTarget widest_vector_target();

}  // namespace kds
