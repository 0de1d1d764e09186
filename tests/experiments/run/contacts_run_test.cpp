// Tests `kds run --structures contacts` as a process: its files and its options.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/csv_cells.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::contacts_run_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::istringstream text(content_of(path));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::string frames_at(const std::vector<std::string>& beads, const std::vector<double>& x) {
  std::string frames;
  for (const double shift : x) {
    frames += std::to_string(beads.size()) + "\nframe\n";
    for (const std::string& bead : beads) frames += "C " + std::to_string(shift) + " " + bead + "\n";
  }
  return frames;
}

// Some balls meet an obstacle at rest and leave; one only touches it, at a frame.
TEST(ContactsRun, ANecklaceAndAnObstacleAtRest) {
  const ScratchDirectory scratch;
  scratch.file("moving.xyz", frames_at({"0 0", "8 0", "16 3"}, {-4, 0, 4}));
  scratch.file("rest.xyz", frames_at({"0 0", "8 1.5", "8 2"}, {0}));
  const Json contacts = run_json(
      "run OUT/moving.xyz OUT/rest.xyz --structures contacts --radius 1 --audit events --dump OUT/dump "
      "--log OUT/log",
      scratch.path())["structures"]["contacts"];
  EXPECT_EQ(contacts["events"]["total"], 5);
  EXPECT_EQ(contacts["events"]["begin"], 2);
  EXPECT_EQ(contacts["events"]["end"], 2);
  EXPECT_EQ(contacts["events"]["touch"], 1);
  EXPECT_EQ(contacts["audits"]["failed"], 0);
  const std::vector<std::string> lines = lines_of(scratch / "dump/contacts.csv");
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines[0], "step,lower,upper,i,j,event");
  EXPECT_EQ(lines[1], "0,0.5,0.5,0,3,begin");
  EXPECT_THAT(lines[2], testing::AllOf(testing::StartsWith("0,0.66"), testing::EndsWith(",1,4,begin")));
  EXPECT_EQ(lines[3], "1,0,0,1,5,touch");
  EXPECT_THAT(lines[4], testing::AllOf(testing::StartsWith("1,0.33"), testing::EndsWith(",1,4,end")));
  run_line("replay OUT/log --quiet", scratch.path());
}

TEST(ContactsRun, NamesFramesAndTimes) {
  const ScratchDirectory scratch;
  run_line(
      "run VILLIN --frames 0:20 --structures contacts --radius 1.9 --apart 5 --out OUT/out --dump OUT/dump "
      "--quiet",
      scratch.path());
  const auto named = lines_of(scratch / "out/contacts.csv"), dumped = lines_of(scratch / "dump/contacts.csv");
  EXPECT_THAT(named[0], testing::StartsWith("event,i,j,first,second,frame"));
  EXPECT_EQ(named[1].substr(0, 68), "begin,41,48,C of THR 54 in chain A,N of ALA 57 in chain A,0");
  ASSERT_EQ(named.size(), dumped.size());
  EXPECT_GT(named.size(), 20U);
  EXPECT_EQ(dumped[1], "0,0,0,41,48,begin");
  // A run of other structures replaces the result.
  run_line("run VILLIN --frames 0:3 --structures sorted --out OUT/out --dump OUT/dump --replace --quiet",
           scratch.path());
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/contacts.csv"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "dump/contacts.csv"));
}

TEST(ContactsRun, StartAndEndAreCounted) {
  for (const std::string frames : {"0:20", "7:9"}) {
    const Json contacts = run_json("run VILLIN --structures contacts --radius 1.9 --frames " +
                                   frames)["structures"]["contacts"];
    const int start = contacts["contacts"]["at_start"], end = contacts["contacts"]["at_end"];
    EXPECT_GT(start, 0);
    EXPECT_EQ(contacts["events"]["begin"].get<int>() + start - contacts["events"]["end"].get<int>(), end);
  }
}

/// Returns step, beads and kind of each event of a dump. Brackets of times may be narrowed by other events.
std::vector<std::string> events_of_dump(const std::filesystem::path& csv) {
  std::vector<std::string> events;
  for (const auto& cells : csv_cells(csv))
    events.push_back(cells[0] + " " + cells[3] + " " + cells[4] + " " + cells[5]);
  return events;
}

// The beads are N, CA, C of the residues 41 to 76.
// An obstacle at rest has the same beads, which belong to the same groups.
TEST(ContactsRun, GroupsLeaveTheContactsOfTheirPairs) {
  for (const bool with_obstacle : {false, true}) {
    SCOPED_TRACE(with_obstacle);
    const ScratchDirectory scratch;
    const auto run = [&](const std::string& name, const std::string& more) {
      const Json done =
          run_json("run VILLIN --frames 0:12 --radius 1.9 --apart 4 --audit events --structures contacts" +
                       more + (with_obstacle ? " --obstacle data/trajectories/villin_hp36_300K.pdb" : "") +
                       " --dump OUT/" + name + " --log OUT/" + name + ".log",
                   scratch.path());
      run_line("replay --quiet OUT/" + name + ".log", scratch.path());
      return done;
    };
    const Json all = run("all", ""), some = run("some", " --groups //A/-60 45-/N");
    EXPECT_EQ(some["settings"]["groups"], "//A/-60 45-/N");
    EXPECT_EQ(all["settings"]["groups"], "");
    EXPECT_NE(all["fingerprint"], some["fingerprint"]);
    const auto number = [](int bead) { return 41 + bead % 108 / 3; };
    const auto first = [&](int bead) { return number(bead) <= 60; };
    const auto second = [&](int bead) { return bead % 3 == 0 && number(bead) >= 45; };
    std::vector<std::string> expected = events_of_dump(scratch / "all/contacts.csv");
    std::erase_if(expected, [&](const std::string& event) {
      int step = 0, i = 0, j = 0;
      std::istringstream(event) >> step >> i >> j;
      return !(first(i) && second(j)) && !(first(j) && second(i));
    });
    EXPECT_GT(expected.size(), 3U);
    EXPECT_EQ(events_of_dump(scratch / "some/contacts.csv"), expected);
    EXPECT_LT(some["structures"]["contacts"]["contacts"]["at_start"],
              all["structures"]["contacts"]["contacts"]["at_start"]);
    EXPECT_EQ(run("both", " --groups all all")["fingerprint"], all["fingerprint"]);
  }
}

// Each pair of beads is within one of two groups or between them.
TEST(ContactsRun, ContactsMissedOfGroups) {
  const auto contacts = [](const std::string& groups) {
    return run_json("missed VILLIN --frames 0:9 --factors 2.5 --apart 5 " + groups)["rows"][0]["contacts"]
        .get<int>();
  };
  const int at_start = contacts("--groups -55 -55"), between = contacts("--groups -55 56-"),
            at_end = contacts("--groups 56- 56-");
  EXPECT_GT(std::min({at_start, between, at_end}), 0);
  EXPECT_EQ(at_start + between + at_end, contacts(""));
}

TEST(ContactsRun, CertifiesGroups) {
  const ScratchDirectory scratch;
  run_line(
      "run VILLIN --frames 0:21:4 --radius 1.9 --apart 4 --structures contacts --certify --groups //A/-60 "
      "45-/N "
      "--out OUT/out --quiet",
      scratch.path());
  const std::vector<std::string> lines = lines_of(scratch / "out/possible_contacts.csv");
  EXPECT_GT(lines.size(), 3U);
  for (const std::string& line : lines)
    EXPECT_THAT(line, testing::AnyOf(HasSubstr(",N of"), HasSubstr("first")));
}

TEST(ContactsRun, PairsNearAlongTheChain) {
  const auto total = [](const std::string& apart) {
    const Json summary = run_json("run VILLIN --frames 0:6 --radius 2 --structures contacts" +
                                  (apart.empty() ? "" : " --apart " + apart));
    EXPECT_EQ(summary["settings"]["apart"], apart);
    return summary["structures"]["contacts"]["events"]["total"].get<int>();
  };
  EXPECT_EQ(total(""), total("2"));
  EXPECT_GT(total(""), total("5"));
  EXPECT_GT(total("5"), total("30"));
}

// The distributions in summary.json are compared with sums over events.csv.
TEST(ContactsRun, DistributionsAgreeWithTheEvents) {
  const ScratchDirectory directory;
  const std::string out = directory / "out";
  run_line(
      "run VILLIN --frames 10:60 --structures power,contacts --apart 5 --radius 2.8 --out OUT/out --quiet",
      directory.path());
  std::map<std::string, std::vector<int>> events;  // by step
  for (const auto& row : csv_cells(directory / "out/events.csv")) events[row[1]].push_back(std::stoi(row[2]));
  const Json summary = Json::parse(content_of(out + "/summary.json"));
  EXPECT_EQ(ReportData(out + "/report.html").result, summary);
  for (const char* name : {"power", "contacts"}) {
    const Json& structure = summary["structures"][name];
    EXPECT_EQ(structure["over_time"]["steps"], 1);
    EXPECT_EQ(structure["over_time"]["events"], Json(events[name])) << name;
  }
  EXPECT_EQ(summary["structures"]["power"]["internal"], Json::array({"wander"}));
  EXPECT_TRUE(summary["structures"]["contacts"]["internal"].empty());
  int named = 0;
  for (const Json& count : summary["structures"]["contacts"]["by_bead"]) named += count.get<int>();
  EXPECT_GT(named, 0);
  EXPECT_EQ(named, 2 * summary["structures"]["contacts"]["events"]["total"].get<int>());
}

// A cutoff of 3.8 between centres finds what balls of radius 1.9 find. The wrapped hierarchy keeps its radii.
TEST(ContactsRun, ACutoffIsADistanceOfItsOwn) {
  const ScratchDirectory scratch;
  const auto run_of = [&](const std::string& options) {
    return run_json("run VILLIN --frames 0:12 --apart 5 --structures contacts,wrapped " + options,
                    scratch.path());
  };
  const auto events_of = [](const Json& run, const char* name) { return run["structures"][name]["events"]; };
  const Json balls = run_of("--radius 1.9"), plain = run_of("--radius 1");
  for (const std::string kernel : {"filtered", "exact"}) {
    const Json cutoff = run_of("--radius 1 --cutoff 3.8 --audit frames --kernel " + kernel);
    EXPECT_EQ(events_of(cutoff, "contacts"), events_of(balls, "contacts")) << kernel;
    EXPECT_EQ(events_of(cutoff, "wrapped"), events_of(plain, "wrapped")) << kernel;
    EXPECT_EQ(cutoff["structures"]["contacts"]["audits"]["failed"], 0);
  }
  EXPECT_GT(events_of(balls, "contacts")["total"], 10);
  const Json surface = run_of("--radius 1 --cutoff 1.75 --surface --log OUT/log");
  EXPECT_EQ(events_of(surface, "contacts"), events_of(run_of("--radius 1.875"), "contacts"));
  EXPECT_EQ(surface["settings"]["cutoff"], "1.75");
  const Json replay = run_json("replay OUT/log", scratch.path());
  EXPECT_EQ(replay["replay"]["same"], true);
  EXPECT_EQ(replay["fingerprint"], surface["fingerprint"]);
}

TEST(ContactsRun, CertifiesACutoff) {
  const auto counts = [](const std::string& options) {
    return run_json("run VILLIN --frames 0:33:4 --apart 5 --structures contacts --certify " +
                    options)["stride"]["contacts"];
  };
  const Json balls = counts("--radius 4");
  EXPECT_EQ(counts("--radius 1 --cutoff 8"), balls);
  EXPECT_GT(balls["sure"], 0);
  EXPECT_LT(balls["sure"], balls["possible"]);
}

// The pairs before and after the event share bead 1.
TEST(EventsByBead, CountAnEventOnceForEachBead) {
  const ScratchDirectory scratch;
  const std::string path =
      scratch.file("line.xyz", "3\n\nC 0 0 0\nC 1 0 0\nC 3 0 0\n3\n\nC 0 0 0\nC 2 0 0\nC 3 0 0\n");
  const ProgramRun run = run_program({"run", path, "--structures", "closest", "--json", "-"});
  const Json closest = Json::parse(run.out)["structures"]["closest"];
  EXPECT_EQ(closest["events"]["replace"], 1);
  EXPECT_EQ(closest["by_bead"], (Json{1, 1, 1}));
}

}  // namespace
}  // namespace kds::test::contacts_run_test
