#include "structures/diagram_update.h"

#include "structures/moving_update.h"
#include "structures/reinsertion.h"

namespace kds {

std::unique_ptr<DiagramUpdate> make_diagram_update(UpdateTechnique technique) {
  switch (technique) {
    case UpdateTechnique::rebuild:
      return std::make_unique<Rebuild>();
    case UpdateTechnique::reinsert:
      return std::make_unique<Reinsertion>(Choice::any);
    case UpdateTechnique::greedy:
      return std::make_unique<Reinsertion>(Choice::most_failed);
    case UpdateTechnique::kinetic:
      return std::make_unique<KineticUpdate>();
    case UpdateTechnique::lifted:
      return std::make_unique<LiftedUpdate>();
    case UpdateTechnique::activate:
      return std::make_unique<Activation>();
    case UpdateTechnique::automatic:
      break;
  }
  return std::make_unique<AutomaticUpdate>();
}

}  // namespace kds
