// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_SOUP_VERTEX_VALUES_H
#define SELVEDGE_SOUP_VERTEX_VALUES_H

#include "Gltf_scene.h"

#include <selvedge/Triangle_soup.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace selvedge {

/// Says which attributes of a soup's vertices can be mixed, reads them as numbers, and writes mixed ones.
///
/// Texture coordinates, normals, and attributes of vertices in floating point or in normalized integers are
/// mixed; for a soup from glTF also the rows of all accessors, those of morph targets included. Other
/// integers (such as the indices of joints) are not: a vertex that is mixed keeps its own. The weights of its
/// joints (`WEIGHTS_...`) become what the mixed vertices give to just these joints, with the sum 1.
///
/// **Preconditions** The soup outlives the object. Vertices that are mixed with each other are of one
/// primitive of glTF.
class Vertex_values
{
public:
  explicit Vertex_values(const Triangle_soup& soup);

  /// The numbers of a vertex. How many they are and what they say depends on its primitive in glTF.
  using Numbers = std::vector<double>;

  /// A vertex in a mixture.
  struct Share
  {
    Index corner; ///< of the soup at this vertex, 3 × triangle + place in it
    double weight;
    const Numbers* numbers; ///< of a vertex that was mixed before; null for one with the values of the soup
  };
  /// Their weights add up to 1; some may be 0.
  using Shares = std::array<Share, 3>;

  /// Whether no vertex has numbers.
  bool is_empty() const { return m_own.size == 0 && m_of_blocks.empty(); }

  /// Returns mixed numbers, for a vertex that keeps from `own` what cannot be mixed. They are such that the
  /// soup can store them: normals get the length 1, and what morph targets add to them is scaled likewise;
  /// texture coordinates and normals become 32-bit floats where those of the soup are, and in glTF what its
  /// accessors hold. A number that is not finite is replaced by that of `own`.
  Numbers mixed(const Shares& shares, const Share& own) const;

  /// Returns the texture coordinates alone among such numbers. The soup must have some.
  std::array<double, 2> mixed_uv(const Shares& shares, const Share& own) const;
  std::array<double, 2> uv(const Numbers& numbers) const { return {numbers[0], numbers[1]}; }

  /// Texture coordinates as the soup can store them: they, and the numbers of the accessor in glTF.
  struct Stored_uv
  {
    std::array<double, 2> uv, in_scene;
  };
  Stored_uv stored_uv(Index corner, const std::array<double, 2>& uv) const;

  /// A number of vertices that can be fitted: a component of an attribute that is mixed, but not of texture
  /// coordinates, of normals and tangents, which have a length, of the weights of joints, which have a sum,
  /// and of what morph targets add.
  class Component;
  std::vector<Component> fitted_components() const;

  /// Returns this number of a vertex of the soup, or of one that was selected from it and has had its numbers
  /// `put`; a fraction where integers stand for fractions, NaN if the vertex does not have it.
  double value(const Component& component, const Triangle_soup& soup, Index vertex) const;

  /// Returns what becomes of it when the vertex stores it, which must have it.
  double stored_value(const Component& component, const Triangle_soup& soup, Index vertex,
                      double value) const;

  /// Returns the normal alone among such numbers. The soup must have some.
  std::array<double, 3> normal(const Numbers& numbers) const
  {
    const double* const normal = numbers.data() + m_first_of_normal;
    return {normal[0], normal[1], normal[2]};
  }

  /// Numbers for a vertex of a result: `of_vertex[v]` is null for a vertex that keeps its values.
  using Of_vertices = std::vector<const Numbers*>;

  /// Writes numbers into a soup that was selected from this one, and the points of these vertices into its
  /// glTF scene, which becomes one of its own. Corners of other vertices keep their values.
  void put(const Of_vertices& of_vertex, Triangle_soup& result) const;

  /// Texture coordinates, where there are some, and values of `fitted_components`, where they are not NaN, by
  /// vertex. Each list may be empty.
  struct Fitted
  {
    std::vector<std::optional<Stored_uv>> uvs;
    std::vector<std::vector<double>> values; ///< by component
  };

  /// Writes these alone, after `put` has written all.
  void put(const Fitted& fitted, Triangle_soup& result) const;

private:
  static constexpr std::size_t s_none = std::size_t(-1);

  // Rows of numbers: an attribute of the soup, or an accessor of a block of its scene.
  struct Column
  {
    std::string name;
    Attribute::Type type;
    std::size_t components;
    bool is_normalized;
    const unsigned char* rows;
    std::size_t row_size;
    std::size_t place, target = s_none;            // in the list of attributes, or in that of a morph target
    std::size_t first = s_none;                    // place of its first component among the numbers
    const Gltf_scene::Column* quantised = nullptr; // the accessor, if it can be quantised again
  };

  // Weights of joints, which are mixed, and in the same places the numbers of these joints, which are not.
  struct Influences
  {
    Column weights, joints;
  };

  // The columns of the soup or of one block that are mixed, with their places among the numbers.
  struct Table
  {
    std::vector<Column> columns; // those of weights are the last
    std::vector<Influences> influences;
    std::size_t size = 0; // of the numbers up to the last of these columns
    const Column* find(const char* name, std::size_t components) const;
  };
  static Table table(std::size_t first, const std::vector<Column>& columns);
  static bool is_mixed(const Column& column);

  // Where a soup has a number of a vertex: a component of a row in its scene, or in a column of its own.
  struct Place
  {
    const Column* column; // null if the vertex does not have it
    std::size_t component, row;
    const Gltf_scene::Instance* instance; // null in a column of the soup
  };
  Place place(const Component& component, const Triangle_soup& soup, Index vertex) const;
  static double unit(const Column& column); // what integers stand for fractions of

  // Where a vertex, or a corner, has its rows.
  struct Row
  {
    const Table* table;
    std::size_t number;
  };
  Row own_row(Index vertex) const { return {&m_own, vertex}; }
  Row scene_row(Index corner) const;                // in the table of its block; the soup must have a scene
  const Column* texture_column(Index corner) const; // null if there is none
  static double coordinate(const Column& column, double number, std::size_t component);

  Index vertex_of(Index corner) const { return m_soup.triangles[corner / 3][corner % 3]; }
  Numbers numbers_of(const Share& share) const;
  static double number(const Column& column, std::size_t row, std::size_t component)
  {
    return number(column, column.rows + row * column.row_size, component);
  }
  static double number(const Column& column, const void* row, std::size_t component);
  static double stored(const Column& column, double number, std::size_t component);
  static void write(const Column& column, std::size_t component, double number, void* row);
  static void write(const Column& column, const double* numbers, void* row);
  void complete_scene(const Shares& shares, const Share& own, const Numbers& numbers_of_own,
                      Numbers& numbers) const;
  static void normalize(const Column& column, const Numbers& own, Numbers& numbers);
  template <class Row_of>
  static void mix_influences(const Row_of& row_of, const Shares& shares, const Share& own, Numbers& numbers);

  template <std::size_t dimension, class Numbers_of>
  static void put(const Numbers_of& numbers_of, const Triangle_soup& result,
                  Corner_values<dimension>& values);
  void put_in_scene(const Of_vertices& of_vertex, Triangle_soup& result) const;
  static void clear_joints_without_weight(const Gltf_scene::Column& weights, Gltf_scene::Column& joints,
                                          std::size_t row);

  const Triangle_soup& m_soup;
  std::size_t m_first_of_normal = 0;
  bool m_are_uvs_float32 = false, m_are_normals_float32 = false;
  Table m_own;
  std::vector<Table> m_of_blocks;      // their numbers follow those of the soup
  std::map<Index, Index> m_of_corners; // vertices of the scene, at poles
};

class Vertex_values::Component
{
  friend class Vertex_values;
  std::size_t in_scene = 0;             // which component of the columns of the scene
  std::vector<const Column*> of_blocks; // null in a block that does not have it; empty if none has it
  std::size_t in_own = 0;               // likewise in that of the soup
  const Column* own = nullptr;          // null if the scene alone has it
};

} // namespace selvedge

#endif // SELVEDGE_SOUP_VERTEX_VALUES_H
