#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>
#include <numbers>
#include <random>

#include "motions/frames/periodic.h"
#include "tests/motions/reader_files.h"
#include "tests/support/inputs/cells.h"

namespace kds::dcd_reader_test {
namespace {

using test::DcdMaker;

constexpr test::FileReader read{"a.dcd"};
constexpr test::FileRefusal refuse{"a.dcd"};

void expect_frames(const Trajectory& trajectory, const DcdMaker& maker) {
  ASSERT_EQ(trajectory.frames.size(), maker.frames.size());
  for (std::size_t k = 0; k < maker.frames.size(); ++k) {
    ASSERT_EQ(trajectory.frames[k].cols(), static_cast<Eigen::Index>(maker.frames[k].size()));
    for (Eigen::Index i = 0; i < trajectory.frames[k].cols(); ++i)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        EXPECT_EQ(trajectory.frames[k](axis, i),
                  double{maker.frames[k][static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)]});
  }
}

FrameRange up_to(std::size_t last) { return {0, last, 1}; }

TEST(DcdReader, EveryLayout) {
  for (const bool big_endian : {false, true})
    for (const std::size_t marker_size : {4U, 8U})
      for (const bool cell : {false, true})
        for (const bool fourth : {false, true})
          for (const bool fixed : {false, true}) {
            DcdMaker maker = DcdMaker::chain(7, 4);
            maker.big_endian = big_endian;
            maker.marker_size = marker_size;
            maker.cell = cell;
            maker.fourth = fourth;
            if (fixed) {
              maker.free_atoms = {2, 3, 7};
              for (auto& frame : maker.frames)
                for (const std::size_t i : {0U, 3U, 4U, 5U}) frame[i] = maker.frames[0][i];
            }
            const Trajectory trajectory = read(maker.bytes());
            expect_frames(trajectory, maker);
            EXPECT_TRUE(trajectory.element_radii.empty());
            EXPECT_TRUE(trajectory.warnings.empty()) << trajectory.warnings[0];
          }
}

TEST(DcdReader, FlagsOfXplorAreNotRead) {
  DcdMaker maker = DcdMaker::chain(5, 2);
  maker.version = 0;
  std::string bytes = maker.bytes();
  bytes[4 + 4 * 11] = 9;  // in X-PLOR files this byte is part of a time step in double
  expect_frames(read(bytes), maker);
}

TEST(DcdReader, SelectsFramesBySeeking) {
  DcdMaker maker = DcdMaker::chain(5, 10);
  maker.frames[3][2][1] = std::numeric_limits<float>::quiet_NaN();  // in a frame that is not selected
  const Trajectory trajectory = read(maker.bytes(), {.frames = {1, 9, 4}});
  EXPECT_EQ(trajectory.frame_numbers, (std::vector<std::size_t>{1, 5}));
  EXPECT_EQ(trajectory.frames[1](1, 0), 1.25);
  maker.free_atoms = {1, 2};
  EXPECT_EQ(read(maker.bytes(), {.frames = {9, 10, 1}}).frames[0](1, 0), 2.25);
  refuse(maker.bytes(), {"--frames", "10 frames"}, {.frames = {10, std::nullopt, 1}});
  refuse(maker.bytes(), {"--frames", "10 frames"}, {.frames = up_to(11)});
}

TEST(DcdReader, FalseFrameCountIsWarnedOf) {
  DcdMaker maker = DcdMaker::chain(5, 3);
  maker.claim_as_said = true;
  for (const std::int32_t claimed : {500, 0, -7, 2}) {
    maker.frames_claimed = claimed;
    const Trajectory trajectory = read(maker.bytes());
    expect_frames(trajectory, maker);
    ASSERT_EQ(trajectory.warnings.size(), 1U);
    EXPECT_NE(trajectory.warnings[0].find("claims " + std::to_string(claimed) + " frames, the file holds 3"),
              std::string::npos);
  }
}

TEST(DcdReader, RecordThatDisagreesWithTheAtoms) {
  DcdMaker maker = DcdMaker::chain(108, 9);
  DcdMaker fewer = DcdMaker::chain(100, 1);
  std::string bytes = maker.header();
  for (std::size_t k = 0; k < 7; ++k) bytes += maker.frame(k);
  bytes += fewer.frame(0) + maker.frame(8);
  refuse(bytes, {"a.dcd: frame 7, byte 9436: record holds 100 atoms, expected 108"});
  // This error is also reported if the file size happens to fit.
  std::string flipped = maker.bytes();
  flipped[maker.header().size() + 2 * maker.frame(0).size()] = 12;
  refuse(flipped, {"a.dcd: frame 2, byte 2836: record holds 67 atoms, expected 108"});
}

TEST(DcdReader, CellWhereNoneIsAnnounced) {
  DcdMaker maker = DcdMaker::chain(108, 2);
  std::string bytes = maker.header();
  maker.cell = true;
  bytes += maker.frame(0) + maker.frame(1);
  refuse(bytes, {"a.dcd: frame 0, byte 196: record holds 12 atoms, expected 108"});
}

TEST(DcdReader, HeadersThatLie) {
  DcdMaker maker = DcdMaker::chain(5, 2);
  maker.atoms_claimed = 2000000000;
  refuse(maker.bytes(), {"a.dcd: frame 0, byte 196: record holds 5 atoms, expected 2000000000"});
  maker.atoms_claimed = 0;
  refuse(maker.bytes(), {"a.dcd", "0 atoms"});
  maker.atoms_claimed = -1;
  maker.magic = "VELD";
  refuse(maker.bytes(), {"a.dcd", "velocities"});
  maker.magic = "NONE";
  refuse(maker.bytes(), {"a.dcd", "no DCD file"});
  refuse("", {"a.dcd", "no DCD file"});
  maker.magic = "CORD";
  maker.free_atoms = {2, 2};
  refuse(maker.bytes(), {"a.dcd", "free atoms"});
  maker.free_atoms = {3, 6};
  refuse(maker.bytes(), {"a.dcd", "free atoms"});
  maker.free_atoms.clear();
  refuse(maker.header(), {"a.dcd", "no frame"});
  std::string title = maker.bytes();
  title[4 + 84 + 4 + 3] = 0x7f;      // a title of two gigabytes
  title[4 + 84 + 4 + 4 + 3] = 0x7f;  // and of as many lines
  refuse(title, {"a.dcd", "title"});
  test::expect_refused([] { (void)read_trajectory("no-such-file.dcd"); },
                       {"no-such-file.dcd", "cannot open"});
  std::filesystem::create_directories(test::temporary("folder.dcd"));
  test::expect_refused([] { (void)read_trajectory(test::temporary("folder.dcd")); }, {"folder.dcd"});
}

// A chain that crosses the walls of a cell. If the cell is read correctly, bonds have length 3.
struct WrappedChain {
  Cell cell;
  DcdMaker maker;

  explicit WrappedChain(const Cell& of_cell) : cell(of_cell) {
    const Cell inverse = cell.inverse();
    maker.cell = true;
    for (int k = 0; k < 3; ++k) {
      auto& frame = maker.frames.emplace_back();
      for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3d place = (3.0 * i + k) * Eigen::Vector3d(2, 3, 6) / 7;
        const Eigen::Vector3d inside = place - cell * (inverse * place).array().floor().matrix();
        frame.push_back(
            {static_cast<float>(inside[0]), static_cast<float>(inside[1]), static_cast<float>(inside[2])});
      }
    }
  }

  bool is_whole_when_read() const {
    const Trajectory trajectory = read(maker.bytes());
    double worst = 0;
    for (const auto& frame : trajectory.frames)
      for (Eigen::Index i = 0; i + 1 < frame.cols(); ++i)
        worst = std::max(worst, std::abs((frame.col(i + 1) - frame.col(i)).norm() - 3));
    return worst < 1e-3;
  }
};

// Returns the symmetric matrix whose square is the metric of the cell, as CHARMM writes it.
Cell shape_matrix(const Cell& cell) {
  const Eigen::SelfAdjointEigenSolver<Cell> solver(cell.transpose() * cell);
  return solver.operatorSqrt();
}

std::array<double, 6> numbers_of(const Cell& symmetric) {
  return {symmetric(0, 0), symmetric(0, 1), symmetric(1, 1),
          symmetric(0, 2), symmetric(1, 2), symmetric(2, 2)};
}

struct CellShape {
  Eigen::Vector3d lengths, degrees;
};

std::vector<CellShape> cell_shapes() {
  constexpr double octahedron = 109.4712206344907, obtuse = 70.52877936550931;
  return {{{40, 40, 40}, {90, 90, 90}},
          {{30, 41, 52}, {90, 90, 90}},
          {{40, 40, 40}, {octahedron, octahedron, octahedron}},
          {{40, 40, 40}, {obtuse, octahedron, obtuse}},
          {{40, 40, 40}, {60, 60, 90}},
          {{40, 40, 60}, {90, 90, 60}},
          {{40, 40, 60}, {90, 90, 120}},
          {{40, 45, 50}, {80, 75, 85}},
          {{40, 45, 50}, {90, 97, 90}},
          {{44, 45, 50}, {100, 95, 110}},
          {{40, 40, 40}, {60, 60, 60}},
          {{70, 71, 72}, {60, 90, 90}}};
}

TEST(DcdReader, CellsOfEveryFormAndShape) {
  for (const CellShape& shape : cell_shapes()) {
    const Cell cell = *test::cell_from_angles(shape.lengths, shape.degrees);
    const Eigen::Vector3d& l = shape.lengths;
    const Eigen::Vector3d& d = shape.degrees;
    WrappedChain degrees(cell);
    degrees.maker.cell_values = {l[0], d[2], l[1], d[1], d[0], l[2]};
    EXPECT_TRUE(degrees.is_whole_when_read()) << l.transpose() << " " << d.transpose();
    WrappedChain cosines(cell);
    const Eigen::Vector3d c = (d * std::numbers::pi / 180).array().cos();
    cosines.maker.cell_values = {l[0], c[2], l[1], c[1], c[0], l[2]};
    EXPECT_TRUE(cosines.is_whole_when_read()) << l.transpose() << " " << d.transpose();
    WrappedChain matrix(shape_matrix(cell));
    matrix.maker.cell_values = numbers_of(matrix.cell);
    matrix.maker.version = 39;
    EXPECT_TRUE(matrix.is_whole_when_read()) << l.transpose() << " " << d.transpose();
    matrix.maker.version = 24;
    if (shape.lengths[0] < 60) {
      EXPECT_TRUE(matrix.is_whole_when_read()) << l.transpose() << " " << d.transpose();
    }
    matrix.maker.title = "* CHARMM";
    EXPECT_TRUE(matrix.is_whole_when_read()) << l.transpose() << " " << d.transpose();
  }
}

TEST(DcdReader, CellsOfAnUnknownFormAreNotUsed) {
  const auto warnings = [](const std::array<double, 6>& numbers, std::int32_t version,
                           const std::string& title) {
    DcdMaker maker = DcdMaker::chain(5, 2);
    maker.cell = true;
    maker.cell_values = numbers;
    maker.version = version;
    maker.title = title;
    const Trajectory trajectory = read(maker.bytes());
    expect_frames(trajectory, maker);
    return trajectory.warnings;
  };
  const auto not_used =
      testing::ElementsAre(testing::HasSubstr("a.dcd: frame 0: its periodic cell is not used: "));
  // These values are ambiguous: angles of 47 degrees, or the matrix of a rhombic dodecahedron.
  const std::array<double, 6> either{188.6, 47.1, 188.6, 47.1, 47.1, 188.6};
  EXPECT_THAT(warnings(either, 24, "made up"), not_used);
  EXPECT_THAT(warnings(either, 35, "made up"), testing::IsEmpty());
  EXPECT_THAT(warnings(either, 24, "* CHARMM"), testing::IsEmpty());
  EXPECT_THAT(warnings(either, 24, "Created by DCD plugin"), testing::IsEmpty());
  EXPECT_THAT(warnings(either, 21, "* CHARMM"), testing::IsEmpty());
  // These values are not a cell in any form.
  EXPECT_THAT(warnings({20, -30, 20, 5, 5, 20}, 24, "made up"), not_used);
  EXPECT_THAT(warnings({20, 190, 20, 90, 90, 20}, 24, "made up"), not_used);
  EXPECT_THAT(warnings({20, 1, 20, 1, 1, 20}, 21, "made up"), not_used);
  // NAMD does not write matrices.
  EXPECT_THAT(warnings({38.5, -7.7, 38.5, -7.7, -7.7, 38.5}, 24, "Created by NAMD"), not_used);
  EXPECT_THAT(warnings({20, 0, 20, 0, 0, 0}, 24, "made up"), not_used);
  EXPECT_THAT(warnings({-20, 0, 20, 0, 0, 20}, 24, "made up"), not_used);
  EXPECT_THAT(warnings({0, 0, 0, 0, 0, 0}, 24, "made up"), testing::IsEmpty());
  EXPECT_THAT(warnings({1, 90, 1, 90, 90, 1}, 24, "made up"), testing::IsEmpty());
}

// One frame decides the form for all frames: in the first frame this matrix is almost diagonal.
TEST(DcdReader, FormOfCellsIsThatOfTheFile) {
  DcdMaker maker = DcdMaker::chain(5, 2);
  maker.frames[0] = {{{0, 0, 0}, {3, 0, 0}, {6, 0, 0}, {9, 0, 0}, {12, 0, 0}}};
  maker.cell = true;
  maker.cell_values = {20, -0.5, 20, -0.5, -0.5, 20};
  std::string bytes = maker.header() + maker.frame(0);
  maker.cell_values = {20, -2, 20, -2, -2, 20};
  bytes += maker.frame(1);
  // If the values were read as cosines, the first frame would be a cell of another shape with a third of the
  // volume.
  EXPECT_THAT(read(bytes).warnings, testing::IsEmpty());
}

TEST(DcdReader, GzippedFiles) {
  std::mt19937 random(3);
  DcdMaker maker = DcdMaker::chain(50, 60);
  for (auto& frame : maker.frames)
    for (auto& atom : frame) atom[2] = static_cast<float>(random() % 1000) / 1000;
  maker.cell = true;
  const auto path = test::write_gzipped("a.dcd.gz", maker.bytes());
  expect_frames(read_trajectory(path), maker);
  EXPECT_EQ(read_trajectory(path, {.frames = {10, 40, 7}}).frame_numbers,
            (std::vector<std::size_t>{10, 17, 24, 31, 38}));
  const std::string packed = test::read_bytes(path);
  for (const double share : {0.3, 0.6, 0.95}) {
    const auto cut = test::write_file(
        "cut.dcd.gz", std::string_view(packed).substr(
                          0, static_cast<std::size_t>(share * static_cast<double>(packed.size()))));
    const Trajectory whole = read_trajectory(cut);
    EXPECT_GT(whole.frames.size(), 5U);
    ASSERT_FALSE(whole.warnings.empty());
    EXPECT_NE(whole.warnings[0].find("the file ends inside frame"), std::string::npos);
    EXPECT_EQ(read_trajectory(cut, {.frames = up_to(5)}).frames.size(), 5U);
  }
  maker.free_atoms = {2, 3, 7};
  for (auto& frame : maker.frames)
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (i != 1 && i != 2 && i != 6) frame[i] = maker.frames[0][i];
  expect_frames(read_trajectory(test::write_gzipped("a.dcd.gz", maker.bytes())), maker);
}

TEST(DcdReader, TimesOfLammps) {
  struct Case {
    std::int32_t first, steps;
    double length;
    std::vector<double> times;
  };
  // The comments name the unit styles of LAMMPS.
  for (const Case& one : std::initializer_list<Case>{{0, 1000, 1, {0, 1, 2, 3, 4}},
                                                     {5000, 1000, 1, {5, 6, 7, 8, 9}},
                                                     {0, 1, 1, {0, 0.001, 0.002, 0.003, 0.004}},
                                                     {0, 100, 2, {0, 0.2, 0.4, 0.2 * 3, 0.8}},
                                                     {0, 500, 0.5, {0, 0.25, 0.5, 0.75, 1}},
                                                     {0, 100, 10, {0, 1, 2, 3, 4}},
                                                     {0, 1000, 0.001, {}},  // metal, electron
                                                     {0, 1000, 0.005, {}},  // lj
                                                     {0, 1000, 0.05, {}},
                                                     {0, 1000, 1e-8, {}},  // si
                                                     {0, 1000, 100, {}}}) {
    DcdMaker maker = DcdMaker::chain(6, 5);
    maker.title = "Written by LAMMPS";
    maker.first_step = one.first;
    maker.steps_a_frame = one.steps;
    maker.step_length = one.length;
    const Trajectory trajectory = read(maker.bytes());
    EXPECT_EQ(trajectory.times, one.times) << one.length;
    EXPECT_THAT(trajectory.warnings,
                testing::ElementsAre(
                    testing::AllOf(testing::HasSubstr("LAMMPS does not write its unit of time"),
                                   testing::HasSubstr(one.times.empty() ? "numbers" : "femtoseconds"))));
  }
}

TEST(DcdReader, TellsTheTimesOfFramesWhereTheHeaderHasThem) {
  DcdMaker maker = DcdMaker::chain(4, 7);
  const auto times = [&](std::int32_t first, std::int32_t steps, double length) {
    maker.first_step = first;
    maker.steps_a_frame = steps;
    maker.step_length = length;
    return read(maker.bytes(), {.frames = {1, std::nullopt, 2}}).times;
  };
  constexpr double femtoseconds = 1 / 48.88821;
  for (const bool big_endian : {false, true})
    for (const std::int32_t version : {24, 0}) {
      maker.big_endian = big_endian;
      maker.version = version;
      // Steps of 2 fs with a frame every 500 steps: 1 ps.
      EXPECT_EQ(times(0, 500, 2 * femtoseconds), (std::vector<double>{1, 3, 5}));
      EXPECT_EQ(times(500, 500, 2 * femtoseconds), (std::vector<double>{2, 4, 6}));
      EXPECT_EQ(times(0, 1, 20 * femtoseconds), (std::vector<double>{0.02, 3 * 0.02, 5 * 0.02}));
      // Programs that do not know the step write such headers. Some values are not possible times.
      EXPECT_TRUE(times(0, 1, 1).empty());
      EXPECT_TRUE(times(0, 0, 0).empty());
      EXPECT_TRUE(times(0, 1, 0).empty());
      EXPECT_TRUE(times(0, -1, 0.1).empty());
      EXPECT_TRUE(times(-7, 1, 0.1).empty());
      EXPECT_TRUE(times(0, 1, -0.1).empty());
      EXPECT_TRUE(times(0, 1, std::numeric_limits<double>::quiet_NaN()).empty());
      EXPECT_TRUE(times(0, 1, 1e-30).empty());
      EXPECT_TRUE(times(0, 1, 1e30).empty());
    }
  EXPECT_TRUE(read_trajectory(test::data_file("trajectories/villin_hp36_300K.dcd")).times.empty());
}

TEST(DcdReader, TopologyPicksAtoms) {
  // Waters at the beginning, alternate locations and a second chain count as atoms of the DCD.
  std::string pdb =
      test::pdb_line({.name = "O", .residue = "HOH", .chain = 'W', .het = true, .element = "O"});
  pdb += test::pdb_residue(1, 'B') + test::pdb_residue(1) + test::pdb_line({.name = "CB", .alternate = 'A'}) +
         test::pdb_line({.name = "CB", .alternate = 'B'}) + test::pdb_residue(2);
  const auto topology = test::write_file("t.pdb", pdb);
  const DcdMaker maker = DcdMaker::chain(12, 2);
  const auto x = [&](const ReadOptions& options) {
    std::vector<double> places;
    const Trajectory trajectory = read(maker.bytes(), options);
    EXPECT_EQ(trajectory.element_radii.size(), trajectory.bead_count());
    for (Eigen::Index i = 0; i < trajectory.frames[0].cols(); ++i)
      places.push_back(trajectory.frames[0](0, i) / 1.5);
    return places;
  };
  EXPECT_EQ(x({.topology = topology}), (std::vector<double>{1, 2, 3}));
  EXPECT_THAT(read(maker.bytes(), {.topology = topology}).warnings,
              testing::ElementsAre(testing::HasSubstr("t.pdb: chain A not read; --chain A or --chain B,A")));
  EXPECT_EQ(x({.topology = topology, .chain = "A"}), (std::vector<double>{4, 5, 6, 9, 10, 11}));
  EXPECT_EQ(x({.topology = topology, .selection = Selection::ca, .chain = "A"}),
            (std::vector<double>{5, 10}));
  EXPECT_EQ(x({.topology = topology, .selection = Selection::all, .chain = "A"}),
            (std::vector<double>{4, 5, 6, 7, 9, 10, 11}));
  // A file that contains the beads only.
  const Trajectory beads = read(DcdMaker::chain(6, 2).bytes(), {.topology = topology, .chain = "A"});
  EXPECT_EQ(beads.bead_count(), 6U);
  EXPECT_EQ(beads.element_radii.front(), 1.55);
  const std::vector<Trajectory> both = read_trajectories(
      test::write_file("a.dcd", DcdMaker::chain(9, 2).bytes()), {.topology = topology, .chain = "A,B"});
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].bead_count(), 6U);
  EXPECT_EQ(both[1].frames[0](0, 0), 9);
  refuse(DcdMaker::chain(11, 2).bytes(), {"a.dcd", "11 atoms", "t.pdb names 12 (3 of them selected)"},
         {.topology = topology});
  refuse(maker.bytes(), {"no-such-file.pdb"}, {.topology = "no-such-file.pdb"});
}

TEST(DcdReader, RealFiles) {
  const Trajectory villin =
      read_trajectory(test::data_file("trajectories/villin_hp36_300K.dcd"),
                      {.topology = test::data_file("trajectories/villin_hp36_300K.pdb")});
  EXPECT_EQ(villin.bead_count(), 108U);
  EXPECT_EQ(villin.frames.size(), 1000U);
  EXPECT_TRUE(villin.breaks.empty());
  EXPECT_TRUE(villin.warnings.empty());
  EXPECT_EQ(villin.element_radii.size(), 108U);
  const Trajectory start = read_trajectory(test::data_file("trajectories/villin_hp36_300K.pdb"));
  EXPECT_LT((villin.frames[0] - start.frames[0]).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(DcdReader, SameCoordinatesAsTheModelsOfAPdbFile) {
  const auto pdb = test::data_file("proteins/1l2y.pdb");
  for (const Selection selection : {Selection::automatic, Selection::ca, Selection::all}) {
    const Trajectory models = read_trajectory(pdb, {.selection = selection});
    const Trajectory frames =
        read_trajectory(test::data_file("trajectories/1l2y.dcd"), {.topology = pdb, .selection = selection});
    EXPECT_TRUE(frames.warnings.empty());
    ASSERT_EQ(models.frames.size(), 38U);
    ASSERT_EQ(frames.frames.size(), 38U);
    EXPECT_EQ(models.element_radii, frames.element_radii);
    for (std::size_t k = 0; k < 38; ++k) {
      ASSERT_EQ(models.frames[k].cols(), frames.frames[k].cols());
      EXPECT_LT((models.frames[k] - frames.frames[k]).cwiseAbs().maxCoeff(), 1e-5);
    }
  }
}

}  // namespace
}  // namespace kds::dcd_reader_test
