/* Copyright (c) 2026 the Selvedge authors
   SPDX-License-Identifier: GPL-3.0-or-later */

#ifndef SELVEDGE_C_H
#define SELVEDGE_C_H

#include <stddef.h>

/* The C interface of Selvedge, which simplifies triangle meshes so that no layer ever pierces another,
   decided exactly. docs/c.md has an example.

   Errors. No function aborts, and no C++ exception leaves one. A function that fails returns what its comment
   says (0, a null pointer or -1), and selvedge_last_error() returns why. Whatever is not a null pointer must
   point to what the function expects; a null pointer where a mesh, options, a result or text is required is
   an error like any other.

   Memory. What a function with _new, _read, _generate or _reduce in its name returns is freed by the _free of
   its type, which takes null pointers, too. All other pointers belong to what they were asked of.

   Threads. Functions may be called in several threads at once, as long as none changes or frees what another
   one uses. Inside, oneTBB's threads are used, as many as it grants, or as the option "threads" says. The
   result does not depend on them. */

#if defined(__GNUC__)
#define SELVEDGE_C_API __attribute__((visibility("default")))
#else
#define SELVEDGE_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the version of the library, such as "0.1.0". */
SELVEDGE_C_API const char* selvedge_version(void);

/* Returns what was wrong in the latest call of this thread that could fail: one line for a person, which is
   valid until the thread's next such call. Returns a null pointer when that call succeeded. Functions that
   only return a number or an array of a mesh or a result leave it as it is. */
SELVEDGE_C_API const char* selvedge_last_error(void);

/* ---- The interface of meshoptimizer
 * ------------------------------------------------------------------------------------ */

/* Options of the two functions below, with the numbers that meshoptimizer has for them. */
enum {
  /* No vertex on a border moves: an edge of a triangle without another triangle at the same two positions. */
  selvedge_SimplifyLockBorder = 1 << 0,
  /* Errors are relative to the extent of the vertices that are used, not of the whole buffer. */
  selvedge_SimplifySparse = 1 << 1,
  /* Errors are distances in the unit of the coordinates. */
  selvedge_SimplifyErrorAbsolute = 1 << 2,
  /* Refused (meshoptimizer's Prune, 1 << 3): no piece is ever removed. */
  /* Triangles that get thinner keep an aspect ratio of 0.2, in place of 0.01. */
  selvedge_SimplifyRegularize = 1 << 4,
  /* Accepted without effect: seams move along themselves alone, as without it. */
  selvedge_SimplifyPermissive = 1 << 5,
  /* Likewise 0.1. */
  selvedge_SimplifyRegularizeLight = 1 << 6
};

/* Flags of vertices in `vertex_lock`. */
enum {
  /* The vertex does not move, nor do others at its position. */
  selvedge_SimplifyVertex_Lock = 1 << 0,
  /* Accepted without effect: seams are always protected. */
  selvedge_SimplifyVertex_Protect = 1 << 1,
  /* The vertex is ten times as costly to remove. */
  selvedge_SimplifyVertex_Priority = 1 << 2
};

/* Reduces the number of triangles, by the contract of meshopt_simplify, so that a program can call either
   through one pointer.

   Returns the number of indices written to `destination`, which refer to the caller's vertices: every vertex
   of the result is one of the input, with its attributes. `destination` has room for `index_count` indices,
   and may be `indices`. Triangles stay in order. Those with two corners at one position are left out.

   `vertex_positions` has three floats at the beginning of each vertex; `vertex_positions_stride` is the
   distance between two vertices in bytes, at least 12. `target_index_count` is three times the number of
   triangles wanted. `target_error` is the largest distance between the two surfaces (docs/c.md says where it
   is measured), at least 0, as a share of the extent: the longest side of the bounding box of all vertices.
   From 2 on, it sets no limit. `result_error` may be null; otherwise it gets the largest distance from a
   vertex of either mesh to the surface of the other, in the same unit.

   What is promised beyond meshoptimizer's contract: no triangles intersect that did not before, nor pass
   through each other on the way, decided exactly for the floats as they stand; where the input intersects
   itself, so may what descends from it, and no more of it. The topology of every piece stays. A judge that
   shares no code with the reduction checks each result.

   Returns 0 when it fails, with `destination` and `result_error` as they were: indices out of range or no
   multiple of three, coordinates that are not finite at a vertex in use, an unknown option, or no triangle
   with an area at all. (0 without an error is the answer to `index_count` 0.) A target that cannot be reached
   is no error. */
SELVEDGE_C_API size_t selvedge_simplify(unsigned int* destination, const unsigned int* indices,
                                        size_t index_count, const float* vertex_positions,
                                        size_t vertex_count, size_t vertex_positions_stride,
                                        size_t target_index_count, float target_error, unsigned int options,
                                        float* result_error);

/* The same by the contract of meshopt_simplifyWithAttributes. `vertex_lock` may be null; otherwise it has
   flags for each vertex.

   Weaker than meshoptimizer: `attribute_weights` are checked, but do not change which edges collapse first.
   Attributes are kept all the same: vertices that share a position but not a number are a seam, which stays
   closed and moves along itself alone. `attribute_count` is at most 32; with 0, both arrays may be null. */
SELVEDGE_C_API size_t selvedge_simplifyWithAttributes(
    unsigned int* destination, const unsigned int* indices, size_t index_count, const float* vertex_positions,
    size_t vertex_count, size_t vertex_positions_stride, const float* vertex_attributes,
    size_t vertex_attributes_stride, const float* attribute_weights, size_t attribute_count,
    const unsigned char* vertex_lock, size_t target_index_count, float target_error, unsigned int options,
    float* result_error);

/* ---- Meshes
 * ------------------------------------------------------------------------------------------------------------
 */

/* A triangle mesh with coordinates in double precision, and the attributes of a file that it was read from.
 */
typedef struct selvedge_mesh selvedge_mesh;

/* Copies a mesh: three doubles for each vertex, and three indices for each triangle. Returns null when an
   index is out of range or a coordinate is not finite. */
SELVEDGE_C_API selvedge_mesh* selvedge_mesh_new(const double* positions, size_t vertex_count,
                                                const unsigned int* indices, size_t index_count);

/* Reads a file (.obj, .off, .ply, .stl, .glb, .gltf, .vrm, also with .gz). Returns null when that fails. */
SELVEDGE_C_API selvedge_mesh* selvedge_mesh_read(const char* path);

/* Makes a scene of `selvedge generate` with about this many triangles and this many layers. Returns null when
   there is no scene of this name, or not of this size. */
SELVEDGE_C_API selvedge_mesh* selvedge_mesh_generate(const char* name, size_t triangles, int layers);

/* Writes a file, whole or not at all. In another folder than that of the file that the mesh was read from, or
   the mesh that it was reduced from, it refers to the same material libraries and images. Returns 0, or -1
   when it fails. */
SELVEDGE_C_API int selvedge_mesh_write(const selvedge_mesh* mesh, const char* path);

SELVEDGE_C_API void selvedge_mesh_free(selvedge_mesh* mesh);

/* Counts of vertices and of indices, and the arrays of both: three doubles for each vertex, three indices for
   each triangle. For a null pointer, 0 and null. */
SELVEDGE_C_API size_t selvedge_mesh_vertex_count(const selvedge_mesh* mesh);
SELVEDGE_C_API size_t selvedge_mesh_index_count(const selvedge_mesh* mesh);
SELVEDGE_C_API const double* selvedge_mesh_positions(const selvedge_mesh* mesh);
SELVEDGE_C_API const unsigned int* selvedge_mesh_indices(const selvedge_mesh* mesh);

/* Gives the mesh texture coordinates: two finite doubles for each index, that is for each corner of each
   triangle. Corners at one position that differ in them are on a seam, which a reduction keeps. A null pointer
   takes them away. Returns 0, or -1 when it fails. */
SELVEDGE_C_API int selvedge_mesh_set_uvs(selvedge_mesh* mesh, const double* uvs);

/* Copies the texture coordinates of the mesh, two for each index; those of a file's triangles without a texture
   are 0. Returns 1, or 0 when the mesh has none, in which case nothing is written, or -1 when it fails. */
SELVEDGE_C_API int selvedge_mesh_get_uvs(const selvedge_mesh* mesh, double* uvs);

/* ---- Reduction
 * ---------------------------------------------------------------------------------------------------------
 */

/* What a reduction is asked for. */
typedef struct selvedge_options selvedge_options;

/* Makes options as `selvedge simplify` has them by default: an error of at most 0.01 of the diagonal, and no
 * target. But "placement" is "vertices", so that every vertex of the result is one of the input; "optimal"
 * comes nearer. */
SELVEDGE_C_API selvedge_options* selvedge_options_new(void);
SELVEDGE_C_API void selvedge_options_free(selvedge_options* options);

/* Sets one option: "ratio" to "0.3", "placement" to "optimal", "lock" to the name of a part, and so on. Names
   are those in docs/report.md (without drop_attribute, key_poses, obstacle, polygons, poses, progressive and
   strict), values those of the command line ("true" or "false" for flags); "log" "true" asks for a log.
   "lock", "keep", "drop_part", "part_ratios" ("collar=0.5"), "may_intersect" ("skin:dress") and "lods"
   ("0.5,0.25", for selvedge_reduce_lods) add to what was set before. Returns 0, or -1 when there is no such
   option or value; the error then names the nearest. */
SELVEDGE_C_API int selvedge_options_set(selvedge_options* options, const char* name, const char* value);

/* Copies a mesh that no face may touch or pass through. Null removes it. Returns 0, or -1 when it fails. */
SELVEDGE_C_API int selvedge_options_set_obstacle(selvedge_options* options, const selvedge_mesh* obstacle);

/* Called from time to time during the reduction, possibly in another thread, with the triangles of the input,
   those wanted and those that there are. When it returns a number other than 0, the reduction ends with what
   it has reached. */
typedef int (*selvedge_progress)(void* user, size_t triangles_of_input, size_t target, size_t triangles);

/* Sets this function, or none. Returns 0, or -1 when it fails. */
SELVEDGE_C_API int selvedge_options_set_progress(selvedge_options* options, selvedge_progress progress,
                                                 void* user);

/* A reduced mesh, and how it was made. */
typedef struct selvedge_result selvedge_result;

/* Reduces a mesh, and judges the result. Returns null when an option is out of range, nothing says how far to
   reduce, or the mesh is not acceptable. */
SELVEDGE_C_API selvedge_result* selvedge_reduce(const selvedge_mesh* mesh, const selvedge_options* options);

/* Makes several levels of detail in one run: one for each ratio of the option "lods". `results` gets
   `count` results in the order of the ratios, which must be as many. Each is judged, has its own report and
   the log that led to it, and is freed by selvedge_result_free. The options "ratio" and "faces" must not be
   set. Returns 0, or -1 when it fails, as selvedge_reduce does, with `results` as they were. */
SELVEDGE_C_API int selvedge_reduce_lods(const selvedge_mesh* mesh, const selvedge_options* options,
                                        selvedge_result** results, size_t count);

SELVEDGE_C_API void selvedge_result_free(selvedge_result* result);

/* Returns whether the judge accepts the result (anything else is a defect of Selvedge, unless
   intersection_check is "false"), and whether the target was reached: 1 or 0. For a null pointer, -1. */
SELVEDGE_C_API int selvedge_result_is_accepted(const selvedge_result* result);
SELVEDGE_C_API int selvedge_result_is_reached(const selvedge_result* result);

/* Returns the reduced mesh. */
SELVEDGE_C_API const selvedge_mesh* selvedge_result_mesh(const selvedge_result* result);

/* Returns for every vertex of the reduced mesh the vertex of the input that it is, counted from 0. With the
   placement "optimal", where a vertex is at a new place, it is one of those that were merged there. */
SELVEDGE_C_API const unsigned int* selvedge_result_vertices(const selvedge_result* result);

/* Returns the log of all collapses, for selvedge_replay; empty text unless the option "log" was set. */
SELVEDGE_C_API const char* selvedge_result_log(const selvedge_result* result);

/* Returns a report in JSON, with keys as in docs/report.md. The first call for a result makes it, which takes
   as long as judging; no other thread may use the result meanwhile. */
SELVEDGE_C_API const char* selvedge_result_report(selvedge_result* result);

/* ---- Judges
 * ------------------------------------------------------------------------------------------------------------
 */

/* Judges a mesh exactly, by itself or, where `original` is not null, as a result of reducing that. Returns 1
   when `selvedge verify` would accept it: no triangles intersect or are degenerate (beside those that do in
   the original), every piece has become one, and no layers have changed places. Returns 0 when not, and -1
   when it fails. `pairs` and `new_pairs` may be null; they get the number of pairs of triangles that
   intersect, and how many of them the original does not have. */
SELVEDGE_C_API int selvedge_verify(const selvedge_mesh* mesh, const selvedge_mesh* original, size_t* pairs,
                                   size_t* new_pairs);

/* What the judge says of a mesh, with all figures. */
typedef struct selvedge_verdict selvedge_verdict;

/* Judges like selvedge_verify, by some of the options by which a mesh was reduced; all others have no effect.
   These are the obstacle, which the mesh may not touch or pass through, "clearance", "may_intersect",
   "threads", "drop_part" and "drop_smaller", which leave out the same of the original, and "weld", if it is a
   number: borders of the original may have been joined within this length.
   `options` may be null. Returns null when it fails. */
SELVEDGE_C_API selvedge_verdict* selvedge_verdict_new(const selvedge_mesh* mesh,
                                                      const selvedge_mesh* original,
                                                      const selvedge_options* options);
SELVEDGE_C_API void selvedge_verdict_free(selvedge_verdict* verdict);

/* Returns whether the mesh is accepted: 1 or 0. For a null pointer, -1. */
SELVEDGE_C_API int selvedge_verdict_is_accepted(const selvedge_verdict* verdict);

/* Returns a report in JSON, with the keys of `selvedge verify --report` that are not about files, in
   docs/report.md. For a null pointer, null. */
SELVEDGE_C_API const char* selvedge_verdict_report(const selvedge_verdict* verdict);

/* Repeats a log on the mesh that it was made of, and judges every step by the limits that the log declares,
   but not against an obstacle, nor in further poses, nor by limits of the caller, as `selvedge replay` can.
   Whether the mesh is from the file of which the log has the SHA-256 is not compared. Returns 1 when all are
   accepted, 0 when not, in which case selvedge_last_error() returns the first violation with its step and
   line, and -1 when it fails. */
SELVEDGE_C_API int selvedge_replay(const selvedge_mesh* original, const char* log);

#ifdef __cplusplus
}
#endif

#endif /* SELVEDGE_C_H */
