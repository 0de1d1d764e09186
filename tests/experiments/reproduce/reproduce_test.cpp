// Tests `kds reproduce`: its measurements compared with slow counts, and its files.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
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
#include "structures/collision/brute_force.h"
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
  for (const Subject& planar : {grill_subject(89), spline_subject(50), rolling_spiral(50, 2)}) {
    EXPECT_TRUE(planar.planar);
    for (const Eigen::Matrix3Xd& frame : planar.frames) EXPECT_TRUE(frame.row(2).isZero(0));
  }
  EXPECT_FALSE(helix_subject(50, 3).planar);
}

// Rolled spirals in parallel planes have sets like those of the paper's last two rows, 1600 / 2400 and 2300 /
// 3700.
TEST(PaperSubjects, SpiralsInParallelPlanes) {
  const std::vector<PairedStage> stages{{1, 36}, {1, 32}};
  const Subject spirals = two_spirals(1000, stages);
  EXPECT_FALSE(spirals.planar);
  ASSERT_EQ(spirals.necklaces.size(), 2U);
  EXPECT_TRUE(spirals.frames[0].leftCols(1000).row(2).isZero(0));
  EXPECT_EQ(spirals.frames[0](2, 1000), 36);
  const PairsAsked asked{spirals.necklaces, false, 1, true};
  std::vector<std::uint64_t> found;
  for (const Eigen::Matrix3Xd& frame : spirals.frames)
    for (const Hierarchy kind : {Hierarchy::wrapped, Hierarchy::layered}) {
      SphereTree<3> tree(kind, spirals.necklaces);
      tree.build(Balls<3>(frame, spirals.radii));
      found.push_back(find_pairs(tree, asked).family);
    }
  EXPECT_EQ(found, (std::vector<std::uint64_t>{1642, 2769, 2326, 3169}));
}

// Counts the edges of all cells, and as edges to the infinite vertex the beads of facets that only one cell
// has.
template <int Dimension>
std::size_t edges_by_cells(const Subject& subject) {
  std::set<std::vector<BeadId>> edges;
  std::map<std::vector<BeadId>, int> facets;
  const std::vector<double> zeros(subject.beads(), 0);
  for (const auto& cell : static_triangulation<Dimension>(subject.frames[0], zeros).cells) {
    for (const BeadId a : cell) {
      std::vector<BeadId> facet;
      for (const BeadId b : cell) {
        if (a < b) edges.insert({a, b});
        if (a != b) facet.push_back(b);
      }
      ++facets[facet];
    }
  }
  std::set<BeadId> hull;
  for (const auto& [facet, cells] : facets)
    if (cells == 1) hull.insert(facet.begin(), facet.end());
  return edges.size() + hull.size();
}

TEST(PaperMeasurements, EdgesIncludeInfiniteOnes) {
  for (const std::size_t beads : {10U, 50U}) {
    const Subject spline = spline_subject(beads);
    const std::uint64_t edges = self_collision_of(spline, 0, 1).edges;
    EXPECT_EQ(edges, edges_by_cells<2>(spline));
    EXPECT_EQ(edges, 3 * beads - 3);  // the paper's 27 and 147
    const Subject helix = helix_subject(beads, 3.3);
    EXPECT_EQ(self_collision_of(helix, 0, 1).edges, edges_by_cells<3>(helix));
  }
  // An exactly straight chain has n - 1 edges, and one to the infinite vertex from each end.
  Subject straight = spline_subject(20);
  for (Eigen::Index bead = 0; bead < 20; ++bead)
    straight.frames[0].col(bead) << 2.0 * static_cast<double>(bead), 0, 0;
  EXPECT_EQ(self_collision_of(straight, 0, 1).edges, 21U);
  straight.planar = false;
  EXPECT_EQ(self_collision_of(straight, 0, 1).edges, 21U);
}

// The turns of the helices are fitted to these figures of the paper.
TEST(PaperMeasurements, HelicesFit) {
  struct Printed {
    std::size_t beads;
    double turns, pairs, edges;
  };
  for (const Printed& paper : {Printed{10, static_helix_turns, 27, 40},
                               {640, static_helix_turns, 1500, 57000},
                               {10, scaling_helix_turns * std::sqrt(10.0), 11, 55},
                               {640, scaling_helix_turns * std::sqrt(640.0), 1500, 45000}}) {
    const SelfCollision found = self_collision_of(helix_subject(paper.beads, paper.turns), 0, 1);
    EXPECT_NEAR(static_cast<double>(found.wrapped_pairs) / paper.pairs, 1, 0.25) << paper.beads;
    EXPECT_NEAR(static_cast<double>(found.edges) / paper.edges, 1, 0.25) << paper.beads;
  }
}

// Judges sets and families by their definitions.
template <int Dimension>
void expect_families(const Subject& subject) {
  const SelfCollision found = self_collision_of(subject, 0, 1);
  const std::vector<double> zeros(subject.beads(), 0);
  for (const bool centers : {true, false}) {
    const Balls<Dimension> balls(subject.frames[0], centers ? zeros : subject.radii);
    const PairsAsked asked{subject.necklaces, true, centers ? 1U : 2U, true};
    for (const auto& [kind, pairs] :
         {std::pair{Hierarchy::wrapped, centers ? found.wrapped_pairs : found.wrapped_family},
          {Hierarchy::layered, centers ? found.layered_pairs : found.layered_family}}) {
      SphereTree<Dimension> tree(kind, subject.necklaces);
      tree.build(balls);
      SeparatingFamily family;
      const PairsFound all = find_pairs(tree, asked, family);
      EXPECT_EQ(family_fault(family, all.pairs, balls, asked), std::nullopt);
      EXPECT_EQ(pairs, family.pairs.size());
      EXPECT_EQ(all.pairs.size(), centers ? 0 : found.collisions);
    }
    if (!centers) {
      EXPECT_EQ(found.collisions, pairs_by_force(balls, asked).size());
    }
  }
  EXPECT_GT(found.quadratic.seconds.least, 0);
  EXPECT_LE(found.quadratic.seconds.least, found.quadratic.seconds.median);
  EXPECT_LE(found.quadratic.seconds.median, found.quadratic.seconds.most);
}

TEST(PaperMeasurements, SelfCollision) {
  expect_families<2>(spline_subject(50));
  expect_families<3>(helix_subject(60, 3));
  const Subject overlapping = helix_subject(10, static_helix_turns);
  EXPECT_GT(self_collision_of(overlapping, 0, 1).collisions, 0U);
  expect_families<3>(overlapping);
}

TEST(PaperMeasurements, StraightChainsHaveAPairForEachNode) {
  EXPECT_EQ(self_collision_of(rolling_spiral(64, 2), 0, 1).wrapped_pairs, 63U);
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

TEST(PaperMeasurements, RemovalsEndTheStep) {
  const Subject villin =
      protein(kData, "trajectories/villin_hp36_300K.dcd", "trajectories/villin_hp36_300K.pdb");
  const DiagramStep gentle = diagram_step_of(villin, 0, 0, 1);
  EXPECT_EQ(gentle.rebuilds, 0U);
  EXPECT_GT(gentle.rebuild.seconds.median, 0);
  EXPECT_EQ(diagram_step_of(rolling_spiral(60, 2), 0, 1, 1).rebuilds, 2U);
}

TEST(PaperMeasurements, TwoNecklaces) {
  const std::vector<PairedStage> stages{{0.5, 400}, {0.51, 400}, {0.9, 4}, {0.91, 4}};
  const Subject spirals = two_spirals(100, stages);
  // The chains are far apart, so only the two roots are compared.
  EXPECT_EQ(collision_between(spirals, 0, 1, 1).wrapped_pairs, 1U);
  const CollisionBetween near = collision_between(spirals, 2, 3, 1);
  const Balls<3> balls(spirals.frames[3], std::vector<double>(spirals.beads(), 0));
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
  const std::vector<std::size_t> rows{21, 8, 12, 9, 17, 6, 6};
  for (int number = 1; number <= paper_table_count; ++number) {
    const PaperTablePlan plan = plan_paper_table(number, kData, 1);
    EXPECT_EQ(plan.table.number, number);
    EXPECT_EQ(plan.rows.size(), rows[static_cast<std::size_t>(number - 1)]);
  }
  EXPECT_THROW(static_cast<void>(plan_paper_table(8, kData, 1)), std::invalid_argument);
}

// A deviation above a quarter has the row's reason, else the column's; times have no deviation.
TEST(PaperTables, LargeDeviationsHaveReasons) {
  PaperTable table{1,
                   "t",
                   {{"ms", "ms", Quantity::time, true, "of the column"},
                    {"a_per_b", "a / b", Quantity::ratio, true, "of the column"},
                    {"count", "count"}},
                   {},
                   ""};
  const auto large = [&](double ms, double a_per_b, double count, Reasons reasons, double printed = 4) {
    const PaperRow row{"m", 2, "", {ms, a_per_b, count}, {1.0, 2.0, printed}, "", std::move(reasons)};
    std::string found;
    for (const Deviation& one : large_deviations(table, row))
      found += fmt::format("{} {} {}|", one.column, one.share.value_or(-9), one.reason);
    return found;
  };
  EXPECT_EQ(large(9, 2, 4, {}), "");
  EXPECT_EQ(large(9, 2.5, 3, {}), "");
  EXPECT_EQ(large(9, 3, 2, {}), "1 0.5 of the column|2 -0.5 no reason is known|");
  EXPECT_EQ(large(9, 1, 6, {{"count", "own"}}), "1 -0.5 of the column|2 0.5 own|");
  EXPECT_EQ(large(9, 2, 3, {}, 0), "2 -9 no reason is known|");
  EXPECT_EQ(large(9, 2, 0, {}, 0), "");
}

PaperTable sample() {
  PaperTable table{6,
                   "t",
                   {{"bases_changed", "bases"}, {"cells_changed", "cells"}},
                   {{"random, protein",
                     300,
                     "2 frames",
                     {12.0, 152.0},
                     {16.0, 608.0},
                     "why",
                     {{"cells_changed", "it is so"}}},
                    {"random, protein", 300, "32 frames", {14.0, 300.0}, {14.0, std::nullopt}, "", {}}},
                   "words"};
  return table;
}

TEST(PaperReport, SaysTheSameInAllForms) {
  EXPECT_EQ(paper_csv(sample()),
            "name,beads,at,bases_changed,bases_changed_paper,bases_changed_deviation,cells_changed,"
            "cells_changed_paper,cells_changed_deviation,note,reasons\n"
            "\"random, protein\",300,2 frames,12,16,-0.25,152,608,-0.75,why,cells_changed: it is so\n"
            "\"random, protein\",300,32 frames,14,14,0,300,,,,\n");
  const std::vector<PaperTable> tables{sample()};
  const Json rows = Json::parse(text_of(paper_rows_json(tables)));
  EXPECT_EQ(rows[1]["cells_changed_paper"], nullptr);
  EXPECT_EQ(rows[0]["bases_changed"], 12);
  EXPECT_EQ(rows[0]["cells_changed_deviation"], -0.75);
  EXPECT_THAT(sentence_of(findings_of(sample())[0]), HasSubstr("within a factor of 1.5: yes (12"));
  EXPECT_THAT(sentence_of(findings_of(sample())[1]), HasSubstr("grow: yes (from 152"));
  PaperTable other = sample();
  other.rows[0].ours = {2.0, 400.0};
  EXPECT_THAT(sentence_of(findings_of(other)[0]), HasSubstr(": no ("));
  EXPECT_THAT(sentence_of(findings_of(other)[1]), HasSubstr(": no ("));
  for (const std::string& text : {paper_text(tables), paper_page(tables, {})}) {
    EXPECT_THAT(text, HasSubstr("why. Rows: random, protein, 300 beads, 2 frames."));
    EXPECT_THAT(text, HasSubstr("cells: it is so. Rows: random, protein, 300 beads, 2 frames (-75%)."));
  }
}

TEST(PaperReport, TimesHaveTheSpreadOfTheirRounds) {
  PaperTable table{1, "t", {{"a_per_b", "a / b", Quantity::ratio}, {"rho_avg", "rho"}}, {}, ""};
  table.rows = {{"grill", 89, "", {Spread{0.5, 0.25, 2}, 0.75}, {0.5, std::nullopt}, "", {}}};
  EXPECT_EQ(paper_csv(table),
            "name,beads,at,a_per_b,a_per_b_least,a_per_b_most,a_per_b_paper,a_per_b_deviation,rho_avg,"
            "rho_avg_paper,rho_avg_deviation,note,reasons\n"
            "grill,89,,0.5,0.25,2,0.5,0,0.75,,,,\n");
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
      ASSERT_EQ(ours.rounds.has_value(), plan.table.columns[c].quantity != Quantity::number)
          << plan.table.columns[c].name;
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
  other.rows[0].ours = {2.0, 152.0};
  EXPECT_EQ(counts({sample()}), std::pair(3UL, 3UL));
  EXPECT_EQ(counts({other, sample()}), std::pair(2UL, 3UL));
  EXPECT_EQ(counts({sample(), other}), std::pair(2UL, 3UL));
  const std::vector<PaperTable> tables{other, sample()};
  EXPECT_THAT(paper_page(tables, {}), HasSubstr("<strong>2</strong> of 3 claims hold"));
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
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0]["at"], "1 frame");
  EXPECT_EQ(rows[0]["cells_changed_paper"], 462);
  EXPECT_EQ(rows[5]["at"], "32 frames");
  EXPECT_EQ(rows[5]["cells_changed_paper"], 1238);
  for (const Json& row : rows)
    EXPECT_THAT(std::string(row["reasons"]), testing::Not(HasSubstr("no reason is known")));
  const ProgramRun compare = run_program({"compare", data_file("paper/random100_400K_900to932.dcd"),
                                          "--structures", "wrapped", "--strides", "32", "--json", "-"});
  ASSERT_EQ(compare.code, 0) << compare.err;
  EXPECT_EQ(rows[5]["bases_changed"], Json::parse(compare.out)["rows"][0]["net_changes"]);
  EXPECT_EQ(content_of(scratch / "out/table1.csv"), "the user's");
  EXPECT_THAT(content_of(scratch / "out/table6.csv"), StartsWith("name,beads,at,lazy_ms,"));
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
