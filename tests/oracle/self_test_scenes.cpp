// Files of every format with features of real files: unit cells, waters, alternate locations, several models.

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <utility>

#include "check_power.h"
#include "self_test.h"

namespace oracle {
namespace {

namespace fs = std::filesystem;

void put_word(std::string& bytes, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((word >> (8 * i)) & 0xff));
}

void write_dcd(const fs::path& path, const std::vector<Points>& frames, bool cell) {
  std::string bytes;
  put_word(bytes, 84);
  bytes += "CORD";
  for (std::uint32_t i = 0; i < 20; ++i) {
    // The header claims more frames than the file has, as some real files do.
    put_word(bytes, i == 0 ? 500 : i == 10 ? static_cast<std::uint32_t>(cell) : i == 19 ? 24 : 0);
  }
  put_word(bytes, 84);
  put_word(bytes, 84);
  put_word(bytes, 1);
  bytes += std::string(80, ' ');
  put_word(bytes, 84);
  put_word(bytes, 4);
  put_word(bytes, static_cast<std::uint32_t>(frames[0].size()));
  put_word(bytes, 4);
  for (const Points& frame : frames) {
    if (cell) {
      put_word(bytes, 48);
      bytes += std::string(48, '\0');
      put_word(bytes, 48);
    }
    const auto size = static_cast<std::uint32_t>(4 * frame.size());
    for (std::size_t c = 0; c < 3; ++c) {
      put_word(bytes, size);
      for (const auto& point : frame)
        put_word(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(point[c])));
      put_word(bytes, size);
    }
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

struct Atom {
  const char* record;
  const char* name;
  char alternate, chain;
  int residue;
  std::array<double, 3> at;
};

void write_pdb(const fs::path& path, const std::vector<std::vector<Atom>>& models) {
  std::ofstream out(path);
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (models.size() > 1) out << "MODEL     " << m + 1 << "\n";
    int serial = 0;
    bool ended = false;
    for (const Atom& a : models[m]) {
      if (a.chain != 'A' && !ended) out << "TER\n";
      ended = ended || a.chain != 'A';
      std::array<char, 100> line{};
      std::snprintf(line.data(), line.size(), "%-6s%5d %-4s%cGLY %c%4d    %8.3f%8.3f%8.3f  1.00  0.00\n",
                    a.record, ++serial, a.name, a.alternate, a.chain, a.residue, a.at[0], a.at[1], a.at[2]);
      out << line.data();
    }
    if (models.size() > 1) out << "ENDMDL\n";
  }
  out << "END\n";
}

// Makes a random walk with steps of about 1.5, in multiples of 1/1000 if `decimal`, else of 1/1024.
Points random_chain(Dice& dice, std::size_t beads, bool decimal) {
  Points points;
  const double grain = decimal ? 1000.0 : 1024.0;
  std::array<double, 3> cursor{};
  std::array<int, 3> at{};
  for (std::size_t i = 0; i < beads; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      at[c] += static_cast<int>(dice.below(2400)) - 1200;
      cursor[c] = at[c] / grain;
    }
    points.push_back(cursor);
  }
  return points;
}

std::vector<Points> random_motion(Dice& dice, std::size_t beads, std::size_t frames, bool decimal) {
  std::vector<Points> motion{random_chain(dice, beads, decimal)};
  while (motion.size() < frames) {
    Points next = motion.back();
    const double grain = decimal ? 1000.0 : 1024.0;
    for (auto& point : next) {
      for (double& x : point)
        x = (std::round(x * grain) + static_cast<double>(dice.below(600)) - 300) / grain;
    }
    motion.push_back(next);
  }
  return motion;
}

Points points_of(const Frame& frame) {
  Points points;
  for (const Ball& ball : frame) points.push_back(ball.centre);
  return points;
}

Scene scene_of(Input input) {
  SceneOptions options;
  options.inputs = {std::move(input)};
  return read_scene(options);
}

// Makes backbone beads among hydrogens, alternate locations, a HETATM residue, an incomplete residue, waters
// and a chain B.
std::vector<Atom> protein_atoms(const Points& beads) {
  std::vector<Atom> atoms;
  const std::array<const char*, 3> names{" N  ", " CA ", " C  "};
  int residue = 0;
  for (std::size_t i = 0; i + 2 < beads.size(); i += 3) {
    ++residue;
    const char* record = residue == 3 ? "HETATM" : "ATOM";
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& at = beads[i + k];
      atoms.push_back({record, names[k], residue == 2 ? 'A' : ' ', 'A', residue, at});
      if (residue == 2) atoms.push_back({record, names[k], 'B', 'A', residue, {at[0] + 0.5, at[1], at[2]}});
    }
    atoms.push_back({record, " H  ", ' ', 'A', residue, {9, 9, 9}});
    if (residue == 4) atoms.push_back({record, " CA ", ' ', 'A', 900, {8, 8, 8}});
  }
  for (const char* name : names) atoms.push_back({"ATOM", name, ' ', 'B', 1, {7, 7, 7}});
  for (const char* name : names) atoms.push_back({"HETATM", name, ' ', 'A', 901, {6, 6, 6}});
  return atoms;
}

void write_instance(const fs::path& path, const std::vector<std::vector<double>>& rows, int width,
                    int degree) {
  std::ofstream out(path);
  out.precision(17);
  out << rows.size() << ' ' << width << ' ' << degree << '\n';
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out << (i ? " " : "") << row[i];
    out << '\n';
  }
}

// Points 0 to 19 and 20 to 39 start at the same positions.
Scene twin_scene(const fs::path& path, Dice& dice) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < 40; ++i) {
    std::vector<double> row;
    for (std::size_t c = 0; c < 3; ++c) {
      const double start = i < 20 ? dice.unit() : rows[i - 20][2 * c];
      row.push_back(start);
      row.push_back(dice.unit());
    }
    rows.push_back(row);
  }
  write_instance(path, rows, 3, 1);
  return scene_of({FileKind::instance, path, {}});
}

Scene instance_scene(const fs::path& path, Dice& dice, int width, int degree, bool grid) {
  std::vector<std::vector<double>> rows;
  const int side = width == 2 ? 8 : 4;
  for (int i = 0; i < (grid ? 64 : 28); ++i) {
    std::vector<double> row;
    const std::array<int, 3> place{i / side % side, i % side, i / side / side};
    for (int c = 0; c < width; ++c) {
      for (int k = 0; k <= degree; ++k) {
        // Weights are large enough to hide some beads.
        const double x = c == 3 ? dice.unit() / 3 : dice.unit();
        row.push_back(grid && k == 0 ? place[static_cast<std::size_t>(c)] : x);
      }
    }
    rows.push_back(row);
  }
  write_instance(path, rows, width, degree);
  return scene_of({FileKind::instance, path, {}});
}

}  // namespace

std::vector<NamedScene> made_scenes(const fs::path& dir, std::vector<std::string>& failures) {
  std::vector<NamedScene> scenes;
  Dice dice(1);
  const auto expect = [&](bool right, const std::string& what) {
    if (!right) failures.push_back(what);
  };

  const auto plain = random_motion(dice, 60, 3, false);
  write_dcd(dir / "plain.dcd", plain, false);
  scenes.push_back({"dcd", scene_of({FileKind::dcd, dir / "plain.dcd", {}})});
  expect(scenes.back().scene.frames.size() == 3, "dcd: frame count");
  for (std::size_t k = 0; k < 3; ++k) {
    expect(points_of(scenes.back().scene.frames[k]) == plain[k], "dcd: coordinates");
  }

  // Beads among other atoms, in a file with unit cells.
  const auto decimal = random_motion(dice, 30, 3, true);
  std::vector<std::vector<Atom>> models;
  std::vector<Points> all_atoms;
  for (const Points& frame : decimal) {
    models.push_back(protein_atoms(frame));
    all_atoms.emplace_back();
    for (const Atom& atom : models.back()) all_atoms.back().push_back(atom.at);
  }
  write_pdb(dir / "models.pdb", models);
  write_dcd(dir / "atoms.dcd", all_atoms, true);
  scenes.push_back({"pdb", scene_of({FileKind::pdb, dir / "models.pdb", {}})});
  scenes.push_back({"dcd with names", scene_of({FileKind::dcd, dir / "atoms.dcd", dir / "models.pdb"})});
  for (std::size_t k = 0; k < 3; ++k) {
    expect(points_of(scenes[1].scene.frames[k]) == decimal[k], "pdb: coordinates");
    for (std::size_t i = 0; i < decimal[k].size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto single = static_cast<double>(static_cast<float>(decimal[k][i][c]));
        expect(scenes[2].scene.frames[k][i].centre[c] == single, "dcd with names: coordinates");
      }
    }
  }

  // Two necklaces, one at rest, and a given radius.
  SceneOptions two;
  write_dcd(dir / "rest.dcd", {random_chain(dice, 17, false)}, false);
  two.inputs = {{FileKind::dcd, dir / "plain.dcd", {}}, {FileKind::dcd, dir / "rest.dcd", {}}};
  two.first = 1;
  two.radius = "0.75";
  scenes.push_back({"two necklaces", read_scene(two)});
  expect(scenes.back().scene.ends == std::vector<std::size_t>{60, 77}, "two necklaces: ends");
  expect(scenes.back().scene.frames.size() == 2, "two necklaces: frames");
  expect(scenes.back().scene.frames[1][76].radius == 0.75, "two necklaces: radius");

  // Bonds of 1, of 2 (in the second frame), and a break of 5: the radius is 1.
  write_dcd(dir / "bonds.dcd",
            {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {7, 0, 0}}, {{0, 0, 0}, {2, 0, 0}, {3, 0, 0}, {9, 0, 0}}},
            false);
  expect(scene_of({FileKind::dcd, dir / "bonds.dcd", {}}).frames[0][0].radius == 1, "automatic radius");

  scenes.push_back({"instance", instance_scene(dir / "d3.txt", dice, 3, 2, false)});
  scenes.push_back({"weighted instance", instance_scene(dir / "w3.txt", dice, 4, 1, false)});
  scenes.push_back({"twins", twin_scene(dir / "twins.txt", dice)});
  scenes.push_back({"grid", instance_scene(dir / "grid.txt", dice, 3, 1, true), false});
  scenes.push_back({"planar instance", instance_scene(dir / "d2.txt", dice, 2, 2, false)});
  scenes.push_back({"planar grid", instance_scene(dir / "grid2.txt", dice, 2, 1, true), false});
  expect(scenes.back().scene.dimension == 2, "planar grid: dimension");

  // Beads of two sizes in the plane y = 7, some of them hidden.
  SceneOptions flat;
  std::ofstream xyz(dir / "flat.xyz"), radii(dir / "radii.txt");
  for (int k = 0; k < 2; ++k) {
    xyz << "40\na comment\n";
    for (int i = 0; i < 40; ++i) xyz << "C " << dice.unit() << " 7 " << dice.unit() << '\n';
  }
  for (int i = 0; i < 40; ++i) radii << (i % 5 == 0 ? "0.3\n" : "0.05\n");
  xyz.close();
  radii.close();
  flat.inputs = {{FileKind::xyz, dir / "flat.xyz", {}}};
  flat.radius = "file:" + (dir / "radii.txt").string();
  scenes.push_back({"beads in a plane", read_scene(flat)});
  expect(scenes.back().scene.dimension == 2 && scenes.back().scene.frames[1][39].centre[1] == 7 &&
             !static_power_diagram(scenes.back().scene.in_plane(0), 2).hidden.empty(),
         "beads in a plane: what was read");
  return scenes;
}

}  // namespace oracle
