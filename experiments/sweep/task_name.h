#pragma once
// Names of tasks: hashes of everything that a task's result depends on.

#include <cstdint>
#include <string_view>

#include "kds/event.h"

namespace kds {

/// The name of a task, 64 bits. Among 10^6 different tasks, two share a name with a probability of 3e-8; the
/// plan of a sweep refuses such tasks.
using TaskName = std::uint64_t;

/// Hashes texts and the content of files. Not a cryptographic hash: the hash finds changes, not forgeries.
class TextHash {
 public:
  /// Adds a text and its end, so that different sequences of texts differ.
  void add(std::string_view text) {
    for (const char c : text) hash_.add(static_cast<unsigned char>(c));
    hash_.add(end_of_text);
  }
  void add_word(std::uint32_t word) { hash_.add(word); }
  [[nodiscard]] std::uint64_t value() const { return hash_.value(); }
  [[nodiscard]] static std::uint64_t of(std::string_view text) {
    TextHash hash;
    hash.add(text);
    return hash.value();
  }

 private:
  static constexpr std::uint32_t end_of_text = 256;  // above every byte
  WordHash hash_;
};

}  // namespace kds
