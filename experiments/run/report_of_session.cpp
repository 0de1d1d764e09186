#include "experiments/run/report_of_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "experiments/events/event_files.h"
#include "experiments/output/text.h"
#include "experiments/run/parse_run_options.h"

namespace kds {

namespace {

StructureReport report_of(const KineticStructure& structure, double seconds, const EventCourse& course) {
  const StructureStatistics& s = structure.statistics;
  StructureReport report;
  report.name = structure.name();
  for (const bool external : {true, false}) {
    for (std::size_t k = 0; k < structure.kinds().size(); ++k) {
      const EventKind& kind = structure.kinds()[k];
      if (kind.external != external || kind.counted_apart) continue;
      report.events_by_kind.emplace_back(std::string(kind.name), s.events_by_kind[k]);
      if (external)
        report.events_total += s.events_by_kind[k];
      else
        report.internal_kinds.emplace_back(kind.name);
    }
  }
  report.course = course;
  report.created = s.certificates.created;
  report.never_failing = s.certificates.never_failing;
  report.cancelled = s.certificates.cancelled;
  report.failed = s.certificates.failed;
  report.touched = s.certificates.touched;
  report.peak = s.certificates.peak;
  report.per_bead_max = s.certificates.per_bead_max;
  for (const Stage& stage : stage_table) report.stages.emplace_back(stage.name, s.stages.*stage.count);
  report.seconds = seconds;
  report.build_seconds = s.build_seconds;
  report.rebuilds = s.rebuilds;
  report.audits_run = s.audits_run;
  report.audits_failed = s.audits_failed;
  return report;
}

}  // namespace

RunReport report_of(Session& session, const Scene& scene, const RunOptions& options,
                    const StepCounts& counts) {
  RunReport report;
  for (const auto& input : options.inputs) report.files.push_back(input.string());
  if (options.obstacle) report.files.push_back(options.obstacle->string());
  report.beads = scene.bead_count();
  report.frames = scene.frame_count();
  report.first_frame = scene.stamp(0);
  report.last_frame = scene.stamp(scene.frame_count() - 1);
  report.dimension = scene.dimension();
  const auto [least, most] = std::minmax_element(scene.radii().begin(), scene.radii().end());
  report.radius_min = *least;
  report.radius_max = *most;
  report.settings = run_options().settings(options);
  report.command_line = "kds run " + shell_words(repeating_arguments(options));
  for (std::size_t s = 0; s < session.structures().size(); ++s) {
    report.structures.push_back(
        report_of(*session.structures()[s], session.simulator().seconds_of(s), counts.courses()[s]));
    if (report.structures.back().name != "contacts") continue;
    report.structures.back().contacts_at_start = counts.contacts_at_start();
    report.structures.back().contacts_at_end = contacts_at(session, scene.frame_count() - 1);
  }
  report.engine_seconds = session.simulator().seconds();
  report.listeners_seconds = session.simulator().seconds_of_listeners();
  const ComparisonCounts& comparisons = session.simulator().comparisons();
  report.comparisons = {
      {"same_function", comparisons.by_identity}, {"exact", comparisons.exact}, {"ties", comparisons.ties}};
  report.exact_work = session.simulator().exact_work().done();
  report.fingerprint = session.simulator().fingerprint();
  return report;
}

}  // namespace kds
