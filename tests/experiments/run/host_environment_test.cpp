// Runs the program with a preloaded library that has set another floating-point environment.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/support/inputs/host_environment.h"

namespace kds::host_environment_test {
namespace {

using test::data_file;
using test::run_program;

// Returns the output without times: the events of each structure, and the fingerprint.
std::vector<std::string> history(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "run");
  arguments.insert(arguments.end(), {"--quiet", "--json", "-"});
  const auto run = run_program(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  std::vector<std::string> told;
  for (const std::string key : {"\"fingerprint\": ", "\"total\": "}) {
    for (std::size_t at = run.out.find(key); at != std::string::npos; at = run.out.find(key, at + 1))
      told.push_back(run.out.substr(at, run.out.find('\n', at) - at));
  }
  EXPECT_GE(told.size(), 2U);
  return told;
}

TEST(HostEnvironment, LeavesTheHistoryAndStays) {
#ifdef KDS_SANITIZED
  GTEST_SKIP() << "the sanitizer's own library has to be loaded first";
#endif
  const std::vector<std::vector<std::string>> runs{
      {data_file("hostile/rounding_mode_d2.txt"), "--structures", "power"},
      {data_file("kinetic/d3_n50_linear.txt"), "--structures", "power,wrapped"},
      {data_file("kinetic/d3_n20_degree3.txt"), "--structures", "power,wrapped", "--kernel", "exact"},
      {data_file("kinetic/degenerate_w3_n64_half.txt"), "--structures", "power"},
      {data_file("kinetic/d1_n100_degree3.txt")},
      {data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
       data_file("trajectories/villin_hp36_300K.pdb"), "--frames", "0:20", "--motion", "hermite"},
      {data_file("trajectories/ubiquitin_pull_first30.pdb"), "--radius", "element:fit"}};
  for (const auto& run : runs) {
    const auto expected = history(run);
    for (std::size_t host = 0; host < test::host_environments.size(); ++host) {
      SCOPED_TRACE(run.front() + " where the host has set " + test::host_environments[host].name);
      ::setenv("LD_PRELOAD", KDS_HOST_LIBRARY, 1);
      ::setenv("KDS_HOST", std::to_string(host).c_str(), 1);
      EXPECT_EQ(history(run), expected);
      ::unsetenv("LD_PRELOAD");
      ::unsetenv("KDS_HOST");
    }
  }
}

}  // namespace
}  // namespace kds::host_environment_test
