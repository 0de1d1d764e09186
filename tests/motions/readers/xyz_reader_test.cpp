#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"

namespace kds::xyz_reader_test {
namespace {

Trajectory read(std::string_view text, const ReadOptions& options = {}) {
  return read_trajectory(test::write_file("a.xyz", text), options);
}

void refuse(std::string_view text, std::initializer_list<std::string_view> parts,
            const ReadOptions& options = {}) {
  test::expect_refused([&] { (void)read(text, options); }, parts);
}

constexpr std::string_view two_frames = "2\nfirst\nC 0 0.1 0\nN 1.5 0 0 extra 7\n2\n\nC 0 1 0\nN 1.5 1 0\n";

TEST(XyzReader, ReadsFrames) {
  const Trajectory trajectory = read(two_frames);
  ASSERT_EQ(trajectory.frames.size(), 2U);
  EXPECT_EQ(trajectory.bead_count(), 2U);
  EXPECT_EQ(trajectory.frames[0](1, 0), 0.1);
  EXPECT_EQ(trajectory.frames[1](1, 1), 1);
  EXPECT_EQ(trajectory.element_radii, (std::vector<double>{1.7, 1.55}));
  EXPECT_EQ(trajectory.frame_numbers, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(trajectory.warnings.empty());
}

TEST(XyzReader, SelectsFrames) {
  const Trajectory trajectory = read(two_frames, {.frames = {1, std::nullopt, 1}});
  ASSERT_EQ(trajectory.frames.size(), 1U);
  EXPECT_EQ(trajectory.frame_numbers, (std::vector<std::size_t>{1}));
  EXPECT_EQ(trajectory.frames[0](1, 0), 1);
}

TEST(XyzReader, OneBeadAndCoincidentBeadsAreLegal) {
  EXPECT_EQ(read("1\n\nX 1 2 3\n").bead_count(), 1U);
  EXPECT_TRUE(read("1\n\nX 1 2 3\n").element_radii.empty());
  EXPECT_EQ(read("3\n\nC 1 2 3\nC 1 2 3\nC 1 2 3\n").breaks.size(), 0U);
}

TEST(XyzReader, Refuses) {
  refuse("", {"a.xyz", "no frame"});
  refuse("x\n", {"a.xyz:1:", "number of atoms"});
  refuse("2 3\n\nC 0 0 0\nC 0 0 0\n", {"a.xyz:1:"});
  refuse("0\n\n", {"a.xyz:1:", "at least 1 atom"});
  refuse("2\n\nC 0 0\nC 0 0 0\n", {"a.xyz:3:", "3 fields"});
  refuse("1\n\nC 0 0 z\n1\n\nC 0 0 0\n", {"a.xyz:3:", "'z'"});
  refuse("1\n\nC 0 0 0\n2\n\nC 0 0 0\nC 0 0 1\n", {"a.xyz: frame 1, byte 11: 2 atoms, expected 1"});
  refuse("1\n\nC 0 0 0\n1\n\nC 0 nan 0\n", {"a.xyz: frame 1: bead 0 has y = nan"});
  refuse("1\n\nC inf 0 0\n", {"a.xyz: frame 0: bead 0 has x = inf"});
  refuse("99999999999999\n\nC 0 0 0\n", {"inside frame 0"});
  refuse(two_frames, {"--select"}, {.selection = Selection::backbone});
  refuse(two_frames, {"--select"}, {.selection = Selection::ca});
  refuse(two_frames, {"--chain"}, {.chain = "A"});
  test::expect_refused([] { (void)read_trajectory("no-such-file.xyz"); },
                       {"no-such-file.xyz", "cannot open"});
}

TEST(XyzReader, ColumnsThatRunTogether) {
  refuse("1\n\nC-100.125 0 0 7\n", {"a.xyz:3:", "'C-100.125'", "run together"});
  refuse("1\n\nC1100.125 0 0 7\n", {"a.xyz:3:", "run together"});
  refuse("1\n\nC 100.125-100.125 0 7\n", {"a.xyz:3:", "'100.125-100.125'"});
  refuse("1\n\nC ******** 0 7\n", {"a.xyz:3:", "'********'"});
  EXPECT_EQ(read("1\n\nC.3 1 2 3\n").frames[0], Eigen::Vector3d(1, 2, 3));
}

TEST(XyzReader, FileThatEndsInsideAFrame) {
  const std::string cut(two_frames.substr(0, two_frames.size() - 12));
  for (const FrameRange& range : {FrameRange{}, FrameRange{0, 1, 1}}) {
    const Trajectory whole = read(cut, {.frames = range});
    EXPECT_EQ(whole.frames.size(), 1U);
    ASSERT_EQ(whole.warnings.size(), 1U);
    EXPECT_NE(whole.warnings[0].find("ends inside frame 1"), std::string::npos);
    EXPECT_NE(whole.warnings[0].find("last whole frame is 0"), std::string::npos);
  }
}

// A number that is cut off must not be read as another one.
TEST(XyzReader, LastNumberWithoutLineEnd) {
  const auto frame = [](const std::string& last) {
    const bool has_further_column = last.find(" 0") != std::string::npos;
    return fmt::format("2\n\nC 0.125 1.000 0.500{}\nC 1.250 0.125 {}", has_further_column ? " 0" : "", last);
  };
  for (const std::string last : {"2", "2.", "2.3", "2.34"}) {
    const Trajectory before = read(frame("2.345\n") + frame(last));
    EXPECT_EQ(before.frames.size(), 1U) << last;
    EXPECT_TRUE(before.truncated) << last;
    ASSERT_EQ(before.warnings.size(), 1U) << last;
    EXPECT_NE(before.warnings[0].find("expected a line end"), std::string::npos) << before.warnings[0];
    refuse(frame(last), {"ends inside frame 0", "expected a line end"});
  }
  refuse("1\n\nC 1 2 3", {"expected a line end"});         // may be 34
  refuse("1\n\nC 1.5 2.25 3.5", {"expected a line end"});  // may be 3.55
  // All decimals are there, or something after the number shows that it is whole.
  for (const std::string last : {"2.345", "2 ", "2.3 0", "2.3\t"})
    for (const std::string& text : {frame("2.345\n") + frame(last), frame(last)}) {
      const Trajectory all = read(text);
      EXPECT_EQ(all.frames.back()(2, 1), std::stod(last)) << text;
      EXPECT_FALSE(all.truncated) << text;
      EXPECT_TRUE(all.warnings.empty()) << text;
    }
  EXPECT_EQ(read("2\n\nC 0 0 0 1.25 1.25\nC 1.5 0 2.3 1.2").frames[0](2, 1), 2.3) << "cut off behind it";
  // A symbol or an id may be cut off, too.
  refuse("1\nProperties=pos:R:3:species:S:1\n0.1 0.2 0.3 C", {"expected a line end"});
  refuse("1\nProperties=species:S:1:pos:R:3:id:I:1\nC 0.1 0.2 0.3 1", {"expected a line end"});
}

TEST(XyzReader, CutAnywhere) {
  const std::string path = test::temporary("a.xyz").string();
  for (std::size_t size = 0; size < two_frames.size(); ++size) {
    test::write_file("a.xyz", two_frames.substr(0, size));
    try {
      const Trajectory trajectory = read_trajectory(path);
      for (const auto& frame : trajectory.frames) EXPECT_EQ(frame.cols(), 2);
    } catch (const InputError&) {
    }
  }
}

TEST(XyzReader, ExtendedXyz) {
  // The second bead lies beyond the wall.
  const Trajectory trajectory = read(
      "2\nLattice=\"10 0 0 0 10 0 0 0 10\" Properties=species:S:1:pos:R:3:id:I:1\nC 9.5 0 0 1\nC 0.75 0 0 "
      "2\n");
  EXPECT_EQ(trajectory.frames[0](0, 1), 10.75);
  ASSERT_EQ(trajectory.warnings.size(), 1U);
  EXPECT_NE(trajectory.warnings[0].find("made whole"), std::string::npos);
  refuse("1\nLattice=\"10 0 0 0 10\"\nC 0 0 0\n", {"a.xyz:2:", "9 numbers"});
  refuse("1\nLattice=\"10 0 0 0 10 0 0 0 x\"\nC 0 0 0\n", {"a.xyz:2:", "'x'"});
  // A flat lattice is not a cell.
  EXPECT_TRUE(read("2\nLattice=\"0 0 0 0 0 0 0 0 0\"\nC 9 0 0\nC 1 0 0\n").warnings.empty());
}

// Every way to write a cell of length 10 makes this chain whole: bonds of 8.75 become 1.25.
TEST(XyzReader, LatticeInEveryForm) {
  for (const std::string_view comment :
       {"Lattice=\"10 0 0 0 10 0 0 0 10\"", "Lattice = \"10 0 0 0 10 0 0 0 10\"",
        "Lattice='10 0 0 0 10 0 0 0 10'", "Lattice={10 0 0 0 10 0 0 0 10}",
        "Lattice=[[10,0,0],[0,10,0],[0,0,10]]", "Lattice= [ [10.0 , 0, 0], [0,1e1,0],\t[0,0,+1.0D+01] ]",
        "Lattice=[10, 0, 0, 0, 10, 0, 0, 0, 10]", "Lattice=\"[[10,0,0],[0,10,0],[0,0,10]]\"",
        "lattice=\"1d1 0 0 0 1.0d01 0 0 0 10.\"", "LATTICE=\"10 10 10\"",
        "\"Lattice\"=\"10 0 0 0 10 0 0 0 10\"",
        "energy=-3.5 note=\"a \\\" b = c\" Lattice=\"10 0 0 0 10 0 0 0 10\"",
        "made by hand, step 3 Lattice=\"10,0,0,0,10,0,0,0,10\" pbc=\"T T T\"",
        "Lattice=\"10 0 0 0 10 0 0 0 10\" pbc=[True, true, TRUE]", "pbc=T Lattice=\"10 0 0 0 10 0 0 0 10\"",
        "Lattice=\"10 0 0 0 10 0 0 0 10\" pbc=\"1 1 1\"", "Lattice=\"10 0 0 0 5 0 0 0 0\" pbc=\"T F F\"",
        "stress=[[1,2],[3,4]] Lattice=\"10 0 0 0 10 0 0 0 10\" tags={a \"b c\" d}"}) {
    const Trajectory trajectory = read("3\n" + std::string(comment) + "\nC 9.5 0 0\nC 0.75 0 0\nC 2 0 0\n");
    EXPECT_EQ(trajectory.frames[0](0, 1), 10.75) << comment;
    EXPECT_EQ(trajectory.frames[0](0, 2), 12) << comment;
    EXPECT_EQ(trajectory.warnings.size(), 1U) << comment;
  }
}

TEST(XyzReader, AxesThatAreNotPeriodicStay) {
  for (const std::string_view pbc :
       {"\"F F F\"", "[F, F, F]", "F", "\"F T T\"", "[False,True,True]", "\"false true T\"", "{F T F}",
        "'0 1 1'", "[FALSE, F, T]", "\"F F T\""}) {
    const Trajectory trajectory = read("3\nLattice=\"10 0 0 0 10 0 0 0 10\" pbc=" + std::string(pbc) +
                                       "\nC 9.5 0 0\nC 0.75 0 0\nC 2 0 0\n");
    EXPECT_EQ(trajectory.frames[0](0, 1), 0.75) << pbc;
  }
}

TEST(XyzReader, PropertiesInAnyOrder) {
  struct Case {
    std::string_view comment, line;
  };
  for (const Case& one : std::initializer_list<Case>{
           {"Properties = id:I:1:species:S:1:pos:R:3", "1 C 1 2 3"},
           {"Properties=pos:R:3:species:S:1", "1 2 3 C"},
           {"properties=pos:R:3", "1 2 3"},
           {"PROPERTIES=\"pos:R:3:Z:I:1\"", "1 2 3 6"},
           {"Properties='species:S:1:pos:R:3:forces:R:3'", "C 1 2 3 9 9 9"},
           {"Properties=species:S:1:move_mask:L:1:pos:R:3", "C T 1 2 3"},
           {"Properties=velo:R:3:Pos:R:3:Species:S:1", "7 8 9 1 2 3 C"},
           {"Lattice=\"90 0 0 0 90 0 0 0 90\" Properties=species:S:1:pos:R:3:tag:S:2", "C 1 2 3 a b"},
           {"Properties =species:S:1:pos:R:3", "C 1D0 2.0d+00 3e0"},
           {"Properties= species:S:1:mass:R:1:pos:R:3", "C 12.011 1 2 3"}}) {
    const std::string text = "1\n" + std::string(one.comment) + "\n" + std::string(one.line) + "\n";
    const Trajectory trajectory = read(text + text);
    ASSERT_EQ(trajectory.frames.size(), 2U) << one.comment;
    EXPECT_EQ(trajectory.frames[1], Eigen::Vector3d(1, 2, 3)) << one.comment;
    EXPECT_EQ(trajectory.element_radii.empty(), one.line.find_first_of("C6") == std::string_view::npos)
        << one.comment;
    EXPECT_TRUE(trajectory.warnings.empty()) << one.comment;
  }
}

TEST(XyzReader, RefusesCommentsThatCannotBeRead) {
  const auto refuse_comment = [](std::string_view comment, std::string_view part) {
    refuse("1\n" + std::string(comment) + "\nC 0 0 0\n", {"a.xyz:2:", part});
  };
  refuse_comment("Lattice=\"10 0 0 0 10 0 0 0 10", "not closed");
  refuse_comment("Lattice=[[10,0,0],[0,10,0],[0,0,10]", "not closed");
  refuse_comment("Lattice=[[10,0],[0,10,0],[0,0,10]]", "3 rows");
  refuse_comment("Lattice=[[10,0,0],[0,10,0]]", "9 numbers");
  refuse_comment("Lattice=", "9 numbers");
  refuse_comment("Lattice=\"10 0 0 0 10 0 0 0 x\"", "'x'");
  refuse_comment("Lattice=\"10 10 10\" Lattice=\"20 20 20\"", "twice");
  refuse_comment("note=\"open Lattice=5", "not closed");
  refuse_comment("\"open Lattice = 5", "not closed");
  refuse_comment("note=[a Properties=species:S:1:forces:R:3:pos:R:3", "not closed");
  refuse_comment("note={a Lattice=\"10 0 0 0 10 0 0 0 10\"", "not closed");
  refuse_comment("note=[[a,b],[c Lattice=\"10 0 0 0 10 0 0 0 10\"", "not closed");
  refuse_comment("title \"a Lattice=\"10 0 0 0 10 0 0 0 10\"", "inside the quotes");
  refuse_comment("\"Properties=species:S:1:forces:R:3:pos:R:3\"", "inside the quotes");
  refuse_comment("Lattice=\"10 10 10\" pbc=\"T T\"", "pbc");
  refuse_comment("Lattice=\"10 10 10\" pbc=\"T T maybe\"", "'maybe'");
  refuse_comment("# CELL(abcABC): 20 20 20 90 90 90 Step: 0 positions{atomic_unit}", "angstrom");
  refuse_comment("Properties=species:S:1", "pos:R:3");
  refuse_comment("Properties=species:S:1:pos:R:2", "pos:R:3");
  refuse_comment("Properties=species:S:1:pos:S:3", "pos:R:3");
  refuse_comment("Properties=species:S:pos:R:3", "name:type:count");
  refuse_comment("Properties=species:S:1:pos:R:3:pos:R:3", "twice");
  refuse_comment("Properties=species:S:0:pos:R:3", "name:type:count");
  refuse("1\nProperties=species:S:1:pos:R:3\nC 0 0 0 1\n", {"a.xyz:3:", "4 columns", "found 5"});
  refuse("1\nProperties=species:S:1:pos:R:3\nC 0 0-1\n", {"a.xyz:3:", "4 columns", "found 3"});
}

TEST(XyzReader, PlainCommentsAreAnyText) {
  for (const std::string_view comment : {"it's 5\" wide = no", "\"open", "= = =", "a=", "\\", "E=[1,2", "x={",
                                         "step 3, Lattice of nothing", "'", "===="}) {
    const Trajectory trajectory = read("1\n" + std::string(comment) + "\nC 1 2 3 4 5\n");
    EXPECT_EQ(trajectory.frames[0], Eigen::Vector3d(1, 2, 3)) << comment;
    EXPECT_TRUE(trajectory.warnings.empty()) << comment;
  }
}

TEST(XyzReader, CellsThatAreNotUsedAreToldOf) {
  for (const std::string_view comment :
       {"Lattice=\"10 0 0 0 10 0 0 0 0\"", "Lattice=\"10 0 0 20 0 0 0 0 10\"",
        "Lattice=\"nan 0 0 0 10 0 0 0 10\"", "Lattice=\"inf 10 10\"", "cell=\"10 10 10\"",
        "# CELL(abcABC): 10 10 10 90 90 90 Step: 0 positions{angstrom} cell{angstrom}",
        "Box = [10, 10, 10]"}) {
    const Trajectory trajectory = read("3\n" + std::string(comment) + "\nC 9.5 0 0\nC 0.75 0 0\nC 2 0 0\n");
    EXPECT_EQ(trajectory.frames[0](0, 1), 0.75) << comment;
    ASSERT_FALSE(trajectory.warnings.empty()) << comment;
    EXPECT_NE(trajectory.warnings[0].find("frame 0: its periodic cell is not used"), std::string::npos)
        << trajectory.warnings[0];
  }
}

TEST(XyzReader, MisspeltKeysAreToldOf) {
  using Case = std::pair<std::string_view, std::string_view>;
  for (const auto& [comment, line] :
       {Case{"latice=\"10 10 10\"", "'latice' is not read, did you mean Lattice?"},
        Case{"Lattices = [10, 10, 10]", "'Lattices' is not read, did you mean Lattice?"},
        Case{"Latitce=\"10 10 10\"", "'Latitce' is not read, did you mean Lattice?"},
        Case{"Property=species:S:1:pos:R:3", "'Property' is not read, did you mean Properties?"},
        Case{"propertis=pos:R:3:species:S:1", "'propertis' is not read, did you mean Properties?"},
        Case{"PCB=\"T T F\"", "'PCB' is not read, did you mean pbc?"},
        Case{"\"lattic\"=1 propertie=2", "Lattice? the key 'propertie' is not read, did you mean"}}) {
    const std::string frame = "2\n" + std::string(comment) + "\nC 1 2 3\nC 2 2 3\n";
    const Trajectory trajectory = read("2\n\nC 1 2 3\nC 2 2 3\n" + frame + frame);
    ASSERT_EQ(trajectory.warnings.size(), 1U) << comment;
    EXPECT_NE(trajectory.warnings[0].find("a.xyz: frame 1: the key "), std::string::npos);
    EXPECT_NE(trajectory.warnings[0].find(line), std::string::npos) << trajectory.warnings[0];
    EXPECT_TRUE(trajectory.warnings[0].ends_with("(2 frames)")) << trajectory.warnings[0];
  }
  // Other keys, words without '=', and keys that resemble the supported key.
  for (const std::string_view comment : {"sublattice=1 proper=2", "pbe=-12.5 pc=3.25", "latice of 10", "pbcs",
                                         "Lattice=\"90 90 90\" lattices=5", "lattice_a=3 property_name=x"}) {
    EXPECT_TRUE(read("1\n" + std::string(comment) + "\nC 1 2 3\n").warnings.empty()) << comment;
  }
}

TEST(XyzReader, AtomNamesAreNoElements) {
  const auto radii = [](std::initializer_list<std::string_view> symbols, bool told) {
    std::string text = std::to_string(symbols.size()) + "\n\n";
    double x = 0;
    for (const std::string_view symbol : symbols)
      text += std::string(symbol) + " " + std::to_string(x += 1.5) + " 0 0\n";
    const Trajectory trajectory = read(text);
    EXPECT_EQ(!trajectory.warnings.empty(), told) << text;
    return trajectory.element_radii;
  };
  using Radii = std::vector<double>;
  EXPECT_EQ(radii({"N", "CA", "C", "N", "CA", "C"}, true), (Radii{1.55, 1.7, 1.7, 1.55, 1.7, 1.7}));
  EXPECT_EQ(radii({"N", "CA", "C", "O"}, true), (Radii{1.55, 1.7, 1.7, 1.52}));
  EXPECT_EQ(radii({"CA", "CA", "CA"}, true), (Radii{1.7, 1.7, 1.7}));
  EXPECT_EQ(radii({"N", "CA", "C", "O", "CB", "CG1", "CD"}, true),
            (Radii{1.55, 1.7, 1.7, 1.52, 1.7, 1.7, 1.7}));
  EXPECT_EQ(radii({"CB", "HB3", "SG"}, false), (Radii{1.7, 1.2, 1.8}));
  EXPECT_EQ(radii({"NE", "CZ", "NH1"}, true), (Radii{1.55, 1.7, 1.55}));
  EXPECT_EQ(radii({"HG", "OG", "CB"}, true), (Radii{1.2, 1.52, 1.7}));
  EXPECT_EQ(radii({"Ca", "C", "O"}, false), (Radii{2.31, 1.7, 1.52}));
  EXPECT_EQ(radii({"CA", "C", "O", "O", "O"}, true),
            (Radii{2.31, 1.7, 1.52, 1.52, 1.52}));  // calcium carbonate
  EXPECT_EQ(radii({"6", "7", "8"}, false), (Radii{1.7, 1.55, 1.52}));
  EXPECT_EQ(radii({"NA", "CL"}, false), (Radii{2.27, 1.75}));
  EXPECT_EQ(radii({"BB", "SC1"}, false), Radii{});
}

TEST(XyzReader, AtomsKeepTheirOrder) {
  refuse("2\n\nC 0 0 0\nN 1 0 0\n2\n\nN 1 0 0\nC 0 0 0\n",
         {"a.xyz:7:", "frame 1: atom 0 has symbol 'N', expected 'C'"});
  const std::string properties = "2\nProperties=id:I:1:pos:R:3\n";
  refuse(properties + "1 0 0 0\n2 1 0 0\n" + properties + "2 1 0 0\n1 0 0 0\n",
         {"a.xyz:7:", "has id '2', expected '1'"});
}

std::filesystem::path gzipped(const std::string& name, std::string_view text) {
  const auto path = test::temporary(name);
  const gzFile out = gzopen(path.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  return path;
}

TEST(XyzReader, OtherEndings) {
  for (const std::string name : {"a.extxyz", "a.EXTXYZ", "a.xyz.gz", "a.extxyz.gz", "a.XYZ.GZ"}) {
    const auto path = name.find('z', name.find('.') + 5) != std::string::npos || name.ends_with(".GZ")
                          ? gzipped(name, two_frames)
                          : test::write_file(name, two_frames);
    EXPECT_EQ(read_trajectory(path).frames.size(), 2U) << name;
  }
}

TEST(XyzReader, GzippedFileThatIsCutOff) {
  std::string text;
  std::mt19937 random(1);
  for (int frame = 0; frame < 200; ++frame) {
    text += "3\n\n";
    for (int atom = 0; atom < 3; ++atom)
      text += "C " + std::to_string(random()) + " 0 " + std::to_string(random()) + "\n";
  }
  const std::string bytes = test::read_bytes(gzipped("a.xyz.gz", text));
  for (const double share : {0.2, 0.5, 0.9}) {
    const auto path = test::write_file(
        "cut.xyz.gz", std::string_view(bytes).substr(
                          0, static_cast<std::size_t>(share * static_cast<double>(bytes.size()))));
    const Trajectory whole = read_trajectory(path);
    EXPECT_GT(whole.frames.size(), 10U);
    ASSERT_FALSE(whole.warnings.empty());
    EXPECT_NE(whole.warnings[0].find("cut.xyz.gz: the file ends inside frame"), std::string::npos);
    EXPECT_EQ(read_trajectory(path, {.frames = {0, 10, 1}}).frames.size(), 10U);
  }
}

TEST(XyzReader, ByteOrderMark) {
  EXPECT_EQ(read("\xEF\xBB\xBF" + std::string(two_frames)).frames.size(), 2U);
  refuse(std::string_view("\xFF\xFE"
                          "2\0\n\0",
                          6),
         {"a.xyz", "UTF-16"});
}

TEST(XyzReader, ChainBreaks) {
  std::string text = "6\n\n";
  for (const double x : {0.0, 1.0, 2.0, 12.0, 13.0, 14.0}) text += "C " + std::to_string(x) + " 0 0\n";
  const Trajectory trajectory = read(text);
  EXPECT_EQ(trajectory.breaks, (std::vector<std::size_t>{2}));
  ASSERT_EQ(trajectory.warnings.size(), 1U);
  EXPECT_NE(trajectory.warnings[0].find("chain break after bead 2 (joined)"), std::string::npos);
}

TEST(ReadTrajectory, UnknownEnding) {
  for (const std::string ending :
       {".tng", ".tpr", ".top", ".rst7", ".h5md", ".TNG", ".g96.gz", ".mol2", ".xyz.bz2"})
    test::expect_refused([&] { (void)read_trajectory(test::write_file("a" + ending, "some bytes")); },
                         {"a" + ending, "not read yet; supported: .pdb", "; "});
  test::expect_refused([&] { (void)read_trajectory(test::write_file("a.tng", "some bytes")); },
                       {"convert it to XTC", "-o traj.xtc"});
  const auto pdb = test::write_file("a.pdb", test::pdb_residue(1));
  const auto dcd = test::write_file("a.dcd", test::DcdMaker::chain(3, 2).bytes());
  test::expect_refused(
      [&] { (void)read_trajectory(dcd, {.topology = test::write_file("a.tpr", "some bytes")}); },
      {"a.tpr", "not read yet"});
  const auto unknown = test::write_file("a", "some bytes");
  test::expect_refused([&] { (void)read_trajectory(unknown); },
                       {"cannot tell the format of", "a from its content or its ending", ".pdb", ".dcd"});
}

TEST(ReadTrajectory, TellsTheFormatFromTheContentFirst) {
  const std::string pdb = test::pdb_residue(1), dcd = test::DcdMaker::chain(3, 2).bytes();
  for (const char* name : {"a.xyz", "a.dcd", "a.cif", "a"}) {
    const Trajectory trajectory = read_trajectory(test::write_file(name, pdb));
    EXPECT_EQ(trajectory.bead_count(), 3U) << name;
    EXPECT_EQ(trajectory.bead_names.size(), 3U) << name;
    ASSERT_EQ(trajectory.warnings.size(), std::string(name) == "a" ? 0U : 1U) << name;
    for (const std::string& line : trajectory.warnings)
      EXPECT_NE(line.find("its content is that of the format pdb"), std::string::npos) << line;
  }
  EXPECT_EQ(read_trajectory(test::write_file("b.pdb", dcd)).frames.size(), 2U);
  EXPECT_EQ(read_trajectory(test::write_file("c", std::string(two_frames))).frames.size(), 2U);
  // --format overrides both the content and the ending.
  EXPECT_EQ(read_trajectory(test::write_file("b.pdb", dcd), {.format = "dcd"}).warnings.size(), 0U);
  test::expect_refused([&] { (void)read_trajectory(test::write_file("b.dcd", dcd), {.format = "xyz"}); },
                       {"b.dcd:1:"});
  test::expect_refused([&] { (void)read_trajectory(test::write_file("b.dcd", dcd), {.format = "zip"}); },
                       {"--format", "zip", "pdb, mmcif"});
}

TEST(ReadTrajectory, ReadsUntilDamage) {
  const std::string frame = "2\n\nC 0 0 0\nC 1 0 0\n", bad = "2\n\nC 0 0 0\nC one 0 0\n";
  const auto path = test::write_file("a.xyz", frame + frame + bad + frame);
  test::expect_refused([&] { (void)read_trajectory(path); }, {"a.xyz:12:", "one"});
  const Trajectory before = read_trajectory(path, {.until_damage = true});
  EXPECT_EQ(before.frames.size(), 2U);
  ASSERT_EQ(before.warnings.size(), 1U);
  EXPECT_NE(before.warnings[0].find("frames up to 1 are read (--until-damage)"), std::string::npos);
  // Nothing can be read if the first frame is damaged.
  const auto all_bad = test::write_file("b.xyz", bad + frame);
  test::expect_refused([&] { (void)read_trajectory(all_bad, {.until_damage = true}); }, {"b.xyz:4:", "one"});
}

TEST(ReadTrajectory, TimesOfATimeStep) {
  const auto path = test::write_file("a.xyz", std::string(two_frames) + std::string(two_frames));
  EXPECT_TRUE(read_trajectory(path).times.empty());
  EXPECT_EQ(read_trajectory(path, {.time_step = 2.5}).times, (std::vector<double>{0, 2.5, 5, 7.5}));
  EXPECT_EQ(read_trajectory(path, {.frames = {1, std::nullopt, 2}, .time_step = 2.5}).times,
            (std::vector<double>{2.5, 7.5}));
}

}  // namespace
}  // namespace kds::xyz_reader_test
