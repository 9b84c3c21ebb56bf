# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Members of plain structs of the public headers have initial values.

An object that is made without any has what was on the stack before, and no sanitizer that CI runs sees a read of it.
usage: initial_values.py TREE
"""

import pathlib
import re
import sys

NUMBERS = "bool|char|int|unsigned|long|float|double|std::size_t|std::u?int(8|16|32|64)_t|Index|Index_triple|Point_3|Vector_3"


def members_without_value(text, enums):
    """Yields the numbers and texts of lines of structs that declare numbers, enumerators or pointers without a value."""
    types = "|".join([NUMBERS, *enums])
    member = re.compile(rf"^ +(const )?((\w+::)*({types})|std::array<({types}), \d+>|[\w:<>]+\*) \w+(, \w+)*;")
    scopes, opened = [], None
    for number, line in enumerate(text.split("\n"), 1):
        code = line.split("//")[0]
        if scopes and scopes[-1] and member.match(code):
            yield number, code.strip()
        if found := re.match(r" *(template <.*> )?struct \w+", code):
            opened = found
        for letter in code:
            if letter == "{":
                scopes.append(opened is not None)
                opened = None
            elif letter == "}":
                scopes.pop()
            elif letter == ";":
                opened = None


def main():
    tree = pathlib.Path(sys.argv[1])
    headers = {file: file.read_text(encoding="utf-8") for file in sorted((tree / "include/selvedge").glob("*.h"))}
    enums = sorted({name for text in headers.values() for name in re.findall(r"\benum class (\w+)", text)})
    errors = [f"{file.relative_to(tree)}:{number}: {code} has no initial value"
              for file, text in headers.items() for number, code in members_without_value(text, enums)]
    print("\n".join(errors) if errors else f"{len(headers)} headers: all members of plain structs have initial values")
    return 1 if errors or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
