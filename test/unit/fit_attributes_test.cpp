// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Colours and other numbers of vertices at new places, fitted to those of the
// original.

#include "soup/fit_attributes.h"
#include "soup/number_positions.h"
#include "soup/selection.h"
#include "support/soups.h"

#include <selvedge/prepare.h>
#include <selvedge/simplify.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

/// A column in which a vertex has the value of a function at its point.
template <class Number, class Value>
Attribute painted(const Triangle_soup& soup, const std::string& name, Attribute::Type type,
                  bool is_normalized, const Value& value)
{
  Attribute result{name, type, 1, is_normalized, {}};
  for (const Point_3& p : soup.points) {
    const auto number = Number(value(p));
    const auto* const bytes = reinterpret_cast<const unsigned char*>(&number);
    result.rows.insert(result.rows.end(), bytes, bytes + sizeof number);
  }
  return result;
}

template <class Number>
Number painted_number(const Attribute& attribute, Index row)
{
  Number result;
  std::memcpy(&result, attribute.rows.data() + row * sizeof result, sizeof result);
  return result;
}

double painted_wave(const Point_3& p)
{
  return 128 + 100 * std::sin(0.25 * p.x()) * std::cos(0.2 * p.y());
}

/// A sheet with waves that its colours do not follow.
Triangle_soup sheet_to_paint(int size)
{
  return mapped(sheet(size, size), [](const Point_3& p) {
    return Point_3(p.x(), p.y(), std::sin(0.4 * p.x()) + std::cos(0.3 * p.y()));
  });
}

Simplified_soup reduced_painted(const Triangle_soup& soup, bool are_values_fitted = true, double ratio = 0.1)
{
  Simplify_options options;
  options.ratio = ratio;
  options.placement = Placement::optimal;
  options.are_values_fitted = are_values_fitted;
  return simplify_soup(prepare(soup), options);
}

/// The root mean square difference between a column and a function, at points
/// of faces.
template <class Number, class Value>
double colour_difference(const Triangle_soup& result, std::size_t place, const Value& value)
{
  double sum = 0, weights = 0;
  constexpr int steps = 12;
  for (const Index_triple& triangle : result.triangles) {
    const auto& [a, b, c] = triangle;
    const double area = std::sqrt(CGAL::squared_area(result.points[a], result.points[b], result.points[c]));
    for (int i = 1; i < steps; ++i)
      for (int j = 1; i + j < steps; ++j) {
        const std::array<double, 3> at = {double(i) / steps, double(j) / steps,
                                          double(steps - i - j) / steps};
        double x = 0, y = 0, shown = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          x += at[k] * result.points[triangle[k]].x();
          y += at[k] * result.points[triangle[k]].y();
          shown += at[k] * painted_number<Number>(result.vertex_attributes[place], triangle[k]);
        }
        sum += area * std::pow(shown - value(Point_3(x, y, 0)), 2);
        weights += area;
      }
  }
  return std::sqrt(sum / weights);
}

/// The vertex of the original that each vertex of a result was.
std::vector<Index> vertices_of_original(const Simplified_soup& result, const Triangle_soup& original)
{
  std::vector<Index> vertices(result.soup.points.size());
  for (Index i = 0; i < result.soup.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index corner = result.corners[i][k];
      vertices[result.soup.triangles[i][k]] = original.triangles[corner / 3][corner % 3];
    }
  return vertices;
}

std::string row_of_attribute(const Attribute& attribute, Index vertex)
{
  return std::string(reinterpret_cast<const char*>(attribute.rows.data()) + vertex * row_size(attribute),
                     row_size(attribute));
}

TEST(FitAttributes, BringsColoursNearerToThoseOfTheOriginal)
{
  Triangle_soup soup = sheet_to_paint(48);
  soup.vertex_attributes = {painted<std::uint8_t>(soup, "red", Attribute::Type::uint8, true, painted_wave)};
  const Simplified_soup fitted = reduced_painted(soup), kept = reduced_painted(soup, false);
  ASSERT_EQ(fitted.soup.triangles, kept.soup.triangles);
  EXPECT_GT(fitted.fitted_attributes, 50u);
  EXPECT_LE(fitted.fitted_attributes, fitted.placed_vertices);
  EXPECT_EQ(kept.fitted_attributes, 0u);
  EXPECT_EQ(fitted.fitted_texture, 0u);
  EXPECT_LT(colour_difference<std::uint8_t>(fitted.soup, 0, painted_wave),
            0.8 * colour_difference<std::uint8_t>(kept.soup, 0, painted_wave));
}

TEST(FitAttributes, LeavesVerticesThatHaveNotMoved)
{
  Triangle_soup soup = sheet_to_paint(32);
  soup.vertex_attributes = {painted<double>(soup, "quality", Attribute::Type::float64, false, painted_wave)};
  const Simplified_soup result = reduced_painted(soup, true, 0.3);
  const std::vector<Index> from = vertices_of_original(result, soup);
  std::size_t left = 0;
  for (Index v = 0; v < from.size(); ++v)
    if (!result.is_placed[v]) {
      EXPECT_EQ(row_of_attribute(result.soup.vertex_attributes[0], v),
                row_of_attribute(soup.vertex_attributes[0], from[v]));
      ++left;
    }
  EXPECT_GT(left, 20u);
  EXPECT_GT(result.fitted_attributes, 50u);
}

// Where colours jump, the best fit goes beyond them on both sides.
TEST(FitAttributes, StaysInTheRangeAround)
{
  Triangle_soup soup = sheet_to_paint(48);
  const auto step = [](const Point_3& p) {
    return p.x() < 6 ? 0 : p.x() > 42 ? 1 : p.x() + 0.3 * p.y() > 30 ? 0.75 : 0.25;
  };
  soup.vertex_attributes = {
      painted<float>(soup, "red", Attribute::Type::float32, false, step),
      painted<float>(soup, "same", Attribute::Type::float32, false, [](const Point_3&) { return 0.5; })};
  const Simplified_soup fitted = reduced_painted(soup), kept = reduced_painted(soup, false);
  std::size_t at_an_end = 0; // where it would be beyond
  for (Index v = 0; v < fitted.soup.points.size(); ++v) {
    const auto now = painted_number<float>(fitted.soup.vertex_attributes[0], v);
    EXPECT_GE(now, 0);
    EXPECT_LE(now, 1);
    if (const double x = fitted.soup.points[v].x(); x > 14 && x < 34) {
      EXPECT_GE(now, 0.25f);
      EXPECT_LE(now, 0.75f);
    }
    at_an_end +=
        (now == 0.25f || now == 0.75f) && now != painted_number<float>(kept.soup.vertex_attributes[0], v);
  }
  EXPECT_GT(at_an_end, 0u);
  EXPECT_EQ(fitted.soup.vertex_attributes[1].rows, kept.soup.vertex_attributes[1].rows);
  EXPECT_LT(colour_difference<float>(fitted.soup, 0, step), colour_difference<float>(kept.soup, 0, step));
}

/// Returns the colour that is fitted to the middle of four triangles, which are what is left of a sheet.
double fitted_middle_colour(const Triangle_soup& original)
{
  const double n = 8;
  Triangle_soup result = soup({{0, 0, 0}, {n, 0, 0}, {n, n, 0}, {0, n, 0}, {n / 2, n / 2, 0}},
                              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  result.vertex_attributes = {painted<double>(result, "red", Attribute::Type::float64, false,
                                              [](const Point_3& p) { return p.x() * p.x() / 64; })};
  const std::vector<Index> triangles = {0, 1, 2, 3}, positions = number_positions(original.points);
  const std::vector<Index_triple> corners = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
  const Fitted_surface surface(result, triangles, corners, original, positions);
  return fitted_attributes(surface, Vertex_values(original), {0, 0, 0, 0, 1}).at(0).at(4);
}

Triangle_soup sheet_with_slope()
{
  Triangle_soup soup = sheet(8, 8);
  soup.vertex_attributes = {painted<double>(soup, "red", Attribute::Type::float64, false,
                                            [](const Point_3& p) { return p.x() * p.x() / 64; })};
  return soup;
}

/// Gives the vertices of triangles beyond a line a colour, some of their own where others have them as well.
void paint_beyond(double line, double colour, bool are_split, Triangle_soup& soup)
{
  for (Index_triple& triangle : soup.triangles) {
    const bool is_beyond =
        std::all_of(triangle.begin(), triangle.end(), [&](Index v) { return soup.points[v].x() >= line; });
    for (Index& v : triangle) {
      std::vector<unsigned char>& rows = soup.vertex_attributes[0].rows;
      if (!is_beyond)
        continue;
      if (are_split) {
        soup.points.push_back(Point_3(soup.points[v]));
        v = Index(soup.points.size() - 1);
        rows.resize(soup.points.size() * sizeof colour);
      }
      std::memcpy(rows.data() + v * sizeof colour, &colour, sizeof colour);
    }
  }
}

// Vertices on both sides of a line have colours of their own. Faces of the result reach over it.
TEST(FitAttributes, DoesNotAskBeyondABorder)
{
  Triangle_soup near = sheet_with_slope();
  const double whole = fitted_middle_colour(near);
  EXPECT_LT(whole, 0.25); // the colours at the corners are too large everywhere between
  Triangle_soup both = near;
  paint_beyond(4, 1, true, both);
  const double fitted = fitted_middle_colour(both);
  EXPECT_NE(fitted, whole);
  near.triangles.erase(std::remove_if(near.triangles.begin(), near.triangles.end(),
                                      [&](const Index_triple& triangle) {
                                        return std::all_of(triangle.begin(), triangle.end(),
                                                           [&](Index v) { return near.points[v].x() >= 4; });
                                      }),
                       near.triangles.end());
  EXPECT_EQ(fitted_middle_colour(near), fitted);
}

TEST(FitAttributes, DoesNotAskWhatHasNoNumber)
{
  Triangle_soup soup = sheet_with_slope();
  const double whole = fitted_middle_colour(soup);
  paint_beyond(6, NAN, false, soup);
  const double fitted = fitted_middle_colour(soup);
  EXPECT_GT(fitted, 0);
  EXPECT_LT(fitted, 0.25);
  EXPECT_NE(fitted, whole);
}

TEST(FitAttributes, DoesNotAskOtherLayers)
{
  Triangle_soup soup = sheet_to_paint(32);
  soup.vertex_attributes = {painted<double>(soup, "red", Attribute::Type::float64, false, painted_wave)};
  const Simplified_soup alone = reduced_painted(soup);
  Triangle_soup both = joined(soup, moved(soup, 0, 0, 0.125));
  both.vertex_attributes = {painted<double>(both, "red", Attribute::Type::float64, false, painted_wave)};
  for (Index v = Index(soup.points.size()); v < both.points.size(); ++v) {
    const double dark = -1000;
    std::memcpy(both.vertex_attributes[0].rows.data() + v * sizeof dark, &dark, sizeof dark);
  }
  const Simplified_soup layers = reduced_painted(both);
  EXPECT_GT(layers.fitted_attributes, 50u);
  const std::vector<Index> from = vertices_of_original(layers, both);
  for (Index v = 0; v < from.size(); ++v) {
    const auto red = painted_number<double>(layers.soup.vertex_attributes[0], v);
    EXPECT_EQ(red > 0, from[v] < soup.points.size()) << red;
  }
}

// Rounding takes no mean out of the range of its numbers, so that one number everywhere stays that number.
TEST(FitAttributes, KeepsWhatIsTheSameEverywhere)
{
  Triangle_soup soup = sheet_to_paint(48);
  const auto label = [](const Point_3&) { return 2.1; };
  soup.vertex_attributes = {painted<double>(soup, "label", Attribute::Type::float64, false, label)};
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    soup.uvs.values.push_back({0.1, 0.7});
  soup.uvs.of_triangle = soup.triangles;
  for (const bool are_fitted : {false, true}) {
    const Simplified_soup result = reduced_painted(soup, are_fitted);
    EXPECT_GT(result.placed_vertices, 50u);
    for (Index v = 0; v < result.soup.points.size(); ++v)
      EXPECT_EQ(painted_number<double>(result.soup.vertex_attributes[0], v), 2.1);
    for (const std::array<double, 2>& uv : result.soup.uvs.values)
      EXPECT_EQ(uv, (std::array<double, 2>{0.1, 0.7}));
  }
}

// What integers stand for nothing between them, or are told by their names to
// do so.
TEST(FitAttributes, LeavesNumbersThatNameSomething)
{
  Triangle_soup soup = sheet_to_paint(32);
  const auto label = [](const Point_3& p) { return int(p.x()) / 8 + 4 * (int(p.y()) / 8); };
  soup.vertex_attributes = {painted<std::uint8_t>(soup, "label", Attribute::Type::uint8, false, label),
                            painted<float>(soup, "_FEATURE_ID_0", Attribute::Type::float32, false, label)};
  const std::vector<Attribute> labels = reduced_painted(soup, false).soup.vertex_attributes;
  const Simplified_soup alone = reduced_painted(soup);
  EXPECT_GT(alone.placed_vertices, 50u);
  EXPECT_EQ(alone.fitted_attributes, 0u);
  soup.vertex_attributes.push_back(
      painted<float>(soup, "red", Attribute::Type::float32, false, painted_wave));
  const Simplified_soup beside = reduced_painted(soup);
  EXPECT_GT(beside.fitted_attributes, 50u);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_EQ(alone.soup.vertex_attributes[i].rows, labels[i].rows);
    EXPECT_EQ(beside.soup.vertex_attributes[i].rows, labels[i].rows);
  }
}

TEST(FitAttributes, FitsSeveralColumnsAsEachAlone)
{
  const Triangle_soup plain = sheet_to_paint(32);
  const std::vector<Attribute> columns = {
      painted<std::uint8_t>(plain, "red", Attribute::Type::uint8, true, painted_wave),
      painted<std::uint16_t>(plain, "green", Attribute::Type::uint16, true,
                             [](const Point_3& p) { return 30000 + 30000 * std::cos(p.x() - p.y()); }),
      painted<float>(plain, "quality", Attribute::Type::float32, false,
                     [](const Point_3& p) { return p.x() * p.x(); }),
      painted<double>(plain, "alpha", Attribute::Type::float64, false, painted_wave)};
  Triangle_soup soup = plain;
  soup.vertex_attributes = columns;
  const Simplified_soup together = reduced_painted(soup);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    soup.vertex_attributes = {columns[i]};
    const Simplified_soup alone = reduced_painted(soup);
    EXPECT_GT(alone.fitted_attributes, 50u);
    EXPECT_LE(alone.fitted_attributes, together.fitted_attributes);
    EXPECT_EQ(alone.soup.vertex_attributes[0].rows, together.soup.vertex_attributes[i].rows) << i;
  }
}

TEST(FitAttributes, LeavesVerticesWithoutNumbers)
{
  Triangle_soup soup = sheet_to_paint(32);
  const auto partial = [](const Point_3& p) { return p.x() > 16 ? NAN : painted_wave(p); };
  soup.vertex_attributes = {painted<double>(soup, "red", Attribute::Type::float64, false, partial)};
  const Simplified_soup fitted = reduced_painted(soup), kept = reduced_painted(soup, false);
  EXPECT_GT(fitted.fitted_attributes, 20u);
  for (Index v = 0; v < fitted.soup.points.size(); ++v) {
    const auto now = painted_number<double>(fitted.soup.vertex_attributes[0], v),
               before = painted_number<double>(kept.soup.vertex_attributes[0], v);
    EXPECT_EQ(std::isnan(now), std::isnan(before));
    EXPECT_TRUE(std::isnan(now) || (now >= 28 && now <= 228)) << now;
  }
}

TEST(FitAttributes, IsDoneLaterAsItIsAtOnce)
{
  Triangle_soup soup = sheet_to_paint(32);
  soup.uvs.of_triangle = soup.triangles;
  for (const Point_3& p : soup.points)
    soup.uvs.values.push_back({p.x() * p.x(), p.y()});
  soup.vertex_attributes = {painted<float>(soup, "red", Attribute::Type::float32, false, painted_wave)};
  const Simplified_soup at_once = reduced_painted(soup);
  Simplified_soup later = reduced_painted(soup, false);
  EXPECT_EQ(later.fitted_attributes, 0u);
  EXPECT_NE(later.soup.vertex_attributes[0].rows, at_once.soup.vertex_attributes[0].rows);
  fit_values(later, prepare(soup));
  EXPECT_GT(later.fitted_attributes, 0u);
  EXPECT_EQ(later.fitted_attributes, at_once.fitted_attributes);
  EXPECT_EQ(later.fitted_texture, at_once.fitted_texture);
  EXPECT_EQ(later.soup.vertex_attributes[0].rows, at_once.soup.vertex_attributes[0].rows);
  EXPECT_EQ(later.soup.uvs.values, at_once.soup.uvs.values);
}

} // namespace
} // namespace selvedge::test
