#include "experiments/collide/collide_report.h"

#include <fmt/format.h>

#include <algorithm>

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

std::string distance_plot(const CollideReport& report) {
  LinePlot plot{"frame", "closest distance", Drawn::line, {{"closest pair", {}}}, true};
  for (const FrameFound& frame : report.frames)
    if (frame.closest)
      plot.curves.front().points.emplace_back(static_cast<double>(frame.stamp.number),
                                              frame.closest->distance);
  return plot.curves.front().points.size() < 2 ? "" : svg_plot(plot);
}

std::string findings(const CollideReport& report) {
  const auto colliding = static_cast<std::size_t>(
      std::ranges::count_if(report.frames, [](const FrameFound& frame) { return frame.collide; }));
  std::string html =
      fmt::format("<p>Beads collide in <strong>{}</strong> of {} {}", with_thousands(colliding),
                  with_thousands(report.frames.size()), report.frames.size() == 1 ? "frame" : "frames");
  const auto telling =
      std::ranges::find_if(report.rows, [](const auto& row) { return row.pairs.has_value(); });
  if (telling != report.rows.end())
    html += fmt::format(", in {} pairs of all frames", with_thousands(*telling->pairs));
  html += ".";
  const auto closest =
      std::ranges::find_if(report.rows, [](const auto& row) { return row.closest.has_value(); });
  if (closest != report.rows.end()) {
    const ClosestPair& pair = closest->closest->pair;
    html += fmt::format(" The closest pair, beads {} and {} in frame {}, is {} apart.", pair.first,
                        pair.second, closest->closest->frame.number, short_decimal(pair.distance));
  }
  html += "</p>\n";
  if (report.rows.size() > 1) {
    const auto& quickest = *std::ranges::min_element(report.rows, {}, &CollideRow::seconds);
    html += fmt::format("<p>{} was the fastest of the methods in this one run.</p>\n",
                        html_escaped(quickest.method));
  }
  return html;
}

std::string table(const CollideReport& report) {
  std::vector<HtmlRow> rows;
  for (const CollideRow& row : report.rows)
    rows.push_back(
        {{std::string(row.method), count_or_dash(row.pairs), with_thousands(row.colliding_frames),
          count_or_dash(row.family), short_decimal(row.seconds), short_decimal(row.closest_seconds)}});
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
    json.push_back({{"method", row.method},
                    {"pairs", count_or_null(row.pairs)},
                    {"closest", closest},
                    {"family", count_or_null(row.family)},
                    {"colliding_frames", row.colliding_frames},
                    {"seconds", row.seconds},
                    {"closest_seconds", row.closest_seconds}});
  }
  return json;
}

Json collide_frames_json(const CollideReport& report) {
  Json json = Json::array();
  for (const FrameFound& frame : report.frames) {
    Json one{{"frame", frame.stamp.number},
             {"collide", frame.collide},
             {"pairs", count_or_null(frame.pairs)},
             {"closest", frame.closest ? pair_json(*frame.closest) : Json(nullptr)}};
    if (frame.stamp.picoseconds) one["picoseconds"] = *frame.stamp.picoseconds;
    json.push_back(std::move(one));
  }
  return json;
}

std::string collide_csv(const CollideReport& report) {
  std::string text = "method,pairs,frame,i,j,distance,family,colliding_frames,seconds,closest_seconds\n";
  for (const CollideRow& row : report.rows)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", row.method, count_or_empty(row.pairs),
                        row.closest ? fmt::format("{}", row.closest->frame.number) : "",
                        pair_csv(row.closest ? std::optional(row.closest->pair) : std::nullopt),
                        count_or_empty(row.family), row.colliding_frames, row.seconds, row.closest_seconds);
  return text;
}

std::string collide_frames_csv(const CollideReport& report) {
  std::string text = "frame,collide,pairs,i,j,distance\n";
  for (const FrameFound& frame : report.frames)
    text += fmt::format("{},{},{},{}\n", frame.stamp.number, frame.collide, count_or_empty(frame.pairs),
                        pair_csv(frame.closest));
  return text;
}

std::string collide_table(const CollideReport& report) {
  std::string text =
      fmt::format("frames    {}\n{}\n", with_thousands(report.frames.size()), closest_line(report));
  text += fmt::format("{:<10}{:>12}{:>18}{:>14}{:>14}{:>18}\n", "method", "pairs", "colliding frames",
                      "family", "seconds", "and for closest");
  for (const CollideRow& row : report.rows)
    text += fmt::format("{:<10}{:>12}{:>18}{:>14}{:>14.6f}{:>18.6f}\n", row.method, count_or_dash(row.pairs),
                        with_thousands(row.colliding_frames), count_or_dash(row.family), row.seconds,
                        row.closest_seconds);
  return text;
}

std::string collide_page(const CollideReport& report, const std::string& input, const std::string& map,
                         Page page) {
  page.title = "kds collide: " + input;
  page.found = findings(report);
  page.words =
      "All methods decide exactly, and have found the same. <em>Pairs</em>: beads that have a point in "
      "common, or whose surfaces are at most as far apart as <code>--within</code> says, of all frames "
      "together; <em>family</em>: pairs of spheres of a hierarchy that prove all others disjoint, for the "
      "power diagram its edges; <em>seconds</em>: to find the pairs in all frames, in this one run; "
      "<code>kds bench collision</code> repeats its own. The distance of two beads is that of their "
      "surfaces, below zero where they overlap.";
  std::string plots;
  if (!map.empty()) plots += html_figure(map, "Which beads collide.");
  if (const std::string distance = distance_plot(report); !distance.empty())
    plots += html_figure(distance, "The closest distance of all pairs asked for, frame by frame.");
  page.body = html_section("Plots", plots) + html_section("Figures", table(report));
  return html_page(page);
}

}  // namespace kds
