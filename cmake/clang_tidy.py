#!/usr/bin/env python3
"""clang-tidy on the units that are not as they were when it passed them.

    cmake/clang_tidy.py BUILD [--write]

BUILD is a build folder inside the source tree (its compile_commands.json names the units). A unit is
passed over only where cmake/clang_tidy_passed.txt holds its fingerprint: a hash of its text, of every
file of the tree that it includes however deep, of its compiler's command line, of .clang-tidy and of
clang-tidy's version. Whatever else stands in that file, or nothing, means that the unit is checked.
What libraries' headers hold is not in the fingerprint. --write enters what passed, and nothing else.
"""
import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', re.MULTILINE)


class Tree:
    def __init__(self, root, build, tidy, rooms):
        self.root, self.build, self.tidy = root, build, tidy
        ours = re.compile(rf'{re.escape(str(build))}/CMakeFiles/regoplan(_({rooms}))?\.dir/Unity/'
                          rf'|{re.escape(str(root))}/({rooms})/')
        entries = json.loads((build / 'compile_commands.json').read_text())
        self.commands = {entry['file']: entry['command'] for entry in entries if ours.match(entry['file'])}
        version = subprocess.run([tidy, '--version'], capture_output=True, text=True, check=True).stdout
        # Of the version, not of the processor that it runs on.
        self.version = re.search(r'.*version.*', version)[0].strip()

    @functools.cache
    def text(self, file):
        """Its text, wherever the tree lies."""
        return file.read_text(errors='surrogateescape').replace(str(self.root), '.')

    @functools.cache
    def included(self, file):
        """Files of the tree that one includes itself; another's headers are left out."""
        found = set()
        for name in INCLUDE.findall(file.read_text(errors='surrogateescape')):
            for folder in (file.parent, self.root, self.build):
                path = pathlib.Path(os.path.normpath(folder / name))
                if path.is_relative_to(self.root) and path.is_file():
                    found.add(path)
        return found

    def fingerprint(self, unit):
        reached, open_files = set(), [pathlib.Path(unit)]
        while open_files:
            file = open_files.pop()
            if file not in reached:
                reached.add(file)
                open_files.extend(self.included(file))
        parts = [self.version, (self.root / '.clang-tidy').read_text(),
                 self.commands[unit].replace(str(self.root), '.')]
        for file in sorted(reached):
            parts += [str(file.relative_to(self.root)), self.text(file)]
        joined = b''.join(hashlib.sha256(part.encode(errors='surrogateescape')).digest() for part in parts)
        return hashlib.sha256(joined).hexdigest()

    def check(self, unit):
        return subprocess.run([self.tidy, '--quiet', '-p', str(self.build), unit], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('--write', action='store_true', help='enter the units that passed')
    parser.add_argument('--root', type=pathlib.Path, default=root)
    parser.add_argument('--tidy', default='clang-tidy')
    parser.add_argument('--rooms', default='terramech|maps|planner|driving|diagnosis|drive_diagnosis|benchmarking|app')
    options = parser.parse_args()
    read_tree = lambda: Tree(options.root.resolve(), options.build.resolve(), options.tidy, options.rooms)
    tree = read_tree()
    if not tree.commands:
        sys.exit(f'{options.build}: no unit of the tree stands in compile_commands.json')

    passed_file = tree.root / 'cmake/clang_tidy_passed.txt'
    listed = set(passed_file.read_text().split()) if passed_file.exists() else set()
    fingerprints = {unit: tree.fingerprint(unit) for unit in sorted(tree.commands)}
    passed = {unit for unit, fingerprint in fingerprints.items() if fingerprint in listed}
    to_check = sorted(fingerprints.keys() - passed, key=lambda unit: -len(tree.included(pathlib.Path(unit))))
    print(f'{len(passed)} of {len(fingerprints)} units are as they were when they passed', flush=True)

    def enter_passed():
        """As they are read now: who edits while this runs has checked something else."""
        now = read_tree()
        lines = [f'{fingerprints[unit]}  {os.path.relpath(unit, tree.root)}\n' for unit in sorted(passed)
                 if now.fingerprint(unit) == fingerprints[unit]]
        passed_file.write_text(''.join(lines))

    if options.write:
        enter_passed()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        runs = {threads.submit(tree.check, unit): unit for unit in to_check}
        for run in concurrent.futures.as_completed(runs):
            unit, result = runs[run], run.result()
            print(f'{"FAILED" if result.returncode else "passed"} {os.path.relpath(unit, tree.root)}', flush=True)
            if result.returncode:
                print(result.stdout, flush=True)
                continue
            passed.add(unit)
            if options.write:
                enter_passed()
    sys.exit(0 if passed == set(fingerprints) else 1)


if __name__ == '__main__':
    main()
