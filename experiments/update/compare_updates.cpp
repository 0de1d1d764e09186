#include "experiments/update/compare_updates.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "experiments/program/timing.h"
#include "motions/base/input_error.h"
#include "structures/power_diagram/diagram_update.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/regularity_fault.h"

namespace kds {

namespace {

/// Counts the work that every technique has to do, using static diagrams of all frames. Only two frames are
/// in memory at a time.
template <int Dimension>
UpdateTask task_of(const Scene& scene, std::size_t stride) {
  UpdateTask task;
  task.stride = stride;
  StaticTriangulation<Dimension> before;
  Eigen::Matrix3Xd centers_before;
  std::vector<double> weights_before;
  for (std::size_t k = 0; k < scene.frame_count(); ++k) {
    Eigen::Matrix3Xd centers = scene.centers(k);
    std::vector<double> weights = scene.weights(k);
    auto now = static_triangulation<Dimension>(centers, weights);
    if (k > 0) {
      ++task.steps;
      task.cells += now.cells.size();
      task.hidden += now.hidden.size();
      std::vector<CellBeads<Dimension>> changed;
      std::set_symmetric_difference(before.cells.begin(), before.cells.end(), now.cells.begin(),
                                    now.cells.end(), std::back_inserter(changed));
      task.cells_changed += changed.size();
    }
    if (k > 0 && before.dimension == Dimension) {
      RegularTriangulation<Dimension> triangulation;
      triangulation.build(centers_before, weights_before);
      const SnapshotFaults faults = snapshot_faults(triangulation, Snapshot<Dimension>(centers, weights));
      task.certificates += faults.tested;
      task.failed += faults.failed();
    }
    before = std::move(now);
    centers_before = std::move(centers);
    weights_before = std::move(weights);
  }
  return task;
}

UpdateTechnique technique_of(std::string_view name) {
  const auto* const found = std::ranges::find(update_technique_names, name);
  if (found == update_technique_names.end()) throw std::logic_error(fmt::format("no technique {}", name));
  return static_cast<UpdateTechnique>(found - update_technique_names.begin());
}

template <int Dimension>
class UpdateComparison {
 public:
  UpdateComparison(Scene linear, SceneAtStride scene_at, const UpdateOptions& options, std::size_t stride)
      : linear_(std::move(linear)),
        scene_at_(std::move(scene_at)),
        audit_(options.audit == AuditMode::frames) {
    const UpdateTask task = task_of<Dimension>(linear_, stride);
    for (const std::string& name : options.techniques) {
      rows_.emplace_back();
      rows_.back().technique = name;
      rows_.back().task = task;
    }
    seconds_.resize(rows_.size());
  }

  /// Runs all techniques once, one after the other.
  void round() {
    for (std::size_t t = 0; t < rows_.size(); ++t) {
      const bool first = seconds_[t].empty();
      seconds_[t].push_back(rows_[t].technique == "hermite" ? run_hermite(rows_[t], first)
                                                            : run(rows_[t], first));
    }
  }
  [[nodiscard]] std::vector<UpdateRow> rows() {
    for (std::size_t t = 0; t < rows_.size(); ++t) {
      rows_[t].seconds = spread_of(seconds_[t]);
      rows_[t].ratio = rows_[t].seconds.median / rows_[0].seconds.median;
    }
    return rows_;
  }

 private:
  /// Counts and audits only in the first round, since all rounds do the same work.
  double run(UpdateRow& row, bool first) const {
    const UpdateTechnique technique = technique_of(row.technique);
    const auto update = make_diagram_update<Dimension>(technique);
    update->build(linear_.centers(0), linear_.weights(0));
    double seconds = 0;
    UpdateCounts sum;
    for (std::size_t k = 1; k < linear_.frame_count(); ++k) {
      const Eigen::Matrix3Xd centers = linear_.centers(k);
      const std::vector<double> weights = linear_.weights(k);
      UpdateCounts counts;
      seconds += processor_seconds_of([&] { counts = update->advance(centers, weights); });
      sum.activated += counts.activated;
      sum.removed += counts.removed;
      sum.events += counts.events;
      sum.rebuilds += counts.rebuilds;
      if (first && audit_) {
        ++row.audits;
        audit_update<Dimension>(
            update->diagram(), static_triangulation<Dimension>(centers, weights),
            [&] { return update->fault(); },
            fmt::format("{} at stride {}, frame {}", row.technique, row.task.stride,
                        linear_.frame_number(k)));
      }
    }
    if (!first) return seconds;
    row.rebuilds = sum.rebuilds;
    const bool reinserts = technique == UpdateTechnique::reinsert || technique == UpdateTechnique::greedy;
    if (reinserts) row.removed = sum.removed;
    if (reinserts || technique == UpdateTechnique::rebuild) return seconds;
    row.activated = sum.activated;
    row.events = sum.events;
    return seconds;
  }

  double run_hermite(UpdateRow& row, bool first) const {
    if (first && audit_) row.audits = audited_hermite(row);
    const Scene scene = scene_at_(row.task.stride, FrameMotion::hermite);
    KineticRun run(scene, {.structures = {"power"}});
    std::uint64_t events = 0;
    const double seconds = run_steps_of(run, events);
    if (!first) return seconds;
    row.events = events;
    row.activated = scene.bead_count() * scene.step_count();
    row.rebuilds = run.structures().front()->statistics.rebuilds;
    return seconds;
  }
  std::uint64_t audited_hermite(const UpdateRow& row) const {
    const Scene scene = scene_at_(row.task.stride, FrameMotion::hermite);
    KineticRun run(scene, {.structures = {"power"}, .audits = AuditMode::frames});
    std::uint64_t events = 0;
    try {
      run_steps_of(run, events);
    } catch (const AuditError& error) {
      throw AuditError(fmt::format("hermite at stride {}: {}", row.task.stride, error.what()));
    }
    return scene.step_count();
  }
  /// Returns the seconds without the time for reading frames.
  static double run_steps_of(KineticRun& run, std::uint64_t& events) {
    const Scene& scene = run.scene();
    std::vector<std::uint64_t>& of_steps = run.structures().front()->statistics.events_per_step;
    run.build();
    double seconds = 0;
    for (std::size_t k = 0; k < scene.step_count(); ++k) {
      static_cast<void>(
          scene.centers(std::min(k + 2, scene.frame_count() - 1)));  // read before the clock runs
      seconds += processor_seconds_of([&] { run.run_step(); });
      for (const std::uint64_t count : of_steps) events += count;
      of_steps.clear();
    }
    return seconds + processor_seconds_of([&] { run.finish(); });
  }

  Scene linear_;
  SceneAtStride scene_at_;
  bool audit_;
  std::vector<UpdateRow> rows_;
  std::vector<std::vector<double>> seconds_;
};

}  // namespace

template <int Dimension>
void audit_update(const StaticTriangulation<Dimension>& found, const StaticTriangulation<Dimension>& expected,
                  const std::function<std::optional<std::string>()>& fault, const std::string& what) {
  if (found.cells == expected.cells && found.hidden == expected.hidden) return;
  if (const auto wrong = fault()) throw AuditError(fmt::format("{}: audit failed: {}", what, *wrong));
}

template void audit_update(const StaticTriangulation<2>&, const StaticTriangulation<2>&,
                           const std::function<std::optional<std::string>()>&, const std::string&);
template void audit_update(const StaticTriangulation<3>&, const StaticTriangulation<3>&,
                           const std::function<std::optional<std::string>()>&, const std::string&);

std::vector<UpdateRow> compare_updates(const SceneAtStride& scene_at, const UpdateOptions& options,
                                       const std::function<void(std::size_t, std::size_t)>& progress) {
  // Checked before the first long run.
  const Scene all = scene_at(1, FrameMotion::linear);
  all.require_weights();
  for (const std::size_t stride : options.strides)
    if (stride >= all.frame_count())
      throw InputError(
          "--strides",
          fmt::format("{} leaves one of the {} frames{}; expected two or more", stride, all.frame_count(),
                      options.inputs.empty() ? "" : fmt::format(" of {}", input_name(options, 0))));
  std::vector<UpdateRow> rows;
  std::size_t done = 0;
  for (const std::size_t stride : options.strides) {
    const auto compare = [&](auto comparison) {
      for (std::size_t round = 0; round < options.rounds; ++round) {
        comparison.round();
        progress(++done, options.strides.size() * options.rounds);
      }
      for (UpdateRow& row : comparison.rows()) rows.push_back(std::move(row));
    };
    Scene some = scene_at(stride, FrameMotion::linear);
    if (some.dimension() == 2) {
      compare(UpdateComparison<2>(std::move(some), scene_at, options, stride));
    } else {
      compare(UpdateComparison<3>(std::move(some), scene_at, options, stride));
    }
  }
  return rows;
}

}  // namespace kds
