#pragma once
// "Can we prove bounds on the number of combinatorial changes in the wrapped hierarchy, assuming a physical
// model of deformation and a given deformation energy budget?" How many changes there are, by the energy of
// deformation.h.

#include <cstdint>
#include <filesystem>
#include <functional>

#include "experiments/questions/question.h"

namespace kds {

/// `data`: the folder of that name, for trajectories. `step_done` is called so often as energy_steps says.
[[nodiscard]] Question ask_about_energy(const std::filesystem::path& data, std::uint64_t seed,
                                        const std::function<void()>& step_done);
[[nodiscard]] std::size_t energy_steps();

}  // namespace kds
