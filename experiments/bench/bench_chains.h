#pragma once
// Chains that benchmarks run on: trajectories, and models (motions/models/model.h) whose beads are moved.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// One necklace, frame after frame.
struct BenchChain {
  std::string name;
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;  ///< one a bead
  int dimension = 3;          ///< 2: all in the plane z = 0
};

/// The first 100 frames of every `stride`-th, radii as `--radius auto` has them; NAME.pdb names the atoms of
/// NAME.dcd and of NAME_first20.dcd. Throws InputError, also where the file has one frame.
[[nodiscard]] BenchChain read_bench_chain(const std::filesystem::path& path, std::size_t stride = 1);

/// Centres of the model with its defaults, radius 1, moved by up to `jitter` radii where it takes that, of
/// dimension 2 in the plane. Throws InputError where there are too few beads for it.
[[nodiscard]] Eigen::Matrix3Xd model_at_rest(std::string_view model, std::size_t beads, double jitter = 0.05,
                                             int dimension = 3);

/// Two frames of the model with its defaults, between which it rotates.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> rotating_frames(std::string_view model, std::size_t beads);

/// Two frames of a grid of which one bead alone moves, to another place between its neighbours.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> grid_with_one_moving(std::size_t beads);

/// Rolled up in the plane, with as many turns as so many beads have room for.
[[nodiscard]] Eigen::Matrix3Xd planar_spiral(std::size_t beads);

/// Frame after frame every bead moves `distance` in a direction of its own, of dimension 2 in the plane.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                                           std::size_t frames, int dimension = 3);

}  // namespace kds
