#include "experiments/reproduce/reproduce_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "experiments/reproduce/findings.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

using Value = std::optional<double>;

// Counts in full, ratios with four figures.
std::string shown(double value) {
  const bool is_count = value == std::floor(value) && value >= 2;
  return is_count ? with_thousands(static_cast<std::uint64_t>(value)) : short_decimal(value);
}
std::string shown(const Value& value) { return value ? shown(*value) : "-"; }
std::string shown(const PaperValue& ours) {
  return ours.rounds ? spread_text(*ours.rounds) : shown(ours.value);
}

std::string name_of(const PaperRow& row) {
  return fmt::format("{}, {} beads{}{}", row.name, with_thousands(row.beads), row.at.empty() ? "" : ", ",
                     row.at);
}

std::string table_with_notes(const PaperTable& table) {
  std::vector<std::string> columns{""};
  for (const PaperColumn& column : table.columns) {
    columns.emplace_back(column.title);
    columns.emplace_back("paper");
  }
  std::vector<HtmlRow> rows;
  for (const PaperRow& row : table.rows) {
    HtmlRow& line = rows.emplace_back(HtmlRow{{name_of(row)}});
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      line.cells.push_back(shown(row.ours[c]));
      line.cells.push_back(shown(row.paper[c]));
    }
  }
  std::string html = html_table(columns, rows);
  std::vector<std::string> notes;
  for (const PaperRow& row : table.rows) {
    if (row.note.empty()) continue;
    std::string note = fmt::format("<p>{}: {}.</p>\n", html_escaped(row.name), html_escaped(row.note));
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(std::move(note));
  }
  for (const std::string& note : notes) html += note;
  return html;
}

// Table 6 is a course over frames.
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
  for (const PaperTable& table : tables)
    for (const PaperRow& row : table.rows) {
      Json of_row{{"table", table.number}, {"name", row.name}, {"beads", row.beads}, {"at", row.at}};
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const std::string name(table.columns[c].name);
        of_row[name] = row.ours[c].value;
        if (const auto& rounds = row.ours[c].rounds) {
          of_row[name + "_least"] = rounds->least;
          of_row[name + "_most"] = rounds->most;
        }
        of_row[name + "_paper"] = row.paper[c];
      }
      of_row["note"] = row.note;
      json.push_back(of_row);
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

std::string paper_csv(const PaperTable& table) {
  std::string text = "name,beads,at";
  for (const PaperColumn& column : table.columns)
    text += column.timed ? fmt::format(",{0},{0}_least,{0}_most,{0}_paper", column.name)
                         : fmt::format(",{0},{0}_paper", column.name);
  text += ",note\n";
  for (const PaperRow& row : table.rows) {
    text += fmt::format("{},{},{}", csv_field(row.name), row.beads, csv_field(row.at));
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      text += fmt::format(",{}", row.ours[c].value);
      if (const auto& rounds = row.ours[c].rounds) text += fmt::format(",{},{}", rounds->least, rounds->most);
      text += fmt::format(",{}", value_or_empty(row.paper[c]));
    }
    text += fmt::format(",{}\n", csv_field(row.note));
  }
  return text;
}

std::string paper_text(std::span<const PaperTable> tables) {
  std::string text;
  for (const PaperTable& table : tables) {
    std::vector<std::vector<std::string>> lines{{""}};
    for (const PaperColumn& column : table.columns)
      lines[0].insert(lines[0].end(), {std::string(column.title), "paper"});
    lines[0].emplace_back();  // notes
    for (const PaperRow& row : table.rows) {
      std::vector<std::string>& line = lines.emplace_back(std::vector{name_of(row)});
      for (std::size_t c = 0; c < table.columns.size(); ++c)
        line.insert(line.end(), {shown(row.ours[c]), shown(row.paper[c])});
      line.push_back(row.note);
    }
    text += fmt::format("{}table {}: {}\n", text.empty() ? "" : "\n", table.number, table.title);
    for (const std::string& line : in_columns(lines, "<" + std::string(2 * table.columns.size(), '>') + "<"))
      text += "  " + line + "\n";
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
      "<p>Of {} claims of Agarwal, Guibas, Nguyen, Russel and Zhang, <em>Collision detection for deforming "
      "necklaces</em> (2004), that these tables can tell of, <strong>{}</strong> hold here, in every table "
      "that "
      "tells of them.</p>\n{}</ul>\n",
      claims.all, claims.hold, list);
  page.words =
      "The paper's values stand beside ours. Times are ratios within a row, for the paper's machine is of "
      "2004: of works that are done in turn, round by round, the median of the rounds and in brackets the "
      "least and the most. Work of more than a second is done once, whatever the rounds, and stands beside "
      "all rounds of the other.";
  for (const PaperTable& table : tables)
    page.body +=
        html_section(fmt::format("Table {}: {}", table.number, table.title),
                     fmt::format("<p>{}</p>\n{}{}", html_escaped(table.words), table_with_notes(table),
                                 table.number == 6 ? stability_plot(table) : ""));
  return html_page(page);
}

}  // namespace kds
