// Tests `kds info`: its options and its output.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/scenes/info_command.h"
#include "experiments/scenes/scene_info.h"
#include "motions/base/input_error.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::info_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

TEST(InfoOptions, TakesTheInputOptionsOfRunAndItsOwn) {
  const InfoOptions plain = parse_info_options({"a.pdb"});
  EXPECT_THAT(plain.inputs, ElementsAre("a.pdb"));
  EXPECT_EQ(plain.radius, "auto");
  EXPECT_TRUE(std::isinf(plain.validate.rho));
  EXPECT_EQ(plain.validate.most_listed, 5U);
  const InfoOptions all =
      parse_info_options({"a.dcd",    "--topology", "t.pdb",    "--select", "all",    "--chain", "B",
                          "--frames", ":9",         "--radius", "2",        "--rho",  "1.5",     "--list",
                          "0",        "--out",      "there",    "--json",   "j.json", "--quiet", "b.dcd"});
  EXPECT_THAT(all.inputs, ElementsAre("a.dcd", "b.dcd"));
  EXPECT_EQ(all.reading.topology, "t.pdb");
  EXPECT_EQ(all.reading.selection, Selection::all);
  EXPECT_EQ(all.reading.chain, "B");
  EXPECT_EQ(all.reading.frames.last, 9U);
  EXPECT_EQ(all.radius, "2");
  EXPECT_EQ(all.validate.rho, 1.5);
  EXPECT_EQ(all.validate.most_listed, 0U);
  EXPECT_EQ(all.out, "there");
  EXPECT_EQ(all.json, "j.json");
  EXPECT_TRUE(all.quiet);
}

TEST(InfoOptions, TakesTheUnitsOfLammps) {
  EXPECT_FALSE(parse_info_options({"a.dump"}).reading.units);
  EXPECT_EQ(parse_info_options({"a.dump", "--units", "nano"}).reading.units, LammpsUnits::nano);
  EXPECT_EQ(parse_info_options({"a.dump", "--units", "real"}).reading.units, LammpsUnits::real);
}

Trajectory necklace(const std::string& file, std::vector<Eigen::Matrix3Xd> frames) {
  Trajectory trajectory;
  trajectory.file = file;
  trajectory.frames = std::move(frames);
  return trajectory;
}

Eigen::Matrix3Xd row(const std::vector<double>& places) {
  Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) frame(0, static_cast<Eigen::Index>(i)) = places[i];
  return frame;
}

SceneInfo describe(const std::vector<Trajectory>& necklaces, const std::vector<double>& radii,
                   double rho = HUGE_VAL) {
  return describe_scene(necklaces, radii, {rho, 2}, [](std::size_t, std::size_t) {});
}

TEST(SceneInfo, CountsOverFramesAndListsTheFirst) {
  // A necklace of three frames breaks and closes again. Another necklace rests, and the first collides with
  // it in the second and third frame.
  const SceneInfo info = describe(
      {necklace("a", {row({0, 2, 4}), row({0, 3, 6}), row({0, 2, 5})}), necklace("b", {row({7.5, 9})})},
      {1, 1, 1, 1, 1}, 1.25);
  EXPECT_EQ(info.beads, 5U);
  EXPECT_EQ(info.frames, 3U);
  const ConditionInfo& connected = info.conditions[0];
  EXPECT_EQ(connected.violations, 3U);
  EXPECT_EQ(connected.frames, 2U);
  EXPECT_EQ(connected.first_frame, 1U);
  EXPECT_THAT(connected.first, ElementsAre(Violation{0, 1}, Violation{1, 2}));
  EXPECT_THAT(connected.by, ElementsAre(1.0, 1.0));
  const ConditionInfo& disjoint = info.conditions[1];
  EXPECT_EQ(disjoint.violations, 1U);
  EXPECT_THAT(disjoint.first, ElementsAre(Violation{2, 3}));
  EXPECT_THAT(disjoint.by, ElementsAre(0.5));
  EXPECT_TRUE(info.conditions[2].holds());
  EXPECT_TRUE(info.conditions[3].holds());
  const ConditionInfo& bonds = info.conditions[4];
  EXPECT_EQ(bonds.first_frame, 2U);
  EXPECT_THAT(bonds.first, ElementsAre(Violation{0, 1}));
  EXPECT_THAT(bonds.by, ElementsAre(1.5));
  EXPECT_FALSE(info.proper());
  EXPECT_EQ(info.necklaces[0].bonds.least, 2);
  EXPECT_EQ(info.necklaces[0].bonds.most, 3);
  EXPECT_EQ(info.necklaces[1].beads, (BeadRange{3, 4}));
  EXPECT_THROW(
      describe({necklace("a", {row({0, 2}), row({0, 2}), row({0, 2})}), necklace("b", {row({8}), row({9})})},
               {1, 1, 1}),
      InputError);
}

TEST(SceneInfo, InfinityIsNullInJson) {
  const SceneInfo info = describe({necklace("a", {row({0, 0, 2})})}, {1, 0, 1});
  kds::Json scene;
  add_scene(scene, info);
  const Json json = Json::parse(text_of(scene));
  EXPECT_EQ(json["necklaces"][0]["radius_ratio"], nullptr);
  EXPECT_EQ(json["necklaces"][0]["bond_ratio"], nullptr);
  EXPECT_EQ(json["rows"][3]["first"][0]["beads"], Json::array({1, 0}));
  EXPECT_EQ(json["rows"][3]["first"][0]["by"], nullptr);
  EXPECT_EQ(Json::parse(json.dump()), json);
}

TEST(Info, OfAFile) {
  const ScratchDirectory directory;
  const std::string json = (directory / "i.json").string();
  const ProgramRun run = run_program({"info", data_file("proteins/6wqa.cif"), "--radius", "element", "--json",
                                      json, "--out", (directory / "out").string(), "--list", "3"});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.err, HasSubstr("chain break after bead 761"));
  EXPECT_THAT(run.out, HasSubstr("1,173 beads, 1 frame\n"));
  EXPECT_THAT(run.out, HasSubstr("761-762"));
  const Json info = Json::parse(content_of(json));
  EXPECT_EQ(info["input"]["beads"], 1173);
  EXPECT_EQ(info["necklaces"][0]["breaks"], Json::array({761}));
  EXPECT_EQ(info["necklaces"][0]["later_breaks"]["frames"], 0);
  EXPECT_TRUE(info["necklaces"][0]["later_breaks"]["first_frame"].is_null());
  EXPECT_EQ(info["warnings"].size(), 1U);
  EXPECT_EQ(info["settings"]["radius"], "element");
  EXPECT_EQ(info["rows"].size(), 5U);
  EXPECT_EQ(info["rows"][0]["violations"], 1);
  EXPECT_EQ(info["rows"][1]["first"].size(), 3U);
  EXPECT_EQ(info["proper"], false);
  EXPECT_THAT(std::string(info["command"]), testing::StartsWith("kds info "));
  EXPECT_THAT(info["machine"].dump(), HasSubstr("cores"));
  EXPECT_EQ(content_of(directory / "out/info.json"), content_of(json));
  EXPECT_THAT(content_of(directory / "out/info.csv"), HasSubstr("connected,1,1,0,false\n"));
}

TEST(Info, FindsNoGapThatTheAutomaticRadiusLeft) {
  const std::vector<std::string> input{data_file("trajectories/random100_400K_first200.dcd"), "--frames",
                                       "::9"};
  std::vector<std::string> info{"info", "--json", "-"}, run{"run", "--structures", "wrapped", "--json", "-"};
  info.insert(info.end(), input.begin(), input.end());
  run.insert(run.end(), input.begin(), input.end());
  const Json told = Json::parse(run_program(info).out), ran = Json::parse(run_program(run).out);
  EXPECT_EQ(told["rows"][0]["condition"], "connected");
  EXPECT_EQ(told["rows"][0]["violations"], 0);
  EXPECT_EQ(told["input"]["radius_max"], ran["input"]["radius_max"]);
}

}  // namespace
}  // namespace kds::test::info_test
