#pragma once
// Table columns for how a quantity grows with the size of its input.

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/page/table.h"
#include "experiments/program/growth_fit.h"
#include "experiments/program/power_fit.h"

namespace kds {

/// All fits to one quantity. A fit that needs more sizes than there are is empty.
struct GrowthSummary {
  std::optional<PowerFit> line;    ///< straight line through the logarithms, without lower-order terms
  std::vector<double> local;       ///< local_exponents
  std::optional<double> exponent;  ///< growth_exponent
  std::optional<GrowthFit> law;
  std::string size = "n";  ///< the name of the size in the law
};

/// Returns the columns sizes, line, last (the local exponent at the largest size), exponent, law,
/// residual_most and prediction_error.
template <class Row>
std::vector<Column<Row>> growth_columns(const std::function<const GrowthSummary&(const Row&)>& growth) {
  const auto of_law = [growth](auto member) {
    return [growth, member](const Row& row) {
      const auto& law = growth(row).law;
      return law ? Field((*law).*member) : Field();
    };
  };
  return {
      {.key = "sizes", .value = [growth](const Row& r) { return Field(growth(r).line->points); }},
      {"line", "line", [growth](const Row& r) { return Field(growth(r).line->exponent); }, with_decimals(3)},
      {"last", "local, last",
       [growth](const Row& r) {
         const auto& local = growth(r).local;
         return local.empty() ? Field() : Field(local.back());
       },
       with_decimals(3)},
      {.key = "local_exponents", .json = [growth](const Row& r) { return Json(growth(r).local); }},
      {"exponent", "beside lower-order terms", [growth](const Row& r) { return Field(growth(r).exponent); },
       with_decimals(3)},
      {.key = "law",
       .heading = "law",
       .value =
           [growth](const Row& r) {
             const auto& law = growth(r).law;
             return law ? Field(growth_text(*law, growth(r).size)) : Field();
           },
       .words =
           [growth](const Row& r) {
             const auto& law = *growth(r).law;
             return law.residual_most > 1 ? "none fits within 100%" : growth_text(law, growth(r).size);
           }},
      {.key = "residual_most",
       .heading = "largest residual",
       .value = of_law(&GrowthFit::residual_most),
       .format = in_percent},
      {.key = "prediction_error",
       .heading = "predicts the last",
       .value = of_law(&GrowthFit::prediction_error),
       .words =
           [growth](const Row& r) {
             return fmt::format("{:+.2f}%", 100 * *growth(r).law->prediction_error);
           }},
  };
}

}  // namespace kds
