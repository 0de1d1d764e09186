#include "motions/numbers/recorded_formula.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace kds {

namespace {

using Kind = FormulaStep::Kind;

bool is_of_beads(Kind kind) { return kind <= Kind::lift_difference; }
bool has_two(Kind kind) { return kind == Kind::sum || kind == Kind::difference || kind == Kind::product; }
/// Returns whether the result may overwrite the value of `a` in place.
bool is_in_place(Kind kind) {
  return kind == Kind::sum || kind == Kind::difference || kind == Kind::negative || kind == Kind::multiple;
}

}  // namespace

std::uint16_t RecordedFormula::add(Kind kind, std::uint16_t a, std::uint16_t b, std::int64_t number) {
  if (steps_.size() > UINT16_MAX) throw std::length_error("a formula of more than 65536 steps");
  steps_.push_back({kind, a, b, number});
  return static_cast<std::uint16_t>(steps_.size() - 1);
}

void RecordedFormula::finish(std::uint16_t result) {
  constexpr std::size_t never = SIZE_MAX;
  std::vector<std::size_t> last_use(steps_.size(), never);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const FormulaStep& step = steps_[i];
    if (is_of_beads(step.kind)) continue;
    last_use[step.a] = i;
    if (has_two(step.kind)) last_use[step.b] = i;
  }
  last_use[result] = steps_.size();

  std::vector<std::uint16_t> unused;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    FormulaStep& step = steps_[i];
    const bool uses_a = !is_of_beads(step.kind), uses_b = has_two(step.kind);
    const bool a_ends = uses_a && last_use[step.a] == i;
    const bool b_ends = uses_b && last_use[step.b] == i && step.b != step.a;
    const bool twice = uses_b && step.a == step.b;
    if (uses_a) step.a = steps_[step.a].slot;
    if (uses_b) step.b = steps_[step.b].slot;
    if (a_ends && is_in_place(step.kind) && !twice) {
      step.slot = step.a;
    } else {
      if (unused.empty()) unused.push_back(static_cast<std::uint16_t>(slots_++));
      step.slot = unused.back();
      unused.pop_back();
      if (a_ends) unused.push_back(step.a);
    }
    if (b_ends) unused.push_back(step.b);
    if (last_use[i] == never) unused.push_back(step.slot);  // computed but never used
  }
  result_ = steps_[result].slot;
}

std::uint16_t detail::record(RecordedFormula* formula, Kind kind, std::uint16_t a, std::uint16_t b,
                             std::int64_t number) {
  if (!formula) throw std::logic_error("a formula uses a polynomial that was never given a value");
  constexpr std::int64_t most = std::int64_t{1} << 53;
  if (number > most || number < -most)
    throw std::invalid_argument("a formula takes " + std::to_string(number) +
                                " times a polynomial: expected a whole number of at most 2^53 in size");
  return formula->add(kind, a, b, number);
}

}  // namespace kds
