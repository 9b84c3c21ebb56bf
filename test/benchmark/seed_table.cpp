// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Table 1 and figure 9 of Derichs, Misiak and Fuhrmann, *Intersection-free mesh decimation for high
// resolution cloth models*, for any meshes: what the intersection filter costs in time and error, what it
// prevents, and how its time depends on the cluster size. The seed is that paper.

#include <selvedge/generate.h>
#include <selvedge/mesh/mesh_files.h>
#include <selvedge/simplify_soup.h>
#include <selvedge/verify.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace {

using namespace selvedge;

using Row = std::vector<std::string>;

constexpr double ratio_of_seed = 0.3;
constexpr std::size_t cluster_size_of_seed = 100;
const std::vector<std::size_t> cluster_sizes{10, 25, 50, cluster_size_of_seed, 200, 500, 1000};

std::string text(std::size_t number)
{
  return std::to_string(number);
}

std::string text(double number, const char* format = "%.3g")
{
  if (std::isnan(number))
    return "-";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, number);
  return buffer;
}

/// Printed as markdown row by row, since rows take their time, and kept for the CSV file.
class Table
{
public:
  explicit Table(const Row& header)
  {
    add(header);
    print(Row(header.size(), "---"));
  }

  void add(const Row& row)
  {
    print(row);
    m_csv += joined(row, ",") + '\n';
  }

  const std::string& csv() const { return m_csv; }

private:
  static void print(const Row& row) { std::cout << "| " << joined(row, " | ") << " |" << std::endl; }

  static std::string joined(const Row& row, const std::string& separator)
  {
    std::string line;
    for (const std::string& cell : row)
      line += (line.empty() ? "" : separator) + cell;
    return line;
  }

  std::string m_csv;
};

/// What is measured more than once.
struct Sample
{
  std::vector<double> values;

  double least() const { return *std::min_element(values.begin(), values.end()); }
  double most() const { return *std::max_element(values.begin(), values.end()); }
  double median() const
  {
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
  }
  friend Sample operator/(Sample a, const Sample& b)
  {
    std::transform(a.values.begin(), a.values.end(), b.values.begin(), a.values.begin(), std::divides<>());
    return a;
  }
};

std::string spread(const Sample& sample)
{
  return text(sample.least()) + " to " + text(sample.most());
}

struct Mesh
{
  std::string name; // nothing in it that CSV, markdown or SVG would have to escape
  Prepared_soup prepared;
};

/// A file, or what `generate` makes: SCENE:FACES.
Mesh mesh(const std::string& argument)
{
  std::string name = std::filesystem::path(argument).stem().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c) && c != '-' && c != ':'; },
      '_');
  const std::size_t colon = argument.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(argument))
    return {name, prepare(read_mesh(argument).soup)};
  Generate_options options;
  const char* const end = argument.data() + argument.size();
  if (const auto [stop, error] = std::from_chars(argument.data() + colon + 1, end, options.faces);
      error != std::errc() || stop != end)
    throw CLI::ValidationError(argument + " is neither a file nor SCENE:FACES");
  return {name, prepare(generate(argument.substr(0, colon), options))};
}

Simplify_options guarded(std::size_t cluster_size = cluster_size_of_seed)
{
  Simplify_options options;
  options.ratio = ratio_of_seed;
  options.faces_per_cluster = cluster_size;
  return options;
}

Simplify_options unguarded()
{
  Simplify_options options = guarded();
  options.check_intersections = false;
  return options;
}

double seconds_per_1000(const Simplify_report& report)
{
  return 1000 * report.seconds_reduce / static_cast<double>(report.collapses);
}

/// Each of these reductions in turn, `runs` times, every other time backwards: what slows the machine down
/// for a while, slows all of them down. `on_first` is called with the first result of each.
template <class Function>
std::vector<Sample> interleaved(const Prepared_soup& prepared, const std::vector<Simplify_options>& all,
                                int runs, const Function& on_first)
{
  std::vector<Sample> seconds(all.size());
  for (int run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t which = run % 2 == 0 ? i : all.size() - 1 - i;
      const Simplified_soup result = simplify_soup(prepared, all[which]);
      if (run == 0)
        on_first(which, result);
      seconds[which].values.push_back(seconds_per_1000(result.report));
    }
  return seconds;
}

/// A column of the seed's table.
struct Column
{
  std::string mesh;
  std::size_t faces, vertices, faces_left;
  double seconds[2], error[2]; // without and with the filter
  std::size_t prevented;
};

const Column columns_of_seed[] = {
    {"seed: Shorts", 99'928, 60'662, 29'978, {0.035, 0.14}, {0.00015, 0.00027}, 18'852},
    {"seed: Garments+Avatar", 631'142, 676'548, 189'341, {0.034, 0.14}, {0.000045, 0.000051}, 40'728},
    {"seed: Bunny", 69'451, 34'834, 20'834, {0.046, 0.09}, {0.00016, 0.00016}, 0},
    {"seed: XYZ Dragon", 7'219'045, 3'609'600, 2'165'713, {0.037, 0.22}, {0.000021, 0.000021}, 314}};

const Row header_of_table{"mesh",        "time ratio",  "least to most", "RMS ratio",     "s/1000 without",
                          "s/1000 with", "RMS without", "RMS with",      "prevented",     "pairs without",
                          "pairs with",  "faces",       "vertices",      "faces at 30 %", "outcome"};

Row row(const Column& c, double time_ratio, const std::string& range, const Row& pairs,
        const std::string& outcome)
{
  return {c.mesh,
          text(time_ratio),
          range,
          text(c.error[1] / c.error[0]),
          text(c.seconds[0]),
          text(c.seconds[1]),
          text(c.error[0]),
          text(c.error[1]),
          text(c.prevented),
          pairs[0],
          pairs[1],
          text(c.faces),
          text(c.vertices),
          text(c.faces_left),
          outcome};
}

std::size_t vertices_in_use(const Triangle_soup& soup)
{
  std::vector<char> is_used(soup.points.size());
  for (const Index_triple& triangle : soup.triangles)
    for (const Index vertex : triangle)
      is_used[vertex] = true;
  return static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), true));
}

Row measured_row(const Mesh& mesh, int runs)
{
  const Triangle_soup& soup = mesh.prepared.soup;
  Column column{mesh.name, soup.triangles.size(), vertices_in_use(soup), 0, {}, {}, 0};
  Row pairs(2);
  std::string outcome;
  const auto seconds =
      interleaved(mesh.prepared, {unguarded(), guarded()}, runs, [&](std::size_t which, const auto& result) {
        const Verification verdict = verify(result, mesh.prepared);
        column.error[which] = verdict.distances->original_to_result.root_mean_square;
        pairs[which] = text(verdict.new_pairs.size());
        column.faces_left = result.report.faces_output; // the last one is guarded
        column.prevented = result.report.refused.intersection;
        outcome = result.report.outcome();
      });
  for (std::size_t which : {0, 1})
    column.seconds[which] = seconds[which].median();
  const Sample ratio = seconds[1] / seconds[0];
  return row(column, ratio.median(), spread(ratio), pairs, outcome);
}

struct Curve
{
  std::string mesh;
  std::vector<double> seconds; // for each of `cluster_sizes`
};

/// Adds a row for each cluster size, and one for no filter at all.
Curve measured_curve(const Mesh& mesh, int runs, Table& table)
{
  std::vector<Simplify_options> all;
  for (const std::size_t size : cluster_sizes)
    all.push_back(guarded(size));
  all.push_back(unguarded());
  const auto seconds = interleaved(mesh.prepared, all, runs, [](std::size_t, const auto&) {});

  const auto of_seed = std::find(cluster_sizes.begin(), cluster_sizes.end(), cluster_size_of_seed);
  Curve curve{mesh.name, {}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Sample ratio = seconds[i] / seconds[static_cast<std::size_t>(of_seed - cluster_sizes.begin())];
    const bool is_guarded = i < cluster_sizes.size();
    table.add({mesh.name, is_guarded ? text(cluster_sizes[i]) : "no filter", text(ratio.median()),
               spread(ratio), text(seconds[i].median())});
    if (is_guarded)
      curve.seconds.push_back(seconds[i].median());
  }
  return curve;
}

/// Sizes on a logarithmic axis, seconds on a linear one from 0.
std::string plot(const std::vector<Curve>& curves)
{
  constexpr double left = 70, right = 690, top = 20, bottom = 360;
  static const char* const colours[] = {"#0b6e99", "#c2410c", "#4d7c0f", "#7e22ce", "#b91c1c", "#475569"};
  double most = 0;
  for (const Curve& curve : curves)
    most = (std::max)(most, *std::max_element(curve.seconds.begin(), curve.seconds.end()));
  const auto x = [&](std::size_t size) {
    const auto place = [](std::size_t s) { return std::log(static_cast<double>(s) / cluster_sizes.front()); };
    return text(left + (right - left) * place(size) / place(cluster_sizes.back()), "%.1f");
  };
  const auto y = [&](double seconds) { return text(bottom - (bottom - top) * seconds / most, "%.1f"); };
  const auto line = [](const std::string& colour, const std::string& points) {
    return "<polyline fill='none' stroke='" + colour + "' points='" + points + "'/>\n";
  };
  const auto label = [](const std::string& at_x, const std::string& at_y, const std::string& more,
                        const std::string& what) {
    return "<text x='" + at_x + "' y='" + at_y + "' " + more + ">" + what + "</text>\n";
  };

  std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 720 420' font-family='sans-serif' "
                    "font-size='13'>\n<rect width='720' height='420' fill='white'/>\n";
  for (const std::size_t size : cluster_sizes)
    svg += line("#ddd", x(size) + ",20 " + x(size) + ",360") +
           label(x(size), "380", "text-anchor='middle'", text(size));
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0})
    svg += line("#ddd", "70," + y(part * most) + " 690," + y(part * most)) +
           label("62", y(part * most), "text-anchor='end' dy='4'", text(part * most));
  svg += line("#000", "70,20 70,360 690,360") +
         label("380", "408", "text-anchor='middle'", "faces per cluster") +
         label("0", "0", "text-anchor='middle' transform='translate(16 190) rotate(-90)'",
               "seconds per 1000 collapses");
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string colour = colours[i % std::size(colours)];
    std::string points;
    for (std::size_t j = 0; j < cluster_sizes.size(); ++j)
      points += x(cluster_sizes[j]) + "," + y(curves[i].seconds[j]) + " ";
    svg += line(colour, points) +
           label("682", text(345 - 18 * i), "text-anchor='end' fill='" + colour + "'", curves[i].mesh);
  }
  return svg + "</svg>\n";
}

struct Request
{
  std::vector<std::string> meshes;
  int runs = 3;
  bool is_clusters = false;
  std::string csv;
  std::string plot;
};

void print_table(const Request& request)
{
  Table table(header_of_table);
  for (const Column& column : columns_of_seed)
    table.add(row(column, column.seconds[1] / column.seconds[0], "-", {"-", "-"}, "-"));
  for (const std::string& argument : request.meshes)
    table.add(measured_row(mesh(argument), request.runs));
  std::cout
      << "\nA reduction to 30 %, with the seed's limits. **The ratios count**: each is of two reductions in "
         "one "
         "run on one machine,\nwith the filter to without. Seconds are per 1000 collapses, of the median of "
      << request.runs << " interleaved run(s), everything from the\nfirst cost to the last collapse included "
      << "(the seed: Intel i7, 2.9 GHz). RMS: from the original's vertices to the result,\nby the diagonal. "
         "Pairs: offending ones that the original does not have. What the seed does not say is '-'.\n";
  if (!request.csv.empty())
    write_file(request.csv, table.csv());
}

void print_curves(const Request& request)
{
  Table table(
      {"mesh", "faces per cluster", "ratio to " + text(cluster_size_of_seed), "least to most", "s/1000"});
  std::vector<Curve> curves;
  for (const std::string& argument : request.meshes)
    curves.push_back(measured_curve(mesh(argument), request.runs, table));
  std::cout
      << "\nA reduction to 30 %; the seed's best cluster size is " << cluster_size_of_seed
      << ". **The ratios count**: each is of two reductions in one\nrun on one machine. Seconds are per 1000 "
         "collapses, of the median of "
      << request.runs << " interleaved run(s).\n";
  if (!request.csv.empty())
    write_file(request.csv, table.csv());
  if (!request.plot.empty())
    write_file(request.plot, plot(curves));
}

} // namespace

int main(int argc, char** argv)
{
  CLI::App app(
      "Table 1 of the seed (Derichs, Misiak, Fuhrmann) for any meshes, or with --clusters its figure 9.");
  Request request;
  app.add_option("MESH", request.meshes, "Files, or generated ones as SCENE:FACES, such as skirt:1000000")
      ->required();
  app.add_option("--runs", request.runs, "Of which the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  auto* const clusters = app.add_flag("--clusters", request.is_clusters, "Time against cluster size instead");
  app.add_option("--csv", request.csv, "The table once more")->type_name("FILE");
  app.add_option("--plot", request.plot, "The curves of --clusters as SVG")
      ->type_name("FILE")
      ->needs(clusters);
  try {
    app.parse(argc, argv);
    (request.is_clusters ? print_curves : print_table)(request);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "seed_table: " << error.what() << std::endl;
    return 1;
  }
}
