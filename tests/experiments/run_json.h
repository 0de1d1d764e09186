#pragma once
// Runs command lines of the program, and reads the JSON that they print.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"

namespace kds::test {

/// Splits a command line at its blanks. VILLIN stands for villin's trajectory and its topology, data/NAME for
/// a file in the data folder, and OUT/NAME for a file in `out`.
[[nodiscard]] inline std::vector<std::string> command_words(const std::string& line,
                                                            const std::filesystem::path& out = {}) {
  std::vector<std::string> words;
  std::istringstream text(line);
  for (std::string word; text >> word;) {
    if (word == "VILLIN")
      words.insert(words.end(), {data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
                                 data_file("trajectories/villin_hp36_300K.pdb")});
    else if (word.starts_with("data/"))
      words.push_back(data_file(word.substr(5)));
    else
      words.push_back(word.starts_with("OUT/") ? (out / word.substr(4)).string() : word);
  }
  return words;
}

/// Runs a command line that must succeed.
inline ProgramRun run_line(const std::string& line, const std::filesystem::path& out = {}) {
  ProgramRun run = run_program(command_words(line, out));
  EXPECT_EQ(run.code, 0) << line << ": " << run.err;
  return run;
}

/// Runs a command line that must succeed, with `--json -`, and returns its JSON.
inline nlohmann::ordered_json run_json(const std::string& line, const std::filesystem::path& out = {}) {
  const ProgramRun run = run_line(line + " --json -", out);
  return run.code == 0 ? nlohmann::ordered_json::parse(run.out) : nlohmann::ordered_json();
}

}  // namespace kds::test
