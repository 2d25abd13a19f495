"""Figures: what they show, and a spectrum against its closed form."""
import pathlib
import tempfile
import unittest

import numpy

import gem

try:
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    raise unittest.SkipTest("matplotlib is not installed (package python3-matplotlib)") from None

CASES = pathlib.Path(__file__).resolve().parents[3] / "cases"


class PlotsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        path = pathlib.Path(cls.scratch.name, "run.h5")
        name = "price $x^{$ \\undefined"  # no formula
        cls.file = gem.run(CASES / "first.toml", path, threads=1, run__duration_s=60.0, run__name=name).open()

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        cls.scratch.cleanup()

    def tearDown(self):
        pyplot.close("all")

    def test_field(self):
        for colour in ("speed", "spin", "thickness"):
            axes = gem.plot_field(self.file, 30.0, colour)
            patches = axes.collections[0]
            outlines = self.file.outlines(30.0)
            self.assertEqual(len(patches.get_paths()), len(outlines.corners))
            numpy.testing.assert_array_equal(patches.get_array(), getattr(outlines, colour))
        axes.figure.savefig(pathlib.Path(self.scratch.name, "field.png"), dpi=50)
        with self.assertRaisesRegex(gem.GemError, "colour 'red' is unknown"):
            gem.plot_field(self.file, colour="red")

    def test_orbit(self):
        axes = gem.plot_orbit(self.file)
        self.assertEqual(len(axes.collections[0].get_segments()), self.file.platform.sizes["time"] - 1)
        axes.figure.savefig(pathlib.Path(self.scratch.name, "orbit.png"))

    def test_spectrum_of_a_run(self):
        axes = gem.plot_spectrum(self.file, "y", start=10.0)
        axes.figure.savefig(pathlib.Path(self.scratch.name, "spectrum.png"))
        self.assertIn("natural period 70.2 s", axes.get_legend().get_texts()[0].get_text())
        with self.assertRaisesRegex(gem.GemError, "channel 'z' is unknown"):
            gem.plot_spectrum(self.file, "z")

    def test_the_integral_of_a_spectrum_is_the_variance(self):
        time = numpy.arange(4096) * 0.5
        values = 3.0 * numpy.sin(2 * numpy.pi * time / 16.0) + 7.0  # 64 and 32 whole periods in the stretches
        frequency, density = gem.spectrum(time, values)
        self.assertAlmostEqual(float(frequency[numpy.argmax(density)]), 1 / 16.0, 9)
        self.assertAlmostEqual(float(density.sum() * frequency[1]), 4.5, 6)
        with self.assertRaisesRegex(gem.GemError, "too few"):
            gem.spectrum(time[:20], values[:20])
        with self.assertRaisesRegex(gem.GemError, "not evenly spaced"):
            gem.spectrum(time**2, values)


if __name__ == "__main__":
    unittest.main()
