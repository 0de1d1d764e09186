#pragma once
// "Can we prove bounds on the number of combinatorial changes in the wrapped hierarchy, assuming a physical
// model of deformation and a given deformation energy budget?" Measures the number of changes as a function
// of the energy of deformation.h.

#include <cstdint>
#include <filesystem>
#include <functional>

#include "experiments/questions/question.h"

namespace kds {

/// Measures the question. `data` is the data folder with the trajectories. `step_done` is called
/// energy_steps() times.
[[nodiscard]] Question ask_about_energy(const std::filesystem::path& data, std::uint64_t seed,
                                        const std::function<void()>& step_done);
[[nodiscard]] std::size_t energy_steps();

}  // namespace kds
