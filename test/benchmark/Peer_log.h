// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef SELVEDGE_BENCHMARK_PEER_LOG_H
#define SELVEDGE_BENCHMARK_PEER_LOG_H

#include <selvedge/Error.h>
#include <selvedge/Sha256.h>
#include <selvedge/collapse_log.h>
#include <selvedge/mesh_files.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace selvedge::benchmark {

/// The log of what a peer does to the mesh of a file, for `selvedge replay`. It does the same collapses to a
/// list of triangles, and so knows whether its log leads to the peer's own result.
class Peer_log
{
public:
  Peer_log(const std::string& path, const Mesh_file& file)
      : m_numbering(file.soup, file.format == Mesh_format::stl), m_writer(m_stream, header(path, file)),
        m_triangles(file.soup.triangles), m_vertices(file.soup.points.size()),
        m_triangles_at(file.soup.points.size())
  {
    std::iota(m_vertices.begin(), m_vertices.end(), Index(0));
    for (Index t = 0; t < m_triangles.size(); ++t)
      for (const Index vertex : m_triangles[t])
        m_triangles_at[vertex].push_back(t);
    m_is_alive.assign(m_triangles.size(), true);
  }

  /// To be called for every collapse, in order: `removed` goes to where `kept` is, and what they have become
  /// is called `survivor` by the peer, which is one of the two. All are the peer's numbers, at first those of
  /// the file.
  void add(std::size_t removed, std::size_t kept, std::size_t survivor)
  {
    const Index from = m_vertices[removed], to = m_vertices[kept];
    Log_step step;
    step.removed = m_numbering.number(from);
    step.kept = m_numbering.number(to);
    m_writer.write(step);
    ++m_collapses;
    for (const Index t : m_triangles_at[from]) {
      Index_triple& triangle = m_triangles[t];
      if (!m_is_alive[t])
        continue;
      m_is_alive[t] = std::find(triangle.begin(), triangle.end(), to) == triangle.end();
      std::replace(triangle.begin(), triangle.end(), from, to);
      m_triangles_at[to].push_back(t);
    }
    m_triangles_at[from].clear();
    m_vertices[survivor] = to;
  }

  /// The whole log. `triangles` is the peer's result, in its own numbers; throws `Error` where these are not
  /// the triangles that the log leads to.
  std::string text(std::vector<Index_triple> triangles)
  {
    for (Index_triple& triangle : triangles)
      for (Index& vertex : triangle)
        vertex = m_vertices[vertex];
    std::vector<Index_triple> own;
    Sha256 sha256;
    for (Index t = 0; t < m_triangles.size(); ++t)
      if (m_is_alive[t]) {
        own.push_back(m_triangles[t]);
        const auto number = [&](std::size_t k) {
          return std::to_string(m_numbering.number(m_triangles[t][k]));
        };
        sha256.add(number(0) + ' ' + number(1) + ' ' + number(2) + '\n');
      }
    if (sorted(own) != sorted(std::move(triangles)))
      throw Error("the log does not lead to the triangles that the program has made");
    m_writer.write(Log_result{m_collapses, own.size(), sha256.digest()});
    return m_stream.str();
  }

private:
  static Log_header header(const std::string& path, const Mesh_file& file)
  {
    Log_header header;
    header.vertices = Log_numbering(file.soup, file.format == Mesh_format::stl).size();
    header.triangles = file.soup.triangles.size();
    header.sha256 = sha256_of_file(path);
    return header;
  }

  static std::vector<Index_triple> sorted(std::vector<Index_triple> triangles)
  {
    for (Index_triple& triangle : triangles)
      std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  }

  const Log_numbering m_numbering;
  std::ostringstream m_stream;
  Log_writer m_writer;
  std::vector<Index_triple> m_triangles; // of the file's vertices
  std::vector<char> m_is_alive;          // by triangle
  std::vector<Index> m_vertices;         // of the file, by the peer's numbers: where these are
  std::vector<std::vector<Index>> m_triangles_at;
  std::size_t m_collapses = 0;
};

/// The main function of a program that writes the log of a peer: `reduce(soup, faces, log)` has the peer
/// reduce the soup to so many faces, adds every collapse to the log, and returns the triangles left, in the
/// peer's numbers.
template <class Reduce>
int write_peer_log(int argc, char** argv, const std::string& description, const Reduce& reduce)
{
  CLI::App app(description);
  std::string mesh, log;
  double ratio = 0.3;
  app.add_option("MESH", mesh, "The mesh to reduce, a manifold without two vertices at one position")
      ->required();
  app.add_option("LOG", log, "Where the log goes")->required();
  app.add_option("--ratio", ratio, "Share of the faces to keep")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
    const Mesh_file file = read_mesh(mesh);
    Peer_log peer_log(mesh, file);
    const auto faces = static_cast<std::size_t>(ratio * static_cast<double>(file.soup.triangles.size()));
    write_file(log, peer_log.text(reduce(file.soup, faces, peer_log)));
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << std::endl;
    return 1;
  }
}

} // namespace selvedge::benchmark

#endif // SELVEDGE_BENCHMARK_PEER_LOG_H
