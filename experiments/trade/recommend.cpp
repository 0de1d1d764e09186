#include "experiments/trade/recommend.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "experiments/output/text.h"

namespace kds {

namespace {

// The limit of a small error: one percent, and no bead outside.
constexpr double small_error = 0.01;

/// Returns two significant figures, or a whole number without an exponent for larger values.
std::string few_figures(double value) {
  if (!(value >= 99 && value < 1e15)) return fmt::format("{:.2g}", value);
  return with_thousands(static_cast<std::uint64_t>(std::llround(value)));
}

std::string percent(double share) { return few_figures(100 * share) + "%"; }

std::string subject_of(const TradeRow& row) {
  switch (row.want) {
    case Want::contacts:
      return "For contacts";
    case Want::cages:
      return "For cages";
    case Want::diagram:
      return "For the diagram";
    case Want::events:
      return "For events of " + row.setting.structure;
    case Want::scenes:
      return "Of what can be asked of the scene";
  }
  return {};
}

bool is_small(const TradeRow& row) {
  if (row.errors.beads_outside.value_or(0) > 0) return false;
  const std::vector<double> errors = main_errors(row);
  return !errors.empty() &&
         std::all_of(errors.begin(), errors.end(), [](double error) { return error <= small_error; });
}

std::string times_as_fast(double ratio) {
  return ratio < 1 ? few_figures(1 / ratio) + " times as fast as the exact run"
                   : few_figures(ratio) + " times as slow as the exact run";
}

std::string sentence_for_scenes(std::span<const TradeRow> group) {
  const auto [least, most] = std::minmax_element(
      group.begin(), group.end(),
      [](const TradeRow& a, const TradeRow& b) { return a.cost.seconds < b.cost.seconds; });
  return fmt::format("{}, `{}` costs least, and `{}` {} times as much.", subject_of(group.front()),
                     words_of(least->setting), words_of(most->setting),
                     few_figures(most->cost.seconds / least->cost.seconds));
}

std::string sentence_for(std::span<const TradeRow> group) {
  if (group.front().want == Want::scenes) return sentence_for_scenes(group);
  constexpr double hardly_quicker = 0.95;
  const TradeRow* best = nullptr;
  for (const TradeRow& row : group.subspan(1)) {
    if (is_small(row) && row.cost.ratio < hardly_quicker &&
        (best == nullptr || row.cost.ratio < best->cost.ratio))
      best = &row;
  }
  const std::string subject = subject_of(group.front());
  const Want want = group.front().want;
  if ((want == Want::contacts || want == Want::events) && group.front().cost.events == 0)
    return fmt::format("{}, there is nothing to tell: the exact run has no event{}.", subject,
                       group.front().setting.structure == "contacts"
                           ? "; --radius makes balls larger, and a lower --apart asks about more of them"
                           : "");
  if (best != nullptr)
    return fmt::format("{}, `{}` is {}: {}.", subject, words_of(best->setting),
                       times_as_fast(best->cost.ratio), losses_of(*best));
  // No setting with small errors is quicker, so choose the quicker setting with the least errors.
  for (const TradeRow& row : group.subspan(1)) {
    const auto worst = [](const TradeRow& r) {
      const std::vector<double> errors = main_errors(r);
      return *std::max_element(errors.begin(), errors.end());
    };
    if (main_errors(row).empty()) continue;
    if (row.cost.ratio < hardly_quicker && (best == nullptr || worst(row) < worst(*best))) best = &row;
  }
  if (best == nullptr)
    return fmt::format("{}, nothing is quicker than the exact run `{}`.", subject,
                       words_of(group.front().setting));
  return fmt::format(
      "{}, stay with the exact run: nothing that is quicker errs by less than {}; the least harm does "
      "`{}`, {}: {}.",
      subject, percent(small_error), words_of(best->setting), times_as_fast(best->cost.ratio),
      losses_of(*best));
}

}  // namespace

std::string losses_of(const TradeRow& row) {
  const TradeErrors& e = row.errors;
  std::vector<std::string> losses;
  const auto add = [&losses](std::string words) { losses.push_back(std::move(words)); };
  if (row.want == Want::cages) {
    add(fmt::format("radii are {} from the smallest on average, {} at most",
                    percent(e.radius_mean.value_or(0)), percent(e.radius_max.value_or(0))));
    add(e.beads_outside.value_or(0) > 0 ? fmt::format("{:.3g} beads stick out on average", *e.beads_outside)
                                        : "no bead is outside");
    if (!row.setting.has_events()) add("it does not tell when bases change");
  }
  if (row.want == Want::diagram)
    add(fmt::format("{} of its cells are wrong, and it misses {} of the short edges",
                    percent(e.cells_wrong.value_or(0)), percent(e.edges_missed.value_or(0))));
  if (row.want == Want::contacts) {
    add(fmt::format("{} of the contacts are missed, {} are spurious", percent(e.contacts_missed.value_or(0)),
                    percent(e.contacts_spurious.value_or(0))));
    if (e.contacts_unsure) add(fmt::format("{} of them are only possible", percent(*e.contacts_unsure)));
    if (row.setting.calpha) add("it is another model, and tells of residues");
  }
  if (row.want == Want::events || ((row.want == Want::diagram || row.want == Want::cages) && e.events_missed))
    add(fmt::format("{} of the events are missed, {} are invented", percent(e.events_missed.value_or(0)),
                    percent(e.events_invented.value_or(0))));
  if (row.setting.kernel == Kernel::fast) add("it guarantees nothing: signs that doubles err in stay wrong");
  return fmt::format("{}", fmt::join(losses, "; "));
}

std::string recommendation(std::span<const TradeRow> rows) {
  std::string text;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first + 1;
    while (end < rows.size() && !rows[end].is_exact) ++end;
    text += (text.empty() ? "" : " ") + sentence_for(rows.subspan(first, end - first));
    first = end;
  }
  return text;
}

}  // namespace kds
