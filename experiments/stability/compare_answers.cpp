#include "experiments/stability/compare_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

namespace kds {

namespace {

struct Times {
  std::vector<TimedChange> exact, other;
};

double error(const TimedChange& exact, const TimedChange& other) {
  const double time = 0.5 * (other.lower + other.upper);
  return std::max({0.0, exact.lower - time, time - exact.upper});
}

// Matches each event of the shorter history, in order, with an event of the longer one. Returns the smallest
// possible worst error.
double least_worst_error(const Times& times) {
  const bool fewer_exact = times.exact.size() <= times.other.size();
  const std::size_t rows = std::min(times.exact.size(), times.other.size());
  const std::size_t columns = std::max(times.exact.size(), times.other.size());
  // worst[j] is the least worst error for the first i events of the shorter and the first j events of the
  // longer history.
  std::vector<double> worst(columns + 1, 0);
  for (std::size_t i = 0; i < rows; ++i) {
    double diagonal = worst[0];
    worst[0] = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < columns; ++j) {
      const double pair = error(times.exact[fewer_exact ? i : j], times.other[fewer_exact ? j : i]);
      const double matched = std::max(diagonal, pair);
      diagonal = worst[j + 1];
      worst[j + 1] = std::min(worst[j], matched);
    }
  }
  return worst[columns];
}

}  // namespace

EventDifference event_difference(std::span<const TimedChange> exact, std::span<const TimedChange> other) {
  std::map<std::vector<BeadId>, Times> by_change;
  const auto times_of = [&by_change](const Change& change) -> Times& {
    std::vector<BeadId> key{change.kind};
    key.insert(key.end(), change.ids.begin(), change.ids.begin() + change.size);
    return by_change[key];
  };
  for (const TimedChange& event : exact) times_of(event.change).exact.push_back(event);
  for (const TimedChange& event : other) times_of(event.change).other.push_back(event);

  EventDifference difference;
  for (const auto& [key, times] : by_change) {
    const std::size_t n = times.exact.size(), m = times.other.size();
    difference.missed += n > m ? n - m : 0;
    difference.extra += m > n ? m - n : 0;
    if (n > 0 && m > 0)
      difference.worst_time_error = std::max(difference.worst_time_error, least_worst_error(times));
  }
  return difference;
}

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
