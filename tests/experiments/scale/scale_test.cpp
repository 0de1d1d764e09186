// Tests `kds scale`: its counts beside those of `kds compare`, its series, and its errors.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/scale/measure_scale.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::test::scale_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

Json value_of(const Json& rows, const std::string& subject, const std::string& measure, int beads) {
  for (const Json& row : rows)
    if (row["subject"] == subject && row["measure"] == measure && row["n"] == beads) return row["value"];
  return {};
}

TEST(Scale, ModelsAreMeasuredAsCompareMeasuresThem) {
  const ScratchDirectory scratch;
  const ProgramRun run = run_program({"scale", "--model", "random-chain", "--beads", "16,24,32,48,64,96",
                                      "--steps", "3", "--seeds", "2", "--out", scratch / "out"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("growth with n"));
  EXPECT_EQ(count_of(run.out, "wrapped      events per step  "), 2U)
      << run.out;  // a line of means, one of fits
  const Json json = Json::parse(content_of(scratch / "out/scale.json"));
  const std::string chain = (scratch / "chain.xyz").string();
  ASSERT_EQ(
      run_program({"generate", "random-chain", "--beads", "48", "--frames", "4", "--seed", "1", "-o", chain})
          .code,
      0);
  const ProgramRun compared =
      run_program({"compare", chain, "--radius", "1", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  const Json of_compare = Json::parse(compared.out);
  for (const Json& row : of_compare["rows"])
    for (const char* measure :
         {"events_per_step", "efficiency", "compactness", "locality", "touched_per_event"})
      EXPECT_EQ(value_of(json["rows"], row["structure"], measure, 48), row[measure]) << measure;
  for (const Json& size : json["sizes"])
    if (size["n"] == 48 && size["measure"] == "wrapped_family") {
      EXPECT_EQ(size["scenes"], 2);
      EXPECT_LE(size["lower"], size["mean"]);
    }
  EXPECT_FALSE(json["fits"].empty());
  for (const Json& fit : json["fits"]) {
    EXPECT_FALSE(fit.contains("lower")) << fit;  // no interval of an exponent is justified
    EXPECT_LE(fit["sizes"], 6) << fit;           // fewer if a measure is zero or has no value at small sizes
    if (fit["measure"] == "compactness") {
      EXPECT_EQ(fit["sizes"], 6) << fit;
    }
  }
  const std::string page = content_of(scratch / "out/report.html");
  expect_sound(page);
  EXPECT_THAT(page, HasSubstr("pairs in the separating family, wrapped"));
}

TEST(Scale, FilesHaveTheirTopologies) {
  const std::string villin = data_file("trajectories/villin_hp36_300K"),
                    other = data_file("trajectories/random100_400K");
  const ProgramRun run = run_program({"scale", villin + ".dcd", other + "_first200.dcd", "--topology",
                                      villin + ".pdb," + other + ".pdb", "--frames", ":4", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  for (const int beads : {108, 300}) {
    EXPECT_GT(value_of(json["rows"], "first frame", "wrapped_family", beads), 100);
    EXPECT_GT(value_of(json["rows"], "power", "events_per_step", beads), 1);
  }
  EXPECT_TRUE(json["fits"].empty());  // two sizes have no fit
}

TEST(ScaleSeries, GroupsBySubjectMeasureAndSize) {
  const ScaleMeasure& events = structure_measures().front();
  std::vector<ScaleRow> rows;
  for (const double value : {7.0, 9.0}) rows.push_back({"chain", 1, 20, 3, "power", &events, value});
  rows.push_back({"chain", 1, 10, 3, "power", &events, 4});
  rows.push_back({"chain", 1, 10, 3, "wrapped", &events, 1});
  const std::vector<ScaleSeries> all = series_of(rows);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].growth(), (GrowthPoints{{10, 4}, {20, 8}}));
  EXPECT_FALSE(all[0].sizes[0].interval);
  EXPECT_TRUE(all[0].sizes[1].interval);
  EXPECT_FALSE(all[0].fits());
  EXPECT_EQ(all[1].subject, "wrapped");
}

TEST(Scale, Refuses) {
  const auto refused = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "scale");
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 2) << run.out;
    EXPECT_EQ(count_of(run.err, "\n"), 1U) << run.err;
    return run.err;
  };
  EXPECT_THAT(refused({}), HasSubstr("needs INPUTs or --model NAME"));
  EXPECT_THAT(refused({"a.dcd", "--beads", "8"}), HasSubstr("--beads: has no meaning for INPUTs"));
  EXPECT_THAT(refused({"--model", "helis"}), HasSubstr("did you mean helix?"));
  EXPECT_THAT(refused({"--model", "helix", "a.dcd"}), HasSubstr("expected no INPUT beside it"));
  EXPECT_THAT(refused({"--model", "helix", "--dt", "1"}),
              HasSubstr("--dt: has no meaning for --model helix"));
  EXPECT_THAT(refused({"--model", "helix", "--beads", "8,8"}), HasSubstr("--beads: 8 is listed twice"));
  EXPECT_THAT(refused({"--model", "helix", "--seeds", "2"}),
              HasSubstr("--seeds: --model helix is the same for each seed; expected --model random-chain"));
  EXPECT_THAT(refused({"--model", "random-chain", "--beads", "3"}),
              HasSubstr("--model random-chain, 3 beads: the power diagram needs at least 4 beads"));
  EXPECT_THAT(refused({"--model", "helix", "--beads", "8", "--directions", "7"}), HasSubstr("--directions"));
  EXPECT_THAT(refused({data_file("paper/1a4y_AB.pdb")}), HasSubstr("at least two frames"));
  EXPECT_THAT(refused({data_file("kinetic/d3_n20_linear.txt")}), HasSubstr("an instance file has no size"));
}

}  // namespace
}  // namespace kds::test::scale_test
