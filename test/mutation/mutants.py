# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The mutants that run.py judges, by the file that they change. Each is an error that could have been made."""

import dataclasses


@dataclasses.dataclass
class Mutant:
    file: str
    old: str  # stands in the file exactly once
    new: str
    reason: str  # what is wrong then
    tests: tuple  # "name" or "name:filter" of those that should see it, the quickest first
    sources: tuple = ()  # of the library, to be compiled anew as well for a mutant in a header
    equal: str = ""  # why it is no error, for those that are none


ALL = []


def group(file, tests, *entries, sources=()):
    for old, new, reason, *equal in entries:
        ALL.append(Mutant(file, old, new, reason, tests, sources, *equal))


headers = "include/selvedge/"

group(
    headers + "internal/exact_predicates.h",
    ("no_directed_rounding",),
    ("    if (!(value.inf() < value.sup()))", "    if (!(value.inf() <= value.sup()))",
     "intervals that hold nothing pass for those that hold the value"),
)

group(
    headers + "geometry/internal/Separation_filter.h",
    ("separation_filter_test",),
    ("m_area_error = 0x1p-44", "m_area_error = 0x1p-53", "bound for areas too small"),
    ("m_volume_error = 0x1p-40", "m_volume_error = 0x1p-53", "bound for volumes too small"),
    ("m_length_error = 0x1p-48", "m_length_error = 0x1p-56", "bound for lengths too small"),
    ("if (!(distance <= m_extent))", "if (!(distance <= m_extent) && m_points.size() < 4)",
     "extent not grown after the fourth point"),
    ("s_least_normal = 1e-150", "s_least_normal = 0", "no least length of a normal"),
    ("        return 0;\n      result |= Mask(1) << p;", "        continue;\n      result |= Mask(1) << p;",
     "masks skip points that have no bit"),
    ("m_points[triangle[0]].outside & m_points[triangle[1]].outside &",
     "m_points[triangle[0]].outside &", "a corner of the face not compared with the box"),
    ("seen.outside |= unsigned(x < m_lower[i] - m_length_error)",
     "seen.outside |= unsigned(x <= m_lower[i])", "what touches the box is outside"),
    ("int(area < -m_area_error)", "int(area < 0)", "a side known without a bound"),
    ("p == i || p == j || side(i, j, p) == far;", "p == i || p == j || side(i, j, p) != -far;",
     "points of which no side is known are on the far side"),
    ("result.below |= Mask(height < -m_volume_error)", "result.below |= Mask(height < m_volume_error)",
     "points in a plane are below it"),
    ("&&\n             (corners & ~points) != 0;", ";", "a face is clear of a sweep that has its three corners"),
    ("result.lower = result.upper = internal::dot(result.normal, (*this)[point]);",
     "result.lower = result.upper = internal::dot(result.normal, (*this)[triangle[0]]);", "a slab forgets its point"),
    ("b > slab.upper + m_volume_error", "b > slab.lower", "a face within a slab is above it"),
    ("near == side(i, j, tetrahedron[d]) &&", "true &&", "a plane with one corner of the sweep on the wrong side"),
    ("m_extent > s_least && m_extent < s_largest", "true", "usable where products underflow and overflow"),
)

group(
    headers + "geometry/internal/Star_pack_filter.h",
    ("star_pack_filter_test",),
    ("s_rounding = float(16 * s_unit)", "s_rounding = float(s_unit / 16)", "bounds for single precision too small"),
    ("m_is_above[k] = ~are_all_shared & (", "m_is_above[k] = (", "a face is clear of a sweep that has its three corners"),
    ("is_left &= m_is_corner[corner][a] | (side > error);", "is_left &= m_is_corner[corner][a] | (side > -error);",
     "a side known without a bound"),
    ("are_clear &= is_beyond | is_right | was_left;", "are_clear &= is_beyond | is_right | is_left;",
     "the left of the wrong ray"),
    ("add_edge_between({a, b, s_from, s_to}, is_clear);", "add_edge_between({a, b, s_from, s_from}, is_clear);",
     "a sweep without its goal"),
    ("(is_own_left & (is_shared | (side < -error)))", "(is_own_left & (is_shared | (side < error)))",
     "points on an edge of the face are beyond it"),
    ("const Answers is_shared = m_is_corner[edge][k] | m_is_corner[next][k];",
     "const Answers is_shared = m_is_corner[edge][k] | m_is_corner[third][k];", "the wrong corners lie on an edge"),
    ("float(slab.upper * inverse * m_scale)", "float(slab.lower * inverse * m_scale)", "a slab without its upper side"),
    ("clear<4>(pack, 4) << 4", "clear<4>(pack, 0) << 4", "plain instructions ask the first half twice"),
    ("m_reach <= s_largest_reach ? m_reach * s_rounding : nothing", "m_reach * s_rounding",
     "triangles too large for floats"),
)

group(
    headers + "geometry/internal/Projected_star.h",
    ("projected_star_test",),
    ("{m_star, of_lines.negative,", "{m_star, of_lines.positive,", "inside and outside of the rim exchanged"),
    ("(a.right & b.right & c.right)", "(a.right & b.right)", "a corner not compared with a ray"),
    ("turned(a.left & b.left & c.left)", "(a.left & b.left & c.left)", "rays at the wrong end of the edges"),
    ("m_all = ~Mask(0) >> (s_max_edges - edges.size());", "m_all = ~Mask(0) >> (s_max_edges - edges.size() + 1);",
     "the last sector forgotten"),
    ("const double error = view.area_error();", "const double error = 0x1p-9 * view.area_error();",
     "bound for areas too small in the shadow"),
    ("std::array<Index, 3>{m_from, (*m_edges)[j][0],", "std::array<Index, 3>{(*m_edges)[j][1], (*m_edges)[j][0],",
     "a sector without its vertex"),
)
group(
    headers + "geometry/internal/Projected_star.h",
    ("guard_test",),
    ("if (sides.star == m_star)", "if (sides.star != 0)", "sides of an earlier star"),
)
group(
    headers + "internal/instructions.h",
    ("projected_star_test",),
    ("least = _mm_set1_pd(-error);", "least = _mm_set1_pd(error);", "points on a line are right of it"),
)

group(
    "src/verify/Capsule.cpp",
    ("triangle_tree_test",),
    ("radii = a.m_radius + b.m_radius", "radii = a.m_radius", "a capsule without its radius"),
    (" + a.m_radius,", ",", "a capsule around capsules forgets the radius of one"),
    ("(std::max)(distance(other[0], segment), distance(other[1], segment))", "distance(other[0], segment)",
     "a capsule around capsules forgets an end"),
    ("0x1p-44 * largest", "0x1p-84 * largest", "no margin for rounding"),
)
group(
    "src/verify/Triangle_tree.cpp",
    ("triangle_tree_test",),
    ("std::sqrt(squared_bound) + margin", "std::sqrt(squared_bound) / 2 + margin", "slivers within the bound are passed by"),
    ("met[12 + i] << 12;", "met[8 + i] << 12;", "the last box of a quad meets what the third does"),
)
group(
    "src/verify/Triangle_tree.h",
    ("triangle_tree_test",),
    ("* 0x1p-21f + 0x1p-70f", "* 0x1p-30f + 0x1p-70f", "boxes have less room than rounding takes"),
    ("0b0000'1000'1100'1110", "0b0000'0000'1100'1110", "the last two boxes of a quad are no pair"),
    sources=("src/verify/Triangle_tree.cpp",),
)
group(
    "src/verify/distances.cpp",
    ("verify_distances_test",),
    ("m_points[m_table[slot]] != p", "m_points[m_table[slot]].x() != p.x()", "places on one plane are one"),
    ("const std::vector<Index> vertices = used_vertices(soup);",
     "std::vector<Index> vertices(m_points.size());\n    std::iota(vertices.begin(), vertices.end(), Index(0));",
     "vertices that no triangle has are on the surface"),
)

group(
    headers + "geometry/sweep.h",
    ("geometry_sweep_test", "sweep_test"),
    ("return is_flat();", "return true;", "a face inside the wedge of a sweep is clear"),
    ("side[k][0] == side[k][1] && side[k][0] != m_sign)", "side[k][0] == side[k][1])",
     "a face on the inner side of a facet is clear"),
    ("height[0] == height[1] && height[0] == height[2]", "height[0] == height[1]", "one ray of a cone not looked at"),
    ("return turn != CGAL::ZERO && planar_orientation(x, u, w) != -turn",
     "return turn != CGAL::ZERO && planar_orientation(x, u, w) == turn", "a ray on the rim of a flat cone is beside it"),
    ("return side != CGAL::ZERO || is_disjoint_in_plane<n>(f);", "return true;", "all in one plane is clear"),
    ("side[2][j] != CGAL::NEGATIVE && side[3][j] != CGAL::NEGATIVE)",
     "side[2][j] != CGAL::NEGATIVE && side[3][j] == CGAL::POSITIVE)", "a corner on a facet of a sweep is not in it"),
    ("return uv * wu != CGAL::NEGATIVE && vw * wu", "return uv * wu == CGAL::POSITIVE && vw * wu",
     "an edge through the rim of a triangle does not pierce it"),
    ("return shared == 2 && is_clear_at_edge", "return is_clear_at_edge", "a face may end on top of another"),
    ("k == i || k == j || planar_orientation(*own[i], *own[j], *own[k]) != far;", "true;",
     "a line with its own points on both sides separates"),
)

group(
    headers + "geometry/star.h",
    ("geometry_star_test", "star_test"),
    ("return next == 0 && length == link.size();", "return next == 0;", "a part of the link is a cycle"),
    ("if (orientation(*q, motion.to, edge[0], edge[1]) != turn)",
     "if (orientation(*q, motion.to, edge[0], edge[1]) == -turn && false)", "the star not looked at after the motion"),
    ("planar_orientation(edge[0], edge[1], motion.from) == planar_orientation", "CGAL::ZERO != planar_orientation",
     "a face may turn over through a line"),
    ("if (&other != &edge && !sweep.is_clear(other[0], other[1]))", "if (&other > &edge && !sweep.is_clear(other[0], other[1]))",
     "of two faces only one is compared with the other"),
    ("for (const auto& other : motion.contracted) {\n      if (!sweep", "for (const auto& other : motion.contracted) {\n      if (false && !sweep",
     "contracted faces not looked at"),
)

loop = headers + "Surface_mesh_simplification/internal/"
group(
    loop + "Intersection_guard.h",
    ("guard_test",),
    ("if (is_held(motion) || !m_star.gather(motion)", "if (!m_star.gather(motion)", "coincident vertices move"),
    ("return !face_at_place || refuse(*face_at_place);", "return true;", "a place where another vertex is"),
    ("return verdict != Star_verdict::refused;", "return true;", "what the star says is not heard"),
    ("      m_faces.add_all_at(*motion.target, mover, m_near);", "      ;",
     "faces at a target that has moved are not in the way"),
    ("m_unclear.resize(m_near.size(), ~Sweeps(0));", "m_unclear.resize(m_near.size(), Sweeps(0));",
     "of faces that no pack has judged, all sweeps are clear"),
    ("return !m_is_mover_first || are_both_clear(collapse.mover(), collapse.goal());", "return true;",
     "a place that is clear in no order is taken"),
)
group(
    loop + "Moving_star.h",
    ("guard_test",),
    ("return is_edge_border || m_is_closed || !is_end_on_border;", "return true;", "two borders meet"),
    ("if (!m_vertices.is_coincident(number)) {", "if (true) {", "neighbours of coincident vertices not looked at"),
    ("m_is_closed && m_size + m_has_target == m_link.size() + 2;", "m_is_closed;", "links that wind twice are cycles"),
    ("for (std::size_t i = 0; i < m_size; ++i)", "for (std::size_t i = 0; i < 2; ++i)", "only the way is asked of the index"),
    ("if (!is_contracted && goal && (first == s_to || second == s_to))", "if (false)",
     "a face beside the edge has a corner at the target",
     "the star is judged with this corner at the target's place, where the face has no area, and refused as well"),
)
group(
    loop + "Star_view.h",
    ("guard_test",),
    ("(!m_star.is_contracted(j) && m_view.side(s_to, a, b) != 1)", "(!m_star.is_contracted(j) && m_view.side(s_to, a, b) == -1)",
     "the star not surely clear after the motion"),
    ("        return false;\n    }\n    m_projection.begin", "        break;\n    }\n    m_projection.begin", "a star that is not clear counts as clear"),
    ("m_star_mask = m_view.mask(m_star_points);", "m_star_mask = m_view.mask(m_star_points) | 1;",
     "stars of more points than bits are known by one"),
)
group(
    loop + "Vertex_table.h",
    ("guard_test",),
    ("if (!is_coincident(v))\n      mark_one", "if (true)\n      mark_one", "coincident vertices are not one point"),
    ("std::replace(all.begin(), all.end(), target, kept);", "", "classes of coincident vertices do not follow"),
)
group(
    loop + "Face_table.h",
    ("guard_test",),
    ("m_index.set(id, box(id), coordinates());", "(void)id;", "the index does not follow"),
    ("        m_corners[id] = find_corners(h);\n", "", "corners do not follow"),
)
group(
    loop + "Collapse.h",
    ("guard_test", "policies_test", "motion_test"),
    ("place != profile.p0(), place != profile.p1(),", "place != profile.p0(), place == profile.p0(),", "the second motion to a new place is not judged"),
)
group(
    loop + "Collapse.h",
    ("replay_test:Replay.Accepts*",),
    ("!is_onto_v0, is_onto_v0, is_onto_v0)", "is_onto_v0, !is_onto_v0, is_onto_v0)", "the limits judge the end that stays"),
    sources=("src/simplify/simplify_soup.cpp",),
)

group(
    headers + "Surface_mesh_simplification/Border_rule.h",
    ("spokes_test",),
    ("(is_line_at_target(h) || takes_needed_spoke(h, *this))", "takes_needed_spoke(h, *this)", "a vertex comes along a spoke"),
    ("(is_line_at_target(h) || takes_needed_spoke(h, *this))", "is_line_at_target(h)", "one line is left at a pole"),
    ("bool(get(state.marks, in)) && (!moves || is_line_at_target(at))", "bool(get(state.marks, in))",
     "a line along which a pole goes stays where nothing differs"),
    ("return may_take_spokes(mover, get(state.points, target(h, state.mesh))) ? Line_refusal::none", "return true ? Line_refusal::none",
     "what a cut has passed is far from it when its end has moved"),
    ("(is_line_at_start && lines.is_line_at_target(to_apex))", "false", "a face between two lines and a spoke vanishes"),
)
group(
    "src/soup/keeps_pieces.cpp",
    ("spokes_test",),
    ("  if (ends_cut && (", "  if (false && (", "a cut into a piece joins another"),
)
group(
    "src/soup/poles.cpp",
    ("gltf_poles_test",),
    ("s_least_spokes = 3;", "s_least_spokes = 2;", "a short cut in the texture is a pole"),
    ("s_least_spokes = 3;", "s_least_spokes = 4;", "poles of three edges stay apart"),
    ("      if (are_alike(a, b))\n", "", "vertices of several colours become one"),
    ("is_at_pole[v] |= !have_same_bits(uv(first[v]), uv(corner));", ";", "corners at poles lose their texture coordinates"),
)
group(
    "src/soup/flat_shading.cpp",
    ("gltf_poles_test",),
    ("  separate_poles(soup);\n", "", "what normals cut apart at a pole stays apart"),
    ("  share_poles(soup);\n", "", "poles stay apart where normals are dropped"),
)
group(
    "src/files/ply_writer.cpp",
    ("gltf_poles_test",),
    ("with_uvs_of_vertices(soup))", "std::optional<Triangle_soup>())", "vertices of a pole lose their texture coordinates in PLY"),
)
group(
    "src/replay/Complex.cpp",
    ("spokes_test",),
    ("edge.is_seam && is_line_at_kept", "edge.is_seam", "lines stay where nothing differs"),
)
group(
    "src/replay/limits.cpp",
    ("spokes_test",),
    ("    if (takes_needed_line(complex, removed, kept))\n      return Violation_kind::line;\n", "", "one line is left at a pole"),
    ("    if (ends_at_other)\n      return Violation_kind::line;\n", "",
     "a vertex comes along a spoke"),
    ("return m_limits.border_drift && edge.is_line_beyond() &&", "return false && edge.is_line_beyond() &&", "what a cut has passed may be far from it"),
)
group(
    headers + "Surface_mesh_simplification/Border_rule.h",
    ("placement_test",),
    ("||\n        is_cut_off(profile.v0_v1(), *this))", ")", "a face whose edges are all lines vanishes"),
)
for file, *entry in (
    ("src/soup/Gltf_scene.cpp", '} else if (column.name != "NORMAL") {', "} else {", "normals keep vertices of glTF apart"),
    ("src/soup/flat_shading.cpp", "is_shared[v] = have_faces_own || has_uv(v);", "is_shared[v] = true;",
     "pieces beside each other are joined"),
    ("src/soup/flat_shading.cpp", "is_shared[v] = have_faces_own || has_uv(v);", "is_shared[v] = have_faces_own;",
     "vertices that differ in nothing are a seam of the texture"),
    ("src/soup/Gltf_scene.cpp", '(column.name == "NORMAL" || column.name == "TANGENT" ?', "(false ?",
     "normals of targets keep vertices apart whose normals are dropped"),
    ("src/soup/flat_shading.cpp", "append_point(pose.points[vertex]);", ";", "vertices that part in a pose are joined"),
    ("src/soup/normals.cpp", "is_in_its_place(t) || is_made_within(t, s_cosine_flat)", "true",
     "faces keep normals that are no longer theirs"),
    ("src/soup/normals.cpp", "is_in_its_place(t) || is_made_within(t, s_cosine_flat)", "false",
     "all flat normals are made anew"),
    ("src/soup/normals.cpp", "sets.unite(t, u);", ";", "squares that bend get two normals"),
    ("src/files/gltf_writer.cpp", "m_soup.normals.empty() && !m_is_scene_made", "false", "dropped normals stay in glTF"),
):
    group(file, ("flat_shading_test",), tuple(entry))
for file, entry in (
    ("Place_rounding.cpp", ("rounded[i] = nearest_float32(rounded[i]);", ";", "places are no 32-bit floats")),
    ("Place_rounding.cpp", ("if (m_is_allowed && !m_is_allowed(result))", "if (false)", "places leave their cell")),
    ("keeps_uv_orientation.cpp",
     ("before == CGAL::COLLINEAR || CGAL::orientation(point(uv), ahead, behind) == before;", "true;",
      "triangles of the texture turn over")),
    ("Sewn_mesh.cpp", ("  lock(is_new);\n", "", "vertices that the user locks move")),
):
    group("src/soup/" + file, ("placement_test", "worlds_test"), entry)

group("src/soup/smooth_normals.cpp", ("smooth_normals_test",),
      ("front == Vector{} || other == Vector{} || internal::dot(front, other) >= s_cosine_of_hard_edge", "true", "hard edges are shaded smooth"),
      ("      fans.unite(a.at_high, b.at_high);\n", "", "one end of each edge is shaded hard"),
      ("in_positions(soup.triangles, number_positions(soup.points))", "soup.triangles", "seams of the texture are hard edges where normals are made anew"),
      ("angle * fronts[corner / 3][i]", "fronts[corner / 3][i]", "smooth normals lean to where many faces meet"),
      ("  if (soup.scene)\n    add_normals_to_scene(soup);\n", "", "scenes without normals stay without"))
group("src/replay/Start.cpp", ("smooth_normals_test",),
      ("return smooth_normals(soup);", "return;", "the replay does not make normals smooth"))
group("src/soup/vertex_normals.cpp", ("vertex_normals_test",),
      ("    if (!fronts.empty() && fronts[t] != t)\n      continue;\n", "", "doubles count in the normals of vertices"),
      ("is_turned[t] ? -1 : 1", "is_turned[t] ? 1 : 1", "turned faces count as they came"),
      ("sums[positions[corners[k]]]", "sums[corners[k]]", "normals of vertices end at seams"))
group("src/soup/Placed_vertices.cpp", ("placed_vertices_test",),
      (" || m_last->collapse_count != count", "", "values at a new place are those of faces that have changed since"))
group(headers + "Surface_mesh_simplification/Halfedge_placement.h", ("loop_test",),
      (" && !m_rule.may_move(is_v0_free ? profile.v1_v0() : profile.v0_v1())", "", "a pole that moves along a spoke costs less than the bound"))
group(headers + "Surface_mesh_simplification/internal/Value_quadric.h", ("vertex_normals_test",),
      ("motion[k] = m_numbers[s_displacements + k] / weight();", "motion[k] = m_numbers[s_displacements + k];", "a value at a new place is not the best one"))
group("src/simplify/simplify_soup.cpp", ("vertex_normals_test",),
      ("      measure_normals();\n", "", "normals do not count"),
      ("m_prepared.normals != Normals_treatment::flat &&", "", "flat shading counts as smooth"))
derived = ("derived_policies_test",)
group(headers + "Surface_mesh_simplification/internal/Filter_base.h", derived,
      ("    : std::is_same<typename Filter::Judging_filter, Filter>", "    : std::true_type", "a filter around ours is not asked itself"),
      ("if (!is_allowed(m_base, collapse))", "if (false)", "what the base refuses is allowed"))
group(headers + "Surface_mesh_simplification/internal/require_initialised.h", derived,
      ("  policy.require_initialised();\n}", "}", "a cost that no loop has initialised is asked"))
group("src/simplify/simplify_soup.cpp", ("doubles_test",),
      ("is_named[m_working.front(face)]", "is_named[m_working.triangle(face)]", "turned fronts count for the target of a double"),
      ("share_of[t] != share_of[front] && is_frozen[front] == 0", "false", "a double goes though its part has another target"))
group("src/files/gltf_nodes.cpp", ("gltf_poses_test",),
      ("    animate_weights(node.node, numbers);\n", "", "instances that become nodes lose the animation of their weights"),
      ("    forget_weights_of_lost_meshes();\n", "", "channels move the weights of meshes that are gone"))
group("src/files/poses.cpp", ("poses_files_test",),
      ("mesh.triangles[t], pose))\n      continue;", "mesh.triangles[t], mesh))\n      continue;", "vertices that the mesh has made one part in a pose"))
group("src/simplify/prepare.cpp", ("snapping_test",),
      ("    mark_what_stays(stays);\n", "", "parts that are kept snap"))
group("src/soup/fit_normals.cpp", ("fitted_shading_test",),
      ("m_is_fixed[w] |= !is_free[w];", "", "triangles get other normals where nothing has changed"),
      ("[edges[i].second] = true;", "[edges[i].second] = false;", "normals on borders are fitted"),
      (" && is_near_on_border(w, fitted[w])", "", "a face is shaded as the narrow edge of cloth that it replaces"),
      ("surfaces_of(m_original.triangles, m_surface.positions_of_original())", "std::vector<std::size_t>(m_original.triangles.size(), 0)", "a layer is shaded as the one beside it"),
      ("std::min(s_cosine_of_sample, before)", "-2", "fitted normals point to the back"),
      ("keys.emplace_back(m_positions[m_result.triangles[i][k]]", "keys.emplace_back(m_result.triangles[i][k]", "seams of the texture are hard edges where normals are fitted"),
      ("!are_near_normals(normal, m_old[wedge])", "true", "normals that differ in their last digits across a seam are fitted apart"),
      ("if (split_wedges(fitted))", "if (false)", "an edge shades round where its bevel is gone"),
      ("errors_after[w] < (do_suit[w] ? s_share_left_of_split : 1) * errors_before[w]", "errors_after[w] < 0", "no wedge is split, whatever its error"))
group("src/soup/fit_texture.cpp", ("fit_texture_test",),
      ("orientation(result[a], result[b], result[c]) == turn", "true", "a triangle of the texture turns over where it is fitted"),
      ("if (is_within(uv))", "if (true)", "a fitted texture leaves the image"),
      ("<= m_size[i]", "<= 1e300", "a texture is fitted to what lies beyond a cut"),
      ("|| !(is_moved[a] || is_moved[b] || is_moved[c])", "|| !is_moved[a]", "a triangle of the texture turns over after a step back"))
group("src/soup/Fitted_surface.h", ("fit_texture_test",),
      ("result[t] = sets.find(t);", "result[t] = 0;", "the texture of a layer is fitted to the one beside it"),
      ("!is_free(i) && !is_changed(i)", "!is_free(i)", "a face that has changed is no sample of the texture"),
      sources=("src/soup/fit_texture.cpp",))
group("src/soup/fit_attributes.cpp", ("fit_attributes_test",),
      ("std::clamp(best[v][0], low[v][0], high[v][0])", "best[v][0]", "a fitted colour goes beyond a jump"),
      ("values[v] == values[w]", "true", "colours are fitted across a border between them"),
      ("is_fixed[v] = !m_is_free[v];", "is_fixed[v] = false;", "colours of vertices that have not moved are fitted"),
      ("moments[sample.of_result].add(sample.weights, value, sample.weight);", ";", "colours are fitted to nothing"),
      ("if (!std::isfinite(value[0]) ||", "if (", "what has no colour is a sample of one"))
group("src/soup/Vertex_values.cpp", ("gltf_writing_test:Gltf.Colours*",),
      ("if (const Column* const own = components[c].own)", "if (const Column* const own = nullptr)",
       "a soup keeps the colours that are fitted in its scene"),
      ('!begins_with(column.name, "WEIGHTS_");', "true;", "weights of joints are fitted, and lose their sum"),
      ('column.name != "NORMAL" && column.name != "TANGENT"', "true", "tangents are fitted, and lose their length"))
group("src/simplify/simplify_soup.cpp", ("fit_texture_test",),
      ("if (m_options.are_values_fitted)", "if (true)", "results that are thrown away are fitted"))
group("src/files/triangulate_polygon.cpp", ("mesh_files_content_test",),
      ("(is_in(m_points[middle]) ||", "(", "a corner in the middle of others obstructs no ear"),
      ("b.y() > a.y() ? box.xmin() : box.xmax()", "b.y() > a.y() ? box.xmax() : box.xmin()",
       "corners obstruct no ear where some of those around them are beside it"),
      ("const bool is_left = inside == CGAL::LEFT_TURN;", "const bool is_left = true;", "a polygon that turns right has no ears"))
group("src/files/Polygon_starts.h", ("polygons_test",),
      ("return k;", "return 0;", "the two sides of a cloth are cut along other diagonals"))
group("src/files/Written_faces.cpp", ("polygons_test",),
      ("if (m_start_of(m_soup.points, vertices) != 0)", "if (false)", "a polygon is written that is cut otherwise beside its twin"))
group("src/verify/triangles_of_part.h", ("intent_test", "gltf_reading_test"),
      ('name.find_first_of("*?") != std::string::npos', "false", "the judge knows no patterns"),
      ("is_primitive && !name.empty()", "false", "the judge does not know the mesh of a primitive"))
group("src/verify/verify.cpp", ("judge_test",),
      ("(std::min)(pair.first, pair.second) >= mesh.triangles.size()", "false", "the obstacle itself is judged"),
      ("if (of_original[t] >= original.triangles.size())", "if (false)", "triangles of the original may be any number"))
group("src/files/gltf_reader.cpp", ("gltf_instances_test",),
      ("model().nodes[place.node].skin == -1 && hides_all(place.to_world)", "false", "hidden meshes are lost"))
group("src/files/gltf_nodes.cpp", ("gltf_levels_test",),
      ("follow_mesh(n, number);", ";", "an avatar's expressions name a node without a mesh"))
group("src/soup/mend_normals.cpp", ("shading_test",),
      ("is_renewed[fans.find(corner)] = true;", ";", "normals that point to the back are not mended"),
      ("m_is_wrong[3 * t + k] || is_changed", "true", "what has not changed is mended along"),
      ("m_is_wrong[3 * t + k] || is_changed", "m_is_wrong[3 * t + k]", "a crease comes beside a mended normal"),
      ("side != 0 && side * cosines[k] < limit", "true", "normals that are near are mended"),
      ("limit = std::min(limit, side * cosine);", ";", "normals that were as far are mended"),
      ("if (dot(mean, front) < s_cosine_of_shading)", "if (false)", "mended normals point to the back"),
      ("in_positions(m_result.triangles, number_positions(m_result.points))", "m_result.triangles",
       "seams of the texture are hard edges where normals are mended"))
group("src/soup/normals.cpp", ("shading_test",),
      ("if (cosine > highest)", "if (false)", "each corner keeps the normals of its triangle"),
      ("corners[i] == Index_triple{3 * t, 3 * t + 1, 3 * t + 2}", "false", "triangles that have not changed pick other normals"))
group(
    headers + "Surface_mesh_simplification/internal/Tracked_points.h",
    ("tracked_points_test",),
    ("if (least > most * (1 + 1e-6) + rounding)", "if (2 * least > most)", "faces that are nearer are skipped"),
    ("if (beside == 0 && least > rounding)", "if (least > rounding)", "beyond a corner, distances are too small"),
    ("difference(vector(p), vector(m_triangle[0]))", "difference(vector(p), vector(m_triangle[1]))",
     "planes are relative to another corner"),
    ("1 / (length * std::sqrt(dot(sides[i], sides[i])))", "1 / length", "distances beyond long sides are too large"),
    ("are_corners_original ? 4 * squared", "are_corners_original ? 16 * squared", "points far from all corners are near them"),
    ("likely = (likely + 1) % state.candidates.size();", "break;", "at a vertex of many faces only one face can take a point"),
    ("find_near_candidates();\n      state.found.reset();", "find_near_candidates();\n      state.found = question(collapse);",
     "at a vertex of many faces points go to a face that is near, not nearest"),
    ("nearest.second > m_state->squared_near; ++i)", "nearest.second > 1; ++i)", "points go to a face that is far"),
    ("parts[own] != parts[other] || own < other;", "parts[own] != parts[other];",
     "where grids beside a side are alike, neither has its points"),
    ("parts[own] != parts[other] || own < other;", "own < other;", "where grids beside a side differ, one lacks its points"),
    ("return Triangle_grid::parts_of(corners, m_state->max_error) == parts;", "return true;", "points on sides are never compared twice, though they differ"),
    ("return {!is_next_beside || ", "return {", "a side that no other candidate has is not compared"),
    ("if (state.max_error > s_rounding)", "if (true)", "without an error, holes between the points of grids are closed"),
)
group(
    headers + "Surface_mesh_simplification/internal/Triangle_union.h",
    ("triangle_union_test",),
    ("covers(part, i + 1, cuts_left)", "true", "what lies beside one triangle is covered"),
    ("if (!inside.empty() && is_near(inside, m_triangles[i].corners))", "if (!inside.empty())",
     "triangles in another plane cover"),
    ("if (height >= 0)", "if (height > m_distance)", "what is cut off loses the corners at the cut"),
)
group(
    "src/soup/Vertex_values.cpp",
    ("gltf_writing_test:Gltf.ValuesAtNewPlaces*:Gltf.NewPlaces*",),
    ("if (number(joints, row.number, i) == joint)", "if (number(joints, own_row.number, i) == joint)",
     "weights are mixed by their places, not by their joints"),
    ("if (users[instance.block] > 1) {", "if (false) {", "nodes that share a mesh share new places"),
    ("normalize(column, numbers_of_own, numbers);", "normalize(column, numbers, numbers);", "the sign of a tangent is mixed"),
    ("return component == 0 ? result : 1 - result;", "return result;", "texture upside down"),
)
for file, *entry in (
    ("src/soup/flat_shading.cpp", "row.normal == bytes.normal && row.targets != bytes.targets", "false",
     "a ridge that a morph target makes is lost"),
    ("src/soup/flat_shading.cpp", "(m_sharing == Sharing::without_normals ? row.tangent : bytes)", "row.tangent",
     "tangents of both sides of a mirrored texture become one"),
    ("src/soup/flat_shading.cpp", "(m_sharing == Sharing::without_normals ? row.tangent : bytes) += row.side;",
     "if (m_sharing != Sharing::without_normals)\n        bytes += row.side;",
     "other formats get tangents with the side of another"),
    ("src/soup/flat_shading.cpp", "do_tangents_differ |=", "do_tangents_differ &=",
     "other formats get one tangent of several"),
    ("src/files/Local_normals.cpp", "if (cosine > highest)", "if (false)", "tangents are those of a face far away"),
    ("src/files/Local_normals.cpp", "return result.replace(0, turned.size(), turned);", "return result;",
     "tangents are not perpendicular to new normals"),
    ("src/files/Local_normals.cpp", "std::array<double, 3> result = turned(added, before, after);",
     "std::array<double, 3> result = added;", "morph targets add to new normals what suits the old ones"),
    ("src/files/Local_normals.cpp", "result = turned(result, turned(direction(tangents->row(row)), before, after),",
     "if (false) result = turned(result, turned(direction(tangents->row(row)), before, after),",
     "what morph targets add to tangents turns with the normals alone"),
    ("src/soup/gltf_transforms.cpp", "const bool are_opposite = !(square > least * least);", "const bool are_opposite = false;",
     "vectors turn by half a circle about nothing"),
    ("src/soup/Vertex_values.cpp", "set(added, turned(direction(added), before, direction(column)));", "set(added, turned(direction(added), before, before));",
     "morph targets add to directions at new places what suits their sums"),
    ("src/soup/Vertex_values.cpp", "set(*tangent, perpendicular(before, direction(*normal)));", "set(*tangent, before);",
     "tangents at new places are not perpendicular to normals"),
):
    group(file, ("gltf_tangents_test",), tuple(entry))
group(
    "src/soup/gltf_transforms.cpp",
    ("gltf_writing_test:Gltf.NewPlaces*",),
    ("const Point_3 result = world_position(to_world, local);", "const Point_3 result = point;",
     "places that the file cannot hold"),
)
group(
    "src/soup/gltf_transforms.cpp",
    ("gltf_compressed_test",),
    ("local[k] = positions.nearest_quantised(local[k], k);", "(void)positions;",
     "new places become floats in a quantised file"),
)
group(
    "src/soup/Vertex_values.cpp",
    ("gltf_compressed_test",),
    ("columns.back().quantised = &column;", ";", "new texture coordinates become floats in a quantised file"),
)

group(
    headers + "spatial/internal/order_along_curve.h",
    ("hilbert_curve_test:OrderAlongCurve*",),
    ("shift < 3 * Hilbert_curve::bits", "shift < bits", "points are sorted by the last digit alone"),
    ("std::uint32_t((point[axis] - lower[axis]) * cells)", "std::uint32_t(point[axis] * cells)", "the curve begins at the origin"),
    ("upper[axis] = i == 0 ? point[axis] : (std::max)(upper[axis], double(point[axis]));", "upper[axis] = point[axis];",
     "the last point bounds all"),
)
group(
    "src/soup/Sewn_mesh.cpp",
    ("working_mesh_part_test:WorkingMesh.*",),
    ("return scale(of.points[of.triangles[triangles[i] - first].front()]);", "return scale(of.points.front());",
     "faces are numbered as the triangles come"),
)
group(
    "src/soup/Working_mesh.cpp",
    ("working_mesh_part_test:WorkingMesh.*",),
    ("return a.triangle < b.triangle;", "return a.face < b.face;", "the result is in the order of the curve"),
)
group(
    headers + "spatial/Packed_R_tree.h",
    ("spatial_index_test",),
    ("if (bounds.contains(box))", "if (true)", "nodes do not grow"),
    ("constexpr double most = 5.5;", "constexpr double most = 1e9;", "faces in any order are left in it"),
    ("for (std::size_t i = m_leaves_in_tree; i < m_leaves.size() &&",
     "for (std::size_t i = m_leaves_in_tree + 1; i < m_leaves.size() &&", "the first new leaf not visited"),
    ("leaf.boxes.set_empty(slot % s_width);", "leaf.boxes.set(slot % s_width, leaf.boxes[0]);",
     "what is removed is still found"),
)
group(
    headers + "spatial/internal/Rod_block.h",
    ("spatial_index_test",),
    ("rod_margin = 0x1p-20, beam_margin = 0x1p-16;", "rod_margin = 0, beam_margin = 0;", "no margin for rounding"),
    ("*this = enclosure.rod();", "", "rods of nodes do not grow"),
    ("radii = m_radius[i] + beam.m_radius;", "radii = beam.m_radius;", "a rod without its radius"),
)
group(
    headers + "Surface_mesh_simplification/internal/Original_surface.h",
    ("original_surface_test",),
    ("if (from <= at_c && at_c <= to)", "if (false)", "a corner of a sliver in none of its boxes"),
    ("found = near_point(point, squared_distance, triangle_of(of_index));", "", "nothing in the index is near"),
    ("(i > 0 && i < size - start && is_found(start + i))", "false", "before there is an index, triangles of higher numbers are not near"),
    ("m_neighbours[other->triangle][other->corner] = side.triangle;", "", "one of two neighbours does not know the other"),
    ("here.weights[i] == 0 && m_neighbours", "m_neighbours", "a walk goes anywhere"),
)
group(
    headers + "Surface_mesh_simplification/internal/Triangle_grid.h",
    ("original_surface_test",),
    ("at(k, l)) <= squared)", "at(k, l)) <= 2 * squared)", "points of a grid that are not near are removed"),
    ("if (!sides[1] || i == 0)", "if (!sides[1])", "a corner is a point of the grid"),
    ("(i == 0 && !sides[2])", "false", "a side that is left out has points"),
    ("inverse_area * (cc * m_along[0] - bc * m_along[1])", "inverse_area * (cc * m_along[0])", "points are removed elsewhere"),
)
group(
    headers + "internal/nearest_on_triangle.h",
    ("original_surface_test",),
    ("if (!(sum > 1e-8 * longest * longest))", "if (!(sum > 0))", "rounding moves what is nearest along a needle"),
    ("of_c <= 0 && d1 >= 0 && d3 <= 0", "false", "beyond a side, the nearest point is beyond it"),
    ("(std::max)(share, 0.), 1.)", "(std::max)(share, 0.), 2.)", "beyond the end of a needle, so is the nearest point"),
)
group(
    headers + "spatial/internal/Box_block.h",
    ("spatial_index_test",),
    ("yes(z1[i] >= box.lower[2])", "yes(z1[i] > box.lower[2])", "boxes that touch do not overlap"),
)
group(
    headers + "spatial/internal/Framed_box_block.h",
    ("spatial_index_test",),
    ("place(axis, lower - 2)", "place(axis, lower + 1)", "a box is read back smaller than it is"),
    ("if (put(i, box))\n      return;", "if (put(i, box) || true)\n      return;", "a frame does not grow"),
    ("yes(z1[i] >= query[2])", "yes(z1[i] > query[2])", "boxes that come to be in the same plane do not overlap"),
)
group(
    headers + "spatial/internal/Monotone_box.h",
    ("spatial_index_test",),
    ("int(other.lower[axis] <= upper[axis])", "int(other.lower[axis] < upper[axis])", "boxes that touch do not overlap, in clusters"),
)
group(
    headers + "spatial/Clustered_AABB_tree.h",
    ("spatial_index_test",),
    ("m_statistics.top_rebuilds += m_top.set(cluster, m_clusters[cluster].box(), *m_cluster_table);", "",
     "boxes of clusters do not grow"),
)

group(
    loop + "Edge_collapse.h",
    ("loop_test",),
    ("      ++record.rank;\n", "      record.rank = 3;\n", "no second placement"),
    ("      return bound_or_cost_of(of_edge, record);", "      return cost_of(of_edge, record);",
     "all costs are computed at first"),
    ("m_waiting.release_around(of_edge.v0());", "", "edges wait for ever"),
    ("put(m_has_stale_edges, of_edge.v0(), true);", "", "stale edges are not found"),
    ("dequeue(edge_id);\n    m_records[edge_id].rank = s_gone;", "m_records[edge_id].rank = s_gone;",
     "edges that are gone stay in the queue"),
    ("float s_near = 6;", "float s_near = 0;", "every change of a cost that can wait is noticed late"),
    ("    if (record.is_outdated) {\n", "    if (false) {\n", "changes of costs that can wait are never noticed"),
    ("if (!selected_at)\n        return true;", "if (!selected_at)\n        return false;",
     "the loop ends at an edge that has no cost any more"),
)
group(
    loop + "Topology_test.h",
    ("loop_test",),
    ("if (is_v0_on_border && is_v1_on_border)", "if (false)", "two stretches of border meet"),
    ("v) != m_neighbours.end() &&\n          !(of_edge.left_face_exists()", "v) != m_neighbours.end() && false &&\n          !(of_edge.left_face_exists()",
     "no link condition"),
    ("return !is_two_faces && !CGAL::is_tetrahedron(of_edge.v0_v1(), mesh);", "return !is_two_faces;", "tetrahedra vanish"),
)
group(
    loop + "Simplification.h",
    ("hindrances_test",),
    ("if (!targets().is_changeable(h))\n        continue;", "", "edges of fixed faces count"),
    ("targets().is_reached() || m_report.is_stopped)\n      return;", "m_report.is_stopped)\n      return;",
     "reasons where the target is reached"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    loop + "Hindrance_search.h",
    ("hindrances_test",),
    ("weakest = (std::max)(weakest, reason);", "weakest = reason;", "an edge counts for its last direction"),
    ("search->line_reason(edge(h, search->m_mesh)) < weakest_gone", "search->line_reason(edge(h, search->m_mesh)) <= weakest_gone", "the kinds of lines are mixed up"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    loop + "Filter_chain.h",
    ("hindrances_test",),
    ("std::count_if(std::begin(sides), std::end(sides), is_line) <= 1;", "false;", "thin cloth keeps its edge dense"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    loop + "Edge_queue.h",
    ("loop_test",),
    ("if (i > 0 && entry < entries[parent(i)])", "if (false)", "what became cheaper does not rise"),
)

group(
    "src/simplify/reduce_in_cells.cpp",
    ("cells_sewing_test", "cells_test"),
    ("if (!(low[i] < p[i] && p[i] < high[i]))", "if (!(low[i] <= p[i] && p[i] <= high[i]))", "walls belong to cells"),
    ("if (!is_locked[v] && (is_bound[a] || is_bound[b]))", "if (!is_locked[v] && is_bound[v])", "neighbours of the wall move"),
    ("if (low <= plane)", "if (low < plane)", "faces that touch the wall are not in the cell below",
     "what moves in a cell is with its neighbours inside the wall, which such a face does not come into"),
    ("return collapse.cost > limit;", "return false;", "every cell goes to its own cost"),
    ("return 0.95 * share;", "return 2 * share;", "cells go to the cost that half of them reach"),
    ("working.constraints().diagonal = whole.diagonal;", "", "drift as a share of the cell"),
    ("      is_at_gap[position] = true;", "      ;", "cells let borders at gaps drift as far as others"),
)
group(
    "src/simplify/simplify_soup.cpp",
    ("cells_test:Cells.GoAsFar*",),
    ("                         }),\n                         Cancellation_scope::inherited([this] { m_simplification->begin(); }),",
     "                         }),", "the error counts from what cells have left"),
)
group(
    "src/soup/Parts.cpp",
    ("intent_test",),
    ("return flag <= 1;", "return flag <= 2;", "numbers of triangles name a part"),
    ("if (is_known ||", "if (", "a piece without fixed faces cannot be reduced with the others"),
)

group(
    "src/cells/cut.cpp",
    ("pieces_test",),
    ("if (box.min(at.axis) <= at.plane)", "if (box.min(at.axis) < at.plane)", "faces that touch the wall are not in the piece below"),
    ("[&](const Point_3& p) { return !(p[axis] > plane); }", "[&](const Point_3&) { return false; }",
     "vertices in the plane count for the cell above", "the walls alone depend on it, and any walls will do"),
    ("sizes.front() = options.shift;", "", "the shift makes one more cell and moves no wall by its share",
     "the walls are other ones all the same"),
    ("is_free = is_free && cell.contains(rows.point(v));", "is_free = is_free || cell.contains(rows.point(v));",
     "faces with a corner beyond the wall are marked as free"),
)

group(
    "src/cells/join.cpp",
    ("pieces_test",),
    ("return cell.touches(box) &&\n           std::none_of", "return std::none_of", "triangles of a polygon come from two pieces"),
    ("std::rotate(corners.begin(), corners.begin() + first, corners.end());", "std::sort(corners.begin(), corners.end());",
     "a fixed face may turn over"),
    ("    found->second.pop_back();\n", "", "a fixed face more often than before"),
    ("!missing.empty())", "false)", "fixed faces may be missing"),
    ("if (!added.empty())", "if (false)", "pieces may intersect themselves"),
    ("!matching.is_complete())", "false)", "pieces may have new holes"),
    ("numbers[v] == no_number ? next : m_vertices", "true ? next : m_vertices", "vertices at walls are not joined"),
)

group(
    "src/verify/pieces.cpp",
    ("verify_pieces_test", "verify_match_pieces_test", "pieces_test"),
    ("if (are(a, b) || are(b, c) || are(c, a))", "if (false)", "triangles with two corners at one position connect pieces"),
)

group(
    "src/soup/Working_mesh.cpp",
    ("hindrances_test",),
    ("weakest = (std::max)(weakest, reason);", "weakest = reason;", "a face has the reason of its last edge"),
)

lines = ("working_mesh_part_test", "cells_test", "attributes_test", "seams_test", "random_soups_test", "worlds_test")

group(
    "src/soup/Corner_mesh.cpp",
    lines,
    ("differ_in_label(m_soup.groups) || differ_in_label(m_soup.objects)", "differ_in_label(m_soup.objects)",
     "groups make no lines"),
    ("differ(m_soup.normals, a, b),", "false,", "normals make no lines"),
    ("m_places[m_mesh.next(h)] = m_places[m_mesh.opposite(m_mesh.prev(h))];", ";", "corners do not follow the edges that merge"),
)
group(
    "src/soup/Corner_mesh.h",
    lines,
    ("if (rule.is_line_at_target(from == moving ? m_mesh.opposite(h) : h))\n        return false;", "if (false)\n        return false;",
     "corners are carried across lines"),
    sources=("src/soup/Working_mesh.cpp",),
)
group(
    "src/soup/Sewn_mesh.cpp",
    lines,
    ("} else if (side < sewing.mate(side))", "} else if (false)", "cells know no lines"),
    ("if (rule.is_line_at_target(originals[side]))", "if (false)", "cells know no spokes"),
    ("is_locked[v] = rule.is_locked(vertices[v]);", "", "what is locked in the whole moves in a cell"),
    ("is_locked.push_back(vertices_at[position] > 1);", "is_locked.push_back(vertices_at[position] > 2);", "pairs of twins move"),
    ("is_locked[v] |= is_in_frozen_face[v];", "", "faces that offend move"),
)
group(
    "src/soup/Sewing.cpp",
    ("slits_test", "cells_sewing_test", "topology_test", "seams_test", "random_soups_test", "obstacle_test"),
    ("if (tear_parallel_edges(matching.unsewn()))", "if (false)", "two edges between two vertices",
     "three faces or more meet in such edges, so that other vertices are at both ends too, and all of them are locked"),
    ("beyond - first != 2 || position(a) == position(b) ||\n", "beyond - first != 2 ||\n", "sides that run the same way are sewn"),
    ("side.high != it->high || is_own(side.side) != is_own(it->side);", "side.high != it->high;", "the soup is sewn to the obstacle"),
)
group(
    "src/soup/Sewing.cpp",
    ("orientation_test",),
    ("unite(side / 3, mates[side] / 3, false);", ";", "edges that agree may come to disagree"),
    ("(2 * against[first_of(t)] > size[first_of(t)])", "false", "the first triangle of a surface is never turned"),
)
group(
    "src/soup/Corner_mesh.cpp",
    ("orientation_test",),
    ("turn(result);", ";", "the result keeps turned faces"),
    ("turn(m_corners.back());", ";", "faces are not turned, and the result turns them back"),
)
group(
    "src/replay/Complex.cpp",
    ("orientation_test",),
    ("std::swap(turned.positions[1], turned.positions[2]);", "", "the replay turns nothing"),
    ("if (m_faces[face].is_turned)", "if (false)", "the replay's result keeps turned faces"),
)

group(
    "src/weld/Border_sites.h",
    ("snapping_rules_test", "snapping_test"),
    ("if ((site.is_frozen || m_sites[j].is_frozen) && !are_frozen_named)", "if (site.is_frozen && !are_frozen_named)", "what moves may snap to a face that offends"),
    ("!is_shortly_followed(i, j, length) && !is_shortly_followed(j, i, length);", "true;", "a border is sewn to itself"),
    sources=("src/weld/snapping.cpp", "src/weld/open_seams.cpp"),
)
group(
    "src/weld/Border_sites.cpp",
    ("snapping_rules_test", "snapping_test"),
    ("p == q ? 0 : distance(m_sites[p], m_sites[q]));", "p == q ? 0 : least);", "gaps are closed only from their ends"),
)
group(
    "src/weld/open_seams.cpp",
    ("snapping_rules_test", "snapping_test"),
    (" || 3 * continued < within", "", "layers upon each other are taken for seams"),
    ("20 * (number_within(2 * length) - within) > within", "false", "seams end where other gaps begin"),
    ("m_distance = clear.length.value_or(0);", "m_distance = result.limit;", "gaps are held that are not clear"),
    ("pairs = mutual_partners<Packed_R_tree>(true);", "pairs = mutual_partners<Packed_R_tree>();", "partners are not tied where one is frozen"),
    ("if (pieces.are_cards(low, high))", "if (false)", "cards of hair are tied"),
    ("!pieces.are_cards(m_sites[i].position, m_sides[side][0]) &&", "", "cards of hair face each other"),
    ("number[a] != number[b] && counts", "counts", "a ring is not tied to itself"),
    ("runs_opposite(i, side) &&", "", "borders that run the same way are seams"),
    ("if (is_of_strip && pieces.is_strip(m_sides[side][0]))", "if (false)", "cards of hair are seams"),
    ("least_row = 4;", "least_row = 1;", "corners that come near are seams"),
    ("opposite.length > m_distance)", "true)", "what partners have found is found again by edges"),
    ("(std::max)(opposite.length, least)", "opposite.length", "borders that touch hide gaps"),
    ("|| !is_of_seam(pair.low) || !is_of_seam(pair.high))", ")", "layers are tied beside a seam that edges find"),
    ("(is_of_seam(i) || is_of_seam(a) || is_of_seam(b)) &&", "", "what is no seam faces a border beside one"),
)
group(
    "src/weld/snapping.cpp",
    ("snapping_rules_test", "snapping_test"),
    ("if (!are_partners(pair.low, pair.high))", "if (false)", "partners of before other joins are joined"),
    ("if (!is_manifold(goes, stays))", "if (false)", "edges of three faces"),
    ("if (!is_star_motion_clear<Kernel>(m_star))", "if (false)", "a star folds onto itself"),
    ("if (!are_sweeps_clear(goes))", "if (false)", "a seam is closed through another layer"),
    ("m_index.set(face, face_box(face));", "", "the index does not follow a snap"),
)
group(
    headers + "Surface_mesh_simplification/Border_rule.h",
    ("snapping_test:Snapping.TheLimit*",),
    ("state.squared_drift_of[kept] = state.pending->max_squared_drift;", ";",
     "a place has the limit of whichever vertex the mesh keeps there"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/Border_rule.h",
    ("seams_test:Seams.*orner*",),
    ("!(is_border && state.max_squared_height > 0 &&", "!(state.max_squared_height > 0 &&", "corners of seams are low"),
    ("[&](const Passed&) { return state.max_squared_height; }", "[&](const Passed& one) { return one.max_squared_drift; }",
     "corners are low as far as lines may drift"),
    ("if (!is_near(passed_at(source(ahead, state.mesh))))", "if (false)", "the vertex of a corner may be far off"),
    ("!std::all_of(found->second.begin(), found->second.end(), is_near)", "false",
     "what lines have passed may be far off"),
    ("max_squared_height(options.max_corner_height * options.max_corner_height)",
     "max_squared_height(options.max_corner_height)", "the height is not squared"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/Normal_change_filter.h",
    ("seams_test:Seams.*orner*",),
    ("return (std::max)(length_before, length_after)", "return length_after",
     "a face may have been high"),
    ("< m_max_height * side", "< 0", "no face is low"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Further_poses.h",
    ("seams_test:Seams.*orner*",),
    ("aspect_ratio, setup.max_corner_height()),", "aspect_ratio),", "no face is low in another pose"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Reduction_setup.h",
    ("seams_test:Seams.*orner*",),
    ("return options.max_corner_height * diagonal;", "return options.max_corner_height;", "the height is no share of the diagonal"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/simplify/simplify_soup.cpp",
    ("snapping_test:Snapping.WhatIsHeld*",),
    ("    if (m_options.loop == Collapse_loop::own)\n      hold_gaps", "    hold_gaps", "CGAL's loop gets ties that it cannot keep"),
)
group(
    "src/simplify/prepare.cpp",
    ("instances_test:Instances.Gaps*",),
    ("find_open_seams(soup(), m_prepared.positions, transforms,", "find_open_seams(soup(), m_prepared.positions, {},",
     "places of a scene are tied to each other"),
)

group(
    "src/simplify/prepare.cpp",
    ("obstacle_test", "prepare_test", "intent_test", "replay_test"),
    ("is_frozen[t] |= is_merged[m_positions_rounded[v]] ||", "is_frozen[t] |=", "what rounding merges moves"),
    ("take_apart(m_prepared.positions, m_positions_rounded);", "", "what rounding takes apart is one position"),
    ("is_frozen[pair.first] = is_frozen[pair.second] = true;", "is_frozen[pair.first] = true;", "one face of a pair moves"),
)

group(
    "src/replay/contact.cpp",
    ("replay_flat_test", "replay_contact_test"),
    ("planar_turn(a, b, t, axis) <= 0;", "planar_turn(a, b, t, axis) < 0;", "a face may end without an area"),
    ("    else if (side != here)\n      return false;\n", "",
     "corners on both sides of a plane are parted by it"),
    ("int side = -side_beyond;", "int side = 0;", "what is on the inner side of a facet is parted by it"),
    ("return axis < 3 && is_clear_in_plane(own, in_plane, axis);", "return true;", "what touches a facet is clear"),
    ("  if (beyond && side_beyond == 0)\n    own.push_back(beyond);\n", "", "a flat sweep has three corners"),
    ("if (are_all_in(in_plane, own))", "if (in_plane.size() < 2 || are_all_in(in_plane, own))",
     "one corner in a facet is clear of it"),
    ("if (!other.is_one_sided || one.side * other.side > 0)", "if (!other.is_one_sided)",
     "a line parts what is on one side of it"),
    ("return end < begin || (end == begin && a.high->id == b.low->id);", "return end <= begin;",
     "segments of a line that touch are apart",
     "they touch in a corner of the sweep, which is there before or after the motion too, and both states are judged"),
    ("return size == 3 ? Answer::touching : Answer::clear;", "return Answer::clear;", "a face may end on top of another"),
    ("m_volume == at_end ? Answer::touching : Answer::clear;", "Answer::clear;", "a face may fold through another"),
)
group(
    "src/replay/Start.cpp",
    ("replay_all_test", "replay_test", "replay_mutation_test"),
    ("is_merged[first[v]] = true;", "", "what rounding merges moves"),
    ("start.is_locked[first[v]] || is_frozen[t];", "start.is_locked[first[v]];", "faces that offend move"),
)
group(
    "src/replay/Start.cpp",
    ("descent_test",),
    ("if (!may_descend)", "if (false)", "pairs may descend in any log"),
)
group(
    "src/replay/replay.cpp",
    ("replay_all_test", "replay_test", "replay_mutation_test"),
    ("!m_complex.is_one_fan(position) &&", "false &&", "what holds sheets together moves"),
)
group(
    "src/replay/Motion_judge.cpp",
    ("replay_all_test", "replay_test", "replay_mutation_test"),
    ("return !complex().has(f, motion.mover);", "return f % 2 == 0;", "half of what stands still is not seen"),
    ("if (face.sweep.touches(standing))", "if (false)", "tunnelling through what stands still"),
    ("face.sweep.touches(side))", "false)", "tunnelling within the star"),
)
group(
    "src/replay/Judged_mesh.cpp",
    ("replay_all_test", "replay_test", "replay_mutation_test"),
    ("m_tree.set(f, m_boxes[f]);", "", "the tree does not follow"),
)
group(
    "src/replay/link.cpp",
    ("replay_all_test", "replay_test", "replay_mutation_test"),
    ("if (edge.is_border() && other->is_border())", "if (false)", "a triangle with two border edges goes"),
    ("if (apexes.count(edge.neighbour) == 0)", "if (false)", "no link condition"),
    ("is_on_border(at_removed) && is_on_border(at_kept) && !edge_to", "false && !edge_to", "two borders meet"),
)
group(
    "src/replay/snap.cpp",
    ("replay_test:*nap*", "replay_mutation_test"),
    ("if (!partners.are_near(moved, kept))", "if (false)", "snaps over any distance"),
    ("if (of_moved.is_empty())", "if (false)", "what is on no border snaps",
     "it has no edge that could be sewn either, and is refused for that"),
    ("edge.outgoing != other.incoming))", "false))", "edges whose faces run the same way"),
)
group(
    "src/replay/limits.cpp",
    ("replay_test",),
    ("if (ahead == lines.end() || lines.size() != 2)", "if (ahead == lines.end())", "corners of lines move"),
    ("!line_drifts_within(*m_limits.corner_height))", "false)", "corners of any height are low"),
    ("(!is_low && !is_angle_within", "(!is_angle_within", "no face is low"),
    ("std::max(length(before), length(after)) <=", "length(after) <=", "a face may have been high"),
    ("if (!has_low_corners() ||", "if (has_low_corners() ||", "no corner is low"),
    ("    if (!ahead->is_border())\n      return Violation_kind::seam_turn;", "", "corners of seams are low"),
    ("return !is_far(complex.point(mover), limit, u) &&", "return true &&", "the vertex that moves may drift"),
    ("return !passed ||", "return true ||", "what was passed before may drift"),
    ("least_after <= least_before * (1 - limit_tolerance))", "false)", "triangles get thin"),
    ("if (behind.is_border() != ahead->is_border())", "if (false)", "from a border on to a seam",
     "a vertex that moves is in one fan, which has two border edges or none"),
    ("int(is_line(q, mover)) <= 1;", "int(is_line(q, mover)) <= 2;", "thin faces at the end of a strip"),
    ("return is_on_line(p) && is_on_line(q) &&", "return is_on_line(p) &&", "thin faces at a line"),
)
group(
    "src/replay/Complex.cpp",
    ("replay_test", "replay_all_test"),
    ("carry_seams(removed, kept);", "", "seams do not follow"),
    ("carry_passed(removed, kept, before);\n", "\n", "what was passed is forgotten"),
    ("if (is_along_line && before[1] != m_points[kept])", "if (false)", "what KEPT has passed is forgotten"),
    ("carry_corners(contracted, moving, removed, kept);", "", "corners do not follow"),
)

# Partners across a gap
group(
    headers + "Surface_mesh_simplification/internal/Border_partners.h",
    ("snapping_test",),
    ("!partner_of(source(moving, m_mesh)) || partner_motion(moving);", "true;", "a vertex goes where its partner cannot follow"),
    ("      join(kept, *m_partner_of_kept);", "      ;", "a pair to which others have gone is none any more"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Edge_collapse.h",
    ("snapping_test",),
    ("          try_along(*moving);", "          ;", "partners go when their own turn comes"),
    sources=("src/simplify/simplify_soup.cpp",),
)

# Meshes in several places

group(
    loop + "Motion_filter.h",
    ("instances_test",),
    ("if (are_apart && std::all_of(m_companions", "if (are_apart || std::all_of(m_companions",
     "other places are not asked"),
    ("const bool are_apart = m_observer.are_companions_apart(collapse.moving(), m_companions);",
     "const bool are_apart = true;", "places that come near each other change alike"),
    ("return m_collapses_left == 0;", "return true;", "a level while places differ"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    loop + "Hindrance_search.h",
    ("instances_test",),
    ("m_observer.are_companions_apart(moving, companions) &&", "true &&",
     "places that are too near are no reason"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/soup/Shared_places.cpp",
    ("instances_test", "worlds_test"),
    ("places[copy.place].is_mirrored != ", "places[copy.place].is_mirrored && ", "mirrored places are not seen as such"),
    ("if (!is_alike || is_held)", "if (!is_alike)", "what is locked in one place is not in others"),
)
group(
    "src/soup/Shared_places.cpp",
    ("shared_places_test",),
    (" != m_corners.is_turned(Face(face))", "", "turned places are not seen as such"),
    ("internal::inflated(box, clearance)", "box", "places that are near each other without overlapping are apart"),
    ("box += mesh().point(mesh().source(in)).bbox();", ";", "a star is its vertex alone"),
)
group(
    "src/soup/Value_wedges.cpp",
    ("value_wedges_test",),
    ("if (wedge != done)", "if (true)", "a wedge on both sides of an edge counts twice"),
)
group(
    "src/soup/Wedge_table.cpp",
    ("wedge_table_test",),
    ("is_met[v] ? s_several : wedge", "wedge", "all corners at a seam are of its last wedge"),
    ("1) << corner % 64;", "1) << corner % 32;", "corners are taken for others"),
)
group(
    "src/soup/Wedge_table.h",
    ("wedge_table_test",),
    ("m_of_vertex[gone] = m_of_vertex[goal];", "", "a merged vertex has the wedge of the one that is gone"),
)
group(
    "src/soup/number_wedges.cpp",
    ("value_wedges_test",),
    ("!is_line_at_target[h];", "true;", "wedges go on across lines, in one direction"),
)
group(
    "src/soup/Place_rounding.cpp",
    ("place_rounding_test",),
    ("if (!m_is_scale_lossless)", "if (false)", "places that are no numbers of the file's type"),
    ("rounded[i] = sum - digits;", "rounded[i] = place[i];", "places have digits that others lose near 0"),
)
group(
    "src/soup/shared_meshes.cpp",
    ("instances_test",),
    ("positions, row) != soup.points[v])", "positions, row) != soup.points[v] && false)",
     "places that a snap has changed are one"),
)
group(
    "src/files/gltf_poses.cpp",
    ("gltf_poses_test",),
    ("side = cosine < 0 ? -1 : 1", "side = 1", "rotations take the longer way"),
    ("channel.part(key + 1, 0)", "channel.part(key + 1, 2)", "a spline ends with the tangent of its next part"),
    ("return std::make_pair(skin.joints[a.joint], a.weight) <", "return &a != &a && std::make_pair(skin.joints[a.joint], a.weight) <",
     "joints are summed in the order of the file"),
    ("if (is_bind_pose || m_influences[i].empty())", "if (true)", "skins move nothing"),
    ("files::product(world[skin.joints[j]], skin.inverse_bind[j])", "world[skin.joints[j]]", "no inverse bind matrix"),
    ("world[instance.node], instance.in_node)", "world[instance.node], identity_matrix)", "instances fall together"),
    ("if (key++ % every == 0)", "if (++key % every == 0)", "the first keyframe is left out"),
)
group(
    "src/files/humanoid.cpp",
    ("humanoid_poses_test",),
    ("return found.empty() || is_below(node, found.back());", "return true;", "a hand hangs on no arm"),
    ("!is_below(left_leg[0], *node) &&\n          !is_below(right_leg[0], *node))", "true)", "legs bow with the spine"),
    ("outwards * v[0] * left[0] - v[2] * left[2]", "outwards * v[0] * left[0] + v[2] * left[2]",
     "what looks along x bends its elbows backwards"),
    ("outwards * v[0] * left[2] + v[2] * left[0]", "outwards * v[0] * left[2] + v[2]", "figures of VRM 0 sit backwards"),
    ("return are_opposite ? turned(turned(v, from, third), third, to) : turned(v, from, to);",
     "return turned(v, from, to);", "what points the other way is mirrored"),
    ("const Vector origin = column == 3 ? pivot : Vector{};", "const Vector origin = {};", "bones turn about the origin"),
    ("if (place.parent && moved.count(*place.parent) > 0)", "if (false)", "what hangs on a bone stays behind"),
    ("result.back() += is_upper(i) ? char(name[i] - 'A' + 'a') : name[i];", "result.back() += name[i];",
     "names in capitals are others"),
)
group(
    "src/files/gltf_writer.cpp",
    ("gltf_instances_test", "gltf_writing_test", "instances_test"),
    ("          *bytes += contents[i];", "", "copies are alike whatever they have become"),
)
group(
    "src/files/gltf_nodes.cpp",
    ("gltf_instances_test", "gltf_writing_test", "gltf_levels_test", "instances_test"),
    ("return mesh(i) == mesh(instances.front());", "return true;", "instances that differ stay instances"),
    ("meshes[*level.meshes[m]] == meshes[*finest]", "false", "a mesh that stays is there for every level"),
    ("if (!is_for_its_mesh_alone(node))", "if (false)", "a level takes away the children of its node"),
    ("m_needed_nodes.count(n) == 0 && ", "", "a level does not move with its node"),
    ("if (is_of_weights(channel) && node_of(channel) == n)", "if (false)", "weights move a node without a mesh"),
    ("          animation[\"channels\"].push_back(channel);", ";", "weights move the finest level alone"),
    ("set_mesh(coarser, m_levels[level].meshes[mesh]);", "set_mesh(coarser, m_levels[1].meshes[mesh]);", "all coarser levels are the second"),
)
group(
    "src/files/gltf_levels.cpp",
    ("gltf_levels_test",),
    ("numbers[std::min(level, numbers.size()) - 1]", "numbers[0]", "a level is the second whichever is asked for"),
    ("    drop_channels(dropped);", "", "channels move nodes that have gone"),
    ("    drop_meshes(std::move(meshes));", "", "meshes of other levels stay"),
    ("for_each([&](const Json& mesh) { dropped.erase(mesh.get<std::size_t>()); });", "", "a mesh that a node still names goes"),
    ("      if (node.contains(\"name\"))\n        coarser[\"name\"] = node[\"name\"];", "", "a level has another name"),
    ("std::none_of(materials.begin(), materials.end(), levels_of)", "true", "levels of materials lose their extension"),
)
group(
    "src/files/Gltf_output.cpp",
    ("gltf_levels_test",),
    ("m_rows[range.first->second].bytes.compare(0, bytes.size(), bytes) == 0", "true", "rows that begin alike are taken for the same"),
    ("[\"byteStride\"] = rows.stride; // must", "; // must", "several accessors of a view without a stride"),
)
group(
    "src/files/united_levels.cpp",
    ("gltf_levels_test",),
    ("const std::size_t number = count[key]++;", "const std::size_t number = 0;", "vertices at one position become one"),
)

# Pairs that offend already
filter_of_pairs = ("descent_test", "descent_filter_test")
group(
    headers + "Surface_mesh_simplification/internal/Exempt_pairs.h",
    filter_of_pairs,
    ("        m_considered.push_back(id);\n      }", "        if (a != other && b != other)\n          m_considered.push_back(id);\n      }",
     "faces that are removed hand on no ancestors"),
    ("find_pairs_after(collapse, m_descent.pairs_now())", "find_pairs_after(collapse)", "pairs may become more"),
    ("    if (collapse.are_both_moved())\n      add_all_at(collapse.goal(), collapse.mover());", "",
     "only one end of two that move hands on ancestors"),
    ("m_faces.remove_at(m_vertices.number(collapse.goal()), m_near);", ";", "faces that change are also counted as they were"),
    (" && is_depth_kept()", "", "shallow pairs may become deep"),
    ("!m_descent.are_all_pairs_now(", "m_descent.are_all_pairs_now(", "only deep pairs are kept from becoming deeper"),
)
group(
    headers + "Surface_mesh_simplification/internal/Intersection_guard.h",
    filter_of_pairs,
    ("if (m_exempt.is_exempt(id))\n        continue;\n      if (!m_view", "if (!m_view", "no pair is exempt"),
    ("if (m_exempt.is_exempt_inside()) {", "if (false) {", "a star that meets itself is judged as a whole"),
    ("[&](const auto& edge) { return is_face_kept(star, edge, m_traits); }", "[](const auto&) { return true; }",
     "faces of a star that meets itself may degenerate"),
    ("may_degenerate_faces_go(collapse) && are_motions_and_pairs_fine", "are_motions_and_pairs_fine", "degenerate faces move"),
    ("return are_pairs_kept(collapse) && are_motions_clear(collapse);", "return are_pairs_kept(collapse);",
     "where pairs refused a vertex last, no motion of it is judged"),
    ("if (m_exempt.has_degenerate()) {", "if (false) {",
     "a degenerate face that is contracted is judged as a face with an area"),
)
group(
    headers + "Surface_mesh_simplification/internal/Descent.h",
    filter_of_pairs,
    ("      m_set_of_face[face] = set;", "      m_set_of_face[face] = s_none;", "faces that change lose their ancestors"),
    ("      if (f == g)\n        continue;", "", "what a degenerate face leaves behind is exempt from itself"),
    ("other == face ? 0 : m_considered_at", "other == face ? 2 : m_considered_at", "a degenerate face makes room for a pair"),
    ("    for (const Id a : m_union)\n      for", "    for (const Id a : m_sets[m_set_of_face[faces.front()]].ancestors)\n      for",
     "exemption is asked of one face as it was before the collapse"),
    ("    for (const Id face : m_considered)\n      remove_pairs(face);", "", "pairs that have gone still count"),
    ("    for (const Pair& pair : pairs)\n      add_pair(pair);\n    if", "    if", "pairs that have come do not count"),
    ("m_considered_at[other] == m_now ? 1 : 2", "2", "pairs within the star count twice"),
    ("m_is_exempt_inside = is_any_marked(m_union);", "m_is_exempt_inside = false;", "no pair within the star is exempt"),
    ("    if (m_considered_at[face] == m_now)\n      return m_is_exempt_inside;\n", "",
     "faces at the other end that moves are asked for what they were before"),
)
group(
    headers + "geometry/face_pair.h",
    ("geometry_face_pair_test",),
    ("if (shared == 3)\n    return true;", "if (shared == 3)\n    return false;", "duplicates do not offend"),
    ("orientation(a, b, c, r) == CGAL::COPLANAR &&\n           planar_orientation(a, b, c)", "planar_orientation(a, b, c)",
     "faces at a common edge offend out of their plane"),
    (" || do_intersect(triangle(p, q, r), segment(b, c));", ";", "one of two sides opposite to a common corner"),
)
group(
    "src/verify/descent.cpp",
    ("descent_test",),
    ("changed.insert(changed.end(), m_triangles_at[position].begin(), m_triangles_at[position].end());",
     "changed.push_back(m_triangles_at[position].front());", "one triangle alone hands on ancestors"),
    (" && left > 0 &&", " &&", "pairs may become more"),
    (": descent.are_partners(first, second));", ": true);",
     "whatever is where the collapses lead may offend"),
    ("if (result.points[result.triangles[i][k]] != descent.corner(triangles_of_original[i], k))", "if (false)",
     "a triangle need not be where the collapses lead"),
    ("is_old = is_old && descent.is_degenerate(first);", "", "a face with an area may become degenerate"),
)
group(
    "src/replay/replay.cpp",
    ("descent_test",),
    ("m_mesh.offending_pairs() > pairs_before)", "false)", "pairs may become more"),
    ("if (!is_obstacle_missing() && m_mesh", "if (m_mesh", "pairs are counted without those with the obstacle"),
)
group(
    "src/replay/Judged_mesh.cpp",
    ("descent_test",),
    ("m_heritage = m_start.lineage.united(m_changing);", "m_heritage = m_start.lineage.united({m_changing.front()});",
     "one triangle alone hands on ancestors"),
    (": m_start.lineage.descends_from_one(other, m_rivals);", ": true;", "whatever has ancestors may offend with all others"),
)
group(
    "src/replay/Motion_judge.cpp",
    ("descent_test",),
    ("if (is_contracted && is_degenerate({m, a, b})) {", "if (false) {",
     "a degenerate face that is contracted is judged as a face with an area"),
    ("if (face.sweep.degenerates())",
     "if (!m_start.offences.has(face.face, face.face) && face.sweep.degenerates())", "degenerate faces move"),
)

# The order of edges, and the soups of callers
group(
    headers + "Surface_mesh_simplification/internal/Edge_queue.h",
    ("edge_queue_test",),
    ("std::uint32_t(bits >> 49)", "std::uint32_t(bits >> 50)", "costs of a class differ by a quarter"),
    ("m_is_relaxed(is_relaxed)", "m_is_relaxed(false)", "tiles come by the costs of their first edges"),
    ("if (place_before == 0 || m_places[edge] == 0)", "if (m_places[edge] == 0)",
     "a tile is not told that its first edge has become dearer"),
    ("if (place_before == 0 || m_places[edge] == 0)", "if (place_before == 0)",
     "a tile is not told that another edge has become its first"),
    ("    heap_of(edge).erase_at(place);\n    if (place == 0)", "    heap_of(edge).erase_at(place);\n    if (place == 1)",
     "a tile is not told that its first edge has gone"),
    ("key == m_keys[1] ? entry < first_of(tile) : key < m_keys[1];", "!(m_keys[1] < key);",
     "an edge would be the first of its tile at any cost of its class"),
    ("(std::max)(m_merged_class, class_of(", "(std::max)(std::uint32_t(0), class_of(", "no classes are merged"),
    ("m_merged_class = *last;", "m_merged_class = *(classes.end() - 1);", "all classes are merged"),
    ("if (i > 0 && entry < entries[parent(i)])", "if (false)", "an edge that gets cheaper stays where it is"),
    ("key = (std::min)(m_keys[2 * node], m_keys[2 * node + 1])", "key = (std::min)(key, m_keys[node / 2])",
     "a tile whose first edge has left stays the winner"),
)
group(
    headers + "Surface_mesh_simplification/internal/Intersection_guard.h",
    ("index_test",),
    ("    std::sort(m_near.begin(), m_near.end());\n    m_clearance", "    m_clearance",
     "the index says which face too near is the blocker"),
    ("[](const Stationary_face& f, const Stationary_face& g) { return f.id < g.id; });",
     "[](const Stationary_face&, const Stationary_face&) { return false; });", "the index says which face in the way is the blocker"),
)
group(
    headers + "Surface_mesh_simplification/internal/Edge_collapse.h",
    ("loop_test",),
    ("*selected_at > cost && !m_queue.would_be_first(edge_id, *selected_at)", "false", "an edge comes at the bound of its cost"),
    ("        record.is_outdated = true;\n        return FT(*bound);", "        return FT(*bound);", "the bound is taken for the cost"),
)
group(
    loop + "Element_numbers.h",
    ("plug_in_test",),
    ("return std::size_t(element) == number++;", "return number++ < m_size;", "elements are numbered as if none had been removed"),
)
group(
    loop + "Intersection_guard.h",
    ("plug_in_test",),
    (" && m_faces.are_in_place()", "", "a mesh with other faces between the same vertices is taken"),
)
group(
    headers + "Surface_mesh_simplification/internal/Edge_collapse.h",
    ("plug_in_test",),
    ("m_expected_collapses -= m_expected_collapses > 0;", "", "as many collapses are expected all the time"),
)
group(
    headers + "Surface_mesh_simplification/internal/Simplification.h",
    ("intent_test",),
    ("!targets().has_several_shares()", "true", "a part loses its faces in its first tiles"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Simplification.h",
    ("instances_test",),
    (" && !has_companions()", "", "the number of collapses in all places decides on the order of those in one"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/soup/check_soup.cpp",
    ("prepare_test",),
    ("if (value >= values)", "if (value > values)", "a number beyond the last value"),
    ("    check_corners(values.of_triangle, values.values.size(), name);", "", "values that do not exist"),
    ("attribute.rows.size(), rows * bytes,", "attribute.rows.size(), attribute.rows.size(),",
     "attributes of another length"),
)

# Sheets that meet along a line
group(
    headers + "Surface_mesh_simplification/internal/Joint_motions.h",
    ("non_manifold_test",),
    ("result.push_back(*along);", "", "the other sheets stay behind"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/soup/keeps_pieces.cpp",
    ("non_manifold_test",),
    ("if ((a[0] == b[0]) != (a[1] == b[1]) || (a[0] == b[0]) != (a[2] == b[2]))", "if (false)",
     "a sheet may be joined by other vertices afterwards"),
)
group(
    "src/replay/Complex.cpp",
    ("non_manifold_test",),
    ("!m_faces[f].is_seam[at][0] &&\n                !edge_to(edges, sides[0]).is_border())", "!m_faces[f].is_seam[at][0])",
     "corners are handed on from sheet to sheet"),
)
group(
    headers + "Surface_mesh_simplification/internal/Intersection_guard.h",
    ("non_manifold_test",),
    ("motion.is_joint() && m_vertices", "false && m_vertices", "coincident vertices never move"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Moving_star.h",
    ("non_manifold_test",),
    ("(!motion.others || std::all_of(", "(true || std::all_of(", "the faces of other sheets are not judged"),
    sources=("src/simplify/simplify_soup.cpp",),
)

may_intersect = ("may_intersect_test",)

group(
    headers + "Surface_mesh_simplification/internal/Intersection_guard.h",
    may_intersect,
    ("!m_permitted.has_at(j, face.id) &&\n          ", "", "faces of parts that may intersect are kept apart in mixed stars"),
    ("motion.target && std::count(face", "false && std::count(face", "parts that may intersect are joined"),
    ("if (!m_permitted.is_any()) {", "if (true) {", "faces at the target are left out before their parts are looked at"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Permitted_pairs.h",
    may_intersect,
    ("m_of_all &= m_rivals[j]", "m_of_all = m_rivals[j]", "a face is skipped because the last of the star may meet it"),
    ("return (mask & firsts) << 1 | (mask >> 1 & firsts);", "return mask | mask << 1 | mask >> 1;",
     "a part may intersect itself"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/replay/Start.cpp",
    may_intersect,
    ("part_of[t])) == 3)", "part_of[t])) == 4)", "the replay accepts parts that are joined"),
)

# Doubles
doubles = ("doubles_test",)

group(
    "src/soup/Corner_mesh.cpp",
    doubles,
    ("result.in_doubles = plies != plies_beyond;", "", "the end of a doubled region is no line"),
    ("m_plies[m_first_ply[face] + i].corners[m_places[h]] = corner_at(from, i);", ";", "doubles stay behind their fronts"),
    ("[](const Ply& ply) { return !ply.is_against_face(); });", "[](const Ply&) { return true; });",
     "doubles are compared in the order of the file"),
)
group(
    "src/verify/descent.cpp",
    doubles,
    ("if (first == second)\n        continue;", "", "a double exempts its front from everything near"),
)
group(
    headers + "Surface_mesh_simplification/internal/Face_targets.h",
    doubles,
    ("record.further_times = times - 1;", "(void)record;", "a face with doubles counts once"),
    sources=("src/simplify/simplify_soup.cpp",),
)

# Poses
draco = ("gltf_compressed_test",)

group(
    "src/files/gltf_encoding.cpp",
    draco,
    ("columns[i].quantisation.reset();\n      is_same = false;", ";", "Draco's quantisation moves vertices"),
    ("bytes.replace(place, steps.size(), box(origin, range));", ";", "the box of the quantisation is not put back"),
    ("i == apart ? copies[row] : 0", "std::uint32_t(apart * 0)",
     "Draco would make one vertex of those that differ in nothing, so that it may not reorder them"),
    ("least = {std::move(bytes), again->num_points()};", "least.bytes = std::move(bytes);", "accessors have too few vertices where Draco splits some"),
)
group(
    "src/files/gltf_writer.cpp",
    draco,
    ("m_soup.poses.empty() && of_part.targets.empty()", "of_part.targets.empty()",
     "Draco reorders a mesh with poses"),
    ("else if (left.quantised_accessor)", "else if (false)", "floats in place of whole numbers are not noted"),
    ("holds_all(part.index_type) ?", "part.index_type != 0 ?", "indices are cut off"),
    ("        if (is_quantised_direction(*columns.back(), row))", "       ",
     "normals of vertices at new places are none that the file could hold"),
    ("m_split = vertices_by_normal(soup, m_normals);", "m_split = vertices_by_normal(soup, soup.normals);",
     "vertices are split whose new normals are one in the file"),
)
group(
    "src/files/Gltf_output.cpp",
    draco,
    ("    return kept->second;", "    return std::nullopt;", "compressed views that are kept become plain"),
    ("  if (!m_may_share_rows)\n    interleave();", "", "columns that were interleaved are not any more"),
    ("  if (!m_may_share_rows)\n    interleave();", "  interleave();", "levels of detail share no rows of interleaved columns"),
    ("json[\"byteOffset\"] = offset;", "json[\"byteOffset\"] = 0;", "columns begin where their view does"),
)
group(
    "src/files/gltf_quantization.cpp",
    draco,
    ("is_exact && dequantised(result).rows == column.rows", "is_exact", "floats become whole numbers near them"),
    ("  remove_extension(document, quantization_extension);", "", "the extension is named without need"),
)

poses = ("poses_test",)

group(
    headers + "Surface_mesh_simplification/Pose_intersection_filter.h",
    poses,
    ("for (std::size_t i = 0; i < count; ++i) {", "for (std::size_t i = 0; i < 1; ++i) {", "one pose is guarded"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Further_poses.h",
    poses,
    ("return sum / double(m_poses.size() + 1);", "return cost_of_first;", "the cost is that of the first pose"),
    ("return m_poses[i].error.allows(in_pose);", "return true;", "limits hold in the first pose alone"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/simplify/prepare.cpp",
    poses,
    ("m_prepared.is_frozen[t] |= m_prepared.is_held[v];", ";", "what coincides in some poses moves"),
)
group(
    "src/replay/inputs.cpp",
    poses,
    ("if (!has_digest && !(stated.sha256.empty() && (has_name || has_place)))", "if (!has_digest && !(has_name || has_place))",
     "the replay takes any pose for the one of the log"),
    ("posed->sha256_of_obstacle != digest_of(points_in_pose(obstacle, *options.pose)))", "false)",
     "the replay takes an obstacle wherever it stands"),
)

obstacles = ("replay_test:Replay.*Obstacle*",)
group(
    "src/replay/Judged_mesh.cpp",
    obstacles,
    ("  for (Index f = Index(m_complex.size()); f < m_complex.size_with_obstacle(); ++f)\n    faces.push_back(f);\n", "",
     "the replay sees no obstacle"),
)
group(
    "src/replay/Motion_judge.cpp",
    obstacles,
    ("complex().is_of_obstacle(f) ||", "!complex().is_of_obstacle(f) &&", "the replay keeps no distance from an obstacle"),
)
group(
    "src/replay/inputs.cpp",
    obstacles,
    ("      stated.sha256 != options.sha256_of_obstacle)", "      false)", "the replay takes any obstacle"),
)
group(
    "src/replay/Start.cpp",
    obstacles,
    ("start.is_locked[corner.id] = true;", ";", "what is at a corner of an obstacle moves"),
    ("offending_pairs(geometry_with_obstacle(start.soup, beside))", "offending_pairs(start.soup)", "nothing descends from pairs with an obstacle"),
)

progressive = ("progressive_test",)

group(
    "src/soup/Progression_recorder.cpp",
    progressive,
    ("first[wedge + 1] = corners.ply_count(face);", "first[wedge + 1] = 1;", "doubles share the wedges of their neighbours"),
    ("side : {moving, mesh.opposite(moving)}) {", "side : {moving}) {",
     "one side of a seam stays behind"),
)
group(
    headers + "Surface_mesh_simplification/internal/Simplification.h",
    progressive,
    ("      m_observer.after_step();\n", "", "no step ends"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/soup/Progression.cpp",
    progressive,
    ("for (std::size_t i = moves; i-- > 0;)", "for (std::size_t i = 0; i < moves; ++i)",
     "a wedge follows the first of its moves alone"),
)
group(
    "src/progressive/level.cpp",
    progressive,
    ("mesh.steps[v] <= steps &&", "mesh.steps[v] < steps &&", "the last step is left out"),
)
group(
    "src/progressive/write.cpp",
    progressive,
    ("~m_fates.steps[wedge], ", "", "vertices are not in the order in which they go"),
    ("if (uses[wedge] == 0)", "if (false)", "vertices end that no triangle has"),
    ("pose.points[m_soup.triangles[m_corners[wedge] / 3][m_corners[wedge] % 3]]",
     "pose.points[m_soup.triangles[wedge / 3][wedge % 3]]", "a pose has the places of other vertices"),
)
group(
    "src/progressive/write.cpp",
    ("progressive_test:*InATurnedNode",),
    ("const bool is_of_normals =", "const bool is_of_normals = false &&",
     "rows keep normals that are not those of their corners"),
)
group(
    "src/progressive/read.cpp",
    progressive,
    ("if (is_digest_judged && progressive", "if (false && progressive", "what another program has changed is read"),
)
group(
    headers + "Reduction_history.h",
    ("reduction_history_test",),
    ("m_collapses_per_sample *= 2;", ";", "united samples go on as short ones"),
    ("(std::min)(first.least_cost, second.least_cost)", "second.least_cost", "united samples forget the least cost"),
    ("last.refused = refused;", ";", "what is refused within a sample does not count"),
)
group(
    headers + "geometry/clearance.h",
    ("clearance_decision_test",),
    ("m_of_sweeps.push_back({{s_to, p, p}, 2});", ";", "new edges have no distance"),
    ("m_of_sweeps.push_back({{s_from, s_to, p}, 3});", ";", "facets at the edge have no distance"),
    ("m_of_sweeps.push_back({{s_to, a, b}, 3});", ";", "moved faces have no distance"),
    ("m_of_sweeps.push_back({{s_from, p, p}, 2});", ";", "the way to a new place has no distance"),
    ("(Interval(upper[i]) + distance).sup()", "upper[i]", "the box is not inflated above"),
    ("side_of_p == -side || ", "", "a star on both sides of a plane is beyond it"),
    ("while (!CGAL::certainly(squared >= least) && next < m_star_near.size())", "while (false)",
     "nearer faces may come no nearer than the clearance, wherever they were"),
)
group(
    headers + "geometry/internal/feature_distances.h",
    ("clearance_decision_test",),
    ("CGAL::certainly(is_attained) ? (std::min)(least.sup(), squared.sup()) : least.sup()",
     "(std::min)(least.sup(), squared.sup())", "what may not be attained counts as attained"),
    ("both(at_u + at_v <= length, length > 0)", "length > 0", "a facet reaches beyond its third edge"),
)
group(
    headers + "Surface_mesh_simplification/internal/Intersection_guard.h",
    ("clearance_test:Clearance_of_pieces.*",),
    ("m_faces.find_near(m_clearance.reach(m_star.box()), mover, m_near);", "m_faces.find_near(m_star.box(), mover, m_near);",
     "faces are near where boxes meet"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    headers + "Surface_mesh_simplification/internal/Clearance.h",
    ("clearance_test:Clearance_of_pieces.*",),
    ("if (is_of_obstacle(id))", "if (false)", "an obstacle connects pieces"),
    sources=("src/simplify/simplify_soup.cpp",),
)
group(
    "src/verify/clearance.cpp",
    ("clearance_test:Clearance_of_pieces.*",),
    ("if (t == own)", "if (false)", "an obstacle connects pieces in the judge"),
    ("t < own && by_vertices.of_triangle[t] == no_piece", "false", "needles connect pieces in the judge of distances"),
    ("return exact() < exact_square(distance);", "return false;", "the judge is not exact"),
    ("return exact() < other.exact();", "return false;", "the judge does not compare exactly"),
)
group(
    "src/replay/Motion_judge.cpp",
    ("clearance_test:Clearance_of_pieces.*",),
    ("m_pieces[complex().face(f).positions[0]] != m_pieces[motion.mover];", "false;",
     "the replay knows no clearance"),
)

group(
    headers + "Surface_mesh_simplification/internal/Value_quadric.h",
    ("uv_test:Uv.AQuadric*",),
    ("linear -= value_motion[k] *", "linear += value_motion[k] *",
     "a quadric says something else from another origin"),
    ("displacement(k, motion) - weight() * value_motion[k])", "displacement(k, motion))",
     "the value of the origin does not count"),
    ("sum -= displacement(k, motion) * displacement(k, motion)", "sum += displacement(k, motion) * displacement(k, motion)",
     "the best values are not the best"),
)
group(
    headers + "Surface_mesh_simplification/Quadric_cost.h",
    ("quadric_cost_test",),
    ("enclosure.is_known = false;", "(void)enclosure;", "what faces enclose is not forgotten when they change"),
    ("Part_of_star{profile.vR(), profile.vL()}", "Part_of_star{profile.vL(), profile.vR()}",
     "costs are computed anew around the end that has not moved"),
    ("    m_state->enclosures.reset();\n", "", "what faces enclose is kept when everything is computed anew"),
    ("if (has_lines || fold_after < 0)", "if (has_lines)", "folds are held on one side only"),
    ("fold_before = fold_after;\n", "\n", "the fold before a face is that before the first"),
    ("is_folded |= x * last[0] + y * last[1] + z * last[2] < 0;", "", "folds are not held"),
    ("xy += x * y;", "xy += x * z;", "planes that are added in single precision are others"),
    ("? m_state->weight_unit * positive(sum(*least)) : 0;", "? 1.5 * m_state->weight_unit * positive(sum(*least)) : 0;",
     "a bound of the cost is too high"),
    ("return m_state->weight_unit * get(m_state->growths, v)", "return get(m_state->growths, v)",
     "the unit of the weights is left out of the cost"),
    ("growth.quadric(m_state->unit).moved_by(from_place)", "growth.quadric(m_state->unit)",
     "what a vertex has accumulated begins at the rounded place"),
    ("merged.from_place(doubles(of_gone.place, unit), unit)", "{0, 0, 0}",
     "quadrics relative to two places are added up as they are"),
)
group(
    headers + "internal/saturated_float.h",
    ("uv_test:Uv.AQuadric*", "quadric_cost_test"),
    ("return float((std::max)(-largest, (std::min)(largest, number)));", "return float(number);",
     "numbers too large for a float are infinite"),
)

group(
    "src/inspect/surface_distances.cpp",
    ("inspect_test",),
    ("least * least >= squared * squared_length", "true", "what is on one side of a plane is far from it"),
    ("return std::abs(sides) == 3;", "return true;", "corners on both sides of a plane are far from it"),
)

group(
    "src/verify/Covering.cpp",
    ("covering_test",),
    ("if (turn * projection.turn < 0)", "if (turn * projection.turn != 0)",
     "a fold is covered by what lies on one side of it"),
    ("if (!beyond || m_looks >= most)", "if (!beyond)\n          continue;\n        if (m_looks >= most)",
     "a triangle over a hole is covered"),
    ("if (crosses(projection, side)) {", "if (crosses(projection, side) && side > 0) {",
     "the covering does not continue across every edge"),
    ("if (visit(other / 3))\n          m_queue.push_back", "if (false)\n          m_queue.push_back",
     "the covering begins only at the triangles named"),
    ("return corners[side] <= 0 && corners[(side + 1) % 3] <= 0;", "return corners[side] < 0 && corners[(side + 1) % 3] < 0;",
     "edges that touch a triangle cross it"),
    ("m_next[side_number(*side)] = side_number(is_last ? *first : *next);",
     "m_next[side_number(*side)] = side_number(is_last ? *side : *next);",
     "only one of two neighbours knows the other"),
)
group(
    "src/verify/maximum_distance.cpp",
    ("verify_compare_test",),
    ("const auto farthest = search->farthest(part.corners, part.nearest, part.upper)",
     "const auto farthest = search->farthest(part.corners, part.nearest, 0)",
     "no triangle is covered, so that points run out"),
    ("        see(*farthest, part.nearest[0]);", "        m_lower = std::max(m_lower, part.upper);",
     "the bound counts as a distance that was seen"),
    ("{0x1p-4, 0x1p-20}", "{0x1p-4}", "along narrow strips points run out"),
)
group(
    "src/verify/compare.cpp",
    ("verify_compare_test",),
    ("bounds.lower > all.lower ? pose : all.pose", "all.pose", "the largest distance is always in the first pose"),
    ("geometry_in_pose(from, {}, pose)", "from", "further poses are compared with the first"),
)
group(
    "src/verify/Surface_tree.h",
    ("verify_distances_test",),
    ("height * height > 2.1 *", "height * height > 0.3 *", "planes that are near count as far"),
    sources=("src/verify/distances.cpp",),
)
group(
    "src/verify/Covering.cpp",
    ("verify_compare_test",),
    (" + 1e-15 * (std::abs(first) + std::abs(second))", "", "rounded cuts leave nothing of a needle"),
)
group(
    "src/verify/sides.cpp",
    ("covering_test",),
    ("corner = positions[corner];", ";", "seams are borders"),
)
group(
    "src/soup/surfaces_of.cpp",
    ("drop_parts_test", "layer_order_test"),
    ("return surfaces_of(soup.triangles, number_positions(soup.points));",
     "std::vector<Index> all(soup.points.size()); std::iota(all.begin(), all.end(), 0); return surfaces_of(soup.triangles, all);",
     "surfaces are connected by vertex numbers"),
)
group(
    "src/soup/drop_parts.cpp",
    ("drop_parts_test",),
    (".size < parts.smaller_than)", ".size <= parts.smaller_than)", "what is just as large goes"),
    ("if (left.triangles.empty() && !soup.triangles.empty())", "if (false)", "nothing may be left"),
    ("had_triangles[part] = false;", ";", "textures go that a part with triangles shows"),
)
group(
    "src/soup/material_textures.cpp",
    ("drop_parts_test",),
    ("      primitive = nullptr;\n", "", "parts without a triangle keep their textures"),
    ("kept.insert(id.get<Index>());", ";", "textures of coarser materials go"),
    ("|| !are_all_references_known(document))\n    return {};", ")\n    return {};",
     "textures go to which an unknown extension may refer"),
    ("if (key == \"material\" && value.is_number_unsigned())",
     "if (key == \"material\" && value.is_number_unsigned() && !json.contains(\"variants\"))",
     "textures of variants go"),
)
group(
    "src/soup/drop_attributes.cpp",
    ("drop_attributes_test",),
    ("is_shared[first[v]] |= found.dropped != dropped;", "is_shared[first[v]] = true;",
     "pieces that lie beside each other become one"),
    ("append(kept, m_soup.normals.values[normals[v]]);", "append(dropped, m_soup.normals.values[normals[v]]);",
     "vertices of different normals become one"),
    ("m_soup.uvs.of_triangle[t][k] = uvs[v];", ";", "texture coordinates stay those of vertices that are gone"),
)
group(
    "src/soup/material_textures.cpp",
    ("drop_attributes_test",),
    ("reference.contains(moved) ? reference[moved]", "false ? reference[moved]",
     "the set that a texture's transform names is not asked for"),
    ("is_of_dropped[i] && !is_kept[i]", "is_of_dropped[i]", "what a texture that stays shows goes with others"),
    ("is_of_dropped[i] && !is_kept[i]", "!is_kept[i]", "images go to which nothing has referred before"),
    (" && are_all_references_known(scene.document)", "", "images go to which an unknown extension refers"),
    ("m_images.renumber(source, \"source\");", ";", "textures that stay show other images"),
    ("      if (is_freed[view]) {", "      if (false) {", "the bytes of images stay"),
)
group(
    "src/files/gltf_bind_poses.cpp",
    ("gltf_bind_poses_test:Bind_poses.*",),
    ("constexpr double rounding = 1e-5;", "constexpr double rounding = 1e-9;",
     "roundings of 32-bit floats move skins against each other"),
    ("constexpr double rounding = 1e-5;", "constexpr double rounding = 1e-2;", "a scale is taken for rounding"),
    ("if (to_joint == to_joint_of_other)\n        return other;", "", "skins bound alike stand apart by roundings",
     "`known` finds the place of the other skin again"),
    ("return known(product(product(other, *from_joint), to_joint),", "return known(other,",
     "bind matrices of the second skin do nothing"),
    ("if (!inverse(*place))", "if (false)", "a joint of size zero makes a mesh degenerate"),
    ("!m_document.to_world[node])", "false)", "a joint outside the scene is read"),
    ("model.accessors[accessor].count < joints.size())", "false)", "matrices are read beyond their accessor"),
)
group(
    "src/weld/open_seams.cpp",
    ("snapping_rules_test:Border_gaps.*",),
    ("(std::max)(std::ldexp(limit, -s_halvings), std::numeric_limits<double>::denorm_min());",
     "std::ldexp(limit, -s_halvings);", "a search among the smallest numbers does not end"),
)
group(
    "src/inspect/inspect.cpp",
    ("inspect_test:Inspect.*",),
    ("face_of[m_prepared.fronts.empty() ? t : m_prepared.fronts[t]]",
     "Sewn_mesh::Mesh::Face_index(m_prepared.fronts.empty() ? t : m_prepared.fronts[t])",
     "a number of a triangle is taken for that of a face"),
)

group("src/soup/regions.cpp", ("attributes_test",),
      ("if (differing > 0 && s_edges_for_one_that_differs * differing <= neighbours.size())", "if (differing > 0)", "a value that is another on each face makes lines"))
group("src/replay/replay.cpp", ("attributes_test",),
      ("      return number_positions(m_start.points_of_first_pose);", "      return number_positions(m_start.soup.points);", "regions are others in each pose"))
group("src/soup/normals.cpp", ("suited_normals_test",),
      ("result.normals.values[kept] == fans.values[fan]", "false", "means of normals are left at soft lines"))
group("src/soup/Corner_mesh.cpp", ("attributes_test",),
      ("m_regions && (*m_regions)[a / 3] != (*m_regions)[b / 3]", "false", "painted regions lose their outlines"))

group("src/verify/match_by_vertices.cpp", ("verify_match_pieces_test",),
      ("likeness.turned + (likeness.is_wrong() ? 1 : 0)", "(likeness.is_wrong() ? 1 : 0)", "a lid is taken for its box"))
group("src/verify/near_positions.cpp", ("verify_match_pieces_test",),
      ("      positions[vertex] = numbers[nearest];", "      positions[vertex] = positions[vertex];",
       "results of few digits are matched by the distances of surfaces alone"))

group("src/verify/Pieces_in_file.cpp", ("verify_match_joined_test",),
      ("pairs.size() != matched(std::move(of_others)).size() + hidden.size()", "pairs.empty()",
       "one double in the file counts for two"),
      ("std::binary_search(corners_of_others.begin(), corners_of_others.end(), of_this.front())", "of_this.empty()",
       "a triangle of another piece counts as a missing one"),
      ("if (original_at[position].size() > 0 &&", "if (false &&", "a cut that leaves a notch counts as a missing piece"),
      ("return m_result.kinds_by_position(left) == m_original.kinds_by_position(others);", "return true;",
       "a cut that divides a piece counts as a missing one"))

group("src/verify/Patches.cpp", ("verify_match_names_test",),
      ("if (distance(shape, i) < least)", "if (false)", "names of parts may be exchanged"))

group("src/verify/match_names.cpp", ("verify_match_names_test",),
      ("if (patches_before->is_likest_of_its_name(m_result.soup, patch))", "if (false)",
       "what is left of a part has the name of what is beside it"))

group("src/verify/Border_lines.cpp", ("verify_match_pieces_test",),
      ("return sum > 0;", "return false;", "what is left of a bag is turned inside out"),
      ("return sum > 0;", "return true;", "no piece is turned inside out"))

group("src/simplify/simplify_soup.cpp", ("lods_test",),
      ("!is_one && !level->report.is_stopped", "!is_one", "levels after one that was stopped have no collapses"),
      ("is_one ? most : count", "count", "a reduction that passes through all levels ends at the first"))
group("include/selvedge/Error_search.h", ("error_search_test",),
      ("largest.pose && add_pose(guarded_poses, *largest.pose)", "largest.pose && guarded_poses.empty()", "the error is lowered for a pose that nobody guards"),
      ("level.upper >= largest.upper", "true", "the last level decides"))

group("src/verify/Likeness.h", ("verify_match_pieces_test",),
      ("std::min(distance, most_thickness)", "0", "a piece is turned whose sides are nearer to each other than the pieces"),
      ("std::min(distance, most_thickness)", "distance", "a piece is not turned of which little is left"),
      ("std::min(distance, most_thickness)", "most_thickness", "a flat piece is not turned"))

group("src/verify/Shape.cpp", ("verify_match_pieces_test",),
      ("!other.m_tree.nearest_facing(centre, directions, normal, as_near)", "true",
       "a flat piece is turned where its other side is found"),
      ("-cosine_of_turned * area)", "0)", "walls at a right angle show which side a piece has"))

group("src/soup/normals.cpp", ("normals_test",),
      ("dot(normal_at(normals, t, k), normal) >= 0", "true", "recomputed normals point to the back of a face at a fold"))

group("src/soup/Vertex_complex.cpp", ("vertex_complex_test",),
      ("if (has_edge(of_goal, a, b))", "if (false)", "an edge may lie opposite both ends"),
      ("!has_edge(of_v, goal, x) ||", "false ||", "the ends may have any neighbours in common"),
      (" || (is_on_line(v, of_v, x) && is_on_line(goal, of_goal, x))", "", "two lines become one"),
      ("degree(of_v, goal) == 2)", "false)", "two lines meet"),
      ("kind_of_v == Kind::singular && kind_of_goal == Kind::singular", "false", "two singular vertices become one"),
      ("is_part(goal) ? Kind::singular : kind_in(of_goal)", "kind_in(of_goal)", "a goal has no faces beyond a cut"),
      ("|| (is_part(end) && is_part(x))", "", "an edge between two vertices at cuts is on no line"),
      ("passed != link.size() ? Kind::singular : ", "", "a vertex where two discs meet is inner"))

group("src/simplify/reduce_in_cells.cpp", ("missed_target_test",),
      ("  options.least_faces.clear();", "", "no cell does anything where the whole has a least number of faces"))

group("include/selvedge/Surface_mesh_simplification/internal/Collapse_record.h", ("collapse_record_test",),
      ("    m_steps.clear();\n", "", "what a reduction before has done is done first"),
      ("      places += is_placed;\n", "", "all new places are the first one"))
group("include/selvedge/Surface_mesh_simplification/internal/Simplification.h", ("collapse_record_test",),
      ("targets().is_reached() || should_stop(0, profile, 0, 0)", "should_stop(0, profile, 0, 0)", "all collapses are repeated"),
      ("targets().is_reached() || should_stop(0, profile, 0, 0)", "targets().is_reached()", "nobody can stop a repetition"),
      ("        m_is_mover_first = is_mover_first;\n        perform", "        perform", "which end moves first is forgotten"))
group("include/selvedge/Missed_target.h", ("missed_target_test",),
      ("shares[i].output + a_tenth(shares[i].output - shares[i].fixed)", "shares[i].output",
       "a missed target keeps no face for the shape"),
      ("a_tenth(shares[i].output - shares[i].fixed)", "a_tenth(shares[i].output)", "faces that cannot change keep shape"),
      ("(share.input - share.output) / 2", "share.input", "a mesh that is hardly reduced is not reduced at all"),
      ("share.target != share.fixed", "true", "a ratio of 0 keeps shape"),
      ("        least[i] = std::min(least[i], shares[i].output);", "        ;", "a coarser level has more faces"),
      ("first.excess() > 0 && share.output", "share.output", "a part that has reached its target could lose faces"),
      ("report.faces_target = m_report.faces_target;", "", "a report names another target than was asked for"),
      ("original_to_result.maximum >= s_much * error", "original_to_result.maximum >= 0",
       "a mesh that kept its shape is reduced again"),
      ("is_farther(level.result.soup, level.original.soup, s_much * error)", "false",
       "what spans something open has kept its shape"),
      ("      m_options.max_border_turn = s_any_angle;\n", "      {}\n", "borders keep faces that the rest needs more"),
      ("50 * by_lines", "500 * by_lines", "borders turn that hold hardly an edge"),
      ("m_options.max_border_turn != Simplify_options().max_border_turn", "false",
       "a turn that is not the default is eased"),
      ("may_borders_turn = !m_is_border_turn_set", "may_borders_turn = true", "a turn that somebody has set is eased"),
      ("share.input == share.fixed || is_missed(share)", "share.input == share.fixed || share.excess() > 0",
       "a part that is not to have more faces is reduced further"),
      ("share.input == share.fixed || is_missed(share)", "is_missed(share)",
       "a part that cannot change keeps borders from turning"),
      ("is_due && is_held_by_lines", "is_held_by_lines", "a level that has kept its shape is reduced further"),
      ("!original.tied.empty() || !original.facing", "!original.facing", "gaps between partners get wider"),
      ("!original.tied.empty() || !original.facing", "!original.tied", "gaps between borders get wider"))
group("apps/advice.cpp", ("cli_test:App_simplify.*",),
      ("return gain >= s_surely; }", "return true; }", "every option is said to go to the target"),
      ("m_to_go += left - share.target", "m_to_go += left", "options gain too little"),
      ("edges * double(m_movable) / (m_edges", "edges * double(m_left) / (m_edges", "fixed faces are said to go"),
      ("return gains_less(b, a); });", "return gains_less(a, b); });", "what gains least is named first"),
      ("    return edges / 2;", "    return edges;", "later rules are forgotten"),
      ("    return edges / 4;", "    return edges;", "all that drifts is said to go"),
      ("double(hindrances[Hindrance::normal_change]) / 2)", "0)", "what turns too far is said to stay with a larger error"),
      ("share.within_reach > 0 ? share.within_reach : share.output", "share.output", "faces that were kept are said to be held"),
      ("2 * remedies[1].edges >= first.edges", "true", "options of little gain are named, too"),
      ("2 * remedies[1].edges >= first.edges", "false", "one option alone is named"),
      ("    others -= count;\n", "", "reasons that are named count as others, too"),
      ("count == total ? \"all\" : ", "", "all is a number"),
      ("    return \"--instances apart\";", "    return \"\";", "what reducing places apart gains is not said"))
group("apps/price_of_target.cpp", ("cli_test:App_simplify.*",),
      ("share.within_reach + (share.output - share.within_reach + 2) / 3", "share.within_reach",
       "a target is named that another order of edges does not reach"),
      ("  if (2 * on_seams <= positions)", "  if (true)", "nobody is told that seams of the texture take the vertices"))
