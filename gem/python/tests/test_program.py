"""Runs, sweeps and analyses by the program."""
import pathlib
import tempfile
import unittest
import warnings

import numpy

import gem
from gem.program import setting_arguments

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"
SWING = {"run__duration_s": 20.0, "floes__source": "listed", "boundary__present": False, "platform__start_offset_m": [1.0, 0.0]}


class ProgramTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_run_with_settings_and_progress(self):
        lines = []
        result = gem.run(out=self.folder / "a b.h5", progress=lines.append, **SWING)
        self.assertEqual(lines[-1]["fraction"], 1.0)
        self.assertEqual(result.summary["status"], "complete")
        with result.open() as run:
            self.assertEqual(float(run.platform.time[-1]), 20.0)
            self.assertAlmostEqual(float(run.platform.x[0]), 1.0, 9)

    def test_the_program_s_errors_are_exceptions(self):
        with self.assertRaises(gem.ProgramError) as caught:
            gem.run(out=self.folder / "a.h5", floes__cont=3)
        self.assertEqual(caught.exception.exit_code, 3)
        self.assertIn("did you mean `floes.count`?", caught.exception.message)
        with self.assertRaises(gem.ProgramError) as caught:
            gem.run("--help", out=self.folder / "a.h5")  # a file name, not an option
        self.assertEqual(caught.exception.exit_code, 4)
        self.assertFalse((self.folder / "a.h5").exists())
        gem.run(out=self.folder / "a.h5", **SWING)
        with self.assertRaises(gem.ProgramError) as caught:
            gem.run(out=self.folder / "a.h5", **SWING)
        self.assertEqual(caught.exception.exit_code, 4)
        gem.run(out=self.folder / "a.h5", overwrite=True, **SWING)
        with self.assertRaisesRegex(gem.GemError, "was not found"):
            gem.run(gem=self.folder / "no gem", **SWING)

    def test_a_callback_that_raises_stops_the_run(self):
        def stop(_):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            gem.run(out=self.folder / "a.h5", progress=stop, **{**SWING, "run__duration_s": 1e7})
        with self.assertRaisesRegex(gem.GemError, "stopped:SIGINT"):
            gem.open(self.folder / "a.h5")

    def test_warnings(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            gem.run(CASES / "first.toml", self.folder / "a.h5", floes__source="listed", run__duration_s=1.0)
        self.assertTrue(any(one.category is gem.GemWarning and "floes.count" in str(one.message) for one in caught))

    def test_settings_in_the_syntax_of_a_case(self):
        settings = {"ice__class": [{"name": 'a "b"', "tenths": 4.0}], "platform__yaw": "free", "boundary__present": True,
                    "run__seed": numpy.int64(7)}
        self.assertEqual(setting_arguments(settings)[1::2],
                         ['ice.class=[{"name" = "a \\"b\\"", "tenths" = 4.0}]', 'platform.yaw="free"', "boundary.present=true",
                          "run.seed=7"])
        with self.assertRaisesRegex(gem.GemError, "cannot be written"):
            setting_arguments({"run__seed": object()})

    def test_texts_beyond_16_bits(self):
        name = 'floes \U0001f9ca "a\\b"'
        result = gem.run(out=self.folder / "a.h5", run__name=name, **SWING)
        with result.open() as run:
            self.assertEqual(run.case["run"]["name"], name)
        self.assertEqual(setting_arguments({"run__name": "\n\x7f\x01"})[1], 'run.name="\\n\\u007f\\u0001"')
        with self.assertRaisesRegex(gem.GemError, "cannot be written"):
            setting_arguments({"run__name": "half a pair: \ud83e"})

    def test_a_run_begins_with_another(self):
        first = gem.run(CASES / "first.toml", self.folder / "a.h5", floes__count=30, run__duration_s=20.0,
                        output__floes_interval_s=5.0, output__contact_forces=True)
        second = gem.run(CASES / "first.toml", self.folder / "b.h5", from_run=first.path, from_time=10.0, run__duration_s=1.0)
        with first.open() as before, second.open() as after:
            numpy.testing.assert_allclose(after.frame(0.0).x, before.frame(10.0).x, atol=1e-3)
            self.assertEqual(set(before.contacts) - {"time"}, {"body_a", "body_b", "x", "y", "force_x", "force_y"})
            self.assertTrue(set(before.contacts.time.values) <= set(before.frame_times()))
            self.assertNotIn("contacts", after.datasets())
        last = gem.run(CASES / "first.toml", self.folder / "c.h5", from_run=first.path, run__duration_s=1.0)
        with first.open() as before, last.open() as after:
            numpy.testing.assert_allclose(after.frame(0.0).x, before.frame().x, atol=1e-3)
        with self.assertRaisesRegex(gem.GemError, "needs from_run"):
            gem.run(out=self.folder / "d.h5", from_time=1.0)

    def test_sweep_collect_and_analyse(self):
        lines = []
        runs = gem.sweep(CASES / "small_sweep.toml", self.folder / "runs", jobs=1, progress=lines.append)
        self.assertEqual(len(runs), 6)
        self.assertEqual({run.summary["status"] for run in runs}, {"done"})
        with runs[-1].open() as run:
            self.assertEqual(run.state_hash, runs[-1].summary["state_hash"])
            largest = float(numpy.hypot(run.platform.mooring_force_x, run.platform.mooring_force_y).max())
        found = gem.analyse(runs[-1].path)["findings"]["mooring_force_largest_N"]["value"]
        self.assertAlmostEqual(found, largest, delta=1e-9 * largest)
        try:
            import h5netcdf  # noqa: F401
        except ImportError:
            self.skipTest("h5netcdf is not installed (package python3-h5netcdf); the rest passed")
        table = gem.collect(self.folder / "runs", self.folder / "table.nc.h5")
        self.assertEqual(table.sizes["run"], 6)
        self.assertEqual(float(table.mooring_force_largest_N[-1]), found)


if __name__ == "__main__":
    unittest.main()
