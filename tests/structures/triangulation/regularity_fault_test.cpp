// The reason why a triangulation is irregular is found and named.

#include "structures/triangulation/regularity_fault.h"

#include <gmock/gmock.h>

#include <random>

#include "certificates/search/snapshot_sign.h"

namespace kds::regularity_fault_test {
namespace {

using testing::HasSubstr;
using testing::Optional;

constexpr BeadId beads = 60;

template <int dimension>
struct Scene {
  Eigen::Matrix3Xd centers{3, Eigen::Index{beads}};
  std::vector<double> weights;
  RegularTriangulation<dimension> triangulation;
  std::vector<HiddenBead> hidden;

  explicit Scene(double heaviest) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(0, 1);
    for (double& x : centers.reshaped()) x = anywhere(random);
    for (BeadId b = 0; b < beads; ++b) weights.push_back(b % 5 == 0 ? heaviest : 0);
    for (const BeadId b : triangulation.build(centers, weights).hidden) hidden.push_back({b, no_cell});
  }
  [[nodiscard]] std::optional<std::string> fault(std::span<const char> absent = {}) const {
    const Snapshot<dimension> now(centers, weights);
    return regularity_fault(
        triangulation, beads, hidden, false, [&](const auto& f) { return snapshot_sign(f, now); }, absent);
  }
};

template <int dimension>
void expect_faults() {
  Scene<dimension> right(0.1);
  ASSERT_GT(right.hidden.size(), 3U);
  EXPECT_EQ(right.fault(), std::nullopt);
  const BeadId hidden = right.hidden.back().bead;
  right.hidden.pop_back();
  EXPECT_THAT(right.fault(), Optional(HasSubstr("bead " + std::to_string(hidden) + " has no cell")));
  std::vector<char> absent(beads, 0);
  absent[hidden] = 1;
  EXPECT_EQ(right.fault(absent), std::nullopt);
  absent.assign(beads, 1);
  EXPECT_THAT(right.fault(absent), Optional(HasSubstr("should be absent")));
  // A heavy bead elsewhere: its cells, or cells of others, have the wrong orientation.
  Scene<dimension> moved(0);
  EXPECT_EQ(moved.fault(), std::nullopt);
  moved.centers.col(30) += Eigen::Vector3d(0.7, 0.7, dimension == 3 ? 0.7 : 0.0);
  EXPECT_NE(moved.fault(), std::nullopt);
  EXPECT_GT(snapshot_faults(moved.triangulation, Snapshot<dimension>(moved.centers, moved.weights)).failed(),
            0U);
  // A bead that is far from its host cell.
  Scene<dimension> far(0.1);
  far.weights[far.hidden[0].bead] = 10;
  EXPECT_NE(far.fault(), std::nullopt);
}

TEST(RegularityFault, IsFound) {
  expect_faults<3>();
  expect_faults<2>();
}

}  // namespace
}  // namespace kds::regularity_fault_test
