// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "blind_spots.h"

#include "text.h"

#include <algorithm>
#include <cstddef>

namespace selvedge::app {
namespace {

std::string pieces_matched(const Piece_matching& matching, Matched_by by)
{
  std::size_t count = 0;
  for (const Piece_match& match : matching.matches)
    count += match.by == by ? match.of_result.size() : 0;
  return count == 0 ? "" : counted(count, "piece");
}

} // namespace

std::vector<std::string> blind_spots(const Verification& verification, const Comparison& comparison)
{
  const Piece_matching& matching = verification.matching;
  std::vector<std::string> lines{
      "what happened on the way: a layer that passed through another and came back; a log shows it, see "
      "selvedge replay"};

  if (verification.is_original_rounded)
    lines.push_back(
        "what rounding did to the original: it was rounded to 32-bit floats before it was compared");

  const Layer_order& layers = comparison.layers;
  lines.push_back("the order of layers between the " + counted(layers.lines, "line") +
                  " that were drawn, and at " + with_commas(layers.pairs - layers.compared) + " of " +
                  counted(layers.pairs, "place") + " where they could not tell");

  double farthest = 0;
  for (const Piece_match& match : matching.matches)
    farthest = (std::max)(farthest, match.distance);
  lines.push_back(
      "parts that a piece has lost at its borders or got there, and places to which it has moved, "
      "up to a quarter of its size in the mean; the most of any piece is " +
      with_digits(100 * farthest) + " %");
  lines.push_back("faces that turned over, unless nine tenths of a piece did; the normals say how many");

  if (const std::string some = pieces_matched(matching, Matched_by::distance); !some.empty())
    lines.push_back("whether " + some +
                    " without the original's vertices are what became of the pieces that lie nearest");
  if (const std::string some = pieces_matched(matching, Matched_by::positions); !some.empty())
    lines.push_back("cuts and joins between vertices at one position, in " + some +
                    ": the files number vertices differently there");
  if (const std::string some = pieces_matched(matching, Matched_by::borders); !some.empty())
    lines.push_back("boundary loops and Euler characteristics of " + some +
                    " whose borders were joined, and whether these borders should have been");

  for (const std::string& kind : matching.names_not_compared)
    lines.push_back("exchanged names of " + kind +
                    "s: only one of the files has any, or they have none in common");
  lines.push_back("names that were exchanged in less than half of a patch of faces of one name");
  lines.push_back("values of attributes such as texture coordinates that are gone, exchanged or not the "
                  "original's at their position: they are counted, and not judged");
  lines.push_back(
      "pairs of pieces that lie at the same positions and have exchanged their places in the file");
  return lines;
}

} // namespace selvedge::app
