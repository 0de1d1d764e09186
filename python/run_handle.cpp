#include "python/run_handle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "experiments/events/closest_approach.h"
#include "experiments/output/output_files.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/replay_labels.h"
#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "python/arrays.h"
#include "structures/contacts/contacts.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/session/scene_motion.h"
#include "structures/triangulation/diagram_edges.h"

namespace kds::python {

namespace py = pybind11;

namespace {

constexpr CommandSpec kPushedRun{"kds.KineticRun", "", {}, {}, ""};

RunOptions pushed_options(const Arguments& arguments) {
  RunOptions options;
  read_arguments(kPushedRun, run_options(), arguments, options);
  return options;
}

void check_output(const RunOptions& options, const std::string& name,
                  const std::optional<std::filesystem::path>& path) {
  if (!path) return;
  TakenPaths paths;
  paths.read(options);
  paths.write(name, *path);
  ensure_writable_file(*path, name);
}

py::array_t<std::int64_t> array_of_pairs(const std::vector<BeadPair>& pairs) {
  std::vector<std::int64_t> ids;
  ids.reserve(2 * pairs.size());
  for (const BeadPair& pair : pairs) {
    ids.push_back(pair.first);
    ids.push_back(pair.second);
  }
  return array_of(std::move(ids), {static_cast<py::ssize_t>(pairs.size()), 2});
}

template <int Dimension>
std::vector<BeadPair> edges_of_diagram(const PowerDiagram<Dimension>& diagram, std::size_t beads, bool within,
                                       bool first) {
  std::vector<BeadPair> pairs;
  std::vector<BeadId> present;
  for (BeadId bead = 0; bead < beads; ++bead)
    if (!diagram.is_absent(bead)) present.push_back(bead);
  const auto add = [&](BeadId bead, const auto& neighbors) {
    for (const BeadId other : neighbors)
      if (bead < other) pairs.push_back({bead, other});
  };
  if (!within && present.size() == beads) {
    const DiagramEdges at_frame = diagram.edges_at_frame(first);
    for (const BeadId bead : present) add(bead, at_frame.edges.of(bead));
  } else {
    for (const BeadId bead : present) add(bead, diagram.neighbors(bead));
  }
  return pairs;
}

}  // namespace

/// Reserves the run for one thread.
class RunHandle::Reserved {
 public:
  explicit Reserved(RunHandle& run) : run_(run) {
    if (run.in_use_.exchange(true))
      throw std::runtime_error(
          "this run is in use, by another thread or by the function that calls this one; expected a run for "
          "each thread");
  }
  Reserved(const Reserved&) = delete;
  Reserved& operator=(const Reserved&) = delete;
  ~Reserved() { run_.in_use_ = false; }

 private:
  RunHandle& run_;
};

/// Reserves the run for one thread and lets Python run other threads meanwhile.
class RunHandle::Use {
 public:
  explicit Use(RunHandle& run, const py::object& progress = py::none())
      : reserved_(run), watch_(progress, run.scene().is_live()) {}
  [[nodiscard]] Watch& watch() { return watch_; }

 private:
  Reserved reserved_;
  Watch watch_;
};

RunHandle::RunHandle(const Arguments& arguments, const PythonOptions& more,
                     std::shared_ptr<FramesInMemory> memory)
    : memory_(std::move(memory)), options_(parse_run_options(arguments)), only_(more.only) {
  check_output(options_, "view", options_.view);
  const auto warn = [this](const std::string& warning) { warnings_.push_back(warning); };
  withdraw_live_end();
  scene_ = std::make_unique<Scene>(load_scene(options_, warn));
  open();
}

RunHandle::RunHandle(const Arguments& arguments, const PythonOptions& more, PushedFrames frames)
    : options_(pushed_options(arguments)) {
  frames.motion = options_.motion;
  frames.probe = options_.probe_length();
  for (const std::string& name : options_.structures) {
    const StructureSpec* const spec = structure_registry().find(name);
    if (frames.cell && spec != nullptr && spec->lacks_images)
      warn_of_images(name, [this](const std::string& warning) { warnings_.push_back(warning); });
  }
  const Scene pattern(frames);  // the options are checked against its beads
  KineticRunOptions kinetic = kinetic_run_options(options_, pattern, options_.audit);
  kinetic.only = more.only;
  run_ = std::make_unique<KineticRun>(std::move(frames), kinetic);
  listen();
}

void RunHandle::open() {
  if (only_.empty()) {
    run_ = open_run(options_, *scene_, options_.audit);
  } else {
    KineticRunOptions kinetic = kinetic_run_options(options_, *scene_, options_.audit);
    kinetic.only = only_;
    run_ = std::make_unique<KineticRun>(*scene_, kinetic);
  }
  listen();
}

void RunHandle::listen() {
  events_.set_structures(run_->structures());
  run_->listen(events_);
  if (options_.work) run_->limit_work(*options_.work);
}

std::unique_ptr<ParallelRun> RunHandle::open_parts() {
  if (!only_.empty()) {
    if (options_.threads.value_or(1) > 1)
      warnings_.push_back(
          fmt::format("{} {}: the run is not cut and takes one thread, because only leaves beads out",
                      "--threads"_arg, *options_.threads));
    return nullptr;
  }
  auto parts = open_parallel_run(options_, *scene_, options_.audit, {},
                                 [this](const std::string& warning) { warnings_.push_back(warning); });
  return parts->threads() > 1 ? std::move(parts) : nullptr;
}

ReplayLabels RunHandle::labels() const {
  ReplayLabels labels = replay_labels(options_, "run");
  if (!memory_) return labels;
  labels.title = memory_->label();
  labels.inputs = {memory_->label()};
  labels.command = "kds.run in Python";
  return labels;
}

void RunHandle::execute(const py::object& progress) {
  Use use(*this, progress);
  Watch& watch = use.watch();
  const std::size_t steps = scene().is_live() ? 0 : scene().step_count();  // 0: not known
  const LiveProgress live(scene());
  const std::unique_ptr<ParallelRun> parts = open_parts();
  KineticRun& run = parts ? parts->whole() : *run_;
  StepCounts counts(run, scene());
  std::optional<ClosestApproachOfRun> approach;
  if (parts) {
    parts->listen(events_);
    follow_approach(*parts);
  } else if (const auto closest = index_of_closest(run); closest) {
    approach.emplace(run, *closest);
  }
  if (options_.view) {
    ViewRequest request;
    request.page = options_.view;
    view_.emplace(request, labels(), scene(), run);
  }
  const auto warn = [this](const std::string& warning) { warnings_.push_back(warning); };
  parts ? watch_exact_work(*parts, warn) : watch_exact_work(run_->simulator(), scene(), warn);
  const auto at_frame = [&](std::size_t frame) {
    if (frame == 0) {
      counts.begin();
      if (approach) approach->begin();
    } else {
      counts.end_step(frame - 1, nullptr);
      if (approach) approach->end_step(scene().frame_number(frame - 1));
    }
    if (view_) view_->add_frame(frame);
    const FrameStamp stamp = scene().stamp(frame);
    stamps_.emplace_back(stamp.number, stamp.picoseconds);
    watch.look(frame, 0, steps);
  };
  const InterruptionCheck within_step([&] {
    const double now = run_->simulator().now().lower();
    watch.set_within(now < 1 ? now : 0);  // 1 between steps
  });
  parts ? run_steps(*parts, options_, at_frame) : run_steps(*run_, options_, at_frame);
  for (const std::string& line : scene().live_warnings()) warn(line);
  is_behind_ = parts != nullptr;
  watch.end(scene().step_count());
  if (view_) view_->finish();
  report_ = report_of(run, scene(), options_, counts);
  if (scene().is_live()) report_->live = live.run(true);
  const auto hint = [&](const std::string& warning) {
    if (only_.empty()) warn(warning);  // hints are about all beads
  };
  complete_report(options_, scene(),
                  parts      ? followed_approach(*parts)
                  : approach ? approach->least()
                             : std::nullopt,
                  hint, *report_);
  if (parts) {
    report_->threads = parts->threads();
    report_->parts = parts->parts();
  }
  report_->command_line = "kds.run in Python";
  if (memory_) {
    report_->files = {memory_->label()};
    std::erase_if(report_->settings, [](const auto& setting) { return setting.first == "format"; });
  }
}

void RunHandle::write_log(const std::string& path) {
  if (memory_ || !scene_ || scene_->is_live() || !only_.empty())
    throw InputError(
        "log: needs a path as input and all beads (no only), because a log names its input files");
  if (log_ || is_logged_) throw std::logic_error("write_log(): the run has a log already");
  check_output(options_, "log", path);
  log_.emplace(path, options_, *scene_, run_->structures(), /*edits=*/true);
  run_->listen(*log_);
}

void RunHandle::write_view() {
  const Use use(*this);
  commit_together({view_.value().files()});
  open();  // the page listens to the run that ended
  is_behind_ = true;
  view_.reset();
}

void RunHandle::push(const Frame& frame, std::optional<double> picoseconds, const std::optional<Cell>& cell) {
  const std::span numbers(frame.data(), static_cast<std::size_t>(frame.size()));
  const Use use(*this);
  run_->push(numbers, picoseconds, cell);
}

void RunHandle::build() {
  const Use use(*this);
  run_->build();
}

bool RunHandle::step() {
  const Use use(*this);
  return run_->run_step();
}

void RunHandle::leave() {
  const Use use(*this);
  if (scene_) scene_->end_frames();
}

bool RunHandle::next_event() {
  const Use use(*this);
  return run_->next_event();
}

void RunHandle::go_to(double time) {
  const Use use(*this);
  go(time);
}

void RunHandle::go(double time) {
  if ((log_ || is_logged_) && run_->is_past(time))
    throw InputError("frame: a run that writes a log cannot go back");
  run_->go_to(time);
}

void RunHandle::finish() {
  const Use use(*this);
  run_->finish();
  if (!log_ || is_logged_) return;
  log_->end(run_->simulator().fingerprint());
  commit_together({&log_->file()});
  is_logged_ = true;
  log_.reset();  // frees the path; a finished run has no more events
}

void RunHandle::audit() {
  const Use use(*this);
  run_->audit_now();
}

void RunHandle::insert(std::size_t structure, BeadId bead) {
  const Use use(*this);
  run_->insert(structure, bead);
}

void RunHandle::erase(std::size_t structure, BeadId bead) {
  const Use use(*this);
  run_->erase(structure, bead);
}

void RunHandle::bend(const std::vector<BeadId>& beads,
                     const py::array_t<double, py::array::c_style | py::array::forcecast>& points) {
  const int degree = scene().degree(), dimension = scene().dimension();
  if (points.ndim() != 3 || points.shape(0) != static_cast<py::ssize_t>(beads.size()) ||
      points.shape(1) != degree + 1 || points.shape(2) != dimension)
    throw InputError(
        fmt::format("points: has the shape {}; expected ({}, {}, {}): beads, control points, axes",
                    std::string(py::str(points.attr("shape"))), beads.size(), degree + 1, dimension));
  std::vector<double> numbers(points.data(), points.data() + points.size());
  const Use use(*this);
  run_->change_motion(beads, std::move(numbers));
}

/// Reads the motion of the present step or, between two steps, that of the next. The structures then stand at
/// the end of the step before, so the run's own motion stays as it is.
template <class Read>
py::array_t<double> RunHandle::of_step(const Read& read) {
  const Reserved reserved(*this);
  if (run_->within_step()) return read(*run_->motion());
  const std::size_t step = run_->simulator().step();
  if (!scene().has_step(step))
    throw InputError("no step follows this frame; expected a frame before the last");
  const FloatingPointScope to_nearest;
  const auto next = make_scene_motion(scene());
  next->load(step);
  return read(*next);
}

py::array_t<double> RunHandle::control_points() {
  std::vector<BeadId> beads(scene().bead_count());
  std::iota(beads.begin(), beads.end(), BeadId{0});
  return of_step([&](const SceneMotion& motion) {
    return array_of(coordinates_of(motion, beads),
                    {static_cast<py::ssize_t>(beads.size()), scene().degree() + 1, scene().dimension()});
  });
}

py::array_t<double> RunHandle::cell_points() {
  return of_step([](const SceneMotion& motion) {
    return std::visit(
        []<int D>(const MotionRef<D>& ref) {
          const Curves<D> curves = ref.curves();
          const py::ssize_t vectors = curves.cell() == nullptr ? 0 : D, points = curves.own_degree() + 1;
          std::vector<double> numbers(curves.cell(), curves.cell() + vectors * points * D);
          return array_of(std::move(numbers), {vectors, points, D});
        },
        motion.ref());
  });
}

double RunHandle::time() {
  const Reserved reserved(*this);
  Simulator& simulator = run_->simulator();
  const auto step = static_cast<double>(simulator.step());
  if (!run_->within_step()) return step;
  const auto [lower, upper] = canonical_bracket(simulator.now());
  return step + 0.5 * (lower + upper);
}

py::array RunHandle::take_events() {
  const Reserved reserved(*this);
  return events_.take();
}

std::uint64_t RunHandle::fingerprint() {
  const Reserved reserved(*this);
  return report_ ? report_->fingerprint : run_->simulator().fingerprint();
}

std::size_t RunHandle::index_of(const std::string& structure) const {
  const auto& all = run_->structures();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const KineticStructure* one) { return one->name() == structure; });
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  std::string names;
  for (const KineticStructure* one : all) names += (names.empty() ? "" : ", ") + std::string(one->name());
  throw InputError(fmt::format("structures: the run has no {}; it has {}", structure, names));
}

Dyadic RunHandle::stand_at(std::optional<double> time) {
  if (std::exchange(is_behind_, false) && !time) time = static_cast<double>(scene().step_count());
  if (time) go(*time);
  run_->build();
  if (!run_->within_step()) return Dyadic(run_->simulator().step() == 0 ? 0.0 : 1.0);
  return time ? Dyadic(*time - static_cast<double>(run_->simulator().step()))
              : Dyadic(run_->simulator().now().lower());
}

template <class Structure>
Structure* RunHandle::find_structure() const {
  for (KineticStructure* const structure : run_->structures())
    if (auto* const found = dynamic_cast<Structure*>(structure)) return found;
  return nullptr;
}

py::array_t<std::int64_t> RunHandle::edges(std::optional<double> time) {
  static_cast<void>(index_of("power"));
  std::vector<BeadPair> pairs;
  {
    const Use use(*this);
    static_cast<void>(stand_at(time));
    const bool within = run_->within_step(), first = run_->simulator().step() == 0;
    const std::size_t beads = scene().bead_count();
    if (const auto* space = find_structure<PowerDiagram<3>>())
      pairs = edges_of_diagram(*space, beads, within, first);
    else if (const auto* plane = find_structure<PowerDiagram<2>>())
      pairs = edges_of_diagram(*plane, beads, within, first);
  }
  return array_of_pairs(pairs);
}

py::array_t<std::int64_t> RunHandle::contacts(std::optional<double> time) {
  static_cast<void>(index_of("contacts"));
  std::vector<BeadPair> pairs;
  {
    const Use use(*this);
    static_cast<void>(stand_at(time));
    if (const auto* space = find_structure<Contacts<3>>())
      pairs = space->pairs();
    else if (const auto* plane = find_structure<Contacts<2>>())
      pairs = plane->pairs();
    else if (const auto* line = find_structure<Contacts<1>>())
      pairs = line->pairs();
  }
  return array_of_pairs(pairs);
}

py::tuple RunHandle::spheres(const std::string& structure, std::optional<double> time) {
  const std::size_t index = index_of(structure);
  std::vector<NodeSphere> nodes;
  {
    const Use use(*this);
    const Dyadic u = stand_at(time);
    nodes = run_->spheres_at(index, u);
  }
  std::vector<std::int64_t> beads;
  std::vector<double> spheres;
  for (const NodeSphere& node : nodes) {
    beads.push_back(node.range.first);
    beads.push_back(node.range.last);
    for (int axis = 0; axis < 3; ++axis) spheres.push_back(node.sphere.center[axis]);
    spheres.push_back(node.sphere.radius);
  }
  const auto count = static_cast<py::ssize_t>(nodes.size());
  return py::make_tuple(array_of(std::move(beads), {count, 2}), array_of(std::move(spheres), {count, 4}));
}

py::tuple RunHandle::elements(const std::string& structure, std::size_t frame) {
  const std::size_t index = index_of(structure);
  std::optional<CombinatorialElements> found;
  {
    const Use use(*this);
    static_cast<void>(stand_at(static_cast<double>(frame)));
    found = run_->elements(index, frame);
  }
  if (!found) throw InputError(fmt::format("{}: its state at a frame is no set of elements", structure));
  std::sort(found->all.begin(), found->all.end());
  std::vector<std::int64_t> ids;
  for (const CombinatorialElement& element : found->all)
    for (const BeadId id : element) ids.push_back(id == no_bead ? -1 : std::int64_t{id});
  return py::make_tuple(
      array_of(std::move(ids), {static_cast<py::ssize_t>(found->all.size()),
                                static_cast<py::ssize_t>(std::tuple_size_v<CombinatorialElement>)}),
      found->place_ids);
}

std::vector<std::pair<std::string, std::vector<std::string>>> RunHandle::structures() {
  std::vector<std::pair<std::string, std::vector<std::string>>> all;
  for (const KineticStructure* const structure : run_->structures()) {
    auto& [name, kinds] = all.emplace_back(structure->name(), std::vector<std::string>());
    for (const EventKind& kind : structure->kinds()) kinds.emplace_back(kind.name);
  }
  return all;
}

std::string RunHandle::table(const py::object& progress) {
  if (!report_) throw std::logic_error("table(): the run has not been executed");
  if (!has_static_times_ && !scene().is_live()) {
    Use use(*this, progress);
    std::vector<double> seconds;
    for (std::size_t frame = 0; frame < scene().frame_count(); ++frame) {
      run_->time_static_builds(frame, seconds);
      use.watch().look(frame, 0, scene().frame_count());
    }
    for (std::size_t s = 0; s < report_->structures.size(); ++s)
      report_->structures[s].static_seconds = seconds[s];
    has_static_times_ = true;
  }
  return comparison_table(*report_);
}

std::string RunHandle::json() {
  if (!report_) throw std::logic_error("json(): the run has not been executed");
  return report_json(*report_);
}

RunHandle::Stamp RunHandle::stamp(std::size_t frame) {
  const Use use(*this);
  const FrameStamp stamp = scene().stamp(frame);
  return {stamp.number, stamp.picoseconds};
}

std::vector<std::string> RunHandle::bead_names() const {
  std::vector<std::string> names;
  for (BeadId bead = 0; scene().names_beads() && bead < scene().bead_count(); ++bead)
    names.push_back(scene().bead_name(bead));
  return names;
}

}  // namespace kds::python
