#pragma once
// Files for print (--paper): each table of a report page as LaTeX, each plot as SVG and PDF, and
// paper-all.tex, a document that includes all tables and plots.
//
// A page in the making carries a copy of each table and plot in the form that print needs. The copy stands
// behind its table or plot, between control characters, which no other text of the page contains
// (html_escaped). write_page takes the copies out of the page.

#include <filesystem>
#include <string>
#include <string_view>

#include "experiments/output/output_files.h"
#include "experiments/output/page/drawing.h"

namespace kds {

/// Returns a copy of a table, which is a LaTeX tabular environment.
[[nodiscard]] std::string table_for_print(std::string_view latex);
/// Returns a copy of a plot, which is a gnuplot script after `set terminal`, with its size in pixels.
[[nodiscard]] std::string plot_for_print(const Drawing& drawing);
/// Returns a note of the section (plain text) that the copies after it belong to.
[[nodiscard]] std::string section_for_print(std::string_view heading);
/// Returns a note of the caption (HTML) of the plots between this note and the last caption.
[[nodiscard]] std::string caption_for_print(std::string_view html);

/// Returns the page as write_page writes it without `print`.
[[nodiscard]] std::string without_copies(const std::string& page);

/// Writes report.html. If `print`, also writes these files and links them in the page:
///
///   paper-table-SECTION.tex           a table, without caption
///   paper-figure-SECTION.svg, .pdf    a plot with its key, in the page's light colours
///   paper-all.tex                     a document that shows them all with their captions
///
/// SECTION is the heading of the table's or plot's section, in lower case, with a number from the second
/// one on. Throws std::runtime_error if gnuplot fails.
void write_page(AtomicFiles& files, const std::string& page, bool print);

/// Checks before work begins that write_page can write. Throws InputError if gnuplot is missing or cannot
/// make what is needed, or if --paper comes without --out.
void check_page(const Destinations& destinations);

}  // namespace kds
