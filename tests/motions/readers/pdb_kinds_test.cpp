// Kinds of PDB files that other programs write and that the format does not foresee. Each kind has several
// instances, and the number of beads that a plain column reader would count.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/motions/reader_files.h"

namespace kds::pdb_kinds_test {
namespace {

using test::pdb_line;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr test::FileReader read{"a.pdb"};
constexpr test::FileRefusal refuse{"a.pdb"};

// The x coordinate of a residue follows its position in the file, whatever its number is.
struct Residue {
  std::string number = "1";
  std::string name = "ALA";  // three or four letters
  char chain = 'A';
  std::vector<std::string> atoms = {"N", "CA", "C"};
  bool het = false;
  char alternate = ' ';
};

class File {
 public:
  File& add(const Residue& residue) {
    double x = 4.5 * count_++;
    for (const std::string& name : residue.atoms) {
      std::string line = pdb_line({.name = name,
                                   .residue = residue.name.substr(0, 3),
                                   .chain = residue.chain,
                                   .x = x,
                                   .alternate = residue.alternate,
                                   .het = residue.het,
                                   .element = name.substr(0, 1)});
      if (residue.name.size() == 4) line[20] = residue.name[3];
      line.replace(22, 4, fmt::format("{:>4}", residue.number));
      text += line;
      x += 1.5;
    }
    return *this;
  }
  File& add(int first, int count, char chain = 'A') {
    for (int i = 0; i < count; ++i) add({.number = std::to_string(first + i), .chain = chain});
    return *this;
  }
  File& line(const std::string& line) {
    text += line + "\n";
    return *this;
  }

  std::string text;

 private:
  int count_ = 0;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

void expect_steps_of_one_residue(const Trajectory& trajectory) {
  const Eigen::Matrix3Xd& frame = trajectory.frames[0];
  for (Eigen::Index i = 0; i < frame.cols(); ++i)
    EXPECT_NEAR(frame(0, i), 1.5 * static_cast<double>(i), 0.001) << i;
}

TEST(PdbKinds, SerialNumbersThatRunIntoTheRecordName) {
  for (const char* record : {"ATOM", "atom"})
    for (const int first : {99997, 99999, 100000, 123456, 999989, 1000000, 9999988}) {
      std::vector<std::string> lines = lines_of(File().add(1, 4).text);
      for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i].replace(0, 11, fmt::format("{}{:>7}", record, first + static_cast<int>(i)));
      const Trajectory trajectory = read(text_of(lines));
      EXPECT_EQ(trajectory.bead_count(), 12U) << lines[3];
      EXPECT_THAT(trajectory.warnings, IsEmpty());
      expect_steps_of_one_residue(trajectory);
    }
  for (const char* serial : {"A0000", "ZZZZZ", "a0000", "*****", "186a0", "     "}) {
    std::vector<std::string> lines = lines_of(File().add(1, 4).text);
    for (std::string& line : lines) line.replace(6, 5, serial);
    EXPECT_EQ(read(text_of(lines)).bead_count(), 12U) << serial;
  }
  // After HETATM, a sixth digit shifts all following columns.
  std::vector<std::string> lines = lines_of(File().add(1, 4).text);
  lines[4].replace(0, 11, "HETATM100000");
  refuse(text_of(lines), {"a.pdb:5:", "serial number overflows into column 12"});
}

TEST(PdbKinds, LinesThatLookLikeAtomsAreCounted) {
  const std::string whole = File().add(1, 4).text;
  for (const char* start :
       {" ATOM     1", "ATOM\t     1", "ATOMS     1", "HETATOM   1", "  hetatm  1", "ATOM-     1"}) {
    std::vector<std::string> lines = lines_of(whole);
    lines[4].replace(0, 11, start);
    lines[7].replace(0, 11, start);
    const Trajectory trajectory = read(text_of(lines));
    EXPECT_EQ(trajectory.bead_count(), 6U);
    EXPECT_THAT(trajectory.warnings,
                testing::Contains(testing::EndsWith("a.pdb: 2 lines that begin like ATOM or HETATM but are "
                                                    "no such records are not read (line 5 first)")))
        << start;
  }
  EXPECT_THAT(read("REMARK ATOM lines follow\nTITLE     ATOM\n" + whole).warnings, IsEmpty());
}

TEST(PdbKinds, PiecesOfAChainBetweenTer) {
  for (const char* ter : {"TER", "TER      10      ALA A   3", "TER  100000      ALA A   3", "ter"})
    for (int pieces = 2; pieces <= 4; ++pieces)
      for (int size = 1; size <= 3; ++size)
        for (const bool closed : {true, false}) {
          File file;
          for (int piece = 0; piece < pieces; ++piece) {
            file.add({.number = std::to_string(10 * piece), .name = "ACE", .atoms = {"C"}});
            file.add(10 * piece + 1, size);
            if (closed || piece + 1 < pieces) file.line(ter);
          }
          const auto beads = static_cast<std::size_t>(3 * size);
          const auto all = static_cast<std::size_t>(pieces) * beads;
          const Trajectory trajectory = read(file.text);
          EXPECT_EQ(trajectory.bead_count(), all);
          EXPECT_EQ(trajectory.residues_read, all / 3);
          EXPECT_THAT(trajectory.warnings,
                      testing::Contains(HasSubstr(fmt::format(
                          "chain A has {} molecules and is read as one necklace; --chain A.1,A.2", pieces))));
          for (int piece = 1; piece <= pieces; ++piece) {
            const Trajectory one = read(file.text, {.chain = fmt::format("A.{}", piece)});
            EXPECT_EQ(one.bead_count(), beads);
            EXPECT_EQ(one.bead_names[0], fmt::format("N of ALA {} in chain A.{}", 10 * piece - 9, piece));
          }
          refuse(file.text, {"--chain", "has no chain 'A.9'", "expected A, A.1, A.2"}, {.chain = "A.9"});
          refuse(file.text, {"--chain", "A.2", "part of chain 'A'"}, {.chain = "A,A.2"});
        }
}

TEST(PdbKinds, WhatFollowsTerIsNoPolymer) {
  File file;
  file.add(1, 3).line("TER");
  file.add({.number = "90", .name = "HOH", .atoms = {"O"}, .het = true});
  file.add({.number = "91", .name = "NAG", .atoms = {"C1"}, .het = true});
  EXPECT_THAT(read(file.text).warnings, IsEmpty());
  file.add({.number = "92", .name = "GLU", .het = true}).add({.number = "93", .name = "MSE", .het = true});
  const Trajectory trajectory = read(file.text);
  EXPECT_EQ(trajectory.bead_count(), 9U);
  EXPECT_THAT(trajectory.warnings,
              ElementsAre(testing::EndsWith(
                  "chain A: 2 amino acids taken for free ones (HETATM) and not read: GLU 92, MSE 93")));
  // A modified residue is part of the second piece, or a piece of its own if TER follows it.
  File pieces;
  pieces.add(1, 2)
      .line("TER")
      .add(5, 1)
      .add({.number = "6", .name = "MSE", .het = true})
      .add(7, 1)
      .line("TER");
  EXPECT_EQ(read(pieces.text).bead_count(), 15U);
  pieces.add({.number = "9", .name = "MSE", .het = true}).line("TER");
  EXPECT_EQ(read(pieces.text).bead_count(), 18U);
}

TEST(PdbKinds, MoleculesWithoutAChainName) {
  for (int molecules = 2; molecules <= 6; ++molecules)
    for (const bool by_segment : {false, true}) {
      File file;
      for (int m = 0; m < molecules; ++m) {
        const std::size_t begin = file.text.size();
        file.add(3 * m + 1, 3, ' ');
        if (by_segment)
          for (std::size_t at = begin + 72; at < file.text.size(); at += 79)
            file.text.replace(at, 4, fmt::format("PRO{}", m));
        else
          file.line("TER");
      }
      const Trajectory first = read(file.text);
      EXPECT_EQ(first.bead_count(), 9U);
      ASSERT_EQ(first.warnings.size(), 1U);
      EXPECT_THAT(first.warnings[0],
                  HasSubstr(fmt::format("molecule 1 is read, 3 of {} residues", 3 * molecules)));
      EXPECT_THAT(first.warnings[0], HasSubstr("--chain 2 or --chain 1,2 reads"));
      for (int m = 1; m <= molecules; ++m) {
        const Trajectory one = read(file.text, {.chain = std::to_string(m)});
        EXPECT_EQ(one.frames[0](0, 0), 13.5 * (m - 1));
        EXPECT_EQ(one.bead_names[0], fmt::format("N of ALA {} in chain {}", 3 * m - 2, m));
        EXPECT_THAT(one.warnings, IsEmpty());
      }
      const auto path = test::write_file("a.pdb", file.text);
      EXPECT_EQ(read_trajectories(path, {.chain = "2,1"}).size(), 2U);
      EXPECT_EQ(read(file.text, {.chain = " "}).bead_count(), static_cast<std::size_t>(9 * molecules));
      refuse(file.text, {"expected 1, 2"}, {.chain = "7"});
      // A chain with that name takes precedence.
      EXPECT_EQ(read(file.text + File().add(1, 5, '2').text, {.chain = "2"}).bead_count(), 15U);
    }
}

// The advice names only chains and molecules that --chain can read.
TEST(PdbKinds, MoleculesBesideAChainWithTheirNumber) {
  const std::string molecules = File().add(1, 3, ' ').line("TER").add(4, 3, ' ').line("TER").text;
  constexpr const char* rename =
      "molecule 2 cannot be named by --chain, because a chain has the name 2: rename it";
  const std::string text = molecules + File().add(1, 5, '2').text;
  EXPECT_THAT(read(text).warnings, ElementsAre(testing::EndsWith(fmt::format(
                                       "2, 2 not read; --chain 2 or --chain 1,2 reads it; {}", rename))));
  EXPECT_EQ(read_trajectories(test::write_file("a.pdb", text), {.chain = "1,2"})[1].bead_count(), 15U);
  EXPECT_THAT(read(text, {.chain = " "}).warnings,
              ElementsAre(testing::EndsWith(fmt::format("; --chain 1 reads one each; {}", rename))));
  refuse(text, {"expected 1, 2"}, {.chain = "7"});
  // The molecule that is read may be the one without its own name.
  const std::string other = molecules + File().add(1, 5, '1').text;
  EXPECT_THAT(read(other).warnings,
              ElementsAre(testing::HasSubstr("2, 1 not read; --chain 2 reads them likewise")));
}

TEST(PdbKinds, LigandsAndWatersBetweenMolecules) {
  // Some programs end every chain with TER and write no HETATM.
  File file;
  file.add({.number = "1", .name = "LIG", .chain = ' ', .atoms = {"C1", "O1"}}).line("TER");
  file.add(2, 2, ' ').line("TER");
  file.add({.number = "4", .name = "WAT", .chain = ' ', .atoms = {"O"}}).line("TER");
  file.add(5, 4, ' ').line("TER");
  file.add({.number = "9", .name = "Na+", .chain = ' ', .atoms = {"Na+"}}).line("TER");
  EXPECT_EQ(read(file.text).bead_count(), 6U);
  EXPECT_EQ(read(file.text, {.chain = "2"}).bead_count(), 12U);
  refuse(file.text, {"expected 1, 2"}, {.chain = "3"});
}

TEST(PdbKinds, NumbersThatRestartOrCollide) {
  using Numbers = std::vector<std::string>;
  for (const Numbers& numbers : std::vector<Numbers>{{"0", "1", "2", "9998", "9999", "0", "1", "2"},
                                                     {"1", "2", "3", "1", "2", "3"},
                                                     {"9999", "9999", "9999"},
                                                     {"****", "****", "****", "****"},
                                                     {"0", "0"},
                                                     {"1", "2", "1", "2", "1", "2", "1"},
                                                     {"2710", "270e", "270f", "2710", "2711"},
                                                     {"9998", "9999", "A000", "A001"},
                                                     {"-1", "0", "1", "-1"},
                                                     {"", "", ""},
                                                     {"5", "4", "3", "5"},
                                                     {"9999", "1000", "1000", "1001"}})
    for (const char* residue : {"ALA", "GLY"})
      for (const std::vector<std::string>& atoms :
           std::vector<std::vector<std::string>>{{"N", "CA", "C"}, {"H1", "N", "CA", "C", "O"}, {"CA"}}) {
        File file;
        for (const std::string& number : numbers)
          file.add({.number = number, .name = residue, .atoms = atoms});
        file.line("TER");
        const std::size_t beads = atoms.size() == 1 ? 1 : 3;
        const Trajectory trajectory = read(file.text);
        EXPECT_EQ(trajectory.bead_count(), beads * numbers.size()) << numbers[0] << " " << residue;
        EXPECT_EQ(trajectory.residues_read, numbers.size());
        for (std::size_t r = 0; r < numbers.size(); ++r)
          EXPECT_EQ(trajectory.frames[0](0, static_cast<Eigen::Index>(beads * r)),
                    4.5 * static_cast<double>(r) + (atoms[0] == "H1" ? 1.5 : 0));
        const std::size_t distinct = std::set<std::string>(numbers.begin(), numbers.end()).size();
        const std::string line = fmt::format("residue{} with the number of an earlier one",
                                             numbers.size() - distinct == 1 ? "" : "s");
        const auto told =
            std::count_if(trajectory.warnings.begin(), trajectory.warnings.end(),
                          [&](const auto& warning) { return warning.find(line) != std::string::npos; });
        EXPECT_EQ(told, distinct == numbers.size() ? 0 : 1) << line;
      }
  EXPECT_EQ(read(File().add({.number = "A000"}).add({.number = "270f"}).text).bead_names[0],
            "N of ALA 10000 in chain A");
}

TEST(PdbKinds, ARestartBehindAnIncompleteResidue) {
  // The atoms of the second residue 1 stay together, although the first residue 1 has no N.
  File file;
  file.add({.number = "1", .atoms = {"CA", "C"}}).add(2, 1).add(1, 2);
  const Trajectory trajectory = read(file.text);
  EXPECT_EQ(trajectory.bead_count(), 9U);
  EXPECT_EQ(trajectory.frames[0](0, 3), 9.0);
  EXPECT_THAT(trajectory.warnings,
              testing::Contains(HasSubstr("chain A: 3 of 4 residues read; 1 without N, CA and C: ALA 1")));
}

TEST(PdbKinds, NeighboursAtOnePositionAreAlternatesOnlyIfTheySaySo) {
  const auto pair_of = [](char first, char second) {
    return File()
        .add({.number = "7", .name = "PRO", .alternate = first})
        .add({.number = "7", .name = "SER", .alternate = second})
        .text;
  };
  EXPECT_EQ(read(pair_of('A', 'B')).bead_count(), 3U);
  EXPECT_THAT(read(pair_of('A', 'B')).warnings, IsEmpty());
  EXPECT_EQ(read(pair_of(' ', ' ')).bead_count(), 6U);
  EXPECT_THAT(read(pair_of(' ', ' ')).warnings, testing::Contains(HasSubstr("1 residue with the number")));
}

TEST(PdbKinds, AtomsOfAResidueThatStandLaterInTheFile) {
  File file;
  file.add(1, 3);
  file.add({.number = "2", .atoms = {"H", "HA"}});                    // hydrogens at the end
  file.add({.number = "1", .atoms = {"N", "CA"}, .alternate = 'B'});  // alternate locations at the end
  const Trajectory trajectory = read(file.text);
  EXPECT_EQ(trajectory.bead_count(), 9U);
  EXPECT_THAT(trajectory.warnings, IsEmpty());
  EXPECT_EQ(read(file.text, {.selection = Selection::all}).bead_count(), 13U);
  // All atoms of one name come first.
  File by_name;
  for (const char* name : {"N", "CA", "C"})
    for (int number = 1; number <= 4; ++number)
      by_name.add({.number = std::to_string(number), .atoms = {name}});
  EXPECT_EQ(read(by_name.text).bead_count(), 12U);
  // An atom that is repeated in consecutive lines is one atom.
  const Trajectory twice = read(File().add({.atoms = {"N", "N", "CA", "CA", "C", "C"}}).text);
  EXPECT_EQ(twice.frames[0].row(0), Eigen::RowVector3d(0, 3, 6));
  EXPECT_THAT(twice.warnings,
              ElementsAre(HasSubstr("1 residue with an atom of the selection twice, the first counts")));
}

TEST(PdbKinds, ResidueNamesOfFourLetters) {
  using Names = std::vector<std::string>;
  for (const Names& names : std::vector<Names>{{"ALA", "LYSH", "ALA", "HISB", "ALA"},
                                               {"ALA", "LYSH", "HISH", "ALA"},
                                               {"NALA", "ALA", "CALA"},
                                               {"ALA", "ASPH"},
                                               {"GLUH", "ALA", "ALA"},
                                               {"CYS2", "GLY", "CYS2", "GLY"},
                                               {"HISA", "HISB", "HISH"},
                                               {"ALA", "ARGN", "LYSH", "ARGN", "ALA"},
                                               {"HIS1", "ALA", "HIS2"},
                                               {"ALA", "ALA", "TYRP"}})
    for (const char chain : {'A', ' '}) {
      File file;
      for (std::size_t r = 0; r < names.size(); ++r)
        file.add({.number = std::to_string(r + 1), .name = names[r], .chain = chain});
      for (int water = 0; water < 20; ++water)
        file.add({.number = std::to_string(100 + water), .name = "TIP3", .chain = chain, .atoms = {"OH2"}});
      const Trajectory trajectory = read(file.text);
      ASSERT_EQ(trajectory.bead_count(), 3 * names.size()) << names[0] << " " << names[1];
      for (std::size_t r = 0; r < names.size(); ++r)
        EXPECT_EQ(trajectory.bead_names[3 * r],
                  fmt::format("N of {} {} in chain {}", names[r], r + 1, chain == ' ' ? "' '" : "A"));
    }
  EXPECT_THAT(read(File().add(1, 1).add({.number = "2", .name = "LYSH"}).text).warnings,
              ElementsAre(HasSubstr("column 21 is read as the fourth letter of residue names")));
}

TEST(PdbKinds, ChainNamesOfTwoLetters) {
  for (const bool renumbered : {true, false}) {
    File file;
    for (const char chain : {'A', 'B', 'C'})
      for (int r = 1; r <= 3; ++r)
        file.add({.number = std::to_string(renumbered ? r : 3 * (chain - 'A') + r),
                  .name = std::string("ALA") + chain});
    EXPECT_EQ(read(file.text).bead_count(), 9U);
    EXPECT_EQ(read(file.text, {.chain = "BA"}).bead_names[0],
              fmt::format("N of ALA {} in chain BA", renumbered ? 1 : 4));
  }
}

// The element in columns 77 and 78 is used. A C-alpha without an element is carbon.
TEST(PdbKinds, ElementsThatTheFileGives) {
  const std::string chain = test::pdb_residue(1) + test::pdb_residue(2);
  for (const auto& [element, radius] : {std::pair("CA", 2.31), std::pair("C", 1.7), std::pair("", 1.7)}) {
    const std::string atom = pdb_line({.name = "CA", .number = 3, .x = 20, .element = element});
    const Trajectory trajectory = read(chain + atom + "END\n", {.selection = Selection::all});
    ASSERT_EQ(trajectory.element_radii.size(), 7U) << element;
    EXPECT_EQ(trajectory.element_radii.back(), radius) << element;
  }
}

TEST(PdbKinds, AtomsOutsideTheModels) {
  const std::string one = File().add(1, 3).text;
  const std::string model = "MODEL        1\n" + one + "ENDMDL\n";
  const std::string water =
      pdb_line({.name = "O", .residue = "HOH", .chain = 'W', .het = true, .element = "O"});
  for (const std::string& stray : {water, water + water, one, one + "TER\n"})
    for (const char* end : {"END\n", "", "MASTER\nEND\n"})
      for (const int count : {1, 2, 3}) {
        std::string text;
        for (int k = 0; k < count; ++k) text += model;
        const Trajectory trajectory = read(text + stray + end);
        EXPECT_EQ(trajectory.frames.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(trajectory.bead_count(), 9U);
        EXPECT_THAT(
            trajectory.warnings,
            ElementsAre(HasSubstr(fmt::format("with atoms outside MODEL and ENDMDL {} not read (line {}",
                                              stray == water ? "is" : "are", 11 * count + 1))));
      }
  EXPECT_EQ(read(model + water + model + water + "END\n").frames.size(), 2U);
  EXPECT_THAT(read(one + model + model + "END\n").warnings,
              ElementsAre(HasSubstr("outside MODEL and ENDMDL")));
  EXPECT_EQ(read(one + model + model + "END\n").frames.size(), 2U);
  for (const Selection selection : {Selection::automatic, Selection::all})
    refuse("MODEL 1\nENDMDL\n" + model, {"a.pdb: frame 0: no atoms"}, {.selection = selection});
  // Frames are separated by ENDMDL alone.
  EXPECT_EQ(read(model + one + "ENDMDL\n" + one + "ENDMDL\n").frames.size(), 3U);
  EXPECT_EQ(read(one + "ENDMDL\n" + one + "ENDMDL\nEND\n").frames.size(), 2U);
  EXPECT_EQ(read(model + model + "END\n" + model, {.frames = {2, std::nullopt, 1}}).frame_numbers,
            std::vector<std::size_t>{2});
}

TEST(PdbKinds, FilesWithoutPolymer) {
  File file;
  file.add({.number = "1", .name = "NAG", .chain = 'S', .atoms = {"C1", "C2"}, .het = true});
  file.add({.number = "2", .name = "HOH", .chain = 'W', .atoms = {"O"}, .het = true});
  file.add({.number = "3", .name = "HOH", .chain = 'W', .atoms = {"O"}, .het = true});
  refuse(file.text,
         {"no chain of amino acids or nucleotides", "3 residues (NAG, HOH)", "--select all reads them"});
  const ReadOptions all{.selection = Selection::all};
  EXPECT_EQ(read(file.text, all).bead_count(), 2U);
  EXPECT_THAT(read(file.text, all).warnings,
              ElementsAre(HasSubstr("chain W not read; --chain W or --chain S,W")));
  EXPECT_EQ(read(file.text, {.selection = Selection::all, .chain = "W"}).bead_count(), 2U);
  // Reading works in this way beside a polymer, too.
  EXPECT_EQ(read(File().add(1, 2).text + file.text, {.selection = Selection::all, .chain = "W"}).bead_count(),
            2U);
  refuse(File().add(1, 2).text + file.text, {"--select", "'W'", "--select all reads its 2 residues"},
         {.chain = "W"});
  refuse(File().add({.atoms = {"X1", "SC1"}}).text, {"--select", "--select all reads its 1 residue"});
}

TEST(PdbKinds, PolymersOfHetatmRecordsAreToldOf) {
  File file;
  for (int number = 1; number <= 4; ++number) file.add({.number = std::to_string(number), .het = true});
  file.add({.number = "5", .name = "HOH", .atoms = {"O"}, .het = true});
  for (const Selection selection : {Selection::automatic, Selection::backbone, Selection::ca})
    refuse(file.text,
           {"5 residues (ALA, HOH), 4 of them amino acids or nucleotides in HETATM records",
            "--select all reads them"},
           {.selection = selection});
  EXPECT_EQ(read(file.text, {.selection = Selection::all}).bead_count(), 13U);
}

TEST(PdbKinds, ResiduesWithoutTheSelectedAtomsAreCounted) {
  File file;
  for (int number = 1; number <= 10; ++number)
    file.add({.number = std::to_string(number),
              .atoms = number % 3 == 0 ? std::vector<std::string>{"N", "C"}
                                       : std::vector<std::string>{"N", "CA", "C"}});
  const Trajectory backbone = read(file.text);
  EXPECT_EQ(backbone.residues, 10U);
  EXPECT_EQ(backbone.residues_read, 7U);
  EXPECT_THAT(backbone.warnings,
              testing::Contains(testing::EndsWith(
                  "chain A: 7 of 10 residues read; 3 without N, CA and C: ALA 3, ALA 6, ALA 9")));
  EXPECT_THAT(read(file.text, {.selection = Selection::ca}).warnings,
              testing::Contains(HasSubstr("3 without CA: ALA 3")));
  EXPECT_THAT(read(file.text, {.selection = Selection::all}).warnings, IsEmpty());
}

}  // namespace
}  // namespace kds::pdb_kinds_test
