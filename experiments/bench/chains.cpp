#include "experiments/bench/chains.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/program/input_options.h"
#include "motions/base/input_error.h"
#include "motions/models/elementary.h"
#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"

namespace kds::bench {

Scene BenchChain::scene() const {
  Trajectory necklace;
  necklace.file = name;
  necklace.frames = frames;
  return {{&necklace, 1}, radii, FrameMotion::linear};
}

std::vector<std::filesystem::path> trajectories() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(source_data_folder() / "trajectories"))
    if (entry.path().extension() == ".dcd") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

BenchChain read_bench_chain(const std::filesystem::path& path, std::size_t stride) {
  constexpr std::size_t most_frames = 100;
  ReadOptions options;
  const std::string stem = path.stem().string();
  const std::filesystem::path topology = path.parent_path() / (stem.substr(0, stem.find("_first")) + ".pdb");
  if (path.extension() == ".dcd" && std::filesystem::exists(topology)) options.topology = topology;
  Trajectory trajectory = read_trajectory(path, options);
  if (trajectory.frames.size() < 2) throw InputError(path.string() + ": expected two frames or more");
  BenchChain chain{stride == 1 ? stem : fmt::format("{} stride {}", stem, stride),
                   {},
                   bead_radii("auto", std::span(&trajectory, 1))};
  for (std::size_t k = 0; k < trajectory.frames.size() && chain.frames.size() < most_frames; k += stride)
    chain.frames.push_back(std::move(trajectory.frames[k]));
  return chain;
}

Eigen::Matrix3Xd model_at_rest(std::string_view name, std::size_t beads, double jitter, int dimension) {
  const models::Model* model = models::find_model(name);
  models::Settings settings{.beads = beads, .motion = models::ShapeMotion::rest};
  if (model->takes(models::Setting::jitter)) settings.jitter = jitter;
  if (model->takes(models::Setting::dimension)) settings.dimension = dimension;
  return models::generate(*model, settings).front().frames.front();
}

std::vector<Eigen::Matrix3Xd> rotating_frames(std::string_view name, std::size_t beads) {
  const models::Settings settings{.beads = beads, .frames = 2, .motion = models::ShapeMotion::rotate};
  return models::generate(*models::find_model(name), settings).front().frames;
}

std::vector<Eigen::Matrix3Xd> grid_with_one_moving(std::size_t beads) {
  const Eigen::Matrix3Xd start = model_at_rest("grid", beads, 0);
  std::vector<Eigen::Matrix3Xd> frames{start, start};
  frames[1].col(start.cols() / 2) += Eigen::Vector3d(0.37, 0.21, -0.3);
  return frames;
}

Eigen::Matrix3Xd planar_spiral(std::size_t beads) {
  return models::spiral(beads, std::sqrt(static_cast<double>(beads) / 10), 1);
}

std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                             std::size_t frames, int dimension) {
  models::Random random(1);
  std::vector<Eigen::Matrix3Xd> all{start};
  while (all.size() < frames) {
    all.push_back(all.back());
    for (Eigen::Index b = 0; b < start.cols(); ++b)
      all.back().col(b) += distance * random.direction(dimension);
  }
  return all;
}

}  // namespace kds::bench
