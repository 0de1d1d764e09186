#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/benches.h"
#include "experiments/program/timing.h"
#include "motions/models/model.h"
#include "structures/hierarchy/layered_hierarchy.h"
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
                for (std::size_t step = 0; step < scene.step_count(); ++step) run.motion()->load(step);
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
      peer.back() += processor_seconds_per_call(
          chain.dimension == 2 ? spheres_by_cgal<2>(tree.ranges(), chain.frames[k], chain.radii)
                               : spheres_by_cgal<3>(tree.ranges(), chain.frames[k], chain.radii));
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

namespace {

struct HierarchyInput : BenchChain {
  // Required factors.
  double build = 6, update = 10, trust = 25;
  std::optional<double> kinetic = std::nullopt;
};

// Every third bead is a fifth smaller, every seventh a tenth. Only half of each factor is required.
HierarchyInput with_unequal_radii(HierarchyInput input) {
  for (std::size_t b = 0; b < input.radii.size(); ++b) {
    if (b % 3 == 0) input.radii[b] *= 0.8;
    if (b % 7 == 0) input.radii[b] *= 0.9;
  }
  input.name += " unequal";
  for (double* factor : {&input.build, &input.update, &input.trust}) *factor /= 2;
  if (input.kinetic) *input.kinetic /= 2;
  return input;
}

/// Returns the required factor of the kinetic step on a trajectory. The start of the trajectory's name
/// selects the factor.
std::optional<double> kinetic_factor(std::string_view name) {
  if (name.starts_with("random100") || name.starts_with("villin")) return 4;
  if (name.starts_with("dhodh")) return 1.5;
  return std::nullopt;
}

template <int Dimension>
class MeasuredHierarchies {
 public:
  MeasuredHierarchies(const HierarchyInput& input, std::vector<BenchRow>& rows) : input_(input), rows_(rows) {
    const BeadRange all{0, static_cast<BeadId>(input.radii.size() - 1)};
    necklace_ = {all};
    for (const Eigen::Matrix3Xd& frame : input.frames) balls_.emplace_back(frame, input.radii);
  }

  /// One round runs once over all frames with each hierarchy, then with the peer.
  void run(std::size_t rounds) {
    StaticWrappedHierarchy<Dimension> built(necklace_), updated(necklace_), naive(necklace_),
        cascade(necklace_), trusting(necklace_);
    LayeredHierarchy<Dimension> layered(necklace_);
    std::vector<double> peer, build, layer, update, by_naive, by_cascade, trust;
    const std::span<const Balls<Dimension>> later = std::span(balls_).subspan(1);
    const auto over_frames = [&](auto& hierarchy, auto&& step) {
      if constexpr (requires { hierarchy.update(balls_[0]); }) hierarchy.build(balls_[0]);
      return processor_seconds_of([&] {
        for (const Balls<Dimension>& now : later) step(hierarchy, now);
      });
    };
    for (std::size_t round = 0; round < rounds; ++round) {
      build.push_back(over_frames(built, [](auto& h, const auto& now) { h.build(now); }));
      layer.push_back(over_frames(layered, [](auto& h, const auto& now) { h.build(now); }));
      update.push_back(over_frames(updated, [](auto& h, const auto& now) { h.update(now); }));
      by_naive.push_back(over_frames(naive, [](auto& h, const auto& now) { h.update(now, Update::naive); }));
      by_cascade.push_back(
          over_frames(cascade, [](auto& h, const auto& now) { h.update(now, Update::cascade); }));
      trust.push_back(over_frames(trusting, [](auto& h, const auto& now) { h.update(now, Update::trust); }));
      peer.push_back(0);
      for (std::size_t k = 1; k < balls_.size(); ++k)
        peer.back() += processor_seconds_per_call(
            spheres_by_cgal<Dimension>(built.tree().ranges(), input_.frames[k], input_.radii));
    }
    const double nodes = static_cast<double>(built.tree().node_count() * later.size());
    const double cgal = median_of(peer) / nodes * 1e9;
    const auto row = [&](const char* name, const std::vector<double>& seconds, std::optional<double> factor) {
      rows_.push_back(
          with_spread({name, input_.name, input_.radii.size(), median_of(seconds) / nodes * 1e9, "ns/node",
                       std::string(sphere_peer), cgal, factor ? std::optional(1 / *factor) : std::nullopt},
                      seconds, 1e9 / nodes));
    };
    row("wrapped build", build, input_.build);
    row("wrapped update", update, input_.update);
    row("wrapped update, naive", by_naive, std::nullopt);
    row("wrapped update, cascade", by_cascade, std::nullopt);
    row("wrapped trusted update", trust, input_.trust);
    rows_.push_back(with_spread({"layered build", input_.name, input_.radii.size(),
                                 median_of(layer) / nodes * 1e9, "ns/node", "", std::nullopt, 10.0},
                                layer, 1e9 / nodes));
  }

 private:
  const HierarchyInput& input_;
  std::vector<BenchRow>& rows_;
  std::vector<BeadRange> necklace_;
  std::vector<Balls<Dimension>> balls_;
};

// The frames show a rigid rotation. All events come from the linear motion between frames, which squeezes the
// chain.
BenchChain rotating_chain(std::size_t beads) {
  const models::Settings settings{.beads = beads, .frames = 20, .motion = models::ShapeMotion::rotate};
  return {"rotating random-chain",
          models::generate(*models::find_model("random-chain"), settings).front().frames,
          std::vector<double>(beads, 1.0)};
}

// Compares all threads with one thread by wall-clock time.
void all_threads(std::size_t beads, std::size_t rounds, std::vector<BenchRow>& rows) {
  const auto frames = jostled_frames(model_at_rest("random-chain", beads), 0.01, 2);
  const std::vector<double> radii(beads, 1.0);
  const std::array<Balls<3>, 2> balls{Balls<3>(frames[0], radii), Balls<3>(frames[1], radii)};
  const std::vector<BeadRange> necklace{{0, static_cast<BeadId>(beads - 1)}};
  StaticWrappedHierarchy<3> hierarchy(necklace);
  std::array<std::vector<double>, 2> build, update;  // on one thread, on all threads
  for (std::size_t round = 0; round < rounds; ++round) {
    for (const Threads threads : {Threads::one, Threads::all}) {
      const std::size_t all = threads == Threads::all ? 1 : 0;
      build[all].push_back(seconds_of<WallClock>([&] { hierarchy.build(balls[0], threads); }));
      update[all].push_back(
          seconds_of<WallClock>([&] { hierarchy.update(balls[1], Update::blocks, threads); }));
    }
  }
  const double nanoseconds = 1e9 / static_cast<double>(hierarchy.tree().node_count());
  const auto row = [&](const char* name, const std::array<std::vector<double>, 2>& seconds) {
    rows.push_back(with_spread({name, "random-chain", beads, median_of(seconds[1]) * nanoseconds, "ns/node",
                                "one thread", median_of(seconds[0]) * nanoseconds, std::nullopt},
                               seconds[1], nanoseconds));
  };
  row("wrapped build, all threads", build);
  row("wrapped update, all threads", update);
}

// Two distant necklaces. A query examines only the two roots, so this is the total cost of a frame.
void lazy_query(std::size_t beads, std::size_t rounds, std::vector<BenchRow>& rows) {
  const Eigen::Matrix3Xd helix = model_at_rest("helix", beads);
  Eigen::Matrix3Xd both(3, 2 * helix.cols());
  const double apart_by = 10 * (helix.rowwise().maxCoeff() - helix.rowwise().minCoeff()).norm();
  both << helix, helix.colwise() + Eigen::Vector3d(apart_by, 0, 0);
  const std::vector<double> radii(static_cast<std::size_t>(both.cols()), 1.0);
  const auto n = static_cast<BeadId>(beads);
  const std::vector<BeadRange> necklaces{{0, n - 1}, {n, 2 * n - 1}};
  StaticWrappedHierarchy<3> hierarchy(necklaces);
  const Balls<3> balls(both, radii);
  hierarchy.build(balls);
  const NodeId second = *hierarchy.tree().find(necklaces[1]);
  std::vector<double> ours, peer;
  double apart = 0;  // used, so that the compiler keeps the work
  for (std::size_t round = 0; round < rounds; ++round) {
    ours.push_back(processor_seconds_per_call([&] {
      hierarchy.update(balls, Update::lazy);
      const Sphere a = hierarchy.sphere(0), b = hierarchy.sphere(second);
      apart += (a.center - b.center).norm() - a.radius - b.radius;
    }));
    peer.push_back(processor_seconds_per_call(spheres_by_cgal<3>(hierarchy.tree().ranges(), both, radii)));
  }
  rows.push_back(
      with_spread({"lazy update and query", "far helices", radii.size(), median_of(ours) * 1e9, "ns/frame",
                   apart > 0 ? std::string(sphere_peer) : "", median_of(peer) * 1e9, 1.0 / 25},
                  ours, 1e9));
}

}  // namespace

std::vector<BenchRow> bench_hierarchies(const HierarchyBenchOptions& options,
                                        const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<std::function<HierarchyInput()>> inputs;
  for (const std::filesystem::path& path : options.trajectories) {
    inputs.emplace_back([path] {
      HierarchyInput input{read_bench_chain(path)};
      input.kinetic = kinetic_factor(input.name);
      return input;
    });
  }
  for (const std::size_t beads : options.sizes) {
    const auto add_planar = [&](const char* name, const auto& start) {
      inputs.emplace_back([=] {
        return HierarchyInput{
            {name, jostled_frames(start(), 0.01, 20, 2), std::vector<double>(beads, 1.0), 2}};
      });
    };
    for (const char* model : {"helix", "random-chain", "grid"}) {
      inputs.emplace_back([name = std::string(model), beads] {
        HierarchyInput input{
            {name, jostled_frames(model_at_rest(name, beads), 0.01, 20), std::vector<double>(beads, 1.0)}};
        if (name == "random-chain") {
          input.update = 18;
          input.kinetic = 10;
        }
        return input;
      });
    }
    add_planar("planar grid", [=] { return model_at_rest("grid", beads, 0.05, 2); });
    add_planar("planar spiral", [=] { return planar_spiral(beads); });
  }
  std::vector<BenchRow> rows;
  std::size_t done = 0;
  for (const auto& make : inputs) {
    const HierarchyInput input = make();
    for (const bool equal : {true, false}) {
      const HierarchyInput one = equal ? input : with_unequal_radii(input);
      // A small hierarchy is measured in many rounds.
      const std::size_t rounds = std::max(options.rounds, 50000 / (one.radii.size() * one.frames.size()));
      if (one.dimension == 2) {
        MeasuredHierarchies<2>(one, rows).run(rounds);
      } else {
        MeasuredHierarchies<3>(one, rows).run(rounds);
      }
      bench_kinetic_steps(one, rounds, one.kinetic, rows);
      bench_kinetic_events(one, rows);
      progress(++done, 2 * inputs.size());
    }
  }
  if (!options.sizes.empty()) bench_kinetic_events(rotating_chain(options.sizes.front()), rows);
  for (const std::size_t beads : options.sizes) {
    all_threads(beads, options.rounds, rows);
    lazy_query(beads, options.rounds, rows);
  }
  return rows;
}

}  // namespace kds
