#pragma once
// "How can we best integrate the power diagram and the sphere hierarchy so as to get the advantages of each?"
// Measures one way: the hierarchy settles as much as it can down to blocks of beads, and a diagram of the
// remaining beads settles the rest.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "experiments/questions/question.h"

namespace kds {

[[nodiscard]] Question ask_about_combination(const std::filesystem::path& data, std::uint64_t seed,
                                             const std::function<void()>& step_done);
[[nodiscard]] std::size_t combination_steps();

}  // namespace kds
