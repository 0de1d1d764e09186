#include "experiments/contacts/contacts_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "experiments/contacts/contacts_rows.h"
#include "experiments/events/event_distribution.h"
#include "experiments/output/text.h"
#include "experiments/run/run_report.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

using Kind = FrameContacts::Kind;

/// Returns "8.333 (95%: 7.9 to 8.8)", "more than 5.2" if there is only a lower end, or nothing.
std::string estimate_text(const Estimate& estimate, const FieldFormat& format) {
  const auto text = [&](const std::optional<double>& value) { return format(Field(value)); };
  if (!estimate.value) return estimate.lower ? "more than " + text(estimate.lower) : "";
  if (!estimate.lower && !estimate.upper) return text(estimate.value);
  if (!estimate.upper) return fmt::format("{} (95%: from {})", text(estimate.value), text(estimate.lower));
  return fmt::format("{} (95%: {} to {})", text(estimate.value), text(estimate.lower), text(estimate.upper));
}

/// Returns one column for people, and three for files: the estimate and the ends of its interval.
std::vector<Column<PairRow>> estimate_columns(const std::string& key, const std::string& heading,
                                              Estimate LifetimeFigures::*member,
                                              const FieldFormat& format = shortly) {
  const auto part = [&](const char* end, std::optional<double> Estimate::*value) {
    return Column<PairRow>{.key = key + end,
                           .value = [=](const PairRow& r) { return Field((r.pair->*member).*value); }};
  };
  return {part("", &Estimate::value),
          part("_lower", &Estimate::lower),
          part("_upper", &Estimate::upper),
          {.heading = heading, .value = [=](const PairRow& r) {
             return text_or_nothing(estimate_text(r.pair->*member, format));
           }}};
}

void add_estimate(Json& json, const std::string& key, const Estimate& estimate) {
  json[key] = Field(estimate.value).json();
  json[key + "_lower"] = Field(estimate.lower).json();
  json[key + "_upper"] = Field(estimate.upper).json();
}

/// Returns a pair's column. Numbers for people have four figures.
Column<PairRow> pair_column(const char* key, std::string heading, Field (*value)(const PairLifetimes&),
                            FieldFormat format = shortly) {
  return {.key = key,
          .heading = std::move(heading),
          .value = [value](const PairRow& r) { return value(*r.pair); },
          .format = std::move(format)};
}

double share_of(double time, double all) { return all > 0 ? std::min(1.0, time / all) : 0; }

std::vector<PairRow> rows_of(const ContactsReport& report, const ContactsFigures& figures) {
  std::vector<PairRow> rows;
  for (const PairLifetimes& pair : figures.pairs)
    rows.push_back({&pair, &report,
                    figures.certificate ? figures.certificate->pairs.at({pair.first, pair.second})
                                        : ContactBoundsOfPair{}});
  return rows;
}

Table<SurvivalPoint> survival_columns() {
  using S = SurvivalPoint;
  return Table<SurvivalPoint>(
      {{.key = "length", .value = [](const S& s) { return Field(s.length); }},
       {.key = "at_risk", .value = [](const S& s) { return Field(s.at_risk); }},
       {.key = "survival", .value = [](const S& s) { return Field(s.survival.value); }},
       {.key = "lower", .value = [](const S& s) { return Field(s.survival.lower); }},
       {.key = "upper", .value = [](const S& s) { return Field(s.survival.upper); }}});
}

}  // namespace

Table<PairRow> pair_columns(const ContactsReport& report, const ContactsFigures& figures) {
  using P = PairLifetimes;
  const std::string unit = report.unit(), in_unit = " (" + unit + ")";
  Table<PairRow> table(
      {pair_column("i", "", [](const P& p) { return Field(p.first); }),
       pair_column("j", "", [](const P& p) { return Field(p.second); }),
       {.key = "first", .heading = "first", .value = [](const PairRow& r) { return Field(r.first()); }},
       {.key = "second", .heading = "second", .value = [](const PairRow& r) { return Field(r.second()); }},
       pair_column(
           "contacts", "contacts", [](const P& p) { return Field(p.contacts); }, plainly)});
  using F = LifetimeFigures;
  table.add(estimate_columns("occupancy", "occupancy", &F::occupancy, in_percent));
  table.add(estimate_columns("residence", "residence" + in_unit, &F::residence));
  table.add(estimate_columns("begin_rate", "", &F::begin_rate));
  table.add(estimate_columns("end_rate", "", &F::end_rate));
  table.add(
      {pair_column("total", "", [](const P& p) { return Field(p.total); }),
       pair_column("longest", "longest" + in_unit, [](const P& p) { return Field(p.longest); }),
       pair_column("first_begin_frame", "first frame",
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

std::vector<SamplingRow> sampling_rows(const ContactsReport& report) {
  const FrameContacts& frames = *report.frames;
  const bool two = report.has_two_cutoffs;
  const std::uint64_t asked = report.pairs_asked;
  const auto exact = [&](Kind kind) {
    const FrameContacts::Sums& sums = frames.exact(kind);
    const double all = static_cast<double>(asked) * report.run_length;
    return SamplingRow::Figures{sums.contacts,
                                sums.contacts == 0 ? 0 : sums.time / static_cast<double>(sums.contacts),
                                all > 0 ? sums.time / all : 0};
  };
  SamplingRow first{{}, {}, {}, {exact(FrameContacts::plain), {}, {}}};
  if (two) first.figures[FrameContacts::dual] = exact(FrameContacts::dual);
  std::vector<SamplingRow> rows{first};
  const double frame = report.run_length / static_cast<double>(report.steps);
  for (const FrameContacts::Row& row : frames.rows()) {
    if (row.sampling.samples < 2) continue;  // a live run was too short for this spacing
    SamplingRow at_samples{row.sampling.frames_apart(), row.sampling.samples, row.found, {}};
    for (const Kind kind : {FrameContacts::plain, FrameContacts::bridged, FrameContacts::dual}) {
      if (kind == FrameContacts::dual && !two) continue;
      at_samples.figures[kind] = {row.sums[kind].contacts, row.length(kind) * frame,
                                  row.occupancy(kind, asked)};
    }
    rows.push_back(at_samples);
  }
  return rows;
}

std::string name_of_sampling(const SamplingRow& row) {
  if (!row.frames_apart) return "all times, exactly";
  const double apart = *row.frames_apart;
  return apart < 1    ? fmt::format("{} times a frame", 1 / apart)
         : apart == 1 ? "each frame"
                      : fmt::format("one frame in {}", apart);
}

Table<SamplingRow> sampling_columns(const ContactsReport& report) {
  Table<SamplingRow> table(
      {{.key = "spacing", .value = [](const SamplingRow& r) { return Field(r.frames_apart); }},
       {.heading = "looked at", .value = [](const SamplingRow& r) { return Field(name_of_sampling(r)); }},
       {.key = "samples",
        .heading = "samples",
        .value = [](const SamplingRow& r) { return Field(r.samples); }},
       {.key = "found", .heading = "found", .value = [](const SamplingRow& r) { return Field(r.found); }}});
  for (std::size_t kind = 0; kind < FrameContacts::kinds; ++kind) {
    if (kind == FrameContacts::dual && !report.has_two_cutoffs) continue;
    const std::string key = sampling_kinds[kind], start = kind == FrameContacts::plain ? "" : key + ": ";
    const auto figures = [kind](auto member) {
      return [kind, member](const SamplingRow& r) {
        return r.figures[kind] ? Field((*r.figures[kind]).*member) : Field();
      };
    };
    table.add({{.key = key + "_contacts",
                .heading = start + "contacts",
                .value = figures(&SamplingRow::Figures::contacts)},
               {.key = key + "_length",
                .heading = start + "mean length (" + report.unit() + ")",
                .value = figures(&SamplingRow::Figures::length),
                .format = shortly},
               {.key = key + "_occupancy",
                .heading = start + "occupancy %",
                .value = figures(&SamplingRow::Figures::occupancy),
                .format = in_percent}});
  }
  return table;
}

ContactsFigures figures_of(const ContactsReport& report) {
  ContactsFigures figures;
  figures.pairs = report.lifetimes.pairs(report.run_length);
  figures.all = report.lifetimes.all(report.run_length, report.pairs_asked);
  constexpr double least_drop = 1.0 / 300;  // a plot is about this many pixels high
  figures.survival = report.lifetimes.survival(least_drop);
  return figures;
}

namespace {

Json certificate_json(const ContactsFigures& figures) {
  const ContactsCertificate& certificate = *figures.certificate;
  const ContactBoundsOfPair& all = certificate.all;
  Json json = deviation_json(certificate.deviation);
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
  json["names"] = report.elements.names;
  json["run_length"] = report.run_length;
  Json sums{{"pairs", figures.pairs.size()}, {"pairs_asked", report.pairs_asked}, {"contacts", all.contacts}};
  sums["open_at_start"] = all.open_at_start;
  sums["open_at_end"] = all.open_at_end;
  sums["open_at_both"] = all.open_at_both;
  sums["total"] = all.total;
  sums["longest"] = all.longest;
  add_estimate(sums, "occupancy", all.occupancy);
  add_estimate(sums, "residence", all.residence);
  add_estimate(sums, "begin_rate", all.begin_rate);
  add_estimate(sums, "end_rate", all.end_rate);
  add_estimate(sums, "median", figures.survival.median);
  json["all"] = std::move(sums);
  if (report.crossings) json["crossings"] = report.crossings->json();
  if (figures.certificate) json["stride"] = certificate_json(figures);
  json["rows"] = pair_columns(report, figures).json(rows_of(report, figures));
  json["frames"] = sampling_columns(report).json(sampling_rows(report));
  json["survival"] = survival_columns().json(figures.survival.points);
  Json course = Json::array();
  const std::vector<double> means = report.course.means();
  for (std::size_t bin = 0; bin < means.size(); ++bin)
    course.push_back(Json{{"frame", report.course.first_frames()[bin].number},
                          {"picoseconds", report.course.first_frames()[bin].picoseconds},
                          {"contacts", means[bin]}});
  json["course"] = std::move(course);
}

std::string contacts_csv(const ContactsReport& report, const ContactsFigures& figures) {
  return pair_columns(report, figures).csv(rows_of(report, figures));
}

std::string frames_csv(const ContactsReport& report) {
  return sampling_columns(report).csv(sampling_rows(report));
}

namespace {

/// Writes lines of intervals. A last column, if it has a name, shows the flags.
struct IntervalsCsv {
  const ContactsReport& report;
  std::string_view last_column, if_set, if_not;

  void write(const std::vector<IntervalRecord>& intervals, const std::vector<std::uint8_t>& flags,
             std::ostream& stream) const {
    const bool timed = report.has_times(), flagged = !last_column.empty();
    std::vector<std::string> names;
    for (const std::string& name : report.elements.names) names.push_back(csv_field(name));
    stream << "i,j,first,second,begin_frame,end_frame" << (timed ? ",begin_picoseconds,end_picoseconds" : "")
           << ",length,open_at_start,open_at_end" << (flagged ? "," : "") << last_column << '\n';
    std::size_t index = 0;
    for (const IntervalRecord& r : intervals) {
      stream << fmt::format("{},{},{},{},{:.12g},{:.12g}", r.first, r.second, names[r.first], names[r.second],
                            r.begin_frame, r.end_frame);
      if (timed) stream << fmt::format(",{:.12g},{:.12g}", r.begin_picoseconds, r.end_picoseconds);
      stream << fmt::format(",{},{},{}", r.length, r.open_at_start, r.open_at_end);
      if (flagged) stream << ',' << (flags[index++] != 0 ? if_set : if_not);
      stream << '\n';
    }
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

std::vector<std::pair<std::string, std::string>> overall_lines(const ContactsReport& report,
                                                               const ContactsFigures& figures) {
  const LifetimeFigures& all = figures.all;
  const Survival& survival = figures.survival;
  const std::string unit = report.unit();
  std::vector<std::pair<std::string, std::string>> lines{
      {"contacts", fmt::format("{} of {} pairs; {} pairs were asked for", with_thousands(all.contacts),
                               with_thousands(figures.pairs.size()), with_thousands(report.pairs_asked))}};
  const auto add = [&](const char* label, const Estimate& estimate, const std::string& words,
                       const FieldFormat& format = shortly) {
    const std::string text = estimate_text(estimate, format);
    if (!text.empty()) lines.emplace_back(label, text + words);
  };
  add("occupancy", all.occupancy, " of the time of all pairs that were asked for", in_percent);
  add("residence", all.residence, " " + unit + ", the mean life of a contact");
  add("rate of beginning", all.begin_rate,
      " per " + report.one_unit() + " out of contact, over all pairs that were asked for", with_figures(4));
  add("rate of end", all.end_rate, " per " + report.one_unit() + " in contact", with_figures(4));
  lines.emplace_back(
      "survival",
      fmt::format(
          "of the contacts whose beginning was seen ({}); those that are open at the first frame ({}) "
          "are left out",
          with_thousands(survival.contacts), with_thousands(survival.left_out)));
  add("median", survival.median, " " + unit + ", which half of the contacts that begin survive");
  lines.emplace_back("intervals",
                     "hold for a run in equilibrium and for pairs that are independent of each other; pairs "
                     "of one molecule depend on each other, so the true uncertainty is larger");
  return lines;
}

std::string contacts_text(const ContactsReport& report, const ContactsFigures& figures) {
  constexpr std::size_t most = 20;
  std::string text =
      "Times are exact for the paths between the frames that are given; the spacing of frames is the "
      "error.\n" +
      (report.crossings && !report.crossings->any()
           ? fmt::format("Crossings: {}.\n", report.crossings->sentence())
           : "") +
      "\n" + sampling_columns(report).text(sampling_rows(report));
  if (figures.certificate) {
    text += '\n';
    for (const auto& [label, line] : certified_lines(report, figures))
      text += fmt::format("{}: {}\n", label, line);
  }
  const auto rows = busiest_of(report, figures, most);
  if (rows.empty()) return text;
  text += '\n';
  for (const auto& [label, line] : overall_lines(report, figures))
    text += fmt::format("{}: {}\n", label, line);
  text += "\n" + pair_columns(report, figures).text(rows);
  if (figures.pairs.size() > most)
    text += fmt::format("... {} more pairs; {} all of them\n", with_thousands(figures.pairs.size() - most),
                        words("--out DIR writes", "rows has"));
  return text;
}

}  // namespace kds
