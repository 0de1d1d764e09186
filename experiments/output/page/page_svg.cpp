#include "experiments/output/page/page_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "experiments/output/page/html_text.h"
#include "experiments/output/text.h"

namespace kds {
namespace {

[[noreturn]] void fail(std::string_view why) {
  throw std::runtime_error(fmt::format("gnuplot failed: {}", why));
}

// Returns the number after `word`, with spaces skipped.
template <class Number>
Number number_after(std::string_view line, std::string_view word) {
  std::size_t place = line.find(word);
  if (place != std::string_view::npos) place = line.find_first_not_of(' ', place + word.size());
  Number number{};
  if (place == std::string_view::npos ||
      std::from_chars(line.data() + place, line.data() + line.size(), number).ec != std::errc())
    fail(fmt::format("expected a number after {} in {}", word, one_line(line)));
  return number;
}

std::string title(const std::string& text) { return "<title>" + html_escaped_lines(text) + "</title>"; }

// Replaces gnuplot's colours by the colours of the page. gnuplot writes them as rgb(0,0,K) or rgb(  0,   0,
// K). Other colours belong to nothing that is drawn.
std::string in_page_colours(std::string_view line) {
  std::string result;
  for (std::size_t place = 0;;) {
    const std::size_t start = line.find("rgb(", place), end = line.find(')', start);
    if (end == std::string_view::npos) return result += line.substr(place);
    const std::string_view colour = line.substr(start, end - start);
    const auto code = number_after<std::size_t>(colour, colour.substr(0, colour.rfind(',') + 1));
    result += line.substr(place, start - place);
    result += fmt::format("var(--{})", page_colours[code < page_colours.size() ? code : 0]);
    place = end + 1;
  }
}

class Rewriter {
 public:
  Rewriter(TextsOf of, const std::vector<std::string>& texts) : of_(of), texts_(texts) {}

  void add(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.empty() || line.starts_with("<rect")) return;  // the page provides the background
    if (line.starts_with("<g onmousemove")) {
      text_ = number_after<std::size_t>(line, "showHypertext(evt,'");
      if (text_ >= texts_.size()) fail("expected fewer hypertexts");
    } else if (line.starts_with("<use")) {
      mark(line);
    } else if (line.starts_with("<polygon") && of_ == TextsOf::squares && !texts_.empty()) {
      if (placed_ == texts_.size()) fail("expected fewer squares");
      emit("<polygon class=\"square\"" + in_page_colours(line.substr(8, line.rfind("/>") - 8)) + ">" +
           title(texts_[placed_++]) + "</polygon>" + std::string(line.substr(line.rfind("/>") + 2)));
    } else if (line.starts_with("<text>\x02")) {
      emit("<text>" + tick_label(number_after<double>(line, "\x02")) + "</text>");
    } else if (line.starts_with("<g id=")) {  // a plot with its title
      emit("<g>");
    } else if (line.starts_with("<g fill=\"none\"")) {
      groups_.emplace_back(line);
    } else if (line == "</g>" && !groups_.empty()) {
      groups_.pop_back();  // a group without content
    } else if (line.starts_with("<path") && number_of_colour(line) < series_colours) {
      emit("<path class=\"curve\"" + in_page_colours(line.substr(5)));
    } else {
      emit(in_page_colours(line));
    }
  }

  std::string finish(const DrawingSize& size) {
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      const auto& [at, text] = strips_[k];
      const double from = k == 0 ? size.left : (strips_[k - 1].first + at) / 2;
      const double to = k + 1 == strips_.size() ? size.width - size.right : (at + strips_[k + 1].first) / 2;
      emit(fmt::format("<rect class=\"hot\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">",
                       from, size.top, to - from, size.height - size.bottom - size.top) +
           title(texts_[text]) + "</rect>");
    }
    if (placed_ != texts_.size()) fail(fmt::format("expected {} texts, found {}", texts_.size(), placed_));
    return std::move(svg_);
  }

 private:
  static std::size_t number_of_colour(std::string_view line) {
    const std::size_t start = line.find("rgb(");
    if (start == std::string_view::npos) return page_colours.size();
    const std::string_view colour = line.substr(start, line.find(')', start) - start);
    return number_after<std::size_t>(colour, colour.substr(0, colour.rfind(',') + 1));
  }

  void emit(std::string_view line) {
    for (const std::string& group : groups_) svg_ += in_page_colours(group) + "\n";
    groups_.clear();
    svg_ += line;
    svg_ += '\n';
  }

  // Writes a mark, which is a circle.
  void mark(std::string_view line) {
    const auto x = number_after<double>(line, "translate("), scale = number_after<double>(line, "scale(");
    const std::string_view after = line.substr(line.find("translate("));
    const auto y = number_after<double>(after, ",");
    const bool has_text = text_ != no_text;
    if (has_text) ++placed_;
    const std::size_t text = std::exchange(text_, no_text);
    if (has_text && of_ == TextsOf::strips) {
      strips_.emplace_back(x, text);
      return;
    }
    const bool closes = !has_text && line.ends_with("</g>");
    emit(
        fmt::format("<circle class=\"mark\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"var(--{})\">{}"
                    "</circle>{}",
                    x, y, scale, page_colours.at(number_of_colour(line)), has_text ? title(texts_[text]) : "",
                    closes ? "</g>" : ""));
  }

  static constexpr std::size_t no_text = ~std::size_t{0};

  TextsOf of_;
  const std::vector<std::string>& texts_;
  std::vector<std::string> groups_;  ///< opened groups that have no content yet
  std::size_t text_ = no_text, placed_ = 0;
  std::vector<std::pair<double, std::size_t>> strips_;
  std::string svg_;
};

}  // namespace

std::string page_svg(std::string_view drawing, const DrawingSize& size, TextsOf of,
                     const std::vector<std::string>& texts, std::string_view attributes) {
  constexpr std::string_view last_definition = "</defs>";
  const std::size_t start = drawing.find(last_definition);
  if (start == std::string_view::npos) fail("it printed no SVG");
  Rewriter rewriter(of, texts);
  rewriter.add("<g id=");
  for (const std::string& line : split(drawing.substr(start + last_definition.size()), '\n'))
    rewriter.add(line);
  return fmt::format("<svg {} viewBox=\"0 0 {:.0f} {:.0f}\">\n{}</svg>\n", attributes, size.width,
                     size.height, rewriter.finish(size));
}

}  // namespace kds
