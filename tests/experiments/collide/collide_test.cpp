// Tests `kds collide`: its options, its results and its files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "experiments/collide/collide_command.h"
#include "experiments/collide/compare_detectors.h"
#include "motions/base/input_error.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::collide_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::StartsWith;

TEST(CollideOptions, DefaultsAndAll) {
  const CollideOptions plain = parse_collide_options({"a.pdb"});
  EXPECT_TRUE(plain.all_methods);
  EXPECT_EQ(plain.methods.size(), collision_methods().size());
  EXPECT_EQ(plain.apart, 2U);
  EXPECT_EQ(plain.pairs, WhichPairs::all);
  const CollideOptions all =
      parse_collide_options({"a.xyz", "--method", "cells,brute", "--apart", "5", "--pairs", "within", "--out",
                             "there", "--json", "-", "--quiet", "b.xyz", "--radius", "2", "--frames", ":9"});
  EXPECT_THAT(all.inputs, ElementsAre("a.xyz", "b.xyz"));
  EXPECT_THAT(all.methods, ElementsAre("brute", "cells"));
  EXPECT_FALSE(all.all_methods);
  EXPECT_EQ(all.apart, 5U);
  EXPECT_EQ(all.pairs, WhichPairs::within);
  EXPECT_EQ(all.destinations.out, "there");
  EXPECT_EQ(all.destinations.json, "-");
  EXPECT_TRUE(all.destinations.quiet);
}

// Writes a square of side 2 that opens. Beads of radius 1 at adjacent corners touch; beads at opposite
// corners never meet.
std::string opening_square(const ScratchDirectory& directory) {
  return directory.file("square.xyz",
                        "4\nframe\nC 0 0 0\nC 2 0 0\nC 2 2 0\nC 0 2 0\n"
                        "4\nframe\nC 0 0 1\nC 2 0 0\nC 2 2 0\nC 0 2 0\n"
                        "4\nframe\nC 0 0.5 0\nC 2 0 0\nC 2 2 0\nC 0 2 0\n");
}

TEST(Collide, RowsOfAllMethodsAgree) {
  const ScratchDirectory directory;
  const ProgramRun run = run_program({"collide", opening_square(directory), "--radius", "1", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["input"]["beads"], 4);
  EXPECT_EQ(json["input"]["frames"], 3);
  EXPECT_EQ(json["input"]["dimension"], 3);
  EXPECT_EQ(json["settings"]["apart"], 2);
  EXPECT_TRUE(json.contains("machine") && json.contains("version"));
  std::vector<std::string> methods, telling;
  for (const Json& row : json["rows"]) {
    methods.push_back(row["method"]);
    // Beads 0 and 3 touch in frame 0 and overlap in frame 2.
    EXPECT_EQ(row["pairs"], 2) << row;
    EXPECT_EQ(row["colliding_frames"], 2) << row;
    for (const std::string what : {"seconds", "closest_seconds"}) {
      if (what == "closest_seconds" && row["closest"].is_null()) {
        for (const std::string end : {"", "_least", "_most"}) EXPECT_TRUE(row[what + end].is_null()) << row;
        continue;
      }
      EXPECT_GE(row[what + "_least"], 0) << row;
      EXPECT_LE(row[what + "_least"], row[what]) << row;
      EXPECT_LE(row[what], row[what + "_most"]) << row;
    }
    if (row["closest"].is_null()) continue;
    telling.push_back(row["method"]);
    EXPECT_EQ(row["closest"]["i"], 0) << row;
    EXPECT_EQ(row["closest"]["j"], 3) << row;
    EXPECT_EQ(row["closest"]["distance"], -0.5) << row;
    EXPECT_EQ(row["closest"]["frame"], 2) << row;
  }
  EXPECT_EQ(methods.size(), collision_methods().size());
  EXPECT_THAT(methods, IsSupersetOf({"cells", "auto"}));
  EXPECT_THAT(telling, ElementsAre("brute", "wrapped", "layered", "auto"));
  ASSERT_EQ(json["frames"].size(), 3U);
  EXPECT_EQ(json["frames"][0]["pairs"], 1);
  EXPECT_EQ(json["frames"][0]["closest"]["distance"], 0);
  EXPECT_EQ(json["frames"][1]["pairs"], 0);
  EXPECT_NEAR(json["frames"][1]["closest"]["distance"].get<double>(), std::sqrt(5.0) - 2, 1e-12);
}

TEST(Collide, RoundsChangeNothingButTimes) {
  const ScratchDirectory directory;
  const std::string square = opening_square(directory);
  const auto rows = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"collide", square, "--radius", "1", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    Json json = Json::parse(run.out);
    for (Json& row : json["rows"])
      for (const std::string what : {"seconds", "closest_seconds"})
        for (const std::string end : {"", "_least", "_most"}) row.erase(what + end);
    return std::pair(json["rows"], json["settings"]["rounds"]);
  };
  const auto [three, rounds] = rows({});
  EXPECT_EQ(rounds, 3);
  EXPECT_EQ(rows({"--rounds", "1"}), std::pair(three, Json(1)));
  EXPECT_EQ(rows({"--method", "auto"}).second, 1);
  EXPECT_EQ(rows({"--method", "auto"}).first[0], three.back());
  EXPECT_EQ(run_program({"collide", square, "--rounds", "0"}).code, 2);
}

TEST(Collide, InThePlaneAndBetweenTwo) {
  const ScratchDirectory directory;
  const std::string a = directory.file("a.xyz", "3\n\nC 0 0 7\nC 2 0 7\nC 4 0 7\n");
  const std::string b = directory.file("b.xyz", "3\n\nC 0 2 7\nC 2 3 7\nC 4 2 7\n");
  ProgramRun run = run_program({"collide", a, b, "--radius", "1", "--json", "-", "--pairs", "between"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  Json json = Json::parse(run.out);
  EXPECT_EQ(json["input"]["dimension"], 2);
  ASSERT_EQ(json["rows"].size(), collision_methods().size());
  for (const Json& row : json["rows"]) EXPECT_EQ(row["pairs"], 2) << row;
  run = run_program({"collide", a, b, "--radius", "1", "--json", "-", "--apart", "1"});
  ASSERT_EQ(run.code, 0) << run.err;
  json = Json::parse(run.out);
  ASSERT_EQ(json["rows"].size(), collision_methods().size());
  for (const Json& row : json["rows"]) EXPECT_EQ(row["pairs"], 4) << row;  // beads that touch
}

TEST(Collide, PairsWithinADistance) {
  const ScratchDirectory directory;
  const std::string square = opening_square(directory);
  for (const auto& [within, pairs] : {std::pair("0.2", 2), {"0.25", 3}, {"0.99", 8}, {"1", 9}}) {
    const ProgramRun run =
        run_program({"collide", square, "--radius", "1", "--json", "-", "--within", within});
    ASSERT_EQ(run.code, 0) << run.err;
    const Json json = Json::parse(run.out);
    EXPECT_EQ(json["settings"]["within"], std::stod(within));
    ASSERT_EQ(json["rows"].size(), collision_methods().size());
    for (const Json& row : json["rows"]) EXPECT_EQ(row["pairs"], pairs) << within << ": " << row;
  }
}

TEST(Collide, OfATrajectoryWithPlots) {
  const ScratchDirectory directory;
  const ProgramRun run = run_program(
      {"collide", data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
       data_file("trajectories/villin_hp36_300K.pdb"), "--frames", ":40:4", "--radius", "1.9", "--apart", "5",
       "--out", (directory / "out").string(), "--json", (directory / "rows.json").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("closest   beads "));
  const Json json = Json::parse(content_of(directory / "out/collide.json"));
  EXPECT_EQ(content_of(directory / "out/collide.json"), content_of(directory / "rows.json"));
  const std::string pairs = content_of(directory / "out/pairs.csv");
  EXPECT_THAT(pairs, StartsWith("frame,i,j,distance,name_i,name_j\n"));
  EXPECT_THAT(pairs, HasSubstr(" in chain "));
  EXPECT_EQ(std::count(pairs.begin(), pairs.end(), '\n') - 1, json["rows"][0]["pairs"]);
  EXPECT_THAT(content_of(directory / "out/collide.csv"), HasSubstr("\nwrapped,"));
  const std::string frames = content_of(directory / "out/frames.csv");
  EXPECT_EQ(std::count(frames.begin(), frames.end(), '\n'), 11);
  EXPECT_THAT(frames, HasSubstr("\n36,true,"));
  Json on_page = json;
  on_page["frames"] = Json::array();  // the page shows the course instead
  EXPECT_EQ(ReportData(directory / "out/report.html").result, on_page);
  ASSERT_EQ(json["course"].size(), 10U);
  for (const Json& bin : json["course"])
    for (const char* end : {"i", "j"})
      EXPECT_TRUE(json["names"].contains(bin["closest"][end].dump())) << bin.dump();
  std::uint64_t in_map = 0;
  for (const Json& group : json["map"]["groups"]) in_map += group["pairs"].get<std::uint64_t>();
  EXPECT_EQ(in_map, json["rows"][0]["pairs"]);
}

// A wrong method is detected: the error names the frame and both methods.
template <int Dimension>
class Wrong final : public Detector<Dimension> {
 public:
  void detect(const Balls<Dimension>&, Detection& found) override { found.pairs.clear(); }
};
template <int Dimension>
std::unique_ptr<Detector<Dimension>> make_wrong(const CollisionQuery&) {
  return std::make_unique<Wrong<Dimension>>();
}

TEST(Collide, BruteForceRefusesWhatTakesMinutes) {
  const auto refusal_of = [](std::size_t beads, BeadGroups groups = {}) {
    const CollisionQuery query{{{{0, static_cast<BeadId>(beads - 1)}}, true, 2, true, std::move(groups)}};
    const Balls<3> balls(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(beads)),
                         std::vector<double>(beads, 1.0));
    return collision_methods().front().make<3>(query)->refusal(balls);
  };
  EXPECT_FALSE(refusal_of(300'001));
  ASSERT_TRUE(refusal_of(300'002));
  EXPECT_THAT(*refusal_of(300'002),
              HasSubstr("looks at 45,000,150,000 pairs of beads; expected 45,000,000,000"));
  // Only pairs between the groups count.
  BeadGroups groups(300'002, 2);
  for (std::size_t b = 0; b < 1000; ++b) groups[b] = 1;
  EXPECT_FALSE(refusal_of(300'002, groups));
}

const std::string kVillin = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kVillinPdb = data_file("trajectories/villin_hp36_300K.pdb");

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::istringstream text(content_of(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// The pairs of a run with groups are those of a run without that join the groups. The beads are N, CA, C of
// the residues 41 to 76.
TEST(Collide, GroupsLeaveTheirPairs) {
  const ScratchDirectory directory;
  const auto run = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{
        "collide", kVillin,   "--topology", kVillinPdb, "--frames", ":12:4", "--radius",
        "1.9",     "--apart", "4",          "--rounds", "1",        "--out", (directory / name).string(),
        "--json",  "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun done = run_program(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    return done;
  };
  const std::vector<std::string> groups{"--groups", "//A/-60", "45-/N"};
  static_cast<void>(run("all", {"--within", "1"}));
  std::vector<std::string> within = groups;
  within.insert(within.end(), {"--within", "1"});
  const ProgramRun some = run("some", within);
  std::vector<std::string> expected = lines_of(directory / "all/pairs.csv");
  const std::size_t all = expected.size();
  std::erase_if(expected, [](const std::string& line) {
    int frame = 0, i = 0, j = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%d", &frame, &i, &j) != 3) return false;  // the header
    const auto first = [](int bead) { return 41 + bead / 3 <= 60; };
    const auto second = [](int bead) { return bead % 3 == 0 && 41 + bead / 3 >= 45; };
    return !(first(i) && second(j)) && !(first(j) && second(i));
  });
  EXPECT_GT(expected.size(), 5U);
  EXPECT_LT(expected.size(), all / 2);
  EXPECT_EQ(lines_of(directory / "some/pairs.csv"), expected);
  const Json json = Json::parse(some.out);
  EXPECT_EQ(json["settings"]["groups"], "//A/-60 45-/N");
  ASSERT_EQ(json["rows"].size(), 2U);
  EXPECT_EQ(json["rows"][0]["method"], "brute");
  EXPECT_EQ(json["rows"][1]["method"], "cells");
  EXPECT_EQ(json["rows"][0]["pairs"], expected.size() - 1);
  EXPECT_FALSE(json["rows"][0]["closest"].is_null());
}

TEST(Collide, MethodsThatDisagreeAreAnInternalFailure) {
  const ScratchDirectory directory;
  InputOptions input;
  input.inputs = {opening_square(directory)};
  input.radius = "1";
  const auto ignore = [](const std::string&) {};
  CollideFrames frames(input, ignore);
  const Method wrong{"wrong", "", false, false, make_wrong<2>, make_wrong<3>};
  CollideTask task{{&collision_methods().front(), &wrong}, {{frames.necklaces(), true, 2, true}}};
  try {
    static_cast<void>(compare_detectors(
        frames, task, [](const FrameRead&, const FrameFound&, std::span<const BeadPair>) {}, ignore,
        [](std::size_t, std::size_t) {}));
    ADD_FAILURE() << "nobody noticed";
  } catch (const InputError&) {
    ADD_FAILURE() << "the input is not at fault";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("frame 0: brute and wrong disagree on which beads collide ("));
  }
}

}  // namespace
}  // namespace kds::test::collide_test
