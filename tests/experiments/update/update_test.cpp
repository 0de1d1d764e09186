// Tests `kds update`: its options, its counts and its files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/update/compare_updates.h"
#include "experiments/update/update_command.h"
#include "motions/base/input_error.h"
#include "motions/frames/trajectory.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::update_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(UpdateOptions, DefaultsAndAll) {
  const UpdateOptions plain = parse_update_options({"a.dcd"});
  EXPECT_EQ(plain.techniques.size(), kTechniques.size());
  EXPECT_THAT(plain.strides, ElementsAre(1U));
  EXPECT_EQ(plain.audit, AuditMode::none);
  const UpdateOptions all = parse_update_options({"a.dcd", "--techniques", "lifted,kinetic", "--strides",
                                                  "8,1,2", "--rounds", "7", "--audit", "frames", "--frames",
                                                  ":9", "--out", "there", "--json", "-", "--quiet", "b.dcd"});
  EXPECT_THAT(all.inputs, ElementsAre("a.dcd", "b.dcd"));
  EXPECT_THAT(all.techniques, ElementsAre("rebuild", "kinetic", "lifted"));
  EXPECT_THAT(all.strides, ElementsAre(1U, 2U, 8U));
  EXPECT_EQ(all.rounds, 7U);
  EXPECT_EQ(all.audit, AuditMode::frames);
  EXPECT_EQ(all.out, "there");
  EXPECT_EQ(all.json, "-");
  EXPECT_TRUE(all.quiet);
}

TEST(UpdateAudit, OnlyADiagramWithAFaultFails) {
  const StaticTriangulation<3> one{{{0, 1, 2, 3}}, {4}, 3}, other{{{0, 1, 2, 4}}, {3}, 3};
  const auto sound = [] { return std::optional<std::string>(); };
  const auto wrong = [] { return std::optional<std::string>("bead 3 has no cell"); };
  EXPECT_NO_THROW(audit_update(one, one, wrong, "x"));
  EXPECT_NO_THROW(audit_update(one, other, sound, "x"));
  EXPECT_THROW(audit_update(one, other, wrong, "x"), AuditError);
  StaticTriangulation<3> without = one;
  without.hidden.clear();
  EXPECT_THROW(audit_update(without, one, wrong, "x"), AuditError);
}

/// Five beads, one of which passes through the sphere of the others: two cells become three, and two again.
std::vector<Trajectory> passing() {
  Eigen::Matrix3Xd outside(3, 5), inside(3, 5);
  outside << 0, 4, 0, 0, 5,  //
      0, 0, 4, 0, 5,         //
      0, 0, 0, 4, 5;
  inside = outside;
  inside.col(4).setConstant(2);
  Trajectory trajectory;
  trajectory.file = "passing";
  trajectory.frames = {outside, inside, inside, outside};
  return {trajectory};
}

Scene passing_at(std::size_t stride, FrameMotion motion) {
  std::vector<Trajectory> some;
  for (const Trajectory& necklace : passing()) some.push_back(every_nth(necklace, stride));
  return Scene(some, std::vector<double>(5, 1.0), motion);
}

TEST(CompareUpdates, CountsWhatChangesAndWhatIsDone) {
  UpdateOptions options;
  options.audit = AuditMode::frames;
  options.rounds = 1;
  const auto rows = compare_updates(passing_at, options, [](std::size_t, std::size_t) {});
  ASSERT_EQ(rows.size(), kTechniques.size());
  for (std::size_t t = 0; t < rows.size(); ++t) {
    const UpdateRow& row = rows[t];
    SCOPED_TRACE(row.technique);
    EXPECT_EQ(row.technique, kTechniques[t]);
    EXPECT_EQ(row.task.steps, 3U);
    // Two cells become three, then stay, then become two again. Each change has five cells that are in only
    // one of the two frames.
    EXPECT_EQ(row.task.cells, 3U + 3U + 2U);
    EXPECT_EQ(row.task.cells_changed, 10U);
    EXPECT_EQ(row.task.hidden, 0U);
    EXPECT_GT(row.task.failed, 0U);
    EXPECT_LT(row.task.failed, row.task.certificates);
    EXPECT_EQ(row.audits, 3U);
    EXPECT_GT(row.seconds.median, 0);
    if (row.technique == "rebuild") {
      EXPECT_EQ(row.rebuilds, 3U);
      EXPECT_EQ(row.ratio, 1);
      EXPECT_FALSE(row.events || row.activated || row.removed || row.efficiency());
    } else if (row.technique == "kinetic" || row.technique == "lifted" || row.technique == "hermite") {
      EXPECT_EQ(row.rebuilds, 0U);
      EXPECT_EQ(row.activated, 15U);
      EXPECT_EQ(row.events.value() % 2, 0U);
      EXPECT_GE(row.events.value(), 2U);
      EXPECT_DOUBLE_EQ(row.efficiency().value(), static_cast<double>(*row.events) / 10);
    } else if (row.technique == "reinsert" || row.technique == "greedy") {
      EXPECT_EQ(row.rebuilds, 2U);  // too few beads to remove one
      EXPECT_TRUE(row.removed);
    }
  }
  UpdateOptions far = options;
  far.strides = {4};
  EXPECT_THAT(update_table(rows), HasSubstr(std::to_string(3 * rows.size()) + " audits"));
  EXPECT_THROW(static_cast<void>(compare_updates(passing_at, far, [](std::size_t, std::size_t) {})),
               InputError);
}

TEST(UpdateReport, RowsInAllForms) {
  UpdateRow rebuild, kinetic;
  rebuild.technique = "rebuild";
  rebuild.task = {4, 10, 1000, 0, 40, 2000, 50};
  rebuild.rebuilds = 10;
  rebuild.seconds = {0.001, 0.0009, 0.002};
  kinetic = rebuild;
  kinetic.technique = "kinetic";
  kinetic.rebuilds = 0;
  kinetic.activated = 70;
  kinetic.events = 20;
  kinetic.seconds = {0.0005, 0.0004, 0.0007};
  kinetic.ratio = 0.5;
  const std::array rows{rebuild, kinetic};
  const Json json = Json::parse(text_of(update_columns().json(rows)));
  EXPECT_EQ(json[0]["events"], nullptr);
  EXPECT_EQ(json[0]["efficiency"], nullptr);
  EXPECT_EQ(json[1]["efficiency"], 0.5);
  EXPECT_EQ(json[1]["certificates_failed"], 50);
  EXPECT_THAT(update_columns().csv(rows),
              HasSubstr("4,kinetic,10,1000,0,40,2000,50,70,,20,0.5,0,0,0.0005,0.5,0.0004,0.0007\n"));
  EXPECT_THAT(update_table(rows), HasSubstr("2.5% of 200.0 certificates failed"));
  EXPECT_THAT(update_table(rows), HasSubstr("50.00  0.500"));
}

TEST(Update, OfATrajectoryWithAPage) {
  const ScratchDirectory directory;
  const ProgramRun run =
      run_program({"update", data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
                   data_file("trajectories/villin_hp36_300K.pdb"), "--frames", ":9", "--strides", "1,4",
                   "--audit", "frames", "--rounds", "1", "--out", (directory / "out").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("stride 4: 2 steps"));
  EXPECT_THAT(run.out, testing::EndsWith("report " + (directory / "out/report.html").string() + "\n"));
  const Json json = Json::parse(content_of(directory / "out/update.json"));
  EXPECT_EQ(json["input"]["beads"], 108);
  EXPECT_EQ(json["settings"]["strides"], Json::array({1, 4}));
  ASSERT_EQ(json["rows"].size(), 2 * kTechniques.size());
  EXPECT_TRUE(json.contains("machine") && json.contains("version"));
  for (const Json& row : json["rows"]) EXPECT_EQ(row["audits"], row["steps"]);
  EXPECT_THAT(content_of(directory / "out/update.csv"), HasSubstr("\n4,auto,2,"));
  const ReportData report(directory / "out/report.html");
  EXPECT_EQ(report.result, json);
  EXPECT_EQ(report.links["data"], Json::array({"update.json", "update.csv"}));
}

TEST(Update, BeadsThatHideOthers) {
  const ScratchDirectory directory;
  std::string radii;
  for (int bead = 0; bead < 108; ++bead) radii += bead % 4 == 0 ? "3\n" : "0.5\n";
  const ProgramRun run = run_program({"update", data_file("trajectories/villin_hp36_300K.dcd"), "--frames",
                                      "::100", "--radius", "file:" + directory.file("radii", radii),
                                      "--techniques", "reinsert,kinetic,lifted,activate,auto", "--audit",
                                      "frames", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  ASSERT_EQ(json["rows"].size(), 6U);
  EXPECT_GT(json["rows"][0]["hidden"], 20);
}

TEST(Update, PlanarTrajectoriesInThePlane) {
  const ScratchDirectory directory;
  const std::string chain = (directory / "chain.xyz").string();
  ASSERT_EQ(run_program(
                {"generate", "spiral", "--beads", "100", "--frames", "6", "--rolled", "0.3:0.5", "-o", chain})
                .code,
            0);
  const ProgramRun run =
      run_program({"update", chain, "--strides", "1,2", "--audit", "frames", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["input"]["dimension"], 2);
  ASSERT_EQ(json["rows"].size(), 2 * kTechniques.size());
  for (const Json& row : json["rows"]) {
    EXPECT_EQ(row["audits"], row["steps"]);
    // At most two triangles per bead.
    EXPECT_LT(row["cells"], row["steps"].get<double>() * 200);
    EXPECT_GT(row["cells"], row["steps"].get<double>() * 100);
  }
}

}  // namespace
}  // namespace kds::test::update_test
