/* Copyright (c) 2026 the Selvedge authors
   SPDX-License-Identifier: GPL-3.0-or-later */

/* Reduces three close layers to a tenth in an index buffer, as meshoptimizer would, and judges the result. */
#include <selvedge_c.h>

#include <stdio.h>
#include <stdlib.h>

static int failed(void)
{
  const char* error = selvedge_last_error();
  fprintf(stderr, "%s\n", error ? error : "triangles intersect");
  return 1;
}

int main(void)
{
  /* Vertices as a renderer has them: floats, here three for each vertex. */
  selvedge_mesh* scene = selvedge_mesh_generate("sheets", 6000, 3);
  size_t vertex_count = selvedge_mesh_vertex_count(scene), index_count = selvedge_mesh_index_count(scene), i, count, pairs;
  float* vertices = malloc(3 * vertex_count * sizeof(float));
  unsigned int* lod = malloc(index_count * sizeof(unsigned int));
  float error;
  if (!scene || !vertices || !lod)
    return failed();
  for (i = 0; i < 3 * vertex_count; ++i)
    vertices[i] = (float)selvedge_mesh_positions(scene)[i];

  count = selvedge_simplify(lod, selvedge_mesh_indices(scene), index_count, vertices, vertex_count, 3 * sizeof(float),
                            index_count / 10, 0.05f, 0, &error);
  if (count == 0)
    return failed();
  printf("%d of %d triangles, at most %.2g of the size away\n", (int)(count / 3), (int)(index_count / 3), error);

  /* The caller's vertices with the new indices are the result. */
  {
    selvedge_mesh* result = selvedge_mesh_new(selvedge_mesh_positions(scene), vertex_count, lod, count);
    if (selvedge_verify(result, NULL, &pairs, NULL) != 1)
      return failed();
    selvedge_mesh_free(result);
  }
  selvedge_mesh_free(scene);
  free(vertices);
  free(lod);
  return 0;
}
