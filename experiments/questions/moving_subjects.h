#pragma once
// The chains in motion that several questions are asked of.

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
/// Two trajectories, and a random chain that wanders slowly, 200 frames each.
[[nodiscard]] NamedSubject moving_subject(std::size_t which, const std::filesystem::path& data,
                                          std::uint64_t seed);

}  // namespace kds
