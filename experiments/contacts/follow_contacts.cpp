#include "experiments/contacts/follow_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "experiments/events/event_distribution.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "motions/readers/bead_name.h"
#include "structures/contacts/contact_distance.h"
#include "structures/contacts/contacts.h"
#include "structures/crossings/crossings.h"
#include "structures/necklace/pairs_in_question.h"
#include "structures/session/parallel_run.h"

namespace kds {

namespace {

/// Returns the number of pairs of elements that the task asks about.
std::uint64_t pairs_asked(const Scene& scene, const ContactsReport& report) {
  const ContactElements& elements = report.elements;
  const auto size = static_cast<BeadId>(elements.names.size());
  PairsAsked asked{{}, report.by != ContactElement::chain, report.apart, true, {}};
  for (BeadId element = 0; element < size; ++element) {
    if (element == 0 || elements.chains[element] != elements.chains[element - 1])
      asked.necklaces.push_back({element, element});
    asked.necklaces.back().last = element;
  }
  if (!scene.at_rest().empty()) asked.at_rest.resize(asked.necklaces.size());
  for (std::size_t n = 0; n < scene.at_rest().size(); ++n)
    asked.at_rest[asked.necklace_of(elements.of_bead[scene.necklaces()[n].first])] = scene.at_rest()[n];
  if (!scene.bead_groups().empty()) asked.groups.assign(size, 0);
  for (BeadId bead = 0; bead < scene.bead_groups().size(); ++bead)
    asked.groups[elements.of_bead[bead]] |= scene.bead_groups()[bead];
  return PairsInQuestion(asked).count();
}

}  // namespace

IntervalRecord record_of(const ContactInterval& interval) {
  const auto at = [](const ContactMoment& moment) {
    const auto step = static_cast<double>(moment.step), time = step + moment.u();
    if (moment.upper == 0 || moment.lower == 1) return time;
    // Rounding must not move a time within a step to a frame.
    return std::clamp(time, std::nextafter(step, step + 1), std::nextafter(step + 1, step));
  };
  const RoundedTime &begin = interval.begin.rounded, &end = interval.end.rounded;
  return {interval.first,
          interval.second,
          begin.frame,
          end.frame,
          begin.picoseconds.value_or(0),
          end.picoseconds.value_or(0),
          interval.length(),
          at(interval.begin),
          at(interval.end),
          interval.open_at_start,
          interval.open_at_end};
}

namespace {

/// Returns the spacings of samples in ticks: parts of a frame first, then the strides.
std::vector<std::size_t> spacings_of(const std::vector<std::size_t>& strides) {
  std::vector<std::size_t> spacings{1, 4, 16, 64};
  for (const std::size_t stride : strides) spacings.push_back(stride * ticks_per_frame);
  return spacings;
}

/// The frames at both ends of a step.
struct StepStamps {
  FrameStamp from, to;
  StepStamps(const Scene& scene, std::size_t step) : from(scene.stamp(step)), to(scene.stamp(step + 1)) {}
};

/// Returns the rule of the task. Structure 0 of the run has the inner cutoff, structure 1 the outer one.
ContactRule rule_of(const ContactsTask& task, const ContactsReport& report) {
  return {.elements = report.elements.of_bead,
          .chains = report.elements.chains,
          .apart = report.apart,
          .gap = task.gap,
          .clock = report.clock,
          .inner = 0,
          .outer = task.has_two_cutoffs() ? 1U : 0U};
}

/// Returns the rule of contacts within the inner cutoff, without any gap.
ContactRule inner_rule_of(const ContactsTask& task, const ContactsReport& report) {
  ContactRule rule = rule_of(task, report);
  rule.gap = 0;
  rule.outer = rule.inner;
  rule.rounds_times = false;
  return rule;
}

/// A run with a structure for each cutoff, whose contacts are followed by several rules.
template <int D>
class ContactsRun {
 public:
  ContactsRun(const ContactsTask& task, const Scene& scene, const ContactsReport& report,
              const CutoffRadii& radii, const BeadGroups& groups, bool with_crossings = false)
      : task_(task),
        scene_(scene),
        run_(scene, {.by_default = false}, {.threads = task.threads.value_or(all_threads())}) {
    const PairsAsked asked{scene.necklaces(), report.by != ContactElement::chain, report.apart, true, groups,
                           scene.at_rest()};
    run_.add<Contacts<D>>(asked, radii.inner);
    if (!radii.outer.empty()) run_.add<Contacts<D>>(asked, radii.outer);
    if constexpr (D == 3)
      if (with_crossings) run_.add<Crossings>(ChainBonds(scene), scene.is_periodic());
  }

  /// Follows the contacts by one more rule. Events reach the rules in the order of these calls.
  void follow(const ContactRule& rule, ContactIntervals::Sink sink) {
    followed_.push_back({rule.inner, rule.outer,
                         std::make_unique<ContactIntervals>(run_.simulator(), rule, std::move(sink))});
    run_.listen(*followed_.back().intervals);
  }

  /// Returns the crossings of bonds, after the run.
  [[nodiscard]] CrossingCounts crossings() {
    return {scene_, run_.whole().structures().back()->statistics.events_by_kind};
  }

  /// `at_end` is called after the last step, before contacts that are still open end.
  void run(
      const std::function<void(std::size_t frame)>& at_frame, const std::function<void()>& at_end = [] {}) {
    RunOptions options;
    static_cast<InputOptions&>(options) = task_;
    run_steps(run_, options, [&](std::size_t frame) {
      if (frame == 0) add_built();
      for (KineticStructure* const structure : run_.whole().structures())
        structure->statistics.events_per_step.clear();  // they would grow with the number of steps
      at_frame(frame);
    });
    at_end();
    const StepStamps last(scene_, scene_.step_count() - 1);
    for (const Followed& one : followed_) one.intervals->finish(scene_.step_count() - 1, last.from, last.to);
  }

  /// Passes to `sinks`, one for each rule, what the rules would pass on if the run ended after these steps.
  void finish_copies(const std::vector<ContactIntervals::Sink>& sinks, std::size_t steps) const {
    const StepStamps last(scene_, steps - 1);
    for (std::size_t k = 0; k < followed_.size(); ++k)
      followed_[k].intervals->finish_copy(sinks[k], steps - 1, last.from, last.to);
  }
  /// Returns the number of contacts now, by the rule that was added last.
  [[nodiscard]] std::size_t contacts_now() const { return followed_.back().intervals->size(); }

 private:
  struct Followed {
    std::size_t inner, outer;
    std::unique_ptr<ContactIntervals> intervals;
  };

  void add_built() {
    const StepStamps first(scene_, 0);
    std::vector<std::vector<BeadPair>> pairs(run_.whole().structures().size());
    for (std::size_t s = 0; s < pairs.size(); ++s)
      for (const Event& event : run_.whole().built(s)) pairs[s].push_back({event.ids()[0], event.ids()[1]});
    for (const Followed& one : followed_)
      one.intervals->add_built(pairs[one.inner], pairs[one.outer], first.from, first.to);
  }

  const ContactsTask& task_;
  const Scene& scene_;
  ParallelRun run_;
  std::vector<Followed> followed_;
};

/// Returns the rules of a run, in the order in which a report takes their intervals.
std::vector<ContactRule> rules_of(const ContactsTask& task, const ContactsReport& report) {
  const ContactRule rule = rule_of(task, report);
  std::vector<ContactRule> rules{inner_rule_of(task, report), rule};
  if (!task.has_two_cutoffs()) return rules;
  ContactRule outer = inner_rule_of(task, report);
  outer.inner = outer.outer = rule.outer;
  return {rules[0], outer, rule};
}

/// Returns a sink for each of these rules, which adds to the report.
std::vector<ContactIntervals::Sink> sinks_of(ContactsReport& report) {
  std::vector<ContactIntervals::Sink> sinks{
      [&](const ContactInterval& interval) { report.frames->add_inner(interval); }};
  if (report.has_two_cutoffs)
    sinks.emplace_back([&](const ContactInterval& interval) { report.frames->add_outer(interval); });
  sinks.emplace_back([&](const ContactInterval& interval) {
    report.lifetimes.add(interval);
    const IntervalRecord record = record_of(interval);
    report.course.add(record.begin, record.end);
    report.intervals.push_back(record);
  });
  return sinks;
}

/// Completes the report of a run of this many steps.
void complete(const Scene& scene, std::size_t steps, ContactsReport& report) {
  const FrameStamp first = scene.stamp(0), last = scene.stamp(steps);
  report.frames->finish(steps);
  report.steps = steps;
  report.first_frame = first.number;
  report.last_frame = last.number;
  report.run_length = report.has_times() ? *last.picoseconds - *first.picoseconds
                                         : static_cast<double>(last.number - first.number);
}

template <int D>
void follow(const ContactsTask& task, const Scene& scene, ContactsReport& report,
            const std::function<void(std::size_t, std::size_t)>& progress,
            const LiveHooks<ContactsReport>& hooks) {
  const bool with_crossings = has_crossings(scene);
  ContactsRun<D> run(task, scene, report, radii_of(task, scene), scene.bead_groups(), with_crossings);
  const std::vector<ContactRule> rules = rules_of(task, report);
  const std::vector<ContactIntervals::Sink> sinks = sinks_of(report);
  for (std::size_t k = 0; k < rules.size(); ++k) run.follow(rules[k], sinks[k]);
  const LiveProgress live(scene);
  std::size_t steps = 0;
  const auto report_so_far = [&] {
    ContactsReport copy = report;
    copy.course.end(steps);
    run.finish_copies(sinks_of(copy), steps);
    complete(scene, steps, copy);
    if (with_crossings) copy.crossings = run.crossings();
    copy.live = live.run(false);
    return copy;
  };
  if (hooks.describe && scene.is_live())
    hooks.describe(
        [&] { return live.state(steps, report.intervals.size(), "contacts ended", run.contacts_now()); });
  run.run(
      [&](std::size_t frame) {
        steps = frame;
        report.course.add_frame(frame, scene);
        progress(frame, scene.is_live() ? 0 : scene.step_count());
        if (hooks.at_frame && scene.is_live() && steps > 0) hooks.at_frame(report_so_far);
      },
      [&] { report.course.end(steps); });
  complete(scene, steps, report);
  if (with_crossings) report.crossings = run.crossings();
  if (scene.is_live()) report.live = live.run(true);
}

template <int D>
void follow_rule_again(const ContactsTask& task, const Scene& scene, const ContactsReport& report,
                       const CutoffRadii& radii, const BeadGroups& groups, const ContactIntervals::Sink& sink,
                       const ContactIntervals::Sink& inner_sink,
                       const std::function<void(std::size_t)>& at_frame) {
  ContactsRun<D> run(task, scene, report, radii, groups);
  run.follow(rule_of(task, report), sink);
  if (inner_sink) run.follow(inner_rule_of(task, report), inner_sink);
  run.run(at_frame);
}

/// Returns the first bead without a residue, or nothing if all have one.
std::optional<BeadId> bead_without_residue(const Scene& scene) {
  for (BeadId bead = 0; bead < scene.bead_count(); ++bead)
    if (!bead_name_of(scene.bead_name(bead))) return bead;
  return std::nullopt;
}

}  // namespace

std::vector<std::size_t> strides_that_fit(const std::vector<std::size_t>& given, std::size_t frames,
                                          const InputOptions& input) {
  const auto too_long = [&](std::size_t stride) { return (frames - 1) / stride < 1; };
  if (!given.empty()) {
    if (too_long(given.back()))
      throw InputError("--strides",
                       fmt::format("{} looks at one of the {} frames of {}; expected two or more",
                                   given.back(), frames, input_name(input, 0)));
    return given;
  }
  std::vector<std::size_t> strides;
  for (std::size_t stride = 1; stride <= 64 && !too_long(stride); stride *= 2) strides.push_back(stride);
  return strides;
}

ContactCourse::ContactCourse(std::optional<std::size_t> steps)
    : steps_(steps), width_(bin_width(steps.value_or(1), most_bins)) {}

void ContactCourse::add_frame(std::size_t frame, const Scene& scene) {
  if (!steps_ && frame > most_bins * width_) double_width();
  if (frame % width_ == 0) first_frames_.push_back(scene.stamp(frame));
}

/// Joins pairs of bins. Contacts that cover whole bins become times in them.
void ContactCourse::double_width() {
  std::vector<double> times(partial_.size() + 1);
  double covering = 0;
  for (std::size_t bin = 0; bin < partial_.size(); ++bin) {
    covering += begun_[bin];
    times[bin] = partial_[bin] + covering * static_cast<double>(width_);
  }
  for (std::size_t bin = 0; 2 * bin < partial_.size(); ++bin)
    partial_[bin] = times[2 * bin] + times[2 * bin + 1];
  for (std::size_t bin = 0; 2 * bin < first_frames_.size(); ++bin)
    first_frames_[bin] = first_frames_[2 * bin];
  partial_.resize((partial_.size() + 1) / 2);
  first_frames_.resize((first_frames_.size() + 1) / 2);
  begun_.assign(partial_.size() + 1, 0);
  width_ *= 2;
}

void ContactCourse::add(double begin, double end) {
  const auto width = static_cast<double>(width_);
  const auto bin_of = [&](double time) {
    const auto bin = static_cast<std::size_t>(time / width);
    return steps_ ? std::min(bin, (*steps_ - 1) / width_) : bin;
  };
  const std::size_t first = bin_of(begin), last = bin_of(end);
  if (last >= partial_.size()) {
    partial_.resize(last + 1);
    begun_.resize(last + 2);
  }
  if (first == last) {
    partial_[first] += end - begin;
    return;
  }
  partial_[first] += static_cast<double>(first + 1) * width - begin;
  partial_[last] += end - static_cast<double>(last) * width;
  ++begun_[first + 1];
  --begun_[last];
}

std::vector<double> ContactCourse::means() const {
  std::vector<double> means;
  double covering = 0;
  for (std::size_t bin = 0; bin * width_ < *steps_; ++bin) {
    if (bin < begun_.size()) covering += begun_[bin];
    const std::size_t steps = std::min(width_, *steps_ - bin * width_);
    means.push_back(covering + (bin < partial_.size() ? partial_[bin] / static_cast<double>(steps) : 0));
  }
  return means;
}

CutoffRadii radii_of(const ContactsTask& task, const Scene& scene) {
  CutoffRadii of_cutoffs{contact_radii(task.distances[0], scene.radii()), {}};
  if (task.has_two_cutoffs()) of_cutoffs.outer = contact_radii(task.distances[1], scene.radii());
  return of_cutoffs;
}

void follow_again(const ContactsTask& task, const Scene& scene, const ContactsReport& report,
                  const CutoffRadii& radii, const BeadGroups& groups, const ContactIntervals::Sink& sink,
                  const ContactIntervals::Sink& inner_sink,
                  const std::function<void(std::size_t)>& at_frame) {
  const auto follow_rules = scene.dimension() == 2 ? &follow_rule_again<2> : &follow_rule_again<3>;
  follow_rules(task, scene, report, radii, groups, sink, inner_sink, at_frame);
}

std::unique_ptr<ContactsReport> follow_contacts(const ContactsTask& task, const Scene& scene,
                                                const std::function<void(std::size_t, std::size_t)>& progress,
                                                const LiveHooks<ContactsReport>& hooks) {
  if (scene.frame_count() < 2)
    throw InputError(fmt::format("{}: has one frame, expected two or more", file_names(task)));
  require_ascending_times(task, scene);
  constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  const auto strides =
      strides_that_fit(task.strides, scene.is_live() ? unlimited : scene.frame_count(), task);
  auto report = std::make_unique<ContactsReport>(
      scene.is_live() ? std::nullopt : std::optional<std::size_t>(scene.step_count()));
  const std::optional<BeadId> nameless = bead_without_residue(scene);
  report->by = task.by.value_or(nameless ? ContactElement::bead : ContactElement::residue);
  if (report->by == ContactElement::residue && nameless)
    throw InputError(fmt::format(
        "{} residue: {} names no residue of bead {}; expected {} bead, or {}", "--by"_arg, file_names(task),
        *nameless, "--by"_arg,
        words("--topology FILE",
              "an AtomGroup or mdtraj Trajectory, or the topology of a file, which name residues")));
  if (report->by == ContactElement::chain && task.apart)
    throw InputError(
        "--apart", fmt::format("it chooses pairs within a chain, which {} chain does not count", "--by"_arg));
  report->elements = elements_of(scene, report->by);
  if (report->elements.names.size() < 2)
    throw InputError(fmt::format(
        "{}: has one {}, expected two or more{}", file_names(task), name_of(report->by),
        report->by == ContactElement::chain ? fmt::format(", or {} residue or bead", "--by"_arg) : ""));
  report->apart = report->by == ContactElement::chain ? 1 : task.apart.value_or(default_contacts_apart);
  report->has_two_cutoffs = task.has_two_cutoffs();
  const FrameStamp first = scene.stamp(0);
  report->clock = first.picoseconds ? ContactClock::picoseconds : ContactClock::frames;
  report->pairs_asked = pairs_asked(scene, *report);
  report->frames.emplace(spacings_of(strides), task.intermittency);
  if (scene.dimension() == 2) {
    follow<2>(task, scene, *report, progress, hooks);
  } else {
    follow<3>(task, scene, *report, progress, hooks);
  }
  return report;
}

}  // namespace kds
