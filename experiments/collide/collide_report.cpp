#include "experiments/collide/collide_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/events/event_distribution.h"
#include "experiments/events/frame_axis.h"
#include "experiments/output/output_files.h"
#include "experiments/output/page/print.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "experiments/program/spread_columns.h"
#include "experiments/program/timing.h"

namespace kds {

namespace {

std::string frame_text(const FrameStamp& frame) {
  if (!frame.picoseconds) return fmt::to_string(frame.number);
  return fmt::format("{} ({:.10g} ps)", frame.number, *frame.picoseconds);
}

std::string closest_line(const CollideReport& report) {
  for (const CollideRow& row : report.rows) {
    if (!row.closest) continue;
    const ClosestPair& pair = row.closest->pair;
    const std::string_view what = pair.sign > 0 ? "apart" : pair.sign == 0 ? "they touch" : "they overlap";
    return fmt::format("closest   beads {} and {} in frame {}, distance {} ({})\n", pair.first, pair.second,
                       frame_text(row.closest->frame), pair.distance, what);
  }
  return "closest   -\n";  // no method reports it, or no pair is asked for
}

std::string findings(const CollideReport& report) {
  std::string html =
      fmt::format("<p>Beads collide in <strong>{}</strong> of {} {}", with_thousands(report.colliding_frames),
                  with_thousands(report.frames), report.frames == 1 ? "frame" : "frames");
  html += fmt::format(": {} pairs, summed over all frames.", with_thousands(report.rows.front().pairs));
  const auto closest =
      std::ranges::find_if(report.rows, [](const auto& row) { return row.closest.has_value(); });
  if (closest != report.rows.end()) {
    const ClosestPair& pair = closest->closest->pair;
    const std::string how = pair.sign > 0   ? fmt::format("are {} apart", short_decimal(pair.distance))
                            : pair.sign < 0 ? fmt::format("overlap by {}", short_decimal(-pair.distance))
                                            : "touch";
    html += fmt::format(" The closest two, beads {} and {} in frame {}, {}.", pair.first, pair.second,
                        frame_text(closest->closest->frame), how);
  }
  html += "</p>\n";
  if (report.rows.size() > 1) {
    const auto& quickest =
        *std::ranges::min_element(report.rows, {}, [](const CollideRow& row) { return row.seconds.median; });
    html += fmt::format("<p><strong>{}</strong> was the fastest method: {} s for all frames.</p>\n",
                        html_escaped(quickest.method), spread_text(quickest.seconds));
  }
  return html;
}

/// Returns the columns of the closest pair, which are members of the object `closest` in JSON.
template <class Row, class PairOf>
std::vector<Column<Row>> pair_columns(PairOf pair_of) {
  const auto part = [&](const char* key, auto ClosestPair::*which) {
    return Column<Row>{.key = key, .value = [=](const Row& row) {
                         const std::optional<ClosestPair> pair = pair_of(row);
                         return pair ? Field((*pair).*which) : Field();
                       }};
  };
  return {part("closest.i", &ClosestPair::first), part("closest.j", &ClosestPair::second),
          part("closest.distance", &ClosestPair::distance)};
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

constexpr std::string_view kCommand = "collide";

}  // namespace

Table<CollideRow> collide_columns(bool timed) {
  using Row = CollideRow;
  Table<Row> table{{
      {"method", "method", [](const Row& r) { return Field(r.method); }},
      {"pairs", "pairs", [](const Row& r) { return Field(r.pairs); }},
      {.key = "closest.frame",
       .value = [](const Row& r) { return r.closest ? Field(r.closest->frame.number) : Field(); }},
  }};
  table.add(pair_columns<Row>(
      [](const Row& r) { return r.closest ? std::optional(r.closest->pair) : std::nullopt; }));
  table.add(
      {{"family", "family", [](const Row& r) { return Field(r.family); }},
       {"colliding_frames", "colliding frames", [](const Row& r) { return Field(r.colliding_frames); }}});
  table.add(spread_columns<Row>("seconds", "seconds", [](const Row& r) { return r.seconds; }));
  table.add(spread_columns<Row>("closest_seconds", "and for closest",
                                [](const Row& r) { return r.closest_seconds; }));
  if (timed)
    table.add(
        {{.key = "closest.picoseconds",
          .value = [](const Row& r) { return r.closest ? Field(r.closest->frame.picoseconds) : Field(); },
          .optional = true}});
  return table;
}

Table<FrameFound> collide_frame_columns(bool timed) {
  using Row = FrameFound;
  Table<Row> table{{{.key = "frame", .value = [](const Row& r) { return Field(r.stamp.number); }},
                    {.key = "collide", .value = [](const Row& r) { return Field(r.pairs > 0); }},
                    {.key = "pairs", .value = [](const Row& r) { return Field(r.pairs); }}}};
  table.add(pair_columns<Row>([](const Row& r) { return r.closest; }));
  Column<Row> time{
      .key = "picoseconds", .json = [](const Row& r) { return Json(r.stamp.picoseconds); }, .optional = true};
  if (timed) time.value = [](const Row& r) { return Field(r.stamp.picoseconds); };
  table.add({time});
  return table;
}

ClosestCourse::ClosestCourse(std::size_t frames)
    : frames_(frames), width_(bin_width(frames, EventCourse::most_bins)) {}

void ClosestCourse::add(const FrameFound& frame) {
  const std::size_t bin = added_++ / width_;
  if (!frame.closest) return;
  const double distance = frame.closest->distance;
  if (distances_.empty() || bin != bin_of_last_) {
    frames_shown_.push_back(frame.stamp);
    distances_.push_back(distance);
  } else if (distance < distances_.back()) {
    frames_shown_.back() = frame.stamp;
    distances_.back() = distance;
  }
  bin_of_last_ = bin;
}

std::string ClosestCourse::figure() const {
  if (distances_.size() < 2) return "";
  constexpr std::size_t few = 60;  // frames; a line would suggest more of them
  const FrameAxis axis(frames_shown_);
  LinePlot plot{axis.label(),
                "closest distance",
                frames_ > few ? Drawn::line : Drawn::points,
                {{"closest pair", {}}},
                true};
  for (std::size_t k = 0; k < distances_.size(); ++k)
    plot.curves.front().points.emplace_back(axis.coordinate(frames_shown_[k]), distances_[k]);
  return html_figure(
      svg_plot(plot),
      fmt::format(
          "Distance of the closest pair, frame by frame, in {}. Two beads overlap if it is below zero.{}",
          length_unit, width_ > 1 ? fmt::format(" Each value is the least of {} frames.", width_) : ""));
}

std::string collide_table(const CollideReport& report) {
  return fmt::format("frames    {}\n{}\n", with_thousands(report.frames), closest_line(report)) +
         collide_columns(false).text(report.rows);
}

std::string collide_page(const CollideReport& report, const std::string& input, const std::string& map,
                         const ClosestCourse& course, Page page) {
  page.title = "kds collide: " + input;
  page.found = findings(report);
  page.words =
      "All methods decide exactly and agree. <em>Pairs</em>: pairs of beads that have a point in common, or "
      "whose surfaces are at most <code>--within</code> apart, summed over all frames; <em>family</em>: "
      "pairs of spheres of a hierarchy that prove all other pairs disjoint; <em>seconds</em>: the time to "
      "find the pairs in all frames, as the median of the rounds with "
      "the least and the most in brackets; <em>and for closest</em>: the time to find the closest pairs as "
      "well. The distance of two beads is the distance of their surfaces, below zero if they overlap.";
  std::string plots;
  if (!map.empty())
    plots += html_figure(map, "The pairs of beads that collide: the stronger the colour, the more often.");
  plots += course.figure();
  page.body =
      html_section("Plots", plots) + html_section("Numbers", collide_columns(false).html(report.rows));
  return html_page(page);
}

ContactMap::ContactMap(std::size_t beads)
    : beads_(beads),
      in_group_((beads + most_groups - 1) / most_groups),
      groups_((beads + in_group_ - 1) / in_group_),
      counts_(groups_ * groups_, 0) {}

void ContactMap::add_frame(std::span<const BeadPair> pairs) {
  ++frames_;
  pairs_ += pairs.size();
  for (const auto& [i, j] : pairs) ++counts_[i / in_group_ * groups_ + j / in_group_];
}

std::string ContactMap::plot() const {
  const auto side = static_cast<double>(in_group_);
  MapPlot map{
      "bead", in_group_ == 1 ? "share of frames" : fmt::format("pairs a frame of {} beads each", in_group_),
      -0.5,   static_cast<double>(beads_) - 0.5,
      side,   {}};
  const auto middle = [&](std::size_t group) { return side * (static_cast<double>(group) + 0.5) - 0.5; };
  for (std::size_t i = 0; i < groups_; ++i) {
    for (std::size_t j = i; j < groups_; ++j) {
      const std::uint64_t count = counts_[i * groups_ + j];
      if (count == 0) continue;
      const double value = static_cast<double>(count) / static_cast<double>(frames_);
      map.squares.push_back({middle(i), middle(j), value});
      if (i != j) map.squares.push_back({middle(j), middle(i), value});
    }
  }
  return svg_plot(map);
}

PairsCsv::PairsCsv(std::ostream& stream, const CollideFrames& scene) : stream_(stream), scene_(scene) {
  stream_ << "frame,i,j,distance,name_i,name_j" << (scene.has_times() ? ",picoseconds\n" : "\n");
}

void PairsCsv::add(const FrameRead& frame, std::span<const BeadPair> pairs) {
  const auto center = [&](BeadId b) -> Eigen::Vector3d { return frame.positions.col(Eigen::Index{b}); };
  const std::vector<double>& radii = scene_.radii();
  std::string time = scene_.has_times() ? "," : "";
  if (scene_.has_times() && frame.stamp.picoseconds) time += fmt::to_string(*frame.stamp.picoseconds);
  for (const auto& [i, j] : pairs) {
    const double distance = (center(i) - center(j)).stableNorm() - (radii[i] + radii[j]);
    stream_ << fmt::format("{},{},{},{},{},{}{}\n", frame.stamp.number, i, j, distance,
                           quoted(scene_.bead_name(i)), quoted(scene_.bead_name(j)), time);
  }
}

void CollideResults::begin(const CollideFrames& scene) {
  frame_columns_ = collide_frame_columns(scene.has_times());
  if (destinations_.out || destinations_.json) frames_.emplace();
  if (!files_) return;
  pairs_.emplace(files_->open("pairs.csv"), scene);
  frames_csv_ = &files_->open("frames.csv");
  *frames_csv_ << frame_columns_.csv_header();
  course_.emplace(scene.frame_count());
  contacts_.emplace(scene.radii().size());
}

void CollideResults::add_frame(const FrameRead& frame, const FrameFound& found,
                               std::span<const BeadPair> pairs) {
  if (frames_) frames_->add(frame_columns_.json(found));
  if (!files_) return;
  *frames_csv_ << frame_columns_.csv_line(found);
  course_->add(found);
  pairs_->add(frame, pairs);
  contacts_->add_frame(pairs);
  files_->check();
}

void CollideResults::deliver(const CollideReport& report, const Json& json, const std::string& input,
                             Page page) {
  const auto write_to = [&](std::ostream& stream) {
    frames_->write_within(json, "frames", [&stream](std::string_view text) { stream << text; });
  };
  const bool json_on_stdout = destinations_.json == "-";
  const bool table_on_stdout = !destinations_.quiet && !json_on_stdout;
  if (files_) {
    write_to(files_->open("collide.json"));
    files_->write("collide.csv", collide_columns(report.timed).csv(report.rows));
    page.data = {"collide.json", "collide.csv", "pairs.csv", "frames.csv"};
    write_page(*files_,
               collide_page(report, input, contacts_->empty() ? "" : contacts_->plot(), *course_, page),
               destinations_.print);
  }
  AtomicFiles json_file;
  if (destinations_.json && !json_on_stdout) write_to(json_file.open(*destinations_.json));
  commit_together({files_.get(), &json_file});
  if (json_on_stdout)
    frames_->write_within(json, "frames", [](std::string_view text) { print_to_stdout(std::string(text)); });
  if (table_on_stdout) print_to_stdout(collide_table(report));
  if (files_ && table_on_stdout) print_report_path(*destinations_.out);
}

}  // namespace kds
