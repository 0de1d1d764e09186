#include "experiments/output/page/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <functional>
#include <system_error>
#include <utility>
#include <vector>

#include "experiments/output/page/gnuplot.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/latex.h"
#include "experiments/output/text.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::string_view kPrintPrefix = "paper-";

// A copy is kStart, a letter, the content and kEnd. The page stays well formed while it carries copies,
// because kLess and kGreater stand for < and > of their content.
constexpr char kStart = '\x01', kEnd = '\x02', kLess = '\x03', kGreater = '\x04';
enum CopyOf : char { of_section = 's', of_caption = 'c', of_table = 't', of_plot = 'p' };

std::string copy_of(CopyOf kind, std::string_view content) {
  std::string copy{kStart, kind};
  copy += content;
  std::ranges::replace(copy, '<', kLess);
  std::ranges::replace(copy, '>', kGreater);
  return copy + kEnd;
}

// Returns letters and digits in lower case, and a hyphen for everything between them.
std::string file_name_of(std::string_view heading) {
  constexpr std::size_t most = 40;
  std::string name;
  for (const std::string& word : split(heading, ' ')) {
    std::string plain;
    for (const char c : word) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 0x80) {
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      } else if (!plain.empty() && plain.back() != '-') {
        plain += '-';
      }
    }
    while (!plain.empty() && plain.back() == '-') plain.pop_back();
    if (plain.empty()) continue;
    if (!name.empty() && name.size() + 1 + plain.size() > most) break;
    name += (name.empty() ? "" : "-") + plain.substr(0, most);
  }
  return name.empty() ? "untitled" : name;
}

std::string light_colours_script() {
  std::string script;
  for (std::size_t k = 0; k < page_colours.size(); ++k)
    script += fmt::format("c_{} = '{}'\n", page_colours[k], light_colours[k]);
  return script;
}

class PrintFiles {
 public:
  explicit PrintFiles(AtomicFiles& files) : files_(files) {}

  // Writes the files of a copy. Returns the links to them, in HTML.
  std::string add(char kind, std::string_view content) {
    switch (kind) {
      case of_section:
        flush();
        section_ = content;
        return "";
      case of_caption:
        caption_ = latex_of_html(content);
        flush();
        return "";
      case of_table:
        flush();
        return table(content);
      case of_plot:
        return plot(content);
      default:
        throw std::logic_error("a copy of an unknown kind on a page");
    }
  }

  void finish(std::string_view title) {
    flush();
    files_.write(
        std::string(kPrintPrefix) + "all.tex",
        fmt::format(
            "% All tables and plots of report.html. To compile: pdflatex paper-all.tex\n"
            "\\documentclass{{article}}\n\\usepackage[T1]{{fontenc}}\n"
            "\\usepackage[utf8]{{inputenc}}\n\\usepackage[margin=25mm]{{geometry}}\n"
            "\\usepackage{{booktabs}}\n\\usepackage{{graphicx}}\n\\extrafloats{{500}}\n"
            "\\IfFileExists{{lmodern.sty}}{{\\usepackage{{lmodern}}}}{{}}\n"
            "% Shrinks what is wider than a line or higher than a page.\n"
            "\\newsavebox{{\\kdsbox}}\n"
            "\\newcommand{{\\kdsfit}}[1]{{\\sbox{{\\kdsbox}}{{#1}}%\n"
            "  \\ifdim\\wd\\kdsbox>\\linewidth\n"
            "    \\sbox{{\\kdsbox}}{{\\resizebox{{\\linewidth}}{{!}}{{\\usebox{{\\kdsbox}}}}}}\\fi\n"
            "  \\ifdim\\dimexpr\\ht\\kdsbox+\\dp\\kdsbox\\relax>0.85\\textheight\n"
            "    \\sbox{{\\kdsbox}}{{\\resizebox*{{!}}{{0.85\\textheight}}{{\\usebox{{\\kdsbox}}}}}}\\fi\n"
            "  \\usebox{{\\kdsbox}}}}\n"
            "\\begin{{document}}\n\\section*{{\\raggedright {}}}\n{}\\end{{document}}\n",
            title, document_));
  }

 private:
  // Writes the plots that have waited for their caption into the document.
  void flush() {
    if (waiting_.empty()) return;
    document_ += "\\begin{figure}[!htbp]\\centering\n\\kdsfit{\\begin{tabular}{@{}c@{}}\n";
    for (const std::string& name : waiting_)
      document_ += fmt::format("\\includegraphics{{{}.pdf}} \\\\\n", name);
    document_ += "\\end{tabular}}\n";
    document_ += fmt::format("\\caption{{{}}}\n\\end{{figure}}\n",
                             caption_.empty() ? latex_escaped(section_) : caption_);
    waiting_.clear();
    caption_.clear();
  }

  std::string next_name(std::string_view what) {
    const std::string plain = fmt::format("{}{}-{}", kPrintPrefix, what, file_name_of(section_));
    for (std::size_t number = 1;; ++number) {
      std::string name = number == 1 ? plain : fmt::format("{}-{}", plain, number);
      if (std::ranges::find(names_, name) == names_.end()) return names_.emplace_back(std::move(name));
    }
  }

  std::string table(std::string_view latex) {
    const std::string name = next_name("table");
    files_.write(name + ".tex", latex);
    document_ += fmt::format(
        "\\begin{{table}}[!htbp]\\centering\n\\caption{{{}}}\n\\kdsfit{{\\input{{{}}}}}\n\\end{{table}}\n",
        latex_escaped(section_), name);
    return fmt::format("<p class=\"paper\"><a href=\"{}.tex\">LaTeX</a></p>\n", name);
  }

  std::string plot(std::string_view content) {
    const std::string name = next_name("figure");
    const std::size_t line = content.find('\n');
    const std::string size(content.substr(0, line));
    const std::string script = light_colours_script() + "reset\nset encoding utf8\n";
    const std::string plot = std::string(content.substr(line + 1)) + "set output\n";
    const std::vector<std::string> sides = split(size, ' ');
    const auto inches = [&](std::size_t k) { return std::stod(sides.at(k)) / 96; };
    files_.write(name + ".svg", run_gnuplot(script +
                                            fmt::format("set terminal svg size {},{} fixed noenhanced font "
                                                        "'sans-serif,12.5' background '#ffffff'\n",
                                                        sides.at(0), sides.at(1)) +
                                            plot));
    files_.write(name + ".pdf",
                 run_gnuplot(script +
                             fmt::format("set terminal pdfcairo size {:.4f}in,{:.4f}in noenhanced "
                                         "font 'sans-serif,9.4'\n",
                                         inches(0), inches(1)) +
                             plot));
    waiting_.push_back(name);
    return fmt::format("<p class=\"paper\"><a href=\"{0}.svg\">SVG</a> <a href=\"{0}.pdf\">PDF</a></p>\n",
                       name);
  }

  AtomicFiles& files_;
  std::string section_ = "Findings", caption_, document_;
  std::vector<std::string> names_, waiting_;
};

// Returns the text between two others, or an empty text.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t start = text.find(before);
  if (start == std::string_view::npos) return "";
  text.remove_prefix(start + before.size());
  return text.substr(0, text.find(after));
}

}  // namespace

std::string table_for_print(std::string_view latex) { return copy_of(of_table, latex); }
std::string plot_for_print(const Drawing& drawing) {
  return copy_of(of_plot,
                 fmt::format("{:.0f} {:.0f}\n", drawing.size.width, drawing.size.height) + drawing.script);
}
std::string section_for_print(std::string_view heading) { return copy_of(of_section, one_line(heading)); }
std::string caption_for_print(std::string_view html) { return copy_of(of_caption, html); }

namespace {

// Takes the copies out of a page. `replacement` receives the kind and the content of each copy, and returns
// the text that stands in its place.
std::string take_copies(std::string_view rest,
                        const std::function<std::string(char, std::string_view)>& replacement) {
  std::string html;
  while (!rest.empty()) {
    const std::size_t start = std::min(rest.find(kStart), rest.size());
    html += rest.substr(0, start);
    rest.remove_prefix(start);
    if (rest.empty()) break;
    const std::size_t end = rest.find(kEnd);
    if (end == std::string_view::npos || end < 2) throw std::logic_error("a copy on a page does not end");
    html += replacement(rest[1], rest.substr(2, end - 2));
    rest.remove_prefix(end + 1);
  }
  return html;
}

}  // namespace

std::string without_copies(const std::string& page) {
  return take_copies(page, [](char, std::string_view) { return std::string(); });
}

void write_page(AtomicFiles& files, const std::string& page, bool print) {
  if (!print) return files.write("report.html", without_copies(page));
  PrintFiles copies(files);
  const std::string html = take_copies(page, [&](char kind, std::string_view copy) {
    std::string content(copy);
    std::ranges::replace(content, kLess, '<');
    std::ranges::replace(content, kGreater, '>');
    return copies.add(kind, content);
  });
  files.write("report.html", html);
  copies.finish(latex_of_html(between(html, "<title>", "</title>")));
}

void check_page(const Destinations& destinations) {
  if (destinations.out) require_gnuplot("--out");
  if (!destinations.print) return;
  if (!destinations.out)
    throw InputError("--paper writes its files beside report.html, expected --out DIR as well");
  require_gnuplot_pdf("--paper");
}

}  // namespace kds
