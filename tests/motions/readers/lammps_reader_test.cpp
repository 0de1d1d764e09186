#include "motions/readers/lammps_reader.h"

#include <gtest/gtest.h>
#include <cmath>

#include "motions/readers/dcd_reader.h"
#include "tests/motions/reader_files.h"
#include "tests/support/inputs/cells.h"

namespace kds::lammps_reader_test {
namespace {

using test::read_frame;

constexpr std::string_view cube = "ITEM: BOX BOUNDS pp pp pp\n-5 15\n0 30\n0 40\n";

// Returns a frame of a dump. `rows` are lines.
std::string dump(int step, std::size_t atoms, std::string_view box, std::string_view columns,
                 std::string_view rows) {
  return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n" + std::to_string(atoms) +
         "\n" + std::string(box) + "ITEM: ATOMS " + std::string(columns) + "\n" + std::string(rows);
}

const std::string two_frames = dump(0, 3, cube, "id type x y z ", "3 1 3 0 0 \n1 1 1 0 0.1 \n2 1 2 0 0 \n") +
                               dump(10, 3, cube, "id type x y z ", "2 1 2 1 0 \n3 1 3 1 0 \n1 1 1 1 0.1 \n");

std::unique_ptr<AtomFrames> open(std::string_view text,
                                 const ReadOptions& options = {.units = LammpsUnits::real}) {
  return open_lammps(test::write_file("a.lammpstrj", text), options);
}

Eigen::Vector3d first_atom(std::string_view text, const ReadOptions& options = {.units = LammpsUnits::real}) {
  return read_frame(*open(text, options), 0).positions.col(0);
}

constexpr test::FileRefusal refuse{"a.lammpstrj"};

TEST(LammpsReader, SortsAtomsById) {
  const auto file = open(two_frames);
  ASSERT_EQ(file->held().whole, 2U);
  EXPECT_FALSE(file->held().ends_inside);
  ASSERT_EQ(file->atom_count(), 3U);
  for (const std::size_t k : {1U, 0U, 1U}) {
    const FrameRead frame = read_frame(*file, k);
    EXPECT_EQ(frame.positions.row(0), Eigen::RowVector3d(1, 2, 3));
    EXPECT_EQ(frame.positions(1, 2), static_cast<double>(k));
    EXPECT_EQ(frame.positions(2, 0), 0.1);
    EXPECT_EQ(frame.cell, Cell(Eigen::Vector3d(20, 30, 40).asDiagonal()));
    EXPECT_FALSE(frame.stamp.picoseconds);
  }
  EXPECT_TRUE(file->notes().empty());
  FrameRead frame;
  file->read(1, std::vector<std::size_t>{2, 0}, frame);
  EXPECT_EQ(frame.positions.row(0), Eigen::RowVector2d(3, 1));
}

TEST(LammpsReader, IdsMayHaveGaps) {
  const std::string columns = "x id z y";
  const std::string text = dump(0, 3, cube, columns, "7 70 0 0\n1 5 0 0\n9 900000000000 0 0\n") +
                           dump(1, 3, cube, columns, "1 5 0 0\n9 900000000000 0 0\n7 70 0 0\n");
  EXPECT_EQ(read_frame(*open(text), 1).positions.row(0), Eigen::RowVector3d(1, 7, 9));
}

TEST(LammpsReader, KeepsTheOrderOfAtomsWithoutIds) {
  const auto file = open(dump(0, 2, cube, "x y z", "2 0 0\n1 0 0\n"));
  EXPECT_EQ(read_frame(*file, 0).positions.row(0), Eigen::RowVector2d(2, 1));
  ASSERT_EQ(file->notes().size(), 1U);
  EXPECT_NE(file->notes()[0].find("no ids"), std::string::npos);
}

TEST(LammpsReader, ReadsScaledCoordinates) {
  for (const std::string columns : {"id xs ys zs", "id xsu ysu zsu"})
    EXPECT_EQ(first_atom(dump(0, 1, cube, columns, "1 0.25 0.5 1.5\n")), Eigen::Vector3d(0, 15, 60));
}

// The bounds of a tilted box hold all its corners: here x from -1 - 4 to 9 + 2, y from 0 - 3 to 20.
constexpr std::string_view tilted = "ITEM: BOX BOUNDS xy xz yz pp ff pp\n-5 11 2\n-3 20 -4\n1 31 -3\n";

TEST(LammpsReader, ReadsTiltedBoxes) {
  const auto file = open(dump(0, 1, tilted, "id xs ys zs", "1 0.5 0.5 0.5\n"));
  const FrameRead frame = read_frame(*file, 0);
  EXPECT_EQ(frame.positions.col(0), Eigen::Vector3d(-1 + 5 + 1 - 2, 10 - 1.5, 16));
  Cell cell;
  cell << 10, 0, -4,  //
      0, 0, -3,       //
      0, 0, 30;
  EXPECT_EQ(frame.cell, cell);  // the second axis is not periodic
}

TEST(LammpsReader, ReadsGeneralBoxes) {
  for (const std::string flags : {"", " pp pp pp"}) {
    const std::string box = "ITEM: BOX BOUNDS abc origin" + flags + "\n0 10 0 1\n-20 0 0 2\n3 0 30 3\n";
    const FrameRead frame = read_frame(*open(dump(0, 1, box, "id xs ys zs", "1 0.5 0.5 0.5\n")), 0);
    EXPECT_EQ(frame.positions.col(0), Eigen::Vector3d(1 - 10 + 1.5, 2 + 5, 3 + 15));
    ASSERT_TRUE(frame.cell);
    EXPECT_EQ(frame.cell->col(1), Eigen::Vector3d(-20, 0, 0));
  }
}

TEST(LammpsReader, ReadsOldBoxesAsPeriodic) {
  EXPECT_TRUE(
      read_frame(*open(dump(0, 1, "ITEM: BOX BOUNDS\n0 10\n0 10\n0 10\n", "id x y z", "1 0 0 0\n")), 0).cell);
  const auto file =
      open(dump(0, 1, "ITEM: BOX BOUNDS ff ss mm\n0 10\n0 10\n0 10\n", "id x y z", "1 0 0 0\n"));
  EXPECT_FALSE(read_frame(*file, 0).cell);
  EXPECT_FALSE(file->may_have_cell());
}

TEST(LammpsReader, ReadsVelocities) {
  const std::string text = dump(0, 2, cube, "id vx x vz z vy y", "2 1 0 3 0 2 0\n1 4 1 6 3 5 2\n");
  const auto velocity = [&](std::optional<LammpsUnits> units) {
    return read_frame(*open(text, {.units = units, .velocities = true}), 0).velocities;
  };
  EXPECT_EQ(velocity(LammpsUnits::metal).col(0), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(velocity(LammpsUnits::real).col(1), Eigen::Vector3d(1000, 2000, 3000));
  EXPECT_DOUBLE_EQ(velocity(LammpsUnits::nano)(1, 1), 0.02);
  for (const auto units : {std::optional(LammpsUnits::lj), std::optional<LammpsUnits>()})
    EXPECT_EQ(velocity(units).cols(), 0);
  EXPECT_EQ(read_frame(*open(text), 0).velocities.cols(), 0);
}

TEST(LammpsReader, UnwrapsByImageFlags) {
  const auto file = open(dump(0, 1, tilted, "id x y z ix iy iz", "1 1 2 3 1 0 -2\n"));
  EXPECT_EQ(read_frame(*file, 0).positions.col(0), Eigen::Vector3d(1 + 10 + 8, 2 + 6, 3 - 60));
  ASSERT_EQ(file->notes().size(), 1U);
  EXPECT_NE(file->notes()[0].find("image flags"), std::string::npos);
  EXPECT_EQ(first_atom(dump(0, 1, cube, "id xs ys zs ix iy iz", "1 0.5 0.5 0.5 1 0 -1\n")),
            Eigen::Vector3d(25, 15, -20));
  EXPECT_EQ(first_atom(dump(0, 1, cube, "id xu yu zu ix iy iz", "1 1 2 3 1 1 1\n")),
            Eigen::Vector3d(1, 2, 3));
}

TEST(LammpsReader, PrefersUnwrappedCoordinates) {
  const auto file = open(dump(0, 1, cube, "id x y z xu yu zu xs ys zs", "1 1 2 3 4 5 6 0.1 0.1 0.1\n"));
  EXPECT_EQ(read_frame(*file, 0).positions.col(0), Eigen::Vector3d(4, 5, 6));
  ASSERT_EQ(file->notes().size(), 1U);
  EXPECT_EQ(file->notes()[0], "coordinates are xu yu zu; columns x y z, xs ys zs are left unread");
  EXPECT_EQ(first_atom(dump(0, 1, cube, "id x y z xsu ysu zsu", "1 1 2 3 0.5 0.5 0.5\n")),
            Eigen::Vector3d(5, 15, 20));
}

TEST(LammpsReader, Units) {
  const auto with = [](const std::string& units) {
    return (units.empty() ? "" : "ITEM: UNITS\n" + units + "\n") + "ITEM: TIME\n3000\n" +
           dump(3, 1, cube, "id x y z", "1 0.1 0 0\n");
  };
  struct Case {
    std::string file;
    std::optional<LammpsUnits> option;
    std::optional<double> time;
    double x, length;
    std::size_t notes;
  };
  const double tenfold = 10.0F * 0.1F;
  for (const Case& expected :
       {Case{"real", {}, 3, 0.1, 20, 0}, Case{"metal", {}, 3000, 0.1, 20, 0},
        Case{"nano", {}, 3e6, tenfold, 200, 0}, Case{"lj", {}, {}, 0.1, 20, 0}, Case{"", {}, {}, 0.1, 20, 1},
        Case{"", LammpsUnits::real, 3, 0.1, 20, 0}, Case{"", LammpsUnits::nano, 3e6, tenfold, 200, 0},
        Case{"real", LammpsUnits::nano, 3e6, tenfold, 200, 1}, Case{"si", LammpsUnits::lj, {}, 0.1, 20, 0}}) {
    const auto file = open(with(expected.file), {.units = expected.option});
    const FrameRead frame = read_frame(*file, 0);
    EXPECT_EQ(frame.stamp.picoseconds, expected.time) << expected.file;
    EXPECT_EQ(frame.positions(0, 0), expected.x) << expected.file;
    EXPECT_EQ((*frame.cell)(0, 0), expected.length) << expected.file;
    EXPECT_EQ(file->notes().size(), expected.notes) << expected.file;
  }
  refuse(with("si"), {"a.lammpstrj", "units 'si'", "--units lj"});
}

TEST(LammpsReader, ElementsHaveRadii) {
  const auto radii = [](const std::string& rows) {
    std::vector<std::string> warnings;
    auto found = open(dump(0, 2, cube, "id element x y z", rows))->element_radii(warnings);
    return std::pair(found, warnings.size());
  };
  EXPECT_EQ(radii("2 C 0 0 0\n1 N 0 0 0\n"), std::pair(std::vector<double>({1.55, 1.7}), std::size_t{0}));
  EXPECT_EQ(radii("2 C 0 0 0\n1 C 0 0 0\n"), std::pair(std::vector<double>({1.7, 1.7}), std::size_t{1}));
  EXPECT_TRUE(std::isnan(radii("2 C 0 0 0\n1 Q9 0 0 0\n").first.at(0)));
  std::vector<std::string> warnings;
  EXPECT_TRUE(open(two_frames)->element_radii(warnings).empty());
}

TEST(LammpsReader, ReadsGzippedFilesInAnyOrder) {
  std::string text;
  for (int k = 0; k < 4000; ++k)
    text += dump(k, 2, "ITEM: BOX BOUNDS ff ff ff\n0 10\n0 10\n0 10\n", "id x y z",
                 "2 1 0 0\n1 0 " + std::to_string(k) + " 0\n");
  const auto path = test::write_gzipped("a.dump.gz", text);
  const auto file = open_lammps(path, {.units = LammpsUnits::lj});
  ASSERT_EQ(file->held().whole, 4000U);
  for (const std::size_t k : {0U, 1U, 3999U, 2U, 2000U, 1999U})
    EXPECT_EQ(read_frame(*file, k).positions(1, 0), static_cast<double>(k));
  EXPECT_EQ(read_trajectory(path, {.frames = {100, 400, 100}}).frames[1](1, 0), 200);
}

TEST(LammpsReader, ReadsAFileOfMdtraj) {
  const auto file = open_lammps(test::data_file("formats/1l2y_first3_mdtraj.lammpstrj"), {});
  const auto dcd = open_dcd(test::data_file("trajectories/1l2y.dcd"), {});
  ASSERT_EQ(file->held().whole, 3U);
  for (std::size_t k = 0; k < 3; ++k) {  // mdtraj writes three decimals
    const Eigen::Matrix3Xd difference = read_frame(*file, k).positions - read_frame(*dcd, k).positions;
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 0.000501);
  }
  const auto cell = read_frame(*file, 0).cell;
  ASSERT_TRUE(cell);
  EXPECT_TRUE(cell->isApprox(*test::cell_from_angles({40, 50, 60}, {80, 75, 65}), 1e-6));
}

// Damage that is found when the file is opened, and damage that is found when the frame is read.
TEST(LammpsReader, FramesLeftOutAsDamagedAreMissing) {
  const std::string columns = "id x y z";
  const std::string sound = dump(0, 1, cube, columns, "1 0 0 0\n");
  for (const std::string& damaged :
       {dump(1, 2, cube, columns, "1 0 0 0\n2 0 0 0\n"), dump(1, 1, cube, columns, "1 x 0 0\n")}) {
    const auto path = test::write_file("a.lammpstrj", sound + damaged + sound);
    EXPECT_TRUE(read_trajectory(path, {.until_damage = true}).truncated);
    EXPECT_FALSE(read_trajectory(path, {.frames = {0, 1, 1}, .until_damage = true}).truncated);
  }
}

}  // namespace
}  // namespace kds::lammps_reader_test
