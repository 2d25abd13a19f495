"""Run files read by the package, against h5py and against xarray with h5netcdf."""
import pathlib
import tempfile
import time
import subprocess
import unittest

import h5py
import numpy

import gem

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"


class RunFileTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.result = gem.run(CASES / "first.toml", cls.folder / "run.h5", threads=1, run__duration_s=120.0,
                             output__contact_forces=True)
        cls.file = cls.result.open()

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        cls.scratch.cleanup()

    def test_every_number_is_that_of_the_file(self):
        compared = 0
        with h5py.File(self.result.path) as file:
            for name in gem.run_file.GROUPS:
                group = self.file.group(name)
                for key, variable in group.variables.items():
                    item = file[name][key]
                    numpy.testing.assert_array_equal(variable.values, item[...], f"{name}/{key}")
                    self.assertEqual(variable.values.dtype, item.dtype)
                    self.assertEqual(variable.attrs["units"], item.attrs["units"].decode())
                    compared += 1
        self.assertGreater(compared, 100)
        self.assertEqual(self.file.floes.x.dims, ("time", "floe"))
        self.assertGreater(self.file.events.sizes["event"], 0)

    def test_equals_xarray_with_h5netcdf(self):
        try:
            import h5netcdf  # noqa: F401
        except ImportError:
            self.skipTest("h5netcdf is not installed (package python3-h5netcdf)")
        import xarray

        for name in gem.run_file.GROUPS:
            with xarray.open_dataset(self.result.path, engine="h5netcdf", group=name) as other:
                for key, variable in self.file.group(name).variables.items():
                    self.assertEqual(other[key].dims, variable.dims, f"{name}/{key}")
                    numpy.testing.assert_array_equal(other[key].values, variable.values, f"{name}/{key}")

    def test_what_the_file_says_of_itself(self):
        self.assertEqual((self.file.name, self.file.status), ("first", "complete"))
        self.assertEqual(self.file.state_hash, self.result.summary["state_hash"])
        self.assertEqual(self.file.verdict, self.result.verdict)
        self.assertEqual(self.file.case["run"]["duration_s"], 120.0)

    def test_outlines_have_place_and_area_of_their_floes(self):
        outlines = self.file.outlines(60.0)
        frame = self.file.floes.sel(time=60.0)
        self.assertEqual(outlines.time, 60.0)
        self.assertEqual(len(outlines.corners), int(frame.active.sum()))
        for i in range(0, len(outlines.corners), 97):
            x, y = outlines.corners[i].T
            nx, ny = numpy.roll(x, -1), numpy.roll(y, -1)
            cross = x * ny - nx * y
            area = cross.sum() / 2
            floe = outlines.floe[i]
            self.assertAlmostEqual(area / float(self.file.shape.area[floe]), 1, 6)
            # the sum loses digits far from the origin: 500 m against an area of some 50 m2
            self.assertAlmostEqual(((x + nx) * cross).sum() / (6 * area), float(frame.x[floe]), 3)
            self.assertAlmostEqual(outlines.speed[i], float(numpy.hypot(frame.vx[floe], frame.vy[floe])), 6)

    def test_last_frame_and_wrong_times(self):
        self.assertEqual(float(self.file.frame().time), 120.0)
        self.assertEqual(float(self.file.frame(58.0).time), 60.0)
        for wrong in (-1.0, 1e4):
            with self.assertRaisesRegex(gem.GemError, "choose a time in it"):
                self.file.frame(wrong)

    def test_tree(self):
        import xarray

        if hasattr(xarray, "DataTree"):
            self.assertEqual(float(self.file.tree()["platform"]["time"][-1]), 120.0)
        else:
            with self.assertRaisesRegex(gem.GemError, "no DataTree"):
                self.file.tree()
        self.assertEqual(set(self.file.datasets()), set(gem.run_file.GROUPS))

    def test_other_files_are_refused(self):
        text = self.folder / "notes.h5"
        text.write_text("notes")
        plain = self.folder / "plain.h5"
        with h5py.File(plain, "w") as file:
            file["x"] = [1.0]
        later = self.folder / "later.h5"
        later.write_bytes(pathlib.Path(self.result.path).read_bytes())
        with h5py.File(later, "a") as file:
            file.attrs["gem_schema"] = "99"
        for path, reason in ((text, "cannot read"), (plain, "not a run file"), (self.folder / "none.h5", "No such file"),
                             (later, "layout '99'")):
            with self.assertRaisesRegex(gem.GemError, reason):
                gem.open(path)
        with self.assertRaisesRegex(gem.GemError, "no group 'ice'"):
            self.file.group("ice")

    def test_damaged_outlines_are_refused(self):
        path = self.folder / "damaged.h5"
        path.write_bytes(pathlib.Path(self.result.path).read_bytes())
        with h5py.File(path, "a") as file:
            file["shape/vertex_count"][0] += 1
        with gem.open(path) as run, self.assertRaisesRegex(gem.GemError, "may be damaged"):
            run.outlines()

    def test_a_run_that_is_being_written(self):
        path = self.folder / "running.h5"
        arguments = [gem.program(), "run", CASES / "analytic/V10_floe_on_moored_platform.toml", "-q", "--until", "10000000"]
        with subprocess.Popen([*arguments, "--out", path], stderr=subprocess.DEVNULL) as process:
            try:
                deadline = time.monotonic() + 30
                while not path.exists() and time.monotonic() < deadline:
                    time.sleep(0.05)
                with self.assertRaisesRegex(gem.GemError, "status: running.*allow_incomplete"):
                    gem.open(path)
                with gem.open(path, allow_incomplete=True) as run:
                    first = run.platform.sizes["time"]
                    self.assertGreater(first, 0)
                    while run.platform.sizes["time"] == first and time.monotonic() < deadline:
                        time.sleep(0.3)
                        run.refresh()
                    self.assertGreater(run.platform.sizes["time"], first, "new rows are seen")
                    self.assertTrue((numpy.diff(run.platform.time) > 0).all())
            finally:
                process.kill()


if __name__ == "__main__":
    unittest.main()
