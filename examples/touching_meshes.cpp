// Prints, for each step, the first time at which a vertex, an edge or a face of one moving mesh begins to
// meet one of the other, exactly on straight paths between frames. Surfaces that already intersect count too.
//
//   touching_meshes CLOTH-0.obj CLOTH-1.obj ... -- BALL-0.obj ...
//
// Each file is a frame of a mesh: lines `v x y z` and triangles `f a b c`, with vertices numbered from 1. The
// frames of a mesh have the same faces. A mesh of one frame is at rest.
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "motions/scene/near_pairs.h"
#include "structures/impacts/impact_search.h"

namespace {

using Corners = std::vector<int>;  // the vertices of a feature: one, two (an edge) or three (a face)

struct Mesh {
  std::vector<std::vector<Eigen::Vector3d>> frames;
  std::vector<Corners> features;  // all vertices, edges and faces
};

[[noreturn]] void refuse(const std::string& why) {
  std::fprintf(stderr, "touching_meshes: %s\n", why.c_str());
  std::exit(2);
}

/// Appends a frame; the first one sets the features.
void add_frame(Mesh& mesh, const std::string& path) {
  std::ifstream file(path);
  if (!file) refuse(path + ": cannot be read");
  std::vector<Eigen::Vector3d> vertices;
  std::set<Corners> features;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    double x = 0, y = 0, z = 0;
    Corners face;
    if (word == "v" && !(words >> x >> y >> z))
      refuse(path + ": expected three coordinates in '" + line + "'");
    if (word == "v") vertices.emplace_back(x, y, z);
    if (word != "f") continue;
    while (words >> word) {  // "7/2/3": vertex 7
      char* end = nullptr;
      face.push_back(int(std::strtol(word.c_str(), &end, 10)) - 1);
      if ((*end != '\0' && *end != '/') || face.back() < 0 || face.back() >= int(vertices.size()))
        refuse(path + ": expected vertices that come before, numbered from 1, in '" + line + "'");
    }
    if (std::set<int>(face.begin(), face.end()).size() != 3 || face.size() != 3)
      refuse(path + ": expected three vertices in '" + line + "'");
    features.insert(face);
    for (int k = 0; k < 3; ++k)
      features.insert({std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])});
  }
  if (vertices.empty() || features.empty()) refuse(path + ": expected a mesh of triangles");
  for (int v = 0; v < int(vertices.size()); ++v) features.insert({v});
  const std::vector<Corners> all(features.begin(), features.end());
  if (mesh.frames.empty()) mesh.features = all;
  if (mesh.features != all) refuse(path + ": has other vertices or faces than the first frame");
  mesh.frames.push_back(vertices);
}

/// The positions at both ends of a step.
std::vector<Eigen::Vector3d> ends_of(const Mesh& mesh, const Corners& feature, std::size_t step) {
  const std::size_t last = mesh.frames.size() - 1;
  std::vector<Eigen::Vector3d> points;
  for (const int corner : feature)
    for (const std::size_t frame : {std::min(step, last), std::min(step + 1, last)})
      points.push_back(mesh.frames[frame][std::size_t(corner)]);
  return points;
}

std::string name_of(const Corners& feature) {
  std::string name = feature.size() == 1 ? "vertex" : feature.size() == 2 ? "edge" : "face";
  for (const int corner : feature) name += " " + std::to_string(corner + 1);
  return name;
}

struct Touch {
  double time;
  const Corners *first, *second;
};

/// Returns the times in a step at which features of the two meshes begin to touch.
std::vector<Touch> touches_in(const Mesh& first, const Mesh& second, std::size_t step) {
  static kds::ImpactSearch vertex_face(kds::ImpactKind::vertex_face), edge_edge(kds::ImpactKind::edge_edge);
  // A ball around the path of each feature finds the features that are near.
  std::vector<std::pair<const Corners*, std::vector<Eigen::Vector3d>>> all;
  for (const Mesh* mesh : {&first, &second})
    for (const Corners& feature : mesh->features) all.emplace_back(&feature, ends_of(*mesh, feature, step));
  Eigen::Matrix3Xd centers(3, Eigen::Index(all.size()));
  std::vector<double> radii(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : all[i].second) box.extend(point);
    centers.col(Eigen::Index(i)) = box.center();
    radii[i] = 0.5 * box.diagonal().norm() * (1 + 1e-9) + 1e-12 * box.max().cwiseAbs().maxCoeff();
  }
  std::vector<Touch> touches;
  kds::visit_near_pairs(centers, radii, [&](kds::BeadId i, kds::BeadId j) {
    if ((i < first.features.size()) == (j < first.features.size())) return;  // of one mesh
    const std::size_t corners[] = {all[i].first->size(), all[j].first->size()};
    if (corners[0] + corners[1] != 4) return;
    const bool swaps = corners[0] == 3;  // the vertex comes first
    std::vector<double> points;
    for (const kds::BeadId k : {swaps ? j : i, swaps ? i : j})
      for (const Eigen::Vector3d& point : all[k].second)
        points.insert(points.end(), point.data(), point.data() + 3);
    for (const kds::Impact& impact : (corners[0] == 2 ? edge_edge : vertex_face).all_impacts(points))
      touches.push_back({0.5 * (impact.lower + impact.upper), all[i].first, all[j].first});
  });
  std::sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.time < b.time; });
  return touches;
}

}  // namespace

int main(int argc, char** argv) {
  Mesh meshes[2];
  std::size_t mesh = 0;
  for (int k = 1; k < argc; ++k) {
    const bool is_next = argv[k] == std::string("--");
    if (is_next && ++mesh > 1) refuse("expected one --, between the frames of two meshes");
    if (!is_next) add_frame(meshes[mesh], argv[k]);
  }
  const std::size_t frames[] = {meshes[0].frames.size(), meshes[1].frames.size()};
  const std::size_t most = std::max(frames[0], frames[1]);
  for (const std::size_t count : frames)
    if (most < 2 || (count != most && count != 1))
      refuse("expected FRAME... -- FRAME..., as many frames of both meshes, or one of a mesh at rest");
  bool any = false;
  for (std::size_t step = 0; step + 1 < most; ++step) {
    const std::vector<Touch> touches = touches_in(meshes[0], meshes[1], step);
    if (touches.empty()) continue;
    any = true;
    const Touch& earliest = touches.front();
    std::printf("%.9f: %s and %s (and %zu more in this step)\n", double(step) + earliest.time,
                name_of(*earliest.first).c_str(), name_of(*earliest.second).c_str(), touches.size() - 1);
  }
  if (!any) std::printf("no features begin to meet\n");
}
