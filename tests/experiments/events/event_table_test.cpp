// Tests `kds run --events`, and `kds info --beads`, which prints the residue of each bead.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::event_table_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

const std::string kDcd = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kPdb = data_file("trajectories/villin_hp36_300K.pdb");

std::vector<std::string> parts(const std::string& line, char separator) {
  std::vector<std::string> all;
  std::istringstream text(line);
  for (std::string part; std::getline(text, part, separator);) all.push_back(part);
  if (!line.empty() && line.back() == separator) all.emplace_back();
  return all;
}

std::vector<std::vector<std::string>> table_of(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : parts(content_of(path), '\n')) {
    if (!line.empty()) rows.push_back(parts(line, ','));
  }
  return rows;
}

// Returns the token of each bead as `kds info` prints it.
std::vector<std::string> tokens_of_beads() {
  const ProgramRun info =
      run_program({"info", kDcd, "--topology", kPdb, "--frames", "0:2", "--beads", "--json", "-"});
  EXPECT_EQ(info.code, 0) << info.err;
  std::vector<std::string> tokens;
  const Json rows = Json::parse(info.out)["rows"];
  for (const Json& row : rows) {
    EXPECT_EQ(row["bead"], tokens.size());
    tokens.push_back(row["chain"].get<std::string>() + ":" + row["residue"].get<std::string>() + ":" +
                     row["number"].get<std::string>() + ":" + row["atom"].get<std::string>());
  }
  return tokens;
}

// The log has the same events in its own format.
TEST(EventTable, HoldsTheEventsOfTheLogAndNamesTheirBeads) {
  const ScratchDirectory scratch;
  const ProgramRun run = run_program({"run", kDcd, "--topology", kPdb, "--frames", "10:40:2", "--structures",
                                      "wrapped,power,contacts", "--events", scratch / "events.csv", "--log",
                                      scratch / "log", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::vector<std::string> tokens = tokens_of_beads();
  ASSERT_EQ(tokens.size(), 108U);
  auto rows = table_of(scratch / "events.csv");
  const bool timed = rows[0].size() == 10;
  EXPECT_THAT(content_of(scratch / "events.csv"),
              StartsWith(timed ? "frame,lower,upper,picoseconds,structure,kind,external,node,beads,residues\n"
                               : "frame,lower,upper,structure,kind,external,node,beads,residues\n"));
  rows.erase(rows.begin());
  std::map<std::string, std::map<std::string, int>> kinds;
  std::size_t row = 0;
  for (const std::string& line : parts(content_of(scratch / "log"), '\n')) {
    const std::vector<std::string> logged = parts(line, ' ');
    if (logged.size() < 6 || logged[0].find_first_not_of("0123456789") != std::string::npos) continue;
    ASSERT_LT(row, rows.size());
    std::vector<std::string> event = rows[row++];
    if (timed) event.erase(event.begin() + 3);
    EXPECT_EQ(event[0], std::to_string(10 + 2 * std::stoi(logged[0])));
    EXPECT_EQ(event[1], logged[3]);
    EXPECT_EQ(event[2], logged[4]);
    EXPECT_EQ(event[3], logged[1]);
    EXPECT_EQ(event[4], logged[2]);
    std::size_t first = 5;
    if (logged[1] == "wrapped") {
      EXPECT_EQ(event[6], logged[5] + "-" + logged[6]);
      first = 7;
    } else {
      EXPECT_EQ(event[6], "");
    }
    std::string beads, residues;
    for (std::size_t i = first; i < logged.size(); ++i) {
      const bool infinite = logged[i] == "4294967295";
      const std::string space = i == first ? "" : " ";
      beads += space + (infinite ? "infinity" : logged[i]);
      residues += space + (infinite ? "-" : tokens.at(std::stoul(logged[i])));
    }
    EXPECT_EQ(event[7], beads);
    EXPECT_EQ(event[8], residues);
    ++kinds[event[3]][event[4]];
  }
  EXPECT_EQ(row, rows.size());
  EXPECT_GT(row, 800U);
  const Json structures = Json::parse(run.out)["structures"];
  for (const auto& [name, structure] : structures.items())
    for (const auto& [kind, count] : structure["events"].items())
      if (kind != "total") {
        EXPECT_EQ(kinds[name][kind], count) << name << " " << kind;
      }

  const ProgramRun replay =
      run_program({"replay", scratch / "log", "--events", scratch / "replayed.csv", "--quiet"});
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(content_of(scratch / "replayed.csv"), content_of(scratch / "events.csv"));
}

// The JSON lines have the same events as the table, and name the roles of the ids.
TEST(EventTable, IsOfJsonLinesWhereItsNameSaysSo) {
  const ScratchDirectory scratch;
  for (const char* name : {"events.csv", "events.JSONL"}) {
    const ProgramRun run =
        run_program({"run", kDcd, "--topology", kPdb, "--frames", "10:20:2", "--structures",
                     "wrapped,power,contacts", "--events", scratch / name, "--quiet"});
    ASSERT_EQ(run.code, 0) << run.err;
  }
  auto rows = table_of(scratch / "events.csv");
  const bool timed = rows[0].size() == 10;
  rows.erase(rows.begin());
  std::vector<std::string> lines = parts(content_of(scratch / "events.JSONL"), '\n');
  lines.pop_back();  // after the last newline
  ASSERT_EQ(lines.size(), rows.size());
  const std::map<std::string, std::vector<std::string>> roles{
      {"wrapped", {"node", "basis"}}, {"contacts", {"first", "second"}}, {"2-3", {"triangle", "edge"}},
      {"3-2", {"triangle", "edge"}},  {"4-1", {"cell", "bead"}},         {"1-4", {"cell", "bead"}},
      {"wander", {"bead", "cell"}}};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Json line = Json::parse(lines[r]);
    std::vector<std::string> row = rows[r];
    if (timed) {
      EXPECT_EQ(line["picoseconds"].get<double>(), std::stod(row[3]));
      row.erase(row.begin() + 3);
    }
    const double first = std::stod(row[0]), lower = std::stod(row[1]), upper = std::stod(row[2]);
    EXPECT_EQ(line["frame"], first);
    EXPECT_EQ(line["step"], (first - 10) / 2);
    EXPECT_NEAR(line["time"].get<double>(), first + lower + upper, 1e-7);  // the stride is 2 frames per step
    EXPECT_EQ(line["lower"], lower);
    EXPECT_EQ(line["upper"], upper);
    EXPECT_EQ(line["structure"], row[3]);
    EXPECT_EQ(line["kind"], row[4]);
    EXPECT_EQ(line["external"], row[5] == "1");
    std::vector<std::string> names;
    std::string beads, residues;
    for (const auto& [role, ids] : line["ids"].items()) {
      names.push_back(role);
      if (role == "node") {
        EXPECT_EQ(ids[0].dump() + "-" + ids[1].dump(), row[6]);
        continue;
      }
      for (const Json& id : ids)
        beads += (beads.empty() ? "" : " ") + (id.is_null() ? std::string("infinity") : id.dump());
    }
    EXPECT_EQ(names, roles.at(row[3] == "power" ? row[4] : row[3]));
    EXPECT_EQ(beads, row[7]);
    std::size_t residue = row[6].empty() ? 0 : 2;  // JSON also gives the residues of the node's ends
    for (; residue < line["residues"].size(); ++residue)
      residues += (residues.empty() ? "" : " ") + line["residues"][residue].get<std::string>();
    EXPECT_EQ(residues, row[8]);
  }
}

TEST(EventTable, SaysNothingOfResiduesWhereTheFileDoesNot) {
  const ScratchDirectory scratch;
  const std::string moving = scratch.file("moving.xyz", "2\na\nC 0 0 0\nC 9 1 2\n2\nb\nC 8 0 0\nC 1 1 2\n");
  const ProgramRun run = run_program({"run", moving, "--structures", "sorted", "--radius", "1", "--events",
                                      scratch / "events.csv", "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto rows = table_of(scratch / "events.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(std::vector<std::string>(rows[1].begin() + 1, rows[1].end()),
              ElementsAre("0.5625", "0.5625", "sorted", "interchange", "1", "", "0 1", "- -"));
}

// A blank chain name is an empty field of a residue and ' ' in texts.
TEST(EventTable, ChainsWithoutAName) {
  const ScratchDirectory scratch;
  std::string pdb = content_of(kPdb);
  for (std::size_t line = 0; line < pdb.size(); line = pdb.find('\n', line) + 1)
    if (pdb.compare(line, 4, "ATOM") == 0) pdb[line + 21] = ' ';
  const std::string blank = scratch.file("blank.pdb", pdb);
  const auto run = [&](const std::string& topology, const std::string& name) {
    const ProgramRun done =
        run_program({"run", kDcd, "--topology", topology, "--frames", ":9", "--structures",
                     "wrapped,contacts", "--radius", "1.9", "--apart", "4", "--events",
                     (scratch / (name + ".csv")).string(), "--out", (scratch / name).string(), "--quiet"});
    EXPECT_EQ(done.code, 0) << done.err;
  };
  run(kPdb, "named");
  run(blank, "blank");
  const auto named = table_of(scratch / "named.csv"), unnamed = table_of(scratch / "blank.csv");
  ASSERT_EQ(named.size(), unnamed.size());
  ASSERT_GT(named.size(), 5U);
  const auto column =
      static_cast<std::size_t>(std::find(named[0].begin(), named[0].end(), "residues") - named[0].begin());
  for (std::size_t row = 1; row < named.size(); ++row) {
    const std::vector<std::string> residues = parts(unnamed[row].at(column), ' ');
    std::string with_name;
    for (const std::string& residue : residues) {
      EXPECT_EQ(parts(residue, ':').size(), 4U) << residue;
      EXPECT_THAT(residue, StartsWith(":"));
      with_name += (with_name.empty() ? "A" : " A") + residue;
    }
    EXPECT_EQ(with_name, named[row].at(column));
  }
  EXPECT_THAT(content_of(scratch / "blank/contacts.csv"), HasSubstr(" in chain ' '"));
  const ProgramRun info =
      run_program({"info", kDcd, "--topology", blank, "--frames", ":2", "--beads", "--json", "-"});
  ASSERT_EQ(info.code, 0) << info.err;
  EXPECT_TRUE(Json::parse(info.out)["rows"][0]["chain"].is_null());
}

TEST(EventTable, IsRefusedWhereItWouldReplaceSomethingElse) {
  const ScratchDirectory scratch;
  const std::string moving = scratch.file("moving.xyz", "2\na\nC 0 0 0\nC 9 1 2\n2\nb\nC 8 0 0\nC 1 1 2\n");
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"run", moving, "--structures", "sorted", "--radius", "1", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 2);
    return run.err;
  };
  EXPECT_THAT(refused({"--events", moving}), HasSubstr("is the file of an input"));
  EXPECT_THAT(refused({"--events", scratch / "a", "--json", scratch / "a"}), HasSubstr("is the file of"));
  EXPECT_THAT(refused({"--events", scratch / "out/events.csv", "--out", scratch / "out"}),
              HasSubstr("lies in the directory of --out"));
  EXPECT_THAT(refused({"--events", scratch / "nowhere/a"}), HasSubstr("--events"));
  EXPECT_THAT(refused({"--events", "-"}), HasSubstr("--events"));
  const ProgramRun chords =
      run_program({"run", kDcd, "--structures", "wrapped", "--between", "chord", "--events", scratch / "a"});
  EXPECT_EQ(chords.code, 2);
  EXPECT_THAT(chords.err, HasSubstr("--events: wrapped has chord cages, which have no events"));
  EXPECT_EQ(scratch.entries(), 1U);
}

TEST(InfoBeads, IsATableOfItsOwn) {
  const ScratchDirectory scratch;
  const ProgramRun run = run_program({"info", kPdb, "--radius", "1.5", "--beads", "--out", scratch / "out"});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto rows = table_of(scratch / "out/info.csv");
  ASSERT_EQ(rows.size(), 109U);
  EXPECT_THAT(rows[0], ElementsAre("bead", "necklace", "chain", "residue", "number", "atom", "radius"));
  EXPECT_THAT(rows[42], ElementsAre("41", "0", "A", "THR", "54", "C", "1.5"));
  EXPECT_THAT(run.out, HasSubstr("THR"));
  const std::string file = scratch.file("one.xyz", "2\na\nC 0 0 0\nC 1 1 2\n");
  const ProgramRun unnamed = run_program({"info", file, "--radius", "1", "--beads", "--json", "-"});
  ASSERT_EQ(unnamed.code, 0) << unnamed.err;
  EXPECT_EQ(Json::parse(unnamed.out)["rows"][1]["residue"], nullptr);
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"info", kPdb, "--beads", "--rho", "2"},
                                              {"info", data_file("kinetic/d3_n20_linear.txt"), "--beads"}}) {
    const ProgramRun refused = run_program(bad);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--beads"));
  }
}

}  // namespace
}  // namespace kds::test::event_table_test
