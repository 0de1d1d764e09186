// Tests every option of `kds run` and every refusal.

#include "experiments/run/run_options.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/program/input_options.h"
#include "motions/base/input_error.h"

namespace kds::parse_run_options_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const Arguments& arguments) {
  try {
    static_cast<void>(parse_run_options(arguments));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RunOptions, DefaultsAreThoseOfTheContract) {
  const RunOptions options = parse_run_options({"chain.pdb"});
  EXPECT_THAT(options.inputs, ElementsAre("chain.pdb"));
  EXPECT_TRUE(options.structures.empty());
  EXPECT_EQ(options.motion, FrameMotion::linear);
  EXPECT_EQ(options.kernel, Kernel::filtered);
  EXPECT_EQ(options.radius, "auto");
  EXPECT_EQ(options.audit, AuditMode::none);
  EXPECT_EQ(options.reading.selection, Selection::automatic);
  EXPECT_FALSE(options.reading.topology || options.reading.chain || options.reading.frames.last);
  EXPECT_FALSE(options.dump || options.out || options.log || options.json || options.quiet);
}

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
  EXPECT_EQ(parse_run_options({"--kernel", "exact", "a"}).kernel, Kernel::exact);
  EXPECT_EQ(parse_run_options({"--kernel=filtered", "a"}).kernel, Kernel::filtered);
  EXPECT_EQ(parse_run_options({"a", "--audit", "none"}).audit, AuditMode::none);
  EXPECT_EQ(parse_run_options({"a", "--audit=frames"}).audit, AuditMode::frames);
  EXPECT_EQ(parse_run_options({"a", "--select", "backbone"}).reading.selection, Selection::backbone);
  EXPECT_EQ(parse_run_options({"a", "--select", "all"}).reading.selection, Selection::all);
  for (const char* name : {"ca", "CA", "Ca", "cA"})
    EXPECT_EQ(parse_run_options({"a", "--select", name}).reading.selection, Selection::ca);
  EXPECT_EQ(parse_run_options({"a", "--select", "BackBone"}).reading.selection, Selection::backbone);
  EXPECT_THAT(refusal({"a", "--select", "Automatic"}),
              HasSubstr("'Automatic' is not one of backbone, ca, bb, p, heavy, all"));
  for (const char* atoms : {"//A/10-40/CA,CB", "(ALA)/[!H];q>0.5", "-5--1"}) {
    const RunOptions options = parse_run_options({"a", "--select", atoms});
    EXPECT_EQ(options.reading.selection, Selection::atoms);
    EXPECT_EQ(options.reading.selection.text(), atoms);
  }
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
  const std::string needed = "--groups needs 2 values, SEL1 SEL2";
  for (const Arguments& given : {Arguments{"a", "--groups"},
                                 {"a", "--groups", "ca"},
                                 {"a", "--groups=ca"},
                                 {"a", "--groups", "ca", "--quiet"},
                                 {"a", "--groups", "", "ca"},
                                 {"a", "--groups", "ca", ""}})
    EXPECT_THAT(refusal(given), HasSubstr(needed));
  EXPECT_THAT(refusal({"a", "--groups", "ca", "--quiet"}), HasSubstr(needed + ", but '--quiet' follows"));
  EXPECT_THAT(refusal({"a", "--groups", "ca", "p", "--groups", "ca", "p"}),
              HasSubstr("--groups is given 2 times"));
  EXPECT_THAT(refusal({"--groups", "ca", "a.pdb"}), HasSubstr("--groups: 'a.pdb' is not one of backbone"));
  EXPECT_THAT(refusal({"a", "--groups", "ca", "//A/10-x"}),
              HasSubstr("--groups: '//A/10-x' has the residues '10-x'"));
}

TEST(RunOptions, RunsStructuresInOneOrder) {
  EXPECT_THAT(parse_run_options({"a", "--structures", "power,wrapped,sorted"}).structures,
              ElementsAre("sorted", "wrapped", "power"));
}

TEST(RunOptions, TakesOperandsAfterADoubleDash) {
  EXPECT_THAT(parse_run_options({"--", "--odd.pdb"}).inputs, ElementsAre("--odd.pdb"));
}

TEST(RunOptions, RefusesUnknownOptions) {
  EXPECT_THAT(refusal({"a", "--bogus"}), HasSubstr("unknown option '--bogus'"));
  EXPECT_THAT(refusal({"a", "-q"}), HasSubstr("unknown option '-q'"));
}

TEST(RunOptions, RefusesMissingInputs) {
  EXPECT_THAT(refusal({}), HasSubstr("INPUT"));
  EXPECT_THAT(refusal({"--quiet"}), HasSubstr("INPUT"));
  EXPECT_THAT(refusal({""}), HasSubstr("INPUT"));
}

TEST(RunOptions, RefusesWhatIsGivenTwice) {
  EXPECT_THAT(refusal({"a", "--kernel", "exact", "--kernel", "exact"}),
              HasSubstr("--kernel is given 2 times"));
  EXPECT_THAT(refusal({"a", "--quiet", "--quiet"}), HasSubstr("--quiet is given 2 times"));
}

TEST(RunOptions, RefusesOptionsWithoutAValue) {
  for (const char* option :
       {"--structures", "--motion", "--kernel", "--topology", "--select", "--chain", "--frames", "--radius",
        "--levels", "--nodes", "--audit", "--dump", "--log", "--out", "--json"}) {
    EXPECT_THAT(refusal({"a", option}), HasSubstr(std::string(option) + " needs a value"));
    EXPECT_THAT(refusal({"a", option, "--quiet"}), HasSubstr(std::string(option) + " needs a value"));
    EXPECT_THAT(refusal({"a", option, ""}), HasSubstr(option));
  }
  EXPECT_THAT(refusal({"a", "--quiet=yes"}), HasSubstr("--quiet takes no value"));
}

TEST(RunOptions, RefusesStructuresThatAreNotRegistered) {
  EXPECT_THAT(
      refusal({"a", "--structures", "power,heap"}),
      HasSubstr("'heap' is not one of sorted, box, hull, closest, wrapped, boxes, layered, power, contacts"));
  EXPECT_EQ(parse_run_options({"a", "--motion", "hermite"}).motion, FrameMotion::hermite);
  EXPECT_EQ(parse_run_options({"a", "--motion", "lifted"}).motion, FrameMotion::lifted);
}

TEST(RunOptions, RefusesUnknownNamesAndListsTheKnown) {
  EXPECT_THAT(refusal({"a", "--structures", "power,heap"}),
              HasSubstr("'heap' is not one of sorted, box, hull, closest, wrapped, boxes, layered, power"));
  EXPECT_THAT(refusal({"a", "--structures", "power,"}), HasSubstr("'' is not one of"));
  EXPECT_THAT(refusal({"a", "--structures", "power,power"}), HasSubstr("power is listed twice"));
  EXPECT_THAT(refusal({"a", "--motion", "cubic"}), HasSubstr("'cubic' is not one of linear, hermite"));
  EXPECT_THAT(refusal({"a", "--kernel", "Exact"}), HasSubstr("'Exact' is not one of filtered, exact"));
  EXPECT_THAT(refusal({"a", "--kernel", "fast"}), HasSubstr("'fast' is not one of filtered, exact"));
  EXPECT_THAT(refusal({"a", "--relax", "0.03"}), HasSubstr("unknown option '--relax'"));
  EXPECT_THAT(refusal({"a", "--audit", "{}"}), HasSubstr("'{}' is not one of none, frames, events"));
  EXPECT_THAT(
      refusal({"a", "--select", "cb"}),
      HasSubstr("'cb' is not one of backbone, ca, bb, p, heavy, all, nor an atom selection as in //A/"));
  for (const char* atoms : {"CB", "CB,OG", "SG", "O5'", "OXT", "MN", "1HB2"})
    EXPECT_THAT(refusal({"a", "--select", atoms}),
                HasSubstr(fmt::format("//*//{} chooses atoms by name", atoms)));
  for (const char* other : {"backbon", "protein", "name CA", "C*"})
    EXPECT_THAT(refusal({"a", "--select", other}), testing::Not(HasSubstr("by name")));
  EXPECT_THAT(refusal({"a", "--select", "//A/10-x"}),
              HasSubstr("--select: '//A/10-x' has the residues '10-x'"));
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
  for (const char* range : {"", "3", "3:3", "4:3", "-1:2", "0:4294967297", "a:b", "1:2:3", "1: 2"}) {
    EXPECT_THAT(refusal({"a", "--levels", range}), HasSubstr("--levels")) << range;
    EXPECT_THAT(refusal({"a", "--nodes", range}), HasSubstr("--nodes")) << range;
  }
}

TEST(RunOptions, RefusesRadiiThatAreNone) {
  for (const char* rule :
       {"0", "-1", "nan", "inf", "1e999", "1,5", "1.5A", "0x1p3", " 1", "elements", "file:", "Auto"})
    EXPECT_THAT(refusal({"a", "--radius", rule}), HasSubstr("--radius")) << rule;
}

TEST(RunOptions, RefusesFrameRangesThatAreNone) {
  for (const char* range : {"x", "1:2:0", "1:2:3:4", "-1:5", "1.5:3"})
    EXPECT_THAT(refusal({"a", "--frames", range}), HasSubstr("--frames")) << range;
}

TEST(RunOptions, KeepsTheDashForJson) {
  EXPECT_THAT(refusal({"a", "--log", "-"}), HasSubstr("--log"));
  EXPECT_THAT(refusal({"a", "--out", "-"}), HasSubstr("--out"));
}

TEST(RunOptions, HelpHasALineForEachOption) {
  for (const char* flag : {"--help", "-h"}) {
    try {
      static_cast<void>(parse_run_options({"a", flag}));
      FAIL() << "no help";
    } catch (const HelpRequest& help) {
      for (const char* option : {"--structures", "--motion", "--kernel", "--audit", "--dump", "--log",
                                 "--out", "--json", "--quiet"})
        EXPECT_THAT(help.text, HasSubstr(std::string("\n  ") + option)) << option;
      for (const char* option : {"--topology", "--select", "--chain", "--frames", "--radius"}) {
        EXPECT_THAT(help.text, HasSubstr(option));
        EXPECT_THAT(inputs_help(), HasSubstr(std::string("\n  ") + option)) << option;
      }
      EXPECT_THAT(help.text, HasSubstr("default: filtered"));
      EXPECT_THAT(help.text, HasSubstr("examples:"));
    }
  }
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
