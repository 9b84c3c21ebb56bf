// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shrunk_world.h"

#include "soup/selection.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace selvedge::test {
namespace {

class Shrinking
{
public:
  Shrinking(World world, const std::function<bool(const World&)>& fails)
      : m_world(std::move(world)), m_fails(fails)
  {
  }

  World run()
  {
    do {
      m_is_smaller = false;
      drop_features();
      drop_triangles(&World::obstacle);
      drop_triangles(&World::soup);
      drop_vertices();
      ease_coordinates();
    } while (m_is_smaller);
    return m_world;
  }

private:
  template <class Change>
  bool attempt(const Change& change)
  {
    World smaller = m_world;
    change(smaller);
    if (smaller.soup.triangles.empty() || !m_fails(smaller))
      return false;
    m_world = std::move(smaller);
    return m_is_smaller = true;
  }

  template <class Value>
  void set(Value& (*value)(World&), const Value& plain)
  {
    if (!(value(m_world) == plain))
      attempt([&](World& world) { value(world) = plain; });
  }

  template <class Value>
  void set_option(Value Simplify_options::*option, const Value& plain)
  {
    if (!(m_world.options.*option == plain))
      attempt([&](World& world) { world.options.*option = plain; });
  }

  template <class Container>
  void clear(Container& (*container)(World&))
  {
    while (!container(m_world).empty() && attempt([&](World& world) { container(world).pop_back(); }))
      ;
  }

  void drop_features()
  {
    const Simplify_options plain;
    set_option(&Simplify_options::faces_per_cell, plain.faces_per_cell);
    set_option(&Simplify_options::loop, plain.loop);
    set_option(&Simplify_options::instances, Instances::apart);
    set_option(&Simplify_options::index, plain.index);
    set_option(&Simplify_options::faces_per_cluster, plain.faces_per_cluster);
    set_option(&Simplify_options::max_error, plain.max_error);
    set_option(&Simplify_options::faces, plain.faces);
    set_option(&Simplify_options::ratio, std::optional<double>(0));
    set_option(&Simplify_options::uv_weight, plain.uv_weight);
    set_option(&Simplify_options::normal_weight, plain.normal_weight);
    set_option(&Simplify_options::check_uv_orientation, plain.check_uv_orientation);
    for (const double limit : {plain.max_normal_change, 180.})
      set_limit(&Simplify_options::max_normal_change, limit, plain.max_normal_change);
    for (const double limit : {plain.min_aspect_ratio, 0.})
      set_limit(&Simplify_options::min_aspect_ratio, limit, plain.min_aspect_ratio);
    for (const double limit : {plain.max_border_turn, 180.})
      set_limit(&Simplify_options::max_border_turn, limit, plain.max_border_turn);
    for (const double limit : {plain.max_corner_height, 0.})
      set_limit(&Simplify_options::max_corner_height, limit, plain.max_corner_height);
    for (const double limit : {plain.max_seam_turn, 180.})
      set_limit(&Simplify_options::max_seam_turn, limit, plain.max_seam_turn);
    for (const double limit : {plain.max_border_drift, 10.})
      set_limit(&Simplify_options::max_border_drift, limit, plain.max_border_drift);
    set<double>([](World& w) -> double& { return w.options.cost.border_weight; }, plain.cost.border_weight);
    set<double>([](World& w) -> double& { return w.options.cost.stabiliser; }, plain.cost.stabiliser);
    set<double>([](World& w) -> double& { return w.options.cost.memory; }, plain.cost.memory);
    set<double>([](World& w) -> double& { return w.weld_distance; }, 0);
    set<Open_seams>([](World& w) -> Open_seams& { return w.open_seams; }, Open_seams::ignore);
    set<bool>([](World& w) -> bool& { return w.are_faces_oriented; }, false);
    set<Normals_choice>([](World& w) -> Normals_choice& { return w.normals; }, Normals_choice::keep);
    set<bool>([](World& w) -> bool& { return w.is_sewn; }, false);
    set<Defects>([](World& w) -> Defects& { return w.defects; }, Defects::freeze);
    set<Mesh_format>([](World& w) -> Mesh_format& { return w.output_format; }, Mesh_format::obj);
    set<std::optional<std::size_t>>([](World& w) -> std::optional<std::size_t>& { return w.questions; },
                                    std::nullopt);
    set<std::optional<double>>([](World& w) -> std::optional<double>& { return w.options.clearance; },
                               std::nullopt);
    clear<std::vector<double>>([](World& w) -> std::vector<double>& { return w.lods; });
    clear<std::vector<std::string>>([](World& w) -> std::vector<std::string>& { return w.intent.locked; });
    clear<std::vector<Index>>([](World& w) -> std::vector<Index>& { return w.intent.locked_vertices; });
    clear<std::vector<std::string>>([](World& w) -> std::vector<std::string>& { return w.intent.kept; });
    clear<std::vector<Simplify_intent::Part_ratio>>(
        [](World& w) -> std::vector<Simplify_intent::Part_ratio>& { return w.intent.ratios; });
    clear<std::vector<std::pair<std::string, std::string>>>(
        [](World& w) -> std::vector<std::pair<std::string, std::string>>& { return w.may_intersect; });
    clear<std::string>([](World& w) -> std::string& { return w.intent.weights; });
    clear<std::vector<std::string>>(
        [](World& w) -> std::vector<std::string>& { return w.dropped_parts.names; });
    set<double>([](World& w) -> double& { return w.dropped_parts.smaller_than; }, 0);
    clear<std::vector<std::string>>([](World& w) -> std::vector<std::string>& { return w.dropped; });

    if (m_world.soup.scene || m_world.input_format != Mesh_format::obj)
      attempt([](World& world) {
        world.soup.scene.reset();
        world.soup.scene_vertices.clear();
        world.input_format = Mesh_format::obj;
      });
    if (!m_world.soup.uvs.empty())
      attempt([](World& world) { world.soup.uvs = {}; });
    if (!m_world.soup.normals.empty())
      attempt([](World& world) { world.soup.normals = {}; });
    for (const auto labels : {&Triangle_soup::groups, &Triangle_soup::objects, &Triangle_soup::materials,
                              &Triangle_soup::smoothing_groups})
      if (!(m_world.soup.*labels).empty() && !(m_world.soup.scene && labels == &Triangle_soup::groups))
        attempt([&](World& world) { world.soup.*labels = {}; });
    for (const auto attributes : {&Triangle_soup::vertex_attributes, &Triangle_soup::triangle_attributes})
      if (!(m_world.soup.*attributes).empty())
        attempt([&](World& world) { (world.soup.*attributes).clear(); });
  }

  // One of the values at which a limit is simple.
  void set_limit(double Simplify_options::*limit, double value, double plain)
  {
    if (m_world.options.*limit != plain && m_world.options.*limit != value)
      attempt([&](World& world) { world.options.*limit = value; });
  }

  // Ever smaller stretches of them.
  void drop_triangles(Triangle_soup World::*soup)
  {
    for (std::size_t size = (m_world.*soup).triangles.size(); size > 0; size /= 2)
      for (std::size_t first = 0; first < (m_world.*soup).triangles.size();) {
        const bool is_dropped = attempt([&](World& world) {
          std::vector<Index> kept((world.*soup).triangles.size());
          std::iota(kept.begin(), kept.end(), Index(0));
          kept.erase(kept.begin() + first, kept.begin() + std::min(first + size, kept.size()));
          keep_triangles(world.*soup, kept);
        });
        first += is_dropped ? 0 : size;
      }
  }

  void drop_vertices()
  {
    if (!m_world.soup.scene)
      drop_unused(&World::soup);
    drop_unused(&World::obstacle);
  }

  void drop_unused(Triangle_soup World::*soup)
  {
    std::set<Index> used;
    for (const Index_triple& triangle : (m_world.*soup).triangles)
      used.insert(triangle.begin(), triangle.end());
    if (used.size() == (m_world.*soup).points.size())
      return;
    attempt([&](World& world) {
      Triangle_soup& from = world.*soup;
      std::vector<Index> triangles(from.triangles.size());
      std::vector<Index_triple> corners;
      std::iota(triangles.begin(), triangles.end(), Index(0));
      for (const Index t : triangles)
        corners.push_back({3 * t, 3 * t + 1, 3 * t + 2});
      from = selected(from, triangles, corners);
    });
  }

  // Of all coordinates together, as they would be written.
  static std::size_t digits(const World& world)
  {
    std::size_t count = 0;
    for (const Triangle_soup* soup : {&world.soup, &world.obstacle})
      for (const Point_3& p : soup->points)
        for (int axis = 0; axis < 3; ++axis) {
          char text[32];
          count += std::size_t(std::to_chars(text, text + sizeof text, p[axis]).ptr - text);
        }
    return count;
  }

  template <class Function>
  bool map_coordinates(int axis, const Function& function)
  {
    World mapped = m_world;
    for (Triangle_soup* soup : {&mapped.soup, &mapped.obstacle})
      for (Point_3& p : soup->points) {
        std::array<double, 3> x{p.x(), p.y(), p.z()};
        x[axis] = function(x[axis]);
        p = Point_3(x[0], x[1], x[2]);
      }
    return digits(mapped) < digits(m_world) && attempt([&](World& world) { world = mapped; });
  }

  // Along each axis: as whole numbers from 0, in the same order; else with fewer digits.
  void ease_coordinates()
  {
    if (m_world.soup.scene)
      return;
    for (int axis = 0; axis < 3; ++axis) {
      std::set<double> values;
      for (const Triangle_soup* soup : {&m_world.soup, &m_world.obstacle})
        for (const Point_3& p : soup->points)
          values.insert(p[axis] + 0.);
      const auto rank = [&](double x) { return double(std::distance(values.begin(), values.find(x))); };
      if (map_coordinates(axis, rank))
        continue;
      for (const double unit : {16., 1., 0x1p-4, 0x1p-8, 0x1p-16, 0x1p-24, 0x1p-32})
        if (map_coordinates(axis, [&](double x) { return unit * std::round(x / unit); }))
          break;
      map_coordinates(axis, [&](double x) { return x - *values.begin(); });
    }
  }

  World m_world;
  const std::function<bool(const World&)>& m_fails;
  bool m_is_smaller = false;
};

} // namespace

World shrunk(World world, const std::function<bool(const World&)>& fails)
{
  return Shrinking(std::move(world), fails).run();
}

} // namespace selvedge::test
