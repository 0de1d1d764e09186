#include "experiments/questions/questions_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

std::string shown(const std::optional<double>& value) {
  constexpr double rounding = 1e-15;
  if (!value) return "-";
  if (std::abs(*value) < rounding) return "0";
  const bool whole = *value == std::floor(*value);
  if ((whole || *value >= 1000) && *value >= 0 && *value < 1e15)
    return with_thousands(static_cast<std::uint64_t>(std::llround(*value)));
  return fmt::format("{:.4g}", *value);
}

// One of the curves that belong together.
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

std::string table_of(const Question& question) {
  std::vector<std::string> columns{""};
  for (const QuestionColumn& column : question.columns) columns.push_back(column.title);
  std::vector<HtmlRow> rows;
  for (const QuestionRow& row : question.rows) {
    HtmlRow& line = rows.emplace_back(HtmlRow{{row.subject}});
    for (const auto& value : row.values) line.cells.push_back(shown(value));
  }
  return html_table(columns, rows);
}

}  // namespace

Json question_rows_json(std::span<const Question> questions) {
  Json json = Json::array();
  for (const Question& question : questions)
    for (const QuestionRow& row : question.rows) {
      Json of_row{{"question", question.name}, {"subject", row.subject}};
      for (std::size_t c = 0; c < question.columns.size(); ++c)
        of_row[question.columns[c].name] = row.values[c] ? Json(*row.values[c]) : Json(nullptr);
      json.push_back(of_row);
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
  std::string text = "question,subject";
  std::size_t width = 0;  // columns of all questions, those of each side by side
  for (const Question& question : questions) {
    for (const QuestionColumn& column : question.columns) text += "," + column.name;
    width += question.columns.size();
  }
  text += "\n";
  std::size_t first = 0;
  for (const Question& question : questions) {
    for (const QuestionRow& row : question.rows) {
      text += fmt::format("{},{}{:,>{}}", question.name, csv_field(row.subject), "", first);
      for (const auto& value : row.values) text += value ? fmt::format(",{}", *value) : ",";
      text += fmt::format("{:,>{}}\n", "", width - first - row.values.size());
    }
    first += question.columns.size();
  }
  return text;
}

std::string questions_text(std::span<const Question> questions) {
  std::string text;
  for (const Question& question : questions) {
    text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", question.name, question.title);
    std::vector<std::vector<std::string>> lines(1, {""});
    for (const QuestionColumn& column : question.columns) lines[0].push_back(column.title);
    for (const QuestionRow& row : question.rows) {
      std::vector<std::string>& line = lines.emplace_back(1, row.subject);
      for (const auto& value : row.values) line.push_back(shown(value));
    }
    for (const std::string& line : in_columns(lines, "<>")) text += "  " + line + "\n";
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
      "<p><strong>No theorem is claimed</strong>: exponents are of these chains, with intervals of 95% "
      "confidence.</p>\n";
  for (const Question& question : questions) {
    std::string section = fmt::format("<p>{}</p>\n<ul>\n", html_escaped(question.words));
    for (const std::string& finding : question.findings)
      section += fmt::format("<li>{}</li>\n", html_escaped(finding));
    section += "</ul>\n" + plots_of(question) + table_of(question);
    page.body += html_section(question.title, section);
  }
  return html_page(page);
}

}  // namespace kds
