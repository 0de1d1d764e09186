// Measures wrapped and layered hierarchies that are built, updated from frame to frame, and run kinetically.
// The peer is CGAL's Min_sphere_of_spheres_d at every node. An item is a node in one frame.

#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "experiments/bench/bench.h"
#include "experiments/bench/chains.h"
#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/static_build.h"

namespace kds::bench {

namespace {

constexpr const char* sphere_peer = "CGAL Min_sphere_of_spheres_d";

std::vector<BeadRange> necklace_of(const BenchChain& chain) {
  return {{0, static_cast<BeadId>(chain.size() - 1)}};
}

template <int Dimension>
struct HierarchyInput {
  explicit HierarchyInput(BenchChain made) : chain(std::move(made)) {
    for (const Eigen::Matrix3Xd& frame : chain.frames) balls.emplace_back(frame, chain.radii);
  }
  BenchChain chain;
  std::vector<BeadRange> necklace = necklace_of(chain);
  NecklaceTree tree{necklace};
  std::vector<Balls<Dimension>> balls;
  std::size_t items = tree.node_count() * (chain.frames.size() - 1);
};

/// Returns the seconds of all steps, with the construction of motions from frames but without the build at
/// the first frame, and the number of events.
std::pair<double, std::uint64_t> run_all_steps(const Scene& scene) {
  KineticRun run(scene, {.structures = {"wrapped"}});
  double seconds = processor_seconds_of([&] { run.load_step(); });
  run.build();
  seconds += processor_seconds_of([&] { run.finish(); });
  const auto& per_step = run.structures().front()->statistics.events_per_step;
  return {seconds, std::accumulate(per_step.begin(), per_step.end(), std::uint64_t{0})};
}

// Counts the bases that differ from frame to frame in static hierarchies.
template <int Dimension>
std::uint64_t bases_that_change(const HierarchyInput<Dimension>& input) {
  StaticWrappedHierarchy<Dimension> hierarchy(input.necklace);
  hierarchy.build(input.balls.front());
  std::uint64_t changed = 0;
  for (std::size_t k = 1; k < input.balls.size(); ++k) changed += hierarchy.update(input.balls[k]).changed;
  return changed;
}

template <int Dimension, class Make>
void add_hierarchy(const std::string& name, std::size_t beads, const Make& make) {
  const std::string group = fmt::format("hierarchies/{}/{}/", name, beads);
  const auto input = lazily([make] { return HierarchyInput<Dimension>(make()); });
  // Each call starts with a hierarchy that was built at the first frame.
  const auto over_frames = [&](const std::string& measure, auto hierarchy_of, auto step) {
    add(group + measure, [=] {
      const auto& in = input();
      const auto hierarchy = std::make_shared<decltype(hierarchy_of(in.necklace))>(in.necklace);
      return TimedWork{in.items, "ns/node", [&in, hierarchy, step] {
                         hierarchy->build(in.balls[0]);
                         return processor_seconds_of([&] {
                           for (std::size_t k = 1; k < in.balls.size(); ++k) step(*hierarchy, in.balls[k]);
                         });
                       }};
    });
  };
  const auto wrapped = [](const auto& necklace) { return StaticWrappedHierarchy<Dimension>(necklace); };
  const auto layered = [](const auto& necklace) { return LayeredHierarchy<Dimension>(necklace); };
  over_frames("wrapped build", wrapped, [](auto& h, const auto& now) { h.build(now); });
  over_frames("wrapped update", wrapped, [](auto& h, const auto& now) { h.update(now); });
  over_frames("wrapped trusted update", wrapped,
              [](auto& h, const auto& now) { h.update(now, Update::trust); });
  over_frames("layered build", layered, [](auto& h, const auto& now) { h.build(now); });
  add(group + "wrapped kinetic step", [=] {
    const auto scene = std::make_shared<Scene>(input().chain.scene());
    const double ratio =
        static_cast<double>(run_all_steps(*scene).second) / static_cast<double>(bases_that_change(input()));
    return TimedWork{input().items,
                     "ns/node",
                     [scene] { return run_all_steps(*scene).first; },
                     {{"wrapped events, linear", ratio}}};
  });
  add(fmt::format("{}wrapped beside {}", group, sphere_peer), [=] {
    std::vector<StaticBuild> builds;
    const auto& in = input();
    for (std::size_t k = 1; k < in.chain.frames.size(); ++k)
      builds.push_back(spheres_by_cgal<Dimension>(in.tree.ranges(), in.chain.frames[k], in.chain.radii));
    return Work{in.items, "ns/node", [builds] {
                  for (const StaticBuild& build : builds) build();
                }};
  });
}

// Also measures the chain with unequal radii: every third bead is a fifth smaller, every seventh a tenth.
template <int Dimension, class Make>
void add_both(const std::string& name, std::size_t beads, const Make& make) {
  add_hierarchy<Dimension>(name, beads, make);
  add_hierarchy<Dimension>(name + " unequal", beads, [make] {
    BenchChain chain = make();
    for (std::size_t b = 0; b < chain.size(); ++b) {
      if (b % 3 == 0) chain.radii[b] *= 0.8;
      if (b % 7 == 0) chain.radii[b] *= 0.9;
    }
    return chain;
  });
}

// Two distant necklaces. A query examines only the two roots, so this is the total cost of a frame.
struct FarHelices {
  explicit FarHelices(std::size_t beads) {
    const Eigen::Matrix3Xd helix = model_at_rest("helix", beads);
    const double apart_by = 10 * (helix.rowwise().maxCoeff() - helix.rowwise().minCoeff()).norm();
    both.resize(3, 2 * helix.cols());
    both << helix, helix.colwise() + Eigen::Vector3d(apart_by, 0, 0);
    radii.assign(2 * beads, 1.0);
    const auto n = static_cast<BeadId>(beads);
    necklaces = {{0, n - 1}, {n, 2 * n - 1}};
    balls.emplace(both, radii);
    hierarchy.emplace(necklaces);
    hierarchy->build(*balls);
    second = *hierarchy->tree().find(necklaces[1]);
    build = spheres_by_cgal<3>(hierarchy->tree().ranges(), both, radii);
  }
  void query() {
    hierarchy->update(*balls, Update::lazy);
    const Sphere a = hierarchy->sphere(0), b = hierarchy->sphere(second);
    benchmark::DoNotOptimize((a.center - b.center).norm() - a.radius - b.radius);
  }
  std::size_t items = 1;
  Eigen::Matrix3Xd both;
  std::vector<double> radii;
  std::vector<BeadRange> necklaces;
  std::optional<Balls<3>> balls;
  std::optional<StaticWrappedHierarchy<3>> hierarchy;
  NodeId second{};
  StaticBuild build;
};

}  // namespace

void add_hierarchies() {
  constexpr std::size_t beads = 10240;
  for (const std::filesystem::path& path : trajectories()) {
    const BenchChain chain = read_bench_chain(path);
    add_both<3>(chain.name, chain.size(), [path] { return read_bench_chain(path); });
  }
  for (const char* model : {"helix", "random-chain", "grid"})
    add_both<3>(model, beads, [=] {
      return BenchChain{model, jostled_frames(model_at_rest(model, beads), 0.01, 20),
                        std::vector<double>(beads, 1.0)};
    });
  const auto in_plane = [](const Eigen::Matrix3Xd& start) {
    return BenchChain{"planar", jostled_frames(start, 0.01, 20, 2), std::vector<double>(beads, 1.0), 2};
  };
  add_both<2>("planar grid", beads, [=] { return in_plane(model_at_rest("grid", beads, 0.05, 2)); });
  add_both<2>("planar spiral", beads, [=] { return in_plane(planar_spiral(beads)); });
  for (const std::size_t size : {std::size_t{640}, beads})
    add_pair(
        fmt::format("hierarchies/far helices/{}/lazy update and query", 2 * size), sphere_peer, "ns/frame",
        [=] { return FarHelices(size); }, [](FarHelices& far) { far.query(); },
        [](FarHelices& far) { far.build(); });
}

}  // namespace kds::bench
