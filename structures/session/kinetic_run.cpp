#include "structures/session/kinetic_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "certificates/exact/exact_time.h"
#include "kds/event_log.h"
#include "kds/kinetic_structure.h"
#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "structures/session/scene_motion.h"

namespace kds {

/// An edit that was made, with its time in the step.
struct KineticRun::MadeEdit {
  Edit edit;
  ExactTime time;
};

/// A bead whose curve the user changed, and the end of its new curve.
struct KineticRun::Bend {
  BeadId bead;
  std::array<double, 3> end;
};

namespace {

PushedFrames without_frames(const SceneMotion::Ref& motion, const BeadsOfMotion& beads) {
  return std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        PushedFrames frames{Dimension, beads.necklaces, beads.radii,
                            ref.is_lifted() ? FrameMotion::lifted : FrameMotion::linear};
        if (frames.necklaces.empty()) frames.necklaces.push_back(ref.bead_count());
        std::size_t count = 0;
        for (const std::size_t of_necklace : frames.necklaces) count += of_necklace;
        if (count != ref.bead_count())
          throw InputError(fmt::format("necklaces of {} beads in all: expected {}, as many as the motion has",
                                       count, ref.bead_count()));
        return frames;
      },
      motion);
}

std::array<double, 3> control_point(const SceneMotion::Ref& motion, BeadId bead, bool last) {
  std::array<double, 3> point{};
  std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        const Curves<Dimension> curves = ref.curves();
        for (int axis = 0; axis < Dimension; ++axis)
          point[static_cast<std::size_t>(axis)] =
              curves.coordinate(bead, last ? curves.own_degree() : 0, axis);
      },
      motion);
  return point;
}

std::string names_of_all() {
  std::string names;
  for (const StructureSpec& spec : structure_registry().all())
    names += (names.empty() ? "" : ", ") + spec.name;
  return names;
}

}  // namespace

KineticRun::KineticRun(PushedFrames frames, const KineticRunOptions& options)
    : own_scene_(std::make_unique<Scene>(std::move(frames))), scene_(*own_scene_), options_(options) {
  make();
}

KineticRun::KineticRun(const Scene& scene, const KineticRunOptions& options)
    : scene_(scene), options_(options) {
  make();
}

KineticRun::KineticRun(const SceneMotion::Ref& motion, const BeadsOfMotion& beads,
                       const KineticRunOptions& options)
    : own_scene_(std::make_unique<Scene>(without_frames(motion, beads))),
      scene_(*own_scene_),
      motion_(motion),
      options_(options) {
  make();
}

KineticRun::~KineticRun() = default;

KineticRun::KineticRun(const Scene& scene, const SceneMotion::Ref& motion, const KineticRunOptions& options)
    : scene_(scene), motion_(motion), options_(options) {
  make();
}

void KineticRun::make() {
  kinetic_.clear();
  running_.clear();
  simulator_ = std::make_unique<Simulator>(options_.audits, options_.kernel);
  if (!motion_) scene_motion_ = make_scene_motion(scene_);
  ref_ = motion_ ? *motion_ : scene_motion_->ref();
  make_by_name();
  for (const auto& addition : additions_) addition();
  simulator().exact_work().set_limit(most_work_);
  if (work_watcher_) simulator().exact_work().set_watcher(work_watcher_, watch_every_);
  built_ = loaded_ = within_ = finished_ = false;
  bends_.clear();
}

void KineticRun::plan(std::function<void()> addition) {
  if (built_) throw std::logic_error("structures are chosen before the first step is run");
  addition();
  additions_.push_back(std::move(addition));
}

void KineticRun::make_by_name() {
  const FloatingPointScope to_nearest;
  std::vector<std::string> names =
      options_.structures.empty() && options_.by_default ? default_structures(scene_) : options_.structures;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const StructureSpec* spec = structure_registry().find(names[i]);
    if (spec == nullptr)
      throw StructureRefusal(names[i], "there is no such structure; expected " + names_of_all());
    if (const auto reason = spec->refusal(scene_)) throw StructureRefusal(names[i], *reason);
    if (!spec->stands_on.empty()) names.push_back(spec->stands_on);
  }
  const auto is_named = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& [name, beads] : options_.only)
    if (!is_named(name)) throw StructureRefusal(name, "is to be of some beads only, and is not in the run");
  for (const StructureSpec& spec : structure_registry().all()) {  // in the registry's order
    if (!is_named(spec.name)) continue;
    StructureSettings settings = options_.settings;
    if (!spec.stands_on.empty()) {
      settings.base = find_made(spec.stands_on);
      if (settings.base == nullptr)
        throw std::logic_error(spec.name + " is made before " + spec.stands_on + ", on which it stands");
    }
    add_made(spec.make(simulator(), scene_, *ref_, settings));
    if (const auto only = options_.only.find(spec.name); only != options_.only.end())
      leave_out_others(running_.size() - 1, only->second);
  }
}

KineticStructure* KineticRun::find_made(std::string_view name) const {
  const auto found = std::find_if(kinetic_.begin(), kinetic_.end(),
                                  [&](const KineticStructure* made) { return made->name() == name; });
  return found == kinetic_.end() ? nullptr : *found;
}

void KineticRun::add_made(std::unique_ptr<RunningStructure> structure) {
  if (structure == nullptr)
    throw StructureRefusal("a structure", "its type is not made for motions in " +
                                              std::to_string(scene_.dimension()) + " dimensions");
  running_.push_back(std::move(structure));
  kinetic_.push_back(&running_.back()->kinetic());
}

void KineticRun::leave_out_others(std::size_t structure, std::span<const BeadId> beads) {
  require_index("structure", structure, kinetic_.size());
  KineticStructure& kept = *kinetic_[structure];
  const std::string name(kept.name());
  BeadEdits* const edits = edits_of(kept);
  if (edits == nullptr) throw StructureRefusal(name, "is of all beads; it cannot be of some only");
  std::vector<char> among(scene_.bead_count(), 0);
  for (const BeadId bead : beads) {
    if (bead >= among.size()) throw StructureRefusal(name, no_such_index("bead", bead, among.size()));
    if (edits->is_absent(bead))
      throw StructureRefusal(name, "bead " + std::to_string(bead) + " is left out already");
    among[bead] = 1;
  }
  for (BeadId bead = 0; bead < among.size(); ++bead)
    if (among[bead] == 0 && !edits->is_absent(bead)) edits->leave_out(bead);
}

void KineticRun::listen(EventListener& listener) {
  listeners_.push_back(&listener);
  simulator().listen(listener);
}

void KineticRun::limit_work(std::uint64_t most) {
  most_work_ = most;
  simulator().exact_work().set_limit(most);
}

void KineticRun::watch_work(std::function<void()> watcher, std::uint64_t every) {
  work_watcher_ = std::move(watcher);
  watch_every_ = every;
  simulator().exact_work().set_watcher(work_watcher_, every);
}

bool KineticRun::can_enter() const { return !finished_ && (motion_ || scene_.has_step(simulator_->step())); }

/// Sets the motion to the next step. A motion that the user sets is checked each time, because the user may
/// have changed it.
void KineticRun::load() {
  if (motion_) return check_radii();
  if (loaded_) return;
  const FloatingPointScope to_nearest;
  const std::size_t step = simulator().step();
  scene_motion_->load(step);
  simulator().set_frames(scene_.stamp(step), scene_.stamp(step + 1));
  loaded_ = true;
}

void KineticRun::build() {
  if (built_) return;
  if (!can_enter()) throw std::logic_error("build(): the first step is not known; push another frame first");
  load();
  simulator().build();
  built_ = true;
}

bool KineticRun::load_step() {
  if (within_) return true;
  if (!can_enter()) return false;
  load();
  return true;
}

void KineticRun::enter() {
  build();
  load();
  check_bends();
  simulator().enter_step();
  bends_.clear();
  within_ = true;
}

void KineticRun::leave() {
  simulator().leave_step();
  within_ = loaded_ = false;
}

/// Checks that the motion has the radii given at the start, on which spheres and contacts rely.
void KineticRun::check_radii() const {
  if (!scene_.has_radii()) return;
  std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& ref) {
        const Curves<Dimension> curves = ref.curves();
        for (BeadId bead = 0; bead < curves.bead_count(); ++bead) {
          for (int k = 0; k <= curves.own_degree(); ++k) {
            if (curves.radius(bead, k) != scene_.radii()[bead])
              throw InputError(
                  fmt::format("bead {}: its radius is {} in the motion, expected {}, as was said", bead,
                              curves.radius(bead, k), scene_.radii()[bead]));
          }
        }
      },
      *motion_);
}

/// Checks that each curve changed in the previous step ends where the next step begins, because structures
/// continue from there.
void KineticRun::check_bends() const {
  for (const Bend& bend : bends_) {
    if (control_point(scene_motion_->ref(), bend.bead, false) != bend.end)
      throw InputError(
          fmt::format("bead {}: its course was changed in step {}, and does not end where frame {} has it",
                      bend.bead, simulator_->step() - 1, simulator_->step()));
  }
}

void KineticRun::take(std::span<const double> coordinates, std::optional<double> picoseconds,
                      const std::optional<Cell>& cell) {
  if (!own_scene_ || motion_) throw std::logic_error("a frame is pushed to a run that has a motion already");
  run();
  own_scene_->push(coordinates, picoseconds, cell);
}

void KineticRun::push(std::span<const double> coordinates, std::optional<double> picoseconds,
                      const std::optional<Cell>& cell) {
  take(coordinates, picoseconds, cell);
  run();
}

bool KineticRun::enter_step() {
  if (within_) return true;
  if (!can_enter()) return false;
  enter();
  return true;
}

bool KineticRun::run_step() {
  if (!enter_step()) return false;
  leave();
  return true;
}

void KineticRun::run() {
  if (motion_) throw std::logic_error("over a motion that its user sets, each step is run by run_step()");
  while (run_step()) {
  }
}

bool KineticRun::next_event() {
  while (within_ || can_enter()) {
    if (!within_) {
      const std::uint64_t before = changes_made();
      enter();
      if (changes_made() != before) return true;  // a change at the frame is the next event
    }
    if (simulator().run_next()) return true;
    leave();
    if (motion_) return false;
  }
  return false;
}

std::uint64_t KineticRun::changes_made() const {
  std::uint64_t changes = 0;
  for (const KineticStructure* structure : structures())
    for (const std::uint64_t of_kind : structure->statistics.events_by_kind) changes += of_kind;
  return changes;
}

void KineticRun::finish() {
  if (finished_) return;
  if (own_scene_) own_scene_->end_frames();
  if (within_) leave();
  if (!motion_) run();
  if (built_) simulator().finish();
  finished_ = true;
}

void KineticRun::audit_now() {
  if (!built_) throw std::logic_error("audit_now(): run a step or call build() first");
  simulator().audit_now();
}

bool KineticRun::is_past(double time) {
  const double u = time - static_cast<double>(simulator().step());
  if (!within_ || !(u >= 0 && u < 1)) return u < 0;
  ExactTime there{Dyadic(u)};
  return ExactTime::compare(there, simulator().now().exact()) < 0;
}

void KineticRun::go_to(double time) {
  if (scene_.is_live()) {  // runs each step as its frames come
    while (static_cast<double>(simulator().step() + 1) <= time && run_step()) {
    }
    if (time > static_cast<double>(simulator().step()))
      static_cast<void>(scene_.has_step(simulator().step()));
  }
  const std::size_t present = simulator().step();
  const auto last = static_cast<double>(!motion_ ? scene_.known_steps() : finished_ ? present : present + 1);
  if (!(time >= 0 && time <= last))
    throw std::invalid_argument(
        fmt::format("time {}: expected one from 0 to {}, where the steps that are known end", time, last));
  const auto step = static_cast<std::size_t>(time);
  const double u = time - static_cast<double>(step);
  ExactTime there{Dyadic(u)};
  if (!is_past(time)) return go_on_to(step, u);
  if (own_scene_ || scene_.is_live() || !built_)
    throw std::invalid_argument(
        fmt::format("time {}: the run is past it, and its steps are not kept; expected a later one", time));
  make();
  struct TellAgain {  // listeners are not notified of events before that time
    KineticRun& run;
    ~TellAgain() {
      for (EventListener* listener : run.listeners_) run.simulator().listen(*listener);
    }
  } const tell_again{*this};
  for (MadeEdit& made : std::exchange(edits_, {})) {
    const std::size_t of_edit = made.edit.step;
    if (of_edit > step || (of_edit == step && ExactTime::compare(there, made.time) < 0)) break;
    repeat(made.edit);
  }
  go_on_to(step, u);
}

void KineticRun::run_to(std::size_t step) {
  while (simulator().step() < step)
    if (!run_step()) throw std::logic_error(fmt::format("step {} lies after the last step", step));
}

/// Runs to time u of the step. Enters the step unless u is 0.
void KineticRun::go_on_to(std::size_t step, double u) {
  run_to(step);
  if (u == 0) return;
  if (!within_) enter();
  simulator().run_until(Dyadic(u));
}

/// Makes an edit now, and keeps it for the case that the run goes back.
void KineticRun::make_edit(Edit edit) {
  if (edit.kind == Edit::Kind::change) {
    const auto set = [&edit](SceneMotion& motion) { set_coordinates(motion, edit.beads, edit.coordinates); };
    {
      TrialCourses trial(editable_motion(), edit.beads);
      set(trial);  // if this throws, nothing has changed
    }
    simulator().make_edit(edit, [&] { simulator().change_motion(edit.beads, [&] { set(*scene_motion_); }); });
    for (const BeadId bead : edit.beads) {
      std::erase_if(bends_, [bead](const Bend& bend) { return bend.bead == bead; });
      bends_.push_back({bead, control_point(scene_motion_->ref(), bead, true)});
    }
  } else {
    BeadEdits& structure = editable(edit.structure);
    const BeadId bead = edit.beads.at(0);
    simulator().make_edit(
        edit, [&] { edit.kind == Edit::Kind::insert ? structure.insert(bead) : structure.erase(bead); });
  }
  if (!own_scene_) edits_.push_back({std::move(edit), simulator().now().exact()});
}

void KineticRun::repeat(const Edit& edit) {
  const auto repeated = [&] {
    run_to(edit.step);
    if (!within_) enter();
    if (edit.after_failure) {
      ExactTime time(edit.time);
      if (ExactTime::compare(time, simulator().now().exact()) < 0)
        throw std::invalid_argument("the run is past the time of this edit");
      while (simulator().run_next(&edit.time)) continue;
    } else {
      simulator().run_until(edit.time);
    }
    make_edit(edit);
  };
  if (edit.where.empty()) return repeated();
  try {
    repeated();
  } catch (const std::invalid_argument& reason) {
    throw InputError(edit.where + ": " + reason.what());
  } catch (const StructureRefusal& reason) {
    throw InputError(edit.where + ": " + reason.what());
  }
}

BeadEdits& KineticRun::editable(std::size_t structure) const {
  require_index("structure", structure, structures().size());
  KineticStructure& edited = *structures()[structure];
  if (BeadEdits* const edits = edits_of(edited)) return *edits;
  throw StructureRefusal(std::string(edited.name()), "its beads cannot come and go");
}

SceneMotion& KineticRun::editable_motion() const {
  if (motion_)
    throw std::logic_error("over a motion that its user sets, Simulator::change_motion changes courses");
  simulator_->require_standing_still();
  return *scene_motion_;
}

void KineticRun::insert(std::size_t structure, BeadId bead) {
  make_edit({Edit::Kind::insert, structure, {bead}});
}

void KineticRun::erase(std::size_t structure, BeadId bead) {
  make_edit({Edit::Kind::erase, structure, {bead}});
}

void KineticRun::change_motion(std::vector<BeadId> beads,
                               const std::function<void(SceneMotion&)>& set_curves) {
  std::vector<double> coordinates;
  {
    TrialCourses trial(editable_motion(), beads);
    set_curves(trial);
    coordinates = coordinates_of(trial, beads);
  }
  change_motion(std::move(beads), std::move(coordinates));
}

void KineticRun::change_motion(std::vector<BeadId> beads, std::vector<double> coordinates) {
  make_edit({Edit::Kind::change, 0, std::move(beads), std::move(coordinates)});
}

std::vector<Event> KineticRun::built(std::size_t structure) const {
  require_index("structure", structure, kinetic_.size());
  std::vector<Event> events;
  const KineticStructure& of = *kinetic_[structure];
  const FrameStamp first = scene_.stamp(0);
  for (const Change& change : running_[structure]->built())
    events.push_back({0, 0, 0, structure, change, of.name(), of.kinds()[change.kind], first, first, {}});
  return events;
}

std::vector<DumpFile> KineticRun::dump(std::size_t frame) const {
  const FloatingPointScope to_nearest;
  require_index("frame", frame, scene_.frame_count());
  std::vector<DumpFile> files;
  for (const auto& structure : running_) {
    for (DumpFile& file : structure->dump(frame)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<NodeSphere> KineticRun::spheres_at(std::size_t structure, const Dyadic& u) const {
  const FloatingPointScope to_nearest;
  require_index("structure", structure, running_.size());
  return running_[structure]->spheres_at(u);
}

std::optional<CombinatorialElements> KineticRun::elements(std::size_t structure, std::size_t frame) const {
  const FloatingPointScope to_nearest;
  require_index("structure", structure, running_.size());
  require_index("frame", frame, scene_.frame_count());
  return running_[structure]->elements(frame);
}

void KineticRun::follow_certificates() {
  for (const auto& structure : running_) structure->follow_certificates();
}

void KineticRun::count_certificates(std::size_t structure, std::span<const BeadId> changed) {
  require_index("structure", structure, running_.size());
  running_[structure]->count_certificates(changed);
}

void KineticRun::time_static_builds(std::size_t frame, std::vector<double>& seconds) const {
  const FloatingPointScope to_nearest;
  require_index("frame", frame, scene_.frame_count());
  seconds.resize(running_.size(), 0);
  for (std::size_t s = 0; s < running_.size(); ++s) seconds[s] += running_[s]->static_seconds(frame);
}

}  // namespace kds
