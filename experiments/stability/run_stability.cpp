#include "experiments/stability/run_stability.h"

#include <utility>

#include "motions/base/input_error.h"

namespace kds {

std::vector<StabilityRow> run_stability(const StabilityOptions& options,
                                        const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<StabilitySubject> subjects = all_subjects();
  std::vector<std::pair<const StabilitySubject*, const Extreme*>> pairs;
  for (const StabilitySubject& subject : subjects) {
    for (const Extreme& extreme : all_extremes())
      if (options.wants(subject) && options.wants(extreme) && subject.meets(extreme))
        pairs.emplace_back(&subject, &extreme);
  }
  if (pairs.empty()) throw InputError("none of the --extremes applies to any of the --subjects");
  std::vector<StabilityRow> rows;
  for (const auto& [subject, extreme] : pairs) {
    rows.push_back(subject->run(*extreme, options.cases));
    progress(rows.size(), pairs.size());
  }
  return rows;
}

}  // namespace kds
