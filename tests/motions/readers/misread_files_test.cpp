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
