// Slow motion: facets that need no certificate thanks to the slack found at an earlier frame, compared with
// EPICK's power test of the same facets at one moment. One step examines all beads and all facets; the slack
// is known beforehand. `ns` is the time per facet of the step. `resting` is the share of facets that need no
// certificate.
//
//   kds_benchmarks --benchmark_filter=tolerance

#include <array>
#include <string>
#include <vector>

#include "experiments/bench/certificate_peers.h"
#include "experiments/bench/random_chain.h"
#include "experiments/bench/subject.h"
#include "motions/curves/positions.h"
#include "structures/power_diagram/facet_filter.h"
#include "structures/power_diagram/facet_slack.h"
#include "structures/triangulation/facet_certificate.h"

namespace kds::bench {

namespace {

// Moves the beads by `distance` times their radius in the step.
template <Motion M>
void rest(Turns& turns, double distance) {
  Random random(1);
  const auto beads = random_chain(10240);
  const M motion = jostled<M>(beads, distance, random);
  RegularTriangulation<3> triangulation;
  static_cast<void>(triangulation.build(control_points(motion, 0), control_weights(motion, 0)));

  std::size_t facets = 0;
  std::vector<std::array<BeadId, 5>> finite;
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (!triangulation.is_live(cell)) continue;
    for (int i = 0; i < 4; ++i) {
      const FacetId beyond = triangulation.beyond(cell, i);
      if (cell_of(beyond) < cell) continue;
      ++facets;
      with_facet_certificate(triangulation.cells()[cell].vertex, triangulation.apex(beyond),
                             [&](const auto& c) {
                               if constexpr (std::same_as<decltype(c), const PowerTest<3>&>)
                                 finite.push_back(c.beads);
                             });
    }
  }
  FacetSlack<3> slack;
  std::size_t others = 0;
  const auto step = [&] {
    slack.start_step(Curves<3>(motion), triangulation);
    others = 0;
    slack.for_the_others(triangulation, [&](CellId, unsigned left) { others += count_of<3>(left); });
  };
  step();  // records the reference positions
  const StaticPredicates peer(control_points(motion, 0), control_weights(motion, 0));
  const double share = static_cast<double>(facets) / static_cast<double>(finite.size());
  turns.take(facets, step, [&] { return share * peer.seconds_for(finite); });
  turns.note("resting", static_cast<double>(facets - others) / static_cast<double>(facets));
}

}  // namespace

std::vector<Subject> slack_subjects() {
  std::vector<Subject> all;
  const auto add = [&](const char* name, const char* input, std::optional<double> most_ns, auto run) {
    all.push_back({name, input, 10240, "CGAL predicate at one moment", most_ns, std::nullopt, run});
  };
  add("tolerance/facet/linear/0.0001r", "random-chain 0.0001 r", 3,
      [](Turns& t) { rest<BezierMotion<3, 1>>(t, 0.0001); });
  add("tolerance/facet/linear/0.001r", "random-chain 0.001 r", 3,
      [](Turns& t) { rest<BezierMotion<3, 1>>(t, 0.001); });
  add("tolerance/facet/hermite/0.001r", "random-chain 0.001 r", std::nullopt,
      [](Turns& t) { rest<BezierMotion<3, 3>>(t, 0.001); });
  return all;
}

}  // namespace kds::bench
