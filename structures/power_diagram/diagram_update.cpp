#include "structures/power_diagram/diagram_update.h"

#include "structures/power_diagram/kinetic_update.h"
#include "structures/power_diagram/static_update.h"

namespace kds {

template <int Dimension>
std::unique_ptr<DiagramUpdate<Dimension>> make_diagram_update(UpdateTechnique technique) {
  switch (technique) {
    case UpdateTechnique::rebuild:
      return std::make_unique<Rebuild<Dimension>>();
    case UpdateTechnique::reinsert:
      return std::make_unique<Reinsertion<Dimension>>(Choice::any);
    case UpdateTechnique::greedy:
      return std::make_unique<Reinsertion<Dimension>>(Choice::most_failed);
    case UpdateTechnique::kinetic:
      return std::make_unique<KineticUpdate<Dimension>>(UpdateMotion::linear);
    case UpdateTechnique::lifted:
      return std::make_unique<KineticUpdate<Dimension>>(UpdateMotion::lifted);
    case UpdateTechnique::activate:
      return std::make_unique<Activation<Dimension>>();
    case UpdateTechnique::automatic:
      break;
  }
  return std::make_unique<AutomaticUpdate<Dimension>>();
}

template std::unique_ptr<DiagramUpdate<2>> make_diagram_update(UpdateTechnique);
template std::unique_ptr<DiagramUpdate<3>> make_diagram_update(UpdateTechnique);

}  // namespace kds
