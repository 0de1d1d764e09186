#include "experiments/output/page/html_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "experiments/output/output_files.h"
#include "experiments/output/page/gnuplot.h"
#include "experiments/output/page/latex.h"
#include "experiments/output/page/print.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"

namespace kds {

std::string html_escaped(std::string_view text) {
  std::string html;
  for (const char c : one_line(text)) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string html_escaped_lines(std::string_view text) {
  std::string html;
  for (const std::string& line : split(text, '\n')) html += (html.empty() ? "" : "\n") + html_escaped(line);
  return html;
}

namespace {

// Returns the colours of light pages that plots use.
std::string light_style() {
  std::string style = "\n:root {";
  for (std::size_t k = 0; k < page_colours.size(); ++k)
    style += fmt::format(" --{}: {};", page_colours[k], light_colours[k]);
  return style + " }";
}

constexpr std::string_view kStyle = R"(
:root { color-scheme: light dark;
  --page: #ffffff; --ink: #1f2933; --tint: #f4f6f8; --shade: #1f29332e; --link: #1d5fa8; }
@media (prefers-color-scheme: dark) { :root {
  --page: #14181d; --ink: #e4e8ec; --soft: #9aa5b1; --line: #313a44; --tint: #1d232a; --shade: #e4e8ec3a; --link: #7db4f0;
  --s0: #6aa8ee; --s1: #f0a04b; --s2: #63c08a; --s3: #cf92d6; --s4: #f0857a; --s5: #a7b1bc; --s6: #52c7d8; --s7: #d6b73a; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0; background: var(--page); color: var(--ink);
       font: 16px/1.55 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 58rem; margin: 0 auto; padding: 2.2rem 1.5rem 3rem; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0 0 1rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 2.4rem 0 .7rem; }
h3 { font-size: .95rem; margin: .5rem 0 .1rem; overflow-wrap: anywhere; }
p { margin: .45rem 0; max-width: 46rem; }
ul { margin: .45rem 0; padding-left: 1.3rem; max-width: 46rem; }
li { margin: .2rem 0; }
a { color: var(--link); }
.found > p:first-child { font-size: 1.12rem; line-height: 1.5; }
dl { margin: .8rem 0 1.2rem; display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.4rem;
     padding: .9rem 1.1rem; background: var(--tint); border-radius: .5rem; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; margin: .6rem 0 1.2rem; position: relative; left: 50%; transform: translateX(-50%);
          width: max-content; min-width: 100%; max-width: calc(100vw - 3rem);
          background: linear-gradient(to left, var(--page) 30%, transparent) right / 2.5rem 100% no-repeat local,
                      linear-gradient(to left, var(--shade), transparent) right / .8rem 100% no-repeat scroll; }
table { width: 100%; border-collapse: separate; border-spacing: 0; font-size: .92rem; font-variant-numeric: tabular-nums; }
.many table { font-size: .85rem; }
th, td { padding: .26rem 0 .26rem 1.2rem; text-align: right; vertical-align: top; white-space: nowrap; }
.many th, .many td { padding-left: .8rem; }
th.text, td.text { text-align: left; white-space: normal; overflow-wrap: break-word; }
td.text { max-width: 24rem; }
td.long { min-width: 9rem; }
td small { display: block; color: var(--soft); }
thead th { border-bottom: 2px solid var(--ink); vertical-align: bottom; font-weight: 600; white-space: normal; }
th:first-child { position: sticky; left: 0; background: var(--page); padding-left: 0; padding-right: .6rem;
                 text-align: left; font-weight: 600; white-space: normal; min-width: 11rem; max-width: 19rem; }
tbody th, tbody td { border-top: 1px solid var(--line); }
tbody tr:first-child > * { border-top: 0; }
tbody tr.detail > * { border-top: 0; }
tbody tr.detail th:first-child { font-weight: 400; padding-left: 1.1rem; color: var(--soft); }
figure { margin: .6rem 0 1.6rem; }
figure svg { width: 100%; height: auto; }
.paper { margin: 0 0 .2rem; font-size: .85rem; }
.panels { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(20rem, 100%), 1fr)); gap: .3rem 1.5rem; }
svg.wide { display: block; }
svg.narrow { display: none; }
svg text { font-size: 12.5px; fill: var(--soft); }
svg g { font: inherit; }
svg.wide, svg.narrow { fill: none; stroke-linejoin: miter; }
svg .curve { stroke-linejoin: round; }
svg .mark { stroke: none; }
svg .squares { fill: var(--s0); stroke: none; }
svg .mark:hover, svg .squares path:hover { stroke: var(--ink); stroke-width: 2; }
.rows { max-height: 36rem; overflow-y: auto; border-bottom: 1px solid var(--line); }
svg .hot { fill: var(--ink); fill-opacity: 0; stroke: none; }
svg .hot:hover { fill-opacity: .08; }
.s0 { color: var(--s0); } .s1 { color: var(--s1); } .s2 { color: var(--s2); } .s3 { color: var(--s3); }
.s4 { color: var(--s4); } .s5 { color: var(--s5); } .s6 { color: var(--s6); } .s7 { color: var(--s7); }
.key { display: flex; flex-wrap: wrap; gap: .1rem 1.3rem; font-size: .92rem; max-width: none; }
.key span::before { content: ""; display: inline-block; width: .75em; height: .75em; margin-right: .4em;
                    border-radius: 50%; background: currentColor; }
figcaption, footer { color: var(--soft); font-size: .9rem; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .9em; }
pre { margin: .5rem 0; padding: .7rem .9rem; background: var(--tint); border-radius: .5rem; white-space: pre-wrap;
      overflow-wrap: anywhere; }
footer { margin-top: 2.4rem; padding-top: .8rem; border-top: 1px solid var(--line); }
@media (max-width: 40rem) {
  body { font-size: 15px; }
  main { padding: 1.3rem 1rem 2rem; }
  .scroll { max-width: calc(100vw - 2rem); }
  h1 { font-size: 1.3rem; }
  dl { grid-template-columns: 1fr; gap: 0; padding: .7rem .9rem; }
  dd { margin-bottom: .45rem; }
  th:first-child { min-width: 8rem; max-width: 9.5rem; }
  tbody th:first-child { min-width: 8rem; }
  th, td { padding-left: 1.1rem; }
  svg.wide { display: none; }
  svg.narrow { display: block; } }
@media print { svg .hot { display: none; } }
)";

std::string value_text(const Json& value) {
  if (const std::string* text = value.text()) return *text;
  if (const Json::Items* items = value.items()) {
    std::vector<std::string> parts;
    for (const Json& item : *items) parts.push_back(value_text(item));
    return fmt::format("{}", fmt::join(parts, ", "));
  }
  return value.is_null() ? "" : line_of(value).value_or("");
}

// Settings without a value are omitted.
std::string settings_of(const Json& settings) {
  std::vector<std::pair<std::string, std::string>> terms;
  if (settings.members() != nullptr)
    for (const auto& [name, value] : *settings.members())
      if (std::string text = value_text(value); !text.empty()) terms.emplace_back(name, std::move(text));
  return html_terms(terms);
}

std::string links_to(const std::vector<std::string>& files) {
  std::vector<std::string> links;
  for (const std::string& file : files)
    links.push_back(fmt::format("<a href=\"{0}\">{0}</a>", html_escaped(file)));
  return links.empty() ? "" : fmt::format("<p>Data: {}.</p>\n", fmt::join(links, ", "));
}

// Returns a path as a relative address. Other characters than these would need a meaning in addresses.
std::string address_of(const std::filesystem::path& path) {
  std::string address;
  for (const char c : path.generic_string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("/-_.~").find(c) != std::string_view::npos;
    address += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

std::string link_to_replay(const std::filesystem::path& replay) {
  if (replay.empty()) return "";
  return fmt::format("<p><a href=\"{}\">Watch the run</a> from frame to frame and from event to event.</p>\n",
                     address_of(replay));
}

std::string how_it_was_made(const Page& page) {
  const Machine machine = this_machine();
  std::string html;
  if (!page.command_line.empty())
    html += fmt::format("<pre><code>{}</code></pre>\n", html_escaped(page.command_line));
  html += links_to(page.data) + settings_of(page.settings);
  return html + fmt::format("<p>kds {} on {}, {} {}, {}; built with {}.</p>\n",
                            html_escaped(program_version()), html_escaped(machine.cpu), machine.cores,
                            machine.cores == 1 ? "core" : "cores", html_escaped(machine.os),
                            html_escaped(machine.compiler));
}

}  // namespace

std::string html_figure(const std::string& svg, const std::string& caption) {
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n{}", svg, caption,
                     caption_for_print(caption));
}

std::string html_section(const std::string& heading, const std::string& content) {
  return content.empty()
             ? ""
             : fmt::format("{}<h2>{}</h2>\n{}", section_for_print(heading), html_escaped(heading), content);
}

namespace {

// Text in brackets after a value, such as its spread, goes on the line below.
std::string cell_text(const std::string& cell) {
  const std::size_t bracket = cell.find(" (");
  if (bracket == std::string::npos || !cell.ends_with(')')) return html_escaped(cell);
  return fmt::format("{} <small>{}</small>", html_escaped(cell.substr(0, bracket)),
                     html_escaped(cell.substr(bracket + 1)));
}

}  // namespace

std::string html_table(const std::vector<std::string>& columns, const std::vector<HtmlRow>& rows,
                       std::string_view alignment) {
  constexpr std::size_t many = 9;
  constexpr std::size_t long_text = 20;  // characters
  const auto style = [&](std::size_t c) {
    if (c == 0 || alignment[std::min(c, alignment.size() - 1)] != '<') return "";
    const bool is_long = std::ranges::any_of(
        rows, [&](const HtmlRow& row) { return c < row.cells.size() && row.cells[c].size() > long_text; });
    return is_long ? " class=\"text long\"" : " class=\"text\"";
  };
  std::string html =
      fmt::format("<div class=\"scroll{}\"><table>\n<thead><tr>", columns.size() > many ? " many" : "");
  for (std::size_t c = 0; c < columns.size(); ++c)
    html += fmt::format("<th scope=\"col\"{}>{}</th>", style(c), html_escaped(columns[c]));
  html += "</tr></thead>\n<tbody>\n";
  for (const HtmlRow& row : rows) {
    html += row.detail ? "<tr class=\"detail\">" : "<tr>";
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string cell = c < row.cells.size() ? row.cells[c] : "";
      html += c == 0 ? fmt::format("<th scope=\"row\">{}</th>", html_escaped(cell))
                     : fmt::format("<td{}>{}</td>", style(c), cell_text(cell));
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n" + table_for_print(latex_table(columns, rows, alignment));
}

std::string html_terms(const std::vector<std::pair<std::string, std::string>>& terms) {
  if (terms.empty()) return "";
  std::string html = "<dl>\n";
  for (const auto& [term, value] : terms)
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(term), html_escaped(value));
  return html + "</dl>\n";
}

std::string html_page(const Page& page) {
  std::string body = fmt::format("<div class=\"found\">\n{}{}</div>\n{}", page.found,
                                 link_to_replay(page.replay), page.body);
  body += html_section("How to read this",
                       (page.words.empty() ? "" : "<p>" + page.words + "</p>\n") + html_terms(page.terms));
  body += html_section("How it was made", how_it_was_made(page));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n{2}</main>\n</body>\n"
      "</html>\n",
      html_escaped(page.title), light_style() + std::string(kStyle), body);
}

std::filesystem::path replay_beside(const std::filesystem::path& directory,
                                    const std::optional<std::filesystem::path>& replay) {
  return replay ? place_of(*replay).lexically_relative(place_of(directory)) : std::filesystem::path();
}

void print_report_path(const std::filesystem::path& directory) {
  print_to_stdout("report " + (directory / "report.html").string() + "\n");
}

}  // namespace kds
