#include "experiments/trade/measure_trade.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "kds/event.h"
#include "motions/base/interruption.h"
#include "motions/numbers/exact_number.h"
#include "structures/session/parallel_run.h"

namespace kds {

namespace {

/// Converts steps of a setting to times of the finest data.
class Clock {
 public:
  Clock(const Scene& scene, std::size_t stride) : steps_(scene.step_count()), stride_(stride) {}

  [[nodiscard]] std::size_t frame(std::size_t of_setting) const { return of_setting * stride_; }
  /// Returns the time in parts of a frame.
  [[nodiscard]] std::size_t start_of(std::size_t step) const { return frame(step) * parts_of_frame; }
  /// Returns a time as a share of its step, from 0 to 1. The result is exact because strides are powers of
  /// two.
  [[nodiscard]] double time_in(std::size_t step, std::size_t time) const {
    return static_cast<double>(time - start_of(step)) / static_cast<double>(stride_ * parts_of_frame);
  }
  /// The event must have a rounded time, because its bracket is 2^-24 of a step wide.
  [[nodiscard]] double time_of(const Event& event) const {
    const auto from = static_cast<double>(event.from.number), to = static_cast<double>(event.to.number);
    const double u = (event.rounded.value().frame - from) / (to - from);
    return static_cast<double>(frame(event.step)) + static_cast<double>(stride_) * u;
  }
  [[nodiscard]] std::size_t steps() const { return steps_; }

 private:
  std::size_t steps_, stride_;
};

class Recorder final : public EventListener {
 public:
  explicit Recorder(const Clock& clock) : clock_(clock) {}
  void on_event(const Event& event) override {
    if (event.kind.external) events.push_back({clock_.time_of(event), event.change});
  }
  [[nodiscard]] bool prints_time_of(const Event& event) const override { return event.kind.external; }
  std::vector<TimedEvent> events;

 private:
  const Clock& clock_;
};

/// Counts the pairs of spheres that a search for contacts within one hierarchy tests. If the spheres of two
/// nodes meet, the search descends into the node with more beads. Neighbouring beads are not tested.
class SearchCost {
 public:
  explicit SearchCost(std::span<const NodeSphere> nodes) {
    for (const NodeSphere& node : nodes) spheres_[{node.range.first, node.range.last}] = node.sphere;
  }
  std::uint64_t of(const BeadRange& necklace) {
    tests_ = 0;
    within(necklace);
    return tests_;
  }

 private:
  void within(const BeadRange& range) {
    if (range.last <= range.first) return;
    const BeadId middle = range.first + (range.last - range.first) / 2;
    within({range.first, middle});
    within({middle + 1, range.last});
    between({range.first, middle}, {middle + 1, range.last});
  }
  void between(const BeadRange& a, const BeadRange& b) {
    const bool beads = a.first == a.last && b.first == b.last;
    if (beads && b.first == a.first + 1) return;
    ++tests_;
    if (beads || !meet(a, b)) return;
    if (a.last - a.first >= b.last - b.first) {
      const BeadId middle = a.first + (a.last - a.first) / 2;
      between({a.first, middle}, b);
      between({middle + 1, a.last}, b);
    } else {
      const BeadId middle = b.first + (b.last - b.first) / 2;
      between(a, {b.first, middle});
      between(a, {middle + 1, b.last});
    }
  }
  [[nodiscard]] bool meet(const BeadRange& a, const BeadRange& b) const {
    const auto of_a = spheres_.find({a.first, a.last}), of_b = spheres_.find({b.first, b.last});
    if (of_a == spheres_.end() || of_b == spheres_.end()) return true;  // a single bead
    return (of_a->second.center - of_b->second.center).norm() <= of_a->second.radius + of_b->second.radius;
  }

  std::map<std::pair<BeadId, BeadId>, Sphere> spheres_;
  std::uint64_t tests_ = 0;
};

/// The structure of a run at a time.
struct Sample {
  std::size_t time;  ///< in parts of a frame
  std::size_t step;
  double u;  ///< the same time within the step, above 0
  std::vector<NodeSphere> spheres;
  std::optional<CombinatorialElements> cells;  ///< only of power diagrams, and not at frames
};

/// Takes the samples of a part of a run.
class Sampler final : public FrameObserver {
 public:
  Sampler(KineticRun& run, const Clock& clock, const std::set<std::size_t>& times, bool has_cells)
      : run_(run), clock_(clock), times_(times), has_cells_(has_cells) {}

  void in_step(std::size_t step) override {
    in_step_ = step;
    const auto end = times_.lower_bound(clock_.start_of(step + 1));
    for (auto time = times_.upper_bound(clock_.start_of(step)); time != end; ++time) {
      const double u = clock_.time_in(step, *time);
      run_.go_to(static_cast<double>(step) + u);
      take(*time, step, u);
    }
  }
  void at_frame(std::size_t frame) override {
    if (!in_step_ || *in_step_ + 1 != frame)
      return;  // the part begins here, so this frame is of another part
    const std::size_t time = clock_.start_of(frame);
    if (times_.contains(time)) take(time, frame - 1, 1);
  }

  std::deque<Sample> samples;

 private:
  void take(std::size_t time, std::size_t step, double u) {
    Sample& sample = samples.emplace_back(Sample{time, step, u, run_.spheres_at(0, Dyadic(u)), {}});
    if (has_cells_ && time % parts_of_frame != 0) sample.cells = run_.elements(0, step + 1);
  }

  KineticRun& run_;
  const Clock& clock_;
  const std::set<std::size_t>& times_;
  bool has_cells_;
  std::optional<std::size_t> in_step_;  // the last step that was run
};

void raise(std::optional<double>& largest, double value) { largest = std::max(largest.value_or(0), value); }

std::set<std::pair<BeadId, BeadId>> short_edges(const std::vector<std::vector<BeadId>>& cells,
                                                const Eigen::Matrix3Xd& positions, double cutoff) {
  std::set<std::pair<BeadId, BeadId>> edges;
  for (const auto& cell : cells)
    for (std::size_t i = 0; i < cell.size(); ++i)
      for (std::size_t j = i + 1; j < cell.size(); ++j)
        if ((positions.col(cell[i]) - positions.col(cell[j])).norm() < cutoff)
          edges.insert({cell[i], cell[j]});
  return edges;
}

/// Turns edges between beads into edges between their residues.
std::set<std::pair<BeadId, BeadId>> of_residues(const std::set<std::pair<BeadId, BeadId>>& edges,
                                                const CalphaModel& model) {
  std::set<std::pair<BeadId, BeadId>> all;
  for (const auto& [a, b] : edges)
    if (model.of_bead[a] != model.of_bead[b]) all.insert(std::minmax(model.of_bead[a], model.of_bead[b]));
  return all;
}

class Follower {
 public:
  /// If `deviation` is not null, the spheres of the run are enlarged by it.
  Follower(const FinestData& finest, const Scene& scene, const TradeSetting& setting, Truth& truth,
           double cutoff, const StrideDeviation* deviation)
      : calpha_(setting.calpha ? finest.calpha() : nullptr),
        scene_(scene),
        setting_(setting),
        truth_(truth),
        motion_(scene),
        cutoff_(cutoff),
        deviation_(deviation) {}

  /// Compares the run with the truth at the time of a sample.
  void look(Sample sample) {
    InterruptionCheck::ask();
    truth_.move_to(sample.time);
    const Eigen::Matrix3Xd here = motion_.positions(sample.step, sample.u);
    raise(errors.displacement, displacement(here));
    if (setting_.structure == "contacts" && calpha_ == nullptr) look_at_distance(here);
    if (sample.cells) look_at_cells(*sample.cells);
    look_at_spheres(std::move(sample.spheres), sample.time % parts_of_frame == 0);
  }
  void finish() {
    if (nodes_ > 0) {
      errors.radius_mean = sum_of_excess_ / static_cast<double>(nodes_);
      errors.beads_outside = static_cast<double>(beads_outside_) / static_cast<double>(looks_at_spheres_);
    }
    if (nodes_at_frames_ > 0)
      errors.radius_frames_mean = sum_at_frames_ / static_cast<double>(nodes_at_frames_);
    if (cells_ > 0 && calpha_ == nullptr)
      errors.cells_wrong = static_cast<double>(wrong_cells_) / static_cast<double>(cells_);
    if (setting_.structure == "power")
      errors.edges_missed =
          edges_ == 0 ? 0 : static_cast<double>(missed_edges_) / static_cast<double>(edges_);
    if (looks_at_spheres_ > 0)
      tests = static_cast<double>(search_tests_) / static_cast<double>(looks_at_spheres_);
  }

  TradeErrors errors;
  std::optional<double> tests;

 private:
  [[nodiscard]] double displacement(const Eigen::Matrix3Xd& here) const {
    double largest = 0;
    for (Eigen::Index b = 0; b < here.cols(); ++b) {
      const Eigen::Index there =
          calpha_ == nullptr ? b : Eigen::Index{calpha_->bead[static_cast<std::size_t>(b)]};
      largest = std::max(largest, (here.col(b) - truth_.positions().col(there)).norm());
    }
    return largest;
  }
  /// Returns the node with the beads that it must truly contain. A certified run enlarges the node's sphere.
  [[nodiscard]] NodeSphere promised(NodeSphere node) const {
    if (deviation_ != nullptr) {
      const auto of_node =
          std::span(deviation_->of_bead)
              .subspan(node.range.first, std::size_t{node.range.last} - node.range.first + 1);
      node.sphere.radius = std::nextafter(node.sphere.radius + *std::ranges::max_element(of_node),
                                          std::numeric_limits<double>::infinity());
    }
    if (calpha_ != nullptr)
      node.range = {calpha_->residue[node.range.first].first, calpha_->residue[node.range.last].last};
    return node;
  }
  void look_at_spheres(std::vector<NodeSphere> nodes, bool at_frame) {
    if (nodes.empty()) return;
    SearchCost cost(nodes);
    for (NodeSphere& node : nodes) {
      InterruptionCheck::ask();
      node = promised(node);
      const double smallest = truth_.smallest_radius(node.range);
      const double excess = smallest > 0 ? std::abs(node.sphere.radius / smallest - 1) : 0;
      raise(errors.radius_max, excess);
      if (at_frame) {
        sum_at_frames_ += excess;
        ++nodes_at_frames_;
        raise(errors.radius_frames_max, excess);
        continue;
      }
      sum_of_excess_ += excess;
      ++nodes_;
      beads_outside_ += truth_.balls_outside(node);
    }
    if (at_frame) return;
    for (const BeadRange& necklace : scene_.necklaces()) search_tests_ += cost.of(necklace);
    ++looks_at_spheres_;
  }
  void look_at_cells(const CombinatorialElements& elements) {
    std::vector<std::vector<BeadId>> found;
    for (const CombinatorialElement& element : elements.all)
      found.emplace_back(element.begin(),
                         std::find(element.begin() + elements.place_ids, element.end(), no_bead));
    std::sort(found.begin(), found.end());
    const auto& expected = truth_.cells();
    for (const auto& cell : found)
      wrong_cells_ += std::binary_search(expected.begin(), expected.end(), cell) ? 0 : 1;
    cells_ += found.size();
    auto edges = short_edges(expected, truth_.positions(), cutoff_);
    if (calpha_ != nullptr) edges = of_residues(edges, *calpha_);
    const auto known = calpha_ == nullptr ? short_edges(found, truth_.positions(), cutoff_)
                                          : short_edges(found, truth_.positions(), HUGE_VAL);
    edges_ += edges.size();
    for (const auto& edge : edges) missed_edges_ += known.contains(edge) ? 0 : 1;
  }
  void look_at_distance(const Eigen::Matrix3Xd& here) {
    const auto expected = truth_.closest_distance(truth_.positions()), found = truth_.closest_distance(here);
    if (expected && found) raise(errors.closest_distance, std::abs(*found - *expected));
  }

  const CalphaModel* calpha_;  // null if the beads are the beads of the finest data
  const Scene& scene_;
  const TradeSetting& setting_;
  Truth& truth_;
  FollowedMotion motion_;
  double cutoff_;
  const StrideDeviation* deviation_;
  double sum_of_excess_ = 0, sum_at_frames_ = 0;
  std::uint64_t nodes_ = 0, nodes_at_frames_ = 0, beads_outside_ = 0, cells_ = 0, wrong_cells_ = 0,
                edges_ = 0, missed_edges_ = 0;
  std::uint64_t search_tests_ = 0, looks_at_spheres_ = 0;
};

/// Returns the times at which all settings are examined, in parts of a frame: frames of the finest data, and
/// random times between them.
std::set<std::size_t> times_to_look(std::size_t frames, const SamplingOfTimes& sampling) {
  std::set<std::size_t> times;
  std::mt19937_64 random(sampling.seed);
  const std::size_t steps = frames - 1;
  for (std::size_t k = 0; k < sampling.times; ++k) {
    times.insert((1 + k * steps / sampling.times) * parts_of_frame);
    times.insert(random() % steps * parts_of_frame + 1 + random() % (parts_of_frame - 1));
  }
  return times;
}

std::vector<BeadPair> pairs_of(const std::vector<Event>& built) {
  std::vector<BeadPair> pairs;
  for (const Event& event : built) pairs.push_back({event.ids()[0], event.ids()[1]});
  return pairs;
}

}  // namespace

std::vector<std::pair<std::string, std::optional<double>>> by_name(const TradeErrors& errors) {
  return {{"displacement", errors.displacement},
          {"radius_mean", errors.radius_mean},
          {"radius_max", errors.radius_max},
          {"radius_frames_mean", errors.radius_frames_mean},
          {"radius_frames_max", errors.radius_frames_max},
          {"beads_outside", errors.beads_outside},
          {"cells_wrong", errors.cells_wrong},
          {"edges_missed", errors.edges_missed},
          {"events_missed", errors.events_missed},
          {"events_invented", errors.events_invented},
          {"event_time_mean", errors.event_time_mean},
          {"event_time_max", errors.event_time_max},
          {"contacts_missed", errors.contacts_missed},
          {"contacts_spurious", errors.contacts_spurious},
          {"contacts_unsure", errors.contacts_unsure},
          {"sure_wrong", errors.sure_wrong},
          {"contact_time_mean", errors.contact_time_mean},
          {"contact_time_max", errors.contact_time_max},
          {"closest_distance", errors.closest_distance}};
}

namespace {

/// Returns all contacts of the setting's motion with these radii.
std::vector<ContactTime> contacts_with(const FinestData& finest, const TradeSetting& setting,
                                       std::vector<double> radii, std::size_t threads) {
  const Scene scene = finest.scene(setting, std::move(radii));
  const Clock clock(scene, setting.stride);
  ParallelRun run(scene, {{"contacts"}, setting.kernel, AuditMode::none, setting.settings},
                  {.threads = threads});
  Recorder recorder(clock);
  run.listen(recorder);
  std::vector<BeadPair> built;
  run.run([&](std::size_t frame) {
    if (frame == 0) built = pairs_of(run.whole().built(0));
  });
  return contact_times(built, recorder.events, 0, static_cast<double>(clock.frame(clock.steps())));
}

void certify_contacts(const FinestData& finest, const TradeSetting& setting, const Scene& scene,
                      const StrideDeviation& deviation, std::size_t threads, RunHistory& history) {
  const RadiiWithin radii = radii_within(deviation, scene.radii());
  history.contacts = contacts_with(finest, setting, radii.larger, threads);
  history.sure = contacts_with(finest, setting, radii.smaller, threads);
  std::erase_if(history.sure, [&](const ContactTime& contact) {
    return radii.has_a_ball[contact.pair.first] == 0 || radii.has_a_ball[contact.pair.second] == 0;
  });
}

}  // namespace

FollowedRun follow_run(const FinestData& finest, const TradeSetting& setting, Truth& truth,
                       const SamplingOfTimes& sampling, double cutoff, std::size_t threads) {
  const Scene scene = finest.scene(setting);
  const Clock clock(scene, setting.stride);
  const std::set<std::size_t> times = times_to_look(finest.frame_count(), sampling);
  std::optional<StrideDeviation> deviation;
  if (setting.certify) deviation = finest.deviation(setting, scene);
  ParallelRun run(scene, {{setting.structure}, setting.kernel, AuditMode::none, setting.settings},
                  {.threads = threads});
  Recorder recorder(clock);
  run.listen(recorder);
  run.observe([&](KineticRun& part) {
    return std::make_unique<Sampler>(part, clock, times, setting.structure == "power");
  });
  Follower follower(finest, scene, setting, truth, cutoff, deviation ? &*deviation : nullptr);
  std::vector<BeadPair> built;
  run.run([&](std::size_t frame) {
    if (frame == 0) {
      built = pairs_of(run.whole().built(0));
      return;
    }
    auto& samples = dynamic_cast<Sampler&>(*run.observer()).samples;
    for (; !samples.empty() && samples.front().time <= clock.start_of(frame); samples.pop_front())
      follower.look(std::move(samples.front()));
  });
  follower.finish();
  const auto end = static_cast<double>(clock.frame(clock.steps()));
  FollowedRun followed{
      {end, std::move(recorder.events), {}, {}}, follower.errors, follower.tests, run.threads()};
  if (setting.structure == "contacts") {
    followed.history.contacts = contact_times(built, followed.history.events, 0, end);
    if (deviation) certify_contacts(finest, setting, scene, *deviation, threads, followed.history);
  }
  return followed;
}

void compare_histories(const RunHistory& exact, FollowedRun& run, const FinestData& finest,
                       const TradeSetting& setting) {
  const auto share = [](std::uint64_t part, std::uint64_t of) {
    return of == 0 ? (part == 0 ? 0.0 : HUGE_VAL) : static_cast<double>(part) / static_cast<double>(of);
  };
  const auto mean = [](double sum, std::uint64_t of) {
    return of == 0 ? std::optional<double>() : std::optional(sum / static_cast<double>(of));
  };
  // A stride may stop before the last frame.
  RunHistory expected{run.history.end, {}, {}, {}};
  for (const TimedEvent& event : exact.events)
    if (event.time <= expected.end) expected.events.push_back(event);
  for (const ContactTime& contact : exact.contacts)
    if (contact.from <= expected.end)
      expected.contacts.push_back({contact.pair, contact.from, std::min(contact.to, expected.end)});
  TradeErrors& errors = run.errors;
  if (setting.structure == "contacts") {
    if (setting.calpha)
      expected.contacts = finest.calpha()->of_residues(expected.contacts, setting.settings.apart);
    // A certified contact must agree at its exact time, which is known up to a bracket.
    constexpr double at_once = 1e-6;
    const ContactMatch match =
        match_contacts(expected.contacts, run.history.contacts, setting.certify ? at_once : setting.reach());
    // If no true contact of beads is a contact of residues that the model asks about, the model was not
    // tested.
    if (!setting.calpha || match.expected > 0) {
      errors.contacts_missed = share(match.missed, match.expected);
      errors.contacts_spurious = share(match.spurious, match.expected);
    }
    errors.contact_time_mean = mean(match.time_error_sum, match.timed);
    if (match.timed > 0) errors.contact_time_max = match.time_error_max;
    if (setting.certify) {
      const ContactMatch sure = match_contacts(expected.contacts, run.history.sure, at_once);
      errors.contacts_unsure = share(sure.missed, sure.expected);
      errors.sure_wrong = static_cast<double>(sure.spurious);
    }
  }
  if (setting.calpha) return;  // the events concern other beads
  const EventMatch match = match_events(expected.events, run.history.events, setting.reach());
  errors.events_missed = share(match.missed, match.expected);
  errors.events_invented = share(match.invented, match.expected);
  errors.event_time_mean = mean(match.time_error_sum, match.matched);
  if (match.matched > 0) errors.event_time_max = match.time_error_max;
}

}  // namespace kds
