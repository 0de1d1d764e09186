#pragma once
// "What properties of a physical model can be exploited to make hierarchy updates faster?" Bounds on how far
// beads move: what each saves.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "experiments/questions/question.h"

namespace kds {

/// How rarely near pairs, found within a skin, must be found anew, by what is known of the motion.
[[nodiscard]] Question ask_about_bounds(const std::filesystem::path& data, std::uint64_t seed,
                                        const std::function<void()>& step_done);
/// What it saves to trust the bases of the wrapped hierarchy for some frames, and how far beads may stick
/// out.
[[nodiscard]] Question ask_about_trust(const std::filesystem::path& data, std::uint64_t seed,
                                       std::size_t rounds, const std::function<void()>& step_done);
[[nodiscard]] std::size_t bounds_steps();
[[nodiscard]] std::size_t trust_steps();

}  // namespace kds
