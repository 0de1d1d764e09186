// Tests how sweep.json is read: its tasks, their names, and the messages for mistakes.

#include "experiments/sweep/sweep_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "experiments/program/commands.h"
#include "experiments/sweep/sweep_plan.h"
#include "motions/base/input_error.h"
#include "tests/experiments/expect_refused.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::sweep_spec_test {
namespace {

using testing::HasSubstr;

SweepSpec spec_of(const std::string& text, const std::filesystem::path& folder = "/nowhere") {
  InputFiles files;
  return read_sweep(read_json(text, "s.json"), folder, files, "s.json");
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(spec_of(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

SweepPlan plan_of(const std::string& text, const std::filesystem::path& folder) {
  InputFiles files;
  return {spec_of(text, folder), files, "s.json"};
}

TEST(SweepSpec, RefusesMistakesWithTheKeyAndTheNearestName) {
  const auto command = [](const std::string& inside) {
    return R"({"inputs": ["a.pdb"], "commands": [{"command": "run", )" + inside + "}]}";
  };
  const std::vector<std::pair<std::string, std::vector<std::string>>> mistakes{
      {"{\n\"inputs\": [,]}", {"s.json: is not JSON at line 2, column 12"}},
      {R"({"inputs": [], "inputs": []})", {"key 'inputs' stands twice"}},
      {R"({"input": []})", {"unknown key 'input'", "did you mean inputs?"}},
      {R"({"inputs": ["a.pdb"]})", {"needs the key 'commands'"}},
      {R"({"commands": [{"command": "rnu"}]})", {"commands[0]", "'rnu'", "did you mean run?"}},
      {R"({"commands": [{"command": "sweep"}]})", {"'sweep' is no command that can be swept"}},
      {R"({"commands": ["run"]})", {"kds run needs inputs"}},
      {command(R"("options": {"structure": "power"})"),
       {"has no option --structure", "did you mean structures?"}},
      {command(R"("options": {"out": "here"})"), {"sets --out of its tasks itself"}},
      {command(R"("options": {"certify": 1})"), {"--certify takes no value; expected true or false"}},
      {command(R"("options": {"motion": []})"), {"motion: has no value"}},
      {command(R"("options": {"motion": ["linear", "linear"]})"), {"'linear' is listed twice"}},
      {command(R"("options": {"radius": [2, 2.0]})"), {"radius: values '2' and '2.0' are the same setting"}},
      {command(R"("options": {"radius": [2, "2.0"]})"),
       {"values '2' and '2.0' are the same setting; expected it once"}},
      {command(R"("options": {"cutoff": [null, "10", 1e1]})"),
       {"cutoff: values '10' and '10.0' are the same"}},
      {command(R"("options": {"structures": ["power,wrapped", "wrapped,power"]})"), {"are the same setting"}},
      {command(R"("options": {"stride": 0})"), {"'0' is not a whole number from 1"}},
      {command(R"("options": {"stride": 2, "frames": "0:9:2"})"), {"expected FIRST:LAST beside"}},
      {command(R"("options": {"groups": ["A"]})"), {"--groups takes 2 values"}},
      {command(R"("options": {"motion": "--json"})"), {"--motion cannot take '--json'"}},
      {command(R"("segment_steps": 5)"),
       {"commands[0]: segment_steps is no longer supported; expected one task", "the option threads"}},
      {R"({"inputs": ["no*.pdb"], "commands": ["run"]})", {"s.json: inputs[0]: no file matches 'no*.pdb'"}},
      {R"({"seeds": 1000000000, "commands": ["stability"]})", {"seeds: '1000000000' is not", "1 to 1000000"}},
      {R"({"inputs": ["**/a.pdb"], "commands": ["run"]})", {"** is not supported"}},
      {R"({"inputs": [{"topology": "t.pdb"}], "commands": ["run"]})", {"needs the key 'file'"}},
      {R"({"inputs": [{"file": "a.pdb", "radius": 1}], "commands": [{"command": "run", "options": {"radius": 2}}]})",
       {"'a.pdb' sets --radius too"}},
      {R"({"inputs": [{"file": "a.pdb", "radius": 1, "--radius": 2}], "commands": ["run"]})",
       {"inputs[0]: option radius is listed twice"}},
      {R"({"inputs": ["a\u0000b"], "commands": ["run"]})", {"inputs[0]: has a zero byte"}},
      {command(R"("options": {"chain": "A\u0000--json"})"), {"chain: has a zero byte"}},
      {command(R"("options": {"dt": 1e999})"), {"s.json: number '1e999' is too large"}},
      {R"({"inputs": [{"file": ["a.pdb", ""]}], "commands": ["run"]})", {"inputs[0]: expected a path"}},
      {R"({"inputs": ["a.pdb"], "commands": ["run"], "seeds": 3})",
       {"no command of this sweep has the option --seed"}},
      {R"({"inputs": ["a.pdb"], "commands": ["run"], "exclude": [{"motions": "x"}]})",
       {"'motions' is no axis"}},
      {R"({"inputs": ["a.pdb"], "commands": ["run"], "pool": ["inputs"]})", {"did you mean input?"}},
  };
  for (const auto& [text, words] : mistakes)
    for (const std::string& word : words) EXPECT_THAT(refusal(text), HasSubstr(word)) << text;
}

// Each command checks the values of its own options before a task runs.
TEST(SweepSpec, RefusesValuesThatNoTaskCanTake) {
  struct Mistake {
    const char *command, *options, *message;
  };
  for (const Mistake& mistake : {
           Mistake{"run", R"("structures": ["power", "wraped"])", "structures: --structures: 'wraped'"},
           {"run", R"("kernel": "exakt")", "kernel: --kernel: 'exakt'"},
           {"run", R"("motion": ["linear", "linaer"])", "did you mean linear?"},
           {"run", R"("audit": "often")", "audit: --audit: 'often'"},
           {"run", R"("radius": "vdw")", "did you mean element?"},
           {"run", R"("radius": [1, "1e"])", "radius: --radius: '1e'"},
           {"run", R"("cutoff": "-1")", "cutoff: --cutoff: '-1'"},
           {"run", R"("tolerance": "0.2x")", "tolerance: --tolerance: '0.2x'"},
           {"run", R"("frames": "9:1")", "frames: --frames"},
           {"run", R"("threads": 0)", "threads: --threads: '0'"},
           {"run", R"("select": "cα")", "select: --select"},
           {"compare", R"("strides": "1,x")", "strides: --strides: 'x'"},
           {"collide", R"("method": "al")", "method: --method: 'al'"},
           {"contacts", R"("cutoff": "6,x")", "cutoff: --cutoff: '6,x'"},
           {"stability", R"("cases": 1.5)", "cases: --cases: '1.5'"},
       }) {
    const std::string text = std::string(R"({"inputs": ["a.pdb"], "commands": ["info", {"command": ")") +
                             mistake.command + R"(", "options": {)" + mistake.options + "}}]}";
    EXPECT_THAT(refusal(text),
                testing::AllOf(testing::StartsWith("s.json: commands[1]: "), HasSubstr(mistake.message)))
        << text;
  }
  EXPECT_THAT(refusal(R"({"inputs": [{"file": "a.pdb", "units": "si"}], "commands": ["run"]})"),
              HasSubstr("s.json: inputs[0]: units: --units: 'si'"));
  EXPECT_EQ(refusal(R"({"inputs": [{"file": "a.pdb", "groups": ["ca", "//A"]}], "commands": [
      {"command": "run", "options": {"structures": ["power", "wrapped,contacts"], "motion": ["linear", "hermite"],
       "radius": [1, "1.5", "auto", "element", "file:r"], "tolerance": [null, "0.2r", 3], "certify": [true, false],
       "frames": ["::2", ":9"], "levels": "2:", "select": "ca", "threads": 2}},
      {"command": "stability", "options": {"cases": 5}}], "seeds": [0, 7]})"),
            "accepted");
}

// Values that are different settings must not be taken for the same. Numbers that are names stay names.
TEST(SweepSpec, TellsDifferentSettingsApart) {
  const std::vector<std::string> samples{"1",       "2",      "3.5",    "0:5",  "0:6",     "A",    "B",
                                         "1,2",     "1,3",    "2:3",    "2:4",  "0.1r",    "0.2r", "power",
                                         "wrapped", "linear", "lifted", "auto", "element", "ca",   "cb"};
  std::size_t accepted = 0;
  for (const std::string& name : swept_commands()) {
    const SweptCommand& command = swept_command(name, "");
    for (const SweptCommand::Option& option : command.options) {
      std::set<std::string> settings;
      std::size_t values = 0;
      for (const std::string& sample : samples) try {
          settings.insert(command.setting(option.name, std::vector<std::string>(option.count, sample), ""));
          ++values;
        } catch (const InputError&) {
        }
      if (option.value.empty()) continue;  // a flag
      EXPECT_EQ(settings.size(), values) << name << " --" << option.name;
      accepted += values;
    }
  }
  EXPECT_GT(accepted, 300U);
  EXPECT_EQ(
      refusal(
          R"({"inputs": ["a.pdb"], "commands": [{"command": "run", "options": {"chain": ["1", "01"]}}]})"),
      "accepted");
}

// A new option that names a file must be known to the sweep, which hashes such files or sets the option
// itself.
TEST(SweepSpec, KnowsEachOptionThatNamesAFile) {
  for (const std::string& name : swept_commands())
    for (const SweptCommand::Option& option : swept_command(name, "").options)
      if (option.value == "FILE" || option.value == "DIR") {
        EXPECT_THAT(option.name, testing::AnyOf("topology", "obstacle")) << name;
      }
  EXPECT_THAT(swept_commands(), testing::IsSupersetOf({"run", "info", "compare", "contacts", "collide",
                                                       "missed", "update", "trade"}));
}

TEST(SweepSpec, CombinesAxesAndExcludes) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", xyz({"0 0 0", "1 0 0"}));
  scratch.file("b.xyz", xyz({"0 0 0", "2 0 0"}));
  const SweepPlan plan = plan_of(
      R"({"inputs": ["*.xyz"],
          "commands": [{"command": "run", "options": {"structures": ["power", "wrapped"], "stride": [1, 5],
                                                      "certify": [true, false], "apart": [null, 4]}}],
          "exclude": [{"structures": "p*", "stride": 5}, {"certify": true}]})",
      scratch.path());
  EXPECT_EQ(plan.tasks().size() + plan.excluded(), 2U * 2 * 2 * 2 * 2);
  EXPECT_EQ(plan.tasks().size(), 2U * (1 + 2) * 2);
  std::set<TaskName> names;
  for (const SweepTask& task : plan.tasks()) names.insert(task.name);
  EXPECT_EQ(names.size(), plan.tasks().size());
  EXPECT_EQ(plan.arguments(plan.tasks().front()),
            (Arguments{"run", scratch / "a.xyz", "--structures", "power", "--frames", "::1"}));
  EXPECT_EQ(plan.arguments(plan.tasks().back()), (Arguments{"run", scratch / "b.xyz", "--apart", "4",
                                                            "--structures", "wrapped", "--frames", "::5"}));
}

// Names depend on content and settings, neither on paths nor on the order of options.
TEST(SweepSpec, NamesTasksByContentAndSettings) {
  const ScratchDirectory scratch;
  const auto name = [&](const std::string& file, const std::string& options) {
    return plan_of(R"({"inputs": [")" + file + R"("], "commands": [{"command": "run", "options": {)" +
                       options + "}}]}",
                   scratch.path())
        .tasks()
        .front()
        .name;
  };
  scratch.file("a.xyz", xyz({"0 0 0", "1 0 0"}));
  scratch.file("same.xyz", xyz({"0 0 0", "1 0 0"}));
  scratch.file("other.xyz", xyz({"0 0 0", "1 0 1"}));
  const TaskName a = name("a.xyz", R"("radius": 1, "motion": "linear")");
  EXPECT_EQ(name("same.xyz", R"("motion": "linear", "radius": 1)"), a);
  EXPECT_NE(name("other.xyz", R"("radius": 1, "motion": "linear")"), a);
  EXPECT_NE(name("a.xyz", R"("radius": 2, "motion": "linear")"), a);
  EXPECT_NE(name("a.xyz", R"("radius": 1)"), a);
  scratch.file("r1", "1\n1\n");
  scratch.file("r2", "1\n2\n");
  const TaskName r1 = name("a.xyz", R"("radius": "file:r1")");
  EXPECT_NE(name("a.xyz", R"("radius": "file:r2")"), r1);
  scratch.file("r2", "1\n1\n");
  EXPECT_EQ(name("a.xyz", R"("radius": "file:r2")"), r1);
  const TaskName missing = name("missing.xyz", R"("radius": 1, "motion": "linear")");
  EXPECT_NE(missing, a);
  EXPECT_NE(name("gone.xyz", R"("radius": 1, "motion": "linear")"), missing);
}

TEST(SweepSpec, RefusesMoreTasksThanMemoryHolds) {
  std::string numbers = "1";
  for (int k = 2; k <= 220; ++k) numbers += ',' + std::to_string(k);
  const std::string text =
      R"({"inputs": ["a.xyz"], "commands": [{"command": "run", "options": {"stride": [)" + numbers +
      R"(], "radius": [)" + numbers + R"(], "apart": [)" + numbers + "]}}]}";
  try {
    static_cast<void>(plan_of(text, "/nowhere"));
    ADD_FAILURE() << "accepted 10,648,000 tasks";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.json: commands[0]: has more than 10,000,000 tasks"));
  }
}

// A task that is listed twice would count twice in means.
TEST(SweepSpec, RefusesTasksListedTwiceAndIdleExclusions) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", xyz({"0 0 0", "1 0 0"}));
  scratch.file("same.xyz", xyz({"0 0 0", "1 0 0"}));
  EXPECT_EQ(plan_of(R"({"inputs": ["*.xyz"], "commands": ["run"]})", scratch.path()).tasks().size(), 2U);
  try {
    static_cast<void>(plan_of(
        R"({"inputs": ["*.xyz"], "commands": ["run"], "exclude": [{"input": "gone"}, {"command": "r"}]})",
        scratch.path()));
    ADD_FAILURE() << "accepted an exclusion that matches no task";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.json: exclude[1]: no task has command 'r'"));
  }
  for (const char* twice : {R"({"inputs": ["a.xyz", "*.xyz"], "commands": ["run"]})",
                            R"({"inputs": ["a.xyz"], "commands": ["run", {"command": "run"}]})"})
    try {
      static_cast<void>(plan_of(twice, scratch.path()));
      ADD_FAILURE() << "accepted " << twice;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(),
                  HasSubstr("s.json: task 'kds run " + (scratch / "a.xyz").string() + "' is listed twice"));
    }
}

TEST(SweepSpec, FindsFilesInFoldersOfAnyName) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "old [1]*\\");
  scratch.file("old [1]*\\/a.xyz", xyz({"0 0 0", "1 0 0"}));
  const SweepPlan plan = plan_of(R"({"inputs": ["*.xyz"], "commands": ["run"]})", scratch / "old [1]*\\");
  EXPECT_EQ(plan.text(plan.tasks().front(), "input"), "a.xyz");
}

TEST(SweepSpec, TellsInputsOfOneFileApart) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", xyz({"0 0 0", "1 0 0"}));
  const SweepPlan plan =
      plan_of(R"({"inputs": [{"file": "a.xyz", "radius": 1}, {"file": "a.xyz", "radius": 2},
                                                "a.xyz"], "commands": ["run"]})",
              scratch.path());
  std::vector<std::string> names;
  for (const SweepTask& task : plan.tasks()) names.push_back(plan.text(task, "input"));
  EXPECT_THAT(names, testing::ElementsAre("a.xyz --radius 1", "a.xyz --radius 2", "a.xyz"));
}

}  // namespace
}  // namespace kds::test::sweep_spec_test
