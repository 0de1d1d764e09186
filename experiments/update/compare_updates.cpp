#include "experiments/update/compare_updates.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "experiments/program/timing.h"
#include "motions/base/input_error.h"
#include "motions/frames/every_nth.h"
#include "structures/power_diagram/diagram_update.h"
#include "structures/session/session.h"
#include "structures/triangulation/snapshot_faults.h"

namespace kds {

namespace {

/// The frames of one stride, with the static diagrams that all techniques must arrive at.
template <int Dimension>
struct Frames {
  Frames(const Scene& scene, bool keep_diagrams) {
    for (std::size_t k = 0; k < scene.frame_count(); ++k) {
      centers.push_back(scene.centers(k));
      weights.push_back(scene.weights(k));
      numbers.push_back(scene.frame_number(k));
    }
    StaticTriangulation<Dimension> before;
    for (std::size_t k = 0; k < centers.size(); ++k) {
      auto now = static_triangulation<Dimension>(centers[k], weights[k]);
      if (k > 0) compare(before, now, k);
      if (keep_diagrams) diagrams.push_back(now);
      before = std::move(now);
    }
  }

  UpdateTask task;
  std::vector<Eigen::Matrix3Xd> centers;
  std::vector<std::vector<double>> weights;
  std::vector<StaticTriangulation<Dimension>> diagrams;
  std::vector<std::size_t> numbers;  ///< of the frames in the file

 private:
  void compare(const StaticTriangulation<Dimension>& before, const StaticTriangulation<Dimension>& now,
               std::size_t k) {
    ++task.steps;
    task.cells += now.cells.size();
    task.hidden += now.hidden.size();
    std::vector<CellBeads<Dimension>> changed;
    std::set_symmetric_difference(before.cells.begin(), before.cells.end(), now.cells.begin(),
                                  now.cells.end(), std::back_inserter(changed));
    task.cells_changed += changed.size();
    if (before.dimension < Dimension) return;
    RegularTriangulation<Dimension> triangulation;
    triangulation.build(centers[k - 1], weights[k - 1]);
    const SnapshotFaults faults = snapshot_faults(triangulation, Snapshot<Dimension>(centers[k], weights[k]));
    task.certificates += faults.tested;
    task.failed += faults.failed();
  }
};

std::vector<Trajectory> strided(const std::vector<Trajectory>& necklaces, std::size_t stride) {
  std::vector<Trajectory> some;
  for (const Trajectory& necklace : necklaces) {
    some.push_back(every_nth(necklace, stride));
    if (necklace.frames.size() > 1 && some.back().frames.size() < 2)
      throw InputError(fmt::format("--strides: {} leaves one of the {} frames of {}; expected two or more",
                                   stride, necklace.frames.size(), necklace.file));
  }
  return some;
}

UpdateTechnique technique_of(std::string_view name) {
  const auto* const found = std::ranges::find(update_technique_names, name);
  if (found == update_technique_names.end()) throw std::logic_error(fmt::format("no technique {}", name));
  return static_cast<UpdateTechnique>(found - update_technique_names.begin());
}

template <int Dimension>
class UpdateComparison {
 public:
  UpdateComparison(std::vector<Trajectory> necklaces, const std::vector<double>& radii,
                   const UpdateOptions& options, std::size_t stride)
      : necklaces_(std::move(necklaces)),
        radii_(radii),
        audit_(options.audit == AuditMode::frames),
        frames_(Scene(necklaces_, radii), audit_) {
    frames_.task.stride = stride;
    for (const std::string& name : options.techniques) {
      rows_.emplace_back();
      rows_.back().technique = name;
      rows_.back().task = frames_.task;
    }
    seconds_.resize(rows_.size());
  }

  /// All techniques once, one after the other.
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
  /// Counts and audits in the first round only: all are alike.
  double run(UpdateRow& row, bool first) const {
    const UpdateTechnique technique = technique_of(row.technique);
    const auto update = make_diagram_update<Dimension>(technique);
    update->build(frames_.centers[0], frames_.weights[0]);
    double seconds = 0;
    UpdateCounts sum;
    for (std::size_t k = 1; k < frames_.centers.size(); ++k) {
      UpdateCounts counts;
      seconds +=
          processor_seconds_of([&] { counts = update->advance(frames_.centers[k], frames_.weights[k]); });
      sum.activated += counts.activated;
      sum.removed += counts.removed;
      sum.events += counts.events;
      sum.rebuilds += counts.rebuilds;
      if (first && audit_) {
        ++row.audits;
        audit_update<Dimension>(
            update->diagram(), frames_.diagrams[k], [&] { return update->fault(); },
            fmt::format("{} at stride {}, frame {}", row.technique, row.task.stride, frames_.numbers[k]));
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
    const Scene scene(necklaces_, radii_, FrameMotion::hermite);
    const auto session =
        std::make_unique<Session>(scene, SessionOptions{{"power"}, Kernel::filtered, AuditMode::none, {}});
    session->load(0);
    session->simulator().build();
    const double seconds = processor_seconds_of([&] { run_steps(scene, *session); });
    if (!first) return seconds;
    const StructureStatistics& statistics = session->structures().front()->statistics;
    row.events = 0;
    for (const std::uint64_t events : statistics.events_per_step) *row.events += events;
    row.activated = scene.bead_count() * scene.step_count();
    row.rebuilds = statistics.rebuilds;
    return seconds;
  }
  std::uint64_t audited_hermite(const UpdateRow& row) const {
    const Scene scene(necklaces_, radii_, FrameMotion::hermite);
    const auto session =
        std::make_unique<Session>(scene, SessionOptions{{"power"}, Kernel::filtered, AuditMode::frames, {}});
    session->load(0);
    session->simulator().build();
    try {
      run_steps(scene, *session);
    } catch (const AuditError& error) {
      throw AuditError(fmt::format("hermite at stride {}: {}", row.task.stride, error.what()));
    }
    return scene.step_count();
  }
  static void run_steps(const Scene& scene, Session& session) {
    for (std::size_t k = 0; k < scene.step_count(); ++k) {
      session.load(k);
      session.simulator().run_step();
    }
    session.simulator().finish();
  }

  std::vector<Trajectory> necklaces_;
  const std::vector<double>& radii_;
  bool audit_;
  Frames<Dimension> frames_;
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

std::vector<UpdateRow> compare_updates(const std::vector<Trajectory>& necklaces,
                                       const std::vector<double>& radii, const UpdateOptions& options,
                                       const std::function<void(std::size_t, std::size_t)>& progress) {
  // Before the first long run.
  Scene(necklaces, radii).require_weights();
  for (const std::size_t stride : options.strides) static_cast<void>(strided(necklaces, stride));
  std::vector<UpdateRow> rows;
  std::size_t done = 0;
  for (const std::size_t stride : options.strides) {
    std::vector<Trajectory> some = strided(necklaces, stride);
    const auto compare = [&](auto comparison) {
      for (std::size_t round = 0; round < options.rounds; ++round) {
        comparison.round();
        progress(++done, options.strides.size() * options.rounds);
      }
      for (UpdateRow& row : comparison.rows()) rows.push_back(std::move(row));
    };
    if (Scene(some, radii).dimension() == 2) {
      compare(UpdateComparison<2>(std::move(some), radii, options, stride));
    } else {
      compare(UpdateComparison<3>(std::move(some), radii, options, stride));
    }
  }
  return rows;
}

}  // namespace kds
