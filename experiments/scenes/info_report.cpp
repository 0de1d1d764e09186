#include "experiments/scenes/info_report.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::size_t kNecklacesShown = 10;

// Infinity is no number of JSON.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json row_json(const ConditionInfo& info) {
  Json row{{"condition", name_of(info.condition)},
           {"violations", info.violations},
           {"frames", info.frames},
           {"first_frame", info.holds() ? Json(nullptr) : Json(info.first_frame)},
           {"first", Json::array()},
           {"holds", info.holds()}};
  for (std::size_t i = 0; i < info.first.size(); ++i)
    row["first"].push_back({{"beads", std::vector{info.first[i].first, info.first[i].second}},
                            {"by", number_or_null(info.by[i])}});
  return row;
}

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
  json["rows"] = Json::array();
  for (const ConditionInfo& condition : info.conditions) json["rows"].push_back(row_json(condition));
  json["proper"] = info.proper();
}

std::string conditions_csv(const SceneInfo& info) {
  std::string text = "condition,violations,frames,first_frame,holds\n";
  for (const ConditionInfo& c : info.conditions)
    text += fmt::format("{},{},{},{},{}\n", name_of(c.condition), c.violations, c.frames,
                        c.holds() ? "" : std::to_string(c.first_frame), c.holds());
  return text;
}

std::string scene_table(const SceneInfo& info) {
  std::string text = fmt::format("scene     {} beads, {} frame{}\n", with_thousands(info.beads),
                                 with_thousands(info.frames), info.frames == 1 ? "" : "s");
  for (std::size_t n = 0; n < std::min(kNecklacesShown, info.necklaces.size()); ++n)
    text +=
        fmt::format("necklace  {}: {}\n", one_line(info.necklaces[n].file), necklace_line(info.necklaces[n]));
  if (info.necklaces.size() > kNecklacesShown)
    text += fmt::format("          and {} more\n", info.necklaces.size() - kNecklacesShown);
  text += fmt::format("\n{:<25}{:>12}{:>11}{:>13}  {}\n", "a proper necklace", "violations", "in frames",
                      "first frame", "first beads (by how much)");
  for (const ConditionInfo& c : info.conditions) {
    std::string line = fmt::format("  {:<23}{:>12}{:>11}{:>13}  {}", about(c.condition),
                                   with_thousands(c.violations), with_thousands(c.frames),
                                   c.holds() ? "-" : with_thousands(c.first_frame), first_violations(c));
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace kds
