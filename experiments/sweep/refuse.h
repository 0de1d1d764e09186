#pragma once
// Refuses a sweep with a message of one line.

#include <fmt/format.h>

#include <utility>

#include "motions/base/input_error.h"

namespace kds {

/// Throws InputError with this text.
template <class... Values>
[[noreturn]] void refuse(fmt::format_string<Values...> text, Values&&... values) {
  throw InputError(fmt::format(text, std::forward<Values>(values)...));
}

}  // namespace kds
