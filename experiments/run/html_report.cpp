#include "experiments/run/html_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "certificates/base/kernel.h"
#include "experiments/events/contact_map.h"
#include "experiments/events/event_distribution.h"
#include "experiments/events/frame_axis.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "motions/readers/bead_name.h"

namespace kds {

namespace {

// Returns the text that shows a kind of event. Internal kinds, which the total excludes, are marked as
// internal.
std::string kind_label(const RunReport& report, const std::string& kind) {
  for (const StructureReport& structure : report.structures)
    if (const std::string label = structure.label_of(kind); label != kind) return label;
  return kind;
}

using Figure = std::function<std::string(const StructureReport&)>;

SummaryRow row(const RunReport& report, std::string label, bool detail, const Figure& figure) {
  SummaryRow line{std::move(label), detail, {}};
  for (const StructureReport& structure : report.structures) line.cells.push_back(figure(structure));
  return line;
}

Figure count(std::uint64_t StructureReport::*member) {
  return [member](const StructureReport& structure) { return with_thousands(structure.*member); };
}

Figure time(double StructureReport::*member) {
  return [member](const StructureReport& structure) { return short_decimal(structure.*member); };
}

// Returns the union of all structures' kinds or stages, in order of appearance. Each structure counts only
// its own kinds and stages.
std::vector<std::string> names_of_any(const RunReport& report, NamedCounts StructureReport::*member) {
  std::vector<std::string> names;
  for (const StructureReport& structure : report.structures)
    for (const auto& [name, value] : structure.*member)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

Figure count_named(NamedCounts StructureReport::*member, const std::string& name) {
  return [member, name](const StructureReport& structure) {
    for (const auto& [key, value] : structure.*member)
      if (key == name) return with_thousands(value);
    return std::string("-");
  };
}

void add_kinds(std::vector<SummaryRow>& rows, const RunReport& report) {
  constexpr auto member = &StructureReport::events_by_kind;
  for (const std::string& name : names_of_any(report, member))
    rows.push_back(row(report, kind_label(report, name), true, count_named(member, name)));
}

// Adds rows only if a structure has contacts.
void add_contacts(std::vector<SummaryRow>& rows, const RunReport& report) {
  const auto add = [&](const char* label, std::optional<std::uint64_t> StructureReport::*member) {
    rows.push_back(row(report, label, false, [member](const StructureReport& structure) {
      return structure.*member ? with_thousands(*(structure.*member)) : std::string("-");
    }));
  };
  if (std::ranges::none_of(report.structures,
                           [](const StructureReport& s) { return s.contacts_at_start.has_value(); }))
    return;
  add("contacts at the start", &StructureReport::contacts_at_start);
  add("contacts at the end", &StructureReport::contacts_at_end);
}

// Returns the heading above a stage of the summary. A size has no heading.
std::string_view heading_of(Stage::Of of) {
  switch (of) {
    case Stage::Of::failure_time:
      return "failure times settled by";
    case Stage::Of::sign:
      return "signs just after settled by";
    case Stage::Of::size:
      break;
  }
  return "";
}

void add_stages(std::vector<SummaryRow>& rows, const RunReport& report) {
  constexpr auto member = &StructureReport::stages;
  std::string_view heading;
  for (const std::string& name : names_of_any(report, member)) {
    const auto* const stage = std::ranges::find(stage_table, name, &Stage::name);
    const bool known = stage != stage_table.end();
    const std::string_view above = heading_of(known ? stage->of : Stage::Of::failure_time);
    if (above != heading && !above.empty()) rows.push_back({std::string(above), false, {}});
    heading = above;
    rows.push_back(
        row(report, known ? std::string(stage->label) : name, !heading.empty(), count_named(member, name)));
  }
}

std::string per_step(const StructureReport& structure) {
  const std::size_t steps = structure.course.steps();
  return steps == 0 ? "-"
                    : short_decimal(static_cast<double>(structure.events_total) / static_cast<double>(steps));
}

// The time of several rounds is shown with its spread.
Figure time(double StructureReport::*member, Spread StructureReport::*spread, std::size_t rounds) {
  if (rounds == 1) return time(member);
  return [spread](const StructureReport& structure) { return spread_text(structure.*spread); };
}

Figure ratio(std::size_t rounds) {
  return [rounds](const StructureReport& structure) {
    if (!(structure.static_seconds > 0)) return std::string("-");
    return rounds == 1 ? short_decimal(structure.seconds / structure.static_seconds)
                       : spread_text(structure.of_ratio);
  };
}

// Describes the frames if they are not the first frames of a file, or if their times are known.
std::string which_frames(const RunReport& report) {
  if (!report.first_frame || !report.last_frame) return "";
  const auto& [first, first_time] = *report.first_frame;
  const auto& [last, last_time] = *report.last_frame;
  std::string text;
  if (last + 1 != report.frames) text = fmt::format("{} to {}", first, last);
  if (first_time && last_time)
    text += fmt::format("{}{:.6g} to {:.6g} ps", text.empty() ? "" : ", ", *first_time, *last_time);
  return text.empty() ? text : fmt::format(" ({})", text);
}

// Returns the number of a bead with its name, if the input has names.
std::string name_of(const RunReport& report, std::size_t bead) {
  return bead_text(bead, bead < report.bead_names.size() ? report.bead_names[bead] : "");
}

void add_stride(std::vector<std::pair<std::string, std::string>>& lines, const RunReport& report) {
  const StrideCertificate& stride = *report.stride;
  const StrideDeviation& deviation = stride.deviation;
  lines.emplace_back(
      "stride",
      fmt::format("{} frames left out, in which beads are at most {:.6g} from their positions in the run "
                  "({}, frame {}): spheres enlarged by this length hold their beads at all times",
                  with_thousands(deviation.skipped), deviation.largest, name_of(report, deviation.bead),
                  deviation.frame));
  if (!stride.contacts) return;
  const auto& [found, sure, possible] = *stride.contacts;
  lines.emplace_back(
      "contacts",
      fmt::format("{} pairs found, {} of them sure; {} possible: at most {} are missed",
                  with_thousands(found.size()), with_thousands(sure.size()), with_thousands(possible.size()),
                  with_thousands(possible.size() - found.size())));
}

void add_approach(std::vector<std::pair<std::string, std::string>>& lines, const RunReport& report) {
  const ClosestApproach& approach = *report.approach;
  std::string text = fmt::format("{} and {} come nearest, to {:.6g}, at u = {:.3g} of the step from frame {}",
                                 name_of(report, approach.beads[0]), name_of(report, approach.beads[1]),
                                 approach.distance.upper, approach.u, approach.frame);
  if (const auto& range = report.approach_in_all_frames)
    text += fmt::format("; over all frames the least distance is between {:.6g} and {:.6g}", range->lower,
                        range->upper);
  lines.emplace_back("closest", text);
}

}  // namespace

std::vector<SummaryRow> summary_rows(const RunReport& report) {
  std::vector<SummaryRow> rows;
  rows.push_back(row(report, "events", false, count(&StructureReport::events_total)));
  add_kinds(rows, report);
  add_contacts(rows, report);
  rows.push_back(row(report, "events per step", false, per_step));
  rows.push_back(row(report, "certificates created", false, count(&StructureReport::created)));
  rows.push_back(row(report, "never failing", true, count(&StructureReport::never_failing)));
  rows.push_back(row(report, "cancelled", true, count(&StructureReport::cancelled)));
  rows.push_back(row(report, "failed", true, count(&StructureReport::failed)));
  rows.push_back(row(report, "most at once", true, count(&StructureReport::peak)));
  rows.push_back(row(report, "most on one bead", true, count(&StructureReport::per_bead_max)));
  add_stages(rows, report);
  rows.push_back(row(report, "seconds", false,
                     time(&StructureReport::seconds, &StructureReport::of_seconds, report.rounds)));
  rows.push_back(row(report, "first build", true, time(&StructureReport::build_seconds)));
  rows.push_back(
      row(report, "static build at every frame", true,
          time(&StructureReport::static_seconds, &StructureReport::of_static_seconds, report.rounds)));
  rows.push_back(row(report, "kinetic / static", true, ratio(report.rounds)));
  rows.push_back(row(report, "rebuilds", false, count(&StructureReport::rebuilds)));
  rows.push_back(row(report, "audits", false, count(&StructureReport::audits_run)));
  rows.push_back(row(report, "failed", true, count(&StructureReport::audits_failed)));
  return rows;
}

std::vector<std::pair<std::string, std::string>> input_lines(const RunReport& report) {
  std::string scene = fmt::format("{} beads, {} frames{}, dimension {}", with_thousands(report.beads),
                                  with_thousands(report.frames), which_frames(report), report.dimension);
  scene += report.radius_min == report.radius_max
               ? fmt::format(", radius {:.6g}", report.radius_min)
               : fmt::format(", radii {:.6g} to {:.6g}", report.radius_min, report.radius_max);
  std::vector<std::string> settings;
  for (const auto& [name, value] : report.settings)
    if (!value.empty()) settings.push_back(name + " " + value);
  std::vector<std::pair<std::string, std::string>> lines{
      {"input", fmt::format("{}", fmt::join(report.files, ", "))},
      {"scene", scene},
      {"settings", fmt::format("{}", fmt::join(settings, ", "))}};
  if (report.stride) add_stride(lines, report);
  if (report.approach) add_approach(lines, report);
  return lines;
}

std::size_t step_count(const RunReport& report) {
  std::size_t steps = 0;
  for (const StructureReport& structure : report.structures)
    steps = std::max(steps, structure.course.steps());
  return steps;
}

namespace {

constexpr std::string_view kWords =
    "An <em>event</em> is a change of the structure itself, found at the exact time at which one of its "
    "<em>certificates</em> fails. Certificates are sign conditions on a few beads, which prove the structure "
    "correct while they hold. Between two frames every bead moves by a known polynomial, so no event in "
    "between is missed. Internal events are bookkeeping and are not in the total. <em>Kinetic / static</em> "
    "is the ratio to the time to build the same structure from scratch at every frame. Times are those of "
    "one run and vary from run to run. With <code>--rounds</code> they are medians, with the least and the "
    "most in brackets.";

// Names as many files as fit on a line, at least one, and counts the others.
std::string title(const RunReport& report) {
  constexpr std::size_t most_letters = 48;
  std::string names;
  std::size_t named = 0;
  for (const std::string& file : report.files) {
    const std::string name = std::filesystem::path(file).filename().string();
    if (named > 0 && names.size() + 2 + name.size() > most_letters) break;
    names += (named == 0 ? "" : ", ") + name;
    ++named;
  }
  if (named < report.files.size()) names += fmt::format(" and {} more", report.files.size() - named);
  return "kds run: " + names;
}

double a_step(std::uint64_t events, std::size_t steps) {
  return static_cast<double>(events) / static_cast<double>(std::max<std::size_t>(1, steps));
}

// Returns where a structure changes most often, or an empty text if no event names a bead.
std::string busiest_bead(const RunReport& report, const StructureReport& structure) {
  const auto& counts = structure.distribution.by_bead;
  const auto most = std::ranges::max_element(counts);
  if (most == counts.end() || *most == 0) return "";
  return fmt::format(", most often at {} ({})",
                     html_escaped(name_of(report, static_cast<std::size_t>(most - counts.begin()))),
                     with_thousands(*most));
}

std::string findings(const RunReport& report) {
  const std::size_t steps = step_count(report);
  std::string html = fmt::format("<p>In {} {} of {} beads", with_thousands(steps),
                                 steps == 1 ? "motion step" : "motion steps", with_thousands(report.beads));
  html += report.structures.empty() ? " nothing was maintained.</p>\n" : ":</p>\n<ul>\n";
  for (const StructureReport& structure : report.structures)
    html +=
        fmt::format("<li>The <strong>{}</strong> structure changed {} times ({} per step){}.</li>\n",
                    html_escaped(structure.name), with_thousands(structure.events_total),
                    short_decimal(a_step(structure.events_total, steps)), busiest_bead(report, structure));
  if (!report.structures.empty()) html += "</ul>\n";
  for (const StructureReport& structure : report.structures)
    if (report.rounds > 1 && structure.static_seconds > 0)
      html += fmt::format(
          "<p>Keeping the {} structure took {} times as long as building it anew at every frame.</p>\n",
          html_escaped(structure.name), spread_text(structure.of_ratio));
  return html;
}

std::string table(const RunReport& report) {
  std::vector<std::string> columns{""};
  for (const StructureReport& structure : report.structures) columns.push_back(structure.name);
  std::vector<HtmlRow> rows;
  for (const SummaryRow& row : summary_rows(report)) {
    HtmlRow& line = rows.emplace_back(HtmlRow{{row.label}, row.detail});
    line.cells.insert(line.cells.end(), row.cells.begin(), row.cells.end());
  }
  return html_table(columns, rows);
}

// Returns the frame at which a bin ends.
FrameStamp end_of(const RunReport& report, const std::vector<EventBin>& bins, std::size_t b) {
  if (b + 1 < bins.size()) return bins[b + 1].first_frame;
  return report.last_frame.value_or(FrameStamp{bins[b].first_frame.number + bins[b].steps, std::nullopt});
}

// Returns the axis of the frames at which the bins of the structures begin and end.
FrameAxis axis_of(const RunReport& report) {
  std::vector<FrameStamp> frames;
  for (const StructureReport& structure : report.structures) {  // all have the same bins
    const std::vector<EventBin>& bins = structure.course.bins();
    if (bins.empty()) continue;
    for (const EventBin& bin : bins) frames.push_back(bin.first_frame);
    frames.push_back(end_of(report, bins, bins.size() - 1));
    break;
  }
  return FrameAxis(frames);
}

std::string over_steps(std::size_t width) {
  return width > 1 ? fmt::format(" Each value is the mean over {} steps.", width) : "";
}
std::string of_steps(std::size_t width) {
  return width > 1 ? fmt::format(
                         " Each value is for {} steps: the mean over these steps, and for the farthest bead "
                         "the largest value in any of them.",
                         width)
                   : "";
}

// Returns the plot if it has one curve; otherwise one panel a curve, each with its own scale.
std::string one_scale_each(LinePlot plot) {
  if (plot.curves.size() == 1) return svg_plot(plot);
  PanelPlot panels;
  for (Curve& curve : plot.curves) {
    const std::string name = curve.name;
    panels.panels.push_back({name, {plot.x_label, plot.y_label, plot.drawn, {std::move(curve)}}});
  }
  return svg_plot(panels);
}

std::string plots_over_time(const RunReport& report) {
  std::size_t width = 1;
  const FrameAxis axis = axis_of(report);
  LinePlot rate{axis.label(), "events per step", Drawn::staircase, {}};
  LinePlot sum{axis.label(), "events so far", Drawn::line, {}};
  for (const StructureReport& structure : report.structures) {
    const std::vector<EventBin>& bins = structure.course.bins();
    width = std::max(width, structure.course.width());
    Curve per_step{structure.name, {}}, so_far{structure.name, {}};
    so_far.points.emplace_back(bins.empty() ? 0.0 : axis.coordinate(bins.front().first_frame), 0.0);
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const double mean = static_cast<double>(bins[b].events) / static_cast<double>(bins[b].steps);
      const double end = axis.coordinate(end_of(report, bins, b));
      per_step.points.emplace_back(axis.coordinate(bins[b].first_frame), mean);
      if (b + 1 == bins.size()) per_step.points.emplace_back(end, mean);
      so_far.points.emplace_back(end, static_cast<double>(bins[b].cumulative));
    }
    rate.curves.push_back(std::move(per_step));
    sum.curves.push_back(std::move(so_far));
  }
  std::string span;
  if (report.first_frame && report.first_frame->picoseconds && report.last_frame &&
      report.last_frame->picoseconds)
    span = fmt::format(" The frames are those from {:.6g} to {:.6g} ps.", *report.first_frame->picoseconds,
                       *report.last_frame->picoseconds);
  return html_figure(one_scale_each(rate), "Events between each frame and the next." + over_steps(width)) +
         html_figure(one_scale_each(sum), "Events since the first frame." + span);
}

std::string plot_of_displacement(const RunReport& report) {
  const auto& bins = report.displacement.bins();
  if (bins.size() < 2) return "";
  std::vector<FrameStamp> frames;
  for (const Displacements::Bin& bin : bins) frames.push_back(bin.first_frame);
  const FrameAxis axis(frames);
  LinePlot plot{
      axis.label(), "displacement", Drawn::staircase, {{"mean of the beads", {}}, {"farthest bead", {}}}};
  for (const Displacements::Bin& bin : bins) {
    const double x = axis.coordinate(bin.first_frame);
    plot.curves[0].points.emplace_back(x, bin.mean());
    plot.curves[1].points.emplace_back(x, bin.most);
  }
  return html_figure(
      svg_plot(plot),
      fmt::format("Displacements of beads from one frame to the next, in {}; the largest radius is {}.{}",
                  length_unit, short_decimal(report.radius_max), of_steps(report.displacement.width())));
}

// Kinds of events that undo each other.
constexpr std::array<std::array<std::string_view, 2>, 5> kOpposites{
    {{"enter", "leave"}, {"begin", "end"}, {"2-3", "3-2"}, {"1-4", "4-1"}, {"1-3", "3-1"}}};

std::string_view opposite_of(std::string_view kind) {
  for (const auto& [one, other] : kOpposites) {
    if (kind == one) return other;
    if (kind == other) return one;
  }
  return "";
}

// Returns the kinds of a structure that occur, each opposite in the row of its kind.
MirrorPlot rows_by_kind(const StructureReport& structure) {
  MirrorPlot plot{"events", {}};
  const auto& kinds = structure.events_by_kind;
  for (auto kind = kinds.begin(); kind != kinds.end(); ++kind) {
    const auto is_opposite = [&](const auto& other) { return other.first == opposite_of(kind->first); };
    if (std::any_of(kinds.begin(), kind, is_opposite)) continue;  // shown in a row above
    MirrorPlot::Row row{{structure.label_of(kind->first), static_cast<double>(kind->second)}};
    if (const auto other = std::find_if(kind, kinds.end(), is_opposite); other != kinds.end())
      row.left = {structure.label_of(other->first), static_cast<double>(other->second)};
    if (row.right.value > 0 || row.left.value > 0) plot.rows.push_back(std::move(row));
  }
  return plot;
}

std::string plots_by_kind(const RunReport& report) {
  std::string html;
  for (const StructureReport& structure : report.structures) {
    const MirrorPlot plot = rows_by_kind(structure);
    if (plot.rows.empty()) continue;
    const std::string name = html_escaped(structure.name);
    if (std::ranges::any_of(plot.rows, [](const auto& row) { return !row.left.name.empty(); })) {
      html += html_figure(
          svg_plot(plot),
          fmt::format("Events of the {} structure by kind, with opposite kinds in one row.", name));
      continue;
    }
    BarPlot bars{plot.x_label, {}};
    for (const MirrorPlot::Row& row : plot.rows) bars.bars.push_back({row.right.name, row.right.value});
    html += html_figure(svg_plot(bars), fmt::format("Events of the {} structure by kind.", name));
  }
  return html;
}

// Short names for maps: atom and residue of a bead, and the residues of a block of neighbouring beads. The
// names have numbers of beads if two beads share a short name, or if a bead has none.
class ShortNames {
 public:
  explicit ShortNames(const RunReport& report) : report_(report) {
    std::vector<BeadName> names;
    for (const std::string& text : report.bead_names)
      if (auto name = bead_name_of(text)) names.push_back(*std::move(name));
    const bool several =
        std::ranges::any_of(names, [&](const BeadName& name) { return name.chain != names.front().chain; });
    std::set<std::string> distinct;
    for (const BeadName& name : names) {
      residues_.push_back(residue_text(name, several));
      distinct.insert(name.atom + " of " + residues_.back());
      atoms_.push_back(name.atom);
    }
    are_distinct_ = distinct.size() == report.beads;
  }

  [[nodiscard]] std::string bead(std::size_t k) const {
    return are_distinct_ ? atoms_[k] + " of " + residues_[k] : name_of(report_, k);
  }
  [[nodiscard]] std::string block(std::size_t first, std::size_t last) const {
    if (first == last) return bead(first);
    if (!are_distinct_) return fmt::format("beads {} to {}", first, last);
    return residues_[first] == residues_[last] ? residues_[first]
                                               : residues_[first] + " to " + residues_[last];
  }

 private:
  const RunReport& report_;
  std::vector<std::string> atoms_, residues_;  // names, for each bead
  bool are_distinct_ = false;
};

std::string contact_map_of(const RunReport& report) {
  if (report.contact_pairs.empty()) return "";
  const ShortNames short_names(report);
  std::vector<std::string> names;
  for (std::size_t bead = 0; bead < report.beads; ++bead) names.push_back(short_names.bead(bead));
  return html_figure(
      contact_map("bead", names, report.contact_pairs, 150),
      "Occupancy of each pair of beads: the share of the time from the first to the last frame, "
      "counted in frames, in which the pair is in contact.");
}

std::string maps_over_time(const RunReport& report) {
  const ShortNames names(report);
  std::string html;
  for (const StructureReport& structure : report.structures) {
    const EventGrid& grid = structure.distribution.grid;
    const auto& by_bead = structure.distribution.by_bead;
    if (grid.counts.size() < 2 || std::ranges::all_of(by_bead, [](auto count) { return count == 0; }))
      continue;
    const FrameAxis axis(grid.edges);
    HeatPlot plot{axis.label(), "bead", "events", {}, {}, {}, {}};
    for (const FrameStamp& frame : grid.edges) plot.x_edges.push_back(axis.coordinate(frame));
    const auto first_of = [&](std::size_t block) {
      return std::min(block * grid.beads_per_block, by_bead.size());
    };
    for (std::size_t block = 0; block <= grid.counts.front().size(); ++block)
      plot.y_edges.push_back(static_cast<double>(first_of(block)) - 0.5);
    for (const auto& bin : grid.counts) plot.values.emplace_back(bin.begin(), bin.end());
    plot.text = [&](std::size_t bin, std::size_t block) {
      const std::size_t first = first_of(block), last = first_of(block + 1) - 1;
      return fmt::format("{}\nframes {} to {}", names.block(first, last), grid.edges[bin].number,
                         grid.edges[bin + 1].number);
    };
    html += html_figure(
        svg_plot(plot),
        fmt::format("Events of the {} structure by time and bead, {} a rectangle.",
                    html_escaped(structure.name),
                    grid.beads_per_block == 1 ? "one bead" : fmt::format("{} beads", grid.beads_per_block)));
  }
  return html;
}

std::string plot_along_chain(const RunReport& report) {
  const auto name_here = [&report](std::size_t bead) { return name_of(report, bead); };
  RowsPlot plot{"bead", 0, name_here, {}};
  for (const StructureReport& structure : report.structures) {
    const auto& counts = structure.distribution.by_bead;
    if (counts.empty()) continue;
    plot.columns = counts.size();
    const auto most = std::ranges::max_element(counts);
    const std::string note = fmt::format("at most {} events, at {}", with_thousands(*most),
                                         name_here(static_cast<std::size_t>(most - counts.begin())));
    plot.rows.push_back({structure.name, *most == 0 ? "no events" : note, {counts.begin(), counts.end()}});
  }
  if (plot.rows.empty()) return "";
  return html_figure(svg_plot(plot),
                     "Events along the chain, each row on its own scale. An event counts for each bead that "
                     "it names; for the wrapped hierarchy these are the beads of the new basis.");
}

}  // namespace

std::string html_report(const RunReport& report, const std::vector<std::string>& data,
                        const std::filesystem::path& replay) {
  Page page;
  page.title = title(report);
  page.found = findings(report);
  page.command_line = report.command_line;
  page.data = data;
  page.replay = replay;
  page.words = kWords;
  page.body = html_section("By kind", plots_by_kind(report));
  if (step_count(report) > 1 && !report.structures.empty())
    page.body += html_section("Over time", plots_over_time(report) + plot_of_displacement(report));
  page.body += html_section("Along the chain", plot_along_chain(report));
  page.body += html_section("Over time along the chain", maps_over_time(report));
  page.body += html_section("Contact map", contact_map_of(report));
  page.body += html_section("Numbers", table(report));
  auto inputs = input_lines(report);
  inputs.emplace_back("fingerprint", hex_digits(report.fingerprint));
  page.body += html_section("Input", html_terms(inputs));
  return html_page(page);
}

}  // namespace kds
