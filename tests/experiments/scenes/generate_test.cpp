// Tests `kds generate`: its options and the files that it writes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "experiments/scenes/generate_command.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/write_trajectory.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::generate_test {
namespace {

using models::ShapeMotion;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

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
  EXPECT_FALSE(
      parse_generate_options({"helix", "--beads", "9", "--motion", "rest", "-o", "c.xyz"}).settings.step);
}

TEST(GenerateOptions, TakesEveryOption) {
  const GenerateOptions grid = parse_generate_options(
      {"grid",     "--beads",     "64",     "--frames", "3",      "--seed", "18446744073709551615",
       "--motion", "rotate",      "--step", "0.5",      "--bond", "0.9",    "--gap",
       "0.25",     "--dimension", "2",      "--jitter", "0.01",   "-o",     "g.ent",
       "--out",    "there",       "--json", "-",        "--quiet"});
  EXPECT_EQ(grid.settings.seed, ~std::uint64_t{0});
  EXPECT_EQ(grid.settings.motion, ShapeMotion::rotate);
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

}  // namespace
}  // namespace kds::test::generate_test
