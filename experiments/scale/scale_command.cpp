#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/growth_columns.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/scale/measure_scale.h"
#include "motions/base/input_error.h"
#include "motions/models/model.h"

namespace kds {

namespace {

constexpr CommandSpec kScaleCommand{
    "kds scale",
    "Measures how events, certificates, times and separating families grow with the number of beads n: of a "
    "model, or\n"
    "over a list of files. Fits the growth. Each scene is measured as kds compare measures it, and its first "
    "frame as\n"
    "kds theorems measures it.\n\n"
    "  line              slope of the straight line through the logarithms\n"
    "  local, last       slope between the two largest sizes\n"
    "  beside ...        exponent of the leading term if lower-order terms are fitted too\n"
    "  law               the form with the least AICc, its largest residual, and the error of its prediction "
    "of the\n"
    "                    largest size from the others",
    "[INPUT]...",
    "necklaces of several sizes: .pdb .cif .gro .dcd .xtc .trr .nc .lammpstrj .xyz (also .gz)",
    "kds scale --model random-chain --beads 128,256,512,1024,2048,4096 --seeds 4 --out report\n"
    "kds scale small.dcd large.dcd --topology small.pdb,large.pdb",
};

std::vector<std::string_view> names_of_models() {
  std::vector<std::string_view> names;
  for (const models::Model& model : models::all_models()) names.push_back(model.name);
  return names;
}

std::vector<std::size_t> parse_sizes(const std::string& list) {
  std::vector<std::size_t> sizes;
  for (const std::string& text : split(list, ','))
    sizes.push_back(parse_whole_number("--beads", text, 2, 1'000'000));
  std::ranges::sort(sizes);
  if (const auto twice = std::ranges::adjacent_find(sizes); twice != sizes.end())
    throw InputError(fmt::format("--beads: {} is listed twice", *twice));
  return sizes;
}

const OptionList<ScaleOptions>& scale_options() {
  using O = ScaleOptions;
  static const std::string model_help =
      fmt::format("measure this model instead of INPUTs, with its default settings (kds generate): {}",
                  fmt::join(names_of_models(), ", "));
  static const auto list =
      OptionList<O>()
          .with({value_option(
                     {"--model", "NAME", model_help}, &O::model,
                     [](const std::string& text) {
                       const auto names = names_of_models();
                       return std::string(names[place_among("--model", text, names)]);
                     },
                     [](const std::string& name) { return name; }),
                 list_option({"--beads", "LIST",
                              "sizes of the model (default: 64,128,256,512,1024,2048). Exponents beside "
                              "lower-order terms need five, those of families six"},
                             &O::beads, parse_sizes),
                 whole_option({"--steps", "N", "steps of the model (default: 10)"}, &O::steps, 1, 100'000),
                 whole_option({"--seed", "N", "seed of the model (default: 1)"}, &O::seed, 0, UINT64_MAX),
                 whole_option({"--seeds", "N",
                               "random-chain: measure N chains of each size, of seeds from --seed on, and "
                               "report means with 95% intervals from their spread (default: 1)"},
                              &O::seeds, 1, 1000)})
          .with(input_options())
          .with({list_option({"--structures", "LIST",
                              "comma list of sorted, box, hull, closest, wrapped, boxes, layered, power, "
                              "contacts (default: wrapped,power)"},
                             &O::structures, parse_structures),
                 directions_option(&O::directions),
                 whole_option(
                     {"--rounds", "N", "repeat each run N times and report the median time (default: 1)"},
                     &O::rounds, 1, 1000)})
          .with(destination_options("write scale.json, scale.csv and report.html to DIR (default: none)"));
  return list;
}

ScaleOptions parse_scale(const Arguments& arguments) {
  ScaleOptions options;
  const ParsedArguments parsed = read_arguments(kScaleCommand, scale_options(), arguments, options);
  if (!options.model) {
    if (parsed.operands().empty())
      throw InputError("kds scale needs INPUTs or --model NAME (see kds scale --help)");
    for (const char* of_model : {"--beads", "--steps", "--seed", "--seeds"})
      if (parsed.has(of_model))
        throw InputError(
            fmt::format("{}: has no meaning for INPUTs; expected --model NAME with it", of_model));
    take_inputs(parsed, kScaleCommand.name, options);
    return options;
  }
  if (!parsed.operands().empty())
    throw InputError(fmt::format("--model {}: is measured alone; expected no INPUT beside it, found {}",
                                 *options.model, parsed.operands().front()));
  if (const models::Model& model = *models::find_model(*options.model);
      options.seeds > 1 && model.defaults.motion != models::ShapeMotion::wander)
    throw InputError(fmt::format(
        "--seeds: --model {} is the same for each seed; expected --model random-chain with it", model.name));
  for (const auto& option : input_options().all())
    if (parsed.has(option.spec.name))
      throw InputError(fmt::format("{}: has no meaning for --model {}", option.spec.name, *options.model));
  return options;
}

Table<ScaleRow> row_columns() {
  using R = ScaleRow;
  return {{
      {.key = "input", .value = [](const R& r) { return Field(r.input); }},
      {.key = "seed", .value = [](const R& r) { return Field(r.seed); }},
      {.key = "n", .value = [](const R& r) { return Field(r.beads); }},
      {.key = "dimension", .value = [](const R& r) { return Field(r.dimension); }},
      {.key = "subject", .value = [](const R& r) { return Field(r.subject); }},
      {.key = "measure", .value = [](const R& r) { return Field(r.measure->key); }},
      {.key = "value", .value = [](const R& r) { return Field(r.value); }},
  }};
}

struct PlacedSize {
  const ScaleSeries* series;
  const ScaleSeries::Size* size;
};

std::vector<PlacedSize> sizes_of(std::span<const ScaleSeries> all) {
  std::vector<PlacedSize> sizes;
  for (const ScaleSeries& series : all)
    for (const ScaleSeries::Size& size : series.sizes) sizes.push_back({&series, &size});
  return sizes;
}

Table<PlacedSize> size_columns() {
  using R = PlacedSize;
  const auto end_of = [](double MeanInterval::*end) {
    return [end](const R& r) { return r.size->interval ? Field((*r.size->interval).*end) : Field(); };
  };
  return {{
      {"subject", "subject", [](const R& r) { return Field(r.series->subject); }},
      {.key = "measure",
       .heading = "measure",
       .value = [](const R& r) { return Field(r.series->measure->key); },
       .words = [](const R& r) { return std::string(r.series->measure->name); }},
      {"n", "n", [](const R& r) { return Field(r.size->beads); }},
      {"scenes", "scenes", [](const R& r) { return Field(r.size->scenes); }},
      {.key = "mean",
       .heading = "mean (95%)",
       .value = [](const R& r) { return Field(r.size->mean); },
       .words =
           [](const R& r) {
             return r.size->interval ? interval_text(*r.size->interval) : short_decimal(r.size->mean);
           }},
      {.key = "lower", .value = end_of(&MeanInterval::lower)},
      {.key = "upper", .value = end_of(&MeanInterval::upper)},
  }};
}

struct PlacedFit {
  const ScaleSeries* series;
  GrowthSummary growth;
};

std::vector<PlacedFit> growth_of(std::span<const ScaleSeries> all) {
  std::vector<PlacedFit> fits;
  for (const ScaleSeries& series : all)
    if (auto fit = series.fits()) fits.push_back({&series, std::move(*fit)});
  return fits;
}

Table<PlacedFit> growth_table() {
  using R = PlacedFit;
  Table<R> table{{
      {"subject", "subject", [](const R& r) { return Field(r.series->subject); }},
      {.key = "measure",
       .heading = "measure",
       .value = [](const R& r) { return Field(r.series->measure->key); },
       .words = [](const R& r) { return std::string(r.series->measure->name); }},
  }};
  return table.add(growth_columns<R>([](const R& r) -> const GrowthSummary& { return r.growth; }));
}

// Returns a table with a line for each measure and a column for each size, which shows means.
std::string means_text(std::span<const ScaleSeries> all) {
  using R = ScaleSeries;
  std::vector<std::size_t> sizes;
  for (const PlacedSize& placed : sizes_of(all)) sizes.push_back(placed.size->beads);
  std::ranges::sort(sizes);
  const auto repeated = std::ranges::unique(sizes);
  sizes.erase(repeated.begin(), repeated.end());
  Table<R> table{{
      {.heading = "subject", .value = [](const R& r) { return Field(r.subject); }},
      {.heading = "mean by n", .value = [](const R& r) { return Field(std::string(r.measure->name)); }},
  }};
  for (const std::size_t beads : sizes)
    table.add({{.heading = with_thousands(beads),
                .value =
                    [beads](const R& r) {
                      const auto size = std::ranges::find(r.sizes, beads, &R::Size::beads);
                      return size == r.sizes.end() ? Field() : Field(size->mean);
                    },
                .format = shortly}});
  return table.text(all);
}

std::string scale_text(std::span<const ScaleSeries> all) {
  const std::vector<PlacedFit> fits = growth_of(all);
  const std::string sizes = means_text(all);
  return fits.empty() ? sizes : sizes + "\ngrowth with n\n" + growth_table().text(fits);
}

// Returns one plot for each measure, with points for each subject and error bars for several scenes of a
// size.
std::string scale_plots(std::span<const ScaleSeries> all) {
  std::string html;
  for (const auto measures : {structure_measures(), frame_measures()})
    for (const ScaleMeasure& measure : measures) {
      PointPlot plot{"beads n", std::string(measure.name), {}, {}};
      plot.x_is_chosen = true;
      for (const ScaleSeries& series : all) {
        if (series.measure != &measure) continue;
        for (const ScaleSeries::Size& size : series.sizes) {
          PointPlot::Point point{"", static_cast<double>(size.beads), size.mean, plot.series.size()};
          if (size.interval) {
            point.least = size.interval->lower;
            point.most = size.interval->upper;
          }
          if (point.y >= 0) plot.points.push_back(point);
        }
        plot.series.push_back(series.subject);
      }
      if (!plot.points.empty())
        html += html_figure(
            svg_plot(plot),
            html_escaped(fmt::format("{} by the number of beads, both axes logarithmic.", measure.name)));
    }
  return html;
}

std::string scale_page(const ScaleOptions& options, std::span<const ScaleSeries> all, Page page) {
  page.title = fmt::format("kds scale: {}", options.model ? *options.model : file_names(options));
  page.found = "<p>No theorem is claimed: exponents and laws hold for these scenes and sizes.</p>\n";
  page.words =
      "Exponents are fitted beside lower-order terms, by least squares of relative residuals. They hold for "
      "these sizes and have no interval, because the residuals are no independent errors. Means over several "
      "scenes of a size have Student's 95% interval, for scenes drawn independently. For families the "
      "lower-order terms are b n + c, for pairs "
      "looked "
      "at a term for the surface, otherwise a constant. The law is the form with the least AICc among the "
      "usual ones.";
  page.body = html_section("Growth", growth_table().html(growth_of(all)));
  page.body += html_section("Plots", scale_plots(all));
  page.body += html_section("Numbers", size_columns().html(sizes_of(all)));
  return html_page(page);
}

}  // namespace

int scale_command(const Arguments& arguments) {
  const ScaleOptions options = parse_scale(arguments);
  TableCommand command("scale", arguments, options, "scene");
  command.check_inputs_and_destinations(options);
  const std::vector<ScaleRow> rows = measure_scale(options, command.progress(), command.warn());
  const std::vector<ScaleSeries> all = series_of(rows);
  Json json;
  json["inputs"] = files_json(options);
  json["settings"] = scale_options().settings_json(options);
  json["rows"] = row_columns().json(rows);
  json["sizes"] = size_columns().json(sizes_of(all));
  json["fits"] = growth_table().json(growth_of(all));
  json["warnings"] = command.warnings();
  command.deliver(json, row_columns().csv(rows), scale_text(all),
                  [&](Page page) { return scale_page(options, all, std::move(page)); });
  return 0;
}

}  // namespace kds
