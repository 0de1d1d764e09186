#include "structures/dual_complex/union_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "structures/dual_complex/dual_complex.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/regular_triangulation.h"
#include "structures/triangulation/static_dual_complex.h"
#include "tests/support/judges/cgal_triangulation.h"
#include "tests/support/judges/union_of_balls.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"

namespace kds::union_measures_test {
namespace {

using test::from_environment;
using test::rounds;
using test::UnionOfBalls;

constexpr double pi = std::numbers::pi;

struct Scene {
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;

  void add(double x, double y, double z, double radius) {
    centers.conservativeResize(3, centers.cols() + 1);
    centers.rightCols(1) << x, y, z;
    radii.push_back(radius);
  }
  [[nodiscard]] std::vector<double> weights() const {
    std::vector<double> weights;
    for (const double radius : radii) weights.push_back(radius * radius);
    return weights;
  }
  [[nodiscard]] ComplexSimplices complex() const { return static_dual_complex(centers, weights()); }
  [[nodiscard]] UnionMeasures measure() const { return measure_union(centers, radii, complex()); }
};

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double sphere(double radius) { return 4 * pi * radius * radius; }
double ball(double radius) { return sphere(radius) * radius / 3; }

/// Compares all measures with those of the judge, relative to each bead's own ball. Contacts of equal cells
/// that tie may be those of other beads, so such scenes compare none.
void compare(const Scene& scene, const std::string& name, bool with_contacts = true) {
  SCOPED_TRACE(name);
  const ComplexSimplices complex = scene.complex();
  const UnionMeasures found = measure_union(scene.centers, scene.radii, complex);
  const UnionOfBalls judge(scene.centers, scene.radii);
  constexpr double tolerance = 1e-9;
  for (std::size_t i = 0; i < scene.radii.size(); ++i) {
    const double radius = scene.radii[i];
    EXPECT_NEAR(found.areas[i], judge.area(i), tolerance * sphere(radius)) << "area of ball " << i;
    EXPECT_NEAR(found.volumes[i], judge.volume(i), tolerance * ball(radius)) << "volume of ball " << i;
  }
  const double largest = *std::max_element(scene.radii.begin(), scene.radii.end());
  EXPECT_NEAR(total(found.volumes), judge.volume(), tolerance * ball(largest));
  if (!with_contacts) return;
  std::map<ComplexSimplices::Edge, double> contacts;
  for (std::size_t e = 0; e < complex.edges.size(); ++e) contacts[complex.edges[e]] = found.contacts[e];
  for (BeadId i = 0; i < scene.radii.size(); ++i)
    for (BeadId j = i + 1; j < scene.radii.size(); ++j) {
      const double radius = std::min(scene.radii[i], scene.radii[j]);
      EXPECT_NEAR((contacts[{i, j}]), judge.contact(i, j), tolerance * pi * radius * radius)
          << "contact of balls " << i << " and " << j;
    }
}

Scene random_scene(std::mt19937& random, std::size_t count, double least, double largest) {
  std::uniform_real_distribution<double> place(-1.5, 1.5), radius(std::log(least), std::log(largest));
  Scene scene;
  for (std::size_t i = 0; i < count; ++i)
    scene.add(place(random), place(random), place(random), std::exp(radius(random)));
  return scene;
}

TEST(UnionMeasures, OfOneAndTwoBallsHaveClosedForms) {
  Scene scene;
  scene.add(1, 2, 3, 2);
  EXPECT_NEAR(scene.measure().areas[0], sphere(2), 1e-12 * sphere(2));
  EXPECT_NEAR(scene.measure().volumes[0], ball(2), 1e-12 * ball(2));
  scene.add(4, 2, 3, 2);
  const UnionMeasures two = scene.measure();  // each ball loses a cap of height 1/2
  EXPECT_NEAR(two.areas[1], sphere(2) - 2 * pi, 1e-12 * sphere(2));
  EXPECT_NEAR(two.volumes[1], ball(2) - pi / 3 * 0.25 * 5.5, 1e-12 * ball(2));
  EXPECT_NEAR(two.contacts.at(0), pi * (4 - 2.25), 1e-12 * pi);
}

TEST(UnionMeasures, OfFourEqualBallsHaveClosedForms) {
  for (const double radius : {1.5, 1.7320508, 2.0, 3.0}) {
    Scene scene;
    for (const auto& c : {std::array{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}})
      scene.add(c[0], c[1], c[2], radius);
    const UnionMeasures four = scene.measure();
    for (const double area : four.areas) EXPECT_NEAR(area, four.areas[0], 1e-13 * sphere(radius));
    for (const double contact : four.contacts) EXPECT_NEAR(contact, four.contacts[0], 1e-13 * sphere(radius));
    ASSERT_EQ(four.contacts.size(), 6U);
    if (radius > std::sqrt(3.0)) {
      // The facet is what a disc of radius rho has in a wedge of angle acos(-1/3) whose apex is the origin.
      // The disc's centre is on the wedge's axis, at distance 1 from the apex.
      const double rho = std::sqrt(radius * radius - 2), half = std::acos(-1.0 / 3) / 2;
      const double arc =
          half + std::asin(std::sin(half) / rho);  // from the axis to the side, seen from the centre
      const double wedge = rho * rho * arc + rho * std::sin(arc);
      EXPECT_NEAR(four.contacts[0], wedge, 1e-12 * sphere(radius));
    }
    compare(scene, "radius " + std::to_string(radius));
  }
}

TEST(UnionMeasures, EqualThoseOfAllPairsAndTriples) {
  std::mt19937 random(static_cast<std::uint32_t>(from_environment("KDS_UNION_SEED", 1)));
  for (std::size_t round = 0; round < rounds(12, 2) * from_environment("KDS_UNION_ROUNDS", 1); ++round) {
    const std::string name = "round " + std::to_string(round);
    compare(random_scene(random, 3 + random() % 7, 0.5, 1.5), name);
    compare(random_scene(random, 6, 0.02, 3), name + ", small and large");
    compare(random_scene(random, 9, 1, 1), name + ", equal radii");
  }
}

TEST(UnionMeasures, EqualThoseOfAllPairsAndTriplesForExtremeRadii) {
  std::mt19937 random(5);
  for (int round = 0; round < rounds(6, 1); ++round) {
    Scene scene = random_scene(random, 4, 0.8, 1.5);
    std::normal_distribution<double> normal;
    for (const double tiny : {1e-3, 1e-5}) {  // on the surface of the first ball
      const Eigen::Vector3d on =
          scene.centers.col(0) +
          scene.radii[0] * Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      scene.add(on.x(), on.y(), on.z(), tiny);
      scene.add(on.x() + tiny, on.y(), on.z(), tiny);
    }
    compare(scene, "tiny");
    for (double& radius : scene.radii) radius *= 1024;
    scene.centers *= 1024;
    scene.centers.row(1).array() += 1e6;
    compare(scene, "huge and far");
  }
}

TEST(UnionMeasures, EqualThoseOfAllPairsAndTriplesInDegeneratePositions) {
  Scene lattice, flat, ring, line, needle, inside;
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 2; ++z) lattice.add(x, y, z, 0.75);
  compare(lattice, "lattice, overlapping");
  for (double& radius : lattice.radii) radius = 0.5;
  compare(lattice, "lattice, touching");
  for (double& radius : lattice.radii) radius = std::sqrt(0.5);
  compare(lattice, "lattice, diagonals touching");
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y) flat.add(x, y + 0.25 * x, 0, 0.625 + 0.125 * ((x + y) % 2));
  compare(flat, "in a plane");
  flat.add(1, 1, 1e-7, 0.75);
  flat.add(0.5, 0.5, -1e-9, 0.75);
  flat.add(2.5, 0.5, 1e-5, 0.75);
  compare(flat, "nearly in a plane");
  for (int k = 0; k < 8; ++k)
    ring.add(std::cos(k * pi / 4), std::sin(k * pi / 4), k % 2 == 0 ? 1e-12 : 0, 0.9);
  compare(ring, "nearly on a circle");
  for (int x = 0; x < 5; ++x) line.add(x, 2 * x, -x, 1.5 + 0.25 * (x % 2));
  compare(line, "on a line");
  for (int x = 0; x < 5; ++x) needle.add(x, 1e-8 * (x * x % 3), 1e-9 * (x % 2), 1.25);
  needle.add(2, 1, 0.5, 1);
  compare(needle, "nearly on a line");
  inside.add(0, 0, 0, 2);
  inside.add(1, 0, 0, 1);  // touches the sphere from inside
  inside.add(0.5, 0.5, 0, 0.5);
  inside.add(0, 0, 0, 1);      // same centre
  inside.add(2.5, 0, 0, 0.5);  // touches the sphere from outside
  inside.add(0, 1.75, 0, 0.5);
  compare(inside, "contained and touching");
}

TEST(UnionMeasures, CountEqualBallsOnce) {
  Scene scene, once;
  for (const double x : {0.0, 1.0, 2.0}) once.add(x, 0.5 * x, x * x, 1.5);
  for (int copy = 0; copy < 3; ++copy)
    for (const double x : {0.0, 1.0, 2.0}) scene.add(x, 0.5 * x, x * x, 1.5);
  const UnionMeasures found = scene.measure(), expected = once.measure();
  EXPECT_NEAR(total(found.areas), total(expected.areas), 1e-12 * sphere(1.5));
  EXPECT_NEAR(total(found.volumes), total(expected.volumes), 1e-12 * ball(1.5));
  EXPECT_EQ(std::count(found.volumes.begin(), found.volumes.end(), 0.0), 6);
}

/// Compares with the published output of Voronota-LT's basic example, up to a unit of its sixth figure:
/// kliment-olechnovic/voronota on GitHub,
/// expansion_lt/tests/output/api_usage_examples/example_basic_output.txt at 3677817e, MIT License. The balls
/// have a probe of radius 1.
TEST(UnionMeasures, EqualThoseOfVoronotaLt) {
  Scene scene;
  scene.add(0, 0, 2, 2);
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{0, 1},
                                                                   {0.382683, 0.92388},
                                                                   {0.707107, 0.707107},
                                                                   {0.92388, 0.382683},
                                                                   {1, 0},
                                                                   {0.92388, -0.382683},
                                                                   {0.707107, -0.707107},
                                                                   {0.382683, -0.92388},
                                                                   {0, -1},
                                                                   {-0.382683, -0.92388},
                                                                   {-0.707107, -0.707107},
                                                                   {-0.92388, -0.382683},
                                                                   {-1, 0},
                                                                   {-0.92388, 0.382683},
                                                                   {-0.707107, 0.707107},
                                                                   {-0.382683, 0.92388}})
    scene.add(x, y, 0, 1.5);
  const ComplexSimplices complex = scene.complex();
  const UnionMeasures found = measure_union(scene.centers, scene.radii, complex);
  // Rows of the file: contacts 0-1, 0-2, 0-3 and their images under the ring's symmetry, neighbours in the
  // ring, and contacts across it that exist because of rounded coordinates.
  const std::array<double, 3> with_cap{0.747721, 0.747722, 0.747723};
  const std::array<double, 3> areas{3.29195, 3.29196, 3.29197};
  const auto kind = [](BeadId bead) {
    return bead % 4 == 1 ? 0U : bead % 2 == 0 ? 1U : 2U;
  };  // of a ball of the ring
  const auto near = [](double value, double printed) {
    EXPECT_NEAR(value, printed, std::pow(10, std::floor(std::log10(printed)) - 5));
  };
  near(found.areas[0], 34.8168);
  near(found.volumes[0], 29.2302);
  for (BeadId bead = 1; bead <= 16; ++bead) {
    near(found.areas[bead], areas[kind(bead)]);
    near(found.volumes[bead], 2.48022);
  }
  ASSERT_EQ(complex.edges.size(), 45U);  // one more: four centres are on one circle
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const auto [i, j] = complex.edges[e];
    const BeadId apart = std::min(j - i, 16 - (j - i));
    if (i == 0)
      near(found.contacts[e], with_cap[kind(j)]);
    else if (apart == 1)
      near(found.contacts[e], 5.0216);
    else  // slivers, of which the file has half the area that all pairs and triples give
      EXPECT_LT(found.contacts[e], 2e-6) << i << " " << j;
  }
  compare(scene, "balls of Voronota-LT");
}

TEST(UnionMeasures, RefuseWrongNumbers) {
  Scene scene;
  scene.add(0, 0, 0, 1);
  ComplexSimplices complex = scene.complex();
  EXPECT_THROW((void)measure_union(scene.centers, std::vector{1.0, 1.0}, complex), std::invalid_argument);
  EXPECT_THROW((void)measure_union(scene.centers, std::vector{-1.0}, complex), std::invalid_argument);
}

TEST(StaticDualComplex, EqualsAlphaShapesOfCgal) {
  std::mt19937 random(3);
  for (int round = 0; round < rounds(60, 5); ++round) {
    Scene scene;
    BezierMotion<3, 1> motion(5 + random() % 20);
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      const double radius = 50 + static_cast<double>(random() % 400);
      scene.add(static_cast<double>(random() % 1000), static_cast<double>(random() % 1000),
                static_cast<double>(random() % 1000), radius);
      for (int axis = 0; axis < 3; ++axis) motion.set_coordinate(b, 0, axis, scene.centers(axis, b));
      motion.set_weight(b, 0, radius * radius);
    }
    const ComplexSimplices complex = scene.complex();
    std::vector<SimplexBeads> simplices;
    const auto add = [&](auto beads) {
      SimplexBeads& simplex = simplices.emplace_back();
      simplex.fill(no_bead);
      std::sort(beads.begin(), beads.end());
      std::copy(beads.begin(), beads.end(), simplex.begin());
    };
    for (const BeadId vertex : complex.vertices) add(std::array{vertex});
    for (const auto& edge : complex.edges) add(edge);
    for (const auto& triangle : complex.triangles) {
      add(triangle.beads);
      for (std::size_t i = 0; i < 3; ++i) {
        auto rest = complex.edges[triangle.edges[i]];
        EXPECT_EQ(std::count(rest.begin(), rest.end(), triangle.beads[i]), 0);
      }
    }
    for (const auto& tetrahedron : complex.tetrahedra) {
      add(tetrahedron.beads);
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& rest = complex.triangles[tetrahedron.triangles[i]].beads;
        EXPECT_EQ(std::count(rest.begin(), rest.end(), tetrahedron.beads[i]), 0);
      }
    }
    std::sort(simplices.begin(), simplices.end());
    EXPECT_EQ(simplices, test::cgal_alpha_complex(test::exact_points(motion, Dyadic(0.0))))
        << "round " << round;
  }
}

/// Runs balls whose coordinates at both ends are multiples of `grid`, and compares the measures of the
/// kinetic complex with those of static ones at both ends and at `times`, multiples of 2^-6 without events.
void compare_through(std::mt19937& random, double grid, const std::vector<double>& times) {
  std::uniform_real_distribution<double> place(0, 6);
  BezierMotion<3, 1> motion(60);
  std::vector<double> radii;
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    radii.push_back(0.5 +
                    b / 64.0);  // all different, so one of several balls with the same centre is visible
    for (int k = 0; k <= 1; ++k) {
      for (int axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, k, axis, grid * std::floor(place(random) / grid));
      motion.set_weight(b, k, radii[b] * radii[b]);
    }
  }
  Simulator simulator(AuditMode::none);
  PowerDiagram<3> diagram(simulator, motion);
  DualComplex<3> complex(simulator, motion, diagram);
  simulator.build();
  const auto compare_at = [&](double u) {
    SCOPED_TRACE("grid " + std::to_string(grid) + ", u = " + std::to_string(u));
    Scene scene;
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      std::array<double, 3> c{};
      for (int axis = 0; axis < 3; ++axis)  // has few bits, so the sum is exact
        c[static_cast<std::size_t>(axis)] =
            (1 - u) * motion.coordinate(b, 0, axis) + u * motion.coordinate(b, 1, axis);
      scene.add(c[0], c[1], c[2], radii[b]);
    }
    const UnionMeasures expected = scene.measure(),
                        found = measure_union(scene.centers, scene.radii, complex.simplices_with_faces());
    for (std::size_t b = 0; b < radii.size(); ++b) {
      EXPECT_NEAR(found.areas[b], expected.areas[b], 1e-10 * sphere(radii[b])) << b;
      EXPECT_NEAR(found.volumes[b], expected.volumes[b], 1e-10 * ball(radii[b])) << b;
    }
    EXPECT_NEAR(total(found.contacts), total(expected.contacts), 1e-8);
  };
  compare_at(0);
  simulator.enter_step();
  for (const double u : times) {
    simulator.run_until(Dyadic(u));
    compare_at(u);
  }
  simulator.leave_step();
  compare_at(1);
}

TEST(DualComplex, GivesMeasuresAtAnyTimeBetweenEvents) {
  std::mt19937 random(11);
  for (int round = 0; round < rounds(6, 1); ++round) {
    compare_through(random, 1.0 / 1024, {0.015625, 0.3125, 0.734375});
    compare_through(random, 1, {});  // many beads tie at both ends
  }
}

/// A cage of balls around a void.
Scene cage(std::mt19937& random, std::size_t count) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> radius(1, 1.2);
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    // A spiral from pole to pole covers the sphere evenly.
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count),
                 turn = 2.39996 * static_cast<double>(i);
    const double flat = std::sqrt(1 - z * z);
    scene.add(2 * flat * std::cos(turn) + 0.03 * normal(random),
              2 * flat * std::sin(turn) + 0.03 * normal(random), 2 * z + 0.03 * normal(random),
              radius(random));
  }
  return scene;
}

/// Returns the cells outside the complex that no path through triangles outside the complex joins with
/// infinity.
std::vector<ComplementCell> enclosed_cells(const Scene& scene) {
  const ComplexSimplices complex = scene.complex();
  std::set<std::vector<BeadId>> belonging;
  for (const BeadId vertex : complex.vertices) belonging.insert({vertex});
  for (const auto& edge : complex.edges) belonging.insert({edge[0], edge[1]});
  const auto add = [&](auto beads) {
    std::sort(beads.begin(), beads.end());
    belonging.insert(std::vector<BeadId>(beads.begin(), beads.end()));
  };
  for (const auto& triangle : complex.triangles) add(triangle.beads);
  for (const auto& tetrahedron : complex.tetrahedra) add(tetrahedron.beads);
  std::map<std::vector<BeadId>, std::vector<std::size_t>>
      at;  // the cells at each triangle outside the complex
  std::vector<CellBeads<3>> cells;
  for (CellBeads<3> cell : static_triangulation<3>(scene.centers, scene.weights()).cells) {
    std::sort(cell.begin(), cell.end());
    if (belonging.contains({cell.begin(), cell.end()})) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      std::vector<BeadId> facet(cell.begin(), cell.end());
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
      if (!belonging.contains(facet)) at[facet].push_back(cells.size());
    }
    cells.push_back(cell);
  }
  std::vector<char> open(cells.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [facet, beside] : at)
      if (beside.size() == 1 || open[beside[0]] != open[beside[1]])
        for (const std::size_t cell : beside) {
          changed |= open[cell] == 0;
          open[cell] = 1;
        }
  }
  std::vector<ComplementCell> enclosed;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (open[c] != 0) continue;
    ComplementCell& cell = enclosed.emplace_back(ComplementCell{cells[c]});
    for (std::size_t i = 0; i < 4; ++i) {
      if (belonging.contains({cells[c][i]})) cell.vertices |= static_cast<std::uint8_t>(1U << i);
      std::vector<BeadId> facet(cells[c].begin(), cells[c].end());
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
      if (belonging.contains(facet)) cell.triangles |= static_cast<std::uint8_t>(1U << i);
    }
    for (std::size_t e = 0; e < 6; ++e)
      if (belonging.contains({cells[c][tetrahedron_edges[e][0]], cells[c][tetrahedron_edges[e][1]]}))
        cell.edges |= static_cast<std::uint8_t>(1U << e);
  }
  return enclosed;
}

TEST(ComplementMeasures, OfAVoidAreWhatABallAddsThatFillsIt) {
  std::mt19937 random(17);
  std::size_t voids = 0;
  for (std::size_t round = 0; round < rounds(2, 1); ++round) {
    Scene scene = cage(random, 24);
    const std::vector<ComplementCell> cells = enclosed_cells(scene);
    if (cells.empty()) continue;
    ++voids;
    const ComplementMeasures found = measure_complement(scene.centers, scene.radii, cells);
    const UnionOfBalls open(scene.centers, scene.radii);
    const std::vector<double> radii = scene.radii;
    scene.add(0, 0, 0, 1.65);  // covers the void and ends within the cage
    const UnionOfBalls filled(scene.centers, scene.radii);
    ASSERT_LT(filled.area(radii.size()), 1e-12);
    EXPECT_NEAR(found.volume, filled.volume() - open.volume(), 1e-9 * ball(2));
    EXPECT_GT(found.volume, 0.01);
    ASSERT_GT(found.areas.size(), 4U);
    for (const auto& [bead, area] : found.areas)
      EXPECT_NEAR(area, open.area(bead) - filled.area(bead), 1e-9 * sphere(radii[bead])) << bead;
  }
  EXPECT_GT(voids, 0U);
}

}  // namespace
}  // namespace kds::union_measures_test
