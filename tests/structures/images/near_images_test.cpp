#include "structures/images/near_images.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/curves/motion_ref.h"
#include "tests/support/inputs/random.h"

namespace kds::near_images_test {
namespace {

using namespace test;

/// The images found that name one of the beads, and whether they overlap throughout.
std::set<std::pair<ImagePair, bool>> naming(const PairsOfImages& found, const std::vector<BeadId>& beads) {
  std::set<std::pair<ImagePair, bool>> all;
  const auto names = [&](BeadId bead) { return std::ranges::find(beads, bead) != beads.end(); };
  for (const auto& [images, overlap] : {std::pair(&found.unclear, false), {&found.overlapping, true}})
    for (const ImagePair& image : *images)
      if (names(image.pair.first) || names(image.pair.second)) all.insert({image, overlap});
  return all;
}

/// Changes the courses of random beads again and again, and compares what is found of these beads with what a
/// search of all pairs finds.
template <int D, int Degree>
void compare_with_a_search_of_all(const Cell& start, const Cell& end, double radius, bool in_groups) {
  constexpr BeadId beads = 70;
  Random random(11);
  BezierMotion<D, Degree> motion(beads);
  motion.own_cell().set(start, end, Degree);
  const auto place = [&](BeadId bead, double move) {
    for (int axis = 0; axis < D; ++axis) {
      const double at = uniform(random, -12, 12);
      for (int k = 0; k <= Degree; ++k)
        motion.set_coordinate(bead, k, axis, at + uniform(random, -move, move));
    }
    for (int k = 0; k <= Degree; ++k) motion.set_radius(bead, k, radius);
  };
  for (BeadId bead = 0; bead < beads; ++bead) place(bead, 0.3);
  PairsAsked asked{{{0, beads - 1}}, true, 2};
  if (in_groups)
    for (BeadId bead = 0; bead < beads; ++bead) asked.groups.push_back(static_cast<std::uint8_t>(bead % 4));
  NearImages<D> changed(asked), fresh(asked);
  ShiftNumbers<D> shifts;
  PairsOfImages of_all, of_beads;
  const MotionRef<D> ref(motion);
  changed.find(ref.curves(), true, shifts, of_all);
  std::size_t compared = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<BeadId> moved;
    for (int k = pick(random, 1, 3); k > 0; --k) {
      const auto bead = static_cast<BeadId>(pick(random, 0, beads - 1));
      if (std::ranges::find(moved, bead) == moved.end()) moved.push_back(bead);
    }
    for (const BeadId bead : moved) place(bead, round % 50 == 49 ? 9 : 0.3);  // some move far
    changed.find_of(ref.curves(), moved, true, shifts, of_beads);
    fresh.find(ref.curves(), true, shifts, of_all);
    const auto expected = naming(of_all, moved);
    ASSERT_EQ(naming(of_beads, moved), expected) << round;
    compared += expected.size();
  }
  EXPECT_GT(compared, 300U);
}

Cell box(double a, double b, double c) { return Eigen::Vector3d(a, b, c).asDiagonal(); }

TEST(NearImages, OfChangedBeadsAreThoseOfASearchOfAll) {
  Cell askew = box(9, 10, 11);
  askew(0, 1) = 3;
  askew(1, 2) = -4;
  for (const bool in_groups : {false, true}) {
    compare_with_a_search_of_all<3, 1>(box(10, 11, 12), box(10, 11, 12), 0.8, in_groups);
    compare_with_a_search_of_all<3, 3>(askew, 1.1 * askew, 0.9, in_groups);
    compare_with_a_search_of_all<3, 1>(box(4, 30, 30), box(4, 30, 30), 1.5, in_groups);  // images of images
    compare_with_a_search_of_all<3, 1>(box(8, 9, 0), box(8, 9, 0), 0.8, in_groups);      // a slab
    compare_with_a_search_of_all<2, 1>(box(9, 9, 0), box(9, 9.5, 0), 0.5, in_groups);
  }
}

}  // namespace
}  // namespace kds::near_images_test
