#include "experiments/program/option_names.h"

#include <fmt/format.h>

namespace kds {

std::string name_of(const FrameRange& frames) {
  return fmt::format("{}:{}:{}", frames.first, frames.last ? std::to_string(*frames.last) : "",
                     frames.stride);
}

}  // namespace kds
