#include "experiments/trade/trade_setting.h"

#include <fmt/format.h>

#include <algorithm>

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
  std::vector<std::pair<std::string, std::string>> options{{"structures", setting.structure}};
  if (setting.kernel != Kernel::filtered) options.emplace_back("kernel", name_of(setting.kernel));
  if (setting.motion != FrameMotion::linear) options.emplace_back("motion", name_of(setting.motion));
  if (setting.stride > 1) options.emplace_back("stride", std::to_string(setting.stride));
  if (setting.tolerance > 0) options.emplace_back("tolerance", fmt::format("{}r", setting.tolerance));
  if (setting.settings.between != Between::events)
    options.emplace_back("between", name_of(setting.settings.between));
  if (setting.settings.tightness)
    options.emplace_back("tightness", fmt::format("{}", *setting.settings.tightness));
  if (setting.settings.relax.any())
    options.emplace_back("relax", fmt::format("{:.3g}", setting.settings.relax.share()));
  return options;
}

std::string words_of(const TradeSetting& setting) {
  std::string words = setting.structure;
  for (const auto& [name, value] : options_of(setting))
    if (name != "structures") words += fmt::format(" --{} {}", name, value);
  return words;
}

namespace {

class Settings {
 public:
  Settings(std::string structure, std::size_t frames, BeadId apart) : frames_(frames) {
    exact_.structure = std::move(structure);
    exact_.settings.apart = apart;
    all.push_back(exact_);
  }

  /// The exact run, but for what `change` does to it.
  template <class Change>
  void add(Change change) {
    TradeSetting setting = exact_;
    change(setting);
    if (frames_ > setting.stride) all.push_back(std::move(setting));
  }
  void add_kernel() {
    add([](TradeSetting& s) { s.kernel = Kernel::fast; });
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
  void add_relaxed() {
    for (const double share : {0.01, 0.03, 0.1})
      add([=](TradeSetting& s) { s.settings.relax = Relaxation::of(share); });
  }

  std::vector<TradeSetting> all;

 private:
  TradeSetting exact_;
  std::size_t frames_;
};

std::vector<TradeSetting> cages(std::size_t frames, BeadId apart) {
  Settings settings("wrapped", frames, apart);
  settings.add_kernel();
  settings.add_motion(FrameMotion::hermite);
  settings.add_strides();
  settings.add_tolerances();
  settings.add_relaxed();
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
  settings.add([](TradeSetting& s) {
    s.settings.relax = Relaxation::of(0.03);
    s.stride = 2;
  });
  return settings.all;
}

std::vector<TradeSetting> with_events(const char* structure, std::size_t frames, BeadId apart) {
  Settings settings(structure, frames, apart);
  settings.add_kernel();
  settings.add_motion(FrameMotion::hermite);
  settings.add_strides();
  settings.add_tolerances();
  return settings.all;
}

}  // namespace

std::vector<TradeGroup> groups_for(Want want, std::size_t frames, BeadId apart) {
  switch (want) {
    case Want::contacts:
      return {{want, with_events("contacts", frames, apart)}};
    case Want::cages:
      return {{want, cages(frames, apart)}};
    case Want::diagram: {
      TradeGroup group{want, with_events("power", frames, apart)};
      TradeSetting lifted = group.settings.front();
      lifted.motion = FrameMotion::lifted;
      group.settings.push_back(lifted);
      return {group};
    }
    case Want::events: {
      std::vector<TradeGroup> groups;
      for (const char* structure : {"wrapped", "power", "contacts"})
        groups.push_back({want, with_events(structure, frames, apart)});
      return groups;
    }
  }
  return {};
}

}  // namespace kds
