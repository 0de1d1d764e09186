#include "experiments/voids/follow_voids.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "experiments/run/load_scene.h"
#include "experiments/run/run_scene.h"
#include "kds/event.h"
#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "structures/dual_complex/dual_topology.h"
#include "structures/dual_complex/union_measures.h"
#include "structures/dual_complex/zigzag_persistence.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

using Topology = DualTopology<3>;
using Number = Topology::Number;

/// The complex as a zigzag filtration: its lines and, if they are asked for, the lives of tunnels.
class Zigzag {
 public:
  Zigzag(std::string* text, bool with_tunnels) : text_(text), with_tunnels_(with_tunnels) {}

  void add(bool inserts, std::span<const BeadId> beads, const VoidMoment& at, bool is_start = false) {
    ++lines_;
    if (text_ != nullptr)
      fmt::format_to(std::back_inserter(*text_), "{} {}\n", inserts ? 'i' : 'd', fmt::join(beads, " "));
    if (!with_tunnels_) return;
    SimplexBeads simplex;
    simplex.fill(no_bead);
    std::copy(beads.begin(), beads.end(), simplex.begin());
    persistence_.add(inserts, simplex);
    ends_.push_back(is_start ? VoidEnd{at, "start", {}}
                             : VoidEnd{at, inserts ? "begin" : "end", {beads.begin(), beads.end()}});
    times_.push_back(time_);
  }
  /// Call this after all changes at one time were added.
  void end_time() { ++time_; }
  [[nodiscard]] std::size_t lines() const { return lines_; }
  /// Returns the tunnels that last at least `persistence`. `last` becomes the end of the tunnels that still
  /// exist at the last frame.
  [[nodiscard]] std::vector<ClosedStretch> tunnels(double persistence, const VoidEnd& last,
                                                   const std::vector<TopologyAtFrame>& frames) const {
    std::vector<ZigzagPersistence::Interval> intervals = persistence_.intervals(1);
    std::sort(intervals.begin(), intervals.end(),
              [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::vector<ClosedStretch> tunnels;
    for (const auto& interval : intervals) {
      const bool lasts = interval.end >= lines_;
      ClosedStretch tunnel{0, ends_[interval.begin], lasts ? last : ends_[interval.end]};
      if (!lasts && times_[interval.begin] == times_[interval.end]) continue;
      const auto frame = std::upper_bound(
          frames.begin(), frames.end(), interval.begin,
          [](std::size_t line, const TopologyAtFrame& one) { return line < one.zigzag_lines; });
      tunnel.is_seen = frame != frames.end() && frame->zigzag_lines <= interval.end;
      if (tunnel.length() >= persistence) tunnels.push_back(std::move(tunnel));
    }
    return tunnels;
  }

 private:
  std::string* text_;
  bool with_tunnels_;
  std::size_t lines_ = 0;
  ZigzagPersistence persistence_;
  std::vector<VoidEnd> ends_;       // the time and the simplex of each line
  std::vector<std::size_t> times_;  // the number of the time of each line
  std::size_t time_ = 0;
};

/// Keeps the events of voids until they are handled, and writes those of the complex.
class VoidEvents final : public EventListener {
 public:
  explicit VoidEvents(Zigzag& zigzag) : zigzag_(zigzag) {}

  void on_event(const Event& event) override {
    if (event.structure == "voids") events.push_back(event);
    if (event.structure == "dual") {
      const int dimension = event.change.size - 1;
      const bool begins = event.change.kind == DualComplex<3>::begins(dimension);
      zigzag_.add(begins, event.ids(), {event.frame(), event.picoseconds()});
    }
  }
  [[nodiscard]] bool prints_time_of(const Event& event) const override {
    return event.structure == "voids" && is_of_void(event.change.kind);
  }
  [[nodiscard]] static bool is_of_void(std::uint8_t kind) {
    return kind >= Topology::void_begin && kind <= Topology::void_close;
  }

  std::vector<Event> events;

 private:
  Zigzag& zigzag_;
};

/// Follows cavities from the events of the topology.
class CavityFollower {
 public:
  explicit CavityFollower(const Topology& topology) : topology_(topology) {}

  void begin(const VoidMoment& start) {
    for (const auto& [number, cells] : topology_.voids()) {
      cavity_of_[number] = add(number, {start, "start", {}});
      note_beads(number, cells);
    }
  }
  /// Follows the events at one time, after all of them were made.
  void follow(const std::vector<Event>& events) {
    const auto voids = topology_.voids();
    for (const Event& event : events) {
      if (!VoidEvents::is_of_void(event.change.kind)) continue;
      const auto ids = event.ids();
      const VoidMoment at{event.frame(), event.picoseconds()};
      switch (event.change.kind) {
        case Topology::void_begin:
          cavity_of_[ids[0]] = add(ids[0], {at, "begun", beads_from(ids, 1)});
          break;
        case Topology::void_end:
          end(ids[0], {at, "filled", beads_from(ids, 1)});
          break;
        case Topology::void_merge:
          end(ids[1], {at, "merged", beads_from(ids, 2)});
          break;
        case Topology::void_split:
          cavity_of_[ids[1]] = add(ids[1], {at, "split", beads_from(ids, 2)});
          break;
        case Topology::void_open:
          open_.emplace(cavity_of_.at(ids[0]), beads_now_[ids[0]]);
          end(ids[0], {at, "opened", beads_from(ids, 1)});
          break;
        default:
          close(ids[0], {at, "closed", beads_from(ids, 1)}, voids);
      }
    }
    for (const auto& [number, cells] : voids) note_beads(number, cells);
  }
  void finish(const VoidMoment& last) {
    while (!cavity_of_.empty()) end(cavity_of_.begin()->first, {last, "last frame", {}});
  }
  /// Measures the voids at a frame.
  void measure(std::size_t frame, const Eigen::Matrix3Xd& centers, const std::vector<double>& radii,
               TopologyAtFrame& at) {
    for (auto& [number, cells] : topology_.complement_cells()) {
      const ComplementMeasures measured = measure_complement(centers, radii, cells);
      if (!std::isfinite(measured.volume)) throw InputError("the volume of a void is too large for a double");
      double area = 0;
      for (const auto& [bead, of_bead] : measured.areas) area += of_bead;
      const double volume = std::max(0.0, measured.volume);  // a void that has just closed may be a point
      Cavity& cavity = cavities_[cavity_of_.at(number)];
      cavity.samples.push_back({frame, volume, std::max(0.0, area)});
      cavity.stretches.back().is_seen = true;
      at.volume += volume;
    }
  }
  [[nodiscard]] std::vector<Cavity> take() { return std::move(cavities_); }

 private:
  static std::vector<BeadId> beads_from(std::span<const BeadId> ids, std::size_t first) {
    return {ids.begin() + static_cast<std::ptrdiff_t>(first), ids.end()};
  }
  static std::set<BeadId> beads_of(const std::vector<SimplexBeads>& cells) {
    std::set<BeadId> beads;
    for (const SimplexBeads& cell : cells) beads.insert(cell.begin(), cell.end());
    return beads;
  }
  std::size_t add(Number number, VoidEnd begin) {
    cavities_.push_back({{{number, std::move(begin), {}}}, {}, {}});
    return cavities_.size() - 1;
  }
  void note_beads(Number number, const std::vector<SimplexBeads>& cells) {
    const std::set<BeadId>& beads = beads_now_[number] = beads_of(cells);
    cavities_[cavity_of_.at(number)].beads.insert(beads.begin(), beads.end());
  }
  void end(Number number, VoidEnd how) {
    const auto found = cavity_of_.find(number);
    cavities_[found->second].stretches.back().end = std::move(how);
    cavity_of_.erase(found);
    beads_now_.erase(number);
  }
  void close(Number number, VoidEnd how, const std::map<Number, std::vector<SimplexBeads>>& voids) {
    const auto cells = voids.find(number);
    const std::set<BeadId> beads = cells == voids.end() ? std::set<BeadId>() : beads_of(cells->second);
    auto best = open_.end();
    double most = 0.5;  // the least share that counts
    for (auto entry = open_.begin(); entry != open_.end(); ++entry) {
      const auto common = static_cast<double>(std::count_if(
          beads.begin(), beads.end(), [&](BeadId bead) { return entry->second.contains(bead); }));
      const double all = static_cast<double>(beads.size() + entry->second.size()) - common;
      if (common < most * all || common == 0) continue;
      most = common / all;
      best = entry;
    }
    if (best == open_.end()) {
      cavity_of_[number] = add(number, std::move(how));
      return;
    }
    cavity_of_[number] = best->first;
    cavities_[best->first].stretches.push_back({number, std::move(how), {}});
    open_.erase(best);
  }

  const Topology& topology_;
  std::vector<Cavity> cavities_;
  std::map<Number, std::size_t> cavity_of_;       // of each void
  std::map<Number, std::set<BeadId>> beads_now_;  // around each void
  std::map<std::size_t, std::set<BeadId>> open_;  // cavities that are open, with their beads when they opened
};

/// Bridges openings shorter than `persistence`, and leaves out cavities without a stretch of this length.
void keep_persistent(std::vector<Cavity>& cavities, double persistence, VoidsReport& report) {
  for (Cavity& cavity : cavities) {
    report.all.insert(report.all.end(), cavity.stretches.begin(), cavity.stretches.end());
    std::vector<ClosedStretch> bridged;
    double longest = 0;
    for (ClosedStretch& stretch : cavity.stretches) {
      if (!bridged.empty() && stretch.begin.at.clock() - bridged.back().end.at.clock() < persistence) {
        bridged.back().end = std::move(stretch.end);
        bridged.back().is_seen |= stretch.is_seen;
      } else {
        bridged.push_back(std::move(stretch));
      }
      longest = std::max(longest, bridged.back().length());
    }
    cavity.stretches = std::move(bridged);
    if (longest < persistence) {
      ++report.short_ones;
    } else {
      report.cavities.push_back(std::move(cavity));
    }
  }
}

}  // namespace

VoidsReport follow_voids(const VoidsTask& task, bool keep_zigzag,
                         const std::function<void(std::size_t, std::size_t)>& progress,
                         const std::function<void(const std::string&)>& warn) {
  VoidsReport report;
  bool lone_frame = false;
  report.scene = std::make_unique<const Scene>(load_union(task, "kds voids", warn, &lone_frame));
  const Scene& scene = *report.scene;
  if (!lone_frame) require_ascending_times(task, scene);
  const std::size_t steps = lone_frame ? 0 : scene.step_count();
  report.unit = length_unit(task);
  std::vector<double> radii = scene.radii();
  for (double& radius : radii) radius += scene.probe();

  KineticRun run(scene, {{"voids"}});
  watch_exact_work(run.simulator(), scene, warn);
  Zigzag zigzag(keep_zigzag ? &report.zigzag : nullptr, task.tunnels);
  VoidEvents heard(zigzag);
  run.listen(heard);
  run.build();
  const auto& topology = run.structure<Topology>(run.structures().size() - 1);
  const auto& complex = run.structure<DualComplex<3>>(run.structures().size() - 2);
  if (!complex.knows_faces())
    warn(
        "all beads of the first frame lie in one plane, where the diagram has no cells: its Betti numbers "
        "are "
        "given as 0, and voids are followed from just after it");
  CavityFollower follower(topology);
  const auto moment = [&](std::size_t frame) {
    const FrameStamp stamp = scene.stamp(frame);
    return VoidMoment{static_cast<double>(stamp.number), stamp.picoseconds};
  };
  for (int dimension = 0; dimension <= 3; ++dimension)
    for (const SimplexBeads& simplex : complex.simplices(dimension))
      zigzag.add(true, std::span(simplex).first(static_cast<std::size_t>(dimension) + 1), moment(0), true);
  const auto at_frame = [&](std::size_t frame) {
    TopologyAtFrame& at =
        report.frames.emplace_back(TopologyAtFrame{moment(frame), topology.betti(), 0, zigzag.lines()});
    follower.measure(frame, scene.centers(frame), radii, at);
    progress(frame, steps);
  };
  const auto follow_events = [&] {
    bool any_of_voids = false;
    for (const Event& event : heard.events) {
      report.tunnels_begun += event.change.kind == Topology::tunnel_begin ? 1 : 0;
      report.tunnels_ended += event.change.kind == Topology::tunnel_end ? 1 : 0;
      any_of_voids |= event.change.kind >= Topology::void_begin && event.change.kind <= Topology::cell_end;
    }
    if (any_of_voids) follower.follow(heard.events);
    heard.events.clear();
    zigzag.end_time();
  };
  report.has_times = moment(0).picoseconds.has_value() && moment(steps).picoseconds.has_value();
  follower.begin(moment(0));
  at_frame(0);
  zigzag.end_time();  // keeps the tunnels of the first frame that end right there
  for (std::size_t step = 0; step < steps; ++step) {
    InterruptionCheck::ask();
    run.enter_step();
    do {
      follow_events();
    } while (run.simulator().run_next());
    run.run_step();
    follow_events();
    at_frame(step + 1);
  }
  follower.finish(moment(steps));
  std::vector<Cavity> cavities = follower.take();
  const double persistence = lone_frame ? 0 : task.persistence;
  keep_persistent(cavities, persistence, report);
  if (task.tunnels)
    report.tunnels = zigzag.tunnels(persistence, {moment(steps), "last frame", {}}, report.frames);
  return report;
}

}  // namespace kds
