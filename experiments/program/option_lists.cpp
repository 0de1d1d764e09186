#include "experiments/program/option_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"
#include "structures/session/structure_spec.h"

namespace kds {

std::vector<std::string> parse_structures(const std::string& list) {
  const std::vector<std::string> names = split(list, ',');
  std::vector<std::string_view> known;
  std::vector<std::string> ordered;
  for (const StructureSpec& spec : structure_registry().all()) {
    known.push_back(spec.name);
    if (std::find(names.begin(), names.end(), spec.name) != names.end()) ordered.push_back(spec.name);
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse_unknown("--structures", name, known);
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(fmt::format("--structures: {} is listed twice", name));
  }
  return ordered;
}

std::vector<std::size_t> parse_strides(const std::string& list) {
  std::vector<std::size_t> strides;
  for (const std::string& text : split(list, ','))
    strides.push_back(parse_whole_number("--strides", text, 1, 1'000'000'000));
  std::sort(strides.begin(), strides.end());
  if (const auto twice = std::adjacent_find(strides.begin(), strides.end()); twice != strides.end())
    throw InputError(fmt::format("--strides: {} is listed twice", *twice));
  return strides;
}

}  // namespace kds
