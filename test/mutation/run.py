#!/usr/bin/env python3
# Copyright (c) 2026 the Selvedge authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests on wrong versions of the code: each mutant of mutants.py must make a test fail.

A mutant changes one place of one file. The tree stays as it is: the changed file stands in a folder of its own, which
the compiler searches first. Only the programs that are to see the mutant, or the one library source that it is in, are
compiled anew, at -O1; all else comes from the build in --build, which is brought up to date at the start, and where
every test must pass. A mutant of the program is linked to a program, which the tests of cli_test run in place of the
build's. With ccache a second run compiles only what has changed. The tree must not be edited meanwhile.

    test/mutation/run.py                       all mutants
    test/mutation/run.py --only Projected_star    those whose file, change or reason holds a word
    test/mutation/run.py --rows 82-               what an earlier run did not come to
    test/mutation/run.py --list                only tells whether the tree still has every place to change, and every test

What becomes of a mutant:

    killed       a test failed or crashed, or did not end
    survived     all tests that should see it passed
    equal        all tests passed, and they must: mutants.py says why the mutant is no error
    not compiled the compiler refused it, which is as good

Ends with status 0 when no mutant survived, 1 when one did, and 2 when the text that a mutant changes does not stand in
its file exactly once, a test is not there, or the unchanged tree does not pass. Needs python 3.9, and what the tests
need.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mutants  # noqa: E402

TREE = pathlib.Path(__file__).resolve().parents[2]


def stop(message):
    print(message, file=sys.stderr)
    sys.exit(2)


def run(command, folder, seconds=None, **variables):
    """Returns status and output; the status is None after `seconds`."""
    process = subprocess.Popen(command, cwd=folder, shell=isinstance(command, str), text=True, errors="replace",
                               env={**os.environ, **variables},
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    try:
        output, _ = process.communicate(timeout=seconds)
        return process.returncode, output
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        return None, process.communicate()[0]


class Build:
    """A build of the unchanged tree, in which some of the objects can be exchanged."""

    def __init__(self, folder):
        self.folder = folder

    def update(self, tests):
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        if not (self.folder / "build.ninja").is_file():
            launcher += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
        for command in (["cmake", "-S", TREE, "-B", self.folder, "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *launcher],
                        ["ninja", "-C", self.folder, "-j2", "selvedge_library", *tests]):
            status, output = run([str(word) for word in command], TREE)
            if status != 0:
                stop(output + "\nThe unchanged tree does not compile.")
        with open(self.folder / "compile_commands.json", encoding="utf-8") as file:
            self.commands = {str(pathlib.Path(entry["file"]).relative_to(TREE)): entry["command"]
                             for entry in json.load(file) if pathlib.Path(entry["file"]).is_relative_to(TREE)}

    def source_of(self, test):
        return next(source for source in self.commands if pathlib.Path(source).stem == test)

    def compile(self, source, overlay):
        """Compiles a source as the build does, but with a folder first. Returns the object, or the error."""
        words = shlex.split(self.commands[source])
        result = overlay / (source.replace("/", "_") + ".o")
        words[words.index("-o") + 1] = str(result)
        mutated = overlay / source
        words[words.index("-c") + 1] = str(mutated if mutated.is_file() else TREE / source)
        first = next(i for i, word in enumerate(words) if word.startswith("-I"))
        words[first:first] = [f"-iquote{(TREE / source).parent}", f"-I{overlay / 'include'}", f"-I{overlay / 'src'}"]
        words += ["-O1", "-w"]  # a warning kills no mutant
        status, output = run(words, self.folder)
        return (result, None) if status == 0 else (None, output)

    def link_command(self, target):
        """Returns the words of the command that links a test, or the program."""
        commands = subprocess.check_output(["ninja", "-C", self.folder, "-t", "commands", target], text=True)
        words = shlex.split(commands.strip().splitlines()[-1])
        words = words[words.index("&&") + 1:]
        return words[:words.index("&&")]

    def program(self, test):
        """Returns where the build puts a test's program."""
        words = self.link_command(test)
        return self.folder / words[words.index("-o") + 1]

    def link(self, target, objects, overlay):
        """Links a test, or the program, with some objects in place of the build's. Returns what has been linked."""
        words = self.link_command(target)
        output = words.index("-o")
        program = overlay / target
        words[output + 1] = str(program)
        replaced = [str(objects[source]) for source in objects]
        names = tuple(f"/{pathlib.Path(source).name}.o" for source in objects)
        words = [word for word in words if not word.endswith(names)]
        # Before the library, so that nothing of the same name is taken from there.
        at = words.index("-o")
        words[at:at] = replaced
        status, message = run(words, self.folder)
        if status != 0:
            stop(message + f"\n{target} cannot be linked.")
        return program


def parts(test):
    """A test as it stands in mutants.py: "name" or "name:filter"."""
    name, _, chosen = test.partition(":")
    return name, ["--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=" + (chosen or "*")]


def judge(build, mutant, seconds, overlay):
    """Returns what became of a mutant, and the test that says so. The folder `overlay` is for its files."""
    shutil.rmtree(overlay, ignore_errors=True)
    changed = overlay / mutant.file
    if mutant.file.startswith("src/") and mutant.file.endswith(".h"):
        shutil.copytree(TREE / "src", overlay / "src")  # headers there include their neighbours
    changed.parent.mkdir(parents=True, exist_ok=True)
    text = (TREE / mutant.file).read_text(encoding="utf-8")
    changed.write_text(text.replace(mutant.old, mutant.new), encoding="utf-8")
    objects = {}
    sources = [mutant.file] if mutant.file.endswith(".cpp") else list(mutant.sources)
    for source in sources:
        objects[source], error = build.compile(source, overlay)
        if error:
            return "not compiled", error.strip().splitlines()[0][-100:]
    of_app = {}
    if mutant.file.startswith("apps/"):
        of_app["SELVEDGE_APP"] = str(build.link("selvedge_app", objects, overlay))
    for test in mutant.tests:
        name, options = parts(test)
        own = dict(objects)
        if not of_app and not mutant.file.endswith(".cpp"):
            source = build.source_of(name)
            own[source], error = build.compile(source, overlay)
            if error:
                return "not compiled", next(line for line in error.splitlines() if "error" in line)[-100:]
        program = build.program(name) if of_app else build.link(name, own, overlay)
        status, output = run([str(program), *options], build.folder, 60 + 10 * seconds[test], **of_app)
        if status is None:
            return "killed", f"{name} (no end)"
        if status != 0:
            failed = [line for line in output.splitlines() if line.startswith("[  FAILED  ]")]
            return "killed", f"{name} {failed[0][13:].split(' (')[0].split(',')[0] if failed else '(crash)'}"
    return ("equal" if mutant.equal else "survived"), ""


def rows(text, last):
    """Returns the numbers that a list of them and of their ranges names."""
    numbers = set()
    for part in text.split(","):
        first, is_range, beyond = part.partition("-")
        numbers.update(range(int(first), (int(beyond) if beyond else last if is_range else int(first)) + 1))
    return numbers


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", metavar="WORD", help="mutants whose file, change or reason holds this")
    parser.add_argument("--rows", default="1-", help="of these, by their numbers: 5,82-120,130-")
    parser.add_argument("--list", action="store_true", help="compile nothing")
    parser.add_argument("--build", type=pathlib.Path, default=TREE / "build/dev", metavar="FOLDER")
    parser.add_argument("--jobs", type=int, default=1, metavar="NUMBER", help="mutants at a time")
    arguments = parser.parse_args()

    chosen = [mutant for mutant in mutants.ALL
              if arguments.only in " ".join([mutant.file, mutant.old, mutant.new, mutant.reason])]
    wanted = rows(arguments.rows, len(chosen))
    chosen = {number: mutant for number, mutant in enumerate(chosen, 1) if number in wanted}
    for mutant in chosen.values():
        count = (TREE / mutant.file).read_text(encoding="utf-8").count(mutant.old) if (TREE / mutant.file).is_file() else 0
        if count != 1:
            stop(f"{mutant.file} has this text {count} times, not once; state the mutant anew:\n{mutant.old}")
        for test in mutant.tests:
            if parts(test)[0] != "cli_test" and not any(TREE.glob(f"test/*/{parts(test)[0]}.cpp")):
                stop(f"no file of test/ has the tests that are to see a mutant of {mutant.file}: {test}")
    if arguments.list:
        for mutant in chosen.values():
            print(f"{mutant.file}: {mutant.reason}")
        print(f"{len(chosen)} mutants")
        return 0

    build = Build(arguments.build.resolve())
    tests = sorted({test for mutant in chosen.values() for test in mutant.tests})
    build.update(sorted({parts(test)[0] for test in tests}))
    seconds = {}
    for test in tests:
        name, options = parts(test)
        start = time.monotonic()
        status, output = run([str(build.program(name)), *options], build.folder)
        seconds[test] = time.monotonic() - start
        if status != 0:
            stop(output + f"\n{test} does not pass on the unchanged tree.")

    def outcome(mutant):
        change = hashlib.sha256(f"{mutant.file} {mutant.old} {mutant.new}".encode()).hexdigest()
        overlay = build.folder / "mutants" / change[:16]  # the same every time, for ccache
        result = judge(build, mutant, seconds, overlay)
        shutil.rmtree(overlay)
        return result

    counts = {}
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for (number, mutant), (became, by) in zip(chosen.items(), pool.map(outcome, chosen.values())):
            counts[became] = counts.get(became, 0) + 1
            print(f"| {number} | {mutant.file.rsplit('/')[-1]} | {mutant.reason} | {became} | {by} |", flush=True)
    print(", ".join(f"{count} {outcome}" for outcome, count in sorted(counts.items())))
    return 1 if counts.get("survived") else 0


if __name__ == "__main__":
    sys.exit(main())
