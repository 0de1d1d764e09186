// Combines necklaces into one scene, and computes the radii of its beads.

#include "scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace oracle {
namespace {

std::vector<Points> bead_frames(const Input& input) {
  if (input.kind == FileKind::pdb) return read_pdb(input.path).models;
  if (input.kind == FileKind::xyz) return read_xyz(input.path);
  std::vector<Points> frames = read_dcd(input.path);
  if (!input.names || frames.empty()) return frames;
  const PdbBackbone names = read_pdb(*input.names);
  const std::size_t atoms = frames[0].size();
  if (atoms == names.first_model_atoms.size()) return frames;  // the file contains only the beads
  if (atoms != names.atom_count) {
    throw UsageError(input.path.string() + ": " + std::to_string(atoms) + " atoms, but " +
                     input.names->string() + " has " + std::to_string(names.atom_count));
  }
  for (Points& frame : frames) {
    Points beads;
    for (const std::size_t atom : names.first_model_atoms) beads.push_back(frame[atom]);
    frame = std::move(beads);
  }
  return frames;
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

// Returns half of the longest bond. A distance above 1.5 times the median bond of the first frame is a chain
// break, not a bond.
double automatic_radius(const std::vector<std::vector<Points>>& necklaces) {
  double longest = 0;
  for (const std::vector<Points>& frames : necklaces) {
    const std::size_t bonds = frames[0].size() - 1;
    if (frames[0].size() < 2) continue;
    std::vector<double> lengths(bonds);
    for (std::size_t i = 0; i < bonds; ++i) lengths[i] = distance(frames[0][i], frames[0][i + 1]);
    const std::vector<double> first = lengths;
    std::sort(lengths.begin(), lengths.end());
    const double limit = 1.5 * (lengths[(bonds - 1) / 2] + lengths[bonds / 2]) / 2;
    for (const Points& frame : frames) {
      for (std::size_t i = 0; i < bonds; ++i) {
        if (first[i] <= limit) longest = std::max(longest, distance(frame[i], frame[i + 1]));
      }
    }
  }
  return longest / 2;
}

std::vector<double> radii_of_file(const std::string& path, std::size_t beads) {
  std::istringstream in(read_text(path));
  std::vector<double> radii;
  for (double radius = 0; in >> radius;) radii.push_back(radius);
  if (radii.size() == 1) radii.assign(beads, radii[0]);
  if (radii.size() != beads) throw UsageError(path + ": one radius a bead, or one for all, expected");
  return radii;
}

// Fewer than four beads always lie in some plane.
void find_plane(Scene& scene) {
  if (scene.bead_count() < 4) return;
  for (const auto& axes : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}) {
    const double height = scene.frames[0][0].centre[axes[2]];
    const bool flat = std::all_of(scene.frames.begin(), scene.frames.end(), [&](const Frame& frame) {
      return std::all_of(frame.begin(), frame.end(),
                         [&](const Ball& ball) { return ball.centre[axes[2]] == height; });
    });
    if (!flat) continue;
    scene.dimension = 2;
    scene.axes = axes;
    return;
  }
}

}  // namespace

Frame Scene::in_plane(std::size_t frame) const {
  Frame turned = frames[frame];
  for (std::size_t i = 0; i < turned.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) turned[i].centre[c] = frames[frame][i].centre[axes[c]];
  return turned;
}

Scene read_scene(const SceneOptions& options) {
  if (options.inputs.empty()) throw UsageError("an input is needed: --dcd, --pdb, --xyz or --instance");
  Scene scene;
  if (options.inputs[0].kind == FileKind::instance) {
    if (options.inputs.size() > 1) throw UsageError("an instance file is a scene by itself");
    scene.frames = read_instance(options.inputs[0].path, scene.dimension);
    scene.ends = {scene.frames[0].size()};
    return scene;
  }
  std::vector<std::vector<Points>> necklaces;
  std::size_t frame_count = 1;
  for (const Input& input : options.inputs) {
    if (input.kind == FileKind::instance) throw UsageError("an instance file is a scene by itself");
    const std::vector<Points> all = bead_frames(input);
    std::vector<Points> wanted;
    const std::size_t last = options.last.value_or(all.size());
    if (all.size() == 1) {
      wanted = all;  // at rest
    } else {
      if (last > all.size())
        throw UsageError(input.path.string() + ": has fewer frames than --frames asks for");
      for (std::size_t k = options.first; k < last; k += options.stride) wanted.push_back(all[k]);
    }
    if (wanted.empty() || wanted[0].empty())
      throw UsageError(input.path.string() + ": no frames or no beads");
    if (wanted.size() > 1 && frame_count > 1 && wanted.size() != frame_count) {
      throw UsageError(input.path.string() + ": has another frame count than the necklaces before it");
    }
    frame_count = std::max(frame_count, wanted.size());
    scene.ends.push_back(scene.bead_count() + wanted[0].size());
    necklaces.push_back(std::move(wanted));
  }

  std::vector<double> radii;
  bool equal = true;
  if (options.radius.starts_with("file:")) {
    radii = radii_of_file(options.radius.substr(5), scene.bead_count());
    equal = std::adjacent_find(radii.begin(), radii.end(), std::not_equal_to<>()) == radii.end();
  } else {
    const double one = options.radius == "auto" ? automatic_radius(necklaces) : std::stod(options.radius);
    radii.assign(scene.bead_count(), one);
  }
  scene.frames.resize(frame_count);
  for (std::size_t k = 0; k < frame_count; ++k) {
    for (const std::vector<Points>& frames : necklaces) {
      for (const auto& point : frames[std::min(k, frames.size() - 1)]) {
        const double radius = radii[scene.frames[k].size()];
        scene.frames[k].push_back({point, radius, equal ? 0.0 : radius * radius});
      }
    }
  }
  find_plane(scene);
  return scene;
}

}  // namespace oracle
