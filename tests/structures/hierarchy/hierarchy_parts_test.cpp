// Tests the parts of the wrapped hierarchy alone, at the start of a step.

#include <gtest/gtest.h>

#include <numeric>

#include "motions/curves/positions.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/hierarchy/node_certificates.h"
#include "structures/hierarchy/node_proofs.h"
#include "structures/hierarchy/signs_just_after.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::hierarchy_parts_test {
namespace {

using namespace test;

/// The parts for one necklace of all beads.
struct Parts {
  Parts(const Space& motion, Kernel kernel, Radii radii)
      : simulator(AuditMode::none, kernel),
        tree(std::array{BeadRange{0, static_cast<BeadId>(motion.bead_count() - 1)}}),
        curves(motion),
        owner(simulator, [](const Dyadic&) { return std::nullopt; }),
        proofs(simulator, tree, curves, 1, radii),
        certificates(simulator, owner, 0, motion, curves, radii, tree.node_count(), proofs),
        repair(radii, proofs, certificates.signs()) {
    proofs.take_curves();
  }

  Simulator simulator;
  NecklaceTree tree;
  Curves<3> curves;
  Witness owner;
  NodeProofs<3> proofs;
  NodeCertificates<3> certificates;
  BasisRepair<3> repair;
};

Basis smallest_basis(const Space& motion, std::span<const BeadId> beads) {
  const Eigen::Matrix3Xd centers = control_points(motion, 0);
  const std::vector<double> radii = control_radii(motion, 0);
  Eigen::Matrix3Xd some(3, static_cast<Eigen::Index>(beads.size()));
  std::vector<double> some_radii;
  for (std::size_t i = 0; i < beads.size(); ++i) {
    some.col(static_cast<Eigen::Index>(i)) = centers.col(beads[i]);
    some_radii.push_back(radii[beads[i]]);
  }
  Basis basis = smallest_sphere(Balls<3>(some, some_radii), 0, static_cast<BeadId>(beads.size() - 1)).basis;
  for (std::size_t i = 0; i < basis.size; ++i) basis.beads[i] = beads[basis.beads[i]];
  return basis;
}

Space six_beads(Random& random, Radii radii) {
  auto motion = random_motion<Space>(random, 6, MotionKind::generic);
  for (BeadId b = 0; b < 6; ++b) {
    for (int k = 0; k <= 1; ++k) {
      motion.set_radius(b, k, radii == Radii::equal ? 0.25 : 0.125 * (1 + b % 3));
      motion.set_weight(b, k, 0);
    }
  }
  return motion;
}

TEST(BasisRepair, FindsTheBasisOfABasisAndTheBeadThatEscaped) {
  for (const Radii radii : {Radii::equal, Radii::any}) {
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      int escapes = 0;
      for (unsigned seed = 0; seed < 20; ++seed) {
        Random random(seed);
        const Space motion = six_beads(random, radii);
        Parts parts(motion, kernel, radii);
        const std::array<BeadId, 5> inside{0, 1, 2, 3, 4};
        const Basis old = smallest_basis(motion, inside);
        std::vector<BeadId> both(old.begin(), old.end());
        both.push_back(5);
        const Basis next = smallest_basis(motion, both);
        if (next == old) continue;
        ++escapes;
        EXPECT_EQ(parts.repair.next_basis(old, 5, false), next) << "seed " << seed;
      }
      EXPECT_GT(escapes, 5);
    }
  }
}

TEST(NodeProofs, ProveAllOfBeadsAtRestButNothingByIntegers) {
  Random random(3);
  Space motion = random_motion<Space>(random, 12, MotionKind::generic);
  for (BeadId b = 0; b < 12; ++b) {
    for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, 1, axis, motion.coordinate(b, 0, axis));
    for (int k = 0; k <= 1; ++k) motion.set_radius(b, k, 0.25);
  }
  for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
    Parts parts(motion, kernel, Radii::equal);
    std::vector<Basis> bases;
    std::vector<NodeId> wide, pairs, nodes;
    for (NodeId node = 0; node < parts.tree.node_count(); ++node) {
      const BeadRange range = parts.tree.range(node);
      std::vector<BeadId> beads(range.last - range.first + 1);
      std::iota(beads.begin(), beads.end(), range.first);
      bases.push_back(smallest_basis(motion, beads));
      (beads.size() == 2 ? pairs : wide).push_back(node);
    }
    nodes = wide;
    parts.proofs.add_unsettled(pairs, bases, nodes);
    EXPECT_EQ(nodes, wide);  // two beads of equal radius never change their basis
    parts.proofs.find_candidates(nodes, bases);
    EXPECT_EQ(parts.proofs.candidates().size(), kernel == Kernel::exact ? wide.size() : 0);
    EXPECT_EQ(parts.proofs.proves_bases(), kernel != Kernel::exact);
  }
}

TEST(NodeCertificates, HoldACertificateUntilItIsDropped) {
  // A bead leaves the sphere of two others in the middle of the step.
  Space motion = moving({{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}});
  Parts parts(motion, Kernel::filtered, Radii::equal);
  parts.simulator.build();
  const Basis pair(std::array<BeadId, 2>{0, 1});
  const std::array<BeadId, 1> beyond{2};
  const NodeId root = 0;
  parts.certificates.enqueue_beyond(root, pair, beyond);
  EXPECT_EQ(parts.certificates.watch_enqueued_of_one(true), std::nullopt);
  EXPECT_TRUE(parts.certificates.holds_any(root));
  EXPECT_NEAR(parts.certificates.certified_until(root), 0.5, 1e-12);
  parts.certificates.count_per_bead();
  EXPECT_EQ(parts.owner.statistics.certificates.per_bead_max, 1U);
  parts.certificates.drop(root);
  EXPECT_FALSE(parts.certificates.holds_any(root));
  EXPECT_EQ(parts.owner.statistics.certificates.cancelled, 1U);
  EXPECT_EQ(parts.owner.statistics.certificates.alive, 0U);
}

// Bead 2 is named by one certificate, then by a second of another node, then by two others after the first is
// dropped. The count never exceeds two, and it is taken only when it is asked for.
TEST(NodeCertificates, FollowHowManyCertificatesNameABead) {
  Space motion = moving({{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {{-1, 0, 0}, {1, 0, 0}, {0, 2, 0}});
  Parts parts(motion, Kernel::filtered, Radii::equal);
  const std::uint64_t& most = parts.owner.statistics.certificates.per_bead_max;
  const Basis pair(std::array<BeadId, 2>{0, 1}), other(std::array<BeadId, 2>{1, 2});
  const std::array<BeadId, 1> second{2}, zeroth{0};
  parts.simulator.build();
  parts.certificates.enqueue_beyond(0, pair, second);
  parts.certificates.count_followed();
  EXPECT_EQ(most, 0U);  // nothing is followed yet
  static_cast<void>(parts.certificates.watch_enqueued_of_one(true));
  parts.certificates.drop(0);
  parts.certificates.follow_names();
  parts.certificates.enqueue_beyond(0, pair, second);
  static_cast<void>(parts.certificates.watch_enqueued_of_one(true));
  parts.certificates.count_followed();
  EXPECT_EQ(most, 1U);
  parts.certificates.drop(0);
  parts.certificates.enqueue_beyond(0, pair, second);
  static_cast<void>(parts.certificates.watch_enqueued_of_one(true));
  parts.certificates.count_followed();
  EXPECT_EQ(most, 1U);  // the first certificate is gone
  parts.certificates.enqueue_beyond(1, other, zeroth);
  static_cast<void>(parts.certificates.watch_enqueued_of_one(true));
  parts.certificates.count_followed();
  EXPECT_EQ(most, 2U);
  parts.certificates.drop(0);
  parts.certificates.drop(1);
  parts.certificates.enqueue_beyond(0, pair, second);
  static_cast<void>(parts.certificates.watch_enqueued_of_one(true));
  parts.certificates.count_followed();
  EXPECT_EQ(most, 2U);
}

}  // namespace
}  // namespace kds::hierarchy_parts_test
