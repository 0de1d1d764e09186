// The checker proves correct triangulations and no wrong ones. The judges are static builds over rationals,
// the definition with exact signs, and triangulations in which every facet is locally correct while the hull
// winds around twice.

#include "structures/triangulation/regularity_proof.h"

#include <gmock/gmock.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "certificates/formulas/function_values.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/positions.h"
#include "structures/triangulation/exact_triangulation.h"
#include "tests/support/inputs/random.h"

namespace kds::regularity_proof_test {
namespace {

using namespace test;

template <int dimension>
using Line = BezierMotion<dimension, 1>;

template <int dimension>
Line<dimension> random_line(Random& random, BeadId beads, double far, double heaviest) {
  Line<dimension> motion(beads);
  for (BeadId b = 0; b < beads; ++b) {
    for (int axis = 0; axis < dimension; ++axis) {
      const double x = uniform(random, 0, 1);
      motion.set_coordinate(b, 0, axis, x);
      motion.set_coordinate(b, 1, axis, x + uniform(random, -far, far));
    }
    for (int k = 0; k < 2; ++k) motion.set_weight(b, k, b % 5 == 0 ? heaviest : 0);
  }
  return motion;
}

template <int dimension>
StaticTriangulation<dimension> static_at(const Line<dimension>& motion, const Dyadic& time, bool oriented) {
  std::vector<ExactBead> beads(motion.bead_count());
  for (BeadId b = 0; b < beads.size(); ++b) {
    const auto at = exact_position(motion, b, time);
    std::copy(at.begin(), at.end() - 1, beads[b].center.begin());
    beads[b].weight = at.back();
  }
  return static_triangulation<dimension>(beads, oriented);
}

template <int dimension>
struct Built {
  RegularTriangulation<dimension> triangulation;
  std::vector<HiddenBead> hidden;

  Built(const Line<dimension>& motion, const Dyadic& time) {
    const auto built = static_at(motion, time, true);
    triangulation.set_points(control_points(motion, 0), control_weights(motion, 0));
    triangulation.assign(motion.bead_count(), built.cells);
    for (const BeadId bead : built.hidden) hidden.push_back({bead, host_of(motion, bead)});
  }
  [[nodiscard]] bool is_proved(const Line<dimension>& motion, const Dyadic& time,
                               std::span<const char> absent = {}) const {
    return is_proved_regular(triangulation, hidden, RoundedPositions<dimension>(motion, time), absent);
  }
  [[nodiscard]] bool is_proved_by(const SignsOfFunctions<dimension>& judge, const Line<dimension>& motion,
                                  const Dyadic& time) const {
    return is_proved_regular(triangulation, hidden, RoundedPositions<dimension>(motion, time), {}, &judge);
  }

 private:
  /// Finds the cell around a bead at the start, by barycentric coordinates.
  [[nodiscard]] CellId host_of(const Line<dimension>& motion, BeadId bead) const {
    using Matrix = Eigen::Matrix<double, dimension + 1, dimension + 1>;
    using Vector = Eigen::Matrix<double, dimension + 1, 1>;
    const auto at = [&](BeadId b) {
      Vector v;
      for (int axis = 0; axis < dimension; ++axis) v[axis] = motion.coordinate(b, 0, axis);
      v[dimension] = 1;
      return v;
    };
    for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
      const auto& v = triangulation.cells()[cell].vertex;
      if (!triangulation.is_live(cell) || std::find(v.begin(), v.end(), infinite_bead) != v.end()) continue;
      Matrix corners;
      for (int i = 0; i <= dimension; ++i) corners.col(i) = at(v[static_cast<std::size_t>(i)]);
      const Vector shares = corners.fullPivLu().solve(at(bead));
      if (shares.minCoeff() > 0) return cell;
    }
    return no_cell;
  }
};

template <int dimension>
void expect_proof_where_it_is_right() {
  Random random(7);
  const Line<dimension> motion = random_line<dimension>(random, 40, 0.05, 0);
  const Built<dimension> built(motion, Dyadic(0.0));
  int right = 0, wrong = 0;
  for (int k = 0; k < 64; ++k) {
    const Dyadic time(Integer(k * k), 12);
    const bool same = static_at(motion, time, false).cells == built.triangulation.finite_cells();
    EXPECT_EQ(built.is_proved(motion, time), same) << k;
    ++(same ? right : wrong);
  }
  EXPECT_GT(right, 2);
  EXPECT_GT(wrong, 2);
}

TEST(RegularityProof, IsProvedWhereTheStaticBuildIsTheSame) {
  expect_proof_where_it_is_right<2>();
  expect_proof_where_it_is_right<3>();
}

template <int dimension>
void expect_hidden_beads_are_looked_at() {
  Random random(3);
  Line<dimension> motion = random_line<dimension>(random, 60, 0, 0.1);
  const Dyadic start(0.0);
  Built<dimension> built(motion, start);
  ASSERT_GT(built.hidden.size(), 3U);
  EXPECT_TRUE(built.is_proved(motion, start));
  const HiddenBead last = built.hidden.back();
  built.hidden.back().host = built.hidden.front().host == last.host ? no_cell : built.hidden.front().host;
  EXPECT_FALSE(built.is_proved(motion, start));
  built.hidden.pop_back();
  EXPECT_FALSE(built.is_proved(motion, start));
  std::vector<char> absent(60, 0);
  absent[last.bead] = 1;
  EXPECT_TRUE(built.is_proved(motion, start, absent));
  absent[built.triangulation.finite_cells()[0][0]] = 1;
  EXPECT_FALSE(built.is_proved(motion, start, absent));
  motion.set_weight(built.hidden[0].bead, 0, 10);
  EXPECT_FALSE(built.is_proved(motion, start));
}

TEST(RegularityProof, HiddenAndAbsentBeadsAreLookedAt) {
  expect_hidden_beads_are_looked_at<2>();
  expect_hidden_beads_are_looked_at<3>();
}

/// Makes cells around the origin, or around an edge through it, that wind around `turns` times. The beads
/// after the first `axis` beads lie on a circle.
template <int dimension>
bool is_fan_proved(int turns) {
  constexpr BeadId axis = dimension - 1, rim = 9;
  Line<dimension> motion(axis + rim);
  for (int k = 0; k < 2; ++k) {
    if (dimension == 3) {
      motion.set_coordinate(0, k, 2, 0.5);
      motion.set_coordinate(1, k, 2, -0.5);
    }
    for (BeadId b = 0; b < rim; ++b) {
      const double angle = 2 * std::numbers::pi * turns * b / rim;
      motion.set_coordinate(axis + b, k, 0, std::cos(angle));
      motion.set_coordinate(axis + b, k, 1, std::sin(angle));
    }
  }
  std::vector<CellBeads<dimension>> cells;
  const auto with_infinity = [](CellBeads<dimension> cell, std::size_t place) {
    cell[place] = infinite_bead;
    std::swap(cell[(place + 1) % (dimension + 1)], cell[(place + 2) % (dimension + 1)]);
    return cell;
  };
  for (BeadId b = 0; b < rim; ++b) {
    CellBeads<dimension> cell{};
    for (BeadId a = 0; a < axis; ++a) cell[a] = axis - 1 - a;
    cell[axis] = axis + b;
    cell[axis + 1] = axis + (b + 1) % rim;
    cells.push_back(cell);
    for (BeadId a = 0; a < axis; ++a) cells.push_back(with_infinity(cell, a));
  }
  RegularTriangulation<dimension> triangulation;
  triangulation.set_points(control_points(motion, 0), control_weights(motion, 0));
  triangulation.assign(motion.bead_count(), cells);
  return is_proved_regular<dimension>(triangulation, {}, RoundedPositions<dimension>(motion, Dyadic(0.5)));
}

TEST(RegularityProof, AHullThatWindsTwiceIsNotProved) {
  EXPECT_TRUE(is_fan_proved<2>(1));
  EXPECT_FALSE(is_fan_proved<2>(2));
  EXPECT_TRUE(is_fan_proved<3>(1));
  EXPECT_FALSE(is_fan_proved<3>(2));
}

TEST(RegularityProof, TiesAreNotProved) {
  Line<2> square(4);
  for (int k = 0; k < 2; ++k)
    for (BeadId b = 0; b < 4; ++b)
      for (int axis = 0; axis < 2; ++axis) square.set_coordinate(b, k, axis, b >> axis & 1);
  EXPECT_FALSE(Built<2>(square, Dyadic(0.0)).is_proved(square, Dyadic(0.0)));
  square.set_weight(3, 1, 0.25);
  EXPECT_TRUE(Built<2>(square, Dyadic(0.5)).is_proved(square, Dyadic(0.5)));
}

/// Makes integer coordinates of a small range, with half of the beads at rest, so that many facets are ties.
template <int dimension>
Line<dimension> random_lattice_line(Random& random, BeadId beads) {
  Line<dimension> motion(beads);
  for (BeadId b = 0; b < beads; ++b) {
    for (int axis = 0; axis < dimension; ++axis) {
      const int start = pick(random, 0, 4);
      motion.set_coordinate(b, 0, axis, start);
      motion.set_coordinate(b, 1, axis, b % 2 == 0 ? start : start + pick(random, -1, 1));
    }
  }
  return motion;
}

template <int dimension>
void expect_the_definition_where_signs_are_zero() {
  Random random(11);
  int proved = 0, refused = 0, proved_by_doubles = 0;
  for (int scene = 0; scene < 300; ++scene) {
    const Line<dimension> motion = random_lattice_line<dimension>(random, dimension == 2 ? 8 : 12);
    const Built<dimension> built(motion, Dyadic(0.0));
    if (built.triangulation.finite_cells().empty()) continue;
    for (int k = 0; k <= 8; k += 2) {
      const Dyadic time(Integer(k), 4);
      const auto sign = [&](const auto& function) {
        using Function = std::decay_t<decltype(function)>;
        return FunctionValues<Function, Curves<dimension>>::sign_at(function, Curves<dimension>(motion),
                                                                    time);
      };
      const SignsBy<dimension, decltype(sign)> judge(sign);
      const bool is_right =
          !regularity_fault(built.triangulation, motion.bead_count(), built.hidden, false, judge).has_value();
      const bool is_proved = built.is_proved_by(judge, motion, time);
      const bool hosts_known = std::all_of(built.hidden.begin(), built.hidden.end(),
                                           [](const HiddenBead& h) { return h.host != no_cell; });
      EXPECT_TRUE(is_right || !is_proved) << scene << ' ' << k;
      EXPECT_TRUE(is_proved || !is_right || !hosts_known) << scene << ' ' << k;
      ++(is_proved ? proved : refused);
      proved_by_doubles += built.is_proved(motion, time) ? 1 : 0;
    }
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(refused, 100);
  EXPECT_LT(proved_by_doubles, proved / 2);
}

TEST(RegularityProof, AJudgeOfTiesProvesWhatTheDefinitionAllows) {
  expect_the_definition_where_signs_are_zero<2>();
  expect_the_definition_where_signs_are_zero<3>();
}

}  // namespace
}  // namespace kds::regularity_proof_test
