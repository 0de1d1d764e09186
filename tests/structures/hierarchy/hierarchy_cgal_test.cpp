// Compares cages with CGAL's Min_sphere_of_spheres_d over rationals and its LP algorithm; the default
// algorithm for double is wrong on cospherical beads. The test samples small cages at one frame of each file.
// With KDS_CHECKED_FRAMES it checks every cage at that many frames.

#include <CGAL/Gmpq.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_2.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "motions/scene/radii.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "tests/support/inputs/ball_sets.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/property_runs.h"

namespace kds::hierarchy_cgal_test {
namespace {

using namespace test;

using Number = CGAL::Gmpq;
using Geometry = CGAL::Simple_cartesian<Number>;
template <int D>
using Traits = std::conditional_t<
    D == 2, CGAL::Min_sphere_of_spheres_d_traits_2<Geometry, Number, CGAL::Tag_false, CGAL::LP_algorithm>,
    CGAL::Min_sphere_of_spheres_d_traits_3<Geometry, Number, CGAL::Tag_false, CGAL::LP_algorithm>>;

template <int D>
double cgal_radius(const BallSet& set, BeadId first, BeadId last) {
  std::vector<typename Traits<D>::Sphere> spheres;
  for (BeadId b = first; b <= last; ++b) {
    const auto c = set.centers.col(b);
    if constexpr (D == 2) {
      spheres.emplace_back(Geometry::Point_2(c.x(), c.y()), Number(set.radii[b]));
    } else {
      spheres.emplace_back(Geometry::Point_3(c.x(), c.y(), c.z()), Number(set.radii[b]));
    }
  }
  CGAL::Min_sphere_of_spheres_d<Traits<D>> smallest(spheres.begin(), spheres.end());
  const auto radius = smallest.radius();  // a + b sqrt(d)
  const Number a = radius.first, b = radius.second, d = smallest.discriminant();
  const double root = std::sqrt(CGAL::to_double(d));
  const double x = CGAL::to_double(a), y = CGAL::to_double(b) * root;
  if (x * y >= 0) return x + y;
  return CGAL::to_double(a * a - b * b * d) / (x - y);  // uses the conjugate if the two parts cancel
}

/// Checks every `stride`-th node with at most `most` beads.
template <int D>
std::size_t check_cages(StaticWrappedHierarchy<D>& hierarchy, const BallSet& set, std::size_t most,
                        NodeId stride) {
  hierarchy.update(Balls<D>(set.centers, set.radii));
  std::size_t checked = 0;
  for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
    const BeadRange range = hierarchy.tree().range(node);
    if (range.last - range.first + 1 > most || node % stride != 0) continue;
    const double ours = hierarchy.sphere(node).radius;
    EXPECT_NEAR(ours, cgal_radius<D>(set, range.first, range.last), 1e-12 * ours)
        << set.name << ", beads " << range.first << "-" << range.last;
    const Basis& basis = hierarchy.basis(node);
    EXPECT_EQ(not_smallest_ball(set, range.first, range.last, {basis.begin(), basis.end()}, ours),
              std::nullopt)
        << set.name << ", beads " << range.first << "-" << range.last;
    ++checked;
  }
  return checked;
}

void check_trajectory(const std::string& name, std::size_t frame_step, std::size_t most, NodeId stride) {
  const Trajectory trajectory = read_trajectory(data(name));
  const auto last = static_cast<BeadId>(trajectory.bead_count() - 1);
  const std::vector<BeadRange> necklace{{0, last}};
  std::vector<std::vector<double>> radii{bead_radii("auto", std::span(&trajectory, 1))};
  if (!trajectory.element_radii.empty()) {
    radii.push_back(bead_radii("element:fit", std::span(&trajectory, 1)));
  } else {
    radii.push_back(radii[0]);
    for (std::size_t b = 0; b < radii[1].size(); b += 3) radii[1][b] *= 0.75;
  }
  for (const auto& r : radii) {
    StaticWrappedHierarchy<3> space(necklace);
    StaticWrappedHierarchy<2> plane(necklace);
    std::size_t checked = 0;
    for (std::size_t k = 0; k < trajectory.frames.size(); k += frame_step) {
      const BallSet set{name + ", frame " + std::to_string(k), trajectory.frames[k], r};
      checked += check_cages<3>(space, set, most, stride);
      BallSet shadow = set;
      shadow.centers.row(2).setZero();
      checked += check_cages<2>(plane, shadow, most, stride);
    }
    EXPECT_GT(checked, 0U);
  }
}

TEST(CagesBesideCgal, OfAllStructuresAndTrajectories) {
  const auto wanted = static_cast<std::size_t>(from_environment("KDS_CHECKED_FRAMES", 0));
  for (const std::string folder : {"proteins", "trajectories"}) {
    for (const auto& entry : std::filesystem::directory_iterator(data(folder))) {
      const std::string file = entry.path().filename().string();
      if (file.starts_with('.')) continue;  // of another test that runs at this time
      const std::string name = folder + "/" + file;
      const std::size_t frames = read_trajectory(entry.path()).frames.size();
      if (wanted > 0) {
        check_trajectory(name, std::max<std::size_t>(1, frames / wanted), 1000000, 1);
      } else {
        check_trajectory(name, frames, 30, 13);
      }
    }
  }
}

TEST(CagesBesideCgal, OfHardSets) {
  std::mt19937 random(83);
  for (std::size_t which = 0; which < hard_ball_sets; ++which) {
    for (const bool equal : {true, false}) {
      const BallSet set = hard_ball_set(random, which, 24, equal, false);
      const std::vector<BeadRange> necklace{{0, 23}};
      StaticWrappedHierarchy<3> space(necklace);
      check_cages<3>(space, set, 24, 1);
      BallSet shadow = set;
      shadow.centers.row(2).setZero();
      StaticWrappedHierarchy<2> plane(necklace);
      check_cages<2>(plane, shadow, 24, 1);
    }
  }
}

}  // namespace
}  // namespace kds::hierarchy_cgal_test
