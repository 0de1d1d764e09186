#pragma once
// The rows of `kds bench hierarchies` about the kinetic wrapped hierarchy. They compare a step with exact
// event times with CGAL's Min_sphere_of_spheres_d at every node. They also compare the number of events with
// the number of bases that differ from frame to frame.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/bench_report.h"
#include "motions/scene/scene.h"
#include "structures/session/structure_spec.h"

namespace kds {

/// Processor seconds and events of all steps.
struct StepsRun {
  double seconds = 0;  ///< including the construction of motions from frames
  double own = 0;      ///< `seconds` minus the time to load the same steps again: engine and structure alone
  std::uint64_t events = 0;
};

[[nodiscard]] Scene scene_of(const BenchChain& chain, FrameMotion motion);
/// Runs all steps of a scene with one structure. The build at the first frame is not timed.
[[nodiscard]] StepsRun run_all_steps(const Scene& scene, const std::string& structure,
                                     const StructureSettings& settings);

inline constexpr std::string_view sphere_peer = "CGAL Min_sphere_of_spheres_d";

/// Adds rows for linear motion. `factor`, if given, is the goal: how many times as fast as the peer a step
/// should be. A step includes the construction of its motion from the frames.
void bench_kinetic_steps(const BenchChain& chain, std::size_t rounds, std::optional<double> factor,
                         std::vector<BenchRow>& rows);

/// Adds rows for linear and for Hermite motion.
void bench_kinetic_events(const BenchChain& chain, std::vector<BenchRow>& rows);

}  // namespace kds
