#pragma once
// Checks how the program reports a refusal.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"

namespace kds::test {

/// Checks for exit code 2, nothing on standard output, and one line on standard error that contains each of
/// the words.
inline void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.code, 2) << testing::PrintToString(arguments) << "\n" << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(run.err.starts_with("kds: ") && run.err.ends_with("\n")) << run.err;
  for (const std::string& word : words) EXPECT_THAT(run.err, testing::HasSubstr(word));
}

/// Returns a frame of an XYZ file; each bead is given as "x y z".
inline std::string xyz(const std::vector<std::string>& beads) {
  std::string frame = std::to_string(beads.size()) + "\nframe\n";
  for (const std::string& bead : beads) frame += "C " + bead + "\n";
  return frame;
}

}  // namespace kds::test
