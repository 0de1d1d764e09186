#include "experiments/output/page/latex.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "experiments/output/text.h"

namespace kds {

namespace {

using Replacement = std::pair<std::string_view, std::string_view>;

// No text is the beginning of a later one. Superscripts follow in a list of their own.
constexpr std::array<Replacement, 45> kLatexOf{{{"\\", "\\textbackslash{}"},
                                                {"{", "\\{"},
                                                {"}", "\\}"},
                                                {"%", "\\%"},
                                                {"&", "\\&"},
                                                {"$", "\\$"},
                                                {"#", "\\#"},
                                                {"_", "\\_"},
                                                {"~", "\\textasciitilde{}"},
                                                {"^", "\\textasciicircum{}"},
                                                {"<", "\\textless{}"},
                                                {">", "\\textgreater{}"},
                                                {"|", "\\textbar{}"},
                                                {"`", "\\textasciigrave{}"},
                                                {"·", "$\\cdot$"},
                                                {"×", "$\\times$"},
                                                {"±", "$\\pm$"},
                                                {"−", "$-$"},
                                                {"≤", "$\\le$"},
                                                {"≥", "$\\ge$"},
                                                {"≈", "$\\approx$"},
                                                {"√", "$\\surd$"},
                                                {"∞", "$\\infty$"},
                                                {"→", "$\\rightarrow$"},
                                                {"°", "$^{\\circ}$"},
                                                {"–", "--"},
                                                {"—", "---"},
                                                {"…", "\\ldots{}"},
                                                {"µ", "$\\mu$"},
                                                {"α", "$\\alpha$"},
                                                {"β", "$\\beta$"},
                                                {"γ", "$\\gamma$"},
                                                {"δ", "$\\delta$"},
                                                {"ε", "$\\varepsilon$"},
                                                {"θ", "$\\theta$"},
                                                {"λ", "$\\lambda$"},
                                                {"μ", "$\\mu$"},
                                                {"π", "$\\pi$"},
                                                {"ρ", "$\\rho$"},
                                                {"σ", "$\\sigma$"},
                                                {"τ", "$\\tau$"},
                                                {"φ", "$\\varphi$"},
                                                {"χ", "$\\chi$"},
                                                {"ω", "$\\omega$"},
                                                {"Å", "\\AA{}"}}};
constexpr std::array<Replacement, 11> kSuperscripts{{{"⁰", "0"},
                                                     {"¹", "1"},
                                                     {"²", "2"},
                                                     {"³", "3"},
                                                     {"⁴", "4"},
                                                     {"⁵", "5"},
                                                     {"⁶", "6"},
                                                     {"⁷", "7"},
                                                     {"⁸", "8"},
                                                     {"⁹", "9"},
                                                     {"⁻", "-"}}};

template <std::size_t Size>
const Replacement* replacement_at(const std::array<Replacement, Size>& all, std::string_view text) {
  const auto found =
      std::ranges::find_if(all, [&](const Replacement& one) { return text.starts_with(one.first); });
  return found == all.end() ? nullptr : &*found;
}

bool is_negative_number(std::string_view cell) {
  return cell.size() > 1 && cell.front() == '-' && (('0' <= cell[1] && cell[1] <= '9') || cell[1] == '.');
}

// A lone hyphen is a cell without a value. A hyphen before a digit is a minus sign.
std::string latex_cell(std::string_view cell) {
  if (cell == "-") return "--";
  if (is_negative_number(cell)) return "$-$" + latex_escaped(cell.substr(1));
  return latex_escaped(cell);
}

// Puts text in brackets after a value, such as its spread, on the line below.
std::string latex_cell_of_two_lines(std::string_view cell) {
  const std::size_t bracket = cell.find(" (");
  if (bracket == std::string_view::npos || !cell.ends_with(')')) return latex_cell(cell);
  return fmt::format("\\shortstack[r]{{{}\\\\{{\\scriptsize {}}}}}", latex_cell(cell.substr(0, bracket)),
                     latex_escaped(cell.substr(bracket + 1)));
}

// Breaks a heading between words into lines of about `most` characters.
std::string latex_heading(const std::string& heading, bool left) {
  constexpr std::size_t most = 12;
  std::vector<std::string> lines;
  for (const std::string& word : split(one_line(heading), ' ')) {
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= most) {
      lines.back() += ' ' + word;
    } else {
      lines.push_back(word);
    }
  }
  if (lines.size() == 1) return latex_escaped(lines.front());
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\\\\") + latex_escaped(line);
  return fmt::format("\\shortstack[{}]{{{}}}", left ? 'l' : 'r', text);
}

}  // namespace

std::string latex_escaped(std::string_view text) {
  const std::string line = one_line(text);
  std::string latex;
  for (std::string_view rest = line; !rest.empty();) {
    if (const Replacement* const one = replacement_at(kLatexOf, rest)) {
      latex += one->second;
      rest.remove_prefix(one->first.size());
      continue;
    }
    std::string power;
    while (const Replacement* const one = replacement_at(kSuperscripts, rest)) {
      power += one->second;
      rest.remove_prefix(one->first.size());
    }
    if (!power.empty()) {
      latex += "$^{" + power + "}$";
      continue;
    }
    latex += rest.front();
    rest.remove_prefix(1);
  }
  return latex;
}

std::string latex_of_html(std::string_view html) {
  constexpr std::array<Replacement, 6> tags{{{"<em>", "\\emph{"},
                                             {"</em>", "}"},
                                             {"<strong>", "\\textbf{"},
                                             {"</strong>", "}"},
                                             {"<code>", "\\texttt{"},
                                             {"</code>", "}"}}};
  constexpr std::array<Replacement, 5> entities{
      {{"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&#39;", "'"}}};
  std::string latex, plain;
  const auto flush = [&] {
    // Escapes the spaces at the end too, which one_line would drop.
    const std::size_t end = plain.find_last_not_of(' ') + 1;
    latex += latex_escaped(std::string_view(plain).substr(0, end)) + plain.substr(end);
    plain.clear();
  };
  while (!html.empty()) {
    if (const Replacement* const one = replacement_at(entities, html)) {
      plain += one->second;
      html.remove_prefix(one->first.size());
    } else if (html.front() == '<' && html.find('>') != std::string_view::npos) {
      flush();
      if (const Replacement* const tag = replacement_at(tags, html)) latex += tag->second;
      html.remove_prefix(html.find('>') + 1);
    } else {
      plain += html.front();
      html.remove_prefix(1);
    }
  }
  flush();
  return latex;
}

std::string latex_table(const std::vector<std::string>& columns, const std::vector<HtmlRow>& rows,
                        std::string_view alignment) {
  constexpr std::size_t long_text = 44;  // characters
  constexpr std::size_t many = 8;        // columns
  if (columns.empty()) return "";
  std::string formats, format, headings;  // `formats` has l, r or p for each column
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const bool left = alignment.empty() || alignment[std::min(c, alignment.size() - 1)] == '<';
    const bool is_long =
        left && std::ranges::any_of(rows, [&](const HtmlRow& row) {
          return row.cells.size() > 1 && c < row.cells.size() && row.cells[c].size() > long_text;
        });
    formats += is_long ? 'p' : left ? 'l' : 'r';
    format += is_long ? "p{0.4\\linewidth}" : std::string(1, formats.back());
    headings += (c == 0 ? "" : " & ") + latex_heading(columns[c], left);
  }
  std::string table =
      fmt::format("\\begin{{tabular}}{{@{{}}{}@{{}}}}\n\\toprule\n{} \\\\\n\\midrule\n", format, headings);
  bool first = true;
  for (const HtmlRow& row : rows) {
    if (row.cells.size() == 1 && columns.size() > 1) {
      table += fmt::format("{}\\multicolumn{{{}}}{{@{{}}l@{{}}}}{{\\textbf{{{}}}}} \\\\\n",
                           first ? "" : "\\addlinespace\n", columns.size(), latex_cell(row.cells.front()));
    } else {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (c > 0) table += " & ";
        if (c == 0 && row.detail) table += "\\quad ";
        if (c >= row.cells.size()) continue;
        table += columns.size() > many && formats[c] == 'r' ? latex_cell_of_two_lines(row.cells[c])
                                                            : latex_cell(row.cells[c]);
      }
      table += " \\\\\n";
    }
    first = false;
  }
  return table + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace kds
