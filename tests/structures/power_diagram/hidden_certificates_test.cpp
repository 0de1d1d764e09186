// Hidden beads have certificates in the cells that contain them.

#include "structures/power_diagram/hidden_certificates.h"

#include <gtest/gtest.h>

#include "tests/structures/power_diagram/bare_diagram.h"

namespace kds::hidden_certificates_test {
namespace {

using namespace test;

/// Returns whether the bead is inside its host cell now, by exact signs.
template <int dimension>
bool is_in_host(const DiagramState<dimension>& state, BeadId bead) {
  const auto& v = state.beads_of(state.hidden.host(bead));
  for (int i = 0; i <= dimension; ++i) {
    const Orientation<dimension> inside(DiagramState<dimension>::with(v, i, bead), 1);
    if (state.template search<Orientation<dimension>>().sign_at(inside, Dyadic(0.0)) < 0) return false;
  }
  return true;
}

template <int dimension>
void expect_housed(Kernel kernel) {
  BareRig<dimension> rig(random_beads<dimension>(1, 80, 0.001, 0.1), AuditMode::none, kernel);
  BareDiagram<dimension>& diagram = rig.structure;
  rig.simulator.build();
  rig.simulator.enter_step();
  diagram.facets.watch_all();
  diagram.hidden.watch_all();
  ASSERT_GT(diagram.state.hidden.size(), 10U);
  EXPECT_EQ(diagram.state.doubt, Doubt::none);
  EXPECT_EQ(diagram.statistics.certificates.alive, diagram.expected_alive());
  for (const BeadId bead : diagram.state.hidden.beads()) EXPECT_TRUE(is_in_host(diagram.state, bead)) << bead;
  // Displaced beads have no host and no certificates. Hidden beads find their cells again from any cell.
  const BeadId bead = diagram.state.hidden.beads()[0];
  const CellId host = diagram.state.hidden.host(bead);
  diagram.hidden.displace(std::array{host});
  const std::vector<BeadId> displaced(diagram.hidden.displaced().begin(), diagram.hidden.displaced().end());
  EXPECT_NE(std::find(displaced.begin(), displaced.end(), bead), displaced.end());
  EXPECT_TRUE(std::is_sorted(displaced.begin(), displaced.end()));
  EXPECT_EQ(diagram.statistics.certificates.alive,
            diagram.expected_alive() - displaced.size() * (dimension + 2));
  diagram.hidden.rehouse(diagram.state.some_finite_cell());
  EXPECT_TRUE(diagram.hidden.displaced().empty());
  EXPECT_EQ(diagram.statistics.certificates.alive, diagram.expected_alive());
  EXPECT_EQ(diagram.state.hidden.host(bead), host);
  diagram.hidden.drop_all();
  diagram.facets.drop_all();
  EXPECT_EQ(diagram.statistics.certificates.alive, 0U);
}

TEST(HiddenCertificates, HouseAndCertifyAllHiddenBeads) {
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    expect_housed<3>(kernel);
    expect_housed<2>(kernel);
  }
}

// A walk leads from any cell to the cell that contains a bead, or out of the hull.
TEST(HiddenCertificates, WalksArriveFromAnywhere) {
  auto motion = random_beads<3>(2, 60, 0, 0.1);
  BareRig<3> rig(motion);
  BareDiagram<3>& diagram = rig.structure;
  rig.simulator.build();
  rig.simulator.enter_step();
  diagram.hidden.watch_all();
  const auto hidden = diagram.state.hidden.beads();
  ASSERT_FALSE(hidden.empty());
  for (CellId from = 0; from < diagram.state.triangulation.cells().size(); ++from) {
    if (diagram.state.triangulation.is_live(from)) {
      EXPECT_EQ(diagram.hidden.walk_to(hidden[0], from), diagram.state.hidden.host(hidden[0]));
    }
  }
}

}  // namespace
}  // namespace kds::hidden_certificates_test
