// Tests `kds generate`: its options and the files that it writes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "experiments/scenes/generate_command.h"
#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/write_trajectory.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::generate_test {
namespace {

using models::ShapeMotion;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

std::string refusal(Arguments arguments) {
  try {
    static_cast<void>(parse_generate_options(arguments));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const std::string& model, const std::string& option, const std::string& value) {
  return refusal({model, "--beads", "10", "-o", "a.xyz", option, value});
}

TEST(GenerateOptions, DefaultsAreTheModels) {
  const GenerateOptions options = parse_generate_options({"random-chain", "--beads", "100", "-o", "c.xyz"});
  EXPECT_EQ(options.model->name, "random-chain");
  EXPECT_EQ(options.settings.beads, 100U);
  EXPECT_EQ(options.settings.frames, 50U);
  EXPECT_EQ(options.settings.seed, 1U);
  EXPECT_EQ(options.settings.motion, ShapeMotion::wander);
  EXPECT_EQ(options.settings.step, 0.1);
  EXPECT_EQ(options.settings.fill, 0.2);
  EXPECT_EQ(options.file, "c.xyz");
  EXPECT_FALSE(options.is_pdb() || options.out || options.json || options.quiet);
  EXPECT_EQ(parse_generate_options({"helix", "--beads", "9", "-o", "c.PDB"}).settings.motion,
            ShapeMotion::rotate);
  EXPECT_TRUE(parse_generate_options({"helix", "--beads", "9", "-o", "c.PDB"}).is_pdb());
}

TEST(GenerateOptions, TakesEveryOption) {
  const GenerateOptions grid = parse_generate_options(
      {"grid",     "--beads",     "64",     "--frames", "3",      "--seed", "18446744073709551615",
       "--motion", "rest",        "--step", "0.5",      "--bond", "0.9",    "--gap",
       "0.25",     "--dimension", "2",      "--jitter", "0.01",   "-o",     "g.ent",
       "--out",    "there",       "--json", "-",        "--quiet"});
  EXPECT_EQ(grid.settings.seed, ~std::uint64_t{0});
  EXPECT_EQ(grid.settings.motion, ShapeMotion::rest);
  EXPECT_EQ(grid.settings.gap, 0.25);
  EXPECT_EQ(grid.settings.dimension, 2);
  EXPECT_EQ(grid.settings.jitter, 0.01);
  EXPECT_EQ(grid.out, "there");
  EXPECT_EQ(grid.json, "-");
  EXPECT_TRUE(grid.quiet);
  const GenerateOptions spirals =
      parse_generate_options({"two-spirals", "--beads", "64", "--turns", "3", "--rolled", "0.25:1",
                              "--distance", "2", "-o", "g.xyz"});
  EXPECT_EQ(spirals.settings.turns, 3);
  EXPECT_EQ(spirals.settings.rolled->first, 0.25);
  EXPECT_EQ(spirals.settings.rolled->last, 1);
  EXPECT_EQ(spirals.settings.distance->first, 2);
  EXPECT_EQ(spirals.settings.distance->last, 2);
  EXPECT_EQ(parse_generate_options({"scaling-helix", "--beads", "64", "--pitch", "3", "-o", "g.xyz"})
                .settings.pitch,
            3);
}

TEST(GenerateOptions, WhatItTellsGivesTheSameAgain) {
  for (const models::Model& model : models::all_models()) {
    const GenerateOptions options =
        parse_generate_options({std::string(model.name), "--beads", "30", "--seed", "5", "-o", "a.xyz"});
    Arguments again{std::string(model.name), "-o", "a.xyz"};
    for (const auto& [name, value] : model_settings(options)) {
      again.push_back("--" + name);
      again.push_back(value);
    }
    EXPECT_EQ(model_settings(parse_generate_options(again)), model_settings(options)) << model.name;
    EXPECT_GE(again.size(), 3 + 2 * 4U);
  }
}

TEST(GenerateOptions, RefusesWithTheOptionAndWhatItTakes) {
  EXPECT_THAT(refusal({}), HasSubstr("one MODEL, one of spline"));
  EXPECT_THAT(refusal({"helix", "grill", "--beads", "9", "-o", "a.xyz"}), HasSubstr("one MODEL"));
  EXPECT_THAT(refusal({"snake", "--beads", "9", "-o", "a.xyz"}), HasSubstr("'snake' is not one of spline"));
  EXPECT_THAT(refusal({"helix", "-o", "a.xyz"}), HasSubstr("--beads"));
  EXPECT_THAT(refusal({"helix", "--beads", "9"}), HasSubstr("-o"));
  EXPECT_THAT(refusal({"helix", "--beads", "9", "-o"}), HasSubstr("-o needs a value"));
  EXPECT_THAT(refusal({"helix", "--beads", "9", "-o", "-"}), HasSubstr("-o needs a path"));
  EXPECT_THAT(refusal({"helix", "--beads", "9", "-o", "a.dcd"}), HasSubstr("expected .xyz, .pdb or .ent"));
  EXPECT_THAT(refusal({"helix", "--beads", "1", "-o", "a.xyz"}), HasSubstr("--beads: '1'"));
  EXPECT_THAT(refusal({"helix", "--beads", "-3", "-o", "a.xyz"}), HasSubstr("--beads: '-3'"));
  EXPECT_THAT(refusal({"helix", "--beads", "10000000", "-o", "a.xyz"}), HasSubstr("positions"));
  EXPECT_THAT(refusal("helix", "--frames", "0"), HasSubstr("--frames: '0'"));
  EXPECT_THAT(refusal("helix", "--seed", "1.5"), HasSubstr("--seed: '1.5'"));
  EXPECT_THAT(refusal("helix", "--motion", "fly"), HasSubstr("rest, rotate, wander"));
  EXPECT_THAT(refusal("helix", "--step", "-0.1"), HasSubstr("--step: '-0.1'"));
  EXPECT_THAT(refusal("helix", "--step", "nan"), HasSubstr("--step: 'nan'"));
  EXPECT_THAT(refusal("random-chain", "--step", "2.5"), HasSubstr("at most 2"));
  EXPECT_THAT(refusal("helix", "--bond", "0.5"), HasSubstr("--bond: '0.5' is not a number above 0.5"));
  EXPECT_THAT(refusal("helix", "--bond", "1.01"), HasSubstr("--bond"));
  EXPECT_THAT(refusal("scaling-helix", "--pitch", "0"), HasSubstr("--pitch"));
  EXPECT_THAT(refusal("grid", "--dimension", "4"), HasSubstr("--dimension"));
  EXPECT_THAT(refusal("random-chain", "--fill", "0.9"), HasSubstr("--fill"));
  EXPECT_THAT(refusal("spiral", "--rolled", "0:1:0"), HasSubstr("FROM:TO"));
  EXPECT_THAT(refusal("spiral", "--rolled", "0:"), HasSubstr("--rolled: ''"));
  EXPECT_THAT(refusal("spiral", "--rolled", "0:1.5"), HasSubstr("--rolled: '1.5'"));
  EXPECT_THAT(refusal("spiral", "--distance", "1"),
              HasSubstr("--distance: has no meaning for the model spiral"));
  EXPECT_THAT(refusal("spiral", "--step", "1"), HasSubstr("--step: has no meaning for the model spiral"));
  EXPECT_THAT(refusal("grill", "--turns", "1"), HasSubstr("--turns: has no meaning for the model grill"));
}

// --help states how many beads the bends of a grill or a spline need.
TEST(Generate, ShortGrillsAndSplinesMeet) {
  const ScratchDirectory directory;
  const auto is_proper = [&](const std::string& model, std::size_t beads) {
    const ProgramRun run = run_program({"generate", model, "--beads", std::to_string(beads), "--frames", "2",
                                        "-o", (directory / "g.xyz").string(), "--json", "-", "--quiet"});
    return Json::parse(run.out)["proper"].get<bool>();
  };
#ifdef KDS_SANITIZED  // each case starts a process
  const std::vector<std::size_t> counts{2, 3, 6, 7, 8, 39, 40, 41, 43, 44, 89};
#else
  std::vector<std::size_t> counts(88);
  std::iota(counts.begin(), counts.end(), 2);
#endif
  for (const std::size_t beads : counts) {
    EXPECT_EQ(is_proper("grill", beads), beads == 2 || beads == 40 || beads >= 44) << beads;
    EXPECT_EQ(is_proper("spline", beads), beads != 7) << beads;
  }
}

TEST(Generate, WritesWhatTheModelIs) {
  const ScratchDirectory directory;
  const std::string file = (directory / "chain.xyz").string(), json = (directory / "chain.json").string();
  const ProgramRun run = run_program({"generate", "random-chain", "--beads", "200", "--frames", "4", "--seed",
                                      "3", "-o", file, "--json", json});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("random-chain, beads 200, frames 4, seed 3, motion wander"));
  models::Settings settings;
  settings.beads = 200;
  settings.frames = 4;
  settings.seed = 3;
  EXPECT_EQ(read_trajectory(file).frames,
            models::generate(*models::find_model("random-chain"), settings)[0].frames);
  const Json summary = Json::parse(content_of(json));
  EXPECT_EQ(summary["model"], "random-chain");
  EXPECT_EQ(summary["settings"]["seed"], "3");
  EXPECT_EQ(std::string(summary["command"]).rfind("kds generate random-chain", 0), 0U);
  EXPECT_EQ(summary["input"]["beads"], 200);
  EXPECT_EQ(summary["input"]["radius_max"], 1.0);
  EXPECT_EQ(summary["proper"], true);
  EXPECT_EQ(directory.entries(), 2U);
}

TEST(Generate, TellsThatANecklaceIsNotProper) {
  const ScratchDirectory directory;
  const ProgramRun run = run_program({"generate", "spiral", "--beads", "300", "--turns", "7", "--frames", "3",
                                      "-o", (directory / "s.xyz").string(), "--json", "-"});
  EXPECT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(run.out);
  EXPECT_EQ(summary["proper"], false);
  EXPECT_EQ(summary["rows"][1]["condition"], "disjoint");
  EXPECT_EQ(summary["rows"][1]["first_frame"], 2);
  EXPECT_EQ(summary["rows"][1]["frames"], 1);
  EXPECT_GT(summary["rows"][1]["violations"], 10);
}

TEST(Generate, RunReadsWhatItWrote) {
  const ScratchDirectory directory;
  for (const char* ending : {".xyz", ".pdb"}) {
    for (const models::Model& model : models::all_models()) {
      const std::string stem = (directory / std::string(model.name)).string();
      const ProgramRun made = run_program({"generate", std::string(model.name), "--beads", "64", "--frames",
                                           "3", "-o", stem + ending, "--quiet"});
      EXPECT_EQ(made.code, 0) << made.err;
      EXPECT_EQ(made.out + made.err, "");
      std::vector<std::string> arguments{"run", "--structures", "wrapped", "--radius",
                                         "1",   "--json",       "-",       stem + ending};
      if (model.name == "two-spirals") {
        arguments.back() = stem + "-1" + ending;
        arguments.push_back(stem + "-2" + ending);
      }
      const ProgramRun run = run_program(arguments);
      ASSERT_EQ(run.code, 0) << run.err;
      EXPECT_EQ(run.err, "");
      const Json report = Json::parse(run.out);
      EXPECT_EQ(report["input"]["beads"], model.name == "two-spirals" ? 128 : 64);
      EXPECT_EQ(report["input"]["frames"], 3);
    }
  }
}

TEST(Generate, LeavesNothingWhereItRefuses) {
  const ScratchDirectory directory;
  const std::string pdb = (directory / "big.pdb").string(), xyz = (directory / "x.xyz").string();
  const auto expect_refused = [&](const std::vector<std::string>& arguments, const std::string& word) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr(word));
    EXPECT_EQ(directory.entries(), 0U);
  };
  expect_refused({"generate", "helix", "--beads", "10000", "--frames", "1", "-o", pdb}, "10000 beads");
  expect_refused({"generate", "spline", "--beads", "9999", "--frames", "1", "-o", pdb},
                 "big.pdb: frame 0, bead");
  expect_refused({"generate", "helix", "--beads", "10", "-o", xyz, "--json", xyz}, "--json");
  expect_refused({"generate", "helix", "--beads", "10", "-o", (directory / "no/x.xyz").string()},
                 "no directory");
  expect_refused({"generate", "grid", "--beads", "10", "--bond", "0.51", "-o", xyz}, "--bond");
}

TEST(Generate, TellsInFilesToo) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string();
  const ProgramRun run = run_program({"generate", "helix", "--beads", "640", "--frames", "2", "-o",
                                      (directory / "h.xyz").string(), "--out", out, "--quiet"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(content_of(directory / "out/generate.json"))["proper"], true);
  EXPECT_THAT(content_of(directory / "out/generate.csv"), HasSubstr("disjoint,0,0,,true\n"));
}

}  // namespace
}  // namespace kds::test::generate_test
