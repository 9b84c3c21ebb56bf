// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_LINE_PLOT_H
#define SELVEDGE_BENCHMARK_LINE_PLOT_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

namespace selvedge::benchmark {

struct Curve
{
  std::string name;
  std::vector<double> values;
};

/// An SVG of curves over common places, on a logarithmic axis; their values are on a linear one from 0.
///
/// Preconditions, not checked: at least one curve and two places, which ascend and are above 0; a value for
/// each of them, finite, at least 0, and somewhere more; no markup in names.
inline std::string line_plot(const std::vector<double>& places, const std::string& place_axis,
                             const std::vector<Curve>& curves, const std::string& value_axis)
{
  constexpr double left = 70, right = 690, top = 20, bottom = 360;
  static const char* const colours[] = {"#0b6e99", "#c2410c", "#4d7c0f", "#7e22ce", "#b91c1c", "#475569"};
  const auto text = [](double number) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", number);
    return std::string(buffer);
  };
  double most = 0;
  for (const Curve& curve : curves)
    most = (std::max)(most, *std::max_element(curve.values.begin(), curve.values.end()));

  std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 720 420' font-family='sans-serif' "
                    "font-size='13'>\n<rect width='720' height='420' fill='white'/>\n";
  const auto x = [&](double place) {
    return left +
           (right - left) * std::log(place / places.front()) / std::log(places.back() / places.front());
  };
  const auto y = [&](double value) { return bottom - (bottom - top) * value / most; };
  const auto point = [&](double at_x, double at_y) { return text(at_x) + ',' + text(at_y) + ' '; };
  const auto draw = [&](const std::string& colour, const std::string& points) {
    svg += "<polyline fill='none' stroke='" + colour + "' points='" + points + "'/>\n";
  };
  const auto write = [&](double at_x, double at_y, const std::string& attributes, const std::string& what) {
    svg += "<text transform='translate(" + point(at_x, at_y) + ")" + attributes + ">" + what + "</text>\n";
  };

  for (const double place : places) {
    draw("#ddd", point(x(place), top) + point(x(place), bottom));
    write(x(place), bottom + 20, "' text-anchor='middle'", text(place));
  }
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    draw("#ddd", point(left, y(part * most)) + point(right, y(part * most)));
    write(left - 8, y(part * most) + 4, "' text-anchor='end'", text(part * most));
  }
  draw("#000", point(left, top) + point(left, bottom) + point(right, bottom));
  write((left + right) / 2, bottom + 48, "' text-anchor='middle'", place_axis);
  write(16, (top + bottom) / 2, " rotate(-90)' text-anchor='middle'", value_axis);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string colour = colours[i % std::size(colours)];
    std::string points;
    for (std::size_t j = 0; j < places.size(); ++j)
      points += point(x(places[j]), y(curves[i].values[j]));
    draw(colour, points);
    write(right - 8, bottom - 15 - 18 * static_cast<double>(i), "' text-anchor='end' fill='" + colour + "'",
          curves[i].name);
  }
  return svg + "</svg>\n";
}

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_LINE_PLOT_H
