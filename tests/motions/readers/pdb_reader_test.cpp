#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include "tests/motions/reader_files.h"

namespace kds::pdb_reader_test {
namespace {

using test::pdb_line;
using test::pdb_residue;

constexpr test::FileReader read{"a.pdb"};
constexpr test::FileRefusal refuse{"a.pdb"};

std::string models(const std::vector<std::string>& texts) {
  std::string all;
  for (std::size_t k = 0; k < texts.size(); ++k)
    all += "MODEL     " + std::to_string(k + 1) + "\n" + texts[k] + "ENDMDL\n";
  return all + "END\n";
}

// A cut file is refused, has lost its last model, or gives the frames of the whole file.
TEST(PdbReader, CutAnywhere) {
  const std::string model = pdb_residue(1) + pdb_residue(2);
  for (const auto& [text, frames] : {std::pair(model, 1U),
                                     {model + "TER\nCONECT    1    2\nEND\n", 1U},
                                     {models({model}), 1U},
                                     {models({model, model}), 2U}}) {
    const Trajectory whole = read(text);
    ASSERT_EQ(whole.frames.size(), frames);
    const std::size_t last_model = text.rfind("MODEL ") == std::string::npos ? 0 : text.rfind("MODEL ");
    const std::size_t last_atom = text.rfind("ATOM"), atoms_end = text.find('\n', last_atom);
    for (std::size_t size = last_model + 1; size < text.size(); ++size) {
      SCOPED_TRACE(size);
      try {
        const Trajectory cut = read(text.substr(0, size));
        const bool lost = cut.frames.size() < frames;
        EXPECT_EQ(cut.truncated, lost);
        const bool at_line_end = text[size - 1] == '\n' || text[size] == '\n';  // cannot be noticed
        EXPECT_TRUE(lost || size >= atoms_end || at_line_end) << "an atom is lost";
        for (std::size_t k = 0; k < cut.frames.size(); ++k) {
          if (!lost && size < atoms_end) break;
          EXPECT_EQ(cut.frames[k], whole.frames[k]);
        }
      } catch (const InputError& error) {
        EXPECT_EQ(frames, 1U) << error.what();
        EXPECT_LT(size, text.size() - 1) << error.what();
      }
    }
  }
}

TEST(PdbReader, AFileThatEndsInsideItsLastNumber) {
  const std::string model = pdb_residue(1) + pdb_residue(2);
  const std::size_t last = model.rfind("ATOM");
  refuse(model.substr(0, last + 53), {"a.pdb: the file ends inside its only model", "expected a line end"});
  refuse(model.substr(0, last + 60), {"the file ends inside its only model"});
  refuse(model.substr(0, last + 2), {"the file ends inside its only model"});
  const Trajectory before =
      read("MODEL        1\n" + model + "ENDMDL\nMODEL        2\n" + model.substr(0, last + 52));
  EXPECT_EQ(before.frames.size(), 1U);
  EXPECT_TRUE(before.truncated);
  EXPECT_THAT(before.warnings, testing::Contains(testing::HasSubstr("its last number may be cut off")));
  // A topology, too.
  const auto dcd = test::write_file("t.dcd", test::DcdMaker::chain(6, 2).bytes());
  const auto topology = test::write_file("a.pdb", model.substr(0, last + 53));
  test::expect_refused([&] { (void)read_trajectory(dcd, {.topology = topology}); },
                       {"a.pdb", "expected a line end"});
}

TEST(PdbReader, ModelsThatAreAnnouncedAndMissing) {
  const std::string model = pdb_residue(1) + pdb_residue(2);
  const auto warnings = [](const std::string& text) { return read(text).warnings; };
  EXPECT_THAT(warnings("NUMMDL    3\n" + models({model, model})),
              testing::Contains(testing::HasSubstr("NUMMDL announces 3 models, the file has 2")));
  EXPECT_THAT(warnings("NUMMDL    2\n" + models({model, model})), testing::IsEmpty());
  EXPECT_THAT(warnings("MODEL        1\n" + model),
              testing::Contains(testing::HasSubstr("no ENDMDL ends it; the file may be cut off")));
  EXPECT_THAT(warnings("MODEL        1\n" + model + "END\n"), testing::IsEmpty());
}

TEST(PdbReader, RealFiles) {
  struct Expected {
    const char* file;
    std::size_t beads, frames, breaks;
  };
  for (const Expected& e : {Expected{"proteins/2f4k.pdb", 105, 1, 0},
                            {"proteins/1ejg.pdb", 138, 1, 0},
                            {"proteins/1l2y.pdb", 60, 38, 0},
                            {"proteins/6wqa.cif", 1173, 1, 1}}) {
    const Trajectory trajectory = read_trajectory(test::data_file(e.file));
    EXPECT_EQ(trajectory.bead_count(), e.beads) << e.file;
    EXPECT_EQ(trajectory.frames.size(), e.frames) << e.file;
    EXPECT_EQ(trajectory.breaks.size(), e.breaks) << e.file;
    EXPECT_EQ(trajectory.warnings.size(), e.breaks) << e.file;
    EXPECT_EQ(trajectory.element_radii.size(), e.beads) << e.file;
    EXPECT_EQ(read_trajectory(test::data_file(e.file), {.selection = Selection::ca}).bead_count() * 3,
              e.beads);
  }
}

TEST(PdbReader, AllAtomsOfThePolymerOnly) {
  // The file has exactly 304 atoms.
  EXPECT_EQ(read_trajectory(test::data_file("proteins/1l2y.pdb"), {.selection = Selection::all}).bead_count(),
            304U);
  const std::string water =
      pdb_line({.name = "O", .residue = "HOH", .number = 9, .het = true, .element = "O"});
  const std::string sugar = pdb_line({.name = "C1", .residue = "NAG", .number = 8, .het = true});
  const std::string calcium =
      pdb_line({.name = "CA", .residue = "CA", .number = 7, .het = true, .element = "CA"});
  const std::string side = pdb_line({.name = "CB", .number = 2});
  for (const char* ter : {"", "TER\n"}) {
    const std::string text = pdb_residue(1) + pdb_residue(2) + side + ter + water + sugar + calcium;
    EXPECT_EQ(read(text, {.selection = Selection::all}).bead_count(), 7U);
    EXPECT_EQ(read(text, {.selection = Selection::ca}).bead_count(), 2U);
    EXPECT_EQ(read(text).bead_count(), 6U);
  }
}

TEST(PdbReader, FirstAlternateLocation) {
  std::string text = pdb_line({.name = "N", .x = 1, .alternate = 'A', .element = "N"}) +
                     pdb_line({.name = "N", .x = 2, .alternate = 'B', .element = "N"}) +
                     pdb_line({.name = "CA", .x = 3, .alternate = 'B'}) +
                     pdb_line({.name = "CA", .x = 4, .alternate = 'A'}) + pdb_line({.name = "C", .x = 5});
  const Trajectory trajectory = read(text);
  EXPECT_EQ(trajectory.frames[0].row(0), Eigen::RowVector3d(1, 3, 5));
  EXPECT_EQ(read(text, {.selection = Selection::all}).bead_count(), 3U);
}

TEST(PdbReader, TwoResiduesAtOnePosition) {
  std::string text;
  for (const char* name : {"N", "CA", "C"})
    for (const char* residue : {"PRO", "SER"})
      text += pdb_line({.name = name,
                        .residue = residue,
                        .x = residue[0] == 'P' ? 1.0 : 2.0,
                        .alternate = residue[0] == 'P' ? 'A' : 'B',
                        .element = std::string(1, name[0])});
  const Trajectory trajectory = read(text);
  EXPECT_EQ(trajectory.frames[0].row(0), Eigen::RowVector3d(1, 1, 1));
}

TEST(PdbReader, InsertionCodesAreResidues) {
  EXPECT_EQ(read(pdb_line({.number = 5}) + pdb_line({.number = 5, .x = 3.8, .insertion = 'A'}),
                 {.selection = Selection::ca})
                .bead_count(),
            2U);
}

TEST(PdbReader, ModifiedResiduesInsideTheChainCount) {
  std::string odd;
  for (const char* name : {"N", "CA", "C"})
    odd += pdb_line(
        {.name = name, .residue = "ZZZ", .number = 2, .het = true, .element = std::string(1, name[0])});
  EXPECT_EQ(read(pdb_residue(1) + odd + pdb_residue(3)).bead_count(), 9U);
  EXPECT_EQ(read(pdb_residue(1) + odd + pdb_residue(3) + "TER\n").bead_count(), 9U);
}

TEST(PdbReader, Chains) {
  const std::string text =
      pdb_line({.name = "O", .residue = "HOH", .chain = 'W', .het = true, .element = "O"}) +
      pdb_residue(1, 'B') + pdb_residue(1, 'A') + pdb_residue(2, 'A');
  EXPECT_EQ(read(text).bead_count(), 3U);
  EXPECT_EQ(read(text, {.chain = "A"}).bead_count(), 6U);
  refuse(text, {"--chain", "a.pdb", "'X'", "expected B, A"}, {.chain = "X"});
  refuse(text, {"--select", "'W'", "a.pdb"}, {.chain = "W"});
  refuse(pdb_line({.name = "O", .residue = "HOH", .het = true, .element = "O"}),
         {"a.pdb", "no chain of amino acids"});
  EXPECT_EQ(read(pdb_residue(1, ' '), {.chain = " "}).bead_count(), 3U);
}

TEST(PdbReader, SeveralChainsAreANecklaceEach) {
  const std::string model = pdb_residue(1, 'A') + pdb_residue(2, 'A') + pdb_residue(1, 'B', 9) +
                            pdb_residue(1, 'C', 20) + pdb_residue(7, 'C', 20);
  const std::filesystem::path file =
      test::write_file("a.pdb", "MODEL 1\n" + model + "ENDMDL\nMODEL 2\n" + model + "ENDMDL\n");
  const std::vector<Trajectory> necklaces = read_trajectories(file, {.chain = "C,A"});
  ASSERT_EQ(necklaces.size(), 2U);
  EXPECT_EQ(necklaces[0].file, file.string() + " chain C");
  EXPECT_EQ(necklaces[0].frames[1].row(1).minCoeff(), 20);
  EXPECT_EQ(necklaces[0].breaks, std::vector<std::size_t>{2});  // no break between the chains
  EXPECT_EQ(necklaces[1].frames[1].row(1).maxCoeff(), 0);
  EXPECT_TRUE(necklaces[1].breaks.empty());
  for (const Trajectory& necklace : necklaces) {
    EXPECT_EQ(necklace.bead_count(), 6U);
    EXPECT_EQ(necklace.element_radii.size(), 6U);
    EXPECT_EQ(necklace.frame_numbers, (std::vector<std::size_t>{0, 1}));
  }
  EXPECT_EQ(read_trajectories(file).size(), 1U);
  refuse(model, {"--chain", "one chain"}, {.chain = "A,B"});
  refuse(model, {"--chain", "'A' is listed twice"}, {.chain = "A,B,A"});
  refuse(model, {"--chain", "has no chain 'X'", "A, B, C"}, {.chain = "A,X"});
}

TEST(PdbReader, FramesMayBeParted) {
  const std::string one = pdb_residue(1);
  EXPECT_EQ(read(one + "ENDMDL\n" + one + "ENDMDL\n").frames.size(), 2U);
  EXPECT_EQ(read(one + "END\n" + one + "END\n").frames.size(), 2U);
  EXPECT_EQ(read("MODEL 1\n" + one + "MODEL 2\n" + one).frames.size(), 2U);
  EXPECT_EQ(read("MODEL        1\n" + one + "ENDMDL\nMODEL        1\n" + one + "ENDMDL\n").frames.size(), 2U);
  EXPECT_EQ(read("REMARK 1\r\n" + one).frames.size(), 1U);
  EXPECT_EQ(read("REMARK\r\r\n" + one).frames[0], read(one).frames[0]);
}

TEST(PdbReader, ModelsMustHaveTheSameAtoms) {
  refuse(models({pdb_residue(1), pdb_residue(2)}),
         {"a.pdb: frame 1: bead 0 is N of ALA 2", "in frame 0 it is N of ALA 1"});
  refuse(models({pdb_residue(1) + pdb_residue(2), pdb_residue(1)}), {"a.pdb: frame 1: 3 beads, expected 6"});
  refuse(models({pdb_residue(1), "", pdb_residue(1)}), {"a.pdb: frame 1:"});
}

TEST(PdbReader, FileThatEndsInsideAModel) {
  const std::string whole = models({pdb_residue(1), pdb_residue(1), pdb_residue(1)});
  const std::string cut = whole.substr(0, whole.size() - 100);
  for (const FrameRange& range : {FrameRange{}, FrameRange{0, 2, 1}}) {
    const Trajectory read_whole = read(cut, {.frames = range});
    EXPECT_EQ(read_whole.frames.size(), 2U);
    ASSERT_EQ(read_whole.warnings.size(), 1U);
    EXPECT_NE(read_whole.warnings[0].find("inside frame 2"), std::string::npos);
    EXPECT_NE(read_whole.warnings[0].find("last whole frame is 1"), std::string::npos);
  }
}

TEST(PdbReader, CompressedFile) {
  const std::string text = test::read_bytes(test::data_file("proteins/2f4k.pdb"));
  EXPECT_EQ(read_trajectory(test::write_gzipped("a.PDB.gz", text)).bead_count(), 105U);
}

TEST(PdbReader, OneBead) { EXPECT_EQ(read(pdb_line({}), {.selection = Selection::ca}).bead_count(), 1U); }

TEST(PdbReader, ShiftedNamesWithoutElements) {
  // CHARMM writes names from column 13 on, and no element column.
  std::string text;
  for (const char* name : {"N   ", "HN  ", "CA  ", "HG1 ", "CD  ", "SG  ", "C   "})
    text +=
        std::string("ATOM      1 ") + name + " HSD     1       1.000   2.000   3.000  1.00  0.00      SEGA\n";
  EXPECT_EQ(read(text).element_radii, (std::vector<double>{1.55, 1.7, 1.7}));
  EXPECT_EQ(read(text, {.selection = Selection::all}).element_radii,
            (std::vector<double>{1.55, 1.2, 1.7, 1.2, 1.7, 1.8, 1.7}));
}

TEST(PdbReader, CellsOfCrystalsAreNoBoxes) {
  const auto frame = [](double x) {
    return pdb_line({.number = 1, .x = 9}) + pdb_line({.number = 2, .x = x}) +
           pdb_line({.number = 3, .x = x + 2});
  };
  const ReadOptions ca{.selection = Selection::ca};
  const std::string box = "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 1           1\n";
  const std::string crystal = "CRYST1   10.000   10.000   10.000  90.00  90.00  90.00 P 21 21 21    4\n";
  const std::string dummy = "CRYST1    1.000    1.000    1.000  90.00  90.00  90.00 P 1           1\n";
  EXPECT_EQ(read(box + models({frame(1), frame(1)}), ca).frames[1](0, 1), 11);
  EXPECT_EQ(read(models({box + frame(1), box + frame(1)}), ca).frames[1](0, 1), 11);
  EXPECT_EQ(read(box + frame(1), ca).frames[0](0, 1), 1);
  EXPECT_EQ(read(crystal + models({frame(1), frame(1)}), ca).frames[1](0, 1), 1);
  EXPECT_EQ(read(dummy + models({frame(1), frame(1)}), ca).frames[1](0, 1), 1);
  for (const std::string group : {"p 1", "P1 ", "p1 ", " P1"}) {
    std::string same = box;
    same.replace(same.find("P 1"), 3, group);
    EXPECT_EQ(read(same + models({frame(1), frame(1)}), ca).frames[1](0, 1), 11) << group;
  }
}

TEST(PdbReader, LargeTopology) {
  std::string text;
  for (int i = 0; i < 100010; ++i)
    text += pdb_line(
        {.name = "O", .residue = "HOH", .chain = 'W', .number = i % 10000, .het = true, .element = "O"});
  const auto topology = test::write_file("t.pdb", text + pdb_residue(1));
  const test::DcdMaker maker = test::DcdMaker::chain(100013, 1);
  const Trajectory trajectory =
      read_trajectory(test::write_file("a.dcd", maker.bytes()), {.topology = topology});
  EXPECT_EQ(trajectory.frames[0](0, 0), 1.5 * 100010);
}

}  // namespace
}  // namespace kds::pdb_reader_test
