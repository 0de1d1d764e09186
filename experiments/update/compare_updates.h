#pragma once
// The experiment behind `kds update`. The experiment runs every technique over the same frames, at several
// strides.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/program/timing.h"
#include "experiments/update/update_command.h"
#include "motions/scene/scene.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// The work that every technique faces at one stride: sums over all steps from one frame to the next.
struct UpdateTask {
  std::size_t stride = 1;
  std::size_t steps = 0;
  std::uint64_t cells = 0;          ///< finite cells of the diagrams at the ends of the steps
  std::uint64_t hidden = 0;         ///< hidden beads in these diagrams
  std::uint64_t cells_changed = 0;  ///< finite cells that only one of the step's two diagrams has
  std::uint64_t certificates = 0;   ///< certificates of the diagrams at the starts of the steps
  std::uint64_t failed = 0;         ///< certificates that fail at the positions at the step's end

  [[nodiscard]] double failed_share() const {
    return certificates == 0 ? 0 : static_cast<double>(failed) / static_cast<double>(certificates);
  }
};

/// The work of one technique, summed over all steps.
struct UpdateRow {
  UpdateTask task;
  std::string technique;
  std::optional<std::uint64_t> activated, removed, events;  ///< empty if the technique has no such operation
  std::uint64_t rebuilds = 0;
  std::uint64_t audits = 0;
  Spread seconds;    ///< processor time over all rounds
  double ratio = 1;  ///< median time divided by the median time of the technique `rebuild`

  /// Returns the events per changed cell. Returns nothing if no cell changed, or if the technique also
  /// changed cells without events.
  [[nodiscard]] std::optional<double> efficiency() const {
    if (!events || rebuilds > 0 || task.cells_changed == 0) return std::nullopt;
    return static_cast<double>(*events) / static_cast<double>(task.cells_changed);
  }
};

/// Throws AuditError if a diagram differs from the static one and `fault` reports what is wrong with it.
/// Degenerate positions have several correct diagrams. `what` begins the message.
template <int Dimension>
void audit_update(const StaticTriangulation<Dimension>& found, const StaticTriangulation<Dimension>& expected,
                  const std::function<std::optional<std::string>()>& fault, const std::string& what);

/// Returns the scene of every stride-th frame. Called at each stride, for linear and for Hermite motion.
using SceneAtStride = std::function<Scene(std::size_t stride, FrameMotion motion)>;

/// Compares techniques, in the plane if the scene is planar. Each technique reads the frames again, one by
/// one, so memory does not grow with the number of frames. Throws InputError if a stride leaves fewer than
/// two frames, AuditError if a diagram is wrong.
[[nodiscard]] std::vector<UpdateRow> compare_updates(
    const SceneAtStride& scene_at, const UpdateOptions& options,
    const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
