#include "experiments/collide/collide_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "experiments/events/event_distribution.h"
#include "experiments/output/output_files.h"
#include "experiments/output/report_page.h"
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

CollisionCourse::CollisionCourse(std::size_t frames) : width_(bin_width(frames, EventCourse::most_bins)) {}

void CollisionCourse::add(const FrameFound& frame) {
  if (added_++ % width_ == 0) return bins_.push_back(frame);
  FrameFound& bin = bins_.back();
  bin.pairs = std::max(bin.pairs, frame.pairs);
  if (frame.closest && !(bin.closest && bin.closest->distance <= frame.closest->distance))
    bin.closest = frame.closest;
}

std::string collide_table(const CollideReport& report) {
  return fmt::format("frames    {}\n{}\n", with_thousands(report.frames), closest_line(report)) +
         collide_columns(false).text(report.rows);
}

ContactMap::ContactMap(std::size_t beads)
    : in_group_((beads + most_groups - 1) / most_groups),
      groups_((beads + in_group_ - 1) / in_group_),
      counts_(groups_ * groups_, 0) {}

void ContactMap::add_frame(std::span<const BeadPair> pairs) {
  for (const auto& [i, j] : pairs) ++counts_[i / in_group_ * groups_ + j / in_group_];
}

Json ContactMap::json() const {
  Json groups = Json::array();
  for (std::size_t i = 0; i < groups_; ++i)
    for (std::size_t j = i; j < groups_; ++j)
      if (const std::uint64_t pairs = counts_[i * groups_ + j]; pairs > 0)
        groups.push_back({{"i", i}, {"j", j}, {"pairs", pairs}});
  return {{"beads_in_group", in_group_}, {"groups", groups}};
}

PairsCsv::PairsCsv(std::ostream& stream, const CollideFrames& scene) : stream_(stream), scene_(scene) {
  stream_ << "frame,i,j,distance,name_i,name_j" << (scene.has_times() ? ",picoseconds\n" : "\n");
}

void PairsCsv::add(const FrameRead& frame, std::span<const BeadPair> pairs) {
  const auto center = [&](BeadId b) -> Eigen::Vector3d { return frame.positions.col(Eigen::Index{b}); };
  const std::optional<Images> images = frame.cell ? std::optional<Images>(*frame.cell) : std::nullopt;
  const std::vector<double>& radii = scene_.radii();
  std::string time = scene_.has_times() ? "," : "";
  if (scene_.has_times() && frame.stamp.picoseconds) time += fmt::to_string(*frame.stamp.picoseconds);
  for (const auto& [i, j] : pairs) {
    Eigen::Vector3d difference = center(i) - center(j);
    if (images) difference = images->shortest(difference);
    const double distance = difference.stableNorm() - (radii[i] + radii[j]);
    stream_ << fmt::format("{},{},{},{},{},{}{}\n", frame.stamp.number, i, j, distance,
                           quoted(scene_.bead_name(i)), quoted(scene_.bead_name(j)), time);
  }
}

void CollideResults::begin(const CollideFrames& scene) {
  frame_columns_ = collide_frame_columns(scene.has_times());
  if (destinations_.out || destinations_.json) frames_.emplace();
  if (frames_) {
    scene_ = &scene;
    course_.emplace(scene.frame_count());
    contacts_.emplace(scene.radii().size());
  }
  if (!files_) return;
  pairs_.emplace(files_->open("pairs.csv"), scene);
  frames_csv_ = &files_->open("frames.csv");
  *frames_csv_ << frame_columns_.csv_header();
}

void CollideResults::add_frame(const FrameRead& frame, const FrameFound& found,
                               std::span<const BeadPair> pairs) {
  if (frames_) {
    frames_->add(frame_columns_.json(found));
    course_->add(found);
    contacts_->add_frame(pairs);
  }
  if (!files_) return;
  *frames_csv_ << frame_columns_.csv_line(found);
  pairs_->add(frame, pairs);
  files_->check();
}

Json CollideResults::names_json(const CollideReport& report) const {
  std::set<BeadId> beads;
  const auto add = [&](const ClosestPair& pair) { beads.insert({pair.first, pair.second}); };
  for (const CollideRow& row : report.rows)
    if (row.closest) add(row.closest->pair);
  for (const FrameFound& bin : course_->bins())
    if (bin.closest) add(*bin.closest);
  Json names = Json::object();
  for (const BeadId bead : beads)
    if (const std::string& name = scene_->bead_name(bead); !name.empty()) names[std::to_string(bead)] = name;
  return names;
}

void CollideResults::deliver(const CollideReport& report, Json json) {
  if (frames_) {
    json["course"] = frame_columns_.json(course_->bins());
    json["map"] = contacts_->json();
    json["names"] = names_json(report);
  }
  const auto write_to = [&](std::ostream& stream) {
    frames_->write_within(json, "frames", [&stream](std::string_view text) { stream << text; });
  };
  const bool json_on_stdout = destinations_.json == "-";
  const bool table_on_stdout = !destinations_.quiet && !json_on_stdout;
  if (files_) {
    write_to(files_->open("collide.json"));
    files_->write("collide.csv", collide_columns(report.timed).csv(report.rows));
    // The page shows the course and the map instead of all frames.
    write_report(*files_, report_name, text_of(json),
                 {{"collide.json", "collide.csv", "pairs.csv", "frames.csv"}});
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
