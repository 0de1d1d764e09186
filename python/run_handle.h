#pragma once
// A run that Python drives: a KineticRun with its scene, its counts and its events.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/run/event_log_file.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_scene.h"
#include "experiments/view/replay_page.h"
#include "experiments/view/view_results.h"
#include "motions/numbers/exact_number.h"
#include "motions/scene/scene.h"
#include "python/event_rows.h"
#include "python/frames_in_memory.h"
#include "python/watch.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"

namespace kds::python {

/// The beads of structures that contain only some beads, by the structure's name.
using OnlyBeads = std::map<std::string, std::vector<BeadId>, std::less<>>;

/// Options that have no text on the command line.
struct PythonOptions {
  OnlyBeads only;
};

class RunHandle {
 public:
  /// A run over the inputs that `arguments` name, as `kds run` takes them. `memory` keeps the input alive if
  /// it is in memory. Warnings are kept for `warnings`. Throws InputError also if the page of --view could
  /// not be written later.
  RunHandle(const Arguments& arguments, const PythonOptions& more, std::shared_ptr<FramesInMemory> memory);
  /// A run over frames that the caller pushes. `arguments` must not name an input.
  RunHandle(const Arguments& arguments, const PythonOptions& more, PushedFrames frames);
  RunHandle(const RunHandle&) = delete;
  RunHandle& operator=(const RunHandle&) = delete;
  ~RunHandle() = default;

  /// Runs all steps, on several threads if the run can be cut, and keeps the report.
  void execute(const pybind11::object& progress);
  /// Writes the log of the run, which must not have begun, to a file when `finish` is called. The run then
  /// cannot go back. Throws InputError if no log can hold the run.
  void write_log(const std::string& path);
  /// Writes the page of --view. Call it once, after `execute`.
  void write_view();

  // The functions of KineticRun. Each one is refused while another thread uses the run.
  using Frame = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
  void push(const Frame& frame, std::optional<double> picoseconds, const std::optional<Cell>& cell);
  void build();
  [[nodiscard]] bool step();
  [[nodiscard]] bool next_event();
  void go_to(double time);
  void finish();
  /// Leaves a running simulation; no further frame follows. Other runs stay as they are.
  void leave();
  void audit();
  void insert(std::size_t structure, BeadId bead);
  void erase(std::size_t structure, BeadId bead);
  /// Gives beads other curves from now on. `points` has the shape (beads, degree + 1, dimension).
  void bend(const std::vector<BeadId>& beads,
            const pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>& points);
  /// Returns the control points of the present step, of the shape (beads, degree + 1, dimension).
  [[nodiscard]] pybind11::array_t<double> control_points();
  /// Returns the control points of the cell's vectors, of the shape (dimension, degree + 1, dimension), or an
  /// array without vectors if the beads have no images.
  [[nodiscard]] pybind11::array_t<double> cell_points();
  /// Returns the time at which the run stands, counted in steps. Rounded if it is irrational.
  [[nodiscard]] double time();
  [[nodiscard]] std::uint64_t fingerprint();

  // Queries at the present time, or at `time` (counted in steps), where the run then stands.
  /// Returns the pairs of beads whose power cells share a facet, ascending: an array (m, 2).
  [[nodiscard]] pybind11::array_t<std::int64_t> edges(std::optional<double> time);
  /// Returns the pairs in contact, ascending: an array (m, 2).
  [[nodiscard]] pybind11::array_t<std::int64_t> contacts(std::optional<double> time);
  /// Returns the nodes' beads (nodes, 2), first and last, and spheres (nodes, 4): centre and radius.
  [[nodiscard]] pybind11::tuple spheres(const std::string& structure, std::optional<double> time);
  /// Returns the elements of a structure at a frame, where no element has more than six ids, and how many of
  /// the ids are its place. Absent ids are -1.
  [[nodiscard]] pybind11::tuple elements(const std::string& structure, std::size_t frame);

  /// Returns the events since the last call (EventRows::take).
  [[nodiscard]] pybind11::array take_events();
  void keep_events(bool keeps) { events_.keep(keeps); }
  /// Returns, for each structure in order, its name and the names of its kinds of events.
  [[nodiscard]] std::vector<std::pair<std::string, std::vector<std::string>>> structures();
  [[nodiscard]] std::vector<std::string> warnings() { return std::exchange(warnings_, {}); }

  /// Returns the table of `kds run`. The first call measures the static builds at all frames.
  [[nodiscard]] std::string table(const pybind11::object& progress);
  /// Returns the JSON of `kds run`.
  [[nodiscard]] std::string json();

  [[nodiscard]] const Scene& scene() const { return run_->scene(); }
  /// Returns the distance at which beads are in contact. Balls that meet have no distance of their surfaces.
  [[nodiscard]] ContactDistance contact_distance() const {
    return options_.distances.first().value_or(ContactDistance{0, true});
  }
  /// Returns how far apart along their chain the beads of a contact are at least.
  [[nodiscard]] BeadId apart() const { return options_.apart.value_or(StructureSettings().apart); }
  /// Returns a frame's number in the trajectory and its time in picoseconds. Fast at and near the present
  /// step.
  using Stamp = std::pair<std::size_t, std::optional<double>>;
  [[nodiscard]] Stamp stamp(std::size_t frame);
  /// Returns the stamps of all frames that `execute` has reached.
  [[nodiscard]] const std::vector<Stamp>& stamps() const { return stamps_; }
  [[nodiscard]] std::vector<std::string> bead_names() const;

 private:
  class Reserved;
  class Use;

  /// Opens a run over `scene_` that stands at its start.
  void open();
  void listen();
  template <class Read>
  [[nodiscard]] pybind11::array_t<double> of_step(const Read& read);
  void go(double time);
  /// Opens the run on several threads, or returns null if it takes one. Keeps a warning that says why.
  [[nodiscard]] std::unique_ptr<ParallelRun> open_parts();
  [[nodiscard]] ReplayLabels labels() const;
  [[nodiscard]] std::size_t index_of(const std::string& structure) const;
  /// Goes to a time and returns the parameter in the step under way or just run.
  [[nodiscard]] Dyadic stand_at(std::optional<double> time);
  template <class Structure>
  [[nodiscard]] Structure* find_structure() const;

  std::shared_ptr<FramesInMemory> memory_;
  RunOptions options_;
  OnlyBeads only_;
  std::vector<std::string> warnings_;
  std::unique_ptr<Scene> scene_;  // empty if frames are pushed
  std::unique_ptr<KineticRun> run_;
  bool is_behind_ = false;           // all steps were run on several threads, and `run_` stands at its start
  std::optional<ViewResults> view_;  // listens to `run_`, as does `log_`
  std::optional<EventLogWriter> log_;
  bool is_logged_ = false;  // whether the file of `log_` is complete
  EventRows events_;
  std::optional<RunReport> report_;
  bool has_static_times_ = false;
  std::vector<Stamp> stamps_;
  std::atomic<bool> in_use_ = false;
};

}  // namespace kds::python
