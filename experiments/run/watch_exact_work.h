#pragma once
// Warns during a run if its exact arithmetic takes unusually long.

#include <functional>
#include <string>

#include "kds/simulator.h"
#include "motions/scene/scene.h"

namespace kds {

/// Number of limb operations at one time of the run that triggers a warning. They take seconds.
inline constexpr std::uint64_t extraordinary_work = 300'000'000;

/// Passes one line to `warn` if the run spends `extraordinary` limb operations at one time: it says where and
/// on what. Warns again only when the total work of the run has doubled.
void watch_exact_work(Simulator& simulator, const Scene& scene,
                      const std::function<void(const std::string&)>& warn,
                      std::uint64_t extraordinary = extraordinary_work);

}  // namespace kds
