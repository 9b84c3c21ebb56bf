// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <selvedge/generate.h>
#include <selvedge/simplify.h>

int main()
{
  selvedge::Generate_options size;
  size.faces = 400;
  selvedge::Simplify_options options;
  options.ratio = 0.5;
  const selvedge::Prepared_soup grid = selvedge::prepare(selvedge::generate("grid", size));
  return selvedge::simplify_soup(grid, options).report.is_reached() ? 0 : 1;
}
