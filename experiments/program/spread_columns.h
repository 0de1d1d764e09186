#pragma once
// Table columns for a quantity that was measured in several rounds.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/program/timing.h"

namespace kds {

/// Returns the columns KEY, KEY_least and KEY_most for JSON and CSV. Tables for people show "median (least to
/// most)" in one column.
template <class Row>
std::vector<Column<Row>> spread_columns(const std::string& key, const std::string& heading,
                                        const std::function<std::optional<Spread>(const Row&)>& spread) {
  const auto part = [&](double Spread::*which) {
    return [spread, which](const Row& row) {
      const std::optional<Spread> found = spread(row);
      return found ? Field((*found).*which) : Field();
    };
  };
  return {{.key = key,
           .heading = heading,
           .value = part(&Spread::median),
           .words = [spread](const Row& row) { return spread_text(*spread(row)); }},
          {.key = key + "_least", .value = part(&Spread::least)},
          {.key = key + "_most", .value = part(&Spread::most)}};
}

}  // namespace kds
