// For any log, a replay ends with the same fingerprint, with another fingerprint, or with one line that
// explains what is wrong with the log.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/run/replay_command.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_results.h"
#include "experiments/run/run_scene.h"
#include "kds/event_log.h"
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
      words[1] = words_of(lines[i - 1])[0];
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

}  // namespace
}  // namespace kds::test::replay_fuzz_test
