#include "experiments/questions/questions_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

std::string shown(const Field& field) {
  constexpr double rounding = 1e-15;
  const double value = field.number();
  if (std::abs(value) < rounding) return "0";
  const bool whole = value == std::floor(value);
  if ((whole || value >= 1000) && value >= 0 && value < 1e15)
    return with_thousands(static_cast<std::uint64_t>(std::llround(value)));
  return fmt::format("{:.4g}", value);
}

struct PlacedRow {
  const Question* question;
  const QuestionRow* row;
};
std::vector<PlacedRow> rows_of(std::span<const Question> questions) {
  std::vector<PlacedRow> rows;
  for (const Question& question : questions)
    for (const QuestionRow& row : question.rows) rows.push_back({&question, &row});
  return rows;
}

// Returns the columns of all these questions, side by side.
Table<PlacedRow> columns_of(std::span<const Question> questions) {
  using Row = PlacedRow;
  Table<Row> table{{{.key = "question", .value = [](const Row& r) { return Field(r.question->name); }},
                    {"subject", "subject", [](const Row& r) { return Field(r.row->subject); }}}};
  for (const Question& question : questions)
    for (std::size_t c = 0; c < question.columns.size(); ++c) {
      const auto value = [&question, c](const Row& r) {
        return r.question == &question ? Field(r.row->values[c]) : Field();
      };
      table.add({{question.columns[c].name, question.columns[c].title, value, shown}});
    }
  return table;
}

// Returns the plot of the curves with this plot name.
PointPlot plot_of(const Question& question, const std::string& name) {
  PointPlot plot{question.x_label, question.y_label, {}, {}};
  for (const QuestionCurve& curve : question.curves) {
    if (curve.plot != name) continue;
    for (const auto& [x, y] : curve.points)
      if (x > 0 && y >= 0) plot.points.push_back({"", x, y, plot.series.size()});
    plot.series.push_back(curve.name);
  }
  return plot;
}

std::string plots_of(const Question& question) {
  std::vector<std::string> names;
  for (const QuestionCurve& curve : question.curves)
    if (std::ranges::find(names, curve.plot) == names.end()) names.push_back(curve.plot);
  std::string html;
  for (const std::string& name : names)
    html += html_figure(
        svg_plot(plot_of(question, name)),
        fmt::format("{}{}{} by {}; both axes are logarithmic.", html_escaped(name), name.empty() ? "" : ": ",
                    html_escaped(question.y_label), html_escaped(question.x_label)));
  return html;
}

}  // namespace

Json question_rows_json(std::span<const Question> questions) {
  Json json = Json::array();
  for (const Question& question : questions) {
    const std::span<const Question> one(&question, 1);
    const Table<PlacedRow> columns = columns_of(one);
    for (const PlacedRow& row : rows_of(one)) json.push_back(columns.json(row));
  }
  return json;
}

Json questions_json(std::span<const Question> questions) {
  Json json = Json::array();
  for (const Question& question : questions) {
    Json fits = Json::array();
    for (const QuestionCurve& curve : question.curves)
      if (const auto fit = curve.fit())
        fits.push_back({{"curve", curve.plot.empty() ? curve.name : curve.plot + ", " + curve.name},
                        {"points", fit->points},
                        {"left_out", fit->left_out},
                        {"exponent", fit->exponent},
                        {"lower", fit->lower},
                        {"upper", fit->upper},
                        {"factor", fit->factor}});
    json.push_back({{"question", question.name},
                    {"title", question.title},
                    {"answer", question.answer},
                    {"fits", fits},
                    {"findings", question.findings}});
  }
  return json;
}

std::string questions_csv(std::span<const Question> questions) {
  return columns_of(questions).csv(rows_of(questions));
}

std::string questions_text(std::span<const Question> questions) {
  std::string text;
  for (const Question& question : questions) {
    text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", question.name, question.title);
    text += columns_of({&question, 1}).text(rows_of({&question, 1}), "  ");
    text += "  " + question.answer + "\n";
    for (const std::string& finding : question.findings) text += "  " + finding + "\n";
  }
  return text;
}

std::string questions_page(std::span<const Question> questions, Page page) {
  page.title = "kds questions";
  for (const Question& question : questions)
    page.found += fmt::format("<p>{}</p>\n", html_escaped(question.answer));
  page.found +=
      "<p><strong>No theorem is claimed</strong>: the exponents hold for these chains, with intervals of 95% "
      "confidence.</p>\n";
  for (const Question& question : questions) {
    std::string section = fmt::format("<p>{}</p>\n<ul>\n", html_escaped(question.words));
    for (const std::string& finding : question.findings)
      section += fmt::format("<li>{}</li>\n", html_escaped(finding));
    section += "</ul>\n" + plots_of(question) + columns_of({&question, 1}).html(rows_of({&question, 1}));
    page.body += html_section(question.title, section);
  }
  return html_page(page);
}

}  // namespace kds
