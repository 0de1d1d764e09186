#include "motions/readers/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"

namespace kds::selection_test {
namespace {

using test::pdb_line;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Selection parsed(std::string_view text) {
  const auto selection = Selection::parse(text);
  if (!selection) throw InputError("no selection: " + std::string(text));
  return *selection;
}

std::vector<Trajectory> read(const std::string& pdb, std::string_view selection,
                             const std::optional<std::string>& chain = {}) {
  return read_trajectories(test::write_file("a.pdb", pdb), {.selection = parsed(selection), .chain = chain});
}

// Returns the beads of all necklaces, as in "A:CA5 A:CB5 | B:CA1".
std::string beads(const std::string& pdb, std::string_view selection,
                  const std::optional<std::string>& chain = {}) {
  std::string text;
  for (const Trajectory& necklace : read(pdb, selection, chain)) {
    if (!text.empty()) text += " | ";
    const std::string& first = necklace.bead_names.front();
    text += first.substr(first.rfind("in chain ") + 9) + ":";
    for (const std::string& name : necklace.bead_names) {
      const std::size_t number = name.find(' ', name.find(" of ") + 4) + 1;
      text += " " + name.substr(0, name.find(' ')) + name.substr(number, name.find(' ', number) - number);
    }
  }
  return text;
}

void refuse(const std::string& pdb, std::string_view selection, std::initializer_list<std::string_view> parts,
            const std::optional<std::string>& chain = {}) {
  test::expect_refused([&] { static_cast<void>(read(pdb, selection, chain)); }, parts);
}

std::string atom(const std::string& name, int number, char chain = 'A', const std::string& residue = "ALA") {
  static int places = 0;
  const bool hydrogen = name.find('H') < 2;
  return pdb_line({.name = name,
                   .residue = residue,
                   .chain = chain,
                   .number = number,
                   .x = 1.5 * ++places,
                   .element = hydrogen ? "H" : name.substr(0, 1)});
}

std::string residue(int number, char chain = 'A', const std::string& name = "ALA") {
  std::string lines;
  for (const char* const one : {"N", "CA", "C", "CB", "HA"}) lines += atom(one, number, chain, name);
  return lines;
}

const std::string& two_chains() {
  static const std::string text =
      residue(-2) + residue(-1) + residue(1) + residue(2, 'A', "GLY") + residue(1, 'B') + residue(2, 'B') +
      pdb_line({.name = "O", .residue = "HOH", .chain = 'W', .number = 7, .het = true, .element = "O"});
  return text;
}

TEST(Selection, NamesAndAtomSelectionsAreToldApart) {
  EXPECT_EQ(parsed("backbone"), Selection::backbone);
  EXPECT_EQ(parsed("CA"), Selection::ca);
  EXPECT_EQ(parsed("Heavy"), Selection::heavy);
  EXPECT_EQ(parsed("p"), Selection::p);
  EXPECT_EQ(parsed("bb"), Selection::bb);
  EXPECT_EQ(parsed("all"), Selection::all);
  for (const char* text :
       {"//A/10-40/CA,CB", "/", "(ALA)", "[C]", "10-40", "-5--1", "CA[C]", ";polymer", ":A"}) {
    EXPECT_EQ(parsed(text).kind(), Selection::atoms) << text;
    EXPECT_EQ(parsed(text).text(), text);
  }
  for (const char* text : {"", "automatic", "cb", "backbon", "A", "CA,CB"})
    EXPECT_FALSE(Selection::parse(text)) << text;
}

TEST(Selection, EachPartOfASelection) {
  const std::string& pdb = two_chains();
  EXPECT_EQ(beads(pdb, "//A/1-2/CA,CB"), "A: CA1 CB1 CA2 CB2");
  EXPECT_EQ(beads(pdb, "A/1-2/CA"), "A: CA1 CA2");
  EXPECT_EQ(beads(pdb, "/*/A/1/CA"), "A: CA1");
  EXPECT_EQ(beads(pdb, "//B//CA"), "B: CA1 CA2");
  EXPECT_EQ(beads(pdb, "//A,B/1/CA"), "A: CA1 | B: CA1");
  EXPECT_EQ(beads(pdb, "//!A,W//CA"), "B: CA1 CA2");
  EXPECT_EQ(beads(pdb, "//W"), "W: O7");
  EXPECT_EQ(beads(pdb, "1/CA"), "A: CA1 | B: CA1");
  EXPECT_EQ(beads(pdb, "(GLY)/CA"), "A: CA2");
  EXPECT_EQ(beads(pdb, "//*/(!ALA,HOH)/CA"), "A: CA2");
  EXPECT_EQ(beads(pdb, "//B/2/[N]"), "B: N2");
  EXPECT_EQ(beads(pdb, "//B/2/[!C,H]"), "B: N2");
  EXPECT_EQ(beads(pdb, "//B/2/!N,C"), "B: CA2 CB2 HA2");
  EXPECT_EQ(beads(pdb, "//B/2/CA,N[N]"), "B: N2");
}

TEST(Selection, ResidueNumbers) {
  const std::string& pdb = two_chains();
  EXPECT_EQ(beads(pdb, "A/-2--1/CA"), "A: CA-2 CA-1");
  EXPECT_EQ(beads(pdb, "A/-1-1/CA"), "A: CA-1 CA1");
  EXPECT_EQ(beads(pdb, "A/-1--1/CA"), "A: CA-1");
  EXPECT_EQ(beads(pdb, "A/-1-/CA"), "A: CA-1 CA1 CA2");
  EXPECT_EQ(beads(pdb, "A/-1/CA"), "A: CA-2 CA-1 CA1");  // up to 1
  EXPECT_EQ(beads(pdb, "A/--1/CA"), "A: CA-2 CA-1");     // up to -1
  EXPECT_EQ(beads(pdb, "A/2-/CA"), "A: CA2");
  std::string inserted = residue(51);
  for (const char code : {' ', 'A', 'B'})
    inserted += pdb_line({.name = "CA", .number = 52, .x = 100.0 + code, .insertion = code});
  inserted += residue(53);
  EXPECT_EQ(beads(inserted, "52/CA"), "A: CA52");
  EXPECT_EQ(beads(inserted, "52A/CA"), "A: CA52A");
  EXPECT_EQ(beads(inserted, "52.A/CA"), "A: CA52A");
  EXPECT_EQ(beads(inserted, "52.*/CA"), "A: CA52 CA52A CA52B");
  EXPECT_EQ(beads(inserted, "51-52A/CA"), "A: CA51 CA52 CA52A");
  EXPECT_EQ(beads(inserted, "52B-53/CA"), "A: CA52B CA53");
}

TEST(Selection, ConditionsOnResiduesAndNumbers) {
  std::string pdb = two_chains();
  EXPECT_EQ(beads(pdb, ";solvent"), "W: O7");
  EXPECT_EQ(beads(pdb, "1/CA;polymer"), "A: CA1 | B: CA1");
  EXPECT_EQ(beads(pdb, "//*//[O];!polymer"), "W: O7");
  // The test writes occupancies 1 and B factors 0.
  EXPECT_EQ(beads(pdb, "//B/1/CA;q>0.5;b<1"), "B: CA1");
  EXPECT_EQ(beads(pdb, "//B/1/CA; q = 1"), "B: CA1");
  refuse(pdb, "//B/1/CA;q<0.5", {"selects no atom"});
  pdb.replace(pdb.find("  1.00  0.00"), 12, "            ");
  refuse(pdb, "/;q>0.5", {"--select", "occupancies (q)", "a.pdb", "N of ALA -2"});
}

TEST(Selection, FirstOfAlternateLocationsCounts) {
  std::string pdb = residue(1);
  for (const char location : {'A', 'B'})
    pdb += pdb_line({.name = "CA", .number = 2, .x = 10.0 + location, .alternate = location});
  EXPECT_EQ(beads(pdb, "2/CA"), "A: CA2");
  EXPECT_EQ(read(pdb, "2/CA:B")[0].frames[0](0, 0), 10.0 + 'B');
  EXPECT_EQ(beads(pdb, "CA:"), "A: CA1");
  // Two residues at one position.
  for (const char location : {'A', 'B'})
    pdb += pdb_line({.name = "CA",
                     .residue = location == 'A' ? "SER" : "THR",
                     .number = 3,
                     .x = 300.0 + location,
                     .alternate = location});
  EXPECT_EQ(read(pdb, "3/CA")[0].frames[0](0, 0), 300.0 + 'A');
  EXPECT_EQ(read(pdb, "3/CA:B")[0].frames[0](0, 0), 300.0 + 'B');
}

// Returns a digit for each bead of all necklaces: the sum of 1 for the first group and 2 for the second.
std::string groups(const std::string& pdb, const ReadOptions& options) {
  std::string digits;
  for (const Trajectory& necklace : read_trajectories(test::write_file("a.pdb", pdb), options))
    for (const std::uint8_t of_bead : necklace.bead_groups) digits += static_cast<char>('0' + of_bead);
  return digits;
}
std::string groups(const std::string& pdb, std::string_view selection, std::string_view first,
                   std::string_view second, const std::optional<std::string>& chain = {}) {
  return groups(pdb,
                {.selection = parsed(selection), .chain = chain, .groups = {parsed(first), parsed(second)}});
}

TEST(Selection, GroupsChooseAmongTheBeads) {
  const std::string& pdb = two_chains();
  EXPECT_EQ(groups(pdb, "//B", "ca", "heavy"), "2322023220");
  EXPECT_EQ(groups(pdb, "//A,B/1/CA", "//A", "1"), "32");
  EXPECT_EQ(groups(pdb, "ca", "//A/1-2", "//B", "A,B"), "001122");
  EXPECT_EQ(groups(pdb, "ca", "(GLY)", "all", "A,B"), "222322");
  EXPECT_EQ(groups(pdb, "ca", "//Z", "[N]", "B"), "00");  // a reader does not refuse an empty group
  // Names of atoms are those of polymers, and `all` and `heavy` take any bead.
  EXPECT_EQ(groups(pdb, "//W", "backbone", "all"), "2");
  const std::string ion = pdb_line(
      {.name = "CA", .residue = "CA", .chain = 'A', .number = 9, .x = 50, .het = true, .element = "CA"});
  EXPECT_EQ(groups(residue(1) + ion, "/", "ca", "CA[CA]"), "010002");
  EXPECT_EQ(groups(residue(1) + ion, "/", "heavy", "//*//CA"), "131103");
  EXPECT_EQ(groups(pdb, {.selection = parsed("ca")}), "");
  // A bead that is not the first of its alternates is in the groups of its atom.
  std::string alternates = residue(1);
  for (const char location : {'A', 'B'})
    alternates += pdb_line({.name = "CA", .number = 2, .x = 10.0 + location, .alternate = location});
  EXPECT_EQ(groups(alternates, "2/CA:B", "ca", "all"), "3");
  EXPECT_EQ(groups(alternates, "2/CA:B", "2/CA", "CA:A"), "1");
}

// With several models, the first frame that is read decides.
TEST(Selection, GroupsOfModelsAndOfFilesWithoutNames) {
  const std::string one = residue(1) + residue(2);
  const std::string models = "MODEL 1\n" + one + "ENDMDL\nMODEL 2\n" + one + "ENDMDL\n";
  EXPECT_EQ(groups(models, "ca", "1", "2"), "12");
  const auto xyz = test::write_file("a.xyz", "2\n\nC 0 0 0\nC 1 0 0\n");
  EXPECT_EQ(read_trajectory(xyz, {.groups = {Selection::all, Selection::all}}).bead_groups,
            (BeadGroups{3, 3}));
  test::expect_refused(
      [&] {
        static_cast<void>(read_trajectory(xyz, {.groups = {Selection::all, Selection::ca}}));
      },
      {"--groups: ", "a.xyz does not name its atoms", "--topology"});
}

TEST(Selection, MessagesAboutGroupsNameTheirOption) {
  test::expect_refused([&] { static_cast<void>(Selection::parse("//A/10-x", "--groups")); },
                       {"--groups: '//A/10-x' has the residues '10-x'"});
  std::string pdb = residue(1);
  pdb.replace(pdb.find("  1.00  0.00"), 12, "            ");
  test::expect_refused([&] { static_cast<void>(groups(pdb, "all", "ca", "/;q>0.5")); },
                       {"--groups: '/;q>0.5' compares occupancies (q)", "N of ALA 1"});
}

TEST(Selection, SelectionThatMatchesNothingSaysWhatTheFileHas) {
  refuse(two_chains(), "//a//CA",
         {"--select: '//a//CA' selects no atom of", "a.pdb", "the chains A, B, W", "ALA -2 to HOH 7",
          "atoms N, CA"});
  refuse(two_chains(), "//A/40-10", {"selects no atom"});
}

// Both the chain and the selection must hold.
TEST(Selection, ChainsAndSelections) {
  EXPECT_EQ(beads(two_chains(), "1-2/CA", "B"), "B: CA1 CA2");
  EXPECT_EQ(beads(two_chains(), "1-2/CA", "B,A"), "B: CA1 CA2 | A: CA1 CA2");
  EXPECT_EQ(beads(two_chains(), "/", "W"), "W: O7");
  refuse(two_chains(), "//A//CA", {"--select: '//A//CA' selects no atom", "in --chain B"}, "B");
}

TEST(Selection, ChainsWithoutNames) {
  const std::string one = residue(1, ' ') + residue(2, ' ');
  EXPECT_EQ(beads(one, "///1/CA"), "' ': CA1");
  EXPECT_EQ(beads(one, "//*/1/CA"), "' ': CA1");
  const std::string two =
      one + "TER\n" + residue(1, ' ') + "TER\n" +
      pdb_line({.name = "O", .residue = "HOH", .chain = ' ', .number = 9, .het = true, .element = "O"});
  EXPECT_EQ(beads(two, "//*/1/CA"), "1: CA1 | 2: CA1");
  EXPECT_EQ(beads(two, "//*//CA,O"), "1: CA1 CA2 | 2: CA1 | ' ': O9");
  EXPECT_EQ(beads(two, "1/CA", "2"), "2: CA1");
}

TEST(Selection, ChainBreaksAreFoundAlongBondedAtomsOnly) {
  EXPECT_TRUE(read(two_chains(), "//A//CA,CB")[0].breaks.empty());
  std::string broken;
  for (int number = 1; number <= 6; ++number)
    broken += pdb_line({.number = number, .x = 3.8 * number + (number > 3 ? 30 : 0)});
  EXPECT_THAT(read(broken, "//A//CA")[0].breaks, ElementsAre(2));
  EXPECT_THAT(read(broken, "all")[0].breaks, IsEmpty());
}

TEST(Selection, HeavyAtoms) {
  EXPECT_EQ(beads(two_chains(), "heavy", "B"), "B: N1 CA1 C1 CB1 N2 CA2 C2 CB2");
  std::string deuterium = residue(1) + pdb_line({.name = "D", .number = 1, .element = "D"});
  EXPECT_EQ(beads(deuterium, "heavy"), "A: N1 CA1 C1 CB1");
  // Without the element's column, names decide: 1HB and HG are hydrogens.
  for (const char* name : {"1HB", "HG", "H"})
    deuterium += pdb_line({.name = name, .number = 1, .element = " "});
  EXPECT_EQ(beads(deuterium, "heavy"), "A: N1 CA1 C1 CB1");
  EXPECT_THAT(read(two_chains(), "heavy")[0].warnings, Contains(HasSubstr("chain B not read")));
}

std::string martini(int number, const std::string& residue) {
  return pdb_line({.name = "BB", .residue = residue, .number = number, .x = 3.5 * number, .element = " "}) +
         pdb_line({.name = "SC1",
                   .residue = residue,
                   .number = number,
                   .x = 3.5 * number,
                   .y = 2,
                   .element = " "});
}

TEST(Selection, MartiniBeads) {
  const std::string pdb = martini(1, "ALA") + martini(2, "LYS") + martini(3, "XYZ");
  const std::vector<Trajectory> automatic = read_trajectories(test::write_file("a.pdb", pdb), {});
  EXPECT_EQ(automatic[0].bead_count(), 3U);
  EXPECT_THAT(automatic[0].element_radii, IsEmpty());
  EXPECT_THAT(automatic[0].warnings, Contains(HasSubstr("the BB beads of Martini are read")));
  EXPECT_EQ(beads(pdb, "bb"), "A: BB1 BB2 BB3");
  EXPECT_THAT(read(pdb, "bb")[0].warnings, IsEmpty());
  EXPECT_EQ(beads(pdb, "all"), "A: BB1 SC11 BB2 SC12 BB3 SC13");
  EXPECT_EQ(beads(pdb, "heavy"), beads(pdb, "all"));
  refuse(two_chains(), "bb", {"--select", "an atom BB"});
  refuse(pdb, "ca", {"--select", "an atom CA"});
}

TEST(Selection, NucleicAcidsByTheirPhosphorus) {
  std::string dna = atom("O5'", 1, 'A', "DA5") + atom("C1'", 1, 'A', "DA5");
  for (int number = 2; number <= 4; ++number)
    dna += atom("P", number, 'A', number == 4 ? "DT3" : "DC") +
           atom("C1'", number, 'A', number == 4 ? "DT3" : "DC");
  EXPECT_EQ(beads(dna, "p"), "A: P2 P3 P4");
  EXPECT_THAT(read(dna, "p")[0].warnings, Contains(HasSubstr("3 of 4 residues read; 1 without P: DA5 1")));
  test::expect_refused(
      [&] { static_cast<void>(read_trajectories(test::write_file("a.pdb", dna), {})); },
      {"does not hold N, CA and C", "--select p reads its P atoms", "--select all reads its 4 residues"});
  // A blank chain name is shown as --chain takes it.
  test::expect_refused(
      [&] {
        static_cast<void>(read_trajectories(test::write_file("blank.pdb", atom("N", 1, ' ', "ALA")), {}));
      },
      {"chain ' ' of", "does not hold N, CA and C"});
  EXPECT_EQ(beads(dna, "heavy"), beads(dna, "all"));
  // A protein that comes first is not asked for.
  EXPECT_EQ(beads(residue(1, 'B') + dna, "p"), "A: P2 P3 P4");
}

}  // namespace
}  // namespace kds::selection_test
