#pragma once
// The experiment behind `kds update`: every technique over the same frames, at several strides.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/program/timing.h"
#include "experiments/update/update_options.h"
#include "motions/scene/scene.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// What all techniques have before them at one stride: sums over all steps from one frame to the next.
struct UpdateTask {
  std::size_t stride = 1;
  std::size_t steps = 0;
  std::uint64_t cells = 0;          ///< finite, of the diagrams arrived at
  std::uint64_t hidden = 0;         ///< beads, in these
  std::uint64_t cells_changed = 0;  ///< finite ones of one frame's diagram that are not in the other's
  std::uint64_t certificates = 0;   ///< of the diagrams set out from
  std::uint64_t failed = 0;         ///< of these, at the positions arrived at

  [[nodiscard]] double failed_share() const {
    return certificates == 0 ? 0 : static_cast<double>(failed) / static_cast<double>(certificates);
  }
};

/// What one technique did, sums over all steps.
struct UpdateRow {
  UpdateTask task;
  std::string technique;
  std::optional<std::uint64_t> activated, removed, events;  ///< where the technique does such a thing
  std::uint64_t rebuilds = 0;
  std::uint64_t audits = 0;
  Spread seconds;    ///< of the processor, of all rounds
  double ratio = 1;  ///< of medians, to rebuilding's

  /// Events a changed cell; none where nothing changed, and where not all changes are events.
  [[nodiscard]] std::optional<double> efficiency() const {
    if (!events || rebuilds > 0 || task.cells_changed == 0) return std::nullopt;
    return static_cast<double>(*events) / static_cast<double>(task.cells_changed);
  }
};

/// Throws AuditError, beginning with `what`, where a diagram is not the static one and `fault` says what is
/// wrong with it: degenerate positions have several.
template <int Dimension>
void audit_update(const StaticTriangulation<Dimension>& found, const StaticTriangulation<Dimension>& expected,
                  const std::function<std::optional<std::string>()>& fault, const std::string& what);

/// Returns the scene of every stride-th frame. Called at each stride, for linear and for Hermite motion.
using SceneAtStride = std::function<Scene(std::size_t stride, FrameMotion motion)>;

/// Compares techniques, in the plane if the scene is planar. Reads frames one by one, again for each
/// technique, so memory does not grow with the frames of files. Throws InputError if a stride leaves fewer
/// than two frames, AuditError if a diagram is wrong.
[[nodiscard]] std::vector<UpdateRow> compare_updates(
    const SceneAtStride& scene_at, const UpdateOptions& options,
    const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
