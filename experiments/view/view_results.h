#pragma once
// Writes the files that show a run: the replay page, VTK files, and a script for another viewer. Listens to
// the run while it goes on. All files appear together with the other results of the command.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/view/replay_page.h"
#include "experiments/view/shown_frame.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/replay_recorder.h"

namespace kds {

struct ViewRequest {
  std::optional<std::filesystem::path> page;
  std::optional<double> quantum;            ///< as in ReplayPageOptions
  std::optional<std::uint64_t> most_bytes;  ///< of the page
  std::optional<std::filesystem::path> vtk;
  std::optional<std::filesystem::path> script;
  std::optional<std::size_t> at;      ///< number of the script's frame in the file; no value: the first frame
  bool replace = false;               ///< whether `vtk` may hold an earlier result, which is replaced
  AtomicFiles* page_files = nullptr;  ///< files with which the page appears; null: files()
};

class ViewResults {
 public:
  /// Starts the files and listens to the run, whose structures must not have been built. The scene and
  /// the run must outlive this object. Throws InputError if the request does not suit the scene, and
  /// ReplayTooLarge.
  ViewResults(const ViewRequest& request, const ReplayLabels& labels, const Scene& scene, KineticRun& run);

  /// Adds a frame that the run has just reached. The first frame is added when the structures are built.
  void add_frame(std::size_t frame);
  /// Completes the files after the last frame. Throws ReplayTooLarge.
  void finish();

  [[nodiscard]] const ReplayRecorder& recorder() const { return recorder_; }
  /// Returns the number of bytes of the page, or 0 without a page.
  [[nodiscard]] std::uint64_t page_bytes() const { return page_ ? page_->bytes() : 0; }
  [[nodiscard]] AtomicFiles* files() { return &files_; }
  [[nodiscard]] AtomicFiles* vtk_files() { return vtk_ ? &vtk_->files() : nullptr; }

 private:
  /// Finds the frame of the script in a run over one frame in `stride`.
  void find_script_frame(std::size_t stride);

  ViewRequest request_;
  const Scene& scene_;
  KineticRun& run_;
  ReplayRecorder recorder_;
  AtomicFiles files_;
  std::optional<ReplayPage> page_;
  std::optional<VtkFrames> vtk_;
  std::size_t script_frame_ = 0;
};

}  // namespace kds
