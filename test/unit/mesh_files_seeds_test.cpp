// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// What the fuzzers start from, and what they have found: every file is read and survives the way to a file
// and back, or is refused.

#include "support/round_trip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace selvedge::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> seeds()
{
  std::vector<fs::path> result;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(SELVEDGE_FUZZ_SEEDS))
    if (entry.is_regular_file())
      result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

std::string name(const fs::path& path)
{
  std::string result = path.parent_path().filename().string() + '_' + path.stem().string();
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return result;
}

class Seeds : public testing::TestWithParam<fs::path>
{
};

TEST_P(Seeds, AreRefusedOrSurviveWritingAndReading)
{
  std::ifstream stream(GetParam(), std::ios::binary);
  const std::string contents(std::istreambuf_iterator<char>(stream), {});
  const std::string kind = GetParam().parent_path().filename().string();
  const bool is_refused = GetParam().stem().string().rfind("refused", 0) == 0;
  const bool is_read = kind == "log"           ? judge_log(contents)
                       : kind == "progressive" ? judge_progressive(contents)
                                               : judge_mesh(contents, mesh_format("m." + kind));
  const bool needs_decoder = GetParam().stem().string().rfind("packed", 0) == 0; // which a build may lack
  EXPECT_TRUE(is_read == !is_refused || needs_decoder);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Seeds, testing::ValuesIn(seeds()),
                         [](const auto& seed) { return name(seed.param); });

} // namespace
} // namespace selvedge::test
