#include "experiments/stability/compare_answers.h"

#include <fmt/format.h>

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

// An answer at the start of a step is not an event.
bool is_event(std::span<const Answer> answers, std::size_t i) {
  const Failure::Kind kind = answers[i].failure.kind;
  return kind == Failure::Kind::later || (kind == Failure::Kind::at_birth && i > 0);
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

std::vector<TimedChange> failures_of(std::span<const Answer> answers) {
  std::vector<TimedChange> failures;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!is_event(answers, i)) continue;
    const FailureTime& time = answers[i].failure.time;
    failures.push_back({{static_cast<std::uint8_t>(answers[i].opposite ? 1 : 0)}, time.lower, time.upper});
  }
  return failures;
}

std::vector<TimedChange> sharp_failures_of(std::span<const Answer> answers, const FunctionOfSide& function) {
  std::vector<TimedChange> failures = failures_of(answers);
  std::size_t next = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!is_event(answers, i)) continue;
    TimedChange& sharp = failures[next++];
    if (answers[i].failure.kind != Failure::Kind::later) continue;
    ExactTime time = exact_time(function(answers[i].opposite), answers[i].failure.time);
    while (!time.is_dyadic() && time.upper().round_up() - time.lower().round_down() > 0x1p-60 &&
           time.lower().round_up() < time.upper().round_down())
      time.refine();
    sharp.lower = time.lower().round_down();
    sharp.upper = time.upper().round_up();
  }
  return failures;
}

}  // namespace kds
