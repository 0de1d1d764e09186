#include "experiments/program/option_names.h"

#include <fmt/format.h>

namespace kds {

std::string_view name_of(Selection selection) {
  switch (selection) {
    case Selection::backbone:
      return "backbone";
    case Selection::ca:
      return "ca";
    case Selection::all:
      return "all";
    case Selection::automatic:
      break;
  }
  return "automatic";
}

std::string name_of(const FrameRange& frames) {
  return fmt::format("{}:{}:{}", frames.first, frames.last ? std::to_string(*frames.last) : "",
                     frames.stride);
}

}  // namespace kds
