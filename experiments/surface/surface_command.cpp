#include "experiments/surface/surface_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/program/commands.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

constexpr CommandSpec kSurfaceCommand{
    "kds surface",
    "Measures the accessible area and the volume of the union of balls, by "
    "atom, residue and chain, and the contact areas "
    "of its atoms. The formulas are exact; the numbers are doubles. By "
    "default all atoms are balls with their van der Waals "
    "radii (--select all, --radius element); --select '//*/*' adds ligands and water.",
    {},
    {},
    "kds surface 1a4y.pdb --chain A,B --select heavy --out areas\n"
    "kds surface villin.dcd --topology villin.pdb --frames ::10 --json -\n"
    "kds surface villin.dcd --topology villin.pdb --at 0,12.5,13"};

const OptionList<SurfaceTask>& surface_task_options() {
  using O = SurfaceTask;
  static const auto list =
      OptionList<O>()
          .with(union_options())
          .with({list_option({"--at", "LIST",
                              "times to measure, counted in frames that are read, from 0: 2.5 is halfway "
                              "from frame 2 to "
                              "frame 3; results are in ascending order (default: all frames)"},
                             &O::times,
                             [](const std::string& text) {
                               return parse_reals("--at", text, {0, 1e15});
                             }),
                 of_output(whole_option(
                     {"--threads", "N", "measure frames on up to N threads (default: all cores)"},
                     &O::threads, 1, 1024))});
  return list;
}

Table<SurfaceFrame> frame_columns(const SurfaceReport& report) {
  using F = SurfaceFrame;
  Table<F> table({{.key = "frame", .heading = "frame", .value = [](const F& f) { return Field(f.frame); }}});
  if (report.frames.front().picoseconds)
    table.add({{.key = "picoseconds", .heading = "time (ps)", .value = [](const F& f) {
                  return Field(f.picoseconds);
                }}});
  table.add({{.key = "area",
              .heading = in_unit("area", report.unit, 2),
              .value = [](const F& f) { return Field(f.area); },
              .format = with_decimals(3)},
             {.key = "volume",
              .heading = in_unit("volume", report.unit, 3),
              .value = [](const F& f) { return Field(f.volume); },
              .format = with_decimals(3)}});
  if (report.chains.names.size() > 1)
    table.add({{.key = "between_chains",
                .heading = in_unit("contact between chains", report.unit, 2),
                .value = [](const F& f) { return Field(f.buried()); },
                .format = with_decimals(3)}});
  return table;
}

/// A quantity over all frames.
struct Summary {
  std::string name;
  double mean = 0, least = 0, most = 0;
};
Summary summary_of(std::string name, const SurfaceReport& report,
                   const std::function<double(const SurfaceFrame&)>& of) {
  Summary summary{std::move(name), 0, of(report.frames.front()), of(report.frames.front())};
  for (const SurfaceFrame& frame : report.frames) {
    const double value = of(frame);
    summary.mean += value / static_cast<double>(report.frames.size());
    summary.least = std::min(summary.least, value);
    summary.most = std::max(summary.most, value);
  }
  return summary;
}

const Table<Summary>& summary_columns() {
  const auto column = [](const char* heading, double Summary::*number) {
    return Column<Summary>{.key = heading,
                           .heading = heading,
                           .value = [number](const Summary& s) { return Field(s.*number); },
                           .format = with_decimals(3)};
  };
  static const Table<Summary> table{
      {{.key = "name", .heading = "over frames", .value = [](const Summary& s) { return Field(s.name); }},
       column("mean", &Summary::mean),
       column("least", &Summary::least),
       column("most", &Summary::most)}};
  return table;
}

std::vector<Summary> residue_summaries(const SurfaceReport& report) {
  std::vector<Summary> summaries;
  if (report.residues)
    for (std::size_t r = 0; r < report.residues->names.size(); ++r)
      summaries.push_back(summary_of(report.residues->names[r], report,
                                     [r](const SurfaceFrame& f) { return f.residue_areas[r]; }));
  return summaries;
}

std::vector<Summary> chain_summaries(const SurfaceReport& report) {
  std::vector<Summary> summaries;
  const std::vector<std::string>& names = report.chains.names;
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const SurfaceFrame& frame : report.frames)
    for (const auto& [pair, area] : frame.between) pairs.insert(pair);
  for (const auto& pair : pairs)
    summaries.push_back(summary_of(fmt::format("{} and {}", names[pair.first], names[pair.second]), report,
                                   [&pair](const SurfaceFrame& f) {
                                     const auto found = f.between.find(pair);
                                     return found == f.between.end() ? 0 : found->second;
                                   }));
  return summaries;
}

// Files with a line for each element of each frame.

void write_atoms(const SurfaceReport& report, std::ostream& stream) {
  stream << "frame,bead,name,area,volume\n";
  std::vector<std::string> names;
  for (BeadId bead = 0; bead < report.scene->bead_count(); ++bead)
    names.push_back(csv_field(report.scene->bead_name(bead)));
  for (const SurfaceFrame& frame : report.frames)
    for (std::size_t bead = 0; bead < names.size(); ++bead)
      stream << fmt::format("{},{},{},{},{}\n", frame.frame, bead, names[bead], frame.measures.areas[bead],
                            frame.measures.volumes[bead]);
}
void write_residues(const SurfaceReport& report, std::ostream& stream) {
  stream << "frame,residue,name,area,volume\n";
  for (const SurfaceFrame& frame : report.frames)
    for (std::size_t r = 0; r < frame.residue_areas.size(); ++r)
      stream << fmt::format("{},{},{},{},{}\n", frame.frame, r, csv_field(report.residues->names[r]),
                            frame.residue_areas[r], frame.residue_volumes[r]);
}
void write_contacts(const SurfaceReport& report, std::ostream& stream) {
  stream << "frame,i,j,area\n";
  for (const SurfaceFrame& frame : report.frames)
    for (std::size_t e = 0; e < frame.edges.size(); ++e)
      stream << fmt::format("{},{},{},{}\n", frame.frame, frame.edges[e][0], frame.edges[e][1],
                            frame.measures.contacts[e]);
}
void write_chains(const SurfaceReport& report, std::ostream& stream) {
  stream << "frame,first,second,area\n";
  const std::vector<std::string>& names = report.chains.names;
  for (const SurfaceFrame& frame : report.frames)
    for (const auto& [pair, area] : frame.between)
      stream << fmt::format("{},{},{},{}\n", frame.frame, csv_field(names[pair.first]),
                            csv_field(names[pair.second]), area);
}

}  // namespace

SurfaceOptions parse_surface_options(const Arguments& arguments) {
  using O = SurfaceOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, surface_task_options())
          .with(&O::destinations,
                destination_options(
                    "write surface.json, surface.csv, atoms.csv, contacts.csv, report.html and, if the "
                    "input names residues or has several chains, residues.csv and chains.csv to DIR "
                    "(default: none)"));
  O options;
  const ParsedArguments parsed = read_arguments(with_inputs(kSurfaceCommand), list, arguments, options);
  take_inputs(parsed, kSurfaceCommand.name, options.task);
  return options;
}

void add_surface(const SurfaceReport& report, Json& json) {
  json["unit"] = report.unit;
  json["probe"] = report.scene->probe();
  json["rows"] = frame_columns(report).json(report.frames);
  json["residues"] = summary_columns().json(residue_summaries(report));
  json["chains"] = summary_columns().json(chain_summaries(report));
}

std::string surface_text(const SurfaceReport& report) {
  constexpr std::size_t most_frames = 10, most_residues = 10;
  std::string text;
  if (report.frames.size() <= most_frames) {
    text = frame_columns(report).text(report.frames);
  } else {
    std::vector<Summary> totals{
        summary_of(in_unit("area", report.unit, 2), report, [](const SurfaceFrame& f) { return f.area; }),
        summary_of(in_unit("volume", report.unit, 3), report,
                   [](const SurfaceFrame& f) { return f.volume; })};
    if (report.chains.names.size() > 1)
      totals.push_back(summary_of(in_unit("contact between chains", report.unit, 2), report,
                                  [](const SurfaceFrame& f) { return f.buried(); }));
    text = summary_columns().text(totals);
  }
  std::vector<Summary> residues = residue_summaries(report);
  const std::size_t shown = std::min(most_residues, residues.size());
  std::partial_sort(residues.begin(), residues.begin() + static_cast<std::ptrdiff_t>(shown), residues.end(),
                    [](const Summary& a, const Summary& b) { return a.mean > b.mean; });
  if (shown > 0)
    text += fmt::format("\n{} of residues, the largest {} of {}:\n", in_unit("Area", report.unit, 2), shown,
                        residues.size()) +
            summary_columns().text(std::span(residues).first(shown));
  const std::vector<Summary> chains = chain_summaries(report);
  if (!chains.empty())
    text += fmt::format("\n{} of pairs of chains:\n", in_unit("Contact area", report.unit, 2)) +
            summary_columns().text(chains);
  return text;
}

int surface_command(const Arguments& arguments) {
  const SurfaceOptions options = parse_surface_options(arguments);
  const SurfaceTask& task = options.task;
  TableCommand command("surface", arguments, options.destinations, "frame");
  command.check_inputs_and_destinations(task);
  const SurfaceReport report =
      measure_surface(task, options.destinations.out.has_value(), command.progress(), command.warn());
  Json json;
  InputSize size = size_of(*report.scene);
  size.frames = report.frame_count;
  json["input"] = input_json(task, size, report.scene->radii());
  json["settings"] = surface_task_options().settings_json(task);
  add_surface(report, json);
  json["warnings"] = command.warnings();
  TableCommand::Csvs csvs{{"surface.csv", frame_columns(report).csv(report.frames)}};
  const auto add = [&](const char* name, void (*write)(const SurfaceReport&, std::ostream&)) {
    csvs.emplace_back(name, CsvContent([&report, write](std::ostream& stream) { write(report, stream); }));
  };
  add("atoms.csv", write_atoms);
  add("contacts.csv", write_contacts);
  if (report.residues) add("residues.csv", write_residues);
  if (report.chains.names.size() > 1) add("chains.csv", write_chains);
  command.deliver(json, csvs, surface_text(report));
  return 0;
}

}  // namespace kds
