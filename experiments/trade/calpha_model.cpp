#include "experiments/trade/calpha_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "motions/base/text_input.h"
#include "motions/readers/bead_name.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

struct Residue {
  BeadRange beads;  ///< the necklace's beads
  BeadId calpha = no_bead;
};

/// Returns the residues in chain order. Returns nothing if a bead has no name, or if a residue does not have
/// exactly one CA.
std::optional<std::vector<Residue>> residues_of(const Trajectory& necklace) {
  std::vector<Residue> residues;
  std::optional<BeadName> before;
  if (necklace.bead_names.size() != necklace.bead_count()) return std::nullopt;
  for (BeadId b = 0; b < necklace.bead_count(); ++b) {
    std::optional<BeadName> name = bead_name_of(necklace.bead_names[b]);
    if (!name) return std::nullopt;
    if (!before || name->number != before->number || name->chain != before->chain)
      residues.push_back({{b, b}});
    Residue& residue = residues.back();
    residue.beads.last = b;
    if (name->atom == "CA") {
      if (residue.calpha != no_bead) return std::nullopt;
      residue.calpha = b;
    }
    before = std::move(name);
  }
  const bool all_have_one = std::all_of(residues.begin(), residues.end(),
                                        [](const Residue& residue) { return residue.calpha != no_bead; });
  return all_have_one ? std::optional(std::move(residues)) : std::nullopt;
}

Trajectory calphas_of(const Trajectory& necklace, const std::vector<Residue>& residues) {
  Trajectory some;
  some.file = necklace.file;
  some.frame_numbers = necklace.frame_numbers;
  some.times = necklace.times;
  for (const Eigen::Matrix3Xd& frame : necklace.frames) {
    Eigen::Matrix3Xd& of_some = some.frames.emplace_back(3, residues.size());
    for (std::size_t r = 0; r < residues.size(); ++r)
      of_some.col(static_cast<Eigen::Index>(r)) = frame.col(residues[r].calpha);
  }
  for (std::size_t r = 0; r < residues.size(); ++r) {
    some.bead_names.push_back(necklace.bead_names[residues[r].calpha]);
    if (r + 1 == residues.size()) continue;
    const auto holds = [&](const std::vector<std::size_t>& residues_of_beads) {
      return std::find(residues_of_beads.begin(), residues_of_beads.end(), residues[r].beads.last) !=
             residues_of_beads.end();
    };
    if (holds(necklace.breaks)) some.breaks.push_back(r);
    if (holds(necklace.gaps)) some.gaps.push_back(r);
  }
  return some;
}

/// Rounds up to three significant digits. Returns 0 if `x` is too small or too large to be rounded up safely.
double rounded_up(double x) {
  if (!(x > 1e-290 && x < 1e290)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(x)) - 2);
  double rounded = x;
  for (double units = std::ceil(x / unit);; ++units) {
    rounded = parse_double(fmt::format("{:.6g}", units * unit)).value_or(HUGE_VAL);
    if (rounded > x) return rounded;
  }
}

/// Checking the frames suffices: on straight lines between frames, a bead is never farther from its CA than
/// at one of the frames.
double covering_radius(std::span<const Trajectory> necklaces, std::span<const double> radii,
                       const CalphaModel& model) {
  double largest = 0;
  std::size_t first = 0;
  for (const Trajectory& necklace : necklaces) {
    const std::size_t beads = necklace.bead_count();
    for (const Eigen::Matrix3Xd& frame : necklace.frames) {
      for (std::size_t b = 0; b < beads; ++b) {
        const std::size_t calpha = model.bead[model.of_bead[first + b]] - first;
        const double distance =
            (frame.col(static_cast<Eigen::Index>(b)) - frame.col(static_cast<Eigen::Index>(calpha)))
                .stableNorm();
        largest = std::max(largest, (distance + radii[first + b]) * (1 + 0x1p-40));
      }
    }
    first += beads;
  }
  return rounded_up(largest);
}

}  // namespace

BeadId CalphaModel::largest_residue() const {
  BeadId most = 0;
  for (const BeadRange& beads : residue) most = std::max(most, beads.last - beads.first + 1);
  return most;
}

std::vector<ContactTime> CalphaModel::of_residues(const std::vector<ContactTime>& contacts,
                                                  BeadId apart) const {
  const PairsAsked asked{ranges, true, apart, true};
  std::vector<ContactTime> of_residues;
  for (const ContactTime& contact : contacts) {
    const BeadPair pair{of_bead[contact.pair.first], of_bead[contact.pair.second]};
    if (pair.first != pair.second && asked.asks(pair))
      of_residues.push_back({pair, contact.from, contact.to});
  }
  std::sort(of_residues.begin(), of_residues.end(), [](const ContactTime& a, const ContactTime& b) {
    return std::tie(a.pair, a.from) < std::tie(b.pair, b.from);
  });
  return of_residues;
}

std::optional<CalphaModel> calpha_model(std::span<const Trajectory> necklaces, std::span<const double> radii,
                                        const std::string& radius) {
  CalphaModel model;
  BeadId first = 0;
  for (const Trajectory& necklace : necklaces) {
    const std::optional<std::vector<Residue>> residues = residues_of(necklace);
    if (!residues || residues->empty()) return std::nullopt;
    model.necklaces.push_back(calphas_of(necklace, *residues));
    const auto begin = static_cast<BeadId>(model.bead.size());
    for (const Residue& residue : *residues) {
      const auto number = static_cast<BeadId>(model.bead.size());
      model.bead.push_back(first + residue.calpha);
      model.residue.push_back({first + residue.beads.first, first + residue.beads.last});
      model.of_bead.insert(model.of_bead.end(), residue.beads.last - residue.beads.first + 1, number);
    }
    model.ranges.push_back({begin, static_cast<BeadId>(model.bead.size()) - 1});
    first += static_cast<BeadId>(necklace.bead_count());
  }
  constexpr std::size_t fewest = 4;  // needed for a diagram in space
  if (model.bead.size() == radii.size() || model.bead.size() < fewest) return std::nullopt;
  model.covering_radius = covering_radius(necklaces, radii, model);
  if (radius == "auto" || radius == "element:fit") {  // policies that depend on the beads present
    for (std::size_t n = 0; n < necklaces.size(); ++n) {
      const std::vector<double>& elements = necklaces[n].element_radii;
      const BeadRange& range = model.ranges[n];
      const BeadId begin = model.residue[range.first].first;
      if (elements.empty()) continue;
      for (BeadId b = range.first; b <= range.last; ++b)
        model.necklaces[n].element_radii.push_back(elements[model.bead[b] - begin]);
    }
    model.radii = bead_radii(radius, model.necklaces);
  } else {
    for (const BeadId bead : model.bead) model.radii.push_back(radii[bead]);
  }
  return model;
}

}  // namespace kds
