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
#include <random>
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
  EXPECT_EQ(rows.size(), 2 * 6 + 4 * 11U);  // strides of two proteins, amplitudes of four kinds of chains
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
    // The expected energy is half the squared normal deviation for each of the 125 or 126 angles. Large
    // changes of bending angles are drawn again, and torsion goes the short way round.
    if (row["subject"] == "random chain, both" && row["step"] <= 0.25) {
      const double amplitude = row["step"], expected = 0.5 * amplitude * amplitude * 125;
      EXPECT_NEAR(row["bending"].get<double>() / expected, 1, 0.1) << row;
      EXPECT_NEAR(row["torsion"].get<double>() / expected, 1, 0.1) << row;
    }
  }
  EXPECT_EQ(of_subject, (std::map<std::string, std::size_t>{{"villin", 6},
                                                            {"random protein", 6},
                                                            {"random chain, bending", 11},
                                                            {"random chain, torsion", 11},
                                                            {"random chain, both", 11},
                                                            {"self-avoiding chain, both", 11}}));
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

// Compares with `kds run` on equal frames, at strides 1 and 8.
void expect_energy_of_runs(const Json& rows) {
  for (const auto& [row, frames] : {std::pair<std::size_t, const char*>{0, "0:200"}, {3, "0:200:8"}}) {
    const ProgramRun by_run =
        run_program({"run", data_file("trajectories/villin_hp36_300K.dcd"), "--topology",
                     data_file("trajectories/villin_hp36_300K.pdb"), "--frames", frames, "--structures",
                     "wrapped,power", "--json", "-"});
    ASSERT_EQ(by_run.code, 0) << by_run.err;
    const Json summary = Json::parse(by_run.out);
    const Json energy = rows[row];
    const double steps = energy["steps"];
    EXPECT_NEAR(energy["basis_changes"].get<double>() * steps,
                summary["structures"]["wrapped"]["events"]["total"], 1e-6);
    EXPECT_NEAR(energy["flips"].get<double>() * steps, summary["structures"]["power"]["events"]["total"],
                1e-6);
  }
}

// The question of energy makes thousands of runs of small chains. The sanitizers skip it, because other tests
// make similar runs.
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
  if (arguments[1] != "bounds") {
    expect_energy(rows_of(json, "energy"));
    expect_energy_of_runs(rows_of(json, "energy"));
  }
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

TEST(SelfAvoidingAngles, NoTwoBeadsOverlap) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  constexpr std::size_t beads = 128;
  int self_avoiding_without_care = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const auto draw = [&](std::size_t) {
      const double bending = pi * (0.4 + 0.4 * uniform(random));
      return std::pair(bending, 2 * pi * uniform(random));
    };
    const auto overlaps = [](const Eigen::Matrix3Xd& chain) {
      for (Eigen::Index a = 0; a < chain.cols(); ++a)
        for (Eigen::Index b = a + 2; b < chain.cols(); ++b)
          if ((chain.col(a) - chain.col(b)).norm() <= 2 - 1e-9) return true;
      return false;
    };
    const ChainAngles angles = self_avoiding_angles(beads, 1.998, draw);
    EXPECT_EQ(angles.bending.size(), beads - 2);
    EXPECT_EQ(angles.torsion.size(), beads - 3);
    EXPECT_FALSE(overlaps(chain_of(angles, 1.998)));
    ChainAngles careless;
    for (std::size_t k = 0; k < beads - 2; ++k) careless.bending.push_back(draw(k).first);
    for (std::size_t k = 0; k < beads - 3; ++k) careless.torsion.push_back(draw(k).second);
    self_avoiding_without_care += overlaps(chain_of(careless, 1.998)) ? 0 : 1;
  }
  EXPECT_LT(self_avoiding_without_care, 5);
}

// Amplitudes 0 to 3 lie on a line of slope 1/2, 5 to 8 on one of slope 2/3, and 8 to 10 on one of slope 1/3.
TEST(QuestionCurve, ACrossoverHasThreeFits) {
  QuestionCurve curve{"", "curve", {}, {}, true};
  for (const double x : {1.0, 2.0, 4.0, 8.0}) curve.points.emplace_back(x, 3 * std::sqrt(x));
  curve.points.emplace_back(16, 17);
  for (const double x : {32.0, 64.0, 128.0, 256.0}) curve.points.emplace_back(x, std::cbrt(x * x));
  for (const double x : {512.0, 1024.0}) curve.points.emplace_back(x, std::cbrt(256.0 * x));
  const auto fits = curve.fits();
  ASSERT_EQ(fits.size(), 3U);
  EXPECT_NEAR(fits[0].fit.exponent, 1.0 / 2, 1e-12);
  EXPECT_EQ(fits[0].to, 8);
  EXPECT_NEAR(fits[1].fit.exponent, 2.0 / 3, 1e-12);
  EXPECT_EQ(fits[1].from, 32);
  EXPECT_NEAR(fits[2].fit.exponent, 1.0 / 3, 1e-12);
  EXPECT_EQ(fits[2].from, 256);
  curve.crossover = false;
  EXPECT_EQ(curve.fits().size(), 1U);
}

TEST(Questions, TheUsersTrajectoriesTakeThePlaceOfTheData) {
  const std::string dcd = data_file("trajectories/villin_hp36_300K.dcd"),
                    pdb = data_file("trajectories/villin_hp36_300K.pdb");
  const ProgramRun run = run_program(
      {"questions", "energy", "bounds", dcd, "--topology", pdb, "--frames", ":200", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(rows_of(json, "energy").size(), 6U);
  EXPECT_EQ(rows_of(json, "bounds").size(), 4U);
  // The first two questions without INPUTs measure the same frames.
  const ProgramRun usual = run_program({"questions", "bounds", "--json", "-"});
  ASSERT_EQ(usual.code, 0) << usual.err;
  const Json of_data = rows_of(Json::parse(usual.out), "bounds");
  EXPECT_EQ(rows_of(json, "bounds")[0]["speed"], of_data[0]["speed"]);
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "questions");
    const ProgramRun bad = run_program(arguments);
    EXPECT_EQ(bad.code, 2) << bad.out;
    return bad.err;
  };
  EXPECT_THAT(refused({"combination", dcd}), HasSubstr("combination is asked of its own chains"));
  EXPECT_THAT(refused({"energy", "--topology", pdb}), HasSubstr("--topology: applies only to INPUTs"));
  EXPECT_THAT(refused({"energy", dcd, "--seed", "3"}), HasSubstr("--seed: has no meaning for INPUTs"));
  EXPECT_THAT(refused({"energy", pdb}), HasSubstr("at least two frames"));
  EXPECT_THAT(refused({"energy", "nowhere.dcd"}), HasSubstr("nowhere.dcd: no such file"));
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
