#include "experiments/scenes/bead_rows.h"

#include <fmt/format.h>

#include "experiments/output/text.h"
#include "motions/base/csv_field.h"

namespace kds {

std::vector<BeadRow> bead_rows(std::span<const Trajectory> necklaces, std::span<const double> radii) {
  std::vector<BeadRow> rows;
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    const std::vector<std::string>& names = necklaces[n].bead_names;
    for (std::size_t b = 0; b < necklaces[n].bead_count(); ++b) {
      const auto bead = static_cast<BeadId>(rows.size());
      BeadRow& row = rows.emplace_back(BeadRow{bead, n, {}, radii[bead]});
      if (b < names.size()) row.name = bead_name_of(names[b]).value_or(BeadName());
    }
  }
  return rows;
}

Json bead_rows_json(std::span<const BeadRow> rows) {
  const auto text_or_null = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
  Json json = Json::array();
  for (const BeadRow& row : rows)
    json.push_back({{"bead", row.bead},
                    {"necklace", row.necklace},
                    {"chain", text_or_null(row.name.chain)},
                    {"residue", text_or_null(row.name.residue)},
                    {"number", text_or_null(row.name.number)},
                    {"atom", text_or_null(row.name.atom)},
                    {"radius", row.radius}});
  return json;
}

std::string bead_rows_csv(std::span<const BeadRow> rows) {
  std::string text = "bead,necklace,chain,residue,number,atom,radius\n";
  for (const BeadRow& row : rows)
    text += fmt::format("{},{},{},{},{},{},{}\n", row.bead, row.necklace, csv_field(row.name.chain),
                        csv_field(row.name.residue), csv_field(row.name.number), csv_field(row.name.atom),
                        row.radius);
  return text;
}

std::string bead_rows_table(std::span<const BeadRow> rows) {
  const auto shown = [](const std::string& text) { return text.empty() ? "-" : one_line(text); };
  std::string text = fmt::format("{:>9}{:>10}{:>8}{:>9}{:>8}{:>7}{:>12}\n", "bead", "necklace", "chain",
                                 "residue", "number", "atom", "radius");
  for (const BeadRow& row : rows)
    text += fmt::format("{:>9}{:>10}{:>8}{:>9}{:>8}{:>7}{:>12.6g}\n", row.bead, row.necklace,
                        shown(row.name.chain), shown(row.name.residue), shown(row.name.number),
                        shown(row.name.atom), row.radius);
  return text;
}

}  // namespace kds
