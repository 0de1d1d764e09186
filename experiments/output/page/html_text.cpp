#include "experiments/output/page/html_text.h"

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

}  // namespace kds
