#pragma once
// Results that appear together or not at all. Each waits beside its place until all are whole.

#include <span>

namespace kds {

class Staged {
 public:
  virtual ~Staged() = default;
  /// All of it is on disk, and nothing that can be known beforehand keeps it from its place. Throws
  /// InputError or OutputError naming the path.
  virtual void finish() = 0;
  /// It takes its place. Throws likewise, but only where the system fails.
  virtual void take_place() = 0;
};

/// All are finished before the first takes its place, and signals wait until the last has. Null ones are left
/// out.
void commit_together(std::span<Staged* const> results);

}  // namespace kds
