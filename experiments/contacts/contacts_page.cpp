#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "experiments/contacts/contacts_rows.h"
#include "experiments/events/contact_map.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

std::string map_of(const ContactsReport& report, const ContactsFigures& figures) {
  std::vector<PairOccupancy> pairs;
  for (const PairLifetimes& pair : figures.pairs)
    pairs.push_back({pair.first, pair.second, *pair.occupancy.value});
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
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> positions;
  for (const PairRow& row : busiest_of(report, figures, timeline_rows)) {
    if (plots.empty() || plots.back().rows.size() == rows_in_plot) plots.push_back(empty);
    positions[{row.pair->first, row.pair->second}] = {plots.size() - 1, plots.back().rows.size()};
    plots.back().rows.push_back({row.first() + ", " + row.second(), {}});
  }
  const double pixel = (empty.to - empty.from) / pixels;
  for (const IntervalRecord& r : report.intervals) {
    const auto position = positions.find({r.first, r.second});
    if (position == positions.end()) continue;
    auto& spans = plots[position->second.first].rows[position->second.second].spans;
    if (!spans.empty() && r.begin_frame - spans.back().second < pixel) {
      spans.back().second = r.end_frame;
    } else {
      spans.emplace_back(r.begin_frame, r.end_frame);
    }
  }
  std::string html = "<div class=\"rows\">\n";
  for (const TimelinePlot& plot : plots) html += svg_plot(plot);
  return html + "</div>\n";
}

std::string survival_plot(const ContactsReport& report, const ContactsFigures& figures) {
  LinePlot plot{
      "length of time (" + report.unit() + ")", "share of contacts that last", Drawn::staircase, {}};
  Curve survival{"survival", {{0, 1}}}, lower{"95% band", {{0, 1}}}, upper{"95% band", {{0, 1}}};
  for (const auto& point : figures.survival.points) {
    survival.points.emplace_back(point.length, *point.survival.value);
    if (point.survival.lower) lower.points.emplace_back(point.length, *point.survival.lower);
    if (point.survival.upper) upper.points.emplace_back(point.length, *point.survival.upper);
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
  const std::vector<SamplingRow> rows = sampling_rows(report);
  LinePlot plot{"frames apart", label, Drawn::points, {}};
  for (std::size_t kind = 0; kind < FrameContacts::kinds; ++kind) {
    const auto& exact = rows.front().figures[kind == FrameContacts::dual ? kind : 0];
    if (!exact || !(static_cast<double>((*exact).*value) > 0)) continue;
    Curve curve{sampling_kinds[kind], {}};
    for (const SamplingRow& row : rows) {
      if (!row.frames_apart || !row.figures[kind]) continue;
      const std::optional<double> at =
          figure(static_cast<double>((*row.figures[kind]).*value) / static_cast<double>((*exact).*value));
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
  return svg_plot(PanelPlot{{panel("Number of contacts", &SamplingRow::Figures::contacts),
                             panel("Mean length", &SamplingRow::Figures::length),
                             panel("Occupancy", &SamplingRow::Figures::occupancy)}});
}

/// Returns the relative error of the mean length at samples. The axis is logarithmic and has no zero.
std::string error_plot(const ContactsReport& report) {
  return svg_plot(plot_by_spacing(
      report, "error of the mean length, divided by the exact one", &SamplingRow::Figures::length,
      [](double ratio) { return ratio == 1 ? std::nullopt : std::optional(std::abs(ratio - 1)); }));
}

std::string findings_of(const ContactsReport& report, const ContactsFigures& figures) {
  const LifetimeFigures& all = figures.all;
  if (all.contacts == 0) return "<p>There are no contacts.</p>\n";
  std::string html = html_terms(overall_lines(report, figures));
  html += fmt::format(
      "<p>The longest contact seen lasts {} {}. {} contacts are open at the first frame, {} at the "
      "last.</p>\n",
      short_decimal(all.longest), report.unit(), with_thousands(all.open_at_start),
      with_thousands(all.open_at_end));
  const std::vector<SamplingRow> rows = sampling_rows(report);
  const SamplingRow::Figures &exact = *rows.front().figures[0], &most = *rows.back().figures[0];
  html += fmt::format(
      "<p>With one cutoff and without a gap, there are {} contacts with a mean length of {} {}. Looking at "
      "{} "
      "shows <strong>{}</strong> contacts with a mean length of {} {}.</p>\n",
      with_thousands(exact.contacts), short_decimal(exact.length), report.unit(),
      name_of_sampling(rows.back()), with_thousands(most.contacts), short_decimal(most.length),
      report.unit());
  return html;
}

}  // namespace

std::string contacts_page(const ContactsReport& report, const ContactsFigures& figures,
                          const std::string& input, Page page) {
  page.title = "kds contacts: " + input;
  page.found = findings_of(report, figures);
  page.words =
      "<strong>Times are exact for the paths between the frames that are given. The spacing of frames is the "
      "error.</strong> A <em>contact</em> lasts as long as two beads of the pair are within the cutoff. With "
      "two cutoffs, it begins within the first and ends when no two beads of the pair are within the second. "
      "<em>Occupancy</em> is the share of the time in contact. A contact is <em>open</em> if it lasts at the "
      "first or the last frame. The <em>residence time</em> is the time in contact divided by the number of "
      "ends. The interval of one pair takes its contacts to begin and end at constant rates.";
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
                    "Share of the contacts that begin which last longer than a length of time (Kaplan and "
                    "Meier). Contacts that are open at the first frame are left out, and those open at the "
                    "last are censored. The 95% band is for each time alone. It covers dependence between "
                    "the contacts of a pair, and none between pairs."));
    page.body += html_section("Contacts over time",
                              html_figure(course_plot(report), "Mean number of pairs in contact."));
  }
  std::string sampled;
  if (figures.all.contacts > 0) {
    sampled =
        html_figure(bias_plot(report),
                    "Contacts that are counted at samples, divided by the exact ones without a gap. Below 1, "
                    "samples divide the frames; from 1 on, one frame in so many is examined.");
    sampled += html_figure(error_plot(report), "How far the mean length at samples is from the exact one.");
  }
  sampled += sampling_columns(report).html(sampling_rows(report));
  page.body += html_section("Contacts counted at frames", sampled);
  constexpr std::size_t most_rows = 200;
  page.body +=
      html_section("Pairs", pair_columns(report, figures).html(busiest_of(report, figures, most_rows)));
  page.terms = {{"samples", "times at which frames, or times between them, are looked at"},
                {"found", "exact contacts in which a sample lies"},
                {"plain",
                 "a contact is a run of samples in contact; n samples last n spacings. Contacts that are "
                 "open at an end of the run count as they are, so the mean length is no mean life"},
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
