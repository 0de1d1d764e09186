// Beads follow bonds across a periodic cell, not the bead that is selected before them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "motions/readers/necklace_stream.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "tests/motions/test_files.h"

namespace kds::bond_paths_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Point = Eigen::Vector3d;

struct Atom {
  std::string name, residue;
  int number;
  char chain;
  Point position;  // in the first frame, whole
};

struct Box {
  double a, b, c, alpha, beta, gamma;

  Cell cell() const { return *read_cell_from_angles({a, b, c}, {alpha, beta, gamma}).cell; }
  Point wrapped(const Point& point) const {
    const Eigen::Vector3d place = cell().inverse() * point;
    return point - cell() * place.array().floor().matrix();
  }
};

const std::vector<Box>& boxes() {
  static const std::vector<Box> all{{30, 30, 30, 90, 90, 90},
                                    {26, 33, 41, 90, 90, 90},
                                    {32, 32, 32, 60, 60, 90},
                                    {35, 31, 38, 70, 105, 80}};
  return all;
}

// Returns a random walk of residues whose CA are 3.8 apart. Each residue has N, CA, C and CB, and every
// `every`-th from `first` on is a MET.
std::vector<Atom> chain(std::size_t residues, std::size_t first, std::size_t every, char name = 'A') {
  std::mt19937 random(7);
  std::normal_distribution<double> step(0, 1);
  std::vector<Atom> atoms;
  Point calpha(3, 4, 5);
  for (std::size_t r = 0; r < residues; ++r) {
    const std::string residue = r >= first && (r - first) % every == 0 ? "MET" : "ALA";
    const double z = step(random), y = step(random), x = step(random);  // in the same order for all compilers
    const Point along = Point(x + 0.8, y, z).normalized();
    const int number = static_cast<int>(r) + 1;
    atoms.push_back({"N", residue, number, name, calpha - 1.4 * along});
    atoms.push_back({"CA", residue, number, name, calpha});
    atoms.push_back({"C", residue, number, name, calpha + 1.5 * along});
    atoms.push_back({"CB", residue, number, name, calpha + Point(0, 0, 1.5)});
    calpha += 3.8 * along;
  }
  return atoms;
}

std::string pdb(const std::vector<Atom>& atoms) {
  std::string text;
  for (const Atom& atom : atoms)
    text += test::pdb_line({.name = atom.name,
                            .residue = atom.residue,
                            .chain = atom.chain,
                            .number = atom.number,
                            .element = atom.name.substr(0, 1)});
  return text;
}

const Point drift(3.1, -2.3, 4.7);  // from one frame to the next

std::filesystem::path dcd(const std::vector<Atom>& atoms, const Box& box, bool wrapped = true,
                          std::size_t frames = 12) {
  test::DcdMaker maker;
  maker.cell = true;
  maker.cell_values = {box.a, box.gamma, box.b, box.beta, box.alpha, box.c};
  for (std::size_t k = 0; k < frames; ++k) {
    maker.frames.emplace_back();
    for (const Atom& atom : atoms) {
      const Point moved = atom.position + static_cast<double>(k) * drift;
      const Point point = wrapped ? box.wrapped(moved) : moved;
      maker.frames.back().push_back(
          {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])});
    }
  }
  return test::write_file("a.dcd", maker.bytes());
}

std::vector<Trajectory> read(const std::vector<Atom>& atoms, const std::filesystem::path& frames,
                             std::string_view selection) {
  return read_trajectories(
      frames, {.topology = test::write_file("a.pdb", pdb(atoms)), .selection = *Selection::parse(selection)});
}

// Returns the columns of `all` that have the names of the beads of `some`.
std::vector<Eigen::Index> columns(const Trajectory& all, const Trajectory& some) {
  std::vector<Eigen::Index> found;
  for (const std::string& name : some.bead_names)
    found.push_back(std::find(all.bead_names.begin(), all.bead_names.end(), name) - all.bead_names.begin());
  return found;
}

TEST(BondPaths, ResiduesLeftOutAreFollowed) {
  for (const Box& box : boxes()) {
    const std::vector<Atom> atoms = chain(61, 0, 12);
    const auto frames = dcd(atoms, box);
    const Trajectory all = read(atoms, frames, "ca")[0];
    const Trajectory some = read(atoms, frames, "//A/(MET)/CA")[0];
    ASSERT_EQ(some.bead_count(), 6U);
    bool beyond_half = false;  // beads are farther apart than half of the cell
    for (std::size_t k = 0; k < all.frames.size(); ++k) {
      EXPECT_EQ(some.frames[k], all.frames[k](Eigen::all, columns(all, some))) << box.gamma << " frame " << k;
      for (Eigen::Index i = 0; i + 1 < some.frames[k].cols(); ++i)
        beyond_half |= (some.frames[k].col(i + 1) - some.frames[k].col(i)).norm() > 20;
    }
    EXPECT_TRUE(beyond_half);
    EXPECT_THAT(some.breaks, IsEmpty());
    EXPECT_THAT(some.gaps, ElementsAre(0, 1, 2, 3, 4));
    EXPECT_THAT(some.warnings, ElementsAre(HasSubstr("made whole across the periodic cell")));
  }
}

// The chain may lie in another image if its ends are not selected.
TEST(BondPaths, EndsLeftOutShiftTheChainByCellVectors) {
  for (const Box& box : boxes())
    for (const char* selection : {"//A/(MET)/CA", "//A/(MET)/N,CA,C", "//A/7-51/CA", "(!ALA)/CA"}) {
      const std::vector<Atom> atoms = chain(61, 5, 11);
      const auto frames = dcd(atoms, box);
      const Trajectory all = read(atoms, frames, "backbone")[0], some = read(atoms, frames, selection)[0];
      for (std::size_t k = 0; k < all.frames.size(); ++k) {
        const Eigen::Matrix3Xd apart = some.frames[k] - all.frames[k](Eigen::all, columns(all, some));
        const Point place = box.cell().inverse() * apart.col(0);
        EXPECT_LT((place - place.array().round().matrix()).norm(), 1e-6);
        EXPECT_LT((apart.colwise() - apart.col(0)).cwiseAbs().maxCoeff(), 1e-9) << selection << " " << k;
      }
    }
}

// The cell is longer than the chain, but the selected beads are farther apart than half of the cell.
TEST(BondPaths, WholeChainsKeepTheirBits) {
  for (Box box : boxes()) {
    for (double* const length : {&box.a, &box.b, &box.c}) *length *= 2.8;
    const std::vector<Atom> atoms = chain(41, 3, 30);
    const auto frames = dcd(atoms, box, false, 3);
    const Trajectory all = read(atoms, frames, "all")[0];
    for (const char* selection : {"//A/(MET)/CA", "//A/(MET)", "//A//CB"}) {
      const Trajectory some = read(atoms, frames, selection)[0];
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < some.bead_count(); ++i) {
          const Eigen::Index column = columns(all, some)[i];
          const Point expected =
              atoms[static_cast<std::size_t>(column)].position + static_cast<double>(k) * drift;
          EXPECT_EQ(some.frames[k].col(static_cast<Eigen::Index>(i)), all.frames[k].col(column)) << selection;
          EXPECT_EQ(all.frames[k].col(column).cast<float>(), expected.cast<float>());
        }
      EXPECT_THAT(some.warnings, IsEmpty());
    }
  }
}

// Files with models read guides from each model.
TEST(BondPaths, ModelsOfAPdbFile) {
  const Box box = boxes()[0];
  const std::vector<Atom> atoms = chain(61, 0, 12);
  std::string text;
  for (int k = 0; k < 4; ++k) {
    text += "CRYST1   30.000   30.000   30.000  90.00  90.00  90.00 P 1           1\nMODEL        1\n";
    for (const Atom& atom : atoms) {
      if (k == 3 && atom.number == 20 && atom.name == "CA") continue;
      const Point point = box.wrapped(atom.position + k * drift);
      text += test::pdb_line({.name = atom.name,
                              .residue = atom.residue,
                              .number = atom.number,
                              .x = point[0],
                              .y = point[1],
                              .z = point[2],
                              .element = atom.name.substr(0, 1)});
    }
    text += "ENDMDL\n";
  }
  const auto path = test::write_file("m.pdb", text);
  const FrameRange three{0, 3, 1};
  const Trajectory all = read_trajectory(path, {.selection = Selection::ca, .frames = three});
  const ReadOptions options{.selection = *Selection::parse("//A/(MET)/CA"), .frames = three};
  const Trajectory some = read_trajectory(path, options);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(some.frames[k], all.frames[k](Eigen::all, columns(all, some)));
  test::expect_refused([&] { static_cast<void>(read_trajectory(path, {.selection = options.selection})); },
                       {"m.pdb: frame 3:", "residues that --select leaves out are not those of frame 0"});
}

// A trajectory of the selected atoms alone has no guides.
TEST(BondPaths, TrajectoriesOfTheSelectedAtomsAlone) {
  const Box box{75, 75, 75, 90, 90, 90};
  const std::vector<Atom> atoms = chain(61, 0, 15);
  std::vector<Atom> selected;
  for (const Atom& atom : atoms)
    if (atom.residue == "MET" && atom.name == "CA") selected.push_back(atom);
  selected.back().position += Point(60, 0, 0);
  const Trajectory some = read(atoms, dcd(selected, box, false), "//A/(MET)/CA")[0];
  for (std::size_t k = 0; k < some.frames.size(); ++k)
    for (std::size_t i = 0; i < selected.size(); ++i)
      EXPECT_EQ(some.frames[k].col(static_cast<Eigen::Index>(i)).cast<float>(),
                (selected[i].position + static_cast<double>(k) * drift).cast<float>());
  EXPECT_THAT(some.warnings, ElementsAre(HasSubstr("4 molecules are not bonded to the beads before")));
}

// Waters of three atoms, spread over the cell, in a chain that begins with a protein.
std::vector<Atom> with_waters() {
  std::vector<Atom> atoms = chain(8, 3, 8);
  for (int w = 0; w < 20; ++w) {
    const Point place(17.0 * w, 11.0 * w, 5.0 * w);
    const Point inside = boxes()[0].wrapped(place);
    atoms.push_back({"O", "HOH", 100 + w, 'A', inside});
    atoms.push_back({"H1", "HOH", 100 + w, 'A', inside + Point(0.9, 0, 0)});
    atoms.push_back({"H2", "HOH", 100 + w, 'A', inside + Point(0, 0.9, 0)});
  }
  return atoms;
}

TEST(BondPaths, WatersStayWhereTheFileHasThemAndMoveContinuously) {
  const std::vector<Atom> atoms = with_waters();
  const auto frames = dcd(atoms, boxes()[0]);
  for (const char* selection : {"(HOH)/O", "(HOH)", "//A", "//A//CA,O"}) {
    const Trajectory read_here = read(atoms, frames, selection)[0];
    for (std::size_t k = 0; k < read_here.frames.size(); ++k)
      for (std::size_t i = 0; i < read_here.bead_count(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const Point moved = read_here.frames[k].col(column) - read_here.frames[0].col(column);
        EXPECT_LT((moved - static_cast<double>(k) * drift).norm(), 1e-4) << selection << " " << i << " " << k;
      }
    for (std::size_t i = 0; i < read_here.bead_count(); ++i)
      if (read_here.bead_names[i].starts_with("O of HOH")) {
        const Point first = read_here.frames[0].col(static_cast<Eigen::Index>(i));
        EXPECT_LT((boxes()[0].wrapped(first) - first).norm(), 1e-3) << selection << " " << i;
        if (i + 1 < read_here.bead_count() && read_here.bead_names[i + 1].starts_with("H1")) {
          EXPECT_LT((read_here.frames[0].col(static_cast<Eigen::Index>(i) + 1) - first).norm(), 1);
        }
      }
    EXPECT_THAT(read_here.breaks, IsEmpty()) << selection;
    EXPECT_THAT(read_here.warnings, Contains(HasSubstr("20 molecules are not bonded to the beads before")));
  }
  EXPECT_EQ(read(atoms, frames, "(HOH)/O")[0].gaps.size(), 19U);
  EXPECT_THAT(read(atoms, frames, "ca")[0].gaps, IsEmpty());
}

TEST(BondPaths, GapsAreNoBondsForTheRadius) {
  const std::vector<Atom> atoms = with_waters();
  const auto frames = dcd(atoms, boxes()[0]);
  const auto radius = [&](std::string_view selection) {
    return bead_radii("auto", read(atoms, frames, selection)).front();
  };
  EXPECT_NEAR(radius("//A//CA,O"), 1.9, 1e-3);
  EXPECT_NEAR(radius("(HOH)"), 0.9 / std::sqrt(2.0), 1e-3);  // from H1 to H2
  test::expect_refused([&] { radius("(HOH)/O"); }, {"--radius: auto", "no two consecutive beads are bonded"});
}

// A cap belongs to its chain, also if the file ends no chain with TER.
TEST(BondPaths, CapsFollowTheirChain) {
  std::vector<Atom> atoms = chain(10, 3, 20);
  const Point first = atoms.front().position, last = atoms[atoms.size() - 2].position;
  atoms.insert(atoms.begin(), {"CH3", "ACE", 0, 'A', first - Point(1.5, 0, 0)});
  atoms.push_back({"N", "NME", 11, 'A', last + Point(1.5, 0, 0)});
  const auto frames = dcd(atoms, boxes()[1]);
  const Trajectory whole = read(atoms, frames, "//A")[0];
  EXPECT_THAT(whole.gaps, IsEmpty());
  for (const Eigen::Matrix3Xd& frame : whole.frames)
    for (std::size_t i = 0; i < atoms.size(); ++i)
      EXPECT_LT(
          (frame.col(static_cast<Eigen::Index>(i)) - frame.col(0) - (atoms[i].position - atoms[0].position))
              .norm(),
          1e-4);
}

// Two molecules of one chain are placed beside each other, as two chains are.
TEST(BondPaths, MoleculesOfOneChain) {
  std::vector<Atom> atoms = chain(6, 3, 20);
  const std::size_t size = atoms.size();
  for (std::size_t i = 0; i < size; ++i) {
    Atom atom = atoms[i];
    atom.number += 50;
    atom.position += Point(0, 6, 0) + Point(30, 0, -30);
    atoms.push_back(atom);
  }
  std::string names = pdb(atoms);
  const std::size_t line = names.size() / atoms.size();
  names.insert(line * size, "TER\n");
  const Trajectory both = read_trajectories(
      dcd(atoms, boxes()[0], false),
      {.topology = test::write_file("a.pdb", names), .selection = Selection::ca, .chain = "A"})[0];
  EXPECT_THAT(both.gaps, ElementsAre(5));
  EXPECT_THAT(both.breaks, IsEmpty());
  for (const Eigen::Matrix3Xd& frame : both.frames)
    EXPECT_LT((frame.col(6) - frame.col(0) - Point(0, 6, 0)).norm(), 1e-4);
  EXPECT_THAT(both.warnings, Contains(HasSubstr("molecule of 6 beads: moved to its periodic image nearest")));
}

}  // namespace
}  // namespace kds::bond_paths_test
