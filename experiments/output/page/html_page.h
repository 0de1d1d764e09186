#pragma once
// The report of every command: one page in one style, complete in itself, without a script and without a
// network. It begins with what was found, and ends with how it was made and where its data are. Light or dark
// as the reader's system is, legible from the width of a telephone on.

#include <string>
#include <utility>
#include <vector>

#include "experiments/output/page/html_text.h"
#include "experiments/output/result_json.h"

namespace kds {

struct Page {
  std::string title;
  std::string found;  ///< HTML, paragraphs: what was found, in words and figures
  std::string body;   ///< HTML: plots and tables, section by section
  std::string words;  ///< HTML: what the words mean; may be empty
  std::vector<std::pair<std::string, std::string>> terms;  ///< a word and what it means, text
  std::string command_line;
  Json settings;                  ///< an object; null where there are none
  std::vector<std::string> data;  ///< names of the files beside it
};

[[nodiscard]] std::string html_page(const Page& page);

[[nodiscard]] std::string html_figure(const std::string& svg, const std::string& caption);

/// A section with its heading; nothing where its content is empty.
[[nodiscard]] std::string html_section(const std::string& heading, const std::string& content);

struct HtmlRow {
  std::vector<std::string>
      cells;            ///< text, the first the row's name; fewer than columns: the others are empty
  bool detail = false;  ///< belongs to the row above that is none
};
/// Scrolls sideways where the page is too narrow; its first column stays.
[[nodiscard]] std::string html_table(const std::vector<std::string>& columns,
                                     const std::vector<HtmlRow>& rows);

/// Terms and what they are here: label and value.
[[nodiscard]] std::string html_terms(const std::vector<std::pair<std::string, std::string>>& terms);

}  // namespace kds
