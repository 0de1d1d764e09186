#pragma once
// The methods of `kds collide` by name.

#include <memory>
#include <span>
#include <string_view>

#include "experiments/collide/detector.h"

namespace kds {

struct Method {
  std::string_view name;
  std::string_view about;  ///< a short description
  std::unique_ptr<Detector<2>> (*in_plane)(const CollisionQuery&);
  std::unique_ptr<Detector<3>> (*in_space)(const CollisionQuery&);

  template <int Dimension>
  [[nodiscard]] std::unique_ptr<Detector<Dimension>> make(const CollisionQuery& query) const {
    if constexpr (Dimension == 2) {
      return in_plane(query);
    } else {
      return in_space(query);
    }
  }
};

/// Returns the methods in the order in which they run and are listed.
[[nodiscard]] std::span<const Method> collision_methods();

}  // namespace kds
