// Tests `kds theorems`: sizes, measurements and output.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/program/timing.h"
#include "experiments/theorems/interleaved_grids.h"
#include "experiments/theorems/plan_theorems.h"
#include "motions/models/shapes.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/necklace/necklace.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::test::theorems_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

TEST(TheoremSizes, SidesAreOddAndGrow) {
  for (const int dimension : {2, 3}) {
    const auto sides = sides_of_grids(dimension, 1'000'000);
    EXPECT_GT(sides.size(), 8U);
    EXPECT_TRUE(std::is_sorted(sides.begin(), sides.end()));
    EXPECT_EQ(std::adjacent_find(sides.begin(), sides.end()), sides.end());
    for (const std::size_t side : sides) EXPECT_EQ(side % 2, 1U);
    EXPECT_GE(std::pow(sides.front(), dimension), 900);
    EXPECT_LT(std::pow(sides.back(), dimension), 1'000'000);
    EXPECT_GT(std::pow(sides.back(), dimension), 900'000);
    EXPECT_LE(beads_of_grid(dimension, sides.back()), 1'000'000U);
  }
}

TEST(TheoremSeries, InThePlaneALogarithmIsDividedOut) {
  TheoremSeries series;
  series.theorem = Theorem::family;
  series.dimension = 2;
  for (const std::size_t beads : {1000, 3000, 10000, 50000}) {
    const auto n = static_cast<double>(beads);
    series.points.push_back({beads, 5 * n * std::log2(n), {}, {}, {}});
  }
  EXPECT_NEAR(series.fit()->exponent, 1, 1e-9);
  series.dimension = 3;
  EXPECT_GT(series.fit()->exponent, 1.05);
}

TEST(TheoremSeries, TightnessGrowsWithTheHeight) {
  TheoremSeries series;
  for (const std::size_t beads : {16, 256, 4096, 65536})
    series.points.push_back({beads, std::sqrt(static_cast<double>(tree_height(beads))), {}, {}, {}});
  EXPECT_NEAR(series.fit()->exponent, 0.5, 1e-9);
}

TEST(RootRatio, OfThePointsOfLemma25IsTheRootOfTheHeight) {
  EXPECT_EQ(tree_height(2), 1U);
  EXPECT_EQ(tree_height(3), 2U);
  EXPECT_EQ(tree_height(1024), 10U);
  EXPECT_EQ(tree_height(1025), 11U);
  for (const int h : {4, 9})
    EXPECT_NEAR(root_ratio(models::tightness_points(h), std::vector<double>(std::size_t{1} << h, 0.0), 2),
                std::sqrt(h), 1e-9);
  const Eigen::Matrix3Xd one_place = Eigen::Matrix3Xd::Zero(3, 4);
  EXPECT_EQ(root_ratio(one_place, std::vector<double>(4, 0.0), 3), 1);
}

TEST(ClosestByDiagram, IsThatOfASearchAndTellsWhatItLookedAt) {
  const TheoremPlan plan = plan_theorems({{Theorem::closest_pair}, 2000});
  std::vector<TheoremSeries> series = plan.series;
  plan.work.front()(series);  // the smallest grid in the plane
  const TheoremPoint& point = series.front().points.front();
  EXPECT_EQ(point.holds, true);
  EXPECT_GT(point.value, static_cast<double>(point.beads));
  // The search examines edges, and pairs of beads that are two apart in the chain.
  EXPECT_LT(point.value, 6 * static_cast<double>(point.beads));
  EXPECT_GT(point.seconds->median, 0);
}

TEST(TheoremPlan, ThreeSizesOfEachFromTheLeastBeads) {
  const std::vector<std::vector<Theorem>> choices{{Theorem::tightness},
                                                  {Theorem::family},
                                                  {Theorem::search},
                                                  {Theorem::closest_pair},
                                                  {Theorem::paths},
                                                  {Theorem::groupings},
                                                  {Theorem::families},
                                                  {Theorem::family, Theorem::two_necklaces},
                                                  {Theorem::tightness, Theorem::closest_pair}};
  for (const std::vector<Theorem>& theorems : choices) {
    const std::size_t least = least_beads_for(theorems);
    const auto fewest = [&](std::size_t beads) {
      const TheoremPlan plan = plan_theorems({theorems, beads});
      EXPECT_EQ(plan.sizes.size(), plan.series.size());
      return std::ranges::min(plan.sizes);
    };
    EXPECT_LT(fewest(least - 1), 3U);
    for (std::size_t beads = least; beads < 50 * least; beads += beads / 16)
      EXPECT_GE(fewest(beads), 3U) << name_of(theorems.front()) << " of " << beads;
  }
  const TheoremPlan plan = plan_theorems({{Theorem::tightness}, 64});
  std::vector<TheoremSeries> series = plan.series;
  for (const auto& work : plan.work) work(series);
  for (std::size_t s = 0; s < series.size(); ++s) EXPECT_EQ(series[s].points.size(), plan.sizes[s]);
}

// The smallest grid in the plane by all variants: no family over a tree is smaller than the smallest.
TEST(TheoremPlan, FamiliesAreCompared) {
  const TheoremPlan plan = plan_theorems({{Theorem::families}, 4096});
  EXPECT_EQ(plan.series.size(), 33U);  // two hierarchies with eight and three variants, on three models
  std::vector<TheoremSeries> series = plan.series;
  plan.work.front()(series);
  for (std::size_t s = 0; s < 11; ++s) {
    const TheoremPoint& point = series[s].points.front();
    if (series[s].variant == "grouped by space") {
      EXPECT_FALSE(point.holds);
      EXPECT_LT(point.value, series.front().points.front().value);
    } else {
      EXPECT_EQ(point.holds, true) << series[s].variant;
    }
    EXPECT_EQ(point.tests.has_value(), series[s].variant != "explicit");
    EXPECT_GT(point.value, static_cast<double>(point.beads));
  }
}

TEST(InterleavedGrids, AreTwoProperNecklaces) {
  for (const int dimension : {2, 3})
    for (const double gap : {0.05, 0.4})
      for (std::size_t side = 3; side < 14; ++side) {
        const TwoChains chains = interleaved_grids(side, dimension, gap);
        Eigen::Matrix3Xd centers(3, chains.first.cols() + chains.second.cols());
        centers << chains.first, chains.second;
        const std::vector<double> radii(static_cast<std::size_t>(centers.cols()), 1);
        const auto first = static_cast<BeadId>(chains.first.cols());
        const std::array necklaces{Necklace({0, first - 1}, centers, radii),
                                   Necklace({first, static_cast<BeadId>(radii.size() - 1)}, centers, radii)};
        EXPECT_TRUE(validate(necklaces).proper()) << side << " " << dimension << " " << gap;
        const std::size_t layers = dimension == 2 ? 1 : side;
        EXPECT_GE(first, side / 2 * side * layers);
        EXPECT_LE(std::abs(chains.first.cols() - chains.second.cols()), static_cast<int>(9 * layers));
      }
}

// Families between two necklaces, by brute force over all pairs of beads.
TEST(InterleavedGrids, AreSeparatedByTheMeasuredFamily) {
  const TheoremPlan plan = plan_theorems({{Theorem::two_necklaces}, 4096});
  std::vector<TheoremSeries> series = plan.series;
  plan.work.front()(series);
  const TheoremPoint& point = series.front().points.front();
  const std::size_t side = sides_of_grids(2, 4096).front();
  const TwoChains chains = interleaved_grids(side, 2, 0.05);
  Eigen::Matrix3Xd centers(3, chains.first.cols() + chains.second.cols());
  centers << chains.first, chains.second;
  const Balls<2> balls(centers, std::vector<double>(static_cast<std::size_t>(centers.cols()), 1));
  const auto first = static_cast<BeadId>(chains.first.cols());
  const PairsAsked asked{{{0, first - 1}, {first, static_cast<BeadId>(balls.size() - 1)}}, false, 2, true};
  SphereTree<2> tree(Hierarchy::wrapped, asked.necklaces);
  tree.build(balls);
  SeparatingFamily family;
  EXPECT_TRUE(find_pairs(tree, asked, family).pairs.empty());
  EXPECT_EQ(family_fault(family, {}, balls, asked).value_or("none"), "none");
  EXPECT_EQ(static_cast<double>(family.pairs.size()), point.value);
}

// The size of a family needs one search, so no time is reported.
TEST(TheoremPlan, FamiliesAloneAreNotTimed) {
  for (const bool timed : {false, true}) {
    TheoremOptions options{{Theorem::family}, 4096};
    if (timed) options.theorems.push_back(Theorem::search);
    const TheoremPlan plan = plan_theorems(options);
    std::vector<TheoremSeries> series = plan.series;
    plan.work.front()(series);
    EXPECT_EQ(series.front().points.front().seconds.has_value(), timed);
    EXPECT_GT(series.front().points.front().value, 1000);
  }
}

// Rows that are farther apart meet less often.
TEST(TheoremPlan, FamiliesShrinkAsTheGapOfGridsGrows) {
  const auto family = [](double gap) {
    const TheoremPlan plan = plan_theorems({{Theorem::family}, 4096, gap});
    std::vector<TheoremSeries> series = plan.series;
    plan.work.front()(series);
    return series.front().points.front().value;
  };
  EXPECT_LT(family(0.5), 0.8 * family(0.05));
}

TEST(TheoremPlan, OneSearchTellsOfBothTheorems) {
  const TheoremPlan both = plan_theorems({{Theorem::family, Theorem::search}, 4000});
  const TheoremPlan one = plan_theorems({{Theorem::search}, 4000});
  EXPECT_EQ(both.work.size(), one.work.size());
  EXPECT_EQ(both.series.size(), 2 * one.series.size());
}

// A time is the median of its rounds.
TEST(Theorems, TimesHaveTheLeastAndTheMostOfTheRounds) {
  const ProgramRun run = run_program({"theorems", "3.2", "--beads", "4096", "--rounds", "2", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json rows = Json::parse(run.out)["rows"];
  EXPECT_FALSE(rows.empty());
  for (const Json& row : rows) {
    EXPECT_EQ(row["value"], row["seconds"]) << row;
    EXPECT_LE(row["seconds_least"], row["seconds"]) << row;
    EXPECT_LE(row["seconds"], row["seconds_most"]) << row;
  }
}

// Equal seeds give equal figures, except for times.
TEST(Theorems, RowsFitsAndPage) {
  const ScratchDirectory scratch;
  std::vector<std::string> arguments{"theorems", "paths", "2.3", "groupings", "3.1", "3.2", "3.3"};
#ifdef KDS_SANITIZED
  const bool closest_pair = false;  // takes nine tenths of the time; ClosestByDiagram.* covers it
#else
  const bool closest_pair = true;
#endif
  if (closest_pair) arguments.emplace_back("3.5");
  for (const char* word : {"--beads", "4096", "--rounds", "1", "--seed", "5", "--out"})
    arguments.push_back(word);
  arguments.push_back(scratch / "out");
  const ProgramRun run = run_program(arguments);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out,
              HasSubstr(closest_pair ? "theorem 3.5: the closest pair is an edge" : "theorem 3.2: "));
  const Json json = Json::parse(content_of(scratch / "out/theorems.json"));
  EXPECT_EQ(json["command"].get<std::string>().rfind("kds theorems paths 2.3", 0), 0U);
  EXPECT_EQ(json["settings"]["seed"], 5);
  for (const Json& row : json["rows"]) {
    const std::string theorem = row["theorem"];
    if (theorem == "2.3" || theorem == "3.5" || theorem == "groupings" || theorem == "paths") {
      EXPECT_EQ(row["holds"], true) << row;
    }
    if (row["variant"] == "antipodes paired") {
      EXPECT_NEAR(row["value"].get<double>(), 1, 1e-9);
    }
    if (theorem == "3.3") {
      EXPECT_GT(row["ratio"], 0.5) << row;
      EXPECT_LT(row["ratio"], 4) << row;
      EXPECT_GE(row["tests"], row["value"]) << row;
    }
    if (theorem == "2.3") {
      EXPECT_GT(row["value"], 0.999) << row;
    }
    if (theorem == "3.1" && row["model"] == "grid") {
      EXPECT_GT(row["ratio"], row["dimension"] == 2 ? 1 : 3) << row;
      EXPECT_LT(row["ratio"], row["dimension"] == 2 ? 1.5 : 4) << row;
    }
    if (theorem == "3.2") {
      EXPECT_EQ(row["value"], row["seconds"]) << row;
    }
  }
  for (const Json& fit : json["fits"]) {
    if (fit["model"] != "points of Lemma 2.5" || fit["theorem"] != "2.3") continue;
    EXPECT_NEAR(fit["exponent"], 0.5, 1e-6);
    EXPECT_EQ(fit["sizes"], 9);
  }
  EXPECT_EQ(json["fits"].size(), 4 + 4 + 5 + 5 + 5 + 2 + (closest_pair ? 4U : 0U));  // one fit of each series
  const std::string csv = content_of(scratch / "out/theorems.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), json["rows"].size() + 1);
  const std::string page = content_of(scratch / "out/report.html");
  expect_sound(page);
  for (const char* part :
       {"Theorem 2.3", closest_pair ? "Theorem 3.5" : "Theorem 3.2", "<svg", " --beads 4096"})
    EXPECT_THAT(page, HasSubstr(part));

  const ProgramRun again = run_program({"theorems", "3.1", "--beads", "4096", "--seed", "5", "--json", "-"});
  ASSERT_EQ(again.code, 0) << again.err;
  std::vector<Json> values, values_again;
  for (const Json& row : json["rows"])
    if (row["theorem"] == "3.1") values.push_back(row["value"]);
  const Json json_again = Json::parse(again.out);
  for (const Json& row : json_again["rows"]) {
    values_again.push_back(row["value"]);
    EXPECT_EQ(row["seconds"], nullptr) << row;
  }
  EXPECT_EQ(values, values_again);
}

TEST(Theorems, RefusesWhatIsNoTheorem) {
  const ProgramRun run = run_program({"theorems", "2.4"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err,
              HasSubstr("THEOREM: '2.4' is not one of paths, 2.3, groupings, 3.1, families, 3.2, 3.3, 3.5"));
  const auto error_of = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "theorems");
    const ProgramRun refused = run_program(arguments);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(count_of(refused.err, "\n"), 1U) << refused.err;
    return refused.err;
  };
  EXPECT_THAT(error_of({"--beads", "1000"}), HasSubstr("--beads: '1000' is not a whole number from 4096"));
  EXPECT_THAT(error_of({"2.3", "--beads", "63"}), HasSubstr("--beads: '63' is not a whole number from 64"));
  EXPECT_THAT(error_of({data_file("trajectories/1l2y.dcd")}),
              HasSubstr("is a path; kds theorems measures models, kds scale FILE... measures files"));
  EXPECT_THAT(error_of({"3.1", "2.3", "3.1"}), HasSubstr("THEOREM: 3.1 is listed twice"));
  EXPECT_THAT(error_of({"2.3", "3.1", "--rounds", "2"}),
              HasSubstr("--rounds applies only to paths, 3.2, 3.3 and 3.5, which measure time"));
}

TEST(Theorems, AFileMayHaveTheNameOfATheorem) {
  const ScratchDirectory scratch;
  static_cast<void>(scratch.file("2.3", ""));
  const ProgramRun run = run_shell("cd \"$1\" && \"$0\" theorems 2.3 --beads 64 --quiet", {scratch / ""});
  EXPECT_EQ(run.code, 0) << run.err;
}

}  // namespace
}  // namespace kds::test::theorems_test
