#pragma once
// An option of a command, declared once: its name, its help, a function that reads its value, and functions
// that write the value as text and JSON. The option list of a command yields its parser, its help, the
// settings shown in reports and JSON, and the command line that repeats a run.
//
//   const OptionList<UpdateOptions>& update_options() {
//     using O = UpdateOptions;
//     static const auto list =
//         OptionList<O>()
//             .with(input_options())  // UpdateOptions derives from InputOptions
//             .with({whole_option({"--rounds", "N", "runs of each (default: 3)"}, &O::rounds, 1, 1000)})
//             .with(destination_options("write update.json, update.csv and report.html there"));
//     return list;
//   }

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/command_line.h"
#include "experiments/program/option_values.h"

namespace kds {

template <class Options>
struct Option {
  using Read = std::function<void(Options&, const std::string&)>;
  using Show = std::function<std::string(const Options&)>;
  using ReadValues = std::function<void(Options&, const std::vector<std::string>&)>;
  using ShowValues = std::function<std::vector<std::string>(const Options&)>;
  using ShowJson = std::function<Json(const Options&)>;

  OptionSpec spec;
  /// Reads the value from the command line's text. Throws an InputError that names the option.
  Read read;
  /// Returns the value as the option takes it, or an empty text if there is no value. The function is null if
  /// the option only says where results go or how they are printed: such an option is not a setting.
  Show text;
  /// Returns the value with absolute paths. Null if `text` is null.
  Show text_anywhere;
  /// Returns the value in JSON. Null if `text` is null.
  ShowJson json;
  /// For an option with several values: reads all of them, in place of `read`.
  ReadValues read_values;
  /// For an option with several values: returns them as the option takes them, or nothing if there are none.
  ShowValues values;
  /// The name of the setting. By default, the option's name without its dashes.
  std::string setting;
  bool shown_if_given = false;  ///< the setting is left out where it has no value
  /// The words that the option applies to, such as names of structures. Empty if it always applies.
  std::vector<std::string_view> applies_to;

  // g++ 12 fails on default member initializers here, hence this constructor.
  Option(OptionSpec its_spec = {}, Read its_read = {}, Show its_text = {}, Show its_text_anywhere = {},
         ShowJson its_json = {})
      : spec(its_spec),
        read(std::move(its_read)),
        text(std::move(its_text)),
        text_anywhere(std::move(its_text_anywhere)),
        json(std::move(its_json)),
        setting(spec.name.empty() ? "" : spec.name.substr(2)) {}
};

/// A list of options, in the order in which the help shows them and the parser reads them.
template <class Options>
class OptionList {
 public:
  OptionList() = default;
  OptionList(std::vector<Option<Options>> options) : options_(std::move(options)) {}

  /// Appends options. Overloads append the options of a base class or of a member, whose values are read into
  /// that part of `Options`.
  [[nodiscard]] OptionList with(const std::vector<Option<Options>>& others) const {
    OptionList all = *this;
    all.options_.insert(all.options_.end(), others.begin(), others.end());
    return all;
  }
  template <class Part>
  [[nodiscard]] OptionList with(Part Options::*member, const OptionList<Part>& others) const {
    return with_part(
        others, [member](auto& options) -> auto& { return options.*member; });
  }
  template <class Base>
  requires std::derived_from<Options, Base>
  [[nodiscard]] OptionList with(const OptionList<Base>& others) const {
    return with_part(
        others, [](auto& options) -> auto& { return options; });
  }

  [[nodiscard]] const std::vector<Option<Options>>& all() const { return options_; }

  [[nodiscard]] std::vector<OptionSpec> specs() const {
    std::vector<OptionSpec> specs;
    for (const auto& option : options_) specs.push_back(option.spec);
    return specs;
  }

  void read(const ParsedArguments& parsed, Options& options) const {
    for (const auto& option : options_)
      if (parsed.has(option.spec.name)) read_values_of(option, parsed.values(option.spec.name), options);
  }

  /// Reads one option, named with its dashes, and returns its setting. `values` has one text for each value,
  /// and one empty text for a flag. Returns the values as they are if the option is no setting, or if there
  /// is none.
  std::string read_one(std::string_view name, const std::vector<std::string>& values,
                       Options& options) const {
    for (const auto& option : options_) {
      if (option.spec.name != name) continue;
      read_values_of(option, values, options);
      if (option.text) return option.text(options);
    }
    return shell_words(values);
  }

  /// Returns the name (without dashes) and the text of each setting. The text is empty if the setting has no
  /// value.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> settings(const Options& options) const {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const auto& option : options_)
      if (is_shown(option, options)) settings.emplace_back(option.setting, option.text(options));
    return settings;
  }
  /// Adds the settings to the members of `settings`, which may already hold others such as the operands.
  [[nodiscard]] Json settings_json(const Options& options, Json settings = Json::object()) const {
    for (const auto& option : options_) {
      if (is_shown(option, options))
        settings[option.setting] = option.json ? option.json(options) : Json(option.text(options));
    }
    return settings;
  }

  /// Throws InputError for an option that is given (`is_given(option)`) and applies to none of `words`.
  /// `where` says where the words stand, such as "among the structures".
  template <class IsGiven>
  void refuse_needless(const std::vector<std::string>& words, std::string_view where,
                       const IsGiven& is_given) const {
    for (const auto& option : options_)
      if (!option.applies_to.empty() && is_given(option))
        require_use_of(option.spec.name, option.applies_to, words, where);
  }

  /// Returns the arguments that ask for the same settings from any directory.
  [[nodiscard]] Arguments arguments(const Options& options) const {
    Arguments arguments;
    for (const auto& option : options_) {
      if (!option.text) continue;
      if (option.values) {
        const std::vector<std::string> values = option.values(options);
        if (!values.empty()) arguments.emplace_back(option.spec.name);
        arguments.insert(arguments.end(), values.begin(), values.end());
        continue;
      }
      const std::string value = (option.text_anywhere ? option.text_anywhere : option.text)(options);
      if (value.empty()) continue;
      arguments.emplace_back(option.spec.name);
      if (!option.spec.value.empty()) arguments.push_back(value);
    }
    return arguments;
  }

 private:
  [[nodiscard]] static bool is_shown(const Option<Options>& option, const Options& options) {
    return option.text && !(option.shown_if_given && option.text(options).empty());
  }
  static void read_values_of(const Option<Options>& option, const std::vector<std::string>& values,
                             Options& options) {
    if (option.read_values)
      option.read_values(options, values);
    else
      option.read(options, values.front());
  }

  template <class Part, class PartOf>
  [[nodiscard]] OptionList with_part(const OptionList<Part>& others, PartOf part_of) const {
    std::vector<Option<Options>> options;
    for (const Option<Part>& o : others.all()) {
      Option<Options>& option = options.emplace_back();
      option.spec = o.spec;
      option.setting = o.setting;
      option.shown_if_given = o.shown_if_given;
      option.applies_to = o.applies_to;
      option.read = [read = o.read, part_of](Options& all, const std::string& text) {
        read(part_of(all), text);
      };
      const auto in_part = [part_of]<class Show>(const Show& show) {
        return [show, part_of](const Options& all) { return show(part_of(all)); };
      };
      if (o.text) option.text = in_part(o.text);
      if (o.text_anywhere) option.text_anywhere = in_part(o.text_anywhere);
      if (o.json) option.json = in_part(o.json);
      if (o.values) option.values = in_part(o.values);
      if (o.read_values)
        option.read_values = [read = o.read_values, part_of](Options& all,
                                                             const std::vector<std::string>& values) {
          read(part_of(all), values);
        };
    }
    return with(options);
  }

  std::vector<Option<Options>> options_;
};

/// Parses the arguments of a command. Throws InputError and HelpRequest as parse_arguments does, with a check
/// of values in the HelpRequest. The check reads them into a copy of `defaults`.
template <class Options>
[[nodiscard]] ParsedArguments parse_for(const CommandSpec& command, const OptionList<Options>& list,
                                        const Arguments& arguments, const Options& defaults) {
  try {
    return parse_arguments(command, list.specs(), arguments);
  } catch (HelpRequest& help) {
    help.check = [list, defaults](std::string_view option, const std::vector<std::string>& values) {
      Options options = defaults;
      return list.read_one(option, values, options);
    };
    throw;
  }
}

/// Reads the arguments of a command into `options`, which has the defaults. Throws as parse_for does.
template <class Options>
ParsedArguments read_arguments(const CommandSpec& command, const OptionList<Options>& list,
                               const Arguments& arguments, Options& options) {
  ParsedArguments parsed = parse_for(command, list, arguments, options);
  list.read(parsed, options);
  return parsed;
}

/// Says what an option applies to.
template <class Options>
[[nodiscard]] Option<Options> only_for(std::vector<std::string_view> words, Option<Options> option) {
  option.applies_to = std::move(words);
  return option;
}

/// Marks an option as an output option: reports do not show it, and the command line that repeats a run omits
/// it.
template <class Options>
[[nodiscard]] Option<Options> of_output(Option<Options> option) {
  option.text = nullptr;
  option.text_anywhere = nullptr;
  option.json = nullptr;
  option.values = nullptr;
  return option;
}

// Options for a member `Value Options::*` or `std::optional<Value> Options::*`. A member that is not optional
// keeps its default value if the option is not given.

namespace detail {

template <class Value>
struct MemberValue {
  using Type = Value;
  static const Value* of(const Value& member) { return &member; }
};
template <class Value>
struct MemberValue<std::optional<Value>> {
  using Type = Value;
  static const Value* of(const std::optional<Value>& member) { return member ? &*member : nullptr; }
};

}  // namespace detail

/// Returns an option for `member`: `read(text)` returns the member's value, and `show(value)` returns its
/// text.
template <class Options, class Member, class Read, class Show>
[[nodiscard]] Option<Options> value_option(OptionSpec spec, Member Options::*member, Read read, Show show) {
  return {spec, [=](Options& options, const std::string& text) { options.*member = read(text); },

          [=](const Options& options) {
            const auto* value = detail::MemberValue<Member>::of(options.*member);
            return value != nullptr ? std::string(show(*value)) : std::string();
          }};
}

template <class Options, class Member>
[[nodiscard]] Option<Options> whole_option(OptionSpec spec, Member Options::*member, std::uint64_t least,
                                           std::uint64_t most) {
  using Value = typename detail::MemberValue<Member>::Type;
  auto option = value_option(
      spec, member,
      [=](const std::string& text) {
        return static_cast<Value>(parse_whole_number(spec.name, text, least, most));
      },
      [](const Value& value) { return std::to_string(value); });
  option.json = [=](const Options& options) { return Json(options.*member); };
  return option;
}

template <class Options, class Member>
[[nodiscard]] Option<Options> real_option(OptionSpec spec, Member Options::*member, RealRange range) {
  auto option = value_option(
      spec, member, [=](const std::string& text) { return parse_real(spec.name, text, range); },
      [](double value) { return fmt::format("{}", value); });
  option.json = [=](const Options& options) { return Json(options.*member); };
  return option;
}

/// Returns an option that takes one of `names`, which are the names of the enumerators from `first` on.
template <class Options, class Member>
[[nodiscard]] Option<Options> choice_option(OptionSpec spec, Member Options::*member,
                                            std::span<const std::string_view> names,
                                            typename detail::MemberValue<Member>::Type first = {}) {
  using Value = typename detail::MemberValue<Member>::Type;
  return value_option(
      spec, member, [=](const std::string& text) { return choice_of(spec.name, text, names, first); },
      [](Value value) { return name_of(value); });
}

/// Returns an option that takes a comma-separated list of words, numbers or enumerators. `parse` reads the
/// whole list.
template <class Options, class Item, class Parse>
[[nodiscard]] Option<Options> list_option(OptionSpec spec, std::vector<Item> Options::*member, Parse parse) {
  const auto text_of = [](const Item& item) {
    if constexpr (requires { name_of(item); }) {
      return std::string(name_of(item));
    } else {
      return fmt::format("{}", item);
    }
  };
  auto option = value_option(spec, member, parse, [=](const std::vector<Item>& items) {
    std::vector<std::string> words;
    for (const Item& item : items) words.push_back(text_of(item));
    return fmt::format("{}", fmt::join(words, ","));
  });
  option.json = [=](const Options& options) {
    Json items = Json::array();
    for (const Item& item : options.*member) {
      if constexpr (requires { name_of(item); }) {
        items.push_back(name_of(item));
      } else {
        items.push_back(item);
      }
    }
    return items;
  };
  return option;
}

template <class Options, class Member>
[[nodiscard]] Option<Options> text_option(OptionSpec spec, Member Options::*member) {
  return value_option(
      spec, member, [](const std::string& text) { return text; },
      [](const std::string& text) { return text; });
}

/// Returns an option that takes a file or directory. The path - is refused. The member is a path or an
/// optional path.
template <class Options, class Member>
[[nodiscard]] Option<Options> path_option(OptionSpec spec, Member Options::*member) {
  using Path = std::filesystem::path;
  auto option = value_option(
      spec, member, [=](const std::string& text) { return parse_path(spec.name, text); },
      [](const Path& path) { return path.string(); });
  option.text_anywhere = [=](const Options& options) {
    const Path* path = detail::MemberValue<Member>::of(options.*member);
    return path != nullptr && !path->empty() ? std::filesystem::absolute(*path).string() : std::string();
  };
  return option;
}

/// Returns a flag that sets a member to true.
template <class Options>
[[nodiscard]] Option<Options> flag_option(std::string_view name, const std::string& help,
                                          bool Options::*member) {
  return {{name, "", help},
          [=](Options& options, const std::string&) { options.*member = true; },
          [=](const Options& options) { return options.*member ? "yes" : ""; },
          nullptr,
          [=](const Options& options) { return Json(options.*member); }};
}

// The options that several commands share.

/// Returns the flag --replace of the options that take a directory for results.
template <class Options>
[[nodiscard]] Option<Options> replace_option(bool Options::*replace) {
  return of_output(flag_option(
      "--replace", "replace an earlier result in DIR (default: a DIR that holds files is refused)", replace));
}
/// Returns the options --out, --replace, --json and --quiet with their help.
[[nodiscard]] inline OptionList<Destinations> destination_options(
    const std::string& out,
    const std::string& json = "write the rows to FILE; - is standard output (default: none)",
    const std::string& quiet = "print no table and no progress bar") {
  return {{of_output(path_option({"--out", "DIR", out}, &Destinations::out)),
           replace_option(&Destinations::replace),
           of_output(text_option({"--json", "FILE", json}, &Destinations::json)),
           of_output(flag_option("--quiet", quiet, &Destinations::quiet))}};
}

template <class Options>
[[nodiscard]] Option<Options> events_option(std::optional<std::filesystem::path> Options::*events) {
  return of_output(path_option({"--events", "FILE",
                                "write every event with its beads and residues to FILE: as JSON lines if its "
                                "name ends in .jsonl, else as CSV (default: none)"},
                               events));
}
/// Returns the option --threads of commands whose results do not depend on it.
template <class Options>
[[nodiscard]] Option<Options> threads_option(std::optional<std::size_t> Options::*threads) {
  return of_output(whole_option({"--threads", "N",
                                 "cut the run at frames and run the parts on up to N threads, with the same "
                                 "events (default: all cores)"},
                                threads, 1, 1024));
}
/// Returns the option --apart: the least distance along the chain between the two beads of a pair.
template <class Options, class Member>
[[nodiscard]] Option<Options> apart_option(const std::string& help, Member Options::*apart) {
  return whole_option({"--apart", "K", help}, apart, 1, 1'000'000'000);
}

/// Returns the option --probe of power diagrams and dual complexes.
template <class Options>
[[nodiscard]] Option<Options> probe_option(std::optional<double> Options::*probe) {
  return real_option(
      {"--probe", "LENGTH",
       fmt::format("power and dual: radius of a probe, which is added to the radii of the beads "
                   "(default: 1.4 for dual and voids with {} element, otherwise 0)",
                   "--radius"_arg)},
      probe, {0, 1e150});
}

/// Returns the option --directions of hierarchies of boxes.
template <class Options, class Member>
[[nodiscard]] Option<Options> directions_option(Member Options::*directions) {
  return whole_option({"--directions", "K",
                       "boxes: directions of the slabs around each node. In space 3 (axes: boxes), 7 or 13 "
                       "(diagonals too: k-DOPs); in the plane 2 or 4 (default: axes)"},
                      directions, 2, 13);
}

/// Returns the option --stretch of spanners.
template <class Options>
[[nodiscard]] Option<Options> stretch_option(std::optional<double> Options::*stretch) {
  return real_option({"--stretch", "S",
                      "spanner: shortest paths along its edges are at most S times as long as straight "
                      "lines (default: 3)"},
                     stretch, {1.001, 1e6});
}

}  // namespace kds
