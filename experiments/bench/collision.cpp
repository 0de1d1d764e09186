// Measures the detector of kds. The peers are a cell list on single scenes, a Verlet list from frame to
// frame, and the trees of FCL and Bullet if this program was built with them. Kinetic contacts, with all
// begin and end times, are compared with a cell list that examines only frames. An item is a bead in one
// frame.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/bench/bench.h"
#include "experiments/bench/chains.h"
#include "experiments/bench/collision_peers.h"
#include "motions/models/elementary.h"
#include "motions/models/model.h"
#include "structures/collision/auto_detector.h"
#include "structures/collision/cell_list.h"
#include "structures/session/kinetic_run.h"

namespace kds::bench {

namespace {

// Beads of a protein closer than this along the chain are always in contact.
constexpr BeadId along_chain = 5;
constexpr std::size_t warm_frames = 4;  // frames before the timed ones, in which detectors make their lists
// For chains in order, the depth of Bullet's trees grows with their length: more beads take minutes.
constexpr std::size_t most_beads_of_trees = 20000;

using Pairs = std::vector<BeadPair>;

/// Balls of one necklace in several frames.
struct Scenes {
  Scenes(const std::vector<Eigen::Matrix3Xd>& frames, const std::vector<double>& radii)
      : asked{{{0, static_cast<BeadId>(radii.size() - 1)}}} {
    for (const Eigen::Matrix3Xd& frame : frames) all.emplace_back(frame, radii);
  }
  [[nodiscard]] std::size_t beads() const { return all.front().size(); }

  std::vector<Balls<3>> all;
  PairsAsked asked;
};

void expect_same(const Pairs& ours, const Pairs& theirs) {
  if (ours != theirs) throw std::logic_error("two detectors found different pairs");
}

// Times each scene separately, as if it were the first.
template <class Get>
void add_static(const std::string& group, std::size_t beads, const Get& scenes) {
  const auto add_auto = [&](const std::string& measure, VectorTarget target) {
    add(group + measure, [=] {
      const Scenes& s = scenes();
      const auto detector = std::make_shared<AutoDetector<3>>(s.asked, std::nullopt, target);
      expect_same(detector->pairs(s.all[0]), CellList<3>(s.asked).pairs(s.all[0]));
      return Work{s.all.size() * s.beads(), "ns/bead", [&s, detector] {
                    for (const Balls<3>& balls : s.all) {
                      detector->forget();
                      benchmark::DoNotOptimize(detector->pairs(balls).data());
                    }
                  }};
    });
  };
  if (widest_vector_target() == VectorTarget::avx512) add_auto("static auto, AVX-512", VectorTarget::avx512);
  if (is_available(VectorTarget::avx2)) add_auto("static auto, AVX2", VectorTarget::avx2);
  add(group + "static auto beside cell list", [=] {
    const Scenes& s = scenes();
    const auto cells = std::make_shared<CellList<3>>(s.asked);
    return Work{s.all.size() * s.beads(), "ns/bead", [&s, cells] {
                  for (const Balls<3>& balls : s.all) benchmark::DoNotOptimize(cells->pairs(balls).data());
                }};
  });
  if (beads > most_beads_of_trees) return;
  for (const CollisionPeer& peer : collision_peers())
    add(fmt::format("{}static auto beside {}", group, peer.name), [=, &peer] {
      const Scenes& s = scenes();
      const std::shared_ptr<PeerTree> tree = peer.build(s.all.front());
      return Work{s.beads(), "ns/bead", [tree] { benchmark::DoNotOptimize(tree->pairs()); }};
    });
}

// Times consecutive frames after the first few.
template <class Get>
void add_frames(const std::string& measure, const Get& scenes, bool with_cell_list) {
  const auto add_list = [&](const std::string& name, auto make) {
    add(name, [=] {
      const Scenes& s = scenes();
      return TimedWork{(s.all.size() - warm_frames) * s.beads(), "ns/bead", [&s, make] {
                         auto list = make(s);
                         const std::span<const Balls<3>> all = s.all;
                         for (const Balls<3>& balls : all.first(warm_frames)) (void)list.pairs(balls);
                         return processor_seconds_of([&] {
                           for (const Balls<3>& balls : all.subspan(warm_frames)) (void)list.pairs(balls);
                         });
                       }};
    });
  };
  add_list(measure, [](const Scenes& s) { return AutoDetector<3>(s.asked); });
  add_list(measure + " beside Verlet list", [](const Scenes& s) {
    const std::span radii(s.all.front().radii(), s.beads());
    return VerletList<3>(s.asked, *std::max_element(radii.begin(), radii.end()));
  });
  if (with_cell_list)
    add_list(measure + " beside cell list", [](const Scenes& s) { return CellList<3>(s.asked); });
}

Eigen::Matrix3Xd start_of(const std::string& name, std::size_t beads) {
  const bool packed = name.ends_with("packed");
  models::Settings settings{.beads = beads, .motion = models::ShapeMotion::rest};
  if (packed) {
    settings.jitter = 0.05;
    settings.gap = 0.11;  // gives radii of 0.45 of the spacing
  }
  Eigen::Matrix3Xd start =
      models::generate(*models::find_model(packed ? "grid" : name), settings).front().frames.front();
  if (name == "rotated packed") {
    const Eigen::Quaterniond turn(0.6, 0.3, 0.5, 0.55);
    start = turn.normalized().toRotationMatrix() * start;
  }
  return start;
}

/// Returns frames in which every bead moves steadily in its own direction. The last `shaking` beads instead
/// shake about their first positions.
std::vector<Eigen::Matrix3Xd> moving_on(const Eigen::Matrix3Xd& start, double step, bool a_part_shakes) {
  const std::size_t frames = start.cols() > 50000 ? 24 : 64;
  const Eigen::Index shaking = a_part_shakes ? start.cols() / 16 : 0;
  models::Random random(1);
  Eigen::Matrix3Xd along(3, start.cols());
  for (Eigen::Index b = 0; b < start.cols(); ++b) along.col(b) = step * random.direction(3);
  std::vector<Eigen::Matrix3Xd> all;
  for (std::size_t k = 0; k < frames; ++k) {
    all.emplace_back(start + static_cast<double>(k) * along);
    for (Eigen::Index b = start.cols() - shaking; b < start.cols(); ++b)
      all.back().col(b) = start.col(b) + 0.3 * random.direction(3);
  }
  return all;
}

void add_generated(const std::string& name, std::size_t beads) {
  const std::string group = fmt::format("collision/{}/{}/", name, beads);
  const std::vector<double> radii(beads, 1.0);
  add_static(group, beads,
             lazily([=] { return Scenes(jostled_frames(start_of(name, beads), 0.01, 6), radii); }));
  const auto add_moving = [&](const std::string& motion, double step, bool a_part_shakes) {
    add_frames(fmt::format("{}frame auto, {}", group, motion),
               lazily([=] { return Scenes(moving_on(start_of(name, beads), step, a_part_shakes), radii); }),
               false);
  };
  for (const double step : {0.003, 0.03, 0.3}) add_moving(fmt::format("{} r a frame", step), step, false);
  add_moving("a sixteenth by 0.3 r", 0.003, true);
}

Scene contact_scene(BenchChain chain, double radius_factor) {
  for (double& radius : chain.radii) radius *= radius_factor;
  return chain.scene();
}

KineticRun contact_run(const Scene& scene) {
  KineticRunOptions options{.structures = {"contacts"}};
  options.settings.apart = along_chain;
  return KineticRun(scene, options);
}

double seconds_of_cell_list(const BenchChain& chain, double radius_factor) {
  std::vector<double> radii = chain.radii;
  for (double& radius : radii) radius *= radius_factor;
  CellList<3> cells(PairsAsked{{{0, static_cast<BeadId>(chain.size() - 1)}}, true, along_chain, true});
  Balls<3> balls(chain.frames.front(), radii);
  (void)cells.pairs(balls);
  return processor_seconds_of([&] {
    for (std::size_t k = 1; k < chain.frames.size(); ++k) {
      balls.move_to(chain.frames[k]);
      (void)cells.pairs(balls);
    }
  });
}

// Radii of pairs are 1.6 times the radii at which neighbours along the chain meet. From this factor on,
// contacts are physically meaningful.
void add_protein(const std::filesystem::path& path) {
  const auto chain = lazily([path] { return read_bench_chain(path); });
  const std::size_t beads = read_bench_chain(path).size();
  const std::string group = fmt::format("collision/{}/{}/", path.stem().string(), beads);
  const auto scenes = lazily([=] {
    std::vector<double> radii = chain().radii;
    for (double& r : radii) r *= 1.6;
    return Scenes(chain().frames, radii);
  });
  add_static(group, beads, scenes);
  add_frames(group + "frame auto, as simulated", scenes, true);
  for (const double factor : {2.2, 2.5}) {
    const std::string measure = fmt::format("{}contacts, {} r", group, factor);
    add(measure, [=] {
      const auto scene = std::make_shared<Scene>(contact_scene(chain(), factor));
      return TimedWork{beads * scene->step_count(), "ns/bead", [scene] {
                         KineticRun run = contact_run(*scene);
                         run.build();
                         return processor_seconds_of([&] { run.finish(); });
                       }};
    });
    add(measure + " beside cell list", [=] {
      return TimedWork{beads * (chain().frames.size() - 1), "ns/bead",
                       [=] { return seconds_of_cell_list(chain(), factor); }};
    });
  }
}

// Two distant necklaces that both rotate. The query only asks whether they meet.
struct FarNecklaces {
  explicit FarNecklaces(std::size_t beads) : items(2 * 2 * beads * 20) {
    const Eigen::Matrix3Xd helix = model_at_rest("helix", beads);
    const double apart = 3 * (helix.rowwise().maxCoeff() - helix.rowwise().minCoeff()).norm();
    const double angle = 1e-6;
    const std::vector<double> radii(2 * beads, 1.0);
    std::vector<Balls<3>> first;
    for (int k = 0; k < 24; ++k) {
      Eigen::Matrix3Xd both(3, 2 * helix.cols());
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle * k, Eigen::Vector3d::UnitX()).toRotationMatrix();
      both << turn * helix, (turn * helix).colwise() + Eigen::Vector3d(apart, 0, 0);
      (k < 4 ? first : frames).emplace_back(both, radii);
    }
    const auto n = static_cast<BeadId>(beads);
    const PairsAsked asked{{{0, n - 1}, {n, 2 * n - 1}}, false, 2, true};
    detector.emplace(asked);
    knows.emplace(asked, angle * apart);
    for (const Balls<3>& balls : first)
      if (!detector->pairs(balls).empty() || !knows->pairs(balls).empty())
        throw std::logic_error("far necklaces meet");
  }
  // Going back and forth keeps within the declared speed.
  template <class Look>
  void for_frames(const Look& look) const {
    for (const Balls<3>& balls : frames) look(balls);
    for (std::size_t k = frames.size(); k-- > 0;) look(frames[k]);
  }
  std::size_t items;
  std::vector<Balls<3>> frames;
  std::optional<AutoDetector<3>> detector, knows;
};

void add_far(std::size_t beads) {
  const std::string group = fmt::format("collision/two helices/{}/frame auto", 2 * beads);
  const auto far = lazily([beads] { return FarNecklaces(beads); });
  const auto add_look = [&](const std::string& name, auto look) {
    add(group + name, [=] {
      FarNecklaces& f = far();
      return Work{f.items, "ns/bead", [&f, look] {
                    f.for_frames([&](const Balls<3>& balls) { benchmark::DoNotOptimize(look(f, balls)); });
                  }};
    });
  };
  add_look(", distant necklaces",
           [](FarNecklaces& f, const auto& balls) { return f.detector->pairs(balls).size(); });
  add_look(", declared speed",
           [](FarNecklaces& f, const auto& balls) { return f.knows->pairs(balls).size(); });
  add_look(" beside reading the positions",
           [](FarNecklaces&, const auto& balls) { return scene_box(balls).low[0]; });
}

// Compares the time per bead with the time per bead for a tenth of the beads.
void add_growth(const char* model, std::size_t beads) {
  for (const bool large : {true, false}) {
    const std::size_t n = large ? 10 * beads : beads;
    const auto name = [&](const char* measure) {
      return fmt::format("collision/{}/{}/{}, ten times the beads{}", model, 10 * beads, measure,
                         large ? "" : fmt::format(" beside the same of {}", beads));
    };
    const auto frames = [=](std::size_t count) {
      return jostled_frames(model_at_rest(model, n), 0.01, count);
    };
    add(name("static auto"), [=] {
      const auto scenes = std::make_shared<Scenes>(frames(2), std::vector<double>(n, 1.0));
      const auto detector = std::make_shared<AutoDetector<3>>(scenes->asked);
      return Work{2 * n, "ns/bead", [=] {
                    for (const Balls<3>& balls : scenes->all) {
                      detector->forget();
                      benchmark::DoNotOptimize(detector->pairs(balls).data());
                    }
                  }};
    });
    // The build at a frame and the steps to the next two frames.
    add(name("contacts"), [=] {
      const auto scene =
          std::make_shared<Scene>(BenchChain{model, frames(3), std::vector<double>(n, 1.0)}.scene());
      return TimedWork{2 * n, "ns/bead", [scene] {
                         KineticRun run = contact_run(*scene);
                         return processor_seconds_of([&] { run.finish(); });
                       }};
    });
  }
}

// Atoms of a fluid as dense as water in a periodic cell. In a step they move as far as atoms of water do in
// 20 fs at 300 K. A contact is a distance of at most 3.5 angstrom.
Scene fluid_in_a_cell(std::size_t atoms) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  constexpr double spacing = 2.154, jitter = 0.3,
                   move = 0.1;  // angstrom; a tenth of an atom a cubic angstrom
  const double per_side = std::ceil(std::cbrt(static_cast<double>(atoms)));
  Trajectory fluid;
  fluid.file = "a fluid in a cell";
  Eigen::Matrix3Xd at(3, static_cast<Eigen::Index>(atoms)), velocity = at;
  for (Eigen::Index atom = 0; atom < at.cols(); ++atom) {
    double rest = static_cast<double>(atom);
    for (double& x : at.col(atom)) {
      x = spacing * std::fmod(rest, per_side) + jitter * normal(random);
      rest = std::floor(rest / per_side);
    }
    for (double& v : velocity.col(atom)) v = move * normal(random);
  }
  for (int frame = 0; frame < 3; ++frame) fluid.frames.emplace_back(at + frame * velocity);
  fluid.cells.assign(3, spacing * per_side * Cell::Identity());
  return {std::span(&fluid, 1), std::vector<double>(atoms, 1.75)};
}

// The second step with all its exact events, beside a search of the pairs of one frame by a cell list,
// without walls.
void add_fluid(std::size_t atoms) {
  const auto scene = lazily([atoms] { return fluid_in_a_cell(atoms); });
  const std::string measure = fmt::format("collision/fluid/{}/contacts in a cell", atoms);
  add(measure, [=] {
    return TimedWork{atoms, "ns/bead", [scene] {
                       KineticRun run(scene(), {.structures = {"contacts"}, .settings = {.apart = 1}});
                       run.build();
                       static_cast<void>(run.run_step());
                       return processor_seconds_of([&] { static_cast<void>(run.run_step()); });
                     }};
  });
  add(measure + " beside cell list of a frame", [=] {
    const auto balls = std::make_shared<Balls<3>>(scene().centers(0), scene().radii());
    const auto cells =
        std::make_shared<CellList<3>>(PairsAsked{{{0, static_cast<BeadId>(atoms - 1)}}, true, 1, true});
    return Work{atoms, "ns/bead", [=] { benchmark::DoNotOptimize(cells->pairs(*balls).data()); }};
  });
}

}  // namespace

void add_collision() {
  for (const std::size_t beads : {1000U, 10240U, 102400U})
    for (const char* name : {"helix", "scaling-helix", "packed", "rotated packed", "random-chain", "spline"})
      add_generated(name, beads);
  for (const std::filesystem::path& path : trajectories()) add_protein(path);
  add_far(102400);
  for (const char* model : {"helix", "random-chain"}) add_growth(model, 102400);
  for (const std::size_t atoms : {10000U, 100000U, 1000000U}) add_fluid(atoms);
}

}  // namespace kds::bench
