"""cmake/clang_tidy.py passes over a unit only where it is what clang-tidy has passed.

A clang-tidy of our own stands in: it writes down what it was asked to check and fails where the text
says so.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / 'cmake/clang_tidy.py'
TIDY = '''#!/bin/sh
here=$(dirname "$0")
[ "$1" = --version ] && { cat "$here/version"; exit; }
for unit; do :; done
basename "$unit" >>"$here/asked"
! grep -q WRONG "$unit"
'''


class ClangTidy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        self.passed = self.root / 'cmake/clang_tidy_passed.txt'
        self.write('clang-tidy', TIDY).chmod(0o755)
        self.write('version', 'LLVM version 14.0.6\n  Host CPU: any\n')
        self.write('.clang-tidy', 'Checks: bugprone-*\n')
        self.write('cmake/.keep', '')
        self.write('maps/a.cpp', '#include "maps/a.h"\nint a() { return kA; }\n')
        self.write('maps/a.h', '#include "deep.h"\n')
        self.write('maps/deep.h', 'constexpr int kA = 1;\n')
        self.write('maps/b.cpp', '#include <vector>\nint b();\n')
        self.commands('-O2')

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def commands(self, flags):
        entries = [{'file': str(self.root / 'maps' / name), 'directory': str(self.root),
                    'command': f'c++ {flags} -I{self.root} -c {self.root}/maps/{name}'} for name in ('a.cpp', 'b.cpp')]
        self.write('build/compile_commands.json', json.dumps(entries))

    def run_it(self, *options):
        """What was checked, and whether all is well."""
        asked = self.write('asked', '')
        run = subprocess.run([sys.executable, SCRIPT, self.root / 'build', '--root', self.root, '--tidy',
                              self.root / 'clang-tidy', *options], capture_output=True, text=True)
        self.assertEqual(run.stderr, '')
        return sorted(asked.read_text().split()), run.returncode == 0

    def test_what_is_not_listed_is_checked_and_listing_is_asked_for(self):
        self.assertEqual(self.run_it(), (['a.cpp', 'b.cpp'], True))
        self.assertFalse(self.passed.exists())
        self.assertEqual(self.run_it('--write'), (['a.cpp', 'b.cpp'], True))
        self.assertEqual(self.run_it(), ([], True))

    def test_a_change_of_anything_that_a_unit_is_made_of_has_it_checked(self):
        both = ['a.cpp', 'b.cpp']
        for change, checked in (
                (lambda: self.write('maps/a.cpp', 'int a();\n'), ['a.cpp']),
                (lambda: self.write('maps/deep.h', 'constexpr int kA = 2;\n'), ['a.cpp']),
                (lambda: self.write('maps/vector', ''), ['b.cpp']),
                (lambda: self.write('.clang-tidy', 'Checks: misc-*\n'), both),
                (lambda: self.write('version', 'LLVM version 15.0.0\n'), both),
                (lambda: self.commands('-O3'), both)):
            self.setUp()
            self.run_it('--write')
            change()
            self.assertEqual(self.run_it(), (checked, True))

    def test_what_failed_fails_again_until_it_is_mended(self):
        self.write('maps/b.cpp', 'int WRONG();\n')
        self.assertEqual(self.run_it('--write'), (['a.cpp', 'b.cpp'], False))
        self.assertEqual(self.run_it('--write'), (['b.cpp'], False))
        self.write('maps/b.cpp', 'int right();\n')
        self.assertEqual(self.run_it('--write'), (['b.cpp'], True))

    def test_an_entry_that_was_tampered_with_passes_nothing(self):
        self.run_it('--write')
        first, second = self.passed.read_text().splitlines()
        self.passed.write_text(f'{first[::-1]}\n{second}\n')
        self.assertEqual(self.run_it(), (['a.cpp'], True))
        self.passed.write_text('maps/a.cpp\nmaps/b.cpp\n')
        self.assertEqual(self.run_it(), (['a.cpp', 'b.cpp'], True))

    def test_a_tree_without_units_is_a_mistake(self):
        self.write('build/compile_commands.json', '[]')
        run = subprocess.run([sys.executable, SCRIPT, self.root / 'build', '--root', self.root], capture_output=True)
        self.assertNotEqual(run.returncode, 0)


if __name__ == '__main__':
    unittest.main()
