// `kds families`: sides, fits and what it prints.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/collide/family_sizes.h"
#include "tests/experiments/run_program.h"

namespace kds::test {
namespace {

using Json = nlohmann::ordered_json;

TEST(FamilySizes, SidesAreOddAndGrow) {
  for (const int dimension : {2, 3}) {
    const auto sides = sides_of_grids(dimension, 1'000'000);
    EXPECT_GT(sides.size(), 8U);
    EXPECT_TRUE(std::is_sorted(sides.begin(), sides.end()));
    EXPECT_EQ(std::adjacent_find(sides.begin(), sides.end()), sides.end());
    for (const std::size_t side : sides) EXPECT_EQ(side % 2, 1U);
    EXPECT_GE(std::pow(sides.front(), dimension), 900);
    EXPECT_LT(std::pow(sides.back(), dimension), 1'000'000);
    EXPECT_GT(std::pow(sides.back(), dimension), 900'000);
  }
}

TEST(FamilySizes, AFitFindsThePowerThatSizesFollow) {
  std::vector<FamilySize> sizes;
  for (const std::size_t beads : {1000, 3000, 10000, 50000}) {
    FamilySize size;
    size.beads = beads;
    size.family = static_cast<std::uint64_t>(3 * std::pow(beads, 1.4));
    sizes.push_back(size);
  }
  const auto fit = fit_exponent(sizes);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->exponent, 1.4, 1e-4);
  EXPECT_LE(fit->lower, fit->exponent);
  EXPECT_LT(fit->upper - fit->lower, 1e-3);
  EXPECT_NEAR(fit->expected, 4.0 / 3, 1e-12);
  sizes[1].family *= 2;  // off the line: the interval is wide
  EXPECT_GT(fit_exponent(sizes)->upper - fit_exponent(sizes)->lower, 0.3);
  for (FamilySize& size : sizes) {
    size.dimension = 2;
    const auto n = static_cast<double>(size.beads);
    size.family = static_cast<std::uint64_t>(n * std::log2(n));
  }
  EXPECT_NEAR(fit_exponent(sizes)->exponent, 1, 1e-4);
  EXPECT_FALSE(fit_exponent(std::span(sizes).first(2)));
}

TEST(FamilySizes, RowsAndFits) {
  const ProgramRun run = run_program({"families", "--beads", "4000", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["fits"].size(), 4U);
  EXPECT_GE(json["rows"].size(), 12U);
  for (const Json& row : json["rows"]) {
    EXPECT_GT(row["ratio"], row["dimension"] == 2 ? 1 : 3) << row;
    EXPECT_LT(row["ratio"], row["dimension"] == 2 ? 1.5 : 4) << row;
    EXPECT_GT(row["seconds"], 0) << row;
  }
}

}  // namespace
}  // namespace kds::test
