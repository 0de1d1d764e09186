#pragma once
// Which instructions the inner loops of collision detection use: chosen when a detector is made, all with the
// same results.

#include <array>
#include <string_view>

namespace kds {

enum class VectorTarget { plain, avx2, avx512 };
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 3> vector_target_names{"plain", "AVX2", "AVX-512"};

/// Whether this processor has them, and this build.
[[nodiscard]] bool is_available(VectorTarget target);
[[nodiscard]] VectorTarget widest_vector_target();

}  // namespace kds
