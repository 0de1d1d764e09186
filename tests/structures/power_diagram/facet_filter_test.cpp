// The filter reports a facet as positive only if its certificate, judged in integers, never fails, and a cell
// as positive only if the cell is positive, judged in integers. The filter examines every facet once.

#include "structures/power_diagram/facet_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "certificates/search/certificate_search.h"
#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/exact_number.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/rounds.h"

namespace kds::facet_filter_test {
namespace {

/// Judges a certificate in integers. Returns 0 if it does not hold at the start, a number above 1 if it never
/// fails in the step, and otherwise a time not after its failure.
template <class Certificate, Motion M>
double failure_of(const M& motion, const Certificate& certificate) {
  const KnownAtStart known = KnownAtStart::unknown;
  StageCounts stages;
  Failure failure;
  search_over<Certificate>(MotionRef<M::dimension>(motion))
      ->first_failures(Kernel::exact, {&certificate, 1}, Instant(0), {&known, 1}, stages,
                       TouchPolicy::ignored, {&failure, 1});
  if (failure.kind == Failure::Kind::never) return 2;
  return failure.kind == Failure::Kind::later ? failure.time.upper : 0;
}

template <int dimension>
PowerTest<dimension> power_test(const TriangulationCell<dimension>& cell, int facet) {
  decltype(PowerTest<dimension>::beads) beads{};
  std::copy(cell.vertex.begin(), cell.vertex.end(), beads.begin());
  beads.back() = cell.apex[static_cast<std::size_t>(facet)];
  return PowerTest<dimension>(beads, 1);
}

template <Motion M>
bool holds(const M& motion, const TriangulationCell<M::dimension>& cell, int facet) {
  return failure_of(motion, power_test(cell, facet)) > 1;
}

/// Judges the orientation of a cell at the end of the step, in integers.
template <Motion M>
bool is_positive_at_end(const M& motion, const TriangulationCell<M::dimension>& cell) {
  return search_over<Orientation<M::dimension>>(MotionRef<M::dimension>(motion))
             ->sign_at(Orientation<M::dimension>(cell.vertex, 1), Dyadic(1.0)) > 0;
}

/// Judges the orientation of a cell at some times of the step, in integers.
template <Motion M>
bool is_positive_throughout(const M& motion, const TriangulationCell<M::dimension>& cell) {
  const auto search = search_over<Orientation<M::dimension>>(MotionRef<M::dimension>(motion));
  bool positive = true;
  for (int k = 0; k <= 16; ++k)
    positive = positive && search->sign_at(Orientation<M::dimension>(cell.vertex, 1), Dyadic(k / 16.0)) > 0;
  return positive;
}

/// Counts the cells that have a fact proved in a part of the step only.
std::uint64_t found_in_parts = 0;

template <int dimension>
struct Found {
  std::set<FacetId> doubts;
  std::map<CellId, bool> ends, throughout;

  std::map<CellId, unsigned> positive;

  void operator()(CellId cell, unsigned wanted, unsigned orientation) {
    positive[cell] = orientation;
    for (int i = 0; i <= dimension; ++i) {
      if ((wanted >> i & 1U) != 0 && (orientation >> i & 1U) == 0) {
        EXPECT_TRUE(doubts.insert(facet_id(cell, i)).second) << cell << ' ' << i;
      }
    }
    EXPECT_TRUE(ends.emplace(cell, (orientation & positive_at_end<dimension>) != 0).second) << cell;
    EXPECT_TRUE(throughout.emplace(cell, (orientation & positive_throughout<dimension>) != 0).second);
  }
};

/// Returns a cell of the first beads with another bead beyond each facet, and the same cell with the opposite
/// orientation.
template <int dimension>
std::array<TriangulationCell<dimension>, 2> cell_both_ways() {
  TriangulationCell<dimension> cell;
  for (BeadId i = 0; i <= dimension; ++i) {
    cell.vertex[i] = i;
    cell.apex[i] = dimension + 1 + i;
  }
  TriangulationCell<dimension> turned = cell;
  std::swap(turned.vertex[0], turned.vertex[1]);
  return {cell, turned};
}

/// Checks a filter of parts of the step: it finds everything that the filter of the whole step finds (`all`),
/// and its findings for parts are correct in integers. A filter of cells alone finds the same.
template <Motion M>
void expect_right_in_parts(const M& motion, std::span<const TriangulationCell<M::dimension>> cells,
                           const Found<M::dimension>& all, const LengthUnit& unit) {
  constexpr int dimension = M::dimension;
  const auto filter = cell_filter_over(MotionRef<dimension>(motion), FilterOf::parts);
  Found<dimension> parts, bare;
  FacetFilter positive(*filter, unit), positive_bare(*filter, unit);
  for (CellId id = 0; id < cells.size(); ++id) {
    positive.look_at(cells[id], id, all_facets<dimension>, parts);
    positive_bare.look_at(cells[id], id, 0, bare);
  }
  positive.finish(parts);
  positive_bare.finish(bare);
  constexpr unsigned of_step = (1U << bits_of_part) - 1;
  constexpr unsigned of_cells = positive_at_end<dimension> | positive_throughout<dimension> * 0x01010101U;
  for (CellId id = 0; id < cells.size(); ++id) {
    const unsigned found = parts.positive.at(id);
    EXPECT_EQ(found & of_step, all.positive.at(id));
    EXPECT_EQ(found & of_cells, bare.positive.at(id));
    for (int part = 1; part <= positive_parts; ++part) {
      const unsigned in_part = found >> (part * bits_of_part);
      const double end = std::ldexp(1.0, -part);
      for (int i = 0; i <= dimension; ++i) {
        if ((in_part >> i & 1U) != 0) {
          EXPECT_GE(failure_of(motion, power_test(cells[id], i)), end);
        }
      }
      if ((in_part & positive_throughout<dimension>) != 0) {
        EXPECT_GE(failure_of(motion, Orientation<dimension>(cells[id].vertex, 1)), end);
      }
      found_in_parts += (found & of_step) == 0 && in_part != 0 ? 1 : 0;
    }
  }
}

/// Examines all facets of some cells and judges the result. The unit of length is off by a factor of 2^off.
template <Motion M>
void expect_right(const M& motion, std::span<const TriangulationCell<M::dimension>> cells,
                  std::uint64_t& found, int off = 0) {
  Found<M::dimension> all, some;
  const LengthUnit unit(exponent_of_length(Curves<M::dimension>(motion), cells) + off);
  const auto filter = cell_filter_over(MotionRef<M::dimension>(motion));
  FacetFilter positive(*filter, unit);
  for (CellId id = 0; id < cells.size(); ++id) positive.look_at(cells[id], id, all_facets<M::dimension>, all);
  positive.finish(all);
  positive.finish(all);  // no facet is left to finish
  const std::set<FacetId>& doubts = all.doubts;
  EXPECT_EQ(positive.count() + doubts.size(), cells.size() * (M::dimension + 1));
  EXPECT_EQ(all.ends.size(), cells.size());
  for (CellId id = 0; id < cells.size(); ++id) {
    for (int i = 0; i <= M::dimension; ++i)
      EXPECT_TRUE(doubts.contains(facet_id(id, i)) || holds(motion, cells[id], i)) << id << ' ' << i;
    EXPECT_TRUE(!all.ends[id] || is_positive_at_end(motion, cells[id])) << id;
    EXPECT_TRUE(!all.throughout[id] || is_positive_throughout(motion, cells[id])) << id;
  }
  found += positive.count();
  // Examining some facets, or none, gives the same result for these facets.
  FacetFilter positive_of_some(*filter, unit);
  std::vector<unsigned> wanted;
  for (CellId id = 0; id < cells.size(); ++id) {
    wanted.push_back((5 * id + cells[0].vertex.size() * found + doubts.size()) & all_facets<M::dimension>);
    positive_of_some.look_at(cells[id], id, wanted[id], some);
  }
  positive_of_some.finish(some);
  for (CellId id = 0; id < cells.size(); ++id) {
    for (int i = 0; i <= M::dimension; ++i)
      EXPECT_EQ(some.doubts.contains(facet_id(id, i)),
                (wanted[id] >> i & 1U) != 0 && doubts.contains(facet_id(id, i)));
    EXPECT_TRUE(!some.ends.at(id) || is_positive_at_end(motion, cells[id])) << id;
  }
  if constexpr (!lifted<M> && M::degree == 1) expect_right_in_parts(motion, cells, all, unit);
  // Examining a few facets at a time gives the same result.
  std::vector<CellId> few;
  for (CellId id = 0; id < cells.size() && id < few_cells; ++id) {
    few.push_back(id);
    const auto of_few = filter_few_cells(*filter, unit, cells, few);
    for (const CellId cell : few) EXPECT_EQ(of_few[cell], all.positive[cell]) << cell;
  }
}

template <Motion M>
void slow_down(M& motion) {
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int k = 1; k <= M::degree; ++k) {
      for (int axis = 0; axis < M::dimension; ++axis)
        motion.set_coordinate(b, k, axis,
                              motion.coordinate(b, 0, axis) * 0.99 + 0.01 * motion.coordinate(b, k, axis));
    }
  }
}

/// Makes a motion of the beads of two cells, generic and so slow that some facets hold throughout the step.
template <Motion M>
M slow_motion(test::Random& random) {
  M motion = test::random_motion<M>(random, 2 * (M::dimension + 1), test::MotionKind::generic);
  slow_down(motion);
  return motion;
}

template <Motion M>
void expect_right(const M& motion, std::uint64_t& found, int off = 0) {
  expect_right<M>(motion, cell_both_ways<M::dimension>(), found, off);
}

template <Motion M>
void compare(std::uint64_t least_found) {
  test::Random random(77);
  std::uint64_t found = 0;
  for (int round = 0; round < 30; ++round) {
    for (const test::MotionKind kind : test::all_motion_kinds) {
      M motion = test::random_motion<M>(random, 2 * (M::dimension + 1), kind);
      if (round % 2 == 0) slow_down(motion);  // slow enough that some facets hold throughout the step
      expect_right(motion, found);
    }
  }
  EXPECT_GT(found, least_found);
}

TEST(FacetFilter, HoldAllOverTheStep) {
  found_in_parts = 0;
  compare<BezierMotion<3, 1>>(200);
  EXPECT_GT(found_in_parts, 50U);
  compare<BezierMotion<2, 1>>(200);
  compare<BezierMotion<3, 3>>(100);
  compare<LiftedMotion<3>>(100);
  compare<LiftedMotion<2>>(100);
}

// Corners of a cube and its mirror image, moved by ever smaller amounts, down to where floats round away the
// deciding digits.
TEST(FacetFilter, HoldNextToZero) {
  using M = BezierMotion<3, 1>;
  test::Random random(5);
  std::uint64_t found = 0;
  for (int places = 4; places < 45; ++places) {
    for (int round = 0; round < test::rounds(100); ++round) {
      M motion(8);
      for (BeadId b = 0; b < 8; ++b) {
        for (int axis = 0; axis < 3; ++axis) {
          const double corner = (b >> axis & 1U) != 0 ? 1 : -1;
          for (int k = 0; k < 2; ++k)
            motion.set_coordinate(b, k, axis, corner + std::ldexp(test::uniform(random), -places));
        }
      }
      auto cells = cell_both_ways<3>();
      for (auto& cell : cells) {
        std::swap(cell.vertex[3], cell.apex[0]);  // corners 0, 1, 2 and 4 are not coplanar
      }
      expect_right<M>(motion, cells, found);
    }
  }
  EXPECT_GT(found, test::rounds(1000U));
}

/// Multiplies all lengths by 2^exponent, which is exact.
template <Motion M>
void scale_with_drift(M& motion, int exponent) {
  test::scale(motion, exponent);
  if constexpr (lifted<M>) {
    auto drift = typename M::Vector{};
    for (int axis = 0; axis < M::dimension; ++axis)
      drift[static_cast<std::size_t>(axis)] = std::ldexp(motion.drift(axis), exponent);
    motion.set_drift(drift);
  }
}

// The unit of length does not change the result, as long as doubles can represent the numbers.
template <Motion M>
void expect_same_at_any_scale() {
  test::Random random(6);
  constexpr int rounds = 4;
  std::array<std::uint64_t, rounds> expected{};
  std::uint64_t all = 0;
  for (int round = 0; round < rounds; ++round) {
    M base = slow_motion<M>(random);
    if constexpr (lifted<M>) {
      auto drift = typename M::Vector{};
      for (double& x : drift) x = 0.01 * test::uniform(random);
      base.set_drift(drift);
    }
    expect_right(base, expected[static_cast<std::size_t>(round)]);
    all += expected[static_cast<std::size_t>(round)];
    for (const int exponent : {-300, -150, -60, -20, -11, -1, 1, 11, 20, 60, 150, 300}) {
      M motion = base;
      scale_with_drift(motion, exponent);
      std::uint64_t found = 0;
      expect_right(motion, found);
      EXPECT_EQ(found, expected[static_cast<std::size_t>(round)]) << exponent;
    }
  }
  EXPECT_GT(all, 0U);
}

TEST(FacetFilter, FindTheSameAtAnyScale) {
  expect_same_at_any_scale<BezierMotion<3, 1>>();
  expect_same_at_any_scale<BezierMotion<2, 1>>();
  expect_same_at_any_scale<LiftedMotion<3>>();
}

// In a unit that is far off the filter finds nothing. At the limits for which the bound is stated, everything
// found is correct.
TEST(FacetFilter, HoldInAnyUnit) {
  using M = BezierMotion<3, 1>;
  test::Random random(6);
  for (int exponent = -160; exponent <= 160; exponent += 4) {
    std::uint64_t found = 0;
    for (int round = 0; round < 4; ++round) {
      M motion = slow_motion<M>(random);
      expect_right(motion, found, exponent);
    }
    if (std::abs(exponent) <= 8) {
      EXPECT_GT(found, 0U) << exponent;
    }
    if (std::abs(exponent) >= 20) {
      EXPECT_EQ(found, 0U) << exponent;
    }
  }
}

// Rows of very different lengths: some beads are a thousand times farther away, or nearer, than others.
TEST(FacetFilter, HoldWhereRowsAreUnlike) {
  using M = BezierMotion<3, 1>;
  test::Random random(8);
  std::uint64_t found = 0;
  for (int round = 0; round < test::rounds(300); ++round) {
    M motion = slow_motion<M>(random);
    for (BeadId b = 1; b < 8; ++b) {
      const int exponent = static_cast<int>(random() % 13) - 6;
      for (int k = 0; k < 2; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
          const double origin = motion.coordinate(0, k, axis);
          motion.set_coordinate(b, k, axis,
                                origin + std::ldexp(motion.coordinate(b, k, axis) - origin, exponent));
        }
        motion.set_weight(b, k, motion.weight(0, k));
      }
    }
    expect_right(motion, found);
  }
  EXPECT_GT(found, test::rounds(200U));
}

// Weights that differ by the largest amount that the bound allows, m^2 of a row, or by an ulp more or less.
TEST(FacetFilter, HoldWhereWeightsAreAsLargeAsTheyMayBe) {
  using M = BezierMotion<3, 1>;
  test::Random random(9);
  std::uint64_t found = 0;
  for (int round = 0; round < test::rounds(600); ++round) {
    M motion = slow_motion<M>(random);
    for (BeadId b = 1; b < 8; ++b) {
      float m = 0;
      for (int k = 0; k < 2; ++k) {
        for (int axis = 0; axis < 3; ++axis)
          m = std::max(
              m, std::abs(static_cast<float>(motion.coordinate(b, k, axis) - motion.coordinate(0, k, axis))));
      }
      double square = static_cast<double>(m * m);
      if (round % 3 != 0) square = std::nextafter(square, round % 3 == 1 ? 0.0 : 1e9);
      for (int k = 0; k < 2; ++k)
        motion.set_weight(b, k, motion.weight(0, k) + (random() % 2 == 0 ? square : -square));
    }
    expect_right(motion, found);
  }
  EXPECT_GT(found, test::rounds(50U));
}

// Any common drift may be subtracted from all beads: the verdicts stay correct.
TEST(FacetFilter, HoldWithDrift) {
  using M = LiftedMotion<3>;
  test::Random random(10);
  std::uint64_t found = 0;
  for (int round = 0; round < test::rounds(300); ++round) {
    M motion = slow_motion<M>(random);
    const double size = std::ldexp(1.0, static_cast<int>(random() % 12) - 10);
    M::Vector drift;
    for (double& x : drift) x = size * test::uniform(random);
    motion.set_drift(drift);
    expect_right(motion, found);
  }
  EXPECT_GT(found, test::rounds(100U));
}

// The code for each vector target gives the same bits.
TEST(FacetFilter, AreTheSameOnAnyProcessor) {
  using M = BezierMotion<3, 1>;
  test::Random random(11);
  for (int round = 0; round < test::rounds(100); ++round) {
    M motion = slow_motion<M>(random);
    const auto filter = cell_filter_over(MotionRef<3>(motion));
    const auto filter_for_any = cell_filter_for_any_processor(MotionRef<3>(motion));
    CellsInLanes<3> cells;
    for (auto& beads : cells) {
      for (BeadId i = 0; i < beads.size(); ++i) beads[i] = (i + static_cast<BeadId>(random() % 8)) % 8;
    }
    PositiveBits best, any;
    for (std::size_t beyond = 0; beyond <= 4; ++beyond) {
      filter->positive_cells(cells, beyond, LengthUnit(), best);
      filter_for_any->positive_cells(cells, beyond, LengthUnit(), any);
      EXPECT_EQ(best, any);
    }
  }
}

template <int dimension>
void expect_each_once() {
  test::Random random(7);
  Eigen::Matrix3Xd centers(3, 200);
  for (auto& x : centers.reshaped()) x = test::uniform(random);
  RegularTriangulation<dimension> triangulation;
  static_cast<void>(triangulation.build(centers, std::vector<double>(200, 0.0)));
  const auto cells = triangulation.cells();
  FacetCover cover;
  cover.start(cells.size());
  std::map<FacetId, int> times;
  std::size_t left_out = 0;
  for (CellId id = 0; id < cells.size(); ++id) {
    const unsigned finite = finite_facets(cells[id]);
    const unsigned facets = cover.facets_of(cells[id], id, finite == all_facets<dimension>);
    left_out += facets == 0 ? 1 : 0;
    EXPECT_EQ(finite == 0, std::find(cells[id].vertex.begin(), cells[id].vertex.end(), infinite_bead) !=
                               cells[id].vertex.end());
    for (int i = 0; i <= dimension; ++i) {
      const FacetId here = facet_id(id, i);
      EXPECT_EQ(finite == 0 || (finite >> i & 1U) != 0,
                finite == 0 || triangulation.apex_beyond(id, i) != infinite_bead);
      if ((facets >> i & 1U) != 0) ++times[std::min(here, triangulation.beyond(id, i))];
    }
  }
  EXPECT_EQ(times.size(), cells.size() * (dimension + 1) / 2);
  for (const auto& [facet, count] : times) EXPECT_EQ(count, 1) << facet;
  EXPECT_GT(4 * left_out, cells.size());
}

TEST(FacetCover, HasEachFacetOnce) {
  expect_each_once<3>();
  expect_each_once<2>();
}

// Facets with an infinite vertex are never reported as positive, and do not disturb other facets.
TEST(FacetFilter, OfAFewAreFinite) {
  using M = BezierMotion<3, 1>;
  test::Random random(8);
  std::uint64_t found = 0;
  for (int round = 0; round < test::rounds(50); ++round) {
    M motion = slow_motion<M>(random);
    const auto [cell, turned] = cell_both_ways<3>();
    auto infinite = cell, beside_infinite = turned;
    infinite.vertex[2] = infinite_bead;
    beside_infinite.apex[1] = infinite_bead;
    const std::array cells{infinite, cell, infinite, beside_infinite};
    const std::array<CellId, 4> few{0, 1, 2, 3};
    const LengthUnit unit(exponent_of_length(Curves<3>(motion), cells));
    const auto filter = cell_filter_over(MotionRef<3>(motion));
    const auto facets = filter_few_cells(*filter, unit, cells, few);
    EXPECT_EQ(facets[0], 0U);
    EXPECT_EQ(facets[2], 0U);
    EXPECT_EQ(facets[3] & 2U, 0U);
    for (const CellId id : {1U, 3U}) {
      for (int i = 0; i < 4; ++i) {
        if ((facets[id] >> i & 1U) == 0) continue;
        ++found;
        EXPECT_TRUE(holds(motion, cells[id], i));
      }
    }
    EXPECT_EQ(filter_few_cells(*filter, unit, cells, std::array<CellId, 1>{0})[0], 0U);
  }
  EXPECT_GT(found, test::rounds(20U));
}

}  // namespace
}  // namespace kds::facet_filter_test
