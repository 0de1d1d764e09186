#include "experiments/contacts/follow_contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "experiments/output/sorted_records.h"
#include "experiments/run/run_scene.h"
#include "motions/base/input_error.h"
#include "motions/readers/bead_name.h"
#include "structures/contacts/contacts.h"
#include "structures/session/kinetic_run.h"

namespace kds {

namespace {

class LivesOnDisk final : public LifeStore {
 public:
  void add(const ContactLife& life) override { lives_.add(life); }
  void visit_sorted(const std::function<void(const ContactLife&)>& visit) override {
    lives_.visit_sorted(visit);
  }

 private:
  SortedRecords<ContactLife> lives_;
};

IntervalRecord record_of(const ContactInterval& interval) {
  const auto at = [](const ContactMoment& moment) { return static_cast<double>(moment.step) + moment.u(); };
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

/// Returns the spacings of samples in ticks: parts of a frame first, then the strides.
std::vector<std::size_t> spacings_of(const std::vector<std::size_t>& strides) {
  std::vector<std::size_t> spacings{1, 4, 16, 64};
  for (const std::size_t stride : strides) spacings.push_back(stride * ticks_per_frame);
  return spacings;
}

/// The two structures of a run, or one that stands for both.
template <int D>
class Cutoffs {
 public:
  Cutoffs(KineticRun& run, const ContactsTask& task, const PairsAsked& asked) {
    const auto structure = [&](double length) -> const Contacts<D>* {
      return &run.add<Contacts<D>>(asked, contact_radii({length, task.surface}, run.scene().radii()));
    };
    inner_ = outer_ = structure(task.cutoff->inner);
    if (task.cutoff->are_two()) outer_ = structure(task.cutoff->outer);
  }
  [[nodiscard]] std::vector<BeadPair> inner() const { return inner_->pairs(); }
  [[nodiscard]] std::vector<BeadPair> outer() const { return outer_->pairs(); }

 private:
  const Contacts<D>*inner_, *outer_;
};

/// The frames at both ends of a step.
struct StepStamps {
  FrameStamp from, to;
  StepStamps(const Scene& scene, std::size_t step) : from(scene.stamp(step)), to(scene.stamp(step + 1)) {}
};

template <int D>
void follow(const ContactsTask& task, const Scene& scene, ContactsReport& report,
            const std::function<void(std::size_t, std::size_t)>& progress) {
  KineticRun run(scene, {.by_default = false});
  const bool by_chain = report.by == ContactElement::chain;
  PairsAsked asked{scene.necklaces(), !by_chain, report.apart, true, scene.bead_groups()};
  const Cutoffs<D> cutoffs(run, task, asked);

  ContactRule rule{.elements = report.elements.of_bead,
                   .chains = report.elements.chains,
                   .apart = report.apart,
                   .gap = task.gap,
                   .clock = report.clock,
                   .inner = 0,
                   .outer = task.cutoff->are_two() ? 1U : 0U};
  ContactRule inner_rule = rule, outer_rule = rule;
  inner_rule.gap = outer_rule.gap = 0;
  inner_rule.outer = 0;
  outer_rule.inner = 1;
  inner_rule.rounds_times = outer_rule.rounds_times = false;
  FrameContacts& frames = *report.frames;
  Simulator& simulator = run.simulator();
  ContactIntervals of_inner(simulator, inner_rule, [&](const ContactInterval& i) { frames.add_inner(i); });
  ContactIntervals of_outer(simulator, outer_rule, [&](const ContactInterval& i) { frames.add_outer(i); });
  ContactIntervals of_rule(simulator, rule, [&](const ContactInterval& interval) {
    report.lifetimes->add(interval);
    const IntervalRecord record = record_of(interval);
    report.course.add(record.begin, record.end);
    report.intervals.add(record);
  });
  run.listen(of_inner);
  if (task.cutoff->are_two()) run.listen(of_outer);
  run.listen(of_rule);

  FrameStamp before;
  RunOptions options;
  static_cast<InputOptions&>(options) = task;
  run_steps(run, options, [&](std::size_t frame) {
    if (frame == 0) {
      const StepStamps first(scene, 0);
      const std::vector<BeadPair> inner = cutoffs.inner(), outer = cutoffs.outer();
      of_inner.add_built(inner, inner, first.from, first.to);
      if (task.cutoff->are_two()) of_outer.add_built(outer, outer, first.from, first.to);
      of_rule.add_built(inner, outer, first.from, first.to);
    }
    const FrameStamp now = scene.stamp(frame);
    if (frame > 0 && report.has_times() && !(before.picoseconds < now.picoseconds))
      throw InputError(
          fmt::format("{}: the time does not advance from frame {} to frame {}; lengths of time need "
                      "ascending times, expected --dt PS or other --frames",
                      file_names(task), before.number, now.number));
    before = now;
    if (frame < scene.step_count() && frame % report.course.width() == 0)
      report.frame_numbers.push_back(now.number);
    progress(frame, scene.step_count());
  });
  const StepStamps last(scene, scene.step_count() - 1);
  of_inner.finish(scene.step_count() - 1, last.from, last.to);
  if (task.cutoff->are_two()) of_outer.finish(scene.step_count() - 1, last.from, last.to);
  of_rule.finish(scene.step_count() - 1, last.from, last.to);
  frames.finish();
}

}  // namespace

namespace {

bool names_residues(const Scene& scene) {
  for (BeadId bead = 0; bead < scene.bead_count(); ++bead)
    if (!bead_name_of(scene.bead_name(bead))) return false;
  return true;
}

}  // namespace

std::vector<std::size_t> strides_that_fit(const std::vector<std::size_t>& given, std::size_t frames,
                                          const InputOptions& input) {
  const auto too_long = [&](std::size_t stride) { return (frames - 1) / stride < 1; };
  if (!given.empty()) {
    if (too_long(given.back()))
      throw InputError(fmt::format("--strides: {} looks at one of the {} frames of {}; expected two or more",
                                   given.back(), frames, input.inputs.front().string()));
    return given;
  }
  std::vector<std::size_t> strides;
  for (std::size_t stride = 1; stride <= 64 && !too_long(stride); stride *= 2) strides.push_back(stride);
  return strides;
}

ContactCourse::ContactCourse(std::size_t steps)
    : steps_(steps),
      width_(std::max<std::size_t>(1, (steps + most_bins - 1) / most_bins)),
      partial_((steps + width_ - 1) / width_),
      begun_(partial_.size() + 1) {}

void ContactCourse::add(double begin, double end) {
  const auto width = static_cast<double>(width_);
  const auto bin_of = [&](double time) {
    return std::min(static_cast<std::size_t>(time / width), partial_.size() - 1);
  };
  const std::size_t first = bin_of(begin), last = bin_of(end);
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
  for (std::size_t bin = 0; bin < partial_.size(); ++bin) {
    covering += begun_[bin];
    const std::size_t steps = std::min(width_, steps_ - bin * width_);
    means.push_back(covering + partial_[bin] / static_cast<double>(steps));
  }
  return means;
}

std::unique_ptr<ContactsReport> follow_contacts(
    const ContactsTask& task, const Scene& scene,
    const std::function<void(std::size_t, std::size_t)>& progress) {
  if (scene.frame_count() < 2)
    throw InputError(fmt::format("{}: has one frame, expected two or more", file_names(task)));
  const auto strides = strides_that_fit(task.strides, scene.frame_count(), task);
  auto report = std::make_unique<ContactsReport>(scene.step_count());
  report->by = task.by.value_or(names_residues(scene) ? ContactElement::residue : ContactElement::bead);
  if (report->by == ContactElement::chain && task.apart)
    throw InputError("--apart: it chooses pairs within a chain, which --by chain does not count");
  report->elements = elements_of(scene, report->by);
  if (report->elements.names.size() < 2)
    throw InputError(
        fmt::format("{}: has one {}, expected two or more", file_names(task), name_of(report->by)));
  report->apart = report->by == ContactElement::chain ? 1 : task.apart.value_or(default_contacts_apart);
  report->has_two_cutoffs = task.cutoff->are_two();
  const FrameStamp first = scene.stamp(0);
  report->clock = first.picoseconds ? ContactClock::picoseconds : ContactClock::frames;
  report->lifetimes =
      std::make_unique<ContactLifetimes>(std::make_unique<LivesOnDisk>(), std::make_unique<LivesOnDisk>());
  report->frames =
      std::make_unique<FrameContacts>(spacings_of(strides), task.intermittency, scene.step_count());
  if (scene.dimension() == 2) {
    follow<2>(task, scene, *report, progress);
  } else {
    follow<3>(task, scene, *report, progress);
  }
  const FrameStamp last = scene.stamp(scene.step_count());
  report->first_frame = first.number;
  report->last_frame = last.number;
  report->run_length = report->has_times() ? *last.picoseconds - *first.picoseconds
                                           : static_cast<double>(last.number - first.number);
  return report;
}

}  // namespace kds
