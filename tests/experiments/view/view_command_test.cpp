// `kds view`, and --view of run and replay, as a process: the state at every frame is that of --dump, and
// the files for other viewers hold the same state.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/output/page_templates.h"
#include "tests/experiments/count_of.h"
#include "tests/experiments/csv_cells.h"
#include "tests/experiments/replay_data.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::view_command_test {
namespace {

using testing::HasSubstr;
using State = ReplayData::State;
using Ids = ReplayData::Ids;

const std::string kVillin = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kNames = data_file("trajectories/villin_hp36_300K.pdb");
const std::vector<std::string> kRun{kVillin,    "--topology",   kNames,
                                    "--frames", "40:70",        "--dt",
                                    "0.02",     "--structures", "wrapped,power,contacts",
                                    "--radius", "2.3"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::uint32_t number(const std::string& text) { return static_cast<std::uint32_t>(std::stoul(text)); }

/// Returns the layers at each frame of a dump. Contacts follow from their events.
std::vector<std::map<std::string, State>> dumped(const std::filesystem::path& dump, std::size_t frames) {
  std::vector<std::map<std::string, State>> states(frames);
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const std::string start = "frame-" + std::to_string(frame);
    for (const auto& cell : csv_cells(dump / (start + ".power.csv")))
      for (std::size_t i = 0; i < cell.size(); ++i)
        for (std::size_t j = i + 1; j < cell.size(); ++j)
          states[frame]["edges"].insert(
              {std::min(number(cell[i]), number(cell[j])), std::max(number(cell[i]), number(cell[j]))});
    states[frame]["hidden"] = {};
    for (const auto& row : csv_cells(dump / (start + ".hidden.csv")))
      states[frame]["hidden"].insert({number(row[0])});
    std::uint32_t node = 0;
    for (const auto& row : csv_cells(dump / (start + ".wrapped.csv"))) {
      Ids cage{node++};
      std::istringstream basis(row[2]);
      for (std::uint32_t bead = 0; basis >> bead;) cage.push_back(bead);
      cage.resize(5, 0xffffffff);
      states[frame]["cages"].insert(cage);
    }
    State& contacts = states[frame]["contacts"];
    for (const auto& row : csv_cells(dump / "contacts.csv")) {
      const Ids pair{number(row[3]), number(row[4])};
      const bool at_start = row[0] == "0" && row[1] == "0" && row[2] == "0" && row[5] == "begin";
      if (number(row[0]) >= frame && !at_start) continue;
      if (row[5] == "begin") contacts.insert(pair);
      if (row[5] == "end") contacts.erase(pair);
    }
  }
  return states;
}

TEST(View, ShowsAtEveryFrameWhatADumpHas) {
  const ScratchDirectory scratch;
  const std::string page = scratch / "replay.html", log = scratch / "run.kdslog";
  const ProgramRun run = run_program(
      with(with({"run"}, kRun), {"--view", page, "--dump", scratch / "dump", "--log", log, "--quiet"}));
  ASSERT_EQ(run.code, 0) << run.err;
  const ReplayData data(content_of(page));
  EXPECT_EQ(data.meta["frames"], 30);
  EXPECT_EQ(data.meta["length_unit"], "angstrom");
  EXPECT_EQ(data.meta["quantum"], 0.02);
  EXPECT_EQ(data.meta["radius"], 2.3);
  EXPECT_EQ(data.words("frames").front(), 40U);
  EXPECT_TRUE(data.meta["has_times"]);
  EXPECT_EQ(data.block("times").size(), 8U * 30);
  EXPECT_EQ(nlohmann::json::parse(data.block("names"))[1], "A/MET41/CA");
  const auto states = dumped(scratch / "dump", 30);
  for (std::size_t frame = 0; frame < 30; ++frame)
    for (const auto& [layer, state] : states[frame])
      EXPECT_EQ(data.state(layer, frame), state) << layer << frame;
  std::size_t changes = 0;
  for (const auto& [layer, state] : states[29]) changes += state != states[0].at(layer) ? 1 : 0;
  EXPECT_GE(changes, 3U);

  // A replay of the log and kds view write the same data.
  const std::string again = scratch / "again.html", viewed = scratch / "viewed.html";
  ASSERT_EQ(run_program({"replay", log, "--view", again, "--quiet"}).code, 0);
  EXPECT_EQ(content_of(again), content_of(page));
  const ProgramRun view = run_program(with(with({"view"}, kRun), {"-o", viewed}));
  ASSERT_EQ(view.code, 0) << view.err;
  EXPECT_EQ(view.err, "");
  EXPECT_THAT(view.out, HasSubstr("30 frames"));
  EXPECT_THAT(view.out, HasSubstr("replay " + viewed));
  ReplayData same(content_of(viewed));
  EXPECT_THAT(same.meta["command"].get<std::string>(), HasSubstr("kds view "));
  same.meta["command"] = data.meta["command"];
  EXPECT_EQ(same.meta, data.meta);
  for (const auto& [name, bytes] : data.meta["blocks"].items()) EXPECT_EQ(same.block(name), data.block(name));
}

TEST(View, IsSmallForASmallProtein) {
  const ScratchDirectory scratch;
  const std::string page = scratch / "replay.html";
  ASSERT_EQ(
      run_program({"view", kVillin, "--topology", kNames, "--frames", "0:200", "-o", page, "--quiet"}).code,
      0);
  std::size_t template_size = 0;
  for (const std::string_view piece : replay_template()) template_size += piece.size();
  EXPECT_LT(template_size, 1'200'000U);
  EXPECT_LT(std::filesystem::file_size(page), template_size + 600'000U);
}

TEST(View, TakesAStrideToStayBelowMaxMb) {
  const ScratchDirectory scratch;
  const std::string page = scratch / "replay.html";
  const std::vector<std::string> arguments{"view", kVillin, "--frames", "0:100", "-o", page};
  ASSERT_EQ(run_program(arguments).code, 0);
  const auto all = std::filesystem::file_size(page);
  const ReplayData every(content_of(page));
  EXPECT_EQ(every.meta["stride"], 1);
  std::size_t template_size = 0;
  for (const std::string_view piece : replay_template()) template_size += piece.size();
  const double most =
      (static_cast<double>(template_size) + 0.6 * static_cast<double>(all - template_size)) / 1e6;
  const std::string vtk = scratch / "vtk";
  const ProgramRun run = run_program(with(arguments, {"--max-mb", std::to_string(most), "--vtk", vtk}));
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("the page and the files of --vtk, takes one in"));
  EXPECT_THAT(run.err, HasSubstr("of the 100 frames"));
  EXPECT_LE(count_of(run.err, "a stride of "), 1U) << run.err;  // of the run that is shown
  const ReplayData data(content_of(page));
  const std::size_t stride = data.meta["stride"];
  EXPECT_GE(stride, 2U);
  EXPECT_LE(std::filesystem::file_size(page), most * 1e6);
  EXPECT_EQ(data.words("frames")[1], stride);
  EXPECT_TRUE(std::filesystem::exists(vtk + "/beads-" + std::to_string(stride) + ".vtp"));
  EXPECT_FALSE(std::filesystem::exists(vtk + "/beads-1.vtp"));
}

TEST(View, RoundsRelativeToRadiiWithoutAUnit) {
  const ScratchDirectory scratch;
  const std::string file = scratch.file("a.xyz", xyz({"0 0 0", "9 0 0", "0 9 0", "0 0 9", "2 3 1"}) +
                                                     xyz({"0 0 0", "9 1 0", "0 9 0", "0 0 9", "2 3 4"}));
  ASSERT_EQ(run_program({"view", file, "--radius", "0.5", "-o", scratch / "a.html", "--quiet"}).code, 0);
  const ReplayData data(content_of(scratch / "a.html"));
  EXPECT_EQ(data.meta["quantum"], 0.005);
  EXPECT_EQ(data.meta["length_unit"], "");
  EXPECT_THAT(data.meta["quantum_note"].get<std::string>(), HasSubstr("a hundredth of the least radius"));
}

TEST(View, IsHarmlessForInputsWithTagsInTheirNames) {
  const ScratchDirectory scratch;
  std::filesystem::create_directories(scratch / "a<");
  const std::filesystem::path file = scratch / "a<" / "script><script>alert(1)<" / "";
  std::filesystem::create_directories(file);
  const std::filesystem::path input = file / "script>.txt";
  std::filesystem::copy_file(data_file("kinetic/d2_n20_linear.txt"), input);
  const std::string page = scratch / "a.html";
  const ProgramRun run = run_program({"view", input, "-o", page});
  ASSERT_EQ(run.code, 0) << run.err;
  const ReplayData data(content_of(page));
  EXPECT_THAT(data.meta["command"].get<std::string>(), HasSubstr("<script>alert(1)</script>"));
  EXPECT_EQ(data.meta["title"], "script>.txt");
  EXPECT_THAT(content_of(page), testing::Not(HasSubstr("<script>alert(1)")));
}

/// Returns the numbers of a data array in a VTK file.
template <class Number>
std::vector<Number> vtk_array(const std::string& file, const std::string& name) {
  const std::size_t tag = file.find("Name=\"" + name + "\""), begin = file.find('>', tag) + 1;
  const std::string bytes = from_base64(file.substr(begin, file.find('<', begin) - begin));
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data(), 4);
  EXPECT_EQ(size + 4, bytes.size()) << name;
  std::vector<Number> numbers(size / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data() + 4, size);
  return numbers;
}

TEST(View, WritesFilesForOtherViewers) {
  const ScratchDirectory scratch;
  const std::vector<std::string> run{
      kVillin, "--frames", "3:9:2", "--structures", "wrapped,power,contacts", "--radius", "2.3"};
  const std::string vtk = scratch / "vtk", script = scratch / "a.pml", bild = scratch / "a.bild";
  ASSERT_EQ(run_program(with(with({"run"}, run), {"--dump", scratch / "dump", "--quiet"})).code, 0);
  const ProgramRun view =
      run_program(with(with({"view"}, run), {"--vtk", vtk, "--script", script, "--at", "5"}));
  ASSERT_EQ(view.code, 0) << view.err;
  ASSERT_EQ(run_program(with(with({"view"}, run), {"--script", bild})).code, 0);
  const auto states = dumped(scratch / "dump", 3);
  const std::string pvd = content_of(std::filesystem::path(vtk) / "replay.pvd");
  EXPECT_EQ(count_of(pvd, "<DataSet "), 6U);
  for (std::size_t frame = 0; frame < 3; ++frame) {
    const std::string number_of_file = std::to_string(3 + 2 * frame);
    const std::string beads = content_of(std::filesystem::path(vtk) / ("beads-" + number_of_file + ".vtp"));
    EXPECT_THAT(pvd, HasSubstr("beads-" + number_of_file + ".vtp"));
    EXPECT_EQ(vtk_array<double>(beads, "radius"), std::vector<double>(108, 2.3));
    std::map<int, State> lines;
    const auto kinds = vtk_array<std::uint8_t>(beads, "kind");
    const auto ends = vtk_array<std::uint32_t>(beads.substr(beads.find("<Lines>")), "connectivity");
    ASSERT_EQ(kinds.size(), 108 + ends.size() / 2);
    for (std::size_t line = 0; line < ends.size() / 2; ++line)
      lines[kinds[108 + line]].insert({ends[2 * line], ends[2 * line + 1]});
    EXPECT_EQ(lines[1].size(), 107U);
    EXPECT_EQ(lines[2], states[frame].at("edges"));
    EXPECT_EQ(lines[3], states[frame].at("contacts"));

    // Spheres are those of the dump, rounded up.
    const std::string cages = content_of(std::filesystem::path(vtk) / ("cages-" + number_of_file + ".vtp"));
    const auto radii = vtk_array<double>(cages, "radius"), points = vtk_array<double>(cages, "Points");
    const auto rows = csv_cells(scratch / ("dump/frame-" + std::to_string(frame) + ".wrapped.csv"));
    ASSERT_EQ(radii.size(), rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      EXPECT_NEAR(radii[k], std::stod(rows[k][6]), 1e-9);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(points[3 * k + axis], std::stod(rows[k][3 + axis]), 1e-9);
    }
  }
  const std::string pml = content_of(script), text = content_of(bild);
  EXPECT_THAT(pml, HasSubstr("# kds: frame 5."));
  EXPECT_EQ(count_of(pml, "\nSPHERE, "), 108U + states[1].at("cages").size());
  EXPECT_EQ(count_of(pml, "\nCYLINDER, "),
            107 + states[1].at("edges").size() + states[1].at("contacts").size());
  EXPECT_THAT(text, HasSubstr(".comment kds: frame 3."));
  EXPECT_EQ(count_of(text, "\n.sphere "), 108U + states[0].at("cages").size());
  EXPECT_EQ(count_of(text, "\n.cylinder "),
            107 + states[0].at("edges").size() + states[0].at("contacts").size());
}

TEST(View, IsLinkedFromReports) {
  const ScratchDirectory scratch;
  const std::string report = scratch / "a report", page = scratch / "a run #1.html";
  const ProgramRun run = run_program({"run", kVillin, "--frames", "0:4", "--out", report, "--view", page});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\nreplay " + page + "\n"));
  EXPECT_EQ(ReportData(report + "/report.html").links["replay"], "../a%20run%20%231.html");
}

TEST(View, ShowsTheContactsThatKdsContactsFollows) {
  const ScratchDirectory scratch;
  const std::string out = scratch / "out", page = scratch / "replay.html";
  constexpr double cutoff = 8;
  const ProgramRun run = run_program({"contacts", kVillin, "--topology", kNames, "--select", "ca", "--frames",
                                      "0:12", "--cutoff", "8", "--apart", "4", "--out", out, "--view", page});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("replay " + page));
  EXPECT_EQ(ReportData(out + "/report.html").links["replay"], "../replay.html");
  const ReplayData data(content_of(page));
  const auto positions = data.positions();
  ASSERT_EQ(positions.size(), 12U);
  std::size_t pairs = 0;
  for (std::size_t frame = 0; frame < positions.size(); ++frame) {
    const State state = data.state("contacts", frame);
    for (std::uint32_t i = 0; i < positions[frame].size(); ++i) {
      for (std::uint32_t j = i + 1; j < positions[frame].size(); ++j) {
        double square = 0;
        for (int axis = 0; axis < 3; ++axis)
          square += std::pow(positions[frame][i][axis] - positions[frame][j][axis], 2);
        const double distance = std::sqrt(square);
        if (std::abs(distance - cutoff) < 0.05) continue;  // positions are rounded
        EXPECT_EQ(state.contains({i, j}), distance < cutoff && j - i >= 4) << frame << ": " << i << " " << j;
        pairs += state.contains({i, j}) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(pairs, 100U);
  const std::string by_chain = scratch / "chains.html";
  ASSERT_EQ(run_program({"contacts", kVillin, "--topology", kNames, "--frames", "0:2", "--cutoff", "8",
                         "--by", "chain", "--obstacle", kNames, "--view", by_chain, "--quiet"})
                .code,
            0);
  const ReplayData chains(content_of(by_chain));
  const std::uint32_t first_of_second = chains.meta["necklaces"][0];
  const State between = chains.state("contacts", 0);
  EXPECT_FALSE(between.empty());
  for (const Ids& pair : between) EXPECT_TRUE(pair[0] < first_of_second && pair[1] >= first_of_second);

  // From C of a residue to N of the third after it are seven beads.
  const std::string by_residue = scratch / "residues.html";
  ASSERT_EQ(run_program({"contacts", kVillin, "--topology", kNames, "--frames", "0:2", "--cutoff", "6",
                         "--view", by_residue, "--quiet"})
                .code,
            0);
  const ReplayData residues(content_of(by_residue));
  const State beads = residues.state("contacts", 0);
  EXPECT_FALSE(beads.empty());
  for (const Ids& pair : beads) EXPECT_GE(pair[1] - pair[0], 7U);
}

TEST(View, ShowsTheFirstRunOfAComparison) {
  const ScratchDirectory scratch;
  const std::string out = scratch / "out", page = scratch / "replay.html";
  const ProgramRun run = run_program({"compare", kVillin, "--topology", kNames, "--frames", "0:12",
                                      "--strides", "2,4", "--motions", "hermite,linear", "--structures",
                                      "wrapped,contacts", "--rounds", "1", "--out", out, "--view", page});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(ReportData(out + "/report.html").links["replay"], "../replay.html");
  const ReplayData data(content_of(page));
  EXPECT_EQ(data.words("frames"), (Ids{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(data.meta["motion"], "linear");  // the first in the order of motions
  const auto rows = nlohmann::json::parse(content_of(out + "/compare.json"))["rows"];
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_EQ(rows[s]["structure"], data.meta["structures"][s]["name"]);
    EXPECT_EQ(rows[s]["events"], data.meta["structures"][s]["events"]);
  }
}

}  // namespace
}  // namespace kds::test::view_command_test
