// Compares the number of certificates that name a bead, counted at all times of a run, with slow counts.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "structures/power_diagram/power_diagram.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::certificates_per_bead_test {
namespace {

using namespace test;

Scene wandering_scene(int dimension, unsigned seed) {
  Random random(seed);
  Trajectory chain;
  chain.file = "chain";
  for (int frame = 0; frame < 4; ++frame) {
    Eigen::Matrix3Xd at = Eigen::Matrix3Xd::Zero(3, 16);
    for (int bead = 0; bead < 16; ++bead)
      for (int axis = 0; axis < dimension; ++axis)
        at(axis, bead) =
            frame == 0 ? uniform(random, 0, 4) : chain.frames.back()(axis, bead) + uniform(random, -0.9, 0.9);
    chain.frames.push_back(at);
  }
  return {std::span(&chain, 1), std::vector<double>(16, 0.3)};
}

// Collects the beads of all events since `beads` was cleared.
struct ChangedBeads final : EventListener {
  void on_event(const Event& event) override {
    const auto ids = event.ids();
    beads.insert(beads.end(), ids.begin(), ids.end());
  }
  std::vector<BeadId> beads;
};

// Counts, for each bead, the facets whose certificate names it: a certificate names the beads of the two
// cells that share the facet.
template <int Dimension>
std::uint64_t most_by_facets(const PowerDiagram<Dimension>& diagram) {
  std::map<std::set<BeadId>, std::set<BeadId>> beads_at_facet;
  const auto& cells = diagram.triangulation().cells();
  for (CellId id = 0; id < cells.size(); ++id) {
    if (!diagram.triangulation().is_live(id)) continue;
    const auto& beads = cells[id].vertex;
    for (const BeadId left_out : beads) {
      std::set<BeadId> facet(beads.begin(), beads.end());
      facet.erase(left_out);
      beads_at_facet[facet].insert(beads.begin(), beads.end());
    }
  }
  std::map<BeadId, std::uint64_t> of_bead;
  std::uint64_t most = 0;
  for (const auto& [facet, beads] : beads_at_facet)
    for (const BeadId bead : beads)
      if (bead != infinite_bead) most = std::max(most, ++of_bead[bead]);
  return most;
}

template <int Dimension>
void expect_counts_at_all_times() {
  bool rose_within_a_step = false;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Scene scene = wandering_scene(Dimension, seed);
    KineticRun run(scene, {.structures = {"power"}});
    ChangedBeads changed;
    run.listen(changed);
    auto& diagram = dynamic_cast<PowerDiagram<Dimension>&>(*run.structures().front());
    std::uint64_t most = 0;
    const std::uint64_t& counted = diagram.statistics.certificates.per_bead_max;
    while (run.enter_step()) {
      most = std::max(most, most_by_facets(diagram));
      EXPECT_EQ(counted, most);
      const std::uint64_t at_start = most;
      changed.beads.clear();
      while (run.simulator().run_next()) {
        run.count_certificates(0, changed.beads);
        changed.beads.clear();
        most = std::max(most, most_by_facets(diagram));
        EXPECT_EQ(counted, most);
      }
      rose_within_a_step |= most > at_start;
      run.run_step();
    }
  }
  EXPECT_TRUE(rose_within_a_step);
}

TEST(CertificatesPerBead, OfDiagramsAreThoseOfTheirFacetsAtAllTimes) {
  expect_counts_at_all_times<2>();
  expect_counts_at_all_times<3>();
}

// Counting changes no event, and counts at all times are no less than those at the starts of steps.
TEST(CertificatesPerBead, CountingIsTheSameRun) {
  for (const int dimension : {2, 3}) {
    const Scene scene = wandering_scene(dimension, 7);
    const KineticRunOptions all{
        {dimension == 2 ? "hull" : "sorted", "box", "closest", "wrapped", "power", "contacts"}};
    KineticRun plain(scene, all), counted(scene, all);
    plain.finish();
    ChangedBeads changed;
    counted.listen(changed);
    counted.follow_certificates();
    while (counted.enter_step()) {
      while (counted.simulator().run_next()) {
        for (std::size_t s = 0; s < counted.structures().size(); ++s)
          counted.count_certificates(s, changed.beads);
        changed.beads.clear();
      }
      counted.run_step();
    }
    counted.finish();
    EXPECT_EQ(plain.simulator().fingerprint(), counted.simulator().fingerprint());
    for (std::size_t s = 0; s < plain.structures().size(); ++s) {
      const CertificateCounts& of_plain = plain.structures()[s]->statistics.certificates;
      const CertificateCounts& of_counted = counted.structures()[s]->statistics.certificates;
      EXPECT_EQ(of_plain.created, of_counted.created);
      EXPECT_EQ(of_plain.peak, of_counted.peak);
      EXPECT_GE(of_counted.per_bead_max, of_plain.per_bead_max) << plain.structures()[s]->name();
    }
  }
}

}  // namespace
}  // namespace kds::certificates_per_bead_test
