#include "experiments/collide/pairs_csv.h"

#include <fmt/format.h>

namespace kds {

namespace {

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

}  // namespace

PairsCsv::PairsCsv(std::ostream& stream, const CollideFrames& scene) : stream_(stream), scene_(scene) {
  stream_ << "frame,i,j,distance,name_i,name_j\n";
}

void PairsCsv::add(const FrameRead& frame, std::span<const BeadPair> pairs) {
  const auto center = [&](BeadId b) -> Eigen::Vector3d { return frame.positions.col(Eigen::Index{b}); };
  const std::vector<double>& radii = scene_.radii();
  for (const auto& [i, j] : pairs) {
    const double distance = (center(i) - center(j)).stableNorm() - (radii[i] + radii[j]);
    stream_ << fmt::format("{},{},{},{},{},{}\n", frame.stamp.number, i, j, distance,
                           quoted(scene_.bead_name(i)), quoted(scene_.bead_name(j)));
  }
}

}  // namespace kds
