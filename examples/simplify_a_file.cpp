// Copyright (c) 2026 the Selvedge authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Reads a mesh, reduces it to 30 % of its faces, judges the result, and writes it.
//   simplify_a_file IN OUT
#include <selvedge/Error.h>
#include <selvedge/mesh_files.h>
#include <selvedge/simplify.h>

#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 3) {
    std::cerr << "usage: simplify_a_file IN OUT\n";
    return 2;
  }
  try {
    //! [calls]
    selvedge::Prepare_options prepare_options;
    prepare_options.round_to_float32 = selvedge::stores_float32(selvedge::mesh_format(argv[2]));
    const selvedge::Prepared_soup input =
        selvedge::prepare(selvedge::read_mesh(argv[1]).soup, prepare_options);

    selvedge::Simplify_options options;
    options.ratio = 0.3;
    const selvedge::Simplified_soup result = selvedge::simplify_soup(input, options);

    const selvedge::Verification verdict = selvedge::verify(result, input);
    std::cout << result.report.faces_input << " faces to " << result.report.faces_output << " ("
              << result.report.outcome() << "), " << verdict.new_pairs.size() << " new offending pairs\n";
    selvedge::write_mesh(argv[2], result.soup);
    //! [calls]
    return verdict.accepted() ? 0 : 1;
  } catch (const selvedge::Error& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
