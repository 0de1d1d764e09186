#include "self_test.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

#include "check_dump.h"
#include "check_power.h"
#include "corruptions.h"
#include "dump.h"
#include "exact_sphere.h"

namespace oracle {
namespace {

namespace fs = std::filesystem;

Scene first_frames(Scene scene, std::size_t count) {
  scene.frames.resize(std::min(scene.frames.size(), count));
  return scene;
}

class SelfTest {
 public:
  explicit SelfTest(fs::path dir) : dir_(std::move(dir)) {}

  void expect(bool right, const std::string& what) {
    if (!right) failures.push_back(what);
  }

  void run(const NamedScene& named) {
    const fs::path dump = dir_ / "dump";
    fs::remove_all(dump);
    write_static_dump(named.scene, dump);
    const Report right = check_dump(named.scene, dump, 1);
    for (const std::string& line : right.mismatches)
      failures.push_back(named.name + ", a right dump: " + line);
    expect(right.frames == named.scene.frames.size() && right.cells > 0 && right.nodes > 0,
           named.name + ": nothing was checked");

    space_ = named.scene.dimension;
    original_ = {read_cells(dump_file(dump, 0, "power"), named.scene.dimension),
                 read_hidden(dump_file(dump, 0, "hidden")), read_nodes(dump_file(dump, 0, "wrapped"))};
    if (named.scene.frames.size() < 2) return;
    const Scene one = first_frames(named.scene, 1), two = first_frames(named.scene, 2);
    // The two kinds of files are separate, so that the check of the same kind must notice a corruption.
    const fs::path power = dir_ / "power", wrapped = dir_ / "wrapped";
    const auto write_parts = [&](const Scene& scene) {
      for (const fs::path& part : {dump, power, wrapped}) {
        fs::remove_all(part);
        fs::create_directories(part);
      }
      write_static_dump(scene, dump);
      for (const fs::directory_entry& file : fs::directory_iterator(dump)) {
        const bool is_node_file = file.path().filename().string().ends_with(".wrapped.csv");
        fs::rename(file, (is_node_file ? wrapped : power) / file.path().filename());
      }
    };
    // Tables are corrupted in frame 0, so their dumps have no other frame. A corruption may take tables of
    // frame 1.
    write_parts(one);
    for (const Corruption& corruption : power_corruptions()) {
      // In a degenerate frame a flip may be correct.
      if (named.generic || std::string(corruption.name) != "a wrong flip")
        spoil(named, two, power, corruption);
    }
    for (const Corruption& corruption : wrapped_corruptions()) spoil(named, two, wrapped, corruption);
    beads_to_spare(named, one, wrapped);
    for (const fs::path& part : {power, wrapped}) {
      expect(check_dump(one, part, 0).mismatch_count == 0, named.name + ": the test spoiled its own dump");
    }
    if (!named.generic) other_triangulation(named, two, power);
    write_parts(two);
    for (const std::string kind : {"power", "hidden"}) spoil_files(named, two, power, kind);
    spoil_files(named, two, wrapped, "wrapped");
    for (const fs::path& part : {power, wrapped}) {
      expect(check_dump(two, part, 0).mismatch_count == 0, named.name + ": the test spoiled its own dump");
    }
  }

  void report_unused() {
    for (const auto& list : {power_corruptions(), wrapped_corruptions()}) {
      for (const Corruption& c : list) {
        expect(std::find(used_.begin(), used_.end(), c.name) != used_.end(),
               std::string("never tried: ") + c.name);
      }
    }
  }

  std::vector<std::string> failures;
  std::size_t caught = 0;

 private:
  void write(const Tables& tables, const fs::path& dump) const {
    if (fs::exists(dump_file(dump, 0, "power"))) {
      write_cells(dump_file(dump, 0, "power"), tables.cells, space_);
      write_hidden(dump_file(dump, 0, "hidden"), tables.hidden);
    } else {
      write_nodes(dump_file(dump, 0, "wrapped"), tables.nodes);
    }
  }

  void judge(const NamedScene& named, const Scene& scene, const fs::path& dump, const std::string& what) {
    // Without comparisons with CGAL: the proofs alone must notice the corruption.
    if (check_dump(scene, dump, 0).mismatch_count > 0) {
      ++caught;
    } else {
      failures.push_back(named.name + ": not noticed: " + what);
    }
  }

  // Corrupts the tables of frame 0, the only frame of the dump. The scene has the frames that a corruption
  // uses.
  void spoil(const NamedScene& named, const Scene& scene, const fs::path& dump,
             const Corruption& corruption) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      Dice dice(seed);
      Tables tables = original_;
      bool done = false;
      for (int attempt = 0; attempt < 20 && !done; ++attempt) done = corruption.spoil(scene, tables, dice);
      if (!done) break;
      used_.push_back(corruption.name);
      write(tables, dump);
      judge(named, first_frames(scene, 1), dump, corruption.name);
    }
    write(original_, dump);
  }

  void spoil_files(const NamedScene& named, const Scene& scene, const fs::path& dump,
                   const std::string& kind) {
    const fs::path file = dump_file(dump, 1, kind);
    const std::string text = read_text(file);
    const auto spoiled = [&](const std::string& other, const std::string& what) {
      std::ofstream(file, std::ios::binary) << other;
      judge(named, scene, dump, kind + ": " + what);
      std::ofstream(file, std::ios::binary) << text;
    };
    spoiled("", "an empty file");
    spoiled("x" + text, "another header");
    spoiled(text.substr(0, text.size() - 1), "a cut end");
    spoiled(text + "1,\n", "a line of another form");
    spoiled(text + "\n", "an empty line");
    fs::remove(file);
    judge(named, scene, dump, kind + ": a missing file");
    std::ofstream(file, std::ios::binary) << text;
    fs::copy_file(file, dump_file(dump, 2, kind));
    judge(named, scene, dump, kind + ": a frame too many");
    fs::remove(dump_file(dump, 2, kind));
  }

  // Superfluous beads must be accepted if they touch the sphere.
  void beads_to_spare(const NamedScene& named, const Scene& scene, const fs::path& dump) {
    Tables tables = original_;
    std::size_t found = 0;
    for (Node& node : tables.nodes) {
      const ExactSphere sphere = cgal_sphere(scene.frames[0], node.basis);
      for (unsigned bead = node.first; bead <= node.last && node.basis.size() < 4; ++bead) {
        if (std::find(node.basis.begin(), node.basis.end(), bead) != node.basis.end()) continue;
        if (!touches(sphere, scene.frames[0][bead])) continue;
        node.basis.push_back(bead);
        ++found;
      }
      std::sort(node.basis.begin(), node.basis.end());
    }
    expect(named.generic || found > 0, named.name + ": no node has a bead to spare");
    write(tables, dump);
    const Report report = check_dump(scene, dump, 1);
    for (const std::string& line : report.mismatches)
      failures.push_back(named.name + ", beads to spare: " + line);
    write(original_, dump);
  }

  // Another one of the grid's many triangulations must be accepted.
  void other_triangulation(const NamedScene& named, const Scene& scene, const fs::path& dump) {
    Frame mirrored = scene.in_plane(0);
    for (Ball& ball : mirrored) ball.centre[0] = -ball.centre[0];
    const PowerDiagram diagram = static_power_diagram(mirrored, scene.dimension, true);
    expect(diagram.cells != original_.cells, named.name + ": the mirror image has the same cells");
    Tables tables = original_;
    tables.cells = diagram.cells;
    write(tables, dump);
    const Report report = check_dump(first_frames(scene, 1), dump, 0);
    for (const std::string& line : report.mismatches) failures.push_back(named.name + ", mirrored: " + line);
    expect(report.degenerate == 1, named.name + ": the mirrored frame is degenerate");
    original_ = tables;  // corruptions of this triangulation must be rejected
    for (const Corruption& corruption : power_corruptions()) {
      if (std::string(corruption.name) != "a wrong flip") spoil(named, scene, dump, corruption);
    }
  }

  fs::path dir_;
  Tables original_;
  int space_ = 3;  ///< dimension of the present scene
  std::vector<std::string> used_;
};

void compare_root_numbers(SelfTest& test) {
  const auto expect = [&](RootNumber x, RootNumber y, CGAL::Sign sign) {
    test.expect(compare(x, y) == sign && compare(y, x) == -sign, "comparison of numbers with roots");
  };
  expect({1, 1, 4}, {3, 0, 7}, CGAL::ZERO);                // 1 + 2 = 3
  expect({0, 1, 8}, {0, 2, 2}, CGAL::ZERO);                // sqrt 8 = 2 sqrt 2
  expect({1, 1, 2}, {0, 1, 6}, CGAL::NEGATIVE);            // 2.414 < 2.449
  expect({5, -1, 2}, {2, 1, 3}, CGAL::NEGATIVE);           // 3.586 < 3.732
  expect({-1, -1, 2}, {-1, -1, 3}, CGAL::POSITIVE);        // -2.414 > -2.732
  expect({0, 665857, 1}, {0, 470832, 2}, CGAL::POSITIVE);  // a convergent of sqrt 2
  expect({1, -1, 1}, {0, 0, 5}, CGAL::ZERO);
}

}  // namespace

int self_test(const std::optional<Scene>& given) {
  const fs::path dir = fs::temp_directory_path() / ("kds-oracle-" + std::to_string(std::random_device{}()));
  fs::create_directories(dir);
  SelfTest test(dir);
  compare_root_numbers(test);
  std::vector<NamedScene> scenes;
  if (given) {
    scenes.push_back({"given", *given});
  } else {
    scenes = made_scenes(dir, test.failures);
  }
  for (const NamedScene& scene : scenes) test.run(scene);
  if (!given) test.report_unused();
  fs::remove_all(dir);
  for (const std::string& line : test.failures) std::printf("%s\n", line.c_str());
  std::printf("%zu scenes, %zu corruptions caught, %zu failures\n", scenes.size(), test.caught,
              test.failures.size());
  return test.failures.empty() ? 0 : 1;
}

}  // namespace oracle
