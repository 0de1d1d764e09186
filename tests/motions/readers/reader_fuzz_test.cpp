// Whatever a file contains, a reader returns valid frames or throws an InputError.

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "motions/readers/instance.h"
#include "motions/readers/necklace_stream.h"
#include "motions/readers/read_trajectory.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/topology.h"
#include "motions/scene/radii.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/gro_text.h"
#include "tests/support/inputs/netcdf_maker.h"
#include "tests/support/rounds.h"

namespace kds::reader_fuzz_test {
namespace {

using namespace std::string_view_literals;

std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  constexpr std::string_view interesting = "\0\n\r \t-+.0129eE:;'\"_#\x7f\x80\xff"sv;
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t place = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[place] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[place] = interesting[below(interesting.size())];
        break;
      case 2:
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << below(8)));
        break;
      case 3:
        bytes.erase(place, 1 + below(8));
        break;
      case 4:
        bytes.insert(place, 1, interesting[below(interesting.size())]);
        break;
      default:
        bytes.insert(place, bytes.substr(below(bytes.size()), 1 + below(90)));
        break;
    }
  }
  return bytes;
}

void expect_sound(const Trajectory& trajectory) {
  ASSERT_FALSE(trajectory.frames.empty());
  ASSERT_GT(trajectory.bead_count(), 0U);
  ASSERT_EQ(trajectory.frames.size(), trajectory.frame_numbers.size());
  for (const Eigen::Matrix3Xd& frame : trajectory.frames) {
    ASSERT_EQ(static_cast<std::size_t>(frame.cols()), trajectory.bead_count());
    ASSERT_TRUE(frame.allFinite());
  }
  if (!trajectory.element_radii.empty()) {
    ASSERT_EQ(trajectory.element_radii.size(), trajectory.bead_count());
  }
  for (const std::size_t b : trajectory.breaks) ASSERT_LT(b + 1, trajectory.bead_count());
  for (const std::string& warning : trajectory.warnings) ASSERT_EQ(warning.find('\n'), std::string::npos);
}

// A test needs more readable files than this, so that it does not see refusals alone. A tenth of the rounds
// may have none.
constexpr int least_accepted = test::rounds(100) == 100 ? 10 : -1;

// Returns the number of files that could be read.
template <class Read>
int fuzz(const std::string& name, const std::string& bytes, int rounds, const Read& read) {
  std::mt19937 random(20);
  int accepted = 0;
  for (int round = 0; round < test::rounds(rounds); ++round) {
    const auto path = test::write_file(name, mutated(bytes, random));
    try {
      read(path);
      ++accepted;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
      EXPECT_LT(std::string_view(error.what()).size(), 2000U);
    } catch (const std::exception& error) {
      ADD_FAILURE() << "round " << round << ": " << error.what();
    }
    if (testing::Test::HasFailure()) break;
  }
  return accepted;
}

// Checks that reading frame by frame, and reading a second time from the start, give the same frames.
void expect_same_frame_by_frame(const Trajectory& trajectory, const std::filesystem::path& path,
                                const ReadOptions& options) {
  NecklaceStream stream(path, options);
  EXPECT_EQ(stream.heads().front().frames.front(), trajectory.frames.front());
  for (int round = 0; round < 2; ++round, stream.rewind()) {
    std::size_t k = 0;
    for (FrameRead frame; stream.next(frame); ++k) {
      ASSERT_LT(k, trajectory.frames.size());
      ASSERT_EQ(frame.positions, trajectory.frames[k]);
      ASSERT_EQ(frame.stamp.number, trajectory.frame_numbers[k]);
    }
    ASSERT_EQ(k, trajectory.frames.size());
    EXPECT_EQ(stream.warnings(0), trajectory.warnings);
  }
}

void read_and_check(const std::filesystem::path& path, const ReadOptions& options = {}) {
  const Trajectory trajectory = read_trajectory(path, options);
  expect_sound(trajectory);
  expect_same_frame_by_frame(trajectory, path, options);
  for (const char* policy : {"auto", "element:fit"}) {
    try {
      EXPECT_EQ(bead_radii(policy, std::span(&trajectory, 1)).size(), trajectory.bead_count());
    } catch (const InputError&) {
    }
  }
}

TEST(ReaderFuzz, Dcd) {
  test::DcdMaker maker = test::DcdMaker::chain(4, 3);
  EXPECT_GT(fuzz("a.dcd", maker.bytes(), 1500, [](const auto& path) { read_and_check(path); }),
            least_accepted);
  maker.cell = true;
  maker.free_atoms = {2, 4};
  maker.big_endian = true;
  fuzz("a.dcd", maker.bytes(), 1500, [](const auto& path) { read_and_check(path); });
  fuzz("a.dcd", maker.bytes(), 500, [](const auto& path) { read_and_check(path, {.frames = {0, 2, 1}}); });
  maker.marker_size = 8;
  fuzz("a.dcd", maker.bytes(), 500, [](const auto& path) { read_and_check(path); });
}

TEST(ReaderFuzz, Pdb) {
  const std::string model = test::pdb_residue(1) + test::pdb_residue(2) + "TER\n" +
                            test::pdb_line({.name = "O", .residue = "HOH", .number = 3, .het = true});
  const std::string cell = "CRYST1   20.000   20.000   20.000  90.00  90.00  90.00 P 1           1\n";
  const std::string text =
      cell + "MODEL        1\n" + model + "ENDMDL\nMODEL        2\n" + model + "ENDMDL\nEND\n";
  for (const Selection selection : {Selection::automatic, Selection::all})
    EXPECT_GT(
        fuzz("a.pdb", text, 1500, [&](const auto& path) { read_and_check(path, {.selection = selection}); }),
        least_accepted);
}

TEST(ReaderFuzz, Gro) {
  test::GroText first, second;
  first.title = "t= 0.0";
  second.title = "t= 1.0";
  const std::string text = first.residues(1, 2).residue(1, "SOL", {"OW"}).text() +
                           second.residues(1, 2).residue(1, "SOL", {"OW"}).text();
  for (const Selection& selection : {Selection(), *Selection::parse("/")})
    EXPECT_GT(
        fuzz("a.gro", text, 1500, [&](const auto& path) { read_and_check(path, {.selection = selection}); }),
        least_accepted);
}

TEST(ReaderFuzz, Mmcif) {
  std::string text = test::read_bytes(test::data_file("proteins/6wqa.cif"));
  // Takes the atoms of a few residues, with the header of their loop.
  const std::size_t loop = text.find("loop_\n_atom_site.");
  ASSERT_NE(loop, std::string::npos);
  const std::size_t end = text.find('\n', loop + 4000);
  text = "data_X\n_cell.length_a 1\nloop_\n_entity.id\n_entity.type\n1 polymer\n" +
         text.substr(loop, end - loop + 1);
  EXPECT_GT(fuzz("a.cif", text, 1500, [](const auto& path) { read_and_check(path); }), least_accepted);
}

TEST(ReaderFuzz, Netcdf) {
  for (const int version : {1, 2, 5}) {
    test::NetcdfMaker maker = test::NetcdfMaker::chain(4, 3);
    maker.version = version;
    maker.cell = {30, 40, 50, 90, 90, 90};
    EXPECT_GT(fuzz("a.nc", maker.bytes(), 1000, [](const auto& path) { read_and_check(path); }),
              least_accepted);
  }
}

TEST(ReaderFuzz, Lammps) {
  const std::string frame =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS xy xz yz pp pp ff\n-5 15 2\n0 30 1\n0 "
      "40 1\n"
      "ITEM: ATOMS id xs ys zs ix iy iz element \n3 0.3 0.1 0 0 0 0 C \n1 0.1 0.1 0 0 1 0 N \n2 0.2 0 0 0 0 "
      "0 O \n";
  const std::string text = "ITEM: UNITS\nreal\nITEM: TIME\n0.5\n" + frame + "ITEM: TIME\n1.5\n" + frame;
  EXPECT_GT(fuzz("a.dump", text, 1500, [](const auto& path) { read_and_check(path); }), least_accepted);
}

TEST(ReaderFuzz, Xyz) {
  const std::string text =
      "3\nLattice=\"10 0 0 0 10 0 0 0 10\"\nC 0 0 0\nN 1.5 0 0\nO 3 0 0\n3\nnext\nC 0 1 0\nN 1.5 1 0\nO 3 1 "
      "0\n";
  EXPECT_GT(fuzz("a.xyz", text, 2000, [](const auto& path) { read_and_check(path); }), least_accepted);
}

TEST(ReaderFuzz, ExtendedXyz) {
  const std::string text =
      "2\nLattice=[[10,0,0],[3,10,0],[0,0,1D1]] pbc = \"T F T\" note='a \\' b' "
      "Properties=id:I:1:species:S:1:pos:R:3\n"
      "1 N 0 0 0\n2 CA 9.5 0 1d0\n2\nlattice=\"10 0 0 45 10 0 0 0 10\" tags={a b} "
      "Properties=id:I:1:species:S:1:pos:R:3\n"
      "1 N 0 1 0\n2 CA 1.5 1 0\n";
  EXPECT_GT(fuzz("a.extxyz", text, 3000, [](const auto& path) { read_and_check(path); }), least_accepted);
}

TEST(ReaderFuzz, Gzipped) {
  const auto packed = [](const std::string& bytes) {
    const auto path = test::temporary("packed.gz");
    const gzFile out = gzopen(path.c_str(), "wb");
    gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(out);
    return test::read_bytes(path);
  };
  test::DcdMaker maker = test::DcdMaker::chain(4, 3);
  maker.cell = true;
  maker.cell_values = {38.5, -7.7, 38.5, -7.7, -7.7, 38.5};
  fuzz("a.dcd.gz", packed(maker.bytes()), 1000, [](const auto& path) { read_and_check(path); });
  fuzz("a.xyz.gz", packed("2\n\nC 0 0 0\nN 1.5 0 0\n2\n\nC 0 1 0\nN 1.5 1 0\n"), 1000,
       [](const auto& path) { read_and_check(path); });
}

TEST(ReaderFuzz, Instance) {
  const std::string text = "3 2 2\n0.5 1 2 3 4 5\n-1 -2 -3 -4 -5 -6\n1e-3 1 0.25 7 8 9\n";
  EXPECT_GT(fuzz("a.txt", text, 2000,
                 [](const auto& path) {
                   (void)is_instance_file(path);
                   const Instance instance = read_instance(path);
                   ASSERT_EQ(instance.control_points.size(),
                             instance.point_count() * static_cast<std::size_t>(instance.columns) *
                                 static_cast<std::size_t>(instance.degree + 1));
                 }),
            least_accepted);
}

TEST(ReaderFuzz, Topology) {
  const auto dcd = test::temporary("b.dcd");
  test::write_file("b.dcd", test::DcdMaker::chain(6, 2).bytes());
  fuzz("t.pdb", test::pdb_residue(1) + test::pdb_residue(2), 1000,
       [&](const auto& path) { read_and_check(dcd, {.topology = path, .selection = Selection::all}); });
}

// libFuzzer starts from these files. A file that is refused leads it nowhere.
TEST(FuzzCorpus, EachFormatHasValidFiles) {
  const std::filesystem::path corpus = test::data_file("../tests/fuzz/corpus");
  for (const std::string& format : reader_registry().names()) {
    ASSERT_TRUE(std::filesystem::is_directory(corpus / format)) << format;
    int files = 0;
    for (const auto& file : std::filesystem::directory_iterator(corpus / format)) {
      SCOPED_TRACE(file.path());
      ++files;
      EXPECT_LE(file.file_size(), 4096U) << "libFuzzer makes longer inputs only if a seed is longer";
      const ReaderSpec* const reader = reader_registry().find(file.path());
      ASSERT_NE(reader, nullptr);
      EXPECT_EQ(reader->name, format);
      for (const std::string& other : reader_registry().names()) {
        const auto& recognises = reader_registry().find(file.path(), other)->recognises;
        EXPECT_FALSE(other != format && recognises && recognises(test::read_bytes(file.path())))
            << other << " recognises it too";
      }
      if (reader->open) read_and_check(file.path(), {.selection = Selection::all});
      if (reader->topology) {
        const Topology topology = reader->topology(file.path(), {.selection = Selection::all});
        EXPECT_FALSE(topology.selected.empty());
      }
    }
    EXPECT_GT(files, 0) << format;
  }
}

}  // namespace
}  // namespace kds::reader_fuzz_test
