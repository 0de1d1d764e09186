// Applying the events of `wrapped` one by one to the dump of frame 0 gives the dumps of all other frames,
// including degenerate frames.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/inputs/random.h"
#include "tests/support/rounds.h"

namespace kds::test::dump_replay_test {
namespace {

using Bases = std::map<std::string, std::string>;  // by node, FIRST-LAST
using Frame = std::vector<std::array<double, 3>>;

std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(content_of(path));
  for (std::string line; std::getline(text, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  if (!rows.empty()) rows.erase(rows.begin());  // the header
  return rows;
}

Bases dumped(const ScratchDirectory& scratch, std::size_t frame) {
  Bases bases;
  for (const auto& row : rows_of(scratch / ("dump/frame-" + std::to_string(frame) + ".wrapped.csv")))
    bases[row[0] + "-" + row[1]] = row[2];
  return bases;
}

std::set<std::string> beads_of(const std::string& basis) {
  std::istringstream text(basis);
  return {std::istream_iterator<std::string>(text), {}};
}

std::string kind_of_change(const std::string& before, const std::string& after) {
  const auto from = beads_of(before), to = beads_of(after);
  const bool entered = !std::includes(from.begin(), from.end(), to.begin(), to.end());
  const bool left = !std::includes(to.begin(), to.end(), from.begin(), from.end());
  return entered && left ? "pivot" : entered ? "enter" : left ? "leave" : "none";
}

void expect_replay(const ScratchDirectory& scratch, std::vector<std::string> arguments, std::size_t frames,
                   const std::string& what) {
  const std::vector<std::string> outputs{
      "--structures", "wrapped",        "--events",  scratch / "events.csv",
      "--dump",       scratch / "dump", "--replace", "--quiet"};
  arguments.insert(arguments.begin(), "run");
  arguments.insert(arguments.end(), outputs.begin(), outputs.end());
  const ProgramRun run = run_program(arguments);
  ASSERT_EQ(run.code, 0) << what << run.err;
  const auto events = rows_of(scratch / "events.csv");
  Bases bases = dumped(scratch, 0);
  auto event = events.begin();
  for (std::size_t step = 0; step + 1 < frames; ++step) {
    for (; event != events.end() && (*event)[0] == std::to_string(step); ++event) {
      std::string& basis = bases.at((*event)[6]);
      EXPECT_EQ((*event)[4], kind_of_change(basis, (*event)[7])) << what;
      basis = (*event)[7];
    }
    EXPECT_EQ(bases, dumped(scratch, step + 1)) << what << ", frame " << step + 1;
  }
  EXPECT_EQ(event, events.end()) << what;
}

Frame frame_of(Random& random, std::size_t beads, const std::string& kind) {
  Frame frame(beads);
  for (auto& p : frame) {
    if (kind == "general") p = {uniform(random, -3, 3), uniform(random, -3, 3), uniform(random, -3, 3)};
    if (kind == "grid")
      for (double& x : p) x = pick(random, -2, 2);
    if (kind == "collinear") p = {static_cast<double>(pick(random, -4, 4)), 0, 0};
    if (kind == "coplanar")
      p = {static_cast<double>(pick(random, -2, 2)), static_cast<double>(pick(random, -2, 2)), 0};
    if (kind == "coincident")
      for (double& x : p) x = pick(random, 0, 3) == 0 ? 1 : 0;
  }
  return frame;
}

TEST(DumpReplay, GivesTheDumpsOfAllFramesWhereTheFirstIsDegenerate) {
  const ScratchDirectory scratch;
  const std::vector<std::string> kinds{"general", "grid", "collinear", "coplanar", "coincident"};
  Random random(34);
  for (int round = 0; round < rounds(60, 10); ++round) {
    const auto beads = static_cast<std::size_t>(pick(random, 2, 13));
    const auto frames = static_cast<std::size_t>(pick(random, 2, 4));
    std::string text, radii, what = std::to_string(round);
    for (std::size_t k = 0; k < frames; ++k) {
      const std::string& kind =
          kinds[static_cast<std::size_t>(k == 0 ? pick(random, 1, 4) : pick(random, 0, 4))];
      what += " " + kind;
      text += std::to_string(beads) + "\n\n";
      for (const auto& p : frame_of(random, beads, kind))
        text += "C " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    }
    for (std::size_t b = 0; b < beads; ++b) radii += pick(random, 0, 1) == 0 ? "1\n" : "1.5\n";
    const std::string input = scratch.file("beads.xyz", text);
    expect_replay(scratch, {input, "--radius", "1"}, frames, what);
    expect_replay(scratch, {input, "--radius", "file:" + scratch.file("radii", radii)}, frames,
                  what + ", radii");
  }
}

TEST(DumpReplay, GivesTheDumpsOfDegenerateInstances) {
  const ScratchDirectory scratch;
  for (const char* dimension : {"d2", "d3"})
    for (const char* kind :
         {"converge", "gridint", "gridrand", "gridrigid", "gridscale", "half", "rigid", "static", "swap"}) {
      const std::string name = std::string("kinetic/degenerate_") + dimension + "_n64_" + kind + ".txt";
      expect_replay(scratch, {data_file(name)}, 2, name);
    }
}

}  // namespace
}  // namespace kds::test::dump_replay_test
