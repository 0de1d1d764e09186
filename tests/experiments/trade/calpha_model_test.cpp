// The model with one bead per residue: its beads, its radii, and contacts of residues.

#include "experiments/trade/calpha_model.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kds::calpha_model_test {
namespace {

/// Makes three residues of one chain, with 3, 1 and 2 beads, on the x axis.
Trajectory small_chain() {
  Trajectory chain;
  chain.bead_names = {"N of ALA 1 in chain A",   "CA of ALA 1 in chain A", "C of ALA 1 in chain A",
                      "CA of GLY 1A in chain A", "CA of GLY 2 in chain A", "C of GLY 2 in chain A"};
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, 6);
  frame.row(0) << 0, 1, 2, 4, 8, 9;
  chain.frames = {frame, frame};
  chain.breaks = {3};
  return chain;
}

TEST(CalphaModel, HasOneBeadAResidue) {
  const std::vector<Trajectory> chains{small_chain(), small_chain()};
  const std::vector<double> radii{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const auto model = calpha_model(chains, radii, "file:some");
  ASSERT_TRUE(model);
  EXPECT_EQ(model->bead, (std::vector<BeadId>{1, 3, 4, 7, 9, 10}));
  EXPECT_EQ(model->of_bead, (std::vector<BeadId>{0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 5, 5}));
  EXPECT_EQ(model->residue[0], (BeadRange{0, 2}));
  EXPECT_EQ(model->residue[5], (BeadRange{10, 11}));
  EXPECT_EQ(model->ranges, (std::vector<BeadRange>{{0, 2}, {3, 5}}));
  // The covered bead has radius 12 and distance 1; the sum is rounded up to three decimals.
  EXPECT_EQ(model->covering_radius, 13.1);
  EXPECT_EQ(model->radii, (std::vector<double>{2, 4, 5, 8, 10, 11}));
  EXPECT_EQ(model->necklaces[1].frames[1](0, 2), 8);
  EXPECT_EQ(model->necklaces[0].breaks, (std::vector<std::size_t>{1}));
  // Half of the longest bond that is not a break: the bond from 1 to 4.
  EXPECT_EQ(calpha_model(chains, radii, "auto")->radii, std::vector<double>(6, 1.5));
}

TEST(CalphaModel, NeedsNamesAndOtherBeads) {
  const std::vector<double> radii(12, 1.0);
  Trajectory nameless = small_chain();
  nameless.bead_names.clear();
  EXPECT_FALSE(calpha_model(std::vector{nameless, nameless}, radii, "1"));
  Trajectory without = small_chain();
  without.bead_names[3] = "N of GLY 1A in chain A";
  EXPECT_FALSE(calpha_model(std::vector{small_chain(), without}, radii, "1"));
  EXPECT_FALSE(calpha_model(std::vector{small_chain()}, std::vector<double>(6, 1.0), "1"));  // three residues
  Trajectory alone = small_chain();
  alone.bead_names = {"CA of ALA 1 in chain A"};
  for (auto& frame : alone.frames) frame = frame.leftCols(1).eval();
  EXPECT_FALSE(calpha_model(std::vector(4, alone), std::vector<double>(4, 1.0), "1"));
}

TEST(CalphaModel, CoversNothingWhereNumbersEnd) {
  std::vector<Trajectory> chains{small_chain(), small_chain()};
  EXPECT_EQ(calpha_model(chains, std::vector<double>(12, 1e-3), "1")->covering_radius, 1.01);
  chains[0].frames[1](0, 0) = 1e300;
  EXPECT_EQ(calpha_model(chains, std::vector<double>(12, 1e-3), "1")->covering_radius, 0.0);
}

TEST(CalphaModel, TellsContactsOfResidues) {
  const std::vector<Trajectory> chains{small_chain(), small_chain()};
  const auto model = calpha_model(chains, std::vector<double>(12, 1.0), "1");
  const std::vector<ContactTime> contacts{
      {{0, 2}, 0, 1}, {{0, 3}, 0, 1}, {{1, 5}, 4, 5}, {{2, 4}, 0, 1}, {{5, 6}, 2, 3}};
  const std::vector<ContactTime> of_residues = model->of_residues(contacts, 2);
  ASSERT_EQ(of_residues.size(), 3U);  // contacts within a residue and between neighbours are left out
  EXPECT_EQ(of_residues[0].pair, (BeadPair{0, 2}));
  EXPECT_EQ(of_residues[0].from, 0);
  EXPECT_EQ(of_residues[1].pair, (BeadPair{0, 2}));
  EXPECT_EQ(of_residues[1].from, 4);
  EXPECT_EQ(of_residues[2].pair, (BeadPair{2, 3}));
}

}  // namespace
}  // namespace kds::calpha_model_test
