#pragma once
// The three number kernels: one template parameter of everything that decides a sign or a time.

#include <concepts>
#include <string_view>

namespace kds {

/// Plain double, no guarantee. Its work is bounded; it may be wrong.
struct Fast {
  static constexpr std::string_view name = "fast";
};
/// Exact answers: double with proved error bounds first, integers for what is left. The default.
struct Filtered {
  static constexpr std::string_view name = "filtered";
};
/// Integers only: exact, slow, the oracle of the other two.
struct Exact {
  static constexpr std::string_view name = "exact";
};

template <class K>
concept Kernel = std::same_as<K, Fast> || std::same_as<K, Filtered> || std::same_as<K, Exact>;

}  // namespace kds
