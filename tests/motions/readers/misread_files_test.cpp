// Files of other programs that readers once took for something else, and further files of the same kinds.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "motions/readers/read_trajectory.h"
#include "motions/readers/topology.h"
#include "motions/scene/radii.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/gro_text.h"
#include "tests/support/inputs/netcdf_maker.h"

namespace kds::misread_files_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::filesystem::path data(const std::string& name) {
  return test::data_file("../tests/motions/readers/data/" + name);
}
std::filesystem::path corpus(const std::string& name) {
  return test::data_file("../tests/fuzz/corpus/" + name);
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

void refuse(const std::string& name, std::string_view bytes, std::initializer_list<std::string_view> parts,
            const ReadOptions& options = {}) {
  test::expect_refused([&] { static_cast<void>(read_trajectory(test::write_file(name, bytes), options)); },
                       parts);
}

Trajectory with_topology(const std::filesystem::path& topology, const Selection& selection,
                         const std::string& dcd = "peptide.dcd") {
  return read_trajectory(data(dcd), {.topology = topology, .selection = selection});
}

std::string refusal_of_elements(const Trajectory& trajectory) {
  try {
    static_cast<void>(bead_radii("element", std::span(&trajectory, 1)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Misread, AtomicNumbersThatAreNone) {
  const auto prmtop = corpus("prmtop/atomic_number_minus1.prmtop");
  EXPECT_EQ(with_topology(prmtop, Selection::heavy).bead_count(), 30U);
  const Trajectory all = with_topology(prmtop, Selection::all);
  EXPECT_EQ(all.element_radii.size(), 36U);
  EXPECT_THAT(std::vector(all.element_radii.begin(), all.element_radii.begin() + 6),
              testing::ElementsAre(1.55, 1.2, 1.7, 1.7, 1.7, 1.52));
  struct Case {
    std::string number, mass;  // of HN of the first residue
    std::size_t heavy;
    double radius;  // 0: a massless site
  };
  for (const Case& one : {Case{"0", "1.00800000E+00", 30, 1.2}, Case{"-1", "3.02400000E+00", 30, 1.2},
                          Case{"-1", "4.03200000E+00", 30, 1.2}, Case{"0", "0.00000000E+00", 30, 0},
                          Case{"-1", "4.00000000E-01", 30, 0}, Case{"104", "1.00800000E+00", 30, 1.2},
                          Case{"6", "1.00800000E+00", 31, 1.7}}) {
    SCOPED_TRACE(one.number + " " + one.mass);
    std::string text = test::read_bytes(prmtop);
    text = replaced(text, "       7      -1", fmt::format("       7{:>8}", one.number));
    const auto file = test::write_file("t.prmtop", replaced(text, "1.00800000E+00", one.mass));
    EXPECT_EQ(with_topology(file, Selection::heavy).bead_count(), one.heavy);
    const Trajectory beads = with_topology(file, Selection::all);
    if (one.radius > 0) {
      EXPECT_EQ(beads.element_radii.at(1), one.radius);
      continue;
    }
    EXPECT_THAT(refusal_of_elements(beads),
                testing::AllOf(HasSubstr("t.prmtop does not tell the element of HN of ALA 1"),
                               Not(HasSubstr("--topology")), Not(HasSubstr("peptide.dcd"))));
    EXPECT_THAT(with_topology(file, Selection::heavy).warnings, Contains(HasSubstr("1 massless site")));
  }
  refuse("a.dcd", test::read_bytes(data("peptide.dcd")), {"no section MASS"},
         {.topology =
              test::write_file("t.prmtop", replaced(test::read_bytes(prmtop), "FLAG MASS", "FLAG MAS "))});
}

TEST(Misread, MasslessSitesByMass) {
  const Trajectory heavy = with_topology(data("drude_lone_pairs.psf"), Selection::heavy, "drude.dcd");
  EXPECT_EQ(heavy.bead_count(), 30U);
  EXPECT_THAT(heavy.warnings,
              Contains(HasSubstr("chain PROA: 42 massless sites (lone pairs, virtual sites, Drude particles) "
                                 "left out, as they are no heavy atoms: DN of ALA 1,")));
  EXPECT_THAT(refusal_of_elements(with_topology(data("drude_lone_pairs.psf"), Selection::all, "drude.dcd")),
              HasSubstr("drude_lone_pairs.psf does not tell the element of DN of ALA 1 in chain PROA"));
  // If all masses are 0, no atom is left out as a massless site.
  std::string text = test::read_bytes(corpus("psf/namd.psf"));
  for (const char* mass : {" 14.007", " 1.008", " 12.011"})
    for (std::size_t place = 0; (place = text.find(mass)) != std::string::npos;)
      text.replace(place, std::string_view(mass).size(), " 0.000");
  const Topology massless = read_topology(test::write_file("t.psf", text), {.selection = Selection::heavy});
  EXPECT_THAT(massless.warnings, Contains(HasSubstr("all masses are 0: the names of atoms give")));
  EXPECT_EQ(massless.selected.size(),
            read_topology(corpus("psf/namd.psf"), {.selection = Selection::heavy}).selected.size());
}

TEST(Misread, MasslessSitesByName) {
  struct Case {
    std::string name, element;
    std::size_t heavy;
    bool site;
  };
  for (const Case& one :
       {Case{"LP1", "", 3, true}, Case{"LPOA", "", 3, true}, Case{"EP1", "EP", 3, true},
        Case{"MN1", "", 3, true}, Case{"MCB1", "", 3, true}, Case{"MW", "", 3, true}, Case{"M", "", 3, true},
        Case{"DCA", "", 3, true}, Case{"DN", "", 3, true}, Case{"MN1", "MN", 4, false},
        Case{"CB", "", 4, false}, Case{"OXT", "", 4, false}, Case{"SD", "", 4, false},
        Case{"DB2", "", 3, false}, Case{"DN", "D", 3, false}, Case{"HM", "", 3, false}}) {
    SCOPED_TRACE(one.name + " " + one.element);
    const auto check = [&](const std::string& file, const std::string& text) {
      const Trajectory heavy = read_trajectory(test::write_file(file, text), {.selection = Selection::heavy});
      EXPECT_EQ(heavy.bead_count(), one.heavy) << file;
      EXPECT_EQ(std::count_if(heavy.warnings.begin(), heavy.warnings.end(),
                              [](const auto& line) { return line.find("1 massless site (") != line.npos; }),
                one.site ? 1 : 0)
          << file;
    };
    check("a.pdb", test::pdb_residue(1) +
                       test::pdb_line({.name = one.name, .number = 1, .x = 9, .element = one.element}));
    std::string rows;
    for (const std::string name : {"N", "CA", "C"})
      rows += fmt::format("{0} {1} ALA A 1 1 0 0\n", name[0], name);
    check("a.cif",
          "data_x\nloop_\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.label_comp_id\n"
          "_atom_site.label_asym_id\n_atom_site.label_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
          "_atom_site.Cartn_z\n" +
              rows + fmt::format("{} {} ALA A 1 1 0 0\n", one.element.empty() ? "?" : one.element, one.name));
    if (!one.element.empty()) continue;
    check("a.gro", test::GroText().residue(1, "ALA", {"N", "CA", "C", one.name}).text());
  }
}

// Lines with a column too few or too many would be read one column off.
TEST(Misread, LinesOfPsfFiles) {
  refuse("a.dcd", test::read_bytes(data("peptide.dcd")),
         {"namd_blank_segid.psf:7", "expected atom 1 of 42 in 9, 11 or 13 columns", "found 8 columns: '"},
         {.topology = data("namd_blank_segid.psf"), .selection = Selection::all});
  const auto psf = [](const std::string& form, const std::string& line) {
    return test::write_file(
        "t.psf", fmt::format("PSF {}\n\n       1 !NTITLE\n x\n\n       1 !NATOM\n{}\n\n", form, line));
  };
  const ReadOptions all{.selection = Selection::all};
  for (const std::string line :
       {"1 1 ALA CA NH1 0.1 12.011 0", "1 P1 1 ALA CA NH1 0.1 12.011", "1 P1 1 A LA CA NH1 0.1 12.011 0",
        "1 P1 1 ALA CA 22 5 0.1 12.011 0", "1 1 ALA CA NH1 0.1 12.011 0 0.0 -0.3E-2",
        "1 P1 1 ALA CA NH1 0.1 12.011 0 1", "1 P1 1 ALA CA NH1 0.1 12.011 0 0.0 x",
        "1 P1 1 ALA CA NH1 0.1 12.011 0.5"})
    for (const char* form : {"NAMD", "", "EXT", "EXT CHEQ XPLOR"})
      test::expect_refused([&] { static_cast<void>(read_topology(psf(form, line), all)); },
                           {"t.psf:7: expected atom 1 of 1 in 9, 11 or 13 columns", " columns: '1 "});
  for (const std::string rest : {"", " 0.00 -0.3E-2", " 0.00 -0.3E-2 -1.13 1.3"}) {
    const std::string line = "1 P1 1 ALA CA NH1 0.1 12.011 -1" + rest;
    EXPECT_EQ(read_topology(psf("NAMD", line), all).bead_names.at(0), "CA of ALA 1 in chain P1") << rest;
  }
  // Columns of fixed width, the type blank: the mass would be taken for the charge.
  const auto columns = [](const std::string& type, const std::string& more) {
    return fmt::format("{:>8} {:<4} {:<4} {:<4} {:<4} {:>4} {:14.6f}{:14.6f}{:>8}{}", 1, "P1", 1, "ALA", "CA",
                       type, 0.1, 12.011, 0, more);
  };
  EXPECT_EQ(read_topology(psf("", columns("22", "")), all).element_radii.at(0), 1.7);
  for (const char* more : {"", "   0.00000     -0.301140E-02", " 0 0"})
    test::expect_refused([&] { static_cast<void>(read_topology(psf("", columns("", more)), all)); },
                         {"t.psf:7", "columns: '"});
}

TEST(Misread, LinesOfPrmtopFiles) {
  const std::string text = test::read_bytes(corpus("prmtop/atomic_number_minus1.prmtop"));
  const auto damaged = [&](std::string_view from, std::string_view to,
                           std::initializer_list<std::string_view> parts) {
    refuse("a.dcd", test::read_bytes(data("peptide.dcd")), parts,
           {.topology = test::write_file("t.prmtop", replaced(text, from, to))});
  };
  damaged("C   O   N   HN  CA  CB  C   O   N ", "C   N   HN  CA  CB  C   O   N ", {"t.prmtop:", "is blank"});
  damaged("N   HN  \nCA  CB", "N   HN  H2  \nCA  CB",
          {"t.prmtop:13: expected at most 20 values of 4 characters"});
  damaged("ALA GLY SER", "ALA     SER", {"value 2 of section RESIDUE_LABEL is blank"});
  damaged("       6       8       7      -1       6       6\n",
          "       6       8       7      -1       6       6       6\n",
          {"expected at most 10 values of 8 characters"});
  damaged("       1       7      13", "       7      13      19", {"RESIDUE_POINTER"});
  damaged("      -1      -1       8", "      -1       8",
          {"expected a number as value 40 of section ATOMIC_NUMBER, found ''"});
}

TEST(Misread, LinesOfXyzFiles) {
  const std::string start = "3\n\nN 0 0 0 0.1 0.2 0.3\nC 1.5 0 0 0.1 0.2 0.3\n";
  EXPECT_EQ(read_trajectory(test::write_file("a.xyz", start + "C 3 0 0 0.1 0.2 0.3\n")).bead_count(), 3U);
  for (const std::string line : {"C 3 0 0.1 0.2 0.3", "C 3 0 0 0 0.1 0.2 0.3", "C 3 0 0 0.1 0.2", "C 3 0 0"})
    refuse("a.xyz", start + line + "\n",
           {"a.xyz:5: expected 6 numbers after the symbol as in the frame's first atom"});
  refuse("a.xyz", "2\n\nN 0 0 0\nC 1 2 3 4\n", {"a.xyz:4: expected 3 numbers after the symbol", "found 4"});
  // Words may follow some of the lines.
  EXPECT_EQ(read_trajectory(test::write_file("b.xyz", "2\n\nN 0 0 0 fixed 1\nC 1.5 0 0\n")).bead_count(), 2U);
}

TEST(Misread, LinesOfGroFiles) {
  const std::string text = test::GroText().residues(1, 3).text();
  EXPECT_EQ(read_trajectory(test::write_file("a.gro", text)).bead_count(), 9U);
  // Names that are a column too wide or too narrow, in all lines.
  for (const auto& [from, to] : {std::pair("ALA  ", "ALA   "), {"ALA  ", "ALA "}, {"ALA  ", "ALAXXX"}}) {
    std::string shifted = text;
    for (std::size_t place = 0; (place = shifted.find(from, place)) != std::string::npos; ++place)
      shifted.replace(place, 5, to);
    refuse("a.gro", shifted,
           {"expected atom 1 of 9 with names in columns 1 to 20, then three decimal numbers"});
  }
  for (const char* box : {"1000.000001000.000001000.00000", "10.00000-5.00000 10.00000", "3.0 4.05.0",
                          "5.0 5.0 5.0 0.0 0.0-1.0 0.0 0.0 0.0", "99999.0000099999.0000099999.00000"})
    refuse("a.gro", replaced(text, "   3.00000   4.00000   5.00000", box),
           {"expected a box of 3 or 9 numbers after 9 atoms, not numbers that touch, found '"});
}

TEST(Misread, TitlesOfDcdFiles) {
  const Trajectory wrong = read_trajectory(corpus("dcd/title_size_164.dcd"));
  EXPECT_EQ(wrong.bead_count(), 12U);
  EXPECT_EQ(wrong.frames.size(), 4U);
  EXPECT_THAT(wrong.warnings,
              Contains(HasSubstr("the record of the title tells 164 bytes and holds 244; its 3 "
                                 "lines tell the size")));
  for (const std::size_t marker : {4U, 8U})
    for (const bool big_endian : {false, true}) {
      test::DcdMaker maker = test::DcdMaker::chain(5, 3);
      maker.marker_size = marker;
      maker.big_endian = big_endian;
      const std::string bytes = maker.bytes();
      const std::size_t begin = 84 + 2 * marker, end = begin + 84 + 2 * marker;
      const auto with_title = [&](std::int64_t told, std::int32_t lines, std::int64_t closing) {
        const auto put = [&](std::string& out, std::int64_t number) {
          if (marker == 4)
            maker.put(out, static_cast<std::int32_t>(number));
          else
            maker.put(out, number);
        };
        std::string title;
        put(title, told);
        maker.put(title, lines);
        title += std::string(80 * static_cast<std::size_t>(lines), 't');
        put(title, closing);
        return bytes.substr(0, begin) + title + bytes.substr(end);
      };
      for (const auto& [told, lines] : {std::pair(84, 2), {164, 3}, {84, 10}, {244, 1}, {4, 1}, {164, 1}})
        for (const int closing : {told, 4 + 80 * lines}) {
          const Trajectory read =
              read_trajectory(test::write_file("a.dcd", with_title(told, lines, closing)));
          ASSERT_EQ(read.frames.size(), 3U) << told << ' ' << lines;
          for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(read.frames[k], read_trajectory(test::write_file("b.dcd", bytes)).frames[k]);
          EXPECT_THAT(read.warnings, Contains(HasSubstr(fmt::format("tells {} bytes", told))));
        }
      // Titles without a size, and sizes below 0.
      refuse("a.dcd", with_title(164, 3, 99), {"a.dcd", "the title"});
      refuse("a.dcd", with_title(-5, 1, -7), {"a.dcd", "a record of -5 bytes"});
      std::string negative;
      if (marker == 4)
        maker.put(negative, std::int32_t{-5});
      else
        maker.put(negative, std::int64_t{-5});
      std::string cut = bytes;
      cut.replace(maker.header().size() + maker.frame(0).size(), marker, negative);
      refuse("a.dcd", cut, {"frame 1, byte", "record holds -5 bytes, expected 20"});
    }
}

TEST(Misread, NetcdfHeadersThatCountNoFrames) {
  const Trajectory uncounted = read_trajectory(corpus("netcdf/numrecs0.nc"));
  EXPECT_EQ(uncounted.bead_count(), 12U);
  EXPECT_EQ(uncounted.frames.size(), 4U);
  EXPECT_THAT(uncounted.times, testing::ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(uncounted.warnings,
              Contains(HasSubstr("the header counts 0 frames, the file has room for 4, which are read")));
  for (const int version : {1, 2, 5})
    for (const bool doubles : {false, true}) {
      test::NetcdfMaker maker = test::NetcdfMaker::chain(5, 3);
      maker.version = version;
      maker.doubles = doubles;
      const auto counted = read_trajectory(test::write_file("a.nc", maker.bytes())).frames;
      maker.frames_claimed = 0;
      EXPECT_EQ(read_trajectory(test::write_file("b.nc", maker.bytes())).frames, counted);
      const std::string cut = maker.bytes().substr(0, maker.bytes().size() - 1);
      EXPECT_EQ(read_trajectory(test::write_file("c.nc", cut)).frames.size(), 2U);
      refuse("d.nc", maker.bytes().substr(0, maker.bytes().size() - 3 * maker.frame_bytes()),
             {"d.nc", "holds no frame"});
      refuse("e.nc", maker.bytes().substr(0, maker.bytes().size() - 2 * maker.frame_bytes() - 1),
             {"e.nc", "ends inside frame 0"});
    }
  std::string bytes = test::NetcdfMaker::chain(3, 2).bytes();
  bytes.replace(bytes.find("coordinates") + 12 + 4, 4, "\xFF\xFF\xFF\xFB");
  refuse("a.nc", bytes, {"expected the number of one of 3 dimensions", "found -5"});
}

TEST(Misread, FormatsThatAreNotRead) {
  test::expect_refused([] { static_cast<void>(read_trajectory(data("tinker.xyz"))); },
                       {"tinker.xyz: this is Tinker XYZ, which is not read", "obabel -itxyz"});
  const std::string atoms =
      "     1  O3   1.5 0.0 -2.0   1 2 3\n     2  H  2.5 0.0 0.0   2 1\n     3  H  3.5 0.0 0.0   2 1\n";
  struct Case {
    std::string file, text;
    std::vector<std::string_view> parts;
  };
  for (const Case& one :
       {Case{"a.xyz", "3\n" + atoms, {"Tinker XYZ"}},
        Case{"a.xyz", "     3  water\n" + atoms + "     3  water\n" + atoms, {"Tinker XYZ"}},
        Case{"a.arc", "3\n 18.6 18.6 18.6 90.0 90.0 90.0\n" + atoms, {"Tinker XYZ"}},
        Case{"a.txt", "3 title\n" + atoms, {"Tinker XYZ"}}, Case{"a.arc", "?\n", {".arc files (Tinker)"}},
        Case{"a.pdb", "<!DOCTYPE html>\n<html>404", {"an HTML page", "download"}},
        Case{"a.dcd", "version https://git-lfs.github.com/spec/v1\n", {"Git LFS", "git lfs pull"}},
        Case{"a.xyz", "BZh91AY", {"bzip2", "unpack it"}},
        Case{"a.dat", "@<TRIPOS>MOLECULE\n", {"MOL2", "obabel"}},
        Case{"a.xtc", std::string("\0\0\0\x0D\0\0\0\x0CVERSION 2022", 20), {"TPR"}},
        Case{"a.dat", "\x89HDF\r\n\x1A\n", {"HDF5", "mdconvert"}}, Case{"a.gsd", "?", {".gsd files (HOOMD)"}},
        Case{"a.npy", "?", {"NumPy", "Python module"}}, Case{"a.coor", "?", {"NAMD"}},
        Case{"a.cor", "?", {"CHARMM"}}, Case{"a.cpt", "?", {"GROMACS", "trjconv"}}}) {
    SCOPED_TRACE(one.file + ": " + one.text);
    for (const std::string_view part : one.parts)
      refuse(one.file, one.text, {one.file, part, "supported: .pdb"});
  }
  // A comment of XYZ that looks like an atom of Tinker.
  EXPECT_EQ(read_trajectory(test::write_file("b.xyz", "2\n1 C 0 0 0 1\nC 0 0 0\nC 1.5 0 0\n")).bead_count(),
            2U);
}

TEST(Misread, CifFilesOfOtherKinds) {
  for (const auto& [text, part] :
       {std::pair("data_x\nloop_\n_atom_site_label\n_atom_site_fract_x\nC1 0.1\n",
                  "a small-molecule CIF, which is not read"),
        {"data_x\n_cell_length_a 5\nloop_\n_atom_site_fract_x\n_atom_site_fract_y\n0.1 0.2\n",
         "a small-molecule CIF"},
        {"data_x\n_atom_site_label C1\n", "a small-molecule CIF"},
        {"data_x\nloop_\n_refln.index_h\n1\n", "structure factors"},
        {"data_x\nloop_\n_chem_comp_atom.atom_id\nCA\n", "chemical components"},
        {"data_x\nloop_\n_atom_site.label_atom_id\n_atom_site.fract_x\nC1 0.1\n",
         "no column _atom_site.Cartn_x; this is a small-molecule"}})
    refuse("a.cif", text, {"a.cif", part});
}

TEST(Misread, FilesThatLackElements) {
  const auto refusal = [](const std::string& file, std::string_view bytes, const ReadOptions& options = {}) {
    return refusal_of_elements(read_trajectory(test::write_file(file, bytes), options));
  };
  const std::string dcd = test::DcdMaker::chain(3, 1).bytes();
  EXPECT_THAT(refusal("a.dcd", dcd),
              HasSubstr("a.dcd names no elements, which a file given by --topology may do"));
  const auto gro = test::write_file("t.gro", test::GroText().residue(1, "ALA", {"BB", "SC1", "SC2"}).text());
  EXPECT_THAT(
      refusal("a.dcd", dcd, {.topology = gro, .selection = Selection::all}),
      testing::AllOf(HasSubstr("t.gro does not tell the element of BB of ALA 1"), Not(HasSubstr("a.dcd"))));
  EXPECT_THAT(refusal("a.xyz", "3\n\nC 0 0 0\nX 1 0 0\nX 2 0 0\n"),
              HasSubstr("a.xyz does not tell the element of atom 1 (bead 1)"));
  EXPECT_THAT(refusal("a.dump",
                      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id element x y z\n"
                      "1 C 0 0 0\n2 Q 1 0 0\n"),
              HasSubstr("a.dump does not tell the element of atom 1 (bead 1)"));
  EXPECT_THAT(
      refusal("a.pdb",
              test::pdb_residue(1) + test::pdb_line({.name = "EPX", .number = 1, .x = 9, .element = ""}),
              {.selection = Selection::all}),
      HasSubstr("a.pdb does not tell the element of EPX of ALA 1 in chain A"));
  EXPECT_EQ(refusal("b.pdb", test::pdb_residue(1)), "");
}

}  // namespace
}  // namespace kds::misread_files_test
