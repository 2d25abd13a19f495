"""All tests of the package: PYTHONPATH=gem/python GEM_PROGRAM=build/gem python3 gem/python/tests. Exit code 77: skipped."""
import importlib.util
import pathlib
import sys
import unittest

for module in ("numpy", "h5py", "xarray"):
    if importlib.util.find_spec(module) is None:
        print(f"skipped: {module} is not installed (package python3-{module})")
        sys.exit(77)
tests = unittest.defaultTestLoader.discover(str(pathlib.Path(__file__).parent))
sys.exit(0 if unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful() else 1)
