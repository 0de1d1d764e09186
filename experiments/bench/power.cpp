// Measures the power diagram from frame to frame by the techniques of
// structures/power_diagram/diagram_update.h. The peer is CGAL's static build. Regular scenes, in which many
// balls lie on one sphere and many events coincide, are measured only kinetically, beside builds of both
// frames.

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/bench/bench.h"
#include "experiments/bench/chains.h"
#include "structures/power_diagram/diagram_update.h"

namespace kds::bench {

namespace {

std::string peer_name(int dimension) { return fmt::format("CGAL Regular_triangulation_{}", dimension); }

std::vector<double> weights_of(const BenchChain& chain) {
  std::vector<double> weights = chain.radii;
  for (double& w : weights) w *= w;
  return weights;
}

/// Goes through all frames. The time includes the build at the first frame if `built`.
template <int Dimension>
double seconds_in(UpdateTechnique technique, const BenchChain& chain, bool built) {
  const std::vector<double> weights = weights_of(chain);
  const auto update = make_diagram_update<Dimension>(technique);
  const double build = processor_seconds_of([&] { update->build(chain.frames[0], weights); });
  return (built ? build : 0) + processor_seconds_of([&] {
           for (std::size_t k = 1; k < chain.frames.size(); ++k)
             static_cast<void>(update->advance(chain.frames[k], weights));
         });
}

double seconds_by(UpdateTechnique technique, const BenchChain& chain, bool built = false) {
  return chain.dimension == 2 ? seconds_in<2>(technique, chain, built)
                              : seconds_in<3>(technique, chain, built);
}

template <class Make>
void add_techniques(const std::string& name, std::size_t beads, int dimension, const Make& make) {
  const auto chain = lazily(make);
  for (const UpdateTechnique t :
       {UpdateTechnique::reinsert, UpdateTechnique::greedy, UpdateTechnique::kinetic, UpdateTechnique::lifted,
        UpdateTechnique::activate, UpdateTechnique::automatic, UpdateTechnique::rebuild}) {
    const std::string measure = t == UpdateTechnique::automatic ? "auto to rebuild"
                                : t == UpdateTechnique::rebuild ? "beside " + peer_name(dimension)
                                                                : std::string(name_of(t));
    add(fmt::format("power/{}/{}/{}", name, beads, measure), [=] {
      return TimedWork{chain().frames.size() - 1, "ns/frame", [=] { return seconds_by(t, chain()); }};
    });
  }
}

template <class Frames>
void add_regular(const char* name, std::size_t beads, const Frames& frames) {
  const auto chain = lazily([=] { return BenchChain{name, frames(), std::vector<double>(beads, 1.0)}; });
  const std::string measure = fmt::format("power/{}/{}/regular", name, beads);
  add(measure, [=] {
    return TimedWork{1, "ns/frame", [=] { return seconds_by(UpdateTechnique::kinetic, chain()); }};
  });
  add(fmt::format("{} beside {} at both frames", measure, peer_name(3)), [=] {
    return TimedWork{1, "ns/frame", [=] { return seconds_by(UpdateTechnique::rebuild, chain(), true); }};
  });
}

}  // namespace

void add_power() {
  for (const std::filesystem::path& path : trajectories())
    for (const std::size_t stride : {1U, 4U, 16U, 64U}) {
      const BenchChain chain = read_bench_chain(path, stride);
      if (chain.frames.size() > 1)
        add_techniques(chain.name, chain.size(), 3, [=] { return read_bench_chain(path, stride); });
    }
  constexpr std::size_t beads = 10240;
  const auto add_chain = [](const char* name, double step, int dimension, const auto& start) {
    add_techniques(fmt::format("{} {} r", name, step), beads, dimension, [=] {
      return BenchChain{name, jostled_frames(start(), step, 9, dimension), std::vector<double>(beads, 1.0),
                        dimension};
    });
  };
  for (const double step : {0.01, 0.1})
    add_chain("random-chain", step, 3, [] { return model_at_rest("random-chain", beads); });
  add_chain("grid jitter 0.5 r", 0.1, 3, [] { return model_at_rest("grid", beads, 0.5); });
  add_chain("grid jitter 0.05 r", 0.1, 3, [] { return model_at_rest("grid", beads, 0.05); });
  add_chain("planar grid jitter 0.5 r", 0.1, 2, [] { return model_at_rest("grid", beads, 0.5, 2); });
  add_chain("planar spiral", 0.01, 2, [] { return planar_spiral(beads); });
  for (const std::size_t size : {1000U, 8000U}) {
    for (const char* model : {"grid", "helix", "grill"})
      add_regular(model, size, [=] { return rotating_frames(model, size); });
    add_regular("grid, one bead moves", size, [=] { return grid_with_one_moving(size); });
  }
}

}  // namespace kds::bench
