#include "experiments/contacts/certify_contacts.h"

#include <algorithm>
#include <array>
#include <compare>
#include <memory>
#include <optional>
#include <string>

#include "experiments/output/sorted_records.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

enum class RunOfBalls : std::uint8_t { shrunk, own, enlarged };

/// A step and a parameter in it, below 1.
struct StepMoment {
  std::size_t step = 0;
  double u = 0;
  friend auto operator<=>(const StepMoment&, const StepMoment&) = default;
};

StepMoment step_moment(std::size_t step, double u) {
  return u < 1 ? StepMoment{step, u} : StepMoment{step + 1, 0};
}

/// An interval that is sorted by pair, by run, and by its place in the run.
struct PlacedInterval {
  std::uint64_t pair = 0;
  RunOfBalls run = RunOfBalls::own;
  std::size_t place = 0;        // among all intervals of the run
  StepMoment earliest, latest;  // bounds of its begin and of its end
  double length = 0;

  friend bool operator<(const PlacedInterval& a, const PlacedInterval& b) {
    if (a.pair != b.pair) return a.pair < b.pair;
    return a.run != b.run ? a.run < b.run : a.place < b.place;
  }
};

/// Sharpens the bounds of disjoint intervals in their order, so that both bounds ascend.
void sharpen(std::vector<PlacedInterval>& intervals) {
  for (std::size_t k = 1; k < intervals.size(); ++k)
    intervals[k].earliest = std::max(intervals[k].earliest, intervals[k - 1].earliest);
  for (std::size_t k = intervals.size(); k > 1; --k)
    intervals[k - 2].latest = std::min(intervals[k - 2].latest, intervals[k - 1].latest);
}

/// Returns the only interval that may contain `inner`, or null if several may.
const PlacedInterval* container_of(const PlacedInterval& inner, const std::vector<PlacedInterval>& all) {
  const auto first = std::partition_point(
      all.begin(), all.end(), [&](const PlacedInterval& one) { return one.latest < inner.earliest; });
  if (first == all.end() || inner.latest < first->earliest) return nullptr;
  const auto second = first + 1;
  return second == all.end() || inner.latest < second->earliest ? &*first : nullptr;
}

/// Calls `visit` for each interval of `all` that certainly contains one of `inner`, once.
template <class Visit>
void for_each_container(const std::vector<PlacedInterval>& inner, const std::vector<PlacedInterval>& all,
                        const Visit& visit) {
  const PlacedInterval* last = nullptr;
  for (const PlacedInterval& one : inner) {
    const PlacedInterval* const container = container_of(one, all);
    if (container == nullptr || container == last) continue;
    last = container;
    visit(*container);
  }
}

class ContactBounder {
 public:
  explicit ContactBounder(ContactsCertificate& certificate) : certificate_(certificate) {}

  /// Adds an interval of a run. Intervals come in the order in which the run reports them.
  void add(RunOfBalls run, std::uint32_t first, std::uint32_t second, const StepMoment& earliest,
           const StepMoment& latest, double length) {
    auto& place = places_[static_cast<std::size_t>(run)];
    sorted_.add({(std::uint64_t{first} << 32U) | second, run, place++, earliest, latest, length});
  }

  void finish() {
    certificate_.is_sure.assign(places_[static_cast<std::size_t>(RunOfBalls::own)], 0);
    certificate_.is_found.assign(places_[static_cast<std::size_t>(RunOfBalls::enlarged)], 0);
    std::optional<std::uint64_t> pair;
    sorted_.visit_sorted([&](const PlacedInterval& interval) {
      if (pair && *pair != interval.pair) finish_pair(*pair);
      pair = interval.pair;
      of_pair_[static_cast<std::size_t>(interval.run)].push_back(interval);
    });
    if (pair) finish_pair(*pair);
  }

 private:
  void finish_pair(std::uint64_t pair) {
    for (auto& intervals : of_pair_) sharpen(intervals);
    const auto& [shrunk, own, enlarged] = of_pair_;
    ContactBoundsOfPair bounds;
    for (const PlacedInterval& one : shrunk) bounds.least_time += one.length;
    for (const PlacedInterval& one : enlarged) bounds.most_time += one.length;
    for_each_container(shrunk, own, [&](const PlacedInterval& one) {
      certificate_.is_sure[one.place] = 1;
      ++bounds.sure;
    });
    for_each_container(own, enlarged,
                       [&](const PlacedInterval& one) { certificate_.is_found[one.place] = 1; });
    for_each_container(shrunk, enlarged, [&](const PlacedInterval&) { ++bounds.least; });
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
  SortedRecords<PlacedInterval> sorted_;
  std::array<std::size_t, 3> places_{};
  std::array<std::vector<PlacedInterval>, 3> of_pair_;  // by RunOfBalls
};

/// Returns groups with which only pairs of these beads are asked about, and among them the pairs of `groups`.
BeadGroups without_empty_balls(BeadGroups groups, const std::vector<std::uint8_t>& has_a_ball) {
  constexpr std::uint8_t both = 3;
  if (groups.empty()) groups.assign(has_a_ball.size(), both);
  for (std::size_t bead = 0; bead < groups.size(); ++bead)
    if (has_a_ball[bead] == 0) groups[bead] = 0;
  return groups;
}

RadiiWithin certified_radii(const StrideDeviation& deviation, const std::vector<double>& radii) {
  try {
    return radii_within(deviation, radii);
  } catch (const InputError& error) {
    throw InputError(std::string("--certify: ") + error.what());
  }
}

}  // namespace

void refuse_needless_certificate(const ContactsTask& task) {
  if (task.certify && task.reading.frames.stride == 1)
    throw InputError(
        "--certify: the command leaves out no frame; expected --frames FIRST:LAST:STRIDE with a stride above "
        "1");
}

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
  const auto follow_balls = [&](RunOfBalls run, const CutoffRadii& radii, const BeadGroups& groups) {
    const auto sink = [&](const ContactInterval& interval) {
      bounder.add(run, interval.first, interval.second,
                  step_moment(interval.begin.step, interval.begin.lower),
                  step_moment(interval.end.step, interval.end.upper), interval.length());
      if (run == RunOfBalls::enlarged) certificate.possible.add(record_of(interval));
    };
    const std::size_t done = static_cast<std::size_t>(run) * steps;
    follow_again(task, scene, report, radii, groups, sink,
                 [&](std::size_t frame) { progress(done + frame, 3 * steps); });
  };
  follow_balls(RunOfBalls::shrunk, smaller, with_balls);
  follow_balls(RunOfBalls::own, own, scene.bead_groups());
  follow_balls(RunOfBalls::enlarged, larger, scene.bead_groups());
  bounder.finish();
  return certificate;
}

}  // namespace kds
