// Tests `kds questions`: the deformation energy and the output.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "experiments/questions/question.h"
#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::test::questions_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;
constexpr double pi = std::numbers::pi;

ChainAngles some_angles() { return {{1.5, 2.0, 1.8, 2.5}, {0.3, -2.0, 3.0}}; }

TEST(Deformation, AChainHasTheAnglesItWasMadeOf) {
  const ChainAngles angles = some_angles();
  const Eigen::Matrix3Xd chain = chain_of(angles, 2);
  ASSERT_EQ(chain.cols(), 6);
  for (int bead = 0; bead + 1 < 6; ++bead)
    EXPECT_NEAR((chain.col(bead + 1) - chain.col(bead)).norm(), 2, 1e-12);
  for (std::size_t k = 0; k < angles.bending.size(); ++k) {
    ChainAngles other = angles;
    other.bending[k] += 0.1;
    const Deformation by = deformation(chain, chain_of(other, 2));
    EXPECT_NEAR(by.bending, 0.1 * 0.1 / 2, 1e-12);
    EXPECT_NEAR(by.torsion, 0, 1e-20);
  }
  for (std::size_t k = 0; k < angles.torsion.size(); ++k) {
    ChainAngles other = angles;
    other.torsion[k] += 0.2;
    const Deformation by = deformation(chain, chain_of(other, 3));  // bond lengths do not count
    EXPECT_NEAR(by.torsion, 0.2 * 0.2 / 2, 1e-12);
    EXPECT_NEAR(by.bending, 0, 1e-20);
  }
}

TEST(Deformation, TorsionGoesTheShortWayRound) {
  ChainAngles before = some_angles(), after = before;
  before.torsion[1] = pi - 0.1;
  after.torsion[1] = -pi + 0.1;
  EXPECT_NEAR(deformation(chain_of(before, 1), chain_of(after, 1)).torsion, 0.02, 1e-12);
}

TEST(Deformation, RigidMotionTakesNone) {
  const Eigen::Matrix3Xd chain = chain_of(some_angles(), 2);
  const Eigen::AngleAxisd turn(1.2, Eigen::Vector3d(1, 2, 3).normalized());
  Eigen::Matrix3Xd moved = turn.toRotationMatrix() * chain;
  moved.colwise() += Eigen::Vector3d(4, 5, 6);
  EXPECT_NEAR(deformation(chain, moved).energy(), 0, 1e-20);
}

TEST(Deformation, StraightAndShortChainsAndBeadsInOnePlace) {
  Eigen::Matrix3Xd straight = Eigen::Matrix3Xd::Zero(3, 5);
  straight.row(0) << 0, 1, 2, 3, 4;
  EXPECT_EQ(deformation(straight, straight).energy(), 0);
  Eigen::Matrix3Xd bent = straight;
  bent.col(4) = Eigen::Vector3d(3, 1, 0);
  EXPECT_NEAR(deformation(straight, bent).bending, pi * pi / 8, 1e-12);  // a right angle at one bead
  EXPECT_EQ(deformation(straight, bent).torsion, 0);  // undefined at the straight part of a chain
  EXPECT_EQ(deformation(straight, Eigen::Matrix3Xd::Zero(3, 5)).energy(), 0);
  EXPECT_EQ(deformation(straight.leftCols(2), bent.leftCols(2)).energy(), 0);
  EXPECT_EQ(deformation(straight.leftCols(1), bent.leftCols(1)).energy(), 0);
}

Json rows_of(const Json& all, const std::string& question) {
  Json rows = Json::array();
  for (const Json& row : all["rows"])
    if (row["question"] == question) rows.push_back(row);
  return rows;
}

void expect_energy(const Json& rows) {
  EXPECT_EQ(rows.size(), 2 * 6 + 3 * 9U);  // strides of two proteins, amplitudes of three kinds of angles
  std::map<std::string, std::size_t> of_subject;
  for (const Json& row : rows) {
    ++of_subject[row["subject"]];
    EXPECT_GT(row["flips"], 0) << row;
    EXPECT_GT(row["basis_changes"], 0) << row;
    if (row["subject"] == "random chain, bending") {
      EXPECT_GT(row["bending"], 1e-6) << row;
      EXPECT_LT(row["torsion"], 1e-20) << row;
    }
    if (row["subject"] == "random chain, torsion") {
      EXPECT_LT(row["bending"], 1e-20) << row;
      EXPECT_GT(row["torsion"], 1e-6) << row;
    }
    // The expected energy is half the squared normal deviation for each of the 125 or 126 angles.
    if (row["subject"] == "random chain, both") {
      const double amplitude = row["step"], expected = 0.5 * amplitude * amplitude * 125;
      EXPECT_NEAR(row["bending"].get<double>() / expected, 1, 0.1) << row;
      EXPECT_NEAR(row["torsion"].get<double>() / expected, 1, 0.1) << row;
    }
  }
  EXPECT_EQ(of_subject, (std::map<std::string, std::size_t>{{"villin", 6},
                                                            {"random protein", 6},
                                                            {"random chain, bending", 9},
                                                            {"random chain, torsion", 9},
                                                            {"random chain, both", 9}}));
}

// Stronger bounds cause fewer searches of pairs.
void expect_bounds(const Json& rows) {
  EXPECT_EQ(rows.size(), 3 * 4U);
  for (const Json& row : rows) {
    EXPECT_EQ(row["frames"], 200);
    EXPECT_GT(row["frames"], row["speed"]) << row;
    EXPECT_GE(row["speed"], row["displacement"]) << row;
    EXPECT_GE(row["displacement"], row["two_largest"]) << row;
    // The beads move by 0.01 radii per frame, so in 200 frames none moves by half of a skin of four.
    if (row["subject"] == "wandering chain" && row["skin"] == 4) {
      EXPECT_EQ(row["displacement"], 0) << row;
    }
  }
}

// The bounds hold, and the bound from the speed is the weaker one.
void expect_trust(const Json& rows) {
  EXPECT_EQ(rows.size(), 3 * 6U);
  for (const Json& row : rows) {
    EXPECT_GE(row["by_speed"].get<double>(), row["by_displacement"].get<double>()) << row;
    EXPECT_GE(row["by_displacement"], row["really"]) << row;
    EXPECT_LE(row["least"], row["trust_per_verify"]) << row;
    EXPECT_LE(row["trust_per_verify"], row["most"]) << row;
  }
}

void expect_combination(const Json& rows) {
  EXPECT_EQ(rows.size(), 7 * 5U);
  for (const Json& row : rows) {
    const double named = row["edges"].get<double>() + row["others"].get<double>();
    EXPECT_EQ(row["together"], row["pairs"].get<double>() + named) << row;
    EXPECT_LE(row["pairs"], row["hierarchy"]) << row;
    EXPECT_NEAR(row["gain"].get<double>(),
                std::min(row["hierarchy"].get<double>(), row["diagram"].get<double>()) /
                    row["together"].get<double>(),
                1e-12);
    if (row["left"] == 100) {
      EXPECT_EQ(named, row["diagram"]) << row;
    }
  }
}

// Excluded under the sanitizers: the test makes thousands of runs of small chains, and other tests make
// similar runs.
TEST(Questions, EnergyOfTheFramesOfRuns) {
  const ProgramRun run = run_program({"questions", "energy", "--seed", "3", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  expect_energy(rows_of(json, "energy"));
  // Compares with `kds run` on equal frames, at strides 1 and 8.
  for (const auto& [row, frames] : {std::pair<std::size_t, const char*>{0, "0:200"}, {3, "0:200:8"}}) {
    const ProgramRun by_run =
        run_program({"run", data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
                     data_file("trajectories/villin_hp36_300K.pdb"), "--frames", frames, "--structures",
                     "wrapped,power", "--json", "-"});
    ASSERT_EQ(by_run.code, 0) << by_run.err;
    const Json summary = Json::parse(by_run.out);
    const Json energy = rows_of(json, "energy")[row];
    const double steps = energy["steps"];
    EXPECT_NEAR(energy["basis_changes"].get<double>() * steps,
                summary["structures"]["wrapped"]["events"]["total"], 1e-6);
    EXPECT_NEAR(energy["flips"].get<double>() * steps, summary["structures"]["power"]["events"]["total"],
                1e-6);
  }
}

TEST(Questions, AllOfThemWithAPage) {
  const ScratchDirectory scratch;
  std::vector<std::string> arguments{"questions", "--rounds", "1", "--seed", "3", "--out", scratch / "out"};
#ifdef KDS_SANITIZED
  arguments.insert(arguments.begin() + 1, {"bounds", "trust", "combination"});
#endif
  const ProgramRun run = run_program(arguments);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(content_of(scratch / "out/questions.json"));
  EXPECT_EQ(json["settings"]["seed"], 3);
  EXPECT_EQ(json["questions"].size(), arguments[1] == "bounds" ? 3U : 4U);
  expect_bounds(rows_of(json, "bounds"));
  expect_trust(rows_of(json, "trust"));
  expect_combination(rows_of(json, "combination"));
  const std::string csv = content_of(scratch / "out/questions.csv");
  const auto commas = [&](std::size_t from) {
    return count_of(csv.substr(from, csv.find('\n', from) - from), ",");
  };
  std::size_t lines = 0;
  for (std::size_t from = 0; from < csv.size(); from = csv.find('\n', from) + 1, ++lines)
    if (csv.find('"', from) >= csv.find('\n', from)) {  // names with commas are quoted
      EXPECT_EQ(commas(from), commas(0)) << lines;
    }
  EXPECT_EQ(lines, json["rows"].size() + 1);
  const std::string page = content_of(scratch / "out/report.html");
  expect_sound(page);
  EXPECT_THAT(page, HasSubstr("No theorem is claimed"));
}

TEST(Questions, TheSameSeedGivesTheSameCounts) {
  const auto rows = [](const std::string& seed) {
    std::vector<std::string> arguments{"questions", "bounds", "--seed", seed, "--json", "-"};
#ifndef KDS_SANITIZED
    arguments.insert(arguments.begin() + 1, "combination");
#endif
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.code == 0 ? Json::parse(run.out)["rows"] : Json();
  };
  const Json first = rows("5");
  EXPECT_EQ(first, rows("5"));
  EXPECT_NE(first, rows("6"));
}

TEST(Questions, RefusesWhatIsNoQuestion) {
  const ProgramRun run = run_program({"questions", "why"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("QUESTION: 'why' is not one of energy, bounds, trust, combination"));
  const auto error_of = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "questions");
    const ProgramRun refused = run_program(arguments);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(count_of(refused.err, "\n"), 1U) << refused.err;
    return refused.err;
  };
  for (const char* question : {"energy", "bounds", "trust", "combination"})
    EXPECT_THAT(error_of({question, "--data", "nowhere"}), HasSubstr("--data: there is no folder nowhere"));
  EXPECT_THAT(error_of({"bounds", "bounds"}), HasSubstr("QUESTION: bounds is listed twice"));
  EXPECT_THAT(error_of({"bounds", "energy", "--rounds", "3"}),
              HasSubstr("--rounds applies only to the question trust, which measures time"));
}

// A result must not replace the input files.
TEST(Questions, NothingIsWrittenOntoTheData) {
  const ScratchDirectory directory;
  namespace fs = std::filesystem;
  fs::create_directories(directory / "data/paper");
  fs::create_directories(directory / "data/trajectories");
  const fs::path file = directory / "data/trajectories/any.dcd", linked = directory / "linked";
  std::ofstream(file) << "frames";
  fs::create_hard_link(file, linked);
  for (const fs::path& json : {file, linked})
    expect_refused({"questions", "energy", "--data", (directory / "data").string(), "--json", json.string()},
                   {"--json", "is the file of --data"});
  EXPECT_EQ(fs::file_size(file), 6U);
}

}  // namespace
}  // namespace kds::test::questions_test
