// Whatever a file contains, a reader returns valid frames or throws an InputError.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "motions/readers/instance.h"
#include "motions/readers/necklace_stream.h"
#include "motions/readers/reader_registry.h"
#include "motions/readers/topology.h"
#include "motions/scene/radii.h"
#include "tests/motions/reader_files.h"
#include "tests/support/inputs/gro_text.h"
#include "tests/support/inputs/gromacs_files.h"
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
    // A stream and read_trajectory() may differ in warnings of frames without times.
    std::vector<std::string> warnings = trajectory.warnings, of_stream = stream.warnings(0);
    for (auto* lines : {&warnings, &of_stream})
      std::erase_if(*lines, [](const auto& line) { return line.find("have no time") != line.npos; });
    EXPECT_EQ(of_stream, warnings);
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

/// A file that tests change and cut.
struct Seed {
  std::string test, file, bytes;
  std::size_t last_frame = 0;  ///< the size of the last frame, if it is known
  int rounds = 1500;
  ReadOptions options = {};
  std::size_t named_atoms = 0;  ///< above 0: the file is a topology, for a DCD file of so many atoms

  /// Reads this seed from other bytes, in all ways that must agree.
  void check(const std::string& changed) const {
    const auto path = test::write_file(file, changed);
    if (named_atoms == 0) return read_and_check(path, options);
    const auto dcd = test::write_file("b.dcd", test::DcdMaker::chain(named_atoms, 2).bytes());
    read_and_check(dcd, {.topology = path, .selection = Selection::all});
  }
};

void PrintTo(const Seed& seed, std::ostream* out) { *out << seed.test; }

void add_dcd(std::vector<Seed>& seeds) {
  test::DcdMaker maker = test::DcdMaker::chain(4, 3);
  seeds.push_back({"Dcd", "a.dcd", maker.bytes(), maker.frame(2).size()});
  maker.cell = true;
  maker.free_atoms = {2, 4};
  maker.big_endian = true;
  seeds.push_back({"DcdOfFreeAtoms", "a.dcd", maker.bytes(), maker.frame(2).size()});
  seeds.push_back({"SomeFramesOfDcd", "a.dcd", maker.bytes(), 0, 500, {.frames = {0, 2, 1}}});
  maker.marker_size = 8;
  seeds.push_back({"DcdOfLongMarkers", "a.dcd", maker.bytes(), maker.frame(2).size(), 500});
}

void add_netcdf(std::vector<Seed>& seeds) {
  for (const int version : {1, 2, 5}) {
    test::NetcdfMaker maker = test::NetcdfMaker::chain(4, 3);
    maker.version = version;
    maker.streamed = version == 2;
    maker.cell = {30, 40, 50, 90, 90, 90};
    if (version == 5) maker.scale = 1.5;
    if (version == 5) maker.velocity_units = "angstrom/picosecond";
    seeds.push_back({"Netcdf" + std::to_string(version),
                     "a.nc",
                     maker.bytes(),
                     maker.frame_bytes(),
                     1000,
                     {.velocities = true}});
  }
}

void add_gromacs(std::vector<Seed>& seeds) {
  const auto place = [](std::size_t k, std::size_t i) { return static_cast<int>(7 * i + 3 * (i % 3) + k); };
  for (const int magic : {1995, 2023})
    for (const std::size_t atoms : {4U, 14U}) {
      test::XtcMaker maker;
      maker.magic = magic;
      for (std::size_t k = 0; k < 3; ++k)
        for (auto& frame = maker.frames.emplace_back(); frame.size() < atoms;)
          frame.push_back({place(k, frame.size()), 5, -place(k, frame.size() % 5)});
      seeds.push_back({"Xtc" + std::to_string(magic) + "Of" + std::to_string(atoms), "a.xtc", maker.bytes(),
                       maker.frame_bytes(2).size(), 500});
    }
  for (const int real : {4, 8}) {
    test::TrrMaker maker;
    maker.real = real;
    maker.has_velocities = true;
    maker.frames.assign(3, {{0, 1, 2}, {0.15, 1, 2}, {0.3, 1, -2}});
    seeds.push_back({"Trr" + std::to_string(8 * real),
                     "a.trr",
                     maker.bytes(),
                     maker.frame_bytes(2).size(),
                     500,
                     {.velocities = true}});
  }
  test::GroText frame;
  frame.title = "t= 0.0";
  const std::string first = frame.residues(1, 2).residue(1, "SOL", {"OW"}).text();
  frame.title = "t= 1.0";
  seeds.push_back({"Gro", "a.gro", first + frame.text(), frame.text().size()});
  seeds.push_back({"GroAndWater",
                   "a.gro",
                   first + frame.text(),
                   frame.text().size(),
                   1500,
                   {.selection = *Selection::parse("/")}});
  frame.box = "3.0 4.0 5.0 0.0 0.0 0.5 0.0 0.0 0.0";
  seeds.push_back({"GroOfTiltedBox", "a.gro", frame.text() + frame.text(), frame.text().size(), 500});
}

void add_text(std::vector<Seed>& seeds) {
  const auto two = [&](const std::string& name, const std::string& file, const std::string& before,
                       const std::string& last, int rounds) {
    seeds.push_back({name, file, before + last, last.size(), rounds});
  };
  const std::string dump =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS xy xz yz pp pp ff\n-5 15 2\n0 30 1\n0 "
      "40 1\n"
      "ITEM: ATOMS id xs ys zs ix iy iz element \n3 0.3 0.1 0 0 0 0 C \n1 0.1 0.1 0 0 1 0 N \n2 0.2 0 0 0 0 "
      "0 O \n";
  two("Lammps", "a.dump", "ITEM: UNITS\nreal\nITEM: TIME\n0.5\n" + dump, "ITEM: TIME\n1.5\n" + dump, 1500);
  two("Xyz", "a.xyz", "3\nLattice=\"10 0 0 0 10 0 0 0 10\"\nC 0 0 0\nN 1.5 0 0\nO 3 0 0\n",
      "3\nnext\nC 0 1 0\nN 1.5 1 0\nO 3 1 0\n", 2000);
  two("ExtendedXyz", "a.extxyz",
      "2\nLattice=[[10,0,0],[3,10,0],[0,0,1D1]] pbc = \"T F T\" note='a \\' b' "
      "Properties=id:I:1:species:S:1:pos:R:3\n1 N 0 0 0\n2 CA 9.5 0 1d0\n",
      "2\nlattice=\"10 0 0 45 10 0 0 0 10\" tags={a b} Properties=id:I:1:species:S:1:pos:R:3\n"
      "1 N 0 1 0\n2 CA 1.5 1 0\n",
      3000);
  const std::string model = test::pdb_residue(1) + test::pdb_residue(2) + "TER\n" +
                            test::pdb_line({.name = "O", .residue = "HOH", .number = 3, .het = true});
  const std::string models =
      "CRYST1   20.000   20.000   20.000  90.00  90.00  90.00 P 1           1\n"
      "MODEL        1\n" +
      model + "ENDMDL\nMODEL        2\n" + model + "ENDMDL\nEND\n";
  seeds.push_back({"Pdb", "a.pdb", models});
  seeds.push_back({"AllOfPdb", "a.pdb", models, 0, 1500, {.selection = Selection::all}});
  seeds.push_back({"PdbTopology", "t.pdb", test::pdb_residue(1) + test::pdb_residue(2), 0, 1000, {}, 6});
  seeds.push_back({"PsfTopology",
                   "t.psf",
                   test::read_bytes(test::data_file("../tests/fuzz/corpus/psf/extended.psf")),
                   0,
                   500,
                   {},
                   8});
  seeds.push_back(
      {"Mmcif", "a.cif", test::read_bytes(test::data_file("../tests/fuzz/corpus/mmcif/chain.cif"))});
}

std::vector<Seed> seeds() {
  std::vector<Seed> all;
  for (const auto add : {add_dcd, add_netcdf, add_gromacs, add_text}) add(all);
  return all;
}

// Returns whether the bytes were read, and not refused in one line.
bool reads(const Seed& seed, const std::string& bytes) {
  try {
    return test::succeeds_or_refuses([&] { seed.check(bytes); });
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return false;
  }
}

// Returns how often the changed file was read.
int read_randomly_changed(const Seed& seed) {
  std::mt19937 random(20);
  int accepted = 0;
  for (int round = 0; round < test::rounds(seed.rounds) && !testing::Test::HasFailure(); ++round) {
    SCOPED_TRACE(round);
    accepted += reads(seed, mutated(seed.bytes, random)) ? 1 : 0;
  }
  return accepted;
}

class ReaderFuzz : public testing::TestWithParam<Seed> {};

INSTANTIATE_TEST_SUITE_P(Seeds, ReaderFuzz, testing::ValuesIn(seeds()),
                         [](const auto& seed) { return seed.param.test; });

TEST_P(ReaderFuzz, RandomChanges) {
  // Refusals alone would show little. A tenth of the rounds may have nothing else.
  EXPECT_GT(read_randomly_changed(GetParam()), test::rounds(100) == 100 ? 10 : -1);
}

TEST(PackedReaderFuzz, RandomChanges) {
  test::DcdMaker maker = test::DcdMaker::chain(4, 3);
  maker.cell = true;
  maker.cell_values = {38.5, -7.7, 38.5, -7.7, -7.7, 38.5};
  const std::string xyz = "2\n\nC 0 0 0\nN 1.5 0 0\n2\n\nC 0 1 0\nN 1.5 1 0\n";
  for (const auto& [name, bytes] : {std::pair("a.dcd.gz", maker.bytes()), {"a.xyz.gz", xyz}})
    read_randomly_changed({name, name, test::read_bytes(test::write_gzipped("packed.gz", bytes)), 0, 1000});
}

TEST_P(ReaderFuzz, EveryByteChanged) {
  const std::string& bytes = GetParam().bytes;
  for (std::size_t place = 0; place < bytes.size() && !HasFailure(); place += test::step_of_places)
    for (const char c : {'\0', '\n', ' ', '9', '\xFF', static_cast<char>(bytes[place] ^ 1)}) {
      SCOPED_TRACE(place);
      std::string changed = bytes;
      changed[place] = c;
      reads(GetParam(), changed);
    }
}

// A cut file is refused, or has frames of the whole file: all but the last one, if that one is cut.
TEST_P(ReaderFuzz, EveryCut) {
  const auto& [test, file, bytes, last_frame, rounds, options, named_atoms] = GetParam();
  if (last_frame == 0) {
    for (std::size_t size = 0; size < bytes.size(); size += test::step_of_places)
      reads(GetParam(), bytes.substr(0, size));
    return;
  }
  const Trajectory whole = read_trajectory(test::write_file(file, bytes), options);
  const std::size_t last = bytes.size() - last_frame, frames = whole.frames.size();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    SCOPED_TRACE(size);
    const auto path = test::write_file(file, bytes.substr(0, size));
    Trajectory cut;
    if (!test::succeeds_or_refuses([&] { cut = read_trajectory(path, options); })) {
      EXPECT_LT(size, last);
      continue;
    }
    for (std::size_t k = 0; k < cut.frames.size(); ++k) EXPECT_EQ(cut.frames[k], whole.frames[k]);
    if (size <= last) continue;
    const bool only_line_end_lost = size + 1 == bytes.size() && cut.frames.size() == frames;
    if (only_line_end_lost) continue;
    EXPECT_EQ(cut.frames.size(), frames - 1);
    EXPECT_TRUE(cut.truncated);
    EXPECT_THAT(cut.warnings, testing::Contains(testing::HasSubstr(
                                  fmt::format("ends inside frame {} (after {} bytes)", frames - 1, size))));
    ReadOptions some = options;
    some.frames = {0, frames - 1, 1};
    EXPECT_EQ(read_trajectory(path, some).frames.size(), frames - 1);
  }
}

TEST(InstanceFuzz, RandomChanges) {
  const std::string text = "3 2 2\n0.5 1 2 3 4 5\n-1 -2 -3 -4 -5 -6\n1e-3 1 0.25 7 8 9\n";
  std::mt19937 random(20);
  int accepted = 0;
  for (int round = 0; round < test::rounds(2000); ++round) {
    const auto path = test::write_file("a.txt", mutated(text, random));
    (void)is_instance_file(path);
    accepted += test::succeeds_or_refuses([&] {
      const Instance instance = read_instance(path);
      ASSERT_EQ(instance.control_points.size(), instance.point_count() *
                                                    static_cast<std::size_t>(instance.columns) *
                                                    static_cast<std::size_t>(instance.degree + 1));
    });
  }
  EXPECT_GT(accepted, test::rounds(10, 0));
}

// libFuzzer starts from these files. A file that is refused leads it nowhere.
TEST(FuzzCorpus, EachFormatHasValidFiles) {
  const std::filesystem::path corpus = test::data_file("../tests/fuzz/corpus");
  for (const std::string& format : reader_registry().names()) {
    ASSERT_TRUE(std::filesystem::is_directory(corpus / format)) << format;
    if (format == "imd") continue;  // not files: imd_protocol_test.cpp reads these bytes
    int files = 0, recognised = 0;
    for (const auto& file : std::filesystem::directory_iterator(corpus / format)) {
      SCOPED_TRACE(file.path());
      ++files;
      EXPECT_LE(file.file_size(), 4096U) << "libFuzzer makes longer inputs only if a seed is longer";
      const ReaderSpec* const reader = reader_registry().find(file.path());
      ASSERT_NE(reader, nullptr);
      EXPECT_EQ(reader->name, format);
      for (const std::string& other : reader_registry().names()) {
        const auto& recognises = reader_registry().find(file.path(), other)->recognises;
        const bool is_own = recognises && recognises(test::read_bytes(file.path()));
        if (other == format)
          recognised += is_own ? 1 : 0;  // some XYZ files are known by their ending alone
        else
          EXPECT_FALSE(is_own) << other << " recognises it too";
      }
      if (reader->open) read_and_check(file.path(), {.selection = Selection::all});
      if (reader->topology) {
        const Topology topology = reader->topology(file.path(), {.selection = Selection::all});
        EXPECT_FALSE(topology.selected.empty());
      }
    }
    EXPECT_GT(files, 0) << format;
    EXPECT_GT(recognised, 0) << format;
  }
}

TEST(FuzzCorpus, OtherBytesAreNotRecognised) {
  const std::string xtc = test::read_bytes(test::data_file("../tests/fuzz/corpus/xtc/long.xtc")),
                    trr = test::read_bytes(test::data_file("../tests/fuzz/corpus/trr/single.trr"));
  for (const std::string& bytes :
       {std::string(), std::string("CDF"), std::string("CDF\x04"), std::string("PSFX\n"),
        std::string("3\nITEM\n"), std::string("?\n5\nC 0.0 0.0 0.0\nC 1.0 0.0 0.0\n"), std::string(100, '\0'),
        xtc.substr(0, 55), xtc.substr(1), trr.substr(0, 20), trr.substr(4)})
    for (const std::string& format : reader_registry().names()) {
      const auto& recognises = reader_registry().find({}, format)->recognises;
      EXPECT_FALSE(recognises && recognises(bytes)) << format << ": " << bytes;
    }
}

}  // namespace
}  // namespace kds::reader_fuzz_test
