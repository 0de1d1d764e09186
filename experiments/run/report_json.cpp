#include "experiments/run/report_json.h"

#include "experiments/output/result_json.h"
#include "experiments/output/text.h"

namespace kds {
namespace {

void add_counts(Json& object, const NamedCounts& counts) {
  for (const auto& [name, value] : counts) object[name] = value;
}

Json structure_json(const StructureReport& structure, std::size_t rounds) {
  Json events{{"total", structure.events_total}};
  add_counts(events, structure.events_by_kind);
  Json stages = Json::object();
  add_counts(stages, structure.stages);
  Json json{{"events", events},
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
            {"build_seconds", structure.build_seconds},
            {"static_seconds", structure.static_seconds},
            {"rebuilds", structure.rebuilds},
            {"audits", {{"run", structure.audits_run}, {"failed", structure.audits_failed}}}};
  if (structure.contacts_at_start && structure.contacts_at_end)
    json["contacts"] = {{"at_start", *structure.contacts_at_start}, {"at_end", *structure.contacts_at_end}};
  if (rounds > 1) {
    json["seconds_least"] = structure.of_seconds.least;
    json["seconds_most"] = structure.of_seconds.most;
    json["static_seconds_least"] = structure.of_static_seconds.least;
    json["static_seconds_most"] = structure.of_static_seconds.most;
  }
  return json;
}

Json stride_json(const StrideCertificate& stride) {
  const StrideDeviation& deviation = stride.deviation;
  Json json{
      {"skipped", deviation.skipped},
      {"deviation", {{"largest", deviation.largest}, {"frame", deviation.frame}, {"bead", deviation.bead}}}};
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
  if (const auto& range = report.approach_in_all_frames) json["distance_in_all_frames"] = json_of(*range);
  return json;
}

Json run_json(const RunReport& report) {
  Json json;
  json["input"] = {{"files", report.files},           {"beads", report.beads},
                   {"frames", report.frames},         {"dimension", report.dimension},
                   {"radius_min", report.radius_min}, {"radius_max", report.radius_max}};
  if (report.first_frame && report.last_frame) {
    const auto& [first, first_time] = *report.first_frame;
    const auto& [last, last_time] = *report.last_frame;
    json["input"]["first_frame"] = first;
    json["input"]["last_frame"] = last;
    if (first_time && last_time) json["input"]["picoseconds"] = std::vector<double>{*first_time, *last_time};
  }
  json["settings"] = Json::object();
  for (const auto& [name, value] : report.settings) json["settings"][name] = value;
  json["structures"] = Json::object();
  for (const StructureReport& structure : report.structures)
    json["structures"][structure.name] = structure_json(structure, report.rounds);
  Json comparisons = Json::object();
  add_counts(comparisons, report.comparisons);
  json["engine"] = {{"seconds", report.engine_seconds},
                    {"listeners_seconds", report.listeners_seconds},
                    {"close_comparisons", comparisons},
                    {"exact_work", report.exact_work}};
  json["fingerprint"] = hex_digits(report.fingerprint);
  if (report.stride) json["stride"] = stride_json(*report.stride);
  if (report.approach) json["closest_approach"] = approach_json(report);
  add_provenance(json, report.command_line);
  return json;
}

}  // namespace

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

}  // namespace kds
