// Tests `kds figures`: what the drawings show, and their files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/figures/paper_figures.h"
#include "structures/enclosing_sphere/enclosing_sphere.h"
#include "structures/necklace/necklace_tree.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::test::figures_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// Bases from scratch in exact arithmetic, by another algorithm than the hierarchy's.
std::vector<Basis> exact_bases(const Eigen::Matrix3Xd& centers) {
  const std::vector<double> radii(static_cast<std::size_t>(centers.cols()), 1);
  const Balls<2> balls(centers, radii);
  const std::array necklaces{BeadRange{0, static_cast<BeadId>(radii.size() - 1)}};
  const NecklaceTree tree(necklaces);
  std::vector<Basis> bases;
  for (const BeadRange& range : tree.ranges())
    bases.push_back(smallest_sphere(balls, range.first, range.last, {}, ExactUse::everywhere).basis);
  return bases;
}

TEST(StablePair, OnlyTheRootsBasisChanges) {
  const auto pair = find_stable_pair({.beads = 16, .candidates = 400, .seed = 2});
  ASSERT_TRUE(pair);
  EXPECT_GT(pair->root_changes, 0U);
  EXPECT_GT(pair->deformation, 0.01);
  const std::vector<Basis> first = exact_bases(pair->frames.front());
  for (const Eigen::Matrix3Xd& frame : pair->frames) {
    const std::vector<Basis> bases = exact_bases(frame);
    EXPECT_TRUE(std::equal(first.begin() + 1, first.end(), bases.begin() + 1, bases.end()));
    for (Eigen::Index i = 0; i < 16; ++i)
      for (Eigen::Index j = i + 1; j < 16; ++j) {
        const double distance = (frame.col(i) - frame.col(j)).norm();
        EXPECT_EQ(distance <= 2, j == i + 1) << i << " " << j;
      }
  }
  EXPECT_FALSE(first.front() == exact_bases(pair->frames.back()).front());
}

TEST(StablePair, MoreCandidatesGiveNoSmallerDeformation) {
  const auto few = find_stable_pair({.beads = 16, .candidates = 200, .seed = 2});
  const auto more = find_stable_pair({.beads = 16, .candidates = 400, .seed = 2});
  ASSERT_TRUE(few && more);
  EXPECT_LE(few->deformation, more->deformation);
}

TEST(Figures, DrawsEachFigureIntoAFile) {
  const ScratchDirectory scratch;
  const ProgramRun run = run_program(
      {"figures", "--beads", "16", "--candidates", "400", "--seed", "2", "--out", scratch / "out"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no other basis did"));
  const Json json = Json::parse(content_of(scratch / "out/figures.json"));
  ASSERT_EQ(json["rows"].size(), 5U);
  EXPECT_GT(json["rows"][0]["sticking_out"], 0);  // wrapped: children stick out
  EXPECT_EQ(json["rows"][1]["sticking_out"], 0);  // layered: never
  EXPECT_GT(json["rows"][1]["root_radius"], json["rows"][0]["root_radius"]);
  EXPECT_NEAR(json["rows"][4]["root_radius"].get<double>(), 2, 1e-12);  // figure 5: sqrt(log2 16)
  for (const char* file : {"figure-2.svg", "figure-3.svg", "figure-5.svg"}) {
    const std::string svg = content_of(scratch / "out" / file);
    EXPECT_EQ(svg.rfind("<svg xmlns", 0), 0U);
    EXPECT_THAT(svg, HasSubstr("</svg>\n"));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_LT(svg.size(), 20000U);
  }
  // 16 beads, and 15 circles in either panel of figure 2
  const std::string two = content_of(scratch / "out/figure-2.svg");
  EXPECT_EQ(count_of(two, "class=\"cage"), 30U);
  EXPECT_EQ(count_of(two, "class=\"bead\"") + count_of(two, "class=\"basis\""), 32U);
}

TEST(Figures, RefusesWhatItDoesNotDraw) {
  const auto error_of = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "figures");
    const ProgramRun refused = run_program(arguments);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(count_of(refused.err, "\n"), 1U) << refused.err;
    return refused.err;
  };
  EXPECT_THAT(error_of({"4"}), HasSubstr("FIGURE: '4' is not one of 2, 3, 5"));
  EXPECT_THAT(error_of({"2", "2"}), HasSubstr("FIGURE: 2 is listed twice"));
  EXPECT_THAT(error_of({"2", "--seed", "3"}), HasSubstr("--seed applies only to figure 3"));
  EXPECT_THAT(error_of({"3", "--beads", "128", "--candidates", "1"}),
              HasSubstr("--candidates 1: no candidate keeps all bases except the root's"));
}

}  // namespace
}  // namespace kds::test::figures_test
