#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motions/base/text_input.h"
#include "tests/motions/reader_files.h"

namespace kds::mmcif_reader_test {
namespace {

constexpr test::FileReader read{"a.cif"};
constexpr test::FileRefusal refuse{"a.cif"};

constexpr std::string_view head =
    "data_X\n# a comment\n_cell.length_a 10\nloop_\n_entity.id\n_entity.type\n1 polymer\n2 'non-polymer'\n3 "
    "water\nloop_\n"
    "_atom_site.group_PDB\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
    "_atom_site.label_alt_id\n_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_entity_"
    "id\n"
    "_atom_site.label_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
    "_atom_site.Cartn_z\n_atom_site.occupancy\n_atom_site.B_iso_or_equiv\n_atom_site.auth_seq_id\n"
    "_atom_site.auth_asym_id\n_atom_site.pdbx_PDB_model_num\n";

std::string atom(const std::string& name, const std::string& x, int residue = 1, int model = 1,
                 const std::string& alternate = ".", const std::string& comp = "ALA", int entity = 1) {
  return "ATOM 1 " + name.substr(0, 1) + " " + name + " " + alternate + " " + comp + " " +
         std::string("?ABC").substr(static_cast<std::size_t>(entity), 1) + " " + std::to_string(entity) +
         " " + (entity == 1 ? std::to_string(residue) : ".") + " ? " + x + " 0.5 0 1.0 20.0 " +
         std::to_string(residue) + " Z " + std::to_string(model) + "\n";
}

std::string residue(int number, int model = 1, const std::string& x = "1.25") {
  return atom("N", x, number, model) + atom("CA", x, number, model) + atom("C", x, number, model);
}

std::string file(const std::string& atoms) { return std::string(head) + atoms; }

// Columns that the reader does not need may be missing; a missing column that it needs is named in the error.
TEST(MmcifReader, ReadsFilesWithoutTheColumnsThatAreNotNeeded) {
  const auto without = [](const std::vector<std::string>& columns) {
    std::string text = "data_X\nloop_\n";
    const std::vector<std::pair<std::string, std::string>> all{
        {"group_PDB", "ATOM"},      {"id", "1"},           {"type_symbol", "C"},
        {"label_atom_id", "CA"},    {"label_alt_id", "."}, {"label_comp_id", "ALA"},
        {"label_asym_id", "A"},     {"label_seq_id", "N"}, {"Cartn_x", "N.5"},
        {"Cartn_y", "1"},           {"Cartn_z", "2"},      {"occupancy", "1.0"},
        {"B_iso_or_equiv", "9"},    {"auth_seq_id", "N"},  {"auth_asym_id", "A"},
        {"pdbx_PDB_model_num", "1"}};
    std::string rows;
    for (int residue = 1; residue <= 4; ++residue) {
      for (const auto& [tag, value] : all) {
        if (std::find(columns.begin(), columns.end(), tag) != columns.end()) continue;
        if (residue == 1) text += "_atom_site." + tag + "\n";
        rows += value.substr(0, 1) == "N" ? std::to_string(residue) + value.substr(1) : value;
        rows += ' ';
      }
      rows += '\n';
    }
    return text + rows;
  };
  const ReadOptions all{.selection = Selection::all};
  const Trajectory full = read(without({}), all);
  ASSERT_EQ(full.bead_count(), 4U);
  for (const std::vector<std::string>& columns : std::vector<std::vector<std::string>>{
           {"group_PDB"},
           {"id"},
           {"label_alt_id"},
           {"label_asym_id"},
           {"auth_asym_id"},
           {"label_seq_id"},
           {"auth_seq_id"},
           {"occupancy", "B_iso_or_equiv"},
           {"pdbx_PDB_model_num"},
           {"type_symbol"},
           {"id", "group_PDB", "label_alt_id", "label_seq_id", "occupancy", "B_iso_or_equiv", "auth_asym_id",
            "pdbx_PDB_model_num", "type_symbol"}}) {
    const Trajectory some = read(without(columns), all);
    EXPECT_EQ(some.frames.front(), full.frames.front()) << columns.front();
    EXPECT_EQ(some.element_radii, full.element_radii) << columns.front();
  }
  refuse(without({"Cartn_z"}), {"a.cif", "_atom_site.Cartn_z"});
  for (const char* axis : {"x", "y"}) {
    const std::string column = std::string("Cartn_") + axis;
    refuse(without({column}), {"a.cif", "the atoms have no column _atom_site." + column});
  }
  refuse(without({"label_atom_id"}),
         {"neither a column _atom_site.label_atom_id nor _atom_site.auth_atom_id"});
  refuse(without({"label_comp_id"}),
         {"neither a column _atom_site.label_comp_id nor _atom_site.auth_comp_id"});
  // Without numbers, a residue begins where an atom name repeats.
  const Trajectory unnumbered = read(without({"label_seq_id", "auth_seq_id"}), all);
  EXPECT_EQ(unnumbered.bead_count(), 4U);
  EXPECT_THAT(unnumbered.warnings,
              testing::Contains(testing::HasSubstr("3 residues with the number of an earlier")));
}

TEST(MmcifReader, RowsOfModelsMayBeMixed) {
  for (const std::vector<int>& order : std::vector<std::vector<int>>{{1, 2}, {2, 1}, {1, 2, 3}, {7, 3, 5}}) {
    std::string mixed, sorted;
    for (int number = 1; number <= 3; ++number)
      for (const char* name : {"N", "CA", "C"})
        for (const int model : order) mixed += atom(name, std::to_string(10 * model + number), number, model);
    for (const int model : order)
      for (int number = 1; number <= 3; ++number)
        sorted += residue(number, model, std::to_string(10 * model + number));
    const Trajectory trajectory = read(file(mixed));
    ASSERT_EQ(trajectory.frames.size(), order.size());
    EXPECT_EQ(trajectory.frames, read(file(sorted)).frames);
    EXPECT_EQ(trajectory.frames[1](0, 0), 10 * order[1] + 1);
    EXPECT_TRUE(trajectory.warnings.empty());
  }
}

TEST(MmcifReader, ReadsTheFirstDataBlockWithAtoms) {
  const std::string full = file(residue(1) + residue(2));
  const std::string headers = "loop_\n_atom_site.id\n_atom_site.Cartn_x\n";
  for (const std::string& before :
       {std::string("data_empty\n"), std::string("data_empty\n_entry.id x\n"),
        std::string("data_a\ndata_b\n_cell.length_a 9\n"), "data_rows\n" + headers}) {
    EXPECT_EQ(read(before + full).bead_count(), 6U) << before;
    EXPECT_TRUE(read(before + full).warnings.empty()) << before;
  }
  EXPECT_EQ(read(full + "data_after\n_entry.id x\n").bead_count(), 6U);
  std::string second = full;
  second.replace(0, 6, "data_Y");
  EXPECT_THAT(
      read(full + second).warnings,
      testing::ElementsAre(testing::EndsWith("a.cif: data block 'X' is read; the atoms of 'Y' are not")));
  refuse("data_a\ndata_b\n", {"a.cif", "no atom in any data block"});
}

TEST(MmcifReader, OneTableOfAtomsABlock) {
  const std::string full = file(residue(1));
  refuse(full + full.substr(full.find("loop_\n_atom_site")),
         {"data block 'X'", "more than one table _atom_site"});
  // A single atom needs no loop, and tags are case-insensitive.
  EXPECT_EQ(read("data_X\n_atom_site.Label_Atom_ID CA\n_atom_site.label_comp_id ALA\n_atom_site.cartn_x 1\n"
                 "_atom_site.CARTN_Y 2\n_atom_site.Cartn_z 3\n")
                .frames[0],
            Eigen::MatrixXd(Eigen::Vector3d(1, 2, 3)));
}

TEST(MmcifReader, NumbersThatRestart) {
  std::string atoms;
  for (const int number : {0, 1, 9999, 0, 1})
    for (const char* name : {"N", "CA", "C"})
      atoms += "ATOM 1 " + std::string(name) + " " + name + " . ALA A 1 . ? 0 0 0 1.0 20.0 " +
               std::to_string(number) + " Z 1\n";
  const Trajectory trajectory = read(file(atoms));
  EXPECT_EQ(trajectory.bead_count(), 15U);
  EXPECT_THAT(trajectory.warnings,
              testing::Contains(testing::HasSubstr("2 residues with the number of an earlier")));
}

TEST(MmcifReader, MoleculesOfAChain) {
  std::string atoms;
  for (const char* asym : {"A", "B"})
    for (const char* name : {"N", "CA", "C"})
      atoms +=
          "ATOM 1 " + std::string(name) + " " + name + " . ALA " + asym + " 1 1 ? 0 0 0 1.0 20.0 1 Z 1\n";
  EXPECT_EQ(read(file(atoms)).bead_count(), 6U);
  EXPECT_THAT(read(file(atoms)).warnings, testing::Contains(testing::HasSubstr("chain Z has 2 molecules")));
  EXPECT_EQ(read(file(atoms), {.chain = "Z.2"}).bead_names[0], "N of ALA 1 in chain Z.2");
}

TEST(MmcifReader, ChainsGoByTheirAuthorsNames) {
  EXPECT_EQ(read(file(residue(1)), {.chain = "Z"}).bead_count(), 3U);
  refuse(file(residue(1)), {"--chain", "'A'", "expected Z"}, {.chain = "A"});
}

TEST(MmcifReader, EntitiesTellThePolymer) {
  const std::string atoms =
      residue(1) + atom("CA", "0", 2, 1, ".", "ALA", 2) + atom("O", "0", 3, 1, ".", "HOH", 3);
  EXPECT_EQ(read(file(atoms), {.selection = Selection::all}).bead_count(), 3U);
}

TEST(MmcifReader, Alternates) {
  const std::string atoms =
      atom("N", "1", 1, 1, "A") + atom("N", "2", 1, 1, "B") + atom("CA", "3") + atom("C", "4") + residue(2);
  const Trajectory trajectory = read(file(atoms));
  EXPECT_EQ(trajectory.bead_count(), 6U);
  EXPECT_EQ(trajectory.frames[0](0, 0), 1);
}

TEST(MmcifReader, AsTopology) {
  const auto topology = test::write_file(
      "t.cif", file(atom("O", "0", 9, 1, ".", "HOH", 3) + residue(1) + atom("N", "2", 2, 1, "A") +
                    atom("N", "2", 2, 1, "B") + atom("CA", "2", 2) + atom("C", "2", 2)));
  const auto dcd = test::write_file("a.dcd", test::DcdMaker::chain(8, 2).bytes());
  const Trajectory trajectory = read_trajectory(dcd, {.topology = topology});
  ASSERT_EQ(trajectory.bead_count(), 6U);
  EXPECT_EQ(trajectory.frames[0](0, 0), 1.5);
  EXPECT_EQ(trajectory.frames[0](0, 4), 9);
}

// All line endings give the same result, also within comments and text fields.
TEST(MmcifReader, LineEndsOfEveryKind) {
  const std::string comment = "# 1 2 3\n", field = "_a.b\n;one\n# ;two\n;\n";
  std::string text = file(residue(1) + comment + residue(2) + comment);
  text.insert(text.find("loop_"), field);
  const Trajectory expected = read(text);
  EXPECT_EQ(expected.bead_count(), 6U);
  for (const std::string_view end : {"\r", "\r\n"}) {
    for (const std::size_t every : {1U, 2U, 3U, 7U}) {
      std::string other;
      std::size_t line = 0;
      for (const char c : text)
        if (c == '\n' && line++ % every == 0)
          other += end;
        else
          other += c;
      EXPECT_EQ(read(other).frames[0], expected.frames[0]) << every;
    }
  }
  std::string bad = file(residue(1) + atom("N", "x", 2));
  std::replace(bad.begin(), bad.end(), '\n', '\r');
  refuse(bad, {"a.cif:" + std::to_string(std::count(head.begin(), head.end(), '\n') + 4) + ":", "'x'"});
}

// A chain that crosses the wall of a cell of length 10, in two models.
TEST(MmcifReader, CellsOfSimulationBoxes) {
  const auto moved = [](const std::string& gamma, const std::string& group) {
    std::string text = "data_X\n";
    for (const char* axis : {"a", "b", "c"}) text += std::string("_cell.length_") + axis + " 10\n";
    text += "_cell.angle_alpha 90\n_cell.angle_beta 90\n_cell.angle_gamma " + gamma + "\n";
    text += "_symmetry.space_group_name_H-M " + group + "\n";
    text += std::string(head).substr(head.find("loop_"));
    for (const int model : {1, 2})
      text += atom("N", "8", 1, model) + atom("CA", "9.5", 1, model) + atom("C", "1", 1, model);
    const Trajectory trajectory = read(text);
    const bool doubt =
        testing::Matches(testing::Contains(testing::HasSubstr("cell is not used")))(trajectory.warnings);
    return std::pair(trajectory.frames[0](0, 2) == 11, doubt);
  };
  for (const char* group : {"'P 1'", "P1", "'p 1'", "'P 1 '", "' P  1'", "p1", "?"})
    EXPECT_EQ(moved("90", group), std::pair(true, false)) << group;
  for (const char* group : {"'P 21'", "'P -1'", "'P 1 21 1'", "'C 1'"})
    EXPECT_EQ(moved("90", group), std::pair(false, false)) << group;
  for (const char* gamma : {"270", "-90", "450", "180", "0", "90x"})
    EXPECT_EQ(moved(gamma, "'P 1'"), std::pair(false, true)) << gamma;
}

}  // namespace
}  // namespace kds::mmcif_reader_test
