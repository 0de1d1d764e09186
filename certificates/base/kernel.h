#pragma once
// The two number kernels, which decide signs and times, and counts of the stages that decided. The kernel is
// chosen when a run starts.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace kds {

enum class Kernel : std::uint8_t {
  /// Exact answers: double with proved error bounds first, then integers for undecided cases. The default.
  filtered,
  /// Integers only. Exact and slow; serves as the oracle for the other.
  exact,
};

/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> kernel_names{"filtered", "exact"};
[[nodiscard]] constexpr std::string_view name_of(Kernel kernel) {
  return kernel_names[static_cast<std::size_t>(kernel)];
}

/// Counts how often each stage of the failure-time cascade decided.
struct StageCounts {
  // Stages that decided failure times.
  std::uint64_t coefficients = 0;  ///< all Bernstein coefficients certainly positive: never fails
  std::uint64_t isolation = 0;     ///< signs in double: never fails, does not hold now, or one root bracketed
  std::uint64_t refined = 0;       ///< the same with running error bounds
  std::uint64_t exact = 0;         ///< integers
  std::uint64_t identically_zero = 0;  ///< integers found the zero polynomial: never fails
  std::uint64_t shared = 0;            ///< shared with a certificate that has the same function
  std::uint64_t slack = 0;             ///< beads strayed less than the slack found at an earlier frame
  // Stages that decided signs just after a time.
  std::uint64_t signs_double = 0;
  std::uint64_t signs_exact = 0;
  std::uint64_t largest_bits = 0;  ///< longest coefficient in the exact stages
};

/// One of the counts as results show it. The table below is the only list of counts.
struct Stage {
  enum class Of : std::uint8_t { failure_time, sign, size };

  std::string_view name;  ///< name in JSON and CSV
  std::uint64_t StageCounts::*count;
  Of of;
  std::string_view label;  ///< label in printed text
};

/// The counts in the order in which they are listed.
inline constexpr std::array<Stage, 10> stage_table{{
    {"coefficients", &StageCounts::coefficients, Stage::Of::failure_time,
     "double, all coefficients positive"},
    {"isolation", &StageCounts::isolation, Stage::Of::failure_time, "double, isolated"},
    {"refined", &StageCounts::refined, Stage::Of::failure_time, "double, errors followed"},
    {"exact", &StageCounts::exact, Stage::Of::failure_time, "integers"},
    {"identically_zero", &StageCounts::identically_zero, Stage::Of::failure_time,
     "integers, identically zero"},
    {"shared", &StageCounts::shared, Stage::Of::failure_time, "with another of the same function"},
    {"slack", &StageCounts::slack, Stage::Of::failure_time, "beads moved too little to matter"},
    {"signs_double", &StageCounts::signs_double, Stage::Of::sign, "double"},
    {"signs_exact", &StageCounts::signs_exact, Stage::Of::sign, "integers"},
    {"largest_bits", &StageCounts::largest_bits, Stage::Of::size, "bits of the longest integer"},
}};
static_assert(sizeof(StageCounts) == stage_table.size() * sizeof(std::uint64_t));

/// Adds the counts; sizes keep the largest value.
constexpr StageCounts& operator+=(StageCounts& sum, const StageCounts& more) {
  for (const Stage& stage : stage_table) {
    std::uint64_t& count = sum.*stage.count;
    count = stage.of == Stage::Of::size ? std::max(count, more.*stage.count) : count + more.*stage.count;
  }
  return sum;
}

}  // namespace kds
