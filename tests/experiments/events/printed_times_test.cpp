// Times in the files of events and contacts have twelve correctly rounded digits.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::printed_times_test {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::istringstream text(content_of(path));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::string last_field(const std::string& line) { return line.substr(line.rfind(',') + 1); }

/// A ball of radius 1 that passes another ball and almost misses it.
class Pass {
 public:
  Pass(const ScratchDirectory& scratch, double y) : y_(y) {
    file_ = scratch.file("pass.xyz",
                         fmt::format("2\n\nC 0 0 0\nC {} {} 0\n2\n\nC 0 0 0\nC {} {} 0\n", from, y, to, y));
  }
  /// Returns the time at which the balls touch: at the beginning of the contact for sign -1, at the end for
  /// sign 1.
  [[nodiscard]] std::string time(int sign) const {
    const long double half = std::sqrt((2.0L - y_) * (2.0L + y_));
    return fmt::format("{:.12g}", (sign * half - from) / (static_cast<long double>(to) - from));
  }
  [[nodiscard]] Json run(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"run",      file_,     "--radius", "1",      "--structures",
                                       "contacts", "--apart", "1",        "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out);
  }

 private:
  static constexpr double from = -10.3, to = 9.7;
  double y_;
  std::string file_;
};

TEST(PrintedTimes, AreCertainWhereBallsNearlyMiss) {
  const ScratchDirectory scratch;
  for (int bits = 3; bits <= 52; bits += 7) {
    const Pass pass(scratch, 2 - std::ldexp(1.0, -bits));
    for (const char* kernel : {"filtered", "exact"}) {
      const Json silent = pass.run({"--kernel", kernel});
      const Json told = pass.run(
          {"--kernel", kernel, "--events", scratch / "events.jsonl", "--out", scratch / "out", "--replace"});
      EXPECT_EQ(told["engine"]["exact_work"], silent["engine"]["exact_work"]);
      EXPECT_EQ(told["fingerprint"], silent["fingerprint"]);
      const auto contacts = lines_of(scratch / "out/contacts.csv");
      const auto events = lines_of(scratch / "events.jsonl");
      ASSERT_EQ(contacts.size(), 3U);
      ASSERT_EQ(events.size(), 2U);
      for (const int sign : {-1, 1}) {
        const std::size_t place = sign < 0 ? 0 : 1;
        EXPECT_EQ(last_field(contacts[place + 1]), pass.time(sign)) << bits << kernel;
        EXPECT_EQ(fmt::format("{:.12g}", Json::parse(events[place])["time"].get<double>()), pass.time(sign));
      }
    }
  }
}

TEST(PrintedTimes, AreCertainInCertifiedContacts) {
  const ScratchDirectory scratch;
  const Pass pass(scratch, 2 - 0x1p-45);
  const Json summary = pass.run({"--certify", "--tolerance", "1e-300", "--out", scratch / "out"});
  EXPECT_EQ(summary["stride"]["contacts"]["found"], 1);
  const auto contacts = lines_of(scratch / "out/contacts.csv");
  ASSERT_EQ(contacts.size(), 3U);
  EXPECT_NE(contacts[1].find("," + pass.time(-1) + ","), std::string::npos) << contacts[1];
  EXPECT_NE(contacts[2].find("," + pass.time(1) + ","), std::string::npos) << contacts[2];
}

// Brackets depend on the kernel, printed times do not.
TEST(PrintedTimes, AreThoseOfAllKernels) {
  const ScratchDirectory scratch;
  std::vector<std::vector<std::string>> times;
  for (const char* kernel : {"filtered", "exact"}) {
    const ProgramRun run = run_program(
        {"run", data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
         data_file("trajectories/villin_hp36_300K.pdb"), "--frames", "0:2", "--radius", "2", "--kernel",
         kernel, "--structures", "wrapped,power,contacts", "--events", scratch / "events.jsonl", "--quiet"});
    ASSERT_EQ(run.code, 0) << run.err;
    times.emplace_back();
    for (const std::string& line : lines_of(scratch / "events.jsonl"))
      times.back().push_back(Json::parse(line)["time"].dump());
  }
  EXPECT_GT(times[0].size(), 50U);
  EXPECT_EQ(times[0], times[1]);
}

}  // namespace
}  // namespace kds::test::printed_times_test
