// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Collapses the shortest edges first, in floats, without looking at other layers, and logs every collapse:
//   naive_simplifier IN.obj RATIO > OUT.log
// It stands for the program that you want to have judged; docs/validate_your_simplifier.md judges this one.

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
  if (argc != 3)
    return 2;
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<int, 3>> faces;
  std::ifstream file(argv[1]);
  for (std::string line, word; std::getline(file, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "v" && points.emplace_back().size() == 3)
      words >> points.back()[0] >> points.back()[1] >> points.back()[2];
    if (word == "f" && faces.emplace_back().size() == 3)
      for (int& corner : faces.back()) {
        words >> word;
        corner = std::stoi(word) - 1; // what follows a slash is texture and normal
      }
  }
  std::cout << "selvedge-log 1\ninput " << points.size() << ' ' << faces.size() << " -\n";
  const std::size_t target = std::size_t(std::stof(argv[2]) * float(faces.size()));
  std::size_t left = faces.size(), collapses = 0, before = 0;
  while (left > target && left != before) {
    before = left;
    std::vector<std::vector<int>> faces_at(points.size());
    std::set<std::array<float, 3>> edges; // squared length, ends; exact in floats up to 2^24 vertices
    for (int f = 0; f < int(faces.size()); ++f)
      for (int k = 0; k < 3 && faces[f][0] >= 0; ++k) {
        const int u = faces[f][k], v = faces[f][(k + 1) % 3];
        float length = 0;
        for (int i = 0; i < 3; ++i)
          length += (points[u][i] - points[v][i]) * (points[u][i] - points[v][i]);
        edges.insert({length, float(u), float(v)});
        faces_at[u].push_back(f);
      }
    std::vector<bool> is_touched(points.size(), false);
    for (const auto& [length, from, to] : edges) {
      const int u = int(from), v = int(to);
      if (is_touched[u])
        continue;
      std::multiset<int> ring; // of an inner vertex: each neighbour twice
      for (const int f : faces_at[u])
        for (const int corner : faces[f])
          if (corner != u)
            ring.insert(corner);
      std::set<int> common;
      for (const int f : faces_at[v])
        for (const int corner : faces[f])
          if (ring.count(corner) > 0)
            common.insert(corner);
      common.erase(v);
      const bool is_inner = std::all_of(ring.begin(), ring.end(), [&](int w) { return ring.count(w) == 2; });
      const bool is_free = std::none_of(ring.begin(), ring.end(), [&](int w) { return is_touched[w]; });
      if (!is_free || !is_inner || common.size() != 2 || left <= target)
        continue;
      //! [log]
      std::cout << "c " << u << ' ' << v << '\n';
      //! [log]
      ++collapses;
      left -= 2;
      is_touched[u] = true;
      for (const int w : ring)
        is_touched[w] = true;
      for (const int f : faces_at[u]) {
        const bool is_gone = std::count(faces[f].begin(), faces[f].end(), v) > 0;
        std::replace(faces[f].begin(), faces[f].end(), u, v);
        if (is_gone)
          faces[f] = {-1, -1, -1};
      }
    }
  }
  std::cout << "result " << collapses << ' ' << left << " -\n";
}
