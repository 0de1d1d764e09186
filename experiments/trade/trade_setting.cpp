#include "experiments/trade/trade_setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "motions/scene/straightened_frames.h"

namespace kds {

bool TradeSetting::has_events() const {
  const StructureSpec* const spec = structure_registry().find(structure);
  return spec != nullptr && spec->has_events(settings);
}

double TradeSetting::reach() const {
  return static_cast<double>(tolerance > 0 ? std::max(stride, StraightenedFrames::block) : stride);
}

std::vector<std::pair<std::string, std::string>> options_of(const TradeSetting& setting) {
  std::string structures = setting.structure;
  for (const std::string& beside : setting.besides) structures += "," + beside;
  std::vector<std::pair<std::string, std::string>> options{{"structures", structures}};
  if (setting.calpha) options.emplace_back("select", "ca");
  if (setting.calpha_radius) options.emplace_back("radius", fmt::format("{}", *setting.calpha_radius));
  if (setting.element_radii) options.emplace_back("radius", "element");
  if (setting.kernel != Kernel::filtered) options.emplace_back("kernel", name_of(setting.kernel));
  if (setting.motion != FrameMotion::linear) options.emplace_back("motion", name_of(setting.motion));
  if (setting.stride > 1) options.emplace_back("stride", std::to_string(setting.stride));
  if (setting.tolerance > 0) options.emplace_back("tolerance", fmt::format("{}r", setting.tolerance));
  if (setting.settings.between != Between::events)
    options.emplace_back("between", name_of(setting.settings.between));
  if (setting.settings.tightness)
    options.emplace_back("tightness", fmt::format("{}", *setting.settings.tightness));
  const NodeSelection& nodes = setting.settings.nodes;
  if (nodes.last_level < std::numeric_limits<std::uint32_t>::max())
    options.emplace_back("levels", fmt::format("{}:{}", nodes.first_level, nodes.last_level + 1));
  if (nodes.beads)
    options.emplace_back("nodes", fmt::format("{}:{}", nodes.beads->first, nodes.beads->last + 1));
  if (setting.has_own_apart) options.emplace_back("apart", std::to_string(setting.settings.apart));
  if (setting.certify) options.emplace_back("certify", "yes");
  return options;
}

namespace {

// Returns --frames as `kds run` takes it. Leaves out FIRST if it is 0.
std::string frames_of(const TradeSetting& setting) {
  const auto& [first, last, stride] = setting.frames;
  return fmt::format("{}:{}:{}", first > 0 ? std::to_string(first) : "", last ? std::to_string(*last) : "",
                     stride * setting.stride);
}

}  // namespace

std::string words_of(const TradeSetting& setting) {
  std::string words;
  for (const auto& [name, value] : options_of(setting)) {
    if (name == "structures") {
      words = value;
    } else if (name == "stride") {
      words += " --frames " + frames_of(setting);
    } else {
      words += name == "certify" ? " --certify" : fmt::format(" --{} {}", name, value);
    }
  }
  return setting.projected ? words + ", projected" : words;
}

namespace {

/// Switches to one bead per residue. If a residue has at most k beads, then beads A apart along the chain lie
/// in residues at least A / k apart, rounded down. This quotient becomes the new distance, so no pair is
/// dropped. The distance is at least 2: the CAs of adjacent residues are bonded, and contacts between these
/// residues are not asked about.
void take_calpha(TradeSetting& setting, const TradeInput& input) {
  setting.calpha = true;
  const BeadId apart =
      std::max<BeadId>(2, setting.settings.apart / std::max<BeadId>(1, input.largest_residue));
  setting.has_own_apart = setting.structure == "contacts" && apart != setting.settings.apart;
  setting.settings.apart = apart;
}

class Settings {
 public:
  Settings(std::string structure, const TradeInput& input, BeadId apart) : input_(input) {
    exact_.structure = std::move(structure);
    exact_.settings.apart = apart;
    exact_.frames = input.range;
    all.push_back(exact_);
  }

  /// Adds the exact run modified by `change`.
  template <class Change>
  void add(Change change) {
    TradeSetting setting = exact_;
    change(setting);
    if (input_.frames > setting.stride) all.push_back(std::move(setting));
  }
  void add_exact_kernel() {
    if (input_.exact_kernel) add([](TradeSetting& s) { s.kernel = Kernel::exact; });
  }
  void add_motion(FrameMotion motion) {
    add([=](TradeSetting& s) { s.motion = motion; });
  }
  void add_strides() {
    for (const std::size_t stride : {2, 4, 8, 16, 32}) add([=](TradeSetting& s) { s.stride = stride; });
  }
  void add_tolerances() {
    for (const double tolerance : {0.1, 0.2, 0.3}) add([=](TradeSetting& s) { s.tolerance = tolerance; });
  }
  /// Adds certified runs where the errors of the frames left out can be bounded.
  void add_certified() {
    for (const std::size_t stride : {2, 4}) {
      add([=](TradeSetting& s) {
        s.stride = stride;
        s.certify = true;
      });
    }
    add([](TradeSetting& s) {
      s.tolerance = 0.2;
      s.certify = true;
    });
  }
  void add_calpha() {
    if (input_.residues == 0) return;
    add([&](TradeSetting& s) { take_calpha(s, input_); });
    // The covering radius has no meaning for a diagram.
    if (exact_.structure == "power" || input_.residue_radius == 0) return;
    add([&](TradeSetting& s) {
      take_calpha(s, input_);
      s.calpha_radius = input_.residue_radius;
    });
  }

  std::vector<TradeSetting> all;

 private:
  TradeSetting exact_;
  const TradeInput& input_;
};

Settings with_events(const char* structure, const TradeInput& input, BeadId apart) {
  Settings settings(structure, input, apart);
  settings.add_exact_kernel();
  settings.add_motion(FrameMotion::hermite);
  settings.add_strides();
  settings.add_tolerances();
  return settings;
}

std::vector<TradeSetting> cages(const TradeInput& input, BeadId apart) {
  Settings settings = with_events("wrapped", input, apart);
  const auto chord = [](TradeSetting& s) { s.settings.between = Between::chord; };
  settings.add(chord);
  for (const double tightness : {0.01, 0.003}) {
    settings.add([&](TradeSetting& s) {
      chord(s);
      s.settings.tightness = tightness;
    });
  }
  settings.add([](TradeSetting& s) { s.structure = "layered"; });
  settings.add([&](TradeSetting& s) {
    chord(s);
    s.motion = FrameMotion::hermite;
  });
  for (const std::size_t stride : {2, 4, 8}) {
    settings.add([&](TradeSetting& s) {
      chord(s);
      s.stride = stride;
    });
  }
  settings.add([&](TradeSetting& s) {
    chord(s);
    s.settings.tightness = 0.01;
    s.stride = 2;
  });
  settings.add([&](TradeSetting& s) {
    chord(s);
    s.tolerance = 0.2;
  });
  settings.add_certified();
  settings.add([&](TradeSetting& s) {
    chord(s);
    s.stride = 2;
    s.certify = true;
  });
  settings.add_calpha();
  return settings.all;
}

std::vector<TradeSetting> contacts(const TradeInput& input, BeadId apart) {
  Settings settings = with_events("contacts", input, apart);
  settings.add_certified();
  settings.add_calpha();
  return settings.all;
}

std::vector<TradeSetting> diagram(const TradeInput& input, BeadId apart) {
  Settings settings = with_events("power", input, apart);
  settings.add_motion(FrameMotion::lifted);
  settings.add_calpha();
  return settings.all;
}

/// Returns the scenes: first from the smallest task to the full task, then variants of the full task, then
/// parts of it.
std::vector<TradeSetting> scenes(const TradeInput& input, BeadId apart) {
  const bool several = input.necklaces > 1;
  Settings settings("contacts", input,
                    several ? input.beads : apart);  // no pair of one chain is this far apart
  const auto more = [&](std::vector<std::string> besides, auto change) {
    settings.add([&](TradeSetting& s) {
      s.settings.apart = apart;
      s.besides = std::move(besides);
      change(s);
    });
  };
  const auto nothing = [](TradeSetting&) {};
  if (several) {
    settings.all.front().has_own_apart = true;
    more({}, nothing);
  }
  const std::vector<std::string> rest{"wrapped", "power"};
  more({"wrapped"}, nothing);
  more(rest, nothing);
  if (input.has_element_radii) more(rest, [](TradeSetting& s) { s.element_radii = true; });
  if (input.residues > 0) more(rest, [&](TradeSetting& s) { take_calpha(s, input); });
  if (input.dimension == 3) more(rest, [](TradeSetting& s) { s.projected = true; });
  more({}, [](TradeSetting& s) { s.structure = "power"; });
  const auto wrapped = [](TradeSetting& s) { s.structure = "wrapped"; };
  more({}, wrapped);
  more({}, [&](TradeSetting& s) {
    wrapped(s);
    s.settings.nodes.last_level = 3;
  });
  more({}, [&](TradeSetting& s) {
    wrapped(s);
    s.settings.nodes.beads = {0, input.beads / 2};
  });
  return settings.all;
}

}  // namespace

namespace {

std::vector<TradeGroup> groups_without_selection(Want want, const TradeInput& input, BeadId apart) {
  switch (want) {
    case Want::contacts:
      return {{want, contacts(input, apart)}};
    case Want::cages:
      return {{want, cages(input, apart)}};
    case Want::diagram:
      return {{want, diagram(input, apart)}};
    case Want::events: {
      std::vector<TradeGroup> groups;
      for (const char* structure : {"wrapped", "power", "contacts"})
        groups.push_back({want, with_events(structure, input, apart).all});
      return groups;
    }
    case Want::scenes:
      return {{want, scenes(input, apart)}};
  }
  return {};
}

}  // namespace

std::vector<TradeGroup> groups_for(Want want, const TradeInput& input, BeadId apart) {
  if (input.groups.empty() || want == Want::cages || want == Want::diagram)
    return groups_without_selection(want, input, apart);
  TradeInput of_all_atoms = input;
  of_all_atoms.residues = 0;  // the groups may have no CA
  std::vector<TradeGroup> groups = groups_without_selection(want, of_all_atoms, apart);
  for (TradeGroup& group : groups)
    for (TradeSetting& setting : group.settings) setting.settings.groups = input.groups;
  return groups;
}

}  // namespace kds
