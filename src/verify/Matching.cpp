// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "Matching.h"

#include "match_steps.h"
#include "positions.h"
#include "rounded.h"

#include <algorithm>
#include <utility>

// Keeps what the steps of `match_pieces` have found so far.

namespace selvedge::internal {
namespace {

/// Numbers the positions of two soups; those of the second follow those of the first. When only the first has
/// been rounded to 32-bit floats, the second is rounded for this too.
std::vector<Index> common_positions(const Triangle_soup& result, const Triangle_soup& original,
                                    bool may_be_rounded)
{
  return may_be_rounded && is_only_first_rounded(result, original)
             ? position_numbers(result, rounded(original))
             : position_numbers(result, original);
}

std::vector<Index> left(const std::vector<Index>& matches)
{
  std::vector<Index> pieces;
  for (Index piece = 0; piece < matches.size(); ++piece)
    if (matches[piece] == no_piece)
      pieces.push_back(piece);
  return pieces;
}

} // namespace

Matching::Matching(const Triangle_soup& of_result, const Triangle_soup& of_original,
                   const Verify_options& verify_options)
    : options(verify_options), positions(common_positions(of_result, of_original, options.may_be_rounded)),
      position_count(positions.empty() ? 0 : 1 + *std::max_element(positions.begin(), positions.end())),
      result(of_result, positions.data()), original(of_original, positions.data() + of_result.points.size()),
      exponent(common_exponent(of_result, of_original)), original_at(original.pieces_at(position_count)),
      match_of_result(result.pieces().size(), no_piece),
      match_of_original(original.pieces().size(), no_piece), is_hidden(original.pieces().size())
{
}

std::vector<Index> Matching::left_of_result() const
{
  return left(match_of_result);
}

std::vector<Index> Matching::left_of_original() const
{
  return left(match_of_original);
}

bool Matching::is_one_empty() const
{
  const auto is_none = [](Index piece) { return piece == no_piece; };
  const std::vector<Index>&now = result.numbered.of_triangle, &before = original.numbered.of_triangle;
  return std::all_of(now.begin(), now.end(), is_none) || std::all_of(before.begin(), before.end(), is_none);
}

void Matching::match(std::vector<Index> of_original, std::vector<Index> of_result, Matched_by by)
{
  const Index number = Index(found.matches.size());
  const auto enter = [&](std::vector<Index>& matches, const std::vector<Index>& pieces) {
    for (const Index piece : pieces) {
      if (matches[piece] != no_piece)
        found.matches[matches[piece]] = {};
      matches[piece] = number;
    }
  };
  enter(match_of_original, of_original);
  enter(match_of_result, of_result);
  found.matches.push_back({std::move(of_original), std::move(of_result), by});
}

void Matching::match_one_to_one(std::vector<Possible_match> possible, Matched_by by)
{
  for (const auto& [r, o] : one_to_one(std::move(possible), result.pieces().size(), original.pieces().size()))
    match({o}, {r}, by);
}

const Lists& Matching::reach()
{
  if (!m_reach)
    m_reach = within_reach(*this);
  return *m_reach;
}

const std::vector<Index>& Matching::positions_nearby()
{
  if (!m_positions_nearby)
    m_positions_nearby = near_positions(*this);
  return *m_positions_nearby;
}

const Pieces_in_file* Matching::pieces_in_file()
{
  if (options.triangles_in_file.size() != result.soup.triangles.size())
    return nullptr;
  if (!m_pieces_in_file)
    m_pieces_in_file.emplace(result, options.triangles_in_file, original);
  return &*m_pieces_in_file;
}

} // namespace selvedge::internal
