// The closest pair by nearest images, judged by all images of all pairs over whole numbers.

#include <gmock/gmock.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "structures/closest/kinetic_closest_pair.h"
#include "structures/closest/least_distance.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_cells.h"
#include "tests/support/judges/moving_points.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::periodic_closest_pair_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

template <Motion M>
using ClosestRig = Rig<KineticClosestPair<M::dimension>, M>;

/// Beads, then the vectors of the cell.
template <Motion M>
ExactPoints points_and_vectors_at(const M& motion, const second::Rational& u) {
  const auto cell_coordinates = [&](int vector, int axis) {
    std::vector<double> x;
    for (int k = 0; k <= M::degree; ++k)
      x.push_back(motion.cell()[(vector * (M::degree + 1) + k) * M::dimension + axis]);
    return x;
  };
  const auto bead_coordinates = [&](BeadId bead, int axis) {
    std::vector<double> x;
    for (int k = 0; k <= M::degree; ++k) x.push_back(motion.coordinate(bead, k, axis));
    return x;
  };
  std::vector<std::vector<std::vector<double>>> curves;
  std::vector<double> all;
  const auto add = [&](const auto& coordinates, auto point) {
    auto& curve = curves.emplace_back();
    for (int axis = 0; axis < M::dimension; ++axis) {
      curve.push_back(coordinates(point, axis));
      all.insert(all.end(), curve.back().begin(), curve.back().end());
    }
  };
  for (BeadId b = 0; b < motion.bead_count(); ++b) add(bead_coordinates, b);
  for (int vector = 0; vector < M::dimension; ++vector) add(cell_coordinates, vector);
  ExactPoints points;
  for (const auto& curve : curves) {
    auto& point = points.emplace_back();
    for (const auto& x : curve) point.push_back(second::whole_value(x, u, second::unit_of(all)));
  }
  return points;
}

/// Returns the square of the distance of the nearest images, among those within `most` cell vectors.
second::Integer least_square(const ExactPoints& at, BeadId a, BeadId b, std::size_t beads, int most) {
  std::optional<second::Integer> least;
  const std::size_t dimension = at.size() - beads;
  std::vector<int> shift(dimension, -most);
  for (;;) {
    second::Integer square = 0;
    for (std::size_t axis = 0; axis < dimension; ++axis) {
      second::Integer d = at[b][axis] - at[a][axis];
      for (std::size_t v = 0; v < dimension; ++v) d += shift[v] * at[beads + v][axis];
      square += d * d;
    }
    if (!least || square < *least) least = square;
    std::size_t v = 0;
    while (v < dimension && ++shift[v] > most) shift[v++] = -most;
    if (v == dimension) return *least;
  }
}

template <Motion M>
std::optional<std::string> fault_of(const KineticClosestPair<M::dimension>& closest, const M& motion,
                                    const second::Rational& u, int most) {
  const ExactPoints at = points_and_vectors_at(motion, u);
  const std::size_t beads = motion.bead_count();
  const auto [i, j] = *closest.pair();
  const second::Integer known = least_square(at, i, j, beads, most);
  for (BeadId a = 0; a < beads; ++a)
    for (BeadId b = a + 1; b < beads; ++b)
      if (least_square(at, a, b, beads, most) < known)
        return text_of("beads ", a, " and ", b, " are closer than ", i, " and ", j);
  return std::nullopt;
}

template <Motion M>
History expect_right(const std::vector<M>& steps, int most) {
  ClosestRig<M> filtered(steps.front(), AuditMode::events);
  filtered.motion = steps.front();
  const Witness witness(filtered.simulator, [&](const Dyadic& time) {
    return fault_of(filtered.structure, filtered.motion, second::of(time), most);
  });
  EXPECT_NO_THROW(filtered.run(steps));
  EXPECT_TRUE(books_balance(filtered.structure.statistics));
  ClosestRig<M> exact(steps.front(), AuditMode::none, Kernel::exact);
  exact.run(steps);
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
  EXPECT_EQ(exact.structure.pair(), filtered.structure.pair());
  return filtered.history;
}

std::vector<std::string> told(const History& history) {
  std::vector<std::string> lines;
  for (const Event& e : history.events) {
    const auto& ids = e.change.ids;
    if (e.change.kind == KineticClosestPair<3>::replace)
      lines.push_back(text_of(ids[0], " ", ids[1], " to ", ids[2], " ", ids[3], " at ",
                              static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  }
  return lines;
}

TEST(PeriodicClosestPair, AcrossAWall) {
  Space step = moving({{0, 0, 0}, {4, 0, 0}, {9, 0, 0}}, {{0, 0, 0}, {4, 0, 0}, {15, 0, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step}, 2)), ElementsAre("0 1 to 0 2 at 0.5"));
  step.own_cell().set(box(0, 16, 16), box(0, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step}, 2)), IsEmpty());
}

TEST(PeriodicClosestPair, AnotherImageOfTheSamePairIsNoEvent) {
  Space step = moving({{0, 0, 0}, {0, 0, 0}, {0, 6, 0}}, {{0, 0, 0}, {16, 0, 0}, {0, 6, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step}, 2)),
              ElementsAre("0 1 to 0 2 at 0.375", "0 2 to 0 1 at 0.625"));
  step = moving({{0, 0, 0}, {0, 0, 0}, {0, 8, 0}}, {{0, 0, 0}, {16, 0, 0}, {0, 8, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  EXPECT_THAT(told(expect_right<Space>({step}, 2)), IsEmpty());
}

TEST(PeriodicClosestPair, AuditsNoticeAPairThatIsNotTheClosest) {
  Space step = moving({{0, 0, 0}, {4, 0, 0}, {15, 0, 0}}, {{0, 0, 0}, {4, 0, 0}, {15, 0, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  ClosestRig<Space> rig(step);
  rig.run(std::vector<Space>{step});
  EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
  rig.structure.apply({KineticClosestPair<3>::replace, 4, {0, 2, 0, 1}});
  EXPECT_NE(rig.structure.audit(Dyadic(0.5)), std::nullopt);
}

// Beads that follow each other along the chain are far apart, as in a slab.
TEST(PeriodicClosestPair, OfAThinCell) {
  Space step = moving({{0, 0, 0}, {0, 0, 400}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 400}, {3, 0, 0}});
  step.own_cell().set(box(10, 10, 0), box(10, 10, 0), 1);
  ClosestRig<Space> rig(step);
  rig.run(std::vector<Space>{step});
  EXPECT_THAT(*rig.structure.pair(), ElementsAre(0, 2));
}

TEST(PeriodicClosestPair, LeastDistanceOfAnImage) {
  Space step = moving({{0, 0, 0}, {12, 1, 0}}, {{0, 0, 0}, {20, 1, 0}});
  step.own_cell().set(box(16, 16, 16), box(16, 16, 16), 1);
  const LeastDistance least = least_distance(Curves<3>(step), 0, 1, {-1, 0, 0});
  EXPECT_LE(least.lower, 1);
  EXPECT_GE(least.upper, 1);
  EXPECT_LT(least.upper - least.lower, 1e-9);
  EXPECT_NEAR(least.at, 0.5, 1e-4);
}

template <class M>
void expect_random_scenes_right(int count) {
  Random random(53);
  for (int round = 0; round < rounds(count, 1); ++round) {
    for (const CellKind kind : cell_kinds(M::dimension)) {
      for (const bool on_grid : {false, true}) {
        SCOPED_TRACE(text_of("round ", round, ", cell ", static_cast<int>(kind), on_grid ? ", grid" : ""));
        expect_right(random_steps_in_cell<M>(random, kind, 2 + random() % 3, on_grid),
                     kind == CellKind::small ? 8 : 5);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(PeriodicClosestPair, RandomInSpace) { expect_random_scenes_right<BezierMotion<3, 1>>(1); }
TEST(PeriodicClosestPair, RandomInThePlane) { expect_random_scenes_right<BezierMotion<2, 1>>(8); }
TEST(PeriodicClosestPair, RandomOfHigherDegree) { expect_random_scenes_right<BezierMotion<2, 3>>(2); }

}  // namespace
}  // namespace kds::periodic_closest_pair_test
