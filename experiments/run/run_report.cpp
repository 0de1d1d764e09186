#include "experiments/run/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "experiments/events/event_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/input_options.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_scene.h"
#include "experiments/run/run_summary.h"

namespace kds {

std::string StructureReport::label_of(const std::string& kind) const {
  return std::ranges::find(internal_kinds, kind) == internal_kinds.end() ? kind : kind + " (internal)";
}

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

RunReport report_of(KineticRun& run, const Scene& scene, const RunOptions& options,
                    const StepCounts& counts) {
  RunReport report;
  for (const auto& input : options.inputs) report.files.push_back(input.string());
  if (options.obstacle) report.files.push_back(options.obstacle->string());
  report.beads = scene.bead_count();
  report.frames = counts.steps() + 1;
  report.first_frame = scene.stamp(0);
  report.last_frame = scene.stamp(counts.steps());
  report.dimension = scene.dimension();
  for (BeadId bead = 0; bead < scene.bead_count(); ++bead) report.bead_names.push_back(scene.bead_name(bead));
  report.truncated = scene.is_truncated();
  const auto [least, most] = std::minmax_element(scene.radii().begin(), scene.radii().end());
  report.radius_min = *least;
  report.radius_max = *most;
  report.length_unit = length_unit(options);
  report.velocities = scene.velocities();
  report.settings = run_options().settings(options);
  if (std::ranges::any_of(options.inputs, is_instance_file))
    for (auto& [name, value] : report.settings)
      if (name == "motion") value = "own";
  report.command_line = "kds run " + shell_words(repeating_arguments(options));
  for (std::size_t s = 0; s < run.structures().size(); ++s) {
    report.structures.push_back(
        report_of(*run.structures()[s], run.simulator().seconds_of(s), counts.courses()[s]));
    if (report.structures.back().name != "contacts") continue;
    report.structures.back().contacts_at_start = counts.contacts_at_start();
    report.structures.back().contacts_at_end = contacts_at(run, counts.steps());
  }
  report.engine_seconds = run.simulator().seconds();
  report.listeners_seconds = run.simulator().seconds_of_listeners();
  const ComparisonCounts& comparisons = run.simulator().comparisons();
  report.comparisons = {
      {"same_function", comparisons.by_identity}, {"exact", comparisons.exact}, {"ties", comparisons.ties}};
  report.exact_work = run.simulator().exact_work().done();
  report.fingerprint = run.simulator().fingerprint();
  return report;
}

namespace {

void add_counts(Json& object, const NamedCounts& counts) {
  for (const auto& [name, value] : counts) object[name] = value;
}

Json structure_json(const StructureReport& structure, std::size_t rounds, bool has_static_builds) {
  Json events{{"total", structure.events_total}};
  add_counts(events, structure.events_by_kind);
  Json stages = Json::object();
  add_counts(stages, structure.stages);
  Json json{{"events", events},
            {"internal", structure.internal_kinds},
            {"certificates",
             {{"created", structure.created},
              {"never_failing", structure.never_failing},
              {"cancelled", structure.cancelled},
              {"failed", structure.failed},
              {"touched", structure.touched},
              {"peak", structure.peak},
              {"per_bead_max", structure.per_bead_max}}},
            {"stages", stages},
            {"seconds", structure.seconds},
            {"build_seconds", structure.build_seconds}};
  if (has_static_builds) json["static_seconds"] = structure.static_seconds;
  json["rebuilds"] = structure.rebuilds;
  json["audits"] = {{"run", structure.audits_run}, {"failed", structure.audits_failed}};
  if (structure.contacts_at_start && structure.contacts_at_end)
    json["contacts"] = {{"at_start", *structure.contacts_at_start}, {"at_end", *structure.contacts_at_end}};
  if (!structure.distribution.by_bead.empty()) {
    json["over_time"] = over_time_json(structure.course);
    json["by_bead"] = structure.distribution.by_bead;
    if (!structure.distribution.by_level.empty()) json["by_level"] = structure.distribution.by_level;
  }
  if (rounds > 1) {
    json["seconds_least"] = structure.of_seconds.least;
    json["seconds_most"] = structure.of_seconds.most;
    json["static_seconds_least"] = structure.of_static_seconds.least;
    json["static_seconds_most"] = structure.of_static_seconds.most;
  }
  return json;
}

Json stride_json(const StrideCertificate& stride) {
  Json json = deviation_json(stride.deviation);
  if (stride.contacts)
    json["contacts"] = {{"found", stride.contacts->found.size()},
                        {"sure", stride.contacts->sure.size()},
                        {"possible", stride.contacts->possible.size()}};
  return json;
}

std::vector<double> json_of(const DistanceRange& range) { return {range.lower, range.upper}; }

Json approach_json(const RunReport& report) {
  const ClosestApproach& approach = *report.approach;
  Json json{{"beads", std::vector<BeadId>(approach.beads.begin(), approach.beads.end())},
            {"frame", approach.frame},
            {"u", approach.u},
            {"distance", json_of(approach.distance)}};
  const std::string &first = report.bead_names[approach.beads[0]],
                    &second = report.bead_names[approach.beads[1]];
  if (!first.empty() && !second.empty()) json["names"] = std::vector<std::string>{first, second};
  if (const auto& range = report.approach_in_all_frames) json["distance_in_all_frames"] = json_of(*range);
  return json;
}

Json run_json(const RunReport& report) {
  Json json;
  json["input"] = {{"files", report.files},           {"beads", report.beads},
                   {"frames", report.frames},         {"dimension", report.dimension},
                   {"truncated", report.truncated},   {"radius_min", report.radius_min},
                   {"radius_max", report.radius_max}, {"length_unit", report.length_unit}};
  if (report.velocities) json["input"]["velocities"] = name_of(*report.velocities);
  if (report.first_frame && report.last_frame)
    add_ends(json["input"], {*report.first_frame, *report.last_frame});
  json["settings"] = Json::object();
  for (const auto& [name, value] : report.settings) json["settings"][name] = value;
  json["structures"] = Json::object();
  for (const StructureReport& structure : report.structures)
    json["structures"][structure.name] = structure_json(structure, report.rounds, !report.live);
  Json comparisons = Json::object();
  add_counts(comparisons, report.comparisons);
  json["engine"] = {{"seconds", report.engine_seconds},
                    {"listeners_seconds", report.listeners_seconds},
                    {"close_comparisons", comparisons},
                    {"exact_work", report.exact_work},
                    {"threads", report.threads},
                    {"parts", report.parts.parts},
                    {"parts_run_again", report.parts.run_again}};
  json["fingerprint"] = hex_digits(report.fingerprint);
  if (report.live) add_live(json, *report.live);
  if (report.stride) json["stride"] = stride_json(*report.stride);
  if (report.approach) json["closest_approach"] = approach_json(report);
  add_provenance(json, report.command_line);
  return json;
}

}  // namespace

Json deviation_json(const StrideDeviation& deviation) {
  return {
      {"skipped", deviation.skipped},
      {"deviation", {{"largest", deviation.largest}, {"frame", deviation.frame}, {"bead", deviation.bead}}}};
}

std::string report_json(const RunReport& report) { return text_of(run_json(report)); }

std::string replay_json(const ReplayReport& replay, const std::filesystem::path& log) {
  Json json = run_json(replay.run);
  json["replay"] = {{"log", log.string()},
                    {"events", replay.events},
                    {"logged_fingerprint", hex_digits(replay.logged_fingerprint)},
                    {"same", replay.same()},
                    {"difference", replay.difference ? Json(*replay.difference) : Json()}};
  return text_of(json);
}

std::string comparison_table(const RunReport& report) {
  std::string text;
  for (const auto& [label, value] : input_lines(report))
    text += one_line(fmt::format("{:<10}{}", label, value)) + "\n";
  text += "\n";

  std::vector<std::vector<std::string>> lines(1, {""});
  for (const StructureReport& structure : report.structures) lines[0].push_back(structure.name);
  for (const SummaryRow& row : summary_rows(report)) {
    std::vector<std::string>& line = lines.emplace_back(1, (row.detail ? "  " : "") + row.label);
    line.insert(line.end(), row.cells.begin(), row.cells.end());
    line.resize(lines[0].size());
  }
  for (const std::string& line : in_columns(lines, "<>")) text += line + "\n";
  text += fmt::format("\nengine {} s\n", short_decimal(report.engine_seconds));
  if (report.parts.parts > 1)
    text += fmt::format("threads {}, parts {} ({} run again)\n", report.threads, report.parts.parts,
                        report.parts.run_again);
  text += fmt::format("fingerprint {}\n", hex_digits(report.fingerprint));
  return text;
}

}  // namespace kds
