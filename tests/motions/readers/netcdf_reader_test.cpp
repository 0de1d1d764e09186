#include "motions/readers/netcdf_reader.h"

#include <gtest/gtest.h>
#include <numbers>

#include "motions/readers/dcd_reader.h"
#include "tests/motions/reader_files.h"
#include "tests/support/inputs/cells.h"
#include "tests/support/inputs/netcdf_maker.h"
#include "tests/support/rounds.h"

namespace kds::netcdf_reader_test {
namespace {

using test::NetcdfMaker;
using test::read_frame;

std::unique_ptr<AtomFrames> open(std::string_view bytes) {
  return open_netcdf(test::write_file("a.nc", bytes), {});
}

constexpr test::FileRefusal refuse{"a.nc"};

void expect_frames(AtomFrames& file, const NetcdfMaker& maker) {
  ASSERT_EQ(file.held().whole, maker.frames.size());
  EXPECT_FALSE(file.held().ends_inside);
  ASSERT_EQ(file.atom_count(), maker.frames[0].size());
  for (std::size_t k = maker.frames.size(); k-- > 0;) {
    const FrameRead frame = read_frame(file, k);
    EXPECT_EQ(frame.stamp.number, k);
    EXPECT_EQ(frame.stamp.picoseconds, maker.times[k]);
    for (std::size_t i = 0; i < file.atom_count(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double written = maker.frames[k][i][axis];
        EXPECT_EQ(frame.positions(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)),
                  maker.doubles ? written : static_cast<float>(written));
      }
  }
}

TEST(NetcdfReader, ReadsFramesOfEveryKind) {
  for (const int version : {1, 2, 5})
    for (const bool doubles : {false, true})
      for (const bool streamed : {false, true})
        for (const bool fixed : {false, true})
          for (const bool cell : {false, true}) {
            NetcdfMaker maker = NetcdfMaker::chain(5, 4);
            maker.version = version;
            maker.doubles = doubles;
            maker.streamed = streamed;
            maker.fixed_frames = fixed;
            if (cell) maker.cell = {30, 40, 50, 90, 90, 90};
            const auto file = open(maker.bytes());
            expect_frames(*file, maker);
            EXPECT_EQ(file->may_have_cell(), cell);
            EXPECT_TRUE(file->notes().empty());
            if (cell)
              EXPECT_EQ(read_frame(*file, 2).cell, Cell(Eigen::Vector3d(30, 40, 50).asDiagonal()));
            else
              EXPECT_FALSE(read_frame(*file, 2).cell);
          }
}

TEST(NetcdfReader, ReadsRestartFiles) {
  NetcdfMaker maker = NetcdfMaker::chain(5, 1);
  maker.restart = maker.doubles = true;
  maker.conventions = "AMBERRESTART";
  maker.times = {7};
  maker.cell = {30, 40, 50, 90, 90, 90};
  expect_frames(*open(maker.bytes()), maker);
}

TEST(NetcdfReader, ReadsTheWantedAtomsInAnyOrder) {
  const auto file = open(NetcdfMaker::chain(7, 2).bytes());
  FrameRead frame;
  file->read(1, std::vector<std::size_t>{4, 2, 5}, frame);
  EXPECT_EQ(frame.positions.row(0), Eigen::RowVector3d(6, 3, 7.5));
}

TEST(NetcdfReader, ConvertsUnits) {
  NetcdfMaker maker = NetcdfMaker::chain(3, 2);
  maker.units = "nanometers";
  maker.time_units = "femtosecond";
  maker.angle_units = "radian";
  maker.times = {0, 9};
  maker.cell = {3, 4, 5, std::numbers::pi / 2, std::numbers::pi / 2, std::numbers::pi / 3};
  for (const bool doubles : {false, true}) {
    maker.doubles = doubles;
    const auto file = open(maker.bytes());
    const FrameRead frame = read_frame(*file, 1);
    EXPECT_EQ(frame.positions(2, 0), 10.0F * 0.1F);
    EXPECT_EQ(frame.stamp.picoseconds, 9.0 / 1000);
    ASSERT_TRUE(frame.cell);
    EXPECT_TRUE(frame.cell->col(1).isApprox(Eigen::Vector3d(20, 20 * std::sqrt(3.0), 0), 1e-12));
    EXPECT_DOUBLE_EQ((*frame.cell)(2, 2), 50);
  }
}

// Floats are scaled as floats, so that other programs find the same coordinates.
TEST(NetcdfReader, Scales) {
  NetcdfMaker maker = NetcdfMaker::chain(3, 2);
  maker.scale = 1.1;
  maker.time_scale = 0.5;
  EXPECT_EQ(read_frame(*open(maker.bytes()), 1).positions(2, 0), 1.1F * 0.1F);
  EXPECT_EQ(read_frame(*open(maker.bytes()), 1).stamp.picoseconds, 0.5);
  maker.doubles = true;
  EXPECT_EQ(read_frame(*open(maker.bytes()), 1).positions(2, 0), 1.1 * 0.1);
  maker.scale = 0;
  refuse(maker.bytes(), {"a.nc", "scale_factor"});
}

TEST(NetcdfReader, ReadsVelocities) {
  NetcdfMaker maker = NetcdfMaker::chain(3, 2);
  const auto velocities = [&](const std::string& units) {
    maker.velocity_units = units;
    return read_frame(*open_netcdf(test::write_file("a.nc", maker.bytes()), {.velocities = true}), 1)
        .velocities;
  };
  EXPECT_EQ(velocities("angstrom/picosecond"), read_frame(*open(maker.bytes()), 1).positions);
  EXPECT_EQ(read_frame(*open(maker.bytes()), 1).velocities.cols(), 0);
  EXPECT_EQ(velocities("nanometers/ps")(1, 2), 2.5);
  EXPECT_EQ(velocities("angstrom/step").cols(), 0);
  for (const bool fixed : {false, true})
    for (const bool doubles : {false, true}) {
      maker.fixed_frames = fixed;
      maker.doubles = doubles;
      maker.velocity_scale = 20.455;  // AMBER's unit of time is 1/20.455 ps
      EXPECT_EQ(velocities("angstrom/picosecond")(1, 2), doubles ? 20.455 * 0.25 : 20.455F * 0.25F);
      EXPECT_DOUBLE_EQ(velocities("angstrom/femtosecond")(1, 2), 1000 * (doubles ? 20.455 : 20.455F) * 0.25);
    }
  maker.frames[1][2][1] = 9.9692099683868690e+36;  // NetCDF's fill value
  const auto file = open_netcdf(test::write_file("a.nc", maker.bytes()), {.velocities = true});
  test::expect_refused([&] { (void)read_frame(*file, 1); }, {"found NetCDF's fill value"});
}

TEST(NetcdfReader, NamesTheByteOfADamagedHeader) {
  std::string bytes = NetcdfMaker::chain(3, 2).bytes();
  bytes[11] = '\x0c';  // the list of dimensions begins at byte 8
  refuse(bytes, {"a.nc: byte 8: expected the NetCDF list of dimensions (tag 10), found tag 12 and length 3"});
  bytes[11] = '\x0a';
  const std::size_t name = bytes.find("coordinates");  // its rank and dimensions follow
  bytes[name + 12 + 4 + 3] = '\x07';
  refuse(bytes, {"a.nc: byte " + std::to_string(name + 16) + ": expected the number of one of 3 dimensions",
                 "counted from 0, found 7"});
}

TEST(NetcdfReader, NotesDoubtfulUnits) {
  NetcdfMaker maker = NetcdfMaker::chain(3, 2);
  maker.units = "";
  maker.time_units = "step";
  const auto file = open(maker.bytes());
  EXPECT_FALSE(read_frame(*file, 1).stamp.picoseconds);
  ASSERT_EQ(file->notes().size(), 2U);
  EXPECT_NE(file->notes()[0].find("angstrom"), std::string::npos);
  EXPECT_NE(file->notes()[1].find("'step'"), std::string::npos);
}

TEST(NetcdfReader, ReadsFilesWithoutTimes) {
  NetcdfMaker maker = NetcdfMaker::chain(3, 2);
  maker.with_time = false;
  const auto file = open(maker.bytes());  // only one variable has records
  EXPECT_FALSE(read_frame(*file, 1).stamp.picoseconds);
  EXPECT_EQ(read_frame(*file, 1).positions(1, 2), 0.25);
}

// libnetcdf would return zeros for the bytes that are not there. reader_fuzz_test.cpp cuts the last frame.
TEST(NetcdfReader, CutFiles) {
  for (const int version : {1, 2, 5})
    for (const bool streamed : {false, true}) {
      NetcdfMaker maker = NetcdfMaker::chain(4, 3);
      maker.version = version;
      maker.streamed = streamed;
      const auto file = open(maker.bytes().substr(0, maker.bytes().size() - maker.frame_bytes()));
      EXPECT_EQ(file->held().whole, 2U);
      EXPECT_EQ(file->held().ends_inside, !streamed);  // only the header tells that a frame is missing
    }
  NetcdfMaker maker = NetcdfMaker::chain(4, 3);
  refuse(maker.bytes().substr(0, 100), {"ends inside its NetCDF header"});
  maker.fixed_frames = true;
  EXPECT_EQ(open(maker.bytes().substr(0, maker.bytes().size() - 1))->held().whole, 2U);
  maker.restart = true;
  maker.frames.resize(1);
  refuse(maker.bytes().substr(0, maker.bytes().size() - 1), {"a.nc", "ends inside frame 0"});
}

TEST(NetcdfReader, ComparesTheHeaderWithTheFile) {
  NetcdfMaker maker = NetcdfMaker::chain(4, 3);
  maker.frames_claimed = 2;
  const auto file = open(maker.bytes());
  EXPECT_EQ(file->held().whole, 2U);
  ASSERT_EQ(file->notes().size(), 1U);
  EXPECT_NE(file->notes()[0].find("counts 2 frames, the file has room for 3"), std::string::npos);
  maker.frames_claimed = 2000000000;
  EXPECT_EQ(open(maker.bytes())->held().whole, 3U);
  EXPECT_TRUE(open(maker.bytes())->held().ends_inside);
  // With a fixed dimension of frames the coordinates are the last part of the file.
  maker = NetcdfMaker::chain(4, 3);
  maker.fixed_frames = true;
  const auto longer = open(maker.bytes() + std::string(4 * 12, '\0'));
  EXPECT_EQ(longer->held().whole, 3U);
  ASSERT_EQ(longer->notes().size(), 1U);
  EXPECT_NE(longer->notes()[0].find("counts 3 frames, the file has room for 4"), std::string::npos);
  EXPECT_TRUE(open(maker.bytes() + std::string(4 * 12 - 1, '\0'))->notes().empty());
}

// The size of a variable shows that a dimension in the header has been changed.
TEST(NetcdfReader, ComparesSizesWithDimensions) {
  for (const int version : {1, 2, 5}) {
    NetcdfMaker maker = NetcdfMaker::chain(4, 3);
    maker.version = version;
    maker.fixed_frames = true;
    maker.frames_claimed = 2;
    refuse(maker.bytes(), {"a.nc: byte ", "expected a size of 8 for the variable 'time'", "found 12"});
    maker.with_time = false;
    refuse(maker.bytes(), {"expected a size of 96 for the variable 'coordinates'", "found 144"});
  }
}

TEST(NetcdfReader, TimesThatWereNeverWrittenAreNone) {
  NetcdfMaker maker = NetcdfMaker::chain(4, 2);
  maker.times = {9.9692099683868690e+36, 0.2};
  const auto file = open(maker.bytes());
  EXPECT_FALSE(read_frame(*file, 0).stamp.picoseconds);
  EXPECT_EQ(read_frame(*file, 1).stamp.picoseconds, 0.2);  // the shortest number, not 0.200000003
}

TEST(NetcdfReader, RefusesUnwrittenFrames) {
  NetcdfMaker maker = NetcdfMaker::chain(4, 3);
  maker.frames[1][2][0] = 9.9692099683868690e+36;
  const std::string bytes = maker.bytes();
  const std::size_t place = bytes.size() - 2 * maker.frame_bytes() + 4 + 2 * 12;
  refuse(bytes, {"a.nc: frame 1, byte " + std::to_string(place) + ":", "atom 2", "fill value"});
}

TEST(NetcdfReader, Refuses) {
  NetcdfMaker maker = NetcdfMaker::chain(4, 2);
  refuse("\x89HDF\r\n\x1A\n and more", {"a.nc", "HDF5", "nccopy -k classic"});
  refuse("CDF\x03 and more", {"a.nc", "CDF-1, CDF-2 or CDF-5"});
  refuse("", {"a.nc"});
  maker.conventions = "CF-1.0";
  refuse(maker.bytes(), {"a.nc", "'CF-1.0'", "AMBER"});
  maker.conventions = "CF-1.0, AMBER";
  EXPECT_EQ(open(maker.bytes())->held().whole, 2U);
  maker.units = "furlong";
  refuse(maker.bytes(), {"a.nc", "'furlong'", "angstrom or nanometer"});
  maker.units = "angstrom";
  maker.cell = {30, 40, 50, 90, 90, 90};
  maker.angle_units = "gon";
  refuse(maker.bytes(), {"a.nc", "'gon'", "degree or radian"});
  maker.cell.reset();
  std::string renamed = maker.bytes();
  renamed.replace(renamed.find("coordinates"), 4, "velo");
  refuse(renamed, {"a.nc", "expected a variable coordinates"});
}

TEST(NetcdfReader, RefusesGzippedFiles) {
  const auto path = test::write_gzipped("a.nc.gz", NetcdfMaker::chain(4, 2).bytes());
  test::expect_refused([&] { (void)read_trajectory(path); }, {"a.nc.gz", "gunzip"});
}

// Files that mdtraj, MDAnalysis (with a scale factor) and netCDF4 wrote, and the coordinates that they read.
TEST(NetcdfReader, ReadsTheFilesOfOtherPrograms) {
  const std::string folder = "formats/1l2y_first3_";
  for (const auto& [name, expected] : {std::pair{"mdtraj.nc", std::string("trajectories/1l2y.dcd")},
                                       std::pair{"mdanalysis.nc", folder + "mdanalysis.dcd"},
                                       std::pair{"cdf5.nc", std::string("trajectories/1l2y.dcd")}}) {
    const auto file = open_netcdf(test::data_file(folder + name), {});
    const auto dcd = open_dcd(test::data_file(expected), {});
    ASSERT_EQ(file->held().whole, 3U);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(read_frame(*file, k).positions, read_frame(*dcd, k).positions) << name;
  }
  const FrameRead frame = read_frame(*open_netcdf(test::data_file(folder + "mdtraj.nc"), {}), 2);
  EXPECT_EQ(frame.stamp.picoseconds, 5.0);
  EXPECT_EQ(frame.cell, test::cell_from_angles({40, 50, 60}, {80, 75, 65}));
  EXPECT_EQ(read_frame(*open_netcdf(test::data_file(folder + "mdanalysis.nc"), {}), 2).stamp.picoseconds,
            1.0);
}

}  // namespace
}  // namespace kds::netcdf_reader_test
