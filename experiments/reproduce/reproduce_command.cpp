#include "experiments/reproduce/reproduce_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/reproduce/findings.h"
#include "experiments/reproduce/paper_tables.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

using Value = std::optional<double>;

// Shows large numbers in full, and others with three figures.
std::string shown(double value) {
  return value >= 1000 || (value == std::floor(value) && value >= 2)
             ? with_thousands(static_cast<std::uint64_t>(std::round(value)))
             : fmt::format("{:.3g}", value);
}
std::string percent(double share) {
  const double rounded = std::round(100 * std::abs(share));
  return fmt::format("{}{}%",
                     rounded == 0 ? ""
                     : share < 0  ? "-"
                                  : "+",
                     with_thousands(static_cast<std::uint64_t>(rounded)));
}

std::string name_of(const PaperRow& row) {
  return fmt::format("{}, {} beads{}{}", row.name, with_thousands(row.beads), row.at.empty() ? "" : ", ",
                     row.at);
}

std::string reasons_in_words(const PaperTable& table, const PaperRow& row) {
  std::string words;
  for (const Deviation& large : large_deviations(table, row))
    words +=
        fmt::format("{}{}: {}", words.empty() ? "" : " | ", table.columns[large.column].name, large.reason);
  return words;
}

// Files have all columns. People see three tables with the same rows: times, their ratios, and numbers.
Table<PaperRow> columns_of(const PaperTable& table, Quantity for_people) {
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
    const auto heading = [shown = column.quantity == for_people](std::string_view text) {
      return shown ? std::string(text) : std::string();
    };
    const auto bound = [c](double Spread::*which) {
      return [=](const Row& r) { return r.ours[c].rounds ? Field((*r.ours[c].rounds).*which) : Field(); };
    };
    columns.add({{.key = name,
                  .heading = heading(column.title),
                  .value = [c](const Row& r) { return Field(r.ours[c].value); },
                  .words = [c](const Row& r) { return shown(r.ours[c].value); }}});
    if (column.quantity != Quantity::number)
      columns.add({{.key = name + "_least", .value = bound(&Spread::least), .optional = true},
                   {.key = name + "_most", .value = bound(&Spread::most), .optional = true}});
    if (!column.in_paper) continue;
    columns.add({{name + "_paper", heading("paper"), [c](const Row& r) { return Field(r.paper[c]); },
                  [](const Field& value) { return shown(value.number()); }}});
    if (column.quantity == Quantity::time) continue;
    columns.add({{name + "_deviation", heading("off"),
                  [&table, c](const Row& r) { return Field(deviation_of(table, r, c)); },
                  [](const Field& value) { return percent(value.number()); }}});
  }
  return columns.add(
      {{.key = "note", .value = [](const Row& r) { return Field(r.note); }},
       {.key = "reasons", .value = [&table](const Row& r) { return Field(reasons_in_words(table, r)); }}});
}

// A note on several rows, or a reason with the deviations that it explains.
struct Remark {
  std::string words;
  std::vector<std::string> rows;
};

std::vector<Remark> notes_of(const PaperTable& table) {
  std::vector<Remark> notes;
  for (const PaperRow& row : table.rows) {
    if (row.note.empty()) continue;
    auto place = std::ranges::find(notes, row.note, &Remark::words);
    if (place == notes.end()) place = notes.insert(place, {row.note, {}});
    place->rows.push_back(name_of(row));
  }
  return notes;
}

std::vector<Remark> reasons_of(const PaperTable& table) {
  std::vector<Remark> reasons;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    for (const PaperRow& row : table.rows) {
      for (const Deviation& large : large_deviations(table, row)) {
        if (large.column != c) continue;
        const std::string words = fmt::format("{}: {}", table.columns[c].title, large.reason);
        auto place = std::ranges::find(reasons, words, &Remark::words);
        if (place == reasons.end()) place = reasons.insert(place, {words, {}});
        place->rows.push_back(
            fmt::format("{} ({})", name_of(row),
                        large.share ? percent(*large.share) : shown(row.ours[c].value) + " for 0"));
      }
    }
  }
  return reasons;
}

std::string text_of(const std::vector<Remark>& remarks, std::string_view heading) {
  std::string text = remarks.empty() ? "" : fmt::format("  {}\n", heading);
  for (const Remark& remark : remarks)
    text += fmt::format("  - {}. Rows: {}.\n", remark.words, fmt::join(remark.rows, "; "));
  return text;
}

std::string html_of(const std::vector<Remark>& remarks, std::string_view heading) {
  if (remarks.empty()) return "";
  std::string html = fmt::format("<p>{}</p>\n<ul>\n", heading);
  for (const Remark& remark : remarks)
    html += html_escaped(fmt::format("{}. Rows: {}.", remark.words, fmt::join(remark.rows, "; ")))
                .insert(0, "<li>") +
            "</li>\n";
  return html + "</ul>\n";
}

constexpr std::string_view kNotesHeading = "How inputs differ from the paper's:";
constexpr std::string_view kReasonsHeading = "Why values deviate by more than 25%:";

struct PlacedFinding {
  int table;
  Finding finding;
};

Table<PlacedFinding> finding_columns() {
  using R = PlacedFinding;
  return {{
      {.heading = "claim", .value = [](const R& r) { return Field(r.finding.claim); }},
      {.heading = "holds", .value = [](const R& r) { return Field(r.finding.holds); }},
      {.heading = "measured", .value = [](const R& r) { return Field(r.finding.figures); }},
  }};
}

// Plots table 6, whose rows differ in the number of frames.
std::string stability_plot(const PaperTable& table) {
  LinePlot plot{"frames", "changes", Drawn::points, {}};
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (table.columns[c].quantity != Quantity::number || !table.columns[c].in_paper) continue;
    for (const bool paper : {false, true}) {
      Curve curve{fmt::format("{}{}", table.columns[c].title, paper ? ", paper" : ""), {}};
      for (const PaperRow& row : table.rows) {
        const Value value = paper ? row.paper[c] : row.ours[c].value;
        if (value) curve.points.emplace_back(std::stod(row.at), *value);
      }
      plot.curves.push_back(std::move(curve));
    }
  }
  return html_figure(svg_plot(plot), "Changes between two frames, by how many frames lie between them.");
}

}  // namespace

Json paper_rows_json(std::span<const PaperTable> tables) {
  Json json = Json::array();
  for (const PaperTable& table : tables) {
    const Table<PaperRow> columns = columns_of(table, Quantity::number);
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

std::string paper_csv(const PaperTable& table) { return columns_of(table, Quantity::number).csv(table.rows); }

std::string paper_text(std::span<const PaperTable> tables) {
  std::string text;
  for (const PaperTable& table : tables) {
    text += fmt::format("{}table {}: {}\n{}\n{}\n{}", text.empty() ? "" : "\n", table.number, table.title,
                        columns_of(table, Quantity::time).text(table.rows, "  "),
                        columns_of(table, Quantity::ratio).text(table.rows, "  "),
                        columns_of(table, Quantity::number).text(table.rows, "  "));
    text += text_of(notes_of(table), kNotesHeading) + text_of(reasons_of(table), kReasonsHeading);
    for (const Finding& finding : findings_of(table)) text += "  " + sentence_of(finding) + "\n";
  }
  return text;
}

std::string paper_page(std::span<const PaperTable> tables, Page page) {
  const ClaimsJudged claims = judged(tables);
  std::vector<PlacedFinding> findings;
  for (const PaperTable& table : tables)
    for (Finding& finding : findings_of(table)) findings.push_back({table.number, std::move(finding)});
  page.title = "kds reproduce";
  page.found = fmt::format(
      "<p><strong>{1}</strong> of {0} claims hold in every table that measures them. The claims are "
      "those of Agarwal, Guibas, Nguyen, Russel and Zhang, <em>Collision detection for deforming "
      "necklaces</em> (2004), that these tables can judge.{2}</p>\n",
      claims.all, claims.hold,
      findings.size() > claims.all ? " A claim that two tables measure has two lines." : "");
  page.body += html_section("Claims", finding_columns().html(findings, [](const PlacedFinding& one) {
    return fmt::format("Table {}", one.table);
  }));
  page.words =
      "The paper's values stand beside ours. <em>off</em> is ours divided by the paper's, less one. Times "
      "have none, because the paper's machine is of 2004: ratios of times do. Works that are compared take "
      "turns, round by round, and the tables show medians; the CSV files also have the least and the most. "
      "Work of more than a second is done once, whatever the number of rounds.";
  for (const PaperTable& table : tables)
    page.body += html_section(
        fmt::format("Table {}: {}", table.number, table.title),
        fmt::format("<p>{}</p>\n{}{}{}{}{}{}", html_escaped(table.words),
                    columns_of(table, Quantity::time).html(table.rows),
                    columns_of(table, Quantity::ratio).html(table.rows),
                    columns_of(table, Quantity::number).html(table.rows),
                    table.number == 6 ? stability_plot(table) : "", html_of(notes_of(table), kNotesHeading),
                    html_of(reasons_of(table), kReasonsHeading)));
  return html_page(page);
}

namespace {

constexpr CommandSpec kReproduceCommand{
    "kds reproduce",
    "Measures the tables of Agarwal et al. (2004) again. Shows each value beside the paper's, how far it is "
    "off, and why.",
    "TABLE...",
    "table1, table2 ... table7, or all",
    "kds reproduce all --out report\nkds reproduce table1 table6 --json -",
};

struct ReproduceOptions : Destinations {
  std::filesystem::path data = source_data_folder();
  std::size_t rounds = 5;
};

const OptionList<ReproduceOptions>& reproduce_options() {
  using O = ReproduceOptions;
  static const auto list =
      OptionList<O>()
          .with({data_option(&O::data),
                 whole_option({"--rounds", "N",
                               "repeat each measurement of time N times, unless it takes more than a "
                               "second, and report the median (default: 5)"},
                              &O::rounds, 1, 1000)})
          .with(destination_options("write reproduce.json, report.html and table1.csv ..., a file for each "
                                    "table, to DIR (default: none)"));
  return list;
}

std::string file_of(int table) { return fmt::format("table{}.csv", table); }

// Returns the numbers in ascending order.
std::vector<int> tables_asked_for(const ParsedArguments& parsed) {
  if (parsed.operands().empty())
    throw InputError(
        "kds reproduce needs at least one TABLE, table1 ... table7, or all (see kds reproduce --help)");
  std::vector<int> tables;
  std::vector<std::string> names{"all"};
  for (int table = 1; table <= paper_table_count; ++table) names.push_back(fmt::format("table{}", table));
  for (const std::string& name : parsed.operands()) {
    bool known = false;
    for (int table = 1; table <= paper_table_count; ++table) {
      if (name != "all" && name != names[static_cast<std::size_t>(table)]) continue;
      known = true;
      if (std::find(tables.begin(), tables.end(), table) != tables.end())
        throw InputError(fmt::format("TABLE: table{} is listed twice", table));
      tables.push_back(table);
    }
    if (!known)
      refuse_unknown("TABLE", name, std::vector<std::string_view>(names.begin(), names.end()),
                     "one of table1 ... table7, all");
  }
  std::sort(tables.begin(), tables.end());
  return tables;
}

std::vector<std::string> files_of(const std::vector<int>& tables) {
  std::vector<std::string> files{"reproduce.json", "report.html"};
  for (const int table : tables) files.push_back(file_of(table));
  return files;
}

std::vector<PaperTable> measure(const std::vector<int>& numbers, const ReproduceOptions& options,
                                const TableCommand::Progress& progress) {
  std::vector<PaperTablePlan> plans;
  std::size_t done = 0, total = 0;
  for (const int number : numbers) {
    plans.push_back(plan_paper_table(number, options.data, options.rounds));
    total += plans.back().rows.size();
  }
  std::vector<PaperTable> tables;
  for (PaperTablePlan& plan : plans) {
    for (const auto& row : plan.rows) {
      plan.table.rows.push_back(row());
      progress(++done, total);
    }
    tables.push_back(std::move(plan.table));
  }
  return tables;
}

}  // namespace

int reproduce_command(const Arguments& arguments) {
  ReproduceOptions options;
  const ParsedArguments parsed = read_arguments(kReproduceCommand, reproduce_options(), arguments, options);
  const std::vector<int> numbers = tables_asked_for(parsed);
  folder_in_data(options.data, "paper");
  TableCommand command("reproduce", arguments, options, "row");
  TakenPaths taken;
  taken.read_folder("--data", options.data);
  command.check_destinations(std::move(taken), files_of(numbers));

  const std::vector<PaperTable> tables = measure(numbers, options, command.progress());
  command.bar().erase();
  std::vector<std::string> names;
  for (const int number : numbers) names.push_back(fmt::format("table{}", number));
  Json json;
  json["settings"] = reproduce_options().settings_json(options, {{"tables", names}});
  json["rows"] = paper_rows_json(tables);
  json["tables"] = paper_findings_json(tables);
  TableCommand::Csvs csvs;
  for (const PaperTable& table : tables) csvs.emplace_back(file_of(table.number), paper_csv(table));
  command.deliver(json, csvs, paper_text(tables),
                  [&](Page page) { return paper_page(tables, std::move(page)); });
  return 0;
}

}  // namespace kds
