#include "experiments/contacts/certify_contacts.h"

#include <algorithm>
#include <array>
#include <compare>
#include <memory>
#include <optional>

#include "experiments/run/certify_stride.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

/// The source of an interval: a run with shrunk, own or enlarged balls, or a frame within an interval.
enum class Source : std::uint8_t { shrunk, own, enlarged, frame };

/// A step and a parameter in it, below 1.
struct StepMoment {
  std::size_t step = 0;
  double u = 0;
  friend auto operator<=>(const StepMoment&, const StepMoment&) = default;
};

StepMoment step_moment(std::size_t step, double u) {
  return u < 1 ? StepMoment{step, u} : StepMoment{step + 1, 0};
}

/// An interval that is sorted by pair, by source, and by its number in the source.
struct NumberedInterval {
  std::uint64_t pair = 0;
  Source source = Source::own;
  std::size_t number = 0;       // among all intervals of the source
  StepMoment earliest, latest;  // bounds of its begin and of its end
  double length = 0;

  friend bool operator<(const NumberedInterval& a, const NumberedInterval& b) {
    if (a.pair != b.pair) return a.pair < b.pair;
    return a.source != b.source ? a.source < b.source : a.number < b.number;
  }
};

/// Sharpens the bounds of disjoint intervals, which stand in their order. Both bounds then ascend.
void sharpen(std::vector<NumberedInterval>& intervals) {
  for (std::size_t k = 1; k < intervals.size(); ++k)
    intervals[k].earliest = std::max(intervals[k].earliest, intervals[k - 1].earliest);
  for (std::size_t k = intervals.size(); k > 1; --k)
    intervals[k - 2].latest = std::min(intervals[k - 2].latest, intervals[k - 1].latest);
}

/// Returns the only interval that may contain `inner`, or null if several may.
const NumberedInterval* container_of(const NumberedInterval& inner,
                                     const std::vector<NumberedInterval>& all) {
  const auto first = std::partition_point(
      all.begin(), all.end(), [&](const NumberedInterval& one) { return one.latest < inner.earliest; });
  if (first == all.end() || inner.latest < first->earliest) return nullptr;
  const auto second = first + 1;
  return second == all.end() || inner.latest < second->earliest ? &*first : nullptr;
}

/// Marks each interval of `all` that certainly contains one of `inner`. Marks stand at their numbers.
void mark_containers(const std::vector<NumberedInterval>& inner, const std::vector<NumberedInterval>& all,
                     std::vector<std::uint8_t>& marks) {
  for (const NumberedInterval& one : inner)
    if (const NumberedInterval* const container = container_of(one, all)) marks[container->number] = 1;
}

std::uint64_t marked(const std::vector<NumberedInterval>& intervals, const std::vector<std::uint8_t>& marks) {
  std::uint64_t count = 0;
  for (const NumberedInterval& one : intervals) count += marks[one.number];
  return count;
}

/// Returns the first frame used within an interval, or nothing if there is none.
std::optional<std::size_t> frame_within(const ContactInterval& interval) {
  const std::size_t frame = (interval.begin.tick_after() + ticks_per_frame - 1) / ticks_per_frame;
  return frame * ticks_per_frame <= interval.end.tick_before() ? std::optional(frame) : std::nullopt;
}

class ContactBounder {
 public:
  explicit ContactBounder(ContactsCertificate& certificate) : certificate_(certificate) {}

  /// Adds an interval. Intervals of one pair come in their order.
  void add(Source source, const ContactInterval& interval) {
    add(source, interval, step_moment(interval.begin.step, interval.begin.lower),
        step_moment(interval.end.step, interval.end.upper), interval.length());
  }
  /// If a frame lies in an interval within the inner cutoff, adds the time of this frame.
  void add_frame(const ContactInterval& interval) {
    if (const auto frame = frame_within(interval)) add(Source::frame, interval, {*frame, 0}, {*frame, 0}, 0);
  }

  void finish() {
    certificate_.is_sure.assign(counts_[static_cast<std::size_t>(Source::own)], 0);
    certificate_.is_found.assign(counts_[static_cast<std::size_t>(Source::enlarged)], 0);
    is_certain_.assign(certificate_.is_found.size(), 0);
    std::optional<std::uint64_t> pair;
    std::sort(all_.begin(), all_.end());
    for (const NumberedInterval& interval : all_) {
      if (pair && *pair != interval.pair) finish_pair(*pair);
      pair = interval.pair;
      of_pair_[static_cast<std::size_t>(interval.source)].push_back(interval);
    }
    if (pair) finish_pair(*pair);
  }

 private:
  void add(Source source, const ContactInterval& interval, const StepMoment& earliest,
           const StepMoment& latest, double length) {
    const std::size_t number = counts_[static_cast<std::size_t>(source)]++;
    all_.push_back(
        {(std::uint64_t{interval.first} << 32U) | interval.second, source, number, earliest, latest, length});
  }

  void finish_pair(std::uint64_t pair) {
    for (auto& intervals : of_pair_) sharpen(intervals);
    const auto& [shrunk, own, enlarged, frames] = of_pair_;
    ContactBoundsOfPair bounds;
    for (const NumberedInterval& one : shrunk) bounds.least_time += one.length;
    for (const NumberedInterval& one : enlarged) bounds.most_time += one.length;
    for (const auto* certain : {&shrunk, &frames}) {
      mark_containers(*certain, own, certificate_.is_sure);
      mark_containers(*certain, enlarged, is_certain_);
    }
    mark_containers(own, enlarged, certificate_.is_found);
    bounds.sure = marked(own, certificate_.is_sure);
    bounds.least = marked(enlarged, is_certain_);
    certificate_.pairs[{static_cast<std::uint32_t>(pair >> 32U), static_cast<std::uint32_t>(pair)}] = bounds;
    certificate_.sure_pairs += bounds.sure > 0 ? 1 : 0;
    ContactBoundsOfPair& all = certificate_.all;
    all.sure += bounds.sure;
    all.least += bounds.least;
    all.least_time += bounds.least_time;
    all.most_time += bounds.most_time;
    for (auto& intervals : of_pair_) intervals.clear();
  }

  ContactsCertificate& certificate_;
  std::vector<NumberedInterval> all_;
  std::array<std::size_t, 4> counts_{};                   // number of intervals so far, by Source
  std::array<std::vector<NumberedInterval>, 4> of_pair_;  // the present pair's intervals, by Source
  std::vector<std::uint8_t> is_certain_;  // for each interval of enlarged balls: a true contact lies in it
};

/// Returns `groups` without the beads that have no ball.
BeadGroups without_empty_balls(BeadGroups groups, const std::vector<std::uint8_t>& has_a_ball) {
  constexpr std::uint8_t both = 3;
  if (groups.empty()) groups.assign(has_a_ball.size(), both);
  for (std::size_t bead = 0; bead < groups.size(); ++bead)
    if (has_a_ball[bead] == 0) groups[bead] = 0;
  return groups;
}

}  // namespace

ContactsCertificate certify_contacts(const ContactsTask& task, const Scene& scene,
                                     const ContactsReport& report,
                                     const std::function<void(std::size_t, std::size_t)>& progress) {
  ContactsCertificate certificate;
  InputOptions every = task;
  every.reading.frames.stride = 1;
  certificate.deviation =
      deviation_of_stride(scene, *open_frames(every, [](const std::string&) {}), task.reading.frames.stride);
  certificate.bead_name = scene.bead_name(certificate.deviation.bead);
  const CutoffRadii own = radii_of(task, scene);
  CutoffRadii smaller, larger;
  BeadGroups with_balls = scene.bead_groups();
  const auto bound = [&](const std::vector<double>& radii, std::vector<double>& less,
                         std::vector<double>& more) {
    if (radii.empty()) return;
    RadiiWithin within = certified_radii(certificate.deviation, radii);
    with_balls = without_empty_balls(std::move(with_balls), within.has_a_ball);
    less = std::move(within.smaller);
    more = std::move(within.larger);
  };
  bound(own.inner, smaller.inner, larger.inner);
  bound(own.outer, smaller.outer, larger.outer);

  ContactBounder bounder(certificate);
  const std::size_t steps = scene.step_count();
  const auto follow_balls = [&](Source source, const CutoffRadii& radii, const BeadGroups& groups,
                                const ContactIntervals::Sink& inner_sink) {
    const auto sink = [&](const ContactInterval& interval) {
      bounder.add(source, interval);
      if (source == Source::enlarged) certificate.possible.push_back(record_of(interval));
    };
    const std::size_t done = static_cast<std::size_t>(source) * steps;
    follow_again(task, scene, report, radii, groups, sink, inner_sink,
                 [&](std::size_t frame) { progress(done + frame, 3 * steps); });
  };
  follow_balls(Source::shrunk, smaller, with_balls, nullptr);
  follow_balls(Source::own, own, scene.bead_groups(),
               [&](const ContactInterval& interval) { bounder.add_frame(interval); });
  follow_balls(Source::enlarged, larger, scene.bead_groups(), nullptr);
  bounder.finish();
  return certificate;
}

}  // namespace kds
