#include "experiments/output/staged.h"

#include "experiments/output/replace_file.h"

namespace kds {

void commit_together(std::span<Staged* const> results) {
  for (Staged* const result : results)
    if (result != nullptr) result->finish();
  const SignalsWait wait;
  for (Staged* const result : results)
    if (result != nullptr) result->take_place();
}

}  // namespace kds
