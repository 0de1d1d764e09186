#include "experiments/output/html_page.h"

#include <fmt/format.h>

#include "experiments/output/provenance.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::string_view kStyle = R"(
:root { --ink: #1f2933; --soft: #5b6570; --line: #dfe4ea; --tint: #f6f8fa; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: var(--ink);
       font: 16px/1.55 system-ui, "Segoe UI", "Helvetica Neue", "DejaVu Sans", sans-serif; }
main { max-width: 58rem; margin: 0 auto; padding: 2.5rem 1.5rem 3rem; }
h1 { font-size: 1.65rem; line-height: 1.25; margin: 0 0 1.1rem; overflow-wrap: anywhere; }
h2 { font-size: 1.12rem; margin: 2.4rem 0 .7rem; }
p { margin: .4rem 0; max-width: 52rem; }
dl { margin: 0 0 1.2rem; display: grid; grid-template-columns: max-content 1fr; gap: .25rem 1.4rem;
     padding: 1rem 1.2rem; background: var(--tint); border-radius: .5rem; }
dt { color: var(--soft); }
dd { margin: 0; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .94rem; font-variant-numeric: tabular-nums; }
th, td { padding: .24rem 0 .24rem 2.6rem; text-align: right; white-space: nowrap; }
th:first-child { padding-left: 0; text-align: left; font-weight: 600; }
thead th { border-bottom: 2px solid var(--ink); }
tbody tr { border-top: 1px solid var(--line); }
tbody tr.detail { border-top: 0; }
tbody tr.detail th { font-weight: 400; padding-left: 1.2rem; color: var(--soft); }
figure { margin: 0 0 1.4rem; }
figure svg { display: block; width: 100%; height: auto; }
figcaption, footer { color: var(--soft); font-size: .9rem; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: .92em; }
footer { margin-top: 2.8rem; padding-top: .8rem; border-top: 1px solid var(--line); }
)";

}  // namespace

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
  for (const std::string& line : split(text, '\n')) html += html_escaped(line) + "\n";
  return html;
}

std::string html_figure(const std::string& svg, const std::string& caption) {
  return fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", svg, caption);
}

std::string html_page(const std::string& name, const std::string& body) {
  const Machine machine = this_machine();
  const std::string footer = html_escaped(
      fmt::format("kds {} on {}, {} {}, {}; built with {}.", program_version(), machine.cpu, machine.cores,
                  machine.cores == 1 ? "core" : "cores", machine.os, machine.compiler));
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n{2}"
      "<footer>{3}</footer>\n</main>\n</body>\n</html>\n",
      html_escaped(name), kStyle, body, footer);
}

}  // namespace kds
