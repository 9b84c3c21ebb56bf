#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tells whether files include what they use: `sufficient_includes.py TREE`.

A unity build compiles several sources as one, so that a source may live on the includes of another, and fails for whoever
compiles it by itself. This check needs no compiler, and seconds where one takes minutes: it looks for names of the standard
library, and for types after which headers of the tree are named. It asks whether the file, or a header of the tree that it
includes, includes a header of each. Functions of the tree and names of other libraries it does not know. Exit status 1 when
an include is missing.
"""
import os
import pathlib
import re
import sys

from include_order import code, reached

# The headers of the names that are used here; any of those listed will do.
STANDARD = {
    "algorithm": "all_of any_of binary_search clamp copy copy_if copy_n count count_if equal_range fill fill_n find find_if "
                 "find_if_not for_each generate includes inplace_merge is_permutation is_sorted lexicographical_compare "
                 "lower_bound max_element merge min_element minmax minmax_element mismatch next_permutation none_of nth_element "
                 "partial_sort partition partition_point replace remove_if replace_if reverse rotate search set_difference "
                 "set_intersection set_symmetric_difference set_union shuffle sort stable_partition stable_sort "
                 "swap_ranges transform unique upper_bound",
    "array": "array", "atomic": "atomic", "bitset": "bitset", "charconv": "from_chars to_chars", "chrono": "chrono",
    "cmath": "abs acos atan2 cbrt ceil cos exp exp2 fabs floor fma fmod frexp hypot ilogb isfinite isinf isnan ldexp llround "
             "log log10 log2 lround nearbyint nextafter pow remainder round sin sqrt tan trunc",
    "condition_variable": "condition_variable", "deque": "deque", "exception": "current_exception exception_ptr",
    "filesystem": "filesystem", "fstream": "ifstream ofstream", "functional": "function greater hash less",
    "initializer_list": "initializer_list", "iomanip": "setprecision setw",
    "iostream": "cerr cin cout", "iterator": "back_inserter inserter istreambuf_iterator make_move_iterator",
    "limits": "numeric_limits", "list": "list", "map": "map multimap", "memory": "make_shared make_unique shared_ptr unique_ptr "
    "weak_ptr", "mutex": "lock_guard mutex unique_lock once_flag call_once", "numeric": "accumulate exclusive_scan iota partial_sum",
    "optional": "nullopt optional", "queue": "priority_queue queue", "random": "mt19937 mt19937_64", "set": "multiset set",
    "sstream": "istringstream ostringstream stringstream", "stdexcept": "domain_error invalid_argument logic_error out_of_range "
    "runtime_error", "string": "stod stoi stoul string to_string", "string_view": "string_view", "thread": "thread",
    "tuple": "forward_as_tuple make_tuple tie tuple", "type_traits": "conditional_t decay_t enable_if_t is_base_of_v is_const_v "
    "is_floating_point_v is_integral_v is_same_v is_void_v remove_reference_t", "unordered_map": "unordered_map",
    "unordered_set": "unordered_set", "variant": "get_if holds_alternative variant visit", "vector": "vector",
}
GENERATED = ["test/compile/every_policy.cpp"]  # their includes are not in the tree
HEADERS = {}
for header, names in STANDARD.items():
    for name in names.split():
        HEADERS.setdefault(name, set()).add(header)


def standard_includes(tree, files):
    text = "\n".join((tree / file).read_text(encoding="utf-8") for file in files)
    return set(re.findall(r"^#include <(\w+)>", text, re.MULTILINE))


def missing(tree, file, headers):
    """Yields what a file uses and does not include. `headers` are those of the tree, by their names."""
    seen = reached(tree, file, {file})
    text = re.sub(r'\bTEST(?:_P|_F)?\(\w+|/\*.*?\*/|"(?:[^"\\\n]|\\.)*"', "", code(tree, file), flags=re.DOTALL)
    included = standard_includes(tree, seen)
    for name in sorted(set(re.findall(r"\bstd::(\w+)", text))):
        if name in HEADERS and not HEADERS[name] & included:
            yield f"std::{name}, and not <{sorted(HEADERS[name])[0]}>"
    for name in sorted(set(re.findall(r"(?<![\w.])(?<!draco::)[A-Z][a-z]\w*\b", text))):
        declares = rf"\b(?:class|struct|using|enum class|namespace)\s+{name}\b"  # as a rule without an include
        of_name = {header for header in headers.get(name, ()) if file.startswith("test/") or not header.startswith("test/")}
        if of_name and not of_name & seen and not any(re.search(declares, code(tree, other)) for other in seen):
            yield f"{name}, and not {sorted(of_name)[0]}"


def main():
    tree = pathlib.Path(sys.argv[1])
    files = sorted(str(f.relative_to(tree)) for folder in ("include", "src", "apps", "bindings", "test")
                   for ending in ("h", "cpp") for f in (tree / folder).rglob("*." + ending))
    headers = {}
    for file in files:
        name, ending = os.path.splitext(os.path.basename(file))
        if ending == ".h":
            headers.setdefault(name, set()).add(file)
    errors = [f"{file}: uses {what}" for file in files if file not in GENERATED for what in missing(tree, file, headers)]
    print("\n".join(errors) if errors else f"{len(files)} files: all include what they use")
    return 1 if errors or not files else 0


if __name__ == "__main__":
    sys.exit(main())
