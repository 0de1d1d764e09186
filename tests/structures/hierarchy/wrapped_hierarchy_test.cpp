#include "structures/hierarchy/wrapped_hierarchy.h"

#include <gmock/gmock.h>

#include <map>

#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random.h"
#include "tests/support/judges/cgal_sphere.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::wrapped_hierarchy_test {
namespace {

using namespace test;

using Necklaces = std::vector<BeadRange>;
template <Kernel kernel>
struct WrappedRig : Rig<WrappedHierarchy<3>, Space> {
  WrappedRig(const Space& first, AuditMode audits, const Necklaces& necklaces)
      : Rig(first, audits, kernel, necklaces, Radii::equal) {}
};

Necklaces one_necklace(const Space& motion) { return {{0, static_cast<BeadId>(motion.bead_count() - 1)}}; }

std::span<const BeadId> beads_of(const Basis& basis) { return {basis.begin(), basis.end()}; }

/// Compares every node with the definition and with CGAL over rationals.
template <Kernel K>
void expect_right_at(const WrappedRig<K>& rig, const Dyadic& time, bool cgal = true) {
  const auto points = exact_points(rig.motion, time);
  const NecklaceTree& tree = rig.structure.tree();
  const std::vector<Basis> bases = rig.structure.bases_at(time);
  for (NodeId node = 0; node < tree.node_count(); ++node) {
    const auto [first, last] = tree.range(node);
    const Basis& basis = bases[node];
    SCOPED_TRACE(text_of("node ", first, "-", last));
    ASSERT_EQ(not_smallest_sphere(points, first, last, beads_of(basis), true), std::nullopt);
    if (!cgal) continue;
    const test::ExactSphere ours = sphere_through(points, beads_of(basis))->first;
    const test::ExactSphere theirs = cgal_smallest_sphere(points, first, last);
    ASSERT_EQ(ours.center, theirs.center);
    ASSERT_EQ(ours.square, theirs.square);
  }
}

template <Kernel K>
Witness::Look definition(WrappedRig<K>& rig, int stride) {
  return [&rig, stride, count = 0](const Dyadic& time) mutable -> std::optional<std::string> {
    if (count++ % stride != 0) return std::nullopt;
    const auto points = exact_points(rig.motion, time);
    const NecklaceTree& tree = rig.structure.tree();
    for (NodeId node = 0; node < tree.node_count(); ++node) {
      const auto [first, last] = tree.range(node);
      // Between events the basis need not be strict. Superfluous beads may stay for a whole step, as when two
      // beads move together.
      const Basis& basis = rig.structure.basis(node);
      if (!sphere_through(points, beads_of(basis))) continue;  // beads that coincide for a while
      if (auto wrong = not_smallest_sphere(points, first, last, beads_of(basis), false)) {
        return text_of("node ", first, "-", last, ": ", *wrong);
      }
    }
    return std::nullopt;
  };
}

/// Checks that each event names its kind and the next basis of its node: the kind must agree with the set
/// difference of the two bases.
template <Kernel K>
void expect_consistent_log(const WrappedRig<K>& rig, std::map<std::pair<BeadId, BeadId>, Basis> bases) {
  std::array<std::uint64_t, 4> kinds{};
  for (const Event& e : rig.history.events) {
    Basis& before = bases.at({e.change.ids[0], e.change.ids[1]});
    const Basis after(std::span(e.change.ids).subspan(2, e.change.size - 2U));
    EXPECT_FALSE(after == before);
    const bool entered =
        std::any_of(after.begin(), after.end(), [&](BeadId b) { return !before.contains(b); });
    const bool left = std::any_of(before.begin(), before.end(), [&](BeadId b) { return !after.contains(b); });
    const std::string_view kind = entered && left ? "pivot" : entered ? "enter" : "leave";
    EXPECT_EQ(rig.structure.kinds()[e.change.kind].name, kind);
    ++kinds[e.change.kind];
    before = after;
  }
  for (NodeId node = 0; node < rig.structure.tree().node_count(); ++node) {
    const auto [first, last] = rig.structure.tree().range(node);
    EXPECT_EQ(bases.at({first, last}), rig.structure.basis(node));
  }
  EXPECT_THAT(rig.structure.statistics.events_by_kind, testing::ElementsAreArray(kinds));
}

/// Runs with audits between all events, by the structure and by the definition.
template <Kernel K>
void run_audited(const std::vector<Space>& steps, const Necklaces& necklaces, int stride = 1) {
  WrappedRig<K> rig(steps.front(), AuditMode::events, necklaces);
  Witness witness(rig.simulator, definition(rig, stride));
  try {
    rig.motion = steps.front();
    rig.simulator.build();
    std::map<std::pair<BeadId, BeadId>, Basis> bases;
    for (NodeId node = 0; node < rig.structure.tree().node_count(); ++node) {
      const auto [first, last] = rig.structure.tree().range(node);
      bases[{first, last}] = rig.structure.basis(node);
    }
    expect_right_at(rig, Dyadic(0.0), steps.size() == 1);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      rig.step(steps[k]);
      expect_right_at(rig, Dyadic(1.0), k + 1 == steps.size());
    }
    expect_consistent_log(rig, bases);
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return;
  }
  EXPECT_TRUE(books_balance(rig.structure.statistics));

  WrappedRig<K> replayed(steps.front(), AuditMode::frames, necklaces);
  EXPECT_NO_THROW(replayed.replay(steps, rig.history));
  EXPECT_EQ(replayed.simulator.fingerprint(), rig.simulator.fingerprint());
}

void run_audited(const std::vector<Space>& steps) {
  run_audited<Kernel::filtered>(steps, one_necklace(steps.front()));
}

template <Kernel K>
std::uint64_t fingerprint_of(const std::vector<Space>& steps, const Necklaces& necklaces) {
  WrappedRig<K> rig(steps.front(), AuditMode::none, necklaces);
  rig.run(steps);
  return rig.simulator.fingerprint();
}

// Tests with few beads.

TEST(WrappedHierarchy, OneBeadHasNoNodes) {
  const Space motion = moving({{1, 2, 3}}, {{4, 5, 6}});
  WrappedRig<Kernel::filtered> rig(motion, AuditMode::events, one_necklace(motion));
  rig.run();
  EXPECT_EQ(rig.structure.tree().node_count(), 0U);
  EXPECT_EQ(rig.history.events.size(), 0U);
}

TEST(WrappedHierarchy, TwoBeadsHaveNoEvents) {
  run_audited({moving({{0, 0, 0}, {1, 0, 0}}, {{5, 0, 0}, {1, 7, 0}})});
  run_audited({moving({{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {0, 0, 0}})});  // the beads pass through each other
  run_audited({moving({{0, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {2, 0, 0}})});  // the beads meet at the end
  run_audited({moving({{2, 0, 0}, {2, 0, 0}}, {{0, 0, 0}, {1, 0, 0}})});  // the beads part at the start
  run_audited({moving({{2, 0, 0}, {2, 0, 0}}, {{3, 1, 0}, {3, 1, 0}})});  // the beads move together
  run_audited(through({{{2, 0, 0}, {2, 0, 0}}, {{3, 1, 0}, {3, 1, 0}}, {{3, 1, 0}, {4, 1, 0}}}));
}

TEST(WrappedHierarchy, ThreeBeads) {
  // An obtuse triangle becomes acute, and then obtuse at another bead: one bead enters the basis, then one
  // leaves.
  const std::vector<Space> steps{
      moving({{-4, 0, 0}, {4, 0, 0}, {-3, 1, 0}}, {{-4, 0, 0}, {4, 0, 0}, {14, 1, 0}})};
  WrappedRig<Kernel::filtered> rig(steps.front(), AuditMode::events, one_necklace(steps.front()));
  rig.run(steps);
  EXPECT_THAT(rig.structure.statistics.events_by_kind, testing::ElementsAre(1, 1, 0, 0));
  run_audited(steps);
  run_audited({moving({{-4, 0, 0}, {4, 0, 0}, {0, 0, 0}}, {{-4, 0, 0}, {4, 0, 0}, {0, 9, 0}})});
  run_audited({moving({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {0, 0, 0}, {-1, 0, 0}})});  // all meet
  run_audited(
      {moving({{-1, 0, 0}, {1, 0, 0}, {0, 3, 0}}, {{1, 0, 0}, {-1, 0, 0}, {0, 3, 0}})});  // two trade places
}

// A square bends through its plane. At that moment its four beads lie on one circle; before and after they
// are the basis.
TEST(WrappedHierarchy, AFourBeadBasisPassesThroughAPlane) {
  const auto bent = [](double s, std::initializer_list<std::array<double, 3>> more) {
    Points points{{2, 0, s}, {-2, 0, s}, {0, 2, -s}, {0, -2, -s}};
    points.insert(points.end(), more);
    return points;
  };
  run_audited({moving(bent(-1, {}), bent(1, {}))});
  run_audited({moving(bent(-1, {{0, 0, 0}}), bent(1, {{0, 0, 0}}))});
  run_audited({moving(bent(-1, {{1, 0, 0}, {0, 1, 1}}), bent(1, {{1, 0, 0}, {0, 1, 1}}))});
  run_audited(through({bent(-1, {{0, 0, 0}}), bent(0, {{0, 0, 0}}), bent(1, {{0, 0, 0}})}));
  run_audited<Kernel::exact>({moving(bent(-1, {{0, 0, 0}}), bent(1, {{0, 0, 0}}))}, {{0, 4}});
  // A similar motion, but not at the middle of the step and not in a coordinate plane.
  run_audited({moving(bent(-1, {{0, 0, 0}}), bent(4, {{0, 0, 0}}))});
}

// In the middle of the step the four basis beads lie in one plane, and each touches the sphere of the other
// three. No certificate changes sign, but the orientation of the basis flips.
TEST(WrappedHierarchy, ABasisTurnsOverByTouchingAlone) {
  run_audited({moving({{2, 2, 0}, {0, 2, 0}, {2, 0, 0}, {2, 2, 2}, {2, 0, 2}, {0, 0, 0}, {0, 0, 2}},
                      {{0, 0, 2}, {2, 0, 2}, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 2}, {2, 2, 0}})});
}

TEST(WrappedHierarchy, SeveralNecklaces) {
  const Space motion = instance_motion<Space>("d3_n50_linear");
  const Necklaces necklaces{{0, 16}, {17, 17}, {18, 19}, {20, 49}};
  run_audited<Kernel::filtered>({motion}, necklaces, 10);
  // Each necklace has the same events as when it runs alone.
  WrappedRig<Kernel::filtered> all(motion, AuditMode::none, necklaces);
  all.run();
  std::uint64_t alone = 0;
  for (const BeadRange& necklace : necklaces) {
    WrappedRig<Kernel::filtered> rig(motion, AuditMode::none, Necklaces{necklace});
    rig.run();
    alone += rig.external_events();
  }
  EXPECT_EQ(all.external_events(), alone);
}

TEST(WrappedHierarchy, RefusesChangesThatCannotBe) {
  const Space motion = instance_motion<Space>("d3_n20_linear");
  WrappedRig<Kernel::filtered> rig(motion, AuditMode::none, one_necklace(motion));
  rig.run();
  EXPECT_THROW(rig.structure.apply({0, 4, {1, 4, 1, 4}}), std::invalid_argument);
  EXPECT_THROW(rig.structure.apply({0, 4, {0, 4, 0, 5}}), std::invalid_argument);
  rig.structure.apply({0, 4, {0, 4, 0, 4}});
}

// The audit must be able to fail: it rejects every other basis.
TEST(WrappedHierarchy, AuditsNoticeEveryWrongBasis) {
  const Space motion = instance_motion<Space>("d3_n20_linear");
  WrappedRig<Kernel::filtered> rig(motion, AuditMode::frames, one_necklace(motion));
  rig.run();
  using Hierarchy = WrappedHierarchy<3>;
  std::mt19937 random(26);
  for (NodeId node = 0; node < rig.structure.tree().node_count(); ++node) {
    const auto [first, last] = rig.structure.tree().range(node);
    const Basis right = rig.structure.basis(node);
    for (int attempt = 0; attempt < 10; ++attempt) {
      Change change{Hierarchy::pivot, 2, {first, last}};
      for (BeadId b = first; b <= last && change.size < 6; ++b) {
        if (random() % 2 == 0) change.ids[change.size++] = b;
      }
      if (change.size == 2) continue;
      const Basis other(std::span(change.ids).subspan(2, change.size - 2U));
      // A basis with superfluous beads is still a valid basis, as at a frame where a bead is about to leave.
      const bool contains =
          std::all_of(right.begin(), right.end(), [&](BeadId b) { return other.contains(b); });
      rig.structure.apply(change);
      EXPECT_EQ(rig.structure.audit(Dyadic(1.0)) == std::nullopt, contains);
    }
    Change back{Hierarchy::pivot, static_cast<std::uint8_t>(2 + right.size), {first, last}};
    std::copy(right.begin(), right.end(), back.ids.begin() + 2);
    rig.structure.apply(back);
    EXPECT_EQ(rig.structure.audit(Dyadic(1.0)), std::nullopt);
  }
  EXPECT_NE(rig.structure.audit(Dyadic(0.0)), std::nullopt);
}

TEST(WrappedHierarchy, ATranslationGivesNoEvent) {
  const Space first = trajectory_steps("villin_hp36_300K.dcd", 0, 1).front();
  std::vector<Points> frames(11, Points(first.bead_count()));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (BeadId b = 0; b < first.bead_count(); ++b) {
      // Whole multiples of 2^-12, so that sums are exact.
      for (int axis = 0; axis < 3; ++axis) {
        frames[k][b][static_cast<std::size_t>(axis)] =
            std::round(first.coordinate(b, 0, axis) * 4096) / 4096 + static_cast<double>(k) * (0.5 + axis);
      }
    }
  }
  const auto steps = through(frames);
  WrappedRig<Kernel::filtered> rig(steps.front(), AuditMode::frames, one_necklace(steps.front()));
  rig.run(steps);
  EXPECT_EQ(rig.history.events.size(), 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.failed, 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.never_failing,
            rig.structure.statistics.certificates.created);
}

// Four beads start on one circle and two of them leave it outwards, so these two are the basis from the
// start.
TEST(WrappedHierarchy, TiesAtTheStartAreSettledWhenItIsBuilt) {
  for (const BeadId leaves : {0U, 1U}) {
    Space motion(4);
    for (BeadId b = 0; b < 4; ++b)
      for (int k = 0; k < 2; ++k)
        motion.set_coordinate(b, k, b % 2 == 0 ? 0 : 1,
                              (b < 2 ? 1 : -1) * (b % 2 == leaves && k == 1 ? 2.0 : 1.0));
    WrappedRig<Kernel::filtered> rig(motion, AuditMode::events, one_necklace(motion));
    rig.simulator.build();
    EXPECT_EQ(rig.structure.basis(0), Basis(std::array<BeadId, 2>{leaves, leaves + 2}));
    rig.simulator.run_step();
    EXPECT_EQ(rig.history.events.size(), 0U);
  }
}

// Beads jostle slowly: most nodes are skipped, some become active, and the reference moves. Now and then the
// whole chain jumps.
TEST(WrappedHierarchy, NodesAreSkippedInSlowMotion) {
  Random random(5);
  std::vector<Points> frames(1, Points(60));
  for (std::size_t b = 1; b < 60; ++b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      frames[0][b][axis] = frames[0][b - 1][axis] + uniform(random);
  }
  for (int k = 1; k < 40; ++k) {
    frames.push_back(frames.back());
    for (auto& point : frames.back())
      for (double& x : point) x += (k % 13 == 0 ? 0.5 : 0.01) * uniform(random) + 0.3;
  }
  const auto steps = through(frames);
  run_audited(steps);
  EXPECT_EQ(fingerprint_of<Kernel::filtered>(steps, one_necklace(steps.front())),
            fingerprint_of<Kernel::exact>(steps, one_necklace(steps.front())));
}

}  // namespace
}  // namespace kds::wrapped_hierarchy_test
