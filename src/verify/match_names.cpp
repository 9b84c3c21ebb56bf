// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "match_names.h"

#include "Patches.h"
#include "Shape.h"
#include "part_names.h"

#include <selvedge/Cancellation_scope.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace selvedge::internal {
namespace {

/// Judges whether matched pieces have kept their groups, objects and materials, a part of the verdict of
/// `verify`.
class Name_matching
{
public:
  Name_matching(Piece_matching& matching, const Piece_mesh& result, const Piece_mesh& original,
                std::size_t position_count, int exponent)
      : m_matching(matching), m_result(result), m_original(original), m_position_count(position_count),
        m_exponent(exponent)
  {
  }

  void run()
  {
    const auto judge = [&](const char* what, const Triangle_labels& now, const Triangle_labels& before) {
      if (now.empty() && before.empty())
        return;
      if (now.empty() || before.empty()) {
        m_matching.names_not_compared.push_back(what);
        return;
      }
      const Common_names names(m_result.soup, now, m_original.soup, before);
      if (!names.is_any_common()) {
        m_matching.names_not_compared.push_back(what);
        return;
      }
      m_matching.names_compared.push_back(what);
      judge_names(what, names);
    };
    judge("group", m_result.soup.groups, m_original.soup.groups);
    judge("object", m_result.soup.objects, m_original.soup.objects);
    judge("material", m_result.soup.materials, m_original.soup.materials);
  }

private:
  void judge_names(const char* what, const Common_names& names)
  {
    if (names.is_one())
      return;
    Cancellation_scope::check();
    std::vector<Pair> pairs;
    for (Index t = 0; t < m_original.soup.triangles.size(); ++t)
      for (int place = 0; m_original.piece(t) != no_piece && place < 3; ++place) {
        const Pair pair(m_original.position(t, place), names.before(t));
        if (pairs.empty() || pairs.back() != pair)
          pairs.push_back(pair);
      }
    const Lists names_at(m_position_count, pairs);
    for (const Piece_match& match : m_matching.matches)
      judge_names(what, names, names_at, match);
  }

  void judge_names(const char* what, const Common_names& names, const Lists& names_at,
                   const Piece_match& match)
  {
    const std::vector<Index> now = m_result.triangles_of(match.of_result),
                             before = m_original.triangles_of(match.of_original);
    std::map<Index, Index> is_there; // the names of the original, with a triangle of each
    for (const Index t : before)
      is_there.emplace(names.before(t), t);
    std::map<Index, Index> is_left;
    for (const Index t : now)
      is_left.emplace(names.now(t), t);
    if (is_there.size() == 1 && is_left.size() == 1 && is_there.begin()->first == is_left.begin()->first)
      return;

    std::optional<Shape> shape;
    // Returns the name that the original has at the place of a triangle of the result. This is the triangle's
    // own name when the original has it there, perhaps among others, and when it has no name there.
    const auto name_before = [&](Index t) {
      const Index name = names.now(t);
      bool is_known = false, is_here = true;
      for (int place = 0; place < 3; ++place) {
        const Lists::Range here = names_at[m_result.position(t, place)];
        if (here.size() == 0 || here.size() > most_at_a_position)
          continue;
        is_known = true;
        is_here = is_here && (std::binary_search(here.begin(), here.end(), name) ||
                              std::binary_search(here.begin(), here.end(), names.none()));
      }
      if (is_known && is_here)
        return name;
      if (!shape)
        shape.emplace(m_original.soup, before, m_exponent);
      const Index nearest = names.before(before[shape->nearest(centre(m_result.soup, t, m_exponent))]);
      return nearest == names.none() ? name : nearest;
    };

    const auto quoted = [&](Index name) {
      return name == names.none() ? "no name" : "'" + names.text(name) + "'";
    };
    std::optional<Patch_shapes> patches_before;
    bool is_any_wrong = false;
    Cancellation_poll poll;
    for (const Patch& patch : patches_of(m_result.soup, now, [&](Index t) { return names.now(t); })) {
      std::map<Index, std::size_t> others; // how many of its faces have another name before, and which
      std::size_t right = 0;
      for (const Index t : patch.triangles) {
        poll();
        if (const Index name = name_before(t); name == patch.name)
          ++right;
        else
          ++others[name];
      }
      if (2 * right >= patch.triangles.size())
        continue;
      // Where little is left of a piece, a face may lie nearest to one that was beside it.
      if (!patches_before)
        patches_before.emplace(m_original.soup,
                               patches_of(m_original.soup, before, [&](Index t) { return names.before(t); }),
                               m_exponent);
      if (patches_before->is_likest_of_its_name(m_result.soup, patch))
        continue;
      is_any_wrong = true;
      const auto most = std::max_element(others.begin(), others.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      add(match, std::string("the ") + what + " of " + counted(patch.triangles.size(), "face") + " of " +
                     describe(m_result, m_result.piece(patch.triangles.front())) + " of the result is " +
                     quoted(patch.name) + ", where the original has " + quoted(most->first));
    }
    if (is_any_wrong)
      return;
    for (const auto& [name, triangle] : is_there)
      if (name != names.none() && is_left.count(name) == 0)
        add(match, std::string("the ") + what + ' ' + quoted(name) + " of " +
                       describe(m_original, m_original.piece(triangle)) +
                       " of the original has no face left in the result");
  }

  template <class Name_of>
  static std::vector<Patch> patches_of(const Triangle_soup& soup, const std::vector<Index>& triangles,
                                       const Name_of& name_of)
  {
    std::vector<Index> names;
    for (const Index t : triangles)
      names.push_back(name_of(t));
    return patches(soup, triangles, names);
  }

  void add(const Piece_match& match, std::string message)
  {
    m_matching.mismatches.push_back({Mismatch::name, match.of_original, match.of_result, std::move(message)});
  }

  Piece_matching& m_matching;
  const Piece_mesh& m_result;
  const Piece_mesh& m_original;
  std::size_t m_position_count;
  int m_exponent;
};

} // namespace

void match_names(Piece_matching& matching, const Piece_mesh& result, const Piece_mesh& original,
                 std::size_t position_count, int exponent)
{
  Name_matching(matching, result, original, position_count, exponent).run();
}

} // namespace selvedge::internal
