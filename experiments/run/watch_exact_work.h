#pragma once
// A run that leaves the ordinary says so while it goes on.

#include <functional>
#include <string>

#include "kds/simulator.h"
#include "motions/scene/scene.h"

namespace kds {

/// From so many limb operations at one time of the run on it is told of: seconds.
inline constexpr std::uint64_t extraordinary_work = 300'000'000;

/// Tells `warn`, one line, where and on what a run works that long; again only when all its work has doubled.
void watch_exact_work(Simulator& simulator, const Scene& scene,
                      const std::function<void(const std::string&)>& warn,
                      std::uint64_t extraordinary = extraordinary_work);

}  // namespace kds
