#pragma once
// The methods of `kds collide` by name.

#include <memory>
#include <span>
#include <string_view>

#include "experiments/collide/detector.h"

namespace kds {

struct Method {
  std::string_view name;
  std::string_view about;  ///< a few words
  std::unique_ptr<Detector<2>> (*in_plane)(const PairsAsked&);
  std::unique_ptr<Detector<3>> (*in_space)(const PairsAsked&);

  template <int Dimension>
  [[nodiscard]] std::unique_ptr<Detector<Dimension>> make(const PairsAsked& asked) const {
    if constexpr (Dimension == 2) {
      return in_plane(asked);
    } else {
      return in_space(asked);
    }
  }
};

/// In the order in which they run and are listed.
[[nodiscard]] std::span<const Method> collision_methods();

}  // namespace kds
