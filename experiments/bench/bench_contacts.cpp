#include "experiments/bench/bench_contacts.h"

#include <fmt/format.h>

#include <array>

#include "experiments/program/timing.h"
#include "structures/collision/cell_list.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

// Beads of a protein closer than this along the chain are always in contact.
constexpr BeadId along_chain = 5;
constexpr std::size_t fewest_bead_steps = 1'000'000;  // shorter runs are repeated

Scene scene_of(const BenchChain& chain) {
  Trajectory necklace;
  necklace.file = chain.name;
  necklace.frames = chain.frames;
  return {{&necklace, 1}, chain.radii, FrameMotion::linear};
}

SessionOptions options_of_run() {
  SessionOptions options{.structures = {"contacts"}};
  options.settings.apart = along_chain;
  return options;
}

double seconds_of_steps(const Scene& scene) {
  KineticRun run(scene, options_of_run());
  run.build();
  return processor_seconds_of([&] { run.finish(); });
}

double seconds_of_cell_list(const BenchChain& chain) {
  CellList<3> cells(PairsAsked{{{0, static_cast<BeadId>(chain.radii.size() - 1)}}, true, along_chain, true});
  Balls<3> balls(chain.frames.front(), chain.radii);
  (void)cells.pairs(balls);
  return processor_seconds_of([&] {
    for (std::size_t k = 1; k < chain.frames.size(); ++k) {
      balls.move_to(chain.frames[k]);
      (void)cells.pairs(balls);
    }
  });
}

}  // namespace

void bench_contacts(const BenchChain& chain, double radius_factor, std::optional<double> goal,
                    std::size_t rounds, std::vector<BenchRow>& rows) {
  BenchChain larger = chain;
  for (double& radius : larger.radii) radius *= radius_factor;
  const Scene scene = scene_of(larger);
  const std::size_t bead_steps = larger.radii.size() * scene.step_count();
  rounds = std::max(rounds, std::min<std::size_t>(25, fewest_bead_steps / bead_steps));
  std::vector<double> ours, peer;
  for (std::size_t round = 0; round < rounds; ++round) {
    ours.push_back(seconds_of_steps(scene));
    peer.push_back(seconds_of_cell_list(larger));
  }
  const double nanoseconds = 1e9 / static_cast<double>(bead_steps);
  rows.push_back(with_spread(
      {fmt::format("contacts, {} r", radius_factor), chain.name, larger.radii.size(),
       median_of(ours) * nanoseconds, "ns/bead", "cell list", median_of(peer) * nanoseconds, goal},
      ours, nanoseconds));
}

void bench_contacts_growth(std::string_view model, std::size_t beads, std::optional<double> goal,
                           std::size_t rounds, std::vector<BenchRow>& rows) {
  const auto seconds = [&](std::size_t count) {
    const BenchChain chain{std::string(model), jostled_frames(model_at_rest(model, count), 0.01, 3),
                           std::vector<double>(count, 1.0)};
    const Scene scene = scene_of(chain);
    std::vector<double> runs;
    for (std::size_t round = 0; round < rounds; ++round) {
      KineticRun run(scene, options_of_run());
      runs.push_back(processor_seconds_of([&] { run.finish(); }));
    }
    return runs;
  };
  const double nanoseconds = 1e9 / static_cast<double>(2 * beads);
  const std::vector<double> large = seconds(10 * beads), small = seconds(beads);
  rows.push_back(with_spread(
      {"contacts, ten times the beads", std::string(model), 10 * beads, median_of(large) * nanoseconds / 10,
       "ns/bead", fmt::format("the same of {}", beads), median_of(small) * nanoseconds, goal},
      large, nanoseconds / 10));
}

}  // namespace kds
