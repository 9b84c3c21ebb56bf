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

std::vector<std::string> blind_spots(const Verification& verification, const Comparison& comparison,
                                     bool is_gltf)
{
  const Piece_matching& matching = verification.matching;
  std::vector<std::string> lines{
      "what happened on the way, such as a layer that passed through another and came back; a log shows it "
      "(selvedge replay)"};

  if (verification.is_original_rounded)
    lines.push_back(
        "what rounding did to the original: it was rounded to 32-bit floats before it was compared");

  if (!verification.poses.empty())
    lines.push_back("the order of layers, borders, seams, normals and the mean distance in " +
                    counted(verification.poses.size(), "further pose") +
                    ": they are those of the mesh's own pose");

  const Layer_order& layers = comparison.layers;
  lines.push_back("the order of layers between the " + counted(layers.lines, "line") +
                  " that were drawn, and at " + with_commas(layers.pairs - layers.compared) + " of " +
                  counted(layers.pairs, "place") + " where they could not tell");

  double farthest = 0;
  for (const Piece_match& match : matching.matches)
    farthest = (std::max)(farthest, match.distance);
  lines.push_back(
      "what a piece has lost or gained at its borders, and where it has moved to, up to a "
      "quarter of its size "
      "on average, or 1 % of the diagonal where little is left of a small one; the most of any piece "
      "is " +
      with_digits(100 * farthest) + " %");
  lines.push_back("faces that turned over, unless they make up nine tenths of a piece and turn its border, "
                  "if it has one; the normals say how many");

  if (const std::string some = pieces_matched(matching, Matched_by::distance); !some.empty())
    lines.push_back("whether " + some +
                    " without the original's vertices come from the pieces of the original that lie nearest");
  if (const std::string some = pieces_matched(matching, Matched_by::positions); !some.empty())
    lines.push_back("cuts and joins between vertices at one position, in " + some +
                    ": the files number vertices differently there");
  if (const std::string some = pieces_matched(matching, Matched_by::borders); !some.empty())
    lines.push_back("boundary loops and Euler characteristics of " + some +
                    " whose borders were joined, and whether these borders should have been");

  for (const std::string& kind : matching.names_not_compared)
    lines.push_back("exchanged names of " + kind +
                    "s: only one of the files has any, or they have none in common");
  lines.push_back("names that were exchanged in less than half of a patch of faces with one name");
  lines.push_back("values of attributes, such as texture coordinates, that are missing, exchanged or not the "
                  "original's at their position: they are counted, not judged");
  lines.push_back("layers that meet at one position, corner on corner: there they count as joined");
  if (is_gltf)
    lines.push_back("morph targets, skins and animations of glTF files, whether lost or changed, but for the "
                    "poses that were given");
  lines.push_back("pieces at the same positions that have changed places in the file");
  return lines;
}

} // namespace selvedge::app
