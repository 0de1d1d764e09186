// Tests the values of every option of `kds run`. tests/golden/run.txt has the refusals and the defaults.

#include "experiments/run/run_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace kds::parse_run_options_test {
namespace {

using testing::ElementsAre;

TEST(RunOptions, TakesEveryOption) {
  const RunOptions options = parse_run_options(
      {"a.dcd",      "--structures", "power,sorted", "--motion", "linear",  "--kernel", "exact",
       "--topology", "top.pdb",      "--select",     "ca",       "--chain", "B",        "--frames",
       "3:9:2",      "--radius",     "1.25",         "--audit",  "events",  "--dump",   "dumps",
       "--log",      "e.log",        "--out",        "report",   "--json",  "-",        "--quiet",
       "b.dcd"});
  EXPECT_THAT(options.inputs, ElementsAre("a.dcd", "b.dcd"));
  EXPECT_THAT(options.structures, ElementsAre("sorted", "power"));
  EXPECT_EQ(options.kernel, Kernel::exact);
  EXPECT_EQ(options.reading.topology, "top.pdb");
  EXPECT_EQ(options.reading.selection, Selection::ca);
  EXPECT_EQ(options.reading.chain, "B");
  EXPECT_EQ(options.reading.frames.first, 3U);
  EXPECT_EQ(options.reading.frames.last, 9U);
  EXPECT_EQ(options.reading.frames.stride, 2U);
  EXPECT_EQ(options.radius, "1.25");
  EXPECT_EQ(options.audit, AuditMode::events);
  EXPECT_EQ(options.dump, "dumps");
  EXPECT_EQ(options.log, "e.log");
  EXPECT_EQ(options.out, "report");
  EXPECT_EQ(options.json, "-");
  EXPECT_TRUE(options.quiet);
}

TEST(RunOptions, TakesEveryNamedValue) {
  for (const auto& [name, motion] :
       {std::pair("hermite", FrameMotion::hermite), {"lifted", FrameMotion::lifted}})
    EXPECT_EQ(parse_run_options({"a", "--motion", name}).motion, motion);
  EXPECT_EQ(parse_run_options({"--kernel=filtered", "a"}).kernel, Kernel::filtered);
  EXPECT_EQ(parse_run_options({"a", "--audit=frames"}).audit, AuditMode::frames);
  EXPECT_EQ(parse_run_options({"a", "--select", "backbone"}).reading.selection, Selection::backbone);
  EXPECT_EQ(parse_run_options({"a", "--select", "all"}).reading.selection, Selection::all);
  for (const char* name : {"ca", "CA", "Ca", "cA"})
    EXPECT_EQ(parse_run_options({"a", "--select", name}).reading.selection, Selection::ca);
  EXPECT_EQ(parse_run_options({"a", "--select", "BackBone"}).reading.selection, Selection::backbone);
  for (const char* rule : {"auto", "element", "element:fit", "file:radii.txt", "2", "1e-3"})
    EXPECT_EQ(parse_run_options({"a", "--radius", rule}).radius, rule);
}

TEST(RunOptions, GroupsAreTwoSelections) {
  EXPECT_TRUE(parse_run_options({"a"}).reading.groups.empty());
  for (const Arguments& given : {Arguments{"a", "--groups", "CA", "-5--1", "b"},
                                 {"--groups", "ca", "-5--1", "a", "b"},
                                 {"a", "--groups=ca", "-5--1", "--quiet", "b"}}) {
    const RunOptions options = parse_run_options(given);
    EXPECT_THAT(options.inputs, ElementsAre("a", "b"));
    ASSERT_EQ(options.reading.groups.size(), 2U);
    EXPECT_EQ(options.reading.groups[0], Selection::ca);
    EXPECT_EQ(options.reading.groups[1].text(), "-5--1");
  }
}

TEST(RunOptions, TakesOperandsAfterADoubleDash) {
  EXPECT_THAT(parse_run_options({"--", "--odd.pdb"}).inputs, ElementsAre("--odd.pdb"));
}

TEST(RunOptions, NodesOfTheHierarchy) {
  EXPECT_FALSE(parse_run_options({"a"}).nodes.restricts());
  const NodeSelection levels = parse_run_options({"a", "--levels", "1:3"}).nodes;
  EXPECT_EQ(levels.first_level, 1U);
  EXPECT_EQ(levels.last_level, 2U);
  EXPECT_FALSE(levels.beads);
  EXPECT_TRUE(parse_run_options({"a", "--levels", "2:"}).nodes.restricts());
  EXPECT_FALSE(parse_run_options({"a", "--levels", ":"}).nodes.restricts());
  const NodeSelection nodes = parse_run_options({"a", "--nodes", "10:20"}).nodes;
  EXPECT_TRUE(nodes.beads == (BeadRange{10, 19}));
}

// The arguments that repeat a run are read again as the same options, also those of ranges without an end.
TEST(RunOptions, RepeatingArgumentsAreReadAgain) {
  for (const Arguments& arguments :
       {Arguments{"/a.pdb", "--nodes", "3:"},
        {"/a.pdb", "--nodes", ":"},
        {"/a.pdb", "--nodes", "3:9"},
        {"/a.pdb", "--levels", "2:"},
        {"/a.pdb", "--levels", ":4", "--tolerance", "0.2r"},
        {"/a.pdb", "--between", "chord", "--certify", "--frames", "::3", "--chain", "A", "--select", "ca"},
        {"/a.pdb", "--select", "//A/-5-40/CA,CB;q>0.5"},
        {"/a.pdb", "--select", "-5--1"},
        {"/a.pdb", "--groups", "ca", "//A/-5-40/CA,CB;q>0.5", "--apart", "4"}}) {
    const Arguments again = repeating_arguments(parse_run_options(arguments));
    EXPECT_EQ(repeating_arguments(parse_run_options(again)), again);
    const auto nodes = [](const Arguments& a) { return parse_run_options(a).nodes; };
    EXPECT_EQ(nodes(again).first_level, nodes(arguments).first_level);
    EXPECT_EQ(nodes(again).last_level, nodes(arguments).last_level);
    EXPECT_EQ(parse_run_options(again).reading.groups, parse_run_options(arguments).reading.groups);
    ASSERT_EQ(nodes(again).beads.has_value(), nodes(arguments).beads.has_value());
    if (nodes(again).beads) {
      EXPECT_EQ(nodes(again).beads->last, nodes(arguments).beads->last);
    }
  }
}

}  // namespace
}  // namespace kds::parse_run_options_test
