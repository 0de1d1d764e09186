#pragma once
// The chains that benchmarks run on: trajectories, and models (motions/models/model.h) whose beads are moved.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "motions/scene/scene.h"

namespace kds::bench {

/// One necklace in consecutive frames.
struct BenchChain {
  std::string name;
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;  ///< one per bead
  int dimension = 3;          ///< 2 if all beads lie in the plane z = 0

  [[nodiscard]] std::size_t size() const { return radii.size(); }
  [[nodiscard]] Scene scene() const;  ///< moves linearly from frame to frame
};

/// Returns the trajectories of data/trajectories with the extension .dcd, in order.
[[nodiscard]] std::vector<std::filesystem::path> trajectories();

/// Reads the first 100 of every `stride`-th frame, with the radii of `--radius auto`. NAME.pdb names the
/// atoms of NAME.dcd and of NAME_first20.dcd. Throws InputError, also if the file has only one frame.
[[nodiscard]] BenchChain read_bench_chain(const std::filesystem::path& path, std::size_t stride = 1);

/// Returns the centres of the model with its default settings and radius 1. The centres are moved by up to
/// `jitter` radii if the model supports jitter. For dimension 2 they lie in the plane. Throws InputError if
/// the model needs more beads.
[[nodiscard]] Eigen::Matrix3Xd model_at_rest(std::string_view model, std::size_t beads, double jitter = 0.05,
                                             int dimension = 3);

/// Returns two frames of the model with its default settings, between which it rotates.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> rotating_frames(std::string_view model, std::size_t beads);

/// Returns two frames of a grid in which a single bead moves to another position between its neighbours.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> grid_with_one_moving(std::size_t beads);

/// Returns a chain rolled up in the plane, with as many turns as the beads have room for.
[[nodiscard]] Eigen::Matrix3Xd planar_spiral(std::size_t beads);

/// Returns frames in which every bead moves by `distance` per frame in its own direction. For dimension 2 the
/// directions lie in the plane.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                                           std::size_t frames, int dimension = 3);

}  // namespace kds::bench
