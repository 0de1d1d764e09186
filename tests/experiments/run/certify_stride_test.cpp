#include "experiments/run/certify_stride.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "experiments/run/load_scene.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_scene.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::certify_stride_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string kDcd = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kPdb = data_file("trajectories/villin_hp36_300K.pdb");

Arguments arguments_with(const std::string& frames, std::vector<std::string> more) {
  Arguments arguments{kDcd,  "--topology", kPdb, "--structures", "contacts", "--radius",
                      "1.9", "--apart",    "5",  "--frames",     frames};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

struct Pairs final : EventListener {
  PairsMet met;
  void on_event(const Event& event) override { met.emplace(event.change.ids[0], event.change.ids[1]); }
};

/// Finds the true pairs by a run of all frames.
PairsMet pairs_in_truth(const RunOptions& options) {
  const Scene scene = load_scene(options, [](const std::string&) {});
  const auto run = open_run(options, scene, AuditMode::none);
  Pairs pairs;
  run->listen(pairs);
  run_steps(*run, options, [&](std::size_t frame) {
    if (frame != 0) return;
    for (const Event& event : run->built(0)) pairs.on_event(event);
  });
  return pairs.met;
}

bool is_among(const PairsMet& some, const PairsMet& all) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(CertifyStride, SureContactsAreThereAndNoOthersThanPossibleOnes) {
  for (const auto& [stride, motion] : {std::pair("2", "linear"), std::pair("4", "linear"),
                                       std::pair("16", "linear"), std::pair("4", "hermite")}) {
    SCOPED_TRACE(std::string(stride) + " " + motion);
    const RunOptions options =
        parse_run_options(arguments_with(std::string("0:161:") + stride, {"--certify", "--motion", motion}));
    const Scene scene = load_scene(options, [](const std::string&) {});
    const StrideCertificate certificate = certify_stride(options, scene);
    ASSERT_TRUE(certificate.contacts);
    const auto& [found, sure, possible] = *certificate.contacts;
    const PairsMet truth = pairs_in_truth(parse_run_options(arguments_with("0:161", {})));
    EXPECT_TRUE(is_among(sure, truth));
    EXPECT_TRUE(is_among(truth, possible));
    EXPECT_TRUE(is_among(sure, found));
    EXPECT_TRUE(is_among(found, possible));
    EXPECT_FALSE(truth.empty());
    EXPECT_GT(certificate.deviation.largest, 0.1);
    EXPECT_LT(certificate.deviation.frame, 161U);
  }
}

// Certificates for straightened motion within a tolerance, with and without a stride.
TEST(CertifyStride, BoundsWhatAToleranceMayMiss) {
  for (const auto& [stride, tolerance] :
       {std::pair("1", "0.1"), std::pair("1", "0.2r"), std::pair("2", "0.4")}) {
    SCOPED_TRACE(std::string(stride) + " " + tolerance);
    const RunOptions options = parse_run_options(
        arguments_with(std::string("0:161:") + stride, {"--certify", "--tolerance", tolerance}));
    const Scene scene = load_scene(options, [](const std::string&) {});
    const StrideCertificate certificate = certify_stride(options, scene);
    const auto& [found, sure, possible] = *certificate.contacts;
    const PairsMet truth = pairs_in_truth(parse_run_options(arguments_with("0:161", {})));
    EXPECT_TRUE(is_among(sure, truth));
    EXPECT_TRUE(is_among(truth, possible));
    EXPECT_TRUE(is_among(sure, found));
    EXPECT_TRUE(is_among(found, possible));
    if (options.reading.frames.stride == 1) {
      const double most = options.tolerance->length(scene.radii());
      EXPECT_NEAR(most, std::string(tolerance) == "0.1" ? 0.1 : 0.38, 1e-12);
      EXPECT_LE(certificate.deviation.largest, most);
      EXPECT_GT(certificate.deviation.largest, 0.9 * most);
    }
  }
}

// If positions are rounded by more than the resolution of the deviations, the tolerance itself is the bound.
TEST(CertifyStride, IsNeverAboveTheToleranceFarFromTheOrigin) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> step(-1, 1);
  for (const auto& [far, unit] :
       {std::pair(0.0, 1.0), std::pair(1e9, 1.0), std::pair(1e12, 1.0), std::pair(1e307, 1e292)}) {
    SCOPED_TRACE(far);
    const ScratchDirectory directory;
    constexpr std::size_t beads = 12;
    std::vector<double> place(3 * beads);
    for (std::size_t k = 0; k < place.size(); ++k) place[k] = far + 3 * unit * step(random);
    std::string frames;
    for (int frame = 0; frame < 40; ++frame) {
      frames += fmt::format("{}\nframe\n", beads);
      for (std::size_t b = 0; b < beads; ++b)
        frames += fmt::format("C {} {} {}\n", place[3 * b], place[3 * b + 1], place[3 * b + 2]);
      for (double& x : place) x += 0.2 * unit * step(random);
    }
    Arguments arguments{directory.file("far.xyz", frames), "--structures", "contacts", "--radius", "1"};
    const PairsMet truth = pairs_in_truth(parse_run_options(arguments));
    arguments.insert(arguments.end(), {"--tolerance", "0.2", "--certify"});
    const RunOptions options = parse_run_options(arguments);
    const Scene scene = load_scene(options, [](const std::string&) {});
    const StrideCertificate certificate = certify_stride(options, scene);
    EXPECT_LE(certificate.deviation.largest, 0.2);
    const auto& [found, sure, possible] = *certificate.contacts;
    EXPECT_TRUE(is_among(sure, truth));
    EXPECT_TRUE(is_among(truth, possible));
    EXPECT_TRUE(is_among(sure, found));
    EXPECT_TRUE(is_among(found, possible));
    EXPECT_EQ(sure.empty(), far == 1e307);
  }
}

TEST(MotionTolerance, MakesEventsFewer) {
  const auto events = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"run",           kDcd,       "--topology", kPdb,      "--structures",
                                       "wrapped,power", "--frames", "0:33",       "--audit", "frames",
                                       "--json",        "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    const Json summary = Json::parse(run.out);
    EXPECT_EQ(summary["settings"]["tolerance"], more.empty() ? "" : more[1]);
    return std::pair(summary["structures"]["wrapped"]["events"]["total"].get<int>(),
                     summary["structures"]["power"]["events"]["total"].get<int>());
  };
  const auto [wrapped, power] = events({});
  const auto [fewer_wrapped, fewer_power] = events({"--tolerance", "0.3r"});
  EXPECT_LT(fewer_wrapped * 4, wrapped * 3);
  EXPECT_LT(fewer_power * 3, power * 2);
}

TEST(CertifyStride, IsReported) {
  Arguments arguments = arguments_with("0:41:4", {"--certify", "--json", "-"});
  arguments.insert(arguments.begin(), "run");
  const ProgramRun run = run_program(arguments);
  ASSERT_EQ(run.code, 0) << run.err;
  const Json summary = Json::parse(run.out);
  EXPECT_EQ(summary["settings"]["certify"], "yes");
  const Json& stride = summary["stride"];
  EXPECT_EQ(stride["skipped"], 30);
  EXPECT_GT(stride["deviation"]["largest"], 0.1);
  EXPECT_LE(stride["contacts"]["sure"], stride["contacts"]["found"]);
  EXPECT_LE(stride["contacts"]["found"], stride["contacts"]["possible"]);
  arguments.resize(arguments.size() - 2);
  const ProgramRun shown = run_program(arguments);
  EXPECT_THAT(shown.out, HasSubstr("30 frames left out, in which beads are at most"));
  EXPECT_THAT(shown.out, HasSubstr("of them sure"));
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::vector<std::string> lines;
  std::istringstream text(content_of(path));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Reads contacts from a table of --out: the pair, and begin and end in frames.
struct Listed {
  std::string pair;
  double begin = 0, end = HUGE_VAL;
  bool flag = false;  ///< sure, or found
};
std::vector<Listed> listed_in(const std::filesystem::path& path) {
  std::vector<Listed> contacts;
  std::map<std::string, std::size_t> open;
  const std::vector<std::string> lines = lines_of(path);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    std::vector<std::string> cells;
    std::istringstream line(lines[k]);
    for (std::string cell; std::getline(line, cell, ',');) cells.push_back(cell);
    const std::string pair = cells[1] + " " + cells[2];
    const double frame = std::stod(cells[5]);
    const bool flag = cells.back() == "sure" || cells.back() == "yes";
    if (cells[0] == "end") {
      contacts[open.at(pair)].end = frame;
      EXPECT_EQ(contacts[open.at(pair)].flag, flag);
      continue;
    }
    open[pair] = contacts.size();
    contacts.push_back({pair, frame, cells[0] == "touch" ? frame : HUGE_VAL, flag});
  }
  return contacts;
}
bool meet(const Listed& a, const Listed& b) {
  return a.pair == b.pair && a.begin <= b.end + 1e-9 && b.begin <= a.end + 1e-9;
}

// The run of all frames has the true contacts. Each sure contact overlaps a true one in time. Each true
// contact overlaps one that is found or listed as possible.
TEST(CertifyStride, ListsWhichContactsAreSureAndWhichThereMayBe) {
  const ScratchDirectory scratch;
  const auto listed = [&](const std::string& name, const std::string& frames, std::vector<std::string> more) {
    Arguments arguments = arguments_with(frames, std::move(more));
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--quiet", "--out", scratch / name, "--replace"});
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return listed_in(scratch / (name + "/contacts.csv"));
  };
  const std::vector<Listed> truth = listed("truth", "0:81", {});
  for (const auto& [frames, more] : {std::pair("0:81:4", std::vector<std::string>{}),
                                     std::pair("0:81", std::vector<std::string>{"--tolerance", "0.03"})}) {
    SCOPED_TRACE(frames);
    std::vector<std::string> certified = more;
    certified.emplace_back("--certify");
    const std::vector<Listed> found = listed("run", frames, certified);
    const std::vector<Listed> possible = listed_in(scratch / "run/possible_contacts.csv");
    const auto meets_any = [](const Listed& contact, const std::vector<Listed>& all) {
      return std::any_of(all.begin(), all.end(), [&](const Listed& other) { return meet(contact, other); });
    };
    std::size_t sure = 0, not_found = 0;
    for (const Listed& contact : found) {
      sure += contact.flag ? 1 : 0;
      EXPECT_TRUE(!contact.flag || meets_any(contact, truth)) << contact.pair;
    }
    for (const Listed& contact : truth) {
      const bool within = std::any_of(possible.begin(), possible.end(), [&](const Listed& other) {
        return contact.pair == other.pair && other.begin <= contact.begin + 1e-9 &&
               contact.end <= other.end + 1e-9;
      });
      EXPECT_TRUE(within || contact.end == HUGE_VAL) << contact.pair;
      EXPECT_TRUE(meets_any(contact, possible)) << contact.pair;
    }
    for (const Listed& contact : possible) {
      not_found += contact.flag ? 0 : 1;
      EXPECT_EQ(contact.flag, meets_any(contact, found)) << contact.pair;
    }
    // Deviations are larger than the overlaps of contacts.
    EXPECT_EQ(sure == 0, frames == std::string("0:81:4"));
    EXPECT_LT(sure, found.size());
    EXPECT_GT(not_found, 0U);
    // Apart from the new column, the table equals the table of an ordinary run.
    std::vector<std::string> with = lines_of(scratch / "run/contacts.csv");
    for (std::string& line : with) line.resize(line.rfind(','));
    static_cast<void>(listed("run", frames, more));
    EXPECT_EQ(with, lines_of(scratch / "run/contacts.csv"));
    EXPECT_FALSE(std::filesystem::exists(scratch / "run/possible_contacts.csv"));
  }
}

TEST(CertifyStride, ALoggedRunIsCertifiedWhenItIsReplayed) {
  const ScratchDirectory directory;
  const std::string log = (directory / "log").string();
  Arguments arguments = arguments_with("0:41:4", {"--certify", "--log", log, "--json", "-"});
  arguments.insert(arguments.begin(), "run");
  const ProgramRun run = run_program(arguments), replay = run_program({"replay", log, "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  ASSERT_EQ(replay.code, 0) << replay.err;
  const Json first = Json::parse(run.out), again = Json::parse(replay.out);
  EXPECT_EQ(again["settings"], first["settings"]);
  EXPECT_EQ(again["stride"], first["stride"]);
  EXPECT_TRUE(first["stride"].is_object());
}

}  // namespace
}  // namespace kds::test::certify_stride_test
