#include "experiments/bench/bench_kinetic.h"

#include <numeric>

#include "experiments/program/timing.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/static_build.h"

namespace kds {

Scene scene_of(const BenchChain& chain, FrameMotion motion) {
  Trajectory necklace;
  necklace.file = chain.name;
  necklace.frames = chain.frames;
  return {{&necklace, 1}, chain.radii, motion};
}

StepsRun run_all_steps(const Scene& scene, const std::string& structure, const StructureSettings& settings) {
  KineticRun run(scene, {{structure}, Kernel::filtered, AuditMode::none, settings});
  StepsRun steps;
  steps.seconds = processor_seconds_of([&] { run.load_step(); });
  run.build();
  steps.seconds += processor_seconds_of([&] { run.finish(); });
  steps.own = steps.seconds - processor_seconds_of([&] {
                for (std::size_t step = 0; step < scene.step_count(); ++step) run.session().load(step);
              });
  const auto& per_step = run.structures().front()->statistics.events_per_step;
  steps.events = std::accumulate(per_step.begin(), per_step.end(), std::uint64_t{0});
  return steps;
}

namespace {

// Counts the bases that differ from frame to frame in static hierarchies.
template <int Dimension>
std::uint64_t bases_that_change(const BenchChain& chain) {
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(chain.radii.size() - 1)}};
  StaticWrappedHierarchy<Dimension> hierarchy(necklace);
  std::uint64_t changed = 0;
  for (std::size_t k = 0; k < chain.frames.size(); ++k) {
    const Balls<Dimension> balls(chain.frames[k], chain.radii);
    changed += k == 0 ? (hierarchy.build(balls), 0) : hierarchy.update(balls).changed;
  }
  return changed;
}

}  // namespace

void bench_kinetic_steps(const BenchChain& chain, std::size_t rounds, std::optional<double> factor,
                         std::vector<BenchRow>& rows) {
  const Scene scene = scene_of(chain, FrameMotion::linear);
  const NecklaceTree tree(scene.necklaces());
  std::vector<double> ours, peer;
  for (std::size_t round = 0; round < rounds; ++round) {
    ours.push_back(run_all_steps(scene, "wrapped", {}).seconds);
    peer.push_back(0);
    for (std::size_t k = 1; k < chain.frames.size(); ++k)
      peer.back() += (chain.dimension == 2 ? seconds_to_wrap<2>(tree.ranges(), chain.frames[k], chain.radii)
                                           : seconds_to_wrap<3>(tree.ranges(), chain.frames[k], chain.radii))
                         .processor;
  }
  const double nanoseconds = 1e9 / static_cast<double>(tree.node_count() * scene.step_count());
  rows.push_back(
      with_spread({"wrapped kinetic step", chain.name, chain.radii.size(), median_of(ours) * nanoseconds,
                   "ns/node", std::string(sphere_peer), median_of(peer) * nanoseconds,
                   factor ? std::optional(1 / *factor) : std::nullopt},
                  ours, nanoseconds));
}

void bench_kinetic_events(const BenchChain& chain, std::vector<BenchRow>& rows) {
  const std::uint64_t changed =
      chain.dimension == 2 ? bases_that_change<2>(chain) : bases_that_change<3>(chain);
  const auto steps = static_cast<double>(chain.frames.size() - 1);
  const auto row = [&](const char* name, FrameMotion motion) {
    const StepsRun run = run_all_steps(scene_of(chain, motion), "wrapped", {});
    rows.push_back({name, chain.name, chain.radii.size(), static_cast<double>(run.events) / steps,
                    "events/step", "bases that differ", static_cast<double>(changed) / steps, std::nullopt});
  };
  row("wrapped events, linear", FrameMotion::linear);
  row("wrapped events, hermite", FrameMotion::hermite);
}

}  // namespace kds
