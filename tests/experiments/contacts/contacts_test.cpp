// Tests `kds contacts`: its options, its figures, its files and its page.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <tuple>

#include "experiments/contacts/certify_contacts.h"
#include "experiments/contacts/contacts_command.h"
#include "experiments/contacts/follow_contacts.h"
#include "experiments/run/load_scene.h"
#include "motions/readers/read_trajectory.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/support/judges/second_numbers.h"

namespace kds::test::contacts_command_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ContactsOptions, DefaultsAndAll) {
  const ContactsTask plain = parse_contacts_options({"a.pdb", "--cutoff", "8"}).task;
  EXPECT_THAT(plain.distances.lengths, ElementsAre(8));
  EXPECT_EQ(plain.gap, 0);
  EXPECT_FALSE(plain.distances.between_surfaces || plain.by || plain.apart);
  const ContactsTask all = parse_contacts_options({"a.xyz", "--cutoff", "4.5:6", "--surface", "--apart", "5",
                                                   "--gap", "1.5", "--by", "chain", "--strides", "8,1",
                                                   "--intermittency", "0", "--motion", "hermite"})
                               .task;
  EXPECT_THAT(all.distances.lengths, ElementsAre(4.5, 6));
  EXPECT_TRUE(all.distances.between_surfaces);
  EXPECT_EQ(all.apart, 5U);
  EXPECT_EQ(all.gap, 1.5);
  EXPECT_EQ(all.by, ContactElement::chain);
  EXPECT_THAT(all.strides, ElementsAre(1, 8));
  EXPECT_EQ(all.intermittency, 0U);
  EXPECT_EQ(all.motion, FrameMotion::hermite);
}

// A bead rests. The other is in contact within 2 from 0.25 to 0.75, and from 1.5 on: its places are the
// frames'.
struct Passing {
  ScratchDirectory directory;
  std::string rests = directory.file("rests.xyz", "1\n\nC 0 0 0\n");
  std::string passes =
      directory.file("passes.xyz", "1\n\nC -4 0 0\n1\n\nC 4 0 0\n1\n\nC 0 0 0\n1\n\nC 0 0 0\n");

  ProgramRun run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"contacts", rests, passes, "--cutoff"});
    return run_program(options);
  }
  Json json(std::vector<std::string> options) const {
    options.insert(options.end(), {"--json", "-"});
    const ProgramRun done = run(options);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.code == 0 ? Json::parse(done.out) : Json();
  }
};

TEST(ContactsCommand, FiguresOfAPair) {
  const Json json = Passing().json({"2", "--strides", "1,3"});
  EXPECT_EQ(json["by"], "bead");
  EXPECT_EQ(json["unit"], "frames");
  EXPECT_EQ(json["settings"]["cutoff"], "2");
  ASSERT_EQ(json["rows"].size(), 1U);
  const Json& row = json["rows"][0];
  EXPECT_EQ(row["contacts"], 2);
  EXPECT_EQ(row["total"], 2.0);
  EXPECT_EQ(row["occupancy"], 2 / 3.0);
  EXPECT_EQ(row["longest"], 1.5);
  EXPECT_EQ(row["first_begin_frame"], 0.25);
  EXPECT_EQ(row["last_end_frame"], 3.0);
  EXPECT_EQ(row["open_at_start"], false);
  EXPECT_EQ(row["open_at_end"], true);
  EXPECT_EQ(row["begin_rate"], 2.0);
  EXPECT_EQ(row["end_rate"], 0.5);
  EXPECT_EQ(row["residence"], 2.0);
  EXPECT_NEAR(row["residence_lower"], 2 / 5.571643, 1e-6);  // in R: qchisq(0.975, 4) / 2
  EXPECT_EQ(json["all"]["pairs_asked"], 1);
  EXPECT_EQ(json["all"]["end_rate_upper"], row["end_rate_upper"]);
  const Json& frames = json["frames"];
  ASSERT_EQ(frames.size(), 7U);  // exact, four parts of a frame, two strides
  EXPECT_EQ(frames[0]["spacing"], nullptr);
  EXPECT_EQ(frames[0]["plain_contacts"], 2);
  EXPECT_EQ(frames[5]["spacing"], 1.0);
  EXPECT_EQ(frames[5]["plain_contacts"], 1);
  EXPECT_EQ(frames[5]["plain_length"], 2.0);
  EXPECT_EQ(frames[5]["plain_occupancy"], 0.5);
  EXPECT_EQ(frames[6]["samples"], 2);
  EXPECT_EQ(json["survival"][0]["length"], 0.5);
  EXPECT_EQ(json["survival"][0]["survival"], 0.5);
  EXPECT_EQ(json["all"]["median"], 0.5);
  EXPECT_EQ(json["course"][1]["contacts"], 0.5);
}

TEST(ContactsCommand, GapsAndTwoCutoffs) {
  const Passing passing;
  // The absence is 0.75 frames, and 0.75 picoseconds if frames are 1 ps apart.
  EXPECT_EQ(passing.json({"2", "--gap", "0.75"})["rows"][0]["contacts"], 2);
  EXPECT_EQ(passing.json({"2", "--gap", "0.76"})["rows"][0]["contacts"], 1);
  EXPECT_EQ(passing.json({"2", "--gap", "1", "--dt", "2"})["rows"][0]["contacts"], 2);
  EXPECT_EQ(passing.json({"2", "--gap", "1", "--dt", "1"})["rows"][0]["contacts"], 1);
  EXPECT_EQ(passing.json({"2", "--dt", "2"})["rows"][0]["total"], 4.0);
  EXPECT_EQ(passing.json({"2", "--dt", "2"})["unit"], "ps");
  const Json dual = passing.json({"2:3"});
  EXPECT_EQ(dual["rows"][0]["total"], 2.125);  // from 0.25 to 0.875, and from 1.5 on
  EXPECT_EQ(dual["frames"][0]["dual_contacts"], 2);
  EXPECT_EQ(passing.json({"2:4"})["rows"][0]["contacts"], 1);
  EXPECT_EQ(passing.json({"0.5", "--surface", "--radius", "0.75"})["rows"], passing.json({"2"})["rows"]);
}

// Rates of all pairs divide by the time of all pairs that were asked for: of 4 beads, 0 and 1 meet from 0.5
// to 1.5, and the others never do. Pairs 3 apart, pairs of groups and pairs of chains are fewer.
TEST(ContactsCommand, FiguresOfAllPairsCountThosePairsThatNeverMeet) {
  const ScratchDirectory directory;
  const auto frame = [](int x) {
    return "4\n\nC 0 0 0\nC " + std::to_string(x) + " 0 0\nC 0 50 0\nC 0 99 0\n";
  };
  const std::string path = directory.file("four.xyz", frame(4) + frame(0) + frame(4));
  const auto all = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"contacts", path, "--cutoff", "2", "--json", "-"});
    const ProgramRun run = run_program(options);
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out)["all"];
  };
  const Json six = all({"--apart", "1"});
  EXPECT_EQ(six["pairs"], 1);
  EXPECT_EQ(six["pairs_asked"], 6);
  EXPECT_EQ(six["occupancy"], 1 / 12.0);
  EXPECT_EQ(six["begin_rate"], 1 / 11.0);
  EXPECT_EQ(six["end_rate"], 1.0);
  EXPECT_EQ(all({"--apart", "2"})["pairs_asked"], 3);
  EXPECT_EQ(all({})["pairs_asked"], 1);
  const ProgramRun chains =
      run_program({"contacts", path, path, path, "--cutoff", "2", "--by", "chain", "--json", "-"});
  EXPECT_EQ(Json::parse(chains.out)["all"]["pairs_asked"], 3);
  const ProgramRun text = run_program({"contacts", path, "--cutoff", "2", "--apart", "1"});
  EXPECT_THAT(text.out, HasSubstr("contacts: 1 of 1 pairs; 6 pairs were asked for"));
  EXPECT_THAT(text.out, HasSubstr("survival: of the contacts whose beginning was seen (1); those that are "
                                  "open at the first frame (0)"));
}

// The example of docs/commands.md: the second bead of residue 1 stays within the outer cutoff, and was never
// within the inner one.
TEST(ContactsCommand, TwoCutoffsOfResiduesAreOfTheLeastDistance) {
  const ScratchDirectory directory;
  std::string models;
  for (const char* x : {"8", "0", "8"})
    models += "MODEL\nATOM      1  CA  ALA A   1       " + std::string(x) +
              ".000   0.000   0.000  1.00  0.00           C\n"
              "ATOM      2  CB  ALA A   1       0.000   5.000   0.000  1.00  0.00           C\n"
              "ATOM      3  CA  GLY A   2       0.000   0.000   0.000  1.00  0.00           C\nENDMDL\n";
  const std::string path = directory.file("two.pdb", models + "END\n");
  const auto row = [&](const std::string& by) {
    const ProgramRun run = run_program({"contacts", path, "--select", "all", "--cutoff", "4:6", "--by", by,
                                        "--apart", "1", "--strides", "1", "--json", "-"});
    EXPECT_EQ(run.code, 0) << run.err;
    const Json json = Json::parse(run.out);
    const Json& last = json["rows"].back();
    return std::tuple(last["total"].get<double>(), last["open_at_end"].get<bool>(),
                      json["frames"].back()["dual_contacts"].get<int>(),
                      json["frames"].back()["dual_length"].get<double>());
  };
  EXPECT_EQ(row("residue"), std::tuple(1.5, true, 1, 2.0));  // samples 1 and 2
  EXPECT_EQ(row("bead"), std::tuple(1.25, false, 1, 1.0));
}

// On a lattice many contacts are equally long. They end at one step of the survival function on any number of
// threads, whatever the last digits of their lengths are.
TEST(ContactsCommand, EqualLengthsAreOneStepOfSurvival) {
  const ScratchDirectory directory;
  std::mt19937 random(7);
  std::string frames;
  for (int frame = 0; frame < 3000; ++frame) {
    frames += "7\n\n";
    for (int bead = 0; bead < 7; ++bead)
      frames += "C " + std::to_string(random() % 6) + ' ' + std::to_string(random() % 4) + " 0\n";
  }
  const std::string path = directory.file("lattice.xyz", frames);
  std::vector<Json> survivals;
  for (const char* threads : {"1", "2"}) {
    const std::string out = (directory / threads).string();
    const ProgramRun run = run_program({"contacts", path, "--cutoff", "1:1.5", "--apart", "1", "--gap", "1.5",
                                        "--threads", threads, "--out", out, "--quiet"});
    ASSERT_EQ(run.code, 0) << run.err;
    std::map<double, std::array<double, 2>> ended;  // and censored, by length
    double at_risk = 0, survival = 1;
    std::istringstream lines(content_of(out + "/intervals.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      std::vector<std::string> cells;
      std::istringstream words(line);
      for (std::string word; std::getline(words, word, ',');) cells.push_back(word);
      if (cells[7] == "true") continue;
      const double length = std::stod(cells[6]);
      auto step = ended.lower_bound(length - 1e-9);
      if (step == ended.end() || step->first > length + 1e-9) step = ended.try_emplace(length).first;
      step->second[cells[8] == "true" ? 1 : 0] += 1;
      ++at_risk;
    }
    survivals.push_back(Json::parse(content_of(out + "/contacts.json"))["survival"]);
    auto point = survivals.back().begin();
    ASSERT_GT(survivals.back().size(), 20U);
    for (const auto& [length, counts] : ended) {
      survival *= 1 - counts[0] / at_risk;
      if (point != survivals.back().end() && std::abs((*point)["length"].get<double>() - length) < 1e-9) {
        EXPECT_EQ((*point)["at_risk"], at_risk);
        EXPECT_NEAR((*point)["survival"], survival, 1e-12) << length;
        ++point;
      }
      at_risk -= counts[0] + counts[1];
    }
    EXPECT_EQ(point, survivals.back().end());
  }
  ASSERT_EQ(survivals[0].size(), survivals[1].size());
  for (std::size_t k = 0; k < survivals[0].size(); ++k)
    EXPECT_EQ(survivals[0][k]["survival"], survivals[1][k]["survival"]);
}

TEST(ContactsCommand, FilesAndPage) {
  const ScratchDirectory directory;
  const std::string out = (directory / "report").string();
  const ProgramRun run = run_program({"contacts", data_file("trajectories/ubiquitin_pull_first30.pdb"),
                                      "--select", "ca", "--cutoff", "6:8", "--out", out});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("one frame in 2"));
  const Json json = Json::parse(content_of(out + "/contacts.json"));
  EXPECT_EQ(test::ReportData(out + "/report.html").result, json);
  std::map<std::string, int> contacts;
  std::istringstream lines(content_of(out + "/intervals.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("i,j,first,second,begin_frame,end_frame"));
  while (std::getline(lines, line)) ++contacts[line.substr(0, line.find(',', line.find(',') + 1))];
  ASSERT_EQ(contacts.size(), json["rows"].size());
  for (const Json& row : json["rows"]) {
    const std::string key = row["i"].dump() + "," + row["j"].dump();
    EXPECT_EQ(row["contacts"], contacts[key]) << key;
    EXPECT_EQ(row["first"], json["names"][row["i"].get<std::size_t>()]) << key;
    EXPECT_GE(row["j"].get<int>() - row["i"].get<int>(), 3);
  }
  EXPECT_THAT(content_of(out + "/contacts.csv"), HasSubstr("i,j,first,second,contacts,occupancy"));
  EXPECT_THAT(content_of(out + "/frames.csv"), HasSubstr("spacing,samples,found,plain_contacts"));
}

using Second = second::Rational;

/// Returns the square root, rounded down to 2^-80.
Second root_of(const Second& x) {
  using boost::multiprecision::denominator;
  using boost::multiprecision::numerator;
  const second::Integer unit = second::Integer(1) << 80;
  const second::Integer scaled = numerator(x) * unit * unit / denominator(x);
  return Second(boost::multiprecision::sqrt(scaled), unit);
}

/// Solves the quadratic of each pair of beads in each step, in fractions: |d0 + u (d1 - d0)|^2 = cutoff^2.
/// Returns begin and end of every contact, rounded, in frames.
using Spans = std::vector<std::pair<double, double>>;
std::map<std::pair<int, int>, Spans> brute_force(const Trajectory& trajectory, double cutoff, int apart) {
  std::map<std::pair<int, int>, Spans> all;
  const Second square = Second(cutoff) * Second(cutoff);
  for (std::size_t step = 0; step + 1 < trajectory.frames.size(); ++step)
    EXPECT_LT((trajectory.frames[step + 1] - trajectory.frames[step]).colwise().norm().maxCoeff(), 1);
  const auto beads = static_cast<int>(trajectory.bead_count());
  for (int i = 0; i < beads; ++i) {
    for (int j = i + apart; j < beads; ++j) {
      std::vector<std::pair<Second, Second>> spans;
      for (std::size_t step = 0; step + 1 < trajectory.frames.size(); ++step) {
        Second a = 0, b = 0, c = -square;  // a u^2 + 2 b u + c
        const Eigen::Matrix3Xd &from = trajectory.frames[step], &to = trajectory.frames[step + 1];
        const double near = std::min((from.col(i) - from.col(j)).norm(), (to.col(i) - to.col(j)).norm());
        if (near > cutoff + 2) continue;  // no bead moves by 1 in a step
        for (int axis = 0; axis < 3; ++axis) {
          const Second start = Second(from(axis, i)) - Second(from(axis, j));
          const Second way = Second(to(axis, i)) - Second(to(axis, j)) - start;
          a += way * way;
          b += start * way;
          c += start * start;
        }
        const Second discriminant = b * b - a * c;
        if (discriminant < 0 || a == 0) continue;
        const Second root = root_of(discriminant);
        const Second low = std::max(Second((-b - root) / a), Second(0)),
                     high = std::min(Second((-b + root) / a), Second(1));
        if (low > high) continue;
        const Second begin = low + Second(step), end = high + Second(step);
        if (!spans.empty() && spans.back().second == begin) {
          spans.back().second = end;
        } else {
          spans.emplace_back(begin, end);
        }
      }
      for (const auto& [begin, end] : spans)
        all[{i, j}].emplace_back(begin.convert_to<double>(), end.convert_to<double>());
    }
  }
  return all;
}

void expect_as_brute_force(const std::string& dcd, const std::string& pdb, std::size_t frames,
                           double cutoff) {
  ReadOptions options;
  options.topology = data_file(pdb);
  options.selection = Selection::ca;
  options.frames.last = frames;
  const Trajectory trajectory = read_trajectory(data_file(dcd), options);
  const auto expected = brute_force(trajectory, cutoff, 4);
  const ScratchDirectory directory;
  const std::string out = (directory / "report").string();
  const ProgramRun run =
      run_program({"contacts", data_file(dcd), "--topology", data_file(pdb), "--select", "ca", "--frames",
                   ":" + std::to_string(frames), "--by", "bead", "--apart", "4", "--cutoff",
                   std::to_string(cutoff), "--out", out, "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  std::map<std::pair<int, int>, Spans> found;
  std::istringstream lines(content_of(out + "/intervals.csv"));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) cells.push_back(word);
    found[{std::stoi(cells[0]), std::stoi(cells[1])}].emplace_back(std::stod(cells[4]), std::stod(cells[5]));
  }
  std::size_t intervals = 0;
  ASSERT_EQ(found.size(), expected.size());
  for (const auto& [pair, spans] : expected) {
    ASSERT_EQ(found[pair].size(), spans.size()) << pair.first << " " << pair.second;
    for (std::size_t k = 0; k < spans.size(); ++k) {
      ASSERT_NEAR(found[pair][k].first, spans[k].first, 1e-9);
      ASSERT_NEAR(found[pair][k].second, spans[k].second, 1e-9);
    }
    intervals += spans.size();
  }
  EXPECT_GE(intervals, 30U);
}

TEST(ContactsCommand, IntervalsAreThoseOfEachPairsQuadratic) {
  expect_as_brute_force("trajectories/villin_hp36_300K.dcd", "trajectories/villin_hp36_300K.pdb", 80, 8);
  expect_as_brute_force("trajectories/random100_400K_first200.dcd", "trajectories/random100_400K.pdb", 60, 8);
}

struct Span {
  double begin = 0, end = 0;
  bool flag = false;  // sure, or found
};
using SpansOfPairs = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Span>>;

SpansOfPairs spans_of(const std::vector<IntervalRecord>& intervals, const std::vector<std::uint8_t>& flags) {
  SpansOfPairs spans;
  std::size_t place = 0;
  for (const IntervalRecord& r : intervals) {
    spans[{r.first, r.second}].push_back(
        {r.begin_frame, r.end_frame, !flags.empty() && flags.at(place) != 0});
    ++place;
  }
  return spans;
}

double time_of(const std::vector<Span>& spans) {
  double time = 0;
  for (const Span& span : spans) time += span.end - span.begin;
  return time;
}

constexpr double rounded = 1e-9;  // times have twelve digits

bool contains(const Span& outer, const Span& inner) {
  return outer.begin <= inner.begin + rounded && inner.end <= outer.end + rounded;
}
bool meet(const Span& a, const Span& b) { return a.begin <= b.end + rounded && b.begin <= a.end + rounded; }

// Compares a certificate with the contacts of all frames.
void expect_true_certificate(const std::vector<std::string>& rule, const std::string& stride) {
  SCOPED_TRACE(testing::PrintToString(rule) + " " + stride);
  const auto task_of = [&](const std::string& frames) {
    Arguments arguments{data_file("trajectories/villin_hp36_300K.dcd"),
                        "--topology",
                        data_file("trajectories/villin_hp36_300K.pdb"),
                        "--select",
                        "ca",
                        "--frames",
                        frames};
    arguments.insert(arguments.end(), rule.begin(), rule.end());
    return parse_contacts_options(arguments).task;
  };
  const auto no_progress = [](std::size_t, std::size_t) {};
  const auto scene_of = [](const ContactsTask& task) {
    return load_necklaces(task, task.motion, 1, [](const std::string&) {});
  };
  ContactsTask all = task_of("0:97");
  all.motion = FrameMotion::linear;
  const ContactsTask strided = task_of("0:97:" + stride);
  const Scene all_frames = scene_of(all), some_frames = scene_of(strided);
  const SpansOfPairs truth = spans_of(follow_contacts(all, all_frames, no_progress)->intervals, {});
  const auto report = follow_contacts(strided, some_frames, no_progress);
  const ContactsCertificate certificate = certify_contacts(strided, some_frames, *report, no_progress);
  const SpansOfPairs found = spans_of(report->intervals, certificate.is_sure),
                     possible = spans_of(certificate.possible, certificate.is_found);
  for (const auto& [pair, spans] : truth) {
    ASSERT_TRUE(possible.contains(pair));
    for (const Span& span : spans)
      EXPECT_EQ(
          std::ranges::count_if(possible.at(pair), [&](const Span& one) { return contains(one, span); }), 1);
  }
  std::uint64_t sure = 0;
  for (const auto& [pair, spans] : found) {
    for (const Span& span : spans) {
      if (!span.flag) continue;
      ++sure;
      ASSERT_TRUE(truth.contains(pair));
      EXPECT_TRUE(std::ranges::any_of(truth.at(pair), [&](const Span& one) { return meet(one, span); }));
    }
    for (const Span& span : possible.at(pair))
      EXPECT_EQ(span.flag, std::ranges::any_of(spans, [&](const Span& one) { return contains(span, one); }));
  }
  std::uint64_t in_truth = 0;
  double time_in_truth = 0;
  for (const auto& [pair, bounds] : certificate.pairs) {
    const auto spans = truth.contains(pair) ? truth.at(pair) : std::vector<Span>();
    in_truth += spans.size();
    time_in_truth += time_of(spans);
    EXPECT_LE(bounds.least, spans.size());
    EXPECT_LE(bounds.least_time, time_of(spans) + rounded);
    EXPECT_GE(bounds.most_time, time_of(spans) - rounded);
  }
  const ContactBoundsOfPair& stated = certificate.all;
  EXPECT_EQ(stated.sure, sure);
  EXPECT_LE(stated.least, in_truth);
  EXPECT_LE(stated.least_time, time_in_truth);
  EXPECT_GE(stated.most_time, time_in_truth);
  EXPECT_GT(stated.least_time, 0.2 * time_in_truth);
  EXPECT_LT(stated.most_time, 3 * time_in_truth);
  EXPECT_GT(stated.least, 0U);
}

TEST(ContactsCommand, CertificatesBoundTheContactsOfAllFrames) {
  expect_true_certificate({"--cutoff", "8"}, "4");
  expect_true_certificate({"--cutoff", "7:9", "--by", "bead"}, "2");
  expect_true_certificate({"--cutoff", "8", "--gap", "3"}, "8");
  expect_true_certificate({"--cutoff", "5", "--surface", "--groups", "//A/41-60", "//A/50-76"}, "3");
  expect_true_certificate({"--cutoff", "8", "--motion", "hermite"}, "6");
}

// In all frames, the bead comes within 1 at frames 1 and 3 and stays 3 away at frame 2. The run leaves out
// frames 1 and 3, in which the bead is 2 from its place in the run.
TEST(ContactsCommand, ACertificateOfOnePair) {
  const ScratchDirectory directory;
  const std::string rests = directory.file("rests.xyz", "1\n\nC 0 0 0\n");
  const std::string moves =
      directory.file("moves.xyz", "1\n\nC 3 0 0\n1\n\nC 1 0 0\n1\n\nC 3 0 0\n1\n\nC 1 0 0\n1\n\nC 3 0 0\n");
  const auto json = [&](const char* cutoff) {
    const ProgramRun run = run_program(
        {"contacts", rests, moves, "--cutoff", cutoff, "--frames", "::2", "--certify", "--json", "-"});
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out);
  };
  // Balls that are two smaller meet within 0, which is no certain contact.
  const Json near = json("2");
  EXPECT_EQ(near["stride"]["skipped"], 2);
  EXPECT_NEAR(near["stride"]["deviation"]["largest"].get<double>(), 2, 1e-9);
  EXPECT_EQ(near["stride"]["pairs"], Json::parse(R"({"found": 0, "sure": 0, "possible": 1})"));
  EXPECT_EQ(near["stride"]["contacts"], Json::parse(R"({"found": 0, "sure": 0, "possible": 1, "least": 0})"));
  EXPECT_NEAR(near["stride"]["time"]["most"].get<double>(), 4, 1e-12);
  const Json far = json("7");
  EXPECT_EQ(far["stride"]["contacts"], Json::parse(R"({"found": 1, "sure": 1, "possible": 1, "least": 1})"));
  EXPECT_EQ(far["rows"][0]["sure"], 1);
  EXPECT_EQ(far["rows"][0]["least_occupancy"], 1.0);
}

// The run goes straight past the other bead. In truth the bead goes round it.
TEST(ContactsCommand, AContactBetweenFramesMayNotExist) {
  const ScratchDirectory directory;
  const std::string rests = directory.file("rests.xyz", "1\n\nC 0 0 0\n");
  const std::string moves = directory.file("moves.xyz", "1\n\nC -5 0 0\n1\n\nC 0 9 0\n1\n\nC 5 0 0\n");
  const std::string out = (directory / "out").string();
  const ProgramRun run = run_program({"contacts", rests, moves, "--cutoff", "1", "--frames", "::2",
                                      "--certify", "--strides", "1", "--out", out});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json contacts = Json::parse(content_of(out + "/contacts.json"))["stride"]["contacts"];
  EXPECT_EQ(contacts["found"], 1);
  EXPECT_EQ(contacts["sure"], 0);
  EXPECT_EQ(contacts["least"], 0);
  EXPECT_THAT(content_of(out + "/intervals.csv"), HasSubstr(",certainty\n"));
  EXPECT_THAT(content_of(out + "/intervals.csv"), HasSubstr(",possible\n"));
  EXPECT_THAT(content_of(out + "/possible_intervals.csv"), HasSubstr(",found\n"));
  EXPECT_THAT(content_of(out + "/possible_intervals.csv"), HasSubstr(",yes\n"));
  EXPECT_THAT(content_of(out + "/contacts.csv"), HasSubstr(",unit,sure,least_occupancy,most_occupancy\n"));
  // A longer cutoff reaches the bead at the first frame, which is at its true position there.
  const ProgramRun near =
      run_program({"contacts", rests, moves, "--cutoff", "5", "--frames", "::2", "--certify", "--json", "-"});
  EXPECT_EQ(Json::parse(near.out)["stride"]["contacts"]["sure"], 1);
  EXPECT_EQ(Json::parse(near.out)["stride"]["time"]["least"], 0.0);
}

}  // namespace
}  // namespace kds::test::contacts_command_test
