#include "experiments/voids/voids_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/program/commands.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/program/timing.h"
#include "experiments/run/page_of_run.h"
#include "experiments/run/run_options.h"

namespace kds {

namespace {

constexpr CommandSpec kVoidsCommand{
    "kds voids",
    "Follows the voids of the union of balls: cavities that no probe can leave. Gives the times at which "
    "each one is closed, exactly for the paths between frames, the gate through which it opens, its atoms, "
    "and its volume at frames. By default all atoms of the chains are balls with their van der Waals radii "
    "(--select all, --radius element); --select '//*/*' adds ligands and water.",
    {},
    {},
    "kds voids dhodh.dcd --topology dhodh.pdb --persistence 0.1 --out voids\n"
    "kds voids villin.dcd --topology villin.pdb --probe 1.2 --json -"};

const OptionList<VoidsTask>& voids_task_options() {
  using O = VoidsTask;
  static const auto list =
      OptionList<O>()
          .with(union_options())
          .with({real_option({"--persistence", "TIME",
                              "bridge openings shorter than this, and leave out cavities that are never "
                              "closed for so long; "
                              "in picoseconds if the frames have times, otherwise in frames (default: 0)"},
                             &O::persistence, {0, 1e12}),
                 flag_option("--tunnels",
                             "also find how long each tunnel lasts, by zigzag persistence. Keeps all events "
                             "in memory (default: tunnels are counted)",
                             &O::tunnels)});
  return list;
}

/// A cavity with its number, as a row of tables.
struct CavityRow {
  std::size_t number;
  const Cavity* cavity;
  const VoidsReport* report;

  [[nodiscard]] const ClosedStretch& first() const { return cavity->stretches.front(); }
  [[nodiscard]] const ClosedStretch& last() const { return cavity->stretches.back(); }
  [[nodiscard]] double closed() const {
    double sum = 0;
    for (const ClosedStretch& stretch : cavity->stretches) sum += stretch.length();
    return sum;
  }
  [[nodiscard]] double longest() const {
    double longest = 0;
    for (const ClosedStretch& stretch : cavity->stretches) longest = std::max(longest, stretch.length());
    return longest;
  }
  /// Returns the volumes at the frames in which the cavity is closed.
  [[nodiscard]] std::vector<double> volumes() const {
    std::vector<double> volumes;
    for (const VoidSample& sample : cavity->samples) volumes.push_back(sample.volume);
    return volumes;
  }
  /// Returns the median, least or largest of these volumes, or nothing.
  [[nodiscard]] std::optional<double> volume(double Spread::*which) const {
    if (cavity->samples.empty()) return std::nullopt;
    return spread_of(volumes()).*which;
  }
};

std::vector<CavityRow> rows_of(const VoidsReport& report) {
  std::vector<CavityRow> rows;
  for (const Cavity& cavity : report.cavities) rows.push_back({rows.size(), &cavity, &report});
  return rows;
}

std::string names_of(const VoidsReport& report, const auto& beads) {
  std::string names;
  for (const BeadId bead : beads) names += (names.empty() ? "" : "; ") + report.scene->bead_name(bead);
  return names;
}

Table<CavityRow> cavity_columns(const VoidsReport& report) {
  using R = CavityRow;
  const std::string unit = report.has_times ? " (ps)" : " (frames)";
  const auto column = [](std::string key, std::string heading, std::function<Field(const R&)> value,
                         FieldFormat format = plainly) {
    return Column<R>{std::move(key), std::move(heading), std::move(value), std::move(format)};
  };
  const auto volume = [&](const char* key, const std::string& heading, double Spread::*which) {
    return column(
        key, heading, [which](const R& r) { return Field(r.volume(which)); }, with_figures(4));
  };
  return Table<R>(
      {column("cavity", "cavity", [](const R& r) { return Field(r.number); }),
       column(
           "first_closed_frame", "from frame", [](const R& r) { return Field(r.first().begin.at.frame); },
           shortly),
       column(
           "last_closed_frame", "to frame", [](const R& r) { return Field(r.last().end.at.frame); }, shortly),
       column("began", "began", [](const R& r) { return Field(r.first().begin.how); }),
       column("ended", "ended", [](const R& r) { return Field(r.last().end.how); }),
       column(
           "closed", "closed" + unit, [](const R& r) { return Field(r.closed()); }, shortly),
       column(
           "longest", "longest" + unit, [](const R& r) { return Field(r.longest()); }, shortly),
       column("openings", "openings", [](const R& r) { return Field(r.cavity->stretches.size() - 1); }),
       column("frames", "in frames", [](const R& r) { return Field(r.cavity->samples.size()); }),
       volume("volume_median", in_unit("volume", report.unit, 3), &Spread::median),
       volume("volume_least", "", &Spread::least), volume("volume_most", "most", &Spread::most),
       column("atoms", "atoms", [](const R& r) { return Field(r.cavity->beads.size()); }),
       column("beads", "",
              [](const R& r) { return Field(fmt::format("{}", fmt::join(r.cavity->beads, " "))); }),
       column("names", "", [](const R& r) { return Field(names_of(*r.report, r.cavity->beads)); })});
}

/// How long closed stretches or tunnels last.
struct Lives {
  std::size_t unseen = 0;             ///< those without a frame
  std::vector<double> of_complete{};  ///< lengths of those that begin and end within the run

  explicit Lives(const std::vector<ClosedStretch>& all) {
    for (const ClosedStretch& one : all) {
      unseen += one.is_seen ? 0 : 1;
      if (one.is_complete()) of_complete.push_back(one.length());
    }
  }
  /// Returns a line about the lengths, which begins with `what`, or nothing if there are none.
  [[nodiscard]] std::string text(std::string_view what, std::string_view unit) const {
    if (of_complete.empty()) return "";
    const Spread spread = spread_of(of_complete);
    return fmt::format(
        "{} that begin and end within the run: {}, median {:.4g} {}, from {:.4g} to {:.4g} {}.\n", what,
        of_complete.size(), spread.median, unit, spread.least, spread.most, unit);
  }
};

Table<TopologyAtFrame> frame_columns(const VoidsReport& report) {
  using F = TopologyAtFrame;
  Table<F> table(
      {{.key = "frame", .heading = "frame", .value = [](const F& f) { return Field(f.at.frame); }}});
  if (report.has_times)
    table.add({{.key = "picoseconds", .heading = "time (ps)", .value = [](const F& f) {
                  return Field(f.at.picoseconds);
                }}});
  const auto betti = [](const char* key, const char* heading, std::size_t which) {
    return Column<F>{
        .key = key, .heading = heading, .value = [which](const F& f) { return Field(f.betti[which]); }};
  };
  table.add({betti("b0", "components", 0),
             betti("b1", "tunnels", 1),
             betti("b2", "voids", 2),
             {.key = "volume",
              .heading = in_unit("volume of voids", report.unit, 3),
              .value = [](const F& f) { return Field(f.volume); },
              .format = with_figures(4)},
             {.key = "zigzag_lines", .value = [](const F& f) { return Field(f.zigzag_lines); }}});
  return table;
}

/// A closed stretch of a cavity or the life of a tunnel, or a cavity at a frame in which it is closed.
struct StretchRow {
  std::size_t number;  ///< of the cavity or tunnel
  const ClosedStretch* stretch;
};
struct SampleRow {
  std::size_t cavity;
  double frame;
  const VoidSample* sample;
};

/// `of` is "cavity" or "tunnel".
Table<StretchRow> stretch_columns(const VoidsReport& report, const char* of) {
  using R = StretchRow;
  Table<R> table({{.key = of, .value = [](const R& r) { return Field(r.number); }}});
  if (of == std::string_view("cavity"))
    table.add({{.key = "void", .value = [](const R& r) { return Field(r.stretch->number); }}});
  const auto add_end = [&](const std::string& key, const std::string& how, VoidEnd ClosedStretch::*end) {
    const auto column = [&](const std::string& name, auto value) {
      return Column<R>{.key = name, .value = [=](const R& r) { return Field(value(r.stretch->*end)); }};
    };
    table.add(
        {column(key + "_frame", [](const VoidEnd& e) { return e.at.frame; }),
         column(key + "_picoseconds", [](const VoidEnd& e) { return e.at.picoseconds; }),
         column(how, [](const VoidEnd& e) { return e.how; }),
         column(key + "_beads", [](const VoidEnd& e) { return fmt::format("{}", fmt::join(e.beads, " ")); }),
         column(key + "_names", [&report](const VoidEnd& e) { return names_of(report, e.beads); })});
  };
  add_end("begin", "began", &ClosedStretch::begin);
  add_end("end", "ended", &ClosedStretch::end);
  table.add({{.key = "in_a_frame", .value = [](const R& r) { return Field(r.stretch->is_seen); }}});
  return table;
}

std::vector<StretchRow> stretch_rows(const VoidsReport& report) {
  std::vector<StretchRow> rows;
  for (std::size_t cavity = 0; cavity < report.cavities.size(); ++cavity)
    for (const ClosedStretch& stretch : report.cavities[cavity].stretches) rows.push_back({cavity, &stretch});
  return rows;
}

std::vector<StretchRow> tunnel_rows(const VoidsReport& report) {
  std::vector<StretchRow> rows;
  for (const ClosedStretch& tunnel : report.tunnels) rows.push_back({rows.size(), &tunnel});
  return rows;
}

const Table<SampleRow>& sample_columns() {
  using R = SampleRow;
  static const Table<R> table({{.key = "frame", .value = [](const R& r) { return Field(r.frame); }},
                               {.key = "cavity", .value = [](const R& r) { return Field(r.cavity); }},
                               {.key = "volume", .value = [](const R& r) { return Field(r.sample->volume); }},
                               {.key = "area", .value = [](const R& r) { return Field(r.sample->area); }}});
  return table;
}

std::vector<SampleRow> sample_rows(const VoidsReport& report) {
  std::vector<SampleRow> rows;
  for (std::size_t cavity = 0; cavity < report.cavities.size(); ++cavity)
    for (const VoidSample& sample : report.cavities[cavity].samples)
      rows.push_back({cavity, report.frames[sample.frame].at.frame, &sample});
  return rows;
}

}  // namespace

VoidsOptions parse_voids_options(const Arguments& arguments) {
  using O = VoidsOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, voids_task_options())
          .with(
              &O::destinations,
              destination_options("write voids.json, voids.csv, stretches.csv, volumes.csv, frames.csv, "
                                  "zigzag.txt (all simplices as a zigzag filtration), report.html and, with "
                                  "--tunnels, tunnels.csv to "
                                  "DIR (default: none)"))
          .with({view_option(&O::view,
                             "run once more, and write a page that shows the complex and its voids in a "
                             "browser to FILE (default: none)")});
  O options;
  const ParsedArguments parsed = read_arguments(with_inputs(kVoidsCommand), list, arguments, options);
  take_inputs(parsed, kVoidsCommand.name, options.task);
  return options;
}

void add_voids(const VoidsReport& report, Json& json) {
  const Lives lives(report.all);
  json["unit"] = report.unit;
  json["probe"] = report.scene->probe();
  json["clock"] = report.has_times ? "ps" : "frames";
  json["rows"] = cavity_columns(report).json(rows_of(report));
  json["short_cavities"] = report.short_ones;
  json["stretches"] = stretch_columns(report, "cavity").json(stretch_rows(report));
  json["volumes"] = sample_columns().json(sample_rows(report));
  Json& of_lives = json["lives"];
  of_lives["all"] = report.all.size();
  of_lives["in_no_frame"] = lives.unseen;
  of_lives["complete"] = lives.of_complete.size();
  if (!lives.of_complete.empty()) {
    const Spread spread = spread_of(lives.of_complete);
    of_lives["shortest"] = spread.least;
    of_lives["median"] = spread.median;
    of_lives["longest"] = spread.most;
  }
  json["tunnels"] = {{"begun", report.tunnels_begun}, {"ended", report.tunnels_ended}};
  json["lives_of_tunnels"] = stretch_columns(report, "tunnel").json(tunnel_rows(report));
  json["frames"] = frame_columns(report).json(report.frames);
}

std::string voids_text(const VoidsReport& report) {
  constexpr std::size_t most_shown = 15;
  const char* const unit = report.has_times ? "ps" : "frames";
  std::vector<CavityRow> rows = rows_of(report);
  std::string text;
  const std::size_t shown = std::min(most_shown, rows.size());
  if (shown > 0) {
    std::stable_sort(rows.begin(), rows.end(), [](const CavityRow& a, const CavityRow& b) {
      const auto rank = [](const CavityRow& row) {
        return std::pair(row.closed(), row.volume(&Spread::most));
      };
      return rank(a) > rank(b);
    });
    text = cavity_columns(report).text(std::span(rows).first(shown)) + '\n';
  }
  text += fmt::format("Cavities shown: {} of {}, those that are closed longest.\n", shown, rows.size());
  if (report.short_ones > 0)
    text += fmt::format("Cavities left out, because no stretch is as long as --persistence: {}.\n",
                        report.short_ones);
  const Lives lives(report.all);
  text += fmt::format("Stretches of time in which a cavity is closed: {}, of which {} contain no frame.\n",
                      report.all.size(), lives.unseen);
  text += lives.text("Stretches", unit);
  text += fmt::format("Tunnels: {} began and {} ended.\n", report.tunnels_begun, report.tunnels_ended);
  if (report.tunnels.empty()) return text;
  const Lives of_tunnels(report.tunnels);
  text += fmt::format("Lives of tunnels: {}, of which {} contain no frame.\n", report.tunnels.size(),
                      of_tunnels.unseen);
  text += of_tunnels.text("Lives of tunnels", unit);
  return text;
}

int voids_command(const Arguments& arguments) {
  const VoidsOptions options = parse_voids_options(arguments);
  const VoidsTask& task = options.task;
  TableCommand command("voids", arguments, options.destinations, "step");
  check_inputs_exist(task);
  TakenPaths taken;
  taken.read(task);
  if (options.view) taken.write_page(*options.view, options.destinations);
  command.check_destinations(std::move(taken));
  const VoidsReport report =
      follow_voids(task, options.destinations.out.has_value(), command.progress(), command.warn());
  if (options.view) {
    RunOptions run;
    static_cast<InputOptions&>(run) = task;
    run.structures = {"voids"};
    run.motion = task.motion;
    run.probe = task.probe_length();
    write_page_of_run(run, *report.scene, *options.view, command.add_replay(*options.view),
                      command.progress());
  }
  Json json;
  json["input"] = input_json(task, size_of(*report.scene), report.scene->radii());
  json["settings"] = voids_task_options().settings_json(task);
  add_voids(report, json);
  json["warnings"] = command.warnings();
  TableCommand::Csvs csvs{{"voids.csv", cavity_columns(report).csv(rows_of(report))},
                          {"stretches.csv", stretch_columns(report, "cavity").csv(stretch_rows(report))},
                          {"volumes.csv", sample_columns().csv(sample_rows(report))},
                          {"frames.csv", frame_columns(report).csv(report.frames)},
                          {"zigzag.txt", report.zigzag}};
  if (task.tunnels)
    csvs.emplace_back("tunnels.csv", stretch_columns(report, "tunnel").csv(tunnel_rows(report)));
  command.deliver(json, csvs, voids_text(report));
  return 0;
}

}  // namespace kds
