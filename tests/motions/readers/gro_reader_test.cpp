#include "motions/readers/gro_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/motions/reader_files.h"
#include "tests/support/inputs/gro_text.h"
#include "tests/support/rounds.h"

namespace kds::gro_reader_test {
namespace {

using test::GroText;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::filesystem::path test_data(std::string_view name) {
  return test::data_file("../tests/motions/readers/data") / name;
}

constexpr test::FileReader read{"a.gro"};

std::vector<std::size_t> bead_counts(std::string_view text, const std::string& chains) {
  std::vector<std::size_t> counts;
  for (const Trajectory& necklace :
       read_trajectories(test::write_file("a.gro", text), {.selection = Selection::all, .chain = chains}))
    counts.push_back(necklace.bead_count());
  return counts;
}

// Returns the number of molecules that --chain can name.
std::size_t molecules_of(const GroText& file) {
  for (std::size_t count = 1;; ++count) {
    try {
      static_cast<void>(bead_counts(file.text(), std::to_string(count + 1)));
    } catch (const InputError&) {
      return count;
    }
  }
}

// The file was written by MDTraj, and the DCD file holds the coordinates that MDTraj and MDAnalysis read from
// it, in angstrom.
TEST(GroReader, CoordinatesAreThoseOfOtherReaders) {
  const Trajectory gro = read_trajectory(test_data("1l2y.gro"), {.selection = Selection::all});
  const Trajectory dcd = read_trajectory(test_data("1l2y_gro.dcd"));
  ASSERT_EQ(gro.frames.size(), 2U);
  ASSERT_EQ(gro.bead_count(), 304U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(gro.frames[k], dcd.frames[k]) << k;
  EXPECT_THAT(gro.times, ElementsAre(0, 12.5));
}

TEST(GroReader, PositionsTimesAndBoxes) {
  GroText file;
  file.title = "Protein in water t=  12.00000 step= 3";
  file.residues(1, 2);
  file.atoms[0] = {1, "ALA", "N", -0.01, 0.023, 0.05};
  const Trajectory trajectory = read(file.text());
  ASSERT_EQ(trajectory.bead_count(), 6U);
  const auto expected = [](float nanometres) { return static_cast<double>(10.0F * nanometres); };
  EXPECT_EQ(trajectory.frames[0].col(0),
            Eigen::Vector3d(expected(-0.01F), expected(0.023F), expected(0.05F)));
  EXPECT_THAT(trajectory.times, ElementsAre(12));
  EXPECT_THAT(trajectory.warnings, IsEmpty());
}

TEST(GroReader, TimesStandInTitles) {
  const auto time = [](const std::string& title) {
    GroText file;
    file.title = title;
    return read(file.residues(1, 2).text()).times;
  };
  EXPECT_THAT(time("t= 1e3"), ElementsAre(1000));
  EXPECT_THAT(time("Generated with MDTraj, t=5.5"), ElementsAre(5.5));
  EXPECT_THAT(time("t= 1 of the paper, t= 2 step= 7"), ElementsAre(2));
  for (const char* none : {"water", "dt= 5", "t= inf", "t=", "t= x", ""})
    EXPECT_THAT(time(none), IsEmpty()) << none;
  GroText first, second;
  first.title = "t= 1";
  const Trajectory mixed = read(first.residues(1, 2).text() + second.residues(1, 2).text());
  EXPECT_THAT(mixed.times, IsEmpty());
  EXPECT_THAT(mixed.warnings, Contains(HasSubstr("1 of 2 frames have no time (t=)")));
}

TEST(GroReader, ColumnsFollowTheDecimals) {
  for (const int decimals : {1, 2, 3, 5, 9})
    for (const bool velocities : {false, true}) {
      GroText file{.decimals = decimals, .velocities = velocities};
      file.residues(1, 2);
      for (test::GroAtom& atom : file.atoms) atom.x = std::round(10 * atom.x) / 10 - 99;
      const Trajectory trajectory = read(file.text());
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(trajectory.frames[0](0, static_cast<Eigen::Index>(i)),
                  static_cast<double>(10.0F * static_cast<float>(file.atoms[i].x)))
            << decimals;
    }
}

TEST(GroReader, NamesFillTheirColumns) {
  GroText file;
  file.residues(99999, 100001, "LYSHX");  // 99999, 0, 1
  file.atoms[0].name = "NABCD";
  const Trajectory trajectory = read(file.text(), {.selection = Selection::all});
  EXPECT_EQ(trajectory.bead_count(), 9U);
  EXPECT_EQ(trajectory.bead_names[0], "NABCD of LYSHX 99999 in chain ' '");
  EXPECT_EQ(trajectory.bead_names[4], "CA of LYSHX 0 in chain ' '");
}

// A chain broken at the walls of the box is made whole, also in a file of one frame: its box is no crystal's.
TEST(GroReader, BoxesMakeChainsWhole) {
  GroText file;
  file.residues(1, 8);
  for (test::GroAtom& atom : file.atoms) atom.x = std::fmod(atom.x, 3.0);
  ASSERT_LT(file.atoms.back().x, 1.0);
  EXPECT_NEAR(read(file.text()).frames[0](0, 23), 34.5, 1e-4);
  // The second vector of this box leans along x.
  file.box = "3.00000 4.00000 5.00000 0.00000 0.00000 1.00000 0.00000 0.00000 0.00000";
  for (std::size_t i = 0; i < file.atoms.size(); ++i) {
    const double y = 0.15 * static_cast<double>(i);
    const double wraps = y >= 2 ? 1 : 0;
    file.atoms[i].x = 1 - wraps;
    file.atoms[i].y = y - 4 * wraps;
  }
  const Eigen::Matrix3Xd frame = read(file.text()).frames[0];
  EXPECT_NEAR(frame(0, 23), 10, 1e-4);
  EXPECT_NEAR(frame(1, 23), 34.5, 1e-4);
  file.box = "0.0 0.0 0.0";
  EXPECT_NO_THROW(static_cast<void>(read(file.text())));
}

TEST(GroReader, MoleculesAreToldApart) {
  const std::vector<std::string> with_end = {"N", "CA", "C", "OC1", "OC2"},
                                 with_start = {"N", "H1", "H2", "CA", "C"};
  EXPECT_EQ(molecules_of(GroText().residues(1, 9)), 1U);
  // Numbers go down.
  EXPECT_EQ(molecules_of(GroText().residues(1, 9).residues(1, 9).residues(3, 5)), 3U);
  EXPECT_EQ(bead_counts(GroText().residues(1, 9).residues(1, 4).text(), "1,2"),
            (std::vector<std::size_t>{27, 12}));
  // GRO files have no insertion codes, so a residue number may repeat: 52, 52, 53.
  EXPECT_EQ(molecules_of(GroText().residues(51, 52).residue(52, "GLY").residues(53, 54)), 1U);
  // Numbers overflow at 100000.
  EXPECT_EQ(molecules_of(GroText().residues(99998, 100003)), 1U);
  // A number that goes down near the overflow is no overflow.
  EXPECT_EQ(molecules_of(GroText().residues(99990, 99998).residues(1, 3)), 2U);
  // Ends of chains, though numbers go on.
  EXPECT_EQ(molecules_of(GroText().residues(1, 4).residue(5, "GLY", with_end).residues(6, 9)), 2U);
  EXPECT_EQ(molecules_of(GroText().residues(1, 5).residue(6, "GLY", with_start).residues(7, 9)), 2U);
  EXPECT_EQ(molecules_of(GroText()
                             .residues(2, 5)
                             .residue(6, "NME", {"N", "CH3"})
                             .residue(7, "ACE", {"CH3", "C"})
                             .residues(8, 9)),
            2U);
  // Solvent and ions between.
  EXPECT_EQ(molecules_of(GroText().residues(1, 4).residue(5, "SOL", {"OW", "HW1", "HW2"}).residues(6, 9)),
            2U);
  EXPECT_EQ(molecules_of(GroText().residues(1, 4).residue(5, "NA", {"NA"}).residues(6, 9)), 2U);
  // A residue with an unknown name belongs to the chain if its number continues those of the chain.
  EXPECT_EQ(molecules_of(GroText().residues(1, 4).residue(5, "CHR", {"C1", "C2", "O3"}).residues(6, 9)), 1U);
  EXPECT_EQ(molecules_of(GroText().residues(1, 4).residue(1, "LIG", {"C1", "C2", "O3"}).residues(6, 9)), 2U);
  // Protein beside DNA.
  EXPECT_EQ(molecules_of(
                GroText().residues(1, 4).residue(5, "DA5", {"O5'", "C1'"}).residue(6, "DT3", {"P", "C1'"})),
            2U);
}

TEST(GroReader, TheFirstMoleculeIsReadAndTheOthersAreToldOf) {
  const Trajectory trajectory =
      read(GroText().residues(1, 9).residues(1, 4).residue(5, "SOL", {"OW"}).text());
  EXPECT_EQ(trajectory.bead_count(), 27U);
  EXPECT_THAT(trajectory.warnings, Contains(HasSubstr("molecule 2 not read; --chain 2 or --chain 1,2")));
}

TEST(GroReader, SolventAndLipidsAreNoPolymers) {
  GroText file;
  file.residue(1, "POPC", {"C12", "P", "O13"}).residue(2, "POPC", {"C12", "P", "O13", "C1", "C2"});
  file.atoms.erase(file.atoms.begin(), file.atoms.begin() + 3);
  file.residue(3, "CA", {"CA"}).residue(4, "SOL", {"OW", "HW1", "HW2"}).residue(5, "W", {"W"});
  test::expect_refused([&] { static_cast<void>(read(file.text())); },
                       {"no chain of amino acids or nucleotides", "4 residues (POPC, CA, SOL, W)"});
}

TEST(GroReader, ElementsFollowFromNames) {
  GroText file;
  file.residue(1, "MET", {"N", "CA", "C", "SD", "1HB", "HG"}).residue(2, "ZN", {"ZN"});
  const Trajectory trajectory = read(file.text(), {.selection = *Selection::parse("/")});
  EXPECT_THAT(trajectory.element_radii, ElementsAre(1.55, 1.7, 1.7, 1.8, 1.2, 1.2, testing::_));
  EXPECT_GT(trajectory.element_radii[6], 0);
}

TEST(GroReader, BoxWithoutLineEnd) {
  GroText file{.box = "3.00000 4.00000 5.00000 0.00000 0.00000 0.50000 0.00000 0.00000 0.00000"};
  const std::string text = file.residues(1, 2).text();
  const std::size_t box = text.find("3.00000 4.00000");
  const auto cut = [&](std::size_t length) { return text.substr(0, box + length); };
  const auto warns = Contains(HasSubstr("the box has no line end after it"));
  EXPECT_THAT(read(cut(23)).warnings, warns);
  EXPECT_THAT(read(cut(23) + "\n").warnings, Not(warns));
  EXPECT_THAT(read(cut(71)).warnings, Not(warns));
  EXPECT_EQ(read(text + cut(23)).frames.size(), 1U);
  EXPECT_EQ(read(text + cut(71)).frames.size(), 2U);
  test::expect_refused([&] { static_cast<void>(read(cut(22))); },
                       {"ends inside frame 0", "expected a line end"});
  file.box = "30 40 50";  // may be 500
  const std::string integers = file.text();
  test::expect_refused([&] { static_cast<void>(read(integers.substr(0, integers.size() - 1))); },
                       {"expected a line end"});
}

TEST(GroReader, NamesTheAtomsOfATrajectory) {
  const auto gro =
      test::write_file("t.gro", GroText().residues(1, 2).residue(3, "SOL", {"OW", "HW1", "HW2"}).text());
  const auto dcd = test::write_file("t.dcd", test::DcdMaker::chain(9, 2).bytes());
  EXPECT_EQ(read_trajectory(dcd, {.topology = gro}).bead_count(), 6U);
  EXPECT_EQ(read_trajectory(dcd, {.topology = gro, .selection = *Selection::parse("(SOL)/OW")}).bead_count(),
            1U);
}

}  // namespace
}  // namespace kds::gro_reader_test
