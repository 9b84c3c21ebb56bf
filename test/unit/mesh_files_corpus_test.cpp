// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Nasty little files, each with the one defect that its name says, and what must become of it.

#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using namespace selvedge;
using namespace std::string_literals;

namespace {

struct Entry
{
  const char* name;
  Mesh_format format;
  std::string contents;
  std::string refusal;      ///< What the message says after the file's name; empty when the file is read.
  std::size_t vertices = 0; ///< What is read when it is.
  std::size_t triangles = 0;
  std::string note = {}; ///< A line that `describe` must contain; with none, there must be no lines at all.
};

void PrintTo(const Entry& entry, std::ostream* stream)
{
  *stream << entry.name;
}

constexpr Mesh_format obj = Mesh_format::obj, off = Mesh_format::off, ply = Mesh_format::ply,
                      stl = Mesh_format::stl;

const std::string corner = "v 0 0 0\nv 4 0 0\nv 0 4 0\n";

std::string ply_header(const std::string& format, const std::string& vertex_count,
                       const std::string& face_count)
{
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertex_count +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + face_count +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string ply_points = "0 0 0\n4 0 0\n0 4 0\n";

std::string stl_facet(const std::string& third)
{
  return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 4 0 0\nvertex " + third +
         "\nendloop\nendfacet\n";
}

/// A polygon that bears numbers.
std::string ply_polygon(std::size_t corners, std::size_t numbers)
{
  std::string header = ply_header("ascii", std::to_string(corners), "1"), points, polygon, values;
  header.erase(header.find("uchar"), 5).insert(header.find("int vertex"), "uint ");
  for (std::size_t i = 0; i < numbers; ++i) {
    header.insert(header.find("end_header"), "property double a" + std::to_string(i) + "\n");
    values += " 0";
  }
  for (std::size_t i = 0; i < corners; ++i) {
    points += std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    polygon += " " + std::to_string(i);
  }
  return header + points + std::to_string(corners) + polygon + values + "\n";
}

/// A binary STL that announces `announced` facets and holds `held`, all zero.
std::string stl_binary(unsigned char announced, std::size_t held)
{
  std::string bytes(80, 'x');
  bytes += static_cast<char>(announced);
  return bytes + std::string(3 + 50 * held, '\0');
}

const std::vector<Entry>& corpus()
{
  static const std::vector<Entry> entries = {
      // Numbers
      {"ObjNanCoordinate", obj, corner + "v 1 nan 1\nf 1 2 4\n",
       ":4: vertex 4 has a coordinate that is not finite"},
      {"ObjNanUnreferenced", obj, corner + "f 1 2 3\nv -nan 0 0\n",
       ":5: vertex 4 has a coordinate that is not finite"},
      {"ObjInfinity", obj, corner + "v 1 1 -inf\nf 1 2 4\n",
       ":4: vertex 4 has a coordinate that is not finite"},
      {"ObjInfinityInFull", obj, corner + "v infinity 1 1\nf 1 2 4\n", ":4: vertex 4 "},
      {"ObjOverflow", obj, corner + "v 1e309 0 0\nf 1 2 3\n",
       ":4: vertex 4 has a coordinate that is not finite"},
      {"ObjOverflowWithoutExponent", obj, corner + "v " + std::string(310, '9') + " 0 0\nf 1 2 3\n",
       ":4: vertex 4 "},
      {"ObjUnderflow", obj, corner + "v 1e-400 -1e-99999 0\nf 1 2 4\n", "", 4, 1},
      {"ObjUnderflowWithoutExponent", obj, corner + "v 0." + std::string(400, '0') + "1 0 0\nf 1 2 4\n", "",
       4, 1},
      {"ObjDenormal", obj, "v 0 0 0\nv 3e-320 0 0\nv 0 5e-324 0\nf 1 2 3\n", "", 3, 1},
      {"ObjHuge", obj, "v 0 0 0\nv 1e300 0 0\nv 0 1e300 0\nf 1 2 3\n", "", 3, 1},
      {"ObjPlusSigns", obj, "v +0 +0.5 +1e+1\nv 4 0 0\nv 0 4 0\nf +1 +2 +3\n", "", 3, 1},
      {"ObjTwoSigns", obj, corner + "v +-1 0 0\nf 1 2 3\n", ":4: '+-1' is not a number"},
      {"ObjDecimalComma", obj, corner + "v 0,5 0 0\nf 1 2 3\n",
       ":4: '0,5' is not a number; write decimals with a point"},
      {"ObjHexadecimal", obj, corner + "v 0x10 0 0\nf 1 2 3\n", ":4: '0x10' is not a number"},
      {"ObjMicrosoftNan", obj, corner + "v 1.#QNAN 0 0\nf 1 2 3\n", ":4: '1.#QNAN' is not a number"},
      {"ObjTwoCoordinates", obj, corner + "v 1 2\nf 1 2 3\n",
       ":4: the line ends where a number should stand"},
      {"ObjNanTextureCoordinate", obj, corner + "vt nan 0\nf 1 2 3\n",
       ":4: texture coordinate 1 is not finite"},

      // Indices
      {"ObjIndexZero", obj, corner + "f 1 0 2\n", ":4: a face names vertex 0, but OBJ files count from 1"},
      {"ObjIndexTooLarge", obj, corner + "f 1 2 3\nf 1 2 4\n",
       ":5: a face names vertex 4, but there are only 3"},
      {"ObjIndexTooSmall", obj, corner + "f -1 -2 -4\n",
       ":4: a face names vertex -4, but there are only 3 above it"},
      {"ObjIndexHuge", obj, corner + "f 1 2 4294967297\n", ":4: a face names vertex 4294967297"},
      {"ObjIndexBeyond64Bits", obj, corner + "f 1 2 99999999999999999999\n", "is not an integer"},
      {"ObjIndexFraction", obj, corner + "f 1 2 3.5\n", ":4: a corner of a face is followed by '.5'"},
      {"ObjTextureIndexTooLarge", obj, corner + "vt 0 0\nf 1/1 2/2 3/1\n",
       ":5: a face names texture coordinate 2, but there are only 1; correct or remove the face, or all "
       "lines "
       "that begin with 'vt' to do without texture coordinates"},
      {"ObjTextureIndicesWithoutCoordinates", obj, corner + "vn 0 0 1\nf 1/1/1 2/2/1 3/-3/1\n", "", 3, 1,
       "not carried, numbers of texture coordinates in a file without any: 3"},
      {"ObjNormalIndicesWithoutNormals", obj, corner + "f 1//1 2//1 3//1\nf 3//2 2//2 1//0\n", "", 3, 2,
       "not carried, numbers of normals in a file without any: 6"},
      {"ObjNormalIndexZero", obj, corner + "vn 0 0 1\nf 1//0 2//0 3//0\nf 3//1 2//1 1//1\n", "", 3, 2,
       "not carried, numbers 0 of normals: 3"},
      {"ObjRelativeIndices", obj, corner + "f -3 -2 -1\nv 9 9 9\nf -4 -3 -1\n", "", 4, 2},
      {"ObjFaceAboveItsVertices", obj, "f 1 2 3\n" + corner, "", 3, 1},
      {"ObjRelativeIndexAboveItsVertices", obj, "f -1 -2 -3\n" + corner, ":1: a face names vertex -1"},

      // Faces
      {"ObjRepeatedCorner", obj, corner + "f 1 2 2\nf 1 2 3\n", "", 3, 2,
       "faces that name a vertex more than once, kept: 1"},
      {"ObjTwoCorners", obj, corner + "f 1 3\nf 1 2 3\n", "", 3, 1,
       "faces of fewer than three corners, skipped: 1"},
      {"ObjNoCorners", obj, corner + "f\nf 1 2 3\n", "", 3, 1,
       "faces of fewer than three corners, skipped: 1"},
      {"ObjOnlyTwoCorners", obj, corner + "f 1 2\n", ": the file has no faces of three or more corners"},
      {"ObjOnePosition", obj, "v 7 7 7\nv 7 7 7\nv 7 7 7\nf 1 2 3\n", "", 3, 1},
      {"ObjFlatQuad", obj, "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n", "", 4, 2,
       "faces of more than three corners, cut into triangles: 1"},
      {"ObjCrossedQuad", obj, "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n", "", 4, 2,
       "faces of more than three corners, cut into triangles: 1"},

      // Lines
      {"ObjWindowsLineEnds", obj, "v 0 0 0\r\nv 4 0 0\r\nv 0 4 0\r\nf 1 2 3\r\n", "", 3, 1},
      {"ObjContinuedLines", obj, "v 0 \\\n0 0\nv 4 0 0\nv 0 4 0\nf 1\\\r\n 2 \\\n\\\n3\n", "", 3, 1},
      {"ObjContinuedIntoNothing", obj, corner + "f 1 2 3 \\", ":4: '\\' is not an integer"},
      {"ObjCommentEndsInBackslash", obj, "# C:\\meshes\\\n" + corner + "f 1 2 3\n", "", 3, 1},
      {"ObjCommentAfterStatement", obj, corner + "f 1 2 3 # the only one\n", "", 3, 1},
      {"ObjCommentAfterIgnoredStatement", obj, "vn 0 0 1 # C:\\\n" + corner + "f 1 2 3 # C:\\\nf -1 -2 -3\n",
       "", 3, 2, "not carried, normals that no face names: 1"},
      {"ObjCommentWithoutBlank", obj, "v 0 0 0#one\n" + corner, ":1: '0#one' is not a number"},
      {"ObjColumnWithHash", obj, "v 0 0 0 a#b \\\n" + corner + "f -3 -2 -1\n", "", 4, 1,
       "not carried, vertex columns: 1"},
      {"ObjGroupContinued", obj, "g all\\\n v 1 1 1\n" + corner + "f 1 2 3\n", "", 3, 1},
      {"ObjTabsAndIndent", obj, "\t v\t0 0 0\n  v 4\t0\t0\nv 0 4 0  \n \tf 1\t2 3\t\n", "", 3, 1},
      {"ObjNoLastLineEnd", obj, corner + "f 1 2 3", "", 3, 1,
       "lines that are not ended, as at the end of a truncated file: 1"},
      {"ObjByteOrderMark", obj, "\xef\xbb\xbf" + corner + "f 1 2 3\n", "", 3, 1},

      // What is not carried
      {"ObjNormals", obj, corner + "vn 0 0 1\nf 1//1 2//1 3//1\n", "", 3, 1},
      {"ObjNormalIndexTooLarge", obj, corner + "vn 0 0 1\nf 1//1 2//2 3//1\n", ":5: a face names normal 2"},
      {"ObjNormalsAtSomeCorners", obj, corner + "vn 0 0 1\nf 1//1 2//1 3\nf 3//1 2//1 1//1\n", "", 3, 2,
       "not carried, normals of faces that have them at some corners only: 1"},
      {"ObjNormalNotFinite", obj, corner + "vn nan nan nan\nf 1//1 2//1 3//1\n", "", 3, 1},
      {"ObjWeights", obj, "v 0 0 0 0.5\nv 4 0 0\nv 0 4 0\nf 1 2 3\n", "", 3, 1},
      {"ObjColours", obj, "v 0 0 0 1 0 0\nv 4 0 0 1 0 0\nv 0 4 0\nf 1 2 3\n", "", 3, 1},
      {"ObjColourNan", obj, "v 0 0 0 nan 0 0\nv 4 0 0 1 0 0\nv 0 4 0 nan\nf 1 2 3\n", "", 3, 1,
       "not carried, vertex columns: 2"},
      {"ObjTwoFurtherColumns", obj, "v 0 0 0 1 2\nv 4 0 0\nv 0 4 0\nf 1 2 3\n", "", 3, 1,
       "not carried, vertex columns: 1"},
      {"ObjFiveFurtherColumns", obj, "v 0 0 0 1 2 3 4 5\nv 4 0 0\nv 0 4 0\nf 1 2 3\n", "", 3, 1,
       "not carried, vertex columns: 1"},
      {"ObjThirdTextureCoordinate", obj, corner + "vt 0 0 0\nvt 1 0 0.5\nf 1/1 2/2 3/2\n", "", 3, 1,
       "not carried, third texture coordinates: 1"},
      {"ObjLines", obj, corner + "l 1 2 3\nf 1 2 3\n", "", 3, 1, "not carried, line elements: 1"},
      {"ObjPoints", obj, corner + "p 1\np 2\nf 1 2 3\n", "", 3, 1, "not carried, point elements: 2"},
      {"ObjMaterials", obj, corner + "usemtl wool\nf 1 2 3\n", "", 3, 1},
      {"ObjUnusedMaterial", obj, corner + "usemtl wool\nusemtl silk\nf 1 2 3\n", "", 3, 1,
       "not carried, materials without faces: 1"},
      {"ObjUnknownStatement", obj, corner + "curv 0 1 1 2\nf 1 2 3\n", "", 3, 1,
       "not carried, statements 'curv': 1"},
      {"ObjPartOfTextureCoordinates", obj, corner + "vt 0 0\nf 1/1 2/1 3/1\nf 1 2 3\n", "", 3, 2},
      {"ObjTextureCoordinatesAtSomeCorners", obj, corner + "vt 0 0\nf 1/1 2/1 3\n", "", 3, 1,
       "not carried, texture coordinates of faces that have them at some corners only: 1"},
      {"ObjTextureCoordinatesOfNoFace", obj, corner + "vt 0 0\nf 1 2 3\n", "", 3, 1,
       "not carried, texture coordinates that no face names: 1"},
      {"ObjEmptyGroup", obj, corner + "g nothing\ng all\nf 1 2 3\n", "", 3, 1,
       "not carried, groups without faces: 1"},
      {"ObjGroupsWithoutName", obj, "g\n" + corner + "g\nf 1 2 3\n", "", 3, 1},

      // Nothing there
      {"ObjEmpty", obj, "", ": the file is empty"},
      {"ObjOnlyComment", obj, "# there was something here\n", ": the file has no faces"},
      {"ObjOnlyVertices", obj, corner, ": the file has no faces"},
      {"ObjOnlyLines", obj, corner + "l 1 2\n", ": the file has no faces, only points or lines"},
      {"ObjUtf16", obj, "\xff\xfev\0 \0"s, ": the text of the file is in UTF-16; save it in UTF-8 or ASCII"},
      {"ObjGitLfs", obj, "version https://git-lfs.github.com/spec/v1\n",
       ": this is only a pointer of Git LFS"},
      {"ObjWebPage", obj, "<!DOCTYPE html>\n", ": this is a web page"},
      {"ObjOnlyLineEnds", obj, "\n\r\n\n", ": the file has no faces"},
      {"ObjBinaryRubbish", obj, "\0\xff\x01 7\n\xfe\0\0\n"s, ": the file has no faces"},

      // OFF
      {"OffPlain", off, "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n", "", 3, 1},
      {"OffCountsBesideKeyword", off, "OFF 3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2", "", 3, 1},
      {"OffWithoutKeyword", off, "3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n", "", 3, 1},
      {"OffWithoutEdgeCount", off, "OFF\n3 1\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n", "", 3, 1},
      {"OffComments", off,
       "# one\nOFF # two\n\n# three\n3 1 0\n0 0 0 # four\n\n4 0 0\n0 4 0\n3 0 1 2\n# five\n", "", 3, 1},
      {"OffWindowsLineEnds", off, "OFF\r\n3 1 0\r\n0 0 0\r\n4 0 0\r\n0 4 0\r\n3 0 1 2\r\n", "", 3, 1},
      {"OffVertexColours", off, "COFF\n3 1 0\n0 0 0 255 0 0 255\n4 0 0 0 0 0 255\n0 4 0 0 0 0 255\n3 0 1 2\n",
       "", 3, 1, "not carried, further columns of vertices (normals, colours, texture coordinates): 3"},
      {"OffFaceColours", off, "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2 255 128 0\n", "", 3, 1,
       "not carried, further columns of faces (colours): 1"},
      {"OffLinesAfterTheLastFace", off, "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n3 2 1 0\n", "", 3, 1,
       "not carried, lines after the last face: 1"},
      {"OffTwoCorners", off, "OFF\n3 2 0\n0 0 0\n4 0 0\n0 4 0\n2 0 1\n3 0 1 2\n", "", 3, 1,
       "faces of fewer than three corners, skipped: 1"},
      {"OffFourDimensions", off, "4OFF\n3 1 0\n", ":1: the header is '4OFF'"},
      {"OffOtherKeyword", off, "SOLID\n3 1 0\n", ":1: the header is 'SOLID'"},
      {"OffBinary", off, "OFF BINARY\n3 1 0\n", ":1: the header continues with 'BINARY'"},
      {"OffIndexTooLarge", off, "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 3\n", ":6: face 0 names vertex 3"},
      {"OffIndexNegative", off, "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 -1\n", ":6: face 0 names vertex -1"},
      {"OffNanCoordinate", off, "OFF\n3 1 0\n0 0 0\n4 nan 0\n0 4 0\n3 0 1 2\n",
       ":4: vertex 1 has a coordinate"},
      {"OffCountTooLarge", off, "OFF\n4000000000 1 0\n0 0 0\n",
       ":2: the header announces 4000000000 vertices"},
      {"OffCountNegative", off, "OFF\n-3 1 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n",
       ":2: the header announces -3 vertices"},
      {"OffFaceTooLong", off, "OFF\n3 1 0\n0 0 0\n4 0 0\n0 4 0\n2000000000 0 1 2\n",
       ":6: the header announces 2000000000"},
      {"OffCutShort", off, "OFF\n3 2 0\n0 0 0\n4 0 0\n0 4 0\n3 0 1 2\n", "the file ends before face 1 of 2"},
      {"OffOnlyHeader", off, "OFF\n", "the file ends after its header"},
      {"OffEmpty", off, "", ": the file is empty"},
      {"OffOnlyComment", off, "# nothing\n", "the file has no header"},
      {"OffNoFaces", off, "OFF\n3 0 0\n0 0 0\n4 0 0\n0 4 0\n", ": the file has no faces"},

      // PLY
      {"PlyAscii", ply, ply_header("ascii", "3", "1") + ply_points + "3 0 1 2\n", "", 3, 1},
      {"PlyAsciiNoLastLineEnd", ply, ply_header("ascii", "3", "1") + ply_points + "3 0 1 2", "", 3, 1},
      {"PlyFacesFirst", ply,
       "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 4\n"
       "property double x\nproperty double y\nproperty double z\nend_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 "
       "0\n0 1 0\n",
       "", 4, 2, "faces of more than three corners, cut into triangles: 1"},
      {"PlyFurtherProperties", ply,
       "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 3\nproperty uchar red\nproperty double "
       "z\n"
       "property double y\nproperty list int float history\nproperty double x\nelement face 1\n"
       "property int flags\nproperty list uchar uint vertex_indices\nelement edge 1\nproperty int "
       "a\nproperty int b\n"
       "end_header\n7 0 0 2 8 8 0\n7 0 0 0 4\n7 0 4 1 8 0\n5 3 0 1 2\n0 1\n",
       "", 3, 1, "not carried, elements 'edge': 1"},
      {"PlyLists", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "property list int float history\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0 2 8 8\n4 0 0 0\n0 4 0 1 8\n3 0 1 2\n",
       "", 3, 1, "not carried, values of the vertex property 'history': 3"},
      {"PlyValueNotOfItsType", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "property uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0 0 255\n4 0 0 256\n0 4 0 7\n3 0 1 2\n",
       ":12: the value 256 is not of the type uchar"},
      {"PlyTextureCoordinateNotFinite", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "property float s\nproperty float t\nelement face 1\nproperty list uchar int "
       "vertex_indices\nend_header\n"
       "0 0 0 0 0\n4 0 0 inf 0\n0 4 0 7 0\n3 0 1 2\n",
       ":13: vertex 1 has a texture coordinate that is not finite"},
      {"PlyTextureCoordinatesNotTwoToACorner", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float "
       "texcoord\nend_header\n" +
           ply_points + "3 0 1 2 5 0 0 1 0 1\n",
       "", 3, 1, "not carried, texture coordinates of faces, not two to a corner: 1"},
      {"PlyPolygonOfManyCornersAndAttributes", ply, ply_polygon(3000, 300),
       ": the attributes of the polygons take more than 64 times the size of the file"},
      {"PlyPolygonOfManyCorners", ply, ply_polygon(3000, 3), "", 3000, 2998,
       "faces of more than three corners, cut into triangles: 1"},
      {"PlyIndexTooLarge", ply, ply_header("ascii", "3", "1") + ply_points + "3 0 1 3\n",
       ":13: face 0 names vertex 3"},
      {"PlyIndexNegative", ply, ply_header("ascii", "3", "1") + ply_points + "3 0 1 -1\n",
       ":13: face 0 names vertex -1"},
      {"PlyNanCoordinate", ply, ply_header("ascii", "3", "1") + "0 0 0\n4 0 nan\n0 4 0\n3 0 1 2\n",
       ":11: vertex 1 "},
      {"PlyBinaryNanCoordinate", ply,
       ply_header("binary_little_endian", "1", "1") +
           "\0\0\xc0\x7f\0\0\0\0\0\0\0\0\3\0\0\0\0\0\0\0\0\0\0\0\0"s,
       ": vertex 0 has a coordinate that is not finite"},
      {"PlyCountTooLarge", ply, ply_header("ascii", "4000000000", "1") + ply_points + "3 0 1 2\n",
       "the header announces 4000000000 elements 'vertex'"},
      {"PlyBinaryCountTooLarge", ply,
       ply_header("binary_big_endian", "9000000000000000000", "1") + "\0\0\0\0"s,
       ": the header announces 9000000000000000000 elements 'vertex'"},
      {"PlyCountNegative", ply, ply_header("ascii", "-3", "1") + ply_points,
       ":3: the element 'vertex' has a negative"},
      {"PlyBinaryCutShort", ply,
       ply_header("binary_little_endian", "1", "1") + std::string(12, '\0') + "\3\0\0"s,
       ": a list 'vertex_indices' has a length of 3, which the file cannot hold"},
      {"PlyAsciiCutShort", ply, ply_header("ascii", "3", "2") + ply_points + "3 0 1 2\n",
       ":14: the file ends after 1 of the 2 elements 'face' that the header announces; it is cut short"},
      {"PlyAsciiCutShortInVertices", ply, ply_header("ascii", "4", "1") + ply_points + std::string(9, '\n'),
       "the file ends after 3 of the 4 elements 'vertex'"},
      {"PlyBinaryCutShortInFaces", ply,
       ply_header("binary_little_endian", "1", "2") + std::string(12, '\0') + '\3' + std::string(12, '\0'),
       ": the file ends after 1 of the 2 elements 'face'"},
      {"PlyHeaderCutShort", ply, "ply\nformat ascii 1.0\nelement vertex 3\n",
       ":4: the file ends within its header"},
      {"PlyNoFormat", ply, "ply\nelement vertex 0\nend_header\n", "the header names no format"},
      {"PlyUnknownFormat", ply, "ply\nformat binary 1.0\nend_header\n", ":2: the format 'binary' is none of"},
      {"PlyUnknownType", ply, "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n",
       ":4: the header has an unknown type"},
      {"PlyLengthsNoIntegers", ply,
       "ply\nformat ascii 1.0\nelement face 1\nproperty list float int vertex_indices\n",
       ":4: the lengths of a list are no integers"},
      {"PlyPropertyOfNothing", ply, "ply\nformat ascii 1.0\nproperty float x\n",
       ":3: a property stands before"},
      {"PlyTriangleStrips", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
           ply_points + "5 0 1 2 -1 3\n",
       "a triangle strip names vertex 3"},
      {"PlyPointCloud", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
       "z\nend_header\n" +
           ply_points,
       "no element 'face'; export the file as a mesh"},
      {"PlyListWithoutFaces", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "property list uchar int vertex_indices\nend_header\n" +
           ply_points + "3 0 1 2\n",
       "no element 'face', whose list of vertices it has; write 'element face'"},
      {"PlyNoVertices", ply,
       "ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n",
       "no element 'vertex'"},
      {"PlyNoHeight", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0\n4 0\n0 4\n3 0 1 2\n",
       "the vertices lack one of the properties x, y, z"},
      {"PlyWindowsLineEnds", ply,
       "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty "
       "float z\r\n"
       "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n0 0 0\r\n4 0 0\r\n0 4 "
       "0\r\n3 0 1 2\r\n",
       "", 3, 1},
      {"PlyHeaderLineOfText", ply,
       "ply\nCreated by a program\n" + ply_header("ascii", "3", "1").substr(4) + ply_points + "3 0 1 2\n", "",
       3, 1, "not carried, lines of the header that PLY does not know: 1"},
      {"PlyMisspeltElement", ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "elemnt face 1\nproperty list uchar int vertex_indices\nend_header\n" +
           ply_points + "3 0 1 2\n",
       ":7: the header has an unknown statement 'elemnt'"},
      {"PlyNoFaces", ply, ply_header("ascii", "3", "0") + ply_points, ": the file has no faces"},
      {"PlyEmpty", ply, "", ": the file is empty"},
      {"PlyNoPly", ply, "solid\n", ":1: the first line is not 'ply'"},

      // STL
      {"StlAscii", stl, "solid\n" + stl_facet("0 4 0") + "endsolid\n", "", 3, 1},
      {"StlNegativeZeros", stl, "solid\n" + stl_facet("0 4 -0") + stl_facet("-0 4 0") + "endsolid\n", "", 3,
       2},
      {"StlTwoSolids", stl,
       "solid a\n" + stl_facet("0 4 0") + "endsolid a\nsolid b\n" + stl_facet("0 5 0") + "endsolid b\n", "",
       4, 2, "not carried, names of solids: 2"},
      {"StlDegenerateFacet", stl, "solid\n" + stl_facet("4 0 0") + "endsolid\n", "", 2, 1,
       "faces that name a vertex more than once, kept: 1"},
      {"StlNanCoordinate", stl, "solid\n" + stl_facet("0 nan 0") + "endsolid\n",
       ":6: a corner has a coordinate"},
      {"StlFourCorners", stl, "solid\n" + stl_facet("0 4 0\nvertex 1 1 1") + "endsolid\n",
       ":7: 'vertex' stands where 'endloop' should"},
      {"StlAsciiCutShort", stl, "solid\n" + stl_facet("0 4 0"), "the file ends where 'facet' should"},
      {"StlNoFacets", stl, "solid nothing\nendsolid nothing\n", ": the file has no faces"},
      {"StlBinary", stl, stl_binary(2, 2), "", 1, 2, "faces that name a vertex more than once, kept: 2"},
      {"StlBinaryCutShort", stl, stl_binary(2, 1),
       ": the header announces 2 facets, but the file ends after 1"},
      {"StlBinaryFurtherBytes", stl, stl_binary(1, 1) + "!!", "", 1, 1,
       "not carried, bytes after the last facet: 2"},
      {"StlBinaryNoFacets", stl, stl_binary(0, 0), ": the file has no faces"},
      {"StlBinaryBeginsWithSolid", stl, "solid" + stl_binary(1, 1).substr(5), "", 1, 1,
       "faces that name a vertex more than once, kept: 1"},
      {"StlTooShort", stl, "nothing", ": the file is too short for an STL file"},
      {"StlEmpty", stl, "", ": the file is empty"},
  };
  return entries;
}

class Mesh_files_corpus : public testing::TestWithParam<Entry>
{
};

TEST_P(Mesh_files_corpus, ComesOutAsListed)
{
  const Entry& entry = GetParam();
  SCOPED_TRACE(entry.contents);
  try {
    const Mesh_file file = read_mesh(entry.contents, entry.format, "nasty");
    ASSERT_EQ(entry.refusal, "") << "was read";
    EXPECT_EQ(file.soup.points.size(), entry.vertices);
    EXPECT_EQ(file.soup.triangles.size(), entry.triangles);
    const std::vector<std::string> lines = describe(file.notes);
    if (entry.note.empty())
      EXPECT_EQ(lines, std::vector<std::string>());
    else
      EXPECT_EQ(std::count(lines.begin(), lines.end(), entry.note), 1) << testing::PrintToString(lines);
  } catch (const Input_error& error) {
    const std::string message = error.what();
    ASSERT_NE(entry.refusal, "") << message;
    EXPECT_EQ(message.rfind("nasty:", 0), 0u) << message;
    EXPECT_NE(message.find(entry.refusal), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Entry, Mesh_files_corpus, testing::ValuesIn(corpus()),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST(MeshFilesCorpus, IsNotEmpty)
{
  EXPECT_GT(corpus().size(), 100u);
}

} // namespace
