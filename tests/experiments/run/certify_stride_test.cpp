#include "experiments/run/certify_stride.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>

#include "experiments/run/load_scene.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_scene.h"
#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::certify_stride_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// Returns the line of a run of these frames.
std::string contacts_of(const std::string& frames, const std::string& more = "") {
  return "VILLIN --structures contacts --radius 1.9 --apart 5 --frames " + frames + " " + more;
}
RunOptions options_of(const std::string& line, const std::filesystem::path& out = {}) {
  return parse_run_options(command_words(line, out));
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

/// Checks the certificate of a run against the run of all frames, and returns it.
StrideCertificate expect_truth_within(const RunOptions& options, const PairsMet& truth) {
  const Scene scene = load_scene(options, [](const std::string&) {});
  const StrideCertificate certificate = certify_stride(options, scene);
  const auto& [found, sure, possible] = *certificate.contacts;
  EXPECT_TRUE(is_among(sure, truth));
  EXPECT_TRUE(is_among(truth, possible));
  EXPECT_TRUE(is_among(sure, found));
  EXPECT_TRUE(is_among(found, possible));
  return certificate;
}

TEST(CertifyStride, SureContactsAreThereAndNoOthersThanPossibleOnes) {
  const PairsMet truth = pairs_in_truth(options_of(contacts_of("0:161")));
  EXPECT_FALSE(truth.empty());
  for (const std::string stride : {"2", "4", "16", "4 --motion hermite"}) {
    SCOPED_TRACE(stride);
    const StrideCertificate certificate =
        expect_truth_within(options_of(contacts_of("0:161:" + stride, "--certify")), truth);
    EXPECT_GT(certificate.deviation.largest, 0.1);
    EXPECT_LT(certificate.deviation.frame, 161U);
  }
}

// Certificates for straightened motion within a tolerance, with and without a stride.
TEST(CertifyStride, BoundsWhatAToleranceMayMiss) {
  const PairsMet truth = pairs_in_truth(options_of(contacts_of("0:161")));
  for (const auto& [tolerance, most] : {std::pair("0:161 --tolerance 0.1", 0.1),
                                        {"0:161 --tolerance 0.2r", 0.38},
                                        {"0:161:2 --tolerance 0.4", 0.0}}) {
    SCOPED_TRACE(tolerance);
    const StrideCertificate certificate =
        expect_truth_within(options_of(contacts_of(tolerance, "--certify")), truth);
    if (most == 0) continue;
    EXPECT_LE(certificate.deviation.largest, most);
    EXPECT_GT(certificate.deviation.largest, 0.9 * most);
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
    directory.file("far.xyz", frames);
    const std::string line = "OUT/far.xyz --structures contacts --radius 1";
    const PairsMet truth = pairs_in_truth(options_of(line, directory.path()));
    const StrideCertificate certificate =
        expect_truth_within(options_of(line + " --tolerance 0.2 --certify", directory.path()), truth);
    EXPECT_LE(certificate.deviation.largest, 0.2);
    EXPECT_EQ(certificate.contacts->sure.empty(), far == 1e307);
  }
}

TEST(MotionTolerance, MakesEventsFewer) {
  const std::string line = "run VILLIN --structures wrapped,power --frames 0:33 --audit frames";
  const Json all = run_json(line), fewer = run_json(line + " --tolerance 0.3r");
  EXPECT_EQ(fewer["settings"]["tolerance"], "0.3r");
  const auto events = [](const Json& run, const char* structure) {
    return run["structures"][structure]["events"]["total"].get<int>();
  };
  EXPECT_LT(events(fewer, "wrapped") * 4, events(all, "wrapped") * 3);
  EXPECT_LT(events(fewer, "power") * 3, events(all, "power") * 2);
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
  const auto listed = [&](const std::string& name, const std::string& more) {
    run_line("run " + contacts_of(more, "--quiet --replace --out OUT/" + name), scratch.path());
    return listed_in(scratch / (name + "/contacts.csv"));
  };
  const std::vector<Listed> truth = listed("truth", "0:81");
  for (const std::string run : {"0:81:4", "0:81 --tolerance 0.03"}) {
    SCOPED_TRACE(run);
    const std::vector<Listed> found = listed("run", run + " --certify");
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
    EXPECT_EQ(sure == 0, run == "0:81:4");
    EXPECT_LT(sure, found.size());
    EXPECT_GT(not_found, 0U);
    // Apart from the new column, the table equals the table of an ordinary run.
    std::vector<std::string> with = lines_of(scratch / "run/contacts.csv");
    for (std::string& line : with) line.resize(line.rfind(','));
    static_cast<void>(listed("run", run));
    EXPECT_EQ(with, lines_of(scratch / "run/contacts.csv"));
    EXPECT_FALSE(std::filesystem::exists(scratch / "run/possible_contacts.csv"));
  }
}

TEST(CertifyStride, ALoggedRunIsCertifiedWhenItIsReplayed) {
  const ScratchDirectory directory;
  const Json first = run_json("run " + contacts_of("0:41:4", "--certify --log OUT/log"), directory.path()),
             again = run_json("replay OUT/log", directory.path());
  EXPECT_EQ(again["settings"], first["settings"]);
  EXPECT_EQ(again["stride"], first["stride"]);
  EXPECT_EQ(first["settings"]["certify"], "yes");
  const Json& stride = first["stride"];
  EXPECT_EQ(stride["skipped"], 30);
  EXPECT_GT(stride["deviation"]["largest"], 0.1);
  EXPECT_LE(stride["contacts"]["sure"], stride["contacts"]["found"]);
  EXPECT_LE(stride["contacts"]["found"], stride["contacts"]["possible"]);
}

}  // namespace
}  // namespace kds::test::certify_stride_test
