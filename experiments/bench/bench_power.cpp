#include "experiments/bench/benches.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/bench/bench_chains.h"
#include "experiments/program/timing.h"
#include "structures/power_diagram/diagram_update.h"

namespace kds {

namespace {

constexpr std::string_view peer_name(int dimension) {
  return dimension == 2 ? "CGAL Regular_triangulation_2" : "CGAL Regular_triangulation_3";
}

struct PowerInput {
  std::string name;
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> weights;
  int dimension;
  std::optional<double> goal;  ///< largest ratio of the kinetic step's time to the peer's

  PowerInput(BenchChain chain, std::optional<double> time)
      : name(std::move(chain.name)),
        frames(std::move(chain.frames)),
        weights(std::move(chain.radii)),
        dimension(chain.dimension),
        goal(time) {
    for (double& w : weights) w *= w;
  }
};

/// All techniques except rebuilding, with which they are compared. The automatic technique comes last,
/// because it is compared with the best of the others.
constexpr std::array techniques{UpdateTechnique::reinsert, UpdateTechnique::greedy,
                                UpdateTechnique::kinetic,  UpdateTechnique::lifted,
                                UpdateTechnique::activate, UpdateTechnique::automatic};

template <int Dimension>
double seconds_in(UpdateTechnique technique, const PowerInput& input) {
  const auto update = make_diagram_update<Dimension>(technique);
  update->build(input.frames[0], input.weights);
  return processor_seconds_of([&] {
    for (std::size_t k = 1; k < input.frames.size(); ++k)
      static_cast<void>(update->advance(input.frames[k], input.weights));
  });
}

double seconds_by(UpdateTechnique technique, const PowerInput& input) {
  return input.dimension == 2 ? seconds_in<2>(technique, input) : seconds_in<3>(technique, input);
}

// One round runs once over all frames with each technique, the peer first.
void measure(const PowerInput& input, std::size_t rounds, std::vector<BenchRow>& rows) {
  std::vector<double> peer;
  std::map<UpdateTechnique, std::vector<double>> ours;
  for (std::size_t round = 0; round < rounds; ++round) {
    peer.push_back(seconds_by(UpdateTechnique::rebuild, input));
    for (const UpdateTechnique t : techniques) ours[t].push_back(seconds_by(t, input));
  }
  const double microseconds = 1e6 / static_cast<double>(input.frames.size() - 1);
  const double cgal = median_of(peer) * microseconds;
  const auto row = [&](std::string name, const std::vector<double>& seconds, std::string_view other,
                       double other_value, std::optional<double> goal) {
    rows.push_back(
        with_spread({std::move(name), input.name, input.weights.size(), median_of(seconds) * microseconds,
                     "us/frame", std::string(other), other_value, goal},
                    seconds, microseconds));
  };
  double best = cgal;
  UpdateTechnique best_technique = UpdateTechnique::rebuild;
  for (const UpdateTechnique t : techniques) {
    const double value = median_of(ours[t]) * microseconds;
    if (t == UpdateTechnique::automatic) {
      row("auto to rebuild", ours[t], peer_name(input.dimension), cgal, 1.05);
      row("auto to best", ours[t], name_of(best_technique), best, 1.1);
      continue;
    }
    row(std::string(name_of(t)), ours[t], peer_name(input.dimension), cgal,
        t == UpdateTechnique::kinetic ? input.goal : std::nullopt);
    if (value < best) {
      best = value;
      best_technique = t;
    }
  }
}

double seconds_to_build_frames(const PowerInput& input) {
  const auto build = [&]<int Dimension>() {
    const auto update = make_diagram_update<Dimension>(UpdateTechnique::rebuild);
    return processor_seconds_of([&] {
      update->build(input.frames[0], input.weights);
      for (std::size_t k = 1; k < input.frames.size(); ++k)
        static_cast<void>(update->advance(input.frames[k], input.weights));
    });
  };
  return input.dimension == 2 ? build.template operator()<2>() : build.template operator()<3>();
}

void measure_regular(const PowerInput& input, std::size_t rounds, std::vector<BenchRow>& rows) {
  std::vector<double> peer, ours;
  for (std::size_t round = 0; round < rounds; ++round) {
    peer.push_back(seconds_to_build_frames(input));
    ours.push_back(seconds_by(UpdateTechnique::kinetic, input));
  }
  rows.push_back(with_spread(
      {"regular", input.name, input.weights.size(), 1e6 * median_of(ours), "us/frame",
       fmt::format("{} at both frames", peer_name(input.dimension)), 1e6 * median_of(peer), input.goal},
      ours, 1e6));
}

/// Returns the goal for the kinetic step on a trajectory. The start of the trajectory's name selects the
/// goal.
std::optional<double> goal_of(std::string_view name) {
  if (name.starts_with("random100") || name.starts_with("villin")) return 1 / 2.5;
  if (name.starts_with("dhodh")) return 1.0;
  return std::nullopt;
}

PowerInput read_input(const std::filesystem::path& path, std::size_t stride) {
  BenchChain chain = read_bench_chain(path, stride);
  const auto goal = stride == 1 ? goal_of(chain.name) : std::nullopt;
  return PowerInput(std::move(chain), goal);
}

}  // namespace

std::vector<BenchRow> bench_power(const PowerBenchOptions& options,
                                  const std::function<void(std::size_t, std::size_t)>& progress) {
  constexpr std::array<std::size_t, 4> strides{1, 4, 16, 64};
  std::vector<std::function<PowerInput()>> inputs;
  for (const std::filesystem::path& path : options.trajectories) {
    for (const std::size_t stride : strides) inputs.emplace_back([=] { return read_input(path, stride); });
  }
  const auto add = [&](const char* name, const auto& start, double step, int dimension,
                       std::optional<double> goal) {
    inputs.emplace_back([=] {
      BenchChain chain{
          fmt::format("{} {} r", name, step), jostled_frames(start(), step, 9, dimension), {}, dimension};
      chain.radii.assign(static_cast<std::size_t>(chain.frames[0].cols()), 1.0);
      return PowerInput(std::move(chain), goal);
    });
  };
  const auto add_chain = [&](const char* name, const auto& start, double step, double factor) {
    add(name, start, step, 3, 1 / factor);
  };
  for (const std::size_t beads : options.sizes) {
    const auto chain = [=] { return model_at_rest("random-chain", beads); };
    const auto grid = [=](double jitter) { return [=] { return model_at_rest("grid", beads, jitter); }; };
    add_chain("random-chain", chain, 0.01, 4.5);
    add_chain("random-chain", chain, 0.1, 4);
    add_chain("grid jitter 0.5 r", grid(0.5), 0.1, 2.2);
    add_chain("grid jitter 0.05 r", grid(0.05), 0.1, 2.2);  // nearly cubes: many balls lie on one sphere
    add(
        "planar grid jitter 0.5 r", [=] { return model_at_rest("grid", beads, 0.5, 2); }, 0.1, 2,
        std::nullopt);
    add(
        "planar spiral", [=] { return planar_spiral(beads); }, 0.01, 2, std::nullopt);
  }
  std::vector<std::function<PowerInput()>> regular;
  for (const std::size_t beads : options.regular) {
    const auto scene = [&](const char* name, const auto& frames) {
      regular.emplace_back([=] {
        BenchChain chain{name, frames(), {}, 3};
        chain.radii.assign(static_cast<std::size_t>(chain.frames[0].cols()), 1.0);
        return PowerInput(std::move(chain), 30.0);
      });
    };
    for (const char* model : {"grid", "helix", "grill"})
      scene(model, [=] { return rotating_frames(model, beads); });
    scene("grid, one bead moves", [=] { return grid_with_one_moving(beads); });
  }
  std::vector<BenchRow> rows;
  std::size_t done = 0;
  const std::size_t all = inputs.size() + regular.size();
  for (const auto& make : regular) {
    measure_regular(make(), options.rounds, rows);
    progress(++done, all);
  }
  for (const auto& make : inputs) {
    const PowerInput input = make();
    // A stride may leave only one frame, and then there is nothing to measure. Short rounds are repeated.
    if (input.frames.size() > 1) {
      measure(input, std::max(options.rounds, 20000 / (input.weights.size() * input.frames.size())), rows);
    }
    progress(++done, all);
  }
  return rows;
}

}  // namespace kds
