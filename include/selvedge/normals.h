// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_NORMALS_H
#define SELVEDGE_NORMALS_H

#include <selvedge/Triangle_soup.h>

#include <cstddef>
#include <vector>

namespace selvedge {

/// What a reduction does with the normals that a file has for the corners of its triangles.
///
/// A normal that is kept makes an edge a *line* (Border_rule.h) where it differs on both sides, and vertices
/// of a line move only along it. That is right for hard edges, and freezes a mesh in which every triangle has
/// normals of its own.
enum class Normals_choice {
  automatic, ///< as `mend`; but those that are kept then give way to others, with which the result shades
             ///< most like the original (`fit_normals`). The program takes `loose` or `soft` for it where
             ///< `suited_to` does
  keep,      ///< every corner of the result has a normal that some corner of the input has, bit for bit
  mend,      ///< flat normals are made anew for the faces that change (`keep_flat_normals`); all others are
             ///< kept, those that are nearly alike at a vertex as one (`join_near_normals`), and mended
             ///< (`mend_normals`)
  loose,     ///< as `automatic`; but different normals make no lines: every corner gets that normal of its
             ///< vertex which suits its triangle best (`pick_normals`), before they are fitted
  soft,      ///< as `automatic`; but normals make no lines at vertices on soft lines (`are_on_soft_lines`),
             ///< where corners get normals as with `loose`
  recompute, ///< the result gets new normals, made as those of the input seem to be made
  smooth,    ///< as `automatic`, with smooth normals in place of those of the input (`smooth_normals`)
  drop       ///< the result has no normals
};

/// What was done with the normals of a soup.
enum class Normals_treatment {
  none,     ///< the soup has no normals
  kept,     ///< they are treated like any other attribute
  mended,   ///< as kept; but those that were nearly alike at a vertex are one, and a corner gets a new one
            ///< where its own is too far from that of its triangle
  picked,   ///< every corner gets one of those that its vertex has in the input, or a new one as in mended,
            ///< and they are then fitted
  softened, ///< as picked at vertices on soft lines, and as fitted at others
  fitted,   ///< as mended, and then fitted to the shading of the input
  smoothed, ///< as fitted, with smooth normals in place of those of the input
  flat,     ///< every corner gets the normal of its triangle, or of the polygon or face (`keep_flat_normals`)
            ///< that this is a part of, bit for bit that of the input where it has not changed
  smooth,   ///< every corner gets the mean normal of the triangles around its vertex, up to hard edges
  dropped
};

/// Returns the word for this in options and reports: auto, keep, mend, loose, soft, recompute, smooth or
/// drop.
const char* name_of(Normals_choice choice);

/// Returns the word for this in reports: none, kept, mended, picked, softened, fitted,
/// smoothed, flat, smooth or dropped.
const char* name_of(Normals_treatment treatment);

/// Returns whether a reduction keeps the normals, but those that are nearly alike at a vertex as one, and
/// then mends or fits them.
inline bool are_joined(Normals_treatment treatment)
{
  return treatment == Normals_treatment::mended || treatment == Normals_treatment::fitted;
}

/// Returns whether corners of a result get others of the normals of their vertices (`pick_normals`).
inline bool are_picked(Normals_treatment treatment)
{
  return treatment == Normals_treatment::picked || treatment == Normals_treatment::softened;
}

/// Returns whether a reduction fits the normals to the shading of the input.
inline bool are_fitted(Normals_treatment treatment)
{
  return treatment == Normals_treatment::fitted || treatment == Normals_treatment::smoothed ||
         are_picked(treatment);
}

/// Returns whether a reduction keeps the normals that the prepared soup has, mended or fitted in the end.
inline bool are_kept(Normals_treatment treatment)
{
  return treatment == Normals_treatment::kept || are_joined(treatment) ||
         treatment == Normals_treatment::smoothed || treatment == Normals_treatment::softened;
}

/// Returns whether normals are *flat*: those of 99 % of all corners differ from the normal of their triangle
/// by at most 0.1°, which is what numbers of four decimals tell, or by at most 60° where the three corners
/// have one normal, up to 0.1°: that of a polygon which is not plane. Triangles without an area are not
/// counted. False for a soup without normals, or with normals for some of its triangles only.
///
/// **Complexity** O(n) for n triangles. Computed in double; no decision about intersections depends on it.
bool has_flat_normals(const Triangle_soup& soup);

/// Takes the normals out of a soup that is to be reduced, as far as they are to be made anew, and returns how
/// `restore_normals` has to make them. For `Normals_treatment::smooth` the soup keeps those of
/// `join_normals_between_hard_edges`, so that hard edges, and no others, are lines; for
/// `Normals_treatment::softened`, those of `loosen_soft_lines`.
///
/// Normals that the result is to get again, be they flat or picked, go to `taken`, unless it is null.
///
/// **Complexity** O(n log n) for n triangles.
Normals_treatment take_normals(Triangle_soup& soup, Normals_choice choice, Corner_values<3>* taken = nullptr);

/// Gives a soup smooth normals in place of its own, if it has any. A normal is the mean of those of the
/// triangles around a position that meet in smooth edges, weighted by the angles there (Thürmer and Wüthrich
/// 1998). An edge of two triangles, with a position at each end, is smooth where the triangles turn by at
/// most 60°, or where one of them has no area. It has the precision of 32-bit floats.
///
/// **Complexity** O(n) expected for n triangles. Computed in double.
void smooth_normals(Triangle_soup& soup);

/// Returns whether vertices that differ in their normals alone become one, with
/// `share_vertices_without_normals`, before normals are taken.
bool joins_vertices(Normals_choice choice);

/// Gives each corner the first of the normals at its vertex, in the order of triangles, that differs from its
/// own by at most 0.1°, and is not replaced itself. Such normals look alike in 256 shades; they come from
/// arithmetic or from few decimals, and would make a line of an edge that nobody sees.
///
/// **Complexity** O(n) for n triangles and bounded numbers of normals at a vertex.
void join_near_normals(Triangle_soup& soup);

/// Gives the corners between two hard edges around a vertex the normal of the first of them. An edge is hard
/// where the normals on its two sides differ by more than 1° at one of its ends.
///
/// **Complexity** O(n log n) for n triangles.
void join_normals_between_hard_edges(Triangle_soup& soup);

/// Makes triangles share the vertices that differ in nothing but their normals, for a soup from a file that
/// has one normal for each vertex (PLY, glTF). Such a file has several vertices where normals differ; without
/// normals they are one, and no line between them is kept.
///
/// Triangles then name the first of such vertices, and the others are unused. Corners keep their normals.
/// Alike, bit for bit, must be positions in all poses (where −0 is 0), attributes, and texture coordinates if
/// they are those of vertices; in a glTF scene the node and all accessors but NORMAL and TANGENT, those of
/// morph targets included; and unless normals are dropped, so that tangents stay, the side of TANGENT. With
/// `Normals_choice::soft`, only vertices on soft lines become one.
/// Where vertices of different tangents become one, the scene alone has tangents then.
/// Vertices that differ in nothing at all stay apart, as pieces that lie beside each other, unless a third
/// one differs from them in its normal, or every face has vertices of its own (at least 100 triangles, and
/// twice as many vertices).
///
/// Returns how many corners name another vertex now. Does nothing where a vertex has two normals, unless
/// they are nearly alike (`join_near_normals`).
///
/// **Complexity** O(n) expected for n triangles.
std::size_t share_vertices_without_normals(Triangle_soup& soup, Normals_choice choice = Normals_choice::drop);

/// Makes the normals of a reduced soup where they are flat or smooth. They have the precision of 32-bit
/// floats. A mean is weighted by the angles at the vertex (Thürmer and Wüthrich 1998). Where it is more than
/// 90° from the normal of a triangle, as at a fold, that triangle has its own there, so that its front is not
/// shaded as its back. A triangle without an area has the normal (0, 0, 1).
void restore_normals(Triangle_soup& soup, Normals_treatment treatment);

/// Gives triangles with flat normals those of the original again, bit for bit, where they still are theirs:
/// all corners are where they were, or the normals differ from those made anew by at most 0.1°. Triangle i is
/// what is left of triangle `triangles[i]` of the original, whose corners have `normals`. Normals that are
/// kept have the least numbers, in their order.
///
/// Several triangles may be one *face*, with one normal, the direction of its area: those of a polygon, and
/// those that meet in an edge of two triangles at both ends of which their originals have the same normals,
/// as the two triangles of a square have. Such an edge is still smooth where the normals made anew of both
/// differ from those of the originals by at most 15°. A face keeps its normals if all its triangles do.
///
/// **Complexity** O(n log n) for n triangles and normals of the original.
void keep_flat_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                       const Triangle_soup& original, const Corner_values<3>& normals);

/// Gives the corners of a result normals of the original, whose corners have `normals`. A triangle of which
/// nothing has changed gets its own. Any other corner gets that normal at its vertex which is nearest to the
/// normal of its triangle, or to that of its back if the normals of the original point there on average.
/// Triangle i is what is left of triangle `triangles[i]` of the original, and has its corners from the
/// corners `corners[i]`, numbered as 3 × triangle + place.
///
/// If the original has normals itself, those of its corners that have one of them at a vertex are a *fan*. A
/// corner then gets normals of its fan only: the first of them where all differ from that of the fan by at
/// most 0.1°, or what it has if that is no longer the fan's, as at a new place.
///
/// **Complexity** O(n) for n triangles, when the numbers of triangles at vertices are bounded.
void pick_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                  const std::vector<Index_triple>& corners, const Triangle_soup& original,
                  const Corner_values<3>& normals);

/// Gives corners of a result new normals where those that they have kept belong to another side of the
/// surface, so that no part of it is shaded as its inside or its edge. They come from across a hem, say: a
/// vertex there brings its normal along when it comes to bound faces of this side. A normal is replaced where
/// it is farther from that of its triangle than 60°, and than all three were in the original. The back of a
/// triangle is taken for its front where its normals in the original point there on average. Triangle i is
/// what is left of triangle `triangles[i]` of the original, whose corners have `normals`.
///
/// With it go those of the corners around the vertex that have the same normal, up to 1°, or need a new one
/// as well, where their triangles meet in edges at which they turn by at most 60°: no crease comes where none
/// was. Triangles that have not changed keep their normals. The new normal is the mean of those of these
/// triangles, weighted by the angles there (Thürmer and Wüthrich 1998), or that of the triangle alone where
/// the mean is more than 60° from it. It has the precision of 32-bit floats. Returns how many corners have a
/// new one.
///
/// **Complexity** O(n) for n triangles, and O(n log n) if any corner needs a new normal. Computed in double.
std::size_t mend_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                         const Triangle_soup& original, const Corner_values<3>& normals);

/// Gives corners of a result the normals with which its surface shades most like the original: those that,
/// interpolated over each triangle, are nearest to those of the original there, in the sense of least
/// squares. A normal that is kept is right at its vertex alone; on large triangles it also shades what was
/// far from there. Triangle i is what is left of triangle `triangles[i]` of the original, whose corners have
/// `normals`, and has its corners from the corners `corners[i]`, numbered as 3 × triangle + place.
///
/// The original is sampled at three points of every triangle. A sample counts for the triangle of the result
/// that is nearest, of those of the same surface (what is connected by positions) that face the same side, if
/// it is at most four times as far as any other. Corners that had one normal at one position, up to 0.1°,
/// have one again, so that hard edges stay hard and others smooth, but where a bevel is gone: there, parts
/// between which triangles turn by more than 40° get normals of their own, if the common one is farther than
/// 40° from a triangle and at least half of the squared error around goes by this. A normal stays, bit for
/// bit, where no triangle that has it has changed, at triangles of the original that `stays` names (by
/// triangle; empty: none), where the new one would differ by at most 0.1°, and on borders, where a mesh of
/// another file or the next place of this one may go on, unless the new one would differ by more than 20°. No
/// new one is farther from the normal of a triangle (or of its back, if the normals of the original point
/// there on average) than 78.4°, of which the cosine is 0.2, unless the old one was farther: it is a mean
/// with the old one then, or the old one. New ones have the length 1 and the precision of 32-bit floats.
/// Returns how many corners have a new one.
///
/// **Not promised** The further poses of a mesh are not asked, nor what morph targets add. Where a pose bends
/// a surface as it is bent, or more, new normals are nearer to those of the original there, too; where it
/// bends it the other way, they may be farther.
///
/// **Complexity** O(n log n) as a rule for n triangles of the original. Computed in double.
std::size_t fit_normals(Triangle_soup& result, const std::vector<Index>& triangles,
                        const std::vector<Index_triple>& corners, const Triangle_soup& original,
                        const Corner_values<3>& normals, const std::vector<char>& stays = {});

} // namespace selvedge

#endif // SELVEDGE_NORMALS_H
