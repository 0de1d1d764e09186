#pragma once
// Results that appear together or not at all. Each waits beside its place until all are complete.

#include <span>

namespace kds {

class Staged {
 public:
  virtual ~Staged() = default;
  /// Completes the result on disk and checks every condition for its move that can be known beforehand.
  /// Throws an InputError or OutputError that names the path.
  virtual void finish() = 0;
  /// Moves the result to its place. Throws as finish() does, but only if the system fails.
  virtual void take_place() = 0;
};

/// Finishes all results before the first takes its place. Blocks signals until the last has taken its place.
/// Skips null pointers.
void commit_together(std::span<Staged* const> results);

}  // namespace kds
