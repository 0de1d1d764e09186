#include "experiments/scenes/bead_rows.h"

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

const Table<BeadRow>& bead_columns() {
  using Row = BeadRow;
  const auto digits = [](const Field& number) { return number.csv(); };
  const auto part = [](const char* key, std::string BeadName::*name) {
    return Column<Row>{key, key, [name](const Row& r) { return text_or_nothing(r.name.*name); }};
  };
  static const Table<Row> table{{
      {"bead", "bead", [](const Row& r) { return Field(r.bead); }, digits},
      {"necklace", "necklace", [](const Row& r) { return Field(r.necklace); }, digits},
      part("chain", &BeadName::chain),
      part("residue", &BeadName::residue),
      part("number", &BeadName::number),
      part("atom", &BeadName::atom),
      {"radius", "radius", [](const Row& r) { return Field(r.radius); }, with_figures(6)},
  }};
  return table;
}

}  // namespace kds
