#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/bench/bench_chains.h"
#include "experiments/bench/benches.h"
#include "experiments/bench/collision_peers.h"
#include "experiments/program/timing.h"
#include "motions/models/elementary.h"
#include "motions/models/model.h"
#include "structures/collision/auto_detector.h"
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

KineticRunOptions options_of_run() {
  KineticRunOptions options{.structures = {"contacts"}};
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

namespace {

using Scenes = std::vector<Balls<3>>;

// For chains in order, the depth of Bullet's trees grows with their length: more beads take minutes.
constexpr std::size_t most_beads_of_trees = 20000;

struct CollisionInput {
  std::string name;
  Eigen::Matrix3Xd start;
  double fastest_static = 1, fastest_frame = 1;  // required ratios
};

CollisionInput generated(std::string_view name, std::size_t beads) {
  const bool packed = name.ends_with("packed");
  const models::Model* model = models::find_model(packed ? "grid" : name);
  models::Settings settings{.beads = beads, .motion = models::ShapeMotion::rest};
  if (packed) {
    settings.jitter = 0.05;
    settings.gap = 0.11;  // gives radii of 0.45 of the spacing
  }
  CollisionInput input{std::string(name), models::generate(*model, settings).front().frames.front()};
  if (name == "rotated packed") {
    const Eigen::Quaterniond turn(0.6, 0.3, 0.5, 0.55);
    input.start = turn.normalized().toRotationMatrix() * input.start;
  }
  const bool helix = name.ends_with("helix");
  if (helix && beads >= 10240) input.fastest_static = 0.1;
  if (name == "packed") input.fastest_static = 0.2;
  if (name == "random-chain") input.fastest_static = 0.5;
  if (helix || name == "packed") input.fastest_frame = 0.5;
  return input;
}

class MeasuredCollisions {
 public:
  MeasuredCollisions(const CollisionInput& input, std::vector<double> radii, std::size_t rounds,
                     std::vector<BenchRow>& rows)
      : input_(input),
        radii_(std::move(radii)),
        rounds_(rounds),
        rows_(rows),
        asked_{{{0, static_cast<BeadId>(radii_.size() - 1)}}} {}

  /// Times each scene separately, as if it were the first.
  void run_static(const Scenes& scenes) {
    CellList<3> cells(asked_);
    AutoDetector<3> widest(asked_), short_vectors(asked_, std::nullopt, usual_target());
    const auto anew = [](AutoDetector<3>& detector, const Balls<3>& balls) -> const std::vector<BeadPair>& {
      detector.forget();
      return detector.pairs(balls);
    };
    for (const Balls<3>& balls : scenes) expect_same(anew(widest, balls), cells.pairs(balls));
    std::vector<double> ours, ours_short, peer;
    std::vector<std::vector<double>> others(collision_peers().size());
    for (std::size_t round = 0; round < rounds_for(scenes); ++round) {
      peer.push_back(seconds_for(scenes, [&](const Balls<3>& balls) { (void)cells.pairs(balls); }));
      ours.push_back(seconds_for(scenes, [&](const Balls<3>& balls) { (void)anew(widest, balls); }));
      ours_short.push_back(
          seconds_for(scenes, [&](const Balls<3>& balls) { (void)anew(short_vectors, balls); }));
      if (round >= rounds_ || radii_.size() > most_beads_of_trees) continue;
      for (std::size_t k = 0; k < others.size(); ++k)
        others[k].push_back(seconds_of_tree(collision_peers()[k], scenes[round % scenes.size()]));
    }
    row("static auto, AVX-512", widest.tree().order() == BlockOrder::sequence ? "" : " (sorted)", ours,
        "cell list", peer, input_.fastest_static, widest_vector_target() == VectorTarget::avx512);
    row("static auto, AVX2", "", ours_short, "cell list", peer, input_.fastest_static,
        usual_target() == VectorTarget::avx2);
    for (std::size_t k = 0; k < others.size() && !others[k].empty(); ++k)
      row("static auto, AVX2", "", ours_short, collision_peers()[k].name, others[k], 1.0, true);
  }

  /// Times consecutive frames. The first few frames are not timed, because the detectors make their lists in
  /// them.
  void run_frames(const Scenes& frames, std::string_view motion, double goal) {
    std::vector<double> ours, verlet, cell;
    const double skin = *std::max_element(radii_.begin(), radii_.end());
    for (std::size_t round = 0; round < rounds_for(frames); ++round) {
      AutoDetector<3> detector(asked_);
      VerletList<3> list(asked_, skin);
      CellList<3> cells(asked_);
      const std::span<const Balls<3>> warm = std::span(frames).first(4), later = std::span(frames).subspan(4);
      for (const Balls<3>& balls : warm) expect_same(detector.pairs(balls), list.pairs(balls));
      const std::array<std::function<void()>, 3> runs{
          [&] {
            ours.push_back(seconds_for(later, [&](const auto& balls) { (void)detector.pairs(balls); }));
          },
          [&] { verlet.push_back(seconds_for(later, [&](const auto& balls) { (void)list.pairs(balls); })); },
          [&] { cell.push_back(seconds_for(later, [&](const auto& balls) { (void)cells.pairs(balls); })); }};
      // The order rotates, because each detector finds the caches as the previous one left them.
      for (std::size_t k = 0; k < runs.size(); ++k) runs[(round + k) % runs.size()]();
      expect_same(detector.pairs(later.back()), cells.pairs(later.back()));
    }
    row(fmt::format("frame auto, {}", motion), "", ours, "Verlet list", verlet, goal, true);
    row(fmt::format("frame auto, {}", motion), "", ours, "cell list", cell, 1.0, true);
  }

 private:
  static VectorTarget usual_target() {
    return is_available(VectorTarget::avx2) ? VectorTarget::avx2 : VectorTarget::plain;
  }
  static void expect_same(const std::vector<BeadPair>& ours, const std::vector<BeadPair>& theirs) {
    if (ours != theirs) throw std::logic_error("kds bench collision: two detectors found different pairs");
  }
  /// Returns more rounds for short runs.
  [[nodiscard]] std::size_t rounds_for(std::span<const Balls<3>> scenes) const {
    return std::max(rounds_, std::min<std::size_t>(25, 400000 / (scenes.size() * radii_.size() + 1)));
  }
  template <class Find>
  static double seconds_for(std::span<const Balls<3>> scenes, const Find& find) {
    return processor_seconds_of([&] {
             for (const Balls<3>& balls : scenes) find(balls);
           }) /
           static_cast<double>(scenes.size());
  }
  static double seconds_of_tree(const CollisionPeer& peer, const Balls<3>& balls) {
    const auto tree = peer.build(balls);
    return processor_seconds_of([&] { (void)tree->pairs(); });
  }
  void row(std::string name, std::string_view remark, const std::vector<double>& ours, std::string_view peer,
           const std::vector<double>& theirs, double goal, bool available) {
    if (!available) return;
    const double nanoseconds = 1e9 / static_cast<double>(radii_.size());
    rows_.push_back(with_spread(
        {std::move(name), input_.name + std::string(remark), radii_.size(), median_of(ours) * nanoseconds,
         "ns/bead", std::string(peer), median_of(theirs) * nanoseconds, goal},
        ours, nanoseconds));
  }

  const CollisionInput& input_;
  std::vector<double> radii_;
  std::size_t rounds_;
  std::vector<BenchRow>& rows_;
  PairsAsked asked_;
};

Scenes scenes_of(const std::vector<Eigen::Matrix3Xd>& frames, const std::vector<double>& radii) {
  Scenes scenes;
  for (const Eigen::Matrix3Xd& frame : frames) scenes.emplace_back(frame, radii);
  return scenes;
}

/// Returns frames in which every bead moves steadily in its own direction. The last `shaking` beads instead
/// shake about their first positions.
Scenes moving_on(const Eigen::Matrix3Xd& start, double step, std::size_t frames,
                 const std::vector<double>& radii, Eigen::Index shaking = 0) {
  models::Random random(1);
  Eigen::Matrix3Xd along(3, start.cols());
  for (Eigen::Index b = 0; b < start.cols(); ++b) along.col(b) = step * random.direction(3);
  Scenes scenes;
  for (std::size_t k = 0; k < frames; ++k) {
    Eigen::Matrix3Xd centers = start + static_cast<double>(k) * along;
    for (Eigen::Index b = start.cols() - shaking; b < start.cols(); ++b)
      centers.col(b) = start.col(b) + 0.3 * random.direction(3);
    scenes.emplace_back(centers, radii);
  }
  return scenes;
}

void bench_generated(const CollisionInput& input, std::size_t rounds, std::vector<BenchRow>& rows) {
  const auto beads = static_cast<std::size_t>(input.start.cols());
  const std::vector<double> radii(beads, 1.0);
  MeasuredCollisions measured(input, radii, rounds, rows);
  measured.run_static(scenes_of(jostled_frames(input.start, 0.01, 6), radii));
  const std::size_t frames = beads > 50000 ? 24 : 64;
  for (const double step : {0.003, 0.03, 0.3})
    measured.run_frames(moving_on(input.start, step, frames, radii), fmt::format("{} r a frame", step),
                        step < 0.1 ? input.fastest_frame : 1.0);
  measured.run_frames(moving_on(input.start, 0.003, frames, radii, input.start.cols() / 16),
                      "a sixteenth by 0.3 r", 1.0);
}

// The radii are 1.6 times the radii at which neighbours along the chain meet. From this factor on, contacts
// are physically meaningful.
void bench_protein(const std::filesystem::path& path, std::size_t rounds, std::vector<BenchRow>& rows) {
  const BenchChain chain = read_bench_chain(path);
  std::vector<double> radii = chain.radii;
  for (double& r : radii) r *= 1.6;
  const CollisionInput input{chain.name, chain.frames.front(), 0.5, 1};
  MeasuredCollisions measured(input, radii, rounds, rows);
  const Scenes frames = scenes_of(chain.frames, radii);
  measured.run_static(frames);
  measured.run_frames(frames, "as simulated", 1.0);
  const bool has_goal = chain.name.starts_with("random100") || chain.name.starts_with("dhodh");
  for (const double factor : {2.2, 2.5})
    bench_contacts(chain, factor, has_goal ? std::optional(0.7) : std::nullopt, rounds, rows);
}

/// Two distant necklaces that both rotate. The query only asks whether they meet.
void bench_far(std::size_t beads, std::size_t rounds, std::vector<BenchRow>& rows) {
  const Eigen::Matrix3Xd helix = model_at_rest("helix", beads);
  const double apart = 3 * (helix.rowwise().maxCoeff() - helix.rowwise().minCoeff()).norm();
  const double angle = 1e-6;
  const std::vector<double> radii(2 * beads, 1.0);
  Scenes frames;
  for (int k = 0; k < 24; ++k) {
    Eigen::Matrix3Xd both(3, 2 * helix.cols());
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle * k, Eigen::Vector3d::UnitX()).toRotationMatrix();
    both << turn * helix, (turn * helix).colwise() + Eigen::Vector3d(apart, 0, 0);
    frames.emplace_back(both, radii);
  }
  const auto n = static_cast<BeadId>(beads);
  const PairsAsked asked{{{0, n - 1}, {n, 2 * n - 1}}, false, 2, true};
  const double speed = angle * apart;
  std::vector<double> ours, told, reading;
  double sum = 0;  // used, so that the compiler keeps the work
  for (std::size_t round = 0; round < rounds; ++round) {
    AutoDetector<3> detector(asked), knows(asked, speed);
    for (const Balls<3>& balls : std::span(frames).first(4))
      if (!detector.pairs(balls).empty() || !knows.pairs(balls).empty())
        throw std::logic_error("kds bench collision: far necklaces meet");
    // All frames take less than a reading of the clock. Going back and forth keeps within the declared speed.
    const auto seconds = [&](const auto& look) {
      const auto later = std::span(frames).subspan(4);
      return processor_seconds_per_call([&] {
               for (const Balls<3>& balls : later) look(balls);
               for (std::size_t k = later.size(); k-- > 0;) look(later[k]);
             }) /
             2;
    };
    ours.push_back(seconds([&](const Balls<3>& balls) { (void)detector.pairs(balls); }));
    told.push_back(seconds([&](const Balls<3>& balls) { (void)knows.pairs(balls); }));
    reading.push_back(seconds([&](const Balls<3>& balls) { sum += scene_box(balls).low[0]; }));
  }
  const double nanoseconds = 1e9 / (static_cast<double>(2 * beads) * static_cast<double>(frames.size() - 4));
  const std::string peer = sum == sum ? "reading the positions" : "";
  rows.push_back(
      with_spread({"frame auto, distant necklaces", "two helices", 2 * beads, median_of(ours) * nanoseconds,
                   "ns/bead", peer, median_of(reading) * nanoseconds, 1.5},
                  ours, nanoseconds));
  rows.push_back(
      with_spread({"frame auto, declared speed", "two helices", 2 * beads, median_of(told) * nanoseconds,
                   "ns/bead", peer, median_of(reading) * nanoseconds, 0.1},
                  told, nanoseconds));
}

/// Compares the time per bead with the time per bead for ten times as many beads.
void bench_growth(std::string_view model, std::size_t beads, std::size_t rounds,
                  std::vector<BenchRow>& rows) {
  std::array<std::vector<double>, 2> seconds;
  std::array<Scenes, 2> scenes;
  std::vector<AutoDetector<3>> detectors;
  for (const std::size_t large : {0, 1}) {
    const std::size_t n = large == 1 ? 10 * beads : beads;
    const CollisionInput input = generated(model, n);
    scenes[large] = scenes_of(jostled_frames(input.start, 0.01, 2), std::vector<double>(n, 1.0));
    detectors.emplace_back(PairsAsked{{{0, static_cast<BeadId>(n - 1)}}});
  }
  for (std::size_t round = 0; round < rounds; ++round) {
    for (const std::size_t large : {0, 1}) {
      seconds[large].push_back(processor_seconds_of([&] {
        for (const Balls<3>& balls : scenes[large]) {
          detectors[large].forget();
          (void)detectors[large].pairs(balls);
        }
      }));
    }
  }
  const double nanoseconds = 1e9 / static_cast<double>(2 * beads);
  // The goal applies to large scenes only, because small ones fit the caches.
  const std::optional<double> goal = beads >= 100000 ? std::optional(1.5) : std::nullopt;
  rows.push_back(
      with_spread({"static auto, ten times the beads", std::string(model), 10 * beads,
                   median_of(seconds[1]) * nanoseconds / 10, "ns/bead", fmt::format("the same of {}", beads),
                   median_of(seconds[0]) * nanoseconds, goal},
                  seconds[1], nanoseconds / 10));
  bench_contacts_growth(model, beads, goal, rounds, rows);
}

}  // namespace

std::vector<BenchRow> bench_collision(const CollisionBenchOptions& options,
                                      const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<BenchRow> rows;
  std::vector<std::function<void()>> parts;
  for (const std::size_t beads : options.sizes) {
    for (const std::string_view name :
         {"helix", "scaling-helix", "packed", "rotated packed", "random-chain", "spline"})
      parts.emplace_back([&, name, beads] { bench_generated(generated(name, beads), options.rounds, rows); });
  }
  for (const std::filesystem::path& path : options.trajectories)
    parts.emplace_back([&, path] { bench_protein(path, options.rounds, rows); });
  if (!options.sizes.empty()) {
    const std::size_t most = *std::max_element(options.sizes.begin(), options.sizes.end());
    parts.emplace_back([&, most] { bench_far(most, options.rounds, rows); });
    for (const std::string_view name : {"helix", "random-chain"})
      parts.emplace_back([&, name, most] { bench_growth(name, most, options.rounds, rows); });
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k]();
    progress(k + 1, parts.size());
  }
  return rows;
}

}  // namespace kds
