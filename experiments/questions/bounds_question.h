#pragma once
// "What properties of a physical model can be exploited to make hierarchy updates faster?" Measures how much
// work bounds on the motion of beads save.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "experiments/questions/question.h"

namespace kds {

/// Measures how rarely near pairs, found within a skin, must be found again, depending on the known bound on
/// the motion.
[[nodiscard]] Question ask_about_bounds(const std::filesystem::path& data, std::uint64_t seed,
                                        const std::function<void()>& step_done);
/// Measures the work saved by trusting the bases of the wrapped hierarchy for several frames, and how far
/// beads may then stick out.
[[nodiscard]] Question ask_about_trust(const std::filesystem::path& data, std::uint64_t seed,
                                       std::size_t rounds, const std::function<void()>& step_done);
[[nodiscard]] std::size_t bounds_steps();
[[nodiscard]] std::size_t trust_steps();

}  // namespace kds
