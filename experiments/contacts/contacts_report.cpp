#include "experiments/contacts/contacts_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "experiments/events/contact_map.h"
#include "experiments/events/event_places.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

using Kind = FrameContacts::Kind;

/// A pair with the names of its elements.
struct PairRow {
  const PairLifetimes* pair;
  const ContactsReport* report;
  ContactBoundsOfPair bounds;  // only with a certificate

  [[nodiscard]] const std::string& first() const { return report->elements.names[pair->first]; }
  [[nodiscard]] const std::string& second() const { return report->elements.names[pair->second]; }
};

/// Returns a pair's column. Numbers for people have four figures.
Column<PairRow> pair_column(const char* key, std::string heading, Field (*value)(const PairLifetimes&),
                            FieldFormat format = shortly) {
  return {.key = key,
          .heading = std::move(heading),
          .value = [value](const PairRow& r) { return value(*r.pair); },
          .format = std::move(format)};
}

double share_of(double time, double all) { return all > 0 ? std::min(1.0, time / all) : 0; }

/// Headings name the unit of time.
Table<PairRow> pair_columns(const ContactsReport& report, const ContactsFigures& figures) {
  using P = PairLifetimes;
  const std::string unit = report.unit(), in_unit = " (" + unit + ")";
  Table<PairRow> table(
      {pair_column("i", "", [](const P& p) { return Field(p.first); }),
       pair_column("j", "", [](const P& p) { return Field(p.second); }),
       {.key = "first", .heading = "first", .value = [](const PairRow& r) { return Field(r.first()); }},
       {.key = "second", .heading = "second", .value = [](const PairRow& r) { return Field(r.second()); }},
       pair_column(
           "contacts", "contacts", [](const P& p) { return Field(p.contacts); }, plainly),
       pair_column(
           "occupancy", "occupancy %", [](const P& p) { return Field(p.occupancy()); }, in_percent),
       pair_column("total", "", [](const P& p) { return Field(p.total); }),
       pair_column("mean", "mean" + in_unit, [](const P& p) { return Field(p.mean()); }),
       pair_column("median", "median" + in_unit, [](const P& p) { return Field(p.median); }),
       pair_column("longest", "longest" + in_unit, [](const P& p) { return Field(p.longest); })});
  table.add(
      {pair_column("first_begin_frame", "first frame",
                   [](const P& p) { return Field(p.first_begin.rounded.frame); }),
       pair_column("last_end_frame", "last frame",
                   [](const P& p) { return Field(p.last_end.rounded.frame); }),
       pair_column("first_begin_picoseconds", "",
                   [](const P& p) { return Field(p.first_begin.rounded.picoseconds); }),
       pair_column("last_end_picoseconds", "",
                   [](const P& p) { return Field(p.last_end.rounded.picoseconds); }),
       pair_column(
           "open_at_start", "open at start", [](const P& p) { return Field(p.open_at_start > 0); }, plainly),
       pair_column(
           "open_at_end", "open at end", [](const P& p) { return Field(p.open_at_end > 0); }, plainly),
       pair_column("begin_rate", "", [](const P& p) { return Field(p.begin_rate()); }),
       pair_column("end_rate", "", [](const P& p) { return Field(p.end_rate()); }),
       pair_column("residence", "residence" + in_unit, [](const P& p) { return Field(p.residence()); }),
       {.key = "unit", .heading = "", .value = [unit](const PairRow&) { return Field(unit); }}});
  if (!figures.certificate) return table;
  const auto share = [](double ContactBoundsOfPair::*time) {
    return [time](const PairRow& r) { return Field(share_of(r.bounds.*time, r.report->run_length)); };
  };
  table.add(
      {{.key = "sure", .heading = "sure", .value = [](const PairRow& r) { return Field(r.bounds.sure); }},
       {.key = "least_occupancy",
        .heading = "occupancy at least %",
        .value = share(&ContactBoundsOfPair::least_time),
        .format = in_percent},
       {.key = "most_occupancy",
        .heading = "at most %",
        .value = share(&ContactBoundsOfPair::most_time),
        .format = in_percent}});
  return table;
}

std::vector<PairRow> rows_of(const ContactsReport& report, const ContactsFigures& figures) {
  std::vector<PairRow> rows;
  for (const PairLifetimes& pair : figures.pairs)
    rows.push_back({&pair, &report,
                    figures.certificate ? figures.certificate->pairs.at({pair.first, pair.second})
                                        : ContactBoundsOfPair{}});
  return rows;
}

/// Returns at most `most` pairs, those with the most contacts first, then those in contact longest.
std::vector<PairRow> busiest_of(const ContactsReport& report, const ContactsFigures& figures,
                                std::size_t most) {
  std::vector<PairRow> rows = rows_of(report, figures);
  std::stable_sort(rows.begin(), rows.end(), [](const PairRow& a, const PairRow& b) {
    if (a.pair->contacts != b.pair->contacts) return a.pair->contacts > b.pair->contacts;
    return a.pair->total > b.pair->total;
  });
  if (rows.size() > most) rows.resize(most);
  return rows;
}

/// The figures of one way of looking: the exact contacts, or those at samples.
struct LookRow {
  std::optional<double> frames_apart;  ///< empty: exact
  std::optional<std::size_t> samples;
  std::optional<std::uint64_t> found;
  struct Told {
    std::uint64_t contacts = 0;
    double life = 0, occupancy = 0;
  };
  std::array<std::optional<Told>, FrameContacts::kinds> told;  ///< by FrameContacts::Kind
};

std::vector<LookRow> looks_of(const ContactsReport& report) {
  const FrameContacts& frames = *report.frames;
  const bool two = report.has_two_cutoffs;
  const auto pairs = static_cast<double>(frames.pair_count());
  const auto exact = [&](Kind kind) {
    const FrameContacts::Sums& sums = frames.exact(kind);
    const double all = pairs * report.run_length;
    return LookRow::Told{sums.contacts,
                         sums.contacts == 0 ? 0 : sums.time / static_cast<double>(sums.contacts),
                         all > 0 ? sums.time / all : 0};
  };
  LookRow first{{}, {}, {}, {exact(FrameContacts::plain), {}, {}}};
  if (two) first.told[FrameContacts::dual] = exact(FrameContacts::dual);
  std::vector<LookRow> rows{first};
  const double frame = report.run_length / static_cast<double>(report.steps);
  for (const FrameContacts::Row& row : frames.rows()) {
    LookRow look{row.sampling.frames_apart(), row.sampling.samples, row.found, {}};
    for (const Kind kind : {FrameContacts::plain, FrameContacts::bridged, FrameContacts::dual}) {
      if (kind == FrameContacts::dual && !two) continue;
      look.told[kind] = {row.sums[kind].contacts, row.life(kind) * frame,
                         row.occupancy(kind, frames.pair_count())};
    }
    rows.push_back(look);
  }
  return rows;
}

std::string name_of_look(const LookRow& row) {
  if (!row.frames_apart) return "all times, exactly";
  const double apart = *row.frames_apart;
  return apart < 1    ? fmt::format("{} times a frame", 1 / apart)
         : apart == 1 ? "each frame"
                      : fmt::format("one frame in {}", apart);
}

constexpr std::array<const char*, FrameContacts::kinds> kind_keys{"plain", "bridged", "dual"};

Table<LookRow> look_columns(const ContactsReport& report) {
  Table<LookRow> table(
      {{.key = "spacing", .value = [](const LookRow& r) { return Field(r.frames_apart); }},
       {.heading = "looked at", .value = [](const LookRow& r) { return Field(name_of_look(r)); }},
       {.key = "samples", .heading = "samples", .value = [](const LookRow& r) { return Field(r.samples); }},
       {.key = "found", .heading = "found", .value = [](const LookRow& r) { return Field(r.found); }}});
  for (std::size_t kind = 0; kind < FrameContacts::kinds; ++kind) {
    if (kind == FrameContacts::dual && !report.has_two_cutoffs) continue;
    const std::string key = kind_keys[kind], start = kind == FrameContacts::plain ? "" : key + ": ";
    const auto told = [kind](auto member) {
      return [kind, member](const LookRow& r) {
        return r.told[kind] ? Field((*r.told[kind]).*member) : Field();
      };
    };
    table.add(
        {{.key = key + "_contacts", .heading = start + "contacts", .value = told(&LookRow::Told::contacts)},
         {.key = key + "_life",
          .heading = start + "life (" + report.unit() + ")",
          .value = told(&LookRow::Told::life),
          .format = shortly},
         {.key = key + "_occupancy",
          .heading = start + "occupancy %",
          .value = told(&LookRow::Told::occupancy),
          .format = in_percent}});
  }
  return table;
}

Table<SurvivalPoint> survival_columns() {
  using S = SurvivalPoint;
  return Table<SurvivalPoint>({{.key = "length", .value = [](const S& s) { return Field(s.length); }},
                               {.key = "at_risk", .value = [](const S& s) { return Field(s.at_risk); }},
                               {.key = "survival", .value = [](const S& s) { return Field(s.survival); }},
                               {.key = "lower", .value = [](const S& s) { return Field(s.lower); }},
                               {.key = "upper", .value = [](const S& s) { return Field(s.upper); }}});
}

}  // namespace

ContactsFigures figures_of(const ContactsReport& report) {
  ContactsFigures figures;
  report.lifetimes->visit_pairs(report.run_length,
                                [&](const PairLifetimes& pair) { figures.pairs.push_back(pair); });
  figures.all = report.lifetimes->all(report.run_length);
  constexpr double least_drop = 1.0 / 300;  // a plot is about this many pixels high
  figures.survival = report.lifetimes->survival(least_drop);
  return figures;
}

namespace {

Json certificate_json(const ContactsFigures& figures) {
  const ContactsCertificate& certificate = *figures.certificate;
  const StrideDeviation& deviation = certificate.deviation;
  const ContactBoundsOfPair& all = certificate.all;
  Json json{
      {"skipped", deviation.skipped},
      {"deviation", {{"largest", deviation.largest}, {"frame", deviation.frame}, {"bead", deviation.bead}}}};
  json["pairs"] = {{"found", figures.pairs.size()},
                   {"sure", certificate.sure_pairs},
                   {"possible", certificate.pairs.size()}};
  json["contacts"] = {{"found", figures.all.contacts},
                      {"sure", all.sure},
                      {"possible", certificate.is_found.size()},
                      {"least", all.least}};
  json["time"] = {{"found", figures.all.total}, {"least", all.least_time}, {"most", all.most_time}};
  return json;
}

}  // namespace

void add_contacts(const ContactsReport& report, const ContactsFigures& figures, Json& json) {
  const LifetimeFigures& all = figures.all;
  json["by"] = name_of(report.by);
  json["unit"] = report.unit();
  json["elements"] = report.elements.names.size();
  json["run_length"] = report.run_length;
  Json sums{{"pairs", figures.pairs.size()}, {"contacts", all.contacts}};
  sums["open_at_start"] = all.open_at_start;
  sums["open_at_end"] = all.open_at_end;
  sums["open_at_both"] = all.open_at_both;
  sums["occupancy"] = all.occupancy();
  sums["total"] = all.total;
  sums["mean"] = all.mean();
  sums["median"] = all.median;
  sums["longest"] = all.longest;
  sums["begin_rate"] = Field(all.begin_rate()).json();
  sums["end_rate"] = Field(all.end_rate()).json();
  sums["residence"] = Field(all.residence()).json();
  json["all"] = std::move(sums);
  if (figures.certificate) json["stride"] = certificate_json(figures);
  json["rows"] = pair_columns(report, figures).json(rows_of(report, figures));
  json["frames"] = look_columns(report).json(looks_of(report));
  json["survival"] = survival_columns().json(figures.survival);
  Json course = Json::array();
  const std::vector<double> means = report.course.means();
  for (std::size_t bin = 0; bin < means.size(); ++bin)
    course.push_back(Json{{"frame", report.frame_numbers[bin]}, {"contacts", means[bin]}});
  json["course"] = std::move(course);
}

std::string contacts_csv(const ContactsReport& report, const ContactsFigures& figures) {
  return pair_columns(report, figures).csv(rows_of(report, figures));
}

std::string frames_csv(const ContactsReport& report) { return look_columns(report).csv(looks_of(report)); }

namespace {

/// Writes lines of intervals. A last column, if it has a name, shows the flags.
struct IntervalsCsv {
  const ContactsReport& report;
  std::string_view last_column, if_set, if_not;

  void write(const SpooledRecords<IntervalRecord>& intervals, const std::vector<std::uint8_t>& flags,
             std::ostream& stream) const {
    const bool timed = report.has_times(), flagged = !last_column.empty();
    std::vector<std::string> names;
    for (const std::string& name : report.elements.names) names.push_back(csv_field(name));
    stream << "i,j,first,second,begin_frame,end_frame" << (timed ? ",begin_picoseconds,end_picoseconds" : "")
           << ",length,open_at_start,open_at_end" << (flagged ? "," : "") << last_column << '\n';
    std::size_t place = 0;
    intervals.for_each([&](const IntervalRecord& r) {
      stream << fmt::format("{},{},{},{},{:.12g},{:.12g}", r.first, r.second, names[r.first], names[r.second],
                            r.begin_frame, r.end_frame);
      if (timed) stream << fmt::format(",{:.12g},{:.12g}", r.begin_picoseconds, r.end_picoseconds);
      stream << fmt::format(",{},{},{}", r.length, r.open_at_start, r.open_at_end);
      if (flagged) stream << ',' << (flags[place++] != 0 ? if_set : if_not);
      stream << '\n';
    });
  }
};

}  // namespace

void write_intervals_csv(const ContactsReport& report, const ContactsFigures& figures, std::ostream& stream) {
  if (figures.certificate)
    IntervalsCsv{report, "certainty", "sure", "possible"}.write(report.intervals,
                                                                figures.certificate->is_sure, stream);
  else
    IntervalsCsv{report, "", "", ""}.write(report.intervals, {}, stream);
}

void write_possible_csv(const ContactsReport& report, const ContactsCertificate& certificate,
                        std::ostream& stream) {
  IntervalsCsv{report, "found", "yes", "no"}.write(certificate.possible, certificate.is_found, stream);
}

namespace {

/// Returns what the certificate says, as lines with a label.
std::vector<std::pair<std::string, std::string>> certified_lines(const ContactsReport& report,
                                                                 const ContactsFigures& figures) {
  const ContactsCertificate& certificate = *figures.certificate;
  const StrideDeviation& deviation = certificate.deviation;
  const ContactBoundsOfPair& all = certificate.all;
  return {{"frames left out",
           fmt::format("{}, in which beads are at most {:.6g} from their positions in the run ({}, frame {})",
                       with_thousands(deviation.skipped), deviation.largest,
                       bead_text(deviation.bead, certificate.bead_name), deviation.frame)},
          {"pairs",
           fmt::format("{} found, {} of them sure; {} possible", with_thousands(figures.pairs.size()),
                       with_thousands(certificate.sure_pairs), with_thousands(certificate.pairs.size()))},
          {"contacts", fmt::format("{} found, {} of them sure; the true number is at least {}, and each true "
                                   "contact lies in one of {} possible ones",
                                   with_thousands(figures.all.contacts), with_thousands(all.sure),
                                   with_thousands(all.least), with_thousands(certificate.is_found.size()))},
          {"time in contact",
           fmt::format("{} {} found; the true time is between {} and {}", short_decimal(figures.all.total),
                       report.unit(), short_decimal(all.least_time), short_decimal(all.most_time))}};
}

}  // namespace

std::string contacts_text(const ContactsReport& report, const ContactsFigures& figures) {
  constexpr std::size_t most = 20;
  std::string text = look_columns(report).text(looks_of(report));
  if (figures.certificate) {
    text += '\n';
    for (const auto& [label, line] : certified_lines(report, figures))
      text += fmt::format("{}: {}\n", label, line);
  }
  const auto rows = busiest_of(report, figures, most);
  if (rows.empty()) return text;
  text += "\n" + pair_columns(report, figures).text(rows);
  if (figures.pairs.size() > most)
    text += fmt::format("... {} more pairs; --out DIR writes all of them\n",
                        with_thousands(figures.pairs.size() - most));
  return text;
}

namespace {

std::string map_of(const ContactsReport& report, const ContactsFigures& figures) {
  std::vector<PairOccupancy> pairs;
  for (const PairLifetimes& pair : figures.pairs)
    pairs.push_back({pair.first, pair.second, pair.occupancy()});
  return contact_map(std::string(name_of(report.by)), report.elements.names, pairs, 1000);
}

constexpr std::size_t timeline_rows = 120;

std::string timeline_caption(const ContactsFigures& figures) {
  return fmt::format("{} pairs, those with the most contacts first. The rows scroll.",
                     figures.pairs.size() > timeline_rows ? fmt::format("{} of the", timeline_rows) : "All");
}

/// Returns the spans of the pairs with the most contacts, in plots that scroll. Spans that one pixel holds
/// are joined.
std::string timeline_of(const ContactsReport& report, const ContactsFigures& figures) {
  constexpr std::size_t rows_in_plot = 30;
  constexpr double pixels = 600;
  const TimelinePlot empty{
      "frame", static_cast<double>(report.first_frame), static_cast<double>(report.last_frame), {}};
  std::vector<TimelinePlot> plots;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> places;
  for (const PairRow& row : busiest_of(report, figures, timeline_rows)) {
    if (plots.empty() || plots.back().rows.size() == rows_in_plot) plots.push_back(empty);
    places[{row.pair->first, row.pair->second}] = {plots.size() - 1, plots.back().rows.size()};
    plots.back().rows.push_back({row.first() + ", " + row.second(), {}});
  }
  const double pixel = (empty.to - empty.from) / pixels;
  report.intervals.for_each([&](const IntervalRecord& r) {
    const auto place = places.find({r.first, r.second});
    if (place == places.end()) return;
    auto& spans = plots[place->second.first].rows[place->second.second].spans;
    if (!spans.empty() && r.begin_frame - spans.back().second < pixel) {
      spans.back().second = r.end_frame;
    } else {
      spans.emplace_back(r.begin_frame, r.end_frame);
    }
  });
  std::string html = "<div class=\"rows\">\n";
  for (const TimelinePlot& plot : plots) html += svg_plot(plot);
  return html + "</div>\n";
}

std::string survival_plot(const ContactsReport& report, const ContactsFigures& figures) {
  LinePlot plot{
      "length of time (" + report.unit() + ")", "share of contacts that last", Drawn::staircase, {}};
  Curve survival{"survival", {{0, 1}}}, lower{"95% band", {{0, 1}}}, upper{"95% band", {{0, 1}}};
  for (const SurvivalPoint& point : figures.survival) {
    survival.points.emplace_back(point.length, point.survival);
    if (point.lower) lower.points.emplace_back(point.length, *point.lower);
    if (point.upper) upper.points.emplace_back(point.length, *point.upper);
  }
  plot.curves = {survival, lower, upper};
  return svg_plot(plot);
}

std::string course_plot(const ContactsReport& report) {
  LinePlot plot{"frame", "pairs in contact", Drawn::staircase, {{"", {}}}};
  const std::vector<double> means = report.course.means();
  auto& points = plot.curves.front().points;
  for (std::size_t bin = 0; bin < means.size(); ++bin)
    points.emplace_back(static_cast<double>(report.frame_numbers[bin]), means[bin]);
  points.emplace_back(static_cast<double>(report.last_frame), means.back());
  return svg_plot(plot);
}

/// Returns points of a figure of each kind of contact by the spacing of samples. `figure` takes the figure
/// divided by the exact one, and returns nothing to leave out the point.
template <class Value, class Figure>
LinePlot plot_by_spacing(const ContactsReport& report, const char* label, Value value, const Figure& figure) {
  const std::vector<LookRow> rows = looks_of(report);
  LinePlot plot{"frames apart", label, Drawn::points, {}};
  for (std::size_t kind = 0; kind < FrameContacts::kinds; ++kind) {
    const auto& exact = rows.front().told[kind == FrameContacts::dual ? kind : 0];
    if (!exact || !(static_cast<double>((*exact).*value) > 0)) continue;
    Curve curve{kind_keys[kind], {}};
    for (const LookRow& row : rows) {
      if (!row.frames_apart || !row.told[kind]) continue;
      const std::optional<double> at =
          figure(static_cast<double>((*row.told[kind]).*value) / static_cast<double>((*exact).*value));
      if (at) curve.points.emplace_back(*row.frames_apart, *at);
    }
    plot.curves.push_back(std::move(curve));
  }
  return plot;
}

/// Returns number, life and occupancy of contacts by the spacing of samples, divided by the exact ones.
std::string bias_plot(const ContactsReport& report) {
  const auto panel = [&](const char* title, auto value) {
    return PanelPlot::Panel{title, plot_by_spacing(report, "divided by the exact value", value,
                                                   [](double ratio) { return std::optional(ratio); })};
  };
  return svg_plot(
      PanelPlot{{panel("Number of contacts", &LookRow::Told::contacts),
                 panel("Mean life", &LookRow::Told::life), panel("Occupancy", &LookRow::Told::occupancy)}});
}

/// Returns the relative error of the mean life at samples. The axis is logarithmic and has no zero.
std::string error_plot(const ContactsReport& report) {
  return svg_plot(plot_by_spacing(
      report, "error of the mean life, divided by the exact life", &LookRow::Told::life,
      [](double ratio) { return ratio == 1 ? std::nullopt : std::optional(std::abs(ratio - 1)); }));
}

std::string findings_of(const ContactsReport& report, const ContactsFigures& figures) {
  const LifetimeFigures& all = figures.all;
  if (all.contacts == 0) return "<p>There are no contacts.</p>\n";
  std::string html = fmt::format(
      "<p><strong>{}</strong> contacts between <strong>{}</strong> pairs last {} {} on average, {} at the "
      "median and "
      "{} at the longest.",
      with_thousands(all.contacts), with_thousands(figures.pairs.size()), short_decimal(all.mean()),
      report.unit(), short_decimal(all.median), short_decimal(all.longest));
  if (const auto residence = all.residence())
    html += fmt::format(" The residence time is {} {}.", short_decimal(*residence), report.unit());
  html += fmt::format(" {} contacts are open at the first frame, and {} at the last.</p>\n",
                      with_thousands(all.open_at_start), with_thousands(all.open_at_end));
  const std::vector<LookRow> rows = looks_of(report);
  const LookRow::Told &exact = *rows.front().told[0], &most = *rows.back().told[0];
  html += fmt::format(
      "<p>With one cutoff and without a gap, there are {} contacts with a mean life of {} {}. Looking at {} "
      "shows <strong>{}</strong> contacts with a mean life of {} {}.</p>\n",
      with_thousands(exact.contacts), short_decimal(exact.life), report.unit(), name_of_look(rows.back()),
      with_thousands(most.contacts), short_decimal(most.life), report.unit());
  return html;
}

}  // namespace

std::string contacts_page(const ContactsReport& report, const ContactsFigures& figures,
                          const std::string& input, Page page) {
  page.title = "kds contacts: " + input;
  page.found = findings_of(report, figures);
  page.words =
      "A <em>contact</em> lasts as long as two beads of the pair are within the cutoff. Its beginning and "
      "end are "
      "exact for the motion between frames. With two cutoffs, it begins within the first and ends outside "
      "the second. "
      "<em>Occupancy</em> is the share of the time in contact. A contact is <em>open</em> if it lasts at the "
      "first "
      "or the last frame; the survival function takes open contacts as censored. The <em>residence time</em> "
      "is the "
      "time in contact divided by the number of ends.";
  if (figures.certificate)
    page.body += html_section("Certificate", html_terms(certified_lines(report, figures)));
  if (figures.all.contacts > 0) {
    page.body +=
        html_section("Contact map",
                     html_figure(map_of(report, figures),
                                 "Occupancy of each pair: the stronger the colour, the longer the pair is in "
                                 "contact. On wide pages the pointer shows names."));
    page.body += html_section("When pairs are in contact",
                              html_figure(timeline_of(report, figures), timeline_caption(figures)));
    page.body += html_section(
        "Survival",
        html_figure(survival_plot(report, figures),
                    "Share of contacts that last longer than a length of time (Kaplan and Meier), "
                    "with its 95% band (Greenwood, log-log). Open contacts are censored."));
    page.body += html_section("Contacts over time",
                              html_figure(course_plot(report), "Mean number of pairs in contact."));
  }
  std::string look;
  if (figures.all.contacts > 0)
    look =
        html_figure(bias_plot(report),
                    "Contacts that are counted at samples, divided by the exact ones without a gap. Below 1, "
                    "samples divide the frames; from 1 on, one frame in so many is examined.");
  if (figures.all.contacts > 0)
    look += html_figure(error_plot(report), "How far the mean life at samples is from the exact one.");
  look += look_columns(report).html(looks_of(report));
  page.body += html_section("Contacts counted at frames", look);
  constexpr std::size_t most_rows = 200;
  page.body +=
      html_section("Pairs", pair_columns(report, figures).html(busiest_of(report, figures, most_rows)));
  page.terms = {{"samples", "times at which frames, or times between them, are looked at"},
                {"found", "exact contacts in which a sample lies"},
                {"plain", "a contact is a run of samples in contact; n samples last n spacings"},
                {"bridged", "absences of up to --intermittency samples do not end a contact"}};
  if (report.has_two_cutoffs)
    page.terms.emplace_back("dual", "a contact begins within the first cutoff and ends outside the second");
  if (figures.certificate) {
    page.terms.emplace_back("sure",
                            "the pair is truly in contact at some time during the contact, whatever "
                            "happens in the frames left out");
    page.terms.emplace_back("possible", "times outside which the pair is certainly not in contact");
  }
  return html_page(page);
}

}  // namespace kds
