// For any log, a replay ends with the same fingerprint, with another fingerprint, or with one line that
// explains what is wrong with the log.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/run/event_log_file.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/replay_command.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_scene.h"
#include "kds/event.h"
#include "motions/base/input_error.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/rounds.h"

namespace kds::test::replay_fuzz_test {
namespace {

using Lines = std::vector<std::string>;

enum class Outcome { same, different, refused };

Outcome replay(const std::string& path, std::string* message = nullptr) {
  try {
    const auto silent = [](auto&&...) {};
    return replay_log(path, silent, silent).same() ? Outcome::same : Outcome::different;
  } catch (const InputError& error) {
    EXPECT_FALSE(one_line(error.what()).empty());
    if (message != nullptr) *message = error.what();
    return Outcome::refused;
  }
}

Lines log_of(const std::string& instance, const std::string& structures, const ScratchDirectory& directory) {
  const std::string path = (directory / "right.log").string();
  const auto silent = [](auto&&...) {};
  RunResults results({std::nullopt, std::nullopt, true});
  const RunReport report = run_scene(
      parse_run_options({data_file("kinetic/" + instance), "--structures", structures, "--log", path}),
      silent, silent, results);
  results.deliver(report, "", "");
  EXPECT_EQ(replay(path), Outcome::same);
  Lines lines = split(content_of(path), '\n');
  lines.pop_back();  // after the last newline
  return lines;
}

std::string write_log(const Lines& lines, const ScratchDirectory& directory) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return directory.file("spoiled.log", text);
}

Lines words_of(const std::string& line) { return split(line, ' '); }

std::string joined(const Lines& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

void spoil(Lines& lines, std::mt19937& random) {
  static const Lines values{"0",   "1",     "4294967295", "4294967296", "-1",      "nan",
                            "inf", "1e308", "",           "sorted",     "wrapped", "power",
                            "2-3", "3-2",   "enter",      "leave",      "pivot",   "0.5",
                            "7",   "19",    "20",         "contacts",   "end",     "99999999999999999999999"};
  const auto among = [&](std::size_t first, std::size_t last) { return first + random() % (last - first); };
  const std::size_t line = among(2, lines.size());
  const std::size_t other = among(2, lines.size());
  Lines words = words_of(lines[line]);
  switch (random() % 6) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
      return;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(line), std::string(lines[other]));
      return;
    case 2:
      std::swap(lines[line], lines[other]);
      return;
    case 3:
      lines[line][random() % lines[line].size()] = static_cast<char>(random() % 256);
      return;
    case 4:
      std::shuffle(words.begin(), words.end(), random);
      break;
    default:
      words[random() % words.size()] = values[random() % values.size()];
  }
  lines[line] = joined(words);
}

// An attacker may know how the steps of a log are counted and hashed. This function repairs both, and the
// count at the end.
void mend(Lines& lines) {
  WordHash hash;
  std::size_t in_step = 0, all = 0;
  for (std::size_t i = 2; i < lines.size(); ++i) {
    Lines words = words_of(lines[i]);
    if (lines[i].starts_with("step ") && words.size() == 4) {
      if (const std::string first = words_of(lines[i - 1])[0]; first != "edit" && first != "curve")
        words[1] = first;
      words[2] = std::to_string(in_step);
      words[3] = hex_digits(hash.value());
      lines[i] = joined(words);
      hash = {};
      in_step = 0;
    } else if (lines[i].starts_with("end ") && words.size() == 3) {
      words[1] = std::to_string(all);
      lines[i] = joined(words);
    } else {
      for (const char c : lines[i]) hash.add(static_cast<unsigned char>(c));
      hash.add('\n');
      if (lines[i].starts_with("edit ") || lines[i].starts_with("curve ")) continue;
      ++in_step;
      ++all;
    }
  }
}

/// Returns the lines without brackets and without the hashes of steps, which depend on the brackets.
Lines without_times(const Lines& lines) {
  Lines rest;
  for (const std::string& line : lines) {
    Lines words = words_of(line);
    if (line.starts_with("step ") && words.size() == 4) {
      words.pop_back();
    } else if (rest.size() >= 2 && !line.starts_with("end ") && words.size() > 5) {
      words.erase(words.begin() + 3, words.begin() + 5);
    }
    rest.push_back(joined(words));
  }
  return rest;
}

TEST(ReplayFuzz, SpoiledLogsAreRefusedOrDiffer) {
  const ScratchDirectory directory;
  std::mt19937 random(2004);
  std::size_t refused = 0, different = 0;
  for (const auto& [instance, structures] :
       {std::pair<std::string, std::string>{"d1_n20_linear.txt", "sorted"},
        {"d3_n20_linear.txt", "sorted,wrapped,power"}}) {
    const Lines right = log_of(instance, structures, directory);
    for (int round = 0; round < rounds(250); ++round) {
      Lines lines = right;
      for (std::size_t times = 1 + random() % 2; times-- > 0;) spoil(lines, random);
      if (random() % 2 != 0) mend(lines);
      const Outcome outcome = replay(write_log(lines, directory));
      EXPECT_TRUE(outcome != Outcome::same || without_times(lines) == without_times(right));
      refused += outcome == Outcome::refused ? 1 : 0;
      different += outcome == Outcome::different ? 1 : 0;
    }
  }
  EXPECT_GT(refused, rounds(300U));
  EXPECT_GT(different, 0U);
}

// Brackets depend on how the run was cut, so a log may have any that hold the failure times.
TEST(ReplayFuzz, TimesMustHoldTheFailureTimes) {
  const ScratchDirectory directory;
  const Lines right = log_of("d3_n20_linear.txt", "wrapped,power", directory);
  Lines all_wide = right;
  for (std::size_t i = 2; i < right.size(); ++i) {
    Lines words = words_of(right[i]);
    if (words.size() < 6) continue;
    const std::string lower = words[3], upper = words[4];
    words[3] = "0";
    words[4] = "1";
    all_wide[i] = joined(words);
    if (i % 16 != 0) continue;
    for (const bool before : {false, true}) {
      words[3] = before ? "0" : upper;
      words[4] = before ? lower : "1";
      Lines beside = right;
      beside[i] = joined(words);
      EXPECT_EQ(replay(write_log(beside, directory)), Outcome::refused) << i;
      mend(beside);
      EXPECT_EQ(replay(write_log(beside, directory)), Outcome::different) << i;
    }
  }
  EXPECT_EQ(replay(write_log(all_wide, directory)), Outcome::refused);
  mend(all_wide);
  EXPECT_EQ(replay(write_log(all_wide, directory)), Outcome::same);
}

TEST(ReplayFuzz, LogsOfVersionOneAreRefused) {
  const ScratchDirectory directory;
  Lines lines = log_of("d1_n20_linear.txt", "sorted", directory);
  lines[0] = "kds event log 1";
  std::string message;
  EXPECT_EQ(replay(write_log(lines, directory), &message), Outcome::refused);
  EXPECT_THAT(message, testing::HasSubstr("spoiled.log:1: this log has version 1"));
}

TEST(ReplayFuzz, LogsCutOffAreRefused) {
  const ScratchDirectory directory;
  const Lines right = log_of("d1_n20_linear.txt", "sorted", directory);
  for (std::size_t count = 0; count < right.size(); ++count) {
    Lines lines = right;
    lines.resize(count);
    EXPECT_EQ(replay(write_log(lines, directory)), Outcome::refused) << count;
  }
  const std::string text = content_of(write_log(right, directory));
  for (std::size_t size = text.size() - 40; size + 1 < text.size(); ++size)
    EXPECT_EQ(replay(directory.file("cut.log", text.substr(0, size))), Outcome::refused) << size;
}

TEST(ReplayFuzz, SpoiledHeadersAreRefused) {
  const ScratchDirectory directory;
  Lines lines = log_of("d1_n20_linear.txt", "sorted", directory);
  const std::string input = data_file("kinetic/d1_n20_linear.txt");
  const auto header = [&](const std::string& arguments, const std::string& beads, const std::string& steps) {
    return R"({"arguments":[)" + arguments + R"(],"beads":)" + beads + R"(,"steps":)" + steps + "}";
  };
  const std::string quoted = '"' + input + '"';
  lines[1] = header(quoted, "20", "1");
  EXPECT_EQ(replay(write_log(lines, directory)), Outcome::same);
  for (const std::string& spoiled :
       {std::string("{}"), std::string("null"), std::string(100000, '['), header(quoted, "21", "1"),
        header(quoted, "-1", "1"), header(quoted, "1e300", "1"), header(quoted, "20", "18446744073709551615"),
        header("1", "20", "1"), header("", "20", "1"), header("\"--help\"", "20", "1"),
        header(quoted + ",\"--kernel\",\"slow\"", "20", "1"), header("\"nowhere.pdb\"", "20", "1")}) {
    lines[1] = spoiled;
    std::string message;
    EXPECT_EQ(replay(write_log(lines, directory), &message), Outcome::refused) << spoiled.substr(0, 80);
    EXPECT_THAT(message,
                testing::AnyOf(testing::HasSubstr("spoiled.log"), testing::HasSubstr("nowhere.pdb")));
  }
}

TEST(ReplayFuzz, LogsOfValuesThatAreGoneAreRefused) {
  const ScratchDirectory directory;
  Lines lines = log_of("d1_n20_linear.txt", "sorted", directory);
  const std::string input = data_file("kinetic/d1_n20_linear.txt");
  for (const auto& [arguments, why] :
       {std::pair(R"("--kernel","fast")", "--kernel: 'fast' is not one of filtered, exact"),
        std::pair(R"("--relax","0.03")", "unknown option '--relax'")}) {
    lines[1] = R"({"arguments":[")" + input + R"(",)" + arguments + R"(],"beads":20,"steps":1})";
    std::string message;
    EXPECT_EQ(replay(write_log(lines, directory), &message), Outcome::refused);
    EXPECT_THAT(message, testing::HasSubstr(std::string("spoiled.log:2: the run's arguments: ") + why));
  }
}

/// Writes beads that oscillate, each in its own way.
std::string oscillating_beads(int beads, int frames, double speed, const ScratchDirectory& directory) {
  std::string text;
  for (int frame = 0; frame < frames; ++frame) {
    text += fmt::format("{}\nframe {}\n", beads, frame);
    for (int b = 0; b < beads; ++b) {
      const double phase = speed * frame * (1 + 0.1 * (b % 7)) + b;
      text +=
          fmt::format("C {} {} {}\n", b + 0.8 * std::sin(phase), std::cos(2 * phase), std::sin(b + phase));
    }
  }
  return directory.file("beads.xyz", text);
}

/// Gives the bead the positions of another until the end of the step.
void swerve(KineticRun& run, BeadId bead, BeadId other) {
  run.change_motion({bead}, [&](SceneMotion& motion) {
    const std::vector<double> course = coordinates_of(motion, std::vector{other});
    for (int axis = 0; axis < 3; ++axis)
      motion.set_coordinate(bead, 0, axis, course[static_cast<std::size_t>(axis)]);
  });
}

/// Runs with edits at times of doubles and of events, and writes the log.
Lines edited_log(const Arguments& arguments, const ScratchDirectory& directory,
                 const std::function<void(KineticRun&)>& make_edits) {
  const RunOptions options = parse_run_options(arguments);
  const Scene scene = load_scene(options, [](const std::string&) {});
  const auto run = open_run(options, scene, AuditMode::none);
  const std::string path = (directory / "edited.log").string();
  EventLogWriter log(path, options, scene, run->structures(), /*edits=*/true);
  run->listen(log);
  make_edits(*run);
  run->finish();
  log.end(run->simulator().fingerprint());
  commit_together({&log.file()});
  Lines lines = split(content_of(path), '\n');
  lines.pop_back();
  return lines;
}

TEST(EditedLogs, AreReplayedOnSeveralThreads) {
  const ScratchDirectory directory;
  const std::string beads = oscillating_beads(50, 441, 0.02, directory);
  const auto make_edits = [](KineticRun& run) {
    run.go_to(100.25);
    swerve(run, 3, 9);
    ASSERT_TRUE(run.next_event());
    swerve(run, 4, 11);
    swerve(run, 5, 3);
    run.go_to(101);
    ASSERT_TRUE(run.next_event());
    swerve(run, 6, 7);
    run.go_to(330.1);
    run.erase(0, 12);
    ASSERT_TRUE(run.next_event());
    run.erase(1, 30);
    run.go_to(430.5);
    run.insert(0, 12);
  };
  const Lines lines = edited_log({beads, "--radius", "1", "--structures", "sorted,contacts", "--apart", "1"},
                                 directory, make_edits);
  EXPECT_EQ(lines[0], "kds event log 3");
  EXPECT_EQ(std::ranges::count_if(lines, [](const auto& l) { return l.starts_with("edit "); }), 7);
  const auto silent = [](auto&&...) {};
  const ReplayReport replay = replay_log(directory / "edited.log", silent, silent);
  EXPECT_TRUE(replay.same()) << replay.difference.value_or("");
  EXPECT_EQ(replay.run.threads, std::min<std::size_t>(2, all_threads()));
  EXPECT_EQ(replay.run.parts.parts > 1, replay.run.threads > 1);
  EXPECT_EQ(replay.run.parts.run_again, 0U);
  const ProgramRun program = run_program({"replay", (directory / "edited.log").string()});
  EXPECT_EQ(program.code, 0);
  EXPECT_THAT(program.out, testing::HasSubstr("fingerprint same"));
}

TEST(EditedLogs, AreReplayedWithoutEdits) {
  const ScratchDirectory directory;
  const Arguments arguments{oscillating_beads(10, 4, 0.5, directory), "--structures", "sorted"};
  Lines lines = edited_log(arguments, directory, [](KineticRun&) {});
  EXPECT_EQ(lines[0], "kds event log 3");
  EXPECT_EQ(replay(write_log(lines, directory)), Outcome::same);
  lines[0] = "kds event log 2";
  EXPECT_EQ(replay(write_log(lines, directory)), Outcome::same);
  lines[0] = "kds event log 4";
  std::string message;
  EXPECT_EQ(replay(write_log(lines, directory), &message), Outcome::refused);
  EXPECT_THAT(message, testing::HasSubstr("this version of event logs is not known; expected"));
}

TEST(EditedLogs, BadEditsAreRefusedInOneLine) {
  const ScratchDirectory directory;
  const Arguments arguments{oscillating_beads(12, 4, 0.5, directory), "--radius", "1", "--structures",
                            "sorted,wrapped"};
  const Lines right = edited_log(arguments, directory, [](KineticRun& run) {
    run.go_to(1.25);
    run.change_motion({2, 3}, coordinates_of(*run.motion(), std::vector<BeadId>{2, 3}));
    EXPECT_TRUE(run.next_event());
    run.erase(0, 5);
  });
  EXPECT_EQ(replay(write_log(right, directory)), Outcome::same);
  const auto line_of = [&](const std::string& begin) {
    return static_cast<std::size_t>(
        std::ranges::find_if(right, [&](const auto& line) { return line.starts_with(begin); }) -
        right.begin());
  };
  const std::size_t change = line_of("edit 1 at"), curve = change + 1, erase = line_of("edit 1 before");
  const Lines words = words_of(right[curve]);
  EXPECT_THAT(right[curve + 2], testing::HasSubstr("change"));  // edits stand before their events
  EXPECT_THAT(right[erase + 1], testing::HasSubstr("sorted erase"));
  const auto with = [&](std::size_t word, const std::string& value) {
    Lines changed = words;
    changed[word] = value;
    return joined(changed);
  };
  const std::string erased = right[erase].substr(0, right[erase].find("erase"));
  struct Bad {
    std::size_t line;
    std::string text;
    std::size_t named;  ///< the line that is refused, from 0
    std::string why;
  };
  const std::vector<Bad> bad{
      {curve, joined(Lines(words.begin(), words.end() - 1)), curve + 1, "more or fewer coordinates than the"},
      {curve, with(1, "12"), curve, "bead 12 of 12"},
      {curve, with(2, "nan"), change, "a control point is not a finite number"},
      {curve, with(2, "1e999"), curve, "expected a coordinate, found '1e999'"},
      {curve, with(2, "0x1p+2"), curve, "expected a coordinate, found '0x1p+2'"},
      {change, "edit 1 at 0x1p-2 change 3", curve + 2, "expected 'curve', a bead and its control points"},
      {change, "edit 1 at 0x1p-2 change 1", curve + 1, "expected a step, found 'curve'"},
      {change, "edit 1 at 0x1p-2 bend 2", change, "expected one of insert, erase, change, found 'bend'"},
      {change, "edit 1 at 0x5p-2 change 2", change, "expected a time from 0 to below 1"},
      {change, "edit 1 at 1/4 change 2", change, "expected a time from 0 to below 1"},
      {change, "edit 1 at 0x2p-3 change 2", change, "expected a time from 0 to below 1"},
      {change, "edit 1 after 0x1p-2 change 2", change, "expected one of at, before, found 'after'"},
      {change, "edit 3 at 0x1p-2 change 2", change, "step 3 of 3"},
      {erase, erased + "erase sorted 12", erase, "bead 12 of 12"},
      {erase, erased + "erase power 5", erase, "the run has no structure power"},
      {erase, erased + "erase wrapped 5", erase, "wrapped: its beads cannot come and go"},
      {erase, erased + "insert sorted 5", erase, "sorted: bead 5 is among its beads already"},
      {erase, "edit 1 at 0x1p-3 erase sorted 5", erase, "a run until u = 1/8"},
      {erase, "edit 1 before 0x1p-3 erase sorted 5", erase, "the run is past the time of this edit"}};
  const auto expect_refused = [&](Lines lines, std::size_t named, const std::string& why) {
    SCOPED_TRACE(why);
    EXPECT_EQ(replay(write_log(lines, directory)), Outcome::refused);
    mend(lines);
    std::string message;
    EXPECT_EQ(replay(write_log(lines, directory), &message), Outcome::refused);
    EXPECT_THAT(message, testing::HasSubstr(fmt::format("spoiled.log:{}: ", named + 1)));
    EXPECT_THAT(message, testing::HasSubstr(why));
  };
  for (const Bad& one : bad) {
    Lines lines = right;
    lines[one.line] = one.text;
    expect_refused(lines, one.named, one.why);
  }
  Lines lines = right;
  for (const std::size_t line : {curve, curve + 1}) lines[line].resize(lines[line].rfind(' '));
  expect_refused(lines, change, "10 coordinates for 2 beads: expected 12");
  lines = right;
  std::swap(lines[erase], lines[erase + 1]);  // after the event that it causes
  mend(lines);
  EXPECT_EQ(replay(write_log(lines, directory)), Outcome::different);
  lines = right;
  lines[1].replace(lines[1].find("sorted,wrapped"), 14, "layered");
  lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(erase));
  expect_refused(lines, change, "its beads cannot change course within a step");
}

}  // namespace
}  // namespace kds::test::replay_fuzz_test
