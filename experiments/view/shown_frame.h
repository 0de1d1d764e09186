#pragma once
// A frame of a recorded run in the input's coordinates: beads, spheres of nodes, edges and contacts. VTK
// files for ParaView and scripts for PyMOL and ChimeraX are made of such frames.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/output_files.h"
#include "motions/frames/frame_stamp.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/replay_recorder.h"

namespace kds {

struct ShownFrame {
  using Pairs = std::vector<std::array<BeadId, 2>>;
  struct Cage {
    BeadRange beads;
    std::uint32_t level = 0;
    Eigen::Vector3d center;
    double radius = 0;
  };

  FrameStamp stamp;
  Eigen::Matrix3Xd centers;
  std::vector<double> radii;          ///< 0 for points without a radius
  std::vector<std::uint32_t> chains;  ///< for each bead the index of its necklace
  std::vector<bool> hidden;           ///< for each bead
  Pairs bonds, edges, contacts;
  std::vector<Cage> cages;
};

/// Returns the state of the run at the frame that it has just reached. At frame 0 the structures have just
/// been built.
[[nodiscard]] ShownFrame shown_frame(std::size_t frame, const Scene& scene, const KineticRun& run,
                                     const ReplayRecorder& recorder);

/// VTK files of all frames, and replay.pvd, which lists these files with their times (docs/formats.md). A
/// frame has a file of spheres only if the run has a wrapped hierarchy.
class VtkFrames {
 public:
  /// Throws an InputError or OutputError that names the option and the path.
  VtkFrames(const std::filesystem::path& directory, bool replace);

  void add(const ShownFrame& frame);
  /// Writes replay.pvd. Call it after the last frame.
  void finish();
  [[nodiscard]] AtomicFiles& files() { return files_; }

 private:
  AtomicFiles files_;
  std::string collection_;
};

/// Returns the text of a scene for another viewer: a PyMOL script if the file's name ends in .pml, a BILD
/// file for ChimeraX if it ends in .bild.
[[nodiscard]] std::string scene_script(const std::filesystem::path& file, const ShownFrame& frame);
/// Throws InputError if the name of the file has another ending.
void check_script_ending(const std::filesystem::path& file);

}  // namespace kds
