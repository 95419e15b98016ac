"""The scripts of benchmarks/ take from each other and from the program: each starts and says what it is
for, and what those of drives make is driven by the real program.

    benchmark_scripts_test.py PROGRAM
"""
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BENCHMARKS = ROOT / 'benchmarks'
sys.path.insert(0, str(BENCHMARKS / 'drives'))
import candidates  # noqa: E402
import concealed  # noqa: E402
import nulls  # noqa: E402
import planned_again  # noqa: E402
import soil_pulls  # noqa: E402

PROGRAM = ''


def skip_without(test, script, error):
    """Skips a test whose script takes a module of others that this Python lacks."""
    lacks = re.search(r"No module named '(\w+)'", error)
    if lacks and not list(BENCHMARKS.rglob(f'{lacks[1]}.py')):
        why = f'{script}: no Python module {lacks[1]}'
        print(f'\nskipped: {why}', flush=True)
        test.skipTest(why)


class Scripts(unittest.TestCase):
    def test_each_script_says_what_it_is_for(self):
        for script in sorted(BENCHMARKS.rglob('*.py')):
            name = script.relative_to(ROOT)
            is_module = '__main__' not in script.read_text(encoding='utf-8')
            asked = ['-c', f'import {script.stem}'] if is_module else [script, '--help']
            with self.subTest(script=str(name)):
                run = subprocess.run([sys.executable, *asked], cwd=script.parent, stdin=subprocess.DEVNULL,
                                     capture_output=True, text=True)
                skip_without(self, name, run.stderr)
                self.assertEqual((run.returncode, run.stderr), (0, ''))
                if not is_module:
                    self.assertRegex(run.stdout, r'^usage: (.|\n)+\n\n[A-Z](.|\n)+\n\noptions:')


class Drives(unittest.TestCase):
    """Of each world the first metres of its path are driven, by `drive` as campaigns run it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.chance = random.Random(1)

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text)
        return file

    def drives(self, folder, scenario, path, truth):
        """That the program takes all three, and gets to the end of the path or breaks a limit."""
        begins = (folder / path).read_text().splitlines()[:6]
        (folder / path).write_text('\n'.join(begins) + '\n')
        run = subprocess.run([PROGRAM, 'drive', scenario, path, '--truth', truth, '--sensors', 'A', '--quiet',
                              '--out', 'drive', '--force'], cwd=folder, capture_output=True, text=True)
        self.assertIn(run.returncode, (0, 2), run.stderr)

    def test_nulls_of_each_vehicle_with_all_that_may_be_otherwise(self):
        otherwise = types.SimpleNamespace(zone=True, drag=True, steering=True)
        for name, driven in nulls.VEHICLES.items():
            self.write('s.yaml', nulls.scenario(name))
            self.write('p.csv', nulls.wave(self.chance, driven))
            told = nulls.truth(self.chance, driven, otherwise)
            self.write('t.yaml', nulls.json.dumps(told))
            with self.subTest(vehicle=name):
                self.drives(self.folder, 's.yaml', 'p.csv', 't.yaml')

    def test_each_effect_that_is_concealed(self):
        for effect in concealed.EFFECTS:
            drive = concealed.Drive(self.folder, effect, 1, 'A')
            drive.conceal()
            with self.subTest(effect=effect):
                self.drives(drive.folder, 'scenario.yaml', 'path.csv', drive.truth)

    def test_bands_of_soils_with_and_without_a_hidden_one(self):
        for seed in (1, 2):
            drive = soil_pulls.Drive(self.folder, seed, 'A')
            drive.conceal()
            with self.subTest(seed=seed):
                self.drives(drive.folder, 'scenario.yaml', 'path.csv', 'truth.json')

    def test_a_patch_on_the_path_that_is_planned_again(self):
        self.write('s.yaml', planned_again.shorter(concealed.cratered(self.chance)))
        path = self.write('p.csv', concealed.at_speed(nulls.wave(self.chance)))
        self.write('t.json', planned_again.json.dumps(planned_again.patch(self.chance, path)))
        self.drives(self.folder, 's.yaml', 'p.csv', 't.json')

    def test_soils_drawn_from_the_spread_of_each_scenario(self):
        for scenario in sorted(candidates.SCENARIOS.glob('*.yaml')):
            with self.subTest(scenario=scenario.stem):
                try:
                    numbers = candidates.uncertain(scenario)
                except ModuleNotFoundError as error:
                    skip_without(self, 'candidates.py', str(error))
                    raise
                self.assertTrue(numbers)
        scenario = candidates.SCENARIOS / 'between_soils.yaml'
        begins = self.write('p.csv', 'x_m,y_m,speed_mps\n20,100,0\n24,100,1\n28,100,1\n')
        truth = candidates.drawn_truth(candidates.uncertain(scenario), self.chance, self.folder / 't.yaml')
        driven = candidates.drive(PROGRAM, scenario, begins, self.folder, 'compensated', truth)
        self.assertIn(driven['status'], ('reached', 'not_reached', 'limits_broken'))


if __name__ == '__main__':
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
