#pragma once
// The moving chains that several questions use.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/reproduce/subjects.h"

namespace kds {

struct NamedSubject {
  std::string name;
  Subject subject;
};

inline constexpr std::size_t moving_subject_count = 3;
/// Returns one of three subjects with 200 frames each: two trajectories, and a random chain that moves
/// slowly.
[[nodiscard]] NamedSubject moving_subject(std::size_t which, const std::filesystem::path& data,
                                          std::uint64_t seed);

}  // namespace kds
