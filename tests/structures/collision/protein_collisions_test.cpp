// Compares every static detector with brute force on real proteins.

#include <string>

#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "tests/structures/collision/detectors.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::protein_collisions_test {
namespace {

using namespace test;

// Takes every `every`-th frame, with radii at which some beads collide and others do not.
void ask_all_about(const std::string& file, const ReadOptions& options, const std::string& policy,
                   double factor, BeadId apart, std::size_t every, DetectorsSeen& seen) {
  const std::vector<Trajectory> necklaces = read_trajectories(data(file), options);
  std::vector<double> radii = bead_radii(policy, necklaces);
  for (double& r : radii) r *= factor;
  std::vector<BeadRange> ranges;
  BeadId beads = 0;
  for (const Trajectory& necklace : necklaces) {
    const auto count = static_cast<BeadId>(necklace.bead_count());
    ranges.push_back({beads, beads + count - 1});
    beads += count;
  }
  Eigen::Matrix3Xd centers(3, Eigen::Index{beads});
  for (std::size_t k = 0; k < necklaces.front().frames.size(); k += every) {
    for (std::size_t n = 0; n < necklaces.size(); ++n)
      centers.middleCols(ranges[n].first, necklaces[n].frames[k].cols()) = necklaces[n].frames[k];
    const std::string what = file + ", " + policy + ", frame " + std::to_string(k);
    expect_detectors_agree(Balls<3>(centers, radii), all_pairs(ranges, apart), 0.3, what, seen);
  }
}

TEST(ProteinCollisions, OfBackbones) {
  DetectorsSeen seen;
  for (const char* file :
       {"proteins/1ejg.pdb", "proteins/1l2y.pdb", "proteins/2f4k.pdb", "proteins/6wqa.cif"}) {
    for (const double factor : {1.0, 1.7, 2.4}) ask_all_about(file, {}, "auto", factor, 2, 20, seen);
  }
  EXPECT_GT(seen.colliding, 4U);
  EXPECT_LT(seen.colliding, seen.cases);
}

TEST(ProteinCollisions, OfAllAtoms) {
  DetectorsSeen seen;
  ReadOptions all;
  all.selection = Selection::all;
  for (const char* file : {"proteins/1ejg.pdb", "proteins/1l2y.pdb", "proteins/2f4k.pdb"}) {
    ask_all_about(file, all, "element", 1, 2, 40, seen);
    ask_all_about(file, all, "element", 0.4, 5, 40, seen);
    ask_all_about(file, all, "1.2", 1, 2, 40, seen);
  }
}

TEST(ProteinCollisions, OfTrajectories) {
  DetectorsSeen seen;
  ReadOptions options;
  const auto ask = [&](const std::string& name, const std::string& topology, std::size_t every) {
    options.topology = data("trajectories/" + topology);
    ask_all_about("trajectories/" + name, options, "auto", 2.2, 5, every, seen);
  };
  ask("random100_400K_first200.dcd", "random100_400K.pdb", 20);
  ask("dhodh363_1000K_first20.dcd", "dhodh363_1000K.pdb", 7);
  ask("villin_hp36_300K.dcd", "villin_hp36_300K.pdb", 100);
  EXPECT_GT(seen.colliding, 5U);
}

/// Two proteins from two files at the same place.
TEST(ProteinCollisions, BetweenChains) {
  DetectorsSeen seen, of_all;
  for (const Selection selection : {Selection::backbone, Selection::all}) {
    ReadOptions options;
    options.selection = selection;
    const Trajectory a = read_trajectory(data("proteins/1ejg.pdb"), options);
    Trajectory b = read_trajectory(data("proteins/2f4k.pdb"), options);
    const auto count = static_cast<BeadId>(a.bead_count()),
               last = static_cast<BeadId>(count + b.bead_count() - 1);
    for (const double away : {0.0, 9.0, 40.0, 1000.0}) {
      Eigen::Matrix3Xd centers(3, Eigen::Index{last} + 1);
      const auto placed = [](const Eigen::Matrix3Xd& frame, double x) -> Eigen::Matrix3Xd {
        return (frame.colwise() - frame.rowwise().mean()).colwise() + Eigen::Vector3d(x, 0, 0);
      };
      centers.leftCols(count) = placed(a.frames[0], 0);
      centers.rightCols(Eigen::Index{last} + 1 - count) = placed(b.frames[0], away);
      const Balls<3> balls(centers, std::vector<double>(last + 1, 1.7));
      const std::vector<BeadRange> necklaces{{0, count - 1}, {count, last}};
      expect_detectors_agree(balls, {necklaces, false, 2, true}, 2.5, "between", seen);
      expect_detectors_agree(balls, {necklaces, true, 4, true}, 2.5, "all", of_all);
    }
  }
  EXPECT_GE(seen.colliding, 2U);
  EXPECT_LT(seen.colliding, seen.cases);
  EXPECT_EQ(of_all.colliding, of_all.cases);
}

}  // namespace
}  // namespace kds::protein_collisions_test
