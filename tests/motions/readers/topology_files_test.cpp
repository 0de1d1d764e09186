// PSF files and AMBER topologies, which name the atoms of a trajectory.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "motions/readers/prmtop_reader.h"
#include "motions/readers/psf_reader.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/topology.h"
#include "tests/motions/test_files.h"
#include "tests/support/rounds.h"

namespace kds::topology_files_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

struct Atom {
  std::string segment, number, residue, name;
  double mass = 12.011;
};

std::vector<Atom> residue(const std::string& number, const std::string& name = "ALA",
                          const std::string& segment = "P1") {
  return {{segment, number, name, "N", 14.007},
          {segment, number, name, "HN", 1.008},
          {segment, number, name, "CA", 12.011},
          {segment, number, name, "C", 12.011}};
}

std::vector<Atom> joined(const std::vector<std::vector<Atom>>& parts) {
  std::vector<Atom> atoms;
  for (const std::vector<Atom>& part : parts) atoms.insert(atoms.end(), part.begin(), part.end());
  return atoms;
}

enum class Form { standard, extended, namd };

// Returns a PSF file. Bonds name atoms from 0.
std::string psf(const std::vector<Atom>& atoms, Form form = Form::standard,
                const std::vector<std::pair<std::size_t, std::size_t>>& bonds = {}) {
  constexpr const char* starts[] = {"PSF CMAP", "PSF EXT CMAP XPLOR", "PSF NAMD"};
  std::string text =
      fmt::format("{}\n\n       1 !NTITLE\n REMARKS made by a test\n\n", starts[static_cast<int>(form)]);
  text += fmt::format("{:>8} !NATOM\n", atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const Atom& a = atoms[i];
    if (form == Form::standard)
      text += fmt::format("{:>8} {:<4} {:<4} {:<4} {:<4} {:>4} {:14.6g}{:14.6g}{:>8}\n", i + 1, a.segment,
                          a.number, a.residue, a.name, 22, -0.47, a.mass, 0);
    else if (form == Form::extended)
      text +=
          fmt::format("{:>10} {:<8} {:<8} {:<8} {:<8} {:<6} {:14.6g}{:14.6g}{:>8}   0.00000 -0.301140E-02\n",
                      i + 1, a.segment, a.number, a.residue, a.name, "CT1", -0.47, a.mass, 0);
    else
      text += fmt::format("{} {} {} {} {} CT1 {} {} 0\n", i + 1, a.segment, a.number, a.residue, a.name,
                          -0.47, a.mass);
  }
  const int width = form == Form::extended ? 10 : 8;
  text += fmt::format("\n{:>{}} !NBOND: bonds\n", bonds.size(), width);
  for (std::size_t i = 0; i < bonds.size(); ++i)
    text += fmt::format("{:>{}}{:>{}}{}", bonds[i].first + 1, width, bonds[i].second + 1, width,
                        i % 4 == 3 && i + 1 < bonds.size() ? "\n" : "");
  return text + "\n\n";
}

std::vector<Trajectory> read(const std::string& file, const std::string& topology, std::size_t atoms,
                             ReadOptions options = {}) {
  options.topology = test::write_file(file, topology);
  return read_trajectories(
      test::write_file("t.dcd", test::DcdMaker::chain(static_cast<int>(atoms), 2).bytes()), options);
}

TEST(Psf, FormsNameTheSameAtoms) {
  const std::vector<Atom> atoms =
      joined({residue("1"),
              residue("2", "HSD"),
              residue("3", "GLY", "P2"),
              {{"W", "1", "TIP3", "OH2", 15.9994}, {"W", "1", "TIP3", "H1", 1.008}}});
  for (const Form form : {Form::standard, Form::extended, Form::namd}) {
    const auto necklaces = read("a.psf", psf(atoms, form), atoms.size(), {.chain = "P1,P2"});
    ASSERT_EQ(necklaces.size(), 2U);
    EXPECT_THAT(necklaces[0].bead_names,
                ElementsAre("N of ALA 1 in chain P1", "CA of ALA 1 in chain P1", "C of ALA 1 in chain P1",
                            "N of HSD 2 in chain P1", "CA of HSD 2 in chain P1", "C of HSD 2 in chain P1"));
    EXPECT_THAT(necklaces[0].element_radii, ElementsAre(1.55, 1.7, 1.7, 1.55, 1.7, 1.7));
    EXPECT_THAT(necklaces[0].warnings, testing::Each(HasSubstr("chain break")));
    EXPECT_EQ(read("a.psf", psf(atoms, form), atoms.size(), {.selection = *Selection::parse("//W//[O]")})[0]
                  .bead_count(),
              1U);
  }
}

TEST(Psf, ColumnsMayTouchOrBeBlankOrTooNarrow) {
  // Fields fill their columns.
  const std::vector<Atom> full = {{"PROA", "1234", "TP3M", "HG11", 1.008},
                                  {"PROA", "1234", "TP3M", "CA", 12.011}};
  EXPECT_EQ(read("a.psf", psf(full), 2, {.selection = *Selection::parse("//PROA/1234(TP3M)/HG11,CA")})[0]
                .bead_count(),
            2U);
  // A segment without a name: its column is blank.
  const std::vector<Atom> blank = joined({residue("1", "ALA", ""), residue("2", "ALA", "")});
  EXPECT_EQ(read("a.psf", psf(blank), 8)[0].bead_names[3], "N of ALA 2 in chain ' '");
  // VMD writes numbers that are too wide for their columns.
  const std::vector<Atom> wide = joined({residue("12345"), residue("12346")});
  EXPECT_EQ(read("a.psf", psf(wide), 8)[0].bead_names[3], "N of ALA 12346 in chain P1");
  // Insertion codes.
  EXPECT_EQ(read("a.psf", psf(joined({residue("52"), residue("52A")})), 8)[0].bead_names[3],
            "N of ALA 52A in chain P1");
}

TEST(Psf, ElementsFollowFromMasses) {
  std::vector<Atom> atoms = residue("1");
  atoms.push_back({"P1", "1", "ALA", "CB", 15.035});  // a united atom, CH3
  atoms.push_back({"P1", "1", "ALA", "CG", 14.027});  // CH2, near nitrogen
  atoms.push_back({"P1", "1", "ALA", "HB1", 3.024});  // a hydrogen made heavier
  atoms.push_back({"P1", "1", "ALA", "LP1", 0});      // a virtual site
  const auto all = read("a.psf", psf(atoms), 8, {.selection = Selection::heavy});
  EXPECT_THAT(all[0].bead_names, testing::SizeIs(5)) << "LP1 is no heavy atom";
  EXPECT_THAT(all[0].warnings, Contains(HasSubstr("the mass of 3 atoms suits no element of its name")));
  EXPECT_THAT(all[0].warnings, Contains(HasSubstr("CB of ALA 1, 15.035")));
  const std::vector<Atom> ions = {{"ION", "1", "SOD", "SOD", 22.98977}, {"ION", "2", "CLA", "CLA", 35.45}};
  EXPECT_EQ(read("a.psf", psf(ions), 2, {.selection = *Selection::parse("[NA]")})[0].bead_count(), 1U);
}

// Residues of the atoms N, H, CA, C: C is bonded to N of the residues of `links`. All residues have bonds of
// their own.
std::vector<std::pair<std::size_t, std::size_t>> bonds_of(
    std::size_t residues, const std::vector<std::pair<std::size_t, std::size_t>>& links) {
  std::vector<std::pair<std::size_t, std::size_t>> bonds;
  for (std::size_t r = 0; r < residues; ++r)
    for (const std::size_t place : {1, 2, 3}) bonds.emplace_back(4 * r + place - 1, 4 * r + place);
  for (const auto& [one, other] : links) bonds.emplace_back(4 * one + 3, 4 * other);
  return bonds;
}

TEST(Psf, BondsTellMoleculesApart) {
  const std::vector<Atom> atoms =
      joined({residue("1"), residue("2"), residue("5"), residue("6"), residue("1", "ALA", "P2")});
  for (const Form form : {Form::standard, Form::extended, Form::namd}) {
    const std::string text = psf(atoms, form, bonds_of(5, {{0, 1}, {2, 3}, {0, 3}}));
    const auto two = read("a.psf", text, 20, {.chain = "P1.1,P1.2"});
    ASSERT_EQ(two.size(), 2U);
    EXPECT_EQ(two[0].bead_count(), 6U);
    EXPECT_EQ(two[1].bead_names[0], "N of ALA 5 in chain P1.2");
    const auto whole = read("a.psf", text, 20, {.chain = "P1"});
    EXPECT_THAT(whole[0].gaps, ElementsAre(5));
    EXPECT_THAT(whole[0].warnings, Contains(HasSubstr("chain P1 has 2 molecules and is read as one")));
    // Without bonds, residues of a segment are one molecule.
    const auto one = read("a.psf", psf(atoms, form), 20, {.chain = "P1"});
    EXPECT_THAT(one[0].gaps, testing::IsEmpty());
    EXPECT_THAT(one[0].warnings, testing::Not(Contains(HasSubstr("molecules"))));
  }
  std::string text = psf(atoms);
  text.erase(text.find("       0 !NBOND"));
  EXPECT_THAT(read("a.psf", text, 20, {.chain = "P1"})[0].warnings,
              Contains(HasSubstr("no section !NBOND: molecules are not distinguished")));
}

// A cut file is refused, warned of, or has lost nothing that is read.
TEST(Psf, CutAnywhere) {
  const std::vector<Atom> atoms = joined({residue("1"), residue("2"), residue("3")});
  for (const Form form : {Form::standard, Form::extended, Form::namd}) {
    const std::string text = psf(atoms, form, bonds_of(3, {{0, 1}}));
    const auto whole = read("a.psf", text, 12)[0];
    EXPECT_THAT(whole.gaps, ElementsAre(5));
    int read_whole = 0;
    for (std::size_t size = text.find("!NATOM"); size < text.size(); ++size) {
      try {
        const auto cut = read("a.psf", text.substr(0, size), 12)[0];
        if (testing::Value(cut.warnings, Contains(HasSubstr("no section !NBOND")))) continue;
        EXPECT_EQ(cut.gaps, whole.gaps) << size;
        EXPECT_EQ(cut.bead_names, whole.bead_names) << size;
        EXPECT_EQ(cut.element_radii, whole.element_radii) << size;
        ++read_whole;
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      }
    }
    EXPECT_EQ(read_whole, form == Form::namd ? 1 : 2) << "without the last line ends";
  }
}

// An AMBER topology of residues of the atoms N, H, CA, C, with the bonds of `links`.
struct Prmtop {
  std::vector<std::string> labels = {"ACE", "ALA", "HIE", "NME"};
  std::vector<std::pair<int, int>> links = {{0, 1}, {1, 2}, {2, 3}};  // residues that a bond connects
  bool numbers = true;                                                // ATOMIC_NUMBER, otherwise MASS
  std::string names_format = "20a4";
  std::size_t per_line = 20;

  static std::string lines(const std::vector<std::string>& fields, std::size_t per_line) {
    std::string text;
    for (std::size_t i = 0; i < fields.size(); ++i)
      text += fields[i] + ((i + 1) % per_line == 0 || i + 1 == fields.size() ? "\n" : "");
    return fields.empty() ? "\n" : text;
  }
  static std::string section(const std::string& name, const std::string& format, const std::string& lines) {
    return fmt::format("%FLAG {:<75}\n%FORMAT({}){:>10}\n{}", name, format, "", lines);
  }
  std::string text() const {
    std::vector<std::string> names, pointers(31, fmt::format("{:>8}", 0)), begins, atomic, masses, labels4,
        bonds;
    for (std::size_t r = 0; r < labels.size(); ++r) {
      labels4.push_back(fmt::format("{:<4}", labels[r]));
      begins.push_back(fmt::format("{:>8}", 4 * r + 1));
      for (const auto& [name, number, mass] :
           {std::tuple("N", 7, 14.01), {"HA12", 1, 1.008}, {"CA", 6, 12.01}, {"C", 6, 12.01}}) {
        names.push_back(fmt::format("{:<4}", name));
        atomic.push_back(fmt::format("{:>8}", number));
        masses.push_back(fmt::format("{:16.8E}", mass));
      }
    }
    for (const auto& [one, other] : links)
      for (const int value : {3 * (4 * one + 3), 3 * 4 * other, 1})
        bonds.push_back(fmt::format("{:>8}", value));
    pointers[0] = fmt::format("{:>8}", names.size());
    pointers[11] = fmt::format("{:>8}", labels.size());
    pointers[12] = fmt::format("{:>8}", links.size());
    return "%VERSION  VERSION_STAMP = V0001.000  DATE = 01/01/26  00:00:00\n" +
           section("TITLE", "20a4", "made by a test\n") + section("POINTERS", "10I8", lines(pointers, 10)) +
           section("ATOM_NAME", names_format, lines(names, per_line)) +
           (numbers ? section("ATOMIC_NUMBER", "10I8", lines(atomic, 10))
                    : section("MASS", "5E16.8", lines(masses, 5))) +
           section("RESIDUE_LABEL", "20a4", lines(labels4, 20)) +
           section("RESIDUE_POINTER", "10I8", lines(begins, 10)) +
           section("BONDS_WITHOUT_HYDROGEN", "10I8", lines(bonds, 10));
  }
};

TEST(Prmtop, NamesTheAtomsOfATrajectory) {
  for (const bool numbers : {true, false}) {
    const auto necklaces = read("a.prmtop", Prmtop{.numbers = numbers}.text(), 16,
                                {.selection = *Selection::parse("//*/(ALA,HIE)")});
    ASSERT_EQ(necklaces.size(), 1U);
    EXPECT_EQ(necklaces[0].bead_names[1], "HA12 of ALA 2 in chain ' '");
    EXPECT_THAT(necklaces[0].element_radii, ElementsAre(1.55, 1.2, 1.7, 1.7, 1.55, 1.2, 1.7, 1.7));
    EXPECT_EQ(read("a.parm7", Prmtop{.numbers = numbers}.text(), 16)[0].bead_count(), 12U)
        << "caps have N, CA and C here";
  }
}

TEST(Prmtop, FieldsFollowTheFormat) {
  Prmtop prmtop;
  prmtop.names_format = "3a4";
  prmtop.per_line = 3;
  EXPECT_EQ(read("a.prmtop", prmtop.text(), 16)[0].bead_names[4], "CA of ALA 2 in chain ' '");
  // A line that lacks the blanks at its end.
  std::string text = prmtop.text();
  const std::size_t line = text.find("C   N   HA12\n");
  ASSERT_NE(line, std::string::npos);
  text = Prmtop().text();
  const std::size_t last = text.find("C   \n%FLAG ATOMIC");
  ASSERT_NE(last, std::string::npos);
  text.erase(last + 1, 3);
  EXPECT_EQ(read("a.prmtop", text, 16)[0].bead_names[11], "C of NME 4 in chain ' '");
}

TEST(Prmtop, BondsTellMoleculesApart) {
  Prmtop prmtop{.labels = {"ALA", "CYX", "CYX", "ALA", "WAT"}, .links = {{0, 1}, {2, 3}, {0, 3}}};
  const auto two = read("a.prmtop", prmtop.text(), 20, {.chain = "1,2"});
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[0].bead_count(), 6U);
  EXPECT_EQ(two[1].bead_names[0], "N of CYX 3 in chain 2");
  // Bonds between other residues, as disulfide bridges, do not join molecules.
  std::string text = prmtop.text();
  text.erase(text.find("%FLAG BONDS"));
  const auto one = read("a.prmtop", text, 20);
  EXPECT_EQ(one[0].bead_count(), 12U);
  EXPECT_THAT(one[0].warnings, Contains(HasSubstr("molecules are not distinguished")));
}

// Returns a LAMMPS dump or an extended XYZ file of one frame, whose atoms lie at x = id.
std::string with_ids(bool is_dump, const std::vector<std::size_t>& ids,
                     const std::vector<std::string>& elements) {
  std::string text =
      is_dump ? fmt::format("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\nITEM: ATOMS id element x y z\n",
                            ids.size())
              : fmt::format("{}\nProperties=id:I:1:species:S:1:pos:R:3\n", ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
    text += fmt::format("{} {} {} 0 0\n", ids[i], elements[i], ids[i]);
  return text;
}

TEST(TopologyFiles, IdsMustBeThoseOfTheSelectedAtoms) {
  const auto topology = test::write_file("t.pdb", test::pdb_residue(1) + test::pdb_residue(2));
  const std::size_t atoms = read_topology(topology, {}).atom_count;
  const ReadOptions ca{.topology = topology, .selection = Selection::ca};
  const std::vector<std::size_t> selected = read_topology(topology, ca).selected;
  ASSERT_EQ(selected.size(), 2U);
  const std::size_t first = selected[0] + 1, second = selected[1] + 1;
  for (const bool is_dump : {true, false}) {
    const auto read = [&](const std::vector<std::size_t>& ids) {
      const std::vector<std::string> elements(ids.size(), is_dump ? "N" : "C");
      return read_trajectory(
          test::write_file(is_dump ? "a.lammpstrj" : "a.xyz", with_ids(is_dump, ids, elements)), ca);
    };
    EXPECT_EQ(read({first, second}).frames[0].row(0), Eigen::RowVector2d(first, second));
    EXPECT_EQ(read({second, first}).frames[0].row(0), Eigen::RowVector2d(first, second));
    test::expect_refused(
        [&] {
          (void)read({first, second + 1});
        },
        {"expected the 2 atoms selected from ",
         fmt::format("no atom with the id {} (bead 1, CA of ALA 2", second)});
    // All atoms, in the reverse order, and with ids that are not those of the topology.
    std::vector<std::size_t> ids(atoms);
    for (std::size_t i = 0; i < atoms; ++i) ids[i] = atoms - i;
    EXPECT_EQ(read(ids).frames[0].row(0), Eigen::RowVector2d(first, second));
    for (std::size_t i = 0; i < atoms; ++i) ids[i] = 1000 + i;
    EXPECT_EQ(read(ids).frames[0].row(0), Eigen::RowVector2d(999 + first, 999 + second));
  }
}

TEST(TopologyFiles, WarnsOfElementsThatContradictTheTopology) {
  const auto topology = test::write_file("t.pdb", test::pdb_residue(1) + test::pdb_residue(2));
  const ReadOptions options{.topology = topology};
  const auto warnings = [&](bool is_dump, const std::vector<std::string>& elements) {
    std::vector<std::size_t> ids(elements.size());
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = i + 1;
    std::string lines;
    for (const std::string& line :
         read_trajectory(
             test::write_file(is_dump ? "a.lammpstrj" : "a.xyz", with_ids(is_dump, ids, elements)), options)
             .warnings)
      lines += line;
    return lines;
  };
  const std::vector<double> radii = read_topology(topology, {.selection = Selection::all}).element_radii;
  std::vector<std::string> elements;
  for (const double radius : radii) elements.emplace_back(radius == 1.55 ? "N" : radius == 1.7 ? "C" : "O");
  for (const bool is_dump : {true, false}) {
    EXPECT_EQ(warnings(is_dump, elements).find("another element"), std::string::npos);
    std::vector<std::string> others = elements;
    const std::size_t alpha = read_topology(topology, {.selection = Selection::ca}).selected[1];
    others[alpha] = "N";
    EXPECT_NE(warnings(is_dump, others).find("CA of ALA 2"), std::string::npos) << warnings(is_dump, others);
    EXPECT_NE(warnings(is_dump, others).find("another element than in"), std::string::npos);
    EXPECT_NE(warnings(is_dump, others).find("(1 bead)"), std::string::npos);
  }
  // LAMMPS writes C unless it is told the elements.
  EXPECT_EQ(warnings(true, std::vector<std::string>(elements.size(), "C")).find("another element"),
            std::string::npos);
}

// A cut file is refused, warned of, or has lost nothing that is read.
TEST(Prmtop, CutAnywhere) {
  const Prmtop prmtop{.labels = {"ALA", "ALA", "ALA"}, .links = {{0, 1}, {1, 2}}};
  const std::string text = prmtop.text();
  const auto whole = read("a.prmtop", text, 12)[0];
  for (std::size_t size = text.find("%FLAG POINTERS"); size < text.size(); ++size) {
    try {
      const auto cut = read("a.prmtop", text.substr(0, size), 12)[0];
      if (testing::Value(cut.warnings, Contains(HasSubstr("no section BONDS_WITHOUT_HYDROGEN")))) continue;
      EXPECT_EQ(size, text.size() - 1) << "only the last line end is lost";
      EXPECT_EQ(cut.bead_names, whole.bead_names);
      EXPECT_THAT(cut.warnings, Contains(HasSubstr("the last line has no line end")));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }
}

// If a topology has bonds, they decide which residues outside polymers are bonded.
TEST(Prmtop, BondsBetweenResiduesOutsidePolymers) {
  const ReadOptions every{.selection = *Selection::parse("//*")};
  const auto gaps = [&](std::vector<std::pair<int, int>> links) {
    const Prmtop prmtop{.labels = {"NAG", "NAG", "NAG", "WAT"}, .links = std::move(links)};
    return read("a.prmtop", prmtop.text(), 16, every)[0].gaps;
  };
  const auto psf_gaps = [&](const std::vector<std::pair<std::size_t, std::size_t>>& links) {
    const std::vector<Atom> atoms =
        joined({residue("1", "NAG"), residue("2", "NAG"), residue("3", "NAG"), residue("4", "WAT")});
    return read("a.psf", psf(atoms, Form::standard, bonds_of(4, links)), 16, every)[0].gaps;
  };
  EXPECT_THAT(gaps({{0, 1}, {1, 2}}), ElementsAre(11));
  EXPECT_THAT(gaps({{1, 2}}), ElementsAre(3, 11));
  EXPECT_THAT(psf_gaps({{0, 1}, {1, 2}}), ElementsAre(11));
  EXPECT_THAT(psf_gaps({{1, 2}}), ElementsAre(3, 11));
  const std::vector<Atom> sugars = joined({residue("1", "NAG"), residue("2", "NAG"), residue("3", "NAG")});
  EXPECT_THAT(read("a.psf", psf(sugars), 12, every)[0].gaps, ElementsAre(3, 7));
}

}  // namespace
}  // namespace kds::topology_files_test
