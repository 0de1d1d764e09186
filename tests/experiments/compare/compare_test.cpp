// Tests `kds compare`: its options, and its counts compared with those of single runs and of their dumps.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/compare/compare_command.h"
#include "experiments/compare/compare_report.h"
#include "experiments/compare/compare_runs.h"
#include "experiments/output/text.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::compare_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string kDcd = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kPdb = data_file("trajectories/villin_hp36_300K.pdb");

TEST(CompareOptions, DefaultsAndAll) {
  const CompareOptions plain = parse_compare_options({"a.dcd"});
  EXPECT_TRUE(plain.structures.empty());
  EXPECT_THAT(plain.strides, ElementsAre(1U));
  EXPECT_THAT(plain.motions, ElementsAre(FrameMotion::linear));
  const CompareOptions all = parse_compare_options({"a.dcd", "--structures", "contacts,wrapped", "--strides",
                                                    "8,1", "--motions", "hermite,linear", "--apart", "4",
                                                    "--out", "there", "--json", "-", "--quiet", "b.dcd"});
  EXPECT_THAT(all.inputs, ElementsAre("a.dcd", "b.dcd"));
  EXPECT_THAT(all.structures, ElementsAre("wrapped", "contacts"));
  EXPECT_THAT(all.strides, ElementsAre(1U, 8U));
  EXPECT_THAT(all.motions, ElementsAre(FrameMotion::linear, FrameMotion::hermite));
  EXPECT_EQ(all.apart, 4U);
  EXPECT_EQ(all.out, "there");
  EXPECT_EQ(all.json, "-");
  EXPECT_TRUE(all.quiet);
}

CombinatorialElement element(std::initializer_list<BeadId> ids) {
  CombinatorialElement all;
  all.fill(no_bead);
  std::copy(ids.begin(), ids.end(), all.begin());
  return all;
}

TEST(NetChanges, CountPlacesThatHoldSomethingElse) {
  const CombinatorialElements nodes{2, {element({0, 3, 0, 3}), element({0, 1, 0, 1}), element({2, 3, 2, 3})}};
  CombinatorialElements other = nodes;
  EXPECT_EQ(net_changes(nodes, other), 0U);
  std::swap(other.all[0], other.all[2]);  // the order does not matter
  EXPECT_EQ(net_changes(nodes, other), 0U);
  other.all[2] = element({0, 3, 0, 1, 3});
  EXPECT_EQ(net_changes(nodes, other), 1U);
  other.all.erase(other.all.begin());
  EXPECT_EQ(net_changes(nodes, other), 2U);
  EXPECT_EQ(net_changes(other, nodes), 2U);
  const CombinatorialElements two{3, {element({0, 1, 2}), element({1, 2, 3})}},
      three{3, {element({0, 1, 4}), element({0, 2, 4}), element({1, 2, 3})}};
  EXPECT_EQ(net_changes(two, three), 3U);
  NetChanges sum;
  EXPECT_FALSE(sum.count());
  for (const auto& frame : {two, three, two}) sum.add(frame);
  EXPECT_EQ(sum.count(), 6U);
  sum.add(std::nullopt);
  EXPECT_FALSE(sum.count());
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::istringstream text(content_of(path));
  std::string line;
  std::getline(text, line);  // the header
  while (std::getline(text, line)) lines.push_back(line);
  return lines;
}

// Counts net changes slowly, from the dumps of two frames.
int cells_in_one_only(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::vector<std::string> x = lines_of(a), y = lines_of(b);
  const std::set<std::string> before(x.begin(), x.end()), after(y.begin(), y.end());
  std::vector<std::string> one_only;
  std::set_symmetric_difference(before.begin(), before.end(), after.begin(), after.end(),
                                std::back_inserter(one_only));
  return static_cast<int>(one_only.size());
}
int bases_changed(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto bases = [](const std::filesystem::path& path) {
    std::map<std::string, std::string> of_nodes;
    for (const std::string& line : lines_of(path)) {
      const std::size_t node = line.find(',', line.find(',') + 1);
      of_nodes[line.substr(0, node)] = line.substr(node, line.find(',', node + 1) - node);
    }
    return of_nodes;
  };
  const auto before = bases(a), after = bases(b);
  int changed = 0;
  for (const auto& [node, basis] : before) changed += after.at(node) == basis ? 0 : 1;
  return changed;
}
int ranks_changed(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::vector<std::string> before = lines_of(a), after = lines_of(b);
  int changed = 0;
  for (std::size_t rank = 0; rank < before.size(); ++rank) changed += before[rank] == after[rank] ? 0 : 1;
  return changed;
}
// Counts, from the events, the pairs whose contact after a step differs from their contact before it.
int pairs_changed(const std::filesystem::path& contacts, int steps) {
  std::vector<std::set<std::string>> after(static_cast<std::size_t>(steps) + 1);
  std::set<std::string> pairs;
  std::size_t reached = 0;
  for (const std::string& line : lines_of(contacts)) {  // step,lower,upper,i,j,event
    std::vector<std::string> fields;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    const bool at_start = fields[0] == "0" && fields[1] == "0" && fields[2] == "0";
    const std::size_t frame = at_start ? 0 : std::stoul(fields[0]) + 1;
    for (; reached < frame; ++reached) after[reached] = pairs;
    const std::string pair = fields[3] + " " + fields[4];
    if (fields[5] == "begin") pairs.insert(pair);
    if (fields[5] == "end") pairs.erase(pair);
  }
  for (; reached < after.size(); ++reached) after[reached] = pairs;
  int changed = 0;
  for (std::size_t k = 1; k < after.size(); ++k) {
    std::vector<std::string> one_only;
    std::set_symmetric_difference(after[k - 1].begin(), after[k - 1].end(), after[k].begin(), after[k].end(),
                                  std::back_inserter(one_only));
    changed += static_cast<int>(one_only.size());
  }
  return changed;
}

void expect_as_in_a_run(const Json& rows, const std::string& stride, const std::string& motion,
                        const ScratchDirectory& scratch) {
  const std::filesystem::path dump = scratch / ("dump-" + motion + stride);
  const ProgramRun run = run_program({"run", kDcd, "--topology", kPdb, "--frames", "100:140:" + stride,
                                      "--radius", "1.9", "--structures", "sorted,wrapped,power,contacts",
                                      "--motion", motion, "--dump", dump, "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(run.out);
  const int steps = summary["input"]["frames"].get<int>() - 1;
  int found = 0;
  for (const Json& row : rows) {
    if (std::to_string(row["stride"].get<int>()) != stride || row["motion"] != motion) continue;
    ++found;
    const std::string name = row["structure"];
    SCOPED_TRACE(name + " at stride " + stride + ", " + motion);
    const Json& expected = summary["structures"][name];
    EXPECT_EQ(row["steps"], steps);
    EXPECT_EQ(row["events"], expected["events"]["total"]);
    for (const auto& [kind, count] : expected["events"].items())
      if (kind != "total") {
        EXPECT_EQ(row[kind], count) << kind;
      }
    EXPECT_EQ(row["compactness"], expected["certificates"]["peak"]);
    EXPECT_GE(row["locality"], expected["certificates"]["per_bead_max"]);
    int net = 0;
    for (int k = 1; k <= steps; ++k) {
      const auto of_frame = [&](int frame, const std::string& ending) {
        return dump / ("frame-" + std::to_string(frame) + "." + ending);
      };
      if (name == "power") net += cells_in_one_only(of_frame(k - 1, "power.csv"), of_frame(k, "power.csv"));
      if (name == "wrapped") net += bases_changed(of_frame(k - 1, "wrapped.csv"), of_frame(k, "wrapped.csv"));
      if (name == "sorted") net += ranks_changed(of_frame(k - 1, "sorted.csv"), of_frame(k, "sorted.csv"));
    }
    if (name == "contacts") net = pairs_changed(dump / "contacts.csv", steps);
    EXPECT_EQ(row["net_changes"], net);
    EXPECT_GT(net, 0);
    EXPECT_DOUBLE_EQ(row["events_per_net_change"], row["events"].get<double>() / net);
    EXPECT_EQ(row["efficiency"], 1);  // none of these structures has internal events
    EXPECT_DOUBLE_EQ(row["events_per_step"], row["events"].get<double>() / steps);
    std::uint64_t at_levels = 0, at_beads = 0;
    for (const Json& count : row["by_bead"]) at_beads += count.get<std::uint64_t>();
    EXPECT_EQ(row["by_level"].is_null(), name != "wrapped");
    for (const Json& count : row["by_level"]) at_levels += count.get<std::uint64_t>();
    if (name == "wrapped") {
      EXPECT_EQ(at_levels, row["events"]);
    }
    if (name == "sorted" || name == "contacts") {
      EXPECT_EQ(at_beads, 2 * row["events"].get<std::uint64_t>());
    }
  }
  EXPECT_EQ(found, 4);
}

TEST(Compare, CountsAsSingleRunsAndTheirDumpsDo) {
  const ScratchDirectory scratch;
  const ProgramRun run = run_program({"compare", kDcd, "--topology", kPdb, "--frames", "100:140", "--radius",
                                      "1.9", "--structures", "sorted,wrapped,power,contacts", "--strides",
                                      "1,3", "--motions", "linear,hermite", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json rows = Json::parse(run.out)["rows"];
  EXPECT_EQ(rows.size(), 16U);
  for (const std::string motion : {"linear", "hermite"})
    for (const std::string stride : {"1", "3"}) expect_as_in_a_run(rows, stride, motion, scratch);
}

TEST(Compare, EventsOfVillinByStride) {
  const ProgramRun run = run_program(
      {"compare", kDcd, "--topology", kPdb, "--strides", "1,2,4,8,16,32", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  std::vector<int> wrapped, power;
  const Json rows = Json::parse(run.out)["rows"];
  for (const Json& row : rows) (row["structure"] == "wrapped" ? wrapped : power).push_back(row["events"]);
  EXPECT_THAT(wrapped, ElementsAre(8325, 4974, 3038, 1659, 881, 466));
  EXPECT_THAT(power, ElementsAre(43140, 25995, 17581, 10638, 6018, 3276));
}

TEST(Compare, SeveralInputsWithAPage) {
  const ScratchDirectory scratch;
  const std::string other = scratch.file("ends.xyz",
                                         "4\na\nC 0 0 0\nC 1 0 0\nC 2 1 0\nC 2 2 1\n"
                                         "4\nb\nC 0 0 0\nC 1 0 0\nC 2 -1 0\nC 1 -1 1\n"
                                         "4\nc\nC 0 0 0\nC 1 0 0\nC 2 1 0\nC 2 2 1\n");
  const ProgramRun run = run_program({"compare", kPdb, other, "--structures", "sorted"});
  EXPECT_EQ(run.code, 2);  // the PDB file has only one frame
  const ProgramRun both = run_program({"compare", kDcd, other, "--structures", "sorted,wrapped", "--strides",
                                       "1,2", "--frames", ":3", "--out", scratch / "out"});
  ASSERT_EQ(both.code, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("ends.xyz, linear motion"));
  const std::string csv = content_of(scratch / "out/compare.csv");
  EXPECT_THAT(csv, testing::StartsWith(
                       "structure,input,stride,motion,beads,steps,events,interchange,enter,leave,pivot,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 9);
  const Json json = Json::parse(content_of(scratch / "out/compare.json"));
  EXPECT_EQ(ReportData(scratch / "out/report.html").result, json);
  EXPECT_EQ(json["inputs"][1]["frames"], 3);
}

// An instance is one step. Boxes are compared like the other structures; layered spheres have no events.
TEST(Compare, TakesInstancesBoxesAndLayered) {
  const std::string instance = data_file("kinetic/d3_n20_linear.txt");
  const ProgramRun run = run_program({"compare", instance, "--structures", "wrapped,boxes,layered",
                                      "--directions", "7", "--rounds", "1", "--json", "-", "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json rows = Json::parse(run.out)["rows"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0]["structure"], "wrapped");
  EXPECT_EQ(rows[1]["structure"], "boxes");
  EXPECT_EQ(rows[2]["structure"], "layered");
  for (const Json& row : rows) EXPECT_EQ(row["steps"], 1);
  EXPECT_GT(rows[1]["events"], 0);
  EXPECT_GT(rows[1]["net_changes"], 0);
  EXPECT_LE(rows[1]["net_changes"], rows[1]["events"]);
  EXPECT_EQ(rows[2]["events"], 0);
  EXPECT_TRUE(rows[2]["net_changes"].is_null());
}

// Three beads on a line. Bead 1 overtakes both others in the first step and returns in the second. Each end
// of the box changes once in each step, which makes 4 events. When bead 1 overtakes bead 2, or falls behind
// it, the tournament of the high end changes inside, without a change of the end: 2 internal events.
TEST(Compare, MeasuresAsByHand) {
  const ScratchDirectory scratch;
  const std::string line = scratch.file("line.xyz",
                                        "3\na\nC 2 0 0\nC 0 0 0\nC 1 0 0\n"
                                        "3\nb\nC 2 0 0\nC 3 0 0\nC 1 0 0\n"
                                        "3\nc\nC 2 0 0\nC 0 0 0\nC 1 0 0\n");
  const ProgramRun run = run_program(
      {"compare", line, "--structures", "sorted,box", "--dt", "0.5", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["inputs"][0]["frame_picoseconds"], 0.5);
  EXPECT_TRUE(json["pooled"].empty());
  const Json &sorted = json["rows"][0], &box = json["rows"][1];
  EXPECT_EQ(sorted["events"], 4);
  EXPECT_EQ(sorted["efficiency"], 1);
  EXPECT_EQ(sorted["net_changes"], 6);  // three ranks change in each step
  EXPECT_EQ(sorted["events_per_net_change"].get<double>(), 4.0 / 6);
  EXPECT_EQ(sorted["events_per_step"], 2);
  EXPECT_EQ(sorted["events_per_step_lower"], nullptr);  // too few steps
  EXPECT_EQ(sorted["events_per_step_first"], 2);
  EXPECT_EQ(sorted["events_per_ps"], 4);
  EXPECT_EQ(sorted["events_per_bead_ps"].get<double>(), 4.0 / 3);
  EXPECT_EQ(sorted["compactness"], 2);  // consecutive beads
  EXPECT_EQ(sorted["locality"], 2);
  // At an interchange the certificate that failed is replaced, and so is the one other beside it.
  EXPECT_EQ(sorted["created_per_event"], 2);
  EXPECT_EQ(sorted["touched_per_event"], 4);
  EXPECT_EQ(sorted["touched_most"], 4);
  EXPECT_GT(sorted["responsiveness_worst"], 0);
  EXPECT_EQ(box["events"], 4);
  EXPECT_EQ(box["internal"], 2);
  EXPECT_EQ(box["efficiency"], 1.5);
  EXPECT_EQ(sorted["over_time"],
            (Json{{"steps", 1}, {"events", {2, 2}}, {"frames", {0, 1}}, {"picoseconds", {0, 0.5}}}));
}

TEST(Compare, InputsArePooledWithATopologyForEach) {
  const ScratchDirectory scratch;
  const std::string again = (scratch / "again.dcd").string(), names = (scratch / "names.pdb").string();
  std::filesystem::copy_file(kDcd, again);
  std::filesystem::copy_file(kPdb, names);
  const ProgramRun run =
      run_program({"compare", kDcd, again, "--topology", kPdb + "," + names, "--structures", "wrapped",
                   "--frames", ":60", "--rounds", "1", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  const Json &row = json["rows"][0], &pooled = json["pooled"][0];
  EXPECT_EQ(pooled["inputs"], 2);
  // Two equal inputs give a mean without an interval.
  EXPECT_DOUBLE_EQ(pooled["events_per_step"], row["events_per_step"]);
  EXPECT_EQ(pooled["events_per_step_lower"], nullptr);
  EXPECT_EQ(pooled["events_per_step_upper"], nullptr);
  EXPECT_DOUBLE_EQ(pooled["events_per_bead_step"].get<double>() * 108, row["events_per_step"]);
  EXPECT_LT(row["events_per_step_lower"], row["events_per_step"]);
  const ProgramRun bad = run_program({"compare", kDcd, "--topology", kPdb + "," + names});
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.err, HasSubstr("--topology: lists 2 files for 1 INPUT"));
  const ProgramRun missing = run_program({"compare", kDcd, again, "--topology", kPdb + ",nowhere.pdb"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("nowhere.pdb: no such file"));
}

TEST(Compare, IntervalsOfThreeInputsStayAboveZero) {
  const std::string other = data_file("trajectories/random100_400K");
  std::vector<std::string> arguments{"compare",
                                     kDcd,
                                     other + "_first200.dcd",
                                     "--structures",
                                     "wrapped,contacts",
                                     "--frames",
                                     ":60",
                                     "--rounds",
                                     "1",
                                     "--json",
                                     "-"};
  const Json of_two = Json::parse(run_program(arguments).out)["pooled"][0];
  EXPECT_EQ(of_two["events_per_step_lower"], nullptr);
  arguments.push_back(data_file("trajectories/dhodh363_1000K_first20.dcd"));
  arguments[6] = ":20";
  const Json of_three = Json::parse(run_program(arguments).out)["pooled"][0];
  EXPECT_GT(of_three["events_per_step_lower"], 0);
  EXPECT_LT(of_three["events_per_step_lower"], of_three["events_per_step"]);
  EXPECT_GT(of_three["events_per_step_upper"], of_three["events_per_step"]);
}

TEST(Compare, RatesOfASeriesHaveIntervals) {
  const Json json = Json::parse(run_program({"compare", kDcd, "--structures", "wrapped,contacts", "--frames",
                                             ":60", "--rounds", "1", "--json", "-"})
                                    .out);
  const Json &row = json["rows"][0], &contacts = json["rows"][1];  // no contact begins or ends
  EXPECT_EQ(contacts["events_per_step"], 0);
  EXPECT_EQ(contacts["events_per_step_upper"], nullptr);
  EXPECT_LT(row["events_per_net_change_lower"], row["events_per_net_change"]);
  EXPECT_GT(row["events_per_net_change_upper"], row["events_per_net_change"]);
}

// Files of one name in two folders, and two chains of one file: each input has its own curve and its own
// beads.
TEST(Compare, TellsInputsOfOneNameApart) {
  const ScratchDirectory scratch;
  std::string two;
  for (int model = 1; model <= 3; ++model) {
    two += fmt::format("MODEL     {:4}\n", model);
    int serial = 0;
    for (const auto& [chain, beads] : {std::pair('A', 6), std::pair('B', 4)}) {
      for (int k = 0; k < beads; ++k)
        two += fmt::format("ATOM  {:5}  CA  ALA {}{:4}    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00           C\n",
                           ++serial, chain, k + 1, 3.8 * k, (k * model) % 3 * 1.0,
                           chain == 'A' ? (k + model) % 2 * 1.0 : 40.0);
      two += "TER\n";
    }
    two += "ENDMDL\n";
  }
  const std::string file = scratch.file("two.pdb", two);
  const ProgramRun run = run_program({"compare", file, file, "--chain", "A/B", "--select", "ca",
                                      "--structures", "wrapped", "--rounds", "1", "--out", scratch / "out"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("two.pdb (chain A), linear motion (6 beads"));
  EXPECT_THAT(run.out, HasSubstr("two.pdb (chain B), linear motion (4 beads"));
  const Json rows = Json::parse(content_of(scratch / "out/compare.json"))["rows"];
  EXPECT_EQ(rows[0]["beads"], 6);
  EXPECT_EQ(rows[1]["beads"], 4);
  EXPECT_NE(rows[0]["input"], rows[1]["input"]);

  std::filesystem::create_directory(scratch / "other");
  const std::string copy = (scratch / "other/two.pdb").string();
  std::filesystem::copy_file(file, copy);
  const ProgramRun folders =
      run_program({"compare", file, copy, "--chain", "A", "--select", "ca", "--structures", "wrapped",
                   "--rounds", "1", "--out", scratch / "folders"});
  ASSERT_EQ(folders.code, 0) << folders.err;

  const ProgramRun twice = run_program({"compare", file, file, "--chain", "A", "--select", "ca"});
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("two.pdb (chain A) is listed twice"));
  const std::string spelt = (scratch / "other/../two.pdb").string();
  EXPECT_THAT(run_program({"compare", file, spelt}).err, HasSubstr("two.pdb is listed twice"));
}

}  // namespace
}  // namespace kds::test::compare_test
