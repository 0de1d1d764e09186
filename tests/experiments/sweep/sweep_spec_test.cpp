// Tests how sweep.json is read: its tasks and their names.

#include "experiments/sweep/sweep_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "experiments/program/commands.h"
#include "experiments/sweep/sweep_plan.h"
#include "motions/base/input_error.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::sweep_spec_test {
namespace {

SweepSpec spec_of(const std::string& text, const std::filesystem::path& folder = "/nowhere") {
  InputFiles files;
  return read_sweep(read_json(text, "s.json"), folder, files, "s.json");
}

SweepPlan plan_of(const std::string& text, const std::filesystem::path& folder) {
  InputFiles files;
  return {spec_of(text, folder), files, "s.json"};
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
  EXPECT_NO_THROW(static_cast<void>(spec_of(
      R"({"inputs": ["a.pdb"], "commands": [{"command": "run", "options": {"chain": ["1", "01"]}}]})")));
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
