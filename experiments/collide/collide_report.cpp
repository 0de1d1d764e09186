#include "experiments/collide/collide_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/events/event_bins.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

Json count_or_null(const std::optional<std::uint64_t>& count) { return count ? Json(*count) : Json(nullptr); }
std::string count_or_empty(const std::optional<std::uint64_t>& count) {
  return count ? fmt::format("{}", *count) : "";
}
std::string count_or_dash(const std::optional<std::uint64_t>& count) {
  return count ? with_thousands(*count) : "-";
}

Json pair_json(const ClosestPair& pair) {
  return {{"i", pair.first}, {"j", pair.second}, {"distance", pair.distance}};
}
std::string pair_csv(const std::optional<ClosestPair>& pair) {
  return pair ? fmt::format("{},{},{}", pair->first, pair->second, pair->distance) : ",,";
}

std::string spread_csv(const std::optional<Spread>& spread) {
  return spread ? fmt::format("{},{},{}", spread->median, spread->least, spread->most) : ",,";
}

std::string closest_line(const CollideReport& report) {
  for (const CollideRow& row : report.rows) {
    if (!row.closest) continue;
    const ClosestPair& pair = row.closest->pair;
    const std::string_view what = pair.sign > 0 ? "apart" : pair.sign == 0 ? "they touch" : "they overlap";
    return fmt::format("closest   beads {} and {} in frame {}, distance {} ({})\n", pair.first, pair.second,
                       row.closest->frame.number, pair.distance, what);
  }
  return "closest   -\n";  // by these methods, or no pair is asked for
}

std::string findings(const CollideReport& report) {
  std::string html =
      fmt::format("<p>Beads collide in <strong>{}</strong> of {} {}", with_thousands(report.colliding_frames),
                  with_thousands(report.frames), report.frames == 1 ? "frame" : "frames");
  const auto telling =
      std::ranges::find_if(report.rows, [](const auto& row) { return row.pairs.has_value(); });
  if (telling != report.rows.end())
    html += fmt::format(": {} pairs in all of them together", with_thousands(*telling->pairs));
  html += ".";
  const auto closest =
      std::ranges::find_if(report.rows, [](const auto& row) { return row.closest.has_value(); });
  if (closest != report.rows.end()) {
    const ClosestPair& pair = closest->closest->pair;
    const std::string how = pair.sign > 0   ? fmt::format("are {} apart", short_decimal(pair.distance))
                            : pair.sign < 0 ? fmt::format("overlap by {}", short_decimal(-pair.distance))
                                            : "touch";
    html += fmt::format(" The closest two, beads {} and {} in frame {}, {}.", pair.first, pair.second,
                        closest->closest->frame.number, how);
  }
  html += "</p>\n";
  if (report.rows.size() > 1) {
    const auto& quickest =
        *std::ranges::min_element(report.rows, {}, [](const CollideRow& row) { return row.seconds.median; });
    html += fmt::format("<p><strong>{}</strong> was the fastest of the methods: {} s for all frames.</p>\n",
                        html_escaped(quickest.method), spread_text(quickest.seconds));
  }
  return html;
}

std::vector<std::string> cells_of(const CollideRow& row) {
  return {std::string(row.method),
          count_or_dash(row.pairs),
          with_thousands(row.colliding_frames),
          count_or_dash(row.family),
          spread_text(row.seconds),
          row.closest_seconds ? spread_text(*row.closest_seconds) : "-"};
}

std::string table(const CollideReport& report) {
  std::vector<HtmlRow> rows;
  for (const CollideRow& row : report.rows) rows.push_back({cells_of(row)});
  return html_table({"method", "pairs", "colliding frames", "family", "seconds", "and for closest"}, rows);
}

}  // namespace

Json collide_rows_json(const CollideReport& report) {
  Json json = Json::array();
  for (const CollideRow& row : report.rows) {
    Json closest(nullptr);
    if (row.closest) {
      closest = pair_json(row.closest->pair);
      closest["frame"] = row.closest->frame.number;
    }
    Json one{{"method", row.method},
             {"pairs", count_or_null(row.pairs)},
             {"closest", closest},
             {"family", count_or_null(row.family)},
             {"colliding_frames", row.colliding_frames},
             {"seconds", row.seconds.median},
             {"seconds_least", row.seconds.least},
             {"seconds_most", row.seconds.most}};
    const auto& of_closest = row.closest_seconds;
    one["closest_seconds"] = of_closest ? Json(of_closest->median) : Json(nullptr);
    one["closest_seconds_least"] = of_closest ? Json(of_closest->least) : Json(nullptr);
    one["closest_seconds_most"] = of_closest ? Json(of_closest->most) : Json(nullptr);
    json.push_back(std::move(one));
  }
  return json;
}

Json collide_frame_json(const FrameFound& frame) {
  Json json{{"frame", frame.stamp.number},
            {"collide", frame.collide},
            {"pairs", count_or_null(frame.pairs)},
            {"closest", frame.closest ? pair_json(*frame.closest) : Json(nullptr)}};
  if (frame.stamp.picoseconds) json["picoseconds"] = *frame.stamp.picoseconds;
  return json;
}

std::string collide_csv(const CollideReport& report) {
  std::string text =
      "method,pairs,frame,i,j,distance,family,colliding_frames,seconds,seconds_least,seconds_most,"
      "closest_seconds,closest_seconds_least,closest_seconds_most\n";
  for (const CollideRow& row : report.rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", row.method, count_or_empty(row.pairs),
                        row.closest ? fmt::format("{}", row.closest->frame.number) : "",
                        pair_csv(row.closest ? std::optional(row.closest->pair) : std::nullopt),
                        count_or_empty(row.family), row.colliding_frames, row.seconds.median,
                        row.seconds.least, row.seconds.most, spread_csv(row.closest_seconds));
  return text;
}

std::string collide_frame_csv(const FrameFound& frame) {
  return fmt::format("{},{},{},{}\n", frame.stamp.number, frame.collide, count_or_empty(frame.pairs),
                     pair_csv(frame.closest));
}

ClosestCourse::ClosestCourse(std::size_t frames)
    : frames_(frames), width_(bin_width(frames, EventCourse::most_bins)) {}

void ClosestCourse::add(const FrameFound& frame) {
  const std::size_t bin = added_++ / width_;
  if (!frame.closest) return;
  const std::pair point(static_cast<double>(frame.stamp.number), frame.closest->distance);
  if (points_.empty() || bin != bin_of_last_) {
    points_.push_back(point);
  } else if (point.second < points_.back().second) {
    points_.back() = point;
  }
  bin_of_last_ = bin;
}

std::string ClosestCourse::figure() const {
  if (points_.size() < 2) return "";
  constexpr std::size_t few = 60;  // frames, that a line would make look like more
  const LinePlot plot{"frame",
                      "closest distance",
                      frames_ > few ? Drawn::line : Drawn::points,
                      {{"closest pair", points_}},
                      true};
  return html_figure(
      svg_plot(plot),
      fmt::format("The distance of the closest pair asked for, frame by frame, in the file's unit "
                  "of length; below zero two beads overlap.{}",
                  width_ > 1 ? fmt::format(" Each value is the least of {} frames.", width_) : ""));
}

std::string collide_table(const CollideReport& report) {
  std::string text = fmt::format("frames    {}\n{}\n", with_thousands(report.frames), closest_line(report));
  std::vector<std::vector<std::string>> lines{
      {"method", "pairs", "colliding frames", "family", "seconds", "and for closest"}};
  for (const CollideRow& row : report.rows) lines.push_back(cells_of(row));
  for (const std::string& line : in_columns(lines, "<>")) text += line + "\n";
  return text;
}

std::string collide_page(const CollideReport& report, const std::string& input, const std::string& map,
                         const ClosestCourse& course, Page page) {
  page.title = "kds collide: " + input;
  page.found = findings(report);
  page.words =
      "All methods decide exactly, and have found the same. <em>Pairs</em>: beads that have a point in "
      "common, or whose surfaces are at most as far apart as <code>--within</code> says, of all frames "
      "together; <em>family</em>: pairs of spheres of a hierarchy that prove all others disjoint, for the "
      "power diagram its edges; <em>seconds</em>: to find the pairs in all frames, the median of the "
      "rounds, and in brackets the least and the most. The distance of two beads is that of their "
      "surfaces, below zero where they overlap.";
  std::string plots;
  if (!map.empty())
    plots += html_figure(map, "Which beads collide: the stronger the colour, the more often.");
  plots += course.figure();
  page.body = html_section("Plots", plots) + html_section("Figures", table(report));
  return html_page(page);
}

}  // namespace kds
