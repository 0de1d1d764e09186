#include "experiments/reproduce/reproduce_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "experiments/reproduce/findings.h"

namespace kds {

namespace {

using Value = std::optional<double>;

// Shows counts in full and ratios with four figures.
std::string shown(double value) {
  const bool is_count = value == std::floor(value) && value >= 2;
  return is_count ? with_thousands(static_cast<std::uint64_t>(value)) : short_decimal(value);
}
std::string shown(const PaperValue& ours) {
  return ours.rounds ? spread_text(*ours.rounds) : shown(ours.value);
}

std::string name_of(const PaperRow& row) {
  return fmt::format("{}, {} beads{}{}", row.name, with_thousands(row.beads), row.at.empty() ? "" : ", ",
                     row.at);
}

Table<PaperRow> columns_of(const PaperTable& table) {
  using Row = PaperRow;
  Table<Row> columns{{
      {.key = "table", .json = [number = table.number](const Row&) { return Json(number); }},
      {.heading = "model", .value = [](const Row& r) { return Field(name_of(r)); }},
      {.key = "name", .value = [](const Row& r) { return Field(r.name); }},
      {.key = "beads", .value = [](const Row& r) { return Field(r.beads); }},
      {.key = "at", .value = [](const Row& r) { return Field(r.at); }},
  }};
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const PaperColumn& column = table.columns[c];
    const std::string name(column.name);
    const auto bound = [c](double Spread::*which) {
      return [=](const Row& r) { return r.ours[c].rounds ? Field((*r.ours[c].rounds).*which) : Field(); };
    };
    columns.add({{.key = name,
                  .heading = std::string(column.title),
                  .value = [c](const Row& r) { return Field(r.ours[c].value); },
                  .words = [c](const Row& r) { return shown(r.ours[c]); }}});
    if (column.timed)
      columns.add({{.key = name + "_least", .value = bound(&Spread::least), .optional = true},
                   {.key = name + "_most", .value = bound(&Spread::most), .optional = true}});
    columns.add({{name + "_paper", "paper", [c](const Row& r) { return Field(r.paper[c]); },
                  [](const Field& value) { return shown(value.number()); }}});
  }
  return columns.add({{"note", "note", [](const Row& r) { return Field(r.note); }, plainly, Shown::in_text}});
}

std::string table_with_notes(const PaperTable& table) {
  std::string html = columns_of(table).html(table.rows);
  std::vector<std::string> notes;
  for (const PaperRow& row : table.rows) {
    if (row.note.empty()) continue;
    std::string note = fmt::format("<p>{}: {}.</p>\n", html_escaped(row.name), html_escaped(row.note));
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  }
  for (const std::string& note : notes) html += note;
  return html;
}

// Plots table 6, whose rows differ in the number of frames.
std::string stability_plot(const PaperTable& table) {
  LinePlot plot{"frames", "changes", Drawn::points, {}};
  for (std::size_t c = 0; c < 2; ++c)
    for (const bool paper : {false, true}) {
      Curve curve{fmt::format("{}{}", table.columns[c].title, paper ? ", paper" : ""), {}};
      for (const PaperRow& row : table.rows) {
        const Value value = paper ? row.paper[c] : row.ours[c].value;
        if (value) curve.points.emplace_back(std::stod(row.at), *value);
      }
      plot.curves.push_back(std::move(curve));
    }
  return html_figure(svg_plot(plot), "Changes between two frames, by how many frames lie between them.");
}

}  // namespace

Json paper_rows_json(std::span<const PaperTable> tables) {
  Json json = Json::array();
  for (const PaperTable& table : tables) {
    const Table<PaperRow> columns = columns_of(table);
    for (const PaperRow& row : table.rows) json.push_back(columns.json(row));
  }
  return json;
}

Json paper_findings_json(std::span<const PaperTable> tables) {
  Json json = Json::array();
  for (const PaperTable& table : tables) {
    Json findings = Json::array();
    for (const Finding& finding : findings_of(table))
      findings.push_back({{"claim", finding.id}, {"holds", finding.holds}, {"words", sentence_of(finding)}});
    json.push_back({{"table", table.number}, {"title", table.title}, {"findings", findings}});
  }
  return json;
}

std::string paper_csv(const PaperTable& table) { return columns_of(table).csv(table.rows); }

std::string paper_text(std::span<const PaperTable> tables) {
  std::string text;
  for (const PaperTable& table : tables) {
    text += fmt::format("{}table {}: {}\n{}", text.empty() ? "" : "\n", table.number, table.title,
                        columns_of(table).text(table.rows, "  "));
    for (const Finding& finding : findings_of(table)) text += "  " + sentence_of(finding) + "\n";
  }
  return text;
}

std::string paper_page(std::span<const PaperTable> tables, Page page) {
  const ClaimsJudged claims = judged(tables);
  std::string list = "<ul>\n";
  for (const PaperTable& table : tables)
    for (const Finding& finding : findings_of(table))
      list += fmt::format("<li>Table {}: {}</li>\n", table.number, html_escaped(sentence_of(finding)));
  page.title = "kds reproduce";
  page.found = fmt::format(
      "<p><strong>{1}</strong> of {0} claims hold here, in every table that tells of them. The claims are "
      "those "
      "of Agarwal, Guibas, Nguyen, Russel and Zhang, <em>Collision detection for deforming necklaces</em> "
      "(2004), that these tables can judge.</p>\n{2}</ul>\n",
      claims.all, claims.hold, list);
  page.words =
      "The paper's values stand beside ours. Times are ratios within a row, because the paper's machine is "
      "of 2004. Works that are compared take turns, round by round; the ratio is the median of the rounds, "
      "with the least and the most in brackets. Work of more than a second is done once, whatever the number "
      "of rounds, and is compared with all rounds of the other work.";
  for (const PaperTable& table : tables)
    page.body +=
        html_section(fmt::format("Table {}: {}", table.number, table.title),
                     fmt::format("<p>{}</p>\n{}{}", html_escaped(table.words), table_with_notes(table),
                                 table.number == 6 ? stability_plot(table) : ""));
  return html_page(page);
}

}  // namespace kds
