#include "experiments/stability/stability_subjects.h"

#include <algorithm>
#include <iterator>

namespace kds {

std::vector<StabilitySubject> all_subjects() {
  std::vector<StabilitySubject> subjects;
  const auto add = [&subjects](std::vector<StabilitySubject> some) {
    std::ranges::move(some, std::back_inserter(subjects));
  };
  for (const int degree : {1, 3}) add(bead_certificates(degree));
  for (const int degree : {1, 3}) add(ball_certificates(degree));
  add(kinetic_structures());
  add(motion_levers());
  // Sorts subjects by name in the order of first appearance, then by dimension and degree.
  std::vector<std::string> names;
  for (const StabilitySubject& subject : subjects)
    if (std::ranges::find(names, subject.name) == names.end()) names.push_back(subject.name);
  const auto place = [&names](const StabilitySubject& subject) {
    return std::tuple(std::ranges::find(names, subject.name) - names.begin(), subject.dimension,
                      subject.degree);
  };
  std::ranges::stable_sort(subjects, {}, place);
  for (StabilitySubject& subject : subjects) {
    subject.run = [subject](const Extreme& extreme, const StabilityCases& cases) {
      StabilityRow row = subject.run(extreme, cases);
      row.subject = subject.name;
      row.structure = subject.structure;
      row.dimension = subject.dimension;
      row.degree = subject.degree;
      row.function_degree = subject.function_degree;
      return row;
    };
  }
  return subjects;
}

}  // namespace kds
