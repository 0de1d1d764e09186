#include "experiments/output/page/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/text.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

// Files in memory are used instead of pipes: they cannot deadlock, raise SIGPIPE or fill a disk.
Stream nameless_file() {
  const int descriptor = ::memfd_create("kds", MFD_CLOEXEC);
  Stream file(descriptor < 0 ? nullptr : ::fdopen(descriptor, "w+"));
  if (!file) fail_to_write("gnuplot: cannot make a file in memory", errno);
  return file;
}

std::string content_of(std::FILE* file) {
  std::string text;
  std::array<char, 65536> block;
  std::rewind(file);
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), file))
    text.append(block.data(), size);
  return text;
}

struct Outcome {
  int status = 0;  ///< the status of waitpid
  std::string output, errors;
};

Outcome spawn_gnuplot(const std::string& script) {
  const Stream input = nameless_file(), output = nameless_file(), errors = nameless_file();
  if (std::fwrite(script.data(), 1, script.size(), input.get()) != script.size() ||
      std::fflush(input.get()) != 0)
    fail_to_write("gnuplot: cannot write its script", errno);
  std::rewind(input.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), 0);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(output.get()), 1);
  posix_spawn_file_actions_adddup2(&actions, ::fileno(errors.get()), 2);
  std::string name = "gnuplot", plain = "--default-settings";  // ignores the user's start-up file
  const std::array<char*, 3> arguments{name.data(), plain.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("gnuplot: " + std::generic_category().message(failed));

  Outcome outcome;
  while (::waitpid(child, &outcome.status, 0) < 0 && errno == EINTR) {
  }
  outcome.output = content_of(output.get());
  outcome.errors = content_of(errors.get());
  return outcome;
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  Outcome outcome = spawn_gnuplot(script);
  if (!WIFEXITED(outcome.status) || WEXITSTATUS(outcome.status) != 0 || outcome.output.empty())
    throw std::runtime_error("gnuplot failed: " + one_line(outcome.errors));
  return std::move(outcome.output);
}

namespace {

void require_terminal(const std::string& terminal, std::string_view what) {
  std::string why;
  try {
    static_cast<void>(run_gnuplot(fmt::format("set terminal {}\nset print '-'\nprint 'ready'\n", terminal)));
    return;
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    why = error.what();
  }
  throw InputError(fmt::format("{} (Debian package gnuplot-nox): {}", what, why));
}

}  // namespace

void require_gnuplot(std::string_view option) {
  require_terminal("svg", fmt::format("{} needs gnuplot for its plots", option));
}

void require_gnuplot_pdf(std::string_view option) {
  require_terminal("pdfcairo", fmt::format("{} needs a gnuplot that has the terminal pdfcairo", option));
}

std::string page_colours_script() {
  std::string script;
  for (std::size_t k = 0; k < page_colours.size(); ++k)
    script += fmt::format("c_{} = '#{:06x}'\n", page_colours[k], k);
  return script;
}

namespace {

[[noreturn]] void fail(std::string_view why) {
  throw std::runtime_error(fmt::format("gnuplot failed: {}", why));
}

// Returns the number after `word`, with spaces skipped.
template <class Number>
Number number_after(std::string_view line, std::string_view word) {
  std::size_t offset = line.find(word);
  if (offset != std::string_view::npos) offset = line.find_first_not_of(' ', offset + word.size());
  Number number{};
  if (offset == std::string_view::npos ||
      std::from_chars(line.data() + offset, line.data() + line.size(), number).ec != std::errc())
    fail(fmt::format("expected a number after {} in {}", word, one_line(line)));
  return number;
}

std::string title(const std::string& text) { return "<title>" + html_escaped_lines(text) + "</title>"; }

// Replaces gnuplot's colours by the colours of the page. gnuplot writes them as rgb(0,0,K) or rgb(  0,   0,
// K). Other colours belong to nothing that is drawn.
std::string in_page_colours(std::string_view line) {
  std::string result;
  for (std::size_t offset = 0;;) {
    const std::size_t start = line.find("rgb(", offset), end = line.find(')', start);
    if (end == std::string_view::npos) return result += line.substr(offset);
    const std::string_view colour = line.substr(start, end - start);
    const auto code = number_after<std::size_t>(colour, colour.substr(0, colour.rfind(',') + 1));
    result += line.substr(offset, start - offset);
    result += fmt::format("var(--{})", page_colours[code < page_colours.size() ? code : 0]);
    offset = end + 1;
  }
}

// Returns the number with `digits` decimals and without zeros at its end.
std::string decimal_text(double value, int digits = 1) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  if (text.starts_with("0.")) text.erase(0, 1);
  return text == "-0" ? "0" : text;
}

// A path of straight lines as it is written: M x y, L x y, or H x and V y if one coordinate stays.
class PathText {
 public:
  void move(double x, double y) { put('M', decimal_text(x), decimal_text(y)); }
  void line(double x, double y) {
    const std::string to_x = decimal_text(x), to_y = decimal_text(y);
    if (to_x == x_ && to_y == y_) return;
    if (to_y == y_) {
      text_ += 'H' + (x_ = to_x);
    } else if (to_x == x_) {
      text_ += 'V' + (y_ = to_y);
    } else {
      put('L', to_x, to_y);
    }
  }
  void close() { text_ += 'Z'; }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void put(char command, const std::string& x, const std::string& y) {
    text_ += command + x + ' ' + y;
    x_ = x;
    y_ = y;
  }
  std::string text_, x_, y_;
};

// Reads "x,y", with or without a letter before it.
std::pair<double, double> point_of(std::string_view word) {
  return {number_after<double>(word, ""), number_after<double>(word, ",")};
}

// Returns the path of a polygon that gnuplot writes as "x,y x,y ...".
std::string polygon_path(std::string_view points) {
  PathText path;
  bool is_first = true;
  for (const std::string& word : split(points, ' ')) {
    if (word.find(',') == std::string::npos) continue;
    const auto [x, y] = point_of(word);
    std::exchange(is_first, false) ? path.move(x, y) : path.line(x, y);
  }
  path.close();
  return path.take();
}

// Shortens the path of a line of gnuplot, which consists of Mx,y and Lx,y.
std::string compact(std::string_view line) {
  constexpr std::string_view before = "d='";
  const std::size_t start = line.find(before);
  const std::size_t end = start == std::string_view::npos ? start : line.find('\'', start + before.size());
  if (end == std::string_view::npos) return std::string(line);
  PathText path;
  for (const std::string& word :
       split(line.substr(start + before.size(), end - start - before.size()), ' ')) {
    if (word.empty()) continue;
    if (word[0] != 'M' && word[0] != 'L') return std::string(line);
    const auto [x, y] = point_of(std::string_view(word).substr(1));
    word[0] == 'M' ? path.move(x, y) : path.line(x, y);
  }
  return std::string(line.substr(0, start)) + "d='" + path.take() + std::string(line.substr(end));
}

class Rewriter {
 public:
  Rewriter(TextsOf of, const std::vector<std::string>& texts) : of_(of), texts_(texts) {}

  void add(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (unfinished_.empty() && !line.starts_with("<path") && !line.starts_with("<polygon"))
      return add_element(line);
    unfinished_ += (unfinished_.empty() ? "" : " ") + std::string(line);  // gnuplot breaks long paths
    if (unfinished_.find("/>") != std::string::npos) add_element(std::exchange(unfinished_, ""));
  }

  std::string finish(const DrawingSize& size) {
    end_squares();
    for (std::size_t k = 0; k < strips_.size(); ++k) {
      const auto& [at, text] = strips_[k];
      const double from = k == 0 ? size.left : (strips_[k - 1].first + at) / 2;
      const double to = k + 1 == strips_.size() ? size.width - size.right : (at + strips_[k + 1].first) / 2;
      emit(fmt::format("<path class=\"hot\" d=\"M{} {}H{}V{}H{}Z\">", decimal_text(from),
                       decimal_text(size.top), decimal_text(to), decimal_text(size.height - size.bottom),
                       decimal_text(from)) +
           title(texts_[text]) + "</path>");
    }
    if (placed_ != texts_.size()) fail(fmt::format("expected {} texts, found {}", texts_.size(), placed_));
    return std::move(svg_);
  }

 private:
  void add_element(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (const std::size_t end = line.find("/>"); line.starts_with("<path") && end + 2 < line.size()) {
      add_element(line.substr(0, end + 2));  // a group may begin or end behind a path
      line.remove_prefix(end + 2);
      return add_element(line);
    }
    if (line.empty() || line.starts_with("<rect")) return;  // the page provides the background
    if (!line.starts_with("<polygon")) end_squares();
    if (line.starts_with("<g onmousemove")) {
      text_ = number_after<std::size_t>(line, "showHypertext(evt,'");
      if (text_ >= texts_.size()) fail("expected fewer hypertexts");
    } else if (line.starts_with("<use")) {
      mark(line);
    } else if (line.starts_with("<polygon") && of_ == TextsOf::squares) {
      square(line);
    } else if (line.starts_with("<g id=")) {  // a plot with its title
      emit("<g>");
    } else if (line.starts_with("<g fill=\"none\"")) {
      groups_.push_back(group(line));
    } else if (line == "</g>" && !groups_.empty()) {
      groups_.pop_back();  // a group without content
    } else if (line.starts_with("<polygon")) {
      polygon(line);
    } else if (line.starts_with("<g transform=")) {
      emit(group_of_text(line));
    } else if (line.starts_with("<path") && number_of_colour(line) < series_colours) {
      emit("<path class=\"curve\"" + in_page_colours(compact(line.substr(5))));
    } else {
      emit(in_page_colours(line));
    }
  }

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

  // Return the start of a group, without what the page's style says.
  static std::string group(std::string_view line) {
    const auto width = number_after<double>(line, "stroke-width=\"");
    return width == 1 ? "<g>" : fmt::format("<g stroke-width=\"{}\">", decimal_text(width));
  }
  static std::string group_of_text(std::string_view line) {
    const std::size_t style = line.find(" stroke="), anchor = line.find(" text-anchor=");
    if (style > anchor || anchor == std::string_view::npos) return in_page_colours(line);
    return std::string(line.substr(0, style)) + std::string(line.substr(anchor));
  }

  // Returns where the points of a polygon begin and end in its line.
  static std::pair<std::size_t, std::size_t> points_of(std::string_view line) {
    constexpr std::string_view before = "points = '";
    const std::size_t start = line.find(before);
    const std::size_t end = start == std::string_view::npos ? start : line.find('\'', start + before.size());
    if (end == std::string_view::npos) fail("expected a polygon");
    return {start + before.size(), end};
  }

  void polygon(std::string_view line) {
    const auto [points, end] = points_of(line);
    const std::size_t name = line.find("points"), first = std::string_view("<polygon").size();
    emit("<path" + in_page_colours(line.substr(first, name - first)) + "d='" +
         polygon_path(line.substr(points, end - points)) + std::string(line.substr(end)));
  }

  // Writes a square with its text. Without texts, collects the squares of each opacity.
  void square(std::string_view line) {
    constexpr std::string_view before_opacity = "fill-opacity='";
    const auto [points, points_end] = points_of(line);
    const std::string path = polygon_path(line.substr(points, points_end - points));
    const std::string opacity =
        line.find(before_opacity) == std::string_view::npos
            ? ""
            : fmt::format(" opacity=\"{}\"", decimal_text(number_after<double>(line, before_opacity), 2));
    if (!std::exchange(in_squares_, true)) emit("<g class=\"squares\">");
    if (texts_.empty()) {
      joined_[opacity] += path;
    } else {
      if (placed_ == texts_.size()) fail("expected fewer squares");
      emit(fmt::format("<path{} d=\"{}\">", opacity, path) + title(texts_[placed_++]) + "</path>");
    }
    if (const std::string_view tail = line.substr(line.rfind("/>") + 2); !tail.empty()) add_element(tail);
  }

  void end_squares() {
    if (!std::exchange(in_squares_, false)) return;
    for (const auto& [opacity, path] : joined_) emit(fmt::format("<path{} d=\"{}\"/>", opacity, path));
    joined_.clear();
    emit("</g>");
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
  bool in_squares_ = false;
  std::string unfinished_;                     ///< the first lines of an element
  std::map<std::string, std::string> joined_;  ///< paths of the squares by opacity
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
