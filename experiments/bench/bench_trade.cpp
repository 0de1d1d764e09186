#include "experiments/bench/benches.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/bench/bench_chains.h"
#include "experiments/program/timing.h"
#include "motions/scene/straightened_frames.h"
#include "structures/chord_cages/chord_cages.h"
#include "structures/contacts/moving_family.h"
#include "structures/contacts/swept_contacts.h"

namespace kds {

namespace {

/// The required speed of each lever as a multiple of the exact run's. The start of a trajectory's name
/// selects the row.
struct Factors {
  std::string_view name;
  std::optional<double> chord, tight, layered, relaxed, tolerant, more_tolerant;
  double swept;  ///< largest cost of a swept query in static queries
};
constexpr std::array kFactors{Factors{"villin", 5, 3, 13, 2, 2, 2.8, 1.1},
                              Factors{"random100", 3.4, 2, 13, 2, 2, 2.8, 1.1},
                              Factors{"dhodh", 6.5, 1.5, 13, 2, {}, {}, 1.45}};

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
  StructureSettings chord, tight, relaxed;
  chord.between = tight.between = Between::chord;
  tight.tightness = 0.01;
  relaxed.relax = Relaxation::of(0.03);
  return {{{"wrapped, exact events", "wrapped"},
           {"wrapped, chord cages", "wrapped", &Factors::chord, chord},
           {"wrapped, chord cages within 0.01", "wrapped", &Factors::tight, tight},
           {"layered, chord cages", "layered", &Factors::layered},
           {"wrapped, relaxed by 0.03", "wrapped", &Factors::relaxed, relaxed}},
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

// The balls are a quarter larger than those of `--radius auto`, so that some meet. Pairs within four beads
// along the chain are excluded.
void add_swept_contacts(BenchChain chain, std::size_t rounds, std::vector<BenchRow>& rows) {
  for (double& radius : chain.radii) radius *= 1.25;
  const Scene scene = scene_of(chain, FrameMotion::linear);
  std::vector<BezierMotion<3, 1>> steps(scene.step_count(), BezierMotion<3, 1>(scene.bead_count()));
  std::vector<ChordCages<StaticWrappedHierarchy<3>>> cages;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    scene.load(k, steps[k]);
    cages.emplace_back(scene.necklaces(), 1);
    cages.back().move_to(Curves<3>(steps[k]));
  }
  const PairsAsked asked{scene.necklaces(), true, 5, true};
  SweptContacts<3> query(NecklaceTree(scene.necklaces()), asked);
  MovingFamily<3> family(asked, 1);
  FoundPairs found;
  PairsOfBlocks pairs;
  std::size_t kept = 0;  // used, so that the compiler keeps the work
  const auto seconds_over_steps = [&](auto&& of_step) {
    return processor_seconds_of([&] {
      for (std::size_t k = 0; k < steps.size(); ++k) {
        of_step(k, Curves<3>(steps[k]));
        kept += found.pairs.size() + pairs.unclear.size();
      }
    });
  };
  std::vector<double> swept, at_rest, boxes;
  double swept_tests = 0, static_tests = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    swept_tests = static_tests = 0;
    swept.push_back(seconds_over_steps([&](std::size_t k, const Curves<3>& curves) {
      query.find(cages[k].cages(0), cages[k].cages(1), curves, found);
      swept_tests += static_cast<double>(found.tests);
    }));
    at_rest.push_back(seconds_over_steps([&](std::size_t k, const Curves<3>& curves) {
      query.find_static(cages[k].cages(0), curves, 0, found);
      static_tests += static_cast<double>(found.tests);
    }));
    boxes.push_back(seconds_over_steps([&](std::size_t, const Curves<3>& curves) {
      family.find_pairs(curves, MovingFamily<3>::Resting::left_out, false, pairs);
    }));
  }
  const auto beads = static_cast<double>(scene.bead_count() * steps.size());
  const Factors* const factors = factors_of(chain.name);
  const std::optional<double> goal = factors != nullptr ? std::optional(factors->swept) : std::nullopt;
  const auto row = [&](const char* unit, double value, const char* peer, double of_peer,
                       std::optional<double> most) {
    rows.push_back({"swept contacts of a step", chain.name, scene.bead_count(), value / beads, unit,
                    kept > 0 ? peer : "", of_peer / beads, most});
  };
  row("tests/bead", swept_tests, "static query", static_tests, goal);
  for (const auto& [peer, seconds] : {std::pair("static query", at_rest), std::pair("moving boxes", boxes)}) {
    row("ns/bead", median_of(swept) * 1e9, peer, median_of(seconds) * 1e9, std::nullopt);
    rows.back() = with_spread(std::move(rows.back()), swept, 1e9 / beads);
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
    if (chain.dimension == 3) add_swept_contacts(chain, rounds, rows);
    progress(++done, options.trajectories.size());
  }
  return rows;
}

}  // namespace kds
