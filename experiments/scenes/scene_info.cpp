#include "experiments/scenes/scene_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/output/text.h"
#include "motions/base/input_error.h"
namespace kds {

namespace {

// Returns the necklace of a bead.
const Necklace& necklace_of(std::span<const Necklace> necklaces, BeadId bead) {
  return *std::find_if(necklaces.begin(), necklaces.end(),
                       [bead](const Necklace& necklace) { return bead <= necklace.beads().last; });
}

double distance_from_holding(std::span<const Necklace> necklaces, Condition condition,
                             const Violation& violation) {
  const auto [i, j] = violation;
  const Necklace& a = necklace_of(necklaces, i);
  const Necklace& b = necklace_of(necklaces, j);
  const auto bond = [&](BeadId bead) { return (a.center(bead + 1) - a.center(bead)).stableNorm(); };
  const double distance = (b.center(j) - a.center(i)).stableNorm();
  switch (condition) {
    case Condition::connected:
      return distance - (a.radius(i) + b.radius(j));
    case Condition::disjoint:
      return a.radius(i) + b.radius(j) - distance;
    case Condition::uncontained:
      return b.radius(j) - a.radius(i) - distance;
    case Condition::uniform_radii:
      return b.radius(j) / a.radius(i);
    case Condition::uniform_bonds:
      break;
  }
  return bond(j) / bond(i);
}

class Description {
 public:
  Description(std::span<const Trajectory> necklaces, std::span<const std::size_t> frames_of_necklaces,
              std::span<const double> radii)
      : radii_(radii) {
    std::size_t beads = 0;
    for (std::size_t n = 0; n < necklaces.size(); ++n) {
      const Trajectory& necklace = necklaces[n];
      const auto first = static_cast<BeadId>(beads);
      beads += necklace.bead_count();
      info_.frames = std::max(info_.frames, frames_of_necklaces[n]);
      info_.necklaces.push_back({necklace.file,
                                 {first, static_cast<BeadId>(beads - 1)},
                                 frames_of_necklaces[n],
                                 {},
                                 {},
                                 necklace.breaks,
                                 necklace.later_breaks,
                                 necklace.residues,
                                 necklace.residues_read});
    }
    info_.beads = beads;
    info_.radius_min = *std::min_element(radii.begin(), radii.end());
    info_.radius_max = *std::max_element(radii.begin(), radii.end());
    for (const Condition condition : kConditions)
      info_.conditions[static_cast<std::size_t>(condition)].condition = condition;
  }

  [[nodiscard]] std::size_t frames() const { return info_.frames; }

  void add_frame(const FrameRead& frame, const ValidateOptions& options) {
    const bool first = begun_ == 0;
    ++begun_;
    std::vector<Necklace> necklaces;
    for (NecklaceInfo& info : info_.necklaces) {
      const Necklace& necklace = necklaces.emplace_back(info.beads, frame.positions, radii_);
      const Necklace::Extent bonds = necklace.bonds();
      if (first) info.radii = necklace.radii();
      if (first) info.bonds = bonds;
      info.bonds = {std::min(info.bonds.least, bonds.least), std::max(info.bonds.most, bonds.most)};
    }
    const NecklaceReport report = validate(necklaces, options);
    for (ConditionInfo& info : info_.conditions) {
      const Violations& violations = report[info.condition];
      if (violations.count == 0) continue;
      if (info.violations == 0) {
        info.first_frame = frame.stamp.number;
        info.first = violations.listed;
        for (const Violation& violation : info.first)
          info.by.push_back(distance_from_holding(necklaces, info.condition, violation));
      }
      info.violations += violations.count;
      ++info.frames;
    }
  }

  [[nodiscard]] SceneInfo info() && { return std::move(info_); }

 private:
  std::span<const double> radii_;
  std::size_t begun_ = 0;  // number of frames begun
  SceneInfo info_;
};

}  // namespace

bool SceneInfo::proper() const {
  return std::all_of(conditions.begin(), conditions.end(), [](const auto& c) { return c.holds(); });
}

SceneInfo describe_frames(std::span<const Trajectory> necklaces,
                          std::span<const std::size_t> frames_of_necklaces, FrameSource& frames,
                          std::span<const double> radii, const ValidateOptions& options,
                          const std::function<void(std::size_t, std::size_t)>& progress) {
  Description description(necklaces, frames_of_necklaces, radii);
  FrameRead frame;
  for (std::size_t done = 0; frames.next(frame); progress(++done, description.frames()))
    description.add_frame(frame, options);
  return std::move(description).info();
}

SceneInfo describe_scene(std::span<const Trajectory> necklaces, std::span<const double> radii,
                         const ValidateOptions& options,
                         const std::function<void(std::size_t, std::size_t)>& progress) {
  MemoryFrames frames(necklaces);
  std::vector<std::size_t> frames_of_necklaces;
  for (const Trajectory& necklace : necklaces) frames_of_necklaces.push_back(necklace.frames.size());
  return describe_frames(necklaces, frames_of_necklaces, frames, radii, options, progress);
}

std::string_view about(Condition condition) {
  switch (condition) {
    case Condition::connected:
      return "consecutive beads touch";
    case Condition::disjoint:
      return "all others are disjoint";
    case Condition::uncontained:
      return "no bead lies in another";
    case Condition::uniform_radii:
      return "radii are uniform";
    case Condition::uniform_bonds:
      break;
  }
  return "bonds are uniform";
}

namespace {

constexpr std::size_t kNecklacesShown = 10;

// Returns null for infinity, which JSON cannot express.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

std::string extent(const Necklace::Extent& extent) {
  if (extent.least == extent.most) return fmt::format("{:.6g}", extent.most);
  return fmt::format("{:.6g} to {:.6g} (ratio {:.4g})", extent.least, extent.most, extent.ratio());
}

std::string necklace_line(const NecklaceInfo& info) {
  std::string line = fmt::format("beads {} to {}, radii {}, bonds {}", info.beads.first, info.beads.last,
                                 extent(info.radii), extent(info.bonds));
  if (info.residues > 0)
    line +=
        fmt::format(", {} of {} residue{}", info.residues_read, info.residues, info.residues == 1 ? "" : "s");
  if (info.frames == 1) line += ", one frame";
  if (!info.breaks.empty())
    line += fmt::format(", {} chain break{}", info.breaks.size(), info.breaks.size() == 1 ? "" : "s");
  if (const auto [frames, first_frame] = info.later_breaks; frames > 0)
    line +=
        fmt::format(", {}breaks from frame {} on in {} frame{}", info.breaks.empty() ? "chain " : "other ",
                    first_frame, frames, frames == 1 ? "" : "s");
  return line;
}

std::string first_violations(const ConditionInfo& info) {
  std::string text;
  for (std::size_t i = 0; i < info.first.size(); ++i)
    text += fmt::format("{}{}-{} ({:.3g})", i == 0 ? "" : ", ", info.first[i].first, info.first[i].second,
                        info.by[i]);
  if (info.first.size() < info.violations) text += text.empty() ? "" : ", ...";
  return text;
}

Json first_json(const ConditionInfo& info) {
  Json first = Json::array();
  for (std::size_t i = 0; i < info.first.size(); ++i)
    first.push_back({{"beads", std::vector{info.first[i].first, info.first[i].second}},
                     {"by", number_or_null(info.by[i])}});
  return first;
}

const Table<ConditionInfo>& condition_columns() {
  using Row = ConditionInfo;
  static const Table<Row> table{{
      {.key = "condition",
       .heading = "a proper necklace",
       .value = [](const Row& r) { return Field(name_of(r.condition)); },
       .words = [](const Row& r) { return "  " + std::string(about(r.condition)); }},
      {"violations", "violations", [](const Row& r) { return Field(r.violations); }},
      {"frames", "in frames", [](const Row& r) { return Field(r.frames); }},
      {"first_frame", "first frame", [](const Row& r) { return r.holds() ? Field() : Field(r.first_frame); }},
      {.key = "first", .json = first_json},
      {.key = "holds", .value = [](const Row& r) { return Field(r.holds()); }},
      {.heading = "first beads (by how much)",
       .value = [](const Row& r) { return Field(first_violations(r)); }},
  }};
  return table;
}

}  // namespace

void add_scene(Json& json, const SceneInfo& info) {
  Json files = Json::array(), necklaces = Json::array();
  for (const NecklaceInfo& necklace : info.necklaces) {
    files.push_back(necklace.file);
    const bool known = necklace.residues > 0;
    const LaterBreaks& later = necklace.later_breaks;
    necklaces.push_back({{"file", necklace.file},
                         {"first", necklace.beads.first},
                         {"last", necklace.beads.last},
                         {"frames", necklace.frames},
                         {"radius_min", necklace.radii.least},
                         {"radius_max", necklace.radii.most},
                         {"radius_ratio", number_or_null(necklace.radii.ratio())},
                         {"bond_min", number_or_null(necklace.bonds.least)},
                         {"bond_max", number_or_null(necklace.bonds.most)},
                         {"bond_ratio", number_or_null(necklace.bonds.ratio())},
                         {"breaks", necklace.breaks},
                         {"later_breaks",
                          {{"frames", later.frames},
                           {"first_frame", later.frames > 0 ? Json(later.first_frame) : Json(nullptr)}}},
                         {"residues", known ? Json(necklace.residues) : Json(nullptr)},
                         {"residues_read", known ? Json(necklace.residues_read) : Json(nullptr)}});
  }
  json["input"] = {{"files", files},
                   {"beads", info.beads},
                   {"frames", info.frames},
                   {"dimension", 3},
                   {"truncated", info.truncated},
                   {"radius_min", info.radius_min},
                   {"radius_max", info.radius_max},
                   {"length_unit", info.length_unit}};
  if (info.first_time && info.last_time)
    json["input"]["picoseconds"] = std::vector<double>{*info.first_time, *info.last_time};
  json["necklaces"] = necklaces;
  json["rows"] = condition_columns().json(info.conditions);
  json["proper"] = info.proper();
  if (info.crossings) json["crossings"] = info.crossings->json();
}

std::string conditions_csv(const SceneInfo& info) { return condition_columns().csv(info.conditions); }

std::string scene_table(const SceneInfo& info) {
  std::string text = fmt::format("scene     {} beads, {} frame{}\n", with_thousands(info.beads),
                                 with_thousands(info.frames), info.frames == 1 ? "" : "s");
  if (info.first_time && info.last_time)
    text += info.frames == 1
                ? fmt::format("time      {:.10g} ps\n", *info.first_time)
                : fmt::format("times     {:.10g} to {:.10g} ps\n", *info.first_time, *info.last_time);
  for (std::size_t n = 0; n < std::min(kNecklacesShown, info.necklaces.size()); ++n)
    text +=
        fmt::format("necklace  {}: {}\n", one_line(info.necklaces[n].file), necklace_line(info.necklaces[n]));
  if (info.necklaces.size() > kNecklacesShown)
    text += fmt::format("          and {} more\n", info.necklaces.size() - kNecklacesShown);
  if (info.crossings) text += fmt::format("crossings {}\n", info.crossings->sentence());
  if (!info.why_no_crossings.empty())
    text += fmt::format("crossings not counted: {}\n", info.why_no_crossings);
  return text + "\n" + condition_columns().text(info.conditions);
}

}  // namespace kds
