// Tests `kds stability`, through the library and as a process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "certificates/types/orientation.h"
#include "certificates/types/power_test.h"
#include "certificates/types/precedes.h"
#include "experiments/output/text.h"
#include "experiments/stability/certificate_trial.h"
#include "experiments/stability/compare_answers.h"
#include "experiments/stability/stability.h"
#include "experiments/stability/stability_scenes.h"
#include "motions/base/input_error.h"
#include "motions/scene/scene.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/rounds.h"

namespace kds::stability_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

std::vector<StabilityRow> rows_of(const Arguments& arguments) {
  return run_stability(parse_stability_options(arguments), [](std::size_t, std::size_t) {});
}

// Tests of scenes.

TEST(StabilityScenes, AreTheSameForTheSameSeed) {
  for (const Extreme& extreme : all_extremes()) {
    const auto text = [&](std::uint64_t seed) {
      SceneRandom random = scene_random(seed, extreme.name, 3);
      return instance_text(extreme.make({3, 3, 5}, random).instance("scene"));
    };
    EXPECT_EQ(text(1), text(1)) << extreme.name;
    EXPECT_NE(text(1), text(2)) << extreme.name;
  }
}

TEST(StabilityScenes, AreRefusedWhereAnExactValueIsMissingAndOnlyThere) {
  for (const Extreme& extreme : all_extremes()) {
    for (const int dimension : {1, 2, 3}) {
      for (const int degree : {1, 2, 3}) {
        if (!extreme.applies(dimension, degree)) continue;
        SceneRandom random = scene_random(5, extreme.name, 0);
        const Instance instance = extreme.make({dimension, degree, 7}, random).instance("scene");
        EXPECT_EQ(instance.point_count(), 7U);
        EXPECT_EQ(instance.dimension(), dimension);
        EXPECT_EQ(instance.degree, degree);
        if (extreme.refused) {
          EXPECT_THROW(Scene{instance}, InputError) << extreme.name;
        } else {
          EXPECT_NO_THROW(Scene{instance}) << extreme.name;
        }
      }
    }
  }
}

const Extreme& extreme(std::string_view name) {
  for (const Extreme& e : all_extremes())
    if (e.name == name) return e;
  throw std::logic_error("no such extreme");
}

// Returns the function of a certificate over the first beads of a scene.
template <class C, int Dimension>
ExactPolynomial function_in(int motion_degree, std::string_view name, std::size_t number) {
  SceneRandom random = scene_random(11, name, number);
  C certificate;
  const auto motion = extreme(name)
                          .make({Dimension, motion_degree, certificate.beads.size()}, random)
                          .template motion<Dimension>();
  for (std::size_t i = 0; i < certificate.beads.size(); ++i) certificate.beads[i] = static_cast<BeadId>(i);
  return *search_over<C>(MotionRef<Dimension>(motion))->exact_function(certificate);
}

TEST(StabilityScenes, AreWhatTheySay) {
  const Dyadic start(0.0), middle(0.5), end(1.0);
  for (std::size_t number = 0; number < 20; ++number) {
    EXPECT_TRUE((function_in<Precedes, 1>(3, "beads:coincident", number).is_zero()));
    EXPECT_EQ((function_in<Precedes, 1>(3, "beads:coincident-mid", number).sign_at(middle)), 0);
    EXPECT_TRUE((function_in<Orientation<3>, 3>(1, "beads:collinear", number).is_zero()));
    EXPECT_TRUE((function_in<Orientation<3>, 3>(1, "beads:coplanar", number).is_zero()));
    EXPECT_EQ((function_in<Orientation<3>, 3>(1, "beads:coplanar-mid", number).sign_at(middle)), 0);
    EXPECT_TRUE((function_in<PowerTest<3>, 3>(1, "beads:cospherical", number).is_zero()));
    EXPECT_EQ((function_in<PowerTest<3>, 3>(1, "beads:cospherical-mid", number).sign_at(middle)), 0);
  }
  int zero_at_start = 0, zero_at_end = 0, touching = 0;
  for (std::size_t number = 0; number < 20; ++number) {
    zero_at_start += function_in<PowerTest<3>, 3>(1, "ties:start", number).sign_at(start) == 0;
    zero_at_end += function_in<PowerTest<3>, 3>(1, "ties:end", number).sign_at(end) == 0;
    const auto touch = function_in<PowerTest<3>, 3>(1, "contact:tangent", number);
    touching += !touch.is_zero() && touch.sign_at(middle) == 0 &&
                touch.sign_at(Dyadic(0.25)) == touch.sign_at(Dyadic(0.75));
  }
  EXPECT_GE(zero_at_start, 5);
  EXPECT_GE(zero_at_end, 5);
  EXPECT_GE(touching, 3);
}

// Simulates the answers of a wrong kernel.

struct Followed {
  explicit Followed(AnyDegreeMotion<2> beads) : motion(std::move(beads)) {
    certificate.beads = {0, 1, 2, 3};
    StageCounts stages;
    filtered = follow(Kernel::filtered, certificate, *search, stages);
    exact = follow(Kernel::exact, certificate, *search, stages);
  }

  AnyDegreeMotion<2> motion;
  std::unique_ptr<CertificateSearch<PowerTest<2>>> search = search_over<PowerTest<2>>(MotionRef<2>(motion));
  PowerTest<2> certificate;
  std::vector<Answer> filtered, exact;
};

// Returns a case with several failures.
std::unique_ptr<Followed> followed() {
  for (std::size_t number = 0;; ++number) {
    SceneRandom random = scene_random(13, "degree:18", number);
    auto f = std::make_unique<Followed>(extreme("degree:18").make({2, 3, 4}, random).motion<2>());
    if (f->exact.size() > 3) return f;
  }
}

TEST(CompareAnswers, AWrongAnswerIsNoticed) {
  const auto kept = followed();
  const Followed& f = *kept;
  const BothSides<PowerTest<2>> functions(f.certificate, *f.search);
  const FunctionOfSide function = [&](bool opposite) { return *functions.exact_function(opposite ? 1 : 0); };
  EXPECT_EQ(disagreement(f.filtered, f.exact, function), std::nullopt);

  const auto later = std::find_if(f.filtered.begin(), f.filtered.end(), [](const Answer& answer) {
    return answer.failure.kind == Failure::Kind::later;
  });
  const auto place = static_cast<std::size_t>(later - f.filtered.begin());
  std::vector<Answer> wrong = f.filtered;
  wrong[place].failure.time.lower = wrong[place].failure.time.upper;  // a double next to the root
  EXPECT_THAT(disagreement(wrong, f.exact, function).value_or(""), HasSubstr("filtered later"));
  wrong = f.filtered;
  wrong[place].failure.kind = Failure::Kind::never;
  EXPECT_THAT(disagreement(wrong, f.exact, function).value_or(""), HasSubstr("filtered never"));
  wrong = f.filtered;
  wrong.pop_back();
  EXPECT_THAT(disagreement(wrong, f.exact, function).value_or(""), HasSubstr("answers"));
  wrong = f.filtered;
  wrong[place].failure.time = wrong[place + 1].failure.time;  // another root of the same function
  EXPECT_NE(disagreement(wrong, f.exact, function), std::nullopt);
}

TEST(StabilityRow, HoldsOnlyWithoutTrouble) {
  StabilityRow row;
  row.cases = 3;
  EXPECT_TRUE(row.holds());
  row.must_refuse = true;
  EXPECT_FALSE(row.holds());
  row.refused = 3;
  EXPECT_TRUE(row.holds());
  for (auto member : {&StabilityRow::disagreements, &StabilityRow::failed, &StabilityRow::audits_failed}) {
    StabilityRow wrong = row;
    wrong.*member = 1;
    EXPECT_FALSE(wrong.holds());
  }
}

// Tests of rows.

TEST(Stability, EverySubjectHoldsInAFewCasesOfEveryExtreme) {
  std::set<std::string> subjects, extremes;
  std::uint64_t audits = 0, events = 0;
#ifdef KDS_SANITIZED  // all subjects in a few extremes, and all extremes of two subjects
  std::vector<StabilityRow> rows =
      rows_of({"--extremes", "ties:middle,contact", "--cases", "1", "--seed", "9"});
  const std::vector<StabilityRow> others =
      rows_of({"--subjects", "power_test,wrapped", "--cases", "1", "--seed", "9"});
  rows.insert(rows.end(), others.begin(), others.end());
#else
  const std::vector<StabilityRow> rows = rows_of({"--cases", "3", "--seed", "9"});
#endif
  for (const StabilityRow& row : rows) {
    EXPECT_TRUE(row.holds()) << name_of(row) << ": " << row.reason << "\n" << row.motion;
    EXPECT_GE(row.cases, 1U);
    subjects.insert(row.subject);
    extremes.insert(row.extreme);
    audits += row.audits_run;
    events += row.events;
    EXPECT_TRUE(!row.must_refuse || row.refused == row.cases) << name_of(row);
  }
  EXPECT_EQ(extremes.size(), all_extremes().size());
  for (const char* name : {"precedes", "orientation", "power_test", "bead_in_sphere_1", "bead_in_sphere_2",
                           "bead_in_sphere_3", "contact", "ball_in_sphere_1", "ball_in_sphere_2",
                           "ball_in_sphere_3", "ball_in_sphere_4", "sorted", "wrapped", "power"})
    EXPECT_TRUE(subjects.contains(name)) << name;
  EXPECT_GT(audits, test::rounds(1000U));
  EXPECT_GT(events, test::rounds(1000U));
}

TEST(Stability, OneBeadInSphereHasDegree18) {
  const auto rows = rows_of({"--subjects", "bead_in_sphere_3", "--extremes", "degree", "--cases", "9"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].function_degree, 18);
  EXPECT_GT(rows[0].events, 0U);
}

TEST(Stability, BallsAreGivenRadiiWhereAnExtremeHasNone) {
  std::set<bool> equal, changing;
  for (std::size_t number = 0; number < 30; ++number) {
    SceneRandom random = scene_random(17, "offset:2^20", number);
    BeadCurves curves = extreme("offset:2^20").make({3, 1, 4}, random);
    give_radii(curves, random);
    bool same = true, constant = true;
    for (std::size_t b = 0; b < 4; ++b) {
      same &= curves.radius(b, 0) == curves.radius(0, 0) && curves.radius(b, 1) == curves.radius(0, 1);
      constant &= curves.radius(b, 0) == curves.radius(b, 1);
      EXPECT_GE(curves.radius(b, 1), 0);
      EXPECT_LE(curves.radius(b, 1), 8);
    }
    equal.insert(same);
    changing.insert(!constant);
  }
  EXPECT_EQ(equal.size() + changing.size(), 4U);
  SceneRandom random = scene_random(17, "radii:10^3", 0);
  BeadCurves curves = extreme("radii:10^3").make({3, 1, 4}, random);
  const double radius = curves.radius(2, 1);
  give_radii(curves, random);
  EXPECT_EQ(curves.radius(2, 1), radius);
}

TEST(Stability, BallsTouchAndCrossSpheres) {
  for (const StabilityRow& row :
       rows_of({"--subjects", "ball_in_sphere_1,contact", "--extremes", "contact", "--cases", "100"})) {
    EXPECT_TRUE(row.holds()) << name_of(row) << ": " << row.reason;
    EXPECT_GT(row.stages.exact, 0U) << name_of(row);  // doubles cannot prove a touch
  }
}

TEST(Stability, NoScaleIsLeftToIntegersWhereDifferencesAreFinite) {
  StageCounts sum;
  for (const StabilityRow& row :
       rows_of({"--subjects", "power_test", "--extremes", "scale:2^300,scale:2^-300", "--cases", "40"}))
    sum += row.stages;
  EXPECT_GT(sum.refined, sum.exact);
}

TEST(Stability, TheSameSeedGivesTheSameRowsWhateverElseRuns) {
  const auto figures = [](const StabilityRow& row) {
    return std::tuple(row.events, row.signs, row.stages.exact);
  };
  const auto alone = rows_of({"--subjects", "orientation", "--extremes", "ties:end", "--cases", "20"});
  const auto among = rows_of({"--subjects", "precedes,orientation", "--extremes", "ties", "--cases", "20"});
  std::size_t found = 0;
  for (const StabilityRow& a : alone) {
    for (const StabilityRow& b : among) {
      if (name_of(a) != name_of(b)) continue;
      EXPECT_EQ(figures(a), figures(b));
      ++found;
    }
  }
  EXPECT_EQ(found, alone.size());
}

// Tests of options.

TEST(StabilityOptions, Defaults) {
  const StabilityOptions options = parse_stability_options({});
  EXPECT_TRUE(options.subjects.empty() && options.extremes.empty());
  EXPECT_EQ(options.cases.cases, 200U);
  EXPECT_EQ(options.cases.seed, 1U);
  EXPECT_FALSE(options.out || options.json || options.quiet);
}

TEST(StabilityOptions, TakesNamesAndFamilies) {
  const StabilityOptions options =
      parse_stability_options({"--subjects", "power,precedes", "--extremes", "scale,ties:end", "--quiet"});
  EXPECT_THAT(options.subjects, ElementsAre("power", "precedes"));
  EXPECT_TRUE(options.wants(extreme("scale:2^300")));
  EXPECT_TRUE(options.wants(extreme("ties:end")));
  EXPECT_FALSE(options.wants(extreme("ties:start")));
  EXPECT_TRUE(options.quiet);
}

// Tests of reports.

StabilityRow failing_row() {
  StabilityRow row;
  row.subject = "power_test";
  row.dimension = 3;
  row.degree = 1;
  row.function_degree = 5;
  row.extreme = "ties:end";
  row.cases = 7;
  row.disagreements = 1;
  row.reason = "case 4: answer 0: filtered never, exact later";
  row.motion = "1 1 1\n0 1\n";
  return row;
}

TEST(StabilityReport, NamesRowsThatDoNotHold) {
  const std::vector<StabilityRow> rows{failing_row()};
  const Json row = Json::parse(text_of(stability_columns().json(rows)))[0];
  EXPECT_EQ(row["holds"], false);
  EXPECT_EQ(row["agree"], 6);
  EXPECT_EQ(row["motion"], "1 1 1\n0 1\n");
  EXPECT_THAT(stability_columns().csv(rows), HasSubstr("power_test,certificate,3,1,5,ties:end,7,"));
  EXPECT_EQ(complaint_about(rows), "1 of 1 rows do not hold: power_test 3D degree 1, ties:end");
  EXPECT_EQ(complaint_about({}), std::nullopt);
}

TEST(StabilityReport, TheTableIsNoWiderThanATerminal) {
  const auto rows = rows_of({"--extremes", "ties:middle,refused,beads:cospherical-mid", "--cases", "2"});
  for (const std::string& line : stability_columns().lines(rows)) EXPECT_LE(line.size(), 120U) << line;
}

// Tests of the program as a process.

namespace outside {

using test::run_program;
using test::ScratchDirectory;

TEST(StabilityProgram, WritesRowsToFiles) {
  const ScratchDirectory directory;
  const std::string out = (directory / "made" / "here").string();
  const std::string file = (directory / "rows.json").string();
  const auto run = run_program({"stability", "--cases", "2", "--subjects", "orientation,power", "--extremes",
                                "offset,refused", "--out", out, "--json", file, "--quiet"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.out + run.err, "");
  const std::string text = test::content_of(file);
  EXPECT_EQ(test::content_of(std::filesystem::path(out) / "stability.json"), text);
  const Json json = Json::parse(text);
  EXPECT_EQ(
      json["settings"],
      (Json{{"subjects", "orientation,power"}, {"extremes", "offset,refused"}, {"cases", 2}, {"seed", 1}}));
  EXPECT_TRUE(json["version"].is_string());
  EXPECT_TRUE(json["machine"]["cpu"].is_string());
  EXPECT_EQ(json["holds"], true);
  // Two subjects with two dimensions and two degrees each; three offsets and two refused extremes.
  EXPECT_EQ(json["rows"].size(), 8U * 5U);
  for (const Json& row : json["rows"]) {
    for (const char* key :
         {"subject", "kind", "dimension", "degree", "function_degree", "extreme", "cases", "agree",
          "disagreements", "refused", "failed", "stages_exact", "audits_run", "rebuilds", "holds"})
      EXPECT_TRUE(row.contains(key)) << key;
    for (const char* key : {"seconds_filtered", "seconds_exact"}) EXPECT_TRUE(row[key].is_number());
    if (row["extreme"] == "refused:nan") {
      EXPECT_THAT(row["reason"].get<std::string>(), HasSubstr("nan"));
    }
  }
  const auto lines = split(test::content_of(std::filesystem::path(out) / "stability.csv"), '\n');
  EXPECT_EQ(lines.size(), json["rows"].size() + 2);  // the header, and the empty text after the last newline
  for (std::size_t i = 1; i + 1 < lines.size(); ++i)
    EXPECT_EQ(split(lines[i], ',').size(), split(lines[0], ',').size());
}

}  // namespace outside

}  // namespace
}  // namespace kds::stability_test
