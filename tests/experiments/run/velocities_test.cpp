// --velocities of kds run, contacts and compare.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/text.h"
#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/inputs/cubic_paths.h"

namespace kds::test::velocities_test {
namespace {

using std::string_literals::operator""s;
using testing::HasSubstr;

class Velocities : public testing::Test {
 protected:
  ScratchDirectory scratch_;
};

// One bead rests, the other is at x = 4 + (t - 0.3)(t - 0.7)(t - 2.1): within 4 until 0.3, and from 0.7
// to 2.1.
TEST_F(Velocities, ContactsBeginAndEndOnTheTrueCubic) {
  std::string text = "ITEM: UNITS\nmetal\n";
  for (const double t : {0.0, 1.0, 2.5})
    text += fmt::format(
        "ITEM: TIME\n{}\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n"
        "0 9\n0 9\n0 9\nITEM: ATOMS id x y z vx vy vz\n1 0 0 0 0 0 0\n2 {} 0 0 {} 0 0\n",
        t, 4 + (t - 0.3) * (t - 0.7) * (t - 2.1),
        (t - 0.7) * (t - 2.1) + (t - 0.3) * (t - 2.1) + (t - 0.3) * (t - 0.7));
  scratch_.file("two.lammpstrj", text);
  const auto json = run_json("contacts OUT/two.lammpstrj --cutoff 4 --apart 1 --motion hermite --out OUT/c",
                             scratch_.path());
  EXPECT_EQ(json.at("input").at("velocities"), "file");
  std::istringstream table(content_of(scratch_ / "c/intervals.csv"));
  std::vector<double> ends;
  for (std::string row; std::getline(table, row);) {
    const std::vector<std::string> fields = split(row, ',');
    if (fields[0] == "0") ends.insert(ends.end(), {std::stod(fields[4]), std::stod(fields[5])});
  }
  const auto near = [](double x) { return testing::DoubleNear(x, 1e-10); };
  EXPECT_THAT(ends, testing::ElementsAre(0.0, near(0.3), near(0.7), near(1 + 1.1 / 1.5)));
}

TEST_F(Velocities, ResultsSayWhereTheyComeFrom) {
  CubicPaths paths;
  scratch_.file("a.lammpstrj", paths.dump());
  const std::string run = "run OUT/a.lammpstrj --structures power --quiet --motion ";
  EXPECT_EQ(run_json(run + "hermite", scratch_.path()).at("input").at("velocities"), "file");
  EXPECT_EQ(run_json(run + "hermite --velocities differences", scratch_.path()).at("input").at("velocities"),
            "differences");
  EXPECT_FALSE(run_json(run + "linear", scratch_.path()).at("input").contains("velocities"));
  EXPECT_THAT(run_line("run OUT/a.lammpstrj --motion hermite --log OUT/log", scratch_.path()).out,
              HasSubstr(", velocities of the file"));
  run_line("replay OUT/log --quiet", scratch_.path());
  const std::string compare = "compare OUT/a.lammpstrj --motions linear,hermite --rounds 1 --strides 1,3";
  EXPECT_THAT(run_line(compare, scratch_.path()).out, HasSubstr("hermite motion, velocities of the file ("));
  EXPECT_THAT(run_line(compare + " --velocities differences", scratch_.path()).out,
              HasSubstr("hermite motion, velocities by differences ("));
  paths.has_times = false;
  scratch_.file("a.lammpstrj", paths.dump());
  EXPECT_THAT(run_line(run + "hermite", scratch_.path()).err,
              HasSubstr("a.lammpstrj: velocities are differences of frames, because frame 0 has no time"));
  for (const auto& [line, message] :
       {std::pair(run + "hermite --velocities file", "--velocities: file: frame 0 has no time; expected"),
        std::pair("run VILLIN --motion hermite --velocities file"s,
                  "file: no frame has velocities; expected"),
        std::pair("run VILLIN --velocities file"s,
                  "--velocities: is of Hermite curves; expected --motion")}) {
    const ProgramRun refused = run_program(command_words(line, scratch_.path()));
    EXPECT_EQ(refused.code, 2) << line;
    EXPECT_THAT(refused.err, HasSubstr(message));
  }
}

// Times that are 1000 times too long make the velocities useless.
TEST_F(Velocities, AreLeftOutWhereTheyMislead) {
  CubicPaths paths;
  paths.times = {0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75};
  paths.has_times = false;
  scratch_.file("a.lammpstrj", paths.dump());
  const std::string run = "run OUT/a.lammpstrj --structures power --quiet --motion hermite --dt 250";
  for (const auto& [asked, used] : {std::pair("", "differences"),
                                    {" --velocities file", "file"},
                                    {" --velocities differences", "differences"}}) {
    EXPECT_EQ(run_json(run + asked, scratch_.path()).at("input").at("velocities"), used) << asked;
    const bool warned =
        run_line(run + asked, scratch_.path()).err.find("the error of differences") != std::string::npos;
    EXPECT_EQ(warned, asked != " --velocities differences"s) << asked;
  }
  const std::string certified =
      "run OUT/a.lammpstrj --structures contacts --motion hermite --dt 0.25 --velocities file";
  EXPECT_THAT(run_line(certified + " --frames ::2 --certify", scratch_.path()).out,
              HasSubstr("velocities of the file"));
}

TEST_F(Velocities, PartsAndThreadsGiveTheEventsOfOneRun) {
  CubicPaths paths;
  paths.beads = 20;
  paths.times.clear();
  for (int k = 0; k < 2400; ++k) paths.times.push_back(0.001 * k);
  scratch_.file("a.lammpstrj", paths.dump());
  std::vector<std::string> logs;
  for (const std::string threads : {"1", "3"}) {
    const auto json =
        run_json("run OUT/a.lammpstrj --motion hermite --structures wrapped,power --quiet --log OUT/log" +
                     threads + " --threads " + threads,
                 scratch_.path());
    EXPECT_EQ(json.at("engine").at("parts") == 1, threads == "1");
    EXPECT_EQ(json.at("input").at("velocities"), "file");
    logs.push_back(content_of(scratch_ / ("log" + threads)));
  }
  EXPECT_GT(logs[0].size(), 2000U);
  EXPECT_EQ(logs[0], logs[1]);
}

}  // namespace
}  // namespace kds::test::velocities_test
