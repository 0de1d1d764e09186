#include "experiments/stability/compare_answers.h"

#include <fmt/format.h>

#include <algorithm>

namespace kds {

namespace {

const char* name_of(Failure::Kind kind) {
  switch (kind) {
    case Failure::Kind::never:
      return "never";
    case Failure::Kind::zero:
      return "zero";
    case Failure::Kind::later:
      return "later";
    case Failure::Kind::at_birth:
      break;
  }
  return "at birth";
}

std::string in_words(const Failure& failure) {
  if (failure.kind != Failure::Kind::later) return name_of(failure.kind);
  return fmt::format("later, in [{}, {}]", failure.time.lower, failure.time.upper);
}

}  // namespace

std::optional<std::string> disagreement(std::span<const Answer> filtered, std::span<const Answer> exact,
                                        const FunctionOfSide& function) {
  if (exact.size() >= most_answers) return "exact: more failures than a function has roots";
  for (std::size_t i = 0; i < std::min(filtered.size(), exact.size()); ++i) {
    const Failure& a = filtered[i].failure;
    const Failure& b = exact[i].failure;
    bool same = a.kind == b.kind && filtered[i].opposite == exact[i].opposite;
    if (same && a.kind == Failure::Kind::later) {
      const ExactPolynomial f = function(exact[i].opposite);
      ExactTime time = exact_time(f, a.time);
      ExactTime expected = exact_time(f, b.time);
      same = ExactTime::compare(time, expected) == 0;
    }
    if (!same) return fmt::format("answer {}: filtered {}, exact {}", i, in_words(a), in_words(b));
  }
  if (filtered.size() != exact.size())
    return fmt::format("filtered has {} answers, exact {}", filtered.size(), exact.size());
  return std::nullopt;
}

std::uint64_t count_of_events(std::span<const Answer> answers) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Failure::Kind kind = answers[i].failure.kind;
    count += kind == Failure::Kind::later || (kind == Failure::Kind::at_birth && i > 0) ? 1 : 0;
  }
  return count;
}

}  // namespace kds
