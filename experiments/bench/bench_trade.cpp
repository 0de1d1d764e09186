#include "experiments/bench/benches.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/bench/bench_chains.h"
#include "experiments/program/timing.h"
#include "motions/scene/straightened_frames.h"

namespace kds {

namespace {

/// The required speed of each lever as a multiple of the exact run's. The start of a trajectory's name
/// selects the row.
struct Factors {
  std::string_view name;
  std::optional<double> chord, tight, layered, tolerant, more_tolerant;
};
constexpr std::array kFactors{Factors{"villin", 5, 3, 13, 2, 2.8}, Factors{"random100", 3.4, 2, 13, 2, 2.8},
                              Factors{"dhodh", 6.5, 1.5, 13, {}, {}}};

const Factors* factors_of(std::string_view name) {
  const auto* const found = std::ranges::find_if(
      kFactors, [name](const Factors& factors) { return name.starts_with(factors.name); });
  return found == kFactors.end() ? nullptr : found;
}

/// A structure under a lever: its settings in a run, or how far beads may be from their frames.
struct Lever {
  std::string name, structure;
  std::optional<double> Factors::*factor = nullptr;
  StructureSettings settings = {};
  double tolerance = 0;  ///< in radii of the smallest bead
};

/// Returns the levers of each structure. The first entry of each list is the exact run.
std::vector<std::vector<Lever>> levers_by_structure() {
  StructureSettings chord, tight;
  chord.between = tight.between = Between::chord;
  tight.tightness = 0.01;
  return {{{"wrapped, exact events", "wrapped"},
           {"wrapped, chord cages", "wrapped", &Factors::chord, chord},
           {"wrapped, chord cages within 0.01", "wrapped", &Factors::tight, tight},
           {"layered, chord cages", "layered", &Factors::layered}},
          {{"power, exact motion", "power"},
           {"power, within 0.2r", "power", &Factors::tolerant, {}, 0.2},
           {"power, within 0.3r", "power", &Factors::more_tolerant, {}, 0.3}}};
}

// Measures the levers in turn with the exact run. First come rows for the steps alone, which have goals, then
// rows that include the construction of the motion from the frames.
void add_levers(const BenchChain& chain, const std::vector<Lever>& levers, std::size_t rounds,
                std::vector<BenchRow>& rows) {
  const Factors* const factors = factors_of(chain.name);
  std::map<double, Scene> scenes;  // by tolerance; runs with one tolerance share the frames in memory
  for (const Lever& lever : levers) {
    BenchChain frames = chain;
    if (lever.tolerance > 0)
      frames.frames = straightened(
          chain.frames, lever.tolerance * *std::min_element(chain.radii.begin(), chain.radii.end()));
    scenes.try_emplace(lever.tolerance, scene_of(frames, FrameMotion::linear));
  }
  std::vector<std::vector<double>> own(levers.size()), whole(levers.size());
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < levers.size(); ++i) {
      const StepsRun run =
          run_all_steps(scenes.at(levers[i].tolerance), levers[i].structure, levers[i].settings);
      own[i].push_back(run.own);
      whole[i].push_back(run.seconds);
    }
  }
  const auto beads = chain.radii.size();
  const double nanoseconds = 1e9 / static_cast<double>(beads * (chain.frames.size() - 1));
  for (std::size_t i = 1; i < levers.size(); ++i) {
    const std::optional<double> factor =
        factors != nullptr ? factors->*levers[i].factor : std::optional<double>();
    const auto row = [&](const std::string& name, const std::vector<std::vector<double>>& seconds,
                         std::optional<double> most) {
      rows.push_back(with_spread({name, chain.name, beads, median_of(seconds[i]) * nanoseconds, "ns/bead",
                                  levers.front().name, median_of(seconds.front()) * nanoseconds, most},
                                 seconds[i], nanoseconds));
    };
    row(levers[i].name, own, factor ? std::optional(1 / *factor) : std::nullopt);
    row(levers[i].name + ", from frame on", whole, std::nullopt);
  }
}

}  // namespace

std::vector<BenchRow> bench_trade(const TradeBenchOptions& options,
                                  const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<BenchRow> rows;
  std::size_t done = 0;
  for (const std::filesystem::path& path : options.trajectories) {
    const BenchChain chain = read_bench_chain(path);
    const std::size_t rounds = std::max(options.rounds, 200000 / (chain.radii.size() * chain.frames.size()));
    for (const std::vector<Lever>& levers : levers_by_structure()) add_levers(chain, levers, rounds, rows);
    progress(++done, options.trajectories.size());
  }
  return rows;
}

}  // namespace kds
