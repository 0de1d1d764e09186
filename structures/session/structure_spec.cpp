#include "structures/session/structure_spec.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "structures/session/own_structures.h"

namespace kds {

void CombinatorialElements::add(std::initializer_list<BeadId> place, std::span<const BeadId> what) {
  CombinatorialElement& element = all.emplace_back();
  element.fill(no_bead);
  std::copy(what.begin(), what.end(), std::copy(place.begin(), place.end(), element.begin()));
}

CombinatorialElements elements_in_order(std::span<const BeadId> beads) {
  CombinatorialElements elements{1, {}};
  for (BeadId k = 0; k < beads.size(); ++k) elements.add({k}, beads.subspan(k, 1));
  return elements;
}

void StructureRegistry::add(StructureSpec spec) {
  if (find(spec.name) != nullptr)
    throw std::logic_error("there is a structure '" + spec.name + "' already: give one of them another name");
  if (!spec.make) throw std::logic_error("structure '" + spec.name + "' does not say how it is made");
  const auto key = [](const StructureSpec& s) { return std::tie(s.order, s.name); };
  const auto at = std::find_if(specs_.begin(), specs_.end(),
                               [&](const StructureSpec& other) { return key(spec) < key(other); });
  specs_.insert(at, std::move(spec));
}

const StructureSpec* StructureRegistry::find(std::string_view name) const {
  const auto spec =
      std::find_if(specs_.begin(), specs_.end(), [&](const StructureSpec& s) { return s.name == name; });
  return spec == specs_.end() ? nullptr : &*spec;
}

StructureRegistry& structure_registry() {
  static StructureRegistry registry = [] {
    StructureRegistry own;
    add_point_structures(own);
    add_hierarchy_structures(own);
    add_ball_structures(own);
    add_dual_structures(own);
    add_bond_structures(own);
    add_spanner_structures(own);
    return own;
  }();
  return registry;
}

std::vector<std::string> default_structures(const Scene& scene) {
  std::vector<std::string> names;
  for (const StructureSpec& spec : structure_registry().all())
    if (spec.by_default(scene)) names.push_back(spec.name);
  return names;
}

}  // namespace kds
