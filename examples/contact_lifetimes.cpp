// Measures how long contacts of residues last, in a run of one's own: the run's events make exact intervals,
// and the intervals make statistics. FILE is PDB, mmCIF or XYZ, and names residues.
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "motions/base/input_error.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "structures/contacts/contact_elements.h"
#include "structures/contacts/contact_lifetimes.h"
#include "structures/contacts/contacts.h"
#include "structures/necklace/pairs_in_question.h"
#include "structures/session/kinetic_run.h"

namespace {

/// Prints an estimate with its 95% interval. A missing end is nan.
void print(const char* name, const kds::Estimate& estimate) {
  std::printf("%s: %.3f, 95%%: %.3f to %.3f\n", name, estimate.value.value_or(NAN),
              estimate.lower.value_or(NAN), estimate.upper.value_or(NAN));
}

void measure(const char* file) {
  kds::ReadOptions options;
  options.selection = kds::Selection::ca;
  const kds::Trajectory necklace = kds::read_trajectory(file, options);
  const std::span necklaces(&necklace, 1);
  const kds::Scene scene(necklaces, kds::bead_radii("auto", necklaces));
  const auto residues = kds::elements_of(scene, kds::ContactElement::residue);

  // Residues are in contact within 8 angstrom, and at least 3 apart along the chain.
  kds::KineticRun run(scene, {.by_default = false});
  const auto& contacts = run.add<kds::Contacts<3>>(kds::PairsAsked{scene.necklaces(), true, 3, true},
                                                   kds::contact_radii({.length = 8}, scene.radii()));
  kds::ContactLifetimes lifetimes;
  // An absence shorter than half a frame does not end a contact.
  kds::ContactIntervals intervals(
      run.simulator(), {.elements = residues.of_bead, .chains = residues.chains, .apart = 3, .gap = 0.5},
      [&](const kds::ContactInterval& interval) { lifetimes.add(interval); });
  run.listen(intervals);
  run.build();
  intervals.add_built(contacts.pairs(), contacts.pairs(), scene.stamp(0), scene.stamp(1));
  run.finish();  // runs all steps
  const std::size_t last = scene.step_count() - 1;
  intervals.finish(last, scene.stamp(last), scene.stamp(last + 1));

  const auto length = static_cast<double>(scene.step_count());
  const std::uint64_t asked = kds::PairsInQuestion({scene.necklaces(), true, 3, true}).count();
  const kds::LifetimeFigures all = lifetimes.all(length, asked);
  const auto pairs = lifetimes.pairs(length);
  std::printf("%d contacts of %d pairs\n", static_cast<int>(all.contacts), static_cast<int>(pairs.size()));
  print("residence time in frames", all.residence);
  print("half of the contacts that begin last longer than", lifetimes.survival().median);
  kds::PairLifetimes busiest;
  for (const kds::PairLifetimes& pair : pairs)
    if (pair.contacts > busiest.contacts) busiest = pair;
  std::printf("%s and %s: %d contacts\n", residues.names[busiest.first].c_str(),
              residues.names[busiest.second].c_str(), static_cast<int>(busiest.contacts));
  print("share of the time in contact", busiest.occupancy);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: contact_lifetimes FILE\n");
    return 2;
  }
  try {
    measure(argv[1]);
  } catch (const kds::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
