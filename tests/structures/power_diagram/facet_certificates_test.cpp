// Every facet has exactly one certificate, which is created and dropped with its cells, whatever the filters
// prove about it.

#include "structures/power_diagram/facet_certificates.h"

#include <gtest/gtest.h>

#include "tests/structures/power_diagram/bare_diagram.h"

namespace kds::facet_certificates_test {
namespace {

using namespace test;

template <int dimension>
void expect_one_a_facet(Kernel kernel, double step) {
  BareRig<dimension> rig(random_beads<dimension>(1, 60, step), AuditMode::none, kernel);
  BareDiagram<dimension>& diagram = rig.structure;
  rig.simulator.build();
  for (int k = 0; k < 2; ++k) {  // in slow motion the second step uses slack
    rig.simulator.enter_step();
    diagram.facets.watch_all();
    EXPECT_EQ(diagram.statistics.certificates.alive, diagram.expected_alive());
    EXPECT_EQ(diagram.state.doubt, Doubt::none);
    EXPECT_EQ(diagram.statistics.stages.slack > 0, kernel != Kernel::exact && step < 1e-6);
    diagram.facets.drop_all();
    EXPECT_EQ(diagram.statistics.certificates.alive, 0U);
    rig.simulator.leave_step();
    diagram.statistics.stages = {};
  }
}

TEST(FacetCertificates, HaveOneCertificateAFacet) {
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    for (const double step : {1e-9, 0.01}) {
      expect_one_a_facet<3>(kernel, step);
      expect_one_a_facet<2>(kernel, step);
    }
  }
}

TEST(FacetCertificates, OfAllKernelsWaitForTheSameFailures) {
  const auto motion = random_beads<3>(2, 60, 0.01);
  std::vector<std::size_t> waiting;
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    BareRig<3> rig(motion, AuditMode::none, kernel);
    rig.simulator.build();
    rig.simulator.enter_step();
    rig.structure.facets.watch_all();
    waiting.push_back(rig.structure.waiting());
  }
  EXPECT_GT(waiting[0], 5U);
  EXPECT_EQ(waiting[0], waiting[1]);
}

TEST(FacetCertificates, AroundNewCellsAreMadeAnew) {
  BareRig<3> rig(random_beads<3>(3, 40, 0.01));
  BareDiagram<3>& diagram = rig.structure;
  rig.simulator.build();
  rig.simulator.enter_step();
  diagram.facets.watch_all();
  const std::size_t waiting = diagram.waiting();
  for (BeadId bead = 0; bead < 40; ++bead) {
    const std::vector<CellId> around = diagram.state.triangulation.cells_around(bead);
    diagram.facets.drop_around(around);
    EXPECT_LT(diagram.statistics.certificates.alive, diagram.expected_alive());
    diagram.facets.watch_around(around);
    EXPECT_EQ(diagram.statistics.certificates.alive, diagram.expected_alive());
    EXPECT_EQ(diagram.waiting(), waiting);
  }
}

// Facets between beads at rest are only counted, and have no certificate.
TEST(FacetCertificates, BetweenBeadsAtRestAreOnlyCounted) {
  auto motion = random_beads<3>(4, 60, 0.05);
  std::vector<char> moving(60, 0);
  moving[7] = 1;
  for (BeadId b = 0; b < 60; ++b) {
    for (int axis = 0; b != 7 && axis < 3; ++axis)
      motion.set_coordinate(b, 1, axis, motion.coordinate(b, 0, axis));
  }
  BareRig<3> rig(motion);
  BareDiagram<3>& diagram = rig.structure;
  rig.simulator.build();
  diagram.facets.move_only(moving);
  EXPECT_FALSE(diagram.facets.all_move());
  rig.simulator.enter_step();
  diagram.facets.watch_all();
  EXPECT_EQ(diagram.statistics.certificates.alive, diagram.expected_alive());
  const StageCounts& stages = diagram.statistics.stages;
  EXPECT_LT(stages.coefficients + stages.isolation + stages.refined + stages.exact,
            diagram.expected_alive() / 2);
  const std::vector<CellId> around = diagram.state.triangulation.cells_around(7);
  diagram.facets.drop_around(around);
  diagram.facets.watch_around(around);
  EXPECT_EQ(diagram.facets.flipped().size(), around.size());
}

// Dropping a certificate that fails at this moment puts the diagram in doubt.
TEST(FacetCertificates, AreGivenUpInDoubtWhereTheyFailNow) {
  BareRig<3> rig(random_beads<3>(5, 40, 0.1));
  BareDiagram<3>& diagram = rig.structure;
  diagram.flipping = false;
  rig.simulator.build();
  rig.simulator.enter_step();
  diagram.facets.watch_all();
  diagram.facets.drop_all();
  EXPECT_EQ(diagram.state.doubt, Doubt::none);
  diagram.facets.watch_all();
  rig.simulator.leave_step();  // all these certificates fail, and nothing is repaired
  EXPECT_GT(diagram.failed.size(), 5U);
}

}  // namespace
}  // namespace kds::facet_certificates_test
