// Tests `kds reproduce`: its measurements compared with slow counts, and its files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/reproduce/findings.h"
#include "experiments/reproduce/measurements.h"
#include "experiments/reproduce/paper_tables.h"
#include "experiments/reproduce/reproduce_command.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::test::reproduce_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

const std::string kData = data_file("");

TEST(PaperSubjects, AreThoseOfThePaper) {
  EXPECT_EQ(protein(kData, "paper/1a4y_AB.pdb").beads(), 1380U);
  EXPECT_EQ(protein(kData, "paper/5h73.pdb").beads(), 1089U);
  EXPECT_EQ(protein(kData, "paper/villin_hp36_collapse.pdb").beads(), 108U);
  EXPECT_TRUE(model_subject("grill", 89).planar);
  EXPECT_FALSE(model_subject("spline", 50).planar);
  const Subject spirals = two_rolling_spirals(60, 3);
  EXPECT_EQ(spirals.beads(), 120U);
  EXPECT_EQ(spirals.necklaces.size(), 2U);
  EXPECT_EQ(spirals.frames.size(), 3U);
}

// Compares with the edges of all cells, and judges the family by its definition.
TEST(PaperMeasurements, SelfCollision) {
  const Subject spline = model_subject("spline", 50);
  const SelfCollision found = self_collision_of(spline, 0, 1);
  std::set<std::pair<BeadId, BeadId>> edges;
  for (const auto& cell :
       static_triangulation<3>(spline.frames[0], spline.radii).cells)  // weights are 1, too
    for (const BeadId a : cell)
      for (const BeadId b : cell)
        if (a < b) edges.insert({a, b});
  EXPECT_EQ(found.edges, edges.size());
  const Balls<3> balls(spline.frames[0], spline.radii);
  const PairsAsked asked{spline.necklaces, true, 2, true};
  for (const auto& [kind, pairs] :
       {std::pair{Hierarchy::wrapped, found.wrapped_pairs}, {Hierarchy::layered, found.layered_pairs}}) {
    SphereTree<3> tree(kind, spline.necklaces);
    tree.build(balls);
    SeparatingFamily family;
    const PairsFound all = find_pairs(tree, asked, family);
    EXPECT_EQ(family_fault(family, all.pairs, balls, asked), std::nullopt);
    EXPECT_EQ(pairs, family.pairs.size());
  }
  EXPECT_GT(found.quadratic_per_wrapped.least, 0);
  EXPECT_LE(found.quadratic_per_wrapped.least, found.quadratic_per_wrapped.median);
  EXPECT_LE(found.quadratic_per_wrapped.median, found.quadratic_per_wrapped.most);
}

TEST(PaperMeasurements, StepsBetweenFrames) {
  const Subject villin =
      protein(kData, "trajectories/villin_hp36_300K.dcd", "trajectories/villin_hp36_300K.pdb");
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 1}, {3, 40}, {7, 7}}) {
    const Step step = step_of(villin, from, to, 1);
    StaticWrappedHierarchy<3> before(villin.necklaces), after(villin.necklaces);
    before.build(Balls<3>(villin.frames[from], villin.radii));
    after.build(Balls<3>(villin.frames[to], villin.radii));
    std::uint64_t changed = 0;
    for (NodeId node = 0; node < before.tree().node_count(); ++node)
      changed += before.basis(node) == after.basis(node) ? 0 : 1;
    EXPECT_EQ(step.bases_changed, changed);
    const std::vector<double> weights(villin.beads(), villin.radii[0] * villin.radii[0]);
    const auto old_cells = static_triangulation<3>(villin.frames[from], weights).cells;
    const std::set<CellBeads<3>> old(old_cells.begin(), old_cells.end());
    std::uint64_t added = 0;
    for (const auto& cell : static_triangulation<3>(villin.frames[to], weights).cells)
      added += old.count(cell) == 0;
    EXPECT_EQ(step.cells_changed, added);
    EXPECT_EQ(step.cells_changed == 0, from == to);
    EXPECT_GT(step.frontier, 1);
    EXPECT_LT(step.frontier, 10);
  }
}

TEST(PaperMeasurements, TwoNecklaces) {
  const Subject spirals = two_rolling_spirals(100, 11);
  // The chains are far apart, so only the two roots are compared.
  EXPECT_EQ(collision_between(spirals, 0, 1, 1).wrapped_pairs, 1U);
  const CollisionBetween near = collision_between(spirals, 9, 10, 1);
  const Balls<3> balls(spirals.frames[10], spirals.radii);
  const PairsAsked asked{spirals.necklaces, false, 1, true};
  for (const auto& [kind, pairs] :
       {std::pair{Hierarchy::wrapped, near.wrapped_pairs}, {Hierarchy::layered, near.layered_pairs}}) {
    SphereTree<3> tree(kind, spirals.necklaces);
    tree.build(balls);
    const PairsFound found = find_pairs(tree, asked);
    EXPECT_EQ(pairs, found.family + found.pairs.size());
    EXPECT_GT(pairs, 1U);
  }
}

TEST(PaperTables, HaveThePapersRows) {
  const std::vector<std::size_t> rows{21, 8, 12, 9, 17, 5, 5};
  for (int number = 1; number <= paper_table_count; ++number) {
    const PaperTablePlan plan = plan_paper_table(number, kData, 1);
    EXPECT_EQ(plan.table.number, number);
    EXPECT_EQ(plan.rows.size(), rows[static_cast<std::size_t>(number - 1)]);
  }
  EXPECT_THROW(static_cast<void>(plan_paper_table(8, kData, 1)), std::invalid_argument);
}

PaperTable sample() {
  PaperTable table{6,
                   "t",
                   {{"bases_changed", "bases"}, {"cells_changed", "cells"}},
                   {{"random, protein", 300, "2 frames", {10.0, 100.0}, {15.0, 608.0}, "why"},
                    {"random, protein", 300, "32 frames", {12.0, 300.0}, {14.0, std::nullopt}, ""}},
                   "words"};
  return table;
}

TEST(PaperReport, SaysTheSameInAllForms) {
  EXPECT_EQ(paper_csv(sample()),
            "name,beads,at,bases_changed,bases_changed_paper,cells_changed,cells_changed_paper,note\n"
            "\"random, protein\",300,2 frames,10,15,100,608,why\n"
            "\"random, protein\",300,32 frames,12,14,300,,\n");
  const std::vector<PaperTable> tables{sample()};
  const Json rows = Json::parse(text_of(paper_rows_json(tables)));
  EXPECT_EQ(rows[1]["cells_changed_paper"], nullptr);
  EXPECT_EQ(rows[0]["bases_changed"], 10);
  EXPECT_THAT(sentence_of(findings_of(sample())[0]), HasSubstr("within a factor of 1.5: yes (10"));
  EXPECT_THAT(sentence_of(findings_of(sample())[1]), HasSubstr("grow: yes (from 100"));
  PaperTable other = sample();
  other.rows[0].ours = {2.0, 400.0};
  EXPECT_THAT(sentence_of(findings_of(other)[0]), HasSubstr(": no ("));
  EXPECT_THAT(sentence_of(findings_of(other)[1]), HasSubstr(": no ("));
  EXPECT_THAT(paper_text(tables), HasSubstr("why"));
}

TEST(PaperReport, TimesHaveTheSpreadOfTheirRounds) {
  PaperTable table{1, "t", {{"a_per_b", "a / b time", true}, {"rho_avg", "rho"}}, {}, ""};
  table.rows = {{"grill", 89, "", {Spread{0.5, 0.25, 2}, 0.75}, {0.125, std::nullopt}, ""}};
  EXPECT_EQ(paper_csv(table),
            "name,beads,at,a_per_b,a_per_b_least,a_per_b_most,a_per_b_paper,rho_avg,rho_avg_paper,note\n"
            "grill,89,,0.5,0.25,2,0.125,0.75,,\n");
  const Json row = Json::parse(text_of(paper_rows_json(std::vector{table})))[0];
  EXPECT_EQ(row["a_per_b"], 0.5);
  EXPECT_EQ(row["a_per_b_least"], 0.25);
  EXPECT_EQ(row["a_per_b_most"], 2);
  EXPECT_FALSE(row.contains("rho_avg_least"));
}

// The spread over several rounds differs from that of one round in every table with times.
TEST(PaperTables, RoundsOfTimedColumnsDiffer) {
  for (const int number : {1, 2, 3, 4, 5, 6}) {
    const PaperTablePlan plan = plan_paper_table(number, kData, 3);
    const PaperRow row = plan.rows.front()();
    ASSERT_EQ(row.ours.size(), plan.table.columns.size());
    for (std::size_t c = 0; c < row.ours.size(); ++c) {
      const PaperValue& ours = row.ours[c];
      ASSERT_EQ(ours.rounds.has_value(), plan.table.columns[c].timed) << plan.table.columns[c].name;
      if (!ours.rounds) continue;
      EXPECT_LT(ours.rounds->least, ours.rounds->most) << plan.table.columns[c].name;
      EXPECT_LE(ours.rounds->least, ours.value);
      EXPECT_LE(ours.value, ours.rounds->most);
    }
  }
}

// A claim that appears in two tables counts once, and holds if both tables confirm it.
TEST(PaperReport, CountsEachClaimOnce) {
  const auto counts = [](const std::vector<PaperTable>& tables) {
    const ClaimsJudged claims = judged(tables);
    return std::pair(claims.hold, claims.all);
  };
  PaperTable other = sample();
  // This row breaks the claim that bases are flat; the claim that cells grow still holds.
  other.rows[0].ours = {2.0, 100.0};
  EXPECT_EQ(counts({sample()}), std::pair(2UL, 2UL));
  EXPECT_EQ(counts({other, sample()}), std::pair(1UL, 2UL));
  EXPECT_EQ(counts({sample(), other}), std::pair(1UL, 2UL));
  const std::vector<PaperTable> tables{other, sample()};
  EXPECT_THAT(paper_page(tables, {}), HasSubstr("<strong>1</strong> of 2 claims hold"));
  const Json json = Json::parse(text_of(paper_findings_json(tables)));
  EXPECT_EQ(json[0]["findings"][0]["claim"], "bases-flat");
  EXPECT_EQ(json[0]["findings"][0]["holds"], false);
}

// One step of `kds compare` equals a row of table 6.
TEST(Reproduce, StabilityAsCompareHasIt) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "out");
  scratch.file("out/table1.csv", "the user's");
  const ProgramRun run =
      run_program({"reproduce", "table6", "--rounds", "1", "--out", scratch / "out", "--data", kData});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("Changes of the diagram grow"));
  const Json rows = Json::parse(content_of(scratch / "out/reproduce.json"))["rows"];
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[4]["at"], "32 frames");
  EXPECT_EQ(rows[4]["cells_changed_paper"], 1238);
  const ProgramRun compare = run_program({"compare", data_file("paper/random100_400K_900to932.dcd"),
                                          "--structures", "wrapped", "--strides", "32", "--json", "-"});
  ASSERT_EQ(compare.code, 0) << compare.err;
  EXPECT_EQ(rows[4]["bases_changed"], Json::parse(compare.out)["rows"][0]["net_changes"]);
  EXPECT_EQ(content_of(scratch / "out/table1.csv"), "the user's");
  EXPECT_THAT(content_of(scratch / "out/table6.csv"), StartsWith("name,beads,at,bases_changed,"));
  const std::string page = content_of(scratch / "out/report.html");
  expect_sound(page);
  for (const char* part : {"<svg", "Table 6", "kds reproduce table6 --rounds 1", "--data"})
    EXPECT_THAT(page, HasSubstr(part));
}

TEST(Reproduce, Refusals) {
  const auto refused = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "reproduce");
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 2);
    return run.err;
  };
  EXPECT_THAT(refused({}), HasSubstr("needs at least one TABLE"));
  EXPECT_THAT(refused({"table8"}), HasSubstr("'table8' is not one of table1 ... table7, all"));
  for (const char* other : {"table5", "all"})
    EXPECT_THAT(refused({"table5", other}), HasSubstr("TABLE: table5 is listed twice"));
  EXPECT_THAT(refused({"table1", "--rounds", "0"}), HasSubstr("--rounds"));
  EXPECT_THAT(refused({"table1", "--data", "nowhere"}), HasSubstr("--data: there is no folder nowhere"));
}

}  // namespace
}  // namespace kds::test::reproduce_test
