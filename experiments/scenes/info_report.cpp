#include "experiments/scenes/info_report.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "experiments/output/page/table.h"
#include "experiments/output/text.h"

namespace kds {

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
  json["input"] = {{"files", files}, {"beads", info.beads},           {"frames", info.frames},
                   {"dimension", 3}, {"radius_min", info.radius_min}, {"radius_max", info.radius_max}};
  json["necklaces"] = necklaces;
  json["rows"] = condition_columns().json(info.conditions);
  json["proper"] = info.proper();
}

std::string conditions_csv(const SceneInfo& info) { return condition_columns().csv(info.conditions); }

std::string scene_table(const SceneInfo& info) {
  std::string text = fmt::format("scene     {} beads, {} frame{}\n", with_thousands(info.beads),
                                 with_thousands(info.frames), info.frames == 1 ? "" : "s");
  for (std::size_t n = 0; n < std::min(kNecklacesShown, info.necklaces.size()); ++n)
    text +=
        fmt::format("necklace  {}: {}\n", one_line(info.necklaces[n].file), necklace_line(info.necklaces[n]));
  if (info.necklaces.size() > kNecklacesShown)
    text += fmt::format("          and {} more\n", info.necklaces.size() - kNecklacesShown);
  return text + "\n" + condition_columns().text(info.conditions);
}

}  // namespace kds
